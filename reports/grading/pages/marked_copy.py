"""The student's own book with coloured cells and comments; the original stays as it was."""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable
from copy import copy
from typing import Any

from openpyxl import load_workbook
from openpyxl.comments import Comment
from openpyxl.styles import PatternFill
from openpyxl.worksheet.worksheet import Worksheet

from reports.grading.issuing.rubric import Rubric
from reports.grading.judging.judgement import CARRIED, RIGHT, TYPED, UNKNOWN, WORDS
from reports.grading.pages.pages import number, points
from reports.grading.reading.submissions import Submission
from reports.shared.gc_pause import uncollected
from reports.shared.russian import capital

_COLOURS = {RIGHT: "D5EBDD", CARRIED: "FBE9C4", TYPED: "FBE9C4", UNKNOWN: "DDDEF5"}
_WRONG = "F6CBCE"
_AUTHOR = "Проверка"
_MAX_CELLS = 20_000
_SIDE = (320, 170)  # px of a comment


def marked_copy(data: bytes, result: dict[str, Any], rubric: Rubric) -> bytes:
    """Return the book with its cells coloured by verdict and a comment at each column."""
    with warnings.catch_warnings(action="ignore"):  # of what a copy does not need
        book = load_workbook(io.BytesIO(data), rich_text=True)
    left, looks = _MAX_CELLS, dict[tuple[Any, ...], Any]()
    for line in result["items"]:
        colour = _COLOURS.get(line["verdict"], _WRONG)
        for index, area in enumerate(line["where"] or line.get("at", ())):
            title, _, cells = area.rpartition("!")
            if title not in book.sheetnames or not isinstance(book[title], Worksheet):
                continue
            sheet = book[title]
            rows = sheet[cells] if ":" in cells else ((sheet[cells],),)
            for (cell,) in rows:
                left -= 1
                if left >= 0 and type(cell).__name__ == "Cell":  # no part of a merged one
                    _fill(cell, colour, looks)
            if index == 0:
                _remark(rows[0][0], _words(line, rubric))
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def _fill(cell: Any, colour: str, looks: dict[tuple[Any, ...], Any]) -> None:  # noqa: ANN401
    """Colour a cell; ``looks`` are those of coloured cells by what they were before."""
    key = (colour, *cell._style)
    if key in looks:  # openpyxl takes a quarter of its time to look a fill up
        cell._style = copy(looks[key])
    else:
        cell.fill = PatternFill("solid", fgColor=colour)
        looks[key] = cell._style


def _words(line: dict[str, Any], rubric: Rubric) -> str:
    """Tell what is said of an item at its first cell."""
    parts = [f"{line['label']}: {WORDS[line['verdict']]}"]
    if line["of"]:
        parts.append(f"баллы {points(line['points'])} из {points(line['of'])}")
    if line["reason"]:
        parts.append(capital(line["reason"]))
    if line["cause"]:
        parts.append(f"Вероятная причина: {line['cause']}")
    if line.get("message"):
        parts.append(f"Преподаватель: {line['message']}")
    if "decision" in line:
        entry = line["decision"]
        parts.append(f"Решение преподавателя ({entry['author']}): {entry['remark'] or '—'}")
    if rubric.feedback.mode == "full":
        parts += [
            f"{cell['cell'].rpartition('!')[2]}: верно {number(cell['right'], line['digits'])}"
            for cell in line.get("cells", ())[:4]
        ]
    return "\n".join(parts)


def _remark(cell: Any, text: str) -> None:  # noqa: ANN401 - a cell of openpyxl
    if cell.comment is not None:
        text = f"{cell.comment.text}\n\n{text}"
    width, height = _SIDE
    cell.comment = Comment(text, _AUTHOR, width=width, height=height)


def copying(rubric: Rubric) -> Callable[[Submission, dict[str, Any]], bytes]:
    """Maker of copies, for a process of its own: people's books are opened in such ones alone."""

    def copied(submission: Submission, result: dict[str, Any]) -> bytes:
        with uncollected():
            return marked_copy(submission.read(), result, rubric)

    return copied
