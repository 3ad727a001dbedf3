"""Chapters that own books say themselves, docs/books.md."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import partial

from markupsafe import Markup, escape

from reports.document.chapters.chapter import Chapter
from reports.document.page.blocks import grid_table
from reports.document.page.numbering import TablePlan
from reports.model.blocks import Grid, OwnChapter, ScalarTable, TableSpec, TextLine
from reports.model.book_text import cause_of, shelf_of
from reports.model.context import MARK
from reports.shared.errors import BookError, KshmError, NotPrintable

_KINDS = {"tab": "table", "fig": "figure"}
_FOLLOWS = {"table": "Значения — в таблице {}.", "figure": "Кривые — на рисунке {}."}


def own(chapter: Chapter) -> Markup:
    """All chapters of own books; nothing where there are none."""
    return Markup("\n").join(_chapter(chapter, each) for each in chapter.model.chapters)


def _chapter(chapter: Chapter, declared: OwnChapter) -> Markup:
    parts = [chapter.writer.heading(1, declared.title)]
    named: set[str] = set()
    for line in declared.lines:
        named |= {key for word, key in MARK.findall(line.text) if word in _KINDS}
        try:
            parts += _LINES[line.kind](chapter, line, named)
        except KshmError:
            raise
        except Exception as error:
            book = shelf_of(chapter.input.books).called(line.book)
            problem = f"строка главы не печатается: {cause_of(error)}"
            raise BookError(book, line.number, 1, problem, "проверьте, что она называет") from error
    return Markup("\n").join(parts)


def _paragraph(chapter: Chapter, line: TextLine, _: set[str]) -> Iterable[Markup]:
    yield Markup("<p>{}</p>").format(_said(chapter, line.text))


def _heading(chapter: Chapter, line: TextLine, _: set[str]) -> Iterable[Markup]:
    yield chapter.writer.heading(2, line.text)


def _formula(chapter: Chapter, line: TextLine, _: set[str]) -> Iterable[Markup]:
    """A scalar's formula with its numbers, a column's in symbols; a choice is its result alone."""
    key = line.text.strip()
    try:
        yield chapter.eq(key, chapter.example, ".") if "." in key else chapter.full(key, ".")
    except NotPrintable:
        yield chapter.writer.formula(f"{chapter.terms.tex(key)} = {chapter.terms.result_tex(key)}")


def _show(chapter: Chapter, line: TextLine, named: set[str]) -> Iterable[Markup]:
    """Yield a block or a chart; what the text has not named yet is named before it."""
    key, refer = line.text.strip(), chapter.writer.n.refer
    kind = "figure" if key in chapter.model.charts_by_id else "table"
    if key not in named:
        yield Markup("<p>{}</p>").format(Markup(_FOLLOWS[kind]).format(refer(kind, key)))  # type: ignore[arg-type]
    if kind == "figure":
        yield chapter.chart(key)
        return
    block = next(block for block in chapter.model.blocks if block.id == key)
    if isinstance(block, TableSpec):
        step = chapter.table_step if block.step is None else 0.0
        plan = chapter.columns(key, step=step)
    elif isinstance(block, Grid):
        plan = TablePlan(partial(grid_table, chapter.terms, block), block.title)
    else:
        plan = _list(chapter, block)
    yield chapter.writer.table(key, plan)


def _list(chapter: Chapter, block: ScalarTable) -> TablePlan:
    numbers = [s.key for s in block.scalars if not isinstance(_value(chapter, s.key), str)]
    return chapter.scalars(block.title, numbers)


def _value(chapter: Chapter, key: str) -> float | str:
    return chapter.terms.values.scalars[key]


def _said(chapter: Chapter, text: str) -> Markup:
    """Return a paragraph with its keys replaced by what they stand for."""

    def put(match: re.Match[str]) -> str:
        word, key = match.groups()
        if word in _KINDS:
            return str(chapter.writer.n.refer(_KINDS[word], key))  # type: ignore[arg-type]
        value = chapter.terms.values.scalars.get(key)
        if isinstance(value, str):
            return str(escape(value))
        return str(getattr(chapter.terms, word)(key))

    return Markup(MARK.sub(put, str(escape(text))))


_LINES = {"paragraph": _paragraph, "heading": _heading, "formula": _formula, "show": _show}
