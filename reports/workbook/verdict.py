"""Verdicts of an open book: inputs within limits, no errors, checks passed.

All three stand on the sheet of checks; the first sheet says the gravest.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from openpyxl.formatting.rule import CellIsRule, FormulaRule, Rule
from openpyxl.styles import PatternFill
from openpyxl.utils import (
    absolute_coordinate,
    column_index_from_string,
    coordinate_to_tuple,
    get_column_letter,
)
from openpyxl.workbook import Workbook
from openpyxl.workbook.defined_name import DefinedName
from openpyxl.worksheet.worksheet import Worksheet

from reports.formula.excel import number
from reports.inputs.fields import Field
from reports.model.blocks import NO, YES, Held, Model, Scalar, ScalarTable
from reports.shared.russian import capital
from reports.tables.verdicts import outcomes, reasons_of
from reports.workbook import styles
from reports.workbook.conditions import Condition, conditions
from reports.workbook.inputs import limits_of, options, shown
from reports.workbook.layout import (
    HEADER_ROW,
    INPUT_SHEET,
    KEY_COLUMN,
    SOURCE_COLUMN,
    TITLE_COLUMN,
    UNIT_COLUMN,
    VALUE_COLUMN,
    Cell,
    Layout,
    area,
    column_range,
    quoted,
)
from reports.workbook.places import wrap_within
from reports.workbook.sheets import BlockWriter, CacheValues, link

GOOD, ACCEPTED = "Проверки выполнены", "Принято: "
UNUSUAL, BAD, BEYOND = "Есть необычное: ", "Не выполнено: ", "Исходные данные вне пределов: "
UNKNOWN, RESHAPED = "Не посчитано: ", "Структура изменена: выполните build"
STRUCTURE_CHANGED = "structure_changed"  # name of the cell that counts what was changed
ODD, _UNKNOWN = "необычно", "—"
# What stands beside a verdict that is not good.
_OPEN, _TAKEN = "требует внимания", "принято"
_BEYOND = "Строки: 1 — вне пределов, 2 — необычно, от 10 — структура изменена"
_WITHIN = f"{INPUT_SHEET}: сколько строк вне пределов"
_PAIRS = f"{INPUT_SHEET}: сколько противоречий"
_FAILED, _BROKEN = "сколько не так", "На скольких листах ошибки в формулах, листов всего {}"
_RESHAPED_ROWS = f"{INPUT_SHEET}: в скольких строках изменена структура"
_WRONG_ROW, _ODD_ROW, RESHAPED_ROW = 1, 2, 10  # the last is added to either
_CHECKS = "checks"  # the list of the house; a department's book may have checks too
_REASON_COLUMN, _REASON_WIDTH = SOURCE_COLUMN + 1, 50
# Columns of a count: words on the first of what it counts and on the first accepted one, where
# both stand in their list, the words of the whole sheet.
_WORDS, _ACCEPTED, _AT, _ACCEPTED_AT, _HELP = "E", "F", "G", "H", ("G", "H", "I", "J")
_FURTHER = 4  # rows of counts besides those of lists
_DIGITS = 3  # decimals of a value in the words


@dataclass(frozen=True, slots=True)
class BookVerdict:
    """What the first sheet says of the numbers: its formula and the text that it has now."""

    formula: str
    text: str


@dataclass(frozen=True, slots=True)
class _Count:
    """A count that must be zero: its row, its verdict and words as they are now."""

    row: int
    verdict: str
    words: str
    accepted: str | None = None  # words; None where the input accepts nothing of the list


@dataclass(frozen=True, slots=True)
class _Judged:
    """A list with verdicts as cells: those of a column, and the lines that are not good."""

    block: ScalarTable
    first: int
    last: int
    shift: int  # columns that it stands further right than a list of its own sheet
    sheet: str

    def cells(self, column: int) -> str:
        """Cells of a column of the list, as a formula of the sheet of checks names them."""
        cells = column_range(self.block.sheet, self.shift + column, self.first, self.last)
        return cells.rpartition("!")[2] if self.block.sheet == self.sheet else cells


_Tests = Mapping[int, Sequence[tuple[Condition, str]]]


def judged_lists(writer: BlockWriter) -> list[ScalarTable]:
    """Return lists whose verdicts stand in the book; none of a book to fill in."""
    model, scalars = writer.layout.model, writer.values.scalars
    lists = [block for block in model.blocks if isinstance(block, ScalarTable) and block.held]
    judged = [each.block for each in outcomes(model, scalars)]
    whole = all(judged.count(block.id) == len(block.pairs) for block in lists)
    return lists if whole and _CHECKS in judged else []


def write_verdict(book: Workbook, model: Model, writer: BlockWriter) -> BookVerdict | None:
    """Write counts and verdicts below the checks; return what the first sheet says of them.

    What the counts sum up of conditions and of sheets is folded below them.  A book without
    checks has no verdict.
    """
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
    sheet = book[first.sheet]
    for scalar, _ in (pair for block in lists for pair in block.pairs):
        at = layout.cells[scalar.key]
        cell = book[at.sheet][at.coordinate]
        cell.number_format = styles.few_digits(float(writer.values.scalars[scalar.key]))
    held = list(conditions(model, layout, writer.values.scalars))
    titles = {title: areas[title] for title in book.sheetnames if title in areas}
    top = sheet.max_row + 2
    below = top + 1 + len(lists)
    details = below + _FURTHER
    sheets_row = details + len(held)
    sheet.cell(top, TITLE_COLUMN, "Исходные данные и листы").style = styles.SUBTITLE
    counts = [_of_list(book, sheet, row, block, writer) for row, block in enumerate(lists, top + 1)]
    tests = _in_order(sheet, details, held, writer)
    counts.append(_of_pairs(sheet, below, details, held, writer))
    states, names = _limits(book[INPUT_SHEET], model, writer, tests)
    reshaped = f'=COUNTIF({states},">={RESHAPED_ROW}")'
    changed = _counted(
        sheet, below + 3, _RESHAPED_ROWS, INPUT_SHEET, reshaped, writer, bad=RESHAPED
    )
    book.defined_names[STRUCTURE_CHANGED] = DefinedName(STRUCTURE_CHANGED, attr_text=changed)
    wrong = "+".join(f"COUNTIF({states},{_WRONG_ROW + more})" for more in (0, RESHAPED_ROW))
    _counted(sheet, below + 1, _WITHIN, INPUT_SHEET, f"={wrong}", writer)
    out = _match(_WRONG_ROW, states, _match(_WRONG_ROW + RESHAPED_ROW, states))
    _first(sheet, below + 1, (_AT, _WORDS), out, names, writer)
    verdicts = _without_errors(sheet, sheets_row, titles, writer)
    broken = _BROKEN.format(len(titles))
    _counted(sheet, below + 2, broken, sheet.title, f'=COUNTIF({verdicts},"{NO}")', writer)
    of_sheets = column_range(sheet.title, TITLE_COLUMN, sheets_row, sheets_row + len(titles) - 1)
    _first(sheet, below + 2, (_AT, _WORDS), _match(NO, verdicts), of_sheets, writer)
    colour_verdicts(sheet, top + 1, sheets_row + len(titles) - 1, YES, NO)
    _fold_rows(sheet, details, sheets_row + len(titles) - 1)
    return _sentence(sheet, top, below, counts, writer)


def _sentence(
    sheet: Worksheet, top: int, below: int, counts: Sequence[_Count], writer: BlockWriter
) -> BookVerdict:
    """Return the gravest of the counts in words, in folded cells beside the heading."""
    judged, words = (f"{letter}{top + 1}:{letter}{below}"
                     for letter in (get_column_letter(UNIT_COLUMN), _WORDS))  # fmt: skip
    text, formula = GOOD, f'"{GOOD}"'
    for each in reversed([each for each in counts if each.accepted is not None]):
        cell = f"{_ACCEPTED}{each.row}"
        formula = f'IF({cell}<>"{_UNKNOWN}","{GOOD}. {ACCEPTED}"&{cell},{formula})'
        text = text if each.accepted == _UNKNOWN else f"{GOOD}. {ACCEPTED}{each.accepted}"
    formula = f"={formula}"
    for letter in _HELP:
        sheet[f"{letter}{top}"].style = styles.HELPER
        sheet.column_dimensions[letter].outlineLevel = 1
        sheet.column_dimensions[letter].hidden = True
    for letter, bad, start in zip(_HELP, (ODD, NO, ""), (UNUSUAL, BAD, ""), strict=False):
        writer.formula(sheet, top, column_index_from_string(letter), formula, text)
        first = next((each.words for each in counts if each.verdict == bad), None)
        text = text if first is None else start + first
        named = f'"{start}"&INDEX({words},MATCH("{bad}",{judged},0))'
        formula = f'=IF(COUNTIF({judged},"{bad}")=0,{letter}{top},{named})'
    broken, beyond = (f"{_WORDS}{row}" for row in (below + 2, below + 1))
    fine = f'IF({beyond}<>"{_UNKNOWN}","{BEYOND}"&{beyond},{_HELP[-2]}{top})'
    whole = Cell(sheet.title, top, column_index_from_string(_HELP[-1]))
    formula = f'=IF({broken}<>"{_UNKNOWN}","{UNKNOWN}"&{broken},{fine})'
    writer.formula(sheet, top, whole.column, formula, text)
    return BookVerdict(f'=IF({STRUCTURE_CHANGED}>0,"{RESHAPED}",{whole.absolute})', text)


def colour_verdict(sheet: Worksheet, cells: str) -> None:
    """Colour cells by the verdict in the first: red, yellow if unusual or accepted, green."""
    mark = absolute_coordinate(cells.partition(":")[0])
    good = {"fill": PatternFill(bgColor="E2EFDA")}
    for test, look in (
        (f'{mark}="{GOOD}"', good),
        (f'LEFT({mark},{len(GOOD)})="{GOOD}"', styles.odd()),
        (f'LEFT({mark},{len(UNUSUAL)})="{UNUSUAL}"', styles.odd()),
        (f'{mark}<>""', styles.wrong()),
    ):
        sheet.conditional_formatting.add(cells, FormulaRule([test], stopIfTrue=True, **look))


def _fold_rows(sheet: Worksheet, first: int, last: int) -> None:
    """Fold rows whose counts stand above them."""
    sheet.sheet_properties.outlinePr.summaryBelow = False
    for row in range(first, last + 1):
        sheet.row_dimensions[row].outlineLevel = 1
        sheet.row_dimensions[row].hidden = True


def _of_list(
    book: Workbook, sheet: Worksheet, row: int, block: ScalarTable, writer: BlockWriter
) -> _Count:
    """Count what is not as it should be in a list and name the first; accepted ones apart."""
    layout, values = writer.layout, writer.values.scalars
    rows = [layout.cells[verdict.key].row for _, verdict in block.pairs]
    shift = layout.places[block.id].column - 1
    judged = _Judged(block, rows[0], rows[-1], shift, sheet.title)
    good, worse = block.verdicts or (YES, NO)
    failing = [pair for pair in block.pairs if values[pair[1].key] != good]
    reasons = _accepted_of(block, layout)
    left = [pair for pair in failing if pair[1].key not in reasons]
    verdicts = judged.cells(UNIT_COLUMN)
    marks = (_OPEN, judged.cells(SOURCE_COLUMN)) if reasons else (worse, verdicts)
    count = f'COUNTIF({marks[1]},"{_OPEN}")' if reasons else f'COUNTIF({verdicts},"<>{good}")'
    bad = ODD if block.held is Held.USUAL else NO
    title = f"{block.title}: {_FAILED}"
    _counted(sheet, row, title, block.sheet, f"={count}", writer, len(left), bad=bad)
    words = _named(sheet, row, (_AT, _WORDS), marks, judged, left, writer)
    verdict = bad if left else YES
    if not reasons:
        return _Count(row, verdict, words)
    _mark_accepted(book[block.sheet], block, reasons, writer)
    taken = [pair for pair in failing if pair[1].key in reasons]
    marks = (_TAKEN, judged.cells(SOURCE_COLUMN))
    said = _named(
        sheet, row, (_ACCEPTED_AT, _ACCEPTED), marks, judged, taken, writer,
        reason=reasons[taken[0][1].key] if taken else "",
    )  # fmt: skip
    wrap_within(sheet, (row, _REASON_COLUMN), said, _REASON_WIDTH)
    return _Count(row, verdict, words, said)


def _accepted_of(block: ScalarTable, layout: Layout) -> dict[str, str]:
    """Reasons that the input gives for verdicts of a list, by key; beside a table is no room."""
    if layout.places[block.id].column > 1:
        return {}
    reasons = reasons_of(layout.model.input)
    names = {verdict.key: verdict.key.partition("_")[2] for _, verdict in block.pairs}
    return {key: reasons[name] for key, name in names.items() if name in reasons}


def _mark_accepted(
    sheet: Worksheet, block: ScalarTable, reasons: Mapping[str, str], writer: BlockWriter
) -> None:
    """Say beside every verdict that is not good whether it is accepted, and why."""
    good, _ = block.verdicts or (YES, NO)
    letter = get_column_letter(SOURCE_COLUMN)
    for _, verdict in block.pairs:
        at = writer.layout.cells[verdict.key]
        mark = _TAKEN if verdict.key in reasons else _OPEN
        said = _UNKNOWN if writer.values.scalars[verdict.key] == good else mark
        formula = f'=IF({at.coordinate}="{good}","{_UNKNOWN}","{mark}")'
        writer.formula(sheet, at.row, SOURCE_COLUMN, formula, said)
        sheet.cell(at.row, SOURCE_COLUMN).style = styles.TEXT
        if reason := reasons.get(verdict.key):
            styles.as_text(sheet.cell(at.row, _REASON_COLUMN, reason)).style = styles.NOTE
            wrap_within(sheet, (at.row, _REASON_COLUMN), reason, _REASON_WIDTH)
    rows = [writer.layout.cells[verdict.key].row for _, verdict in block.pairs]
    cells = area(Cell("", rows[0], UNIT_COLUMN), Cell("", rows[-1], SOURCE_COLUMN))
    before(sheet, cells, FormulaRule([f'${letter}{rows[0]}="{_TAKEN}"'], stopIfTrue=True,
                                     **styles.odd()))  # fmt: skip


def _named(
    sheet: Worksheet, row: int, columns: tuple[str, str], marks: tuple[str, str],
    judged: _Judged, pairs: Sequence[tuple[Scalar, Scalar]], writer: BlockWriter, reason: str = "",
) -> str:  # fmt: skip
    """Name the first line of a list that has a mark: title, value and reason; else nothing."""
    at, text = f"{columns[0]}{row}", _UNKNOWN
    values = f'" = "&ROUND(INDEX({judged.cells(VALUE_COLUMN)},{at}),{_DIGITS})'
    if columns[1] == _ACCEPTED:
        values += f'&" — "&INDEX({judged.cells(_REASON_COLUMN)},{at})'
    if pairs:
        scalar, verdict = pairs[0]
        value = round(float(writer.values.scalars[scalar.key]), _DIGITS)
        title = capital(scalar.label or scalar.quantity.title)
        text = f"{title} = {value:.15g}" + (f" — {reason}" if reason else "")
        line = writer.layout.cells[verdict.key].row - judged.first + 1
    _first(
        sheet, row, columns, _match(*marks), judged.cells(TITLE_COLUMN), writer, f"&{values}",
        (line, text) if pairs else (0, _UNKNOWN),
    )  # fmt: skip
    return text


def _first(
    sheet: Worksheet, row: int, columns: tuple[str, str], match: str, titles: str,
    writer: BlockWriter, more: str = "", now: tuple[int, str] = (0, _UNKNOWN),
) -> None:  # fmt: skip
    """Name the line that ``match`` finds, if any; its number stands in a folded cell."""
    letter, words = columns
    formula = f"={match}"
    writer.formula(sheet, row, column_index_from_string(letter), formula, float(now[0]))
    sheet[f"{letter}{row}"].style = styles.HELPER
    text = f'=IF({letter}{row}=0,"{_UNKNOWN}",INDEX({titles},{letter}{row}){more})'
    writer.formula(sheet, row, column_index_from_string(words), text, now[1])
    sheet[f"{words}{row}"].style = styles.LINE


def _match(mark: str | int, cells: str, other: str = "0") -> str:
    """Number of the first cell that holds a mark, else ``other``; IFERROR not all programs have."""
    word = number(mark)
    return f"IF(COUNTIF({cells},{word})=0,{other},MATCH({word},{cells},0))"


def _of_pairs(
    sheet: Worksheet, row: int, first: int, held: Sequence[Condition], writer: BlockWriter
) -> _Count:
    """Count the conditions of the inputs that do not hold; those that are odd only name one."""
    last = first + max(len(held), 1) - 1
    cells = column_range(sheet.title, UNIT_COLUMN, first, last).rpartition("!")[2]
    titles = column_range(sheet.title, TITLE_COLUMN, first, last).rpartition("!")[2]
    wrong = [each for each in held if not each.holds and not each.pair.warning]
    odd = [each for each in held if not each.holds and each.pair.warning]
    verdict, count = NO if wrong else ODD if odd else YES, len(wrong)
    link(sheet, Cell(sheet.title, row, TITLE_COLUMN), _PAIRS, INPUT_SHEET)
    writer.formula(sheet, row, VALUE_COLUMN, f'=COUNTIF({cells},"{NO}")', float(count))
    sheet.cell(row, VALUE_COLUMN).style = styles.FORMULA
    at = Cell("", row, VALUE_COLUMN).coordinate
    said = f'=IF({at}>0,"{NO}",IF(COUNTIF({cells},"{ODD}")>0,"{ODD}","{YES}"))'
    _say(sheet, Cell(sheet.title, row, UNIT_COLUMN), said, writer, verdict)
    worst = (wrong or odd)[:1]
    number_ = held.index(worst[0]) + 1 if worst else 0
    match = _match(NO, cells, _match(ODD, cells))
    words = worst[0].title if worst else _UNKNOWN
    _first(sheet, row, (_AT, _WORDS), match, titles, writer, now=(number_, words))
    return _Count(row, verdict, words)


def _counted(
    sheet: Worksheet, row: int, title: str, target: str, formula: str, writer: BlockWriter,
    count: float = 0.0, *, bad: str = NO,
) -> str:  # fmt: skip
    """Return a count that must be zero, and whether it is; the address of the count."""
    link(sheet, Cell(sheet.title, row, TITLE_COLUMN), title, target)
    at, cell = (Cell(sheet.title, row, column) for column in (VALUE_COLUMN, UNIT_COLUMN))
    writer.formula(sheet, row, at.column, formula, float(count))
    sheet.cell(row, at.column).style = styles.FORMULA
    verdict = f'=IF({at.coordinate}=0,"{YES}","{bad}")'
    _say(sheet, cell, verdict, writer, bad if count else YES)
    return at.absolute


def _in_order(sheet: Worksheet, row: int, held: Sequence[Condition], writer: BlockWriter) -> _Tests:
    """Return a verdict for each pair that must be in order; by rows of input data what tests it."""
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
    """Whether each sheet has no errors in its formulas; the range of the verdicts."""
    for at, (title, area_of) in enumerate(areas.items(), row):
        if sheet.parent[title].sheet_state == "visible":
            link(sheet, Cell(sheet.title, at, TITLE_COLUMN), title, title)
        else:
            sheet.cell(at, TITLE_COLUMN, title).style = styles.TEXT
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
    rule = FormulaRule([f"{STRUCTURE_CHANGED}>0"], stopIfTrue=True, **styles.outdated())
    before(sheet, cells, rule)


def before(sheet: Worksheet, cells: str, rule: Rule) -> None:
    """Add a conditional format before all others of a sheet."""
    for entry in sheet.conditional_formatting:
        for other in entry.rules:
            other.priority += 1
    rule.priority = 1
    sheet.conditional_formatting.add(cells, rule)


def _say(sheet: Worksheet, cell: Cell, formula: str, writer: BlockWriter, said: str = YES) -> None:
    writer.formula(sheet, cell.row, cell.column, formula, said)
    sheet.cell(cell.row, cell.column).style = styles.CHECK


def _areas(caches: CacheValues) -> dict[str, str]:
    """Sheet → the range of all its formula cells: the ends of a filled column are among them."""
    areas: dict[str, str] = {}
    for title in dict.fromkeys((*caches.values, *caches.bare)):
        coordinates = [coordinate_to_tuple(at) for at in caches.values.get(title, ())]
        coordinates += [(c.row, c.column) for c in caches.bare.get(title, ()) if c.formula]
        rows, columns = {row for row, _ in coordinates}, {column for _, column in coordinates}
        first, last = (
            Cell(title, end(rows), end(columns)).absolute.partition("!")[2] for end in (min, max)
        )
        areas[title] = f"{quoted(title)}!{first}:{last}"
    return areas


def _limits(
    sheet: Worksheet, model: Model, writer: BlockWriter, in_order: _Tests
) -> tuple[str, str]:
    """A folded column that says which rows are wrong, and which odd; its range and the titles'."""
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
    states, titles = (
        column_range(sheet.title, each, min(rows), max(rows)) for each in (column, TITLE_COLUMN)
    )
    return states, titles


def _changed(item: Field, layout: Layout) -> str:
    """That a structural cell holds another value than the book is built with: it stands here."""
    return f"{layout.cells[item.name].coordinate}<>{number(shown(item))}"


def _tests(items: Sequence[Field], layout: Layout) -> Iterable[str]:
    """Yield what the cells of a row must hold; neighbours of equal limits together."""
    for item in items:
        if words := options(item):
            cell = layout.cells[item.name].coordinate
            yield f"OR({','.join(f'{cell}={number(word)}' for word in words)})"
    numbers = [item for item in items if not options(item)]
    for limits, run in groupby(numbers, lambda item: limits_of(item, layout)):
        cells = [layout.cells[item.name] for item in run]
        if limits is None:
            continue
        cells_tested = area(cells[0], cells[-1]) if len(cells) > 1 else cells[0].coordinate
        yield f"COUNT({cells_tested})={len(cells)}"  # an empty cell would be zero
        yield f"MIN({cells_tested})>={limits[0]}"
        yield f"MAX({cells_tested})<={limits[1]}"
