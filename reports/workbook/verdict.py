"""Whether the numbers of an open book hold: data in their limits, sheets without errors, checks.

All three stand on the sheet of checks; the first sheet says the gravest.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby

from openpyxl.formatting.rule import CellIsRule, FormulaRule
from openpyxl.styles import PatternFill
from openpyxl.utils import coordinate_to_tuple, get_column_letter
from openpyxl.workbook import Workbook
from openpyxl.worksheet.worksheet import Worksheet

from reports.formula.excel import number
from reports.inputs.fields import Field
from reports.model.blocks import NO, YES, Model
from reports.workbook import styles
from reports.workbook.inputs import options
from reports.workbook.layout import (
    FIRST_ROW,
    INPUT_SHEET,
    KEY_COLUMN,
    TITLE_COLUMN,
    UNIT_COLUMN,
    VALUE_COLUMN,
    Cell,
    Layout,
    area,
    column_range,
    quoted,
)
from reports.workbook.links import link
from reports.workbook.pairs import Condition, conditions
from reports.workbook.sheets import CacheValues, Writer

GOOD, BAD = "все выполнены", "не все, см. «Проверки»"
BEYOND, UNKNOWN = "вне пределов, см. «Проверки»", "не посчитаны, см. «Проверки»"
ODD, _UNKNOWN = "необычно", "—"
_BEYOND = "Строки: 1 — вне пределов, 2 — необычно"
_WITHIN = f"{INPUT_SHEET}: сколько строк вне пределов или противоречит другим"
_WRONG_ROW, _ODD_ROW = 1, 2
_Tests = Mapping[int, Sequence[tuple[Condition, str]]]


def check_keys(writer: Writer) -> list[str]:
    """Scalars of the checks whose verdicts stand in the book; none of a book to fill in."""
    values = writer.values.scalars
    keys = [key for key in writer.layout.model.scalars if key.startswith("check_")]
    return keys if all(values.get(key) in (YES, NO) for key in keys) else []


def write_verdict(book: Workbook, model: Model, writer: Writer) -> tuple[str, str] | None:
    """Formula and value of what the first sheet says of the numbers; nothing without checks."""
    keys = check_keys(writer)
    if not keys:
        return None
    layout, values = writer.layout, writer.values.scalars
    first, last = layout.cells[keys[0]], layout.cells[keys[-1]]
    checks = column_range(first.sheet, first.column, first.row, last.row)
    # The verdicts of the sheet's own list follow from these.
    areas = _areas(writer.caches) | {
        first.sheet: column_range(first.sheet, VALUE_COLUMN, first.row, last.row)
    }
    held = list(conditions(model, layout, values))
    sheet = book[first.sheet]
    row = sheet.max_row + 2
    in_order = _in_order(sheet, row + 2, held, writer)
    beyond = _limits(book[INPUT_SHEET], model, writer, in_order)
    sheet.cell(row, TITLE_COLUMN, "Исходные данные и листы").style = styles.SUBTITLE
    within = _within(sheet, row + 1, beyond, writer)
    titles = [title for title in book.sheetnames if title in areas]
    own = {title: areas[title] for title in titles}
    sheets = _without_errors(sheet, row + 2 + len(held), own, writer)
    colour_verdicts(sheet, row + 1, row + 1 + len(held) + len(titles), YES, NO)
    good = all(values[key] == YES for key in keys)
    return (
        f'=IF(COUNTIF({sheets},"{NO}")>0,"{UNKNOWN}",'
        f'IF({within}<>"{YES}","{BEYOND}",'
        f'IF(COUNTIF({checks},"{YES}")={len(keys)},"{GOOD}","{BAD}")))',
        GOOD if good else BAD,
    )


def _within(sheet: Worksheet, row: int, beyond: str, writer: Writer) -> str:
    """The check of the input data; the address of its verdict."""
    link(sheet, Cell(sheet.title, row, TITLE_COLUMN), _WITHIN, INPUT_SHEET)
    count = Cell(sheet.title, row, VALUE_COLUMN)
    writer.formula(sheet, row, count.column, f"=COUNTIF({beyond},{_WRONG_ROW})", 0.0)
    sheet.cell(row, count.column).style = styles.FORMULA
    place = Cell(sheet.title, row, UNIT_COLUMN)
    _say(sheet, place, f'=IF({count.coordinate}=0,"{YES}","{NO}")', writer)
    return place.absolute


def _in_order(sheet: Worksheet, row: int, held: Sequence[Condition], writer: Writer) -> _Tests:
    """A verdict for each pair that must be in order; by rows of input data what tests it."""
    found: dict[int, list[tuple[Condition, str]]] = defaultdict(list)
    for at, condition in enumerate(held, row):
        link(sheet, Cell(sheet.title, at, TITLE_COLUMN), condition.title, INPUT_SHEET)
        wrong, place = ODD if condition.pair.warning else NO, Cell(sheet.title, at, UNIT_COLUMN)
        told = f'IF({condition.formula},"{YES}","{wrong}")'
        formula = f'=IF(ISERROR({condition.formula}),"{_UNKNOWN}",{told})'
        _say(sheet, place, formula, writer, YES if condition.holds else wrong)
        for item in condition.fields:
            test = f'{place.absolute}<>"{wrong}"'
            found[writer.layout.cells[item.name].row].append((condition, test))
    return found


def _without_errors(sheet: Worksheet, row: int, areas: dict[str, str], writer: Writer) -> str:
    """A verdict for each sheet; their range."""
    for at, (title, area_of) in enumerate(areas.items(), row):
        link(sheet, Cell(sheet.title, at, TITLE_COLUMN), f"{title}: без ошибок в формулах", title)
        formula = f'=IF(ISERROR(SUM({area_of})),"{NO}","{YES}")'
        _say(sheet, Cell(sheet.title, at, UNIT_COLUMN), formula, writer)
    return column_range(sheet.title, UNIT_COLUMN, row, row + len(areas) - 1)


def colour_verdicts(sheet: Worksheet, first: int, last: int, good: str, bad: str) -> None:
    """Verdicts of rows green and red."""
    place = area(*(Cell(sheet.title, row, UNIT_COLUMN) for row in (first, last)))
    green = PatternFill(bgColor="C6EFCE")
    sheet.conditional_formatting.add(place, CellIsRule("equal", [f'"{good}"'], fill=green))
    sheet.conditional_formatting.add(place, CellIsRule("equal", [f'"{bad}"'], **styles.wrong()))


def _say(sheet: Worksheet, place: Cell, formula: str, writer: Writer, said: str = YES) -> None:
    writer.formula(sheet, place.row, place.column, formula, said)
    sheet.cell(place.row, place.column).style = styles.CHECK


def _areas(caches: CacheValues) -> dict[str, str]:
    """Sheet → the range of all its formula cells: the ends of a filled column are among them."""
    found: dict[str, str] = {}
    for title, cells in caches.values.items():
        places = [coordinate_to_tuple(place) for place in cells]
        rows, columns = {row for row, _ in places}, {column for _, column in places}
        first, last = (
            Cell(title, end(rows), end(columns)).absolute.partition("!")[2] for end in (min, max)
        )
        found[title] = f"{quoted(title)}!{first}:{last}"
    return found


def _limits(sheet: Worksheet, model: Model, writer: Writer, in_order: _Tests) -> str:
    """A folded column that says which rows are wrong, and which odd; its range."""
    layout = writer.layout
    rows: dict[int, list[Field]] = defaultdict(list)
    for item in model.inputs:
        if options(item) or item.minimum is not None:
            rows[layout.cells[item.name].row].append(item)
    column = 1 + max(KEY_COLUMN, *(layout.cells[item.name].column for item in model.inputs))
    sheet.cell(FIRST_ROW - 1, column, _BEYOND).style = styles.HEADER
    for row, items in rows.items():
        tests, usual = list(_tests(items, layout)), list[str]()
        state = 0.0
        for condition, test in in_order.get(row, ()):
            (usual if condition.pair.warning else tests).append(test)
            state = state if condition.holds else _ODD_ROW
        other = f"IF(AND({','.join(usual)}),0,{_ODD_ROW})" if usual else "0"
        formula = f"=IF(AND({','.join(tests)}),{other},{_WRONG_ROW})"
        writer.formula(sheet, row, column, formula, state)
        sheet.cell(row, column).style = styles.HELPER
    letter = get_column_letter(column)
    sheet.sheet_properties.outlinePr.summaryRight = False
    sheet.column_dimensions[letter].outlineLevel, sheet.column_dimensions[letter].hidden = 1, True
    # Of a list only the number of the line: which of its cells it is their own limits say.
    marked = [area(Cell("", min(rows), 1), Cell("", max(rows), 1))]
    marked += [layout.cells[i.name].coordinate for found in rows.values() for i in found
               if not i.listed]  # fmt: skip
    for state, look in ((_WRONG_ROW, styles.wrong()), (_ODD_ROW, styles.odd())):
        rule = FormulaRule([f"${letter}{min(rows)}={state}"], **look)
        sheet.conditional_formatting.add(" ".join(marked), rule)
    return column_range(sheet.title, column, min(rows), max(rows))


def _tests(items: Sequence[Field], layout: Layout) -> Iterable[str]:
    """What the cells of a row must hold; neighbours of equal limits together."""
    for item in items:
        if words := options(item):
            cell = layout.cells[item.name].coordinate
            yield f"OR({','.join(f'{cell}={number(word)}' for word in words)})"
    numbers = [item for item in items if not options(item)]
    for (least, most), run in groupby(numbers, lambda item: (item.minimum, item.maximum)):
        cells = [layout.cells[item.name] for item in run]
        if least is None or most is None:
            continue
        place = area(cells[0], cells[-1]) if len(cells) > 1 else cells[0].coordinate
        yield f"COUNT({place})={len(cells)}"  # an empty cell would be zero
        yield f"MIN({place})>={number(least)}"
        yield f"MAX({place})<={number(most)}"
