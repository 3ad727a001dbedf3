"""Defined names that stand for formulas: calculated where they mean one thing, else unknown."""

from __future__ import annotations

import io

import pytest
from openpyxl import Workbook
from openpyxl.workbook.defined_name import DefinedName

from reports.recalculation.evaluate import Engine
from reports.recalculation.language import UnknownFormula
from reports.recalculation.read import read_grid

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
    return float(Engine(read_grid(stream.getvalue())).values("Лист", 3, 3, 3)[0][0])


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
