"""First sheet: engine, key results, links; the sheet of what-if studies."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby
from math import inf, isfinite

from openpyxl.formatting.rule import FormulaRule
from openpyxl.styles import Alignment, Border, PatternFill, Protection, Side
from openpyxl.styles import Font as CellFont
from openpyxl.workbook import Workbook
from openpyxl.worksheet.cell_range import CellRange
from openpyxl.worksheet.worksheet import Worksheet

from kshm.nomenclature.quantity import Quantity
from reports.inputs.fields import Field
from reports.model.blocks import Model
from reports.model.contents import Contents
from reports.model.shape import Shape, pin_figure, pin_name
from reports.shared.russian import capital
from reports.tables.left_out import left_out_note
from reports.workbook import styles
from reports.workbook.chapters import chapter_of, contents_for, heading, ordered
from reports.workbook.charts import HIGH, WIDE, make_chart, ranges_of
from reports.workbook.inputs import shown
from reports.workbook.layout import (
    HEADER_ROW,
    INPUT_SHEET,
    NOTE_ROW,
    SOURCE_COLUMN,
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
from reports.workbook.verdict import GOOD, STRUCTURE_CHANGED, UNUSUAL, fade

# Inputs and scalars that say which engine this is, and what came out; those that there are.
DATA = (
    "regime_speed_rpm", "gas_max_pressure_mpa", "cycle_max_pressure_mpa",
    "masses_reciprocating_kg", "masses_piston_group_kg", "geometry_rod_length_mm",
    "geometry_lambda", "geometry_bore_mm", "cyc_D", "geometry_stroke_mm",
    "geometry_crank_radius_mm", "cyc_S", "V_engine",
)  # fmt: skip
RESULTS = (
    "cyc_N_e", "N_e_calc", "M_mean", "M_e", "N_i_calc", "p_i_calc", "M_max", "phi_M_max_deg",
    "M_min", "c_m", "j_tdc",
    "worst_pin_load", "Rpin_mean", "Rpin_max", "q_pin_max", "hole_pin_deg", "worst_main_load",
    "worst_main_torque", "delta_work", "I_flywheel",
)  # fmt: skip
# Of the crankpins: where there are several, the most loaded one's.
_OF_PINS = {
    "Rpin_mean": "Rpin{}_mean", "Rpin_max": "Rpin{}_max", "q_pin_max": "q_pin{}_max",
    "hole_pin_deg": "hole_pin{}_deg",
}  # fmt: skip
CHARTS = ("p_phi", "fig49", "fig50", "fig52")
_PIN_CHARTS = {"fig50", "fig52"}
BESIDE = ("fig49", "fig50")
_CHECKS = "Проверки расчёта"
_WORST = "worst_pin_load"
_WORST_PIN = (
    ("шатунную шейку", "наиболее нагруженную"), ("шатунной шейки", "наиболее нагруженной"),
)  # fmt: skip
_WIDTHS = {"A": 51, "B": 10, "C": 13, "D": 8, "E": 1.5}
_TOP = 2
_LINKS, _ACROSS, _EACH = 6, 3, 3  # first column, chapters in a row, columns that each takes
_HIDDEN = "Нужные только формулам листы скрыты: правая кнопка на ярлыке → «Показать»."
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
    verdict: tuple[str, str] | None,
) -> list[Box]:
    """Fill the first sheet; the places of its charts."""
    for letter, width in _WIDTHS.items():
        sheet.column_dimensions[letter].width = width
    sheet.row_dimensions[1].height = TITLE_HEIGHT
    title = model.input.report.title or "Кинематика и динамика КШМ"
    styles.as_text(sheet.cell(1, 1, title)).style = styles.TITLE
    row = _people(sheet, model, _TOP)
    row = _verdict(sheet, writer, row, verdict)
    row = _samples(sheet, legend, row)
    row = _values(sheet, writer, row + 1, "Исходные данные: щёлкните, чтобы изменить", DATA)
    top, row = row + 2, _values(sheet, writer, row + 1, "Главные результаты", results_of(model))
    if verdict is not None and row > top:
        fade(sheet, area(Cell("", top, 3), Cell("", row - 1, 3)))
    boxes = _charts(sheet, model, writer, _chapters(sheet, titles, contents_for(model)) + 1)
    row = _sheets(sheet, titles, model, row + 1)
    row = _left_out(sheet, writer, row)
    _legend(sheet, model, legend, row + 1)
    return boxes


def results_of(model: Model) -> tuple[str, ...]:
    """Keys of what came out; the oil hole is where the film puts it, as the report says."""
    if "oil_film1_deg" not in model.scalars:
        return RESULTS
    key = "crankshaft_oil_hole_deg"
    hole = (key,) if key in model.fields else ("oil_film1_deg", "oil_film2_deg")
    at = RESULTS.index("hole_pin_deg")
    return (*RESULTS[:at], *hole, *RESULTS[at + 1 :])


def _people(sheet: Worksheet, model: Model, row: int) -> int:
    report = model.input.report
    people = (
        ("Двигатель", model.input.engine.name),
        ("Студент", report.student),
        ("Группа", report.group),
        ("Вариант", report.variant),
        ("Руководитель", report.supervisor),
    )
    for label, text in people:
        if text:
            sheet.cell(row, 1, label).style = styles.TEXT
            styles.as_text(sheet.cell(row, 2, text)).style = styles.LINE
            if lines_of(text, sum(_WIDTHS[letter] for letter in "BCD")) > 1:
                wrap_across(sheet, row, 2, 4)  # the charts stand beside it
                sheet.cell(row, 1).alignment = Alignment(vertical="top")
            row += 1
    return row


def _samples(sheet: Worksheet, legend: Sequence[tuple[str, str]], row: int) -> int:
    """Colours of cells in a word each; the whole legend stands below."""
    sheet.cell(row, 1, "Цвета ячеек").style = styles.TEXT
    shown_styles = [style for style, _ in legend if style in _SAMPLES]
    for column, style in enumerate(shown_styles, 2):
        cell = sheet.cell(row, column, _SAMPLES[style])
        cell.style = style
        cell.protection = Protection(locked=True)
    return row + 1


def _chapters(sheet: Worksheet, titles: Sequence[str], contents: Contents) -> int:
    """Links to the sheets of the first chapter and to the first ones of the others; last row."""
    others = [title for title in titles if title != sheet.title]
    firsts = {title: chapter_of(title, contents) for title in others[:3]}
    for title in others[3:]:
        chapter = chapter_of(title, contents)
        if chapter not in firsts.values():
            firsts[title] = chapter
    for number, (title, chapter) in enumerate(firsts.items()):
        row, across = divmod(number, _ACROSS)
        at = Cell(sheet.title, _TOP + row, _LINKS + _EACH * across)
        text = title if number < 3 else chapter.title
        link(sheet, at, text, title)
        for column in range(at.column, at.column + _EACH):
            under = Side(style="medium", color=chapter.colour)
            sheet.cell(at.row, column).border = Border(bottom=under)
        sheet.merged_cells.add(CellRange(min_row=at.row, max_row=at.row, min_col=at.column,
                                         max_col=at.column + _EACH - 1))  # fmt: skip
    return _TOP + (len(firsts) - 1) // _ACROSS


def _verdict(
    sheet: Worksheet, writer: BlockWriter, row: int, verdict: tuple[str, str] | None
) -> int:
    """Whether the numbers of the book hold; nothing where no checks are in it."""
    if verdict is None:
        return row
    sheet.cell(row, 1, _CHECKS).style = styles.TEXT
    writer.formula(sheet, row, 2, *verdict)
    sheet.cell(row, 2).style = styles.LINE
    # Not bold: the longest verdict ends before the charts.
    _colour(sheet, f"B{row}:D{row}", f"$B{row}", "")
    # Beside what is changed as well.
    inputs, at = sheet.parent[INPUT_SHEET], Cell(sheet.title, row, 2).absolute
    here = Cell(INPUT_SHEET, NOTE_ROW, VALUE_COLUMN)
    text, (_, value) = f"{_CHECKS}: ", verdict
    said = f'=IF({STRUCTURE_CHANGED}>0,{at},"{text}"&{at})'
    writer.formula(inputs, here.row, here.column, said, f"{text}{value}")
    inputs.cell(here.row, here.column).style = styles.LINE
    mark = here.absolute.partition("!")[2]
    _colour(inputs, area(here, Cell(INPUT_SHEET, here.row, SOURCE_COLUMN)), mark, text)
    return row + 1


def _colour(sheet: Worksheet, cells: str, mark: str, before: str) -> None:
    """Fill of a verdict that is not good."""
    odd = FormulaRule([f'{mark}="{before}{UNUSUAL}"'], stopIfTrue=True, fill=styles.odd()["fill"])
    wrong = FormulaRule([f'{mark}<>"{before}{GOOD}"'], fill=styles.wrong()["fill"])
    for rule in (odd, wrong):
        sheet.conditional_formatting.add(cells, rule)


def _values(
    sheet: Worksheet, writer: BlockWriter, row: int, title: str, keys: Sequence[str]
) -> int:
    """Values that stand elsewhere, with symbol and unit."""
    sheet.cell(row, 1, title).style = styles.SUBTITLE
    for text, measure, formula, value, unit, look in known(writer, keys):
        row += 1
        raise_row(sheet, row, {text: _WIDTHS["A"]})
        writer.symbol(sheet, row, 2, measure)
        for column, words in ((1, text), (4, unit)):
            look_of = styles.UNIT if column == 4 else styles.TEXT
            sheet.cell(row, column, words or None).style = look_of
        key = formula.removeprefix("=")
        if key in writer.layout.model.fields:
            at = writer.layout.cells[key]
            link(sheet, Cell(sheet.title, row, 1), text, at.sheet, at.coordinate)
        writer.formula(sheet, row, 3, formula, value)
        sheet.cell(row, 3).style = styles.FORMULA
        sheet.cell(row, 3).number_format = look
    return row + 1


def known(
    writer: BlockWriter, keys: Sequence[str]
) -> Iterator[tuple[str, Field | Quantity, str, float | str, str, str]]:
    """Title, whose symbol, formula, value, unit and number format of what the book has."""
    model, values = writer.layout.model, writer.values.scalars
    known_keys = [key for key in keys if key in model.scalars and _finite(values.get(key, inf))]
    typed = [model.fields[key].value for key in keys if key in model.fields]
    decimals = styles.decimals_of([*typed, *(model.scalars[key].quantity for key in known_keys)])
    for key in keys:
        if key in model.fields:
            field = model.fields[key]
            yield (
                field.title,
                field,
                f"={key}",
                shown(field),
                field.unit,
                styles.typed_format(field.value, decimals),
            )
        elif key in known_keys:
            quantity = model.scalars[key].quantity
            look = styles.excel_format(quantity, decimals)
            formula, value = _of_worst_pin(writer, key)
            title = capital(quantity.title)
            if formula != f"={key}":
                for words, more in _WORST_PIN:
                    title = title.replace(words, f"{more} {words}")
            yield title, quantity, formula, value, quantity.unit_label, look


def _of_worst_pin(writer: BlockWriter, key: str) -> tuple[str, float | str]:
    """Formula and value of a scalar, of the most loaded pin where each has its own."""
    values = writer.values.scalars
    if key not in _OF_PINS or _WORST not in values:
        return f"={key}", values[key]
    count = len(Shape.of(writer.layout.model.input).pins)
    keys = [_OF_PINS[key].format(pin_name(number)) for number in range(1, count + 1)]
    return f"=CHOOSE({_WORST},{','.join(keys)})", values[keys[_worst_pin(writer) - 1]]


def _worst_pin(writer: BlockWriter) -> int:
    """The number of the most loaded pin; the first where a student is to find it."""
    worst = float(writer.values.scalars.get(_WORST, 1))
    return round(worst) if isfinite(worst) else 1


def _finite(value: float | str) -> bool:
    return isinstance(value, str) or isfinite(value)


def charts_beside(sheet: Worksheet, model: Model, writer: BlockWriter) -> list[Box]:
    """Two diagrams that answer at once beside the input data, above the lists of records."""
    left = sum(column_px(sheet, i) for i in range(1, SOURCE_COLUMN + 1)) + GAP
    listed = [writer.layout.cells[item.name].row for item in model.inputs if item.listed]
    top = top_of(sheet, HEADER_ROW + 1)
    room = top_of(sheet, min(listed) - 2) - top if listed else 2 * (HIGH + GAP)
    charts = BESIDE[: room // (HIGH + GAP)]
    return _drawn(sheet, model, writer, charts, (left, top, left + WIDE))


def _charts(sheet: Worksheet, model: Model, writer: BlockWriter, row: int) -> list[Box]:
    """The four that say most, two to a row and of one size."""
    left = sum(round(width * 7) for width in _WIDTHS.values()) + GAP
    return _drawn(sheet, model, writer, CHARTS,
                  (left, top_of(sheet, row), left + 2 * WIDE + GAP))  # fmt: skip


def _drawn(
    sheet: Worksheet, model: Model, writer: BlockWriter, wanted: Sequence[str],
    room: tuple[int, int, int],
) -> list[Box]:  # fmt: skip
    """Charts of one size from left to right and down; of several pins the most loaded one's."""
    worst = _worst_pin(writer)
    charts = [pin_figure(chart, worst) if chart in _PIN_CHARTS else chart for chart in wanted]
    specs = [model.charts_by_id[chart] for chart in charts if chart in model.charts_by_id]
    boxes = flow([(WIDE, HIGH)] * len(specs), *room)
    for spec, box in zip(specs, boxes, strict=True):
        chart = make_chart(spec, writer.layout, writer.values, oblong=box.width / box.height)
        chart.anchor = anchor(sheet, box)
        sheet.add_chart(chart)
        writer.caches.ranges |= ranges_of(spec, writer.layout, writer.values)
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
    sheet.cell(row, 2, "Столбцы, нужные только формулам, свёрнуты: кнопка «+» над столбцами.")
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
    for text, measure, formula, value, unit, look in known(writer, keys):
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
