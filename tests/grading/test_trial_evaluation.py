"""Other engines on which formulas are tried: what is typed in is right for one of them at most."""

from __future__ import annotations

from dataclasses import replace

import pytest

from reports.grading.judging.trial_evaluation import (
    Trial,
    fixed,
    known_numbers,
    stepping,
    trials_of,
)
from reports.model.evaluation import Evaluation
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


@pytest.mark.parametrize("seed", range(40))
def test_the_third_leaves_no_ratio_of_neighbours_as_it_was(seed: int) -> None:
    """λ, where no student has another: a column made with one's own was right for it by chance."""
    first, _, third = trials_of(assignment(), register().books, str(seed))
    fields = assignment().model.fields
    kept = ("geometry", "regime", "gas")
    values = [third.inputs[name] / float(fields[name].value) for name in third.inputs
            if name.startswith(kept) and name not in first.inputs]  # fmt: skip
    times = list(dict.fromkeys(round(factor, 9) for factor in values))
    assert len(times) > 5
    least = 0.2 * (max(times) - min(times))
    for further in (1, 2):
        assert all(abs(a - b) > least for a, b in zip(times, times[further:], strict=False))


def test_a_speed_is_known_in_thousands_but_not_where_it_may_be_anything() -> None:
    fields, trials = assignment().model.fields, trials_of(assignment(), register().books, "1")
    speed = replace(fields["regime_speed_rpm"], value=4250)
    known = known_numbers({**fields, speed.name: speed}, trials)
    assert known[4.25] == (speed.name, 1e-3)
    round_speed = replace(speed, value=4000)
    assert 4.0 not in known_numbers({**fields, speed.name: round_speed}, trials)


def test_angles_of_ones_own_are_not_taken_for_input_data() -> None:
    """Among them is 420, the mass of a piston in grams, and 90, a bore."""
    angles = {("П4.1", 20, 6 + i): 30.0 * i for i in range(25)}
    data = {("Мой вариант", 2, i): value for i, value in enumerate((90.0, 94.0, 148.0, 4400.0))}
    alike = {("Мой вариант", 3, i): 0.245 for i in range(6)}
    assert stepping(angles | data | alike) == set(angles)


def test_an_angle_is_no_other_a_turn_further() -> None:
    """Extremes at 0, 360 and 720 are alike for all engines: ``=360+0*n`` follows from nothing."""
    own, node = Evaluation(assignment().model), "phi_vmax_deg"
    for further, same in ((360.0, True), (-720.0, True), (180.0, False)):
        other = own.fork({node: own.value(node) + further})
        assert fixed(node, own, (Trial({}, other, decides=True),)).all() == same
