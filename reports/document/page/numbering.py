"""Numbers of figures, tables, formulas and sections, and the check that references resolve.

Everything is declared in the order in which it will stand; then the text may refer to it
before or after it appears.  A draft of the text declares what it places.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from markupsafe import Markup, escape

Kind = Literal["figure", "table", "formula", "source"]
Name = tuple[Kind, str]

# What a kind is called and how its anchors begin.
_WORDS: dict[Kind, tuple[str, str]] = {
    "figure": ("рисунок", "ris"),
    "table": ("таблица", "tab"),
    "formula": ("формула", "eq"),
    "source": ("источник", "src"),
}


class NumberingError(ValueError):
    """A reference, a placing or a declaration does not fit the others."""


@dataclass(frozen=True, slots=True)
class Label:
    """A number handed out: what it numbers, its key, the number and the anchor in HTML."""

    kind: Kind
    key: str
    number: str
    anchor: str

    def __str__(self) -> str:
        """What it is, its number and key, for messages."""
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
    ) -> None:
        self._by_chapter = by_chapter
        self._labels: dict[Name, Label] = dict(labels or {})
        self._elsewhere = dict(elsewhere or {})
        self._counts: Counter[tuple[Kind, int]] = Counter()
        self._referred: set[Name] = set()
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
        """Number as a link to its thing, for the text: ``<a href="#ris-x">3</a>``.

        What stands in a chapter that is left out has its words instead of a number.
        """
        if (kind, key) not in self._labels and (kind, key) in self._elsewhere:
            return Markup(escape(self._elsewhere[kind, key]))
        label = self.label(kind, key)
        self._referred.add((kind, key))
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
        """Say that the thing stands here, under the number it was declared with.

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
        """Number a heading and note it for the contents.

        Args:
            level: 1 for a chapter, 2 and 3 below it.
            title: Text of the heading.
            numbered: False for «Введение», «Заключение», appendices.
        """
        number = self._next_section(level) if numbered else ""
        heading = Heading(level, number, title, f"sec-h{len(self._headings) + 1}")
        self._headings.append(heading)
        return heading

    def is_cited(self, source: str) -> bool:
        """Whether the text so far refers to a source of the bibliography."""
        return ("source", source) in self._referred

    @property
    def contents(self) -> tuple[Heading, ...]:
        """Headings in the order in which they came."""
        return tuple(self._headings)

    def count(self, kind: Kind) -> int:
        """How many things of a kind stand in the report (for the реферат)."""
        return sum(placed == kind for placed, _ in self._placed)

    def problems(self) -> list[str]:
        """What does not fit: declared but absent, referred to but absent, out of order."""
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
        self._referred.add((kind, key))
        return Markup("?")

    def place(self, kind: Kind, key: str, *, number: str | None = None) -> Label:
        """Declare the thing."""
        return self.declare(kind, key, number=number)

    @property
    def declared(self) -> tuple[Name, ...]:
        """Kind and key of everything that was placed."""
        return tuple(self._labels)

    def numbering(self, elsewhere: Mapping[Name, str] | None = None) -> Numbering:
        """A numbering in which everything is declared.

        Args:
            elsewhere: Words for what stands in chapters that are left out.
        """
        return Numbering(self._labels, elsewhere)


def _ascii(key: str) -> str:
    """Anchor-safe form of a key; distinct keys stay distinct."""
    safe = (c.isascii() and (c.isalnum() or c in "_-") for c in key)
    return "".join(c if ok else f".{ord(c):x}." for c, ok in zip(key, safe, strict=True))
