"""The institute's own form of marks, filled in: cells of the rubric, people by their names."""

from __future__ import annotations

import io
import warnings
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import date
from pathlib import Path
from typing import Any

from openpyxl import load_workbook
from openpyxl.cell.cell import Cell as SheetCell
from openpyxl.utils.cell import column_index_from_string, coordinate_from_string
from openpyxl.worksheet.worksheet import Worksheet

from reports.exports.numbers import neutralised
from reports.grading.issuing.names import skeletons
from reports.grading.issuing.names import words as words_of
from reports.grading.issuing.rubric import Rubric
from reports.shared.errors import InputError, Problem, SharedFormulaError
from reports.shared.file_types import read_bytes
from reports.workbook.cell_patch import Value, with_cells
from reports.workbook.intake import check_data

MAX_BYTES = 20_000_000
_MAX_ROWS = 2000
Row = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class FilledForm:
    """The form with marks, and whose marks are not in it."""

    data: bytes
    written: int
    left: tuple[str, ...]


def filled_form(path: Path, rows: Sequence[Row], rubric: Rubric) -> FilledForm:
    """Write points and marks into a form; a list without people gets them from the gradebook.

    Raises:
        InputError: the form cannot be read, or has no such sheet.
    """
    data = read_bytes(path, MAX_BYTES, "это не ведомость")
    data = check_data(data, path.name).data
    rules = rubric.form
    try:
        with warnings.catch_warnings(action="ignore"):
            book = load_workbook(io.BytesIO(data))
        sheet = book[rules.sheet] if rules.sheet else book.worksheets[0]
    except KeyError:
        problem = f"нет листа «{rules.sheet}»"
        raise InputError(Problem(path.name, problem, "исправьте [form] sheet в рубрике")) from None
    except Exception:  # whatever openpyxl meets in a file of another program
        hint = "сохраните её в Excel как .xlsx"
        raise InputError(Problem(path.name, "ведомость не читается", hint)) from None
    students = [row for row in rows if row["number"] is not None]
    sheet = _FormSheet(sheet)
    found_rows, left = _places(sheet, students, rules.student, rules.first_row)
    written = 0
    for row, at in found_rows:
        final = row["points"] is not None and not row["manual"]
        mark = rubric.scale.mark(row["points"]) if final and rubric.scale.marks else ""
        sheet.put(rules.mark, at, _number(mark) if final else "")
        sheet.put(rules.points, at, row["points"] if final else "")
        sheet.put(rules.number, at, row["number"])
        written += bool(final)
        if not final:
            left.append(f"{row['student']}: {row['status']}")
    for address, problem in rules.cells.items():
        letters, at = coordinate_from_string(address)
        sheet.put(letters, at, _general(problem, students))
    try:
        filled = with_cells(data, sheet.sheet.title, sheet.values)
    except SharedFormulaError as error:
        problem = "в ячейке формула, общая для нескольких ячеек"
        where = f"{path.name}, {error}"
        hint = "выберите в рубрике [form] другой столбец или сотрите формулу"
        raise InputError(Problem(where, problem, hint)) from None
    except (UnicodeDecodeError, KeyError):
        hint = "сохраните её в Excel как .xlsx"
        raise InputError(Problem(path.name, "ведомость не читается", hint)) from None
    return FilledForm(filled, written, tuple(left))


@dataclass
class _FormSheet:
    """The sheet of a form as it is read, and what is to be written into its cells."""

    sheet: Worksheet
    values: dict[tuple[int, int], Value] = field(default_factory=dict)

    def put(self, letters: str, row: int, value: Value) -> None:
        """Write into a cell; a part of a merged one holds nothing."""
        column = column_index_from_string(letters) if letters else 0
        if column and isinstance(self.sheet.cell(row, column), SheetCell):
            self.values[row, column] = value


def _places(
    form: _FormSheet, students: Sequence[Row], letters: str, first: int
) -> tuple[list[tuple[Row, int]], list[str]]:
    """Row of the form for each student, and who is not in it."""
    sheet = form.sheet
    column = column_index_from_string(letters or "B")
    last = min(sheet.max_row, first + _MAX_ROWS)
    named = {at: str(sheet.cell(at, column).value or "").strip() for at in range(first, last + 1)}
    named = {at: name for at, name in named.items() if any(map(str.isalpha, name))}
    if not named:
        for at, row in enumerate(students, first):
            form.put(letters or "B", at, neutralised(row["student"]))
        return [(row, at) for at, row in enumerate(students, first)], []
    fitting = {
        row["number"]: [at for at, name in named.items() if _is_same(row["student"], name)]
        for row in students
    }
    claims = Counter(at for rows in fitting.values() for at in rows)
    lines, left = [], []
    for row in students:
        candidates = fitting[row["number"]]
        if len(candidates) == 1 and claims[candidates[0]] == 1:
            lines.append((row, candidates[0]))
        else:
            why = (
                "подходит не одна строка или не один студент" if candidates else "нет такой строки"
            )
            left.append(f"{row['student']}: {why}")
    return lines, left


def _is_same(student: str, name: str) -> bool:
    """Whether a name of the form is that of a student: in full, or with initials."""
    words = [word.strip(".,") for word in name.replace(".", ". ").split()]
    whole = skeletons(" ".join(word for word in words if len(word) > 1))
    spelt_words = [(word, skeletons(word)) for word in student.split()]
    if not whole or not whole <= set().union(*(spelt for _, spelt in spelt_words)):
        return False
    unmatched = [word for word, spelt in spelt_words if spelt.isdisjoint(whole)]
    for initial in (word for word in words if len(word) == 1):
        fits = [word for word in unmatched if words_of(word[0]) == words_of(initial)]
        if unmatched and not fits:
            return False
        unmatched = [word for word in unmatched if word not in fits[:1]]
    return True


def _number(mark: str) -> int | str:
    return int(mark) if mark.isdigit() else mark


def _general(key: str, students: Sequence[Row]) -> Value:
    """Tell what stands once in a form: the group, the date, how many; else the text itself."""
    groups = ", ".join(sorted({row["group"] for row in students if row["group"]}))
    values: dict[str, Value] = {
        "группа": groups,
        "дата": f"{date.today():%d.%m.%Y}",
        "студентов": len(students),
    }
    return values.get(key.strip().casefold(), key)
