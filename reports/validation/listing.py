"""``validation.csv``: every printed number on a line."""

from __future__ import annotations

import csv
import io

from reports.exports.numbers import neutralised
from reports.validation.book import WORDS, Book
from reports.validation.checks import Check
from reports.validation.registry import SHORT

HEAD = (
    "источник", "таблица", "место", "строка", "столбец", "что",
    "в книге", "у нас", "отклонение", "допуск", "вердикт", "должно быть", "причина",
)  # fmt: skip


def listing(book: Book) -> str:
    """All checks as CSV: decimal point, comma, angles with minutes in minutes."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(HEAD)
    for check in book.checks:
        writer.writerow(_row(check))
    return stream.getvalue()


def _row(check: Check) -> list[str]:
    table, cell = check.table, check.cell
    is_number = check.printed is not None
    return [
        SHORT[table.source],
        table.id,
        table.place,
        cell.row,
        cell.column,
        cell.what,
        cell.text if is_number else neutralised(cell.text),
        neutralised(check.ours) if isinstance(check.ours, str) else f"{check.ours:.10g}",
        _number(check.deviation),
        _number(check.tolerance),
        WORDS[check.verdict],
        check.should_be,
        check.reason,
    ]


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.6g}"
