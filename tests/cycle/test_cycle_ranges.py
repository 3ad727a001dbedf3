"""Usual ranges carry their source; names lead to the numbers."""

from dataclasses import replace

import pytest

from kshm.cycle.cycle import cycle
from kshm.cycle.usual_ranges import RANGES, usual_ranges
from kshm.nomenclature.dizdn_listing import EXTRA, INPUTS, OUTPUTS, value_of


def test_every_range_says_where_it_comes_from():
    for key, table in RANGES.items():
        assert table, key
        for usual in table.values():
            assert usual.low <= usual.high
            assert usual.source in ("memory", "web")
            assert (usual.reference == "") == (usual.source == "memory")


def test_every_engine_has_its_ranges(engine):
    ranges = usual_ranges(engine.kind, boosted=engine.boost is not None)
    assert len(ranges) >= 12
    result = cycle(engine)
    assert all(isinstance(value_of(result, key), float | int) for key in ranges)


def test_units_are_those_of_the_listing(diesel):
    result = cycle(diesel)
    assert value_of(result, "combustion.p_z") == pytest.approx(10.5)
    assert value_of(result, "inputs.t_residual") == 840


def test_boosted_petrol_is_not_measured_by_columns_of_the_natural_one(engines):
    keys = usual_ranges(engines["turbo_petrol"].kind, boosted=True)
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
