"""Schemes of the mechanism: with its forces (figure 1), with its velocity (figure 5)."""

from __future__ import annotations

import math

from reports.document.figures.pen import (
    CENTRE,
    DASHED,
    HAIR,
    THICK,
    Pen,
    Point,
    direction,
    polar,
    shifted,
)
from reports.document.figures.sheet import Sheet
from reports.document.figures.style import MM, SMALL

_GREY = "#e4e4e4"
_FAINT = "#b4b4b4"


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
    page = Sheet(width, height / MM)
    pen = Pen(page)
    for share, letter in ((0.27, "а)"), (0.75, "б)")):
        origin = (page.width * share, radius + 36)
        part = _Mechanism(pen, origin, radius, rod, math.radians(phi), k * radius)
        if letter == "а)":
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
        for place, name in ((self.top, "ВМТ"), (self.bottom, "НМТ")):
            pen.line([(edge - 4, place[1]), (place[0], place[1])], HAIR, DASHED)
            pen.text((edge - 20, place[1]), name, SMALL)
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
        """P_s, N and S at the piston pin; S, K and T at the crank pin; the torque."""
        pen, phi, beta = self.pen, self.phi, self.beta
        total = 50.0
        along = (math.sin(beta), -math.cos(beta))
        toward, ahead = (-math.sin(phi), -math.cos(phi)), (math.cos(phi), -math.sin(phi))
        rod_force = total / math.cos(beta)
        side = total * math.tan(beta)
        a, b = self.piston, self.pin
        pen.arrow((a[0], a[1] + 17 + 44), (a[0], a[1] + 18), 1.5)
        pen.text((a[0] + 14, a[1] + 17 + 32), "$P_s$")
        reach = max(side, 10) + self.bore
        pen.arrow(a, (a[0] - reach - 12, a[1]), 1.5)
        pen.text((a[0] - reach - 20, a[1] + 7), "$N$")
        tip = shifted(a, along, rod_force)
        pen.arrow(a, tip, 1.5)
        pen.text((tip[0] + 13, tip[1] + 6), "$S$")
        radial = rod_force * math.cos(phi + beta)
        tangential = rod_force * math.sin(phi + beta)
        end = shifted(b, along, rod_force)
        corner_k, corner_t = shifted(b, toward, radial), shifted(b, ahead, tangential)
        for corner in (corner_k, corner_t):
            pen.line([corner, end], HAIR, DASHED)
        for corner, name, away in (
            (end, "$S$", (7.0, -9.0)),
            (corner_k, "$K$", (-9.0, 5.0) if radial > 0 else (6.0, 9.0)),
            (corner_t, "$T$", (10.0, 4.0)),
        ):
            pen.arrow(b, corner, 1.5)
            pen.text((corner[0] + away[0], corner[1] + away[1]), name)
        pen.arc(self.origin, self.radius * 0.66, math.radians(200), math.radians(300), arrow=True)
        place = polar(self.origin, self.radius + 17, math.radians(250))
        pen.text(place, r"$M_{\mathrm{кр}}$")
        pen.text((self.origin[0] + 9, self.origin[1] - 9), "$O$")
        pen.text((b[0] + 8, b[1] + 9), "$B$")
        pen.text((a[0] + self.bore - 7, a[1] + 9), "$A$", halo=False)


def velocity_sketch(lam: float, phi: float = 50.0, *, width: float = 90.0) -> str:
    """The rod's line cuts OH off the diameter square to the cylinder axis, v = rω·OH/OB.

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
    page = Sheet(width, height / MM)
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
