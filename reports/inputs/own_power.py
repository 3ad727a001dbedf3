"""Pressures with which a made engine has the power that was asked for.

The power is that of the engine solved as its report does it.  Each way changes the diagram of the
usual engine along one number from 0 to 1, along which the power grows: first p_z alone, then less
heat at part load, or boost.  The bounds are usual ones, from memory.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from kshm.results.solution import solve
from reports.inputs.sections.gas import PolytropicGasSection
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.engine import to_engine
from reports.inputs.units import number_text
from reports.shared.errors import InputError, Problem

Gas = dict[str, float]
_POWER = "regime.indicated_power_kw"
_ADVICE = "проверьте мощность и частоту, задайте другие размеры или число цилиндров"
_PEAK = (0.75, 1.3)  # p_z/p_c that p_z alone may take, over the usual one
_LEAST_PEAK = 1.1  # p_z/p_c of the weakest diagram
_THROTTLED = 0.6  # intake pressure of a spark engine at part load, over the usual one
_BOOSTED_MPA = {"diesel": 0.32, "petrol": 0.3}
_BOOSTED_RHO = {"diesel": 1.7, "petrol": 1.2}
_CLOSE = 1e-5  # of the power
_STEPS = 40


@dataclass(frozen=True, slots=True)
class _Way:
    """Diagrams along a number from 0 to 1, and what the file says of their intake."""

    gas: Callable[[float], Gas]
    words: str = ""


@dataclass(frozen=True, slots=True)
class Pressures:
    """Keys of [gas], the indicated power of [regime] [kW], and notes to both."""

    gas: Gas
    indicated_kw: float
    notes: dict[str, str]


def pressures_for(model: InputFile, power_kw: float, kind: str) -> Pressures:
    """Pressures with which an engine of usual ones has a power.

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
    """By p_z alone, at part load, with boost."""
    usual = _polytropic(model)
    ratio = float(model.geometry.compression_ratio)
    peak = usual.max_pressure_mpa / (
        usual.intake_pressure_mpa * ratio**usual.compression_exponent
    )  # fmt: skip

    def diagram(times: float, intake: float, rho: float) -> Gas:
        """Of p_z/p_c and p_a over the usual ones, and ρ."""
        return {
            "intake_pressure_mpa": usual.intake_pressure_mpa * intake,
            "residual_pressure_mpa": usual.residual_pressure_mpa * intake,
            "max_pressure_mpa": usual.max_pressure_mpa * times * intake,
            "preexpansion_ratio": rho,
        }

    rho, (low, high) = usual.preexpansion_ratio, _PEAK
    least = min(_LEAST_PEAK / peak, low)
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
    way: _Way, power_of: Callable[[Gas], float], wanted: float, low: float, high: float
) -> float:
    """Where along a way the power is the wanted one, by the secant held between both sides."""
    left, right, below, above = 0.0, 1.0, low - wanted, high - wanted
    part = 1.0
    for _ in range(_STEPS):
        part = right - above * (right - left) / ((above - below) or 1.0)
        off = power_of(way.gas(part)) - wanted
        if abs(off) <= _CLOSE * wanted:
            break
        # The side that stays counts half, so that both close in.
        if off < 0:
            left, below, above = part, off, above / 2
        else:
            right, above, below = part, off, below / 2
    return part


def _out_of_reach(power_kw: float, low: float, high: float) -> InputError:
    asked, near = power_kw, high if power_kw > high else low
    least_or_most = "не больше" if power_kw > high else "не меньше"
    what = (
        f"задано {number_text(asked)} кВт, а при этих размерах и частоте обычные давления дают "
        f"{least_or_most} {number_text(float(f'{near:.3g}'))} кВт"
    )
    return InputError(Problem("--power", what, _ADVICE))
