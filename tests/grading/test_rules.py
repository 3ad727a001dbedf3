"""Each judging rule decides some work alone: taken away, the work gets something else."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import pytest
from openpyxl import Workbook

from reports.grading.issuing.register import Register
from reports.grading.issuing.rubric import Formulas
from reports.grading.judging import response, verdicts
from reports.grading.judging.dependencies import GROUND_RULES
from reports.grading.judging.marking import Marker
from reports.grading.judging.response import RESPONSE_RULES
from reports.grading.judging.verdicts import CELL_RULES, ITEM_RULES
from reports.grading.reading.submissions import Submission
from reports.model.evaluation import Values, evaluate_model
from reports.workbook.layout import Layout
from tests.cover import sparse
from tests.grading import classroom
from tests.grading.fill import Formula, filled_book
from tests.grading.test_verdicts import formulas

V1, S1, V = "P3_1.v1_m_s", "P3_1.s1_mm", "P3_1.v_m_s"
M, S = "P4_1.M_Nm", "P4_1.S_MPa"
NOUGHT = "P4_3_1.bTsin_MPa"  # 0 whatever the engine
Changes = dict[str, list[Formula]]
TABLES = {
    "response": (response, "RESPONSE_RULES", RESPONSE_RULES),
    "cell": (verdicts, "CELL_RULES", CELL_RULES),
    "item": (verdicts, "ITEM_RULES", ITEM_RULES),
    "ground": (verdicts, "GROUND_RULES", GROUND_RULES),
}


@pytest.fixture(autouse=True)
def _the_same_trials(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Register, "trial_seed", "1")


@lru_cache(maxsize=2)
def values(number: int = 1) -> Values:
    return evaluate_model(classroom.assignment(number).model)


def right(node: str, number: int = 1) -> list[float]:
    table, _, key = node.partition(".")
    return [float(value) for value in values(number).columns[table][key]]


def each(node: str, text: str) -> Changes:
    """A formula for each cell: ``@`` the book's, ``{v}`` the right number, ``{r}`` the row."""
    count = len(formulas()[node])
    numbers = right(node) if "." in node else [values().scalars[node]] * count
    return {
        node: [
            text.replace("@", own[1:]).replace("{v}", repr(number)).replace("{r}", str(row))
            for row, (own, number) in enumerate(zip(formulas()[node], numbers, strict=True), 6)
        ]
    }


def some(node: str, rows: slice, cells: list[Formula]) -> Changes:
    """The book's formulas but for some rows."""
    column: list[Formula] = list(formulas()[node])
    column[rows] = cells
    return {node: column}


def of_a_friend() -> Changes:
    """A friend's numbers times an exact ratio."""
    r, omega = values(2).scalars["r_crank"], values(2).scalars["omega"]
    return {V1: [f"={v!r}*(r_crank*omega)/({r!r}*{omega!r})" for v in right(V1, 2)]}


def copied(book: Workbook, layout: Layout) -> None:
    """The sheet filled in once more, the issued one empty."""
    book.copy_worksheet(book["П3.1"]).title = "П3.1 (2)"
    for line in book["П3.1"].iter_rows(min_row=6, min_col=2):
        for cell in line:
            cell.value = None


def in_three(book: Workbook, layout: Layout) -> None:
    """A result in three parts, following an input that it does not depend on."""
    sheet, omega = book.create_sheet("Числа"), values().scalars["omega"]
    for row, part in enumerate((0.123456, 0.234567, omega - 0.358023), 1):
        sheet.cell(row, 1).value = part
    cell = layout.cells["omega"]
    text = f"=SUM(Числа!$A$1:$A$3)*geometry_bore_mm/{bore()}"
    book[cell.sheet].cell(cell.row, cell.column).value = text


def without_sheet(book: Workbook, layout: Layout) -> None:
    del book["П3.2"]


def turned() -> Changes:
    """Few digits of π in every formula."""
    return {
        node: [f.replace("RADIANS", "1/57.3*") for f in own] for node, own in formulas().items()
    }


def through_the_bore() -> Changes:
    """Right numbers for one's own bore, and for any other bore a circle."""
    forces = right("P4_1.Ps_MPa")
    return {
        "P4_1.Ps_MPa": [f"=IF(geometry_bore_mm={bore()},{v!r},F{row}*COS(J{row}))"
                        for row, v in enumerate(forces, 6)],
        "P4_1.S_MPa": [f"=D{row}/COS(J{row})" for row in range(6, 6 + len(forces))],
    }  # fmt: skip


def backwards() -> Changes:
    """A force from the moment that is typed in."""
    rows = range(6, 6 + len(right(M)))
    return {M: right(M), "P4_1.T_MPa": [f"=I{row}/F_piston/r_crank/10^6" for row in rows]}


def around() -> Changes:
    """A moment from the sum that it is a part of."""
    rows = range(6, 6 + len(right("P4_2.M1_Nm")))
    return {"P4_2.M1_Nm": [f"=E{row}-C{row}-D{row}" for row in rows]}


def bore() -> float:
    return classroom.book().drawn["geometry.bore_mm"]


@dataclass(frozen=True)
class Decided:
    """A work: item, its verdict and share of the points with the rule and without it."""

    item: str
    verdict: tuple[str, float]
    otherwise: tuple[str, float]
    changes: Callable[[], Changes] = dict
    edit: Callable[[Workbook, Layout], None] | None = None
    free: bool = False  # no formulas are demanded


WORKS = {
    ("response", "no formula"): Decided(
        V1, ("right", 1.0), ("typed", 0.96), lambda: some(V1, slice(0, 1), [0.0])),
    ("response", "no number"): Decided(
        V1, ("typed", 0.5), ("still", 0.0),
        lambda: each(V1, f"=IF(geometry_bore_mm={bore()},{{v}},1/0)")),
    ("response", "stands still"): Decided(
        "geometry.omega", ("still", 0.0), ("typed", 0.5),
        lambda: {"omega": [f"={values().scalars['omega']!r}+0*regime_speed_rpm"]}),
    ("response", "list of numbers"): Decided(
        V1, ("still", 0.0), ("unknown", 0.0),
        lambda: each(V1, f"={{v}}*omega/{values().scalars['omega']!r}")),
    ("response", "right at its own rows"): Decided(
        V1, ("unknown", 0.0), ("right", 1.0), of_a_friend),
    ("response", "reads a list"): Decided(
        "geometry.omega", ("unknown", 0.0), ("typed", 0.5), edit=in_three),
    ("response", "idle"): Decided(
        NOUGHT, ("unknown", 0.0), ("right", 1.0), lambda: each(NOUGHT, "=0*B{r}")),
    ("response", "right"): Decided(NOUGHT, ("right", 1.0), ("typed", 0.5)),
    ("response", "rounded"): Decided(S1, ("right", 1.0), ("wrong", 0.0), turned),
    ("response", "one or two rows wrong"): Decided(
        S, ("error", 0.96), ("error", 0.48), lambda: each(S, "=IF(ROW()=8,1/0,@)")),
    ("response", "coarse"): Decided(
        S1, ("wrong", 0.69), ("wrong", 0.35), lambda: each(S1, "=ROUND(@,1)")),
    ("cell", "blank"): Decided(
        V, ("empty", 0.85), ("wrong", 0.85), lambda: some(V, slice(-2, None), [None, None])),
    ("cell", "typed error"): Decided(
        V1, ("error", 0.92), ("wrong", 0.92), lambda: some(V1, slice(3, 4), ["#DIV/0!"])),
    ("cell", "wrong number"): Decided(
        V1, ("wrong", 0.0), ("typed", 0.5), lambda: {V1: [v * 1.1 for v in right(V1)]}),
    ("cell", "typed number"): Decided(
        M, ("typed", 0.94), ("right", 1.0), lambda: some(M, slice(3, 6), [*right(M)[3:6]])),
    ("cell", "error"): Decided(V1, ("error", 0.0), ("wrong", 0.0), lambda: each(V1, "=(@)/0")),
    ("cell", "wrong formula"): Decided(
        S1, ("wrong", 0.0), ("unknown", 0.0), lambda: each(S1, "=-(@)")),
    ("cell", "number in a formula"): Decided(
        S1, ("typed", 0.5), ("right", 1.0),
        lambda: each(S1, f"=47*(1-COS(RADIANS(A{{r}})))*{bore()}/geometry_bore_mm")),
    ("cell", "numbers alone"): Decided(
        V1, ("typed", 0.5), ("still", 0.0), lambda: each(V1, "={v}+0")),
    ("cell", "formula of numbers"): Decided(
        S1, ("still", 0.0), ("typed", 0.92), lambda: each(S1, "={v}+0*A{r}")),
    ("item", "not calculated"): Decided(
        "geometry.V_c", ("unknown", 0.0), ("unknown", 0.0),
        lambda: {"V_c": ['=INDIRECT("V_h")/(geometry_compression_ratio-1)']}),
    ("item", "lost"): Decided(
        "P3_2.beta_rad", ("unknown", 0.0), ("wrong", 0.0), edit=without_sheet),
    ("item", "copy of the sheet filled"): Decided(
        V1, ("unknown", 0.0), ("empty", 0.0), edit=copied),
    ("item", "blank"): Decided(
        V1, ("empty", 0.0), ("empty", 0.0), lambda: some(V1, slice(None), [None] * 13)),
    ("item", "taken for another"): Decided(
        V1, ("unknown", 0.0), ("wrong", 0.92),
        lambda: some(V1, slice(3, 4), [" =r_crank*omega"])),
    ("item", "numbers allowed"): Decided(
        V1, ("right", 1.0), ("typed", 0.5), lambda: {V1: [*right(V1)]}, free=True),
    ("item", "idle"): Decided(
        NOUGHT, ("unknown", 0.0), ("right", 1.0), lambda: each(NOUGHT, "=0*B{r}")),
    ("item", "pasted"): Decided(V1, ("unknown", 0.0), ("typed", 0.5), of_a_friend),
    # (145 + 2·18 − 2)/2 is the bore of this variant, and of no other.
    ("item", "by chance"): Decided(
        "geometry.F_piston", ("unknown", 0.0), ("typed", 0.5),
        lambda: {"F_piston": ["=PI()*((geometry_rod_length_mm+2*geometry_compression_ratio-2)"
                              "/2000)^2/4"]}),
    ("ground", "circle"): Decided(
        "P4_2.M1_Nm", ("error", 0.0), ("right", 1.0), around),
    ("ground", "circle with other input data"): Decided(
        "P4_1.S_MPa", ("unknown", 0.0), ("right", 1.0), through_the_bore),
    ("ground", "no ground"): Decided(
        V, ("groundless", 0.0), ("carried", 1.0), lambda: some(V1, slice(None), [None] * 13)),
    ("ground", "backwards"): Decided(
        "P4_1.T_MPa", ("still", 0.0), ("right", 1.0), backwards),
    ("ground", "carried"): Decided(
        V1, ("carried", 1.0), ("right", 1.0), lambda: {"omega": ["=regime_speed_rpm*PI()/60"]}),
}  # fmt: skip
# Decides where the textbook's own formula has one value by nature: see the class of one cylinder.
ELSEWHERE = {("cell", "not linked")}
# The last rule of a table decides what no other does.
LAST = {(name, rules[-1].name) for name, (_, _, rules) in TABLES.items() if name != "ground"}


def lines(work: Decided, marker: Marker) -> dict[str, dict[str, Any]]:
    data = filled_book(classroom.handout(), classroom.assignment(), work.changes(), work.edit)
    result = marker.mark(Submission("1.xlsx", Path("1.xlsx"), None, None), data)
    return {line["id"]: line for line in result["items"]}


def marker_of(work: Decided) -> Marker:
    register = classroom.register()
    if not work.free:
        return Marker(register)
    rubric = register.rubric.model_copy(update={"formulas": Formulas(required=False)})
    return Marker(replace(register, rubric=rubric))


def outcome(line: dict[str, Any]) -> tuple[str, float]:
    return line["verdict"], round(line["points"] / line["of"], 2)


@pytest.mark.parametrize(("table", "name"), sparse(WORKS))
def test_a_rule_decides_a_work_alone(
    table: str, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    work, (module, attribute, rules) = WORKS[table, name], TABLES[table]
    with_rule = lines(work, marker_of(work))[work.item]
    assert outcome(with_rule) == work.verdict
    monkeypatch.setattr(module, attribute, tuple(rule for rule in rules if rule.name != name))
    without = lines(work, marker_of(work))[work.item]
    assert outcome(without) == work.otherwise
    assert (with_rule["verdict"], with_rule["points"], with_rule["reason"]) != (
        without["verdict"], without["points"], without["reason"])  # fmt: skip


def test_every_rule_has_its_work() -> None:
    rules = {(name, rule.name) for name, (_, _, table) in TABLES.items() for rule in table}
    assert rules - LAST - ELSEWHERE == WORKS.keys()
    assert all(len({rule.name for rule in table}) == len(table) for _, _, table in TABLES.values())
