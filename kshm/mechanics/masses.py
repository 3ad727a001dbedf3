"""Moving masses that stand for rod, piston group and throw, Gots 2.2 and 2.3."""

from __future__ import annotations

from kshm.engine.arrangement import throws as throws_of
from kshm.engine.crankshaft import Throw
from kshm.engine.engine import Engine
from kshm.engine.masses import DirectMasses, Masses


def two_mass_rod(rod: float, centre: float, length: float) -> tuple[float, float]:
    """Masses m_1 (piston pin) and m_2 (crankpin) replacing the rod [kg], Gots (20).

    Args:
        rod: rod mass [kg].
        centre: l_1, distance from the piston pin to the centre of mass [m].
        length: rod length l [m].
    """
    big_end = rod * centre / length
    return rod - big_end, big_end


def point_masses(masses: Masses, rod_length: float) -> tuple[float, float]:
    """Reciprocating mass m_j and rotating rod mass m_2 [kg], Gots 2.2, (20), (22)."""
    if isinstance(masses, DirectMasses):
        return masses.reciprocating, masses.rod_big_end
    small_end, big_end = two_mass_rod(masses.rod, masses.centre, rod_length)
    return masses.piston_group + small_end, big_end


def throw_mass(throw: Throw) -> float:
    """Unbalanced mass of a throw without counterweights m_к [kg], Gots (28).

    The web masses are already reduced to the crank radius.
    """
    return throw.pin_mass + throw.left_web.mass + throw.right_web.mass


def rotating_mass(engine: Engine) -> float:
    """Rotating mass of the first throw with its rods m_r = m_к + Σm_2 [kg], Gots (29).

    Rods on one pin count each; an articulated rod hangs on its master and does not.
    """
    _, big_end = point_masses(engine.masses, engine.geometry.rod_length)
    places = engine.arrangement
    rods = sum(places[i].master is None for i in throws_of(places)[0])
    return throw_mass(engine.crankshaft.throws[0]) + rods * big_end
