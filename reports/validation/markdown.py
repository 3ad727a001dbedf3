"""``docs/validation.md``: counts, deviations and numbers of running text.

``./run docs`` renews it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from reports.shared.russian import capital
from reports.validation import shown
from reports.validation.book import Book, Checked
from reports.validation.checks import Check
from reports.validation.page import COUNT_HEADS, count_cells
from reports.validation.registry import SHORT, SOURCES

_HEAD = """# Сверка с печатными источниками

> In English: every printed table and number of the sources that the software covers,
> recomputed; what deviates is a misprint, belongs to another run or cannot be reproduced, each with
> its reason. Generated from the data of `kshm validate`, which also lists the numbers that agree.

Файл составлен командой `./run docs`; тест следит, чтобы он не устарел. Все числа по одному, с
отклонением и допуском, даёт `kshm validate -o DIR` (`validation.html`, `validation.pdf`,
`validation.csv`). Печатные числа и записанные причины лежат в `reports/validation/data/`, что чем
считается — в `reports/validation/registry.py`.

«Совпадает» — в пределах допуска таблицы, он назван у каждой; «до знака» — расчёт, округлённый до
напечатанных знаков, отличается не больше чем на половину последнего."""


def markdown(book: Book) -> str:
    """The page as Markdown; the same data give the same text."""
    return "\n".join(_lines(book)) + "\n"


def _lines(book: Book) -> Iterator[str]:
    yield _HEAD
    yield ""
    yield "## Итоги"
    yield ""
    rows = [[SHORT[source], *count_cells(book.counts_of(source))] for source in SOURCES]
    rows.append(["**Всего**", *count_cells(book.counts)])
    yield from _table(("источник", *COUNT_HEADS), rows)
    yield ""
    yield shown.apart(book.counts)
    for source, title in SOURCES.items():
        yield ""
        yield f"## {SHORT[source]}"
        yield ""
        yield f"{title}."
        yield ""
        tables = book.of(source)
        rows = [[one.table.place, one.table.title, *count_cells(one.counts)] for one in tables]
        yield from _table(("где", "что", *COUNT_HEADS), rows)
        for checked in tables:
            yield from _section(checked)


def _section(checked: Checked) -> Iterator[str]:
    table = checked.table
    place = capital(table.place)
    yield ""
    yield f"### {place}: {table.title}"
    yield ""
    yield f"Считает: {table.run}. Допуск: {table.tolerance.why}."
    for note in table.notes:
        yield ""
        yield note
    if checked.is_text:
        yield ""
        yield from _table(_NUMBER_HEADS, [_row(check) for check in checked.checks])
    elif checked.deviating:
        yield ""
        heads = ("строка", "столбец", *_NUMBER_HEADS[1:])
        rows = [
            [shown.row_head(check), shown.column_head(check.cell.column), *_row(check)[1:]]
            for check in checked.deviating
        ]
        yield from _table(heads, rows)


_NUMBER_HEADS = ("число", "в книге", "у нас", "отклонение", "допуск", "вердикт")


def _row(check: Check) -> list[str]:
    return [
        shown.row_head(check), shown.printed(check), shown.ours(check),
        shown.deviation(check), shown.tolerance(check), shown.verdict(check),
    ]  # fmt: skip


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    yield "| " + " | ".join(heads) + " |"
    yield "|" + "---|" * len(heads)
    for row in rows:
        yield "| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |"
