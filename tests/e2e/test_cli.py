"""The command line as a person meets it: results, messages, exit codes, nothing half-written."""

from __future__ import annotations

import csv
import io
import json
import os
import subprocess
import sys
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path

import pytest
from openpyxl import load_workbook

from reports.cli import main
from tests.workbook.made import coarse_book

ROOT = Path(__file__).parents[2]
SAMPLES = ROOT / "samples"
COARSE = ("step_deg = 10", "step_deg = 15")  # where cells with numbers are not looked at


def kshm(*args: object, cwd: Path = ROOT) -> subprocess.CompletedProcess[str]:
    """The command line in this process: its words and its exit code."""
    out, err = io.StringIO(), io.StringIO()
    command = [*map(str, args)]
    streams = redirect_stdout(out), redirect_stderr(err)
    with chdir(cwd), streams[0], streams[1], pytest.raises(SystemExit) as left:
        main(command)
    code = left.value.code if isinstance(left.value.code, int) else 0
    return subprocess.CompletedProcess(command, code, out.getvalue(), err.getvalue())


def as_process(*args: object) -> subprocess.CompletedProcess[str]:
    """The command line as a person starts it."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONIOENCODING": "utf-8"}
    return subprocess.run(
        [sys.executable, "-m", "reports", *map(str, args)],
        capture_output=True, text=True, cwd=ROOT, env=environment, timeout=300, check=False,
    )  # fmt: skip


def refused(done: subprocess.CompletedProcess[str]) -> list[str]:
    """Lines of a refusal: exit code 2, no traceback, nothing on stdout."""
    assert done.returncode == 2, (done.stdout, done.stderr)
    assert "Traceback" not in done.stderr
    assert done.stdout == ""
    lines = done.stderr.splitlines()
    assert lines
    return lines


def edited(tmp_path: Path, *replacements: tuple[str, str], name: str = "gots-diesel") -> Path:
    text = (SAMPLES / f"{name}.toml").read_text(encoding="utf-8")
    for old, new in replacements:
        assert old in text, old
        text = text.replace(old, new, 1)
    path = tmp_path / "engine.toml"
    path.write_text(text, encoding="utf-8")
    return path


def line_of(name: str, key: str) -> str:
    """The line of a sample that sets a key, comment included."""
    text = (SAMPLES / f"{name}.toml").read_text(encoding="utf-8")
    return next(line for line in text.splitlines() if line.split("=")[0].strip() == key)


def with_key(tmp_path: Path, key: str, value: str) -> Path:
    return edited(tmp_path, (line_of("gots-diesel", key), f"{key} = {value}"))


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("bore_mm", "-88.0", ["geometry.bore_mm", "допустимо"]),
        ("bore_mm", "0", ["geometry.bore_mm", "допустимо"]),
        ("bore_mm", '"88 мм"', ["geometry.bore_mm"]),
        ("bore_mm", "nan", ["geometry.bore_mm"]),
        ("bore_mm", "inf", ["geometry.bore_mm"]),
        ("rod_length_mm", "40.0", ["geometry"]),
        ("firing_offsets_deg", "[0, 240]", ["firing_offsets_deg"]),
        ("firing_offsets_deg", "[0, 480, 240]", ["firing_offsets_deg", "240", "120"]),
        ("throw_angles_deg", "[0, 90, 240]", ["throw_angles_deg"]),
        ("max_pressure_mpa", "1.0", ["gas.max_pressure_mpa"]),
        ("main_lengths_mm", "[32, 32]", ["main_lengths_mm"]),
        ("step_deg", "7", ["calculation.step_deg"]),
        ("cylinders", "0", ["engine.cylinders"]),
    ],
)
def test_a_bad_value_is_refused_with_its_key(
    tmp_path: Path, key: str, value: str, words: list[str]
) -> None:
    path = with_key(tmp_path, key, value)
    out = tmp_path / "out"
    lines = refused(kshm("build", path, "-o", out))
    assert all(any(word in line for line in lines) for word in words), lines
    assert not out.exists()


@pytest.mark.parametrize(
    ("content", "word"),
    [
        (b"", "пуст"),
        (b"[engine", "обрывается"),
        (bytes(range(256)) * 20, ""),
        (b"\xff\xfe[\x00e\x00", ""),
        (b"[engine]\ncylinders = 3\n", "geometry"),
    ],
)
def test_a_file_that_is_no_input_is_refused(tmp_path: Path, content: bytes, word: str) -> None:
    path = tmp_path / "engine.toml"
    path.write_bytes(content)
    lines = refused(kshm("build", path, "-o", tmp_path / "out"))
    assert word in " ".join(lines)
    assert not (tmp_path / "out").exists()


def test_a_misspelt_key_is_refused_with_the_likely_one(tmp_path: Path) -> None:
    path = edited(tmp_path, ("bore_mm", "boer_mm"))
    lines = refused(kshm("check", path))
    assert any("boer_mm" in line and "bore_mm" in line for line in lines)


def test_all_errors_are_told_at_once(tmp_path: Path) -> None:
    path = edited(
        tmp_path,
        (line_of("gots-diesel", "bore_mm"), "bore_mm = -1"),
        (line_of("gots-diesel", "speed_rpm"), "speed_rpm = 0"),
    )
    lines = refused(kshm("check", path))
    assert any("bore_mm" in line for line in lines)
    assert any("speed_rpm" in line for line in lines)


def test_r_l_and_lambda_that_disagree(tmp_path: Path) -> None:
    bore = line_of("gots-diesel", "bore_mm")
    path = edited(tmp_path, (bore, bore + "\nlambda = 0.25"))
    assert any("lambda" in line for line in refused(kshm("check", path)))


def test_unusual_lambda_is_a_warning_and_exit_code_1(tmp_path: Path) -> None:
    path = with_key(tmp_path, "rod_length_mm", "100.0")
    done = kshm("check", path)
    assert done.returncode == 1
    assert "Внимание" in done.stderr


def test_a_missing_file_and_an_unknown_command() -> None:
    assert len(refused(kshm("build", "no-such.toml"))) == 1
    assert len(refused(kshm("bild", "x.toml"))) == 1
    assert len(refused(kshm("build"))) == 1
    assert len(refused(kshm("build", "x.toml", "--colour"))) == 1


def test_old_files_survive_a_failed_build(tmp_path: Path) -> None:
    out, before = tmp_path / "out", coarse_book()
    out.mkdir()
    book = out / "gots-diesel.xlsx"
    book.write_bytes(before)
    bad = with_key(tmp_path, "bore_mm", "-1")
    bad.rename(tmp_path / "gots-diesel.toml")
    refused(kshm("build", tmp_path / "gots-diesel.toml", "-o", out))
    assert book.read_bytes() == before
    assert [path.name for path in out.iterdir()] == ["gots-diesel.xlsx"]


def test_an_output_place_that_cannot_be_written(tmp_path: Path) -> None:
    blocker = tmp_path / "file"
    blocker.write_text("x")
    lines = refused(kshm("build", SAMPLES / "gots-diesel.toml", "-o", blocker, "--only", "xlsx"))
    assert "file" in lines[0]
    assert blocker.read_text() == "x"


def test_build_does_not_write_over_the_edited_book(tmp_path: Path) -> None:
    book = tmp_path / "gots-diesel.xlsx"
    book.write_bytes(coarse_book())
    lines = refused(kshm("build", book, "-o", tmp_path))
    assert "-o" in lines[0]
    assert book.read_bytes() == coarse_book()


@pytest.mark.parametrize("text", ["a/b <script>alert(1)</script> =1+1 &amp;", "=1+1"])
def test_a_name_with_markup_or_like_a_formula_stays_text(text: str, tmp_path: Path) -> None:
    path = edited(tmp_path, COARSE, (line_of("gots-diesel", "name"), f'name = "{text}"'))
    done = kshm("build", path, "-o", tmp_path / "out", "--only", "xlsx")
    assert done.returncode == 0, done.stderr
    book = load_workbook(tmp_path / "out" / "engine.xlsx", read_only=True)
    cells = [c for sheet in book for row in sheet.iter_rows() for c in row if c.value == text]
    assert "Содержание" in {cell.parent.title for cell in cells}
    assert {cell.data_type for cell in cells} == {"s"}


def test_solve_writes_csv_in_the_golden_shape(tmp_path: Path) -> None:
    done = kshm(
        "solve", SAMPLES / "gots-diesel.toml", "--csv", tmp_path, "--json", tmp_path / "a.json"
    )
    assert done.returncode == 0, done.stderr
    golden = ROOT / "reports" / "studies" / "data"
    for table in ("P3_1", "P3_2", "P4_1", "P4_2", "P4_3", "P4_4", "P4_5", "table_1", "table_2",
                  "table_3", "table_5", "table_6", "table_7", "table_8", "table_14"):  # fmt: skip
        ours = (tmp_path / f"{table}.csv").read_text(encoding="utf-8").splitlines()
        theirs = (golden / f"{table}.csv").read_text(encoding="utf-8").splitlines()
        assert ours[0] == theirs[0], table
    with (tmp_path / "P4_1.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["phi_deg"] for row in rows][:2] == ["0", "10"]
    assert len(rows[1]["Pj_MPa"]) > 10
    data = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))
    assert set(data) == {"engine", "summary", "tables"}
    columns = data["tables"]["P4_1"]["columns"]
    assert columns[0]["key"] == "phi_deg"
    assert set(columns[0]) == {"key", "symbol", "unit", "title"}
    assert len(data["tables"]["P4_1"]["rows"]) == 73


def test_solve_writes_a_degree_beside_its_number() -> None:
    said = kshm("solve", SAMPLES / "gots-diesel.toml").stdout
    assert "°" in said and " °" not in said


def test_solve_json_to_stdout_is_json_alone() -> None:
    done = kshm("solve", SAMPLES / "gots-diesel.toml", "--json", "-")
    assert done.returncode == 0
    json.load(io.StringIO(done.stdout))


def test_new_gives_an_input_that_check_accepts(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    assert kshm("new", "-o", path).returncode == 0
    assert kshm("check", path).returncode in (0, 1)
    assert len(refused(kshm("new", "-o", path))) == 1
    for sample in SAMPLES.glob("*.toml"):
        done = kshm("new", "--sample", sample.stem)
        assert done.returncode == 0
        assert "#" in done.stdout


def test_check_json(tmp_path: Path) -> None:
    good = json.loads(kshm("check", SAMPLES / "gots-diesel.toml", "--json").stdout)
    assert good == {"ok": True, "errors": [], "warnings": []}
    bad = json.loads(kshm("check", with_key(tmp_path, "bore_mm", "-1"), "--json").stdout)
    assert not bad["ok"]
    assert "bore_mm" in bad["errors"][0]["where"]


def test_help_is_russian() -> None:
    done = as_process("--help")
    assert done.returncode == 0
    assert "Использование:" in done.stdout
    for word in ("Usage", "Options", "Commands", "Show this"):
        assert word not in done.stdout + kshm("build", "--help").stdout


def test_the_first_command_of_the_readme_ends_well(tmp_path: Path) -> None:
    done = kshm("build", "samples/gots-diesel.toml", "-o", tmp_path,
                "--only", "xlsx", "--only", "html")  # fmt: skip
    assert done.returncode == 0
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [".html", ".xlsx"]
    assert done.stderr == ""  # what the input accepts stands in the book


def test_a_failed_check_is_told_and_ends_with_one(tmp_path: Path) -> None:
    source = edited(
        tmp_path, ("[[checks.accepted]]", ""), ('what = "power"', ""), ("reason =", "#")
    )
    done = kshm("build", source, "-o", tmp_path, "--only", "xlsx")
    assert done.returncode == 1
    (line,) = done.stderr.splitlines()
    assert line.startswith("Внимание: не выполнена проверка «Средняя тангенциальная сила")
    assert (tmp_path / "engine.xlsx").is_file()
    done = kshm("check", source)
    assert done.returncode == 1
    assert done.stdout.count("Внимание: ") == 1 and "indicated_power_kw" in done.stdout


def test_remarks_stand_in_the_book(tmp_path: Path) -> None:
    import openpyxl

    source = with_key(tmp_path, "mechanical_efficiency", "1.0")
    assert kshm("build", source, "-o", tmp_path, "--only", "xlsx").returncode == 1
    sheet = openpyxl.load_workbook(tmp_path / "engine.xlsx", read_only=True)["Проверки"]
    texts = [str(cell.value) for row in sheet.iter_rows() for cell in row if cell.value]
    assert any(t.startswith("Внимание: engine.toml: regime.mechanical_efficiency") for t in texts)
    assert any(t.startswith("в учебнике мощность взята") for t in texts)


def test_help_is_whole_and_russian_to_its_last_word() -> None:
    text = " ".join(kshm("--help").stdout.split())
    assert "..." not in text.replace("[АРГУМЕНТЫ]...", "")
    assert "по изменённой книге" in text
    page = kshm("serve", "--help").stdout
    assert "от 1 до 65535" in page
    for word in ("RANGE", "DIR", "URL", "<="):
        assert word not in page


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("chek a.toml", "нет команды chek; возможно, check; справка: kshm --help"),
        ("build --onyl xlsx", "нет ключа --onyl; возможно, --only; справка: kshm build --help"),
        ("xyz", "нет команды xyz; справка: kshm --help"),
        (
            "grade issued submitted --decide 5 балл",
            "ключу --decide нужно значений: 4; --decide КТО ЧТО БАЛЛЫ ПРИМЕЧАНИЕ; "
            "справка: kshm grade --help",
        ),
    ],
)
def test_a_slip_of_the_keys_is_told_with_what_was_meant(words: str, told: str) -> None:
    assert refused(kshm(*words.split())) == [f"kshm: {told}"]


def test_a_folder_of_the_page_that_is_a_file_is_told(tmp_path: Path) -> None:
    path = tmp_path / "engine.toml"
    path.touch()
    (line,) = refused(kshm("serve", "--data", path))
    assert line.startswith(f"{path}: не удаётся записать")
    assert "--secret" not in line
