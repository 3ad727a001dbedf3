"""Literal tables: formulas that tell cases apart, a friend's column, sines that were looked up."""

from __future__ import annotations

import math
from functools import lru_cache

import pytest
from openpyxl import Workbook

from reports.model.evaluation import Values, evaluate_model
from reports.workbook.layout import Layout
from tests.grading import classroom
from tests.grading.test_verdicts import formulas, graded, line

V1, J1, S1 = "P3_1.v1_m_s", "P3_1.j1_m_s2", "P3_1.s1_mm"
ANGLES = range(0, 361, 30)


@lru_cache(maxsize=1)
def friend() -> Values:
    return evaluate_model(classroom.assignment(2).model)


def ratio(node: str) -> str:
    """By what a friend's column becomes one's own."""
    r, omega = friend().scalars["r_crank"], friend().scalars["omega"]
    return {
        V1: f"*(r_crank*omega)/({r!r}*{omega!r})",
        J1: f"*(r_crank*omega^2)/({r * omega**2!r})",
        S1: f"*r_crank/{r!r}",
    }[node]


def numbers(node: str, digits: int) -> list[float]:
    return [round(float(v), digits) for v in friend().columns["P3_1"][node.partition(".")[2]]]


def on_a_sheet(node: str, values: list[float], formula: str, cell: str = "{v}"):
    """Numbers on a sheet of one's own, read row by row."""

    def edit(book: Workbook, layout: Layout) -> None:
        sheet = book.create_sheet("Числа")
        table, column = layout.columns[node]
        for row, value, angle in zip(range(6, 19), values, ANGLES, strict=True):
            sheet.cell(row, 1).value = value if cell == "{v}" else cell.replace("{v}", repr(value))
            sheet.cell(row, 2).value, sheet.cell(row, 3).value = angle, value
            book[table.sheet].cell(row, column).value = formula.replace("{r}", str(row))

    return edit


@pytest.mark.parametrize("node", [V1, J1, S1])
@pytest.mark.parametrize("form", ["typed", "six digits", "sheet", "formulas", "look-up", "choose"])
def test_ready_numbers_times_an_exact_ratio_are_for_a_person(node: str, form: str) -> None:
    values = numbers(node, 6 if form == "six digits" else 15)
    if form in ("typed", "six digits"):
        result = graded({node: [f"={v!r}{ratio(node)}" for v in values]})
    elif form == "choose":
        text = ",".join(map(repr, values))
        result = graded(
            {node: [f"=CHOOSE(A{row}/30+1,{text}){ratio(node)}" for row in range(6, 19)]}
        )
    else:
        formula = "VLOOKUP(A{r},Числа!B:C,2,0)" if form == "look-up" else "Числа!A{r}"
        cell = "={v}*1" if form == "formulas" else "{v}"
        result = graded(edit=on_a_sheet(node, values, f"={formula}{ratio(node)}", cell))
    actual = line(result, node)
    assert (actual["verdict"], actual["points"]) == ("unknown", 0)
    assert result["manual"]


@pytest.mark.parametrize("digits", [3, 4, 6])
@pytest.mark.parametrize(
    ("node", "function", "formula"),
    [
        (V1, math.sin, "{v}*r_crank*omega"), (J1, math.cos, "r_crank*omega^2*{v}"),
        (S1, math.cos, "1000*r_crank*(1-{v})"),
        (V1, lambda angle: angle, "r_crank*omega*SIN({v})"),
    ],
)  # fmt: skip
def test_sines_of_a_table_of_sines_are_honest(node, function, formula, digits) -> None:
    values = [round(function(math.radians(angle)), digits) for angle in ANGLES]
    result = graded(edit=on_a_sheet(node, values, "=" + formula.replace("{v}", "Числа!A{r}")))
    actual = line(result, node)
    if digits > 3:  # with three they do not reach the digits that the book prints
        assert (actual["verdict"], actual["points"]) == ("right", actual["of"])
    else:
        assert actual["points"] == actual["of"] or actual["verdict"] != "right"


def written(case: str) -> list[str]:
    """The column by quarters of a turn: ``@`` is the textbook's formula, ``{r}`` the row."""
    return [
        "=" + case.replace("{r}", str(row)).replace("@", text[1:])
        for row, text in enumerate(formulas()[V1], 6)
    ]


@pytest.mark.parametrize(
    ("case", "share"),
    [
        ("IF(A{r}=0,0,IF(A{r}=90,r_crank*omega,IF(A{r}=180,0,IF(A{r}=270,-r_crank*omega,"
         "IF(A{r}=360,0,@)))))", 1),
        ("IF(A{r}=0,0,IF(A{r}=90,r_crank*omega,IF(A{r}=180,0,IF(A{r}=270,-r_crank*omega,"
         "IF(A{r}=360,0,-@)))))", 0),
        ("IF(INT(A{r}/90)=0,@,IF(INT(A{r}/90)=1,-@,IF(INT(A{r}/90)=2,@,IF(INT(A{r}/90)=3,@,"
         "IF(INT(A{r}/90)=4,@,0)))))", 10 / 13 / 2),
    ],
)  # fmt: skip
def test_cases_with_formulas_in_them_are_no_list_of_numbers(case: str, share: float) -> None:
    """Of five cases one is wrong: the column was called ready numbers, and earned nothing."""
    actual = line(graded({V1: written(case)}), V1)
    assert actual["verdict"] == ("right" if share == 1 else "wrong")
    assert actual["points"] == pytest.approx(actual["of"] * share, abs=1e-5)
    assert actual["reason"] == ""
