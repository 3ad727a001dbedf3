"""Doors that do not bite: a command never destroys what it reads, and says what it is given."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.e2e.test_cli import ROOT, SAMPLES, edited, kshm, refused
from tests.workbook.made import coarse_book

OWN = "результат лёг бы поверх ваших исходных данных; укажите другое место"
DIAGRAM = "angle,pressure\n" + "".join(
    f"{angle},{8.0 if angle == 360 else 0.1}\n" for angle in range(0, 721, 30)
)


@pytest.fixture
def engine(tmp_path: Path) -> Path:
    path = tmp_path / "engine.toml"
    shutil.copy(SAMPLES / "d-240.toml", path)
    return path


def links(folder: Path, path: Path) -> list[Path]:
    """The same file by other names."""
    soft, hard = folder / f"soft{path.suffix}", folder / f"hard{path.suffix}"
    soft.symlink_to(path)
    os.link(path, hard)
    (folder / "sub").mkdir()
    return [path, soft, hard, folder / "sub" / ".." / path.name]


def test_solve_spares_its_own_input(engine: Path, tmp_path: Path) -> None:
    before = engine.read_bytes()
    for target in links(tmp_path, engine):
        assert OWN in refused(kshm("solve", engine, "--json", target))[-1]
        assert engine.read_bytes() == before
    assert OWN in refused(kshm("solve", "engine.toml", "--json", "./engine.toml", cwd=tmp_path))[0]
    assert engine.read_bytes() == before


def with_diagram(tmp_path: Path, name: str) -> Path:
    (tmp_path / name).write_text(DIAGRAM, encoding="utf-8")
    text = (SAMPLES / "d-240.toml").read_text(encoding="utf-8")
    head, _, rest = text.partition("[gas]")
    rest = rest[rest.index("[masses]") :]
    gas = f'[gas]\nsource = "file"\nfile = "{name}"\npressure_unit = "mpa"\n\n'
    path = tmp_path / "engine.toml"
    path.write_text(head + gas + rest, encoding="utf-8")
    return path


def test_solve_spares_the_diagram_beside_its_input(tmp_path: Path) -> None:
    path = with_diagram(tmp_path, "gas.csv")
    done = kshm("solve", path, "--csv", tmp_path)
    assert done.returncode == 2 and OWN in done.stderr.splitlines()[-1]
    assert (tmp_path / "gas.csv").read_text(encoding="utf-8") == DIAGRAM
    assert sorted(path.name for path in tmp_path.iterdir()) == ["engine.toml", "gas.csv"]


def test_sweep_spares_its_own_input(tmp_path: Path) -> None:
    book, before = tmp_path / "d-240.xlsx", coarse_book("d-240")
    book.write_bytes(before)
    vary = ("--vary", "geometry.bore_mm=108:110:2", "-o")
    for target in links(tmp_path, book):
        assert OWN in refused(kshm("sweep", book, *vary, target))[-1]
        assert book.read_bytes() == before
    path = with_diagram(tmp_path, "points.csv")
    done = kshm("sweep", path, *vary, tmp_path / "points.csv")
    assert done.returncode == 2 and OWN in done.stderr.splitlines()[-1]
    assert (tmp_path / "points.csv").read_text(encoding="utf-8") == DIAGRAM


def test_build_spares_its_own_input(engine: Path, tmp_path: Path) -> None:
    before = engine.read_bytes()
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "engine.xlsx").symlink_to(engine)
    assert OWN in refused(kshm("build", engine, "-o", tmp_path / "out", "--only", "xlsx"))[-1]
    assert engine.read_bytes() == before


def test_issue_spares_its_base(tmp_path: Path) -> None:
    out, base, roster = (tmp_path / name for name in ("issued", "base.toml", "group.csv"))
    text = (SAMPLES / "class/base.toml").read_text(encoding="utf-8")
    assert "step_deg = 10" in text
    base.write_text(text.replace("step_deg = 10", "step_deg = 30"), encoding="utf-8")
    roster.write_text("Фамилия;Имя\nИванова;Анна\n", encoding="utf-8")
    secret = ("--secret", tmp_path / "key")
    assert kshm("issue", base, "--roster", roster, "-o", out, *secret).returncode == 0
    own = out / "base.toml"
    shutil.copy(base, own)
    line = refused(kshm("issue", own, "--roster", roster, "-o", out, *secret))[-1]
    assert "файл лежит в папке выдачи" in line
    assert own.read_bytes() == base.read_bytes()


@pytest.mark.parametrize(
    ("path", "what"),
    [("/dev/zero", "это устройство, а нужен файл"), ("/dev/null", "это устройство, а нужен файл")],
)
def test_a_device_is_called_one(path: str, what: str) -> None:
    assert refused(kshm("check", path)) == [f"{path}: {what}; проверьте имя и путь"]


@pytest.mark.parametrize("name", ["pipe.toml", "pipe.xlsx"])
def test_a_pipe_is_called_one(tmp_path: Path, name: str) -> None:
    os.mkfifo(tmp_path / name)
    assert "это канал, а нужен файл" in refused(kshm("check", tmp_path / name))[0]


def test_standard_input_is_called_what_it_is() -> None:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-m", "reports", "check", "/dev/stdin"], input=b"x", capture_output=True,
        env=environment, check=False,
    )  # fmt: skip
    assert done.returncode == 2
    assert "/dev/stdin: это канал, а нужен файл" in done.stderr.decode()


def test_a_missing_folder_of_templates_fails_the_check(tmp_path: Path) -> None:
    path = edited(tmp_path, ("[report]", '[report]\ntemplates = "none"'))
    assert "report.templates: нет папки" in refused(kshm("check", path))[-1]
    done = kshm("check", path, "--json")
    assert done.returncode == 2 and not json.loads(done.stdout)["ok"]
    done = kshm("build", path, "-o", tmp_path, "--only", "xlsx")
    assert done.returncode == 2 and not (tmp_path / "engine.xlsx").exists()


@pytest.mark.parametrize("module", ["kshm", "reports"])
def test_both_packages_are_the_command(module: str) -> None:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-m", module], capture_output=True, env=environment, check=False
    )
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout.decode().startswith("Использование: kshm [КЛЮЧИ] КОМАНДА")


COMMANDS = ("", "new", "check", "solve", "build", "issue", "grade", "validate", "sweep",
            "optimise", "schema", "doctor")  # fmt: skip
# Names of things, the same in every language.
NAMES = set(
    re.findall(
        r"\w+",
        "kshm live html pdf xlsx xlsm csv json toml excel moodle zip dask parquet tcp host "
        "variants gots diesel geometry bore mm m mean p n mpa libreoffice issue build new "
        "inline v opposed petrol docx sheet book schema max",
    )
)


@pytest.mark.parametrize("columns", ["30", "40", "80", "200"])
@pytest.mark.parametrize("command", COMMANDS)
def test_no_english_in_the_help(
    monkeypatch: pytest.MonkeyPatch, command: str, columns: str
) -> None:
    monkeypatch.setenv("COLUMNS", columns)
    text = kshm(*command.split(), "--help").stdout
    plain = re.sub(r"--?[a-z-]+", "", text)
    plain = re.sub(r"(?m)^  [a-z]+  ", "", plain)  # the commands of the list
    plain = re.sub(r"kshm [a-z]+", "", plain)
    assert {word.lower() for word in re.findall(r"[A-Za-z]+", plain)} <= NAMES


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("build", "не указан аргумент ФАЙЛ"),
        ("buld x", "нет команды buld"),
        ("check a b", "лишний аргумент b"),
        ("build x --only doc", "неверное значение --only: «doc»; допустимо: xlsx, pdf, html"),
        ("solve x --csv", "ключу --csv нужно значение"),
        ("grade --jobs q", "неверное значение --jobs: нужно число, а задано «q»"),
        ("check --json=1 x", "ключ --json пишется без значения"),
        ("grade --explain a", "ключу --explain нужно значений: 2"),
        ("--foo", "нет ключа --foo"),
        ("issue x -o y", "нужны список группы (--roster) и папка для выдачи (-o)"),
        ("serve --port 99999", "неверное значение --port: 99999 вне пределов от 1 до 65535"),
        ("build samples/gots-diesel.toml --only html --style no.toml", "no.toml: файл не найден; "),
    ],
)
def test_usage_errors_are_russian(arguments: str, words: str) -> None:
    (line,) = refused(kshm(*arguments.split()))
    assert words in line


def test_a_slip_in_the_ranges_is_told_in_russian(tmp_path: Path) -> None:
    ranges = tmp_path / "ranges.toml"
    ranges.write_text("[variants\n")
    group = ("--roster", "samples/class/group.csv", "-o", tmp_path / "out")
    (line,) = refused(kshm("issue", "samples/gots-diesel.toml", *group, "--ranges", ranges))
    assert line.startswith("ranges.toml: строка 1")
    assert "Expected" not in line
