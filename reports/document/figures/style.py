"""One look for all figures: sheet, line patterns, fonts, and the way to a clean SVG."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from reports.document.figures.svg import clean

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PAGE_WIDTH = 165.0  # mm of text width
FONT_SIZE = 11.0  # pt
SMALL = 9.5
MM = 72 / 25.4  # points in a millimetre

# Patterns are told apart without colour; widths help where dashes are short.
Pattern = tuple[Any, float, str]
PATTERNS: tuple[Pattern, ...] = (
    ("-", 1.5, "#000000"),
    ((0, (7, 2.2)), 1.3, "#000000"),
    ((0, (7, 2, 1.3, 2)), 1.3, "#000000"),
    ((0, (1.3, 1.7)), 1.6, "#000000"),
    ((0, (11, 2, 3, 2)), 1.2, "#000000"),
    ((0, (3, 1.6)), 1.2, "#000000"),
    ("-", 2.4, "#8a8a8a"),
    ((0, (7, 1.6, 1.3, 1.6, 1.3, 1.6)), 1.2, "#000000"),
)
GRID: dict[str, Any] = {"color": "#c4c4c4", "linewidth": 0.45}
AXIS: dict[str, Any] = {"color": "#000000", "linewidth": 0.8}
HALO: dict[str, Any] = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}

_RC: dict[Any, Any] = {
    "font.family": "STIXGeneral",
    "font.size": FONT_SIZE,
    "mathtext.fontset": "stix",
    "svg.fonttype": "none",
    "svg.hashsalt": "kshm",
    "axes.unicode_minus": True,
    "axes.linewidth": 0.6,
    "path.simplify": False,
    "lines.dash_capstyle": "butt",
    "lines.scale_dashes": False,
    "hatch.linewidth": 0.5,
}


class Sheet:
    """A figure of given size in millimetres; everything on it is placed in points."""

    def __init__(self, width: float, height: float) -> None:
        from matplotlib.figure import Figure

        self.width, self.height = width * MM, height * MM
        self.figure: Figure = Figure(figsize=(self.width / 72, self.height / 72), dpi=72)
        self.figure.patch.set_visible(False)

    def axes(self, left: float, bottom: float, width: float, height: float) -> Axes:
        """Axes at a place given in points from the lower left corner."""
        axes = self.figure.add_axes(
            (left / self.width, bottom / self.height, width / self.width, height / self.height)
        )
        axes.patch.set_visible(False)
        return axes

    def plane(self) -> Axes:
        """Axes over the whole sheet whose units are points and which show nothing."""
        axes = self.axes(0, 0, self.width, self.height)
        axes.set_axis_off()
        axes.set(xlim=(0, self.width), ylim=(0, self.height))
        return axes

    def svg(self) -> str:
        """The sheet as an SVG element for HTML, the same bytes each time."""
        stream = io.StringIO()
        self.figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
        return clean(stream.getvalue(), self.width / MM)


@contextmanager
def sheet(width: float, height: float) -> Iterator[Sheet]:
    """Open a sheet with our settings in force; call ``svg()`` before leaving.

    Args:
        width: Width [mm].
        height: Height [mm].
    """
    import matplotlib as mpl

    with mpl.rc_context(_RC):
        yield Sheet(width, height)
