"""What a chart is: one description from which the workbook and the report draw it."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Literal

from reports.shared.russian import NBSP

PHI = "φ, ° ПКВ"
_HEAD = re.compile(
    r"(?P<id>\w+)(?P<report> report)?(?: over (?P<over>\w+)| in (?P<box>[\w.]+))?: (?P<title>.+)"
)
_FLAGS = ("stems", "extremes", "x_reversed", "y_reversed")
_TEXTS = ("figure", "caption", "x_tex", "y_tex", "group", "panel", "hole")


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
        number = f"Рис.{NBSP}{self.number}. " if self.number else ""
        textbook = f" [рис.{NBSP}{self.figure}]" if self.figure else ""
        return f"{number}{self.title}{textbook}"

    @property
    def equal_axes(self) -> bool:
        """Whether both axes have one scale: the plot is square."""
        return self.kind != "line"

    @property
    def words(self) -> str:
        """Caption of the report's figure."""
        return self.caption or self.title

    def drawn_by(self, medium: Literal["workbook", "report"]) -> tuple[Series, ...]:
        """Curves that the workbook or the report draws."""
        return tuple(s for s in self.series if s.only in ("", medium))


@dataclass(frozen=True)
class ChartLines:
    """A chart as far as it is read.

    ``chart``: curves in rectangular coordinates, with ``over KEY`` over that angle of the first
    curve's table; ``polar``: the path of a vector, ``in BOX`` names the row with the limits of its
    axes; ``wear``: a wear diagram, ``in GRID`` names its sums; ``scheme``: lines in a unit square.
    """

    HEADS: ClassVar[dict[str, str]] = {
        "chart": "line", "polar": "polar", "wear": "wear", "scheme": "scheme",
    }  # fmt: skip

    kind: str
    id: str
    sheet: str
    title: str
    over: str = ""
    box: str = ""
    curves: tuple[Series, ...] = ()
    more: dict[str, Any] = field(default_factory=dict)

    @classmethod
    def opened(cls, word: str, tail: str, sheet: str) -> ChartLines:
        """Return a chart from its heading.

        Raises:
            ValueError: it is none.
        """
        head = _HEAD.fullmatch(tail)
        if head is None:
            raise ValueError(f"заголовок «{word} {tail}» не разобран; пишите {word} ИМЯ: ЗАГОЛОВОК")
        return cls(cls.HEADS[word], head["id"], "" if head["report"] else sheet, head["title"],
                   head["over"] or "", head["box"] or "")  # fmt: skip

    def take(self, word: str, tail: str) -> ChartLines:
        """Return the chart with one more line.

        Raises:
            ValueError: the line says nothing of a chart.
        """
        if word == "curve":
            return replace(self, curves=(*self.curves, _curve(tail)))
        return replace(self, more={**self.more, **self._said(word, tail)})

    def _said(self, word: str, tail: str) -> dict[str, Any]:
        if word in ("x", "y"):
            return {f"{word}_title": tail}
        if word in _TEXTS:
            return {word: tail}
        if word in _FLAGS:
            return {word: True}
        if word == "x_step":
            return {word: _step(tail)}
        if word == "floating":
            return {"from_zero": False}
        if word in ("levels", "contact"):
            return {word: tuple(tail.split())}
        if word == "pole":
            symbol, _, ordinate = tail.partition(" = ")
            return {"poles": (*self.more.get("poles", ()), (symbol, ordinate))}
        raise ValueError(f"слово «{word}» диаграмме неизвестно; слова диаграмм — в docs/books.md")

    def made(self) -> ChartSpec:
        """Return the description.

        Raises:
            ValueError: there is nothing to draw.
        """
        curves, more = self.curves, dict(self.more)
        if not (curves or self.kind == "wear"):
            raise ValueError(f"у диаграммы «{self.id}» нет кривых; допишите curve ТАБЛИЦА.КЛЮЧ")
        if self.kind in ("polar", "wear") and not self.box:
            raise ValueError(
                f"у диаграммы «{self.id}» нет осей; пишите {self.kind} ИМЯ in СЕТКА: …"
            )
        if self.kind != "wear" and not self.over and any(not curve.x for curve in curves):
            raise ValueError(f"у кривых «{self.id}» нет абсциссы; пишите chart ИМЯ over phi_deg: …")
        if self.over:
            key = f"{curves[0].y.split('.')[0]}.{self.over}"
            curves = tuple(replace(curve, x=curve.x or key) for curve in curves)
            more = {"x_title": PHI, "x_is_angle": True} | more
        elif self.kind == "polar":
            curves = (*curves, Series(self.box, self.box, "оси", only="workbook", invisible=True))
        elif self.kind == "wear":
            curves = _wear_curves(self.box)
            more["x_reversed"] = True
        return ChartSpec(self.id, self.sheet, self.title, self.kind, curves, **more)  # type: ignore[arg-type]


def _step(text: str) -> float:
    """Return a step of an axis.

    Raises:
        ValueError: it is none.
    """
    step = float(text) if re.fullmatch(r"\d+(?:\.\d+)?", text) else 0.0
    if not step > 0:
        raise ValueError(f"шаг оси «{text}» не разобран; пишите x_step 30")
    return step


def _curve(tail: str) -> Series:
    """``[X] Y [workbook|report]: name``."""
    head, _, name = tail.partition(": ")
    refs = [word for word in head.split() if "." in word]
    words = [word for word in head.split() if "." not in word]
    only = next((word for word in words if word in ("workbook", "report")), "")
    if not 1 <= len(refs) <= 2 or set(words) - {only, "point"}:
        raise ValueError(f"«curve {tail}» не разобрано; пишите curve ТАБЛИЦА.X ТАБЛИЦА.Y: имя")
    return Series(refs[0] if len(refs) == 2 else "", refs[-1], name, only=only,  # type: ignore[arg-type]
                  point="point" in words)  # fmt: skip


def _wear_curves(grid: str) -> tuple[Series, ...]:
    return (
        Series(f"{grid}.circle_x", f"{grid}.circle_y", "шейка"),
        Series(f"{grid}.wear_x", f"{grid}.wear_y", "износ"),
        Series(f"{grid}.hole_x", f"{grid}.hole_y", "отверстие", only="workbook", point=True),
    )
