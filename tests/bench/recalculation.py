"""Recalculating a workbook: formualizer beside LibreOffice.

The book is the textbook's diesel at 10°.  LibreOffice is timed with one book and with
three, so that its start can be taken out, and with a book that keeps its charts.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from unittest import mock

from reports.recalculation import grid
from reports.recalculation.grid import CellColumn, Run
from tests.bench._figure import Figure, interleaved, median, memory, ratio
from tests.bench.workbook import ours
from tools.referees import by_libreoffice
from tools.referees.by_formualizer import Formualizer
from tools.referees.by_libreoffice import LibreOffice, find_soffice

MORE = 2
CELLS = 6000  # of a book that keeps everything in one column


def by_formualizer() -> None:
    """One book."""
    Formualizer().recalculate([ours()])


def with_charts(office: LibreOffice, book: bytes) -> None:
    """One book as it is."""
    with mock.patch.object(by_libreoffice, "without_pictures", lambda book: book):
        office.recalculate([book])


def found_in_column(few: int) -> None:
    """Every cell of a column of unlike formulas, columns of so few looked through one by one."""
    column = CellColumn(runs=[Run("Лист", 2, row, 1, None, "") for row in range(1, CELLS + 1)])
    with mock.patch.object(grid, "_FEW", few):
        for row in range(1, CELLS + 1):
            column.runs_in(row, row)


def figures() -> Iterator[Figure]:
    """Figures."""
    times = interleaved(
        {"order": lambda: found_in_column(grid._FEW), "each": lambda: found_in_column(CELLS)},
        rounds=3,
    )
    yield Figure("столбец из 6000 разных формул, поиск каждой ячейки", median(times["order"]), "с")
    yield Figure("перебором / по порядку", ratio(times, "each", "order"), "раз")
    book, fast = ours(), Formualizer()
    if find_soffice() is None:
        actions = {"formualizer": lambda: fast.recalculate([book])}
    else:
        office = LibreOffice()
        actions = {
            "formualizer": lambda: fast.recalculate([book]),
            "one": lambda: office.recalculate([book]),
            "more": lambda: office.recalculate([book] * (1 + MORE)),
            "charts": lambda: with_charts(office, book),
        }
    times = interleaved(actions, rounds=3, clock=time.perf_counter)
    yield Figure("formualizer", median(times["formualizer"]), "с")
    if "one" in times:
        own = median((b - a) / MORE for a, b in zip(times["one"], times["more"], strict=True))
        yield Figure("LibreOffice с запуском", median(times["one"]), "с")
        yield Figure("LibreOffice с диаграммами", median(times["charts"]), "с")
        yield Figure("LibreOffice, каждая следующая книга", own, "с")
        yield Figure("LibreOffice без запуска / formualizer", own / median(times["formualizer"]),
                     "раз")  # fmt: skip
    yield memory("formualizer с изготовлением книги",
                 "from tests.bench.recalculation import by_formualizer as f; f()")  # fmt: skip
