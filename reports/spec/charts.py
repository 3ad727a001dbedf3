"""What a chart is: one description from which the workbook and the report draw it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, TypedDict, Unpack

from reports.shared.russian import NBSP

PHI = "φ, ° ПКВ"


@dataclass(frozen=True, slots=True)
class Series:
    """A curve: columns or grid rows as ``table.key``; ``name`` overrides the symbol.

    ``only`` says who draws it where workbook and report differ.  An invisible curve keeps the
    limits of both axes of the workbook's chart equal; a point is a run of one.
    """

    x: str
    y: str
    name: str = ""
    only: Literal["", "workbook", "report"] = ""
    invisible: bool = False
    point: bool = False


@dataclass(frozen=True, slots=True)
class ChartSpec:
    """A chart beside its table; without a sheet it stands in the report alone.

    Attributes:
        kind: lines over an abscissa, path of a vector, wear diagram, scheme in a unit square.
        figure: its number in the textbook.
        caption: what the report says where that is more than the title.
        x_tex: name and unit of the report's abscissa where they are not its column's.
        y_tex: name and unit of the report's ordinate where they are not the workbook's.
        x_is_angle: the abscissa is a crank angle [deg].
        stems: the abscissa is an order: nothing lies between two, each value stands alone.
        x_step: the abscissa's step where the programs do not choose it, 1 where it counts things.
        x_reversed: positive x to the left, as the axes of the journals run.
        y_reversed: positive y downwards.
        from_zero: the report's ordinate takes zero in.
        levels: scalars and inputs that the report draws across, such as a mean.
        extremes: the report marks the greatest and the least value of the first curve.
        hole: scalar with the angle of the oil hole in a wear diagram [deg].
        contact: signed columns of x and y from the axis to where the force acts in a wear
            diagram.
        poles: points below the origin from which the report's vector is measured: symbol and
            expression of the ordinate.
        group: what the report says of this chart and the others that share a figure with it.
        panel: what it says of this one.
        number: number of the figure in the report, where one is written.
    """

    id: str
    sheet: str
    title: str
    kind: Literal["line", "polar", "wear", "scheme"]
    series: tuple[Series, ...]
    x_title: str = ""
    y_title: str = ""
    figure: str = ""
    caption: str = ""
    x_tex: str = ""
    y_tex: str = ""
    x_is_angle: bool = False
    stems: bool = False
    x_step: float | None = None
    x_reversed: bool = False
    y_reversed: bool = False
    from_zero: bool = True
    levels: tuple[str, ...] = ()
    extremes: bool = False
    hole: str = ""
    contact: tuple[str, ...] = ()
    poles: tuple[tuple[str, str], ...] = ()
    group: str = ""
    panel: str = ""
    number: str = ""

    @property
    def heading(self) -> str:
        """Title of the workbook's chart: the report's number, the textbook's in brackets."""
        own = f"Рис.{NBSP}{self.number}. " if self.number else ""
        textbook = f" [рис.{NBSP}{self.figure}]" if self.figure else ""
        return f"{own}{self.title}{textbook}"

    @property
    def equal_axes(self) -> bool:
        """Whether both axes have one scale: the plot is square."""
        return self.kind != "line"

    @property
    def words(self) -> str:
        """Caption of the report's figure."""
        return self.caption or self.title

    def drawn_by(self, place: Literal["workbook", "report"]) -> tuple[Series, ...]:
        """Curves that the workbook or the report draws."""
        return tuple(s for s in self.series if s.only in ("", place))


class More(TypedDict, total=False):
    """What a chart may say besides, as ``ChartSpec`` has it."""

    figure: str
    caption: str
    x_tex: str
    y_tex: str
    stems: bool
    x_step: float
    from_zero: bool
    levels: tuple[str, ...]
    extremes: bool
    poles: tuple[tuple[str, str], ...]
    group: str
    panel: str


def line(
    chart: str, sheet: str, title: str, axes: tuple[str, str], *curves: Series, **more: Unpack[More]
) -> ChartSpec:
    """Curves in rectangular coordinates; ``axes`` are the titles of abscissa and ordinate."""
    return ChartSpec(chart, sheet, title, "line", curves, *axes, **more)


def over_phi(
    chart: str,
    sheet: str,
    title: str,
    y_title: str,
    *columns: str | Series,
    x: tuple[str, str] = ("phi_deg", PHI),
    **more: Unpack[More],
) -> ChartSpec:
    """Columns over an angle; ``x`` is the key of the first one's angles and their title."""
    given = [Series("", c) if isinstance(c, str) else c for c in columns]
    key = f"{given[0].y.split('.')[0]}.{x[0]}"
    curves = tuple(replace(curve, x=curve.x or key) for curve in given)
    return ChartSpec(chart, sheet, title, "line", curves, x[1], y_title, x_is_angle=True, **more)


def only(place: Literal["workbook", "report"], *columns: str) -> tuple[Series, ...]:
    """Columns over the chart's angle that one of the two draws."""
    return tuple(Series("", column, only=place) for column in columns)


def columns_of(table: str, *keys: str) -> tuple[str, ...]:
    """Columns of one table as charts name them."""
    return tuple(f"{table}.{key}" for key in keys)


def polar(
    chart: str,
    sheet: str,
    title: str,
    axes: tuple[str, str],
    box: str,
    *curves: Series,
    x_reversed: bool = False,
    y_reversed: bool = False,
    **more: Unpack[More],
) -> ChartSpec:
    """Path of a vector's end; ``box`` is a grid's row with the common limits of both axes."""
    corners = Series(box, box, "оси", only="workbook", invisible=True)
    return ChartSpec(
        chart, sheet, title, "polar", (*curves, corners), *axes,
        x_reversed=x_reversed, y_reversed=y_reversed, **more,
    )  # fmt: skip


def wear_chart(
    chart: str, sheet: str, title: str, grid: str, hole: str,
    contact: tuple[str, ...] = (), **more: Unpack[More],
) -> ChartSpec:  # fmt: skip
    """Conditional wear diagram of a journal from the grid with the sums of its rays."""
    curves = (
        Series(f"{grid}.circle_x", f"{grid}.circle_y", "шейка"),
        Series(f"{grid}.wear_x", f"{grid}.wear_y", "износ"),
        Series(f"{grid}.hole_x", f"{grid}.hole_y", "отверстие", only="workbook", point=True),
    )
    return ChartSpec(
        chart, sheet, title, "wear", curves, x_reversed=True, hole=hole, contact=contact, **more
    )
