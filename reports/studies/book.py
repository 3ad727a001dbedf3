"""A study as a workbook: all combinations, extremes of each quantity, charts against the input."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from openpyxl import Workbook
from openpyxl.cell import WriteOnlyCell
from openpyxl.styles import Alignment, Font
from openpyxl.utils import get_column_letter

from reports.shared.errors import InputError, Problem
from reports.shared.russian import capital, short, uncapital
from reports.studies.plan import Axis, Plan, span_text
from reports.studies.points import Chunk
from reports.studies.quantities import Wanted, described, format_of, symbol_of
from reports.workbook.caches import finish
from reports.workbook.charts import curves_chart
from reports.workbook.drawn import Curve
from reports.workbook.gallery import hang, lay
from reports.workbook.layout import Cell, column_range
from reports.workbook.sheets import CacheValues
from reports.workbook.styles import FONT

MOST_ROWS = 100_000
MOST_CURVES = 12
MOST_CHARTS = 24
DATA, SUMMARY, CHARTS = "Результаты", "Сводка", "Диаграммы"
_FIRST = 3  # rows of keys and titles stand above
_NOWHERE = "не меняется"  # the place of an extreme of what stays the same
# Shown where nothing is asked for.
_USUAL = ("M_mean", "M_max", "M_e", "N_i_calc", "Rpin_max", "q_pin_max", "worst_main_load")


@dataclass
class _Extreme:
    """Greatest and least value of a quantity and the combinations where they stand."""

    largest: float = -math.inf
    smallest: float = math.inf
    at_largest: tuple[float | int, ...] = ()
    at_smallest: tuple[float | int, ...] = ()

    def see(self, value: float, row: tuple[float | int, ...]) -> None:
        """Take one value into account."""
        if value > self.largest:
            self.largest, self.at_largest = value, row
        if value < self.smallest:
            self.smallest, self.at_smallest = value, row


@dataclass
class StudyBook:
    """Writes rows as they come; only what the charts show is kept."""

    plan: Plan
    wanted: Wanted
    _extremes: dict[str, _Extreme] = field(default_factory=dict)
    _shown: dict[str, list[float]] = field(default_factory=dict)
    _formats: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        if self.plan.count > MOST_ROWS:
            what = f"сочетаний {self.plan.count}, а в книге помещается {MOST_ROWS}"
            raise InputError(Problem("-o", what, "выберите .parquet или .csv"))
        self._book = Workbook(write_only=True)
        self._book.properties.creator = "kshm"
        self._first = self._book.create_sheet(SUMMARY)
        self._drawn = self._book.create_sheet(CHARTS) if self._charted() else None
        self._data = self._book.create_sheet(DATA)  # the long sheet comes last
        names = self.wanted.names
        self._extremes = {name: _Extreme() for name in names}
        self._shown = {name: [] for name in self._charted()}
        for number, text in enumerate([*(axis.key for axis in self.plan.axes), *names, "error"], 1):
            self._data.column_dimensions[get_column_letter(number)].width = max(16, len(text) + 3)
        self._data.row_dimensions[1].height, self._data.row_dimensions[2].height = 20, 62
        self._formats = [format_of(name) for name in names]
        self._data.freeze_panes = Cell(DATA, _FIRST, len(self.plan.axes) + 1).coordinate
        last = get_column_letter(len(self.plan.axes))
        lay(self._data, rows=f"1:{_FIRST - 1}", columns=f"A:{last}")
        keys = [axis.key for axis in self.plan.axes]
        titles = [_headed(axis.title, axis.unit) for axis in self.plan.axes]
        titles += [_headed(*described(name)) for name in names]
        self._data.append([self._head(text) for text in (*keys, *names, "error")])
        self._data.append([self._head(text) for text in (*titles, "Почему нет результата")])

    def _head(self, text: str) -> WriteOnlyCell:
        cell = WriteOnlyCell(self._data, text)
        cell.font = Font(name=FONT, bold=True)
        cell.alignment = Alignment(wrap_text=True, vertical="center", horizontal="center")
        return cell

    def _charted(self) -> list[str]:
        """Quantities with a chart each: those asked for, or the usual ones."""
        if len(self.plan.axes) > 2 and not self.plan.pairwise:
            return []
        names = [name for name in self.wanted.names if not name.endswith("_deg")]
        usual = [name for name in names if name in _USUAL]
        return (usual or names)[:MOST_CHARTS] if len(names) > MOST_CHARTS else names

    def write(self, chunk: Chunk) -> None:
        """Append rows; what has no result stays empty and says why."""
        names = self.wanted.names
        columns = [chunk.values[name].tolist() for name in names]
        for row, values, error in zip(
            chunk.rows, zip(*columns, strict=True), chunk.errors, strict=True
        ):
            numbers = [None] * len(names) if error else self._numbers(values)
            self._data.append([*row, *numbers, error or None])
            for name, value in zip(names, values, strict=True):
                if not error:
                    self._extremes[name].see(value, row)
                if name in self._shown:
                    self._shown[name].append(math.nan if error else value)

    def _numbers(self, values: Sequence[float]) -> list[WriteOnlyCell]:
        cells = []
        for value, form in zip(values, self._formats, strict=True):
            cell = WriteOnlyCell(self._data, value)
            cell.number_format = form
            cells.append(cell)
        return cells

    def close(self) -> None:
        """Give up: the sheet is a file under way."""
        self._data.close()

    def data(self) -> bytes:
        """The finished workbook."""
        self._summary()
        ranges = self._charts()
        return finish(self._book, CacheValues(ranges=ranges))

    def _summary(self) -> None:
        sheet = self._first
        lay(sheet, rows=f"{len(self.plan.axes) + 2}:{len(self.plan.axes) + 2}")
        for letter, width in (("A", 26), ("B", 60), ("C", 12)):
            sheet.column_dimensions[letter].width = width
        for number in range(4, 6 + 2 * len(self.plan.axes)):
            sheet.column_dimensions[get_column_letter(number)].width = 17
        for axis in self.plan.axes:
            sheet.append([axis.key, span_text(axis)])
        sheet.append([])
        keys = [axis.key for axis in self.plan.axes]
        sheet.append(
            [self._head(text) for text in
             ("Ключ", "Величина", "Единица", "Наибольшее", *[f"при {key}" for key in keys],
              "Наименьшее", *[f"при {key}" for key in keys])]
        )  # fmt: skip
        for name, found in self._extremes.items():
            if found.at_largest:
                title, unit = described(name)
                largest, smallest = (
                    WriteOnlyCell(sheet, v) for v in (found.largest, found.smallest)
                )
                largest.number_format = smallest.number_format = format_of(name)
                still = _level((found.smallest, found.largest)) is not None
                places = [
                    (_NOWHERE,) * len(keys) if still else at
                    for at in (found.at_largest, found.at_smallest)
                ]
                sheet.append([name, title, unit, largest, *places[0], smallest, *places[1]])

    def _charts(self) -> dict[str, list[float]]:
        """One chart a quantity; the numbers of their ranges."""
        ranges: dict[str, list[float]] = {}
        sheet = self._drawn
        if sheet is None:
            return ranges
        x = self.plan.axes[0]
        names = self.wanted.names
        charts = []
        for name, values in self._shown.items():
            column = len(self.plan.axes) + 1 + names.index(name)
            curves = []
            for label, first, count in self._runs():
                if not any(map(math.isfinite, values[first : first + count])):
                    continue  # none of its combinations has a result: a key would name no curve
                rows = (_FIRST + first, _FIRST + first + count - 1)
                curve = Curve(
                    label, column_range(DATA, 1, *rows), column_range(DATA, column, *rows)
                )
                ranges[curve.x] = [float(value) for value in x.values[:count]]
                ranges[curve.y] = values[first : first + count]
                curves.append(curve)
            if not curves:
                continue
            title, unit = described(name)
            title = capital(title)
            if all(curve.name for curve in curves):
                title += f"; кривые: {uncapital(self.plan.axes[1].title)}"
            ends = (float(min(x.values)), float(max(x.values)))
            chart = curves_chart(
                title, _headed(x.title, x.unit), _headed(symbol_of(name), unit), curves, ends
            )
            level = _level(values)
            if level is not None:  # else the axis would show rounding
                span = abs(level) / 10 or 1.0
                chart.y_axis.scaling.min, chart.y_axis.scaling.max = level - span, level + span
            charts.append(chart)
        hang(sheet, charts, 1)
        return ranges

    def _runs(self) -> Iterator[tuple[str, int, int]]:
        """Rows of each curve: all of them, or those of one value of the second input."""
        axes = self.plan.axes
        if len(axes) == 1 or self.plan.pairwise:
            yield "", 0, self.plan.count
            return
        count, second = len(axes[0].values), axes[1]
        step = max(1, math.ceil(len(second.values) / MOST_CURVES))
        for number in range(0, len(second.values), step):
            yield _valued(second, number), number * count, count


def _level(values: Sequence[float]) -> float | None:
    """The value of a quantity that stays the same but for rounding."""
    known = [value for value in values if math.isfinite(value)]
    if not known or max(known) - min(known) > 1e-9 * max(map(abs, known)):
        return None
    return float(f"{known[0]:.6g}")


def _valued(axis: Axis, number: int) -> str:
    unit = f" {axis.unit}" if axis.unit else ""
    return f"{short(axis.values[number])}{unit}"


def _headed(title: str, unit: str) -> str:
    return f"{title}, {unit}" if unit else title
