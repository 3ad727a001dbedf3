"""Which checks of a calculation failed, and which of them the input explains."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from kshm.ranges import side_of
from reports.inputs.sections.input_file import InputFile
from reports.model.blocks import NO, YES, Block, Held, Model, Scalar, ScalarTable, scalars_of
from reports.model.evaluation import Values
from reports.shared.russian import fixed, uncapital
from reports.shared.standing import Standing

_PREFIX, _ALLOWED = "check_", "allowed_"


@dataclass(frozen=True, slots=True)
class JudgedValue:
    """A value of the tables and where it stands; ``key`` is that of its verdict."""

    block: str
    held: Held
    key: str
    title: str
    value: float
    standing: Standing

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
            yield JudgedValue(block.id, held, verdict.key, scalar.label, value, where)


def _outside(value: float, usual: tuple[float, float] | None) -> Standing:
    if usual is None:
        return Standing.FAILED
    return Standing.ABOVE if side_of(value, usual) > 0 else Standing.BELOW


@dataclass(frozen=True, slots=True)
class Failed:
    """A check that did not pass; ``reason`` is the input's own, empty if it gives none."""

    key: str
    title: str
    value: str
    reason: str

    def line(self) -> str:
        """Return the one-line message."""
        text = f"не выполнена проверка «{self.title}»: получено {self.value}"
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
    names = {scalar.key for scalar in checks_of(model, department=department).values()}
    return [
        Failed(each.name, each.title, check_value(each.value), reasons.get(each.name, ""))
        for each in outcomes(model, values.scalars)
        if each.standing is not Standing.INSIDE
        and each.key in names
        and (each.held is Held.CHECK or each.key in model.department)
    ]


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
    return fixed(value, 2 if abs(value) >= 1 else 4)
