"""Figures of a solution: what they are called; another package draws them."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Protocol, cast

from kshm.errors import KshmError

if TYPE_CHECKING:
    from pathlib import Path

# By name only: the solver knows nothing of drawing, and nothing is loaded before a figure is asked.
_DRAWER = "reports.python.figures"


class Picture(Protocol):
    """A figure as SVG; a notebook shows it."""

    svg: str

    def save(self, path: Path | str) -> Path:
        """Write the figure; return its path."""


class Plots(Protocol):
    """Figures of one solution."""

    def torque(self) -> Picture:
        """Torque of the engine over the cycle with its mean, Gots figure 42."""

    def polar(self, journal: int = 0) -> Picture:
        """Polar diagram of the load on the crankpin, or on a main journal by its number."""

    def wear(self, journal: int = 0) -> Picture:
        """Wear of the crankpin, or of a main journal by its number."""

    def diagram(self) -> Picture:
        """Return indicator diagram over the volume of the cylinder."""


def plots_of(solution: object) -> Plots:
    """Return the figures of a solution.

    Raises:
        KshmError: the package that draws is not installed.
    """
    try:
        drawer = import_module(_DRAWER)
    except ModuleNotFoundError as error:
        raise KshmError(f"figures need the package {_DRAWER.partition('.')[0]}") from error
    return cast(Plots, drawer.plot(solution))
