"""Chapters that books say themselves, docs/books.md."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from markupsafe import Markup, escape

from reports.document.chapters.chapter import Chapter
from reports.document.chapters.record import Write
from reports.document.page.blocks import TableBlock, TableColumn, grid_table, table_block
from reports.document.page.numbering import Figure, TablePlan
from reports.document.text.symbols import titled_html
from reports.document.text.terms import Terms
from reports.formula.numeric import evaluate
from reports.model.blocks import BookChapter, Grid, Held, ScalarTable, TableSpec, TextLine
from reports.model.book_text import cause_of, shelf_of
from reports.model.context import CASE_MARK, MARK
from reports.shared.errors import BookError, KshmError, NotPrintable
from reports.shared.russian import capital, fixed, uncapital
from reports.shared.standing import WORDS, Standing
from reports.tables.verdicts import JudgedValue, outcomes

_KINDS = {"tab": "table", "fig": "figure", "src": "source"}
_FOLLOWS = {"table": "Значения — в таблице {}.", "figure": "Кривые — на рисунке {}."}
_SPARE = "взято с запасом"  # of a value below the usual
_RANGED = 2  # decimals of values beside their usual limits
_MEMBER = re.compile(r"(least|largest) (\w*@\w*)")


def own(chapter: Chapter) -> Markup:
    """All chapters of own books; nothing where there are none."""
    return Markup("\n").join(
        _Telling(chapter, each).whole() for each in chapter.model.chapters if not each.name
    )


def told(name: str) -> Write:
    """Return a writer of the chapter of the report that a book of the house says."""

    def write(chapter: Chapter) -> Markup:
        return Markup("\n").join(
            _Telling(chapter, each).whole() for each in chapter.model.chapters if each.name == name
        )

    return write


@dataclass
class _Telling:
    """A chapter as far as it is told: what its text has named, the member that it is about."""

    chapter: Chapter
    declared: BookChapter
    named: set[str] = field(default_factory=set)
    member: str = "@"

    def whole(self) -> Markup:
        """Return heading and all lines."""
        parts = [self.chapter.heading(1, self.declared.title)]
        for line in self.declared.lines:
            try:
                text = line.text.replace("@", self.member)
                self.named |= {key for word, key in MARK.findall(text) if word in _KINDS}
                parts += getattr(self, f"_{line.kind}")(text)
            except KshmError:
                raise
            except Exception as error:
                raise self._fault(line, error) from error
        return Markup("\n").join(parts)

    def _fault(self, line: TextLine, error: Exception) -> BookError:
        book = shelf_of(self.chapter.input.books).called(line.book)
        problem = f"строка главы не печатается: {cause_of(error)}"
        return BookError(book, line.number, 1, problem, "проверьте, что она называет")

    def _paragraph(self, text: str) -> Iterator[Markup]:
        """A paragraph; one that begins with a small letter goes on with the sentence above."""
        said = self._of_cases(text).strip()
        if said:
            manner = Markup(' class="flush"') if said[0].islower() else ""
            yield Markup("<p{}>{}</p>").format(manner, self._said(said))

    def _heading(self, text: str) -> Iterator[Markup]:
        yield self.chapter.heading(2, text)

    def _formula(self, text: str) -> Iterator[Markup]:
        """A scalar's formula with its numbers, a column's in symbols; a choice is its result."""
        chapter, key = self.chapter, text.strip().rstrip(",;.")
        end = text.strip()[len(key) :] or "."
        try:
            yield (chapter.eq(key, chapter.example, end) if "." in key else chapter.full(key, end))
        except NotPrintable:
            tex = f"{chapter.terms.tex(key)} = {chapter.terms.result_tex(key)}"
            yield chapter.writer.formula(tex)

    def _show(self, text: str) -> Iterator[Markup]:
        """Yield a block or a chart; what the text has not named yet is named before it."""
        key, _, caption = text.strip().partition(": ")
        key, *size = key.split()
        chapter = self.chapter
        view = chapter.views.get(key)
        plan = view(chapter) if view else None
        is_figure = isinstance(plan, Figure) or key in chapter.model.charts_by_id
        kind = "figure" if is_figure else "table"
        if key not in self.named:
            refer = chapter.writer.n.refer(kind, key)  # type: ignore[arg-type]
            yield Markup("<p>{}</p>").format(Markup(_FOLLOWS[kind]).format(refer))
        if isinstance(plan, Figure):
            yield chapter.writer.figure(key, plan)
        elif is_figure:
            yield chapter.chart(key, *map(float, size))
        else:
            table = plan if isinstance(plan, TablePlan) else self._table(key, caption)
            yield chapter.writer.table(key, table)

    def _insert(self, text: str) -> Iterator[Markup]:
        """Yield what the program writes itself."""
        yield self.chapter.inserts[text.strip()](self.chapter)

    def _pick(self, text: str) -> Iterable[Markup]:
        """Turn to the member of a row with the least or the largest value."""
        match = _MEMBER.fullmatch(text.strip())
        if match is None:
            raise ValueError("пишите pick least КЛЮЧ@ или pick largest КЛЮЧ@")
        terms, numbers = self.chapter.terms, list[float]()
        while terms.has(match[2].replace("@", str(len(numbers) + 1))):
            numbers.append(terms.value(match[2].replace("@", str(len(numbers) + 1))))
        at = np.argmin(numbers) if match[1] == "least" else np.argmax(numbers)
        self.member = str(int(at) + 1)
        return ()

    def _mend(self, _: str) -> Iterable[Markup]:
        """Say nothing: a mend is told where its value is beyond its limits."""
        return ()

    def _table(self, key: str, caption: str) -> TablePlan:
        """Return the table of a block as its kind has it."""
        chapter = self.chapter
        block = next(block for block in chapter.model.blocks if block.id == key)
        if isinstance(block, TableSpec):
            step = chapter.table_step if block.step is None else 0.0
            return chapter.columns(key, step=step, caption=caption)
        caption = caption or block.title
        if isinstance(block, Grid):
            return TablePlan(partial(grid_table, chapter.terms, block), caption)
        if block.held is Held.USUAL:
            return TablePlan(partial(_usual_table, chapter, block), caption)
        values = chapter.terms.values.scalars
        numbers = [s.key for s in block.scalars if not isinstance(values[s.key], str)]
        return chapter.scalars(caption, numbers)

    def _of_cases(self, text: str) -> str:
        """Return a text without the parts whose condition does not hold."""
        parts, holds, start = list[str](), [True], 0
        for mark in CASE_MARK.finditer(text):
            parts += [text[start : mark.start()]] * all(holds)
            start = mark.end()
            if mark[3] and len(holds) > 1:
                holds.pop()
            elif mark[3]:
                raise ValueError("у end нет условия")
            else:
                holds.append(self._holds(mark[1], mark[2]))
        if len(holds) > 1:
            raise ValueError("у условия нет {{ end }}")
        return "".join([*parts, text[start:]])

    def _holds(self, word: str, text: str) -> bool:
        if word == "when":
            return bool(evaluate(text, self.chapter.terms.value))
        return any(self._beyond(text)) == (word == "outside")

    def _beyond(self, name: str) -> list[JudgedValue]:
        """Values of a list that are beyond their limits."""
        terms = self.chapter.terms
        return [each for each in outcomes(terms.model, terms.values.scalars)
                if each.block == name and each.standing is not Standing.INSIDE]  # fmt: skip

    def _mended(self, name: str) -> str:
        """Values beyond their limits, each with what mends it."""
        mends = dict(line.text.split(" ", 1) for line in self.declared.lines if line.kind == "mend")
        spare, scalars = {Standing.BELOW: _SPARE}, self.chapter.model.scalars
        return "; ".join(
            f"{uncapital(scalars[each.key].note)} ({spare.get(each.standing) or mends[each.name]})"
            for each in self._beyond(name)
        )

    def _said(self, text: str) -> Markup:
        """Return a paragraph with its keys replaced by what they stand for."""
        return Markup(MARK.sub(self._put, str(escape(text))))

    def _put(self, match: re.Match[str]) -> str:
        word, key = match.groups()
        terms, numbering = self.chapter.terms, self.chapter.writer.n
        if word == "src":
            return str(numbering.src(key))
        if word in _KINDS:
            return str(numbering.refer(_KINDS[word], key))  # type: ignore[arg-type]
        if word == "beyond":
            return str(titled_html(self._mended(key)))
        value = terms.values.scalars.get(key)
        return str(escape(value) if isinstance(value, str) else getattr(terms, word)(key))


def _usual_table(chapter: Chapter, block: ScalarTable) -> TableBlock:
    """Values beside what is usual."""
    terms = chapter.terms
    judged = {each.key: each for each in outcomes(terms.model, terms.values.scalars)}
    rows = [
        [titled_html(capital(verdict.united)), _ranged(terms, judged[verdict.key]),
         verdict.span_text, WORDS[judged[verdict.key].standing]]
        for _, verdict in block.pairs
    ]  # fmt: skip
    return table_block(
        [TableColumn("Величина", 4.2, text=True), TableColumn("Значение", 1.4),
         TableColumn("Обычно", 1.8), TableColumn("Вывод", 1.8)], rows,
    )  # fmt: skip


def _ranged(terms: Terms, each: JudgedValue) -> str:
    """Return a value with the digits of what it is, where it is a value of the tables."""
    of = str(each.scalar.expr)
    return terms.num(of) if terms.has(of) else fixed(each.value, _RANGED)
