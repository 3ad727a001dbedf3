"""A drawing as a small black and white PNG, for programs that show no lines of their own."""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import cycle, pairwise

from reports.draw.canvas import Box, Circle, Dash, Item, Line, Point, Words
from reports.draw.fonts import STROKE, strokes_of
from reports.draw.writers import parts_placed

MM_PER_INCH = 25.4


def png_of(items: Sequence[Item], box: Box, dpi: float) -> bytes:
    """Return the items within a box as PNG of one bit a pixel; the same items give the same bytes.

    Args:
        items: what is drawn.
        box: what of the sheet is shown [mm].
        dpi: pixels in an inch.
    """
    from PIL import Image, ImageDraw

    scale = dpi / MM_PER_INCH
    left, low, right, high = box
    image = Image.new("1", (round((right - left) * scale), round((high - low) * scale)), 1)
    pen = ImageDraw.Draw(image)

    def placed(points: Iterable[Point]) -> list[Point]:
        return [((x - left) * scale, (high - y) * scale) for x, y in points]

    def stroke(points: Iterable[Point], width: float) -> None:
        pen.line(placed(points), fill=0, width=max(1, round(width * scale)))

    for item in items:
        if isinstance(item, Words):
            for part in parts_placed(item):
                for letter in _strokes(part):
                    stroke(letter, STROKE * part.height)
        elif isinstance(item, Circle):
            x, y = placed([item.centre])[0]
            r, width = item.radius * scale, max(1, round(item.layer.width * scale))
            out = r + width / 2
            pen.ellipse((x - out, y - out, x + out, y + out), outline=0, width=width)
        elif isinstance(item, Line) and item.filled:
            pen.polygon(placed(item.points), fill=0, outline=0)
        elif isinstance(item, Line):
            points = [*item.points, item.points[0]] if item.closed else list(item.points)
            for piece in _dashed(points, item.dash or item.layer.dash):
                stroke(piece, item.layer.width)
    stream = io.BytesIO()
    image.save(stream, "png", optimize=True)
    return stream.getvalue()


def _strokes(words: Words) -> Iterator[list[Point]]:
    """Yield the strokes of a line of text turned about its place."""
    turn, start = math.radians(words.angle), -words.align * words.width
    cos, sin = math.cos(turn), math.sin(turn)
    x, y = words.place
    for letter in strokes_of(words.text, words.height):
        yield [(x + (start + a) * cos - b * sin, y + (start + a) * sin + b * cos)
               for a, b in letter]  # fmt: skip


def _dashed(points: Sequence[Point], dash: Dash) -> Iterator[Sequence[Point]]:
    """Yield a polyline, or its dashes."""
    if not dash:
        yield points
        return
    for start, end in pairwise(points):
        length = math.dist(start, end)
        if not length:
            continue
        at, pattern = 0.0, zip(cycle(dash), cycle((True, False)), strict=False)
        for part, is_drawn in pattern:
            if at >= length:
                break
            until = min(at + part, length)
            if is_drawn:
                across, up = (end[0] - start[0]) / length, (end[1] - start[1]) / length
                yield [(start[0] + t * across, start[1] + t * up) for t in (at, until)]
            at = until
