"""The validation book as a page: HTML for a browser, the same set on paper as PDF."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from markupsafe import Markup

from reports.document.page.blocks import Column, DocumentInfo, TableBlock, table_block
from reports.document.page.numbering import Draft, Heading, Label
from reports.document.text.texts import rich, spaces_inside
from reports.shared.russian import capital
from reports.validation import shown
from reports.validation.book import WORDS, Book, Checked, Counts
from reports.validation.checks import Check, Verdict
from reports.validation.registry import SHORT, SOURCES

_TITLE = "Книга сверки с печатными источниками"
_LOWERED = re.compile("([₀-₉ⱼ]+)")
_PLAIN = str.maketrans("₀₁₂₃₄₅₆₇₈₉ⱼ", "0123456789j")
_MANY = 8  # columns from which a grid is set smaller
_KINDS = (Verdict.MISPRINT, Verdict.OTHER_RUN, Verdict.NOT_REPRODUCED)


@dataclass(frozen=True, slots=True)
class Placed:
    """A table to set: its block, number, caption and size."""

    block: TableBlock
    label: Label
    caption: str
    size: str = "dense"


@dataclass(frozen=True, slots=True)
class Section:
    """A printed table in the book: heading, what computes it, notes, our tables."""

    heading: Heading
    checked: Checked
    run: Markup
    tolerance: str
    notes: tuple[Markup, ...]
    tables: tuple[Placed, ...]


@dataclass(frozen=True, slots=True)
class Chapter:
    """A source with its sections."""

    heading: Heading
    source: str
    counts: Counts
    sections: tuple[Section, ...]


class _Setter:
    """Numbers headings and tables in the order in which they are made."""

    def __init__(self) -> None:
        self.numbering = Draft()

    def place(self, key: str, block: TableBlock, caption: str, size: str = "dense") -> Placed:
        return Placed(block, self.numbering.place("table", key), caption, size)

    def chapter(self, source: str, book: Book) -> Chapter:
        heading = self.numbering.section(1, SHORT[source])
        sections = tuple(self.section(checked) for checked in book.of(source))
        return Chapter(heading, SOURCES[source], book.counts_of(source), sections)

    def section(self, checked: Checked) -> Section:
        table = checked.table
        place = capital(table.place)
        heading = self.numbering.section(2, f"{place}: {table.title}")
        tables = []
        if checked.is_text:
            tables.append(self.place(table.id, _list(checked.checks), table.place))
        else:
            block = _grid(checked)
            size = "tiny" if len(block.columns) > _MANY else "dense"
            tables.append(self.place(table.id, block, f"{table.place}, в книге и у нас", size))
            if checked.deviating:
                caption = f"{table.place}, отклонения"
                block = _list(checked.deviating, with_column=True)
                tables.append(self.place(f"{table.id}_deviations", block, caption))
        notes = tuple(map(_lowered, table.notes))
        run = _lowered(table.run)
        return Section(heading, checked, run, table.tolerance.why, notes, tuple(tables))


def validation_page(book: Book, *, media: Literal["print", "screen"]) -> str:
    """The whole page with style sheet and fonts inside."""
    from reports.document.page.render import environment

    setter = _Setter()
    heading = setter.numbering.section(1, "Итоги", numbered=False)
    summary = setter.place("summary", _summary(book), "Итоги по источникам")
    by_table = setter.place("by_table", _by_table(book), "Итоги по таблицам")
    chapters = [setter.chapter(source, book) for source in SOURCES]
    page = environment(media=media).get_template("validation/page.html.j2").render(
        doc=DocumentInfo(_TITLE, subject="Печатные числа источников и расчёт"),
        title=_TITLE,
        counts=book.counts,
        apart=shown.apart(book.counts),
        heading=heading,
        summary=summary,
        by_table=by_table,
        chapters=chapters,
        words=WORDS,
    )  # fmt: skip
    return spaces_inside(page)


def count_cells(counts: Counts) -> list[str]:
    """Counts in the columns of the summaries."""
    numbers = [counts.total, counts.agrees, counts.close]
    numbers += [counts.by_verdict[kind] for kind in _KINDS]
    return [str(number) for number in numbers]


COUNT_HEADS = ("чисел", "совпадает", "до знака", "опечаток", "другой расчёт", "не воспр.")


def _count_columns(first: str, width: float) -> list[Column]:
    return [Column(first, width, text=True), *(Column(head) for head in COUNT_HEADS)]


def _summary(book: Book) -> TableBlock:
    rows = [[SHORT[source], *count_cells(book.counts_of(source))] for source in SOURCES]
    rows.append(["Всего", *count_cells(book.counts)])
    return table_block(_count_columns("Источник", 1.6), rows)


def _by_table(book: Book) -> TableBlock:
    rows = [
        [f"{SHORT[one.table.source]}, {one.table.place}", *count_cells(one.counts)]
        for one in book.tables
    ]
    return table_block(_count_columns("Таблица", 2.2), rows)


def _list(checks: tuple[Check, ...], *, with_column: bool = False) -> TableBlock:
    """One check a row: what, book, ours, deviation, tolerance, verdict."""
    what = [Column("Строка", 0.9), Column("Столбец", 1.4)] if with_column else [
        Column("Число", 3.0, text=True)
    ]  # fmt: skip
    columns = [
        *what, Column("В книге", 1.3), Column("У нас", 1.4), Column("Отклонение", 1.7),
        Column("Допуск", 1.2), Column("Вердикт", 3.4, text=True),
    ]  # fmt: skip
    return table_block(columns, [_list_row(check, with_column=with_column) for check in checks])


def _list_row(check: Check, *, with_column: bool) -> list[str]:
    first: list[str] = [_lowered(shown.row_head(check))]
    if with_column:
        first.append(_lowered(shown.column_head(check.cell.column)))
    # Markup keeps numbers of different kinds from being lined up as one column.
    numbers = (shown.printed(check), shown.ours(check), shown.deviation(check),
               shown.tolerance(check))  # fmt: skip
    word = Markup('<span class="word {}">{}</span>').format(
        check.verdict.value, WORDS[check.verdict]
    )
    reason = Markup(": {}").format(_lowered(check.reason)) if check.reason else ""
    return [*first, *(Markup("{}").format(text) for text in numbers), word + reason]


def _lowered(text: str) -> Markup:
    """A text whose lowered signs, which the font lacks, are real subscripts."""
    parts = _LOWERED.split(text)
    return Markup("").join(
        Markup("<sub>{}</sub>").format(part.translate(_PLAIN)) if place % 2 else rich(part)
        for place, part in enumerate(parts)
    )


def _grid(checked: Checked) -> TableBlock:
    """The table as printed, in each cell the book's number above ours."""
    keys = list(dict.fromkeys(check.cell.column for check in checked.checks))
    rows: dict[str, dict[str, Check]] = {}
    for check in checked.checks:
        rows.setdefault(check.cell.row, {})[check.cell.column] = check
    columns = [Column(shown.row_title(checked.table.id), 0.7)]
    columns += [Column(_lowered(shown.column_head(key))) for key in keys]
    cells = []
    for found in rows.values():
        first = shown.row_head(next(iter(found.values())))
        cells.append([first, *(_cell(found[key]) if key in found else "" for key in keys)])
    return table_block(columns, cells)


def _cell(check: Check) -> Markup:
    word = Markup("")
    if shown.is_marked(check):
        word = Markup("<b>{}</b>").format(WORDS[check.verdict])
    ours, book = shown.ours(check), shown.printed(check)
    if check.printed is None and not shown.is_marked(check):
        # A sign or an empty place that is the same needs no second line.
        return Markup("{}").format("" if book == "пусто" else book)
    if not shown.is_marked(check):
        return Markup("{}<br>{}").format(book, ours)  # spans cost as much as the cell itself
    return Markup('<span class="pair {}">{}<i>{}</i>{}</span>').format(
        check.verdict.value, book, ours, word
    )
