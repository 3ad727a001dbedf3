"""Other engines on which formulas are tried: what is typed in is right for one of them at most."""

from __future__ import annotations

from dataclasses import replace

import pytest

from reports.grading.judging.copied import known_numbers
from reports.grading.judging.trials import trials_of
from tests.grading.classroom import assignment, register


@pytest.mark.parametrize("seed", range(40))
def test_the_two_that_decide_are_far_from_each_other(seed: int) -> None:
    first, second, _ = trials_of(assignment(), register().books, str(seed))
    assert first.decides and second.decides
    for name in first.inputs:
        drawn = [float(book.drawn[key]) for book in register().books for key in book.drawn
                 if key.replace(".", "_") == name]  # fmt: skip
        low, high = min(drawn), max(drawn)
        if low == high:
            low, high = 0.95 * low, 1.05 * high
        assert low < second.inputs[name] < high
        assert abs(first.inputs[name] - second.inputs[name]) >= 0.249 * (high - low), name


def test_a_speed_is_known_in_thousands_but_not_where_it_may_be_anything() -> None:
    fields, trials = assignment().model.fields, trials_of(assignment(), register().books, "1")
    speed = replace(fields["regime_speed_rpm"], value=4250)
    known = known_numbers({**fields, speed.name: speed}, trials)
    assert known[4.25] == (speed.name, 1e-3)
    round_speed = replace(speed, value=4000)
    assert 4.0 not in known_numbers({**fields, speed.name: round_speed}, trials)
