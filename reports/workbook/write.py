"""The workbook of an engine: all sheets with live formulas, caches and charts."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil

from lxml.etree import SerialisationError
from openpyxl import Workbook
from openpyxl.formatting.rule import CellIsRule
from openpyxl.styles import Alignment, Font, PatternFill
from openpyxl.utils import get_column_letter
from openpyxl.workbook.defined_name import DefinedName
from openpyxl.worksheet.cell_range import CellRange
from openpyxl.worksheet.hyperlink import Hyperlink
from openpyxl.worksheet.pagebreak import Break
from openpyxl.worksheet.worksheet import Worksheet
from openpyxl.writer.excel import ExcelWriter

from reports.shared.files import temporary_failure
from reports.spec.blocks import Grid, Model, ScalarTable, TableSpec
from reports.spec.evaluation import Values, evaluate_model
from reports.tables.gas.cycle_names import SHEET as CYCLE_SHEET
from reports.tables.gas.cycle_speed import RANGE_SHEET
from reports.tables.overview.left_out import left_out_note
from reports.workbook import styles
from reports.workbook.caches import finish
from reports.workbook.charts import make_chart, ranges_of, size
from reports.workbook.inputs import write_inputs
from reports.workbook.layout import (
    CONTENTS_SHEET,
    FIRST_ROW,
    HEADER_ROW,
    INPUT_SHEET,
    NOTE_ROW,
    NUMBER_ROW,
    SOURCE_COLUMN,
    TITLE_ROW,
    UNIT_COLUMN,
    VALUE_COLUMN,
    Cell,
    Layout,
    area,
    check_names,
    quoted,
)
from reports.workbook.sheets import CacheValues, Writer

_ROW_CM = 0.53
_COLUMN_CM = 1.95
_CHARACTER_CM = 0.25
_SLOT = 16  # rows that a chart takes, so that pages hold whole charts
_PORTRAIT_COLUMNS = 9
_MOST_CHECKS = 40
_REMARK_CHARACTERS = 60  # in a line of the widest column
_CYCLE_TITLES = {CYCLE_SHEET: "Расчет рабочего цикла"}
_CYCLE_WIDTHS = {2: 20, 4: 17, SOURCE_COLUMN: 28, 6: 17, 7: 17, 8: 17}
_RANGE_WIDTHS = {1: 76, 2: 4, 4: 16, SOURCE_COLUMN: 42}


def workbook_bytes(model: Model, values: Values | None = None) -> bytes:
    """The finished workbook as bytes; the same model gives the same bytes."""
    layout = Layout.of(model)
    check_names(layout)
    writer = Writer(layout, values or evaluate_model(model))
    return saved(assemble(model, writer), writer.caches)


def assemble(
    model: Model, writer: Writer, legend: Sequence[tuple[str, str]] = styles.LEGEND
) -> Workbook:
    """All sheets of a model's blocks, where the writer's layout puts them."""
    layout = writer.layout
    book = Workbook()
    book.remove(book.active)
    styles.add_styles(book)
    contents = book.create_sheet(CONTENTS_SHEET)
    inputs = book.create_sheet(INPUT_SHEET)
    _heading(inputs, "Исходные данные")
    write_inputs(inputs, model, layout)
    for title in model.sheets:
        _blocks(book.create_sheet(title), model, writer)
    _contents(contents, model, legend)
    for sheet in book.worksheets:
        _page(sheet, model, layout)
    for title in model.sheets:
        _charts(book[title], model, writer)
    for name, address in layout.defined_names().items():
        if name in model.fields or name in model.scalars:
            book.defined_names[name] = DefinedName(name, attr_text=address)
    book.properties.creator = "kshm"
    book.properties.title = f"{model.input.engine.name}: кинематика и динамика КШМ"
    book.calculation.fullCalcOnLoad = True
    return book


def saved(book: Workbook, caches: CacheValues) -> bytes:
    """The bytes of a workbook with the values of its formulas.

    Raises:
        OutputError: there is no room for temporary files.
    """
    stream = io.BytesIO()
    try:
        # As ``book.save`` does, but for the compression, which the finishing pass brings.
        with zipfile.ZipFile(stream, "w", zipfile.ZIP_STORED) as archive:
            ExcelWriter(book, archive).save()
    except (OSError, SerialisationError) as error:  # each sheet is a temporary file before
        raise temporary_failure(error) from None
    return finish(stream.getvalue(), caches)


def _heading(sheet: Worksheet, title: str) -> None:
    styles.as_text(sheet.cell(TITLE_ROW, 1, title)).style = styles.TITLE
    if sheet.title != CONTENTS_SHEET:
        _link(sheet, Cell(sheet.title, NOTE_ROW, 1), "← Содержание", CONTENTS_SHEET)


def _link(sheet: Worksheet, place: Cell, text: str, target: str) -> None:
    """A link within the book, as a place: an address such as ``#'Лист'!A1`` is a foreign file."""
    cell = sheet.cell(place.row, place.column, text)
    at = place.coordinate
    cell.hyperlink = Hyperlink(ref=at, location=f"{quoted(target)}!A1", display=text)
    cell.style = styles.LINK


def _blocks(sheet: Worksheet, model: Model, writer: Writer) -> None:
    blocks = [block for block in model.blocks if block.sheet == sheet.title]
    titles = {
        "Массы": "Размеры, массы и постоянные силы инерции",
        "Итоги": "Итоги расчёта",
        "Проверки": "Проверки",
        **_CYCLE_TITLES,
    }
    _heading(sheet, titles.get(sheet.title, blocks[0].title))
    notes = [block.note for block in blocks if block.note]
    for block in blocks:
        if isinstance(block, TableSpec):
            writer.table(sheet, block)
        elif isinstance(block, ScalarTable):
            writer.list(sheet, block)
            if block.verdicts is not None:
                _colour_verdicts(sheet, *block.verdicts)
            if block.id == "checks":
                _remarks(sheet, model.remarks)
        elif isinstance(block, Grid):
            writer.grid(sheet, block)
    if notes:
        _note(sheet, " ".join(dict.fromkeys(notes)))


def _colour_verdicts(sheet: Worksheet, good: str, bad: str) -> None:
    first, last = (
        Cell(sheet.title, row, UNIT_COLUMN) for row in (HEADER_ROW, HEADER_ROW + _MOST_CHECKS)
    )
    place = area(first, last)
    green, red = PatternFill(bgColor="C6EFCE"), PatternFill(bgColor="FFC7CE")
    sheet.conditional_formatting.add(place, CellIsRule("equal", [f'"{good}"'], fill=green))
    sheet.conditional_formatting.add(
        place, CellIsRule("equal", [f'"{bad}"'], fill=red, font=Font(bold=True, color="9C0006"))
    )


def _remarks(sheet: Worksheet, remarks: Sequence[str]) -> None:
    """Lines about the input below its checks: odd, or odd and explained."""
    if not remarks:
        return
    first = sheet.max_row + 2
    title = sheet.cell(first, 1, "Замечания к исходным данным при построении книги")
    title.style = styles.SUBTITLE
    for row, text in enumerate(remarks, first + 1):
        cell = styles.as_text(sheet.cell(row, 1, text))
        cell.style = styles.TEXT
        cell.alignment = Alignment(wrap_text=True, vertical="top")
        sheet.row_dimensions[row].height = 15 * ceil(len(text) / _REMARK_CHARACTERS)


def _contents(sheet: Worksheet, model: Model, legend: Sequence[tuple[str, str]]) -> None:
    report = model.input.report
    _heading(sheet, report.title or "Кинематика и динамика КШМ")
    people = [
        ("Двигатель", model.input.engine.name),
        ("Студент", report.student),
        ("Группа", report.group),
        ("Вариант", report.variant),
        ("Руководитель", report.supervisor),
    ]
    row = 3
    for label, text in people:
        if text:
            sheet.cell(row, 1, label).style = styles.TEXT
            styles.as_text(sheet.cell(row, 2, text)).style = styles.TEXT
            row += 1
    row += 1
    sheet.cell(row, 1, "Листы").style = styles.SUBTITLE
    described = {INPUT_SHEET: "Размеры, режим, газы, массы, коленчатый вал"}
    for block in model.blocks:
        described.setdefault(block.sheet, _CYCLE_TITLES.get(block.sheet, block.title))
    for title, text in described.items():
        row += 1
        _link(sheet, Cell(sheet.title, row, 1), title, title)
        sheet.cell(row, 2, text).style = styles.TEXT
    row += 2
    sheet.cell(row, 1, "Цвета ячеек").style = styles.SUBTITLE
    for style, text in legend:
        row += 1
        sheet.cell(row, 1, "образец").style = style
        sheet.cell(row, 2, text).style = styles.TEXT
    sheet.column_dimensions["A"].width = 26
    sheet.column_dimensions["B"].width = 95
    missing = left_out_note(model.input)
    if missing:
        cell = styles.as_text(sheet.cell(row + 2, 2, missing))
        cell.style = styles.NOTE
        cell.alignment = Alignment(wrap_text=True, vertical="top")
        sheet.row_dimensions[row + 2].height = 15 * ceil(len(missing) / 90)


def _charts(sheet: Worksheet, model: Model, writer: Writer) -> None:
    layout = writer.layout
    specs = [spec for spec in model.charts if spec.sheet == sheet.title]
    if not specs:
        return
    column, page = sheet.max_column + 2, page_of(sheet)
    offset = 0
    for spec in specs:
        height = _SLOT * ceil(size(spec)[1] / _ROW_CM / _SLOT)
        if offset % page.rows + height > page.rows:  # not across a page break
            offset = page.rows * ceil(offset / page.rows)
        place = Cell(sheet.title, FIRST_ROW + offset, column)
        sheet.add_chart(make_chart(spec, layout, writer.values), place.coordinate)
        writer.caches.ranges |= ranges_of(spec, layout, writer.values)
        offset += height
    columns = round(max(size(spec)[0] for spec in specs) / _COLUMN_CM) + 1
    last = Cell(sheet.title, FIRST_ROW + offset - 1, column + columns)
    sheet.print_area = [
        str(sheet.print_area).replace("$", "").split("!")[-1],
        area(Cell(sheet.title, FIRST_ROW, column), last),
    ]
    rows = max(offset, sheet.max_row)
    for row in range(FIRST_ROW - 1 + page.rows, FIRST_ROW + rows, page.rows):
        sheet.row_breaks.append(Break(id=row))


@dataclass(frozen=True, slots=True)
class Page:
    """How a sheet goes to paper: landscape, scale in percent, rows to a page."""

    landscape: bool
    scale: int
    rows: int


def page_of(sheet: Worksheet) -> Page:
    """A4 page for a sheet with tables: whole columns, pages a multiple of a chart's slot."""
    landscape = sheet.max_column > _PORTRAIT_COLUMNS
    # Height of the sheet of paper less the titles that repeat on each page.
    width, height, most = (26.0, 12.9, 0.75) if landscape else (17.5, 21.8, 0.8)
    widths = (
        sheet.column_dimensions[get_column_letter(i)].width for i in range(1, sheet.max_column + 1)
    )
    scale = min(most, width / (sum(widths) * _CHARACTER_CM))
    return Page(landscape, int(scale * 100), max(1, int(height / _ROW_CM / scale / _SLOT)) * _SLOT)


def _page(sheet: Worksheet, model: Model, layout: Layout) -> None:
    """Widths, frozen headers and print set-up of a sheet, before its charts are placed."""
    blocks = [block for block in model.blocks if block.sheet == sheet.title]
    tables = [block for block in blocks if isinstance(block, TableSpec)]
    last_row, last_column = sheet.max_row, sheet.max_column
    if tables:
        sheet.freeze_panes = Cell(sheet.title, FIRST_ROW, 2).coordinate
        sheet.print_title_rows = f"{HEADER_ROW - 1}:{NUMBER_ROW}"
        _widths(sheet, dict.fromkeys(range(1, last_column + 1), 11.5))
        for block in blocks:
            if isinstance(block, ScalarTable):
                first = layout.places[block.id].column
                _widths(sheet, {first + i: width for i, width in enumerate((40, 12, 13, 8, 26))})
        sheet.row_dimensions[HEADER_ROW].height = 48
        # The same row height everywhere, else the slots of the charts drift from the pages.
        sheet.sheet_format.defaultRowHeight = 15
        sheet.sheet_format.customHeight = True
    elif sheet.title != CONTENTS_SHEET:
        sheet.freeze_panes = Cell(sheet.title, HEADER_ROW, 1).coordinate
        wide = {1: 62, 2: 16, VALUE_COLUMN: 16, 4: 12, SOURCE_COLUMN: 26, 6: 32}
        if sheet.title in (CYCLE_SHEET, RANGE_SHEET):
            wide |= _CYCLE_WIDTHS if sheet.title == CYCLE_SHEET else _RANGE_WIDTHS
        _widths(sheet, {i: wide.get(i, 14) for i in range(1, last_column + 1)})
    sheet.print_area = f"A1:{Cell('', last_row, last_column).coordinate}"
    sheet.page_setup.paperSize = sheet.PAPERSIZE_A4
    if tables:
        page = page_of(sheet)
        sheet.page_setup.orientation = "landscape" if page.landscape else "portrait"
        sheet.page_setup.scale = page.scale
    else:
        sheet.page_setup.orientation = "landscape" if last_column > 9 else "portrait"
        sheet.page_setup.fitToWidth, sheet.page_setup.fitToHeight = 1, 0
        sheet.sheet_properties.pageSetUpPr.fitToPage = True
    sheet.oddFooter.center.text = "&A — лист &P из &N"
    sheet.page_margins.left, sheet.page_margins.right = 0.8, 0.4


def _widths(sheet: Worksheet, widths: dict[int, float]) -> None:
    for column, width in widths.items():
        sheet.column_dimensions[get_column_letter(column)].width = width


def _note(sheet: Worksheet, text: str) -> None:
    """A note across the sheet's columns, as high as its text."""
    last = max(10, min(sheet.max_column, 16))
    cell = sheet.cell(NOTE_ROW, 3, text)
    cell.style = styles.NOTE
    cell.alignment = Alignment(wrap_text=True, vertical="top")
    # Not merge_cells, which compares the borders of cells that have none.
    area = CellRange(min_row=NOTE_ROW, min_col=3, max_row=NOTE_ROW, max_col=last)
    sheet.merged_cells.add(area)
    sheet.cell(NOTE_ROW, last)  # the note's width counts as the sheet's
    sheet.row_dimensions[NOTE_ROW].height = 14 * ceil(len(text) / ((last - 2) * 13)) + 4
