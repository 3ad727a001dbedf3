"""Chapter on why the data are what they are: usual ranges, the prototype, what follows."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

from markupsafe import Markup

from kshm.engine.arrangement import rods_beside
from reports.document.chapters.chapter import Chapter, after_noun
from reports.document.page.blocks import TableBlock, TableColumn, table_block
from reports.document.page.numbering import TablePlan
from reports.document.text.symbols import inline_html
from reports.document.text.terms import Terms, with_unit
from reports.document.text.texts import rich
from reports.formula.numeric import evaluate
from reports.inputs.checks.bands import stated_kind
from reports.inputs.firing import arrangement_of
from reports.inputs.reasons import REASONS, Reason
from reports.inputs.to_si.masses import Sizes
from reports.shared.russian import fixed, short, uncapital

_NEAR = 1e-9  # a value on the end of its span is inside


@dataclass(frozen=True, slots=True)
class Judged:
    """A reason with the value of the report's engine and of the prototype."""

    reason: Reason
    value: float
    other: float | None
    low: float
    high: float

    @property
    def verdict(self) -> str:
        """Where the value lies."""
        if self.value < self.low * (1 - _NEAR):
            return "ниже"
        return "выше" if self.value > self.high * (1 + _NEAR) else "в пределах"

    @property
    def shown(self) -> str:
        """The value in print."""
        return fixed(self.value, self.reason.digits)

    @property
    def usual(self) -> str:
        """The span in print."""
        ends = (float(f"{end:.3g}") for end in (self.low, self.high))
        return "…".join(short(end) for end in ends)

    @property
    def line(self) -> Markup:
        """What lies outside and what follows."""
        reason, shown = self.reason, with_unit(self.shown, self.reason.unit)
        follows = reason.above if self.verdict == "выше" else reason.below
        side = "больше" if self.verdict == "выше" else "меньше"
        words = '{} <span class="nb">{} = {}</span> {} обычного ({}): {}'
        return Markup(words).format(
            reason.title, inline_html(reason.tex), shown, side, self.usual, follows
        )


def rationale(chapter: Chapter) -> Markup:
    """The data beside usual ranges and the prototype."""
    judged = list(judge(chapter))
    prototype = chapter.prototype
    return chapter.page(
        "rationale",
        plan=TablePlan(partial(_table, judged, prototype is not None),
                       "Принятые данные и обычные пределы", size="dense", lined=True),
        outside=[each.line for each in judged if each.verdict != "в пределах"],
        prototype=after_noun(prototype.model.input.engine.name) if prototype else "",
    )  # fmt: skip


def concluded(chapter: Chapter) -> Markup:
    """What of the data lies outside its usual range, with the range, in a line."""
    outside = [each for each in judge(chapter) if each.verdict != "в пределах"]
    if not outside:
        return Markup("принятые данные лежат в обычных пределах")
    parts = (
        Markup("{} {} (обычно {})").format(
            uncapital(each.reason.title), with_unit(each.shown, each.reason.unit), each.usual
        )
        for each in outside
    )
    return Markup("вне обычных пределов: ") + Markup("; ").join(parts)


def judge(chapter: Chapter) -> Iterator[Judged]:
    """Every reason that the engine's data allow to judge."""
    model, prototype = chapter.input, chapter.prototype
    number = chapter.terms.value
    bore = 2000 * float(evaluate("sqrt(F_piston/pi)", number))
    sizes = Sizes(bore, 1000 * number("r_crank"), 1000 * number("L_rod"))
    kind, times = stated_kind(model), sizes.heavier
    several = rods_beside(arrangement_of(model), 0) > 1
    for reason in REASONS:
        value = _value(reason, chapter.terms)
        if value is not None and not (reason.one_rod and several):
            other = _value(reason, prototype) if prototype is not None else None
            yield Judged(reason, value, other, *reason.span(kind, times))


def _value(reason: Reason, terms: Terms) -> float | None:
    for text in reason.value:
        try:
            return float(evaluate(text, terms.value))
        except KeyError:  # the engine's data go another way
            continue
    return None


def _table(judged: list[Judged], compared: bool) -> TableBlock:
    columns = [
        TableColumn("Величина", 4.4, text=True), TableColumn("Символ", 1.3),
        TableColumn("Принято", 1.2), *([TableColumn("Прототип", 1.3)] if compared else []),
        TableColumn("Обычно", 1.7), TableColumn("Вывод", 1.5), TableColumn("Основание", 1.6),
    ]  # fmt: skip
    rows = []
    for each in judged:
        unit = f", {each.reason.unit}" if each.reason.unit else ""
        other = "—" if each.other is None else fixed(each.other, each.reason.digits)
        rows.append([
            rich(each.reason.title + unit), inline_html(each.reason.tex), each.shown,
            *([other] if compared else []), each.usual, each.verdict,
            each.reason.place or "принято",
        ])  # fmt: skip
    return table_block(columns, rows)
