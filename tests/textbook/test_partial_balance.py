"""One cylinder whose counterweights take a part of the reciprocating mass: two printed examples.

1. A theory of machines, «Balancing of Reciprocating Masses», illustration 1 on page 310: 250 rpm,
   a stroke of 18 cm, 120 kg that reciprocate, 70 kg that turn at 9 cm, two thirds balanced at
   15 cm: 90 kg, 3262.8 N at 30° from the dead centre.  The print has π = 3.141.
2. R. S. Khurmi, Theory of Machines, on one cylinder: 240 rpm, a stroke of 300 mm, 50 kg, 37 kg,
   two thirds at 400 mm: 26.38 kg.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import kshm
from kshm import throw
from tests.api.test_api import small

pytestmark = pytest.mark.filterwarnings("ignore:(mean piston speed|stroke over bore|divide)")

_SHARE, _PI_OF_PRINT = 2 / 3, 3.141


def cylinder(*, speed: float, radius_mm: float, reciprocating: float, turning: float):
    """A cylinder whose webs weigh nothing; its pin has a half of what turns."""
    arms = throw(arms_mm=[radius_mm] * 6, web_kg=0.0, pin_kg=turning / 2)
    return small(
        speed_rpm=speed, bore_mm=500, crank_radius_mm=radius_mm, rod_length_mm=4 * radius_mm,
        reciprocating_kg=reciprocating, rod_big_end_kg=turning / 2, throws=arms,
    )  # fmt: skip


def balanced(engine):
    """Mass of a web's counterweight at the crank radius [kg]: two take what turns and the share."""
    scalars = kshm.solve(engine.with_({"balancing.counterweight_share": _SHARE})).scalars
    return scalars["counterweight_web"]


@pytest.mark.parametrize(
    ("speed", "stroke_mm", "reciprocating", "turning", "at_mm", "printed", "half"),
    [(250, 180, 120, 70, 150, 90.0, 0.05), (240, 300, 50, 37, 400, 26.38, 0.005)],
)
def test_the_balance_mass(speed, stroke_mm, reciprocating, turning, at_mm, printed, half):
    radius = stroke_mm / 2
    engine = cylinder(speed=speed, radius_mm=radius, reciprocating=reciprocating, turning=turning)
    assert 2 * balanced(engine) * radius / at_mm == pytest.approx(printed, abs=half)


def test_the_force_that_is_left():
    """The first order at 30°: along the cylinder without the higher orders, and across."""
    engine = cylinder(speed=250, radius_mm=90, reciprocating=120, turning=70)
    weights = {"counterweight_kg": balanced(engine), "balancing.counterweight_share": 0.0}
    table = kshm.solve(engine.with_(weights)).columns["balance"]
    row = int(np.flatnonzero(table["phi_deg"] == 30)[0])
    along = (table["Fup_kN"] - table["F2_kN"] - table["F4_kN"])[row]
    force = math.hypot(along, table["Fright_after_kN"][row]) * 1000
    assert force * (_PI_OF_PRINT / math.pi) ** 2 == pytest.approx(3262.8, abs=0.05)
    assert force == pytest.approx(3264.1, abs=0.05)
