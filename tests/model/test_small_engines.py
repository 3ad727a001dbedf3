"""The smaller an engine, the more decimals: a moped's torque keeps its digits as a lorry's does."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kshm.nomenclature.quantity import quantity, smallness
from reports.inputs.fields import iter_fields, tables_shape
from reports.inputs.load import load_mapping
from reports.inputs.solve_input import solved
from reports.inputs.to_si.engine import smallness_of
from reports.new.generate import generate_engine
from reports.tables.registry import build_model
from reports.workbook.styles import excel_format

_GROWING = ("M_max", "Rpin_max_kN", "I_flywheel", "V_h")


@pytest.mark.parametrize(
    ("bore_m", "small", "formats"),
    [
        (0.200, 0, ("0", "0.00", "0.000000", "0.0000")),
        (0.330, -1, ("0", "0.00", "0.00000", "0.000")),
        (0.960, -3, ("0", "0.0", "0.000", "0.00")),
        (0.060, 0, ("0", "0.00", "0.000000", "0.0000")),
        (0.050, 1, ("0.0", "0.000", "0.0000000", "0.00000")),
        (0.0359, 2, ("0.00", "0.000", "0.00000000", "0.000000")),
        (0.010, 4, ("0.000", "0.0000", "0.0000000000", "0.0000000")),
    ],
)
def test_decimals_follow_the_bore(bore_m, small, formats):
    assert smallness(bore_m) == small
    assert tuple(excel_format(quantity(key, small)) for key in _GROWING) == formats
    for key in ("j_m_s2", "K_MPa", "phi_deg"):  # the same in alike engines
        assert quantity(key, small) == quantity(key)


def single(power_kw: float, speed_rpm: float):
    built = generate_engine(1, layout="inline", strokes=4, kind="petrol",
                      power_kw=power_kw, speed_rpm=speed_rpm)  # fmt: skip
    return load_mapping(built.data, source="").model


@settings(max_examples=25)
@given(st.floats(0.6, 80), st.floats(3000, 9000))
def test_the_greatest_torque_and_load_have_three_digits(power_kw, speed_rpm):
    model = single(power_kw, speed_rpm)
    small, scalars = smallness_of(model), solved(model).scalars
    for key in ("M_max", "Rpin_max_kN"):
        decimals = quantity(key, small).digits.decimals
        assert abs(scalars[key]) * 10**decimals >= 100, (key, model.geometry.bore_mm)


def test_a_model_of_a_small_engine_shows_them_everywhere():
    model = single(2.2, 6500)
    small = smallness_of(model)
    assert small == math.ceil(5 * math.log10(60 / model.geometry.bore_mm)) > 0
    built = build_model(model)
    for name, node in built.nodes.items():
        assert node.quantity == quantity(node.of or node.key, small), name
    rows = [
        row for block in built.blocks for row in getattr(block, "rows", ()) if hasattr(row, "cells")
    ]
    assert rows and all(row.quantity == quantity(row.of, small) for row in rows)


def test_tables_of_engines_with_other_decimals_are_of_another_shape():
    shapes = {
        power: tables_shape(iter_fields(single(power, 6500))) for power in (2.2, 2.3, 30.0, 31.0)
    }
    assert shapes[2.2] == shapes[2.3] != shapes[30.0] == shapes[31.0]
