"""Working cycle of a generated engine: usual data, one of which is chosen by the power."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from reports.inputs.load import load_mapping
from reports.inputs.solve_input import solved
from reports.inputs.units import number_text
from reports.new.sizing import Usual
from reports.shared.errors import InputError, KshmError, Problem

_USUAL: dict[str, dict[str, Any]] = {
    "petrol": {
        "fuel": "petrol", "excess_air": 0.96, "ambient_temperature_k": 293.0,
        "charge_heating_k": 8.0, "residual_temperature_k": 1050.0, "intake_factor": 0.87,
        "exhaust_factor": 1.16, "xi_z": 0.88, "xi_b": 0.92, "fullness": 0.96, "h2_co_ratio": 0.5,
    },
    "diesel": {
        "fuel": "diesel", "excess_air": 1.5, "ambient_temperature_k": 293.0,
        "charge_heating_k": 18.0, "residual_temperature_k": 800.0, "intake_factor": 0.89,
        "exhaust_factor": 1.08, "xi_z": 0.8, "xi_b": 0.87, "fullness": 0.94,
    },
}  # fmt: skip
_TURBO: dict[str, dict[str, float]] = {
    "petrol": {
        "excess_air": 0.92, "charge_heating_k": 6.0, "residual_temperature_k": 1020.0,
        "intake_factor": 0.9, "exhaust_factor": 1.06,
    },
    "diesel": {
        "excess_air": 1.7, "charge_heating_k": 10.0, "residual_temperature_k": 800.0,
        "intake_factor": 0.92, "exhaust_factor": 1.02,
    },
}  # fmt: skip
_COMPRESSOR = {
    "compressor_efficiency": 0.72, "turbine_efficiency": 0.7, "cooler_loss_mpa": 0.005,
}  # fmt: skip
_COOLED_K = 240.0  # times π_к**0.286 − 1: six tenths of the heating in the compressor
_MIN_BOOST, _BOOST = 1.1, {"petrol": 3.2, "diesel": 3.6}  # π_к
_PEAK_MPA, _PEAK_BY_BOOST = 7.6, 0.8  # p_z of a diesel without boost, exponent of its rise by π_к
_GREATEST_PEAK_MPA = 16.0
_STEPS, _CLOSE, _DIGITS = 40, 1e-5, 5
_ROUNDS = 3  # of the temperature of the residual gases
_GAS = ("ambient_pressure_mpa", "exhaust_start_before_bdc_deg", "exhaust_end_after_bdc_deg")
_IGNITION = {"injection_advance_deg": 25.0, "ignition_delay_deg": 15.0}  # with the rounded cycle
Keys = dict[str, Any]


@dataclass(frozen=True, slots=True)
class NewCycle:
    """Sections [gas] and [cycle], notes by «section.key»."""

    gas: Keys
    cycle: Keys
    notes: dict[str, str]


@dataclass(frozen=True, slots=True)
class _CycleWay:
    """A key of [cycle] between the values of the least and the greatest power."""

    key: str
    least: float
    most: float
    further: Callable[[float], Keys]
    words: str

    def keys(self, part: float) -> Keys:
        """Return the keys at a share of the way."""
        value = self.least + (self.most - self.least) * part
        return self.further(value) | {self.key: float(f"{value:.{_DIGITS}g}")}


def cycle_for(data: Mapping[str, Any], usual: Usual, kind: str, power_kw: float | None) -> NewCycle:
    """Working cycle that gives an engine its power, usual data where none is asked for.

    Raises:
        KshmError: a two-stroke engine.
        InputError: no usual cycle gives the engine such a power.
    """
    if data["engine"]["strokes"] != 4:
        raise KshmError("--cycle: рассчитывается только четырёхтактный цикл; уберите ключ")
    gas = {"source": "cycle", **{key: usual.gas[key] for key in _GAS}, **_IGNITION}
    base = {"kind": kind, **_USUAL[kind]}
    if kind == "diesel":
        base["max_pressure_mpa"] = _PEAK_MPA

    def settled(keys: Keys) -> tuple[Keys, float]:
        """Return the keys with the temperature that the residual gases have, and the power."""
        keys = base | keys
        for _ in range(_ROUNDS):
            scalars = solved(load_mapping({**data, "gas": gas, "cycle": keys}, source="").model)
            keys["residual_temperature_k"] = round(float(scalars.scalars["cyc_T_r_check"]))
        return keys, float(scalars.scalars["cyc_N_e"])

    if power_kw is None:
        return NewCycle(gas, settled({})[0], {})
    reach: list[float] = []
    for way in _ways(kind):
        low, high = (settled(way.keys(part))[1] for part in (0.0, 1.0))
        reach += low, high
        if low <= power_kw <= high:
            part = _root(lambda part, way=way: settled(way.keys(part))[1], power_kw)  # type: ignore[misc]
            words = f"{way.words}: по мощности {number_text(power_kw)} кВт"
            return NewCycle(gas, settled(way.keys(part))[0], {f"cycle.{way.key}": words})
    span = f"обычный цикл даёт от {number_text(round(min(reach), 1))}"
    span += f" до {number_text(round(max(reach), 1))} кВт"
    problem = f"мощность {number_text(power_kw)} кВт с такими размерами не получить; {span}"
    raise InputError(Problem("--power", problem, "задайте другие размеры, частоту или цилиндры"))


def _ways(kind: str) -> tuple[_CycleWay, ...]:
    """Ways to reach a power: the charge alone, then boost."""
    boosted = _CycleWay(
        "boost_ratio", _MIN_BOOST, _BOOST[kind], lambda ratio: _turbo(kind, ratio), "наддув"
    )
    if kind == "diesel":
        return _CycleWay("excess_air", 2.6, 1.35, lambda _: {}, "подача топлива"), boosted
    return _CycleWay("intake_factor", 0.7, 0.92, lambda _: {}, "наполнение"), boosted


def _turbo(kind: str, ratio: float) -> Keys:
    drop = round(_COOLED_K * (ratio**0.286 - 1), 1)
    keys: Keys = {**_TURBO[kind], **_COMPRESSOR, "cooler_drop_k": drop}
    if kind == "diesel":
        peak = min(_PEAK_MPA * ratio**_PEAK_BY_BOOST, _GREATEST_PEAK_MPA)
        keys["max_pressure_mpa"] = round(peak, 2)
    return keys


def _root(power: Callable[[float], float], goal: float) -> float:
    """Return the share of a way at which the power is the one asked for, by halving."""
    low, high = 0.0, 1.0
    for _ in range(_STEPS):
        middle = (low + high) / 2
        value = power(middle)
        if abs(value - goal) <= _CLOSE * goal:
            return middle
        low, high = (middle, high) if value < goal else (low, middle)
    return (low + high) / 2
