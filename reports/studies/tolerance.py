"""Bands of results within tolerances as a file: a book, a page with a figure, or plain numbers."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from markupsafe import Markup
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.worksheet import Worksheet

from kshm.chain.solve import solve_batch
from kshm.engine.engine import Engine
from kshm.results.chosen import ChosenQuantities, described
from kshm.results.tolerance import Bands, ResultBand
from reports.document.figures.canvas import LineStyle, Sheet
from reports.document.page.blocks import DocumentInfo, TableColumn, table_block
from reports.document.page.numbering import Draft
from reports.document.text.texts import spaces_inside
from reports.shared.errors import InputError, Problem
from reports.shared.files import write_bytes, write_text
from reports.shared.russian import NBSP, capital, fixed, short, uncapital
from reports.studies.comparison_page import NumberedBlock
from reports.studies.quantities import choose, format_of, symbol_of
from reports.workbook.caches import finish
from reports.workbook.sheets import CacheValues
from reports.workbook.simple_workbook import bold, lay, new_book

SUFFIXES = (".xlsx", ".html", ".csv")
_TITLE = "Допуски и разброс результатов"
_HEADS = ("Величина", "Единица", "По номиналам", "2,5 %", "50 %", "97,5 %", "Наименьшее",
          "Наибольшее", "Сильнее всего влияет", "Ранговая корреляция")  # fmt: skip
_WIDTHS = (60, 10, 14, 14, 14, 14, 14, 14, 36, 14)
_LEFT, _RIGHT, _ROW, _FOOT = 110.0, 20.0, 18.0, 26.0  # pt of the figure
_WIDTH_MM, _TICKS = 165.0, 5
_BAR, _LINE = "#9db8d9", LineStyle(1.2)
_GRID, _AXIS = LineStyle(0.5, colour="#c8c8c8"), LineStyle(0.9)
_MAX_BARS = 24


@dataclass(frozen=True, slots=True)
class Described:
    """Bands with the words of their results."""

    bands: Bands
    chosen: ChosenQuantities
    engine: Engine

    def titled(self, band: ResultBand) -> tuple[str, str]:
        """Return the title and the unit of a result."""
        title, unit = described(band.name, self.chosen)
        return capital(title), unit

    def input(self, key: str) -> str:
        """Return what an input is called."""
        source = self.engine.source
        return source.title(key) if source is not None and key else key

    def rows(self) -> Iterator[list[str | float]]:
        """Yield a row a result."""
        for band in self.bands.bands:
            title, unit = self.titled(band)
            numbers = (band.base, band.low, band.middle, band.high, band.least, band.greatest)
            rank = band.ranks.get(band.first, 0.0)
            yield [title, unit, *numbers, self.input(band.first), rank]


def check_suffix(target: Path) -> None:
    """Refuse a target whose ending is none of ``SUFFIXES``.

    Raises:
        InputError: it is another.
    """
    if target.suffix.lower() not in SUFFIXES:
        problem = f"нужно окончание {', '.join(SUFFIXES)}"
        raise InputError(Problem(str(target), problem, "укажите его в ключе -o"))


def write(bands: Bands, engine: Engine, quantities: Sequence[str], target: Path) -> None:
    """Write the bands to a file by its ending.

    Raises:
        OutputError: the file cannot be written.
    """
    source = engine.source
    chosen = choose(solve_batch([engine]), quantities, source.cycle if source else None)
    study = Described(bands, chosen, engine)
    kind = target.suffix.lower()
    if kind == ".xlsx":
        write_bytes(target, _book(study))
    elif kind == ".html":
        write_text(target, _page(study))
    else:
        write_text(target, _csv(study))


def _csv(study: Described) -> str:
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    inputs = list(study.bands.tolerances)
    writer.writerow(["name", "base", "q025", "q50", "q975", "min", "max", "first", *inputs])
    for band in study.bands.bands:
        numbers = (band.base, band.low, band.middle, band.high, band.least, band.greatest)
        ranks = (band.ranks[name] for name in inputs)
        writer.writerow([band.name, *map(repr, numbers), band.first, *map(repr, ranks)])
    return stream.getvalue()


def _book(study: Described) -> bytes:
    book = new_book()
    sheet = _sheet(book.create_sheet("Разброс"), _TITLE, _HEADS, _WIDTHS)
    for row, band in zip(study.rows(), study.bands.bands, strict=True):
        sheet.append(row)
        for cell in sheet[sheet.max_row][2:8]:
            cell.number_format = f"{format_of(band.name, study.chosen)}"
        sheet.cell(sheet.max_row, len(_HEADS)).number_format = "0.00"
    lay(sheet, rows="3:3")
    inputs = list(study.bands.tolerances)
    heads = ("Величина", *map(study.input, inputs))
    sheet = _sheet(book.create_sheet("Влияние"), "Ранговая корреляция с допусками", heads,
                   (60, *[22] * len(inputs)))  # fmt: skip
    sheet.append(["Допуск ±", *study.bands.tolerances.values()])
    for band in study.bands.bands:
        sheet.append([study.titled(band)[0], *(band.ranks[name] for name in inputs)])
    for cells in sheet.iter_rows(min_row=5, min_col=2):
        for cell in cells:
            cell.number_format = "0.00"
    lay(sheet, rows="3:3")
    frame = study.bands.samples
    heads = tuple(map(str, frame.columns))
    sheet = _sheet(book.create_sheet("Выборка"), "Выборка", heads, [18] * len(heads))
    for line in frame.itertuples(index=False):
        sheet.append(list(line))
    lay(sheet, rows="3:3", columns="A:A")
    return finish(book, CacheValues())


def _sheet(
    sheet: Worksheet, title: str, heads: Sequence[str], widths: Sequence[float]
) -> Worksheet:
    for number, width in enumerate(widths, 1):
        sheet.column_dimensions[get_column_letter(number)].width = width
    bold(sheet.cell(1, 1, title), size=13)
    for number, text in enumerate(heads, 1):
        bold(sheet.cell(3, number, text), head=True)
    sheet.freeze_panes = "B4"
    return sheet


def _page(study: Described) -> str:
    from reports.document.page.render import environment

    numbering = Draft()
    bands = study.bands
    inputs = table_block(
        [TableColumn("Величина", 3, text=True), TableColumn("Допуск ±", 1)],
        [[study.input(name), short(half)] for name, half in bands.tolerances.items()],
    )
    columns = [TableColumn("Величина", 2.6, text=True), *(TableColumn(text, 1) for text in
               ("Номинал", "2,5 %", "50 %", "97,5 %")), TableColumn("Главный допуск", 2, text=True),
               TableColumn("Ранговая ρ", 1)]  # fmt: skip
    rows = []
    for band in bands.bands:
        title, unit = study.titled(band)
        numbers = (band.base, band.low, band.middle, band.high)
        rank = fixed(band.ranks.get(band.first, 0.0), 2)
        named = f"{title}, {unit}" if unit else title
        rows.append([named, *map(_number, numbers), study.input(band.first), rank])
    first = numbering.section(1, "Допуски")
    tables = [(first, NumberedBlock(inputs, numbering.place("table", "inputs"),
                                    "Допуски исходных данных"))]  # fmt: skip
    second = numbering.section(1, "Разброс результатов")
    tables.append((second, NumberedBlock(table_block(columns, rows),
                                         numbering.place("table", "bands"),
                                         "Результаты в пределах допусков")))  # fmt: skip
    drawn = numbering.section(1, "Диаграмма")
    figure = NumberedBlock(Markup(bands_figure(study)), numbering.place("figure", "bands"),
                           "Пределы 95 % результатов, в процентах от номинала")  # fmt: skip
    count = len(bands.samples)
    words = (
        f"Двигателей в выборке {count}: каждая величина с равной вероятностью в пределах своего "
        f"допуска (латинский гиперкуб). Между 2,5 % и 97,5 % лежат 95{NBSP}% двигателей."
    )
    page = environment(media="screen").get_template("tolerance/page.html.j2").render(
        doc=DocumentInfo(_TITLE, subject=study.engine.name), title=_TITLE, engine=study.engine.name,
        words=words, tables=tables, drawn=drawn, figure=figure, sentences=list(_sentences(study)),
    )  # fmt: skip
    return spaces_inside(page)


def _number(value: float) -> str:
    return short(float(f"{value:.5g}"))


def _sentences(study: Described) -> Iterator[str]:
    """Yield what the figures say: the widest band and its cause, engines without a result."""
    wide = [band for band in study.bands.bands if band.base]
    if wide:
        band = max(wide, key=lambda each: (each.high - each.low) / abs(each.base))
        percent = 50 * (band.high - band.low) / abs(band.base)
        yield (
            f"Больше всех меняется величина «{study.titled(band)[0].lower()}»: "
            f"±{fixed(percent, 1)}{NBSP}% от номинала; сильнее всего на неё влияет величина "
            f"«{uncapital(study.input(band.first))}»."
        )
    if study.bands.failed:
        yield f"Двигателей, которые не проходят проверку: {study.bands.failed}; в разброс не вошли."


def bands_figure(study: Described) -> str:
    """Return the bands in per cent of the base, one below the other, as SVG."""
    shown = [band for band in study.bands.bands if band.base][:_MAX_BARS]
    spans = [
        (100 * (band.low / band.base - 1), 100 * (band.high / band.base - 1)) for band in shown
    ]
    most = max((abs(end) for span in spans for end in span), default=1.0) or 1.0
    height = _ROW * len(shown) + _FOOT
    sheet = Sheet(_WIDTH_MM, height / (sheet_points := 72 / 25.4))
    field = _WIDTH_MM * sheet_points - _LEFT - _RIGHT
    middle = _LEFT + field / 2

    def across(percent: float) -> float:
        return middle + percent / most * field / 2

    for tick in range(-_TICKS, _TICKS + 1):
        x = across(most * tick / _TICKS)
        sheet.line([(x, _FOOT), (x, height)], _AXIS if tick == 0 else _GRID, 1)
        if tick % _TICKS == 0 or abs(tick) * 2 == _TICKS + 1:
            sheet.text((x, _FOOT - 12), f"{fixed(most * tick / _TICKS, 2)} %", 8.5)
    for row, (band, span) in enumerate(zip(shown, spans, strict=True)):
        y = height - _ROW * (row + 0.5)
        low, high = map(across, span)
        box = [(low, y - 5), (high, y - 5), (high, y + 5), (low, y + 5)]
        sheet.shape(box, _BAR, LineStyle(0.7), 2)
        mark = across(100 * (band.middle / band.base - 1))
        sheet.line([(mark, y - 5), (mark, y + 5)], _LINE, 3)
        sheet.text((_LEFT - 8, y), symbol_of(band.name, study.chosen), 9.5, align=1.0)
    return sheet.svg()
