"""The example of ``docs/new-table.md``: run, recalculated, issued and graded; landed on a copy."""

from __future__ import annotations

import io
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import openpyxl
import pytest

from reports.grading.issuing.issue import assignment_for
from reports.grading.judging.marking import Marker
from reports.grading.reading.submissions import Submission
from reports.model import chapter_source
from reports.model.contents import contents_of
from reports.shared.resources import templates_dir
from reports.workbook.chapters import place_of
from reports.workbook.layout import FIRST_ROW
from tests.grading.classroom import issue_class
from tests.grading.fill import filled_book
from tests.manual.pages import DOCS, ROOT, blocks
from tests.referee.compare import differences_from_caches, errors_in
from tools.referees.by_formualizer import Formualizer

PAGE = DOCS / "new-table.md"
SHEET = "Опрокидывание"


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    """What the page runs, with its book among those of the house."""
    templates = tmp_path_factory.mktemp("templates")
    shutil.copytree(templates_dir() / "tables", templates / "tables")
    (written,) = blocks(PAGE, "book")
    (templates / "tables" / "tilting.book").write_text(written, encoding="utf-8")
    kept = (contents_of, place_of)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(ROOT)
        patch.setattr(chapter_source, "templates_dir", lambda: templates)
        for each in kept:
            each.cache_clear()
        names: dict[str, object] = {}
        for block in blocks(PAGE, "python"):
            exec(block, names)
        yield names
    for each in kept:
        each.cache_clear()


def test_the_sheet_has_live_formulas(example):
    book = example["book"]
    sheet = openpyxl.load_workbook(io.BytesIO(book))[SHEET]
    rows = sheet.iter_rows(min_row=FIRST_ROW)
    formulas = [cell.value for row in rows for cell in row if cell.data_type == "f"]
    assert len(formulas) == 4 * 73 - 1  # φ of the first row is a number
    (recalculated,) = Formualizer().recalculate([book])
    assert errors_in(recalculated) == []
    assert differences_from_caches(book, recalculated) == []
    (chart,) = sheet._charts
    assert len(chart.series) == 1


def test_the_report_takes_the_formula_from_the_description(example):
    assert r"N_{\mathrm{уд}}" in example["formula"]
    assert r"\cos 30^{\circ}" in example["numbers"]
    assert len(example["printed"].rows) == 25  # each third of 73 and the last


def test_the_table_is_graded_by_its_name_in_the_rubric(example, tmp_path):
    assert SHEET in example["model"].sheets
    (rubric,) = blocks(PAGE, "toml")
    assert "tilting" in tomllib.loads(rubric)["work"]["fill"]

    register = issue_class(tmp_path, 1, rubric).register
    (book,) = register.books
    handout = (tmp_path / "issued" / book.folder / book.file).read_bytes()
    assert SHEET in openpyxl.load_workbook(io.BytesIO(handout), read_only=True).sheetnames
    assignment = assignment_for(book, register.rubric)

    def verdict_of(changes):
        filled = filled_book(handout, assignment, changes)
        result = Marker(register).mark(Submission("a.xlsx", Path("a.xlsx"), None, None), filled)
        return {line["id"]: line["verdict"] for line in result["items"]}

    right = verdict_of({})
    assert right["tilting.Mopr_side_Nm"] == "right"
    assert set(right.values()) == {"right"}
    typed = verdict_of({"tilting.Mopr_side_Nm": [1.0] * 25})
    assert typed["tilting.Mopr_side_Nm"] == "wrong"
    assert typed["tilting.Mopr_gap_Nm"] == "carried"


ROOMS = "tests/tables/test_two_statements.py tests/model/test_books.py tests/model/test_language.py"


@pytest.fixture(scope="module")
def landed(tmp_path_factory):
    """A copy of the tree with the page's book in it, and nothing else."""
    copy = tmp_path_factory.mktemp("tree")
    for room in ("kshm", "reports", "templates", "samples", "tests", "tools", "docs"):
        shutil.copytree(ROOT / room, copy / room, symlinks=True)
    shutil.copy2(ROOT / "pyproject.toml", copy)
    (written,) = blocks(PAGE, "book")
    (copy / "templates" / "tables" / "tilting.book").write_text(written, encoding="utf-8")
    return copy


def run(copy: Path, *words: str) -> subprocess.CompletedProcess[str]:
    away = {"PYTHONPATH": str(copy), "PYTHONSAFEPATH": "1"}
    return subprocess.run([sys.executable, *words], cwd=copy, env=os.environ | away,
                          capture_output=True, text=True, check=False)  # fmt: skip


@pytest.mark.slow
def test_the_book_alone_lands(landed):
    """Tests of the rooms that take the books as they are stay green."""
    ended = run(landed, "-m", "pytest", "-q", "-n0", "-p", "no:cacheprovider", *ROOMS.split())
    assert ended.returncode == 0, ended.stdout[-3000:]


def test_its_numbers_are_exported(landed, tmp_path):
    sample = str(landed / "samples" / "gots-diesel.toml")
    ended = run(landed, "-m", "reports", "solve", sample, "--csv", str(tmp_path / "csv"))
    assert ended.returncode == 0, ended.stderr
    lines = (tmp_path / "csv" / "tilting.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0].split(",")[:2] == ["phi_deg", "Mopr_torque_Nm"] and len(lines) == 74
