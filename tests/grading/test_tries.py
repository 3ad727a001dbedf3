"""Tries before the deadline: what a student is told, what the teacher; a semester played."""

from __future__ import annotations

import random
from dataclasses import replace
from datetime import datetime, timedelta
from pathlib import Path

import pytest

from reports.grading.batch.tries import told_of_try
from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.handout import handout_bytes
from reports.grading.issuing.issue import assignment_for
from reports.grading.issuing.register import Register
from reports.grading.issuing.rubric import Attempts
from reports.grading.judging.marking import Marker
from reports.grading.judging.tries import in_order, probed, words_of_all, words_of_try
from reports.grading.judging.work_digest import Entry, Work, work_of
from reports.grading.pages.gradebook import gradebook_csv, moodle_csv
from reports.grading.pages.summary import choose, table_rows
from reports.grading.reading.submissions import Submission
from reports.workbook.layout import Layout
from tests.grading import classroom
from tests.grading.fill import Formula, filled_book, solved_formulas

RUBRIC = '[work]\nfill = ["geometry", "P3_1"]\n[attempts]\ntries = 5\ncount = "best"\n'
STUDENTS, TRIES = 20, 5
PROBERS = {18: "lam", 19: "P3_1.s1_mm", 20: "one by one"}


@pytest.fixture(scope="module")
def register(tmp_path_factory: pytest.TempPathFactory) -> Register:
    return classroom.registered(tmp_path_factory.mktemp("tries"), STUDENTS, RUBRIC)


def honest(own: dict[str, list[Formula]], chance: random.Random) -> list[dict[str, list[Formula]]]:
    """Some columns to come and some mistakes, of which each try mends one or two."""
    left = chance.sample(sorted(own), min(len(own), 8))
    spoilt = {
        node: [None] * len(own[node])
        if chance.random() < 0.5
        else [f"=-({str(text)[1:]})" for text in own[node]]
        for node in left
    }
    tries = []
    for _ in range(TRIES):
        tries.append(dict(spoilt))
        for _ in range(chance.randint(1, 2)):
            if spoilt:
                spoilt.pop(sorted(spoilt)[-1])  # the single values first
    return tries


def probing(own: dict[str, list[Formula]], what: str) -> list[dict[str, list[Formula]]]:
    """The same column with other numbers, or a column a try."""
    if what == "one by one":
        nodes = [node for node in sorted(own) if node.startswith("P3_1.")]
        typed = {node: [7.5] * len(own[node]) for node in nodes}
        return [typed | {node: [9.5 + i] * len(own[node]) for i, node in enumerate(nodes[:n])}
                for n in range(TRIES)]  # fmt: skip
    return [{what: [f"={0.2 + n / 100}*{str(text)[1:]}" for text in own[what]]}
            for n in range(TRIES)]  # fmt: skip


def played(register: Register) -> list[tuple[Work, str]]:
    """Each try of each student with what the student was told of it."""
    marker, began, shared = Marker(register), datetime(2026, 11, 2, 9), {}
    first: Assignment | None = None
    works = []
    for book in register.books:
        assignment = assignment_for(book, register.rubric, first)
        first = first or assignment
        own = solved_formulas(assignment, Layout.of(assignment.model))
        handout = handout_bytes(assignment, book.ticket)
        what = PROBERS.get(book.number)
        changes = probing(own, what) if what else honest(own, random.Random(book.number))
        for number, change in enumerate(changes):
            file = Path(f"{number}-{book.file}")
            time = began + timedelta(days=7 * number, minutes=book.number)
            data = filled_book(handout, assignment, change)
            result = marker.mark(Submission(file.name, file, None, time), data)
            works.append((work_of(result, shared), words_of_try(result)))
    return works


def test_a_semester_of_tries(register: Register) -> None:
    works = played(register)
    assert len(works) == STUDENTS * TRIES
    rows = table_rows(register, [work for work, _ in works])
    requested = {len([entry for entry in work.items if entry.of]) for work, _ in works}
    assert len(requested) == 1
    rose = 0
    for row in rows:
        lines = [words for work, words in works if work.number == row["number"]]
        rights = [int(words.split()[1]) for words in lines]
        assert all(f" из {max(requested)}" in words for words in lines)
        assert f"попыток 5 из 5, верно столбцов: {', '.join(map(str, rights))} из" in row["similar"]
        assert ("подбор значений" in row["similar"]) == (row["number"] in PROBERS), row["similar"]
        if row["number"] not in PROBERS:
            rose += rights[-1] - rights[0]
            assert row["points"] == max(
                w.points or 0 for w, _ in works if w.number == row["number"]
            )
        # No more than the count and one sheet: no column, no number of the student's or the right.
        assert all("первая ошибка на листе" in words or "не заполнено" in words
                   or rights[i] == max(requested) for i, words in enumerate(lines))  # fmt: skip
        assert not any(entry.label in words for words in lines for entry in works[0][0].items)
    assert rose > STUDENTS  # what is mended is counted
    assert "попыток 5 из 5" in gradebook_csv(rows, 100)
    assert "попыток 5 из 5" in moodle_csv(rows)


def entry(id_: str, spelling: tuple[str, str]) -> Entry:
    return Entry(id_, "П3.1", id_, id_, "wrong", 0, 1, "", "", None, spelling=spelling)


def work(number: int, *items: Entry, sha256: str = "") -> Work:
    about = {"number": 1, "status": "graded", "points": 10.0 * number, "key": str(number),
             "file": str(number), "time": f"2026-11-0{number}", "items": [], "manual": [],
             "sha256": sha256 or str(number)}  # fmt: skip
    return replace(work_of(about, {}), items=items)


@pytest.mark.parametrize(
    ("spellings", "suspect"),
    [
        ([("a", "1"), ("a", "2"), ("a", "3")], True),  # the numbers of one column, again
        ([("a", "1"), ("a", "2"), ("b", "2")], False),  # mended once, then written anew
        ([("a", "1"), ("b", "1"), ("c", "1"), ("d", "1")], False),  # other formulas
        ([("", ""), ("a", "1"), ("a", "2")], False),  # filled in, then mended
    ],
)
def test_who_tries_values_is_told_from_who_mends(spellings, suspect):
    tries = [work(n, entry("v", each)) for n, each in enumerate(spellings, 1)]
    assert bool(probed(tries)) == suspect


def test_files_beyond_the_tries_do_not_count_and_one_file_is_one_try():
    works = [work(1), work(2, sha256="1"), work(3), work(4)]
    assert [each.key for each in in_order(works)] == ["1", "3", "4"]
    assert choose(works, Attempts(tries=2))[1].key == "3"
    assert choose(works, Attempts())[1].key == "4"
    assert words_of_all([], 5) == ""


def test_the_server_s_answer_is_one_sentence(tmp_path):
    folder = classroom.folder()
    path = tmp_path / "book.xlsx"
    path.write_bytes(filled_book(classroom.handout(), classroom.assignment(), {"lam": ["=1/5"]}))
    classroom.register()
    message = told_of_try(str(path), str(folder / "issued"))
    assert message.keys() == {"try"}
    assert message["try"].endswith("первая ошибка на листе Массы")
    path.write_bytes(b"MZ")
    assert told_of_try(str(path), str(folder / "issued")) == {}
