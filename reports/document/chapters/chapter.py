"""Chapter tools: writer, terms, words for formulas, tables and figures; choice of chapters."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from markupsafe import Markup

from kshm.defaults import FINE_STEP
from reports.document.chapters.record import Record, Write, chosen, relevant
from reports.document.page.blocks import angle_table, scalar_table
from reports.document.page.charts import HEIGHT, chart_figure, panels_figure
from reports.document.page.numbering import Figure, Kind, TablePlan, Writer
from reports.document.page.style import Style
from reports.document.text.factors import WRITTEN_ALL, Factor, of_scale, written_in
from reports.document.text.symbols import inline_html
from reports.document.text.terms import Terms, WhereItem, with_unit
from reports.document.text.texts import of_digits
from reports.inputs.firing import order_text, strokes_at
from reports.inputs.sections.input_file import EngineSection, InputFile
from reports.inputs.sections.report import CHAPTERS
from reports.inputs.solve_input import MAX_GRID_ERROR, GridError, refined, solved
from reports.model.blocks import Grid, Model
from reports.model.charts import Series
from reports.model.shape import Shape, most_loaded_pin, pin_name
from reports.shared.russian import NBSP, fixed, joined, runs

if TYPE_CHECKING:
    from jinja2 import Environment

STATICS = "P4_5s"  # table of the crankpins' torques by statics
_NOUN = re.compile(r"^[^«»\d,;:(]*?\b(?:двигатель|дизель|мотор)\b", re.IGNORECASE)
BOOK = "gots"
ELSEWHERE = "книги Excel"  # where the tables of chapters that are left out stand
# Signs of a place in the textbook that stays with the word before it; that stays in one line.
_SHORT_PLACE, _ONE_FORMULA = 8, 14
FORMULA = "n:"  # prefix of the keys of formulas of nodes


def after_noun(name: str, *, genitive: bool = True) -> str:
    """Return engine's name to stand after «двигателя» or «двигатель»: the noun is not said twice.

    «Судовой дизель 6Ч 30/38» gives « 6Ч 30/38», «Дизель: рядный» gives « (рядного)».
    """
    noun = _NOUN.match(name)
    if noun is None:
        return f" «{name}»"
    head, colon, tail = name[noun.end() :].strip().partition(":")
    ending = "ого" if genitive else "ый"  # «рядный, четырёхтактный»
    of = re.sub(r"(?<=\w)ый\b", ending, tail.strip())
    words = f"{head.strip()} ({of})" if colon else head
    return f" {words.strip()}" if words.strip() else ""


def named_engine(model: InputFile, *, genitive: bool = True) -> str:
    """Return engine's name to stand after the word for it; nothing for an engine without one."""
    name = model.engine.name
    is_named = name not in ("", EngineSection.model_fields["name"].default)
    return after_noun(name, genitive=genitive) if is_named else ""


def leaders(terms: Terms, names: Sequence[str]) -> list[int]:
    """Numbers, from 1, of the scalars that are printed as large as the largest."""
    values = [terms.value(name) for name in names]
    most = terms.num(names[int(np.argmax(values))])
    return [number for number, name in enumerate(names, 1) if terms.num(name) == most]


def stretched(labels: Sequence[Markup]) -> list[Markup]:
    """Numbered labels, three and more that follow each other by their ends: «19–22»."""
    stretches: list[Markup] = []
    for first, last in runs([str(label.striptags()) for label in labels]):
        if last - first > 1:
            stretches.append(labels[first] + "–" + labels[last])
        else:
            stretches += labels[first : last + 1]
    return stretches


def pin_stems(shape: Shape) -> list[str]:
    """Stems of the keys of the crankpins, from the nose: ``pin``, ``pin2``."""
    return [f"pin{pin_name(number)}" for number in range(1, len(shape.pins) + 1)]


def worst_pin(terms: Terms) -> int:
    """Return the number of the most loaded crankpin by the workbook."""
    return most_loaded_pin(terms.values.scalars)


def worst_running(terms: Terms, throws: int) -> tuple[list[int], list[int]]:
    """Return main journals and crankpins with the greatest range of the running-on torque."""
    mains = leaders(terms, [f"dM_main{k}" for k in range(2, throws + 2)])  # journal 1 has none
    pins = [pin_swing(terms, throws, i) for i in range(1, throws + 1)]
    most = max(pins, key=lambda text: float(text.replace(",", ".").replace(NBSP, "")))
    return [k + 1 for k in mains], [i for i, text in enumerate(pins, 1) if text == most]


def half_torque_gap(terms: Terms, throws: int) -> float:
    """How far the rule of half a throw's torque is from statics at most [N·m]."""
    pairs = [(f"{STATICS}.Mpins{i}_Nm", f"P4_5.Mpin{i}_Nm") for i in range(1, throws + 1)]
    return max(
        float(np.abs(terms.column(statics) - terms.column(rule)).max()) for statics, rule in pairs
    )


def pin_torque(terms: Terms, throws: int, number: int) -> str:
    """Column of the torque in a crankpin: by statics where the rule of half a torque is off."""
    digits = terms.quantity("dM_pin1").digits
    if half_torque_gap(terms, throws) > 0.5 * 10.0**-digits.decimals:
        return f"{STATICS}.Mpins{number}_Nm"
    return f"P4_5.Mpin{number}_Nm"


def pin_swing(terms: Terms, throws: int, number: int) -> str:
    """Range of the torque in a crankpin, as printed [N·m]."""
    values = terms.column(pin_torque(terms, throws, number))
    return of_digits(float(np.ptp(values)), terms.quantity("dM_pin1").digits)


def swing_errors(model: InputFile, throws: int) -> list[GridError]:
    """Errors of the tables' step in the ranges of the crankpins' torques by statics."""
    coarse, fine = (solved(each).columns[STATICS] for each in (model, refined(model)))
    keys = {f"dM_pin{i}": f"Mpins{i}_Nm" for i in range(1, throws + 1)}
    errors = [
        GridError(name, float(np.ptp(coarse[key])), float(np.ptp(fine[key])))
        for name, key in keys.items()
    ]
    return [error for error in errors if abs(error.percent) > MAX_GRID_ERROR]


@dataclass(frozen=True, slots=True)
class Prototype:
    """The engine that the report's one is held against.

    Attributes:
        name: its name.
        value: the number of a node or an input in its unit; KeyError where it is not known.
    """

    name: str
    value: Callable[[str], float]


@dataclass(frozen=True)
class Chapter:
    """Tools for writing one report; templates see the public methods by their names."""

    terms: Terms
    writer: Writer
    environment: Environment
    prototype: Prototype | None = None
    records: Sequence[Record] = ()
    figures: dict[str, str] = field(default_factory=dict)  # chart → key of its figure, in a draft
    scales: dict[Factor, bool] = field(default_factory=dict)  # of the chapter → explained

    @property
    def model(self) -> Model:
        """Specifications of the report's engine."""
        return self.terms.model

    @property
    def input(self) -> InputFile:
        """The input file."""
        return self.terms.model.input

    @cached_property
    def chosen(self) -> set[str]:
        """Names of the chapters that the report has."""
        return chosen(self.records, self.input)

    @cached_property
    def relevant(self) -> set[str]:
        """Names of the chosen chapters that apply to the engine."""
        return relevant(self.records, self.input)

    @cached_property
    def views(self) -> Mapping[str, Callable[[Any], TablePlan | Figure]]:
        """Tables and figures that books show and the program makes."""
        return {name: view for record in self.records for name, view in record.views.items()}

    @cached_property
    def inserts(self) -> Mapping[str, Write]:
        """Texts that books insert and the program writes."""
        return {name: write for record in self.records for name, write in record.inserts.items()}

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
        """The engine's name after «двигателя»."""
        return named_engine(self.input)

    def page(self, template: str, **context: Any) -> Markup:  # noqa: ANN401
        """Render a template of the folder ``report`` with the tools and a chapter's own data."""
        names = {
            "t": self.terms,
            "w": self.writer,
            "n": self.writer.n,
            "h": self.heading,
            "figure": self.writer.figure,
            "table": self.writer.table,
            "at": self.example,
            "title": CHAPTERS.get(template, ""),
        }
        own = ("input", "shape", "example", "exact", "order", "strokes_at", "eq", "full", "sub",
               "ref", "book", "tabs", "figs", "chart", "panels", "told", "told_swing",
               "printed_step", "whole", "named", "by_fine", "where")  # fmt: skip
        names |= {name: getattr(self, name) for name in own}
        text = self.environment.get_template(f"report/{template}.html.j2")
        return Markup(text.render(**names | context))

    def heading(self, level: int, title: str, **manner: bool) -> Markup:
        """Return a heading; with a chapter the factors of its formulas are to be explained anew."""
        if level == 1:
            self.scales.clear()
        return self.writer.heading(level, title, **manner)

    def eq(self, name: str, at: float | None = None, end: str = "",
           zeros: Collection[str] = ()) -> Markup:  # fmt: skip
        """Return the formula of a node in symbols, numbered, without the terms of ``zeros``."""
        if self.writer.draft:
            return self.writer.formula("", FORMULA + name)
        formula = self.writer.formula(self.terms.formula(name, at, zeros), FORMULA + name, end)
        return formula + self.explained(written_in(name), end)

    def full(self, name: str, end: str = "") -> Markup:
        """Return the formula of a scalar in symbols, with numbers and its result, numbered."""
        if self.writer.draft:
            self.terms.put_in.add((name, None))
            return self.writer.formula("", FORMULA + name)
        tex = self.terms.substitution(name, symbols=True)
        formula = self.writer.formula(tex, FORMULA + name, end)
        return formula + self.explained(self._put_in(name, None), end)

    def sub(self, name: str, at: float | None = None, end: str = "") -> Markup:
        """Return the formula with numbers and its result, not numbered."""
        if self.writer.draft:
            self.terms.put_in.add((name, at))
            return Markup("")
        formula = self.writer.formula(self.terms.substitution(name, at), None, end)
        return formula + self.explained(self._put_in(name, at), end)

    def where(self, *names: str) -> Markup:
        """Return the «где» list under a formula, with the factors that are not explained yet."""
        factors = [WhereItem(power, f"перевод {words}") for power, words in self._factors()]
        return self.writer.where([*self.terms.where(*names), *factors])

    def _put_in(self, name: str, at: float | None) -> Iterator[Factor]:
        """Factors of a formula with numbers."""
        yield from map(of_scale, self.terms.scales(name, at))
        yield from written_in(name)

    def explained(self, used: Iterable[Factor] = (), end: str = ".") -> Markup:
        """Return words on the factors of formulas whose sentence ends here."""
        for factor in used:
            self.scales.setdefault(factor, False)
        factors = list(self._factors()) if end == "." else []
        if not factors:
            return Markup("")
        numbers = [power for power, _ in factors]
        if len(set(numbers)) == 1:  # one number in several places
            numbers = numbers[:1]
        word = ("число", "числа") if set(factors) & WRITTEN_ALL else ("множитель", "множители")
        verb = f"{word[1]} {{}} переводят" if len(numbers) > 1 else f"{word[0]} {{}} переводит"
        said = Markup(f"Здесь {verb} {{}}.").format(
            Markup(joined([inline_html(number) for number in numbers])),
            joined([words for _, words in factors]),
        )
        return Markup('<p class="flush">{}</p>').format(said)

    def _factors(self) -> Iterator[Factor]:
        """Factors that wait for their words, with these."""
        for factor, explained in self.scales.items():
            if not explained:
                self.scales[factor] = True
                yield factor

    def ref(self, name: str) -> Markup:
        """Return the number of a node's formula as a link, in brackets."""
        return self.writer.n.eq(FORMULA + name)

    def book(self, *names: str, place: str = "") -> Markup:
        """Return reference to the textbook with the place there: «[1, формула (3)]»."""
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
        elsewhere = f" {ELSEWHERE}"  # said once for all of them
        if all(link.endswith(elsewhere) for link in links):
            links = [link.removesuffix(elsewhere) for link in links]
        else:
            elsewhere = ""
        return Markup(joined(stretched(links)) + elsewhere)

    def told(self, name: str, *, symbol: bool = False, angle: bool = False) -> Markup:
        """A scalar with its unit and, where the grid is too coarse for it, with the fine value.

        ``angle`` adds where the fine value is, if that is elsewhere.
        """
        value = self.terms.eqv(name) if symbol else self.terms.val(name)
        return self._beside_fine(value, name, angle=angle)

    def told_swing(self, number: int) -> Markup:
        """Range of the torque in a crankpin, with the fine value where the grid is too coarse."""
        name = f"dM_pin{number}"
        swing = pin_swing(self.terms, self.shape.throws, number)
        return self._beside_fine(with_unit(swing, self.terms.unit(name)), name)

    def told_range(self, most: str, least: str) -> Markup:
        """Range of a scalar between two others, with the fine one where either is off."""
        terms, errors = self.terms, {error.key: error.fine for error in self.grid_errors}
        ends = [
            with_unit(of_digits(high - low, terms.quantity(most).digits), terms.unit(most))
            for high, low in (
                (terms.value(most), terms.value(least)),
                (errors.get(most, terms.value(most)), errors.get(least, terms.value(least))),
            )
        ]
        remark = Markup("{} (при шаге 1° — {})").format(*ends)
        return ends[0] if ends[0] == ends[1] else remark

    def _beside_fine(self, value: Markup, name: str, *, angle: bool = False) -> Markup:
        if name.startswith("q_"):  # a pressure is off as its load is
            one_rod = name.startswith("q_main") or self.shape.rods_beside == 1
            key = f"R{name[2:]}" if one_rod else f"B_{name.rpartition('_')[2]}"
            load = next((e for e in self.grid_errors if e.key == key), None)
            return value if load is None else self._beside_load(value, name, load)
        for error in self.grid_errors:
            if error.key == name:
                where = error.moved_deg if angle else None
                more = "" if where is None else f" при φ = {fixed(where, 0)}°"
                return Markup("{} (при шаге 1° — {}{})").format(value, self.fine(error), more)
        return value

    def _beside_load(self, value: Markup, name: str, load: GridError) -> Markup:
        fine = self.terms.value(name) * load.fine / load.coarse
        text = with_unit(of_digits(fine, self.terms.quantity(name).digits), self.terms.unit(name))
        return Markup("{} (при шаге 1° — {})").format(value, text)

    @cached_property
    def grid_errors(self) -> tuple[GridError, ...]:
        """Errors of the tables' step; of the torque in crankpins by statics where it leads."""
        errors, throws = self.terms.grid_errors, self.shape.throws
        if not errors or not pin_torque(self.terms, throws, 1).startswith(STATICS):
            return errors
        first = next((n for n, e in enumerate(errors) if e.key.startswith("dM_")), len(errors))
        others = [error for error in errors if not error.key.startswith("dM_pin")]
        others[first:first] = swing_errors(self.input, throws)
        return tuple(others)

    def fine(self, error: GridError) -> Markup:
        """Return the value by the fine step with its unit."""
        digits = error.digits.within(error.coarse)
        return with_unit(of_digits(error.fine, digits), self.terms.unit(error.key))

    def fine_value(self, name: str) -> float:
        """Return a scalar by the solution with the fine step; on a grid as fine the table's own."""
        if self.input.calculation.step_deg <= FINE_STEP:
            return self.terms.value(name)
        return float(solved(refined(self.input)).scalars[name])

    def by_fine(self, name: str, *, symbol: bool = False) -> Markup:
        """Return a scalar by the fine step with its unit, after its symbol if asked for."""
        value, digits = self.fine_value(name), self.terms.quantity(name).digits
        text = with_unit(of_digits(value, digits.within(value)), self.terms.unit(name))
        if not symbol:
            return text
        words = Markup('<span class="nb">{}{}={}{}</span>')
        return words.format(self.terms.sym(name), NBSP, NBSP, text)

    def worst(self, key: str) -> int:
        """Return the number of the most loaded journal by a scalar that holds it."""
        return round(self.terms.value(key))

    def chart(
        self,
        name: str,
        size: float = HEIGHT,
        *,
        key: str = "",
        **more: Any,  # noqa: ANN401
    ) -> Markup:
        """Return a chart of the specifications as a figure; see :func:`chart_figure`."""
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
        *,
        series: Mapping[str, tuple[Series, ...]] | None = None,
        **more: Any,  # noqa: ANN401
    ) -> Markup:
        """Charts of one group in one figure, one above the other; ``series`` instead of theirs."""
        names = tuple(names)
        if self.writer.draft:
            self.figures.update((name, self.figures.get(name, key)) for name in names)
            return self.writer.figure(key, None)
        charts = [self.model.charts_by_id[name] for name in names]
        panel_series = series or {}
        charts = [
            replace(chart, series=panel_series.get(chart.id, chart.series)) for chart in charts
        ]
        return self.writer.figure(key, panels_figure(self.terms, charts, size, **more))

    def shared(self, key: str, names: Iterable[str], plan: Callable[[], Figure]) -> Markup:
        """One figure for several charts of the specifications, drawn in a manner of its own."""
        if self.writer.draft:
            self.figures.update((name, self.figures.get(name, key)) for name in names)
            return self.writer.figure(key, None)
        return self.writer.figure(key, plan())

    def scalars(self, caption: str, keys: Iterable[str], **manner: Any) -> TablePlan:  # noqa: ANN401
        """Return a list of the scalars and inputs that there are."""
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
        """Return a table over the crank angle, whole or some columns and rows of it."""
        build = partial(angle_table, self.terms, table, keys, step=step)
        return TablePlan(build, caption or self.model.tables[table].title, **manner)

    def grid(self, name: str) -> Grid:
        """Return a grid of the model."""
        return next(b for b in self.model.blocks if isinstance(b, Grid) and b.id == name)
