"""What the note prints of a condition, and that it is what the condition means."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.document.text.tolerances import tolerance
from reports.formula.numeric import evaluate
from reports.formula.spans import spans_of

NAMES = {"limit": 130.0, "k": 2.0, "word": "текст", "column": None}
PRINTED = {
    "value <= 125": "не более 125", "value < 125": "менее 125", "value >= -5": "не менее −5",
    "value > 0.5": "более 0,5", "value == 5": "5", "value != 0": "не равно 0",
    "value <= 10**3": "не более 1000", "value <= 2*115": "не более 230",
    "value <= 230/2 + 1": "не более 116", "value <= -10": "не более −10",
    "value > 1e6": "более 1000000", "value <= 0.0005": "не более 0,0005",
    "value <= 0.000001": "0", "value <= 137.8671": "не более 137,8671",
    "230 >= value": "не более 230", "10 < value": "более 10", "5 == value": "5",
    "10 <= value <= 230": "10…230", "230 >= value >= 10": "10…230",
    "value >= 0.15 and value <= 0.45": "0,15…0,45",
    "value > 1 and value <= 3": "более 1 и не более 3",
    "1 < value < 3": "более 1 и менее 3", "value >= 1 and value >= 2": "не менее 2",
    "not value > 230": "не более 230", "not (value < 1 or value > 3)": "1…3",
    "not not value < 3": "менее 3", "not value == 4": "не равно 4",
    "value > 0 or value < -5": "менее −5 или более 0", "value < 1 or value == 7": "менее 1 или 7",
    "value <= 1 or 2 <= value <= 3": "не более 1 или 2…3",
    "abs(value) <= 2": "±2", "abs(value) > 2": "менее −2 или более 2",
    "abs(value - 720) <= 0.000001": "720", "abs(value - 5) <= 1": "4…6",
    "abs(value) == 3": "−3 или 3",
    "value <= limit": "не более 130", "value <= k*limit": "не более 260",
    "limit >= value >= 1": "1…130", "value <= max(1, k)": "не более 2",
    "-value <= 5": "не менее −5", "2*value + 1 <= 5": "не более 2", "3 - value <= 1": "не менее 2",
    "value/2 > 3": "более 6", "value*(-2) < 6": "более −3",
    "value <= 1 if k > 1 else value <= 3": "не более 1",
    # No span: the formula.
    "value*value < 4": "значение·значение < 4", "1/value < 3": "1/значение < 3",
    "value < k*value": "значение < k·значение", "min(value, 3) < 2": "min(значение; 3) < 2",
    "value <= word": "значение ≤ word", "value <= column": "значение ≤ column",
    "value < 5 and value > 10": "значение < 5 и значение > 10",
    "value < 5 or value > 1": "значение < 5 или значение > 1",
}  # fmt: skip


@pytest.mark.parametrize("condition", PRINTED)
def test_a_limit_is_printed_as_its_value(condition: str):
    for text in (condition, f'"да" if ({condition}) else "НЕТ"'):
        assert tolerance(text, "value", NAMES.__getitem__, str) == PRINTED[condition]


numbers = st.integers(-4, 4)
sides = st.sampled_from(["value", "-value", "2*value", "value + 1", "3 - value", "abs(value)",
                         "abs(value - 1)", "value/-2"])  # fmt: skip
signs = st.sampled_from(["<", "<=", ">", ">=", "==", "!="])
comparisons = st.builds("{} {} {}".format, sides, signs, numbers)
conditions = st.recursive(
    comparisons,
    lambda inner: st.one_of(
        st.builds("not ({})".format, inner),
        st.builds("({} and {})".format, inner, inner),
        st.builds("({} or {})".format, inner, inner),
    ),
    max_leaves=5,
)


@given(conditions)
def test_spans_are_where_the_condition_holds(condition: str):
    spans = spans_of(condition, "value", NAMES.__getitem__)
    assert spans is not None and list(spans) == sorted(spans)
    for half in range(-41, 42):
        x = half / 4
        within = any(
            (s.low < x or (s.low == x and not s.above)) and (x < s.high or (s.high == x and s.upto))
            for s in spans
        )
        assert within == bool(evaluate(condition, {"value": x}.__getitem__)), x
    assert all(not math.isnan(end) for s in spans for end in (s.low, s.high))
