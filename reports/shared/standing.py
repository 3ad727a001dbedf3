"""Judgement of a number by its limits: made once, as a value; words stand where it is written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from reports.shared.russian import as_printed

_SPAN_DIGITS = 3  # significant digits of the printed ends of a span


class Standing(Enum):
    """Where a number lies: in its usual span, outside of it, or where it must not be."""

    INSIDE = "inside"
    BELOW = "below"
    ABOVE = "above"
    FAILED = "failed"


class Severity(Enum):
    """How grave a remark is."""

    WARNING = "Внимание"
    NOTE = ""


@dataclass(frozen=True, slots=True)
class Notice:
    """A remark for the console and the sheet of checks."""

    severity: Severity
    text: str

    @property
    def line(self) -> str:
        """The remark in a line, a warning with its word."""
        word = self.severity.value
        return f"{word}: {self.text}" if word else self.text


WORDS: Mapping[Standing, str] = {
    Standing.INSIDE: "в пределах",
    Standing.BELOW: "ниже",
    Standing.ABOVE: "выше",
    Standing.FAILED: "недостаточно",
}


def standing(value: float, span: tuple[float, float], digits: int) -> Standing:
    """Standing of a number as it is printed in a span as it is printed, whose ends are inside."""
    low, high = printed_span(span)
    printed = as_printed(value, digits)
    if printed < low:
        return Standing.BELOW
    return Standing.ABOVE if printed > high else Standing.INSIDE


def printed_span(span: tuple[float, float]) -> tuple[float, float]:
    """Return ends of a span as they are printed."""
    low, high = (float(f"{end:.{_SPAN_DIGITS}g}") for end in span)
    return low, high
