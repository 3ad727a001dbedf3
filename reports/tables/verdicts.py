"""Which checks of a calculation failed, and which of them the input explains."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from reports.inputs.sections.input_file import InputFile
from reports.model.blocks import NO, Block, Model, Scalar, scalars_of
from reports.model.evaluation import Values
from reports.shared.russian import fixed

_PREFIX, _ALLOWED = "check_", "allowed_"


@dataclass(frozen=True, slots=True)
class Failed:
    """A check that did not pass; ``reason`` is the input's own, empty if it gives none."""

    key: str
    title: str
    value: str
    reason: str

    def line(self) -> str:
        """The one-line message."""
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
    """The checks that did not pass, in their order; ``department`` leaves those of own books."""
    reasons, value = reasons_of(model.input), values.scalars
    return [
        Failed(name, scalar.note, check_value(float(value[f"value_{name}"])), reasons.get(name, ""))
        for name, scalar in checks_of(model, department=department).items()
        if value[scalar.key] == NO
    ]


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
    """What a check found, as it is printed."""
    return fixed(value, 2 if abs(value) >= 1 else 4)
