"""Charts in rectangular coordinates: curves over the crank angle, panels, p-V."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reports.document.figures import axes as ax
from reports.document.figures.axes import dot, put
from reports.document.figures.labels import (
    Room,
    dense,
    label_curve,
    label_point,
    shown,
    text_size,
)
from reports.document.figures.style import (
    FONT_SIZE,
    PAGE_WIDTH,
    PATTERNS,
    SMALL,
    Sheet,
    sheet,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Values = NDArray[np.float64]
_LETTERS = "абвгдежиклмнпрстуфхцшщэюя"  # without з, о, ё, й, ъ, ы, ь, as the standard lists them


@dataclass(frozen=True, slots=True)
class Series:
    """A curve: its name (``$…$`` for symbols), ordinates, number of its line pattern."""

    label: str
    y: ArrayLike
    style: int | None = None


@dataclass(frozen=True, slots=True)
class Level:
    """A horizontal line across a chart, such as a mean, with its name."""

    label: str
    y: float


@dataclass(frozen=True, slots=True)
class Mark:
    """A point worth naming, such as an extreme or z on the indicator diagram."""

    label: str
    x: float
    y: float


@dataclass(frozen=True, slots=True)
class Panel:
    """One panel of a stacked figure."""

    series: Sequence[Series]
    y_label: str
    title: str = ""


def line_chart(
    x: ArrayLike,
    series: Sequence[Series],
    x_label: str,
    y_label: str,
    *,
    height: float = 85.0,
    angle: bool = True,
    x_step: float | None = None,
    direct: bool = True,
    levels: Sequence[Level] = (),
    marks: Sequence[Mark] = (),
    zero: bool = True,
) -> str:
    """Curves over one abscissa as SVG.

    Args:
        x: Abscissa, shape (n,), rising.
        series: Curves of n ordinates each.
        x_label: Name and unit of the abscissa.
        y_label: Name and unit of the ordinate.
        height: Height of the figure [mm].
        angle: The abscissa is a crank angle [deg]: marks at multiples of 30, 60, 90, 120.
        x_step: Step of the marks instead of the one chosen.
        direct: Names beside the curves if there is room, else a legend.
        levels: Horizontal lines.
        marks: Named points.
        zero: Take zero into the ordinate.

    Raises:
        ValueError: Shapes differ or a value is not finite.
    """
    panel = Panel(series, y_label)
    return _stack(
        x, [panel], x_label, [height], angle, x_step, direct, levels=levels, marks=marks, zero=zero
    )


def stacked_panels(
    x: ArrayLike,
    panels: Sequence[Panel],
    x_label: str,
    *,
    panel_height: float = 48.0,
    x_step: float | None = None,
    direct: bool = True,
    same_scale: bool = False,
) -> str:
    """Panels one above the other over one crank angle, lettered а, б, в … (figures 56, 57).

    Args:
        x: Crank angle [deg], shape (n,).
        panels: Curves and ordinate of each panel.
        x_label: Name and unit of the abscissa, set under the lowest panel.
        panel_height: Height of a panel [mm].
        x_step: Step of the marks instead of the one chosen.
        direct: Names beside the curves if there is room, else a legend.
        same_scale: One range of ordinates for all panels.
    """
    heights = [panel_height] * len(panels)
    return _stack(
        x, panels, x_label, heights, True, x_step, direct, letters=True, same_scale=same_scale
    )


def twin_chart(
    x: ArrayLike,
    upper: Panel,
    lower: Panel,
    x_label: str,
    *,
    panel_height: float = 58.0,
    x_step: float | None = None,
) -> str:
    """Two quantities of different units over one angle: two panels, one abscissa."""
    heights = [panel_height, panel_height]
    return _stack(x, [upper, lower], x_label, heights, True, x_step, True, letters=True)


def pv_diagram(
    volume: ArrayLike,
    pressure: ArrayLike,
    *,
    marks: Sequence[Mark] = (),
    volume_label: str = r"$V$, л",
    pressure_label: str = r"$p$, МПа",
    ambient: float | None = None,
    height: float = 95.0,
) -> str:
    """Indicator diagram over the volume, not smoothed.

    Args:
        volume: Volume of the cylinder along the cycle, shape (n,).
        pressure: Pressure along the cycle, shape (n,).
        marks: Named points (a, c, z, b, r …).
        volume_label: Name and unit of the volume.
        pressure_label: Name and unit of the pressure.
        ambient: Pressure of the surroundings, drawn as a line.
        height: Height of the figure [mm].
    """
    levels = () if ambient is None else (Level("$p_0$", ambient),)
    panel = Panel((Series("", pressure),), pressure_label)
    return _stack(
        volume, [panel], volume_label, [height], False, None, False, levels=levels, marks=marks
    )


def _stack(
    x: ArrayLike,
    panels: Sequence[Panel],
    x_label: str,
    heights: Sequence[float],
    angle: bool,
    x_step: float | None,
    direct: bool,
    *,
    letters: bool = False,
    same_scale: bool = False,
    levels: Sequence[Level] = (),
    marks: Sequence[Mark] = (),
    zero: bool = True,
) -> str:
    abscissa = np.asarray(x, dtype=np.float64)
    curves = [[_ordinates(s, abscissa.size) for s in panel.series] for panel in panels]
    low, high = ax.bounds([abscissa])
    x_ticks = ax.angle_ticks(low, high, step=x_step) if angle else ax.value_ticks(low, high)
    ranges = [
        ax.bounds([*columns, [level.y for level in levels], [mark.y for mark in marks]])
        for columns in curves
    ]
    if same_scale:
        ranges = [ax.bounds(ranges)] * len(ranges)
    y_ticks = [
        ax.value_ticks(*pair, count=max(3, round(height / 13)), zero=zero)
        for pair, height in zip(ranges, heights, strict=True)
    ]
    left = max(ticks.width() for ticks in y_ticks) + 8
    right = max(text_size(x_label, FONT_SIZE)[0] + 14, 14)
    bottom, top, between = 20.0, 22.0, 38.0
    with sheet(PAGE_WIDTH, sum(heights)) as page:
        plot_width = page.width - left - right
        room = page.height - bottom - top - between * (len(panels) - 1)
        plot_height = room / len(panels)
        for index, panel in enumerate(panels):
            last = index == len(panels) - 1
            base = page.height - top - plot_height - index * (plot_height + between)
            axes = page.axes(left, base, plot_width, plot_height)
            ax.dress(axes, x_ticks, y_ticks[index], x_texts=True)
            letter = f"{_LETTERS[index]}) " if letters else ""
            ax.y_title(axes, panel.y_label)
            _title(axes, letter + panel.title)
            _draw(axes, abscissa, panel.series, curves[index], levels)
            _name(axes, abscissa, panel.series, curves[index], direct, levels, marks)
            if last:
                ax.x_title(axes, x_label)
        return page.svg()


def _ordinates(series: Series, size: int) -> Values:
    values = np.asarray(series.y, dtype=np.float64)
    if values.shape != (size,):
        msg = f"Кривая «{series.label}»: {values.shape} значений при {size} абсциссах"
        raise ValueError(msg)
    return values


def _title(axes: Axes, text: str) -> None:
    if text.strip():
        axes.annotate(
            shown(text),
            (0.5, 1.0),
            xytext=(0, 7),
            xycoords="axes fraction",
            textcoords="offset points",
            ha="center",
            va="baseline",
            fontsize=FONT_SIZE,
        )


def _draw(
    axes: Axes,
    x: Values,
    series: Sequence[Series],
    curves: Sequence[Values],
    levels: Sequence[Level],
) -> None:
    for number, (item, y) in enumerate(zip(series, curves, strict=True)):
        dash, width, colour = PATTERNS[
            (number if item.style is None else item.style) % len(PATTERNS)
        ]
        axes.plot(
            x,
            y,
            linestyle=dash,
            linewidth=width,
            color=colour,
            label=shown(item.label),
            clip_on=False,
        )
    for level in levels:
        axes.axhline(
            level.y, color="#000000", linewidth=0.9, linestyle=(0, (12, 3, 2, 3)), clip_on=False
        )


def _name(
    axes: Axes,
    x: Values,
    series: Sequence[Series],
    curves: Sequence[Values],
    direct: bool,
    levels: Sequence[Level],
    marks: Sequence[Mark],
) -> None:
    """Names of marks, levels and curves, in this order of right to the room."""
    to_sheet = axes.transData.transform
    box = axes.get_window_extent()
    room = Room((box.x0 + 2, box.y0 + 2, box.x1 - 2, box.y1 - 2))
    lines = [dense(to_sheet(np.column_stack([x, y]))) for y in curves]
    room.curves.extend(lines)
    ends = np.array([axes.get_xlim()[0], axes.get_xlim()[1]])
    level_lines = [dense(to_sheet(np.column_stack([ends, [lv.y, lv.y]]))) for lv in levels]
    zero = [dense(to_sheet(np.column_stack([ends, [0.0, 0.0]])))]
    room.curves.extend(level_lines + zero)
    for mark in marks:
        _mark(axes, room, mark)
    for level, line in zip(levels, level_lines, strict=True):
        place = label_curve(room, line, lines, text_size(level.label, FONT_SIZE))
        if place:
            put(axes, place, level.label)
    named = [(item, line) for item, line in zip(series, lines, strict=True) if item.label]
    if len(named) > 1 and not (direct and _direct(axes, room, named)):
        _legend(axes)


def _direct(axes: Axes, room: Room, named: Sequence[tuple[Series, Values]]) -> bool:
    places = []
    for item, line in named:
        others = [other for _, other in named if other is not line]
        place = label_curve(room, line, others, text_size(item.label, FONT_SIZE))
        if place is None:
            return False
        places.append(place)
    for (item, _), place in zip(named, places, strict=True):
        put(axes, place, item.label)
    return True


def _legend(axes: Axes) -> None:
    axes.legend(
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=4,
        frameon=False,
        fontsize=FONT_SIZE,
        handlelength=2.8,
        borderaxespad=0.1,
        borderpad=0.2,
        columnspacing=1.4,
    )


def _mark(axes: Axes, room: Room, mark: Mark) -> None:
    x, y = axes.transData.transform((mark.x, mark.y))
    dot(axes, (float(x), float(y)))
    place = label_point(room, (float(x), float(y)), text_size(mark.label, SMALL))
    if place:
        put(axes, place, mark.label, SMALL)


__all__ = ["Level", "Mark", "Panel", "Series", "Sheet", "line_chart", "pv_diagram"]
__all__ += ["stacked_panels", "twin_chart"]
