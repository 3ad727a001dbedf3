"""Usual ranges carry their source; names lead to the numbers."""

from dataclasses import replace

import pytest

from kshm.cycle.cycle import cycle
from kshm.cycle.names import EXTRA, INPUTS, OUTPUTS, value_of
from kshm.cycle.usual_ranges import RANGES, assess


def test_every_range_says_where_it_comes_from():
    for key, table in RANGES.items():
        assert table, key
        for usual in table.values():
            assert usual.low <= usual.high
            assert usual.source in ("memory", "web")
            assert ("не сверены" in usual.reference) == (usual.source == "memory")


def test_assessment_of_each_engine(engine):
    found = assess(cycle(engine))
    assert len(found) == len({a.key for a in found}) >= 12
    for a in found:
        assert a.inside == (a.usual.low - 1e-6 <= a.value <= a.usual.high + 1e-6)


def test_units_are_those_of_the_listing(diesel):
    found = {a.key: a for a in assess(cycle(diesel))}
    assert found["combustion.p_z"].value == pytest.approx(10.5)
    assert found["combustion.p_z"].inside
    assert found["inputs.t_residual"].value == 840


def test_outside_is_outside(diesel):
    found = {a.key: a.inside for a in assess(cycle(replace(diesel, excess_air=2.4, p_max=8e6)))}
    assert not found["inputs.excess_air"]


def test_boosted_petrol_is_not_measured_by_columns_of_the_natural_one(engines):
    keys = {a.key for a in assess(cycle(engines["turbo_petrol"]))}
    assert "compression.p_c" not in keys
    assert "expansion.n_2" in keys


def test_every_name_leads_to_a_number(diesel):
    r = cycle(diesel)
    for q in INPUTS:
        assert value_of(diesel, q.key) == value_of(r, f"inputs.{q.key}")
    for q in (*OUTPUTS, *EXTRA):
        assert value_of(r, q.key) > 0
    assert len(OUTPUTS) == 34
    assert len({q.key for q in (*INPUTS, *OUTPUTS, *EXTRA)}) == len((*INPUTS, *OUTPUTS, *EXTRA))


def test_a_missing_number_is_refused(engines):
    with pytest.raises(AttributeError):
        value_of(cycle(engines["petrol"]), "turbo.p_t")
    with pytest.raises(AttributeError):
        value_of(replace(engines["petrol"], bore=None), "bore")
