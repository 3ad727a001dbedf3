"""Sketches of parts on the sheets of their strength: letters, which no edit makes untrue."""

from __future__ import annotations

import io
from collections.abc import Sequence

from openpyxl import Workbook
from openpyxl.drawing.fill import Blip
from openpyxl.drawing.geometry import PresetGeometry2D
from openpyxl.drawing.picture import PictureFrame
from openpyxl.worksheet.worksheet import Worksheet

from reports.draw.canvas import Item, Words, bounds
from reports.draw.fonts import plain
from reports.draw.pixels import MM_PER_INCH, png_of
from reports.draw.sketched import SKETCHED, sketch
from reports.model.blocks import TableSpec, scalars_of
from reports.workbook.layout import HEADER_ROW, Layout
from reports.workbook.places import GAP, SCREEN, Box, anchor, column_px, top_of
from reports.workbook.sheets import BlockWriter

# The list whose formulas are written in the letters of a sketch.
SKETCH_OF = {"strength_piston": "piston", "strength_pin": "pin", "strength_eye": "rod",
             "strength_web": "web", "safe_pins": "crank"}  # fmt: skip
_DPI, _SCREEN_DPI = 128, 96
_MARGIN = 1.0  # mm of white around a drawing
_BESIDE = 24  # px from what is written
_FIRST_ID = 100  # of a sketch among the things of a sheet, behind its charts


def add_sketches(book: Workbook, writer: BlockWriter, boxes: dict[str, list[Box]]) -> None:
    """Put a sketch on each sheet that calculates a part; note where it stands.

    Args:
        book: the sheets, with all that is written on them.
        writer: layout, model and values.
        boxes: what stands on each sheet beside its cells; the places of sketches are added.
    """
    model = writer.layout.model
    for block in model.blocks:
        name = SKETCH_OF.get(block.id)
        if name is None or block.sheet in model.folded:
            continue
        items = sketch(name, model, writer.values.scalars)
        if items is None:
            continue
        left, low, right, high = bounds(items)
        area = (left - _MARGIN, low - _MARGIN, right + _MARGIN, high + _MARGIN)
        size = (_pixels(area[2] - area[0]), _pixels(area[3] - area[1]))
        sheet, taken = book[block.sheet], boxes.setdefault(block.sheet, [])
        box = _place(sheet, size, _written(sheet, writer.layout), taken)
        taken.append(box)
        words = described(SKETCHED[name].title, items)
        _draw(sheet, box, png_of(items, area, _DPI), words, _FIRST_ID + len(taken))


def described(title: str, items: Sequence[Item]) -> str:
    """Return a sketch in words: the part and its letters."""
    letters = ", ".join(plain(item.text) for item in items if isinstance(item, Words))
    return f"{title}, размеры: {letters}"


def _pixels(length: float) -> int:
    return round(length / MM_PER_INCH * _SCREEN_DPI)


def _written(sheet: Worksheet, layout: Layout) -> list[Box]:
    """Where the blocks of a sheet stand."""
    written = []
    for block in layout.model.blocks:
        if block.sheet != sheet.title:
            continue
        first, last_column = layout.places[block.id], layout.last_column([block])
        if isinstance(block, TableSpec):
            last_row = layout.rows_of(block)[-1]
        else:
            last_row = max(layout.cells[scalar.key].row for scalar in scalars_of(block))
        x = sum(column_px(sheet, i) for i in range(1, first.column))
        y = top_of(sheet, first.row - 1)  # with its title above
        width = sum(column_px(sheet, i) for i in range(first.column, last_column + 1))
        written.append(Box(x, y, width, top_of(sheet, last_row + 1) - y))
    return written


def _place(
    sheet: Worksheet, size: tuple[int, int], written: Sequence[Box], taken: Sequence[Box]
) -> Box:
    """Return a free place: beside all that is written, under a block within it, or below it all."""
    width, height = size
    right, bottom = max(box.right for box in written), max(box.bottom for box in written)
    beside = Box(right + _BESIDE, top_of(sheet, HEADER_ROW), width, height)
    under = [
        Box(box.x + GAP, box.bottom + GAP, width, height)
        for box in sorted(written, key=lambda box: (box.bottom, box.x))
    ]
    inside = [box for box in under if box.right <= right and box.bottom <= bottom]
    occupied = [*written, *taken]
    fitting = [box for box in (beside, *inside) if box.right <= SCREEN or box in inside]
    below = max(box.bottom for box in occupied) + GAP
    free = (box for box in fitting if not any(_overlap(box, other) for other in occupied))
    return next(free, Box(GAP, below, width, height))


def _overlap(one: Box, other: Box) -> bool:
    return (
        one.x < other.right and other.x < one.right
        and one.y < other.bottom and other.y < one.bottom
    )  # fmt: skip


def _draw(sheet: Worksheet, box: Box, png: bytes, words: str, number: int) -> None:
    """Put a picture on a sheet with its words for those who do not see it."""
    from openpyxl.drawing.image import Image

    image = Image(io.BytesIO(png))
    image.anchor = anchor(sheet, box)
    frame = PictureFrame()
    look = frame.nvPicPr.cNvPr
    look.id, look.name, look.descr = number, "Эскиз", words
    frame.blipFill.blip = Blip()
    frame.spPr.prstGeom = PresetGeometry2D(prst="rect")
    frame.spPr.ln = None
    image.anchor.pic = frame
    sheet.add_image(image)
