"""Checks of the [torsion] section: its lists, and the train against the shaft."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

from kshm.engine.torsion import MAX_MASSES
from reports.inputs.checks import bands
from reports.inputs.checks.bands import Band
from reports.inputs.fields import Path
from reports.inputs.findings import Finding, ValidValues
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.torsion import MassSection, TorsionSection
from reports.inputs.to_si.masses import Sizes
from reports.inputs.units import MPA, number_text

# What describes the equivalent train of the engine: a train given directly has none of it.
_EQUIVALENT = (
    "pulley_kg_m2", "throws_kg_m2", "flywheel_kg_m2", "driven_kg_m2", "nose_nm_rad",
    "throws_nm_rad", "rear_nm_rad", "driven_nm_rad", "web_width_mm", "web_thickness_mm",
)  # fmt: skip
_RISING = "по возрастанию"
_SPACING = 1.25  # of cylinders, in bores, from memory: the length that twists
_PATH = ("torsion",)
Entry = tuple[Path, float]


def check_torsion(values: ValidValues) -> Iterator[Finding]:
    """Yield contradictions in the train and the peaks."""
    if "torsion" not in values.sections:
        return
    angles = values.get("crankshaft", "throw_angles_deg")
    throws = None if angles is None else len(angles)
    masses = values.get("torsion", "masses")
    if masses:
        yield from _train(masses, throws)
        for key in _EQUIVALENT:
            if values.get("torsion", key) is not None:
                problem = "схема задана массами, этот ключ к ней не относится"
                yield Finding(
                    ("torsion", key), problem, "удалите ключ или записи [[torsion.masses]]"
                )
    elif throws is not None:
        yield from _counts(values, throws)
    yield from _peaks(values)


def _train(masses: Sequence[MassSection], throws: int | None) -> Iterator[Finding]:
    if not 2 <= len(masses) <= MAX_MASSES:
        problem = f"масс {len(masses)}, а нужно от 2 до {MAX_MASSES}"
        yield Finding(("torsion", "masses"), problem, "исправьте записи [[torsion.masses]]")
    for index, mass in enumerate(masses[:-1]):
        if mass.stiffness_nm_rad == 0:
            problem = "жёсткость участка между массами не задана"
            hint = "0 допустим только за последней массой"
            yield Finding(("torsion", "masses", index, "stiffness_nm_rad"), problem, hint)
    seen: set[float] = set()
    for index, mass in enumerate(masses):
        path = ("torsion", "masses", index, "throw")
        number = mass.throw
        if not number:
            continue
        if number != int(number) or (throws is not None and number > throws):
            upto = f"от 0 до {throws}" if throws is not None else "целое"
            problem = f"нет колена {number_text(number)}"
            yield Finding(path, problem, f"нужно число {upto}")
        elif number in seen:
            yield Finding(path, f"колено {number_text(number)} названо дважды", "оставьте одно")
        seen.add(number)


def _counts(values: ValidValues, throws: int) -> Iterator[Finding]:
    required = {"throws_kg_m2": throws, "throws_nm_rad": throws - 1}
    for key, count in required.items():
        written = values.counts.get(("torsion", key))
        if written is not None and written != count:
            problem = f"значений {written}, а нужно {count}"
            yield Finding(("torsion", key), problem, f"колен {throws}")
    if values.get("torsion", "driven_nm_rad") is not None and (
        values.get("torsion", "driven_kg_m2") is None
    ):
        problem = "жёсткость за маховиком задана, а массы за ним нет"
        yield Finding(
            ("torsion", "driven_nm_rad"), problem, "задайте driven_kg_m2 или удалите ключ"
        )


def _peaks(values: ValidValues) -> Iterator[Finding]:
    peaks = values.get("torsion", "peaks") or ()
    for index, (before, after) in enumerate(pairwise(peaks), 1):
        if after.speed_rpm <= before.speed_rpm:
            problem = f"частота {number_text(after.speed_rpm)} мин⁻¹ не больше предыдущей"
            yield Finding(("torsion", "peaks", index, "speed_rpm"), problem, f"запишите {_RISING}")


def train_values(model: InputFile, sizes: Sizes) -> Iterator[tuple[Path, Band, float]]:
    """Values of the train over those of a shaft of this size, with their bands."""
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
    for index, inertia in enumerate(section.throws_kg_m2 or ()):
        yield (*_PATH, "throws_kg_m2", index), inertia
    for index, mass in enumerate(section.masses):
        if mass.throw:
            yield (*_PATH, "masses", index, "inertia_kg_m2"), mass.inertia_kg_m2


def _stiffnesses(section: TorsionSection) -> Iterator[Entry]:
    """Stiffnesses of the shaft from throw to throw, and of its own ends [N·m/rad]."""
    for index, stiffness in enumerate(section.throws_nm_rad or ()):
        yield (*_PATH, "throws_nm_rad", index), stiffness
    for key in ("nose_nm_rad", "rear_nm_rad"):
        if (end := getattr(section, key)) is not None:
            yield (*_PATH, key), end
    for index, mass in enumerate(section.masses[:-1]):
        if mass.throw and section.masses[index + 1].throw:
            yield (*_PATH, "masses", index, "stiffness_nm_rad"), mass.stiffness_nm_rad


def _shaft_stiffness(model: InputFile, section: TorsionSection, sizes: Sizes) -> float:
    """GI_p/l of a plain shaft of the main journals between two cylinders [N·m/rad]."""
    shaft = model.crankshaft
    diameters = shaft.main_diameters_mm or (shaft.main_diameter_mm or 0.0,)
    mean = sum(diameters) / len(diameters) / 1000
    modulus = MPA.to_si(section.shear_modulus_mpa)
    return modulus * math.pi * mean**4 / 32 / (_SPACING * sizes.bore / 1000)
