"""Ranges of quantities: each in order, the usual one inside the doubtful one."""

from __future__ import annotations

import pytest

from kshm.ranges import RANGES


@pytest.mark.parametrize("name", RANGES)
def test_what_is_usual_is_not_doubtful(name: str) -> None:
    """An input would be called usual by one room and doubtful by another."""
    ranges = RANGES[name]
    assert ranges.usual or ranges.doubtful
    for group, (low, high) in ranges.usual.items():
        assert low <= high
        kind = group.split("_", maxsplit=1)[0]
        least, most = ranges.doubtful.get(kind, ranges.doubtful.get("", (low, high)))
        assert least <= low and high <= most


def test_groups_of_a_kind_go_together() -> None:
    peak = RANGES["combustion.p_z"]
    assert peak.of("diesel") == (5, 15)
    assert peak.of("diesel_na") == (5, 12)
    assert peak.of() == (3.5, 15)
    assert RANGES["st_crown_MPa"].of("iron") == (40, 200)
    assert RANGES["st_q1_MPa"].of("iron") == (0, 1)
