"""A second issue into the same folder: books that are handed out already stay what they are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from reports.grading.issuing.names import twin
from reports.grading.issuing.register import FILE, Issued, load_register, read_secret
from reports.grading.issuing.roster import Student
from reports.shared.errors import InputError, Problem

_KEYS: tuple[Callable[[Student], Hashable], ...] = (
    lambda student: student.id.casefold(),
    lambda student: (twin(student.full), student.group),
    lambda student: twin(student.full),
)


@dataclass(frozen=True, slots=True)
class Reissue:
    """Work-books of an earlier issue that stay, who came later and who has left."""

    kept: tuple[Issued, ...] = ()
    newcomers: tuple[Student, ...] = ()
    former: tuple[Issued, ...] = ()
    identity: str = ""
    first_number: int = 1  # of the newcomers


def reissue(folder: Path, batch: str, secret: Path, students: Sequence[Student]) -> Reissue:
    """Tell what an earlier issue in a folder leaves to be issued.

    A student keeps number, file, variant and identifier; one who comes back gets his own again.

    Raises:
        InputError: what was handed out from the folder would not be known any more.
    """
    if not (folder / FILE).exists():
        return Reissue(newcomers=tuple(students))
    earlier = load_register(folder)
    if earlier.batch != batch:
        problem = "в папке выдача по другой базе, другим диапазонам или другому зерну"
        hint = "розданные книги перестали бы узнаваться: укажите другую папку ключом -o " \
               "или удалите эту, если книги ещё не розданы"  # fmt: skip
        raise InputError(Problem(str(folder), problem, hint))
    earlier.check(read_secret(secret), folder)
    every = (*earlier.books, *earlier.former)
    books = matched(every, students)
    numbers = {book.number for _, book in books}
    newcomers = [student for student in students if all(one is not student for one, _ in books)]
    is_alike = not newcomers and numbers == {book.number for book in earlier.books}
    return Reissue(
        tuple(replace(book, student=replace(student, id=book.student.id))
              for student, book in sorted(books, key=lambda pair: pair[1].number)),
        tuple(newcomers),
        tuple(book for book in every if book.number not in numbers),
        earlier.identity if is_alike else earlier.trial_seed,
        max((book.number for book in every), default=0) + 1,
    )  # fmt: skip


def matched(books: Sequence[Issued], students: Sequence[Student]) -> list[tuple[Student, Issued]]:
    """Students with their books: by identity, else by a name that nobody else has."""
    pairs: list[tuple[Student, Issued]] = []
    for key in _KEYS:
        taken = {id(one) for pair in pairs for one in pair}
        free = [book for book in books if id(book) not in taken]
        open_ = [student for student in students if id(student) not in taken]
        of_books = Counter(key(book.student) for book in free)
        of_students = Counter(map(key, open_))
        by_key = {key(book.student): book for book in free}
        pairs += [
            (student, by_key[key(student)])
            for student in open_
            if of_books[key(student)] == of_students[key(student)] == 1
        ]
    return pairs
