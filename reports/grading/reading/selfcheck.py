"""Self-check of a work-book before it is handed in; tells nothing about right or wrong.

It needs no register and no secret: which cells are to be filled in is seen from the book,
what must not be changed follows from its input data and from marks put there at issue.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from reports.exports.build import load_input
from reports.grading.issuing.assignment import Assignment, assignment_of
from reports.grading.issuing.handout import INPUT_MARKS, TICKET_NAME, fill_cells, input_mark
from reports.grading.issuing.rubric import Rubric, WorkTables
from reports.grading.reading.circularity import through
from reports.grading.reading.placement import address, range_text, stretches
from reports.grading.reading.restoring import restore
from reports.grading.reading.student import LOST, StudentBook
from reports.grading.reading.submissions import collect, own_properties
from reports.model.blocks import Model
from reports.recalculation.evaluate import BLANK, ERROR, ERROR_WORDS, NUMBER, TEXT
from reports.recalculation.formulas import UnknownFormula
from reports.recalculation.grid import BadBook
from reports.recalculation.read import read_grid, worksheets
from reports.recalculation.sheets import MAIN, parse_xml
from reports.shared.errors import InputError, Problem
from reports.shared.russian import plural
from reports.tables.registry import build_model
from reports.workbook.inputs import shown
from reports.workbook.intake import Package, check_package
from reports.workbook.layout import Layout

_TOLD = 20  # remarks at once


@dataclass(frozen=True, slots=True)
class BookFinding:
    """Cells and what is odd about them."""

    where: str
    what: str
    blank: int = 0  # cells of it that are empty, where nothing else is odd


def is_work_book(path: Path) -> bool:
    """Whether a file is a work-book that was issued to a student."""
    if path.suffix.lower() not in (".xlsx", ".xlsm"):
        return False
    try:
        package = Package(check_package(path))
        return TICKET_NAME.encode() in package.read("xl/workbook.xml")
    except (InputError, KeyError):
        return False


def findings_in_archive(path: Path) -> list[BookFinding]:
    """Return the same of the work-books of a zip, as they would be handed in.

    Raises:
        InputError: it cannot be read, or there is no work-book in it.
    """
    results: list[BookFinding] = []
    seen = False
    with TemporaryDirectory(prefix="kshm-check-") as folder:
        for at, submission in enumerate(collect(path)):
            book = Path(folder) / str(at) / Path(submission.key).name
            book.parent.mkdir()
            book.write_bytes(submission.read())
            if is_work_book(book):
                seen = True
                name = submission.label
                results += [replace(x, where=f"{name}, {x.where}") for x in findings(book)]
    if not seen:
        hint = "положите в архив книгу .xlsx, которую вам выдали"
        raise InputError(Problem(path.name, "в архиве нет выданной рабочей книги", hint))
    return results


def findings(path: Path) -> list[BookFinding]:
    """Tell what is empty, typed in, an error, not understood, or locked and changed.

    Raises:
        InputError: the file cannot be read as a workbook.
    """
    package = Package(check_package(path))
    try:
        grid = read_grid(package)
    except BadBook as error:
        raise InputError(Problem(path.name, str(error), "откройте и сохраните её заново")) from None
    model = build_model(load_input(path).model)
    assignment = _assignment(model, package)
    student = StudentBook.of(assignment, Layout.of(assignment.model), grid)
    student.package = package
    results = list(_changed_inputs(student, package))
    restore(student)
    results += [
        BookFinding(change.where, f"ячейка заперта, а изменена: теперь {change.now}")
        for change in student.changed
        if change.name not in model.fields
    ]
    results += [
        BookFinding(_of(assignment, node), "выданная формула изменена")
        for node in sorted(student.rewritten)
        if student.as_laid_out
    ]
    broken = {node for node, answer in student.answers.items() if ERROR in answer.kinds}
    followers = {node for node in broken if (through(student, node) - {node}) & broken}
    for item in assignment.items:
        for node in item.nodes:
            results += _of_node(student, node, errors=node not in followers)
    if followers:
        names = ", ".join(_of(assignment, node) for node in sorted(followers)[:6])
        more = "" if len(followers) <= 6 else f" и ещё {len(followers) - 6}"
        results.append(BookFinding("Ошибки, пришедшие из названных выше", names + more))
    return results


def remarks(path: str, issued: str) -> dict[str, list[str]]:
    """Tell what is told of a book that is handed in; it may be handed in whatever is told.

    ``issued`` is the student's own empty book.

    Raises:
        InputError: no program reads it.
    """
    book = Path(path)
    check_package(book)
    if not is_work_book(book):
        return {"remarks": ["в книге нет идентификатора: это не выданная рабочая книга"]}
    try:
        lines = _lines(findings(book))
    except InputError as error:
        lines = error.lines()
    more = [f"и ещё замечаний: {len(lines) - _TOLD}"] if len(lines) > _TOLD else []
    ticket, issued_ticket = _ticket(book), _ticket(Path(issued))
    if ticket and issued_ticket and ticket != issued_ticket:
        lines.insert(0, "эта книга выдана не вам: скачайте свою и сдайте её")
    return {"remarks": lines[:_TOLD] + more}


def _lines(results: Sequence[BookFinding]) -> list[str]:
    """Return a line for each finding; one for a book in which nothing but blanks is to be seen."""
    if len(results) > _TOLD and all(each.blank for each in results):
        count = sum(each.blank for each in results)
        verb = "пуста" if count % 10 == 1 and count % 100 != 11 else "пусты"
        return [f"{verb} {plural(count, 'ячейка', 'ячейки', 'ячеек')}: книга не заполнена"]
    return [f"{each.where}: {each.what}" for each in results]


def refuse_foreign(path: str, issued: str) -> dict[str, object]:
    """Refuse a book that was issued to another student; ``issued`` is the own empty one.

    Raises:
        InputError: it was, or no program reads it.
    """
    ticket, issued_ticket = _ticket(Path(path)), _ticket(Path(issued))
    if ticket and ticket != issued_ticket:
        problem = "эта книга выдана не вам и не принята; сданное раньше осталось"
        raise InputError(Problem("", problem, "скачайте свою книгу и сдайте её"))
    return {}


def _ticket(book: Path) -> str:
    return own_properties(Package(check_package(book))).get(TICKET_NAME, "")


def _assignment(model: Model, package: Package) -> Assignment:
    """Tables with open cells."""
    layout = Layout.of(model)
    open_ = _open_cells(package)
    fill = [
        block.id
        for block in model.blocks
        if any(
            (cell.sheet, cell.coordinate) in open_
            for cells in fill_cells(block, layout).values()
            for cell in cells
        )
    ]
    sheets = {name.casefold() for name in _names(package)}
    matching = [
        table.id
        for table in model.tables.values()
        if table.id not in fill and f"col_{table.id}_1".casefold() in sheets
    ]
    return assignment_of(model, Rubric(work=WorkTables(fill=tuple(fill), given=tuple(matching))))


def _names(package: Package) -> Iterator[str]:
    root = parse_xml(package.read("xl/workbook.xml"))
    yield from (str(name.get("name")) for name in root.iter(f"{MAIN}definedName"))


def _open_cells(package: Package) -> set[tuple[str, str]]:
    """Sheet and address of all cells that are not locked."""
    styles = parse_xml(package.read("xl/styles.xml")).find(f"{MAIN}cellXfs")
    unlocked = {
        str(number)
        for number, style in enumerate(styles if styles is not None else ())
        if any(
            part.tag == f"{MAIN}protection" and part.get("locked") in ("0", "false")
            for part in style
        )
    }
    cells = set()
    for title, part in worksheets(package):
        for cell in parse_xml(package.read(part)).iter(f"{MAIN}c"):
            if cell.get("s") in unlocked:
                cells.add((title, str(cell.get("r"))))
    return cells


def _changed_inputs(student: StudentBook, package: Package) -> Iterator[BookFinding]:
    """Input data that are not those issued, as far as the marks in the file tell."""
    marks = _marks(package)
    model = student.assignment.model
    for name, item in model.fields.items():
        location = student.placement.places.get(name)
        if name in marks and marks[name] != input_mark(shown(item)):
            where = (
                f"{location.sheet}!{address(location.rows[0] or 0, location.column)}"
                if location
                else name
            )
            yield BookFinding(where, f"исходное данное «{item.title}» изменено")


def _marks(package: Package) -> dict[str, str]:
    texts = own_properties(package)
    marks: dict[str, str] = {}
    for text in (texts[name] for name in sorted(texts) if name.startswith(INPUT_MARKS)):
        for entry in text.split(" "):
            name, _, mark = entry.partition("=")
            if mark:
                marks[name] = mark
    return marks


def _of_node(student: StudentBook, node: str, *, errors: bool) -> list[BookFinding]:
    answer = student.answers[node]
    location = answer.location
    problem = _of(student.assignment, node)
    if location is None:
        return [BookFinding(problem, "ячейки не найдены: верните таблице её заголовки")]
    results = []
    if answer.problem:
        results.append(BookFinding(problem, f"формулу программа не пересчитает: {answer.problem}"))
    for kind, words in ((LOST, "строка не найдена: верните угол в первый столбец"),
                        (BLANK, "пусто"), (TEXT, "текст вместо числа")):  # fmt: skip
        rows = [r for i, r in enumerate(location.rows)
                if answer.kinds[i] == kind and i not in answer.odd]  # fmt: skip
        if rows:
            where = _ranges(location.sheet, location.column, rows)
            blank = len(rows) if kind == BLANK else 0
            results.append(BookFinding(problem, f"{words}: {where}", blank))
    for words in dict.fromkeys(answer.odd.values()):
        rows = [location.rows[i] for i, why in answer.odd.items() if why == words]
        results.append(
            BookFinding(problem, f"{words}: {_ranges(location.sheet, location.column, rows)}")
        )
    wrong: dict[str, list[int | None]] = {}
    for row, kind in zip(location.rows, answer.kinds, strict=True):
        if errors and kind == ERROR and row is not None:
            try:
                text = student.engine.shown(location.sheet, location.column, row)
            except UnknownFormula:
                continue
            wrong.setdefault(ERROR_WORDS.get(str(text), str(text)), []).append(row)
    for text, rows in wrong.items():
        where = _ranges(location.sheet, location.column, rows)
        results.append(BookFinding(problem, f"ошибка {text}: {where}"))
    typed = [r for i, r in enumerate(location.rows)
             if answer.typed[i] and answer.kinds[i] == NUMBER and i not in answer.odd]  # fmt: skip
    if typed:
        where = _ranges(location.sheet, location.column, typed)
        results.append(BookFinding(problem, f"число вместо формулы: {where}"))
    return results


def _of(assignment: Assignment, node: str) -> str:
    """Return a node as the book calls it."""
    model = assignment.model
    quantity = model.nodes[node].quantity
    table = model.tables.get(node.partition(".")[0]) if "." in node else None
    if table is not None:
        return f"{table.number} {quantity.symbol}"
    owner = next(b for b in model.blocks if b.id == assignment.graph.owners[node])
    return f"{owner.sheet} {quantity.symbol}"


def _ranges(sheet: str, column: int, rows: list[int | None]) -> str:
    pairs = stretches(sorted(row for row in rows if row is not None))
    texts = [range_text(first, last, column) for first, last in pairs]
    return f"{sheet}!" + ", ".join(texts[:8]) + ("…" if len(texts) > 8 else "")
