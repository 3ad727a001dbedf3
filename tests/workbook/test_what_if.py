"""The sheet «Что если»: with changed data it shows old, new and the difference."""

from __future__ import annotations

import formualizer
import pytest

from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from reports.workbook.cockpit import SHEET
from reports.workbook.layout import HEADER_ROW, Layout
from tests.referee.changes import Change, with_values
from tests.workbook.made import coarse_book, coarse_model
from tools.referees.cells import stripped


def lines(engine: formualizer.Workbook) -> dict[str, tuple[float, float, float]]:
    """Symbol → was, is, difference in percent."""
    collected = {}
    for row in range(HEADER_ROW + 1, 130):
        symbol, *numbers = (engine.get_value(SHEET, row, column) for column in range(2, 6))
        if symbol and all(isinstance(n, int | float) for n in numbers):
            collected.setdefault(symbol, tuple(map(float, numbers)))
    return collected


@pytest.mark.parametrize("name", ["gots-diesel", "two-stroke"])
def test_a_lighter_piston(name: str) -> None:
    model = coarse_model(name)
    field = next(f for f in model.inputs if f.name in
                 ("masses_reciprocating_kg", "masses_piston_group_kg"))  # fmt: skip
    engine = formualizer.load_workbook_bytes(stripped(coarse_book(name))[0])
    engine.evaluate_all()
    before = lines(engine)
    assert len(before) > 25
    assert all(was == pytest.approx(now, rel=1e-12) for was, now, _ in before.values())
    assert {percent for _, _, percent in before.values()} == {0.0}

    lighter = 0.8 * field.value
    position = Layout.of(model).cells[field.name]
    engine.set_value(position.sheet, position.row, position.column, lighter)
    engine.evaluate_all()
    changed = with_values(model.input, [Change(field, lighter)])
    assert changed is not None
    expected = evaluate_model(build_model(changed)).scalars
    old = evaluate_model(model).scalars
    after = lines(engine)
    seen = 0
    for key in ("M_mean", "M_max", "M_min", "Rpin_mean", "Rpin_max", "q_pin_max", "j_tdc"):
        was, now, percent = after[model.scalars[key].quantity.symbol]
        assert was == pytest.approx(old[key], rel=1e-12)
        assert now == pytest.approx(expected[key], rel=1e-9)
        assert percent == pytest.approx((expected[key] / old[key] - 1) * 100, abs=1e-6)
        seen += abs(percent) > 1
    assert seen >= 3
    own = [collected for collected in after.values() if collected[0] == field.value]
    assert any(now == lighter and percent == pytest.approx(-20) for _, now, percent in own)
