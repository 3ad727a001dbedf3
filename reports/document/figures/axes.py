"""Axes as in a Russian textbook: units at the ends, decimal comma, angle steps, zero line."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from reports.document.figures.labels import shown, text_size
from reports.document.figures.style import AXIS, FONT_SIZE, GRID, HALO, SMALL
from reports.shared.russian import fixed

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_ANGLE_STEPS = (5.0, 10.0, 15.0, 30.0, 60.0, 90.0, 120.0, 180.0)
_FACTORS = (1.0, 2.0, 2.5, 5.0, 10.0)


@dataclass(frozen=True, slots=True)
class Ticks:
    """Marks of an axis: places, their texts, and the limits they span."""

    places: tuple[float, ...]
    texts: tuple[str, ...]

    @property
    def low(self) -> float:
        """Lower end of the axis."""
        return self.places[0]

    @property
    def high(self) -> float:
        """Upper end of the axis."""
        return self.places[-1]

    def width(self) -> float:
        """Room of the widest text [pt]; digits of STIX are half an em wide."""
        return max(text_size(text, SMALL)[0] for text in self.texts)


def value_ticks(low: float, high: float, *, count: int = 6, zero: bool = True) -> Ticks:
    """Round marks that enclose a range, about ``count`` intervals of them.

    Args:
        low: Least value to show.
        high: Greatest value to show.
        count: Wanted number of intervals.
        zero: Take zero into the range.

    Raises:
        ValueError: The range is not finite.
    """
    if not (math.isfinite(low) and math.isfinite(high)):
        msg = f"Границы оси не конечны: {low}, {high}"
        raise ValueError(msg)
    if zero:
        low, high = min(low, 0.0), max(high, 0.0)
    if high - low <= 1e-12 * max(1.0, abs(high), abs(low)):
        low, high = low - 0.5 * max(1.0, abs(low)), high + 0.5 * max(1.0, abs(high))
    step = _nice_step((high - low) / count)
    first, last = math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9)
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    if not math.isclose(step * 10**digits, round(step * 10**digits), rel_tol=1e-6):
        digits += 1
    places = tuple(index * step for index in range(first, last + 1))
    return Ticks(places, tuple(fixed(place, digits) for place in places))


def angle_ticks(low: float, high: float, *, step: float | None = None, most: int = 13) -> Ticks:
    """Marks of an axis of crank angles [deg] at multiples of 30, 60, 90 … degrees."""
    if step is None:
        step = next((s for s in _ANGLE_STEPS[3:] if (high - low) / s < most), 360.0)
        if (high - low) / step < 3:
            step = next(s for s in _ANGLE_STEPS if (high - low) / s < most)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    places = [index * step for index in range(first, last + 1)]
    texts = [fixed(place, 0 if step >= 1 else 1) for place in places]
    if not places or places[0] > low + 1e-9:
        places, texts = [low, *places], ["", *texts]
    if places[-1] < high - 1e-9:
        places, texts = [*places, high], [*texts, ""]
    return Ticks(tuple(places), tuple(texts))


def _nice_step(rough: float) -> float:
    scale = 10.0 ** math.floor(math.log10(rough))
    return next(factor * scale for factor in _FACTORS if factor * scale >= rough * (1 - 1e-9))


def dress(
    axes: Axes,
    x_ticks: Ticks,
    y_ticks: Ticks,
    *,
    invert: tuple[bool, bool] = (False, False),
    x_texts: bool = True,
    zero_lines: tuple[bool, bool] = (False, True),
) -> None:
    """Grid, limits, marks with decimal comma, heavier lines through zero."""
    x_limits, y_limits = (x_ticks.low, x_ticks.high), (y_ticks.low, y_ticks.high)
    axes.set_xlim(*(reversed(x_limits) if invert[0] else x_limits))
    axes.set_ylim(*(reversed(y_limits) if invert[1] else y_limits))
    axes.set_xticks(x_ticks.places, x_ticks.texts if x_texts else [""] * len(x_ticks.places))
    axes.set_yticks(y_ticks.places, y_ticks.texts)
    axes.tick_params(length=0, pad=3, labelsize=SMALL)
    axes.grid(visible=True, clip_on=False, **GRID)
    axes.set_axisbelow(True)
    for side in ("top", "right", "bottom"):
        axes.spines[side].set(color=GRID["color"], linewidth=GRID["linewidth"])
    axes.spines["left"].set(**AXIS)
    if y_ticks.low >= 0:
        axes.spines["bottom"].set(**AXIS)
    if zero_lines[1] and y_ticks.low < 0 < y_ticks.high:
        axes.axhline(0, zorder=1.5, clip_on=False, **AXIS)
    if zero_lines[0] and x_ticks.low < 0 < x_ticks.high:
        axes.axvline(0, zorder=1.5, clip_on=False, **AXIS)


def y_title(axes: Axes, text: str, *, right: bool = False) -> None:
    """Name and unit of the vertical axis above its upper end."""
    axes.annotate(
        shown(text),
        (1.0 if right else 0.0, 1.0),
        xytext=(8 if right else -8, 7),
        xycoords="axes fraction",
        textcoords="offset points",
        ha="right" if right else "left",
        va="baseline",
        fontsize=FONT_SIZE,
    )


def x_title(axes: Axes, text: str) -> None:
    """Name and unit of the horizontal axis at its right end, in line with the numbers."""
    axes.annotate(
        shown(text),
        (1.0, 0.0),
        xytext=(11, -3 - 0.76 * SMALL),
        xycoords="axes fraction",
        textcoords="offset points",
        ha="left",
        va="baseline",
        fontsize=FONT_SIZE,
    )


def bounds(columns: Iterable[Iterable[float]]) -> tuple[float, float]:
    """Least and greatest value of several columns.

    Raises:
        ValueError: A value is not finite or there is none.
    """
    values = [float(value) for column in columns for value in column]
    if not values or not all(map(math.isfinite, values)):
        msg = "Кривая пуста или содержит не число"
        raise ValueError(msg)
    return min(values), max(values)


def put(
    axes: Axes,
    place: tuple[float, float],
    text: str,
    size: float = FONT_SIZE,
    *,
    halo: bool = True,
) -> None:
    """A text centred at a place of the sheet [pt]."""
    axes.annotate(
        shown(text),
        place,
        xycoords="figure points",
        ha="center",
        va="center",
        fontsize=size,
        bbox=HALO if halo else None,
        annotation_clip=False,
    )


def dot(axes: Axes, place: Sequence[float], radius: float = 1.6) -> None:
    """A small disc at a place of the sheet [pt]."""
    from matplotlib.patches import Circle
    from matplotlib.transforms import IdentityTransform

    disc = Circle((place[0], place[1]), radius, facecolor="#000000", edgecolor="none")
    disc.set(transform=IdentityTransform(), clip_on=False, zorder=4)
    axes.add_artist(disc)
    disc.set_clip_path(None)
