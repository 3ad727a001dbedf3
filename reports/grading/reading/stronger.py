"""Formulas outside the quick referee's whitelist: formualizer calculates the workbook instead.

What formualizer does not know either, and functions whose precedents cannot be
told from the formula, stay unknown: a person looks.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from reports.grading.reading.student import Student
from reports.recalculation.by_columns import Grid, UnknownFormula
from reports.recalculation.by_columns.grid import Run
from reports.recalculation.by_columns.syntax import Token, render

# Functions of values only: nothing volatile, nothing that builds an address or leaves the book.
_ALLOWED = """
ABS ACOS ACOSH AND ASIN ASINH ATAN ATAN2 ATANH AVERAGE AVERAGEIF CEILING CHOOSE COS COSH COUNT
COUNTA COUNTIF DEGREES EVEN EXP FACT FALSE FLOOR HLOOKUP IF IFERROR INDEX INT ISBLANK ISERROR
ISNUMBER LARGE LN LOG LOG10 LOOKUP MATCH MAX MEDIAN MIN MOD N NOT ODD OR PI POWER PRODUCT QUOTIENT
RADIANS RANK ROUND ROUNDDOWN ROUNDUP SIGN SIN SINH SMALL SQRT STDEV SUM SUMIF SUMPRODUCT SUMSQ
SUMX2MY2 SUMXMY2 TAN TANH TRUE TRUNC VLOOKUP XOR
"""
ALLOWED = frozenset(_ALLOWED.split())
MAX_FORMULAS = 60_000


def recalculate_unknown(student: Student) -> bool:
    """Let formualizer calculate what the quick referee cannot; tell whether it was asked."""
    wanted = [run for node in student.assignment.fill_nodes for run in student.runs(node)]
    unknown = False
    for run in wanted:
        try:
            with np.errstate(all="ignore"):
                student.engine.run(run)
        except (UnknownFormula, RecursionError):
            unknown = True
    if not unknown:
        return False
    needed = _with_precedents(student, wanted)
    if any(not _allowed(run) for run in needed) or sum(r.count for r in needed) > MAX_FORMULAS:
        # Only the formulas that do not lead to a forbidden one can be calculated.
        needed = [run for run in needed if _clean(student, run)]
    _calculate(student.grid, needed)
    return True


def _allowed(run: Run) -> bool:
    return run.pattern is not None and all(name in ALLOWED for name in _functions(run.pattern))


def _functions(pattern: tuple[Token, ...]) -> Iterator[str]:
    for (kind, value), (_, after) in zip(pattern, (*pattern, ("end", ""))[1:], strict=True):
        if kind == "name" and after == "(":
            yield value.upper()


def _with_precedents(student: Student, runs: list[Run]) -> list[Run]:
    found: dict[int, Run] = {}
    stack = list(runs)
    while stack:
        run = stack.pop()
        if id(run) in found:
            continue
        found[id(run)] = run
        stack += _referred(student, run)
    return list(found.values())


def _referred(student: Student, run: Run) -> list[Run]:
    try:
        areas = list(student.engine.areas(run))
    except UnknownFormula:
        return []
    runs = []
    for area in areas:
        columns = student.grid.sheets.get(area.sheet, {})
        for number in range(area.first_column, min(area.last_column, area.first_column + 500) + 1):
            if number in columns:
                runs += [
                    r
                    for r in columns[number].runs
                    if r.first <= area.last_row and r.last >= area.first_row
                ]
    return runs


def _clean(student: Student, run: Run) -> bool:
    return all(_allowed(other) for other in _with_precedents(student, [run]))


def _calculate(grid: Grid, runs: list[Run]) -> None:
    import formualizer

    engine = formualizer.Workbook()
    for title, columns in grid.sheets.items():
        engine.add_sheet(title)
        for number, column in columns.items():
            for row, value in column.constants.items():
                engine.set_value(title, row, number, value)
    for run in runs:
        assert run.pattern is not None
        for row in range(run.first, run.last + 1):
            text = render(run.pattern, row, run.column, grid.names)
            engine.set_formula(run.sheet, row, run.column, text)
    engine.evaluate_all()
    for run in runs:
        _take(run, [engine.get_value(run.sheet, row, run.column) for row in
                    range(run.first, run.last + 1)])  # fmt: skip


def _take(run: Run, values: list[Any]) -> None:
    run.values = np.full(run.count, np.nan)
    for index, value in enumerate(values):
        if isinstance(value, str):
            run.texts[run.first + index] = value
        elif isinstance(value, dict):
            kind = str(value.get("kind", ""))
            if kind.upper() in ("NAME", "NIMPL", "N/IMPL", "CANCELLED", "UNSUPPORTED"):
                run.problem, run.state = f"функция не поддерживается ({kind})", "unknown"
                return
        elif value is not None:
            run.values[index] = float(value)
    run.state = "done"
