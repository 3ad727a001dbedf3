"""What every chapter is given: writer, terms and the words for formulas."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from reports.document.page.writer import Writer
from reports.document.text.terms import Terms
from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Model
from reports.spec.shape import Shape

if TYPE_CHECKING:
    from jinja2 import Environment

BOOK = "gots"
FORMULA = "n:"  # prefix of the keys of formulas of nodes


@dataclass(frozen=True)
class Chapter:
    """Tools for writing one report; templates see the public methods by their names."""

    terms: Terms
    writer: Writer
    environment: Environment

    @property
    def model(self) -> Model:
        """Specifications of the report's engine."""
        return self.terms.model

    @property
    def input(self) -> InputFile:
        """The input file."""
        return self.terms.model.input

    @cached_property
    def shape(self) -> Shape:
        """Layout of the engine."""
        return Shape.of(self.input)

    @property
    def example(self) -> float:
        """Crank angle of the worked lines of the dynamics, shortly after the combustion [deg]."""
        return 390.0 if self.shape.strokes == 4 else 30.0

    def page(self, template: str, **context: Any) -> Markup:  # noqa: ANN401
        """Render a template of the folder ``report`` with the tools and a chapter's own data."""
        names = {
            "t": self.terms,
            "w": self.writer,
            "n": self.writer.n,
            "input": self.input,
            "shape": self.shape,
            "example": self.example,
            "eq": self.eq,
            "full": self.full,
            "sub": self.sub,
            "ref": self.ref,
            "book": self.book,
            "h": self.writer.heading,
            "figure": self.writer.figure,
            "table": self.writer.table,
        }
        text = self.environment.get_template(f"report/{template}").render(**names, **context)
        return Markup(text)

    def eq(self, name: str, at: float | None = None, end: str = "") -> Markup:
        """The formula of a node in symbols, numbered."""
        return self.writer.formula(self.terms.formula(name, at), FORMULA + name, end)

    def full(self, name: str, end: str = "") -> Markup:
        """The formula of a scalar in symbols, with numbers and its result, numbered."""
        tex = self.terms.substitution(name, symbols=True)
        return self.writer.formula(tex, FORMULA + name, end)

    def sub(self, name: str, at: float | None = None, end: str = "") -> Markup:
        """The formula with numbers and its result, not numbered."""
        return self.writer.formula(self.terms.substitution(name, at), None, end)

    def ref(self, name: str) -> Markup:
        """Number of a node's formula as a link, in brackets."""
        return self.writer.n.eq(FORMULA + name)

    def book(self, name: str = "", place: str = "") -> Markup:
        """Reference to the textbook with the place there: «[1, формула (3)]»."""
        where = place or self.terms.book(name)
        link = self.writer.n.refer("source", BOOK)
        return Markup("[{}, {}]").format(link, where) if where else Markup("[{}]").format(link)
