"""A value that is compared with an allowed one says what it is wherever it is printed."""

from __future__ import annotations

import pytest

from reports.model.blocks import Held, ScalarTable
from reports.tables.registry import build_model
from tests.document.test_report_parts import NEW, SAMPLES, with_every_part

_STEM = 5  # letters by which words are the same


@pytest.mark.parametrize("name", [*SAMPLES, *NEW])
def test_a_value_beside_what_is_allowed_is_named_as_its_list(name: str):
    """«Запас прочности не меньше допускаемого: нет — щёки 1,02» left out what 1,02 is."""
    lists = [block for block in build_model(with_every_part(name)).blocks
             if isinstance(block, ScalarTable) and block.held is Held.ALLOWED]  # fmt: skip
    assert len(lists) >= 4
    nameless = {
        scalar.note
        for block in lists
        for scalar, _ in block.pairs
        if block.title[:_STEM].lower() not in scalar.note.lower()
    }
    assert nameless == set()
