"""Where results may be written: beside nothing that is read, over nobody else's."""

from __future__ import annotations

from pathlib import Path

from reports.grading.issuing.register import FILE, Register, load_register
from reports.shared.errors import InputError, Problem

RESULTS = "results"


def refuse_overlap(submitted: Path, folder: Path, issued: Path) -> None:
    """Results must not land among the files that are read."""
    target = folder.resolve()
    for place in (submitted, issued):
        source = place.resolve()
        if source.is_dir() and (target == source or source in target.parents):
            what = f"результаты легли бы в папку {place}"
            raise InputError(Problem(str(folder), what, "укажите другую папку ключом -o"))


def refuse_another_class(folder: Path, register: Register) -> None:
    """Decisions on one class are not those on the students with the same numbers of another."""
    try:
        earlier = load_register(folder / RESULTS / FILE)
    except InputError:
        return
    if {book.ticket for book in earlier.books}.isdisjoint(book.ticket for book in register.books):
        what = "здесь результаты и решения другой группы или другой выдачи"
        raise InputError(Problem(str(folder), what, "укажите другую папку ключом -o"))
