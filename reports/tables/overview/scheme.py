"""Scheme of the engine in the workbook: throws, rows of cylinders, order of the strokes."""

from __future__ import annotations

from collections.abc import Iterable

from reports.spec.blocks import TURN, Grid, GridRow
from reports.spec.charts import ChartSpec, Series
from reports.spec.listing import grid_row
from reports.spec.parts import Part, Scope
from reports.spec.shape import FIRING, Shape

SHEET = "Схема"
_REACH = "0.95"  # rows of cylinders reach nearly to the edge of the drawing
_CRANK = "0.5"
_SOURCE = "исходные данные"


def scheme(scope: Scope) -> Part:
    """Cylinders with their places and firing order, throws with the points of the drawing."""
    return Part((_cylinders(scope.shape), _throws(scope.shape)), (_drawing(),))


def _lean(shape: Shape) -> str:
    """Half of the angle between the rows: the drawing stands upright."""
    return "crankshaft_bank_angle_deg/2" if shape.banks else "0"


def _cylinders(shape: Shape) -> Grid:
    numbers = range(1, shape.cylinders + 1)

    def row(of: str, texts: Iterable[str], every: str = TURN) -> GridRow:
        return grid_row(of, texts, _SOURCE, every=every)

    def axis(i: int) -> str:
        return f"rad({shape.axis(i)} - {_lean(shape)})"

    return Grid(
        "scheme",
        "Цилиндры: колено, ось ряда, начало рабочего хода, место в порядке работы",
        SHEET,
        tuple(f"цилиндр {i}" for i in numbers),
        (
            row("cyl_throw", (str(shape.throw_of(i)) for i in numbers)),
            row("cyl_axis", map(shape.axis, numbers)),
            row("cyl_theta", (f"firing_offset_{i}_deg" for i in numbers), f"{shape.period}"),
            row("cyl_rank", (f"rank(cyl_theta{i}, {FIRING})" for i in numbers)),
            row("cyl_x", (f"{_REACH}*sin({axis(i)})" for i in numbers)),
            row("cyl_y", (f"{_REACH}*cos({axis(i)})" for i in numbers)),
        ),
        note=(
            "Вид с носка вала, кривошип первого колена стоит вдоль оси первого цилиндра. "
            "Нумерация: левый ряд от носка, затем правый."
        ),
    )


def _throws(shape: Shape) -> Grid:
    """Broken lines through the shaft: rows of cylinders and throws, one point a column."""
    throws = range(1, shape.throws + 1)
    angles = [f"rad(throw_angle_{t}_deg - {_lean(shape)})" for t in throws]
    rows = []
    for of, turn in (("throw_line_x", "sin"), ("throw_line_y", "cos")):
        texts = [text for a in angles for text in ("0", f"{_CRANK}*{turn}({a})")]
        rows.append((of, [*texts, "0"]))
    ends = ["1", str(shape.cylinders)] if shape.banks else ["1"]
    for of, key in (("bank_line_x", "cyl_x"), ("bank_line_y", "cyl_y")):
        rows.append((of, [text for n in ends for text in ("0", f"{key}{n}")]))
    width = max(len(texts) for _, texts in rows)
    labels = [label for t in throws for label in ("вал", f"колено {t}")]
    labels += ["вал"] * (width - len(labels))
    return Grid(
        "scheme_lines",
        "Точки схемы: колена и оси рядов",
        SHEET,
        tuple(labels),
        tuple(
            grid_row(of, [*texts, *[None] * (width - len(texts))], _SOURCE) for of, texts in rows
        ),
    )


def _drawing() -> ChartSpec:
    """The drawing of the engine from the nose."""
    at = "scheme_lines."
    curves = (
        Series(f"{at}bank_line_x", f"{at}bank_line_y", "оси рядов"),
        Series(f"{at}throw_line_x", f"{at}throw_line_y", "колена"),
    )
    title = "Схема двигателя с носка вала: колена и оси рядов цилиндров"
    return ChartSpec("scheme", SHEET, title, "scheme", curves)
