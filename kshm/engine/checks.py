"""What no engine can be is refused where it is made, in one line."""

from __future__ import annotations

import math
from dataclasses import fields

POSITIVE, NOT_NEGATIVE, FINITE = "positive", "not negative", "finite"


def refuse(*problems: tuple[bool, str]) -> None:
    """Raise the first problem that is one.

    Raises:
        ValueError: with the text of that problem.
    """
    for wrong, text in problems:
        if wrong:
            raise ValueError(text)


def check_numbers(part: object, want: str, *names: str) -> None:
    """Numbers of a part of an engine, single ones and tuples of them; None counts as not given.

    Args:
        part: a dataclass; its name and the field's are told.
        want: "positive", "not negative" or "finite".
        names: fields to check; all others must be finite.

    Raises:
        ValueError: a number is NaN, infinite or not as wanted.
    """
    for field in fields(part):  # type: ignore[arg-type]
        value = getattr(part, field.name)
        kind = want if field.name in names else FINITE
        for number in value if isinstance(value, tuple) else (value,):
            if isinstance(number, int | float) and not _is(number, kind):
                msg = f"{type(part).__name__}: {field.name} must be {kind}, not {number:g}"
                raise ValueError(msg)


def _is(number: float, kind: str) -> bool:
    least = {POSITIVE: math.ulp(0.0), NOT_NEGATIVE: 0.0}.get(kind, -math.inf)
    return math.isfinite(number) and number >= least
