"""A drawing as SVG in millimetres: for the report, and whole as the page of a PDF."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from html import escape

from reports.drawing.lettering import CAPITAL, INDEX, WIDER, parts_of, width_of
from reports.drawing.primitives import Box, Circle, Item, Line, Words

_FAMILY = "STIXGeneral, DejaVuSecond"  # the second for letters that the first lacks
_GREY = "#9a9a9a"
_PT = 72 / 25.4  # in a millimetre


def svg_of(items: Sequence[Item], box: Box, *, shown_mm: float | None = None) -> str:
    """The items within a box of the sheet.

    Args:
        items: what is drawn.
        box: what of the sheet is shown [mm].
        shown_mm: width on paper, by default true to size [mm].
    """
    left, low, right, high = box
    wide, tall = right - left, high - low
    body = "".join(_runs(items, left, high))
    return (
        f'<svg class="fig" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide:.2f} {tall:.2f}" '
        f'style="width:{shown_mm or wide:.1f}mm" data-size="{_PT * wide:.4g}/{_PT * tall:.4g}" '
        f'font-family="{_FAMILY}" stroke-linejoin="round">{body}</svg>'
    )


def _runs(items: Iterable[Item], left: float, high: float) -> Iterable[str]:
    """Items as elements; lines of equal looks follow one another in one path."""
    paths: dict[str, list[str]] = {}
    rest: list[str] = []
    for item in items:
        if isinstance(item, Words):
            rest.append(_words(item, left, high))
            continue
        layer = item.layer
        colour = _GREY if layer.grey else "#000000"
        dash = (item.dash if isinstance(item, Line) else ()) or layer.dash
        dashes = f' stroke-dasharray="{" ".join(f"{d:g}" for d in dash)}"' if dash else ""
        looks = (
            f' fill="{colour if item.filled else "none"}" stroke="{colour}" '
            f'stroke-width="{layer.width:g}"{dashes}'
        )
        paths.setdefault(looks, []).append(_path(item, left, high))
    yield from (f'<path d="{"".join(parts)}"{looks}/>' for looks, parts in paths.items())
    yield from rest


def _path(item: Line | Circle, left: float, high: float) -> str:
    if isinstance(item, Circle):
        (x, y), r = item.centre, item.radius
        x, y = x - left, high - y
        return (
            f"M{x - r:.3f} {y:.3f}A{r:.3f} {r:.3f} 0 1 0 {x + r:.3f} {y:.3f}"
            f"A{r:.3f} {r:.3f} 0 1 0 {x - r:.3f} {y:.3f}Z"
        )
    points = "L".join(f"{x - left:.3f} {high - y:.3f}" for x, y in item.points)
    return f"M{points}{'Z' if item.closed else ''}"


def _words(item: Words, left: float, high: float) -> str:
    parts = parts_of(item.text)
    if len(parts) == 1:
        return _text(item, left, high)
    shown, run = [], -item.align * item.width / WIDER
    for text, index in parts:
        height = item.height * (INDEX if index else 1.0)
        along, down = run, -0.3 * item.height if index else 0.0
        turn = math.radians(item.angle)
        x = item.place[0] + along * math.cos(turn) - down * math.sin(turn)
        y = item.place[1] + along * math.sin(turn) + down * math.cos(turn)
        part = replace(item, place=(x, y), text=text, height=height, align=0.0)
        shown.append(_text(part, left, high))
        run += width_of(text, height) / WIDER
    return "".join(shown)


def _text(item: Words, left: float, high: float) -> str:
    x, y = item.place[0] - left, high - item.place[1]
    anchor = {0.0: "start", 0.5: "middle", 1.0: "end"}[item.align]
    turn = f' transform="rotate({-item.angle:g} {x:.2f} {y:.2f})"' if item.angle else ""
    return (
        f'<text x="{x:.2f}" y="{y:.2f}" font-style="italic" font-size="{item.height / CAPITAL:.2f}"'
        f' text-anchor="{anchor}"{turn} xml:space="preserve">{escape(item.text)}</text>'
    )
