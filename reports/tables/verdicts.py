"""Which checks of a calculation failed, and which of them the input explains."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from kshm.ranges import side_of
from reports.formula.parse import names
from reports.inputs.sections.input_file import InputFile
from reports.model.blocks import NO, YES, Block, Held, Model, Scalar, ScalarTable, scalars_of
from reports.model.evaluation import Evaluation, Values
from reports.shared.russian import fixed, uncapital
from reports.shared.standing import Standing

_PREFIX, _ALLOWED = "check_", "allowed_"


@dataclass(frozen=True, slots=True)
class JudgedValue:
    """A value of the tables and where it stands; ``key`` is that of its verdict."""

    block: str
    held: Held
    key: str
    scalar: Scalar
    value: float
    standing: Standing

    @property
    def title(self) -> str:
        """What it is, with its usual span."""
        return self.scalar.label

    @property
    def name(self) -> str:
        """The check's name in a file."""
        return self.key.partition("_")[2]


def outcomes(model: Model, scalars: Mapping[str, float | str]) -> tuple[JudgedValue, ...]:
    """All values that the tables judge, in order; none of a list that is to be filled in.

    The only place that reads the words of the tables.
    """
    return tuple(each for block in model.blocks if isinstance(block, ScalarTable)
                 for each in _judged(block, scalars))  # fmt: skip


def _judged(block: ScalarTable, scalars: Mapping[str, float | str]) -> Iterator[JudgedValue]:
    held, words = block.held, block.verdicts or (YES, NO)
    if held is None:
        return
    for scalar, verdict in block.pairs:
        said = scalars.get(verdict.key)
        if said in words:
            value = float(scalars[scalar.key])
            where = Standing.INSIDE if said == words[0] else _outside(value, scalar.usual)
            yield JudgedValue(block.id, held, verdict.key, scalar, value, where)


def _outside(value: float, usual: tuple[float, float] | None) -> Standing:
    if usual is None:
        return Standing.FAILED
    return Standing.ABOVE if side_of(value, usual) > 0 else Standing.BELOW


@dataclass(frozen=True, slots=True)
class Failed:
    """A check that did not pass.

    ``reason`` is the input's own, empty if it gives none; ``counted`` are the values that a
    check counts.
    """

    key: str
    title: str
    value: str
    reason: str
    counted: tuple[str, ...] = ()

    def line(self) -> str:
        """Return the one-line message."""
        text = f"не выполнена проверка «{self.title}»: получено {self.value}"
        text += f" ({'; '.join(self.counted)})" if self.counted else ""
        if self.reason:
            return f"{text}; причина: {self.reason}"
        return f'{text}; исправьте данные или объясните: [[checks.accepted]], what = "{self.key}"'


def checks_of(model: Model, *, department: bool = False) -> dict[str, Scalar]:
    """Verdicts by the names of their checks, in order; of own books what is allowed as well.

    ``department`` leaves those of own books alone.
    """
    names: dict[str, Scalar] = {}
    for key, scalar in model.scalars.items():
        theirs = key in model.department
        prefixes = (_PREFIX, _ALLOWED) if theirs else (_PREFIX,)
        if key.startswith(prefixes) and (theirs or not department):
            names[key.partition("_")[2]] = scalar
    return names


def failed_checks(model: Model, values: Values, *, department: bool = False) -> list[Failed]:
    """Return checks that did not pass, in their order; ``department`` leaves those of own books."""
    reasons = reasons_of(model.input)
    keys = {scalar.key for scalar in checks_of(model, department=department).values()}
    judged = outcomes(model, values.scalars)
    return [
        Failed(each.name, each.title, check_value(each.value), reasons.get(each.name, ""),
               _counted(each, model, judged))
        for each in judged
        if each.standing is not Standing.INSIDE
        and each.key in keys
        and (each.held is Held.CHECK or each.key in model.department)
    ]  # fmt: skip


def _counted(check: JudgedValue, model: Model, judged: Sequence[JudgedValue]) -> tuple[str, ...]:
    """Return the values beyond what is usual that a check counts, where it is their number."""
    marks = (model.scalars[name] for name in names(check.scalar.expr) if name in model.scalars)
    watched = frozenset[str]().union(*(names(mark.expr) for mark in marks))
    beyond = [
        f"{uncapital(each.scalar.note)} {check_value(each.value)}, обычно {each.scalar.usual_text}"
        for each in judged
        if each.held is Held.USUAL and each.scalar.expr in watched and each.scalar.usual
        and abs(each.value) > each.scalar.usual[1]
    ]  # fmt: skip
    return tuple(beyond) if len(beyond) == check.value else ()


def failed_of(model: Model, *, department: bool = False) -> list[Failed]:
    """Return checks that an engine does not pass and does not explain, no more calculated."""
    run = Evaluation(model)
    keys = {verdict.key for verdict in checks_of(model, department=department).values()}
    lists = [block for block in model.blocks if isinstance(block, ScalarTable) and block.held]
    scalars = {
        scalar.key: run.value(scalar.key)
        for block in lists if block.held is Held.USUAL or keys & {v.key for _, v in block.pairs}
        for pair in block.pairs for scalar in pair
    }  # fmt: skip
    failed = failed_checks(model, Values(scalars, {}), department=department)
    return [each for each in failed if not each.reason]


def weak_values(model: Model, values: Values) -> tuple[str, ...]:
    """A line for each list whose values are not what is allowed; own books have checks of it."""
    weak: dict[str, list[str]] = {}
    for each in outcomes(model, values.scalars):
        beyond = each.held is Held.ALLOWED and each.standing is not Standing.INSIDE
        if beyond and each.key not in model.department:
            words = f"{uncapital(each.title)} {check_value(each.value)}"
            weak.setdefault(each.block, []).append(words)
    titles = {block.id: block.title for block in model.blocks if isinstance(block, ScalarTable)}
    return tuple(f"{titles[name]}: нет — {'; '.join(words)}" for name, words in weak.items())


def accepted_checks(model: InputFile, blocks: Sequence[Block]) -> tuple[str, ...]:
    """Lines about the checks whose failure the input explains."""
    titles = {scalar.key.partition("_")[2]: scalar.note for block in blocks
              for scalar in scalars_of(block)
              if scalar.key.startswith((_PREFIX, _ALLOWED))}  # fmt: skip
    return tuple(
        f"Принято расхождение «{titles[name]}»: {reason}"
        for name, reason in reasons_of(model).items()
        if name in titles
    )


def reasons_of(model: InputFile) -> dict[str, str]:
    """Reasons that the input gives, by check or key."""
    accepted = () if model.checks is None else model.checks.accepted
    return {entry.what: entry.reason for entry in accepted}


def check_value(value: float) -> str:
    """Return what a check found, as it is printed."""
    return fixed(value, 0 if value.is_integer() else 2 if abs(value) >= 1 else 4)
