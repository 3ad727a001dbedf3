"""Moodle's own forms: the offline grading worksheet filled in, feedback files in a zip.

The rules are those of Moodle's import (``mod/assign/feedback/offline/importgradeslib.php`` and
``file/importziplib.php``): columns are found by their exact titles in the reader's language, that
of the time of the last grade among them; a line by the number at the end of its identifier; a
grade is written as the language of the worksheet writes it, and a scale takes words alone; a
comment is HTML.  A file goes to the participant whose number is the second part of its folder's
name, of four or five divided by ``_``.
"""

from __future__ import annotations

import csv
import html
import io
import re
import zipfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from reports.exports.numbers import neutralised
from reports.grading.pages.states import State
from reports.shared.errors import InputError, Problem
from reports.shared.file_types import read_bytes

MAX_BYTES = 20_000_000
FEEDBACK = "feedback.html"
_HEADS = {
    "id": ("identifier", "идентификатор"),
    "grade": ("grade", "оценка"),
    "modified": ("last modified (grade)", "последнее изменение (оценка)",
                 "последнее изменение оценки"),
    "scale": ("scale", "шкала"),
    "maximum": ("maximum grade", "максимальная оценка", "максимальный балл"),
    "open": ("grade can be changed", "оценка может быть изменена", "оценку можно изменить"),
    "feedback": ("feedback comments", "отзыв в виде комментария", "отзыв в комментариях",
                 "комментарии к отзыву"),
    "email": ("email address", "адрес электронной почты"),
    "name": ("full name", "полное имя", "фамилия и имя", "имя / фамилия", "фио"),
}  # fmt: skip
_NO = ("no", "нет")
_Thing = TypeVar("_Thing")


@dataclass(frozen=True, slots=True)
class FilledWorksheet:
    """A worksheet with grades, and what could not be written."""

    text: str
    graded: int
    left: tuple[str, ...]


def check_upload(path: Path, kind: str) -> None:
    """Look at a file that should be an archive of works, or else a worksheet.

    Raises:
        InputError: it is neither.
    """
    if kind != ".zip":
        read_worksheet(path)
    elif not zipfile.is_zipfile(path):
        raise InputError(Problem("", "это не тот файл", "загрузите архив .zip"))


def read_worksheet(path: Path) -> str:
    """Return the text of a worksheet.

    Raises:
        InputError: it cannot be read, or is none.
    """
    data = read_bytes(path, MAX_BYTES, "это не ведомость Moodle")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeError:
        hint = "возьмите файл таким, каким его отдал Moodle"
        raise InputError(Problem(path.name, "это не ведомость Moodle", hint)) from None
    _parsed(text, path.name)
    return text


def _parsed(text: str, source: str) -> tuple[list[list[str]], dict[str, int], str]:
    """Lines of a worksheet, where its columns are, and what divides them."""
    delimiter = max(",;\t", key=text.partition("\n")[0].count)
    try:
        lines = list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter))
    except csv.Error:  # an endless field
        lines = []
    at = _columns(lines[0] if lines else [])
    if not at.keys() >= {"id", "grade", "modified"}:
        hint = "нужны её столбцы «Идентификатор», «Оценка», «Последнее изменение (оценка)»"
        raise InputError(Problem(source, "это не ведомость оценивания Moodle", hint))
    return lines, at, delimiter


def filled(
    text: str, rows: Sequence[dict[str, Any]], maximum: float, source: str
) -> FilledWorksheet:
    """Moodle's worksheet with the grades and remarks of a gradebook.

    Raises:
        InputError: the columns of Moodle's worksheet are not there.
    """
    lines, at, delimiter = _parsed(text, source)
    russian = lines[0][at["grade"]].strip().casefold() == "оценка"
    graded, left = 0, []
    whole = [line for line in lines[1:] if len(line) > max(at.values())]
    for line, row in _pairs(whole, at, rows):
        who = line[at["name"]] if "name" in at else line[at["id"]]
        if row["points"] is None or row["manual"]:
            left.append(f"{who}: {row['status']}")
            continue
        if "scale" in at:
            left.append(f"{who}: в задании шкала, а не баллы")
            continue
        if "open" in at and line[at["open"]].strip().casefold() in _NO:
            left.append(f"{who}: оценка в Moodle закрыта")
            continue
        most = _number(line[at["maximum"]]) if "maximum" in at else None
        points = round(row["points"] * most / maximum, 2) if most else row["points"]
        grade = f"{points:.2f}"
        line[at["grade"]] = grade.replace(".", ",") if russian else grade
        if "feedback" in at and row["remark"]:  # else a person's comment stays
            line[at["feedback"]] = html.escape(neutralised(row["remark"]), quote=False)
        graded += 1
    stream = io.StringIO()
    csv.writer(stream, delimiter=delimiter, lineterminator="\n").writerows(lines)
    return FilledWorksheet("\ufeff" + stream.getvalue(), graded, tuple(left))


def _columns(head: Sequence[str]) -> dict[str, int]:
    columns: dict[str, int] = {}
    for index, cell in enumerate(head):
        word = " ".join(cell.casefold().split())
        for key, words in _HEADS.items():
            if word in words:
                columns.setdefault(key, index)
    return columns


def _pairs(
    lines: Sequence[list[str]], at: Mapping[str, int], rows: Sequence[dict[str, Any]]
) -> Iterator[tuple[list[str], dict[str, Any]]]:
    """Lines of Moodle's with the rows of their participants: by number, else by mail, by name.

    Nobody's grade goes to two: what several lines or rows share tells none of them, and whose
    number the worksheet knows is not looked for under a namesake's.
    """
    free = [row for row in rows if row["number"] is not None]
    numbers = {_of_line(line, at)["id"] for line in lines}
    numbered = any(row["moodle_id"] in numbers for row in free if row["moodle_id"])
    matched: dict[int, dict[str, Any]] = {}
    for kind in ("id", "mail", "name"):
        if kind != "id" and numbered:
            free = [row for row in free if not row["moodle_id"]]
        by_row = _unique((_of_row(row)[kind], row) for row in free)
        left = [line for line in lines if id(line) not in matched]
        for word, line in _unique((_of_line(line, at)[kind], line) for line in left).items():
            if word in by_row:
                matched[id(line)] = by_row[word]
                free = [row for row in free if row is not by_row[word]]
    return ((line, matched[id(line)]) for line in lines if id(line) in matched)


def _unique(things: Iterable[tuple[str, _Thing]]) -> dict[str, _Thing]:
    """Things by a word that no other has."""
    by_name: dict[str, list[_Thing]] = {}
    for word, thing in things:
        by_name.setdefault(word, []).append(thing)
    return {word: same[0] for word, same in by_name.items() if word and len(same) == 1}


def _of_row(row: Mapping[str, Any]) -> dict[str, str]:
    return {"id": row["moodle_id"], "mail": row["email"].casefold(), "name": _words(row["student"])}


def _of_line(line: Sequence[str], at: Mapping[str, int]) -> dict[str, str]:
    number = re.search(r"(\d+)\s*$", line[at["id"]])
    return {
        "id": number[1] if number else "",
        "mail": line[at["email"]].strip().casefold() if "email" in at else "",
        "name": _words(line[at["name"]]) if "name" in at else "",
    }


def _words(name: str) -> str:
    """Return a name whichever part of it stands first."""
    return " ".join(sorted(name.casefold().replace("ё", "е").split()))


def _number(text: str) -> float | None:
    try:
        value = float(text.replace(",", ".").replace("\u00a0", ""))
    except ValueError:
        return None
    return value if value > 0 else None


def feedback_zip(rows: Sequence[dict[str, Any]], pages: Path) -> bytes:
    """Pages of the students in the folders of Moodle's own zip of submissions."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for row in rows:
            # What is held may be another's: its points and suspicions are no student's to read.
            if not row["moodle_id"] or not row["page"] or row["status"] == State.HELD:
                continue
            name = row["student"].replace("_", " ").replace("/", " ")
            folder = f"{name}_{row['moodle_id']}_assignsubmission_file_"
            data = (pages / row["page"]).read_bytes()
            info = zipfile.ZipInfo(f"{folder}/{FEEDBACK}")  # without a date: the same every time
            archive.writestr(info, data, zipfile.ZIP_DEFLATED)
    return stream.getvalue()
