"""Places headings, formulas, figures and tables in the text and numbers them.

A report is written twice.  The draft only notes what stands where; the second pass writes
with numbers known, so that the text may refer forward and the contents, counts and links are
right.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from reports.document.page.blocks import TableBlock
from reports.document.page.numbering import Draft, Numbering
from reports.document.text.terms import WhereItem

if TYPE_CHECKING:
    from jinja2 import Environment

_KEPT_ROWS = 10  # a longer table that must not break would leave half a page empty


@dataclass(frozen=True, slots=True)
class Figure:
    """A figure to draw: what draws it, its caption and alternative text."""

    draw: Callable[[], str]
    caption: str
    alt: str = ""


def drawn(figure: Figure) -> str:
    """The figure as SVG."""
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
        """A heading for text and contents."""
        item = self.n.section(level, title, numbered=numbered)
        return Markup(self._macros.heading(item, runon=runon))

    def heading_again(self, level: int, title: str, **_: bool) -> Markup:
        """The heading of that title once more: its chapter is written anew."""
        items = (item for item in self.n.contents if (item.level, item.title) == (level, title))
        return Markup(self._macros.heading(next(items), runon=False))

    def formula(self, tex: str, key: str | None = None, end: str = "") -> Markup:
        """A displayed formula, numbered if it has a key."""
        label = None if key is None else self.n.place("formula", key)
        if self.draft:
            return Markup("")
        self.formulas.append(tex)
        return Markup(self._macros.formula(tex, label, end))

    def where(self, items: Sequence[WhereItem]) -> Markup:
        """The «где» list under a formula."""
        return Markup("") if self.draft else Markup(self._macros.where(items))

    def figure(self, key: str, plan: Figure | None) -> Markup:
        """A figure with its caption; a draft needs no plan."""
        label = self.n.place("figure", key)
        if self.draft or plan is None:
            return Markup("")
        self.figures[label.anchor] = plan
        return Markup(self._macros.figure(Markup(drawn(plan)), label, plan.caption, plan.alt))

    def table(self, key: str, plan: TablePlan) -> Markup:
        """A table with its caption."""
        label = self.n.place("table", key, number=plan.number)
        if self.draft:
            return Markup("")
        block = plan.build()
        keep = plan.keep and len(block.rows) <= _KEPT_ROWS
        manner = {"size": plan.size, "keep": keep, "lined": plan.lined}
        return Markup(self._macros.table(block, label, plan.caption, **manner))

    def sources(self, texts: Iterable[tuple[str, str]]) -> Markup:
        """The bibliography: keys and texts."""
        items = [(self.n.place("source", key), text) for key, text in texts]
        return Markup("") if self.draft else Markup(self._macros.bibliography(items))

    def contents(self) -> Markup:
        """Contents from the headings written so far."""
        return Markup(self._macros.contents(self.n.contents))
