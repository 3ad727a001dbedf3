"""What a work gets does not depend on who else hands in, in which order, or on how many processes.

Each pair of works here has the same formulas to the letter and means other things by them.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from openpyxl import Workbook
from openpyxl.workbook.defined_name import DefinedName

from reports.grading.batch.pool import grade_all
from reports.grading.judging.marking import Marker
from reports.grading.reading.submissions import Submission, collect
from reports.workbook.layout import Layout
from tests.cover import examples, sparse
from tests.grading import classroom
from tests.grading.fill import Formula, filled_book
from tests.grading.forms import as_excel
from tests.grading.hostile import bare, part

Edit = Callable[[Workbook, Layout], None]
V1 = "P3_1.v1_m_s"


def named(name: str, text: str | None) -> Edit:
    """A defined name that means something else, or nothing."""

    def edit(book: Workbook, layout: Layout) -> None:
        if text is None:
            del book.defined_names[name]
        else:
            book.defined_names[name] = DefinedName(name, attr_text=text)

    return edit


def typed(sheet: str, at: str, value: object) -> Edit:
    def edit(book: Workbook, layout: Layout) -> None:
        book[sheet][at] = value

    return edit


def each_row(text: str) -> list[Formula]:
    return [text.replace("{r}", str(row)) for row in range(6, 19)]


R, L = "Массы!$C$5", "Массы!$C$6"
OWN_NAME: dict[str, list[Formula]] = {"lam": ["=mine/L_rod"]}
FAR: dict[str, list[Formula]] = {"lam": ["=Массы!$GZ$5"]}
VARIANT: dict[str, list[Formula]] = {"lam": ["=IF('Исходные данные'!$C$12=\"1\",r_crank/L_rod,1)"]}
BELOW = "SUMIF('П3.1'!$A$17:$A$18,\">0\",'П3.1'!$A$18)"  # and the cell below
PAST: dict[str, list[Formula]] = {"lam": [f"=r_crank/L_rod+{BELOW}-360"]}
OWN_NUMBERS: dict[str, list[Formula]] = {V1: each_row("={v}*SIN(RADIANS(A{r}))")}
OTHER_SHEET: dict[str, list[Formula]] = {"lam": ["=Лист!$A$1/L_rod"]}


def numbers_of(book: int) -> dict[str, list[Formula]]:
    """Formulas in which the product of one student's radius and speed stands as a number."""
    values = classroom.assignment(book).model
    fields = {name: float(values.fields[name].value) for name in
              ("geometry_crank_radius_mm", "regime_speed_rpm")}  # fmt: skip
    speed = fields["geometry_crank_radius_mm"] / 1000 * fields["regime_speed_rpm"] * 0.10471975512
    return {V1: [str(f).replace("{v}", repr(speed)) for f in OWN_NUMBERS[V1]]}


def added(title: str, value: float) -> Edit:
    def edit(book: Workbook, layout: Layout) -> None:
        book.create_sheet(title)["A1"] = value

    return edit


def filled(number: int, edit: Edit | None = None, changes: dict | None = None) -> bytes:
    return filled_book(classroom.handout(number), classroom.assignment(number), changes, edit)


WORKS: dict[str, Callable[[], bytes]] = {
    "right 1": lambda: as_excel(filled(1)),
    "right 2": lambda: filled(2),
    "right 3": lambda: as_excel(filled(3)),
    "name gone 4": lambda: filled(4, named("r_crank", None)),
    "name broken 1": lambda: filled(1, named("r_crank", "#REF!")),
    "speed gone 2": lambda: filled(2, named("omega", None)),
    "name a number 3": lambda: filled(3, named("r_crank", "0.047")),
    "name of the length 4": lambda: filled(4, named("r_crank", L)),
    "own name 1": lambda: filled(1, named("mine", R), OWN_NAME),
    "own name, another cell 2": lambda: filled(2, named("mine", L), OWN_NAME),
    "own name, none 3": lambda: filled(3, None, OWN_NAME),
    "far cell 1": lambda: filled(1, typed("Массы", "GZ5", "=r_crank/L_rod"), FAR),
    "far number 2": lambda: filled(2, typed("Массы", "GZ5", 0.3), FAR),
    "variant 1": lambda: filled(1, None, VARIANT),
    "variant 2": lambda: filled(2, None, VARIANT),
    "nothing below 1": lambda: filled(1, None, PAST),
    "something below 2": lambda: filled(2, typed("П3.1", "A19", 5), PAST),
    "own numbers 1": lambda: filled(1, None, numbers_of(1)),
    "the first one's numbers 2": lambda: filled(2, None, numbers_of(1)),
    "sheet there 3": lambda: filled(3, added("Лист", 0.05), OTHER_SHEET),
    "sheet gone 4": lambda: filled(4, None, OTHER_SHEET),
    "angle 3": lambda: filled(3, typed("П3.1", "A8", 77)),
    "empty 4": lambda: classroom.handout(4),
    "broken": lambda: b"PK\x03\x04 nothing",
    "no declaration 1": lambda: part(filled(1), "xl/workbook.xml", bare),
    "foreign function 2": lambda: filled(2, None, {"V_c": ['=INDIRECT("V_h")/10']}),
}


@lru_cache(maxsize=64)
def work(name: str) -> bytes:
    return WORKS[name]()


def marked(marker: Marker, name: str) -> str:
    """All that is said of a work."""
    submission = Submission(f"{name}.xlsx", Path(f"{name}.xlsx"), None, None)
    return json.dumps(marker.mark(submission, work(name)), ensure_ascii=False, sort_keys=True)


@lru_cache(maxsize=64)
def alone(name: str) -> str:
    """What a work gets where nobody else hands in."""
    return marked(Marker(classroom.register()), name)


# What stood before in the class has changed the marks of what comes after.
PAIRS = [
    ("name gone 4", "right 1"), ("name broken 1", "right 2"), ("speed gone 2", "right 3"),
    ("name a number 3", "right 1"), ("name of the length 4", "right 2"),
    ("own name 1", "own name, another cell 2"), ("own name, none 3", "own name 1"),
    ("far cell 1", "far number 2"), ("variant 1", "variant 2"),
    ("nothing below 1", "something below 2"),
    ("own numbers 1", "the first one's numbers 2"), ("sheet gone 4", "sheet there 3"),
    ("right 1", "right 3"),
]  # fmt: skip


@pytest.mark.parametrize(("first", "second"), sparse(PAIRS, 3))
def test_whoever_came_before_has_no_part_in_it(first: str, second: str) -> None:
    for names in ((first, second), (second, first)):
        marker = Marker(classroom.register())
        assert [marked(marker, name) for name in names] == [alone(name) for name in names]


@settings(max_examples=examples(3, 6), deadline=None, suppress_health_check=list(HealthCheck))
@given(st.lists(st.sampled_from(sorted(WORKS)), min_size=3, max_size=8, unique=True))
def test_any_order_of_any_part_of_a_class_gets_the_same(names: list[str]) -> None:
    marker = Marker(classroom.register())
    assert {name: marked(marker, name) for name in names} == {name: alone(name) for name in names}


@pytest.mark.parametrize("workers", sparse([2, 1, 4], 3))
def test_any_number_of_processes_says_the_same(workers: int, tmp_path: Path) -> None:
    names = sorted(WORKS)[:: 1 if workers == 1 else -1]
    for name in names:
        (tmp_path / f"{name}.xlsx").write_bytes(work(name))
    folder = classroom.folder() / "issued"
    outcomes = grade_all(collect(tmp_path), folder, workers=workers)
    collected = {
        outcome.submission.key.removesuffix(".xlsx"): outcome.result for outcome in outcomes
    }
    for name in names:
        mine = {key: collected[name][key] for key in ("number", "items", "points", "manual")
                if key in collected[name]}  # fmt: skip
        wanted = json.loads(alone(name))
        assert mine == {key: wanted[key] for key in mine}, name
