"""What stands where on the sheet: equal cells, the title block in the last ones."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from functools import partial

from reports.document.chapters import facts
from reports.document.text.terms import Terms
from reports.drawing.primitives import Canvas
from reports.inputs.sections.sheet import USUAL, SheetSection
from reports.model.shape import pin_figure
from reports.shared.errors import InputError, Problem
from reports.sheet import diagrams, parts, schemes, stamp, tables
from reports.sheet.cell import Room

SIZES = {"A1": (841.0, 594.0), "A2": (594.0, 420.0)}
_GAP = 6.0
_LEAST = (120.0, 92.0)  # of a cell [mm]
Draw = Callable[[Canvas, Room, Terms], None]


def sheet_items(terms: Terms) -> tuple[Canvas, float, float]:
    """The whole sheet; its width and height [mm].

    Raises:
        InputError: the sheet cannot hold what was picked.
    """
    section = terms.model.input.sheet or SheetSection()
    width, height = SIZES[section.size]
    if section.orientation == "portrait":
        width, height = height, width
    wanted = blocks(terms, section)
    canvas = Canvas()
    stamp.frame(canvas, width, height)
    rooms = cells(width, height, len(wanted), section)
    for draw, room in zip(wanted, rooms, strict=False):
        draw(canvas, room, terms)
    left, low = width - stamp.MARGINS[1] - stamp.WIDTH, stamp.MARGINS[3]
    stamp.title_block(canvas, terms.model.input, left, low)
    return canvas, width, height


def blocks(terms: Terms, section: SheetSection) -> list[Draw]:
    """What was picked, in order; by default everything that the engine has."""
    known = available(terms)
    picked: tuple[str, ...] = section.diagrams or tuple(name for name in USUAL if name in known)
    missing = [name for name in picked if name not in known]
    if missing:
        what = f"у этого двигателя нет: {', '.join(missing)}"
        raise InputError(Problem("sheet.diagrams", what, "уберите из списка"))
    return [known[name] for name in picked]


def available(terms: Terms) -> dict[str, Draw]:
    """What can be drawn for an engine, by name."""
    pin = facts.worst_pin(terms)
    main = round(terms.value("worst_main_load"))
    folded = partial(diagrams.curves, closed=True)
    curves = partial(diagrams.curves, closed=False)
    charts: dict[str, tuple[str, Callable[..., None]]] = {
        "pv": ("pv", folded), "p_phi": ("p_phi", curves), "forces": ("fig46", curves),
        "side": ("fig47", curves), "crank": ("fig48", curves), "torque": ("fig49", curves),
        "pin_polar": (pin_figure("fig50", pin), diagrams.path),
        "pin_load": (pin_figure("fig51", pin), curves),
        "pin_wear": (pin_figure("fig52", pin), diagrams.wear),
        "main_polar": (f"fig53_{main}", diagrams.path),
        "main_load": (f"fig55_{main}", curves), "main_wear": (f"fig54_{main}", diagrams.wear),
    }  # fmt: skip
    known: dict[str, Draw] = {
        name: partial(draw, chart=terms.model.charts_by_id[key])
        for name, (key, draw) in charts.items()
        if key in terms.model.charts_by_id
    }
    return known | {"shaft": schemes.shaft, "balance": schemes.balance,
                    "running": tables.running, "results": tables.results,
                    "throw": parts.throw, "mechanism": parts.mechanism}  # fmt: skip


def cells(width: float, height: float, count: int, section: SheetSection) -> list[Room]:
    """Equal cells for so many blocks, row by row from the top; none under the title block.

    What was not picked one by one gives way where the sheet is too small for all of it.

    Raises:
        InputError: the cells would be too small.
    """
    grids = [g for g in _grids(width, height) if g]
    most = max(map(len, grids), default=0)
    if count > most and section.diagrams:
        way = "альбомный" if width > height else "книжный"
        what = f"на лист {section.size} ({way}) помещается {most}, выбрано {count}"
        hint = "уберите лишнее" + ("" if section.size == "A1" else ' или выберите size = "A1"')
        raise InputError(Problem("sheet.diagrams", what, hint))
    fitting = [g for g in grids if len(g) >= min(count, most)]
    return max(fitting, key=lambda g: min(g[0].width / 1.4, g[0].height))


def _grids(width: float, height: float) -> Iterator[list[Room]]:
    """Free cells of every division of the sheet into columns and rows."""
    left, right, top, bottom = stamp.MARGINS
    wide, tall = width - left - right - _GAP, height - top - bottom - _GAP
    for columns, rows in itertools.product(range(1, 9), repeat=2):
        across, down = wide / columns, tall / rows
        if across < _LEAST[0] or down < _LEAST[1]:
            continue
        taken = math.ceil((stamp.WIDTH + _GAP) / across), math.ceil((stamp.HEIGHT + _GAP) / down)
        yield [
            Room(left + _GAP + c * across, height - top - (r + 1) * down, across - _GAP,
                 down - _GAP)
            for r in range(rows) for c in range(columns)
            if not (c >= columns - taken[0] and r >= rows - taken[1])
        ]  # fmt: skip
