"""Angles of a recorded diagram that are none: turns, radians, times, numbers of samples."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence

import numpy as np

from kshm.arrays import Array
from reports.inputs.units import number_text

WIDEST_GAP_DEG = 45.0  # between points of a diagram
_MIN_ALIKE = 0.5  # correlation of a cycle with the first one
_TIMES = {"секунды": 1.0, "миллисекунды": 1e3, "микросекунды": 1e6}
_BEFORE, _END = r"(^|[\[(,/]\s*)", r"\.?\s*[\])]*$"
_HEADS = {
    "время": re.compile(
        rf"^(time|время)\b|(^|[\[(,/]\s*)(s|sec|с|сек|ms|мс|us|µs|мкс){_END}", re.I
    ),
    "радианы": re.compile(rf"(^|[\[(,/]\s*)(rad|рад|радианы){_END}", re.I),
}
_MENDS = {
    "радианы": "нужны градусы: умножьте на 57,29578",
    "обороты": "нужны градусы: умножьте на 360",
    "номера отсчётов": "нужны градусы: угол = начало + шаг · номер",
}
_TIME_MEND = "нужны градусы: угол = 6 · n · t, n в мин⁻¹, t в секундах"
Fault = tuple[str, str]  # what, how to mend it


def is_several(angles: Array, period: float) -> bool:
    """Whether angles span more than one cycle."""
    return float(np.ptp(angles)) > period + 1e-6


def angles_fault(
    angles: Array, pressures: Array, heads: Sequence[str], period: float, speed_rpm: float | None
) -> Fault | None:
    """Why the numbers, shape (rows,), are no angles of a whole cycle [deg]; None if they may be."""
    for unit, pattern in _HEADS.items():
        head = next((head for head in heads if pattern.search(head)), None)
        if head is not None:
            return f"в столбце угла {unit} («{head}»)", _MENDS.get(unit, _TIME_MEND)
    turns = _turns(angles, period)
    if turns is not None:
        return turns
    falls = np.flatnonzero(np.diff(angles) < -0.5 * np.ptp(angles))
    part = angles[: falls[0] + 1] if falls.size else angles  # a recorder may begin each cycle anew
    if len(part) < 2 or not np.ptp(part):
        return None
    span = f"от {_short(part.min())} до {_short(part.max())}"
    step = float(np.median(np.abs(np.diff(part))))
    whole = float(np.ptp(part)) + step
    counted = bool((np.diff(part) == 1).all())
    if whole < period - WIDEST_GAP_DEG:
        if counted and part[0] in (0, 1):
            problem = f"углы идут {span} через 1: это номера отсчётов или один оборот"
            return problem, f"нужны градусы за цикл {number_text(period)}°"
        unit = next(_units(whole, step, period, speed_rpm), "")
        if not unit and whole < 10 and speed_rpm and 0.5 < whole * 6 * speed_rpm / period < 100:
            unit = "секунды"
        if unit:
            return f"углы идут {span}: похоже на {unit}", _MENDS.get(unit, _TIME_MEND)
        if whole < 10:
            return f"углы идут {span}: это не градусы", f"нужен цикл {number_text(period)}°"
        return None
    if not is_several(part, period):
        return None
    if step < WIDEST_GAP_DEG and _are_alike(part, pressures[: len(part)], period):
        return None
    if counted:
        return f"углы идут {span} через 1: похоже на номера отсчётов", _MENDS["номера отсчётов"]
    unit = next(_units(whole, step, period, speed_rpm), "")
    if unit:
        return f"углы идут {span}: похоже на {unit}", _MENDS.get(unit, _TIME_MEND)
    problem = f"углы идут {span}, но давления не повторяются через {number_text(period)}°"
    return problem, "нужны градусы поворота вала: проверьте столбец угла"


def _turns(angles: Array, period: float) -> Fault | None:
    """Return a cycle of two turns whose angles begin anew at each."""
    low, high = float(angles.min()), float(angles.max())
    steps = np.diff(angles)
    if period != 720 or not (steps < -180).any() or not 315 <= high - low <= 360 + 1e-6:
        return None
    turns = max(2, round(len(angles) * float(np.median(np.abs(steps))) / 360))
    low = 5 * round(low / 5)
    times = "дважды" if turns == 2 else f"{turns} раза" if turns in (3, 4) else f"{turns} раз"
    problem = f"углы {times} проходят {number_text(low)}…{number_text(low + 360)}°"
    if turns == 2:
        return problem, "цикл занимает 720°: прибавьте ко второму обороту 360°"
    return problem, "цикл занимает 720°: прибавляйте к каждому обороту на 360° больше"


def _units(whole: float, step: float, period: float, speed_rpm: float | None) -> Iterator[str]:
    """Units in which numbers may span whole cycles, with points close enough for a diagram."""
    widest = WIDEST_GAP_DEG / period  # of a cycle
    for unit, turn, most in (("радианы", math.tau, 8), ("обороты", 1.0, 20)):
        cycle = turn * period / 360
        if _is_whole(whole / cycle, most, 0.01) and step <= widest * cycle:
            yield unit
    if speed_rpm:
        cycle_s = period / (6 * speed_rpm)
        for unit, factor in _TIMES.items():
            cycle = cycle_s * factor
            if _is_whole(whole / cycle, 100, 0.02) and step <= widest * cycle:
                yield unit


def _is_whole(cycles: float, most: int, tolerance: float) -> bool:
    return 1 <= round(cycles) <= most and abs(cycles - round(cycles)) <= tolerance * round(cycles)


def _are_alike(angles: Array, pressures: Array, period: float) -> bool:
    """Whether each cycle has the shape of the first, as far as it goes."""
    cycle = np.floor((angles - angles.min()) / period + 1e-9).astype(int)
    first = cycle == 0
    order = np.argsort(angles[first])
    first_angles, p = angles[first][order], pressures[first][order]
    for number in range(1, int(cycle.max()) + 1):
        here = cycle == number
        if here.sum() < 10:
            continue
        there = np.interp(angles[here] - number * period, first_angles, p)
        if not np.ptp(there) and not np.ptp(pressures[here]):
            continue
        with np.errstate(invalid="ignore", divide="ignore"):
            if not np.corrcoef(there, pressures[here])[0, 1] >= _MIN_ALIKE:
                return False
    return True


def _short(value: float) -> str:
    return number_text(float(f"{value:.4g}"))


def alike_columns(first: Array, columns: Sequence[Array]) -> int:
    """How many columns from the first on look like cycles of the same cylinder."""
    for count, column in enumerate(columns):
        with np.errstate(invalid="ignore", divide="ignore"):
            shape = np.corrcoef(first, column)[0, 1]
        if not shape >= 0.8 or not 0.3 < column.max() / first.max() < 3:
            return count
    return len(columns)
