"""Places headings, formulas, figures and tables in the text and numbers them.

A report is written twice.  The draft only notes what stands where; then everything is
declared in that order, and the second pass writes with numbers known, so that the text may
refer forward and the contents, counts and links are right.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from reports.document.page.blocks import TableBlock, WhereItem
from reports.document.page.drawing import Drawing
from reports.document.page.numbering import Heading, Kind, Label, Numbering

if TYPE_CHECKING:
    from jinja2 import Environment

_KEPT_ROWS = 10  # a longer table that must not break would leave half a page empty


@dataclass(frozen=True, slots=True)
class Figure:
    """A figure to draw: what draws it (picklable), its caption and alternative text."""

    draw: Callable[[], str]
    caption: str
    alt: str = ""


@dataclass(frozen=True, slots=True)
class TablePlan:
    """A table to set: what builds it, its caption, own number of an appendix, manner."""

    build: Callable[[], TableBlock]
    caption: str
    number: str | None = None
    size: str = ""
    keep: bool = False
    lined: bool = False
    column_numbers: bool = True


@dataclass(slots=True)
class Order:
    """What stands in the report, in order; the same key must not stand twice."""

    items: list[tuple[Kind, str, str | None]] = field(default_factory=list)
    sections: dict[str, str] = field(default_factory=dict)

    def numbering(self) -> Numbering:
        """A numbering in which everything is declared."""
        result = Numbering()
        for kind, key, number in self.items:
            result.declare(kind, key, number=number)
        for key, number in self.sections.items():
            result.declare("section", key, number=number)
        return result

    def count(self, kind: Kind) -> int:
        """How many things of a kind there are."""
        return sum(1 for found, _, _ in self.items if found == kind)

    def keys(self, kind: Kind) -> list[str]:
        """Keys of a kind in order."""
        return [key for found, key, _ in self.items if found == kind]


class Draft(Numbering):
    """A numbering that knows nothing yet: notes what is placed and answers every reference."""

    def __init__(self) -> None:
        super().__init__()
        self.order = Order()

    def refer(self, kind: Kind, key: str) -> Markup:
        """No number yet."""
        return Markup("?")

    def place(self, kind: Kind, key: str, *, number: str | None = None) -> Label:
        """Note the thing."""
        self.order.items.append((kind, key, number))
        return Label(kind, key, number or "?", "draft")

    def section(
        self, level: int, title: str, *, key: str | None = None, numbered: bool = True
    ) -> Heading:
        """Number the heading and note the number for references."""
        heading = super().section(level, title, numbered=numbered)
        if key is not None:
            self.order.sections[key] = heading.number or title
        return heading


class Writer:
    """Turns calls of the templates into HTML, in draft without the heavy parts."""

    def __init__(
        self,
        environment: Environment,
        numbering: Numbering,
        drawing: Drawing | None = None,
    ) -> None:
        self.n = numbering
        self.draft = isinstance(numbering, Draft)
        self.drawing = drawing
        self.figures: dict[str, Figure] = {}
        self._macros: Any = environment.get_template("report/macros.html.j2").module

    def heading(
        self,
        level: int,
        title: str,
        key: str | None = None,
        *,
        numbered: bool = True,
        runon: bool = False,
    ) -> Markup:
        """A heading for text and contents."""
        item = self.n.section(level, title, key=key, numbered=numbered)
        return Markup(self._macros.heading(item, runon=runon))

    def formula(self, tex: str, key: str | None = None, end: str = "") -> Markup:
        """A displayed formula, numbered if it has a key."""
        label = None if key is None else self._place("formula", key)
        return Markup("") if self.draft else Markup(self._macros.formula(tex, label, end))

    def where(self, items: Sequence[WhereItem]) -> Markup:
        """The «где» list under a formula."""
        return Markup("") if self.draft else Markup(self._macros.where(items))

    def figure(self, key: str, plan: Figure) -> Markup:
        """A figure with its caption."""
        label = self._place("figure", key)
        self.figures[key] = plan
        if self.draft:
            return Markup("")
        svg = plan.draw() if self.drawing is None else self.drawing.svg(key)
        return Markup(self._macros.figure(Markup(svg), label, plan.caption, plan.alt))

    def table(self, key: str, plan: TablePlan) -> Markup:
        """A table with its caption."""
        label = self._place("table", key, plan.number)
        if self.draft:
            return Markup("")
        block = plan.build()
        return Markup(
            self._macros.table(
                block,
                label,
                plan.caption,
                size=plan.size,
                keep=plan.keep and len(block.rows) <= _KEPT_ROWS,
                lined=plan.lined,
                column_numbers=plan.column_numbers,
            )
        )

    def sources(self, texts: Iterable[tuple[str, str]]) -> Markup:
        """The bibliography: keys and texts."""
        items = [(self._place("source", key), text) for key, text in texts]
        return Markup("") if self.draft else Markup(self._macros.bibliography(items))

    def contents(self) -> Markup:
        """Contents from the headings written so far."""
        return Markup(self._macros.contents(self.n.contents))

    def _place(self, kind: Kind, key: str, number: str | None = None) -> Label:
        if isinstance(self.n, Draft):
            return self.n.place(kind, key, number=number)
        return self.n.place(kind, key)
