"""What a crankshaft's torsional train cannot well be: inertias, stiffnesses, damping of throws.

Pulleys, couplings and flywheels differ by more than slips do, so they are left alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from reports.inputs.checks import bands
from reports.inputs.checks.bands import Band
from reports.inputs.findings import Path
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.torsion import TorsionSection
from reports.inputs.to_si.geometry import Sizes
from reports.inputs.units import MPA

_SPACING = 1.25  # of cylinders, in bores, from memory: the length that twists
_PATH = ("torsion",)
Entry = tuple[Path, float]


def train_values(model: InputFile, sizes: Sizes) -> Iterator[tuple[Path, Band, float]]:
    """Values of the train over those of a shaft of this size, each with its band."""
    section = model.torsion
    if section is None:
        return
    rods = model.engine.cylinders / len(model.crankshaft.throw_angles_deg)
    area_r2 = sizes.piston_area * (sizes.radius / 1000) ** 2
    usual = bands.THROW_INERTIA.scaled(sizes.heavier)
    for path, inertia in _inertias(section):
        yield path, usual, inertia / (rods * area_r2)
    twisted = _shaft_stiffness(model, section, sizes)
    for path, stiffness in _stiffnesses(section):
        yield path, bands.THROW_STIFFNESS, stiffness / twisted
    if section.damping_nms_rad:
        path = (*_PATH, "damping_nms_rad")
        usual = bands.DAMPING.scaled(sizes.heavier)
        yield path, usual, section.damping_nms_rad / (1000 * area_r2)


def _inertias(section: TorsionSection) -> Iterator[Entry]:
    for index, given in enumerate(section.throws_kg_m2 or ()):
        yield (*_PATH, "throws_kg_m2", index), given
    for index, mass in enumerate(section.masses):
        if mass.throw:
            yield (*_PATH, "masses", index, "inertia_kg_m2"), mass.inertia_kg_m2


def _stiffnesses(section: TorsionSection) -> Iterator[Entry]:
    """Stiffnesses of the shaft from throw to throw, and of its own ends [N·m/rad]."""
    for index, given in enumerate(section.throws_nm_rad or ()):
        yield (*_PATH, "throws_nm_rad", index), given
    for key in ("nose_nm_rad", "rear_nm_rad"):
        if (end := getattr(section, key)) is not None:
            yield (*_PATH, key), end
    for index, mass in enumerate(section.masses[:-1]):
        if mass.throw and section.masses[index + 1].throw:
            yield (*_PATH, "masses", index, "stiffness_nm_rad"), mass.stiffness_nm_rad


def _shaft_stiffness(model: InputFile, section: TorsionSection, sizes: Sizes) -> float:
    """GI_p/l of a plain shaft of the main journals between two cylinders [N·m/rad]."""
    shaft = model.crankshaft
    given = shaft.main_diameters_mm or (shaft.main_diameter_mm or 0.0,)
    mean = sum(given) / len(given) / 1000
    modulus = MPA.to_si(section.shear_modulus_mpa)
    return modulus * math.pi * mean**4 / 32 / (_SPACING * sizes.bore / 1000)
