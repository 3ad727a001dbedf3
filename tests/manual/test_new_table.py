"""The example of ``docs/new-table.md``: run, recalculated, issued and graded."""

from __future__ import annotations

import io
import shutil
import tomllib
from pathlib import Path

import openpyxl
import pytest

from reports.grading.issuing.issue import assignment_for
from reports.grading.judging.marking import Marker
from reports.grading.reading.submissions import Submission
from reports.model import book_text
from reports.model.contents import contents_of
from reports.shared.resources import templates_dir
from reports.workbook.chapters import place_of
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
        patch.setattr(book_text, "templates_dir", lambda: templates)
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
    formulas = [cell.value for row in sheet.iter_rows() for cell in row if cell.data_type == "f"]
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
