"""Steps of a formula that do nothing: written so that two formulas should not look alike."""

from __future__ import annotations

import pytest

from reports.grading.judging.work_digest import is_odd
from reports.recalculation.formulas import pattern


@pytest.mark.parametrize(
    "text", ["A6*1", "A6/1", "2*A6^1", "A6+0", "A6-0.0", "A6*1/3", "SIN(A6)+(A7-A7)", "(A6)+0"]
)
def test_a_step_that_does_nothing_is_seen(text: str) -> None:
    assert is_odd(pattern(text, 6, 2))


@pytest.mark.parametrize(
    "text", ["A6*10", "A6+10", "1+A6^2", "SQRT(1-A6^2)", "A6-A7", "IF(A6>0,A6,0)", "1*A6", "0-A6*2"]
)
def test_an_ordinary_formula_has_none(text: str) -> None:
    assert not is_odd(pattern(text, 6, 2))
