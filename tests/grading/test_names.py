"""Defined names that stand for formulas: calculated where they mean one thing, else unknown."""

from __future__ import annotations

import io

import pytest
from openpyxl import Workbook
from openpyxl.workbook.defined_name import DefinedName

from reports.recalculation.evaluate import Evaluator
from reports.recalculation.read import read_grid
from reports.shared.errors import UnknownFormula

NAMES = {
    "k": "PI()/180", "g": "Лист!$A$1*2", "cell": "Лист!$A$2", "of_cell": "cell+1",
    "nested": "k*2", "relative": "Лист!A1", "bare": "$A$1", "bomb": "+".join(["1"] * 200),
    "range": "SUM(Лист!$A$1:$A$2)", "external": "[1]Лист!$A$1", "column": "Лист!$A:$A",
}  # fmt: skip


def value(formula: str) -> float:
    book = Workbook()
    sheet = book.active
    sheet.title = "Лист"
    sheet["A1"], sheet["A2"], sheet["C3"] = 30.0, 5.0, formula
    for name, text in NAMES.items():
        book.defined_names[name] = DefinedName(name, attr_text=text)
    stream = io.BytesIO()
    book.save(stream)
    return float(Evaluator(read_grid(stream.getvalue())).values("Лист", 3, 3, 3)[0][0])


@pytest.mark.parametrize(
    ("formula", "right"),
    [
        ("=SIN(A1*k)", 0.5), ("=A1+g", 90.0), ("=A2^K", 5 ** (3.141592653589793 / 180)),
        ("=A1*of_cell", 180.0), ("=A1/range", 30 / 35), ('=LEN("k")*A1', 30.0),
        ("=ROW()*A1", 90.0), ("=ROW(A2)+COLUMN()", 5.0),
    ],
)  # fmt: skip
def test_a_name_stands_for_its_formula(formula, right):
    assert value(formula) == pytest.approx(right, rel=1e-12)


@pytest.mark.parametrize(
    "formula",
    ["=A1*nested", "=A1*relative", "=A1*bare", "=A1*bomb", "=A1*external", "=A1*column",
     "=k", "=-k*2", "=A1*Лист!k", "=SUMPRODUCT((A1:A2=ROW())*1)", "=SUM(ROW(A1:A2))",
     '=IFERROR(__xludf.DUMMYFUNCTION("ARRAYFORMULA(A1:A2)"),3)', "='[1]Лист'!A1*A1"],
)  # fmt: skip
def test_what_may_mean_another_thing_is_for_a_person(formula):
    with pytest.raises(UnknownFormula, match=r"[а-я]"):  # and why is said in Russian
        value(formula)


LOCAL = {"k": "Лист!$A$2", "two": "Лист!$A$1:$A$2", "half": "PI()/360", "gone": "#REF!",
         "moving": "Лист!A1", "number": "7", "of_name": "cell"}  # fmt: skip


def hidden(formula: str, sheet: str) -> float:
    """A formula in a book whose first sheet has names of its own beside those of the book."""
    book = Workbook()
    first = book.active
    first.title = "Лист"
    first["A1"], first["A2"] = 30.0, 5.0
    book.create_sheet("Другой")
    book[sheet]["C3"] = formula
    for name in LOCAL:
        book.defined_names[name] = DefinedName(name, attr_text="Лист!$A$1")
        first.defined_names[name] = DefinedName(name, attr_text=LOCAL[name])
    book.defined_names["double"] = DefinedName("double", attr_text="k*2")
    book.defined_names["cell"] = DefinedName("cell", attr_text="Лист!$A$2")
    stream = io.BytesIO()
    book.save(stream)
    return float(Evaluator(read_grid(stream.getvalue())).values(sheet, 3, 3, 3)[0][0])


@pytest.mark.parametrize(
    ("formula", "sheet", "right"),
    [
        ("=k", "Лист", 5), ("=K*2", "Лист", 10), ("=k", "Другой", 30), ("=Лист!k", "Другой", 5),
        ("=Лист!k+1", "Лист", 6), ("=SUM(two)", "Лист", 35), ("=SUM(two)", "Другой", 30),
        ("=A1*half", "Лист", 30 * 3.141592653589793 / 360), ("=A1*number", "Лист", 210),
        ("=Лист!A1*double", "Другой", 1800),
    ],
)  # fmt: skip
def test_a_name_of_a_sheet_hides_that_of_the_book(formula, sheet, right):
    assert hidden(formula, sheet) == pytest.approx(right, rel=1e-12)


@pytest.mark.parametrize("formula", ["=gone", "=A1*moving", "=number", "=A1*of_name", "=A1*double"])
def test_a_name_of_a_sheet_that_means_no_one_thing_is_for_a_person(formula):
    """The name of the book, which it hides, is not taken for it."""
    with pytest.raises(UnknownFormula, match="имя"):
        hidden(formula, "Лист")
