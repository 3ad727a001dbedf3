"""Grading: books a second and memory, beside recalculating each book by LibreOffice.

The books are the textbook's diesel at 10° under the default rubric, filled in with the
solved book's formulas and saved by LibreOffice, as students save them.
"""

from __future__ import annotations

import os
import resource
import shutil
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from reports.grading.grade import Options, grade
from reports.grading.issue import assignment_for, issue
from reports.grading.register import Register
from reports.recalculation.by_libreoffice import LibreOffice
from reports.resources import samples_dir
from tests.grading.fill import filled_book

STUDENTS = 10
FEW, MANY = 40, 240
OFFICE = 4


def rows() -> Iterator[tuple[str, str]]:
    """Labels and figures."""
    workers = len(os.sched_getaffinity(0))
    with tempfile.TemporaryDirectory(prefix="kshm-bench-") as name:
        folder = Path(name)
        started = time.perf_counter()
        register = _issued(folder)
        each = (time.perf_counter() - started) / STUDENTS
        yield "выдача одной рабочей книги", f"{each:.2f} с"
        empty = [
            filled_book(
                (folder / "issued" / book.folder / book.file).read_bytes(),
                assignment_for(book, register.rubric),
            )
            for book in register.books
        ]
        books = LibreOffice().converted(empty)
        few, memory_few = _graded(folder, books, FEW, workers)
        yield f"проверка {FEW} книг, процессов {workers}, с их запуском", f"{few:.1f} с"
        many, memory_many = _graded(folder, books, MANY, workers)
        yield f"проверка {MANY} книг, процессов {workers}, с их запуском", f"{many:.1f} с"
        speed = (MANY - FEW) / (many - few)
        yield "скорость проверки без запуска", f"{speed:.1f} книг/с"
        growth = f"{memory_few:.0f} и {memory_many:.0f} МиБ"
        yield f"наибольшая память процесса на {FEW} и {MANY} книгах", growth
        office = _office(books)
        yield (
            "пересчёт книги в LibreOffice без запуска",
            f"{office:.2f} с ({1 / office:.1f} книг/с)",
        )
        yield "проверка быстрее пересчёта в LibreOffice", f"в {speed * office:.1f} раза"


def _issued(folder: Path) -> Register:
    lines = ["Фамилия;Имя"] + [f"Студент{chr(1040 + i)};Имя" for i in range(STUDENTS)]
    (folder / "group.csv").write_text("\n".join(lines), encoding="utf-8")
    return issue(
        samples_dir() / "class" / "base.toml",
        folder / "group.csv",
        folder / "issued",
        seed=1,
        secret_file=folder / "key",
    ).register


def _graded(folder: Path, books: list[bytes], count: int, workers: int) -> tuple[float, float]:
    """Seconds for so many books, and the largest memory of any process so far [MiB]."""
    place, out = folder / f"submitted{count}", folder / f"graded{count}"
    place.mkdir()
    for i in range(count):
        (place / f"{i:05d}.xlsx").write_bytes(books[i % len(books)])
    started = time.perf_counter()
    options = Options(workers=workers)
    done = grade(folder / "issued", place, out, secret_file=folder / "key", options=options)
    seconds = time.perf_counter() - started
    assert done.summary["mean"] == done.summary["maximum"], done.summary["mean"]
    shutil.rmtree(place)
    return seconds, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024


def _office(books: list[bytes]) -> float:
    """Seconds of LibreOffice for one book more."""
    times = []
    for count in (1, 1 + OFFICE):
        started = time.perf_counter()
        LibreOffice().converted(books[:count])
        times.append(time.perf_counter() - started)
    return (times[1] - times[0]) / OFFICE
