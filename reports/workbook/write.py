"""Write the workbook: all sheets with live formulas, waves of Fourier sums, charts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import cos, radians, sin

from lxml.etree import SerialisationError
from openpyxl import Workbook
from openpyxl.cell.cell import TYPE_FORMULA
from openpyxl.utils import get_column_letter
from openpyxl.workbook.defined_name import DefinedName
from openpyxl.worksheet.cell_range import CellRange
from openpyxl.worksheet.worksheet import Worksheet

from reports.model.blocks import Block, Grid, Model, ScalarTable, TableSpec
from reports.model.charts import ChartSpec
from reports.model.contents import Contents
from reports.model.evaluation import Values, evaluate_model
from reports.shared.files import temporary_failure
from reports.shared.gc_pause import uncollected
from reports.tables.curves import with_curves, with_values
from reports.tables.verdicts import accepted_checks
from reports.workbook import cockpit, motion, styles
from reports.workbook.bars import draw_bars
from reports.workbook.caches import finish
from reports.workbook.chapters import chapter_of, contents_for, diagrams_of, heading, ordered
from reports.workbook.charts import WIDE, is_blank, make_chart, names_of, pixels, ranges_of
from reports.workbook.cockpit import write_cockpit
from reports.workbook.inputs import write_inputs
from reports.workbook.layout import (
    BOOK_MARK,
    CONTENTS_SHEET,
    FIRST_ROW,
    HEADER_ROW,
    INPUT_SHEET,
    NOTE_ROW,
    NUMBER_ROW,
    OWN_SHEET,
    SOURCE_COLUMN,
    TITLE_ROW,
    WAVES_SHEET,
    Cell,
    Layout,
    check_names,
    quoted,
)
from reports.workbook.orders import Waves
from reports.workbook.pictures import add_sketches
from reports.workbook.places import (
    FOLD,
    GAP,
    NOTE_LETTER,
    SCREEN,
    SMALL,
    TITLE_HEIGHT,
    Box,
    anchor,
    column_px,
    extent,
    flow,
    keep_columns,
    raise_row,
    top_of,
    wrap_across,
)
from reports.workbook.print_setup import UPRIGHT, print_beginning, set_page, set_widths
from reports.workbook.sheets import BlockWriter, CacheValues, link
from reports.workbook.substitution import write_substitutions
from reports.workbook.typed_over import mark_typed_over
from reports.workbook.verdict import colour_verdicts, write_verdict

_ANGLE, _WAVE = (styles.HELPER, "0.0"), (styles.HELPER, "0.0000")
_TURNS = {"cos": cos, "sin": sin}
_MAX_CHECKS = 40
_TEXT_WIDTH = 110
NOTE_COLUMN, _NOTE_PX = 3, 560  # where a sheet's note may begin, and how wide it is at least
_LINK_PX = 90  # of the link to the contents
_REMARK_WIDTH = 115  # of the columns of a list
_CHARTS_ROW = 4  # of a sheet of diagrams
_CURVES_WIDTH = 12  # of the columns of a hidden sheet
_BESIDE = 24  # px: a narrow column between a table and its charts


def write_waves(sheet: Worksheet, writer: BlockWriter) -> None:
    """Angles as their table has them, orders above the columns; the last row repeats the first."""
    layout = writer.layout
    for run in layout.run_orders:
        _write_run(sheet, writer, run)
    for grid, waves in layout.orders.items():
        table, column = layout.columns[waves.angle]
        if table.id not in writer.values.columns:  # a work-book has some tables only
            continue
        angles = writer.values.columns[table.id][table.columns[0].key][:-1].tolist()
        first = layout.waves[grid]
        rows = range(FIRST_ROW, FIRST_ROW + len(angles))
        sheet.cell(HEADER_ROW - 1, first, table.sheet).style = styles.SUBTITLE
        writer.symbol(sheet, HEADER_ROW, first, table.columns[0].quantity, styles.HEADER, unit=True)
        letter, home = get_column_letter(first), quoted(table.sheet)
        copies = [f"={home}!{Cell('', row, column).coordinate}" for row in rows]
        writer.column(sheet, first, copies, angles, _ANGLE)
        for at, (turn, order) in enumerate(_each(waves), first + 1):
            sheet.cell(HEADER_ROW, at, f"{turn} kφ").style = styles.HEADER
            sheet.cell(NUMBER_ROW, at, order).style = styles.NUMBER
            above = f"{get_column_letter(at)}${NUMBER_ROW}"
            texts = [f"={turn.upper()}(${letter}{row}*({above}*PI()/180))" for row in rows]
            # The same digits for the same angle in every column: they take less room.
            values = [round(_TURNS[turn](radians(order * angle % 360)), 15) for angle in angles]
            writer.column(sheet, at, texts, values, _WAVE)


def _each(waves: Waves) -> Iterator[tuple[str, float]]:
    """Yield function and order of each wave."""
    for turn, orders in waves.orders.items():
        for order in orders:
            yield turn, order


def _write_run(sheet: Worksheet, writer: BlockWriter, run: str) -> None:
    """Angles of a run side by side, below them a row an order."""
    layout = writer.layout
    keys, top = layout.keys_of_run(run), layout.run_waves[run]
    values_by_name = {
        field.name: field.value for field in layout.model.inputs
    } | writer.values.scalars
    if not all(key in values_by_name for key in keys):  # a work-book has some lists only
        return
    angles = [float(values_by_name[key]) for key in keys]
    cells = layout.cells_of_run(run)
    sheet.cell(top - 1, 1, cells[0].sheet).style = styles.SUBTITLE
    for column, (cell, angle) in enumerate(zip(cells, angles, strict=True), 2):
        _cell(sheet, writer, top, column, f"={cell.absolute}", angle)
    for row, (turn, order) in enumerate(_each(layout.run_orders[run]), top + 1):
        sheet.cell(row, 1, order).style = styles.NUMBER
        for column, angle in enumerate(angles, 2):
            letter = get_column_letter(column)
            text = f"={turn.upper()}({letter}${top}*($A{row}*PI()/180))"
            value = round(_TURNS[turn](radians(order * angle)), 15)
            _cell(sheet, writer, row, column, text, value)


def _cell(
    sheet: Worksheet, writer: BlockWriter, row: int, column: int, text: str, value: float
) -> None:
    writer.formula(sheet, row, column, text, value)
    cell = sheet.cell(row, column)
    cell.style, cell.number_format = _WAVE


def workbook_bytes(model: Model, values: Values | None = None) -> bytes:
    """Return the finished workbook as bytes; the same model gives the same bytes."""
    values = values or evaluate_model(model)
    model = with_curves(model)
    layout = Layout.of(model)
    check_names(layout)
    writer = BlockWriter(layout, with_values(model, values))
    with uncollected():
        book = assemble(model, writer)
        write_texts(book, model)
        return saved(book, writer.caches)


def formula_places(model: Model) -> dict[str, set[tuple[int, int]]]:
    """Return rows and columns of the workbook's formulas, by sheets."""
    values, model = evaluate_model(model), with_curves(model)
    writer = BlockWriter(Layout.of(model), with_values(model, values))
    with uncollected():
        sheets = assemble(model, writer).worksheets
    return {
        sheet.title: {(cell.row, cell.column) for row in sheet.iter_rows() for cell in row
                      if cell.data_type == TYPE_FORMULA}
        | set(writer.caches.formulas_of(sheet.title))
        for sheet in sheets
    }  # fmt: skip


def write_texts(book: Workbook, model: Model) -> None:
    """Write texts of own books, line by line: an edited workbook is calculated by them again."""
    if not model.input.books:
        return
    sheet = book.create_sheet(OWN_SHEET)
    contents = contents_for(model)
    _heading(sheet, heading(OWN_SHEET, contents))
    sheet.column_dimensions["A"].width = _TEXT_WIDTH
    row = FIRST_ROW
    for name, text in model.input.books:
        styles.as_text(sheet.cell(row, 1, f"{BOOK_MARK}{name}")).style = styles.SUBTITLE
        lines = text.splitlines()
        for number, line in enumerate(lines, row + 1):
            if line:
                styles.as_text(sheet.cell(number, 1, line)).style = styles.LINE
        row += len(lines) + 2
    sheet.sheet_properties.tabColor = chapter_of(OWN_SHEET, contents).colour
    set_page(sheet, ())
    sheet.sheet_state = "veryHidden"  # nobody changes it here: the book's own file is changed


def assemble(
    model: Model, writer: BlockWriter, legend: Sequence[tuple[str, str]] = styles.LEGEND
) -> Workbook:
    """All sheets of a model's blocks, where the writer's layout puts them."""
    layout, contents = writer.layout, contents_for(model)
    book = Workbook()
    book.remove(book.active)
    styles.add_styles(book)
    for title in (CONTENTS_SHEET, *ordered((INPUT_SHEET, *model.sheets), contents)):
        book.create_sheet(title)
    inputs = book[INPUT_SHEET]
    _heading(inputs, heading(INPUT_SHEET))
    write_inputs(inputs, model, writer)
    set_widths(inputs, model, layout, writer.values)
    for title in model.sheets:
        _blocks(book[title], model, writer)
        if title in model.drawn:  # nobody looks at it, or one who has shown it
            book[title].sheet_format.defaultColWidth = _CURVES_WIDTH
            continue
        set_widths(book[title], model, layout, writer.values)
        notes = [block.note for block in model.blocks if block.sheet == title and block.note]
        if notes:
            _note(book[title], " ".join(dict.fromkeys(notes)))
    if layout.orders or layout.run_orders:
        waves = book.create_sheet(WAVES_SHEET, _index(book, WAVES_SHEET, contents))
        _heading(waves, heading(WAVES_SHEET))
        write_waves(waves, writer)
    boxes = _charts(book, model, writer)
    add_sketches(book, writer, boxes)
    boxes[INPUT_SHEET] = cockpit.charts_beside(inputs, model, writer)
    if motion.can_move(writer):
        for title in (cockpit.SHEET, motion.SHEET):
            _heading(
                book.create_sheet(title, _index(book, title, contents)), heading(title, contents)
            )
        boxes[motion.SHEET] = motion.write_motion(book, model, writer)
        cockpit.write_what_if(book, model, writer)
    _fold(book, model)
    if writer.tells:
        write_substitutions(book, writer)
    verdict = write_verdict(book, model, writer)
    visible = [sheet.title for sheet in book.worksheets if sheet.sheet_state == "visible"]
    boxes[CONTENTS_SHEET] = write_cockpit(
        book[CONTENTS_SHEET], visible, model, writer, legend, verdict
    )
    for sheet in book.worksheets:
        keep_columns(sheet, boxes.get(sheet.title, ()))
        styles.look(sheet, chapter_of(sheet.title, contents).colour)
        if sheet.sheet_state != "visible":
            continue  # without an area no program prints it
        # Of the points under the charts of the mechanism nobody needs a print.
        alone = sheet.title == motion.SHEET
        set_page(sheet, boxes.get(sheet.title, ()), charts_alone=alone)
    if WAVES_SHEET in visible:
        print_beginning(book[WAVES_SHEET])
    for name, address in layout.defined_names().items():
        if name in model.fields or name in model.scalars:
            book.defined_names[name] = DefinedName(name, attr_text=address)
    book.properties.creator = "kshm"
    book.properties.title = f"{model.input.engine.name}: кинематика и динамика КШМ"
    book.calculation.fullCalcOnLoad = True
    return book


def _fold(book: Workbook, model: Model) -> None:
    """Hide the sheets that only serve charts and, of a short book, formulas, behind all others."""
    waves = {WAVES_SHEET} if model.left_out or model.folded else set()
    for sheet in list(book.worksheets):
        if sheet.title in {*waves, *model.folded, *model.drawn}:
            sheet.sheet_state = "hidden"
            book.move_sheet(sheet, len(book.worksheets))


def saved(book: Workbook, caches: CacheValues) -> bytes:
    """Return the bytes of a workbook with the values of its formulas.

    Raises:
        OutputError: there is no room for temporary files.
    """
    try:
        return finish(book, caches)
    except (OSError, SerialisationError) as error:  # each sheet is a temporary file before
        raise temporary_failure(error) from None


def _heading(sheet: Worksheet, title: str) -> None:
    styles.as_text(sheet.cell(TITLE_ROW, 1, title)).style = styles.TITLE
    sheet.row_dimensions[TITLE_ROW].height = TITLE_HEIGHT
    link(sheet, Cell(sheet.title, NOTE_ROW, 1), f"← {CONTENTS_SHEET}", CONTENTS_SHEET)


def _blocks(sheet: Worksheet, model: Model, writer: BlockWriter) -> None:
    blocks = [block for block in model.blocks if block.sheet == sheet.title]
    _heading(sheet, heading(sheet.title, contents_for(model)))
    for block in blocks:
        if isinstance(block, TableSpec):
            writer.table(sheet, block)
        elif isinstance(block, ScalarTable):
            writer.list(sheet, block)
            if block.verdicts is not None:
                colour_verdicts(sheet, HEADER_ROW, HEADER_ROW + _MAX_CHECKS, *block.verdicts)
                draw_bars(sheet, block, writer.layout)
            if block.id == "checks":
                # Beside its check stands why a discrepancy is accepted.
                accepted = accepted_checks(model.input, model.blocks)
                _remarks(sheet, [text for text in model.remarks if text not in accepted])
        elif isinstance(block, Grid):
            writer.grid(sheet, block)
    if writer.tells and sheet.title not in model.drawn:
        mark_typed_over(sheet, writer.caches.columns.get(sheet.title, ()))


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
        across = CellRange(min_row=row, min_col=1, max_row=row, max_col=SOURCE_COLUMN)
        sheet.merged_cells.add(across)
        raise_row(sheet, row, {text: _REMARK_WIDTH})


def _charts(book: Workbook, model: Model, writer: BlockWriter) -> dict[str, list[Box]]:
    """Charts beside or below their tables, or on their chapter's sheet; where they stand."""
    boxes_by_sheet: dict[str, list[Box]] = {}
    homeless: dict[str, list[ChartSpec]] = {}
    contents = contents_for(model)
    for title in ordered(model.sheets, contents):
        sheet = book[title]
        specs: list[ChartSpec] = []
        blank: list[ChartSpec] = []
        for spec in (spec for spec in model.charts if spec.sheet == title):
            empty = is_blank(spec, writer.layout, writer.values)
            (blank if empty else specs).append(spec)
        if blank:
            _say_blank(sheet, blank)
        blocks = [block for block in model.blocks if block.sheet == title]
        boxes = _room(sheet, specs, blocks, writer.layout)
        if boxes is None:
            homeless.setdefault(diagrams_of(chapter_of(title, contents)), []).extend(specs)
        else:
            boxes_by_sheet[title] = boxes
            _draw(sheet, specs, boxes, writer)
    for title, specs in homeless.items():
        sheet = book.create_sheet(title, _index(book, title, contents))
        _heading(sheet, heading(title, contents))
        boxes_by_sheet[title] = flow(
            [pixels(spec, wide=True) for spec in specs], GAP, top_of(sheet, _CHARTS_ROW), SCREEN
        )
        _draw(sheet, specs, boxes_by_sheet[title], writer)
    return boxes_by_sheet


def _say_blank(sheet: Worksheet, specs: Sequence[ChartSpec]) -> None:
    """Which charts are left out, for all their values are zero."""
    text = f"Не начерчено, все значения равны нулю: {'; '.join(spec.title for spec in specs)}."
    _note(sheet, f"{sheet.cell(NOTE_ROW, _note_column(sheet)).value or ''} {text}".strip())


def _room(
    sheet: Worksheet, specs: Sequence[ChartSpec], blocks: Sequence[Block], layout: Layout
) -> list[Box] | None:
    """Room beside what is written, or below where that is short; None where there is none."""
    height = extent(sheet)[1]
    # A note above runs on over the charts: they stand beside the tables.
    columns = range(1, layout.last_column(blocks) + 1)
    left = _BESIDE + sum(column_px(sheet, i) for i in columns)
    sizes = [pixels(spec) for spec in specs]
    if not specs or left + sizes[0][0] <= SCREEN:
        frozen = any(isinstance(block, TableSpec) for block in blocks)
        top = top_of(sheet, FIRST_ROW if frozen else HEADER_ROW)
        return flow(sizes, left, top, max(UPRIGHT, left + WIDE))
    tallest = max(size[1] for size in sizes)
    if height + GAP + tallest <= FOLD + tallest // 2:  # their greater halves in sight
        return flow(sizes, GAP, height + GAP, SCREEN)
    return None


def _draw(
    sheet: Worksheet, specs: Sequence[ChartSpec], boxes: Sequence[Box], writer: BlockWriter
) -> None:
    for spec, box in zip(specs, boxes, strict=True):
        chart = make_chart(spec, writer.layout, writer.values)
        chart.anchor = anchor(sheet, box)
        sheet.add_chart(chart)
        writer.caches.ranges |= ranges_of(spec, writer.layout, writer.values)
        writer.caches.names |= names_of(spec, writer.layout, writer.values)


def _index(book: Workbook, title: str, contents: Contents) -> int:
    """Where a sheet's place among the others is."""
    return 1 + ordered([*book.sheetnames[1:], title], contents).index(title)


def _note_column(sheet: Worksheet) -> int:
    """Return the column of a sheet's note: beside the link to the contents."""
    column = NOTE_COLUMN
    while sum(column_px(sheet, i) for i in range(1, column)) < _LINK_PX:
        column += 1
    return column


def _note(sheet: Worksheet, text: str) -> None:
    """Write a note across the sheet's open columns, as high as its text."""
    first = last = _note_column(sheet)
    width = 0
    while width < _NOTE_PX:
        width += column_px(sheet, last)
        last += 1
    sheet.cell(NOTE_ROW, first, text).style = styles.NOTE
    wrap_across(sheet, NOTE_ROW, first, last - 1, NOTE_LETTER, SMALL)
