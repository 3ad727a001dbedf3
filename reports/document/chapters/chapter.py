"""What every chapter is given: writer, terms and the words for formulas, tables and figures."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, cast

from markupsafe import Markup

from reports.document.page.charts import HEIGHT, chart_figure, panels_figure
from reports.document.page.numbering import Kind
from reports.document.page.spec_tables import angle_table, scalar_table
from reports.document.page.style import Style
from reports.document.page.writer import TablePlan, Writer
from reports.document.text.numbers import of_digits
from reports.document.text.terms import Terms, with_unit
from reports.inputs.checks.grid import GridError
from reports.inputs.firing import order_text, strokes_at
from reports.inputs.sections.input_file import EngineSection, InputFile
from reports.model.blocks import Grid, Model
from reports.model.shape import Shape
from reports.shared.russian import NBSP, fixed, joined, runs

if TYPE_CHECKING:
    from jinja2 import Environment

BOOK = "gots"
ELSEWHERE = "книги Excel"  # where the tables of chapters that are left out stand
# Signs of a place in the textbook that stays with the word before it; that stays in one line.
_SHORT_PLACE, _ONE_FORMULA = 8, 14
FORMULA = "n:"  # prefix of the keys of formulas of nodes


@dataclass(frozen=True)
class Chapter:
    """Tools for writing one report; templates see the public methods by their names."""

    terms: Terms
    writer: Writer
    environment: Environment
    figures: dict[str, str] = field(default_factory=dict)  # chart → key of its figure, in a draft

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

    @property
    def exact(self) -> bool:
        """Whether the forces follow from the exact acceleration."""
        return self.input.calculation.method == "exact"

    @property
    def whole(self) -> bool:
        """Whether every journal has its diagrams here; otherwise the most loaded one alone."""
        return self.input.report.detail == "full"

    @property
    def table_step(self) -> float:
        """Step of a printed table whose own step is fine [deg]; 0 where all rows stand."""
        style = cast(Style, self.environment.globals["style"])
        return 0.0 if self.whole else float(style.table_step_deg)

    @property
    def printed_step(self) -> float:
        """Step of the printed tables over the crank angle [deg]; 0 where all rows stand."""
        step = self.table_step
        return 0.0 if self.input.calculation.step_deg >= step else step

    @property
    def order(self) -> str:
        """Order in which the power strokes begin: ``1–3–4–2``, ``(1, 2)–(3, 4)``."""
        return order_text(self.input.crankshaft.firing_offsets_deg, self.shape.period)

    @property
    def strokes_at(self) -> dict[float, tuple[int, ...]]:
        """Cylinders whose power strokes begin at each angle of the cycle [deg]."""
        return strokes_at(self.input.crankshaft.firing_offsets_deg, self.shape.period)

    @property
    def named(self) -> str:
        """The engine's name in quotes after a space; nothing for an engine without one."""
        name = self.input.engine.name
        return "" if name in ("", EngineSection.model_fields["name"].default) else f" «{name}»"

    def page(self, template: str, **context: Any) -> Markup:  # noqa: ANN401
        """Render a template of the folder ``report`` with the tools and a chapter's own data."""
        names = {
            "t": self.terms,
            "w": self.writer,
            "n": self.writer.n,
            "h": self.writer.heading,
            "figure": self.writer.figure,
            "table": self.writer.table,
            "at": self.example,
        }
        own = ("input", "shape", "example", "exact", "order", "strokes_at", "eq", "full", "sub",
               "ref", "book", "tabs", "figs", "chart", "panels", "told", "printed_step",
               "whole", "named")  # fmt: skip
        names |= {name: getattr(self, name) for name in own}
        text = self.environment.get_template(f"report/{template}.html.j2")
        return Markup(text.render(**names | context))

    def eq(self, name: str, at: float | None = None, end: str = "") -> Markup:
        """The formula of a node in symbols, numbered."""
        if self.writer.draft:
            return self.writer.formula("", FORMULA + name)
        return self.writer.formula(self.terms.formula(name, at), FORMULA + name, end)

    def full(self, name: str, end: str = "") -> Markup:
        """The formula of a scalar in symbols, with numbers and its result, numbered."""
        if self.writer.draft:
            return self.writer.formula("", FORMULA + name)
        tex = self.terms.substitution(name, symbols=True)
        return self.writer.formula(tex, FORMULA + name, end)

    def sub(self, name: str, at: float | None = None, end: str = "") -> Markup:
        """The formula with numbers and its result, not numbered."""
        if self.writer.draft:
            return Markup("")
        return self.writer.formula(self.terms.substitution(name, at), None, end)

    def ref(self, name: str) -> Markup:
        """Number of a node's formula as a link, in brackets."""
        return self.writer.n.eq(FORMULA + name)

    def book(self, *names: str, place: str = "") -> Markup:
        """Reference to the textbook with the place there: «[1, формула (3)]»."""
        where = place or self.terms.book(*names)
        link = self.writer.n.refer("source", BOOK)
        if not where:
            return Markup("[{}]").format(link)
        if len(where) <= _SHORT_PLACE:
            return Markup("[{},{}{}]").format(link, NBSP, where.replace(" ", NBSP))
        look = '<span class="nb">[{}, {}]</span>' if len(where) <= _ONE_FORMULA else "[{}, {}]"
        return Markup(look).format(link, where)

    def tabs(self, names: Iterable[str]) -> Markup:
        """Numbers of tables as links: «Б.5–Б.8», «14 и 16»; in the workbook by its numbers."""
        return self._linked("table", names)

    def figs(self, names: Iterable[str]) -> Markup:
        """Numbers of figures as links: «19–22»."""
        return self._linked("figure", names)

    def _linked(self, kind: Kind, names: Iterable[str]) -> Markup:
        links = [self.writer.n.refer(kind, name) for name in names]
        place = f" {ELSEWHERE}"  # said once for all of them
        if all(link.endswith(place) for link in links):
            links = [link.removesuffix(place) for link in links]
        else:
            place = ""
        stretches = []
        for first, last in runs([str(link.striptags()) for link in links]):
            if last - first > 1:
                stretches.append(links[first] + "–" + links[last])
            else:
                stretches += links[first : last + 1]
        return Markup(joined(stretches) + place)

    def told(self, name: str, *, symbol: bool = False, angle: bool = False) -> Markup:
        """A scalar with its unit and, where the grid is too coarse for it, with the fine value.

        ``angle`` adds where the fine value is, if that is elsewhere.
        """
        value = self.terms.eqv(name) if symbol else self.terms.val(name)
        for error in self.terms.grid_errors:
            if error.key == name:
                where = error.moved_deg if angle else None
                more = "" if where is None else f" при φ = {fixed(where, 0)}°"
                return Markup("{} (при шаге 1° — {}{})").format(value, self.fine(error), more)
        return value

    def fine(self, error: GridError) -> Markup:
        """The value by the fine step with its unit."""
        digits = error.digits.within(error.coarse)
        return with_unit(of_digits(error.fine, digits), self.terms.unit(error.key))

    def worst(self, key: str) -> int:
        """Number of the most loaded journal by a scalar that holds it."""
        return round(self.terms.value(key))

    def chart(
        self,
        name: str,
        size: float = HEIGHT,
        *,
        key: str = "",
        **more: Any,  # noqa: ANN401
    ) -> Markup:
        """A chart of the specifications as a figure; see :func:`chart_figure`."""
        if self.writer.draft:
            self.figures.setdefault(name, key or name)
            return self.writer.figure(key or name, None)
        plan = chart_figure(self.terms, self.model.charts_by_id[name], size, **more)
        return self.writer.figure(key or name, plan)

    def panels(
        self,
        key: str,
        names: Iterable[str],
        size: float,
        **more: Any,  # noqa: ANN401
    ) -> Markup:
        """Charts of one group in one figure, one above the other."""
        names = tuple(names)
        if self.writer.draft:
            self.figures.update((name, self.figures.get(name, key)) for name in names)
            return self.writer.figure(key, None)
        charts = [self.model.charts_by_id[name] for name in names]
        return self.writer.figure(key, panels_figure(self.terms, charts, size, **more))

    def scalars(self, caption: str, keys: Iterable[str], **manner: Any) -> TablePlan:  # noqa: ANN401
        """A list of the scalars and inputs that there are."""
        present = [key for key in keys if self.terms.has(key)]
        return TablePlan(partial(scalar_table, self.terms, present), caption, **manner)

    def columns(
        self,
        table: str,
        keys: Sequence[str] | None = None,
        caption: str = "",
        *,
        step: float = 0.0,
        **manner: Any,  # noqa: ANN401
    ) -> TablePlan:
        """A table over the crank angle, whole or some columns and rows of it."""
        build = partial(angle_table, self.terms, table, keys, step=step)
        return TablePlan(build, caption or self.model.tables[table].title, **manner)

    def grid(self, name: str) -> Grid:
        """A grid of the model."""
        return next(b for b in self.model.blocks if isinstance(b, Grid) and b.id == name)
