"""The engines that expensive comparisons take hold all that all engines hold."""

from __future__ import annotations

import pytest

from tests.conftest import sample_names
from tests.cover import (
    Kind,
    chapters,
    charts,
    choices,
    covering,
    formulas,
    held,
    operations,
    quantities,
    smallest,
)
from tests.layouts import MAKERS

SAMPLES, LAYOUTS = tuple(sample_names()), tuple(MAKERS)


@pytest.mark.parametrize(
    ("kind", "names"),
    [(kind, SAMPLES) for kind in (quantities, charts, chapters, choices, operations)]
    + [(formulas, SAMPLES + LAYOUTS)],
    ids=["quantities", "charts", "chapters", "choices", "operations", "formulas"],
)
def test_nothing_is_left_out_and_nobody_is_needless(kind: Kind, names: tuple[str, ...]) -> None:
    def together(some: list[str]) -> set[tuple]:
        return set().union(*(held(name, kind) for name in some))

    taken = covering(names, (kind,))
    assert together(taken) == together(list(names))
    for name in taken:
        assert together([other for other in taken if other != name]) < together(taken), name
    assert len(taken) < len(names)


def test_every_table_function_chart_and_chapter_counts() -> None:
    """A kind that sees nothing would be covered by anybody."""
    for name in SAMPLES:
        assert len(held(name, formulas)) > 500 and len(held(name, quantities)) > 500
        assert len(held(name, charts)) > 50 and len(held(name, chapters)) > 10
    assert {("function", "element"), ("block", "P#_#")} <= held("gots-diesel", quantities)
    assert {("section", "torsion"), ("chapter", "torsion")} <= held("mwm-6", chapters)
    assert {"element", "sqrt", "wave_cos"} <= {name for _, name, _ in held("mwm-6", operations)}


def test_what_is_new_joins_by_itself() -> None:
    collected = {"one": {1, 2, 3}, "other": {3, 4}, "again": {1, 2}}
    cost = dict.fromkeys([*collected, "new"], 1)
    assert smallest(collected, cost) == ["one", "other"]
    assert smallest(collected | {"new": {5}}, cost) == ["one", "other", "new"]
    assert smallest(collected, cost | {"one": 9}) == ["other", "again"]
