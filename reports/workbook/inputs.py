"""The sheet of input data: named cells with units, ranges and data validation."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from itertools import groupby
from textwrap import shorten

from openpyxl.comments import Comment
from openpyxl.formatting.rule import CellIsRule
from openpyxl.styles import Alignment, Protection
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.datavalidation import DataValidation
from openpyxl.worksheet.worksheet import Worksheet

from reports.formula.excel import number
from reports.inputs.fields import Field
from reports.model.blocks import Model
from reports.shared.russian import capital, short
from reports.workbook import styles
from reports.workbook.layout import (
    HEADER_ROW,
    KEY_COLUMN,
    MAX_COLUMN,
    MIN_COLUMN,
    SYMBOL_COLUMN,
    TITLE_COLUMN,
    UNIT_COLUMN,
    VALUE_COLUMN,
    Layout,
    arranged,
)
from reports.workbook.sheets import BlockWriter

LEGEND_ROW = 3
_HEADINGS = ("Величина", "Обозначение", "Значение", "Единица", "От", "До")
_LEGEND = "Жёлтые меняют; после оранжевых нужна команда kshm build"
_SAMPLES = ((styles.INPUT, "меняют"), (styles.STRUCTURE, "строение"))
_KEY = "Ключ в файле .toml"
_FOLDED = "свёрнуто: «+» слева от строк"
_TITLE_LETTERS = 32  # of a message box, as much as Excel takes
_LOOKS = {KEY_COLUMN: styles.NOTE, UNIT_COLUMN: styles.UNIT}


def write_inputs(sheet: Worksheet, model: Model, writer: BlockWriter) -> None:
    """All input fields of a model below a legend and headings; words about the work folded."""
    layout = writer.layout
    _legend(sheet)
    for column, text in enumerate(_HEADINGS, 1):
        sheet.cell(HEADER_ROW, column, text).style = styles.HEADER
    sheet.cell(HEADER_ROW, KEY_COLUMN, _KEY).style = styles.HEADER
    # A section may be interrupted by the lists that stand within it in the file.
    for section, run in groupby(arranged(model.inputs), lambda item: item.section):
        items = list(run)
        top = layout.cells[items[0].name].row - (2 if items[0].listed else 1)
        sheet.cell(top, 1, section).style = styles.SUBTITLE
        decimals = {
            column: styles.decimals_of(item.value for item in group)
            for column, group in _by_column(items, layout).items()
        }
        for item in items:
            _field(sheet, item, writer, top, decimals[layout.cells[item.name].column])
        if items[0].path[0] == "report":
            sheet.cell(top, VALUE_COLUMN, _FOLDED).style = styles.NOTE
            for item in items:
                dimension = sheet.row_dimensions[layout.cells[item.name].row]
                dimension.outlineLevel, dimension.hidden = 1, True
    sheet.sheet_properties.outlinePr.summaryBelow = False
    # Told by the notes; without its names a book is graded by these.
    sheet.column_dimensions[get_column_letter(KEY_COLUMN)].hidden = True
    _mark_wrong(sheet, model, layout)


def _legend(sheet: Worksheet) -> None:
    """What the colours of the cells say; the samples hold nothing and cannot be typed into."""
    sheet.cell(LEGEND_ROW, 1, _LEGEND).style = styles.NOTE
    for column, (look, text) in enumerate(_SAMPLES, VALUE_COLUMN):
        cell = sheet.cell(LEGEND_ROW, column, text)
        cell.style = look
        cell.protection = Protection(locked=True)
        cell.alignment = Alignment(horizontal="center", vertical="center")


def _field(sheet: Worksheet, item: Field, writer: BlockWriter, top: int, decimals: int) -> None:
    """One value with its labels; the headers of a list stand below the title at ``top``."""
    cell = writer.layout.cells[item.name]
    if item.listed:
        _entry(sheet, item, cell.row, cell.column, top + 1)
    else:
        _labels(sheet, item, cell.row)
        writer.symbol(sheet, cell.row, SYMBOL_COLUMN, item)
    target = styles.as_text(sheet.cell(cell.row, cell.column, shown(item)))
    target.style = styles.STRUCTURE if item.structural else styles.INPUT
    text = isinstance(item.value, str)
    target.number_format = "@" if text else styles.typed_format(item.value, decimals)
    _validate(sheet, item, cell.coordinate, limits_of(item, writer.layout))


def _by_column(items: Sequence[Field], layout: Layout) -> dict[int, list[Field]]:
    columns: dict[int, list[Field]] = defaultdict(list)
    for item in items:
        columns[layout.cells[item.name].column].append(item)
    return columns


def shown(item: Field) -> float | int | str:
    """Value as the cell shows it: choices by their Russian label."""
    if item.choices is not None and isinstance(item.value, str):
        return item.choices[item.value]
    return item.value


def options(item: Field) -> list[int | str]:
    """What the cell of a choice may hold: numbers without the words that a file has for them."""
    choices = item.choices or {}
    return list(map(int, choices)) if isinstance(item.value, int) else [*choices.values()]


def range_text(item: Field) -> str:
    """Return allowed range in words."""
    if item.minimum is None or item.maximum is None:
        return ""
    return f"{short(item.minimum)} … {short(item.maximum)}"


def _labels(sheet: Worksheet, item: Field, row: int) -> None:
    texts = {
        TITLE_COLUMN: item.title,
        UNIT_COLUMN: item.unit,
        KEY_COLUMN: ".".join(
            str(part + 1 if isinstance(part, int) else part) for part in item.path
        ),
    }
    for column, text in texts.items():
        sheet.cell(row, column, text or None).style = _LOOKS.get(column, styles.TEXT)
    if item.minimum is not None and item.maximum is not None:
        for column, limit in ((MIN_COLUMN, item.minimum), (MAX_COLUMN, item.maximum)):
            sheet.cell(row, column, limit).style = styles.UNIT
    key = Comment(f"{_KEY}: {texts[KEY_COLUMN]}", "kshm")
    key.width, key.height = 330, 40
    sheet.cell(row, TITLE_COLUMN).comment = key
    sheet.cell(row, VALUE_COLUMN)


def limits_of(item: Field, layout: Layout) -> tuple[str, str] | None:
    """Limits of an input as its formulas name them: their cells, of records the numbers."""
    if item.minimum is None or item.maximum is None:
        return None
    if item.listed:
        return number(item.minimum), number(item.maximum)
    row = layout.cells[item.name].row
    least, most = (f"${get_column_letter(column)}{row}" for column in (MIN_COLUMN, MAX_COLUMN))
    return least, most


def _entry(sheet: Worksheet, item: Field, row: int, column: int, header_row: int) -> None:
    """Write a value of a list of records: headers above, the number of the entry on the left."""
    number = int(item.path[-2]) + 1
    sheet.cell(header_row, 1, "№").style = styles.HEADER
    sheet.cell(row, 1, number).style = styles.HEADER
    if number == 1:
        unit = f", {item.unit}" if item.unit else ""
        title = item.title.replace(" 1:", ":").split(":")[-1].strip()
        header = sheet.cell(header_row, column, capital(title) + unit)
        header.style = styles.HEADER


def _validate(
    sheet: Worksheet, item: Field, coordinate: str, limits: tuple[str, str] | None
) -> None:
    if item.choices is not None:
        labels = list(map(str, options(item)))
        rule = DataValidation(type="list", formula1=f'"{",".join(labels)}"', allow_blank=False)
        if any("," in label for label in labels) or len(",".join(labels)) > 250:
            return
        rule.error = "Выберите значение из списка."
    elif limits is not None:
        whole = isinstance(item.value, int) and item.structural
        rule = DataValidation(
            type="whole" if whole else "decimal",
            operator="between",
            formula1=limits[0],
            formula2=limits[1],
            allow_blank=False,
        )
        rule.error = f"Допустимо {range_text(item)} {item.unit}".strip() + "."
    else:
        return
    rule.errorTitle = shorten(item.title, _TITLE_LETTERS, placeholder="…")
    rule.showErrorMessage = True
    sheet.add_data_validation(rule)
    rule.add(coordinate)


def _mark_wrong(sheet: Worksheet, model: Model, layout: Layout) -> None:
    """Red where a number is beyond its range: what is deleted or pasted no validation stops.

    A text is larger than every number, and a cell left empty is zero.
    """
    cells: dict[tuple[str, str], list[str]] = defaultdict(list)
    for item in model.inputs:
        if limits := limits_of(item, layout):
            cells[limits].append(layout.cells[item.name].coordinate)
    for limits, addresses in cells.items():
        rule = CellIsRule("notBetween", list(limits), **styles.wrong())
        sheet.conditional_formatting.add(" ".join(addresses), rule)
