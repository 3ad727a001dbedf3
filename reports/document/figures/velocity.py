"""Graphical finding of the piston velocity, figure 5 of the textbook."""

from __future__ import annotations

import math

from reports.document.figures.pen import DASHED, HAIR, THICK, Pen, polar
from reports.document.figures.style import MM, SMALL, sheet


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
    with sheet(width, height / MM) as page:
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
