"""Figures of a solution from Python: SVG of the report's own pen, shown by a notebook."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from kshm.arrays import Array
from kshm.engine.checks import takes_kinds
from kshm.results.solution import Solution
from reports.document.figures.curves import Level, Mark, Panel, PlotCurve, curves_figure
from reports.document.figures.polar import polar_path, wear_diagram
from reports.model.shape import most_loaded_pin, pin_name, pin_table, rays_table
from reports.shared.errors import InputError, Problem
from reports.shared.files import write_text

_PHI = r"$\varphi$, °"
_AGAINST = 180.0  # degrees from a ray to the side of the journal on which its forces press


class SvgPicture:
    """A figure; ``svg`` is its text, a notebook shows it."""

    def __init__(self, svg: str) -> None:
        self.svg = svg

    def save(self, path: Path | str) -> Path:
        """Write the figure as an SVG file, whole or not at all; return its path.

        Args:
            path: of the file.

        Raises:
            OutputError: the file cannot be written.

        >>> import tempfile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     SvgPicture("<svg/>").save(f"{folder}/a.svg").name
        'a.svg'
        """
        write_text(Path(path), self.svg)
        return Path(path)

    def _repr_svg_(self) -> str:
        """Return what a notebook shows."""
        return self.svg

    def __repr__(self) -> str:
        return f"<figure, SVG of {len(self.svg)} characters; .save('figure.svg') writes it>"


@takes_kinds
def plot(solution: Solution) -> SolutionPlots:
    """Return the figures of a solution, also there as ``solution.plot``.

    Args:
        solution: what ``kshm.solve`` returns.

    Raises:
        InputError: what is no solution.

    >>> import kshm
    >>> import reports
    >>> figures = plot(kshm.solve(reports.load("gots-diesel")))
    >>> figures.torque().svg.startswith("<svg")
    True
    """
    return SolutionPlots(solution)


class SolutionPlots:
    """Figures of one solution; SVG without pango or a screen."""

    def __init__(self, solution: Solution) -> None:
        self._solution = solution

    def __dir__(self) -> list[str]:
        """Return the names of the figures."""
        return ["diagram", "polar", "torque", "wear"]

    def torque(self) -> SvgPicture:
        """Draw the torque of the engine [N·m] over the cycle with its mean, Gots 2.5.

        >>> import kshm
        >>> import reports
        >>> kshm.solve(reports.load("gots-diesel")).plot.torque().svg[:4]
        '<svg'
        """
        columns = self._columns("P4_2")
        mean = Level(r"$M_{\text{ср}}$", self._solution.scalars["M_mean"])
        curve = PlotCurve(r"$M$", columns["Msum_Nm"])
        panel = Panel((curve,), r"$M$, Н·м", levels=(mean,))
        return SvgPicture(curves_figure(columns["phi_deg"], (panel,), _PHI))

    def polar(self, journal: int = 0) -> SvgPicture:
        """Draw the polar diagram of the load on a journal [MPa], Gots 2.6.

        Args:
            journal: number of a main journal from 1; 0 for the most loaded crankpin.

        Raises:
            InputError: there is no such journal.

        >>> import kshm
        >>> import reports
        >>> kshm.solve(reports.load("gots-diesel")).plot.polar(2).svg[:4]
        '<svg'
        """
        pin = most_loaded_pin(self._solution.scalars)
        columns = self._columns(f"P4_3_{journal}" if journal else pin_table(pin))
        keys = ("Rx_MPa", "Ry_MPa") if journal else ("T_MPa", "Krod_MPa")
        titles = (
            (r"$R_x$, МПа", r"$R_y$, МПа") if journal else (r"$T$, МПа", r"$K_{\text{ш}}$, МПа")
        )
        x, y = (columns[key] for key in keys)
        drawn = polar_path(x, y, columns["phi_deg"], titles, reverse=(False, not journal))
        return SvgPicture(drawn)

    def wear(self, journal: int = 0) -> SvgPicture:
        """Draw the wear of a journal by rays [MPa], Gots 2.6 and table 14.

        Args:
            journal: number of a main journal from 1; 0 for the most loaded crankpin.

        Raises:
            InputError: there is no such journal.

        >>> import kshm
        >>> import reports
        >>> kshm.solve(reports.load("gots-diesel")).plot.wear().svg[:4]
        '<svg'
        """
        pin = most_loaded_pin(self._solution.scalars)
        rays = f"table_14_main_{journal}" if journal else rays_table(pin)
        sums = self._solution.wear_sums
        columns = self._chosen(sums, f"{rays}_sums")
        scalars = self._solution.scalars
        hole = None if journal else scalars.get(f"hole_pin{pin_name(pin)}_deg")
        return SvgPicture(wear_diagram(columns["ray_sum"], columns["ray_deg"] + _AGAINST, hole))

    def diagram(self) -> SvgPicture:
        """Draw the indicator diagram: pressure [MPa] over a cylinder's volume [dm³], Gots 2.1.

        >>> import kshm
        >>> import reports
        >>> kshm.solve(reports.load("gots-diesel")).plot.diagram().svg[:4]
        '<svg'
        """
        columns = self._columns("gas")
        volume, pressure = columns["volume_dm3"], columns["p_MPa"]
        top = int(np.argmax(pressure))
        mark = Mark(r"$z$", float(volume[top]), float(pressure[top]))
        panel = Panel((PlotCurve("", pressure),), r"$p$, МПа", marks=(mark,))
        return SvgPicture(curves_figure(volume, (panel,), r"$V$, дм³", angle=False, height=100.0))

    def _columns(self, table: str) -> dict[str, Array]:
        return self._chosen(self._solution.columns, table)

    def _chosen(self, tables: Any, table: str) -> dict[str, Array]:  # noqa: ANN401
        if table not in tables:
            problem = "у двигателя нет такой шейки"
            count = len(self._solution.engine.crankshaft.main_lengths)
            raise InputError(Problem("journal", problem, f"коренные шейки: от 1 до {count}"))
        columns: dict[str, Array] = tables[table]
        return columns
