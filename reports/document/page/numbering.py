"""Numbers of figures, tables, formulas and sections, and the check that references resolve.

Everything is declared in the order in which it will stand; then the text may refer to it
before or after it appears.  The same object can number the workbook's captions.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from markupsafe import Markup

Kind = Literal["figure", "table", "formula", "section", "source"]

_TITLES: dict[Kind, str] = {
    "figure": "рисунок",
    "table": "таблица",
    "formula": "формула",
    "section": "раздел",
    "source": "источник",
}
_ANCHORS: dict[Kind, str] = {
    "figure": "ris",
    "table": "tab",
    "formula": "eq",
    "section": "sec",
    "source": "src",
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
        """The number alone."""
        return self.number


@dataclass(frozen=True, slots=True)
class Heading:
    """A heading for the contents: level 1-3, number ('' for an unnumbered one), title."""

    level: int
    number: str
    title: str
    anchor: str


class Numbering:
    """Registry of numbers of one report.

    Figures, tables, formulas and sources count through the report; an appendix gives its
    numbers itself (``number="П4.1"``).  Sections number themselves by level.
    """

    def __init__(self) -> None:
        self._labels: dict[tuple[Kind, str], Label] = {}
        self._numbers: dict[tuple[Kind, str], str] = {}
        self._counts: Counter[Kind] = Counter()
        self._referred: Counter[tuple[Kind, str]] = Counter()
        self._placed: list[tuple[Kind, str]] = []
        self._early: list[str] = []
        self._section: list[int] = []
        self._headings: list[Heading] = []

    def declare(self, kind: Kind, key: str, *, number: str | None = None) -> Label:
        """Give a thing its number: the next one of its kind, or the one asked for.

        Raises:
            NumberingError: The key or the number was given before.
        """
        if (kind, key) in self._labels:
            msg = f"{_TITLES[kind]} «{key}»: объявлено дважды"
            raise NumberingError(msg)
        if number is None:
            self._counts[kind] += 1
            number = str(self._counts[kind])
        owner = self._numbers.setdefault((kind, number), key)
        if owner != key:
            msg = f"{_TITLES[kind]} {number}: номер уже у «{owner}», его просит и «{key}»"
            raise NumberingError(msg)
        anchor = f"{_ANCHORS[kind]}-{_ascii(key)}"
        label = Label(kind, key, number, anchor)
        self._labels[kind, key] = label
        return label

    def declare_all(self, kind: Kind, keys: Iterable[str]) -> None:
        """Declare several things in order."""
        for key in keys:
            self.declare(kind, key)

    def label(self, kind: Kind, key: str) -> Label:
        """Look a number up without counting as a reference.

        Raises:
            NumberingError: Nothing of that name was declared.
        """
        try:
            return self._labels[kind, key]
        except KeyError:
            msg = f"{_TITLES[kind]} «{key}»: ссылка на необъявленное"
            raise NumberingError(msg) from None

    def refer(self, kind: Kind, key: str) -> Markup:
        """Number as a link to its thing, for the text: ``<a href="#ris-x">3</a>``."""
        label = self.label(kind, key)
        self._referred[kind, key] += 1
        return Markup('<a class="ref" href="#{}">{}</a>').format(label.anchor, label.number)

    def fig(self, key: str) -> Markup:
        """Link to a figure: «на рисунке {{ n.fig('path') }}»."""
        return self.refer("figure", key)

    def tab(self, key: str) -> Markup:
        """Link to a table."""
        return self.refer("table", key)

    def eq(self, key: str) -> Markup:
        """Link to a formula with its parentheses."""
        return Markup("({})").format(self.refer("formula", key))

    def sec(self, key: str) -> Markup:
        """Link to a section."""
        return self.refer("section", key)

    def src(self, *keys: str) -> Markup:
        """Links to sources of the bibliography in brackets: «[1, 3]»."""
        return Markup("[{}]").format(Markup(", ").join(self.refer("source", key) for key in keys))

    def place(self, kind: Kind, key: str) -> Label:
        """Say that the thing stands here; it must be the first time.

        Raises:
            NumberingError: Not declared, or placed before.
        """
        label = self.label(kind, key)
        if (kind, key) in self._placed:
            msg = f"{_TITLES[kind]} {label.number} «{key}»: помещено дважды"
            raise NumberingError(msg)
        if not self._referred[kind, key] and kind in ("figure", "table"):
            self._early.append(f"{_TITLES[kind]} {label.number} «{key}»: нет ссылки до появления")
        self._placed.append((kind, key))
        return label

    def section(
        self, level: int, title: str, *, key: str | None = None, numbered: bool = True
    ) -> Heading:
        """Number a heading and note it for the contents.

        Args:
            level: 1 for a chapter, 2 and 3 below it.
            title: Text of the heading.
            key: Key for references; without it the heading cannot be referred to.
            numbered: False for «Введение», «Заключение», appendices.
        """
        number = self._next_section(level) if numbered else ""
        if key is None:
            anchor = f"sec-h{len(self._headings) + 1}"
        else:
            label = self._labels.get(("section", key)) or self.declare(
                "section", key, number=number or title
            )
            if label.number != (number or title):
                msg = f"раздел «{key}»: объявлен под номером {label.number}, стоит под {number}"
                raise NumberingError(msg)
            self._placed.append(("section", key))
            anchor = label.anchor
        heading = Heading(level, number, title, anchor)
        self._headings.append(heading)
        return heading

    @property
    def contents(self) -> tuple[Heading, ...]:
        """Headings in the order in which they came."""
        return tuple(self._headings)

    def count(self, kind: Kind) -> int:
        """How many things of a kind stand in the report (for the реферат)."""
        return sum(1 for placed, _ in self._placed if placed == kind)

    def problems(self) -> list[str]:
        """What does not fit: declared but absent, referred to but absent, out of order."""
        found = list(self._early)
        placed = set(self._placed)
        for (kind, key), label in self._labels.items():
            if (kind, key) not in placed:
                said = "есть ссылка" if self._referred[kind, key] else "объявлено"
                found.append(f"{_TITLES[kind]} {label.number} «{key}»: {said}, но в отчёте нет")
        declared = list(self._labels)
        for kind, title in _TITLES.items():
            if kind == "section":
                continue
            order = [declared.index(item) for item in self._placed if item[0] == kind]
            if order != sorted(order):
                found.append(f"{title}: порядок в тексте не по номерам")
        return found

    def check(self) -> None:
        """Raise if :meth:`problems` finds any.

        Raises:
            NumberingError: One line that names every problem.
        """
        found = self.problems()
        if found:
            msg = "Нумерация отчёта не сходится: " + "; ".join(found)
            raise NumberingError(msg)

    def _next_section(self, level: int) -> str:
        if not 1 <= level <= len(self._section) + 1:
            msg = f"раздел уровня {level} стоит без раздела уровнем выше"
            raise NumberingError(msg)
        self._section = [*self._section[:level], 0][:level]
        self._section[level - 1] += 1
        return ".".join(map(str, self._section))


def _ascii(key: str) -> str:
    """Anchor-safe form of a key; distinct keys stay distinct."""
    plain = (c.isascii() and (c.isalnum() or c in "_-") for c in key)
    return "".join(c if ok else f".{ord(c):x}." for c, ok in zip(key, plain, strict=True))
