"""Grading: books a second and memory, beside recalculating each book by LibreOffice.

The books are the textbook's diesel at 10° under the default rubric, filled in with the
solved book's formulas and saved by LibreOffice, as students save them.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from unittest import mock

from reports.grading.batch import pool
from reports.grading.issuing.issue import assignment_for, issue
from reports.grading.issuing.register import Register
from reports.grading.judging import verdicts
from reports.grading.judging.marking import Marker
from reports.grading.pages.pages import student_page
from reports.grading.reading import restoring
from reports.grading.reading.submissions import Submission
from reports.recalculation.formulas import Formula as Read
from reports.recalculation.formulas import formula_of
from reports.recalculation.read import read_grid
from reports.recalculation.sheets import Forms
from reports.shared import workers as room
from reports.shared.gc_pause import uncollected
from reports.shared.resources import samples_dir
from reports.workbook.layout import Cell, Layout
from tests.bench._figure import Figure, costs, interleaved, median, ratio
from tests.bench._process import Cost, kshm, run
from tests.grading.fill import Formula, filled_book
from tools.referees.by_libreoffice import LibreOffice

Changes = dict[str, list[Formula]]

STUDENTS = 10
FEW, MANY = 40, 240
OFFICE = 4


def figures() -> Iterator[Figure]:
    """Figures."""
    workers = len(os.sched_getaffinity(0))
    with tempfile.TemporaryDirectory(prefix="kshm-bench-") as name:
        folder = Path(name)
        started = time.perf_counter()
        register = _issued(folder)
        each = (time.perf_counter() - started) / STUDENTS
        yield Figure("выдача одной рабочей книги", each, "с")
        yield from _assignments(register)
        yield from _own_formulas(register)
        yield _copied(folder)
        books = LibreOffice().converted(_filled(folder, register))
        yield from _forms(books)
        yield from _marking(folder, register, books)
        few, many = _graded(folder, books, FEW), _graded(folder, books, MANY)
        for count, cost in ((FEW, few), (MANY, many)):
            yield from costs(f"проверка {count} книг, процессов {workers}, с их запуском", cost)
        # The start of the processes costs the same for any number of books.
        speed = (MANY - FEW) / (many.wall - few.wall)
        yield Figure("скорость проверки без запуска", speed, "книг/с", "цель 15 на двух ядрах")
        processor = (many.cpu - few.cpu) / (MANY - FEW)
        yield Figure("процессорное время на книгу", processor, "с",
                     f"{workers / processor:.1f} книг/с")  # fmt: skip
        # One early mistake: everything after it is judged by the student's own values.
        wrong = _filled(folder, register, {"omega": ["=regime_speed_rpm*PI()/60"]})
        cost = _graded(folder, wrong * 8, 80, "wrong")
        processor = (cost.cpu - few.cpu + processor * FEW) / 80
        yield Figure("то же с ошибкой в начале работы", processor, "с",
                     f"{workers / processor:.1f} книг/с")  # fmt: skip
        office = _office(books)
        yield Figure("пересчёт книги в LibreOffice без запуска", office, "с",
                     f"{1 / office:.1f} книг/с")  # fmt: skip
        yield Figure("пересчёт в LibreOffice / проверка", speed * office, "раз")


def _issued(folder: Path) -> Register:
    lines = ["Фамилия;Имя"] + [f"Студент{letter};Имя" for letter in "АБВГДЕЖЗКЛ"[:STUDENTS]]
    (folder / "group.csv").write_text("\n".join(lines), encoding="utf-8")
    return issue(
        samples_dir() / "class" / "base.toml",
        folder / "group.csv",
        folder / "issued",
        seed=1,
        secret_file=folder / "key",
    ).register


def _forms(books: list[bytes]) -> Iterator[Figure]:
    """What it saves that sheets which differ in values alone are parsed once for a class."""
    forms = Forms()
    for book in books[:2]:  # a form is kept when it comes again
        read_grid(book, forms)
    times = interleaved(
        {
            "known": lambda: [read_grid(book, forms) for book in books],
            "anew": lambda: [read_grid(book) for book in books],
        },
        rounds=3,
    )
    known, anew = (median(times[word]) / len(books) for word in ("known", "anew"))
    yield Figure("чтение работы, листы разобраны заново", anew, "с")
    yield Figure("чтение работы, формы листов известны", known, "с", f"{anew / known:.1f} раза")


def _marking(folder: Path, register: Register, books: list[bytes]) -> Iterator[Figure]:
    """What it saves that right items are taken at once, garbage later."""
    marker = Marker(register)
    names = [folder / "issued" / book.folder / book.file for book in register.books]
    works = [Submission(path.name, path, None, None) for path in names]

    def marked() -> None:
        for work, book in zip(works, books, strict=True):
            student_page(marker.mark(work, book), register.rubric)

    def paused() -> None:
        with uncollected():
            marked()

    def each_item() -> None:
        with uncollected(), mock.patch.object(verdicts, "proven", lambda evidence: None):
            marked()

    times = interleaved({"here": paused, "items": each_item, "collected": marked})
    now = f"вместо {median(times['here']) / len(books):.3f} с"
    for word, name in (("items", "по каждой строке правила"),
                       ("collected", "сборщик мусора не ждёт")):  # fmt: skip
        yield Figure(f"проверка в памяти, {name}", ratio(times, word, "here"), "раз", now)


def _own_formulas(register: Register) -> Iterator[Figure]:
    """What it saves that a column's formulas are read from its first two rows and the last."""
    assignment = assignment_for(register.books[0], register.rubric)
    layout, nodes = Layout.of(assignment.kept_model), assignment.fill_nodes | assignment.live_nodes
    filled_down = restoring._filled_down

    def each(text: str, cells: list[Cell]) -> tuple[Read, ...]:
        return tuple(filled_down(text, [cell])[0] for cell in cells)

    def read(way: object) -> None:
        formula_of.cache_clear()
        with mock.patch.object(restoring, "_filled_down", way):
            restoring.own_formulas(assignment, layout, nodes)

    times = interleaved({"two": lambda: read(filled_down), "each": lambda: read(each)})
    yield Figure("формулы программы, прочитаны строка за строкой", median(times["each"]), "с")
    yield Figure("формулы программы, прочитаны по двум строкам", median(times["two"]), "с",
                 f"{ratio(times, 'each', 'two'):.1f} раза")  # fmt: skip


def _assignments(register: Register) -> Iterator[Figure]:
    """What it saves that the tables of a class are made once."""
    like = assignment_for(register.books[0], register.rubric)
    for words, known in (("заново", None), ("по образцу первой", like)):
        started = time.process_time()
        for book in register.books:
            assignment = assignment_for(book, register.rubric, known)
            assert assignment.items and assignment.points and assignment.fill_nodes
        each = (time.process_time() - started) / len(register.books)
        yield Figure(f"таблицы работы {words}", each, "с")


def _copied(folder: Path) -> Figure:
    """What it saves that a process is copied from one that has imported what it needs."""

    def started() -> None:
        begun = room.Workers(1, pool._marking, folder / "issued", needs=pool._NEEDS)
        with begun as workers, suppress(RuntimeError):  # no submission, but an answer
            workers.ask(None, seconds=60).result()

    def importing() -> None:
        spawn = multiprocessing.get_context("spawn")
        with mock.patch.object(room, "processes", lambda needs: spawn):
            started()

    times = interleaved({"copied": started, "importing": importing}, 5, time.perf_counter)
    gained = ratio(times, "copied", "importing")
    return Figure("следующий процесс проверки копией / с импортом", gained, "раз",
                  f"{median(times['copied']):.2f} с")  # fmt: skip


def _filled(folder: Path, register: Register, changes: Changes | None = None) -> list[bytes]:
    """The work-books with the solved book's formulas."""
    return [
        filled_book(
            (folder / "issued" / book.folder / book.file).read_bytes(),
            assignment_for(book, register.rubric),
            changes,
        )
        for book in register.books
    ]


def _graded(folder: Path, books: list[bytes], count: int, mark: str = "") -> Cost:
    """Cost of the command for so many books; all of them are right where nothing is marked."""
    path, out = folder / f"submitted{mark}{count}", folder / f"graded{mark}{count}"
    path.mkdir()
    for i in range(count):
        (path / f"{i:05d}.xlsx").write_bytes(books[i % len(books)])
    command = kshm("grade", str(folder / "issued"), str(path), "-o", str(out),
                   "--secret", str(folder / "key"))  # fmt: skip
    cost = run(command)
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    assert (summary["mean"] == summary["maximum"]) == (not mark), summary["mean"]
    return cost


def _office(books: list[bytes]) -> float:
    """Seconds of LibreOffice for one book more."""
    times = []
    for count in (1, 1 + OFFICE):
        started = time.perf_counter()
        LibreOffice().converted(books[:count])
        times.append(time.perf_counter() - started)
    return (times[1] - times[0]) / OFFICE
