"""The state of a work: one word for its page, its JSON, the gradebook, Moodle and the server."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import Any


class State(StrEnum):
    """What has become of a work."""

    CHECKED = "проверено"
    BY_HAND = "нужна ручная проверка"
    HELD = "ждёт решения"  # it may be another's: no points until a person has decided
    REFUSED = "не принято"
    UNKNOWN = "не опознано"
    ABSENT = "не сдано"


_OF_FILE = {"graded": State.CHECKED, "refused": State.REFUSED, "unmatched": State.UNKNOWN}


def state_of(status: str, open_items: Sequence[str], doubts: Sequence[str]) -> State:
    """State of a file: what became of it, what a person is asked, why it may be another's."""
    if doubts:
        return State.HELD
    by_hand = status == "graded" and open_items
    return State.BY_HAND if by_hand else _OF_FILE[status]


def state_of_result(result: Mapping[str, Any]) -> State:
    """State of a result by itself, whatever the class says of it."""
    return state_of(result["status"], result["manual"], result.get("doubts", ()))
