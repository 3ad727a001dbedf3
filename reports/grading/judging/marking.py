"""From a submitted workbook to its result: points, feedback, notes and signals, as plain data."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.issue import assignment_for
from reports.grading.issuing.register import Issued, Register
from reports.grading.judging.causes import Causes
from reports.grading.judging.foreign import OtherVariant
from reports.grading.judging.judgement import (
    GROUNDLESS,
    STILL,
    UNKNOWN,
    Judgement,
    fault,
    part_remark,
    unread_remark,
)
from reports.grading.judging.proven import Proofs
from reports.grading.judging.response import FormulaResponse
from reports.grading.judging.scoring import HandedIn, score
from reports.grading.judging.spelling import chooses_a_number
from reports.grading.judging.traits import OwnFormulas, Textbook, pasted, texts_of, traits_of
from reports.grading.judging.trial_evaluation import trials_of
from reports.grading.judging.tries import spellings
from reports.grading.judging.verdicts import NUMBERS_ALONE, judge_all
from reports.grading.judging.work_digest import (
    feedback_line,
    formula_marks,
    is_verbatim,
    own_marks,
    part_line,
)
from reports.grading.reading.placement import address
from reports.grading.reading.restoring import issued_formulas, leave_out_unused, restore
from reports.grading.reading.student import StudentBook
from reports.grading.reading.submissions import (
    Match,
    Submission,
    file_properties,
    find_by_name,
    find_owner,
)
from reports.inputs.fields import cell_name
from reports.inputs.ranges import ParameterRange
from reports.model.blocks import TURN
from reports.model.evaluation import Evaluation
from reports.recalculation.evaluate import Evaluator
from reports.recalculation.grid import CellGrid
from reports.recalculation.read import read_grid
from reports.recalculation.sheets import Forms
from reports.shared.errors import BadBook, InputError, UnknownFormula
from reports.shared.russian import short
from reports.workbook.intake import Package, check_data
from reports.workbook.layout import Layout

FORMAT = 8
_DISGUISED = 3  # numbers in the guise of formulas from which a person looks
Result = dict[str, Any]
T = TypeVar("T")


def blank_result(submission: Submission) -> Result:
    """Return the result of a file before anything is known about it."""
    return {
        "format": FORMAT,
        "key": submission.key,
        "file": submission.label,
        "time": submission.time.isoformat() if submission.time else None,
        "clock": submission.clock,
        "moodle_id": submission.moodle_id,
        "sha256": "",
        "items": [],
        "manual": [],
        "doubts": [],
        "submitter": None,
        "notes": [],
        "moved": [],
        "changed": [],
        "altered": [],
        "evidence": [],
        "identity": [],
    }


@dataclass
class _Tables:
    """Shared data of students with the same tables; ``assignment`` is one of theirs."""

    assignment: Assignment
    layout: Layout
    register: Register
    variants: dict[int, Evaluation] = field(default_factory=dict)  # others, as far as calculated

    @cached_property
    def proofs(self) -> Proofs:
        """The engines on which formulas are tried, and what is proven."""
        return Proofs(trials_of(self.assignment, self.register.books, self.register.trial_seed))

    @cached_property
    def textbook(self) -> Textbook:
        """The program's formulas as trees."""
        return Textbook(self.assignment, self.layout)

    @cached_property
    def own(self) -> dict[str, str]:
        """Item → the mark of the program's own formula."""
        return own_marks(self.assignment, self.layout)


@dataclass
class Marker:
    """Grades submissions against a register; keeps what all students share."""

    register: Register

    def __post_init__(self) -> None:
        self._assignments: dict[int, tuple[Assignment, Layout]] = {}
        self._forms = Forms()

    def mark(self, submission: Submission, data: bytes) -> Result:
        """Return the result of one file; whatever is wrong with it is part of the result."""
        result = blank_result(submission)
        result["sha256"] = hashlib.sha256(data).hexdigest()
        try:
            package = check_data(data, submission.label)
            grid = read_grid(package, self._forms)
            match = find_owner(self.register, submission, grid, package)
        except InputError as error:
            problem = error.problems[0]
            hint = f"; {problem.hint}" if problem.hint else ""
            return self.refused(result, submission, problem.what + hint)
        except BadBook as error:
            return self.refused(result, submission, str(error))
        _take_match(result, match)
        result["identity"] = list(match.doubts)
        if match.book is None:
            result["status"] = "unmatched"
            result["manual"].append("не удалось установить, чья это работа")
            return result
        result["properties"] = file_properties(package)
        self._grade(result, grid, match.book, package)
        handed = HandedIn(submission.time, submission.clock, match.book.student.extension)
        score(result, self.register.rubric, handed)
        return result

    def assignment(self, book: Issued) -> tuple[Assignment, Layout]:
        """Return the tables of a student's work-book and where they were issued."""
        cached = self._assignments.get(book.number)
        if cached is None:
            first = self._first
            assignment = assignment_for(book, self.register.rubric, first.assignment)
            alike = assignment.fill is first.assignment.fill
            layout = first.layout if alike else Layout.of(assignment.model)
            if len(self._assignments) > 8:  # a class must not fill the memory
                self._assignments.clear()
            cached = self._assignments[book.number] = (
                assignment,
                replace(layout, model=assignment.model),
            )
        return cached

    @cached_property
    def _first(self) -> _Tables:
        """Those of the first work-book, whichever is graded first: the others are mostly alike."""
        assignment = assignment_for(self.register.books[0], self.register.rubric)
        layout = Layout.of(assignment.model)
        issued_formulas(assignment, layout)  # read once for the class
        return _Tables(assignment, layout, self.register)

    def _tables(self, assignment: Assignment) -> _Tables:
        """Shared data of a student's tables."""
        if assignment.fill is self._first.assignment.fill:
            return self._first
        return _Tables(assignment, Layout.of(assignment.model), self.register)

    def refused(self, result: Result, submission: Submission, why: str) -> Result:
        """Return the result of a file that cannot be graded."""
        _take_match(result, find_by_name(self.register, submission))
        result |= {"status": "refused", "reason": why}
        result["manual"].append(f"файл не принят: {why}")
        return result

    def response(self, student: StudentBook) -> FormulaResponse:
        """Response of a student's formulas to other input data."""
        return FormulaResponse(student, self._tables(student.assignment).proofs)

    def student(self, book: Issued, grid: CellGrid, package: Package | None = None) -> StudentBook:
        """Return the workbook under its assignment."""
        student = StudentBook.of(*self.assignment(book), grid)
        student.package = package
        restore(student)
        leave_out_unused(student)
        return student

    def _grade(self, result: Result, grid: CellGrid, book: Issued, package: Package) -> None:
        assignment = self.assignment(book)[0]
        student = self.student(book, grid, package)
        response = self.response(student)
        student.settle(response.settled)
        judged = judge_all(student, response)
        for text in judged.faults:
            _doubt(result, text)
        tampered = _attempted(result, lambda: response.tampered, list[str]())
        if tampered:
            # A row within a table makes the ranges of given look-ups longer, whoever meant no harm.
            moved = "выданные формулы изменены или сбиты вставкой строк: "
            text = moved if student.placement.moved else "изменены выданные формулы: "
            _doubt(result, text + ", ".join(tampered[:4]))
        others, titles = self.others(book.number), self.titles(assignment)
        tables = self._tables(assignment)
        causes = Causes(student, others, titles, tables.variants, response, judged.judgements)
        items = [feedback(student, each, causes, assignment) for each in judged.judgements]
        result |= {
            "status": "graded",
            "feedback": self.register.rubric.feedback.mode,
            "items": items,
            "moved": student.placement.moved[:50],
            "changed": [
                {"where": c.where, "name": c.name, "was": c.was, "now": c.now}
                for c in student.changed[:50]
            ],
            "altered": _attempted(result, lambda: _altered(student, package), list[str]()),
        }
        notes = result["notes"]
        theirs = self._variant_of(student, book)
        if theirs:
            _doubt(result, f"исходные данные заменены данными другого варианта: {theirs}")
        result |= {"formulas": {}, "traits": []}
        _attempted(result, lambda: self._compare(result, student, tables), None)
        if student.changed:
            notes.append(f"изменены исходные или защищённые данные: ячеек {len(student.changed)}")
        if result["altered"]:
            notes.append("сохранённые значения не соответствуют формулам: " + result["altered"][0])
        result["manual"] += [*asked_of_blanks(items), *disguised(student, judged.judgements)]
        unknown = [line["label"] for line in items if line["verdict"] == UNKNOWN]
        if unknown:
            result["manual"].append(unread_remark(unknown))
        parts = self.register.rubric.parts
        items += [part_line(name, points) for name, points in parts.items()]
        if parts:
            result["manual"].append(part_remark([*parts]))

    @staticmethod
    def _compare(result: Result, student: StudentBook, tables: _Tables) -> None:
        """Compare marks and traits of a work with others and with the program."""
        result["formulas"] = formula_marks(student, tables.own)
        if tables.register.rubric.attempts.tries:
            result["spellings"] = spellings(student)
        formulas = OwnFormulas(student, tables.textbook)
        result["traits"] = traits_of(formulas, result["items"])
        result["texts"] = texts_of(student, result["traits"])
        for text in _of_the_program(formulas, result["formulas"]):
            _doubt(result, text)

    def _variant_of(self, student: StudentBook, book: Issued) -> str:
        """Owners of the variant typed over the issued input data."""
        typed = {change.name: change.now for change in student.changed}
        names = {key: cell_name(ParameterRange.path_of(key)) for key in book.drawn}
        mine = {key for key, name in names.items() if name in typed}
        if not mine:
            return ""
        drawn = {**book.drawn, **{key: typed[names[key]] for key in mine}}
        owners = [
            f"{other.number} ({other.student.full})"
            for other in self.register.books
            if other.number != book.number
            and all(_equal(drawn[key], value) for key, value in other.drawn.items())
        ]
        return ", ".join(owners[:4])

    def others(self, number: int) -> list[OtherVariant]:
        """Values in which other students' variants differ."""
        mine = next(book for book in self.register.books if book.number == number)
        others = []
        for other in self.register.books:
            if other.number == number:
                continue
            values = {
                cell_name(ParameterRange.path_of(key)): float(value)
                for key, value in other.drawn.items()
                if isinstance(value, (int, float)) and value != mine.drawn.get(key)
            }
            others.append(OtherVariant(other.number, values))
        return others

    @staticmethod
    def titles(assignment: Assignment) -> dict[str, str]:
        """Name of an input → its title."""
        return {name: field.title for name, field in assignment.model.fields.items()}


def _doubt(result: Result, text: str) -> None:
    """Leave a work to a person."""
    result["doubts"].append(text)
    result["manual"].append(text)


def _attempted(result: Result, step: Callable[[], T], otherwise: T) -> T:
    """Return outcome of a step on a whole work; an error of the program's leaves it to a person."""
    try:
        return step()
    except Exception as error:
        _doubt(result, fault(error))
        return otherwise


def feedback(
    student: StudentBook, judgement: Judgement, causes: Causes, assignment: Assignment
) -> Result:
    """One item of the feedback, left to a person where the program itself fails on it."""
    try:
        return feedback_line(student, judgement, causes, assignment)
    except Exception as error:
        unknown = replace(judgement, verdict=UNKNOWN, paid=0.0, reason=fault(error))
        return feedback_line(student, unknown, causes, assignment)


def _of_the_program(reader: OwnFormulas, formulas: Mapping[str, Sequence[Any]]) -> list[str]:
    """How the work comes of a book that the program has solved: a person decides."""
    doubts = []
    if sheet := pasted(reader):
        doubts.append(
            f"зелёные ячейки только ссылаются на лист «{sheet}» с формулами решённой книги"
        )
    same = sum(bool(mark[2]) for mark in formulas.values())
    issued = any(name.startswith("col_") for name in reader.student.grid.names)
    if not issued and is_verbatim(same, len(formulas)):
        doubts.append(
            f"это книга, решённая программой: слово в слово {same} из {len(formulas)} формул"
        )
    return doubts


def _equal(text: object, value: object) -> bool:
    """Whether a cell, as it is shown, holds a value."""
    try:
        return math.isclose(float(str(text)), float(str(value)), rel_tol=1e-9, abs_tol=1e-9)
    except ValueError:
        return text == str(value)


def _take_match(result: Result, match: Match) -> None:
    book = match.book
    result["number"] = book.number if book else None
    result["student"] = book.student.full if book else None
    result["group"] = book.student.group if book else None
    result["folder"] = book.folder if book else None
    result["evidence"] = list(match.evidence)
    result["manual"] += list(match.doubts)
    result["doubts"] += list(match.doubts)
    result["submitter"] = match.submitter


def _altered(student: StudentBook, package: Package) -> list[str]:
    """Return the first of these cells, in the book as it was saved."""
    return altered(student, read_grid(package) if student.changed else None)[:50]


def altered(student: StudentBook, original: CellGrid | None) -> list[str]:
    """Cells whose saved value is not what their formula gives."""
    grid = original or student.grid
    engine = student.engine if original is None else Evaluator(original)
    cells = []
    locations = [student.placement.places.get(node) for node in student.answers]
    columns = {
        (location.sheet, location.column): location
        for location in locations
        if location is not None
    }
    turning = {
        (location.sheet, location.column)
        for node in student.answers
        if (location := student.placement.places.get(node)) is not None
        and student.assignment.model.nodes[node].quantity.unit == "deg"
    }
    for location in columns.values():
        column = grid.column(location.sheet, location.column)
        for run in engine.grid.column(location.sheet, location.column).runs:
            claims = column.saved_of(run)
            if not np.nan_to_num(claims).any():  # XlsxWriter saves noughts: it calculates nothing
                continue
            try:
                values = engine.all_of(run)
            except UnknownFormula:
                continue
            away = np.abs(claims - values)
            if (location.sheet, location.column) in turning:  # −180° and 180° are one direction
                away = np.abs(away - float(TURN) * np.round(away / float(TURN)))
            if not (away > 1e-6).any():
                continue
            finite = np.abs(values[np.isfinite(values)])
            scale = max(1.0, float(finite.max())) if finite.size else 1.0
            off = away > 1e-6 * scale
            for index in np.flatnonzero(off)[:3]:
                where = address(run.first + int(index), location.column)
                now, was = short(values[index]), short(claims[index])
                if now != was:  # a program that saves few digits has changed nothing
                    cells.append(f"{location.sheet}!{where}: сохранено {was}, формула даёт {now}")
    return cells


def disguised(student: StudentBook, judgements: Sequence[Judgement]) -> list[str]:
    """Question to a person where numbers in the guise of formulas are no chance any more."""
    guises = [j for j in judgements if _is_guise(student, j)]
    if len(guises) < _DISGUISED:
        return []
    kind = "столбцов" if all(j.item.is_column for j in guises) else "величин"
    return [f"число под видом формулы, {kind}: {len(guises)}"]


def _is_guise(student: StudentBook, judgement: Judgement) -> bool:
    if judgement.verdict == STILL:
        return not judgement.origins
    runs = (run for node in judgement.item.nodes for run in student.runs(node))
    return judgement.reason == NUMBERS_ALONE and any(
        run.formula is not None and chooses_a_number(run.formula) for run in runs
    )


def asked_of_blanks(lines: Sequence[Mapping[str, Any]]) -> list[str]:
    """Question to a person where blanks cost more points than they are worth."""
    taken = [line for line in lines if line["verdict"] == GROUNDLESS]
    roots = {origin for line in taken for origin in line["origins"]}
    lines_of = [line for line in lines if line["id"] in roots]
    lost = sum(line["of"] for line in taken)
    if lost <= sum(line["of"] for line in lines_of) + 1e-6:
        return []
    names = ", ".join(line["label"] for line in lines_of[:4])
    return [
        f"верные формулы остались без баллов, потому что опираются на пустое или круговое "
        f"({names}): величин {len(taken)}, баллов {short(lost, 4)}; засчитать их?"
    ]
