"""Inputs of the strength of piston, ring, pin, rod, bolts and webs; SI units.

A size that is None is its usual share of another, `kshm.ranges.PART_SHARES`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from kshm.engine.checks import NOT_NEGATIVE, POSITIVE, check_numbers, refuse
from kshm.ranges import PART_SHARES

EngineKind = Literal["petrol", "diesel"]
_ROUNDED = 6  # decimals of a usual share


@dataclass(frozen=True, slots=True)
class Steel:
    """Limits of a part's steel [Pa] and its elasticity.

    ``tensile`` σ_в, ``yielding`` σ_т, ``bending`` σ_−1 and ``pull`` σ_−1р of symmetric cycles;
    ``modulus`` E [Pa]; ``expansion`` α [1/K].
    """

    tensile: float
    yielding: float
    bending: float
    pull: float
    modulus: float
    expansion: float

    def __post_init__(self) -> None:
        """Refuse what no steel can be."""
        check_numbers(self, POSITIVE, "tensile", "yielding", "bending", "pull", "modulus")
        refuse((self.pull >= self.yielding, "a steel endures less than it yields at"))


_STEEL_40H = Steel(980e6, 800e6, 350e6, 300e6, 2.2e11, 1e-5)


@dataclass(frozen=True, slots=True)
class PartStrength:
    """Sizes [m], forms, temperatures [°C], fits, materials and factors of the parts' strength.

    ``speed_factor`` is ω_max/ω; plays of head and skirt are over the bore; ``embedding`` φ_з
    [rad]; concentrations are k/(εε'); ``mean_factor`` is α_σ; ``bolt_preload`` the tightening
    over the load of a bolt, ``bolt_share`` χ.  Other sizes have the names of `PART_SHARES`.
    """

    kind: EngineKind = "diesel"
    crown_form: Literal["full", "quarter"] = "full"
    pin_form: Literal["minus", "plus"] = "minus"
    oval_form: Literal["curved", "program"] = "curved"
    bolt_form: Literal["each", "all"] = "each"
    speed_factor: float = 1.1
    piston_material: Literal["aluminium", "iron"] = "aluminium"
    piston: float | None = None  # piston with rings and pin [kg]
    crown: float | None = None
    height: float | None = None
    skirt: float | None = None
    head_wall: float | None = None
    land: float | None = None
    bosses: float | None = None
    ring_radial: float | None = None
    ring_gap: float | None = None
    ring_play: float = 0.8e-3
    oil_holes: float = 10.0
    oil_hole: float = 1.5e-3
    head_play: float = 0.007
    skirt_play: float = 0.002
    cylinder_temperature: float = 115.0
    head_temperature: float = 250.0
    skirt_temperature: float = 140.0
    ring_modulus: float = 1.0e11
    pin: float | None = None
    pin_bore: float | None = None
    pin_length: float | None = None
    pin_share: float = 0.8
    pin_modulus: float = 2.0e11
    eye_length: float | None = None
    eye_outer: float | None = None
    bush_wall: float | None = None
    bush_fit: float = 40e-6
    bush_warming: float = 110.0
    bush_modulus: float = 1.15e11
    embedding: float = math.radians(110)
    rod_material: Steel = _STEEL_40H
    bolt_material: Steel = _STEEL_40H
    web_material: Steel = _STEEL_40H
    rod_concentration: float = 1.4
    bolt_concentration: float = 4.0
    web_concentration: float = 2.0
    mean_factor: float = 0.2
    shank_height: float | None = None
    shank_width: float | None = None
    shank_web: float | None = None
    shank_flange: float | None = None
    bolts_apart: float | None = None
    cap_length: float | None = None
    shell: float | None = None
    bolts: float = 2.0
    bolt: float | None = None
    bolt_pitch: float = 1e-3
    bolt_preload: float = 2.0
    bolt_share: float = 0.2

    def __post_init__(self) -> None:
        """Refuse sizes that are none."""
        check_numbers(
            self, POSITIVE, *PART_SHARES, "piston", "ring_modulus", "pin_modulus", "bush_modulus",
            "embedding", "bolts", "bolt_pitch", "rod_concentration", "bolt_concentration",
            "web_concentration",
        )  # fmt: skip
        check_numbers(
            self, NOT_NEGATIVE, "ring_play", "oil_holes", "oil_hole", "bush_fit", "mean_factor"
        )

    def sizes(self, bore: float, crankpin: float) -> dict[str, float]:
        """Sizes by name [m], each as given or its usual share of the one that it follows."""
        sizes = {"bore": bore, "crankpin": crankpin}
        for key, (base, petrol, diesel) in PART_SHARES.items():
            low, high = diesel if self.kind == "diesel" else petrol
            size: float | None = getattr(self, key)
            usual = round((low + high) / 2, _ROUNDED) * sizes[base]
            sizes[key] = usual if size is None else size
        return sizes
