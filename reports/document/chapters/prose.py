"""Chapters that books say themselves, docs/books.md."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial

from markupsafe import Markup, escape

from reports.document.chapters.chapter import Chapter
from reports.document.chapters.record import Write
from reports.document.page.blocks import TableBlock, TableColumn, grid_table, table_block
from reports.document.page.numbering import Figure, TablePlan
from reports.document.text.symbols import inline_html, titled_html
from reports.document.text.terms import Terms, input_text
from reports.formula.numeric import evaluate
from reports.model.blocks import BookChapter, Grid, Held, ScalarTable, TableSpec, TextLine
from reports.model.chapter_source import cause_of, shelf_of
from reports.model.context import CASE_MARK, FREE_MARK, MARK
from reports.shared.errors import BookError, KshmError, NotPrintable, one_line
from reports.shared.russian import capital, fixed, uncapital
from reports.shared.standing import WORDS, Standing
from reports.tables.verdicts import JudgedValue, outcomes

_KINDS = {"tab": "table", "fig": "figure"}
_FOLLOWS = {"table": "Значения — в таблице {}.", "figure": "Кривые — на рисунке {}."}
_SPARE = "взято с запасом"  # of a value below the usual
_RANGED = 2  # decimals of values beside their usual limits
_MEMBER = re.compile(r"(least|largest) (\w*@\w*|\w+\.\w+)")
_MAX_TEX = 1000  # letters of an equation
_DECIMALS = tuple("0123456789")
_TEX = re.compile(r"\$([^$]+)\$")


def told(name: str) -> Write:
    """Return a writer of a chapter that a book of the house says; without a name, of own books."""
    return lambda chapter: Markup("\n").join(each.whole() for each in _tellings(chapter, name))


def concluded(name: str) -> Write:
    """Return a writer of what books conclude, a line of the conclusion."""
    return lambda chapter: Markup("; ").join(
        line for each in _tellings(chapter, name) for line in each.conclusions()
    )


def _tellings(chapter: Chapter, name: str) -> Iterator[_Telling]:
    return (_Telling(chapter, each) for each in chapter.model.chapters if each.name == name)


@dataclass
class _Telling:
    """A chapter as far as it is told: what its text has named, the member that it is about."""

    chapter: Chapter
    declared: BookChapter
    named: set[str] = field(default_factory=set)
    member: str = "@"
    equations: int = 0

    def whole(self) -> Markup:
        """Return heading and all lines."""
        parts = [self.chapter.heading(1, self.declared.title)]
        for line in self.declared.lines:
            with self._faults(line):
                text = self._text(line)
                self.named |= {key for word, key in MARK.findall(text) if word in _KINDS}
                parts += getattr(self, f"_{line.kind}")(text)
        return Markup("\n").join(parts)

    def conclusions(self) -> Iterator[Markup]:
        """Yield what the text concludes, with the members that it picked before."""
        for line in self.declared.lines:
            with self._faults(line):
                if line.kind == "pick":
                    self._pick(line.text)
                elif line.kind == "conclude":
                    yield self._said(self._of_cases(self._text(line)).strip())

    def _text(self, line: TextLine) -> str:
        """Return a line's text of the member at hand; a pick turns from it to another."""
        return line.text if line.kind == "pick" else line.text.replace("@", self.member)

    @contextmanager
    def _faults(self, line: TextLine) -> Iterator[None]:
        """Tell of a mistake where it stands."""
        try:
            yield
        except KshmError:
            raise
        except Exception as error:
            book = shelf_of(self.chapter.input.books).called(line.book)
            problem = f"строка главы не печатается: {cause_of(error)}"
            hint = "проверьте, что она называет"
            raise BookError(book, line.number, 1, problem, hint) from error

    def _paragraph(self, text: str) -> Iterator[Markup]:
        """A paragraph; one that begins with a small letter goes on with the sentence above."""
        said = self._of_cases(text).strip()
        if said:
            manner = Markup(' class="flush"') if said[0].islower() else ""
            yield Markup("<p{}>{}</p>").format(manner, self._said(said))
            if manner and said[-1] == ".":  # here the sentence of the formulas above ends
                yield self.chapter.explained()

    def _heading(self, text: str) -> Iterator[Markup]:
        yield self.chapter.heading(2, text)

    def _formula(self, text: str) -> Iterator[Markup]:
        """A scalar's formula with its numbers, a column's in symbols; a choice is its result."""
        chapter, key = self.chapter, text.strip().rstrip(",;.")
        end = text.strip()[len(key) :] or "."
        try:
            yield (chapter.eq(key, self._row_of(key), end) if "." in key
                   else chapter.full(key, end))  # fmt: skip
        except NotPrintable:
            tex = f"{chapter.terms.tex(key)} = {chapter.terms.result_tex(key)}"
            yield chapter.writer.formula(tex)

    def _row_of(self, column: str) -> float:
        """Return the row whose formula is printed: of the example, else in the middle."""
        example, rows = self.chapter.example, self._rows(column)
        return example if rows[0] <= example <= rows[-1] else rows[len(rows) // 2]

    def _rows(self, column: str) -> Sequence[float]:
        return self.chapter.model.tables[column.partition(".")[0]].rows

    def _equation(self, text: str) -> Iterator[Markup]:
        """Yield a formula in symbols alone, which holds no quantity of the tables."""
        if len(text) > _MAX_TEX:
            raise ValueError(f"формула длиннее {_MAX_TEX} знаков")
        self.equations += 1
        tex, key = text.strip().rstrip(",;."), f"{self.declared.title}:{self.equations}"
        yield self.chapter.writer.formula(tex, key, text.strip()[len(tex) :] or ".")

    def _where(self, text: str) -> Iterator[Markup]:
        """Yield what the symbols of the formulas above mean."""
        yield self.chapter.where(*text.split())

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
        """Turn to the member, or the row of a table, with the least or the largest value."""
        match = _MEMBER.fullmatch(text.strip())
        if match is None:
            raise ValueError("пишите pick least КЛЮЧ@ или pick largest ТАБЛИЦА.СТОЛБЕЦ")
        numbers = self._members(match[2])
        self.member = (min if match[1] == "least" else max)(numbers, key=lambda n: numbers[n])
        return ()

    def _members(self, key: str) -> dict[str, float]:
        """Values of the members of a row, or of a column's rows, by their numbers."""
        terms = self.chapter.terms
        if "." in key:
            rows = zip(self._rows(key), terms.column(key), strict=True)
            return {f"{row:g}": float(value) for row, value in rows}
        alike = re.compile(key.replace("@", r"(\d+)"))
        matches = filter(None, map(alike.fullmatch, terms.values.scalars))
        return {match[1]: terms.value(match[0]) for match in matches}

    def _unsaid(self, _: str) -> Iterable[Markup]:
        """Say nothing: the words are said where they are asked for."""
        return ()

    _member = _mend = _conclude = _unsaid

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
            if mark[3] and len(holds) == 1:
                raise ValueError(f"у {mark[3]} нет условия")
            if mark[3] == "otherwise":
                holds[-1] = not holds[-1]
            elif mark[3]:
                holds.pop()
            else:
                holds.append(self._holds(mark[1], mark[2]))
        if len(holds) > 1:
            raise ValueError("у условия нет {{ end }}")
        return "".join([*parts, text[start:]])

    def _holds(self, word: str, text: str) -> bool:
        if word == "when":
            return bool(self._calculated(text))
        return any(self._beyond(text)) == (word == "outside")

    def _calculated(self, formula: str) -> float:
        """Value of a formula of scalars and columns."""
        terms = self.chapter.terms
        return float(
            evaluate(formula, lambda key: (terms.column if "." in key else terms.value)(key))
        )

    def _beyond(self, name: str) -> list[JudgedValue]:
        """Values of a list that are beyond their limits."""
        terms = self.chapter.terms
        return [each for each in outcomes(terms.model, terms.values.scalars)
                if each.block == name and each.standing is not Standing.INSIDE]  # fmt: skip

    def _mended(self, name: str) -> str:
        """Values beyond their limits, each with what mends it."""
        mends = self._words("mend")
        spare, scalars = {Standing.BELOW: _SPARE}, self.chapter.model.scalars
        return "; ".join(
            uncapital(scalars[each.key].note)
            + (f" ({spare.get(each.standing) or mends[each.name]})" if mends else "")
            for each in self._beyond(name)
        )

    def _words(self, kind: str) -> dict[str, str]:
        """Words of the lines of a kind, by what they are about."""
        return dict(line.text.split(" ", 1) for line in self.declared.lines if line.kind == kind)

    def _said(self, text: str) -> Markup:
        """Return a paragraph with its keys and symbols replaced by what they stand for."""
        pieces = _TEX.split(text)  # every second one is a symbol
        said = "".join(str((escape, inline_html)[n % 2](piece)) for n, piece in enumerate(pieces))
        return Markup(MARK.sub(self._put, FREE_MARK.sub(self._put_free, said)))

    def _put_free(self, match: re.Match[str]) -> str:
        word, text = match[1], Markup(match[2]).unescape()
        if word == "src":
            return str(self.chapter.writer.n.src(*text.split()))
        if word == "book":
            return str(self.chapter.book(place=text))
        decimals, _, formula = text.partition(" ")
        if decimals not in _DECIMALS:
            raise ValueError(f"знаков у calc «{one_line(decimals, 20)}», а можно от 0 до 9")
        return fixed(self._calculated(formula), int(decimals))

    def _put(self, match: re.Match[str]) -> str:
        word, key = match.groups()
        terms, numbering = self.chapter.terms, self.chapter.writer.n
        if word in _KINDS:
            return str(numbering.refer(_KINDS[word], key))  # type: ignore[arg-type]
        if word == "title":
            return str(titled_html(terms.title(key)))
        if word == "beyond":
            return str(titled_html(self._mended(key)))
        if word == "member":
            return str(escape(self._words(word)[key]))
        field = terms.model.fields.get(key)
        value = input_text(field) if field and field.choices else terms.values.scalars.get(key)
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
