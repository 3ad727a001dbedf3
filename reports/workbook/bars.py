"""Bars in cells: how much of its limit a value takes, from green to red."""

from __future__ import annotations

from collections.abc import Iterator

from openpyxl.formatting.rule import ColorScaleRule, DataBarRule, Rule
from openpyxl.worksheet.worksheet import Worksheet

from reports.formula.parse import names
from reports.model.blocks import Held, Scalar, ScalarTable
from reports.workbook.layout import Layout

_GREEN, _AMBER, _RED, _BAR = "C6EFCE", "FFEB9C", "FFC7CE", "7F9DB9"
_NEAR = 0.8  # of the limit: amber


def draw_bars(sheet: Worksheet, block: ScalarTable, layout: Layout) -> None:
    """Give every value of a list that is held to limits a bar and a colour by its limit."""
    if block.held not in (Held.USUAL, Held.ALLOWED):
        return
    for value, verdict in block.pairs:
        at = layout.cells[value.key].coordinate
        for rule in _rules(value, verdict, layout):
            sheet.conditional_formatting.add(at, rule)


def _rules(value: Scalar, verdict: Scalar, layout: Layout) -> Iterator[Rule]:
    if verdict.usual is not None:
        most = max(map(abs, verdict.usual))
        if verdict.usual[0] < 0:
            yield _scale((-most, _RED), (0.0, _GREEN), (most, _RED))
        else:
            yield _scale((0.0, _GREEN), (_NEAR * most, _AMBER), (most, _RED))
            yield DataBarRule("num", 0, "num", most, color=_BAR)
        return
    (limit,) = names(verdict.expr) - {value.key}
    name = layout.name_of(limit)
    if f"{value.key} >= " in verdict.expr:  # twice the least safety is a full bar
        ends = ((f"{name}", _RED), (f"{name}/{_NEAR}", _AMBER), (f"2*{name}", _GREEN))
        yield _scale(*ends)
        yield DataBarRule("num", 0, "formula", f"2*{name}", color=_BAR)
    else:
        yield _scale(("0", _GREEN), (f"{_NEAR}*{name}", _AMBER), (f"{name}", _RED))
        yield DataBarRule("num", 0, "formula", name, color=_BAR)


def _scale(*points: tuple[float | str, str]) -> Rule:
    """Return a scale of colours through three values or formulas."""
    kind = "formula" if isinstance(points[-1][0], str) else "num"
    (start, first), (middle, second), (end, third) = points
    return ColorScaleRule(kind, start, first, kind, middle, second, kind, end, third)
