"""First sheet: engine, key results, links; the sheet of what-if studies."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from openpyxl.formatting.rule import FormulaRule
from openpyxl.styles import Alignment, Border, PatternFill, Protection, Side
from openpyxl.styles import Font as CellFont
from openpyxl.workbook import Workbook
from openpyxl.worksheet.cell_range import CellRange
from openpyxl.worksheet.worksheet import Worksheet

from reports.model.blocks import Model
from reports.model.contents import Contents
from reports.model.shape import pin_figure
from reports.tables.left_out import left_out_note
from reports.workbook import styles
from reports.workbook.chapters import chapter_of, contents_for, heading, ordered
from reports.workbook.charts import HIGH, WIDE, make_chart, names_of, ranges_of
from reports.workbook.key_values import key_values, nought_words, results_of, worst_pin
from reports.workbook.layout import (
    HEADER_ROW,
    INPUT_SHEET,
    MAX_COLUMN,
    NOTE_ROW,
    VALUE_COLUMN,
    Cell,
    area,
)
from reports.workbook.places import (
    GAP,
    NOTE_LETTER,
    SMALL,
    TITLE_HEIGHT,
    Box,
    anchor,
    column_px,
    flow,
    lines_of,
    raise_row,
    top_of,
    wrap_across,
)
from reports.workbook.sheets import BlockWriter, link
from reports.workbook.tiles import SPANS, write_tiles
from reports.workbook.verdict import BookVerdict, colour_verdict, fade

# Inputs and scalars that say which engine this is, and what came out; those that there are.
DATA = (
    "regime_speed_rpm", "gas_max_pressure_mpa", "cycle_max_pressure_mpa",
    "masses_reciprocating_kg", "masses_piston_group_kg", "geometry_rod_length_mm",
    "geometry_lambda", "geometry_bore_mm", "cyc_D", "geometry_stroke_mm",
    "geometry_crank_radius_mm", "cyc_S", "V_engine",
)  # fmt: skip
CHARTS = ("fig50", "fig49", "p_phi", "fig52")
_PIN_CHARTS = {"fig50", "fig52"}
BESIDE = ("fig49", "fig50")
_WIDTHS = {"A": 28, "B": 9, "C": 13, "D": 7, "E": 1.5}
PEOPLE_ROW, VERDICT_ROW = 2, 3
_VERDICT_HEIGHT = 30.0  # pt: two lines
_HIDDEN = "Нужные только формулам листы скрыты: правая кнопка на ярлыке → «Показать»."
_FOLDED = (
    "Столбцы, нужные только формулам, свёрнуты: кнопка «+» над столбцами. "
    "Красное в таблице: вместо формулы вписано число."
)
_SAMPLES = {styles.INPUT: "меняют", styles.ANSWER: "впишите", styles.STRUCTURE: "строение"}
SHEET = "Что если"
_STUDY_WIDTHS = {"A": 62, "B": 14, "C": 14, "D": 14, "E": 12, "F": 6, "G": 12}
_HEAD = ("Величина", "Обозначение", "Было", "Стало", "Разница", "", "Единица")
_NOTE = (
    "Измените жёлтую ячейку на листе «Исходные данные»: здесь видно, что от этого изменилось. "
    "Вернуть: впишите на том листе число из столбца «Было»."
)
_NO_PART = "—"


def write_cockpit(
    sheet: Worksheet,
    titles: Sequence[str],
    model: Model,
    writer: BlockWriter,
    legend: Sequence[tuple[str, str]],
    verdict: BookVerdict | None,
) -> list[Box]:
    """Fill the first sheet; the places of its charts."""
    for letter, width in _WIDTHS.items():
        sheet.column_dimensions[letter].width = width
    title = model.input.report.title or "Кинематика и динамика КШМ"
    styles.as_text(sheet.cell(1, 1, title)).style = styles.TITLE
    sheet.row_dimensions[1].height = TITLE_HEIGHT
    styles.as_text(sheet.cell(PEOPLE_ROW, 1, people(model))).style = styles.LINE
    row = _verdict(sheet, writer, VERDICT_ROW, verdict)
    top, row = row, write_tiles(sheet, writer, row)
    if verdict is not None and row > top:
        fade(sheet, area(Cell("", top + 1, 1), Cell("", row - 1, SPANS[-1][1])))
    row = _chapters(sheet, titles, contents_for(model), row) + 1
    boxes = _charts(sheet, model, writer, row)
    row = _samples(sheet, legend, row)
    row = _values(sheet, writer, row + 1, "Исходные данные: щёлкните, чтобы изменить", DATA)
    top, row = row + 2, _values(sheet, writer, row + 1, "Главные результаты", results_of(model))
    if verdict is not None and row > top:
        fade(sheet, area(Cell("", top, 3), Cell("", row - 1, 3)))
    row = _sheets(sheet, titles, model, row + 1)
    row = _left_out(sheet, writer, row)
    _legend(sheet, model, legend, row + 1)
    return boxes


def people(model: Model) -> str:
    """Return the engine, and whose work this is."""
    report = model.input.report
    people = (
        ("студент", report.student),
        ("группа", report.group),
        ("вариант", report.variant),
        ("руководитель", report.supervisor),
    )
    names = (f"{label} {text}" for label, text in people if text)
    return " · ".join((model.input.engine.name, *names))


def _samples(sheet: Worksheet, legend: Sequence[tuple[str, str]], row: int) -> int:
    """Colours of cells in a word each; the whole legend stands below."""
    sheet.cell(row, 1, "Цвета ячеек").style = styles.TEXT
    shown_styles = [style for style, _ in legend if style in _SAMPLES]
    for column, style in enumerate(shown_styles, 2):
        cell = sheet.cell(row, column, _SAMPLES[style])
        cell.style = style
        cell.protection = Protection(locked=True)
    return row + 1


def _chapters(sheet: Worksheet, titles: Sequence[str], contents: Contents, top: int) -> int:
    """Links to the sheets of the first chapter and to the first ones of the others; last row."""
    others = [title for title in titles if title != sheet.title]
    firsts = {title: chapter_of(title, contents) for title in others[:3]}
    for title in others[3:]:
        chapter = chapter_of(title, contents)
        if chapter not in firsts.values():
            firsts[title] = chapter
    for number, (title, chapter) in enumerate(firsts.items()):
        down, across = divmod(number, len(SPANS))
        (first, last), row = SPANS[across], top + down
        link(sheet, Cell(sheet.title, row, first), title if number < 3 else chapter.title, title)
        for column in range(first, last + 1):
            under = Side(style="medium", color=chapter.colour)
            sheet.cell(row, column).border = Border(bottom=under)
        if last > first:
            sheet.merged_cells.add(CellRange(min_row=row, max_row=row, min_col=first, max_col=last))
    return top + (len(firsts) - 1) // len(SPANS)


def _verdict(sheet: Worksheet, writer: BlockWriter, row: int, verdict: BookVerdict | None) -> int:
    """What holds of the numbers of the book and what does not; nothing where it has no checks."""
    if verdict is None:
        return row
    writer.formula(sheet, row, 1, verdict.formula, verdict.text)
    last = SPANS[-1][1]
    wrap_across(sheet, row, 1, last)
    sheet.cell(row, 1).style = styles.LINE
    sheet.cell(row, 1).alignment = Alignment(wrap_text=True, vertical="center", indent=1)
    sheet.row_dimensions[row].height = _VERDICT_HEIGHT
    colour_verdict(sheet, area(Cell("", row, 1), Cell("", row, last)))
    # Beside what is changed as well.
    inputs, here = sheet.parent[INPUT_SHEET], Cell(INPUT_SHEET, NOTE_ROW, VALUE_COLUMN)
    text = Cell(sheet.title, row, 1).absolute
    writer.formula(inputs, here.row, here.column, f"={text}", verdict.text)
    inputs.cell(here.row, here.column).style = styles.LINE
    colour_verdict(inputs, area(here, Cell(INPUT_SHEET, here.row, MAX_COLUMN)))
    return row + 1


def _values(
    sheet: Worksheet, writer: BlockWriter, row: int, title: str, keys: Sequence[str]
) -> int:
    """Values that stand elsewhere, with symbol and unit."""
    sheet.cell(row, 1, title).style = styles.SUBTITLE
    for text, measure, formula, value, unit, look in key_values(writer, keys):
        row += 1
        raise_row(sheet, row, {text: _WIDTHS["A"]})
        writer.symbol(sheet, row, 2, measure)
        for column, words in ((1, text), (4, unit)):
            look_of = styles.UNIT if column == 4 else styles.TEXT
            sheet.cell(row, column, words or None).style = look_of
        key = formula.removeprefix("=")
        if key in writer.layout.model.fields:
            at = writer.layout.cells[key]
            # LibreOffice breaks no link into lines: the symbol of a long title is the link.
            symbol = None if lines_of(text, _WIDTHS["A"]) == 1 else sheet.cell(row, 2).value
            words, column = (str(symbol), 2) if symbol else (text, 1)
            link(sheet, Cell(sheet.title, row, column), words, at.sheet, at.coordinate)
        writer.formula(sheet, row, 3, formula, value)
        sheet.cell(row, 3).style = styles.FORMULA
        sheet.cell(row, 3).number_format = look + nought_words(key)
    return row + 1


def charts_beside(sheet: Worksheet, model: Model, writer: BlockWriter) -> list[Box]:
    """Two diagrams that answer at once beside the input data, above the lists of records."""
    left = sum(column_px(sheet, i) for i in range(1, MAX_COLUMN + 1)) + GAP
    listed = [writer.layout.cells[item.name].row for item in model.inputs if item.listed]
    top = top_of(sheet, HEADER_ROW + 1)
    room = top_of(sheet, min(listed) - 2) - top if listed else 2 * (HIGH + GAP)
    charts = BESIDE[: room // (HIGH + GAP)]
    return _drawn(sheet, model, writer, charts, (left, top, left + WIDE))


def _charts(sheet: Worksheet, model: Model, writer: BlockWriter, row: int) -> list[Box]:
    """Return the four that say most, two to a row and of one size."""
    left = sum(round(width * 7) for width in _WIDTHS.values()) + GAP
    return _drawn(sheet, model, writer, CHARTS,
                  (left, top_of(sheet, row), left + 2 * WIDE + GAP))  # fmt: skip


def _drawn(
    sheet: Worksheet, model: Model, writer: BlockWriter, names: Sequence[str],
    room: tuple[int, int, int],
) -> list[Box]:  # fmt: skip
    """Charts of one size from left to right and down; of several pins the most loaded one's."""
    worst = worst_pin(writer)
    charts = [pin_figure(chart, worst) if chart in _PIN_CHARTS else chart for chart in names]
    specs = [model.charts_by_id[chart] for chart in charts if chart in model.charts_by_id]
    boxes = flow([(WIDE, HIGH)] * len(specs), *room)
    for spec, box in zip(specs, boxes, strict=True):
        chart = make_chart(spec, writer.layout, writer.values, oblong=box.width / box.height)
        chart.anchor = anchor(sheet, box)
        sheet.add_chart(chart)
        writer.caches.ranges |= ranges_of(spec, writer.layout, writer.values)
        writer.caches.names |= names_of(spec, writer.layout, writer.values)
    return boxes


def _sheets(sheet: Worksheet, titles: Sequence[str], model: Model, row: int) -> int:
    """Links to all sheets by chapters."""
    sheet.cell(row, 1, "Листы").style = styles.SUBTITLE
    others = [title for title in titles if title != sheet.title]
    contents = contents_for(model)
    for chapter, group in groupby(others, lambda title: chapter_of(title, contents)):
        row += 1
        head = sheet.cell(row, 1, chapter.title)
        head.font = CellFont(name=styles.FONT, size=11, bold=True, color="FFFFFF")
        for column in range(1, 5):
            sheet.cell(row, column).fill = PatternFill("solid", fgColor=chapter.colour)
        for title in group:
            row += 1
            link(sheet, Cell(sheet.title, row, 1), title, title)
            sheet.cell(row, 2, heading(title, contents)).style = styles.LINE
    return row + 1


def _left_out(sheet: Worksheet, writer: BlockWriter, row: int) -> int:
    """Sheets that only the full book has, by chapters, and the cell that asks for it."""
    model, contents = writer.layout.model, contents_for(writer.layout.model)
    if not (model.left_out or model.folded):
        return row
    row += 1
    sheet.cell(row, 1, "Есть только в полной книге").style = styles.SUBTITLE
    beyond = ordered((*model.left_out, *model.folded), contents)
    for chapter, group in groupby(beyond, lambda title: chapter_of(title, contents)):
        row += 1
        sheet.cell(row, 1, chapter.title).style = styles.TEXT
        sheet.cell(row, 2, "; ".join(group)).style = styles.LINE
    field = model.fields["workbook_sheets"]
    row += 1
    link(sheet, Cell(sheet.title, row, 1), field.title, INPUT_SHEET,
         writer.layout.cells[field.name].coordinate)  # fmt: skip
    section, key = field.path
    choices = field.choices or {}
    text = f"для полной — «{choices['full']}», затем kshm build; в файле: [{section}] {key}"
    sheet.cell(row, 2, f'{text} = "full"').style = styles.NOTE
    if model.folded:
        row += 1
        sheet.cell(row, 2, _HIDDEN).style = styles.NOTE
    return row + 1


def _legend(sheet: Worksheet, model: Model, legend: Sequence[tuple[str, str]], row: int) -> None:
    sheet.cell(row, 1, "Цвета ячеек").style = styles.SUBTITLE
    missing = left_out_note(model.input)
    for style, text in legend:
        row += 1
        sheet.cell(row, 1, "образец").style = style
        sheet.cell(row, 2, text).style = styles.LINE
    row += 1
    sheet.cell(row, 2, _FOLDED)
    sheet.cell(row, 2).style = styles.NOTE
    if missing:
        cell = styles.as_text(sheet.cell(row + 1, 2, missing))
        cell.style = styles.NOTE
        cell.alignment = Alignment(vertical="top")


def write_what_if(book: Workbook, model: Model, writer: BlockWriter) -> None:
    """Fill the sheet: results first, then the data that may be changed."""
    sheet = book[SHEET]
    for letter, width in _STUDY_WIDTHS.items():
        sheet.column_dimensions[letter].width = width
    sheet.cell(NOTE_ROW, 2, _NOTE).style = styles.NOTE
    wrap_across(sheet, NOTE_ROW, 2, len(_HEAD), NOTE_LETTER, SMALL)
    sheet.freeze_panes = Cell(SHEET, HEADER_ROW + 1, 1).coordinate
    for column, text in enumerate(_HEAD, 1):
        sheet.cell(HEADER_ROW, column, text).style = styles.HEADER
    free = [
        item.name
        for item in model.inputs
        if not item.structural and isinstance(item.value, float) and not item.listed
    ]
    row = _part(sheet, writer, HEADER_ROW + 1, "Главные результаты", results_of(model))
    last = _part(sheet, writer, row, "Исходные данные", free)
    changed = FormulaRule(formula=[f"$E{HEADER_ROW + 1}<>0"], fill=PatternFill(bgColor="FFEB9C"))
    sheet.conditional_formatting.add(f"D{HEADER_ROW + 1}:E{last}", changed)


def _part(
    sheet: Worksheet, writer: BlockWriter, row: int, title: str, keys: list[str] | tuple[str, ...]
) -> int:
    """Lines of some values; the row behind them."""
    sheet.cell(row, 1, title).style = styles.SUBTITLE
    for text, measure, formula, value, unit, look in key_values(writer, keys):
        if isinstance(value, str):
            continue
        row += 1
        raise_row(sheet, row, {text: _STUDY_WIDTHS["A"]})
        writer.symbol(sheet, row, 2, measure)
        for column, words in ((1, text), (7, unit)):
            look_of = styles.UNIT if column == 7 else styles.TEXT
            sheet.cell(row, column, words or None).style = look_of
        was, now = (Cell(SHEET, row, column).coordinate for column in (3, 4))
        sheet.cell(row, 3, value)
        writer.formula(sheet, row, 4, formula, value)
        # Noise of the last digits is no change; of what was nothing there is no part to tell.
        from_nothing = f'IF(ROUND({now},9)=0,0,"{_NO_PART}")'
        share = f"=IF({was}=0,{from_nothing},ROUND(({now}/{was}-1)*100,6))"
        # An angle and a journal's number have no share to tell: their difference itself.
        kind = look.partition("_")[0]
        whole = unit == "°" or (kind == "0" and not unit)
        writer.formula(sheet, row, 5, f"=ROUND({now}-{was},9)" if whole else share, 0.0)
        sheet.cell(row, 6, unit if whole else "%").style = styles.UNIT
        change = ("0_._0_0" if kind == "0" else kind) if whole else "0.00"
        for column, form in ((3, look), (4, look), (5, change)):
            sheet.cell(row, column).style = styles.FORMULA
            sheet.cell(row, column).number_format = form
    return row + 2
