"""Whose file it is: by the identifier, then by the names, with what speaks against it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from reports.grading.issuing.handout import TICKET_NAME, TICKET_TITLE
from reports.grading.issuing.register import Register
from reports.grading.issuing.roster import Student
from reports.grading.reading.submissions import (
    Match,
    Submission,
    collect,
    find_by_name,
    find_owner,
)
from reports.recalculation.grid import CellColumn, CellGrid
from reports.shared.errors import InputError
from reports.workbook.intake import check_package
from tests.grading import classroom

FORGED = "K" + "A" * 24


class Parts:
    """A package with one property, or none."""

    def __init__(self, ticket: str = "") -> None:
        self.ticket = ticket

    def read(self, name: str) -> bytes:
        if not self.ticket:
            raise KeyError(name)
        return (f'<P xmlns="x"><property name="{TICKET_NAME}"><v>{self.ticket}</v></property></P>'
                ).encode()  # fmt: skip


def grid_with(ticket: str, *, named: bool = True) -> CellGrid:
    cells = {1: CellColumn({3: TICKET_TITLE}), 2: CellColumn({3: ticket})} if ticket else {}
    names = {TICKET_NAME.casefold(): ("A", 3, 2)} if named and ticket else {}
    return CellGrid({"A": cells}, names)


def submission(key: str, moodle: str = "") -> Submission:
    return Submission(key, Path(key), None, None, moodle_name=moodle)


def owner(key: str = "x.xlsx", cell: str = "", prop: str = "", **more) -> Match:
    register = classroom.register()
    where = submission(key, more.pop("moodle", ""))
    return find_owner(register, where, grid_with(cell, **more), Parts(prop))


def tickets() -> list[str]:
    return [book.ticket for book in classroom.register().books]


@pytest.mark.parametrize("where", ["name", "property", "label"])
def test_an_identifier_in_any_of_its_places_is_enough(where):
    mine = tickets()[1]
    match = owner(
        cell=mine if where != "property" else "", prop=mine if where == "property" else "",
        named=where == "name",
    )  # fmt: skip
    assert match.book is classroom.register().books[1]
    assert mine in match.evidence[0]
    assert match.doubts == ()


def test_identifiers_of_two_people_are_nobodys():
    match = owner(cell=tickets()[0], prop=tickets()[2])
    assert match.book is None
    assert "идентификаторы разных работ" in match.doubts[0]


def test_an_identifier_that_was_not_issued_is_no_proof():
    name = classroom.register().books[1].student.surname
    match = owner(f"{name}.xlsx", cell=FORGED)
    assert match.book is None
    assert "не выдавался" in match.doubts[0]


def test_a_name_that_contradicts_the_identifier_is_a_doubt():
    books = classroom.register().books
    match = owner(cell=tickets()[0], moodle=books[1].student.full)
    assert match.book is books[0]
    assert books[1].student.full in match.doubts[0]
    assert owner(cell=tickets()[0], moodle=books[0].student.full).doubts == ()


@pytest.mark.parametrize("before", ["", "Команда 1-", "Группа по умолчанию-"])  # of a team's zip
def test_the_name_of_a_file_is_not_that_of_who_hands_it_in(before):
    """A book of another's that keeps its name is still handed in by the participant."""
    mine, other = classroom.register().books[:2]
    handed = f"{before}{other.student.full}"
    match = owner(key=f"{handed}_7_assignsubmission_file_/{mine.file}", cell=mine.ticket,
                  moodle=handed)  # fmt: skip
    assert match.book is mine
    assert match.submitter == other.number
    assert "файл сдал(а)" in match.doubts[0]
    own = owner(key=f"{handed}_7_assignsubmission_file_/{other.file}", cell=other.ticket,
                moodle=handed)  # fmt: skip
    assert (own.book, own.doubts) == (other, ())


def test_a_participant_who_is_not_on_the_roster_is_told():
    """Whatever identifier and name his file has: it may be another's."""
    mine = classroom.register().books[0]
    stranger = "Чужаков Семён"
    key = f"{stranger}_7_assignsubmission_file_/{mine.file}"
    match = owner(key, cell=mine.ticket, moodle=stranger)
    assert (match.book, match.submitter) == (mine, 0)
    lines = f"имя участника Moodle: «{stranger}» — его нет в списке"
    assert match.doubts == (f"{lines}, а идентификатор выдан: {mine.student.full}",)
    bare = owner(key, moodle=stranger)
    assert (bare.book, bare.doubts) == (None, (f"нет идентификатора; {lines}",))
    unreadable = submission(key, stranger)
    assert find_by_name(classroom.register(), unreadable).book is None
    hidden = owner(key, cell=mine.ticket, moodle="Участник")  # of a task graded without names
    assert (hidden.book, hidden.doubts) == (mine, ())


def test_without_an_identifier_the_only_fitting_name_decides():
    books = classroom.register().books
    for key in (f"группа/{books[1].folder}/кр.xlsx", f"Moja {books[1].file}", "petrov kr.xlsx"):
        match = owner(key)
        assert match.book is books[1], key
        assert "идентификатора нет" in match.evidence[0]
    assert owner("кр.xlsx").book is None
    assert owner("Иванов и Петров.xlsx").book is None


def test_a_file_that_cannot_be_read_is_known_by_name():
    register = classroom.register()
    assert find_by_name(register, submission("Петров.xlsx")).book is register.books[1]
    assert find_by_name(register, submission("x.xlsx")) == Match(None, (), ())


@pytest.mark.parametrize("first", ["Сергей", ""])
@pytest.mark.parametrize(
    ("surname", "file"),
    [("..", "р.xlsx"), ("-2+3", "р.xlsx"), ("И", "Кинематика и динамика.xlsx"),
     ("По", "Работа по ДВС.xlsx"), ("李", "р.xlsx"), ("Əліев", "лиев.xlsx")],
)  # fmt: skip
def test_a_name_of_few_letters_is_not_found_in_everything(surname, first, file):
    register = renamed(Student("x", surname, first))
    other = register.books[0]
    match = find_owner(register, submission(file), grid_with(other.ticket), Parts())
    assert match.book is other
    assert match.doubts == ()
    assert find_by_name(register, submission(file)) == Match(None, (), ())


@pytest.mark.parametrize(
    ("surname", "file"),
    [("Əліев", "Əліев.xlsx"), ("李", "李 Сергей.xlsx"), ("По", "По Сергей.xlsx")],
)
def test_names_of_any_letters_are_found(surname, file):
    register = renamed(Student("x", surname, "Сергей"))
    assert find_by_name(register, submission(file)).book is register.books[1]


def test_the_longer_of_two_names_in_one_another_is_meant():
    register = renamed(Student("x", "Иванов-Водкин", "Имя"))  # the first is Иванов Имя
    first, second, third = register.books[:3]
    for file in ("Иванов-Водкин Имя.xlsx", "Иванов-Водкин.xlsx"):
        assert find_by_name(register, submission(file)).book is second
        match = find_owner(register, submission(file), grid_with(third.ticket), Parts())
        assert (match.book, match.submitter) == (third, second.number)
    assert find_by_name(register, submission("Иванов Имя.xlsx")).book is first


def test_a_name_of_two_students_is_not_that_of_a_third():
    register = renamed(Student("x", "Иванов", "Имя"))
    first, second, third = register.books[:3]
    for book in (first, second):
        match = find_owner(register, submission("Иванов Имя.xlsx"), grid_with(book.ticket), Parts())
        assert (match.book, match.doubts, match.submitter) == (book, (), None)
    match = find_owner(register, submission("Иванов Имя.xlsx"), grid_with(third.ticket), Parts())
    assert "сдал(а) Иванов Имя (" in match.doubts[0]
    assert (match.book, match.submitter) == (third, 0)


def test_one_word_that_is_both_names_is_a_surname_among_others():
    register = renamed(Student("x", "Роман", "Роман"))
    third = register.books[2]
    file = submission(f"Роман {third.student.surname}.xlsx")
    assert find_owner(register, file, grid_with(third.ticket), Parts()).doubts == ()


def renamed(student: Student) -> Register:
    """The class with another second student."""
    register = classroom.register()
    books = [replace(b, student=student) if i == 1 else b for i, b in enumerate(register.books)]
    return replace(register, books=type(register.books)(books))


@pytest.mark.parametrize("name", ["Iurii Iakovlev", "Yakovlev Yuriy", "Jakovlev J Jurij"])
def test_a_name_in_the_letters_of_a_passport_is_known(name):
    register = renamed(Student("x", "Яковлев", "Юрий Ильич"))
    mine = register.books[1]
    for surname in ("Яковлев", "Jakovlev"):
        assert find_by_name(register, submission(f"{surname}.xlsx")).book is mine
    match = find_owner(register, submission("work.xlsx", name), grid_with(mine.ticket), Parts())
    assert (match.book, match.doubts) == (mine, ())


def test_a_lock_file_of_excel_alone_is_told_and_beside_its_book_is_left_out(tmp_path):
    lock, book = "~$книга.xlsx", "книга.xlsx"
    (tmp_path / "alone").mkdir()
    (tmp_path / "alone" / lock).write_bytes(b"\x04user" + b" " * 160)
    (tmp_path / "both").mkdir()
    for name in (lock, book):
        (tmp_path / "both" / name).write_bytes(b"\x04user" + b" " * 160)
    assert [each.key for each in collect(tmp_path)] == [f"alone/{lock}", f"both/{book}"]
    with pytest.raises(InputError, match="временный файл, который Excel держит рядом"):
        check_package(tmp_path / "alone" / lock)
