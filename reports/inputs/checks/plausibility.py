"""Warnings for values far from those of real engines.

Works on a checked file, so it never judges what is wrong anyway.  Only slips are meant: of
a unit, of a decimal point, of a key.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel

from kshm.engine.arrangement import rods_beside, throws
from reports.inputs.checks import bands
from reports.inputs.checks.bands import BANDS, Band, diesel_rho, stated_kind
from reports.inputs.checks.counterweight import check_counterweight
from reports.inputs.checks.gas import check_indicated, indicated_of
from reports.inputs.checks.layout import check_neighbours, check_one_rod, check_room
from reports.inputs.checks.torsion import train_values
from reports.inputs.fields import Path, key_text
from reports.inputs.findings import Finding, Keys, in_lines
from reports.inputs.firing import arrangement_of
from reports.inputs.sections.gas import CycleGasSection, GasSection, TableGasSection
from reports.inputs.sections.input_file import InputFile, Regime
from reports.inputs.to_si.masses import Sizes
from reports.inputs.units import is_within, number_text

_MAX_OFF = 0.5  # share of the sizes that disagree with the bore when the bore is wrong
# --- a key against its band ---
Tested = tuple[Path, Band, float]


def check_plausibility(
    model: InputFile, sizes: Sizes, accepted: Keys = frozenset()
) -> Iterator[Finding]:
    """Yield a warning for every implausible value.

    What stands for others in one line does so only as far as it is not ``accepted``.
    """
    tested = list(_tested(model, sizes))
    outside = [entry for entry in tested if not entry[1].low <= entry[2] <= entry[1].high]
    off, all_sizes = _of_the_bore(outside), _of_the_bore(tested)
    ratio = list(_stroke(model, sizes))
    found_by_power = getattr(model.geometry, "bore_mm", None) is None
    bore = _wrong_bore(model, sizes, len(off), len(all_sizes))
    wrong_bore = bool(ratio or found_by_power) and len(off) > _MAX_OFF * len(all_sizes)
    if wrong_bore:
        yield bore
        wrong_bore = key_text(bore.path) not in accepted
    if wrong_bore:
        yield from _told([entry for entry in outside if entry not in off], accepted)
    else:
        yield from ratio
        yield from _told(outside, accepted)
    yield from _burning(model)
    yield from _speed(model, sizes)
    yield from _shaft(model, sizes, accepted)
    yield from check_room(model, accepted)
    yield from check_counterweight(model, sizes)
    yield from _efficiency(model)
    yield from _gas(model, model.gas, ())
    yield from check_indicated(model, sizes)
    if not wrong_bore:
        yield from check_neighbours(model, sizes.bore)
        yield from _power(model, model.gas, model.regime, sizes, ())
        for path, band, value in train_values(model, sizes):
            yield from _judged(path, band, value)
    for index in range(len(model.regimes)):
        yield from _lower_regime(model, sizes, index)


def _of_the_bore(entries: list[Tested]) -> list[Tested]:
    return [entry for entry in entries if entry[1].base in ("D", "F", "ΣF")]


def _told(outside: list[Tested], accepted: Keys) -> Iterator[Finding]:
    """Yield findings of the values; equal ones of a list once."""
    alike: dict[tuple[Path, float], list[Tested]] = {}
    for path, band, value in outside:
        key = tuple(part for part in path if isinstance(part, str))
        alike.setdefault((key, value), []).append((path, band, value))
    for entries in alike.values():
        for (path, band, value), *others in in_lines(entries, accepted):
            yield _finding(path, band, value, len(others))


def _tested(model: InputFile, sizes: Sizes) -> Iterator[Tested]:
    kind, area = stated_kind(model), sizes.piston_area
    bases = {
        "": 1.0, "D": sizes.bore, "r": sizes.radius, "L": sizes.rod, "F": area,
        "ΣF": area * max(map(len, throws(arrangement_of(model)))),
        "n": float(model.regime.speed_rpm),
    }  # fmt: skip
    keys_of_kind = {band.key for band in BANDS if band.kind and band.kind == kind}
    for band in BANDS:
        if band.kind not in ("", kind) or (not band.kind and band.key in keys_of_kind):
            continue
        for path, value in values_at(model, band.key):
            if not (band.zero and value == 0):
                over = abs(value) if band.base and band.zero else value
                own_band = band.scaled(sizes.heavier) if band.base.endswith("F") else band
                yield path, own_band, over / bases[band.base]


def values_at(model: InputFile, key: str) -> Iterator[tuple[Path, float]]:
    """Yield the given numbers at a key of the file, one for each entry of its lists."""
    yield from _values(model, key.split("."), ())


def _values(part: Any, keys: list[str], path: Path) -> Iterator[tuple[Path, float]]:  # noqa: ANN401
    if isinstance(part, tuple):
        for index, item in enumerate(part):
            yield from _values(item, keys, (*path, index))
    elif isinstance(part, BaseModel) and keys:
        field = {"lambda": "lambda_"}.get(keys[0], keys[0])
        value = getattr(part, field, None)
        spec = type(part).model_fields.get(field)
        # What the house has chosen itself is no slip of a person.
        if value is not None and spec is not None and value != spec.default:
            yield from _values(value, keys[1:], (*path, keys[0]))
    elif isinstance(part, int | float) and not isinstance(part, bool) and not keys:
        yield path, float(part)


def _finding(path: Path, band: Band, value: float, others: int = 0) -> Finding:
    unit = f" {band.unit}" if band.unit and band.unit != "°" else band.unit
    more = f", в списке таких ещё {others}" if others else ""
    problem = f"{band.words} = {_short(value)}{unit} необычно{more}"
    hint = f"обычно от {_short(band.low)} до {_short(band.high)}{unit} ({band.source})"
    return Finding(path, problem, f"{hint}; проверьте единицу и запятую", warning=True)


def _burning(model: InputFile) -> Iterator[Finding]:
    """Yield the compression ratio of a diesel that only its ρ makes one."""
    ratio, rho = _ratio(model), diesel_rho(model)
    if rho and not is_within(ratio, (bands.DIESEL.low, bands.DIESEL.high)):
        problem = f"ε = {_short(ratio)} необычно для дизеля, о котором говорит ρ = {_short(rho)}"
        span = f"обычно от {_short(bands.DIESEL.low)} до {_short(bands.DIESEL.high)}"
        hint = f"{span}; если двигатель бензиновый, назовите его так в engine.name"
        yield Finding(("geometry", "compression_ratio"), problem, hint, warning=True)


def _short(value: float) -> str:
    return number_text(float(f"{value:.4g}"))


def _judged(path: Path, band: Band, value: float) -> Iterator[Finding]:
    if not is_within(value, (band.low, band.high)):
        yield _finding(path, band, value)


# --- sizes and speeds ---
def _stroke(model: InputFile, sizes: Sizes) -> Iterator[Finding]:
    band = bands.LARGE_SIZES if sizes.bore >= bands.LARGE_BORE_MM else bands.SIZES
    yield from _judged(_stroke_path(model), band, 2 * sizes.radius / sizes.bore)


def _stroke_path(model: InputFile) -> Path:
    for key in ("stroke_mm", "crank_radius_mm", "rod_length_mm"):
        if getattr(model.geometry, key, None) is not None:
            return ("geometry", key)
    return ("cycle", "stroke_bore")


def _wrong_bore(model: InputFile, sizes: Sizes, off: int, tested: int) -> Finding:
    problem = (
        f"D = {_short(sizes.bore)} мм не вяжется с другими данными: S/D = "
        f"{_short(2 * sizes.radius / sizes.bore)}, необычны {off} из {tested} размеров и масс"
    )
    if getattr(model.geometry, "bore_mm", None) is None:
        hint = "диаметр найден по мощности: проверьте её и частоту вращения"
        return Finding(("cycle", "power_kw"), problem, hint, warning=True)
    return Finding(("geometry", "bore_mm"), problem, "проверьте диаметр цилиндра", warning=True)


def _speed(model: InputFile, sizes: Sizes) -> Iterator[Finding]:
    speed = 2 * sizes.radius / 1000 * model.regime.speed_rpm / 30
    yield from _judged(("regime", "speed_rpm"), bands.SPEED, speed)


def _lower_regime(model: InputFile, sizes: Sizes, index: int) -> Iterator[Finding]:
    regime, path = model.regimes[index], ("regimes", index)
    ratio = regime.speed_rpm / model.regime.speed_rpm
    yield from _judged((*path, "speed_rpm"), bands.LOWER_SPEED, ratio)
    if regime.mechanical_efficiency:
        band, value = bands.EFFICIENCY, float(regime.mechanical_efficiency)
        yield from _judged((*path, "mechanical_efficiency"), band, value)
    for key, band in ((band.key.split(".")[-1], band) for band in BANDS if band.base == ""):
        number = getattr(regime.gas, key, None) if band.key.startswith("gas.") else None
        if isinstance(number, int | float) and not (band.zero and number == 0):
            yield from _judged((*path, "gas", key), band, float(number))
    yield from _gas(model, regime.gas, path)
    yield from _power(model, regime.gas, regime, sizes, path)


def _efficiency(model: InputFile) -> Iterator[Finding]:
    law = model.cycle is not None and model.cycle.friction_a_mpa is not None
    if not law:
        path = ("regime", "mechanical_efficiency")
        yield from _judged(path, bands.EFFICIENCY, float(model.regime.mechanical_efficiency))


# --- journals and webs ---
def _shaft(model: InputFile, sizes: Sizes, accepted: Keys) -> Iterator[Finding]:
    pins, mains = _entries(model, bands.PIN_DIAMETERS), _entries(model, bands.MAIN_DIAMETERS)
    rods, one_rod = rods_beside(arrangement_of(model), 0), list(check_one_rod(model, accepted))
    yield from one_rod
    for keys, band, diameters, shared in (
        (() if one_rod else bands.PIN_LENGTHS, bands.PIN_LENGTH, pins, rods),
        (("main_lengths_mm",), bands.MAIN_LENGTH, mains, 1),
    ):
        for index, (path, length) in enumerate(_entries(model, keys)):
            diameter = diameters[min(index, len(diameters) - 1)][1]
            yield from _judged(path, band, length / shared / diameter)
    path, main = max(mains, key=lambda entry: entry[1])
    yield from _judged(path, bands.MAIN_TO_PIN, main / max(pin for _, pin in pins))
    for index, web in enumerate(model.crankshaft.webs):
        if web.actual_mass_kg is None or web.centre_mm is None or web.centre_mm <= 0:
            continue
        reduced = web.actual_mass_kg * web.centre_mm / sizes.radius / sizes.piston_area
        band = bands.REDUCED_WEB.scaled(sizes.heavier)
        yield from _judged(("crankshaft", "webs", index, "centre_mm"), band, reduced)


def _entries(model: InputFile, keys: tuple[str, ...]) -> list[tuple[Path, float]]:
    """Places and sizes of journals [mm], one for all or one for each."""
    return [entry for key in keys for entry in values_at(model, f"crankshaft.{key}")]


# --- pressures and power ---
def _gas(model: InputFile, gas: GasSection, path: Path) -> Iterator[Finding]:
    gas_path = (*path, "gas")
    if isinstance(gas, TableGasSection):
        yield from _points(gas, gas_path)
    elif not isinstance(gas, CycleGasSection):
        yield from _polytropes(gas, _ratio(model), gas_path)
        if not path:
            work = mean_pressure(gas, _ratio(model))
            yield from _judged((*gas_path, "max_pressure_mpa"), bands.MEAN_PRESSURE, work)


def _ratio(model: InputFile) -> float:
    return float(model.geometry.compression_ratio)


def _power(
    model: InputFile, gas: GasSection, regime: Regime, sizes: Sizes, path: Path
) -> Iterator[Finding]:
    """Yield the given power against the work of the diagram."""
    power = regime.indicated_power_kw
    if power is None or isinstance(gas, CycleGasSection):
        return
    if isinstance(gas, TableGasSection):
        work = indicated_of(model, gas, sizes).work
    else:
        work = mean_pressure(gas, _ratio(model))
    where = (*(path or ("regime",)), "indicated_power_kw")
    swept = sizes.piston_area * 2 * sizes.radius / 1000  # m³
    cycles = float(regime.speed_rpm) / 30 / model.engine.strokes * model.engine.cylinders
    needed = power / 1000 / (swept * cycles)  # MPa
    if work > 0:
        yield from _judged(where, bands.POWER, needed / work)
    elif not path:
        yield from _judged(where, bands.MEAN_PRESSURE_OF_POWER, needed)


def _polytropes(gas: Any, ratio: float, path: Path) -> Iterator[Finding]:  # noqa: ANN401
    residual = gas.residual_pressure_mpa / gas.intake_pressure_mpa
    yield from _judged((*path, "residual_pressure_mpa"), bands.RESIDUAL, residual)
    end = gas.intake_pressure_mpa * ratio**gas.compression_exponent
    yield from _judged((*path, "max_pressure_mpa"), bands.RISE, gas.max_pressure_mpa / end)


def mean_pressure(gas: Any, ratio: float) -> float:  # noqa: ANN401
    """p_i [MPa] of the diagram's two polytropes, without pumping and rounding."""
    n_1, n_2, rho = (
        float(value)
        for value in (gas.compression_exponent, gas.expansion_exponent, gas.preexpansion_ratio)
    )
    end = gas.intake_pressure_mpa * ratio**n_1

    def expanded(exponent: float, shrinking: float) -> float:
        if abs(exponent - 1) < 1e-9:
            return -math.log(shrinking)
        return float(1 - shrinking ** (exponent - 1)) / (exponent - 1)

    top = float(gas.max_pressure_mpa)
    gained = top * (rho - 1) + top * rho * expanded(n_2, rho / ratio)
    return float((gained - end * expanded(n_1, 1 / ratio)) / (ratio - 1))


def _points(gas: TableGasSection, path: Path) -> Iterator[Finding]:
    pressures = [float(pressure) for _, pressure in gas.points]
    here = (*path, "points")
    highest = _judged((*here, pressures.index(max(pressures))), bands.POINTS, max(pressures))
    lowest = _judged((*here, pressures.index(min(pressures))), bands.MIN_POINT, min(pressures))
    findings = [*highest, *lowest]
    yield from findings
    named = {finding.path for finding in findings}
    for index in range(1, len(pressures) - 1):
        neighbours = (pressures[index - 1], pressures[index + 1])
        factor = bands.LONE_POINT
        if gas.points[index + 1][0] - gas.points[index - 1][0] > 2 * bands.NEAR_DEG:
            factor = bands.LONE_POINT_FAR
        lone = not min(neighbours) / factor <= pressures[index] <= max(neighbours) * factor
        if lone and (*here, index) not in named:
            problem = f"давление {_short(pressures[index])} МПа выпадает из соседних точек"
            hint = f"рядом {_short(neighbours[0])} и {_short(neighbours[1])} МПа; проверьте запятую"
            yield Finding((*here, index), problem, hint, warning=True)
