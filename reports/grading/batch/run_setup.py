"""What surrounds a run: where it may write, later deadlines, form, copies, questions, no names."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from markupsafe import escape

from reports.grading.batch.pool import Job, copies
from reports.grading.issuing.register import FILE, Register, load_register
from reports.grading.issuing.reissue import matched
from reports.grading.issuing.roster import Student
from reports.grading.issuing.rubric import Rubric
from reports.grading.judging.marking import Marker
from reports.grading.judging.work_digest import Work
from reports.grading.pages.pages import questions_page
from reports.shared.errors import InputError, Problem
from reports.shared.files import make_dir, write_bytes, write_text

RESULTS, QUESTIONS = "results", "questions"


class Pseudonyms:
    """Numbers for the names of a class."""

    def __init__(self, register: Register) -> None:
        self._names: dict[str, str] = {}
        for book in register.books:
            student = book.student
            first = student.name.split(" ")[0]
            for name in (book.file, book.folder, student.full, f"{student.surname} {first}",
                         f"{first} {student.surname}"):  # fmt: skip
                self._names.setdefault(str(escape(name)), f"Студент {book.number}")

    def over(self, page: str, files: Iterable[str]) -> str:
        """Return a page with numbers for names and for the names of files."""
        names = {str(escape(file)): f"файл {i}" for i, file in enumerate(files, 1)} | self._names
        ordered = sorted(filter(None, names), key=len, reverse=True)
        return re.sub("|".join(map(re.escape, ordered)), lambda match: names[match[0]], page)


def fill_form(folder: Path, rows: Sequence[Mapping[str, Any]], rubric: Rubric, path: Path) -> None:
    """Fill in the form; list the students whom it lacks.

    Raises:
        InputError: it cannot be read.
    """
    from reports.grading.pages.form import filled_form

    form = filled_form(path, rows, rubric)
    write_bytes(folder / "ведомость.xlsx", form.data)
    left = "\n".join(form.left) or "все студенты в ведомости"
    write_text(folder / "ведомость-осталось.txt", f"{left}\n")


def write_copies(
    folder: Path, jobs: Sequence[Job], rubric: Rubric, workers: int, timeout_s: float
) -> None:
    """Write the books of the students with coloured cells and comments, beside the pages."""
    for work, data in copies(jobs, rubric, workers, timeout_s):
        write_bytes((folder / work.page).with_suffix(".xlsx"), data)


def write_questions(
    folder: Path, works: Sequence[Work], marker: Marker, page_of: Callable[..., str]
) -> None:
    """Questions for the defence: a sheet for each student, one with answers for the class."""
    from reports.grading.pages.questions import questions_for

    rubric = marker.register.rubric
    books = {book.number: book for book in marker.register.books}
    sheets = []
    make_dir(folder / QUESTIONS)
    for work in works:
        book = books[work.number or 0]
        wrong = [line.id for line in work.items if line.of and line.points < line.of]
        questions = questions_for(marker.assignment(book)[0], book.ticket, wrong)
        student = book.student
        sheet = {"student": student.full, "group": student.group, "number": book.number,
                 "questions": questions}  # fmt: skip
        sheets.append(sheet)
        page = page_of(questions_page([sheet], rubric, answers=False))
        write_text(folder / QUESTIONS / Path(work.page).name, page)
    write_text(folder / "questions.html", page_of(questions_page(sheets, rubric, answers=True)))


def put_off(register: Register, students: Sequence[Student]) -> Register:
    """Return the register with the deadlines of a newer roster; nothing else is taken from it."""
    pairs = matched(register.books, students)
    extensions = {book.number: student.extension for student, book in pairs}
    late = [student for student, _ in pairs]
    lost = [one.full for one in students if one.extension and one not in late]
    if lost or not pairs:
        hint = "возьмите список, по которому выданы варианты, и впишите в него столбец «Срок»"
        problem = (
            f"в этой выдаче нет: {', '.join(lost[:5])}" if lost else "в списке нет её студентов"
        )
        raise InputError(Problem("--roster", problem, hint))
    books = (
        replace(book, student=replace(book.student, extension=extensions[book.number]))
        if book.number in extensions
        else book
        for book in register.books
    )
    return replace(register, books=tuple(books))


def refuse_overlap(submitted: Path, folder: Path, issued: Path) -> None:
    """Results must not land among the files that are read."""
    target = folder.resolve()
    for read_folder in (submitted, issued):
        source = read_folder.resolve()
        if source.is_dir() and (target == source or source in target.parents):
            problem = f"результаты легли бы в папку {read_folder}"
            raise InputError(Problem(str(folder), problem, "укажите другую папку ключом -o"))


def refuse_another_class(folder: Path, register: Register) -> None:
    """Raise InputError if the results belong to another class."""
    try:
        earlier = load_register(folder / RESULTS / FILE)
    except InputError:
        return
    if {book.ticket for book in earlier.books}.isdisjoint(book.ticket for book in register.books):
        problem = "здесь результаты и решения другой группы или другой выдачи"
        raise InputError(Problem(str(folder), problem, "укажите другую папку ключом -o"))
