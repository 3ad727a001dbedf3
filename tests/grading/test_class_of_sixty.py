"""A class of seeded defects, of sixty with --all: each is found, nothing right is marked wrong."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from tempfile import mkdtemp

import pytest

from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.handout import handout_bytes
from reports.grading.issuing.issue import assignment_for
from reports.grading.issuing.register import Issued, Register
from reports.grading.judging.marking import Marker
from reports.grading.reading.submissions import Submission
from reports.model.blocks import TableSpec
from reports.model.evaluation import Values
from reports.workbook.layout import Cell, Layout
from tests.cover import ALL
from tests.grading.classroom import opened, registered
from tests.grading.defects import DEFECTS, Defect
from tests.grading.fill import filled_book, filled_cells, solved_formulas
from tests.grading.forms import as_excel, tampered
from tests.grading.real.desk import Desk
from tests.grading.real.typed import typed
from tools.referees.by_libreoffice import LibreOffice

RUBRIC = """
[work]
fill = ["geometry", "masses", "P3_1", "P3_2", "P4_1", "P4_2"]
"""
FORMS = ("own", "office", "excel")
FORMS_OF_EACH = 2 if ALL else 1
# LibreOffice takes its time: without --all it saves one of six, the right book among them.
ORDER = FORMS * 2 if ALL else ("own", "office", "excel", "own", "excel", "own")
COUNT = FORMS_OF_EACH * len(DEFECTS)


def plan() -> list[tuple[int, Defect, str]]:
    """Each defect is a student's, who hands it in in one of the three forms, or in two."""
    collected = []
    for index, defect in enumerate(DEFECTS):
        at = (index + 1) % 6  # the right book as another program saves it
        forms = [form for form in dict.fromkeys(ORDER[at:] + FORMS) if form in defect.forms]
        collected += [(index + 1, defect, form) for form in forms[:FORMS_OF_EACH]]
    return collected


@lru_cache(maxsize=1)
def classroom() -> Register:
    return registered(Path(mkdtemp(prefix="kshm-sixty-")), len(DEFECTS), RUBRIC)


@lru_cache(maxsize=64)
def assignment_of_book(number: int) -> Assignment:
    register = classroom()
    like = assignment_of_book(1) if number > 1 else None
    return assignment_for(register.books[number - 1], register.rubric, like)


@lru_cache(maxsize=64)
def desk_of(number: int) -> Desk:
    """All that is known of a student; the neighbour's speed and rod are both other ones."""
    register = classroom()
    issued = register.books[number - 1]
    other = next(
        book
        for book in register.books
        if all(book.drawn[key] != issued.drawn[key] for key in issued.drawn)
    )
    assignment = assignment_of_book(number)
    return Desk(issued, other, assignment, Layout.of(assignment.model))


def substituted(
    assignment: Assignment, values: Values, formulas: dict, other: Issued, layout: Layout
) -> dict:
    """Cells and numbers put into the formulas of the defects."""
    model = assignment.model
    radius = layout.cells["geometry_crank_radius_mm"].absolute
    items = {}
    for node, texts in formulas.items():
        table = model.tables.get(node.split(".")[0]) if "." in node else None
        rows = layout.rows_of(table) if isinstance(table, TableSpec) else [layout.cells[node].row]
        column = layout.column_of(node) if table is not None else layout.cells[node].column
        items[node] = [
            text
            if not isinstance(text, str)
            else text.replace("{a}", Cell("", row, 1).coordinate)
            .replace("{self}", Cell("", row, column).coordinate)
            .replace("{own_wrong}", Cell("", row, 17).coordinate)
            .replace("{radius}", radius)
            .replace("{other_rod}", str(other.drawn["geometry.rod_length_mm"]))
            .replace("{other_speed}", str(other.drawn["regime.speed_rpm"]))
            .replace("{value}", str(values.scalars.get(node)))
            for row, text in zip(rows, texts, strict=True)
        ]
    return items


def book_of(number: int, defect: Defect) -> bytes:
    here = desk_of(number)
    issued, assignment, layout, values = here.issued, here.assignment, here.layout, here.values
    formulas = solved_formulas(assignment, layout)
    changes = defect.change(formulas, values, assignment)
    wrong = substituted(assignment, values, changes, here.other, layout)
    plain = defect.edit is None and defect.name != "copied"
    if plain and number > 1 and not ALL:
        return typed(here, filled_cells(assignment, layout, {**formulas, **wrong}), desk_of(1))
    # The first one as the file that is handed out, with its charts.
    empty = (handout_bytes if number == 1 else opened)(assignment, issued.ticket)

    def edit(book, places):
        if defect.name == "copied":  # numbers right for the wrong ω, taken from elsewhere
            for row, value in zip(range(6, 19), values.columns["P3_1"]["v2_m_s"], strict=True):
                book["П3.1"].cell(row, 17).value = float(value) / 2
        if defect.edit is not None:
            defect.edit(book, places)

    return filled_book(empty, assignment, wrong, edit, charts=True)


def graded_class(libreoffice: LibreOffice):
    """Number of the student and form → defect, result and file."""
    register = classroom()
    works = plan()
    assert len(works) == COUNT == FORMS_OF_EACH * len(register.books) >= 30
    books = {number: book_of(number, defect) for number, defect in enumerate(DEFECTS, 1)}
    office = [number for number, _, form in works if form == "office"]
    saved = dict(
        zip(office, libreoffice.converted([books[number] for number in office]), strict=True)
    )
    marker = Marker(register)
    collected = {}
    for number, defect, form in works:
        data = as_excel(books[number]) if form == "excel" else books[number]
        data = saved[number] if form == "office" else data
        submission = Submission(f"работа {number}.xlsx", Path("x"), None, None)
        collected[number, form] = defect, marker.mark(submission, data), data
    return collected


def test_a_class_of_sixty(libreoffice: LibreOffice):
    # One test: on several workers the class would otherwise be made several times.
    results = graded_class(libreoffice)
    check_the_table_of_verdicts_holds_exactly(results)
    check_a_wrong_omega_costs_one_item(results)
    check_what_was_moved_or_changed_is_told(results)
    check_a_saved_value_that_was_altered_is_reported(results)


def check_the_table_of_verdicts_holds_exactly(results):
    wrong = []
    for (number, form), (defect, result, _) in results.items():
        where = f"{number} {defect.name} ({form})"
        if result["status"] != "graded" or result["number"] != number:
            wrong.append((where, result["status"], result.get("reason"), result["manual"]))
            continue
        lines = {line["id"]: line for line in result["items"]}
        collected = {
            id_: line["verdict"] for id_, line in lines.items() if line["verdict"] != "right"
        }
        carried = {id_ for id_, verdict in collected.items() if verdict == "carried"}
        judged = {id_: verdict for id_, verdict in collected.items() if verdict != "carried"}
        if judged != defect.verdicts:
            wrong.append((where, judged, defect.verdicts))
        # Only what depends on a wrong value is carried forward.
        assignment = assignment_of_book(number)
        sources = {node for i in assignment.items if i.id in judged for node in i.nodes}
        for item in assignment.items:
            if item.id in carried and not (assignment.ancestors(item) & sources):
                wrong.append((where, item.id, "carried without a wrong ancestor"))
        for item, words in defect.causes.items():
            if words not in lines[item]["cause"]:
                wrong.append((where, item, lines[item]["cause"], words))
        if bool(result["manual"]) != defect.manual:
            wrong.append((where, result["manual"]))
    assert wrong == []


def check_a_wrong_omega_costs_one_item(results):
    for defect, result, _ in results.values():
        if defect.name == "omega":
            lines = result["items"]
            verdicts = {line["id"]: line["verdict"] for line in lines}
            assert verdicts["P3_1.v1_m_s"] == verdicts["P4_2.Msum_Nm"] == "carried"
            cost = next(line["of"] for line in lines if line["id"] == "geometry.omega")
            assert result["points"] == pytest.approx(100 - cost, abs=0.01)


def check_what_was_moved_or_changed_is_told(results):
    for (_, form), (defect, result, _) in results.items():
        message = " ".join([*result["moved"], *result["notes"]])
        if defect.note:
            assert defect.note in message, (defect.name, form, message)
        else:
            assert not result["changed"], (defect.name, form, result["changed"])
            assert not result["altered"], (defect.name, form, result["altered"])


def check_a_saved_value_that_was_altered_is_reported(results):
    register = classroom()
    for (_, form), (defect, _, data) in results.items():
        if defect.name == "right" and form != "own":
            changed = tampered(data, "П3.1", "E9")
            submission = Submission("a.xlsx", Path("a"), None, None)
            result = Marker(register).mark(submission, changed)
            assert result["points"] == 100
            assert len(result["altered"]) == 1
            assert "П3.1!E9" in result["altered"][0]
            return
    pytest.fail("no right book was saved by another program")
