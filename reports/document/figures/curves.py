"""Charts in rectangular coordinates: curves over an abscissa, panels, p-V."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reports.document.figures import axes as ax
from reports.document.figures.labels import (
    Points,
    Room,
    dense,
    label_curve,
    label_point,
    shown,
    text_size,
)
from reports.document.figures.style import FONT_SIZE, PAGE_WIDTH, PATTERNS, SMALL, sheet
from reports.document.figures.ticks import Ticks, angle_ticks, bounds, value_ticks

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LETTERS = "абвгдежиклмнпрстуфхцшщэюя"  # without з, о, ё, й, ъ, ы, ь, as the standard lists them
_BOTTOM, _TOP, _BETWEEN = 20.0, 22.0, 38.0  # pt below, above and between the panels
_DOT: dict[str, Any] = {"linewidth": 2.2, "solid_capstyle": "round", "label": "_"}
_LEVEL: dict[str, Any] = {"color": "#000000", "linewidth": 0.9, "linestyle": (0, (12, 3, 2, 3))}


@dataclass(frozen=True, slots=True)
class Curve:
    """A curve: its name (``$…$`` for symbols) and ordinates."""

    name: str
    y: ArrayLike


@dataclass(frozen=True, slots=True)
class Level:
    """A horizontal line across a chart, such as a mean, with its name."""

    name: str
    y: float


@dataclass(frozen=True, slots=True)
class Mark:
    """A point worth naming, such as an extreme or z on the indicator diagram."""

    name: str
    x: float
    y: float


@dataclass(frozen=True, slots=True)
class Panel:
    """One plot of a figure; ``zero`` takes zero into the ordinate, ``points`` get dots."""

    curves: Sequence[Curve]
    y_title: str
    levels: Sequence[Level] = ()
    marks: Sequence[Mark] = ()
    zero: bool = True
    points: Sequence[tuple[ArrayLike, ArrayLike]] = ()

    def ordinates(self, size: int) -> list[NDArray[np.float64]]:
        """The curves as arrays, shape (size,) each.

        Raises:
            ValueError: A curve has another number of values.
        """
        columns = [np.asarray(curve.y, dtype=np.float64) for curve in self.curves]
        for curve, column in zip(self.curves, columns, strict=True):
            if column.shape != (size,):
                msg = f"Кривая «{curve.name}»: {column.shape} значений при {size} абсциссах"
                raise ValueError(msg)
        return columns

    def bounds(self) -> tuple[float, float]:
        """Least and greatest ordinate of all that is drawn."""
        columns = [np.asarray(curve.y, dtype=np.float64).tolist() for curve in self.curves]
        return bounds(
            [*columns, [level.y for level in self.levels], [mark.y for mark in self.marks]]
        )


def curves_figure(
    x: ArrayLike,
    panels: Sequence[Panel],
    x_title: str,
    *,
    height: float = 76.0,
    angle: bool = True,
    x_step: float | None = None,
    same_scale: bool = False,
) -> str:
    """Panels over one abscissa, one above the other, as SVG; several are lettered а, б, в ….

    Args:
        x: Abscissa, shape (n,).
        panels: Curves and ordinate of each panel.
        x_title: Name and unit of the abscissa, set under the lowest panel.
        height: Height of a panel [mm].
        angle: Marks at multiples of 30, 60, 90, 120 or of ``x_step``.
        x_step: Step of the marks instead of the one chosen.
        same_scale: One range of ordinates for all panels.

    Raises:
        ValueError: Shapes differ or a value is not finite.
    """
    abscissa = np.asarray(x, dtype=np.float64)
    for panel in panels:
        panel.ordinates(abscissa.size)
    low, high = bounds([abscissa.tolist()])
    x_ticks = angle_ticks(low, high, step=x_step) if angle else value_ticks(low, high)
    ranges = [panel.bounds() for panel in panels]
    if same_scale:
        ranges = [bounds(ranges)] * len(ranges)
    y_ticks = [
        value_ticks(*pair, count=max(3, round(height / 13)), zero=panel.zero)
        for pair, panel in zip(ranges, panels, strict=True)
    ]
    left = max(ticks.width() for ticks in y_ticks) + 8
    right = text_size(x_title, FONT_SIZE)[0] + 14
    with sheet(PAGE_WIDTH, height * len(panels)) as page:
        room = page.height - _BOTTOM - _TOP - _BETWEEN * (len(panels) - 1)
        tall = room / len(panels)
        for index, (panel, ticks) in enumerate(zip(panels, y_ticks, strict=True)):
            base = page.height - _TOP - tall - index * (tall + _BETWEEN)
            axes = page.axes(left, base, page.width - left - right, tall)
            _plot(axes, abscissa, panel, (x_ticks, ticks))
            if len(panels) > 1:
                ax.beside(axes, f"{LETTERS[index]})", (0.5, 1.0), (0, 7), "center")
        ax.x_title(axes, x_title)
        return page.svg()


def _plot(
    axes: Axes, x: NDArray[np.float64], panel: Panel, ticks: tuple[Ticks, Ticks]
) -> None:  # fmt: skip
    ax.dress(axes, *ticks)
    ax.y_title(axes, panel.y_title)
    columns = panel.ordinates(x.size)
    for number, (curve, y) in enumerate(zip(panel.curves, columns, strict=True)):
        dash, width, colour = PATTERNS[number % len(PATTERNS)]
        look = {"linestyle": dash, "linewidth": width, "color": colour}
        axes.plot(x, y, label=shown(curve.name), clip_on=False, **look)
    for number, points in enumerate(panel.points):
        colour = PATTERNS[number % len(PATTERNS)][2]
        dots = axes.plot(*map(_dotted, points), color=colour, clip_on=False, **_DOT)
        dots[0].get_path().should_simplify = False
    for level in panel.levels:
        axes.axhline(level.y, clip_on=False, **_LEVEL)
    _name(axes, panel, [np.column_stack([x, y]) for y in columns])


def _dotted(values: ArrayLike) -> NDArray[np.float64]:
    """Segments of no length, which round caps make dots; markers would be copies by reference."""
    places = np.repeat(np.asarray(values, dtype=np.float64), 3)
    places[2::3] = np.nan
    return places


def _name(axes: Axes, panel: Panel, curves: Sequence[Points]) -> None:
    """Names of marks, levels and curves, in this order of right to the room."""
    to_sheet = axes.transData.transform
    left, low, right, high = axes.get_window_extent().extents
    room = Room((left + 2, low + 2, right - 2, high - 2))
    lines = [dense(to_sheet(curve)) for curve in curves]
    ends = axes.get_xlim()
    across = [
        dense(to_sheet(np.array([(ends[0], y), (ends[1], y)])))
        for y in (*(level.y for level in panel.levels), 0.0)
    ]
    room.curves += [*lines, *across]
    for mark in panel.marks:
        _mark(axes, room, to_sheet((mark.x, mark.y)).tolist(), mark.name)
    for level, line in zip(panel.levels, across, strict=False):
        place = label_curve(room, line, lines, text_size(level.name, FONT_SIZE))
        if place:
            ax.put(axes, place, level.name)
    if len(panel.curves) < 2:
        return
    places = []
    for curve, line in zip(panel.curves, lines, strict=True):
        others = [other for other in lines if other is not line]
        places.append(label_curve(room, line, others, text_size(curve.name, FONT_SIZE)))
    if all(places):
        for curve, place in zip(panel.curves, places, strict=True):
            ax.put(axes, place or (0, 0), curve.name)
    else:
        axes.legend(
            loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4, frameon=False,
            fontsize=FONT_SIZE, handlelength=2.8, borderaxespad=0.1, borderpad=0.2,
            columnspacing=1.4,
        )  # fmt: skip


def _mark(axes: Axes, room: Room, point: tuple[float, float], name: str) -> None:
    from matplotlib.patches import Circle
    from matplotlib.transforms import IdentityTransform

    disc = Circle(point, 1.6, facecolor="#000000", edgecolor="none", clip_on=False, zorder=4)
    disc.set_transform(IdentityTransform())
    axes.add_artist(disc).set_clip_path(None)
    place = label_point(room, (point[0], point[1]), text_size(name, SMALL))
    if place:
        ax.put(axes, place, name, SMALL)
