"""One judgement as a line of the feedback: plain data for pages and tables."""

from __future__ import annotations

import math
from dataclasses import asdict
from itertools import groupby
from operator import itemgetter
from typing import Any

import numpy as np

from reports.grading.issuing.assignment import Assignment, Item
from reports.grading.judging.causes import Causes
from reports.grading.judging.judgement import (
    BROKEN,
    CARRIED,
    RIGHT,
    STILL,
    TYPED,
    WRONG,
    Judgement,
)
from reports.grading.judging.marks import fingerprint
from reports.grading.reading.addresses import address, range_text, stretches
from reports.grading.reading.placement import Place
from reports.grading.reading.student import Student

SHOWN_ROWS = 12  # wrong cells shown in the feedback of an item


def feedback_line(
    student: Student, judgement: Judgement, causes: Causes, assignment: Assignment
) -> dict[str, Any]:
    """One item of the feedback."""
    item = judgement.item
    worth = assignment.points[item.id]
    share = judgement.paid
    if judgement.verdict == CARRIED:
        share *= assignment.rubric.credit.carried
    heading, short = _headings(item, assignment)
    cause = causes.find(judgement) if judgement.verdict == WRONG else ""
    line: dict[str, Any] = {
        "id": item.id,
        "block": item.block,
        "table": short if item.block in assignment.model.tables else "",
        "heading": heading,
        "label": f"{short} {item.symbol}",
        "title": item.title,
        "symbol": item.symbol,
        "unit": item.quantity.unit_label,
        "source": item.source,
        "digits": asdict(item.quantity.digits),
        "verdict": judgement.verdict,
        "points": round(worth * share, 6),
        "of": round(worth, 6),
        "reason": judgement.reason,
        "cause": cause,
        "origins": list(judgement.origins),
        "right_mark": fingerprint(item, judgement.expected),
        "rows": [item.labels[i] for i in judgement.rows],
        "where": _where(student, judgement),
        "typed": [item.labels[i] for i in judgement.typed] if judgement.verdict != RIGHT else [],
    }
    if judgement.verdict in (WRONG, CARRIED, TYPED, STILL, BROKEN):
        line["cells"] = _cells(student, judgement)
        line["mark"] = fingerprint(item, judgement.values)
        if item.is_column:
            line["chart"] = {
                "x": [float(label) for label in item.labels],
                "own": _plain(judgement.values),
                "right": _plain(judgement.expected),
            }
    return line


def _headings(item: Item, assignment: Assignment) -> tuple[str, str]:
    """The table or list of an item as a person calls it, in full and in short."""
    table = assignment.model.tables.get(item.block)
    if table is not None:
        return f"Таблица {table.number}", table.number
    block = next(block for block in assignment.fill if block.id == item.block)
    return f"{block.title} ({block.sheet})", block.sheet


def _cells(student: Student, judgement: Judgement) -> list[dict[str, Any]]:
    item = judgement.item
    places = _cells_of(student, item)
    cells = []
    for row in judgement.rows[:SHOWN_ROWS]:
        place, index = places[row]
        at = place.rows[index] if place is not None else None
        cells.append(
            {
                "row": item.labels[row],
                "cell": f"{place.sheet}!{address(at, place.column)}" if place and at else "",
                "own": _number(judgement.values[row]),
                "right": _number(judgement.expected[row]),
            }
        )
    return cells


def _where(student: Student, judgement: Judgement) -> list[str]:
    """The cells that a verdict is about, those below each other as ranges."""
    item = judgement.item
    rows = set(judgement.rows)
    found: list[tuple[tuple[str, int], int]] = []  # sheet and column, row
    for number, (place, index) in enumerate(_cells_of(student, item)):
        row = place.rows[index] if place is not None else None
        if number in rows and place is not None and row is not None:
            found.append(((place.sheet, place.column), row))
    return [
        f"{sheet}!{range_text(first, last, column)}"
        for (sheet, column), cells in groupby(found, key=itemgetter(0))
        for first, last in stretches(row for _, row in cells)
    ]


def _cells_of(student: Student, item: Item) -> list[tuple[Place | None, int]]:
    """The place of each value of an item and the value's index there."""
    return [
        (student.placement.places.get(node), i)
        for node in item.nodes
        for i in range(student.assignment.length(node))
    ]


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _plain(values: np.ndarray[Any, np.dtype[np.float64]]) -> list[float | None]:
    return [float(f"{v:.6g}") if math.isfinite(v) else None for v in values]
