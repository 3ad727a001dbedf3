"""A class as it comes back: the honest are paid, the wrong are told, the cheats earn nothing."""

from __future__ import annotations

import io
import re
import zipfile

import pytest

from tests.grading.real.books import filling, saved, values
from tests.grading.real.cheats import CHEATS
from tests.grading.real.desk import desk
from tests.grading.real.grading import Marked, marked, works
from tests.grading.real.honest import HONEST
from tests.grading.real.mistakes import MISTAKES
from tests.grading.real.together import NAMES
from tests.grading.real.typed import typed
from tools.referees.by_libreoffice import LibreOffice

pytestmark = pytest.mark.xdist_group("real class")  # the class is graded once


@pytest.fixture(scope="module", autouse=True)
def _saved_by_another_program(libreoffice: LibreOffice) -> None:
    """Some books are saved by LibreOffice."""


def unlike(actual: Marked, *allowed: str) -> dict[str, str]:
    """Items whose verdict is none of those allowed."""
    return {
        item: line["verdict"]
        for item, line in actual.lines.items()
        if line["verdict"] not in ("right", *allowed)
    }


def test_the_class_is_large_enough():
    assert len(HONEST) >= 15
    assert len(MISTAKES) >= 46
    assert len(CHEATS) >= 46
    names = [work.name for work in (*HONEST, *MISTAKES, *CHEATS)]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("name", [work.name for work in HONEST])
def test_an_honest_book_is_right_throughout(name):
    actual = marked()[name]
    assert unlike(actual) == {}
    assert actual.result["points"] == 100
    assert actual.result["manual"] == actual.result["notes"] == actual.result["doubts"] == []


@pytest.mark.parametrize("name", ["array formulas", "noughts at dead centre", "blank omega"])
def test_a_typed_book_is_what_openpyxl_writes(name):
    number, work = next((n, w) for n, w in enumerate(works(), 1) if name in w.name.split(NAMES))
    here = desk(number)
    own = parts(typed(here, values(here, filling(here, work))))
    written = parts(saved(here, filling(here, work)))
    del own["docProps/core.xml"], written["docProps/core.xml"]  # the time of writing
    assert own == written


# Cells of input data: the blanks after a number are as its decimals, so the looks differ.
OF_INPUTS = re.compile(rb'(<c r="C\d+") s="\d+"')
SHEETS_OF_INPUTS = {"xl/worksheets/sheet1.xml", "xl/worksheets/sheet2.xml"}


def parts(book: bytes) -> dict[str, bytes]:
    """Parts without the looks of input data."""
    with zipfile.ZipFile(io.BytesIO(book)) as source:
        read = {name: source.read(name) for name in source.namelist()}
    return read | {name: OF_INPUTS.sub(rb"\1", read[name]) for name in SHEETS_OF_INPUTS}


def test_formulas_by_hand_are_not_the_programs():
    shares = [
        sum(own for _, _, own in built.values()) / len(built)
        for work in HONEST
        if (built := marked()[work.name].result["formulas"])
    ]
    assert len(shares) >= 15 and max(shares) < 0.5


@pytest.mark.parametrize("name", [work.name for work in MISTAKES])
def test_a_mistake_costs_its_own_column_and_no_other(name):
    actual = marked()[name]
    assert unlike(actual, "carried") == dict(actual.work.verdicts)
    for item, words in actual.work.causes.items():
        assert words in actual.lines[item]["cause"]
    for item, line in actual.lines.items():
        if item not in actual.work.verdicts:
            assert line["points"] == line["of"], item  # carried is paid in full
    assert not actual.result["manual"]
    assert actual.row["points"] == actual.result["points"] < 99.2 or _is_small(actual)


def _is_small(actual: Marked) -> bool:
    """Mistakes in what nothing follows from, or in one row, may cost less than a point."""
    return all(actual.lines[i]["of"] < 1 or actual.lines[i]["points"] for i in actual.work.verdicts)


@pytest.mark.parametrize("name", [work.name for work in CHEATS if not work.held])
def test_a_cheat_earns_nothing(name):
    actual = marked()[name]
    for item in actual.work.unpaid:
        assert actual.lines[item]["points"] == 0, (item, actual.lines[item]["verdict"])
    # Nothing right is lost to the cheat but what rests on blanks and circles.
    lines = {*actual.work.unpaid, *actual.work.verdicts}
    others = {i: v for i, v in unlike(actual, "carried", "groundless").items() if i not in lines}
    assert others == {}


@pytest.mark.parametrize("name", [work.name for work in CHEATS if work.held])
def test_a_foreign_work_waits_for_a_person(name):
    actual = marked()[name]
    assert actual.row["points"] is None
    assert actual.row["manual"]
    assert actual.work.held in actual.row["remark"]
