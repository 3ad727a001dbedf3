"""Charts as books write them, read into their descriptions."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

from reports.spec.charts import PHI, ChartSpec, Series

_HEAD = re.compile(
    r"(?P<id>\w+)(?P<report> report)?(?: over (?P<over>\w+)| in (?P<box>[\w.]+))?: (?P<title>.+)"
)
_FLAGS = ("stems", "extremes", "x_reversed", "y_reversed")
_TEXTS = ("figure", "caption", "x_tex", "y_tex", "group", "panel", "hole")


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
    def opened(cls, word: str, rest: str, sheet: str) -> ChartLines:
        """A chart from its heading.

        Raises:
            ValueError: it is none.
        """
        found = _HEAD.fullmatch(rest)
        if found is None:
            raise ValueError(f"заголовок «{word} {rest}» не разобран; пишите {word} ИМЯ: ЗАГОЛОВОК")
        return cls(cls.HEADS[word], found["id"], "" if found["report"] else sheet, found["title"],
                   found["over"] or "", found["box"] or "")  # fmt: skip

    def take(self, word: str, rest: str) -> ChartLines:
        """The chart with one more line.

        Raises:
            ValueError: the line says nothing of a chart.
        """
        if word == "curve":
            return replace(self, curves=(*self.curves, _curve(rest)))
        return replace(self, more={**self.more, **self._said(word, rest)})

    def _said(self, word: str, rest: str) -> dict[str, Any]:
        if word in ("x", "y"):
            return {f"{word}_title": rest}
        if word in _TEXTS:
            return {word: rest}
        if word in _FLAGS:
            return {word: True}
        if word == "x_step":
            return {word: float(rest)}
        if word == "floating":
            return {"from_zero": False}
        if word in ("levels", "contact"):
            return {word: tuple(rest.split())}
        if word == "pole":
            symbol, _, ordinate = rest.partition(" = ")
            return {"poles": (*self.more.get("poles", ()), (symbol, ordinate))}
        raise ValueError(f"слово «{word}» диаграмме неизвестно; слова диаграмм — в docs/books.md")

    def made(self) -> ChartSpec:
        """The description."""
        curves, more = self.curves, dict(self.more)
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


def _curve(rest: str) -> Series:
    """``[X] Y [workbook|report]: name``."""
    head, _, name = rest.partition(": ")
    refs = [word for word in head.split() if "." in word]
    words = [word for word in head.split() if "." not in word]
    only = next((word for word in words if word in ("workbook", "report")), "")
    if not 1 <= len(refs) <= 2 or set(words) - {only, "point"}:
        raise ValueError(f"«curve {rest}» не разобрано; пишите curve ТАБЛИЦА.X ТАБЛИЦА.Y: имя")
    return Series(refs[0] if len(refs) == 2 else "", refs[-1], name, only=only,  # type: ignore[arg-type]
                  point="point" in words)  # fmt: skip


def _wear_curves(grid: str) -> tuple[Series, ...]:
    return (
        Series(f"{grid}.circle_x", f"{grid}.circle_y", "шейка"),
        Series(f"{grid}.wear_x", f"{grid}.wear_y", "износ"),
        Series(f"{grid}.hole_x", f"{grid}.hole_y", "отверстие", only="workbook", point=True),
    )
