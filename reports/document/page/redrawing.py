"""Figures that were to be made smaller, drawn anew at that size with type of the usual size."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import partial

from reports.document.page.writer import Figure

_PICTURE = re.compile(
    r'<figure id="(?P<name>[^"]+)"><(?:svg|img) class="fig"[^>]*?style="width:(?P<width>[\d.]+)mm"'
    r'[^>]*? data-size="(?P<wide>[\d.]+)/(?P<tall>[\d.]+)"[^>]*>'
)
_SIZE = re.compile(r'data-size="([\d.]+)/([\d.]+)"')
_MM = 72 / 25.4  # pt
_SIZES = ("height", "most", "size")  # what the drawing functions call their size [mm]
_TRIES = 8
_CLOSE = 0.995  # of the height that there is


def redrawn(body: str, figures: Mapping[str, Figure], pictured: Callable[[str, str], str]) -> str:
    """The text with every reduced figure drawn within its new height.

    Args:
        body: HTML of the chapters, of each figure the picture as an image.
        figures: Plans by the ids of the figures.
        pictured: Makes an image of a drawing and its alternative text.
    """

    def anew(match: re.Match[str]) -> str:
        share = float(match["width"]) * _MM / float(match["wide"])
        plan = figures.get(match["name"])
        if plan is None or share >= _CLOSE:
            return match.group()
        svg = smaller(plan.draw, share * float(match["tall"]))
        if svg is None:
            return match.group()
        return f'<figure id="{match["name"]}">{pictured(svg, plan.alt or plan.caption)}'

    return _PICTURE.sub(anew, body)


def smaller(draw: Callable[[], str], height: float) -> str | None:
    """A drawing within a height [pt]; ``None`` where its size is not to be chosen."""
    if not isinstance(draw, partial):
        return None
    key = next((name for name in _SIZES if name in draw.keywords), None)
    if key is None:
        return None
    size, margins = float(draw.keywords[key]), 0.0
    svg: str = draw()
    for _ in range(_TRIES):
        tall = _height(svg)
        if tall <= height:
            return svg
        # The room of the type around the field does not shrink.
        share = (_CLOSE * height - margins) / (tall - margins)
        if share <= 0:
            break
        size *= share
        svg = draw.func(*draw.args, **draw.keywords | {key: size})
        margins = max(0.0, (_height(svg) - share * tall) / (1 - share))
    return None


def _height(svg: str) -> float:
    found = _SIZE.search(svg)
    return float(found[2]) if found else 0.0
