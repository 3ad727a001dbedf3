"""Schemes of the mechanism, of the shaft and of the engine."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

from kshm.nomenclature.quantity import quantity
from reports.document.figures.canvas import (
    CENTRE,
    DASHED,
    FONT_SIZE,
    HAIR,
    SMALL,
    THICK,
    Pen,
    Point,
    Sheet,
    direction,
    polar,
    shifted,
)
from reports.document.figures.labels import text_size
from reports.draw.writers import PT_PER_MM

_GREY = "#e4e4e4"
_FAINT = "#b4b4b4"
_ROW = 17.0
_CLEAR = 20.0  # between a letter beside the axis of the shaft and a ray [deg]
_HALF = 15.0  # of a cylinder's width


def mechanism_sketch(lam: float, phi: float = 50.0, *, k: float = 0.0, width: float = 150.0) -> str:
    """Mechanism: а) geometry, б) forces; drawn to scale in λ and in the offset, as SVG.

    Args:
        lam: Crank radius over rod length λ, between 0.1 and 0.6.
        phi: Crank angle to draw [deg], best between 30 and 70.
        k: Relative offset e/r, between −0.6 and 0.6.
        width: Width of the figure [mm].

    Raises:
        ValueError: λ cannot be drawn.
    """
    if not 0.1 <= lam <= 0.6 or abs(k) > 0.6:
        msg = f"Схема механизма: λ = {lam} вне пределов 0,1…0,6 или k = {k} вне ±0,6"
        raise ValueError(msg)
    radius = 45.0
    rod = radius / lam
    height = 2 * radius + rod + 78 + 22
    page = Sheet(width, height / PT_PER_MM)
    pen = Pen(page)
    for share, letter, links in ((0.27, "а)", True), (0.75, "б)", False)):
        origin = (page.width * share, radius + 36)
        part = _Mechanism(pen, origin, radius, rod, math.radians(phi), k * radius)
        if links:
            part.links()
            part.geometry()
        else:
            part.links(faint=True)
            part.forces()
        pen.text((origin[0], 9), letter)
    return page.svg()


class _Mechanism:
    """One drawing of the mechanism with its joints O, A, B."""

    def __init__(
        self,
        pen: Pen,
        origin: Point,
        radius: float,
        rod: float,
        phi: float,
        offset: float = 0.0,
    ) -> None:
        self.pen, self.origin, self.radius, self.rod, self.phi = pen, origin, radius, rod, phi
        self.offset = offset
        self.beta = math.asin((radius * math.sin(phi) - offset) / rod)
        self.pin = polar(origin, radius, phi)
        lift = radius * math.cos(phi) + rod * math.cos(self.beta)
        axis = origin[0] + offset
        self.piston = (axis, origin[1] + lift)
        self.top = (axis, origin[1] + math.sqrt((rod + radius) ** 2 - offset**2))
        self.bottom = (axis, origin[1] + math.sqrt((rod - radius) ** 2 - offset**2))
        self.bore = radius * 0.52

    def links(self, *, faint: bool = False) -> None:
        """Cylinder, piston, rod, crank, circle of the crank pin; rod and crank faint or not."""
        pen, (x, y) = self.pen, self.origin
        crown = self.top[1] + 22
        pen.line([(x, y - self.radius - 12), (x, crown + 12)], HAIR, CENTRE)
        pen.line([(x - self.radius - 10, y), (x + self.radius + 10, y)], HAIR, CENTRE)
        x += self.offset
        if self.offset:
            pen.line([(x, y - self.radius - 12), (x, crown + 12)], HAIR, CENTRE)
        for side in (-1, 1):
            wall = x + side * (self.bore + 2)
            pen.line([(wall, self.bottom[1] - 14), (wall, crown)], 1.4)
        left = (x - self.bore, self.piston[1] - 13)
        right = (x + self.bore, self.piston[1] + 17)
        corners = [left, (right[0], left[1]), right, (left[0], right[1])]
        pen.shape(corners, fill=_GREY, width=1.3, order=1.6)
        pen.circle(self.origin, self.radius, width=HAIR)
        pen.line([self.piston, self.pin, self.origin], THICK, colour=_FAINT if faint else "#000000")
        for joint in (self.origin, self.pin, self.piston):
            pen.circle(joint, 3.2, fill="#ffffff", width=1.2)

    def geometry(self) -> None:
        """Dead centres, r, L, φ, β, ω, the offset and the names of the joints."""
        pen, (x, y) = self.pen, self.origin
        edge = x - self.radius - 16
        if self.offset:
            below = y - self.radius - 8
            pen.measure((x, below), (x + self.offset, below))
            pen.text((x + self.offset + (9 if self.offset > 0 else -9), below), "$e$", SMALL)
        for level, name in ((self.top, "ВМТ"), (self.bottom, "НМТ")):
            pen.line([(edge - 4, level[1]), (level[0], level[1])], HAIR, DASHED)
            pen.text((edge - 20, level[1]), name, SMALL)
        pen.measure((edge, self.bottom[1]), (edge, self.top[1]))
        stroke = "$S$" if self.offset else "$S=2r$"
        pen.text((edge - 22, (self.top[1] + self.bottom[1]) / 2), stroke, SMALL)
        x += self.offset
        across = x + self.bore + 16
        pen.line([(x, self.piston[1]), (across + 4, self.piston[1])], HAIR, DASHED)
        pen.line([(x, self.top[1]), (across + 4, self.top[1])], HAIR, DASHED)
        pen.measure((across, self.piston[1]), (across, self.top[1]))
        pen.text((across + 10, (self.piston[1] + self.top[1]) / 2), r"$s_{\mathrm{п}}$")
        pen.arc(self.origin, 19, 0.0, self.phi, arrow=True)
        pen.text(polar(self.origin, 27, self.phi * 0.45), r"$\varphi$")
        pen.arc(self.piston, self.rod * 0.42, math.pi, math.pi - self.beta, arrow=True)
        pen.text(polar(self.piston, self.rod * 0.42 + 9, math.pi - self.beta / 2), r"$\beta$")
        pen.text(_beside(self.origin, self.pin, 0.6, -9), "$r$")
        pen.text(_beside(self.piston, self.pin, 0.62, 11), "$L$")
        pen.text((self.origin[0] - 9, y - 9), "$O$")
        pen.text((self.pin[0] + 11, self.pin[1] + 2), "$B$")
        pen.text((x - self.bore + 8, self.piston[1] + 4), "$A$", halo=False)
        spin = self.radius * 0.62
        pen.arc(self.origin, spin, math.radians(110), math.radians(165), arrow=True)
        pen.text(polar(self.origin, spin + 9, math.radians(140)), r"$\omega$")

    def forces(self) -> None:
        """The sum, side and rod forces at the piston pin, those at the crank pin; the torque."""
        pen, phi, beta = self.pen, self.phi, self.beta
        total = 50.0
        along = (math.sin(beta), -math.cos(beta))
        toward, ahead = (-math.sin(phi), -math.cos(phi)), (math.cos(phi), -math.sin(phi))
        rod_force = total / math.cos(beta)
        side = total * math.tan(beta)
        a, b = self.piston, self.pin
        pen.arrow((a[0], a[1] + 17 + 44), (a[0], a[1] + 18), 1.5)
        pen.text((a[0] + 14, a[1] + 17 + 32), _letter("Ps_MPa"))
        reach = max(side, 10) + self.bore
        pen.arrow(a, (a[0] - reach - 12, a[1]), 1.5)
        pen.text((a[0] - reach - 20, a[1] + 7), _letter("N_MPa"))
        tip = shifted(a, along, rod_force)
        pen.arrow(a, tip, 1.5)
        pen.text((tip[0] + 13, tip[1] + 6), _letter("S_MPa"))
        radial = rod_force * math.cos(phi + beta)
        tangential = rod_force * math.sin(phi + beta)
        end = shifted(b, along, rod_force)
        corner_k, corner_t = shifted(b, toward, radial), shifted(b, ahead, tangential)
        for corner in (corner_k, corner_t):
            pen.line([corner, end], HAIR, DASHED)
        for corner, name, away in (
            (end, _letter("S_MPa"), (7.0, -9.0)),
            (corner_k, _letter("K_MPa"), (-9.0, 5.0) if radial > 0 else (6.0, 9.0)),
            (corner_t, _letter("T_MPa"), (10.0, 4.0)),
        ):
            pen.arrow(b, corner, 1.5)
            pen.text((corner[0] + away[0], corner[1] + away[1]), name)
        pen.arc(self.origin, self.radius * 0.66, math.radians(200), math.radians(300), arrow=True)
        anchor = polar(self.origin, self.radius + 17, math.radians(250))
        pen.text(anchor, _letter("Msum_Nm"))
        pen.text((self.origin[0] + 9, self.origin[1] - 9), "$O$")
        pen.text((b[0] + 8, b[1] + 9), "$B$")
        pen.text((a[0] + self.bore - 7, a[1] + 9), "$A$", halo=False)


def _letter(key: str) -> str:
    """Return the symbol of a quantity as a letter of a figure."""
    return f"${quantity(key).tex}$"


def velocity_sketch(lam: float, phi: float = 50.0, *, width: float = 90.0) -> str:
    """Return the rod's line cuts OH off the diameter square to the cylinder axis, v = rω·OH/OB.

    Args:
        lam: λ.
        phi: crank angle [deg], between 0 and 180.
        width: width of the figure [mm].
    """
    radius = 52.0
    turn = math.radians(phi)
    beta = math.asin(lam * math.sin(turn))
    lift = radius * (math.cos(turn) + math.cos(beta) / lam)
    cut = radius * math.sin(turn + beta) / math.cos(beta)
    height = lift + radius + 60
    page = Sheet(width, height / PT_PER_MM)
    pen = Pen(page)
    origin = (page.width * 0.42, radius + 30)
    x, y = origin
    pin, piston = polar(origin, radius, turn), (x, y + lift)
    across = (x + cut, y)
    pen.line([(x, y - radius - 14), (x, piston[1] + 18)], HAIR)
    pen.line([(x - radius - 14, y), (x + max(radius, cut) + 14, y)], HAIR)
    pen.circle(origin, radius, width=HAIR)
    pen.line([piston, pin, origin], THICK)
    pen.line([pin, across] if phi < 90 else [piston, across], HAIR, DASHED)
    pen.line([origin, across], 2.6)
    for joint in (origin, pin, piston, across):
        pen.circle(joint, 2.8, fill="#ffffff", width=1.1)
    pen.text((x - 9, y - 9), "$O$")
    pen.text((pin[0] + 10, pin[1] + 4), "$B$")
    pen.text((x - 10, piston[1] + 3), "$A$")
    pen.text((across[0] + 9, y - 9), "$H$")
    pen.text((x + cut / 2, y - 10), "$OH$", SMALL)
    pen.arc(origin, 18, 0.0, turn, arrow=True)
    pen.text(polar(origin, 26, turn * 0.5), r"$\varphi$")
    return page.svg()


def _beside(start: Point, end: Point, share: float, offset: float) -> Point:
    """Point beside a segment, to the left of its direction for a positive offset."""
    along = direction(start, end)
    foot = shifted(start, along, share * math.dist(start, end))
    return shifted(foot, (-along[1], along[0]), offset)


def engine_scheme(
    axes: Sequence[float],
    throws: Sequence[int],
    throw_angles: Sequence[float],
    offsets: Sequence[float],
    period: float,
    *,
    width: float = 165.0,
) -> str:
    """Engine from the nose and its power strokes over the cycle, as SVG.

    Args:
        axes: Angle of each cylinder's axis from that of cylinder 1 [deg], clockwise.
        throws: Number of each cylinder's throw.
        throw_angles: Angle of each throw from the first [deg], clockwise.
        offsets: Start of each cylinder's power stroke [deg].
        period: Length of the cycle [deg].
        width: Width of the figure [mm].

    Raises:
        ValueError: No cylinders, or lists of different lengths.
    """
    if not axes or not len(axes) == len(throws) == len(offsets):
        msg = "Схема двигателя: нет цилиндров или списки разной длины"
        raise ValueError(msg)
    bars = len(axes) * _ROW + 34
    page = Sheet(width, max(184.0, bars + 14) / PT_PER_MM)
    pen = Pen(page)
    half = page.width * 0.42
    # Banks stand symmetrically: the axis of cylinder 1 leans to the left.
    lean = -max(math.remainder(axis, 360.0) % 360 for axis in axes) / 2
    _front(pen, (half / 2, page.height * 0.42), axes, throw_angles, lean)
    _strokes(pen, (half + 30, page.height / 2), page.width - half - 40, offsets, throws, period)
    return page.svg()


def _front(
    pen: Pen, centre: Point, axes: Sequence[float], throw_angles: Sequence[float], lean: float
) -> None:
    """Rows of cylinders and throws seen from the nose with crank 1 along cylinder 1."""
    radius, inner, far = 26.0, 52.0, 88.0
    half = _half_width(axes, inner)
    numbered = sorted((round(axis + lean, 6), n) for n, axis in enumerate(axes, 1))
    for axis, members in itertools.groupby(numbered, key=lambda pair: pair[0]):
        angle = math.radians(axis)
        pen.line([centre, polar(centre, far + 8, angle)], HAIR, CENTRE)
        corners = []
        for distance, side in ((inner, -1), (inner, 1), (far, 1), (far, -1)):
            base = polar(centre, distance, angle)
            corners.append(polar(base, side * half, angle + math.pi / 2))
        pen.shape(corners, fill=_GREY, width=1.2)
        names = [str(number) for _, number in members]
        text = ", ".join(names) if len(names) <= 3 else f"{names[0]}–{names[-1]}"
        centre_of_name = polar(centre, (inner + far) / 2, angle)
        if half < _HALF:  # beside a narrow cylinder, on its free side
            aside = half + text_size(text, SMALL)[0] / 2 + 5
            centre_of_name = polar(centre_of_name, math.copysign(aside, axis), angle + math.pi / 2)
        pen.text(centre_of_name, text, SMALL, halo=False)
    pen.throws(centre, radius, throw_angles, SMALL, lean=lean)
    pen.arc(centre, radius + 18, math.radians(150), math.radians(205), arrow=True)
    pen.text(polar(centre, radius + 27, math.radians(178)), r"$\omega$", SMALL)


def _half_width(axes: Sequence[float], inner: float) -> float:
    """Half the width of a cylinder that leaves its neighbours free at their nearest."""
    turns = sorted({round(math.remainder(axis, 360.0), 6) for axis in axes})
    gap = min((b - a for a, b in itertools.pairwise(turns)), default=180.0)
    return min(_HALF, 0.9 * inner * math.tan(math.radians(gap) / 2))


def _strokes(
    pen: Pen,
    left: Point,
    length: float,
    offsets: Sequence[float],
    throws: Sequence[int],
    period: float,
) -> None:
    """Power strokes of the cylinders, a row for each, over the angle of the shaft."""
    rows = len(offsets)
    top = left[1] + rows * _ROW / 2
    bottom = top - rows * _ROW
    for mark in range(0, round(period) + 1, 180 if period > 360 else 90):
        x = left[0] + length * mark / period
        pen.line([(x, bottom - 4), (x, top)], HAIR, DASHED)
        pen.text((x, bottom - 12), f"{mark}°", SMALL)
    for row, (offset, throw) in enumerate(zip(offsets, throws, strict=True)):
        middle = top - (row + 0.5) * _ROW
        pen.text((left[0] - 14, middle), f"{row + 1} ({throw})", SMALL)
        for start, end in _parts(offset % period, min(180.0, period / 2), period):
            first, last = (left[0] + length * angle / period for angle in (start, end))
            low, high = middle - 5, middle + 5
            corners = [(first, low), (last, low), (last, high), (first, high)]
            pen.shape(corners, fill=_GREY, width=1.0)
    pen.line([(left[0], bottom), (left[0] + length, bottom)], HAIR)
    pen.text((left[0] + length / 2, top + 9), r"$\varphi$", FONT_SIZE)


def _parts(start: float, length: float, period: float) -> list[tuple[float, float]]:
    """Return a stroke within the cycle; one that passes its end goes on at its beginning."""
    end = start + length
    if end <= period:
        return [(start, end)]
    return [(start, period), (0.0, end - period)]


def crank_scheme(throw_angles: Sequence[float], *, split: float = 0.0, width: float = 150.0) -> str:
    """Throws of the shaft from the side and from the nose, as SVG.

    Args:
        throw_angles: Angle γ of each throw from the first [deg], clockwise seen from the nose.
        split: Angle from the left half of every pin to its right half [deg], 0 for common pins.
        width: Width of the figure [mm].

    Raises:
        ValueError: No throws.
    """
    if not throw_angles:
        msg = "Схема вала: нет ни одного колена"
        raise ValueError(msg)
    radius, star = 40.0, 34.0
    page = Sheet(width, (2 * radius + 62) / PT_PER_MM)
    pen = Pen(page)
    level = page.height / 2 + 4
    right = page.width - star - 34
    _side_view(pen, (12.0, level), right - star - 42, radius, throw_angles, split)
    _star_view(pen, (right, level), star, throw_angles, split)
    return page.svg()


def _side_view(
    pen: Pen, start: Point, length: float, radius: float, throw_angles: Sequence[float],
    split: float,
) -> None:  # fmt: skip
    """Broken line of the shaft: journals on the axis, pins at r·cos γ above or below it."""
    (x, y), count = start, len(throw_angles)
    pitch = (length - 16) / count
    journal, web = pitch * 0.30, pitch * 0.10
    pen.line([(x - 6, y), (x + length + 6, y)], HAIR, CENTRE)
    points: list[Point] = [(x, y), (x + 8 + journal / 2, y)]
    for number, angle in enumerate(throw_angles, 1):
        left = x + 8 + (number - 1) * pitch + journal / 2
        height, other = (y + radius * math.cos(math.radians(a)) for a in (angle, angle + split))
        inner = (left + web, left + pitch - journal - web)
        middle = (inner[0] + inner[1]) / 2
        halves = [(middle, height), (middle, other)] if split else []
        points += [(left, y), (inner[0], height), *halves, (inner[1], other)]
        points += [(left + pitch - journal, y), (left + pitch - journal / 2, y)]
        height = max(height, other, key=lambda level: abs(level - y))
        above = 10 if height >= y else -10
        pen.text((middle, height + above), str(number))
    points[-1] = (x + length, y)
    pen.line(points, THICK)
    size = min(5.0, journal * 0.35)
    for number in range(count + 1):
        centre = x + 8 + number * pitch
        for side in (-1, 1):
            pen.line([(centre - size, y + side * 4), (centre + size, y + side * 4)], 1.4)


def _star_view(
    pen: Pen, centre: Point, radius: float, throw_angles: Sequence[float], split: float
) -> None:
    """Directions of the throws seen from the nose; throws of one direction share a ray."""
    for dx, dy in ((radius + 8, 0.0), (0.0, radius + 8)):
        ends = [(centre[0] - dx, centre[1] - dy), (centre[0] + dx, centre[1] + dy)]
        pen.line(ends, HAIR, CENTRE)
    rays = list(throw_angles)
    if split:
        rays += [angle + split for angle in throw_angles]
        names = [f"{n}{half}" for half in "лп" for n in range(1, len(throw_angles) + 1)]
        pen.throws(centre, radius, rays, SMALL, names=names)
    else:
        pen.throws(centre, radius, rays, FONT_SIZE)
    turn = _free_direction(rays)
    pen.arc(centre, radius * 0.5, math.radians(turn - 25), math.radians(turn + 25), arrow=True)
    pen.text(polar(centre, radius * 0.5 + 9, math.radians(turn)), r"$\omega$")


def _free_direction(rays: Sequence[float]) -> float:
    """Where a letter between the rays hides none [deg]: at 45°, else amid the widest gap."""
    turns = sorted({round(ray % 360, 6) % 360 for ray in rays})
    if all(abs(math.remainder(ray - 45, 360)) > _CLEAR for ray in turns):
        return 45.0
    gaps = [(after - ray, ray) for ray, after in itertools.pairwise([*turns, turns[0] + 360])]
    width, start = max(gaps)
    return start + width / 2
