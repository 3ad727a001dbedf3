"""Round scales of diagrams: units in a millimetre, by which a diagram fits its room."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from reports.shared.russian import fixed

_ROUND = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0)
_ANGLES = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 4.5, 5.0, 6.0, 8.0, 9.0, 10.0, 12.0, 15.0, 18.0, 20.0)
STEP = 10.0  # mm between the lines of the grid


@dataclass(frozen=True, slots=True)
class Scale:
    """Values along an axis: ``unit`` in a millimetre, from ``low`` to ``high``."""

    unit: float
    low: float
    high: float

    @property
    def length(self) -> float:
        """Length of the axis [mm]."""
        return (self.high - self.low) / self.unit

    def at(self, value: float) -> float:
        """Distance of a value from the beginning of the axis [mm]."""
        return (value - self.low) / self.unit

    def marks(self) -> list[float]:
        """Values at the lines of the grid."""
        count = round(self.length / STEP)
        return [self.low + n * STEP * self.unit for n in range(count + 1)]

    def text(self, value: float) -> str:
        """A value at a line of the grid as it is written."""
        return fixed(value, decimals(STEP * self.unit))


def round_scale(low: float, high: float, room: float, *, angle: bool = False) -> Scale:
    """The largest round scale at which values fit a room [mm]; ends at lines of the grid."""
    units = iter(_ANGLES) if angle else _units((high - low) / room)
    for unit in units:
        step = STEP * unit
        ends = (math.floor(low / step + 1e-9) * step, math.ceil(high / step - 1e-9) * step)
        made = Scale(unit, ends[0], ends[1] if ends[1] > ends[0] else ends[0] + step)
        if angle:
            made = Scale(unit, low, high)
        if made.length <= room + 1e-9:
            return made
    raise ValueError(f"no scale for {low}…{high} in {room} mm")


def _units(least: float) -> Iterator[float]:
    power = math.floor(math.log10(least)) if least > 0 else -3
    for exponent in range(power - 1, power + 4):
        for digit in _ROUND:
            unit = digit * 10.0**exponent
            if unit >= least * 0.999:
                yield unit


def decimals(step: float) -> int:
    """Decimals that a step of round digits needs."""
    return next((n for n in range(9) if abs(round(step, n) - step) < 1e-9 * step), 9)


def unit_text(unit: float) -> str:
    """A scale as it is written."""
    return fixed(unit, decimals(unit))
