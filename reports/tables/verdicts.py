"""Which checks of a calculation failed, and which of them the input explains."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from reports.inputs.sections.input_file import InputFile
from reports.model.blocks import NO, Block, Model, scalars_of
from reports.model.evaluation import Values
from reports.shared.russian import fixed

_PREFIX = "check_"


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


def failed_checks(model: Model, values: Values) -> list[Failed]:
    """The checks that did not pass, in their order."""
    reasons = reasons_of(model.input)
    return [
        Failed(
            key.removeprefix(_PREFIX),
            scalar.note,
            check_value(float(values.scalars[f"value_{key.removeprefix(_PREFIX)}"])),
            reasons.get(key.removeprefix(_PREFIX), ""),
        )
        for key, scalar in model.scalars.items()
        if key.startswith(_PREFIX) and values.scalars[key] == NO
    ]


def accepted_checks(model: InputFile, blocks: Sequence[Block]) -> tuple[str, ...]:
    """Lines about the checks whose failure the input explains."""
    titles = {scalar.key: scalar.note for block in blocks for scalar in scalars_of(block)}
    return tuple(
        f"Принято расхождение «{titles[_PREFIX + name]}»: {reason}"
        for name, reason in reasons_of(model).items()
        if _PREFIX + name in titles
    )


def reasons_of(model: InputFile) -> dict[str, str]:
    """Reasons that the input gives, by check or key."""
    accepted = () if model.checks is None else model.checks.accepted
    return {entry.what: entry.reason for entry in accepted}


def check_value(value: float) -> str:
    """What a check found, as it is printed."""
    return fixed(value, 2 if abs(value) >= 1 else 4)
