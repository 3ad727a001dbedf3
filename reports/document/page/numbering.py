"""Numbers of headings, formulas, tables and figures; the writer that gives them out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from markupsafe import Markup, escape

from reports.document.page.blocks import TableBlock
from reports.document.text.terms import WhereItem
from reports.shared.errors import NumberingError

if TYPE_CHECKING:
    from jinja2 import Environment

Kind = Literal["figure", "table", "formula", "source"]
Name = tuple[Kind, str]

# What a kind is called and how its anchors begin.
_WORDS: dict[Kind, tuple[str, str]] = {
    "figure": ("рисунок", "ris"),
    "table": ("таблица", "tab"),
    "formula": ("формула", "eq"),
    "source": ("источник", "src"),
}
_KEPT_ROWS = 10  # a longer table that must not break would leave half a page empty


@dataclass(frozen=True, slots=True)
class Label:
    """A number handed out: what it numbers, its key, the number and the anchor in HTML."""

    kind: Kind
    key: str
    number: str
    anchor: str

    def __str__(self) -> str:
        """Return what it is, its number and key, for messages."""
        return f"{_WORDS[self.kind][0]} {self.number} «{self.key}»"


@dataclass(frozen=True, slots=True)
class Heading:
    """A heading for the contents: level 1-3, number ('' for an unnumbered one), title."""

    level: int
    number: str
    title: str
    anchor: str


class Numbering:
    """Registry of numbers of one report.

    Figures, tables, formulas and sources count through the report or, but for the sources,
    within a chapter; an appendix gives its
    numbers itself (``number="П4.1"``).  Sections number themselves by level.
    """

    def __init__(
        self,
        labels: Mapping[Name, Label] | None = None,
        elsewhere: Mapping[Name, str] | None = None,
        *,
        by_chapter: bool = False,
        served: Mapping[Name, str] | None = None,
    ) -> None:
        self._by_chapter = by_chapter
        self._served = dict(served or {})
        self._labels: dict[Name, Label] = dict(labels or {})
        self._elsewhere = dict(elsewhere or {})
        self._counts: Counter[tuple[Kind, int]] = Counter()
        self._referred: dict[Name, None] = {}  # in the order of the first reference
        self._placed: list[Name] = []
        self._early: list[str] = []
        self._section: list[int] = []
        self._headings: list[Heading] = []

    def declare(self, kind: Kind, key: str, *, number: str | None = None) -> Label:
        """Give a thing its number: the next one of its kind, or the one asked for.

        Raises:
            NumberingError: The key or the number was given before.
        """
        word, anchor = _WORDS[kind]
        if (kind, key) in self._labels:
            msg = f"{word} «{key}»: объявлено дважды"
            raise NumberingError(msg)
        if number is None:
            chapter = self._section[0] if self._by_chapter and kind != "source" else 0
            self._counts[kind, chapter] += 1
            number = f"{chapter}.{self._counts[kind, chapter]}".removeprefix("0.")
        for other in self._labels.values():
            if (other.kind, other.number) == (kind, number):
                msg = f"{word} {number}: номер уже у «{other.key}», его просит и «{key}»"
                raise NumberingError(msg)
        label = Label(kind, key, number, f"{anchor}-{_ascii(key)}")
        self._labels[kind, key] = label
        return label

    def stand_for(self, kind: Kind, key: str, other: str) -> None:
        """Note that another thing stands for this one: references lead to it."""
        self._served[kind, key] = other

    def label(self, kind: Kind, key: str) -> Label:
        """Look a number up without counting as a reference.

        Raises:
            NumberingError: Nothing of that name was declared.
        """
        if (kind, key) not in self._labels:
            msg = f"{_WORDS[kind][0]} «{key}»: ссылка на необъявленное"
            raise NumberingError(msg)
        return self._labels[kind, key]

    def refer(self, kind: Kind, key: str) -> Markup:
        """Return the number as a link to its thing, for the text: ``<a href="#ris-x">3</a>``.

        What stands in a chapter that is left out has its words instead of a number.
        """
        key = self._served.get((kind, key), key)
        if (kind, key) not in self._labels and (kind, key) in self._elsewhere:
            return Markup(escape(self._elsewhere[kind, key]))
        label = self.label(kind, key)
        self._referred[kind, key] = None
        return Markup('<a class="ref" href="#{}">{}</a>').format(label.anchor, label.number)

    def fig(self, key: str) -> Markup:
        """Link to a figure: «на рисунке {{ n.fig('path') }}»."""
        return self.refer("figure", key)

    def tab(self, key: str) -> Markup:
        """Link to a table."""
        return self.refer("table", key)

    def eq(self, key: str) -> Markup:
        """Link to a formula with its parentheses."""
        number = self.refer("formula", key)
        return Markup("({})").format(number) if number else number

    def src(self, *keys: str) -> Markup:
        """Links to sources of the bibliography in brackets: «[1, 3]»."""
        return Markup("[{}]").format(Markup(", ").join(self.refer("source", key) for key in keys))

    def place(self, kind: Kind, key: str, *, number: str | None = None) -> Label:
        """Mark the place of a declared thing.

        Raises:
            NumberingError: Not declared, or placed before.
        """
        label = self.label(kind, key)
        if (kind, key) in self._placed:
            msg = f"{label}: помещено дважды"
            raise NumberingError(msg)
        # A chapter that is left out may be the one that names a table of an appendix.
        excused = bool(self._elsewhere) and number is not None
        if (kind, key) not in self._referred and kind in ("figure", "table") and not excused:
            self._early.append(f"{label}: нет ссылки до появления")
        self._placed.append((kind, key))
        return label

    def section(self, level: int, title: str, *, numbered: bool = True) -> Heading:
        """Return the number a heading and note it for the contents.

        Args:
            level: 1 for a chapter, 2 and 3 below it.
            title: Text of the heading.
            numbered: False for «Введение», «Заключение», appendices.
        """
        number = self._next_section(level) if numbered else ""
        heading = Heading(level, number, title, f"sec-h{len(self._headings) + 1}")
        self._headings.append(heading)
        return heading

    @property
    def cited(self) -> tuple[str, ...]:
        """Sources that the text so far refers to, in the order of the first references."""
        return tuple(key for kind, key in self._referred if kind == "source")

    @property
    def contents(self) -> tuple[Heading, ...]:
        """Headings in the order in which they came."""
        return tuple(self._headings)

    def count(self, kind: Kind) -> int:
        """How many things of a kind stand in the report (for the реферат)."""
        return sum(placed == kind for placed, _ in self._placed)

    def problems(self) -> list[str]:
        """Faults: declared but absent, referred to but absent, out of order."""
        problems = list(self._early)
        for name, label in self._labels.items():
            if name not in self._placed:
                said = "есть ссылка" if name in self._referred else "объявлено"
                problems.append(f"{label}: {said}, но в отчёте нет")
        for kind, (word, _) in _WORDS.items():
            declared = [name for name in self._labels if name[0] == kind and name in self._placed]
            if declared != [name for name in self._placed if name[0] == kind]:
                problems.append(f"{word}: порядок в тексте не по номерам")
        return problems

    def check(self) -> None:
        """Raise if :meth:`problems` finds any.

        Raises:
            NumberingError: One line that names every problem.
        """
        problems = self.problems()
        if problems:
            msg = "Нумерация отчёта не сходится: " + "; ".join(problems)
            raise NumberingError(msg)

    def _next_section(self, level: int) -> str:
        if not 1 <= level <= len(self._section) + 1:
            msg = f"раздел уровня {level} стоит без раздела уровнем выше"
            raise NumberingError(msg)
        self._section = [*self._section[:level], 0][:level]
        self._section[level - 1] += 1
        return ".".join(map(str, self._section))


class Draft(Numbering):
    """A numbering of the first pass: declares what is placed and answers every reference."""

    def refer(self, kind: Kind, key: str) -> Markup:
        """No number yet."""
        self._referred[kind, key] = None
        return Markup("?")

    def place(self, kind: Kind, key: str, *, number: str | None = None) -> Label:
        """Declare the thing."""
        return self.declare(kind, key, number=number)

    @property
    def declared(self) -> tuple[Name, ...]:
        """Kind and key of everything that was placed."""
        return (*self._labels, *self._served)

    def numbering(self, elsewhere: Mapping[Name, str] | None = None) -> Numbering:
        """Return a numbering in which everything is declared.

        Args:
            elsewhere: Words for what stands in chapters that are left out.
        """
        return Numbering(self._labels, elsewhere, served=self._served)


def _ascii(key: str) -> str:
    """Anchor-safe form of a key; distinct keys stay distinct."""
    safe = (c.isascii() and (c.isalnum() or c in "_-") for c in key)
    return "".join(c if ok else f".{ord(c):x}." for c, ok in zip(key, safe, strict=True))


@dataclass(frozen=True, slots=True)
class Figure:
    """A figure to draw: what draws it, its caption and alternative text."""

    draw: Callable[[], str]
    caption: str
    alt: str = ""


def drawn(figure: Figure) -> str:
    """Return the figure as SVG."""
    return figure.draw()


@dataclass(frozen=True, slots=True)
class TablePlan:
    """A table to set: what builds it, its caption, own number of an appendix, manner."""

    build: Callable[[], TableBlock]
    caption: str
    number: str | None = None
    size: str = ""
    keep: bool = False
    lined: bool = False


class Writer:
    """Turns calls of the templates into HTML, in draft without the heavy parts."""

    def __init__(self, environment: Environment, numbering: Numbering) -> None:
        self.n = numbering
        self.draft = isinstance(numbering, Draft)
        self.figures: dict[str, Figure] = {}  # that were drawn, by their anchors
        self.formulas: list[str] = []  # that were set, in TeX
        self._macros: Any = environment.get_template("report/macros.html.j2").module

    def heading(
        self, level: int, title: str, *, numbered: bool = True, runon: bool = False
    ) -> Markup:
        """Return a heading for text and contents."""
        item = self.n.section(level, title, numbered=numbered)
        return Markup(self._macros.heading(item, runon=runon))

    def heading_again(self, level: int, title: str, **_: bool) -> Markup:
        """Return the heading of that title once more: its chapter is written anew."""
        items = (item for item in self.n.contents if (item.level, item.title) == (level, title))
        return Markup(self._macros.heading(next(items), runon=False))

    def formula(self, tex: str, key: str | None = None, end: str = "") -> Markup:
        """Return a displayed formula, numbered if it has a key."""
        label = None if key is None else self.n.place("formula", key)
        if self.draft:
            return Markup("")
        self.formulas.append(tex)
        return Markup(self._macros.formula(tex, label, end))

    def where(self, items: Sequence[WhereItem]) -> Markup:
        """Return the «где» list under a formula."""
        return Markup("") if self.draft else Markup(self._macros.where(items))

    def figure(self, key: str, plan: Figure | None) -> Markup:
        """Return a figure with its caption; a draft needs no plan."""
        label = self.n.place("figure", key)
        if self.draft or plan is None:
            return Markup("")
        self.figures[label.anchor] = plan
        return Markup(self._macros.figure(Markup(drawn(plan)), label, plan.caption, plan.alt))

    def table(self, key: str, plan: TablePlan) -> Markup:
        """Return a table with its caption."""
        label = self.n.place("table", key, number=plan.number)
        if self.draft:
            return Markup("")
        block = plan.build()
        keep = plan.keep and len(block.rows) <= _KEPT_ROWS
        manner = {"size": plan.size, "keep": keep, "lined": plan.lined}
        return Markup(self._macros.table(block, label, plan.caption, **manner))

    def sources(self, texts: Iterable[tuple[str, str]]) -> Markup:
        """Return the bibliography: keys and texts."""
        items = [(self.n.place("source", key), text) for key, text in texts]
        return Markup("") if self.draft else Markup(self._macros.bibliography(items))

    def contents(self) -> Markup:
        """Contents from the headings written so far."""
        return Markup(self._macros.contents(self.n.contents))
