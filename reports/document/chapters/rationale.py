"""Chapter on why the data are what they are: usual ranges, the prototype, what follows."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from markupsafe import Markup

from kshm.engine.arrangement import rods_beside
from reports.document.chapters import cycle
from reports.document.chapters.chapter import (
    Chapter,
    Prototype,
    leaders,
    pin_stems,
    worst_pin,
)
from reports.document.page.blocks import TableBlock, TableColumn, table_block
from reports.document.page.numbering import TablePlan
from reports.document.text.symbols import inline_html
from reports.document.text.terms import Terms, with_unit
from reports.document.text.texts import rich
from reports.formula.numeric import evaluate
from reports.inputs.checks.bands import stated_kind
from reports.inputs.firing import arrangement_of
from reports.inputs.reasons import REASONS, RODS, Reason
from reports.inputs.sections.input_file import InputFile, PrototypeSection
from reports.inputs.to_si.masses import Sizes
from reports.shared.russian import NBSP, fixed, joined, short, uncapital
from reports.shared.standing import WORDS, Standing, printed_span, standing
from reports.tables.cycle_members import ranges_of, section_of

# Main values; those of the table of usual ranges are not repeated.
_POWER = "cyc_N_e", "N_e_calc"
_NODES = {
    "cylinders": "engine_cylinders", "bore_mm": "geometry_bore_mm",
    "stroke_mm": "geometry_stroke_mm", "rod_length_mm": "geometry_rod_length_mm",
    "compression_ratio": "geometry_compression_ratio", "speed_rpm": "regime_speed_rpm",
    "power_kw": "cyc_N_e", "mechanical_efficiency": "regime_mechanical_efficiency",
    "max_pressure_mpa": "gas_max_pressure_mpa", "piston_group_kg": "masses_piston_group_kg",
    "rod_kg": "masses_rod_kg", "pin_diameter_mm": "crankshaft_pin_diameter_mm",
    "main_diameter_mm": "crankshaft_main_diameter_mm",
}  # fmt: skip
# Sizes of a prototype that follow from its main values.
_SIZES = {
    "F_piston": "pi*geometry_bore_mm**2/4e6", "S_stroke": "geometry_stroke_mm/1000",
    "lam": "geometry_stroke_mm/2/geometry_rod_length_mm",
    "c_m": "S_stroke*regime_speed_rpm/30", "V_engine": "1000*F_piston*S_stroke*engine_cylinders",
}  # fmt: skip
# Reasons that the chapter on the cycle holds against limits too, by the names it has for them.
_OF_CYCLE = {"peak": "cyc_p_z", "efficiency": "cyc_eta_m"}


@dataclass(frozen=True, slots=True)
class Judged:
    """A reason with the value of the report's engine and of the prototype."""

    reason: Reason
    value: float
    other: float | None
    low: float
    high: float
    bore_mm: float
    required: float | None = None  # what the tables allow at least
    least: float | None = None  # the limit within it

    @property
    def verdict(self) -> Standing:
        """Where the value lies."""
        if self.required is not None and self.value < self.required:
            return Standing.FAILED
        return standing(self.value, (self.low, self.high), self.reason.digits)

    @property
    def place(self) -> str:
        """Where the span is from; that of a large bore is no longer the printed one."""
        span = [low for low, _ in self.reason.ranges.usual.values()]
        grown = ", с ростом D" if self.reason.by_size and self.low not in span else ""
        return f"{self.reason.place}{grown}" or "принято"

    @property
    def shown(self) -> str:
        """The value in print."""
        return fixed(self.value, self.reason.digits)

    @property
    def usual(self) -> str:
        """The span in print."""
        return "…".join(map(short, printed_span((self.low, self.high))))

    @property
    def bounds(self) -> str:
        """What the value should keep to, in print."""
        if self.verdict is Standing.FAILED and self.required is not None:
            return f"допускается не менее {fixed(self.required, self.reason.digits)}"
        return f"обычно {self.usual}"

    @property
    def follows(self) -> tuple[str, str]:
        """On which side of what the value lies and what follows."""
        if self.verdict is Standing.ABOVE:
            return "больше обычного", self.reason.above
        of = "допускаемого" if self.verdict is Standing.FAILED else "обычного"
        if self.least is not None and self.value >= self.least:
            return f"меньше {of}", self.reason.between
        return f"меньше {of}", self.reason.below_at(self.bore_mm)

    @property
    def named(self) -> Markup:
        """Title, symbol and value."""
        words = Markup('{} <span class="nb">{}\u00a0=\u00a0{}</span>')
        text = with_unit(self.shown, self.reason.unit)
        return words.format(self.reason.title, inline_html(self.reason.tex), text)


@dataclass(frozen=True, slots=True)
class Main:
    """A main value of an engine: title, symbol, formulas of which the first known counts."""

    title: str
    tex: str
    value: tuple[str, ...]
    unit: str = ""
    digits: int = 0


_MAIN = (
    Main("Число цилиндров", "i", ("engine_cylinders",)),
    Main("Диаметр цилиндра", "D", ("2000*sqrt(F_piston/pi)",), "мм", 1),
    Main("Ход поршня", "S", ("1000*S_stroke",), "мм", 1),
    Main("Рабочий объём двигателя", r"V_{\mathrm{л}}", ("V_engine",), "дм³", 3),
    Main("Частота вращения", "n", ("regime_speed_rpm",), "мин⁻¹"),
    Main("Эффективная мощность", "N_e", _POWER, "кВт", 1),
    Main("Литровая мощность", r"N_{\mathrm{л}}", tuple(f"{p}/V_engine" for p in _POWER),
         "кВт/дм³", 1),
)  # fmt: skip


def rationale(chapter: Chapter) -> Markup:
    """Return the data beside usual ranges and the prototype."""
    judged = list(judge(chapter))
    prototype = chapter.prototype
    pairs = _pairs(chapter)
    return chapter.page(
        "rationale",
        plan=TablePlan(partial(_table, judged, any(each.other is not None for each in judged)),
                       "Принятые данные и обычные пределы", size="dense", lined=True),
        outside=list(_outside(judged)),
        several=sum(each.verdict is not Standing.INSIDE for each in judged) > 1,
        known_kind=bool(stated_kind(chapter.input)),
        compared=prototype is not None,
        prototype=prototype.name if prototype else "",
        design=chapter.input.prototype.description.strip() if chapter.input.prototype else "",
        pairs=TablePlan(partial(_main_table, pairs), "Двигатель и прототип") if pairs else None,
        denser=_denser(pairs),
        film=judged[-1].reason.key == "film",
    )  # fmt: skip


def _outside(judged: list[Judged]) -> Iterator[Markup]:
    """Yield what lies outside; values from which the same follows stand in one sentence."""
    groups: dict[tuple[str, str], list[Judged]] = {}
    for each in judged:
        if each.verdict is not Standing.INSIDE:
            groups.setdefault(each.follows, []).append(each)
    for (side, follows), members in groups.items():
        if len(members) == 1:
            (one,) = members
            limit = one.bounds.split()[-1]
            yield Markup("{} {} ({}): {}").format(one.named, side, limit, follows)
            continue
        names = [Markup("{} ({})").format(each.named, each.bounds) for each in members]
        said = Markup(joined([names[0], *map(uncapital, names[1:])]))
        yield Markup("{} {}: {}").format(said, side, follows)


def stated(section: PrototypeSection) -> Prototype:
    """Return the prototype whose main values the input tells."""
    values = section.model_dump(exclude_none=True)
    nodes = {_NODES[key]: float(value) for key, value in values.items() if key in _NODES}

    def value(name: str) -> float:
        formula = _SIZES.get(name)
        return nodes[name] if formula is None else float(evaluate(formula, value))

    return Prototype(section.name, value)


def _pairs(chapter: Chapter) -> list[tuple[Main, float, float]]:
    """Return main values that both engines have."""
    prototype = chapter.prototype
    if prototype is None:
        return []
    pairs = ((main, _value(main.value, chapter.terms.value), _value(main.value, prototype.value))
             for main in _MAIN)  # fmt: skip
    return [(main, value, other) for main, value, other in pairs
            if value is not None and other is not None]  # fmt: skip


def _denser(pairs: list[tuple[Main, float, float]]) -> str:
    """By how much the power per litre is above the prototype's, in words."""
    values = {main.tex: (value, other) for main, value, other in pairs}
    if _MAIN[-1].tex not in values:
        return ""
    value, other = values[_MAIN[-1].tex]
    percent = fixed(abs(value / other - 1) * 100, 1)
    if not float(percent.replace(",", ".")):
        return "равна литровой мощности прототипа"
    return f"{'больше' if value > other else 'меньше'}, чем у прототипа, на {percent}{NBSP}%"


def concluded(chapter: Chapter) -> Markup:
    """What of the data and of the cycle lies outside its usual range, with the range, in a line."""
    parts = [
        Markup("{} {} ({})").format(
            uncapital(each.reason.title), with_unit(each.shown, each.reason.unit), each.bounds
        )
        for each in judge(chapter) if each.verdict is not Standing.INSIDE
    ]  # fmt: skip
    has_cycle = "cycle" in chapter.relevant
    if has_cycle:
        parts += cycle.outside_lines(chapter.terms, set(_OF_CYCLE.values()))
    if not parts:
        also = " и результаты расчёта цикла" if has_cycle else ""
        return Markup(f"принятые данные{also} лежат в обычных пределах")
    return Markup("вне обычных пределов: ") + Markup("; ").join(parts)


def numbers(terms: Terms) -> Callable[[str], float]:
    """Nodes of an engine by name, and how many rods stand on a crankpin."""
    rods = float(rods_beside(arrangement_of(terms.model.input), 0))
    return lambda name: rods if name == RODS else terms.value(name)


def judge(chapter: Chapter) -> Iterator[Judged]:
    """Every reason that the engine's data allow to judge."""
    model, prototype = chapter.input, chapter.prototype
    number = numbers(chapter.terms)
    bore = 2000 * float(evaluate("sqrt(F_piston/pi)", number))
    sizes = Sizes(bore, 1000 * number("r_crank"), 1000 * number("L_rod"))
    kind, times = stated_kind(model), sizes.heavier
    section, several = section_of(model), several_rods(model)
    by_cycle = {} if section is None else {r.name: (r.low, r.high) for r in ranges_of(section)}
    for reason in REASONS:
        key = _of_worst_pin(reason, chapter)
        value = _value(key.value, number)
        of_cycle = _OF_CYCLE.get(reason.key, "")
        unknown = section is not None and of_cycle and of_cycle not in by_cycle  # with boost
        if value is not None and not unknown and not (reason.one_rod and several):
            other = None if prototype is None else _value(reason.value, prototype.value)
            span = by_cycle.get(of_cycle, reason.span(kind, times))
            required, least = (_value(of, number) for of in (key.required, key.least))
            yield Judged(key, value, other, *span, bore, required, least)


def several_rods(model: InputFile) -> bool:
    """Whether a throw bears rods side by side: some spans are of a throw with one rod."""
    return rods_beside(arrangement_of(model), 0) > 1


def _of_worst_pin(reason: Reason, chapter: Chapter) -> Reason:
    """Return a reason on the pressure of a big-end bearing: of the greatest among the pins.

    Of equal ones it is that of the pin whose loads the chapter tells.
    """
    if not reason.value[0].startswith("q_pin_"):
        return reason
    terms, stems = chapter.terms, pin_stems(chapter.shape)
    keys = [reason.value[0].replace("q_pin_", f"q_{stem}_") for stem in stems]
    first, leading = worst_pin(terms), leaders(terms, keys)
    key = keys[(first if first in leading else leading[0]) - 1]
    return replace(reason, value=(key,), tex=chapter.terms.quantity(key).tex)


def _value(formulas: Sequence[str], number: Callable[[str], float]) -> float | None:
    for text in formulas:
        try:
            return float(evaluate(text, number))
        except KeyError:  # the engine's data go another way
            continue
    return None


def _main_table(pairs: list[tuple[Main, float, float]]) -> TableBlock:
    columns = [
        TableColumn("Показатель", 4, text=True), TableColumn("Символ", 1.2),
        TableColumn("Двигатель", 1.5), TableColumn("Прототип", 1.5),
        TableColumn("Отличие, %", 1.5),
    ]  # fmt: skip
    rows = []
    for main, value, other in pairs:
        title = rich(f"{main.title}, {main.unit}" if main.unit else main.title)
        texts = (fixed(value, main.digits), fixed(other, main.digits))
        rows.append([title, inline_html(main.tex), *texts, fixed((value / other - 1) * 100, 1)])
    return table_block(columns, rows)


def _table(judged: list[Judged], compared: bool) -> TableBlock:
    columns = [
        TableColumn("Величина", 6.8, text=True), TableColumn("Символ", 1.2),
        TableColumn("Принято", 1.2), *([TableColumn("Прототип", 1.3)] if compared else []),
        TableColumn("Обычно", 1.6), TableColumn("Вывод", 1.8), TableColumn("Основание", 1.5),
    ]  # fmt: skip
    rows = []
    for each in judged:
        unit = f", {each.reason.unit}" if each.reason.unit else ""
        other = "—" if each.other is None else fixed(each.other, each.reason.digits)
        rows.append([
            rich(each.reason.title + unit), inline_html(each.reason.tex), each.shown,
            *([other] if compared else []), each.usual, WORDS[each.verdict],
            each.place,
        ])  # fmt: skip
    return table_block(columns, rows)
