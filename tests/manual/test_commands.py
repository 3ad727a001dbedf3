"""Every command of the README and of the manual, run as a reader would run it.

The commands share a folder, in the order of the pages; what was run once is not run
again.  ``./run`` is a stand-in that calls the same program with this interpreter:
making an environment is tested with the script itself.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from reports.grading.issuing.issue import assignment_for
from reports.grading.issuing.register import load_register
from reports.inputs.fields import iter_fields
from reports.inputs.load import load_toml
from reports.inputs.schema import LINE
from reports.workbook.read import load_workbook_input
from tests.cover import ALL
from tests.grading.fill import filled_book
from tests.manual.pages import DOCS, PAGES, READMES, ROOT, blocks, commands
from tests.referee.changes import Change, type_into

# What a test cannot run, and why.
LEFT_OUT = {
    "./run test": "the command that runs this test",
    "./run serve": "it does not end by itself",
}
CHAINS = {
    "class": re.compile(r"^./run (issue|grade)\b"),
    "project": re.compile(r"my-engine|blank|own\.toml"),
    "others": re.compile(r""),
}
_RUN = """#!/bin/sh
if [ "$1" = docs ]; then
    shift
    exec "{python}" -m tools.manual "{folder}/docs" "$@"
fi
exec "{python}" -m reports "$@"
"""


# The pages build one sample after another by the same words, and the copy of a sample: the copy
# is built, of the samples the file must be there.  That every sample makes its files is tested
# where they are made.
SAME = re.compile(r"^./run build (samples/[\w-]+\.toml) -o out$")
# Without --all what a command makes is smaller: that it is whole is tested where it is made.
# What renews the checkout itself; the pages with a folder for the site are run.
SPARED = ("./run renew", *(() if ALL else ("./run docs",)))
LIGHTER = {} if ALL else {"./run validate -o validation": " --only html"}
MOST = 3  # students of a class
EDITED = {"masses_reciprocating_kg": 1.9, "report_detail": "short"}
COPY = "my-engine.toml", "samples/gots-diesel.toml"


def chain_of(command: str) -> str:
    return next(name for name, pattern in CHAINS.items() if pattern.search(command))


def all_commands() -> list[str]:
    order = (*READMES, DOCS / "first-project.md", DOCS / "grading.md", *PAGES)
    item = dict.fromkeys(command for page in order for command in commands(page))
    assert f"./run build {COPY[0]} -o out" in item
    left_out = {*LEFT_OUT, *SPARED}
    return [command for command in item if command not in left_out and not SAME.match(command)]


def put(path: Path, old: str, new: str) -> None:
    """Other words in a file that has them."""
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def smaller_class(folder: Path) -> None:
    """A coarse grid and fewer students."""
    put(folder / "base.toml", "step_deg = 10", "step_deg = 30")
    lines = (folder / "group.csv").read_text(encoding="utf-8").splitlines(keepends=True)
    put(folder / "group.csv", "".join(lines[MOST + 1 :]), "")


def submitted(folder: Path) -> None:
    """Two students' books, filled in and handed in."""
    target = folder / "submitted"
    target.mkdir()
    register = load_register(folder / "issued")
    for book in register.books[:2]:
        handout = (folder / "issued" / book.folder / book.file).read_bytes()
        filled = filled_book(handout, assignment_for(book, register.rubric), charts=True)
        (target / book.file).write_bytes(filled)


def copied(folder: Path) -> None:
    """The copy of a sample is the sample, but for the year of the report and the schema's line."""
    copy, given = ((folder / name).read_text(encoding="utf-8") for name in COPY)
    first, _, rest = copy.partition("\n")
    assert first == f"#{LINE}" and re.sub(r"year = \d+", "year = 2006", rest) == given
    if not ALL:
        put(folder / COPY[0], "[report]\n", '[report]\nchapters = ["kinematics", "checks"]\n')


def edited(folder: Path) -> None:
    """The workbook as a person edits it: a lighter piston, a short report."""
    book, data = folder / "out" / "my-engine.xlsx", load_toml(folder / COPY[0]).model
    fields = {field.name: field for field in iter_fields(data)}
    changes = [Change(fields[name], value) for name, value in EDITED.items()]
    book.write_bytes(type_into(book.read_bytes(), data, changes))


@pytest.mark.skipif(sys.platform == "win32", reason="the blocks are of a POSIX shell")
@pytest.mark.parametrize("chain", CHAINS)
def test_commands(tmp_path, chain):
    shutil.copytree(ROOT / "samples", tmp_path / "samples")
    shutil.copytree(DOCS, tmp_path / "docs")
    (tmp_path / "templates").symlink_to(ROOT / "templates")  # pages link to it
    for page in (*READMES, ROOT / "CONTRIBUTING.md", ROOT / "CITATION.cff"):
        shutil.copy2(page, tmp_path)
    run = tmp_path / "run"
    run.write_text(_RUN.format(python=sys.executable, folder=tmp_path))
    run.chmod(0o755)
    env = {**os.environ, "PYTHONPATH": str(ROOT), "HOME": str(tmp_path / "home")}
    env.pop("XDG_CONFIG_HOME", None)
    chosen = [command for command in all_commands() if chain_of(command) == chain]
    assert chosen
    if not ALL:
        smaller_class(tmp_path / "samples" / "class")
    for command in chosen:
        if command.startswith("./run grade") and not (tmp_path / "submitted").exists():
            submitted(tmp_path)
        if command == "./run build out/my-engine.xlsx -o out2":
            edited(tmp_path)
        done = subprocess.run(
            ["bash", "-c", command + LIGHTER.get(command, "")],
            check=False,
            cwd=tmp_path,
            env=env,
            capture_output=True,
            text=True,
        )
        # 1 says that something needs a person's eye: some students handed nothing in.
        allowed = (0, 1) if command.startswith("./run grade") else (0,)
        assert done.returncode in allowed, f"{command}\n{done.stdout}{done.stderr}"
        assert "Traceback" not in done.stderr, command
        if " --sample gots-diesel -o my-engine.toml" in command:
            copied(tmp_path)
    for name in EXPECTED[chain]:
        assert (tmp_path / name).exists(), name
    if chain == "project":
        built = load_workbook_input(tmp_path / "out2" / "my-engine.xlsx").model
        collected = {field.name: field.value for field in iter_fields(built)}
        assert {name: collected[name] for name in EDITED} == EDITED


EXPECTED = {
    "class": ("issued/register.json", "graded/gradebook.xlsx", "graded/moodle.csv"),
    "project": (
        "own/own.xlsx",
        "own/compare.xlsx",
        "out/my-engine.xlsx",
        "out/my-engine.pdf",
        "out2/my-engine.pdf",
        "results.json",
    ),
    "others": (
        "out/docs/index.html",
        "validation/validation.pdf" if ALL else "validation/validation.html",
        "speed.xlsx",
        "out/sweep.xlsx",
    ),
}


def test_the_samples_of_the_pages_are_there():
    named = [
        name
        for page in PAGES
        for name in re.findall(r"samples/[\w/-]+\.\w+", page.read_text("utf-8"))
    ]
    assert len(set(named)) > 5
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_what_is_left_out_is_still_written_somewhere():
    written = {command for page in PAGES for command in commands(page)}
    texts = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    for command in LEFT_OUT:
        assert command in written or command in texts


def test_the_message_shown_is_the_message_given(tmp_path):
    text = (ROOT / "samples" / "gots-diesel.toml").read_text(encoding="utf-8")
    assert "\nbore_mm = 88.0" in text
    wrong = text.replace("\nbore_mm = 88.0", "\nbore_mm = -88.0")
    (tmp_path / "my-engine.toml").write_text(wrong, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "reports", "check", "my-engine.toml"],
        check=False,
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
    )
    (shown,) = blocks(DOCS / "first-project.md", "text")
    assert done.stderr == shown
    assert done.returncode == 2


def test_an_own_engine_takes_the_lines_and_commands_that_the_page_says(tmp_path, monkeypatch):
    """One line of a made file is edited; the file passes without a warning."""
    page = DOCS / "first-project.md"
    own = [command for command in commands(page) if "own.toml" in command]
    shown = own[: next(i for i, command in enumerate(own) if "--from" in command)]
    assert len(shown) == 4
    assert "Команд четыре, строк правки одна" in " ".join(page.read_text("utf-8").split())
    monkeypatch.chdir(tmp_path)
    program = f'"{sys.executable}" -m reports'
    env = {**os.environ, "PYTHONPATH": str(ROOT)}
    texts = []
    for command in shown:
        if "build" in command:
            continue
        line = command.replace("./run", program)
        done = subprocess.run(["bash", "-c", line], check=False, env=env, capture_output=True)
        assert done.returncode == 0, (command, done.stderr)
        said = done.stderr.decode()
        assert not said or said.startswith("Дальше: kshm "), command
        texts.append((tmp_path / "own.toml").read_text("utf-8").splitlines())
    first, last = texts[0], texts[-1]
    assert len(first) == len(last)
    assert sum(a != b for a, b in zip(first, last, strict=True)) == 1
