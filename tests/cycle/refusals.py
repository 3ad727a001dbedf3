"""Refusals of the cycle in the words that a person reads."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from kshm.errors import CycleError
from reports.inputs.to_si.cycle import text_of


@contextmanager
def refused(match: str = "") -> Iterator[pytest.ExceptionInfo[CycleError]]:
    """Demand a ``CycleError`` whose Russian text matches."""
    with pytest.raises(CycleError) as caught:
        yield caught
    text = text_of(caught.value.remark)
    assert re.search(match, text), text
    assert "\n" not in text
