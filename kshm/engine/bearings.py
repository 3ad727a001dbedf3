"""Inputs of bearings, oil and strength of the journals; SI units.

A number that is None is estimated from the journals by a rule.
"""

from __future__ import annotations

from dataclasses import dataclass

from kshm.defaults import (
    FILLET_BENDING,
    FILLET_TORSION,
    HOLE_BENDING,
    HOLE_TORSION,
    MEAN_BENDING,
    MEAN_TORSION,
    SENSITIVITY,
    SIZE_FACTOR,
)
from kshm.engine.checks import NOT_NEGATIVE, POSITIVE, check_numbers, refuse

# Width over diameter beyond which the closed forms of the film have no table behind them.
MIN_WIDTH, MAX_WIDTH = 0.1, 1.0


@dataclass(frozen=True, slots=True)
class Oil:
    """Viscosities at 40 and 100 °C [Pa·s], density [kg/m³], specific heat [J/(kg·K)].

    ``supply`` is its temperature before the bearings [°C], ``pressure`` there [Pa];
    ``temperature`` [°C] in the film, None by the heat balance.
    """

    at_40: float = 0.0935
    at_100: float = 0.0094
    density: float = 850.0
    heat: float = 2100.0
    supply: float = 80.0
    pressure: float = 0.35e6
    temperature: float | None = None

    def __post_init__(self) -> None:
        """Refuse what no oil can be."""
        check_numbers(self, POSITIVE, "at_40", "at_100", "density", "heat", "pressure")
        refuse((self.at_40 < self.at_100, "oil does not thicken when it is heated"))


@dataclass(frozen=True, slots=True)
class Strength:
    """Limits of the material [Pa] and what lessens them [-].

    ``tensile`` σ_в, ``bending`` σ_−1, ``torsion`` τ_−1; ψ_σ and ψ_τ of the mean stress;
    theoretical concentrations at the fillet and at the hole; sensitivity to them; factors of
    size and surface; ``fillet`` [m], None a share of the diameter; ``making`` K of the class
    rule.
    """

    tensile: float = 980e6
    bending: float = 420e6
    torsion: float = 240e6
    mean_bending: float = MEAN_BENDING
    mean_torsion: float = MEAN_TORSION
    fillet_bending: float = FILLET_BENDING
    fillet_torsion: float = FILLET_TORSION
    hole_bending: float = HOLE_BENDING
    hole_torsion: float = HOLE_TORSION
    sensitivity: float = SENSITIVITY
    size: float = SIZE_FACTOR
    surface: float = 1.0
    fillet: float | None = None
    making: float = 1.05

    def __post_init__(self) -> None:
        """Refuse what no material can be."""
        check_numbers(
            self, POSITIVE, "tensile", "bending", "torsion", "fillet_bending", "fillet_torsion",
            "hole_bending", "hole_torsion", "size", "surface", "fillet", "making",
        )  # fmt: skip
        check_numbers(self, NOT_NEGATIVE, "mean_bending", "mean_torsion", "sensitivity")


@dataclass(frozen=True, slots=True)
class Bearings:
    """Clearances, widths, grooves, roughness, oil, strength.

    Attributes:
        pin_clearances: least and largest diametral clearance of the big end [m].
        main_clearances: the same of the main bearings [m].
        pin_width: width of the big-end bearing [m], None the pin's length over its rods.
        main_width: width of the main bearings [m], None the journal's length.
        pin_groove: width of a groove around the big end [m], 0 without.
        main_groove: the same of the main bearings [m].
        hole: diameter of the oil hole [m].
        pin_bore: bore of the crankpins [m].
        main_bore: bore of the main journals [m].
        least_gap: critical film h_кр [m].
        oil: the oil.
        strength: the material.
    """

    pin_clearances: tuple[float | None, float | None] = (None, None)
    main_clearances: tuple[float | None, float | None] = (None, None)
    pin_width: float | None = None
    main_width: float | None = None
    pin_groove: float = 0.0
    main_groove: float = 0.0
    hole: float = 0.005
    pin_bore: float = 0.0
    main_bore: float = 0.0
    least_gap: float = 3e-6
    oil: Oil = Oil()
    strength: Strength = Strength()

    def __post_init__(self) -> None:
        """Refuse what no bearing can be."""
        check_numbers(
            self, POSITIVE, "pin_clearances", "main_clearances", "pin_width", "main_width", "hole",
            "least_gap",
        )  # fmt: skip
        check_numbers(
            self, NOT_NEGATIVE, "pin_groove", "main_groove", "pin_bore", "main_bore"
        )  # fmt: skip
