"""Validation book as HTML, PDF, CSV and Markdown."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from markupsafe import Markup

from kshm.mechanics.strength import EYE_M0, EYE_N0, between, eye_forces
from reports.document.page.blocks import DocumentInfo, TableBlock, TableColumn, table_block
from reports.document.page.numbering import Draft, Heading, Label
from reports.document.page.render import render_pdf
from reports.document.text.texts import rich, spaces_inside
from reports.exports.numbers import neutralised
from reports.shared.errors import SystemPartMissing
from reports.shared.files import make_dir, write_bytes, write_text
from reports.shared.progress import Progress
from reports.shared.russian import capital, fixed
from reports.studies import validation_workbook as shown
from reports.studies.validation_checks import Check, Verdict
from reports.studies.validation_registry import SHORT, SOURCES
from reports.studies.validation_workbook import WORDS, Book, Checked, Counts, validate

_TITLE = "Книга сверки с печатными источниками"
_LOWERED = re.compile("([₀-₉ⱼ]+)")
_PLAIN = str.maketrans("₀₁₂₃₄₅₆₇₈₉ⱼ", "0123456789j")
_MANY = 8  # columns from which a grid is set smaller
_KINDS = (Verdict.MISPRINT, Verdict.OTHER_RUN, Verdict.NOT_REPRODUCED)
COUNT_HEADS = ("чисел", "совпадает", "до знака", "опечаток", "другой расчёт", "не воспр.")
_HEAD = """# Сверка с печатными источниками

> In English: every printed table and number of the sources that the software covers,
> recomputed; what deviates is a misprint, belongs to another run or cannot be reproduced, each with
> its reason. Generated from the data of `kshm validate`, which also lists the numbers that agree.

Файл составлен командой `./run docs`; тест следит, чтобы он не устарел. Все числа по одному, с
отклонением и допуском, даёт `kshm validate -o DIR` (`validation.html`, `validation.pdf`,
`validation.csv`). Печатные числа и записанные причины лежат в `reports/studies/data/`, что чем
считается — в `reports/studies/validation_registry.py`.

«Совпадает» — в пределах допуска таблицы, он назван у каждой; «до знака» — расчёт, округлённый до
напечатанных знаков, отличается не больше чем на половину последнего."""
_FITS = """
## Прочность деталей: формулы и статика

Печатного примера расчёта прочности деталей нет, формулы записаны по памяти (Колчин, Демидов) и с
изданием не сверены. Вторая запись, `kshm/mechanics/strength.py`, где может, идёт от статики: втулка
(кольца Ламе), стержень (Эйлер), кручение щеки (ряд Сен-Венана) и запасы прочности с книгой
совпадают. Остальное тесты сверяют с балками и кольцами: изгиб пальца — до округления 12π/32 до 1,2
(1,8 %), срез — до 0,85 вместо 8/(3π) (0,2 %); днище лежит между заделанной (0,75) и опёртой
(1,24) пластинами; овализация тонкого кольца — того же порядка. Знак M₀ сжатой головки взят по
статике. Коэффициенты верхней головки — приближения: прямая для M₀ завышает его вдесятеро у 100°,
впятеро у 105° и сходится с брусом только у 90° и 130°.
"""
_ANGLES = (90, 100, 105, 110, 115, 120, 125, 130)
_NUMBER_HEADS = ("число", "в книге", "у нас", "отклонение", "допуск", "вердикт")
HEAD = (
    "источник", "таблица", "место", "строка", "столбец", "что",
    "в книге", "у нас", "отклонение", "допуск", "вердикт", "должно быть", "причина",
)  # fmt: skip
Kind = Literal["csv", "html", "pdf"]
KINDS: tuple[Kind, ...] = ("csv", "html", "pdf")


@dataclass(frozen=True, slots=True)
class NumberedTable:
    """A table to set: its block, number, caption and size."""

    block: TableBlock
    label: Label
    caption: str
    size: str = "dense"


@dataclass(frozen=True, slots=True)
class TableSection:
    """A printed table in the book: heading, what computes it, notes, our tables."""

    heading: Heading
    checked: Checked
    run: Markup
    tolerance: str
    notes: tuple[Markup, ...]
    tables: tuple[NumberedTable, ...]


@dataclass(frozen=True, slots=True)
class SourceChapter:
    """A source with its sections."""

    heading: Heading
    source: str
    counts: Counts
    sections: tuple[TableSection, ...]


class _Setter:
    """Numbers headings and tables in the order in which they are made."""

    def __init__(self) -> None:
        self.numbering = Draft()

    def place(
        self, key: str, block: TableBlock, caption: str, size: str = "dense"
    ) -> NumberedTable:
        return NumberedTable(block, self.numbering.place("table", key), caption, size)

    def chapter(self, source: str, book: Book) -> SourceChapter:
        heading = self.numbering.section(1, SHORT[source])
        sections = tuple(self.section(checked) for checked in book.of(source))
        return SourceChapter(heading, SOURCES[source], book.counts_of(source), sections)

    def section(self, checked: Checked) -> TableSection:
        table = checked.table
        source_place = capital(table.place)
        heading = self.numbering.section(2, f"{source_place}: {table.title}")
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
        return TableSection(heading, checked, run, table.tolerance.why, notes, tuple(tables))


def validation_page(book: Book, *, media: Literal["print", "screen"]) -> str:
    """Return the whole page with style sheet and fonts inside."""
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
    """Return counts in the columns of the summaries."""
    numbers = [counts.total, counts.agrees, counts.close]
    numbers += [counts.by_verdict[kind] for kind in _KINDS]
    return [str(number) for number in numbers]


def _count_columns(first: str, width: float) -> list[TableColumn]:
    return [TableColumn(first, width, text=True), *(TableColumn(head) for head in COUNT_HEADS)]


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
    heads = [TableColumn("Строка", 0.9), TableColumn("Столбец", 1.4)] if with_column else [
        TableColumn("Число", 3.0, text=True)
    ]  # fmt: skip
    columns = [
        *heads, TableColumn("В книге", 1.3), TableColumn("У нас", 1.4),
        TableColumn("Отклонение", 1.7),
        TableColumn("Допуск", 1.2), TableColumn("Вердикт", 3.4, text=True),
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
    """Return a text whose lowered signs, which the font lacks, are real subscripts."""
    parts = _LOWERED.split(text)
    return Markup("").join(
        Markup("<sub>{}</sub>").format(part.translate(_PLAIN)) if index % 2 else rich(part)
        for index, part in enumerate(parts)
    )


def _grid(checked: Checked) -> TableBlock:
    """Return the table as printed, in each cell the book's number above ours."""
    keys = list(dict.fromkeys(check.cell.column for check in checked.checks))
    rows: dict[str, dict[str, Check]] = {}
    for check in checked.checks:
        rows.setdefault(check.cell.row, {})[check.cell.column] = check
    columns = [TableColumn(shown.row_title(checked.table.id), 0.7)]
    columns += [TableColumn(_lowered(shown.column_head(key))) for key in keys]
    cells = []
    for row in rows.values():
        first = shown.row_head(next(iter(row.values())))
        cells.append([first, *(_cell(row[key]) if key in row else "" for key in keys)])
    return table_block(columns, cells)


def _cell(check: Check) -> Markup:
    word = Markup("")
    if shown.is_marked(check):
        word = Markup("<b>{}</b>").format(WORDS[check.verdict])
    ours, book = shown.ours(check), shown.printed(check)
    if check.printed is None and not shown.is_marked(check):
        # A sign or an empty place that is the same needs no second line.
        return Markup("{}").format("" if book == shown.EMPTY else book)
    if not shown.is_marked(check):
        return Markup("{}<br>{}").format(book, ours)  # spans cost as much as the cell itself
    return Markup('<span class="pair {}">{}<i>{}</i>{}</span>').format(
        check.verdict.value, book, ours, word
    )


def markdown(book: Book) -> str:
    """Return the page as Markdown; the same data give the same text."""
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
    yield from _strength()


def _strength() -> Iterator[str]:
    """How far the fits of the eye are from the curved beam, at each embedding."""
    yield _FITS
    rows = []
    for angle in _ANGLES:
        beams = [*eye_forces(math.radians(angle), drawn=True),
                 *eye_forces(math.radians(angle), drawn=False)]  # fmt: skip
        fits = [0.572 - 0.0008 * angle, 0.00033 * angle - 0.0297,
                float(between(angle, EYE_N0)), -float(between(angle, EYE_M0))]  # fmt: skip
        pairs = zip(beams, fits, (4, 5, 5, 5), strict=True)
        rows.append([f"{angle}°", *(f"{fixed(beam + 0.0, n)} ({fixed(fit + 0.0, n)})"
                                    for beam, fit, n in pairs)])  # fmt: skip
    heads = ("φз", "растяжение N₀/P: брус (формула)", "M₀/(Pr)", "сжатие N₀/P", "M₀/(Pr)")
    yield from _table(heads, rows)


def _section(checked: Checked) -> Iterator[str]:
    table = checked.table
    source_place = capital(table.place)
    yield ""
    yield f"### {source_place}: {table.title}"
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
            [
                shown.row_head(check),
                shown.column_head(check.cell.column),
                *_row(check)[1:],
            ]
            for check in checked.deviating
        ]
        yield from _table(heads, rows)


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


def listing(book: Book) -> str:
    """All checks as CSV: decimal point, comma, angles with minutes in minutes."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(HEAD)
    for check in book.checks:
        writer.writerow(_listed(check))
    return stream.getvalue()


def _listed(check: Check) -> list[str]:
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


def write(folder: Path, kinds: tuple[Kind, ...]) -> tuple[Book, list[Path], str]:
    """Write the book.

    Returns:
        The book, the files, and why the PDF is missing (one Russian line, or empty).

    Raises:
        OutputError: the folder cannot be written.
    """
    make_dir(folder)
    files = []
    missing = ""
    with Progress("Пересчёт печатных таблиц") as progress:
        book = validate()
        for kind in kinds:
            target = folder / f"validation.{kind}"
            if kind == "csv":
                write_text(target, listing(book))
            elif kind == "html":
                write_text(target, validation_page(book, media="screen"))
            else:
                progress.step("Книга сверки PDF")
                try:
                    write_bytes(target, render_pdf(validation_page(book, media="print")))
                except SystemPartMissing as error:
                    missing = "\n".join(error.lines())
                    continue
            files.append(target)
    return book, files, missing
