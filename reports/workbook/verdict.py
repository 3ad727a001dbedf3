"""Verdicts of an open book: inputs within limits, no errors, checks passed.

All three stand on the sheet of checks; the first sheet says the gravest.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from openpyxl.formatting.rule import CellIsRule, FormulaRule
from openpyxl.styles import PatternFill
from openpyxl.utils import coordinate_to_tuple, get_column_letter
from openpyxl.workbook import Workbook
from openpyxl.workbook.defined_name import DefinedName
from openpyxl.worksheet.worksheet import Worksheet

from reports.formula.excel import number
from reports.inputs.checks.bearings import PAIRS, Pair, Term, is_of, terms_of
from reports.inputs.fields import Field, regime_suffix
from reports.model.blocks import NO, YES, Held, Model, ScalarTable
from reports.tables.verdicts import outcomes
from reports.workbook import styles
from reports.workbook.inputs import options, shown
from reports.workbook.layout import (
    HEADER_ROW,
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
from reports.workbook.sheets import BlockWriter, CacheValues, link

_Fields = Mapping[str, Sequence[Field]]
_POINTS = Pair("gas.points", "gas.points", "Углы точек диаграммы возрастают")
GOOD, _WHERE = "все выполнены", ", см. «Проверки»"
_BAD, _UNUSUAL, _OUTSIDE, _BLANK = "не все", "есть необычное", "вне пределов", "не посчитаны"
BAD, UNUSUAL, BEYOND, UNKNOWN = (f"{words}{_WHERE}" for words in (_BAD, _UNUSUAL, _OUTSIDE, _BLANK))
RESHAPED = "структура изменена: выполните build"
STRUCTURE_CHANGED = "structure_changed"  # name of the cell that counts what was changed
ODD, _UNKNOWN = "необычно", "—"
_BEYOND = "Строки: 1 — вне пределов, 2 — необычно, от 10 — структура изменена"
_WITHIN = f"{INPUT_SHEET}: сколько строк вне пределов или противоречит другим"
_FAILED, _BROKEN = "сколько не так", "На скольких листах ошибки в формулах"
_RESHAPED_ROWS = f"{INPUT_SHEET}: в скольких строках изменена структура"
_WRONG_ROW, _ODD_ROW, RESHAPED_ROW = 1, 2, 10  # the last is added to either
_LISTS = 4  # rows before those of lists: a title and counts
_CHECKS = "checks"  # the list of the house; a department's book may have checks too


@dataclass(frozen=True, slots=True)
class Condition:
    """A pair of this book: what its formula tests, and the cells that it is about."""

    pair: Pair
    title: str
    formula: str
    fields: tuple[Field, ...]
    holds: bool  # with the values that the book is built with


def conditions(
    model: Model, layout: Layout, scalars: Mapping[str, float | str]
) -> Iterator[Condition]:
    """Every pair both of whose sides stand in the book, those of further regimes as well."""
    main, further = _by_key(model.inputs)
    for number_, regime in ((1, main), *further.items()):
        suffix, whose = (regime_suffix(number_), f", режим {number_}") if number_ > 1 else ("", "")
        shared = {key: of_key for key, of_key in main.items() if not suffix or not _of_regime(key)}
        fields = {**shared, **regime}
        for pair in PAIRS:
            if not is_of(pair, model.input.engine.strokes, fields.get):
                continue
            less, more = (
                _side(side, end, fields, layout, scalars, suffix)
                for side, end in ((pair.less, "MAX"), (pair.more, "MIN"))
            )
            if less is None or more is None or not (less.own or more.own):
                continue
            cells = (*less.fields, *more.fields)
            # A further regime is held to its own gas; what rests on a speed rests on the first.
            if suffix and not any(field.path[2:3] == ("gas",) for field in cells):
                continue
            sign = "<" if pair.strict else "<="
            text, holds = f"{less.text}{sign}{more.text}", pair.holds(less.value, more.value)
            yield Condition(pair, pair.title + whose, text, cells, holds)
        if angles := tuple(item for item in regime.get(_POINTS.less, ()) if item.path[-1] == 0):
            title = _POINTS.title + whose
            yield Condition(_POINTS, title, _rising(angles, layout), angles, holds=True)


def _rising(fields: Sequence[Field], layout: Layout) -> str:
    """That each of several cells of a column is greater than the one above it."""
    first, last = (layout.cells[item.name] for item in (fields[0], fields[-1]))
    above = column_range(first.sheet, first.column, first.row, last.row - 1)
    below = column_range(first.sheet, first.column, first.row + 1, last.row)
    return f"SUMPRODUCT(1*({below}<={above}))=0"


def _by_key(inputs: Sequence[Field]) -> tuple[_Fields, dict[int, _Fields]]:
    """Fields by their keys without numbers: the main ones, and those of each further regime."""
    grouped: dict[int, dict[str, list[Field]]] = defaultdict(lambda: defaultdict(list))
    for item in inputs:
        path, regime = item.path, 1
        if path[0] == "regimes":
            regime, path = int(path[1]) + 2, path[2:]
            path = path if path[0] == "gas" else ("regime", *path)
        key = ".".join(part for part in path if isinstance(part, str))
        grouped[regime][key].append(item)
    return grouped.pop(1), {key: dict(fields) for key, fields in grouped.items()}


def _of_regime(key: str) -> bool:
    """Whether each regime has this key for itself."""
    return key.startswith(("regime.", "gas."))


@dataclass(frozen=True, slots=True)
class _Side:
    text: str
    value: float
    fields: tuple[Field, ...]
    own: bool


def _side(
    side: str,
    end: str,
    fields: _Fields,
    layout: Layout,
    scalars: Mapping[str, float | str],
    suffix: str,
) -> _Side | None:
    """The first term of a side that the book holds, with its cells."""
    for index, term in enumerate(terms_of(side)):
        name = term.key.removeprefix("=") + suffix
        if term.key[0] == "=" and name in layout.model.scalars:
            value = term.of(float(scalars[name]))
            return _Side(_scaled(layout.name_of(name), term), value, (), False)
        if cells := tuple(fields.get(term.key, ())):
            values = [float(item.value) for item in cells]
            value = term.of(max(values) if end == "MAX" else min(values))
            return _Side(_scaled(_cells(cells, end, layout), term), value, cells, not index)
    return None


def _cells(fields: Sequence[Field], end: str, layout: Layout) -> str:
    """One cell by its name, the end of several of a column."""
    if len(fields) == 1:
        return layout.name_of(fields[0].name)
    first, last = (layout.cells[item.name] for item in (fields[0], fields[-1]))
    return f"{end}({column_range(first.sheet, first.column, first.row, last.row)})"


def _scaled(text: str, term: Term) -> str:
    power = "" if term.power == 1 else f"^{number(term.power)}"
    return text + power if term.times == 1 else f"{number(term.times)}*{text}{power}"


_Tests = Mapping[int, Sequence[tuple[Condition, str]]]


def judged_lists(writer: BlockWriter) -> list[ScalarTable]:
    """Lists whose verdicts stand in the book; none of a book to fill in."""
    model, scalars = writer.layout.model, writer.values.scalars
    lists = [block for block in model.blocks if isinstance(block, ScalarTable) and block.held]
    judged = [each.block for each in outcomes(model, scalars)]
    whole = all(judged.count(block.id) == len(block.pairs) for block in lists)
    return lists if whole and _CHECKS in judged else []


def write_verdict(book: Workbook, model: Model, writer: BlockWriter) -> tuple[str, str] | None:
    """Formula and value of what the first sheet says of the numbers; nothing without checks."""
    lists = judged_lists(writer)
    if not lists:
        return None
    layout = writer.layout
    checks = next(block for block in lists if block.id == _CHECKS)
    first, last = (layout.cells[checks.scalars[end].key] for end in (0, -1))
    # The verdicts of the sheet's own list follow from these.
    areas = _areas(writer.caches) | {
        first.sheet: column_range(first.sheet, VALUE_COLUMN, first.row, last.row)
    }
    for title, cells in areas.items():
        fade(book[title], cells.rpartition("!")[2])
    held, sheet = list(conditions(model, layout, writer.values.scalars)), book[first.sheet]
    row = sheet.max_row + 2
    pairs_row = row + _LISTS + len(lists)
    states = _limits(book[INPUT_SHEET], model, writer, _in_order(sheet, pairs_row, held, writer))
    titles = {title: areas[title] for title in book.sheetnames if title in areas}
    sheets = _without_errors(sheet, pairs_row + len(held), titles, writer)
    said = _inputs_and_sheets(sheet, row, states, sheets, writer)
    verdicts = {_of_list(sheet, at, block, writer) for at, block in enumerate(lists, row + _LISTS)}
    colour_verdicts(sheet, row + 1, pairs_row - 1 + len(held) + len(titles), YES, NO)
    final = BAD if NO in verdicts else UNUSUAL if ODD in verdicts else GOOD
    at = Cell(sheet.title, row, UNIT_COLUMN)
    writer.formula(sheet, row, at.column, _gravest(row, row + _LISTS, pairs_row - 1), final)
    sheet.cell(row, at.column).style = styles.LINE
    return f"=IF({STRUCTURE_CHANGED}>0,{said},{at.absolute})", final


def _inputs_and_sheets(
    sheet: Worksheet, row: int, states: str, sheets: str, writer: BlockWriter
) -> str:
    """Counts of wrong inputs, of sheets with errors and of changes; where the last is judged."""
    sheet.cell(row, TITLE_COLUMN, "Исходные данные и листы").style = styles.SUBTITLE
    wrong = "+".join(f"COUNTIF({states},{_WRONG_ROW + more})" for more in (0, RESHAPED_ROW))
    _counted(sheet, row + 1, _WITHIN, INPUT_SHEET, f"={wrong}", writer)
    _counted(sheet, row + 2, _BROKEN, sheet.title, f'=COUNTIF({sheets},"{NO}")', writer)
    reshaped = f'=COUNTIF({states},">={RESHAPED_ROW}")'
    said = _counted(sheet, row + 3, _RESHAPED_ROWS, INPUT_SHEET, reshaped, writer, bad=RESHAPED)
    count = DefinedName(
        STRUCTURE_CHANGED, attr_text=Cell(sheet.title, row + 3, VALUE_COLUMN).absolute
    )
    sheet.parent.defined_names[STRUCTURE_CHANGED] = count
    return said


def _gravest(row: int, first: int, last: int) -> str:
    """The gravest of the counts below a row and of the verdicts on lists."""
    letter, value = get_column_letter(UNIT_COLUMN), get_column_letter(VALUE_COLUMN)
    lists = f"{letter}{first}:{letter}{last}"
    wrong, odd = (f'COUNTIF({lists},"{words}")' for words in (NO, ODD))
    outside, blank = f"{value}{row + 1}", f"{value}{row + 2}"
    worst = f'IF({blank},"{_BLANK}",IF({outside},"{_OUTSIDE}",IF({wrong},"{_BAD}","{_UNUSUAL}")))'
    return f'=IF({blank}+{outside}+{wrong}+{odd}=0,"{GOOD}",{worst}&"{_WHERE}")'


def _of_list(sheet: Worksheet, row: int, block: ScalarTable, writer: BlockWriter) -> str:
    """How many values of a list are not as they should be; the verdict on it."""
    cells = [writer.layout.cells[verdict.key] for _, verdict in block.pairs]
    within = column_range(block.sheet, cells[0].column, cells[0].row, cells[-1].row)
    good = (block.verdicts or (YES, NO))[0]
    values = writer.values.scalars
    count = sum(values[verdict.key] != good for _, verdict in block.pairs)
    bad = ODD if block.held is Held.USUAL else NO
    _counted(
        sheet, row, f"{block.title}: {_FAILED}", block.sheet,
        f'=COUNTIF({within},"<>{good}")', writer, count, bad=bad,
    )  # fmt: skip
    return bad if count else YES


def _counted(
    sheet: Worksheet,
    row: int,
    title: str,
    target: str,
    formula: str,
    writer: BlockWriter,
    count: float = 0.0,
    *,
    bad: str = NO,
) -> str:
    """A count that must be zero, and whether it is; the address of the verdict."""
    link(sheet, Cell(sheet.title, row, TITLE_COLUMN), title, target)
    at, cell = (Cell(sheet.title, row, column) for column in (VALUE_COLUMN, UNIT_COLUMN))
    writer.formula(sheet, row, at.column, formula, float(count))
    sheet.cell(row, at.column).style = styles.FORMULA
    verdict = f'=IF({at.coordinate}=0,"{YES}","{bad}")'
    _say(sheet, cell, verdict, writer, bad if count else YES)
    return cell.absolute


def _in_order(sheet: Worksheet, row: int, held: Sequence[Condition], writer: BlockWriter) -> _Tests:
    """A verdict for each pair that must be in order; by rows of input data what tests it."""
    by_row: dict[int, list[tuple[Condition, str]]] = defaultdict(list)
    for at, condition in enumerate(held, row):
        link(sheet, Cell(sheet.title, at, TITLE_COLUMN), condition.title, INPUT_SHEET)
        wrong, cell = ODD if condition.pair.warning else NO, Cell(sheet.title, at, UNIT_COLUMN)
        verdict = f'IF({condition.formula},"{YES}","{wrong}")'
        formula = f'=IF(ISERROR({condition.formula}),"{_UNKNOWN}",{verdict})'
        _say(sheet, cell, formula, writer, YES if condition.holds else wrong)
        for item in condition.fields:
            test = f'{cell.absolute}<>"{wrong}"'
            by_row[writer.layout.cells[item.name].row].append((condition, test))
    return by_row


def _without_errors(sheet: Worksheet, row: int, areas: dict[str, str], writer: BlockWriter) -> str:
    """A verdict for each sheet; their range."""
    for at, (title, area_of) in enumerate(areas.items(), row):
        text = f"{title}: без ошибок в формулах"
        if sheet.parent[title].sheet_state == "visible":
            link(sheet, Cell(sheet.title, at, TITLE_COLUMN), text, title)
        else:
            sheet.cell(at, TITLE_COLUMN, text).style = styles.TEXT
        formula = f'=IF(ISERROR(SUM({area_of})),"{NO}","{YES}")'
        _say(sheet, Cell(sheet.title, at, UNIT_COLUMN), formula, writer)
    return column_range(sheet.title, UNIT_COLUMN, row, row + len(areas) - 1)


def colour_verdicts(sheet: Worksheet, first: int, last: int, good: str, bad: str) -> None:
    """Verdicts of rows green and red, what is unusual yellow."""
    cells = area(*(Cell(sheet.title, row, UNIT_COLUMN) for row in (first, last)))
    green = PatternFill(bgColor="C6EFCE")
    sheet.conditional_formatting.add(cells, CellIsRule("equal", [f'"{good}"'], fill=green))
    sheet.conditional_formatting.add(cells, CellIsRule("equal", [f'"{bad}"'], **styles.wrong()))


def fade(sheet: Worksheet, cells: str) -> None:
    """Results grey while they follow a structure that is not theirs, before other formats."""
    for places in sheet.conditional_formatting:
        for rule in places.rules:
            rule.priority += 1
    rule = FormulaRule([f"{STRUCTURE_CHANGED}>0"], stopIfTrue=True, **styles.outdated())
    rule.priority = 1
    sheet.conditional_formatting.add(cells, rule)


def _say(sheet: Worksheet, cell: Cell, formula: str, writer: BlockWriter, said: str = YES) -> None:
    writer.formula(sheet, cell.row, cell.column, formula, said)
    sheet.cell(cell.row, cell.column).style = styles.CHECK


def _areas(caches: CacheValues) -> dict[str, str]:
    """Sheet → the range of all its formula cells: the ends of a filled column are among them."""
    areas: dict[str, str] = {}
    for title, cells in caches.values.items():
        coordinates = [coordinate_to_tuple(address) for address in cells]
        rows, columns = {row for row, _ in coordinates}, {column for _, column in coordinates}
        first, last = (
            Cell(title, end(rows), end(columns)).absolute.partition("!")[2] for end in (min, max)
        )
        areas[title] = f"{quoted(title)}!{first}:{last}"
    return areas


def _limits(sheet: Worksheet, model: Model, writer: BlockWriter, in_order: _Tests) -> str:
    """A folded column that says which rows are wrong, and which odd; its range."""
    layout = writer.layout
    rows: dict[int, list[Field]] = defaultdict(list)
    for item in model.inputs:
        if options(item) or item.minimum is not None or item.structural:
            rows[layout.cells[item.name].row].append(item)
    column = 1 + max(KEY_COLUMN, *(layout.cells[item.name].column for item in model.inputs))
    sheet.cell(HEADER_ROW, column, _BEYOND).style = styles.HEADER
    for row, items in rows.items():
        tests, usual = list(_tests(items, layout)), list[str]()
        state = 0.0
        for condition, test in in_order.get(row, ()):
            (usual if condition.pair.warning else tests).append(test)
            state = state if condition.holds else _ODD_ROW
        other = f"IF(AND({','.join(usual)}),0,{_ODD_ROW})" if usual else "0"
        formula = f"=IF(AND({','.join(tests)}),{other},{_WRONG_ROW})" if tests else f"={other}"
        if changed := [_changed(item, layout) for item in items if item.structural]:
            formula += f"+IF(OR({','.join(changed)}),{RESHAPED_ROW},0)"
        writer.formula(sheet, row, column, formula, state)
        sheet.cell(row, column).style = styles.HELPER
    letter = get_column_letter(column)
    sheet.sheet_properties.outlinePr.summaryRight = False
    sheet.column_dimensions[letter].outlineLevel, sheet.column_dimensions[letter].hidden = 1, True
    # Of a list only the number of the line: which of its cells it is their own limits say.
    marked = [area(Cell("", min(rows), 1), Cell("", max(rows), 1))]
    marked += [layout.cells[i.name].coordinate for values in rows.values() for i in values
               if not i.listed]  # fmt: skip
    for test_of, look in (
        (f">={RESHAPED_ROW}", styles.wrong()),
        (f"={_WRONG_ROW}", styles.wrong()),
        (f"={_ODD_ROW}", styles.odd()),
    ):
        rule = FormulaRule([f"${letter}{min(rows)}{test_of}"], **look)
        sheet.conditional_formatting.add(" ".join(marked), rule)
    return column_range(sheet.title, column, min(rows), max(rows))


def _changed(item: Field, layout: Layout) -> str:
    """That a structural cell holds another value than the book is built with: it stands here."""
    return f"{layout.cells[item.name].coordinate}<>{number(shown(item))}"


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
        cells_tested = area(cells[0], cells[-1]) if len(cells) > 1 else cells[0].coordinate
        yield f"COUNT({cells_tested})={len(cells)}"  # an empty cell would be zero
        yield f"MIN({cells_tested})>={number(least)}"
        yield f"MAX({cells_tested})<={number(most)}"
