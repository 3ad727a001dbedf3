"""Sketches of a web and of a throw with the letters of their sizes."""

from __future__ import annotations

import math

from reports.draw.canvas import AXES, CONTOUR, DASHED, SIZES, THIN, Item, Point
from reports.draw.lettered import LetteredCanvas
from reports.draw.parts import ROUND, ThrowSizes, throw_outline
from reports.draw.sketches import LANE, PartSizes, box

_STUB = 0.55  # of a crankpin's diameter: what of it is drawn beside its web
_ARC = 6  # pieces of a quarter of a circle


def web_sketch(part: PartSizes, *, letters: float = 2.5, scale: float = 1.0) -> list[Item]:
    """Return a web with its journals from the side and from the end of the shaft.

    Args:
        part: sizes.
        letters: height of the letters on the drawing [mm].
        scale: size of the drawing to that of the part.
    """
    canvas, h = part.canvas(letters), letters
    s = part.scaled(scale)
    main, pin, radius = s["main"] / 2, s["crankpin"] / 2, s["radius"]
    thick, arm, half = s["web_thickness"], s["arm"], s["web_width"] / 2
    low, high = -2 * ROUND * main, radius + 2 * ROUND * pin
    face, back = max(arm - thick / 2, 0.1 * thick), max(arm + thick / 2, 1.1 * thick)
    end = back + 2 * _STUB * pin
    canvas.line(*box(face, back, low, high), layer=CONTOUR, closed=True)
    canvas.hatch(box(face, back, low, high))
    left = -0.7 * face
    for level, journal, (start, stop) in ((0.0, main, (left, face)), (radius, pin, (back, end))):
        for y in (level - journal, level + journal):
            canvas.line((start, y), (stop, y), layer=CONTOUR)
        broken = left if level == 0.0 else end
        canvas.line(*_wave(broken, level, journal), layer=SIZES)
        canvas.line((start - h, level), (stop + h, level), layer=AXES)
    canvas.line((0.0, low - 2 * LANE * h), (0.0, main + h), layer=AXES)
    canvas.line((arm, low - 2 * LANE * h), (arm, low), layer=THIN)
    canvas.across("web_thickness", high + 0.9 * LANE * h, (face, back), high)
    canvas.across("arm", low - 1.6 * LANE * h, (0.0, arm))
    x = end + half + 1.5 * LANE * h
    canvas.line(*_rounded(x, half, low, high), layer=CONTOUR, closed=True)
    canvas.circle((x, radius), pin, layer=CONTOUR)
    canvas.circle((x, 0.0), main, layer=THIN)
    for level in (0.0, radius):
        canvas.line((x - half - h, level), (x + half + h, level), layer=AXES)
    canvas.line((x, low - h), (x, high + h), layer=AXES)
    canvas.across("web_width", high + 0.9 * LANE * h, (x - half, x + half), (radius + high) / 2)
    return canvas.lettered()


def _wave(x: float, level: float, half: float) -> list[Point]:
    """Line of a break across a journal."""
    swing = 0.12 * half
    return [(x + swing * math.sin(math.pi * t / 2), level + t * half / 4) for t in range(-4, 5)]


def _rounded(x: float, half: float, low: float, high: float) -> list[Point]:
    """Rectangle with cut corners."""
    cut = min(0.45 * half, 0.2 * (high - low))
    return [(x - half, low + cut), (x - half + cut, low), (x + half - cut, low),
            (x + half, low + cut), (x + half, high - cut), (x + half - cut, high),
            (x - half + cut, high), (x - half, high - cut)]  # fmt: skip


def crank_sketch(part: PartSizes, *, letters: float = 2.5, scale: float = 1.0) -> list[Item]:
    """Return a throw from the side with diameters, bores and fillets of its journals.

    Args:
        part: sizes.
        letters: height of the letters on the drawing [mm].
        scale: size of the drawing to that of the throw.
    """
    canvas, h = part.canvas(letters), letters
    drawn = throw_outline(canvas, _throw(part), scale)
    s = part.scaled(scale)
    (left, right), inner, radius = drawn.ends, drawn.inner, drawn.radius
    main, pin = s["main"] / 2, s["crankpin"] / 2
    canvas.line((left - h, 0.0), (right + h, 0.0), layer=AXES)
    canvas.line((inner[0] - h, radius), (inner[1] + h, radius), layer=AXES)
    canvas.down("main", left - LANE * h, (-main, main), left, -1)
    canvas.down("crankpin", right + 0.9 * LANE * h, (radius - pin, radius + pin), inner[1])
    for key, level, ends, at in (
        ("main_bore", 0.0, (left, drawn.outer[0]), 0.6), ("crankpin_bore", radius, inner, 0.75),
    ):  # fmt: skip
        half = s[key] / 2
        if half:
            for y in (level - half, level + half):
                canvas.line((ends[0], y), (ends[1], y), layer=THIN, dash=DASHED)
            canvas.down(key, ends[0] + at * (ends[1] - ends[0]), (level - half, level + half))
    hole, middle = s["hole"] / 2, inner[0] + 0.4 * (inner[1] - inner[0])
    if hole:
        canvas.circle((middle, radius), hole, layer=CONTOUR)
        canvas.line((middle, radius - pin - h), (middle, radius + pin + h), layer=AXES)
        canvas.across("hole", radius + pin + LANE * h, (middle - hole, middle + hole), radius)
    rho = s["fillet"]
    if rho:
        _fillets(canvas, drawn.outer, main, 0.0, rho, 1)
        _fillets(canvas, inner, pin, radius, rho, -1)
        deep = rho * (1 - math.sqrt(0.5))  # from the corner to the middle of the arc
        tip = inner[1] - deep, radius - pin - deep
        canvas.leader("fillet", (tip[0] - 1.8 * h, tip[1] - 1.8 * h), tip)
    return canvas.lettered()


def _throw(part: PartSizes) -> ThrowSizes:
    lengths = part["main_length"], part["next_length"]
    return ThrowSizes(
        arms=tuple(part[f"l{n}"] for n in range(1, 7)), webs=(part["left_web"], part["right_web"]),
        radius=part["radius"], pin=part["crankpin"], mains=(part["main"], part["main"]),
        lengths=lengths, usual=(part["left_usual"], part["right_usual"]),
    )  # fmt: skip


def _fillets(
    canvas: LetteredCanvas, faces: tuple[float, float], half: float, level: float, rho: float,
    way: int,
) -> None:  # fmt: skip
    """Round the corners of a journal and both webs; it lies outside (1) or between (-1) them."""
    if not rho:
        return
    for face, out in zip(faces, (-way, way), strict=True):
        for side in (1, -1):
            centre = (face + out * rho, level + side * (half + rho))
            turns = (math.pi / 2 * n / _ARC for n in range(_ARC + 1))
            arc = [(centre[0] - out * rho * math.cos(t), centre[1] - side * rho * math.sin(t))
                   for t in turns]  # fmt: skip
            canvas.line(*arc, layer=CONTOUR)
