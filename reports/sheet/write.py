"""The sheet of dynamics as PDF and DXF from one list of primitives."""

from __future__ import annotations

import base64
from dataclasses import replace

from reports.document.figures.parts import mechanism_of, throws_of
from reports.document.page.render import render_pdf
from reports.document.text import fonts
from reports.document.text.terms import Terms
from reports.drawing.dxf import dxf_bytes
from reports.drawing.parts import Mechanism, Throw, mechanism_drawing, throw_drawing
from reports.drawing.primitives import Item, Words, bounds, moved
from reports.drawing.svg import svg_of
from reports.inputs.checks.grid import fine_columns
from reports.model.blocks import Model
from reports.model.evaluation import Values
from reports.shared.signs import printable
from reports.sheet.layout import sheet_items

_LETTERS = 0.02  # height of the letters of a drawing true to size, of its extent
_PRINTED = 3.5  # mm: the height of letters on paper that the dashes of lines go with
_PAGE = """<!DOCTYPE html><html lang="ru"><head><meta charset="utf-8"><title>{title}</title>
<meta name="dcterms.created" content="{year}-01-01">
<meta name="dcterms.modified" content="{year}-01-01"><style>{fonts}
@page {{ size: {width}mm {height}mm; margin: 0 }} body {{ margin: 0 }}
img {{ display: block; width: {width}mm; height: {height}mm }}
html {{ font-family: {stack} }}</style></head>
<body><img alt="{title}" src="data:image/svg+xml;base64,{svg}"></body></html>"""


def sheet_files(model: Model, values: Values) -> dict[str, bytes]:
    """The sheet's files by the endings of their names.

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


def _throws(throws: list[Throw]) -> bytes:
    """Every throw true to size beside the one before it; letters in proportion."""
    items: list[Item] = []
    letters, place = _LETTERS * max(throw.size for throw in throws), 0.0
    for number, throw in enumerate(throws, 1):
        drawn = throw_drawing(throw, letters=letters)
        left, low, right, _ = bounds(drawn)
        items += moved(drawn, place - left, 0.0)
        middle = place + (right - left) / 2
        items.append(Words((middle, low - 4 * letters), f"Колено {number}", 1.4 * letters, 0.5))
        place += right - left + 12 * letters
    return dxf_bytes(items, letters / _PRINTED)


def _mechanism(mechanism: Mechanism) -> bytes:
    letters = _LETTERS * mechanism.size
    return dxf_bytes(mechanism_drawing(mechanism, letters=letters), letters / _PRINTED)


def sheet_pdf(items: list[Item], width: float, height: float, model: Model) -> bytes:
    """A sheet of a size [mm] as PDF, lines and letters as such."""
    from html import escape

    letters = (
        replace(item, text=printable(item.text)) if isinstance(item, Words) else item
        for item in items
    )
    svg = svg_of(list(letters), (0.0, 0.0, width, height))
    page = _PAGE.format(
        title=escape(printable(f"Лист динамики. {model.input.engine.name}")),
        year=model.input.report.year,
        fonts=fonts.fonts_css(),
        stack=fonts.STACK,
        width=f"{width:g}",
        height=f"{height:g}",
        svg=base64.b64encode(svg.encode()).decode(),
    )
    return render_pdf(page)
