"""Tables of the sheet: running-on torques over the angle, key results."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from reports.document.chapters import facts
from reports.document.text.numbers import of_digits
from reports.document.text.terms import Terms
from reports.drawing.lettering import width_of
from reports.drawing.primitives import TABLES, THIN, Canvas
from reports.model.shape import Shape
from reports.shared.russian import capital, fixed
from reports.sheet.cell import TEXT, Room, headed

ROW = 6.0  # mm
_PADDING = 1.0  # on each side of the words in a cell [mm]
_STEPS = (30.0, 60.0, 90.0, 120.0, 180.0)
_RESULTS = ("M_mean", "M_max", "M_min", "M_e", "p_i_calc", "N_i_calc")


def grid(canvas: Canvas, room: Room, rows: Sequence[Sequence[str]]) -> None:
    """Rows of cells from the top of a room, the first of them above a thick line.

    Columns are as wide as their longest words ask, so that all letters are of one height.
    """
    needs = [max(width_of(text, TEXT) for text in column) for column in zip(*rows, strict=True)]
    share = (room.width - 2 * _PADDING * len(needs)) / sum(needs)
    wides = [need * share + 2 * _PADDING for need in needs]
    tall = min(ROW, room.height / len(rows))
    height = min(TEXT, 0.6 * tall, TEXT * share)
    xs = [room.left + sum(wides[:n]) for n in range(len(wides) + 1)]
    low = room.high - tall * len(rows)
    canvas.box(xs[0], low, xs[-1], room.high, TABLES)
    for x in xs[1:-1]:
        canvas.line((x, low), (x, room.high), layer=TABLES)
    for number, row in enumerate(rows):
        y = room.high - tall * (number + 1)
        if number + 1 < len(rows):
            ends = (xs[0], y), (xs[-1], y)
            canvas.line(*ends, layer=THIN if number else TABLES)
        middle = y + (tall - height) / 2
        for place, text in enumerate(row):
            if place or not number:
                canvas.words((xs[place] + wides[place] / 2, middle), text, height, align=0.5)
            else:
                canvas.words((xs[place] + _PADDING, middle), text, height)


def running(canvas: Canvas, room: Room, terms: Terms) -> None:
    """Running-on torques on main journals at a step of the angle that fits the room."""
    throws = Shape.of(terms.model.input).throws
    room = headed(canvas, room, "Набегающие моменты на коренные шейки, Н·м")
    angles = np.asarray(terms.model.tables["P4_4"].rows, dtype=float)
    most = int(room.height / 4.2) - 2
    step = next(s for s in _STEPS if (angles[-1] - angles[0]) / s + 1 <= most or s == _STEPS[-1])
    kept = [n for n, a in enumerate(angles) if abs(np.remainder(a + 1e-6, step)) < 1e-3]
    columns = [terms.column(f"P4_4.Mmain{k}_Nm") for k in range(2, throws + 2)]
    rows = [["φ, °", *(f"шейка {k}" for k in range(2, throws + 2))]]
    digits = terms.quantity("P4_4.Mmain2_Nm").digits
    rows += [[fixed(angles[n], 0), *(of_digits(float(c[n]), digits) for c in columns)]
             for n in kept]  # fmt: skip
    swings = [terms.num(f"dM_main{k}") for k in range(2, throws + 2)]
    rows.append(["размах", *swings])
    grid(canvas, room, rows)


def results(canvas: Canvas, room: Room, terms: Terms) -> None:
    """What the calculation found."""
    room = headed(canvas, room, "Результаты расчёта")
    worst = facts.pin_stems(Shape.of(terms.model.input))[facts.worst_pin(terms) - 1]
    main = f"main{round(terms.value('worst_main_load'))}"
    keys = [*_RESULTS, f"R{worst}_max_kN", f"q_{worst}_mean", f"R{main}_max_kN", f"q_{main}_mean"]
    rows = [["Величина", "Значение", "Единица"]]
    rows += [
        [capital(terms.title(key)), terms.num(key), terms.unit(key) or "—"]
        for key in keys
        if terms.has(key)
    ]
    grid(canvas, room, rows)
