"""The engine as frozen dataclasses, SI units throughout, angles in radians."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from kshm.engine.arrangement import Arrangement, ArticulatedRod, in_line

if TYPE_CHECKING:
    from kshm.cycle.run import CycleRun
    from kshm.engine.masses import Estimate, Swinging, Weighing

Method = Literal["textbook", "exact"]


@dataclass(frozen=True, slots=True)
class Geometry:
    """Main dimensions of the crank mechanism [m].

    ``crank_offset`` is how far the cylinder's axis passes the shaft on the side to which
    the crank turns at TDC, ``pin_offset`` how far the piston pin stands from the
    cylinder's axis on the same side, Gots 1.4.  None of both: a central mechanism.
    """

    bore: float
    crank_radius: float
    rod_length: float
    compression_ratio: float
    crank_offset: float | None = None
    pin_offset: float | None = None

    @property
    def lam(self) -> float:
        """Crank radius over rod length λ = r/L [-]."""
        return self.crank_radius / self.rod_length

    @property
    def offset(self) -> float:
        """Distance e of the pin's path from the shaft axis [m]."""
        return (self.crank_offset or 0.0) + (self.pin_offset or 0.0)

    @property
    def is_central(self) -> bool:
        """Whether the mechanism is meant to have no offset, not even one of zero."""
        return self.crank_offset is None and self.pin_offset is None

    @property
    def relative_offset(self) -> float:
        """Relative offset k = e/r [-], Gots 1.4."""
        return self.offset / self.crank_radius

    @property
    def stroke(self) -> float:
        """Piston stroke [m]: 2r, with an offset S_д of Gots (11)."""
        if self.offset == 0:
            return 2 * self.crank_radius
        r, rod, e = self.crank_radius, self.rod_length, self.offset
        return math.sqrt((rod + r) ** 2 - e**2) - math.sqrt((rod - r) ** 2 - e**2)

    @property
    def piston_area(self) -> float:
        """Piston area F [m²]."""
        return math.pi * self.bore**2 / 4


@dataclass(frozen=True, slots=True)
class PolytropicGas:
    """Indicator diagram by polytropes as the program Dinn builds it.

    Pressures are absolute [Pa]; crank angles [rad] are counted from TDC before
    the intake stroke, in a two-stroke engine from the TDC of combustion.  An offset
    moves the dead centres: angles are meant as if these stood at 0, π, 2π, 3π.
    ``scavenge_open`` is used by two-stroke engines only.  ``ignition_advance`` is the
    angle from the start of injection to TDC; ``combustion_start`` the angle at which the
    straight pressure rise begins (φ_c, already delayed).
    """

    p_ambient: float
    p_intake: float
    p_residual: float
    p_max: float
    n_compression: float
    n_expansion: float
    rho: float
    combustion_start: float
    ignition_advance: float
    exhaust_open: float
    exhaust_close: float
    scavenge_open: float = 0.0


@dataclass(frozen=True, slots=True)
class TabulatedGas:
    """Indicator diagram by points: angles [rad], absolute pressures [Pa]; ends repeat."""

    p_ambient: float
    angles: tuple[float, ...]
    pressures: tuple[float, ...]
    smooth: bool = False  # cubics without overshoot instead of straight lines


@dataclass(frozen=True, slots=True)
class RoundedGas:
    """Rounded indicator diagram of a four-stroke engine; absolute Pa, angles [rad].

    ``peak`` is z_д and ``join`` the end of its rounding, both as angles in the cycle;
    ``settle`` is the angle at which the intake pressure is reached.
    """

    p_ambient: float
    p_intake: float
    p_residual: float
    p_max: float
    n_compression: float
    n_expansion: float
    rho: float
    combustion_start: float
    tdc_rise: float  # p_c''/p_c
    peak: float
    peak_share: float  # p_zд/p_z
    join: float
    exhaust_open: float
    exhaust_close: float
    settle: float


Gas = PolytropicGas | TabulatedGas | RoundedGas


@dataclass(frozen=True, slots=True)
class RodMasses:
    """Masses from which m_j and m_2 follow by the two-mass replacement, Gots (20)."""

    piston_group: float
    rod: float
    centre: float  # l_1: pin axis to the rod's centre of mass [m]
    inertia: float | None = None  # I_ш about the centre of mass [kg·m²], where it is known
    basis: Weighing | Swinging | Estimate | None = None  # what the values were found from


@dataclass(frozen=True, slots=True)
class DirectMasses:
    """Masses m_j and m_2 given as such [kg]."""

    reciprocating: float
    rod_big_end: float


Masses = DirectMasses | RodMasses


@dataclass(frozen=True, slots=True)
class Web:
    """One crank web with its counterweight; masses reduced to the crank radius [kg].

    ``angle`` [rad] is measured from the crank direction against rotation,
    ``counterweight_angle`` from the direction opposite the crank in the
    direction of rotation (the reading of Gots (45), (47) that statics gives).
    """

    mass: float
    angle: float = 0.0
    counterweight_mass: float = 0.0
    counterweight_angle: float = 0.0


@dataclass(frozen=True, slots=True)
class Throw:
    """One throw of the crankshaft with the chain of arms of Gots figure 35 [m].

    ``angle`` is γ_i [rad], clockwise from crank 1 seen from the nose.
    """

    angle: float
    arms: tuple[float, float, float, float, float, float]
    left_web: Web
    right_web: Web
    pin_mass: float
    left_web_thickness: float = 0.0
    right_web_thickness: float = 0.0

    @property
    def length(self) -> float:
        """Distance between the middles of the two main journals l [m]."""
        return sum(self.arms) + self.left_web_thickness + self.right_web_thickness


@dataclass(frozen=True, slots=True)
class EndMass:
    """External counterweight beyond an end journal: mass reduced to r [kg], arm [m].

    ``angle`` [rad] is measured from the neighbouring crank: at the nose in the
    direction of rotation, at the rear against it.
    """

    mass: float = 0.0
    angle: float = 0.0
    arm: float = 0.0


@dataclass(frozen=True, slots=True)
class Crankshaft:
    """Crankshaft: throws from the nose, end masses, journal sizes [m]."""

    throws: tuple[Throw, ...]
    nose: EndMass
    rear: EndMass
    pin_diameter: float
    pin_length: float
    main_diameter: float
    main_lengths: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Balancing:
    """What a person chooses for balancing and for the flywheel; SI units."""

    counterweight_share: float = 0.5
    first_shafts_share: float = 0.0
    second_shafts_share: float = 1.0
    suppression: float = 0.5
    shaft_radius: float = 0.02
    irregularity: float = 0.015
    rod_small_end_share: float = 0.275
    rod_mass_factor: float = 1.0
    web_width_share: float = 1.125
    web_thickness_share: float = 0.175


@dataclass(frozen=True, slots=True)
class Regime:
    """A further regime: what differs from the main one; SI units."""

    name: str
    omega: float
    gas: Gas
    mechanical_efficiency: float = 1.0
    indicated_power: float | None = None
    fullness: float = 1.0


@dataclass(frozen=True, slots=True)
class Engine:
    """A piston engine, SI units.

    ``firing_offsets`` are θ_i [rad], one per cylinder, cylinder 1 first.
    ``arrangement`` says where the cylinders stand; empty means in line.
    ``force_offsets`` replaces θ_i for the loads on the main journals only; it
    exists to reproduce the printed table П4.3, whose phases contradict the
    shaft, and is None otherwise.
    """

    geometry: Geometry
    omega: float
    gas: Gas
    masses: Masses
    crankshaft: Crankshaft
    firing_offsets: tuple[float, ...]
    strokes: int = 4
    method: Method = "textbook"
    step_deg: int = 10
    rays: int = 12
    mechanical_efficiency: float = 1.0
    indicated_power: float | None = None  # W, from a cycle calculation
    fullness: float = 1.0  # φ_п: how much the power was rounded down by
    force_offsets: tuple[float, ...] | None = None
    balancing: Balancing = field(default_factory=Balancing)
    name: str = field(default="engine")
    cycle: CycleRun | None = None  # the cycle calculation that the gas comes from
    oil_hole: float | None = None  # angle of the crankpin's oil hole [rad], by the wear if None
    regimes: tuple[Regime, ...] = ()  # further speeds and loads
    reference_lambdas: tuple[float, ...] = ()  # λ of the reference tables, none if not asked for
    reference_angle: float = 0.0  # crank angle of the drawn mechanism [rad]
    arrangement: Arrangement = ()
    articulated: ArticulatedRod | None = None

    def __post_init__(self) -> None:
        """Give an engine without arrangement its cylinders in line."""
        if not self.arrangement:
            object.__setattr__(self, "arrangement", in_line(len(self.firing_offsets)))

    @property
    def is_in_line(self) -> bool:
        """Whether all cylinders stand in one row, each on its own throw."""
        return self.arrangement == in_line(self.cylinders)

    @property
    def is_basic(self) -> bool:
        """Whether this is a four-stroke in-line engine with a central mechanism."""
        return self.is_in_line and self.strokes == 4 and self.geometry.is_central

    @property
    def cylinders(self) -> int:
        """Number of cylinders i."""
        return len(self.firing_offsets)

    @property
    def period(self) -> float:
        """Length of the working cycle [rad]: 4π or 2π."""
        return self.strokes * math.pi

    @property
    def speed_rpm(self) -> float:
        """Rotational speed n [min⁻¹]."""
        return self.omega * 30 / math.pi
