"""A line over each table: a column's formula with the numbers of a chosen row put in, live.

The numbers and their texts stand on a hidden sheet, a row a name; a line joins them.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import count, islice

import numpy as np
from openpyxl.styles import Alignment, Protection
from openpyxl.workbook import Workbook
from openpyxl.worksheet.datavalidation import DataValidation
from openpyxl.worksheet.worksheet import Worksheet

from reports.formula.parse import SCALE_FUNCTIONS, names, parse
from reports.formula.plain import plain
from reports.model.blocks import Column, TableSpec
from reports.shared.russian import as_printed
from reports.workbook import styles
from reports.workbook.chapters import contents_for, heading
from reports.workbook.layout import FIRST_ROW, TITLE_ROW, Cell, column_range
from reports.workbook.places import column_px
from reports.workbook.sheets import BlockWriter

SHEET = "Подстановка"
_SYMBOL, _VALUE, _TEXT, _LINE_SYMBOL, _HEAD, _LINE = range(1, 7)  # columns of the hidden sheet
_WIDTHS = (14, 12, 12, 14, 50, 100)
_PLAIN = SCALE_FUNCTIONS | {"sin", "cos", "tan", "asin", "acos", "sqrt", "abs", "rad", "exp", "ln"}
_MAX_FORMULA, _MAX_LINE = 200, 90  # letters of a formula, of an equation
_TITLE_LETTER, _AFTER, _NARROWEST = 11, 12, 40  # px
_START = 1 / 12  # of a table's rows, where nothing is nought: 60° of 720
_DEGREE = "°"
_FINE = 8  # decimals of a number; with + 0 no program writes -0
# Decimals of its text, below what size.
_DECIMALS = ((0.1, 8), (100, 5), (1000, 3))
_LARGE = 1
_MARK = re.compile("\x01([0-9]+)\x02")


@dataclass(frozen=True)
class _Operand:
    """A name of a formula at the chosen row: where its text stands, and the text."""

    cell: str
    text: str


@dataclass
class _Texts:
    """The hidden sheet as it fills."""

    sheet: Worksheet
    writer: BlockWriter
    row: int = FIRST_ROW
    operands: dict[tuple[str, str], _Operand] = field(default_factory=dict)  # by table and name

    def put(self, column: int, text: str, value: float | str) -> str:
        """Write one formula; its address."""
        self.writer.bare(SHEET, (self.row, column), value, text.replace(f"'{SHEET}'!", ""))
        return Cell(SHEET, self.row, column).absolute

    def say(self, column: int, text: str) -> None:
        """Write a text."""
        self.writer.bare(SHEET, (self.row, column), text)


def write_substitutions(book: Workbook, writer: BlockWriter) -> None:
    """Write the lines of all tables of the visible sheets, and what they are joined of."""
    lines_by_table = {
        table.id: columns
        for table in writer.layout.model.tables.values()
        if book[table.sheet].sheet_state == "visible" and (columns := _lines_of(table, writer))
    }
    if not lines_by_table:
        return
    hidden = _Texts(book.create_sheet(SHEET), writer)
    for column, width in zip("ABCDEF", _WIDTHS, strict=True):
        hidden.sheet.column_dimensions[column].width = width
    head = heading(SHEET, contents_for(writer.layout.model))
    styles.as_text(hidden.sheet.cell(TITLE_ROW, 1, head)).style = styles.TITLE
    for name, columns in lines_by_table.items():
        table = writer.layout.model.tables[name]
        _table(book[table.sheet], hidden, table, columns)
    hidden.sheet.sheet_state = "hidden"


def shown(value: float, text: str = "") -> str:
    """Return a number as its text cell has it: a negative one in brackets."""
    value = as_printed(value, _FINE)
    digits = next((many for size, many in _DECIMALS if abs(value) < size), _LARGE)
    number = f"{as_printed(value, digits):.{digits}f}"
    number = (number.rstrip("0").rstrip(".") if "." in number else number) + text
    return f"({number})" if value < 0 else number


def _lines_of(table: TableSpec, writer: BlockWriter) -> list[Column]:
    """Columns with a line: a formula short enough, of one row and single numbers."""
    layout = writer.layout
    if layout.places[table.id].column > 1 or table.helper or not table.columns[0].quantity.unit:
        return []
    values = writer.values.columns.get(table.id)
    return [] if values is None else [c for c in table.columns if _is_told(c, table, writer)]


def _is_told(column: Column, table: TableSpec, writer: BlockWriter) -> bool:
    if column.expr is None or column.helper:
        return False
    for part in ast.walk(parse(column.expr)):
        if isinstance(part, ast.Call) and ast.unparse(part.func) not in _PLAIN:
            return False
        if isinstance(part, (ast.IfExp, ast.Compare, ast.BoolOp)):
            return False
        if isinstance(part, ast.Constant) and isinstance(part.value, str):
            return False
    used = names(column.expr)
    known = all(_is_number(name, table, writer) for name in used)
    said = writer.explained(column.quantity, column.expr, table.id)
    return bool(used) and known and 0 < len(said) < _MAX_LINE


def _is_number(name: str, table: TableSpec, writer: BlockWriter) -> bool:
    """Whether a name is a column of the same rows, or one number."""
    layout = writer.layout
    key = name if name in layout.columns else f"{table.id}.{name}"
    if key in layout.columns:
        return layout.columns[key][0].rows == table.rows
    if name in layout.model.grid_runs or name in layout.model.input_runs:
        return False
    return isinstance(_single(name, writer), (int, float))


def _single(name: str, writer: BlockWriter) -> object:
    field_of = writer.layout.model.fields.get(name)
    return writer.values.scalars.get(name, field_of.value if field_of is not None else None)


def _table(sheet: Worksheet, hidden: _Texts, table: TableSpec, columns: Sequence[Column]) -> None:
    """Write the texts of one table and its line."""
    writer = hidden.writer
    at = round((len(table.rows) - 1) * _START) or 1
    places = _beside_title(sheet)
    label, angle, chosen, line = (Cell(sheet.title, TITLE_ROW, column) for column in places)
    angles = writer.layout.range_of(f"{table.id}.{table.columns[0].key}")
    hidden.say(_SYMBOL, table.number or table.title)
    ordinal = hidden.put(_VALUE, _place(angle, angles), at + 1)
    hidden.row += 1
    for name in dict.fromkeys(n for c in columns for n in sorted(names(c.expr or ""))):
        hidden.operands[table.id, name] = _operand(hidden, table, name, ordinal, at)
        hidden.row += 1
    top, texts, lengths = hidden.row, dict[str, str](), dict[str, int]()
    for column in columns:
        symbol = column.quantity.symbol
        if symbol not in texts and (line_of := _line(hidden, table, column, ordinal, at)):
            head, said = line_of
            texts[symbol], lengths[symbol] = head + said, len(head)
            hidden.row += 1
    if not texts:
        return
    # With the empty row below: Gnumeric takes one cell for no range.
    symbols, heads, lines = (
        column_range(SHEET, c, top, hidden.row) for c in (_LINE_SYMBOL, _HEAD, _LINE)
    )
    choices = column_range(SHEET, _LINE_SYMBOL, top, hidden.row - 1)
    hidden.row += 1
    start = max(lengths, key=lengths.__getitem__)  # of formulas: no number decides
    quantity = table.columns[0].quantity
    said = f"при {quantity.symbol}, {quantity.unit_label}"
    title = sheet.cell(label.row, label.column, said)
    title.style = styles.NOTE
    title.alignment = Alignment(horizontal="right", vertical="center")
    _choice(sheet, angle, table.rows[at], angles)
    _choice(sheet, chosen, start, choices)
    row = f"MATCH({chosen.coordinate},{symbols},0)"
    text = f"=INDEX({heads},{row})&INDEX({lines},{row})"
    writer.formula(sheet, line.row, line.column, text, texts[start])
    sheet.cell(line.row, line.column).style = styles.LINE


def _place(angle: Cell, angles: str) -> str:
    """Return the formula of the place of an angle among others that go by equal steps."""
    sheet, _, ends = angles.rpartition("!")
    first = f"{sheet}!{ends.partition(':')[0]}"
    second = first[: -len(str(FIRST_ROW))] + str(FIRST_ROW + 1)
    return f"=1+ROUND(({angle.absolute}-{first})/({second}-{first}),0)"


def _beside_title(sheet: Worksheet) -> list[int]:
    """Return the columns of the line that are seen, after the title."""
    title = _TITLE_LETTER * len(str(sheet.cell(TITLE_ROW, 1).value)) + _AFTER
    column, width = 1, 0
    while width < title:
        width += column_px(sheet, column)
        column += 1
    seen = (index for index in count(column) if column_px(sheet, index) >= _NARROWEST)
    return list(islice(seen, 4))


def _choice(sheet: Worksheet, at: Cell, value: float | str, choices: str) -> None:
    """Write a cell that a person changes."""
    cell = sheet.cell(at.row, at.column, value)
    cell.style, cell.protection = styles.INPUT, Protection(locked=False)
    rule = DataValidation(type="list", formula1=choices, allow_blank=False)
    rule.showErrorMessage, rule.error = True, "Выберите значение из списка."
    sheet.add_data_validation(rule)
    rule.add(cell)


def _operand(hidden: _Texts, table: TableSpec, name: str, ordinal: str, at: int) -> _Operand:
    """Write the number of a name in the chosen row and its text."""
    writer, layout = hidden.writer, hidden.writer.layout
    key = name if name in layout.columns else f"{table.id}.{name}"
    if key in layout.columns:
        text = f"INDEX({layout.range_of(key)},{ordinal})"
        home, _, column = key.partition(".")
        value = float(writer.values.columns[home][column][at])
    else:
        text, value = layout.name_of(name), float(_single(name, writer))  # type: ignore[arg-type]
    hidden.say(_SYMBOL, writer.symbol_of(name, table.id))
    hidden.put(_VALUE, f"={text}", value)
    cell = Cell(SHEET, hidden.row, _VALUE).coordinate
    model = layout.model
    node, given = model.nodes.get(key) or model.nodes.get(name), model.fields.get(name)
    label = node.quantity.unit_label if node is not None else ""
    label = given.unit if given is not None else label
    degree = label if label == _DEGREE else ""
    digits = str(_LARGE)
    for size, many in reversed(_DECIMALS):
        times, below = (f"*{round(1 / size)}", 1) if size < 1 else ("", size)
        digits = f"IF(ABS({cell}){times}<{below},{many},{digits})"
    rounded, sign = f"(ROUND({cell},{digits})+0)", f"ROUND({cell},{_FINE})<0"
    said = f'=IF({sign},"(","")&{rounded}&"{degree}"&IF({sign},")","")'
    return _Operand(hidden.put(_TEXT, said, shown(value, degree)).rpartition("!")[2],
                    shown(value, degree))  # fmt: skip


def _line(
    hidden: _Texts, table: TableSpec, column: Column, ordinal: str, at: int
) -> tuple[str, str] | None:
    """Write a column's line; None where its formula would be too long for a spreadsheet."""
    writer, quantity = hidden.writer, column.quantity
    assert column.expr is not None
    used = sorted(names(column.expr))
    put_in = plain(column.expr, lambda name: f"\x01{used.index(name)}\x02", scaled=True)
    symbols = plain(column.expr, lambda name: writer.symbol_of(name, table.id), scaled=True)
    head, unit = f"{quantity.symbol} = {symbols} = ", quantity.unit_label
    key, decimals = f"{table.id}.{column.key}", quantity.digits.decimals
    value = float(writer.values.columns[table.id][column.key][at])
    number = np.format_float_positional(as_printed(value, decimals), trim="-")
    after = f" {unit}" if unit else ""
    operands = [hidden.operands[table.id, name] for name in used]
    joined = "&".join(_pieces(put_in, [each.cell for each in operands]))
    ordinal = ordinal.rpartition("!")[2]
    result = f"(ROUND(INDEX({writer.layout.range_of(key)},{ordinal}),{decimals})+0)"
    formula = f'={joined}&" = "&{result}&"{after}"'.replace(f"'{SHEET}'!", "")
    if len(formula) > _MAX_FORMULA:
        return None
    hidden.say(_LINE_SYMBOL, quantity.symbol)
    hidden.say(_HEAD, head)
    said = _MARK.sub(lambda match: operands[int(match[1])].text, put_in)
    text = f"{said} = {number}{after}"
    hidden.put(_LINE, formula, text)
    return head, text


def _pieces(text: str, cells: list[str]) -> Iterator[str]:
    """Yield what a formula joins: texts in quotes and the cells of the numbers."""
    for number, part in enumerate(_MARK.split(text)):
        if number % 2:
            yield cells[int(part)].replace("$", "")
        elif part:
            yield f'"{part}"'
