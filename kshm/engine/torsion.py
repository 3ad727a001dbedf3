"""Inputs of the torsional vibration of the shaft; SI units.

A number that is None is estimated from the rest of the engine.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from kshm.defaults import LOSS_FACTOR
from kshm.engine.checks import NOT_NEGATIVE, POSITIVE, check_numbers, refuse

StiffnessFormula = Literal["wilson", "carter", "zimanenko"]
DamperKind = Literal["viscous", "tuned"]
MAX_MASSES = 20


@dataclass(frozen=True, slots=True)
class TrainMass:
    """A mass of a train given directly.

    ``inertia`` [kg·m²]; ``stiffness`` [N·m/rad] of the shaft to the next mass, of the last
    mass to the ground (0 where it is free); ``diameter`` [m] of that shaft, None that of the
    main journals; ``throw`` counts from 0, None where no rod acts.
    """

    name: str
    inertia: float
    stiffness: float = 0.0
    diameter: float | None = None
    throw: int | None = None

    def __post_init__(self) -> None:
        """Refuse what no mass can be."""
        check_numbers(self, POSITIVE, "inertia", "diameter")
        check_numbers(self, NOT_NEGATIVE, "stiffness")


@dataclass(frozen=True, slots=True)
class Torsion:
    """Train, damping, range of speeds and damper of the torsional vibration.

    Attributes:
        masses: a train given directly; empty: the equivalent train of the engine.
        ground: stiffness from the first mass to the ground [N·m/rad], 0 where it is free.
        pulley: inertia of pulley or damper at the nose [kg·m²].
        throws: inertia of every throw with its rods and pistons [kg·m²].
        flywheel: inertia of the flywheel [kg·m²].
        driven: inertia behind the flywheel [kg·m²], None or 0 where there is none.
        nose_stiffness: pulley to the first throw [N·m/rad].
        throw_stiffness: between neighbouring throws [N·m/rad].
        rear_stiffness: last throw to the flywheel [N·m/rad].
        driven_stiffness: flywheel to the driven side [N·m/rad].
        formula: the formula of the stiffness of a throw.
        shear_modulus: G [Pa].
        main_bore: bore of the main journals [m].
        pin_bore: bore of the crankpins [m].
        web_width: b [m].
        web_thickness: h [m].
        damping: absolute damping at each cylinder [N·m·s/rad].
        loss_factor: η of the shafts, C = η c/ω [-].
        speed_min: least working speed [rad/s].
        speed_max: greatest working speed [rad/s].
        other_flywheel: inertia of a second flywheel to compare with [kg·m²].
        damper: kind of the damper at the first mass.
        damper_inertia: its ring [kg·m²].
        damper_stiffness: its spring [N·m/rad], tuned only.
        damper_damping: its damping [N·m·s/rad].
        peaks: speeds [rad/s] and greatest pressures of the cycle [Pa] there.
    """

    masses: tuple[TrainMass, ...] = ()
    ground: float = 0.0
    pulley: float | None = None
    throws: tuple[float, ...] | None = None
    flywheel: float | None = None
    driven: float | None = None
    nose_stiffness: float | None = None
    throw_stiffness: tuple[float, ...] | None = None
    rear_stiffness: float | None = None
    driven_stiffness: float | None = None
    formula: StiffnessFormula = "wilson"
    shear_modulus: float = 8e10
    main_bore: float = 0.0
    pin_bore: float = 0.0
    web_width: float | None = None
    web_thickness: float | None = None
    damping: float | None = None
    loss_factor: float = LOSS_FACTOR
    speed_min: float | None = None
    speed_max: float | None = None
    other_flywheel: float | None = None
    damper: DamperKind = "viscous"
    damper_inertia: float | None = None
    damper_stiffness: float | None = None
    damper_damping: float | None = None
    peaks: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        """Refuse a train that is none."""
        check_numbers(
            self, POSITIVE, "pulley", "throws", "flywheel", "nose_stiffness", "throw_stiffness",
            "rear_stiffness", "driven_stiffness", "shear_modulus", "web_width", "web_thickness",
            "speed_min", "speed_max", "other_flywheel", "damper_inertia", "damper_stiffness",
        )  # fmt: skip
        check_numbers(
            self, NOT_NEGATIVE, "ground", "driven", "main_bore", "pin_bore", "damping",
            "loss_factor", "damper_damping",
        )  # fmt: skip
        count, speeds = len(self.masses), [speed for speed, _ in self.peaks]
        refuse(
            (count == 1 or count > MAX_MASSES, f"a train has 2 to {MAX_MASSES} masses"),
            (
                any(mass.stiffness == 0 for mass in self.masses[:-1]),
                "a shaft between two masses needs a stiffness",
            ),
            (sorted(set(speeds)) != speeds, "the speeds of the peaks must rise"),
        )
