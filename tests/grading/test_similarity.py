"""Signals that works may have a common origin: each, and only where it is one."""

from __future__ import annotations

import json
import tracemalloc

from reports.grading.judging import similarity
from reports.grading.judging.work_digest import Work, work_of
from tests.grading import classroom
from tests.grading.fill import filled_book


def result(number: int, **more) -> dict:
    values = {
        "status": "graded", "number": number, "student": f"Студент {number}", "key": f"{number}",
        "file": f"{number}.xlsx", "sha256": f"{number}", "items": [], "properties": {},
        "manual": [],
    }  # fmt: skip
    return values | more


def line(item: str, mark: str, right: str, of: float = 1.0) -> dict:
    return {"id": item, "mark": mark, "right_mark": right.ljust(16), "of": of, "verdict": "wrong",
            "heading": "", "label": item, "title": "", "points": 0.0, "cause": ""}  # fmt: skip


def works(results: list[dict]) -> list[Work]:
    shared: dict = {}
    return [work_of(result, shared) for result in results]


def signals(results: list[dict]) -> list[str]:
    return similarity.signals(works(results))


def test_different_works_give_no_signal():
    assert signals([result(1), result(2)]) == []


def test_one_file_of_two_people():
    (text,) = signals([result(1, sha256="a"), result(2, sha256="a"), result(3)])
    assert text == "одинаковые файлы: Студент 1 (1.xlsx), Студент 2 (2.xlsx)"


def test_equal_wrong_values_where_the_right_ones_differ():
    first = result(1, items=[line("a", "x", "r1"), line("b", "y", "r1")])
    second = result(2, items=[line("a", "x", "r2"), line("b", "y", "r2")])
    (text,) = signals([first, second])
    assert "Студент 1 (1.xlsx) и Студент 2 (2.xlsx) — 2 (например, a, b)" in text
    # Where the right values are equal, or nothing is paid for them, equal wrong ones say nothing.
    same = result(3, items=[line("a", "x", "r1")])
    assert signals([first, same]) == []
    free = [result(n, items=[line("a", "x", f"r{n}", of=0.0)]) for n in (1, 2)]
    assert signals(free) == []
    # Two files of one person are no signal.
    assert signals([first, second | {"number": 1}]) == []


def test_numbers_of_a_friend_stop_the_points():
    """Wrong for one's own variant, right for another's: from three columns on it is no chance."""
    friend = result(2, items=[line(item, f"r2{item}", f"r2{item}") for item in "abc"])
    copied = result(1, items=[line(item, f"r2{item}", f"r1{item}") for item in "abc"])
    words = "значения верны для чужого варианта: Студент 2 (2.xlsx)"
    assert any(words in text for text in signals([copied, friend]))
    ((key, (text,)),) = similarity.suspicions(works([copied, friend])).items()
    assert key == "1" and words in text
    assert similarity.suspicions(works([copied | {"items": copied["items"][:2]}, friend])) == {}


def test_the_programs_own_formulas_are_told_and_a_students_are_not():
    """By hand, with other algebra and from the textbook, hardly one is the same to a sign."""
    copied = classroom.marks(filled_book(classroom.handout(), classroom.assignment()))
    (text,) = signals([copied])
    assert "формулы слово в слово как в книге, решённой программой — 94 из 94" in text
    assert similarity.suspicions(works([copied])) == {}  # a signal takes no points
    few = copied | {"formulas": dict(list(copied["formulas"].items())[:9])}
    assert signals([few]) == []
    half = {key: [mark, odd, n % 2 == 0]
            for n, (key, (mark, odd, _)) in enumerate(copied["formulas"].items())}  # fmt: skip
    assert signals([copied | {"formulas": half}]) == []


def test_files_that_one_person_saved_last():
    people = [result(n, properties={"lastModifiedBy": "Вася"}) for n in (1, 2)]
    (text,) = signals(people)
    assert text.startswith("файлы последним сохранил «Вася»")
    common = [result(n, properties={"lastModifiedBy": "openpyxl"}) for n in (1, 2)]
    assert signals(common) == []


def test_foreign_identifiers_are_told():
    (text,) = signals([result(1, identity=["идентификатор выдан: Петров"])])
    assert text == "Студент 1 (1.xlsx): идентификатор выдан: Петров"


def distinct(result: dict, number: int) -> dict:
    """The work of another student with another variant: other right values, other wrong ones."""
    mine = json.loads(json.dumps(result))
    for line in mine["items"]:
        for mark in ("right_mark", "mark"):
            if line.get(mark):
                line[mark] = f"{number:08d}{line[mark][8:]}"
    mine |= {"number": number, "key": f"{number}.xlsx", "sha256": f"{number}"}
    return mine | {"student": f"Студент {number}"}


def test_a_class_of_a_thousand_fits_into_memory():
    wrong = {"omega": ["=regime_speed_rpm*PI()/60"]}
    result = classroom.marks(filled_book(classroom.handout(), classroom.assignment(), wrong))
    assert len(json.dumps(result)) > 60_000
    for formula in result["formulas"].values():
        formula[2] = False  # the book is filled as the program fills it
    shared: dict = {}
    kept = [work_of(distinct(result, number), shared) for number in (1, 2)]
    tracemalloc.start()
    kept += [work_of(distinct(result, number), shared) for number in range(3, 43)]
    taken = tracemalloc.get_traced_memory()[0] / 40
    tracemalloc.stop()
    assert taken < 6_000  # bytes of a work
    assert [right for _, right in kept[1].rights] != [right for _, right in kept[2].rights]
    assert similarity.signals(kept) == []
