"""The sheet of dynamics: cells, frame and title block (form 1 of ГОСТ 2.104), PDF and DXF."""

from __future__ import annotations

import base64
import itertools
import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial

from reports.document.chapters.chapter import named_engine, worst_pin
from reports.document.page.charts import mechanism_of, throws_of
from reports.document.page.render import render_pdf
from reports.document.text.terms import Terms
from reports.draw import fonts
from reports.draw.canvas import FRAME, THIN, Canvas, Item, Words, bounds, moved
from reports.draw.fonts import HEIGHTS, fitted, larger, standard, width_of, wrapped
from reports.draw.parts import MechanismSizes, ThrowSizes, mechanism_drawing, throw_drawing
from reports.draw.writers import dxf_bytes, svg_of
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.report import USUAL, ReportSection, SheetSection
from reports.inputs.solve_input import fine_columns
from reports.model.blocks import Model
from reports.model.charts import ChartSpec
from reports.model.evaluation import Values
from reports.model.shape import pin_figure
from reports.shared.errors import InputError, Problem
from reports.shared.font_coverage import printable
from reports.shared.russian import surname
from reports.sheet import diagrams
from reports.sheet.cell import (
    CellArea,
    balance,
    counterweight,
    flywheel,
    mechanism,
    results,
    running,
    shaft,
    strength,
    throw,
)

STAMP_WIDTH, STAMP_HEIGHT = 185.0, 55.0
MARGINS = (20.0, 5.0, 5.0, 5.0)  # left, right, top, bottom of the frame
_COLUMNS = (0.0, 7.0, 17.0, 40.0, 55.0, 65.0)
_HEADS = ("Изм.", "Лист", "№ докум.", "Подп.", "Дата")
_NAME = (65.0, 135.0)
_READABLE = 2.0  # of a name; one that would be smaller leaves the surname alone
_NOTE = re.compile(r"\s*ПЗ$")
_BOX_26 = (70.0, 14.0)  # [mm]
SIZES = {"A1": (841.0, 594.0), "A2": (594.0, 420.0)}
_GAP = 6.0
_MIN_CELL_MM = (120.0, 92.0)  # of a cell [mm]
_FILLERS = ("mechanism", "main_load")
Draw = Callable[[Canvas, CellArea, Terms], None]
_LETTERS = 0.025  # greatest height of the letters of a drawing true to size, of its extent
_SMALL = 0.8  # of it, where the drawing is smaller than any letters of the standard
_PRINTED = 3.5  # mm: the height of letters on paper that the dashes of lines go with
_PAGE = """<!DOCTYPE html><html lang="ru"><head><meta charset="utf-8"><title>{title}</title>
<meta name="dcterms.created" content="{year}-01-01">
<meta name="dcterms.modified" content="{year}-01-01"><style>{fonts}
@page {{ size: {width}mm {height}mm; margin: 0 }} body {{ margin: 0 }}
img {{ display: block; width: {width}mm; height: {height}mm }}
html {{ font-family: {stack} }}</style></head>
<body><img alt="{title}" src="data:image/svg+xml;base64,{svg}"></body></html>"""


def frame(canvas: Canvas, width: float, height: float) -> None:
    """Outer edge and frame."""
    canvas.box(0, 0, width, height, THIN)
    left, right, top, bottom = MARGINS
    canvas.box(left, bottom, width - right, height - top, FRAME)


def title_block(canvas: Canvas, model: InputFile, left: float, low: float) -> None:
    """Form 1 with its lower left corner at a place."""
    report = model.report

    def line(x1: float, y1: float, x2: float, y2: float, *, thick: bool = True) -> None:
        layer = FRAME if thick else THIN
        canvas.line((left + x1, low + y1), (left + x2, low + y2), layer=layer)

    def cell(text: str, box: tuple[float, float, float, float], most: float = 2.5) -> None:
        x1, y1, x2, y2 = box
        room = x2 - x1 - 1
        for height in (h for h in reversed(HEIGHTS) if h <= most):
            lines = wrapped(text, room, height, hyphens=True)
            fits = all(width_of(words, height) <= room for words in lines)
            if fits and len(lines) * 1.7 * height <= y2 - y1:
                break
        y = (y1 + y2) / 2 + (len(lines) * 1.7 * height) / 2 - 1.4 * height
        for words in lines:
            wide = width_of(words, height)  # at last smaller than the standard allows
            size = height if wide <= room else max(0.5, height * room / wide)
            canvas.words((left + (x1 + x2) / 2, low + y), words, size, align=0.5)
            y -= 1.7 * height

    canvas.box(left, low, left + STAMP_WIDTH, low + STAMP_HEIGHT, FRAME)
    for x in (17.0, 40.0, 55.0, 65.0):
        line(x, 0, x, STAMP_HEIGHT)
    line(7, 30, 7, STAMP_HEIGHT)
    for row in range(1, 11):
        y = 5.0 * row
        line(0, y, 65, y, thick=row in (6, 7))
    for number, word in enumerate(_HEADS):
        cell(word, (_COLUMNS[number], 30, _COLUMNS[number + 1], 35))
    people = (("Разраб.", report.student), ("Пров.", report.supervisor), ("Т. контр.", ""),
              ("", ""), ("Н. контр.", report.controller),
              ("Утв.", report.approver or report.head))  # fmt: skip
    for row, (post, name) in enumerate(people):
        y = 25.0 - 5.0 * row
        cell(post, (0, y, 17, y + 5))
        small = fitted(name, 22, 2.5) < _READABLE
        cell(surname(name) if small else name, (17, y, 40, y + 5))
    line(65, 40, STAMP_WIDTH, 40)
    line(65, 15, STAMP_WIDTH, 15)
    line(135, 0, 135, 40)
    line(135, 35, STAMP_WIDTH, 35)
    line(135, 20, STAMP_WIDTH, 20)
    for x in (150.0, 167.0):
        line(x, 20, x, 40)
    line(155, 15, 155, 20)
    for x in (140.0, 145.0):
        line(x, 20, x, 35, thick=False)
    for word, x1, x2 in (("Лит.", 135, 150), ("Масса", 150, 167), ("Масштаб", 167, 185)):
        cell(word, (x1, 35, x2, 40))
    cell("Лист", (135, 15, 155, 20))
    cell("Листов 1", (155, 15, STAMP_WIDTH, 20))
    cell("У", (140, 20, 145, 35), 3.5)
    cell(designation(report), (65, 40, STAMP_WIDTH, 55), 7.0)
    title = f"Динамический расчёт двигателя{named_engine(model)}"
    cell(title, (*_NAME[:1], 15, _NAME[1], 40), 5.0)
    names = (report.institution, report.department, report.group)
    cell(", ".join(filter(None, names)), (135, 0, STAMP_WIDTH, 15), 3.5)


def designation(report: ReportSection) -> str:
    """Return sheet's own designation: that of the note with the code of diagrams, ГОСТ 2.102."""
    return _NOTE.sub(" Д", report.designation)


def corner(canvas: Canvas, report: ReportSection, width: float, height: float) -> None:
    """Box 26: the designation turned upside down in the upper left corner of the frame."""
    left, top = MARGINS[0], height - MARGINS[2]
    if width < height:  # along the upright edge where the sheet stands
        canvas.box(left, top - _BOX_26[0], left + _BOX_26[1], top, FRAME)
        middle, turn = (left + _BOX_26[1] / 2 + 2.5, top - _BOX_26[0] / 2), 90.0
    else:
        canvas.box(left, top - _BOX_26[1], left + _BOX_26[0], top, FRAME)
        middle, turn = (left + _BOX_26[0] / 2, top - _BOX_26[1] / 2 + 2.5), 180.0
    text = designation(report)
    canvas.words(middle, text, fitted(text, _BOX_26[0] - 2, 5.0), align=0.5, angle=turn)


def sheet_items(terms: Terms) -> tuple[Canvas, float, float]:
    """Return the whole sheet; its width and height [mm].

    Raises:
        InputError: the sheet cannot hold what was picked.
    """
    section = terms.model.input.sheet or SheetSection()
    width, height = SIZES[section.size]
    if section.orientation == "portrait":
        width, height = height, width
    draws = [*blocks(terms, section), *_fillers(terms, section, width, height)]
    canvas = Canvas()
    frame(canvas, width, height)
    for draw, room in zip(draws, _rooms(draws, width, height, section), strict=False):
        if room is not None:
            draw(canvas, room, terms)
    corner(canvas, terms.model.input.report, width, height)
    left, low = width - MARGINS[1] - STAMP_WIDTH, MARGINS[3]
    title_block(canvas, terms.model.input, left, low)
    return canvas, width, height


def blocks(terms: Terms, section: SheetSection) -> list[Draw]:
    """Chosen diagrams in order; by default all available."""
    draws = available(terms)
    picked: tuple[str, ...] = section.diagrams or tuple(name for name in USUAL if name in draws)
    missing = [name for name in picked if name not in draws]
    if missing:
        problem = f"у этого двигателя нет: {', '.join(missing)}"
        raise InputError(Problem("sheet.diagrams", problem, "уберите из списка"))
    return [draws[name] for name in picked]


def _fillers(terms: Terms, section: SheetSection, width: float, height: float) -> list[Draw]:
    """Return what fills the cells that the usual diagrams leave free."""
    if section.diagrams:
        return []
    usual, draws = blocks(terms, section), available(terms)
    need = len(usual) + sum(map(_is_tall, usual))
    free = max(0, len(cells(width, height, need, section)) - need)
    return [draws[name] for name in _FILLERS if name in draws][:free]


def _is_tall(draw: Draw) -> bool:
    return isinstance(draw, partial) and draw.func is diagrams.path


def _rooms(
    draws: Sequence[Draw], width: float, height: float, section: SheetSection
) -> list[CellArea | None]:
    """Room of every block; polar diagrams take two cells, one above the other, where they fit."""
    tall = [_is_tall(draw) for draw in draws]
    try:
        free = cells(width, height, len(draws) + sum(tall), section)
    except InputError:
        free, tall = cells(width, height, len(draws), section), [False] * len(draws)
    rooms: list[CellArea | None] = [None] * len(draws)
    order = sorted(range(len(draws)), key=lambda n: not tall[n])
    for n in order:
        room = None
        if tall[n]:
            pairs = ((one, two) for one in reversed(free) for two in free if _is_under(two, one))
            upper, lower = next(pairs, (None, None))
            if upper is not None and lower is not None:
                room = CellArea(upper.left, lower.low, upper.width, upper.high - lower.low)
                free = [cell for cell in free if cell not in (upper, lower)]
        if room is None and free:
            room, *free = free
        rooms[n] = room
    return rooms


def _is_under(low: CellArea, high: CellArea) -> bool:
    return low.left == high.left and abs(low.high + _GAP - high.low) < 1e-6


def available(terms: Terms) -> dict[str, Draw]:
    """Available diagrams of an engine by name."""
    pin = worst_pin(terms)
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
        "torsion": ("torsion_stress", curves),
    }  # fmt: skip
    draws: dict[str, Draw] = {
        name: partial(draw, chart=terms.model.charts_by_id[key])
        for name, (key, draw) in charts.items()
        if key in terms.model.charts_by_id
    }
    parts: dict[str, tuple[str, Draw]] = {
        "counterweight": ("cw_mass", counterweight), "flywheel": ("fw_mass", flywheel),
        "strength": ("st_crown_MPa", strength),
    }  # fmt: skip
    drawn = {name: draw for name, (key, draw) in parts.items() if terms.has(key)}
    if "speed_Me" in terms.model.charts_by_id:
        draws["speed"] = partial(curves, chart=_characteristic(terms))
    return draws | drawn | {"shaft": shaft, "balance": balance,
                    "running": running, "results": results,
                    "throw": throw, "mechanism": mechanism}  # fmt: skip


def _characteristic(terms: Terms) -> ChartSpec:
    """Torque over the speed, of a diesel with the branch of its governor."""
    known, branch = (terms.model.charts_by_id.get(key) for key in ("speed_Me", "governor_Me"))
    assert known is not None
    further = [replace(each, only="") for each in branch.series] if branch is not None else []
    words = "Крутящий момент по внешней характеристике"
    words += " с регуляторной ветвью" * bool(further)
    return replace(known, series=(*known.series, *further), caption=words)


def cells(width: float, height: float, count: int, section: SheetSection) -> list[CellArea]:
    """Equal cells for so many blocks, row by row from the top; none under the title block.

    What was not picked one by one gives way where the sheet is too small for all of it.

    Raises:
        InputError: the cells would be too small.
    """
    grids = [g for g in _grids(width, height) if g]
    most = max(map(len, grids), default=0)
    if count > most and section.diagrams:
        way = "альбомный" if width > height else "книжный"
        problem = f"на лист {section.size} ({way}) помещается {most}, выбрано {count}"
        hint = "уберите лишнее" + ("" if section.size == "A1" else ' или выберите size = "A1"')
        raise InputError(Problem("sheet.diagrams", problem, hint))
    fitting = [g for g in grids if len(g) >= min(count, most)]
    return max(fitting, key=lambda g: min(g[0].width / 1.6, g[0].height))


def _grids(width: float, height: float) -> Iterator[list[CellArea]]:
    """Free cells of every division of the sheet into columns and rows."""
    left, right, top, bottom = MARGINS
    head = _BOX_26[1] if width > height else 0.0  # under the box in the corner
    wide, tall = width - left - right - _GAP, height - top - bottom - _GAP - head
    for columns, rows in itertools.product(range(1, 9), repeat=2):
        across, down = wide / columns, tall / rows
        if across < _MIN_CELL_MM[0] or down < _MIN_CELL_MM[1]:
            continue
        taken = math.ceil((STAMP_WIDTH + _GAP) / across), math.ceil((STAMP_HEIGHT + _GAP) / down)
        yield [
            CellArea(left + _GAP + c * across, height - top - head - (r + 1) * down, across - _GAP,
                 down - _GAP)
            for r in range(rows) for c in range(columns)
            if not (c >= columns - taken[0] and r >= rows - taken[1])
        ]  # fmt: skip


def sheet_files(model: Model, values: Values) -> dict[str, bytes]:
    """Return the sheet's files by the endings of their names.

    Raises:
        InputError: the sheet cannot hold what was picked.
        SystemPartMissing: pango is not on this machine.
    """
    terms = Terms(model, values, fine_columns(model.input))
    canvas, width, height = sheet_items(terms)
    return {
        "-sheet.pdf": sheet_pdf(canvas.items, width, height, model),
        "-sheet.dxf": dxf_bytes(canvas.items),
        "-throw.dxf": _throws(throws_of(terms)),
        "-mechanism.dxf": _mechanism(mechanism_of(terms)),
    }


def _throws(throws: list[ThrowSizes]) -> bytes:
    """Every throw true to size beside the one before it; letters in proportion."""
    items: list[Item] = []
    letters, left_end = _letters(max(sizes.size for sizes in throws)), 0.0
    for number, sizes in enumerate(throws, 1):
        drawn = throw_drawing(sizes, letters=letters)
        left, low, right, _ = bounds(drawn)
        items += moved(drawn, left_end - left, 0.0)
        middle = left_end + (right - left) / 2
        items.append(Words((middle, low - 4 * letters), f"Колено {number}", larger(letters), 0.5))
        left_end += right - left + 12 * letters
    return dxf_bytes(items, letters / _PRINTED)


def _letters(size: float) -> float:
    """Height of the letters of a drawing of that extent, of the row of ГОСТ 2.304 [mm]."""
    most = _LETTERS * size
    return standard(most) if most >= HEIGHTS[0] else _SMALL * most


def _mechanism(mechanism: MechanismSizes) -> bytes:
    letters = _letters(mechanism.size)
    return dxf_bytes(mechanism_drawing(mechanism, letters=letters), letters / _PRINTED)


def sheet_pdf(items: list[Item], width: float, height: float, model: Model) -> bytes:
    """Return a sheet of a size [mm] as PDF, lines and letters as such."""
    from html import escape

    letters = (
        replace(item, text=printable(item.text)) if isinstance(item, Words) else item
        for item in items
    )
    svg = svg_of(list(letters), (0.0, 0.0, width, height))
    page = _PAGE.format(
        title=escape(printable(f"Динамический расчёт двигателя{named_engine(model.input)}")),
        year=model.input.report.year,
        fonts=fonts.fonts_css(),
        stack=fonts.STACK,
        width=f"{width:g}",
        height=f"{height:g}",
        svg=base64.b64encode(svg.encode()).decode(),
    )
    return render_pdf(page)
