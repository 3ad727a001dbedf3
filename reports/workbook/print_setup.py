"""Print areas, page breaks, column widths, frozen headers."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from itertools import accumulate, pairwise
from math import ceil, floor, isfinite

import numpy as np
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.pagebreak import Break
from openpyxl.worksheet.worksheet import Worksheet

from kshm.nomenclature.quantity import Quantity
from reports.model.blocks import Block, Grid, Model, ScalarTable, TableSpec, scalars_of
from reports.model.evaluation import Values
from reports.shared.russian import written
from reports.workbook.layout import (
    FIRST_ROW,
    HEADER_ROW,
    INPUT_SHEET,
    KEY_COLUMN,
    MAX_COLUMN,
    MIN_COLUMN,
    NUMBER_ROW,
    SOURCE_COLUMN,
    VALUE_COLUMN,
    Cell,
    Layout,
    area,
)
from reports.workbook.places import (
    DIGIT,
    Box,
    column_px,
    extent,
    last_cell,
    room_of,
    row_px,
    wrap_across,
)
from reports.workbook.sheets import (
    NARROW,
    SOURCE_WIDTH,
    SYMBOL_WIDTH,
    TITLE_WIDTH,
    decimals_in,
)
from reports.workbook.styles import HEADER, SUBTITLE, blanks

_LIST = {
    1: TITLE_WIDTH, 2: SYMBOL_WIDTH, VALUE_COLUMN: 14, 4: 11,
    SOURCE_COLUMN: SOURCE_WIDTH, KEY_COLUMN: 30,
}  # fmt: skip
_LIMIT = 8  # width of the columns of limits
_SUBTITLE_LETTER = 1.18  # in digits of a column: bold and larger
_THIN, _HEADER_LETTER = 0.65, 1.25  # the same of thin letters and of others of a header
_HEADER_LINE = 16  # pt
_CORNER = 10.5  # width of «Величина»
_NAME = 34  # of a text among the numbers of a record at most
_TABLE_LINES = 2  # of a table's header at least
_THIN_LETTERS, _EDGES = frozenset(" ()ijlt1/·.,'"), 1.5
_BESIDE, _WIDEST = (34, 10, 11, 8, 20), 64  # of a list beside a table
_CYCLE_WIDTHS = {2: 20, 4: 17, SOURCE_COLUMN: 28, 6: 17, 7: 17, 8: 17}
_RANGE_WIDTHS = {1: 76, 2: 4, 4: 16, SOURCE_COLUMN: 42}
_WIDTHS_WITH = {"cycle_fuel": _CYCLE_WIDTHS, "cycle_ranges": _RANGE_WIDTHS}  # by a sheet's block
UPRIGHT = 1290  # px: wider sheets lie
PAPER = {"portrait": (690, 1010), "landscape": (1030, 670)}  # px: A4 less its margins
_MIN_SCALE = 0.45  # scale below which a sheet rather takes more pages, down and across
SURE = 0.93  # part of the paper that no program's own widths of columns go beyond
_BEGINNING = 3  # rows of a long list that stand with its heading
_FINE = 54  # per cent to which nothing is made smaller only to save a page
_SHOWN_ROWS = 40  # of a helper sheet
_SQUEEZED = 0.3  # what is made smaller by less than this saves a page


def set_widths(sheet: Worksheet, model: Model, layout: Layout, values: Values) -> None:
    """Widths of columns, frozen headers, folded columns that only serve formulas."""
    blocks = [block for block in model.blocks if block.sheet == sheet.title]
    tables = [block for block in blocks if isinstance(block, TableSpec)]
    last = sheet.max_column
    if not tables:
        sheet.freeze_panes = Cell(sheet.title, HEADER_ROW, 1).coordinate
        grids = bool(blocks) and all(isinstance(block, Grid) for block in blocks)
        wide = {i: _LIST[i] for i in (1, 2)} if grids else dict(_LIST)
        if sheet.title == INPUT_SHEET:
            wide |= {MIN_COLUMN: _LIMIT, MAX_COLUMN: _LIMIT}
        for block in blocks:
            wide |= _WIDTHS_WITH.get(block.id, {})
        _widths(sheet, {i: wide.get(i, 12) for i in range(1, last + 1)})
        _widen(sheet, blocks, layout, values)
        _raise_labels(sheet, blocks, layout)
        if sheet.title == INPUT_SHEET:
            sheet.freeze_panes = Cell(sheet.title, NUMBER_ROW, 1).coordinate
            _fit_inputs(sheet, model, layout)
        return
    sheet.freeze_panes = Cell(sheet.title, FIRST_ROW, 2).coordinate
    sheet.print_title_rows = f"{HEADER_ROW - 1}:{NUMBER_ROW}"
    _widths(sheet, dict.fromkeys(range(1, last + 1), NARROW))
    widths: dict[int, float] = {}
    for block in blocks:
        if isinstance(block, ScalarTable):
            fitting = enumerate(_fitting(sheet, layout, block), layout.places[block.id].column)
            widths |= {index: max(width, widths.get(index, 0)) for index, width in fitting}
    _widths(sheet, widths)
    _widen(sheet, blocks, layout, values)
    _raise_labels(sheet, blocks, layout)
    sheet.row_dimensions[HEADER_ROW].height = _HEADER_LINE * max(
        _TABLE_LINES,
        *(_lines(column.quantity.header, column_px(sheet, index) / DIGIT)
          for table in tables
          for index, column in enumerate(table.columns, layout.places[table.id].column)),
    )  # fmt: skip
    for table in tables:
        _fold(sheet, table, layout, values)
    _wrap_titles(sheet)


def _wrap_titles(sheet: Worksheet) -> None:
    """Titles of tables that the next title beside them would cut off take a line more."""
    row = HEADER_ROW - 1
    titles = [cell for cell in sheet[row] if cell.value]
    for cell, following in pairwise(titles):
        room = sum(column_px(sheet, i) for i in range(cell.column, following.column)) / DIGIT
        if _SUBTITLE_LETTER * len(str(cell.value)) > room:
            wrap_across(sheet, row, cell.column, following.column - 1, _SUBTITLE_LETTER)


def _fitting(sheet: Worksheet, layout: Layout, block: ScalarTable) -> list[float]:
    """Widths of a list beside a table, whose rows have one line: as its longest texts ask."""
    rows = [layout.cells[scalar.key].row for scalar in block.scalars]
    first = layout.places[block.id].column
    sizes: list[float] = []
    for index, least in enumerate(_BESIDE, first):
        texts = (sheet.cell(row, index).value for row in rows)
        longest = max(
            len(text) for text in ("", *(t for t in texts if isinstance(t, str) and t[0] != "="))
        )
        sizes.append(min(max(least, room_of(longest)), _WIDEST))
    return sizes


def _widen(sheet: Worksheet, blocks: Sequence[Block], layout: Layout, values: Values) -> None:
    """Room for the longest numbers of each column, which else are crosses."""
    longest: dict[int, int] = {}

    def hold(column: int, number: float, quantity: Quantity, decimals: int = 0) -> None:
        letters = len(written(number, quantity.digits, more=0)) if isfinite(number) else 0
        longest[column] = max(longest.get(column, 0), letters + blanks(quantity, decimals))

    for block in blocks:
        if isinstance(block, TableSpec):
            for index, column in enumerate(block.columns, layout.places[block.id].column):
                numbers = values.columns[block.id][column.key]
                for end in (numbers.min(), numbers.max()):
                    hold(index, float(end), column.quantity)
                _hold(sheet, index, max(map(_word, column.quantity.header.split())))
            continue
        decimals = decimals_in(block)
        for scalar in scalars_of(block):
            value = values.scalars[scalar.key]
            if not isinstance(value, str):
                hold(layout.cells[scalar.key].column, float(value), scalar.quantity, decimals)
    for index, letters in longest.items():
        _hold(sheet, index, room_of(letters))


def _hold(sheet: Worksheet, index: int, width: float) -> None:
    dimension = sheet.column_dimensions[get_column_letter(index)]
    dimension.width = max(dimension.width, width)


def _lines(header: str, width: float) -> int:
    """Lines of a header in a column."""
    lines = [""]
    for word in header.split():
        longer = f"{lines[-1]} {word}".strip()
        if _word(longer) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return len(lines)


def _raise_labels(sheet: Worksheet, blocks: Sequence[Block], layout: Layout) -> None:
    """Room for the labels of grids, «коренной 10, Δmin»."""
    for block in blocks:
        if not isinstance(block, Grid):
            continue
        first = layout.cells[next(c for c in block.rows[0].cells if c is not None).key].column
        labels = dict(enumerate(block.labels, first))
        _hold(sheet, layout.places[block.id].column, _CORNER)
        _hold_words(sheet, labels)
        _raise_row(sheet, layout.places[block.id].row, labels)


def _fit_inputs(sheet: Worksheet, model: Model, layout: Layout) -> None:
    """Headers of the lists of records whole; a person's long texts end before the keys."""
    headers: dict[int, dict[int, str]] = {}
    for item in model.inputs:
        cell = layout.cells[item.name]
        text = str(sheet.cell(cell.row, cell.column).value)
        if item.listed:
            header = sheet.cell(cell.row - 1, cell.column)
            if header.style == HEADER:
                headers.setdefault(header.row, {})[header.column] = str(header.value)
            if sheet.cell(cell.row, cell.column + 1).value is not None:
                _hold(sheet, cell.column, min(room_of(len(text)), _NAME))
        elif isinstance(item.value, str):
            _wrap_text(sheet, cell, text)
    for labels in headers.values():
        _hold_words(sheet, labels)
    for row, labels in headers.items():  # when no list widens a column any more
        _raise_row(sheet, row, labels)


def _wrap_text(sheet: Worksheet, cell: Cell, text: str) -> None:
    room = sum(column_px(sheet, i) for i in range(VALUE_COLUMN, MAX_COLUMN + 1)) / DIGIT
    if room_of(len(text)) > room:
        wrap_across(sheet, cell.row, VALUE_COLUMN, MAX_COLUMN)


def _hold_words(sheet: Worksheet, labels: Mapping[int, str]) -> None:
    """Columns in which no word of a header is broken."""
    for index, label in labels.items():
        _hold(sheet, index, max(map(_word, label.split()), default=0.0))


def _raise_row(sheet: Worksheet, row: int, labels: Mapping[int, str]) -> None:
    """Write a row in which headers have all their lines."""
    lines = max(_lines(label, column_px(sheet, index) / DIGIT) for index, label in labels.items())
    dimension = sheet.row_dimensions[row]
    if lines > 1:
        dimension.height = max(dimension.height or 0, _HEADER_LINE * lines)


def _word(word: str) -> float:
    """Width of a column in which a word of a header is not broken."""
    thin = sum(letter in _THIN_LETTERS for letter in word)
    return _EDGES + thin * _THIN + (len(word) - thin) * _HEADER_LETTER


def _fold(sheet: Worksheet, table: TableSpec, layout: Layout, values: Values) -> None:
    """Columns that only serve formulas are folded; what a student fills in stays open."""
    sheet.sheet_properties.outlinePr.summaryRight = False
    folded = [
        column
        for column in table.columns[1:]
        if column.helper and np.isfinite(values.columns[table.id][column.key]).all()
    ]
    if len(folded) == len(table.columns) - 1:  # of angles alone nobody reads
        folded.insert(0, table.columns[0])
    for column in folded:
        letter = get_column_letter(layout.column_of(f"{table.id}.{column.key}"))
        sheet.column_dimensions[letter].outlineLevel = 1
        sheet.column_dimensions[letter].hidden = True


def set_page(sheet: Worksheet, boxes: Sequence[Box], *, charts_alone: bool = False) -> None:
    """One print area with the charts, or of them alone; as few pages as can be read."""
    last = Cell("", 1, 1) if charts_alone else Cell("", sheet.max_row, sheet.max_column)
    width, height = (0, 0) if charts_alone else extent(sheet)
    if boxes:
        row, column = last_cell(sheet, boxes)
        last = Cell("", max(row, last.row), max(column, last.column))
        width = max(width, *(box.right for box in boxes))
        height = max(height, *(box.bottom for box in boxes))
    page = sheet.page_setup
    page.paperSize = sheet.PAPERSIZE_A4
    scales = {name: min(w / width, h / height) for name, (w, h) in PAPER.items()}
    page.orientation = max(scales, key=lambda name: scales[name])
    pages = int(scales[page.orientation] >= _MIN_SCALE)
    if not pages and width > UPRIGHT:
        page.orientation = "landscape"
    w, h = PAPER[page.orientation]
    across = ceil(width * _MIN_SCALE / w)
    if not pages:
        sheets = height * min(1, across * w / width) / h
        # A few rows too many go onto the page before, or stand on one of their own.
        spare = floor(sheets) and sheets <= floor(sheets) * (1 + _SQUEEZED)
        pages = floor(sheets) if spare else 0
    page.fitToWidth, page.fitToHeight = across, pages
    sheet.sheet_properties.pageSetUpPr.fitToPage = True
    if across > 1 and (boxes or not _part(sheet, height)):
        sheet.print_title_cols = "A:A"
    parts = [*boxes, *(() if charts_alone else _sections(sheet))]
    if parts and pages != 1 and across == 1:
        _end_between(sheet, parts, width)
    sheet.print_area = area(Cell("", 1, 1), last)
    set_margins(sheet)


def print_beginning(sheet: Worksheet) -> None:
    """One page of a helper sheet, whose rows are alike and which nobody reads on paper."""
    page = sheet.page_setup
    page.fitToWidth = page.fitToHeight = 1
    sheet.sheet_properties.pageSetUpPr.fitToPage = True
    written = [cell.row for cell in sheet["A"] if cell.value is not None and cell.row > HEADER_ROW]
    # Of a work-book that has lists only the rows begin far below the title.
    first = written[0] - 1 if written and written[0] > _SHOWN_ROWS else 1
    if first > 1:
        sheet.print_title_rows = "1:1"
    last = first + _SHOWN_ROWS - 1
    sheet.print_area = area(Cell("", first, 1), Cell("", last, sheet.max_column))


def set_margins(sheet: Worksheet) -> None:
    """Margins, the file's name above, the sheet's below with the number of the page."""
    margins = sheet.page_margins
    margins.left, margins.right, margins.top, margins.bottom = 0.6, 0.3, 0.5, 0.6
    margins.header = margins.footer = 0.3
    sheet.oddHeader.right.text = "&F"
    sheet.oddFooter.center.text = "&A — лист &P из &N"


def _sections(sheet: Worksheet) -> Iterator[Box]:
    """Yield lists one below the other, each with its heading, and of each how it begins."""
    if sheet.print_title_rows:
        return
    starts = [cell.row for cell in sheet["A"] if cell.style == SUBTITLE]
    tops = _tops(sheet, sheet.max_row)
    for start, following in pairwise([*starts, sheet.max_row + 2]):
        for end in (min(start + _BEGINNING, following - 2), following - 2):
            yield Box(0, tops[start - 1], 0, tops[end] - tops[start - 1])


def _tops(sheet: Worksheet, last: int) -> list[int]:
    """Upper edges of the rows and the lower one of the last."""
    return [0, *accumulate(row_px(sheet, row) for row in range(1, last + 1))]


def _end_between(sheet: Worksheet, boxes: Sequence[Box], width: int) -> None:
    """Pages that end between charts and lists; smaller where that saves pages."""
    w, h = (SURE * side for side in PAPER[sheet.page_setup.orientation])
    most = floor(100 * min(w / width, 1))
    if max(box.bottom for box in boxes) <= 100 * h / most:
        return
    tops = _tops(sheet, last_cell(sheet, boxes)[0])
    repeated = tops[NUMBER_ROW] - tops[HEADER_ROW - 2] if sheet.print_title_rows else 0
    least = max(floor(most / (1 + _SQUEEZED)), min(most - 1, _FINE))
    scales = range(most, least, -1)
    ends = {scale: _ends(boxes, tops, 100 * h / scale, repeated) for scale in scales}
    scale = min(scales, key=lambda scale: len(ends[scale]))
    for row in ends[scale]:
        sheet.row_breaks.append(Break(id=row))
    _own_scale(sheet, scale)


def _ends(boxes: Sequence[Box], tops: Sequence[int], room: float, repeated: int) -> list[int]:
    """Last rows of pages of some height, of which all but the first repeat headers."""
    top, rows = 0, list[int]()
    while (end := top + room - (repeated if top else 0)) < max(box.bottom for box in boxes):
        row = full = bisect_right(tops, end) - 1
        while cut := [
            box.y for box in boxes if top < box.y < tops[row] < box.bottom and box.height <= room
        ]:
            row = bisect_right(tops, min(cut)) - 1
        if tops[row] <= top:  # no row ends between them: one is cut
            row = max(full, bisect_right(tops, top))
        rows.append(row)
        top = tops[row]
    return rows


def _own_scale(sheet: Worksheet, percent: int) -> None:
    page = sheet.page_setup
    page.scale, page.fitToWidth, page.fitToHeight = percent, None, None
    sheet.sheet_properties.pageSetUpPr.fitToPage = False


def _part(sheet: Worksheet, height: int) -> bool:
    """Each of the tables side by side upright on pages of its own; whether there are several.

    Fitted to pages a sheet is cut anywhere: Excel then passes over the breaks that are set.
    """
    starts = [cell.column for cell in sheet[HEADER_ROW - 1] if cell.value]
    if len(starts) < 2:
        return False
    ends = [*starts[1:], sheet.max_column + 1]
    widest = max(
        sum(column_px(sheet, i) for i in range(start, end))
        for start, end in zip(starts, ends, strict=True)
    )
    w, h = (SURE * side for side in PAPER["portrait"])
    scale = min(w / widest, 1)
    if scale < _MIN_SCALE:
        return False
    down = floor(height * scale / h)
    if down and height * scale <= down * h * (1 + _SQUEEZED):
        scale = min(scale, down * h / height)
    sheet.page_setup.orientation = "portrait"
    _own_scale(sheet, floor(100 * scale))
    for start in starts[1:]:
        sheet.col_breaks.append(Break(id=start - 1))
    return True


def _widths(sheet: Worksheet, widths: Mapping[int, float]) -> None:
    for column, width in widths.items():
        sheet.column_dimensions[get_column_letter(column)].width = width
