"""Bore, stroke, speed and pressures of a generated engine."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from kshm.engine.arrangement import rods_beside
from kshm.results.solution import solve
from reports.inputs.firing import arrangement_of
from reports.inputs.reasons import usual_span
from reports.inputs.sections.gas import PolytropicGasSection
from reports.inputs.sections.input_file import InputFile
from reports.inputs.solve_input import refined, solved
from reports.inputs.to_si.engine import to_engine
from reports.inputs.units import number_text
from reports.shared.errors import InputError, Problem

BORES_MM = (10.0, 1000.0)
_STROKE_BORE = (0.8, 1.35)  # S/D that is chosen for a power where one of the two is given
_GAS = (
    "ambient_pressure_mpa", "intake_pressure_mpa", "residual_pressure_mpa", "max_pressure_mpa",
    "compression_exponent", "expansion_exponent", "preexpansion_ratio", "injection_advance_deg",
    "ignition_delay_deg", "exhaust_start_before_bdc_deg", "exhaust_end_after_bdc_deg",
    "scavenge_start_before_bdc_deg",
)  # fmt: skip
_NOISE = 1e-6  # of a tenth of a millimetre
Gas = dict[str, float]
_POWER = "regime.indicated_power_kw"
_ADVICE = "проверьте мощность и частоту, задайте другие размеры или число цилиндров"
_PEAK = (0.75, 1.3)  # p_z/p_c that p_z alone may take, over the usual one
_MIN_PEAK = 1.1  # p_z/p_c of the weakest diagram
_THROTTLED = 0.6  # intake pressure of a spark engine at part load, over the usual one
_BOOSTED_MPA = {"diesel": 0.32, "petrol": 0.3}
_BOOSTED_RHO = {"diesel": 1.7, "petrol": 1.2}
_POWER_TOLERANCE = 1e-5  # of the power
_STEPS = 40


@dataclass(frozen=True, slots=True)
class EngineTask:
    """Task for an engine; None where it says nothing.

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


def usual_for(kind: str, strokes: int, task: EngineTask) -> Usual:
    """Usual values with those of the task; p_z/p_c stays the usual one."""
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
    task: EngineTask, usual: Usual, cylinders: int, strokes: int
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


def _free_bore(task: EngineTask, usual: Usual, box: float | None, strokes: float) -> float:
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


def size_notes(task: EngineTask, usual: Usual, stroke: float, speed: float) -> dict[str, str]:
    """Return notes on the sizes: of the task, usual, to be replaced."""
    pressure = number_text(usual.effective_mpa)
    mean = number_text(round(stroke * speed / 30000, 1))
    advice = "впишите свой" if task.power_kw is None else "свой задают ключом {}"
    remarks = {
        "geometry.bore_mm": (
            task.bore_mm,
            f"при p_e = {pressure} МПа и Sn/30 ≈ {mean} м/с; {advice.format('--bore')}",
        ),
        "geometry.stroke_mm": (
            task.stroke_mm,
            f"обычное S/D = {number_text(usual.stroke_bore)}; {advice.format('--stroke')}",
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
    notes = {
        key: words if value is None else "по заданию" for key, (value, words) in remarks.items()
    }
    notes["gas.max_pressure_mpa"] = f"диаграмма даёт p_e ≈ {pressure} МПа"
    return notes


def _no_such_bore(bore: float, task: EngineTask) -> InputError:
    problem = f"получается диаметр цилиндра {number_text(bore)} мм"
    low, high = (number_text(value) for value in BORES_MM)
    options = (("--bore", task.bore_mm), ("--stroke", task.stroke_mm), ("--power", task.power_kw))
    where = next((option for option, value in options if value is not None), "--speed")
    hint = f"возможно от {low} до {high} мм: задайте другую мощность, частоту или число цилиндров"
    if task.bore_mm is not None or task.stroke_mm is not None:
        hint = f"возможно от {low} до {high} мм"
    return InputError(Problem(where, problem, hint))


def pin_within(model: InputFile, kind: str, bore_mm: float) -> tuple[float, float] | None:
    """Diameter and length [mm] of crankpins that keep the big-end bearings' usual pressure.

    A pin is lengthened first, as far as is usual, then thickened; None where it is large enough,
    the largest usual one where that is not.
    """
    shaft, scalars = model.crankshaft, solved(refined(model)).scalars
    over = max(
        scalars[key] / usual_span(reason, kind)[1]
        for key, reason in (("q_pin_mean", "pin_pressure"), ("q_pin_max", "pin_peak"))
    )
    if over <= 1 or shaft.pin_diameter_mm is None or shaft.pin_length_mm is None:
        return None
    diameter, length = shaft.pin_diameter_mm, shaft.pin_length_mm
    rods = rods_beside(arrangement_of(model), 0)
    longest, area = rods * usual_span("pin_length", kind)[1], over * diameter * length
    thickest = usual_span("pin", kind)[1] * bore_mm
    if area > longest * diameter**2:
        diameter = min(_up(math.sqrt(area / longest)), _down(thickest))
    return diameter, min(_up(area / diameter), _down(longest * diameter))


def _up(value: float) -> float:
    return math.ceil(10 * value - _NOISE) / 10


def _down(value: float) -> float:
    return math.floor(10 * value + _NOISE) / 10


@dataclass(frozen=True, slots=True)
class _Way:
    """Diagrams along a parameter from 0 to 1, and the note on their intake."""

    gas: Callable[[float], Gas]
    words: str = ""


@dataclass(frozen=True, slots=True)
class Pressures:
    """Keys of [gas], the indicated power of [regime] [kW], and notes to both."""

    gas: Gas
    indicated_kw: float
    notes: dict[str, str]


def pressures_for(model: InputFile, power_kw: float, kind: str) -> Pressures:
    """Pressures that give an engine of usual sizes a power.

    Args:
        model: the engine with the usual pressures.
        power_kw: effective power at the engine's speed.
        kind: diesel or petrol.

    Raises:
        InputError: no usual diagram gives the engine such a power.
    """
    efficiency = float(model.regime.mechanical_efficiency)

    def power_of(gas: Gas) -> float:
        section = _polytropic(model).model_copy(update=gas)
        engine = to_engine(model.model_copy(update={"gas": section}))
        return float(solve(engine).scalars["N_i_calc"]) * efficiency

    reach: list[float] = []
    for way in _ways(model, kind):
        low, high = (power_of(way.gas(end)) for end in (0.0, 1.0))
        reach += low, high
        if low <= power_kw <= high:
            part = _root(way, power_of, power_kw, low, high)
            gas = {key: float(f"{value:.5g}") for key, value in way.gas(part).items()}
            words = f"подобрано: диаграмма даёт {number_text(power_kw)} кВт"
            notes = {"gas.max_pressure_mpa": words, _POWER: "N_e/η_м по заданию; сверяет check"}
            usual = _polytropic(model)
            for key in (key for key in gas if gas[key] != getattr(usual, key)):
                notes.setdefault(f"gas.{key}", f"{way.words}: подобрано по мощности")
            return Pressures(gas, round(power_kw / efficiency, 3), notes)
    raise _out_of_reach(power_kw, min(reach), max(reach))


def _ways(model: InputFile, kind: str) -> tuple[_Way, ...]:
    """Ways to reach a power: p_z alone, part load, boost."""
    usual = _polytropic(model)
    ratio = float(model.geometry.compression_ratio)
    peak = usual.max_pressure_mpa / (
        usual.intake_pressure_mpa * ratio**usual.compression_exponent
    )  # fmt: skip

    def diagram(times: float, intake: float, rho: float) -> Gas:
        """Diagram by p_z/p_c and p_a over the usual ones, and ρ."""
        return {
            "intake_pressure_mpa": usual.intake_pressure_mpa * intake,
            "residual_pressure_mpa": usual.residual_pressure_mpa * intake,
            "max_pressure_mpa": usual.max_pressure_mpa * times * intake,
            "preexpansion_ratio": rho,
        }

    rho, (low, high) = usual.preexpansion_ratio, _PEAK
    least = min(_MIN_PEAK / peak, low)
    throttled = _THROTTLED if kind == "petrol" else 1.0
    boosted = max(_BOOSTED_MPA[kind] / usual.intake_pressure_mpa, 1.0)
    return (
        _Way(lambda t: {"max_pressure_mpa": usual.max_pressure_mpa * _between(low, high, t)}),
        _Way(
            lambda t: diagram(
                _between(least, low, t), _between(throttled, 1.0, t), _between(1.0, rho, t)
            ),
            "частичная нагрузка",
        ),
        _Way(
            lambda t: diagram(
                _between(1.0, low, t),
                _between(1.0, boosted, t),
                _between(rho, _BOOSTED_RHO[kind], t),
            ),
            "наддув",
        ),
    )


def _polytropic(model: InputFile) -> PolytropicGasSection:
    if not isinstance(model.gas, PolytropicGasSection):
        raise TypeError("a made engine has polytropes")
    return model.gas


def _between(first: float, last: float, part: float) -> float:
    return first + (last - first) * part


def _root(
    way: _Way, power_of: Callable[[Gas], float], power: float, low: float, high: float
) -> float:
    """Parameter of a way that gives the wanted power, by a bracketed secant."""
    left, right, below, above = 0.0, 1.0, low - power, high - power
    part = 1.0
    for _ in range(_STEPS):
        part = right - above * (right - left) / ((above - below) or 1.0)
        off = power_of(way.gas(part)) - power
        if abs(off) <= _POWER_TOLERANCE * power:
            break
        # The side that stays counts half, so that both close in.
        if off < 0:
            left, below, above = part, off, above / 2
        else:
            right, above, below = part, off, below / 2
    return part


def _out_of_reach(power_kw: float, low: float, high: float) -> InputError:
    power, bound = power_kw, high if power_kw > high else low
    least_or_most = "не больше" if power_kw > high else "не меньше"
    problem = (
        f"задано {number_text(power)} кВт, а при этих размерах и частоте обычные давления дают "
        f"{least_or_most} {number_text(float(f'{bound:.3g}'))} кВт"
    )
    return InputError(Problem("--power", problem, _ADVICE))
