"""Checks of the [torsion] section against itself and the shaft."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from kshm.engine.torsion import MOST_MASSES
from reports.inputs.findings import Finding, Values
from reports.inputs.sections.torsion import MassSection
from reports.inputs.units import number_text

# What describes the equivalent train of the engine: a train given directly has none of it.
_EQUIVALENT = (
    "pulley_kg_m2", "throws_kg_m2", "flywheel_kg_m2", "driven_kg_m2", "nose_nm_rad",
    "throws_nm_rad", "rear_nm_rad", "driven_nm_rad", "web_width_mm", "web_thickness_mm",
)  # fmt: skip
_RISING = "по возрастанию"


def check_torsion(values: Values) -> Iterator[Finding]:
    """Yield what contradicts itself about the train and the peaks."""
    if "torsion" not in values.sections:
        return
    angles = values.get("crankshaft", "throw_angles_deg")
    throws = None if angles is None else len(angles)
    masses = values.get("torsion", "masses")
    if masses:
        yield from _train(masses, throws)
        for key in _EQUIVALENT:
            if values.get("torsion", key) is not None:
                what = "схема задана массами, этот ключ к ней не относится"
                yield Finding(("torsion", key), what, "удалите ключ или записи [[torsion.masses]]")
    elif throws is not None:
        yield from _counts(values, throws)
    yield from _peaks(values)


def _train(masses: Sequence[MassSection], throws: int | None) -> Iterator[Finding]:
    if not 2 <= len(masses) <= MOST_MASSES:
        what = f"масс {len(masses)}, а нужно от 2 до {MOST_MASSES}"
        yield Finding(("torsion", "masses"), what, "исправьте записи [[torsion.masses]]")
    for index, mass in enumerate(masses[:-1]):
        if mass.stiffness_nm_rad == 0:
            what = "жёсткость участка между массами не задана"
            hint = "0 допустим только за последней массой"
            yield Finding(("torsion", "masses", index, "stiffness_nm_rad"), what, hint)
    seen: set[float] = set()
    for index, mass in enumerate(masses):
        path = ("torsion", "masses", index, "throw")
        number = mass.throw
        if not number:
            continue
        if number != int(number) or (throws is not None and number > throws):
            upto = f"от 0 до {throws}" if throws is not None else "целое"
            what = f"нет колена {number_text(number)}"
            yield Finding(path, what, f"нужно число {upto}")
        elif number in seen:
            yield Finding(path, f"колено {number_text(number)} названо дважды", "оставьте одно")
        seen.add(number)


def _counts(values: Values, throws: int) -> Iterator[Finding]:
    wanted = {"throws_kg_m2": throws, "throws_nm_rad": throws - 1}
    for key, count in wanted.items():
        found = values.counts.get(("torsion", key))
        if found is not None and found != count:
            what = f"значений {found}, а нужно {count}"
            yield Finding(("torsion", key), what, f"колен {throws}")
    if values.get("torsion", "driven_nm_rad") is not None and (
        values.get("torsion", "driven_kg_m2") is None
    ):
        what = "жёсткость за маховиком задана, а массы за ним нет"
        yield Finding(("torsion", "driven_nm_rad"), what, "задайте driven_kg_m2 или удалите ключ")


def _peaks(values: Values) -> Iterator[Finding]:
    peaks = values.get("torsion", "peaks") or ()
    for index, (before, after) in enumerate(pairwise(peaks), 1):
        if after.speed_rpm <= before.speed_rpm:
            what = f"частота {number_text(after.speed_rpm)} мин⁻¹ не больше предыдущей"
            yield Finding(("torsion", "peaks", index, "speed_rpm"), what, f"запишите {_RISING}")
