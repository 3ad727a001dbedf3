"""Masses of a cylinder as given: rod and piston group, or m_j and m_2; kilograms, metres."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from kshm.engine.checks import NOT_NEGATIVE, POSITIVE, check_numbers

Fuel = Literal["petrol", "diesel"]


@dataclass(frozen=True, slots=True)
class Weighing:
    """Rod with its axis level, the big end on a fixed support [kg], Gots (23)."""

    mass: float
    small_end: float  # what the scale under the piston pin shows


@dataclass(frozen=True, slots=True)
class Swinging:
    """Rod swung on a prism in either bore, Gots (24)-(27); SI, swings in 1/s."""

    mass: float
    swings_small: float  # hung by the small end
    swings_big: float
    bore_radius: float  # r_1 of the small end
    distance: float  # l_3 between the two edges


@dataclass(frozen=True, slots=True)
class Estimate:
    """Entries of table 4; a mass per area [kg/m²] given replaces the table's."""

    fuel: Fuel
    piston_material: Literal["aluminium", "iron"] = "aluminium"
    shaft: Literal["steel", "iron"] = "steel"
    piston_area_mass: float | None = None
    rod_area_mass: float | None = None
    throw_area_mass: float | None = None
    pin_share: float = 0.465


@dataclass(frozen=True, slots=True)
class RodMasses:
    """Masses from which m_j and m_2 follow by the two-mass replacement, Gots (20)."""

    piston_group: float
    rod: float
    centre: float  # l_1: pin axis to the rod's centre of mass [m]
    inertia: float | None = None  # I_ш about the centre of mass [kg·m²], where it is known
    basis: Weighing | Swinging | Estimate | None = None  # what the values were found from

    def __post_init__(self) -> None:
        """Refuse what no mass can be."""
        check_numbers(self, POSITIVE, "piston_group", "rod")


@dataclass(frozen=True, slots=True)
class DirectMasses:
    """Masses m_j and m_2 given as such [kg]."""

    reciprocating: float
    rod_big_end: float

    def __post_init__(self) -> None:
        """Refuse what no mass can be."""
        check_numbers(self, NOT_NEGATIVE, "reciprocating", "rod_big_end")
        check_numbers(self, POSITIVE, "reciprocating")


Masses = DirectMasses | RodMasses
