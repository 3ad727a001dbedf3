"""Bore, stroke and speed of a made engine: those of the task, the rest of usual ratios."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from reports.inputs.units import number_text
from reports.shared.errors import InputError, Problem

BORES_MM = (20.0, 1000.0)
_STROKE_BORE = (0.8, 1.35)  # S/D that is chosen for a power where one of the two is given


@dataclass(frozen=True, slots=True)
class Task:
    """What a task says of an engine; None where it says nothing.

    Attributes:
        power_kw: effective power.
        speed_rpm: its speed.
        bore_mm: bore.
        stroke_mm: stroke.
        rod_mm: length of the rod.
        lambda_: r/L in place of that length.
        compression: compression ratio.
        efficiency: mechanical efficiency.
    """

    power_kw: float | None = None
    speed_rpm: float | None = None
    bore_mm: float | None = None
    stroke_mm: float | None = None
    rod_mm: float | None = None
    lambda_: float | None = None
    compression: float | None = None
    efficiency: float | None = None


@dataclass(frozen=True, slots=True)
class Usual:
    """An engine without its size.

    Attributes:
        gas: keys of [gas]: polytropes that give ``effective_mpa``.
        ratio: compression ratio.
        stroke_bore: S/D.
        lam: λ = r/L.
        efficiency: mechanical efficiency.
        effective_mpa: mean effective pressure that the diagram gives; a test holds it.
        piston_speed: Sn/30 at the rated speed [m/s].
        bore_mm: bore where neither power nor speed is given.
    """

    gas: dict[str, float]
    ratio: float
    stroke_bore: float
    lam: float
    efficiency: float
    effective_mpa: float
    piston_speed: float
    bore_mm: float


_GAS = (
    "ambient_pressure_mpa", "intake_pressure_mpa", "residual_pressure_mpa", "max_pressure_mpa",
    "compression_exponent", "expansion_exponent", "preexpansion_ratio", "injection_advance_deg",
    "ignition_delay_deg", "exhaust_start_before_bdc_deg", "exhaust_end_after_bdc_deg",
    "scavenge_start_before_bdc_deg",
)  # fmt: skip


def _gas(*values: float) -> dict[str, float]:
    return dict(zip(_GAS, values, strict=False))


USUAL: dict[tuple[str, int], Usual] = {
    ("petrol", 4): Usual(
        _gas(0.1, 0.085, 0.115, 6.2, 1.37, 1.25, 1.1, 30, 12, 55, 25),
        9.5, 0.95, 0.28, 0.8, 0.81, 13.0, 82.0,
    ),
    ("diesel", 4): Usual(
        _gas(0.1, 0.09, 0.11, 7.8, 1.37, 1.26, 1.27, 24, 14, 56, 25),
        16.5, 1.15, 0.27, 0.78, 0.645, 9.0, 105.0,
    ),
    ("petrol", 2): Usual(
        _gas(0.115, 0.11, 0.12, 4.3, 1.33, 1.28, 1.05, 28, 10, 78, 70, 60),
        8.2, 1.0, 0.26, 0.85, 0.557, 12.0, 66.0,
    ),
    ("diesel", 2): Usual(
        _gas(0.1, 0.12, 0.125, 7.8, 1.36, 1.27, 1.2, 18, 8, 80, 60, 48),
        16.0, 1.15, 0.26, 0.8, 0.603, 8.0, 108.0,
    ),
}  # fmt: skip


def usual_for(kind: str, strokes: int, task: Task) -> Usual:
    """The usual values with what the task says of the cycle; p_z/p_c stays the usual one."""
    usual = USUAL[kind, strokes]
    ratio, efficiency = task.compression or usual.ratio, task.efficiency or usual.efficiency
    gas, grown = usual.gas, (ratio / usual.ratio) ** usual.gas["compression_exponent"]
    if task.compression is not None:
        gas = gas | {"max_pressure_mpa": round(gas["max_pressure_mpa"] * grown, 3)}
    effective = usual.effective_mpa * efficiency / usual.efficiency
    return replace(
        usual, gas=gas, ratio=ratio, efficiency=efficiency, effective_mpa=round(effective, 3)
    )


def main_sizes(
    task: Task, usual: Usual, cylinders: int, strokes: int
) -> tuple[float, float, float]:
    """Bore, stroke [mm] and speed [min⁻¹]; what is given stays to its last digit.

    Raises:
        InputError: the bore would be none that can be.
    """
    bore, stroke, speed = task.bore_mm, task.stroke_mm, task.speed_rpm
    free, ratio = bore is None and stroke is None, usual.stroke_bore
    box = _box(task.power_kw, speed, usual, strokes * 30 / cylinders)
    if free:
        bore = round(_free_bore(task, usual, box, strokes / cylinders), 1)
    elif box is not None:
        bore, stroke = _shared(bore, stroke, box)
    if bore is None:
        bore = round((stroke or 0.0) / ratio, 1)
    if not BORES_MM[0] <= bore <= BORES_MM[1]:
        raise _no_such_bore(bore, task)
    stroke = stroke or round(bore * ratio, 1)
    if speed is None:
        fast = usual.piston_speed * 30000 / stroke
        step = 50 if fast > 1000 else 5
        speed = max(step * round(fast / step), step)
        if free and task.power_kw is not None:  # the rounded speed gives the same power
            box = _box(task.power_kw, speed, usual, strokes * 30 / cylinders) or 0.0
            bore = round((box / ratio) ** (1 / 3), 1)
            stroke = round(bore * ratio, 1)
    return bore, stroke, speed


def _box(power_kw: float | None, speed: float | None, usual: Usual, strokes: float) -> float | None:
    """D²S [mm³] that gives a power with the usual pressure, N_e = p_e·V·n/(30τ)."""
    if power_kw is None or speed is None:
        return None
    return 4 / math.pi * power_kw * 1e6 * strokes / (usual.effective_mpa * speed)


def _free_bore(task: Task, usual: Usual, box: float | None, strokes: float) -> float:
    """Bore of a task without sizes [mm]."""
    if box is not None:
        return float((box / usual.stroke_bore) ** (1 / 3))
    if task.power_kw is not None:  # N_e = p_e·F·c_m·i/τ
        area = task.power_kw * 1000 * strokes / (usual.effective_mpa * usual.piston_speed)
        return math.sqrt(4 * area / math.pi)
    if task.speed_rpm is not None:
        return usual.piston_speed * 30000 / task.speed_rpm / usual.stroke_bore
    return usual.bore_mm


def _shared(
    bore: float | None, stroke: float | None, box: float
) -> tuple[float | None, float | None]:
    """Bore and stroke [mm]: the one that is not given from D²S, within usual bounds of S/D."""
    low, high = _STROKE_BORE
    if bore is None and stroke is not None:
        bore = round(min(max(math.sqrt(box / stroke), stroke / high), stroke / low), 1)
    elif stroke is None and bore is not None:
        stroke = round(min(max(box / bore**2, low * bore), high * bore), 1)
    return bore, stroke


def size_notes(task: Task, usual: Usual, stroke: float, speed: float) -> dict[str, str]:
    """What the file says of its first values: of the task, usual, to be replaced."""
    pressure = number_text(usual.effective_mpa)
    mean = number_text(round(stroke * speed / 30000, 1))
    own = "впишите свой" if task.power_kw is None else "свой задают ключом {}"
    found = {
        "geometry.bore_mm": (
            task.bore_mm,
            f"при p_e = {pressure} МПа и Sn/30 ≈ {mean} м/с; {own.format('--bore')}",
        ),
        "geometry.stroke_mm": (
            task.stroke_mm,
            f"обычное S/D = {number_text(usual.stroke_bore)}; {own.format('--stroke')}",
        ),
        "geometry.rod_length_mm": (task.rod_mm, f"обычное λ = {number_text(usual.lam)}"),
        "geometry.lambda": (task.lambda_, ""),
        "geometry.compression_ratio": (task.compression, ""),
        "regime.mechanical_efficiency": (task.efficiency, "обычное"),
        "regime.speed_rpm": (
            task.speed_rpm,
            f"обычная: средняя скорость поршня {number_text(usual.piston_speed)} м/с",
        ),
    }
    notes = {key: words if value is None else "по заданию" for key, (value, words) in found.items()}
    notes["gas.max_pressure_mpa"] = f"диаграмма даёт p_e ≈ {pressure} МПа"
    return notes


def _no_such_bore(bore: float, task: Task) -> InputError:
    what = f"получается диаметр цилиндра {number_text(bore)} мм"
    low, high = (number_text(value) for value in BORES_MM)
    given = (("--bore", task.bore_mm), ("--stroke", task.stroke_mm), ("--power", task.power_kw))
    where = next((option for option, value in given if value is not None), "--speed")
    hint = f"возможно от {low} до {high} мм: задайте другую мощность, частоту или число цилиндров"
    if task.bore_mm is not None or task.stroke_mm is not None:
        hint = f"возможно от {low} до {high} мм"
    return InputError(Problem(where, what, hint))
