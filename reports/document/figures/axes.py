"""Axes as in a Russian textbook: units at the ends, heavier lines through zero."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reports.document.figures.labels import shown
from reports.document.figures.style import AXIS, FONT_SIZE, GRID, HALO, SMALL
from reports.document.figures.ticks import Ticks

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def dress(
    axes: Axes,
    x_ticks: Ticks,
    y_ticks: Ticks,
    *,
    reverse: tuple[bool, bool] = (False, False),
    zero_lines: tuple[bool, bool] = (False, True),
) -> None:
    """Grid, limits, marks with decimal comma, heavier lines through zero."""
    axes.set_xticks(x_ticks.places, x_ticks.texts)
    axes.set_yticks(y_ticks.places, y_ticks.texts)
    axes.set_xlim(x_ticks.low, x_ticks.high)
    axes.set_ylim(y_ticks.low, y_ticks.high)
    axes.xaxis.set_inverted(reverse[0])
    axes.yaxis.set_inverted(reverse[1])
    axes.tick_params(length=0, pad=3, labelsize=SMALL)
    axes.grid(visible=True, clip_on=False, **GRID)
    axes.set_axisbelow(True)
    axes.spines[["top", "right", "bottom"]].set(**GRID)
    axes.spines["left"].set(**AXIS)
    if y_ticks.low >= 0:
        axes.spines["bottom"].set(**AXIS)
    if zero_lines[1] and y_ticks.low < 0 < y_ticks.high:
        axes.axhline(0, zorder=1.5, clip_on=False, **AXIS)
    if zero_lines[0] and x_ticks.low < 0 < x_ticks.high:
        axes.axvline(0, zorder=1.5, clip_on=False, **AXIS)


def beside(
    axes: Axes, text: str, corner: tuple[float, float], shift: tuple[float, float], ha: str
) -> None:
    """A text set off from a place of the axes (0 … 1) by points."""
    axes.annotate(
        shown(text), corner, xytext=shift, xycoords="axes fraction", textcoords="offset points",
        ha=ha, va="baseline", fontsize=FONT_SIZE,
    )  # fmt: skip


def y_title(axes: Axes, text: str) -> None:
    """Name and unit of the vertical axis above its upper end."""
    beside(axes, text, (0.0, 1.0), (-8, 7), "left")


def x_title(axes: Axes, text: str) -> None:
    """Name and unit of the horizontal axis at its right end, in line with the numbers."""
    beside(axes, text, (1.0, 0.0), (11, -3 - 0.76 * SMALL), "left")


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
        shown(text), place, xycoords="figure points", ha="center", va="center", fontsize=size,
        bbox=HALO if halo else None, annotation_clip=False,
    )  # fmt: skip
