"""Results of works: feedback lines, marks for comparison, and the small form of a class.

The whole result of a work lies in its file; a class keeps sums, words and marks.  Items that
came out alike, and most of a class does, are one object for all works.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from fnmatch import fnmatchcase
from itertools import groupby
from operator import itemgetter
from typing import Any

import numpy as np

from reports.grading.issuing.assignment import Assignment, Item
from reports.grading.judging.causes import Causes
from reports.grading.judging.judgement import (
    BROKEN,
    CARRIED,
    PART,
    RIGHT,
    STILL,
    TYPED,
    UNKNOWN,
    WRONG,
    Judgement,
)
from reports.grading.reading.placement import Location, address, range_text, stretches
from reports.grading.reading.restoring import own_formulas
from reports.grading.reading.student import StudentBook
from reports.shared.russian import capital
from reports.workbook.layout import Layout

_TELLING = 6  # tokens of a formula that may tell who wrote it
Trait = tuple[str, str, str, str, str]  # kind, item, digest, digest as spelt, what it goes with
_MARK = 16  # signs of a mark of right values
_NONE = " " * _MARK
Shared = dict[Any, Any]  # entries and traits
VERBATIM, NEARLY_ALL = 10, 0.9  # formulas, and the share of them, that nobody writes by chance
_SAMPLE = 200  # signs of a formula that a person looks at
SHOWN_ROWS = 12  # wrong cells shown in the feedback of an item


def formula_marks(student: StudentBook, formulas: Mapping[str, str]) -> dict[str, list[Any]]:
    """Return marks of formulas by item: digest, idle step, whether it is the textbook's.

    Args:
        student: the work.
        formulas: item → the mark of the formula that the program writes there.
    """
    marks: dict[str, list[Any]] = {}
    for item in student.assignment.items:
        runs = [run for node in item.nodes for run in student.runs(node)]
        if not runs or len(runs) > 2 * len(item.nodes) or any(r.formula is None for r in runs):
            continue
        patterns = [run.formula.pattern for run in runs if run.formula is not None]
        if max(map(len, patterns)) >= _TELLING:
            mark = _mark(patterns)
            marks[item.id] = [mark, any(map(is_odd, patterns)), formulas.get(item.id) == mark]
    return marks


def own_marks(assignment: Assignment, layout: Layout) -> dict[str, str]:
    """Item → the mark of the formulas that the program writes there."""
    formulas = own_formulas(assignment, layout, assignment.fill_nodes)
    return {
        item.id: _mark(
            [tokens for node in item.nodes
             for tokens, _ in groupby(formula.pattern for formula in formulas[node])]
        )
        for item in assignment.items
        if all(node in formulas for node in item.nodes)
    }  # fmt: skip


def _mark(patterns: Sequence[Sequence[tuple[str, str]]]) -> str:
    text = "\n".join("".join(value for _, value in tokens) for tokens in patterns)
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def fingerprint(item: Item, values: np.ndarray[Any, np.dtype[np.float64]]) -> str:
    """Return same for values that print alike, whatever the book: for the signals of similarity."""
    finite = values[np.isfinite(values)]
    if not finite.size or (item.is_column and np.unique(finite).size < 4):
        return ""  # zeros and constants are alike by themselves
    printed = np.round(values, item.quantity.digits.decimals) + 0.0
    return hashlib.sha256(printed.tobytes()).hexdigest()[:16]


def idle_steps(tokens: Sequence[tuple[str, str]]) -> list[str]:
    """Steps of a formula that do nothing, ``+0``, ``*1``, ``A6-A6``, however they are spelt."""
    plain = [token for token in tokens if token[0] != "space"]
    around = [("op", "("), *plain, ("op", ")")]
    steps = []
    for before, sign, (kind, value), after in zip(
        around, around[1:], around[2:], around[3:], strict=False
    ):
        if kind == "number" and sign[0] == "op":
            nothing = sign[1] in ("+", "-") and float(value) == 0 and before[1] not in "(,"
            same = sign[1] in ("*", "/", "^") and float(value) == 1
            if (nothing or same) and after[1] not in ("^", "*", "/", ":"):
                steps.append("0" if nothing else "1")
            elif same and after[1] in ("*", "/"):
                steps.append("1")
    steps += [
        "-"
        for before, sign, after in zip(plain, plain[1:], plain[2:], strict=False)
        if sign[1] == "-" and before == after and before[0] in ("ref", "name")
    ]
    return steps


def is_odd(tokens: Sequence[tuple[str, str]]) -> bool:
    """Whether a formula has a step that does nothing."""
    return bool(idle_steps(tokens))


# --- the small form ------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Entry:
    """An item as it came out; ``mark`` tells wrong values, ``formula`` who wrote it."""

    id: str
    heading: str
    label: str
    title: str
    verdict: str
    points: float
    of: float
    cause: str
    mark: str
    formula: tuple[str, bool, bool] | None  # its mark, a step that does nothing, the program's
    reason: str = ""  # why a person has to look, and the formula that he looks at
    sample: str = ""
    block: str = ""
    spelling: tuple[str, str] = ("", "")  # of its formulas and of their numbers, for tries


@dataclass(frozen=True, slots=True)
class Work:
    """A result without its cells, curves and explanations."""

    key: str
    file: str
    page: str
    fingerprint: str
    sha256: str
    status: str
    number: int | None
    student: str
    submitter: int | None
    moodle_id: str
    time: str
    points: float | None
    late: float
    manual: tuple[str, ...]
    doubts: tuple[str, ...]
    identity: tuple[str, ...]
    notes: tuple[str, ...]
    saved_by: str
    decision: dict[str, Any] | None
    decisions: tuple[dict[str, Any], ...]
    items: tuple[Entry, ...]
    traits: tuple[Trait, ...]
    _rights: str

    @property
    def rights(self) -> Iterator[tuple[Entry, str]]:
        """Items with the marks of their right values, empty where there is nothing to tell."""
        for index, entry in enumerate(self.items):
            yield entry, self._rights[index * _MARK : (index + 1) * _MARK].strip()


def work_of(result: dict[str, Any], shared: Shared) -> Work:
    """Return the small form of a result; ``shared`` holds the items of all works of a class."""
    formulas, spellings = result.get("formulas", {}), result.get("spellings", {})
    entries = (_entry(line, formulas.get(line["id"]), spellings.get(line["id"]))
               for line in result["items"])  # fmt: skip
    return Work(
        key=result["key"],
        file=result["file"],
        page=result.get("page", ""),
        fingerprint=result.get("fingerprint", ""),
        sha256=result.get("sha256", ""),
        status=result["status"],
        number=result.get("number"),
        student=result.get("student") or "",
        submitter=result.get("submitter"),
        moodle_id=result.get("moodle_id") or "",
        time=result.get("time") or "",
        points=result.get("points"),
        late=result.get("late", 1.0),
        manual=tuple(result["manual"]),
        doubts=tuple(result.get("doubts", ())),
        identity=tuple(result.get("identity", ())),
        notes=tuple(result.get("notes", ())),
        saved_by=result.get("properties", {}).get("lastModifiedBy", "").strip(),
        decision=result.get("decision"),
        decisions=tuple(result.get("decisions", ())),
        items=tuple(shared.setdefault(entry, entry) for entry in entries),
        traits=tuple(shared.setdefault(t, t) for t in map(_trait, result.get("traits", ()))),
        _rights="".join((line.get("right_mark") or _NONE) for line in result["items"]),
    )


def _trait(fields: Sequence[str]) -> Trait:
    kind, item, mark, spelt, group = fields
    return kind, item, mark, spelt, group


def _entry(
    line: dict[str, Any], formula: list[Any] | None, spelling: Sequence[str] | None
) -> Entry:
    verdict = line["verdict"]
    return Entry(
        id=line["id"],
        heading=line["heading"],
        label=line["label"],
        title=line["title"],
        verdict=verdict,
        points=line["points"],
        of=line["of"],
        cause=line["cause"],
        mark=line.get("mark", "") if verdict in (WRONG, TYPED, STILL) else "",
        formula=(formula[0], bool(formula[1]), bool(formula[2])) if formula else None,
        reason=line.get("reason", "") if verdict == UNKNOWN else "",
        sample=line.get("sample", "") if verdict == UNKNOWN else "",
        block=line.get("block", ""),
        spelling=(spelling[0], spelling[1]) if spelling else ("", ""),
    )


def is_verbatim(shared: int, count: int) -> bool:
    """Whether so many formulas are the program's to a sign that they are copied."""
    return shared >= max(VERBATIM, NEARLY_ALL * count)


# --- lines of the feedback -----------------------------------------------------------------------


def feedback_line(
    student: StudentBook, judgement: Judgement, causes: Causes, assignment: Assignment
) -> dict[str, Any]:
    """One item of the feedback."""
    item = judgement.item
    worth = assignment.points[item.id]
    share = judgement.paid
    if judgement.verdict == CARRIED:
        share *= assignment.rubric.credit.carried
    heading, short = _headings(item, assignment)
    cause = causes.find(judgement) if judgement.verdict == WRONG else ""
    line: dict[str, Any] = {
        "id": item.id,
        "block": item.block,
        "table": short if item.block in assignment.model.tables else "",
        "heading": heading,
        "label": f"{short} {item.symbol}",
        "title": item.title,
        "symbol": item.symbol,
        "indexed": item.indexed,
        "unit": item.quantity.unit_label,
        "source": item.source,
        "digits": asdict(item.quantity.digits),
        "verdict": judgement.verdict,
        "points": round(worth * share, 6),
        "of": round(worth, 6),
        "reason": judgement.reason,
        "cause": cause,
        "message": _message(judgement, causes, cause, assignment),
        "origins": list(judgement.origins),
        "right_mark": fingerprint(item, judgement.expected),
        "rows": [item.labels[i] for i in judgement.rows],
        "where": _where(student, judgement),
        "typed": [item.labels[i] for i in judgement.typed] if judgement.verdict != RIGHT else [],
    }
    if not line["where"]:
        line["at"] = _at(student, item)
    if judgement.verdict == UNKNOWN:
        runs = (run for node in item.nodes for run in student.runs(node))
        line["sample"] = next((run.text for run in runs), "")[:_SAMPLE]
    if judgement.verdict in (WRONG, CARRIED, TYPED, STILL, BROKEN):
        line["cells"] = _cells(student, judgement)
        line["mark"] = fingerprint(item, judgement.values)
        if item.is_column:
            angle = assignment.model.tables[item.block].columns[0].quantity
            line["chart"] = {
                "over": ", ".join(filter(None, (angle.symbol, angle.unit_label))),
                "x": [float(label) for label in item.labels],
                "own": _plain(judgement.values),
                "right": _plain(judgement.expected),
            }
    return line


def part_line(name: str, points: float) -> dict[str, Any]:
    """Return the line of what a person marks; it waits for his points."""
    return {
        "id": name, "block": PART, "table": "", "heading": capital(name), "label": capital(name),
        "title": "", "symbol": "", "indexed": "", "unit": "", "source": "",
        "digits": {}, "verdict": UNKNOWN, "points": 0.0, "of": points,
        "reason": "ставит преподаватель", "cause": "", "message": "", "origins": [],
        "right_mark": "", "rows": [], "where": [], "at": [], "typed": [],
    }  # fmt: skip


def _message(judgement: Judgement, causes: Causes, cause: str, assignment: Assignment) -> str:
    """Return the instructor's own words for a mistake, the first that fit."""
    item = judgement.item
    for message in assignment.rubric.messages if judgement.verdict == WRONG else ():
        concerns = any(fnmatchcase(name, message.items) for name in (item.id, item.block))
        if not concerns or message.cause.casefold() not in cause.casefold():
            continue
        if not message.formula or causes.gives(judgement, message.formula):
            return message.text
    return ""


def _headings(item: Item, assignment: Assignment) -> tuple[str, str]:
    """Return the table or list of an item as a person calls it, in full and in short."""
    table = assignment.model.tables.get(item.block)
    if table is not None:
        return f"Таблица {table.number}", table.number
    block = next(block for block in assignment.fill if block.id == item.block)
    return f"{block.title} ({block.sheet})", block.sheet


def _cells(student: StudentBook, judgement: Judgement) -> list[dict[str, Any]]:
    item = judgement.item
    locations = _cells_of(student, item)
    cells = []
    for row in judgement.rows[:SHOWN_ROWS]:
        location, index = locations[row]
        at = location.rows[index] if location is not None else None
        cells.append(
            {
                "row": item.labels[row],
                "cell": f"{location.sheet}!{address(at, location.column)}"
                if location and at
                else "",
                "own": _number(judgement.values[row]),
                "right": _number(judgement.expected[row]),
            }
        )
    return cells


def _where(student: StudentBook, judgement: Judgement) -> list[str]:
    """Return the cells that a verdict is about, those below each other as ranges."""
    if not judgement.rows:
        return []
    item = judgement.item
    rows = set(judgement.rows)
    located: list[tuple[tuple[str, int], int]] = []  # sheet and column, row
    for number, (location, index) in enumerate(_cells_of(student, item)):
        row = location.rows[index] if number in rows and location is not None else None
        if location is not None and row is not None:
            located.append(((location.sheet, location.column), row))
    return [
        f"{sheet}!{range_text(first, last, column)}"
        for (sheet, column), cells in groupby(located, key=itemgetter(0))
        for first, last in stretches(row for _, row in cells)
    ]


def _at(student: StudentBook, item: Item) -> list[str]:
    """Return the cells of an item as ranges."""
    locations = filter(None, map(student.placement.places.get, item.nodes))
    return [
        f"{location.sheet}!{range_text(location.span.first, location.span.last, location.column)}"
        for location in locations
        if location.span is not None
    ]


def _cells_of(student: StudentBook, item: Item) -> list[tuple[Location | None, int]]:
    """Return the place of each value of an item and the value's index there."""
    places, length = student.placement.places, student.assignment.length
    located = ((places.get(node), length(node)) for node in item.nodes)
    return [(location, i) for location, count in located for i in range(count)]


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _plain(values: np.ndarray[Any, np.dtype[np.float64]]) -> list[float | None]:
    return [float(f"{v:.6g}") if math.isfinite(v) else None for v in values.tolist()]
