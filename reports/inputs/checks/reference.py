"""Checks of the [reference] section."""

from __future__ import annotations

from collections.abc import Iterator

from reports.inputs.findings import Finding, Values
from reports.inputs.sections.reference import MOST_LAMBDAS


def check_reference(values: Values) -> Iterator[Finding]:
    """Yield what is wrong about the list of λ."""
    count = values.counts.get(("reference", "lambdas"))
    if count is not None and not 1 <= count <= MOST_LAMBDAS:
        what = f"значений {count}, а нужно от 1 до {MOST_LAMBDAS}"
        yield Finding(("reference", "lambdas"), what, "исправьте список")
