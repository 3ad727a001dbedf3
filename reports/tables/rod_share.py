"""Share of a rod's mass at its small end: its usual bounds as words and as a test."""

from __future__ import annotations

from kshm.engine.engine import USUAL_SMALL_END_SHARE
from reports.inputs.units import number_text

USUAL_SHARE = (
    f"доля массы шатуна на поршневом пальце {'…'.join(map(number_text, USUAL_SMALL_END_SHARE))}"
)


def is_usual_share(name: str) -> str:
    """Expression that tells whether the share of that name is usual, its ends included."""
    low, high = USUAL_SMALL_END_SHARE
    return f"round({name}, 6) >= {low:g} and round({name}, 6) <= {high:g}"
