"""Limits in which one layout becomes another."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
from hypothesis import given, settings

from kshm import solve
from kshm.chain.solve import ChainArrays, solve_batch
from kshm.engine.arrangement import fan, in_row
from kshm.engine.engine import Engine
from kshm.engine.gas import PolytropicGas
from kshm.engine.masses import DirectMasses
from kshm.mechanics.masses import point_masses
from tests.kshm.engines import engines


def arrays(raw: ChainArrays) -> dict[str, np.ndarray]:
    values = {field.name: getattr(raw, field.name) for field in fields(raw)}
    return {name: value for name, value in values.items() if isinstance(value, np.ndarray)}


@settings(max_examples=40)
@given(engines(offset=False))
def test_zero_offset_is_the_central_mechanism_to_the_last_digit(engine: Engine) -> None:
    zero = replace(engine, geometry=replace(engine.geometry, crank_offset=0.0, pin_offset=0.0))
    central, shifted = arrays(solve_batch([engine])), arrays(solve_batch([zero]))
    for name, values in central.items():
        np.testing.assert_array_equal(shifted[name], values, err_msg=name)
    tables, others = solve(engine).columns, solve(zero).columns
    for table in ("P3_1", "P3_2", "gas", "P4_1"):
        for key, values in tables[table].items():
            np.testing.assert_array_equal(others[table][key], values, err_msg=f"{table}.{key}")


@settings(max_examples=30)
@given(engines(offset=True))
def test_opposite_offsets_of_shaft_and_pin_cancel(engine: Engine) -> None:
    geometry = replace(engine.geometry, crank_offset=0.01, pin_offset=-0.01)
    raw = solve_batch([replace(engine, geometry=geometry)])
    central = replace(engine.geometry, crank_offset=None, pin_offset=None)
    np.testing.assert_array_equal(
        raw.torque, solve_batch([replace(engine, geometry=central)]).torque
    )


@settings(max_examples=30)
@given(engines(layouts=("inline",), step_deg=10))
def test_v_engine_without_bank_angle_is_in_line_with_everything_doubled(engine: Engine) -> None:
    """Two rods at one place of a pin, in phase: torque, rods and journals carry twice as much."""
    count = engine.cylinders
    pair = replace(
        engine,
        arrangement=fan(count, (0.0, 0.0)),
        firing_offsets=engine.firing_offsets * 2,
    )
    m_j, m_2 = point_masses(engine.masses, engine.geometry.rod_length)
    one, two = solve_batch([engine]), solve_batch([pair])
    scale = np.abs(one.journal).max() + np.abs(one.pin_up).max()
    np.testing.assert_allclose(
        two.torque_sum, 2 * one.torque_sum, atol=1e-9 * abs(one.torque).max()
    )
    np.testing.assert_allclose(two.pin_up, 2 * one.pin_up, atol=1e-9 * scale)
    np.testing.assert_allclose(two.pin_load, 2 * one.pin_load, atol=1e-9 * scale)

    # The shaft's own masses are not doubled: take the in-line engine with doubled gas, masses
    # and the mass of a second rod, and compare whole journals.
    gas = engine.gas
    assert isinstance(gas, PolytropicGas)
    names = ("p_ambient", "p_intake", "p_residual", "p_max")
    doubled = replace(
        engine,
        masses=DirectMasses(2 * m_j, 2 * m_2),
        gas=replace(gas, **{name: 2 * getattr(gas, name) for name in names}),
    )
    np.testing.assert_allclose(two.journal, solve_batch([doubled]).journal, atol=1e-9 * scale)
    np.testing.assert_allclose(two.throw_load, solve_batch([doubled]).throw_load, atol=1e-9 * scale)
    np.testing.assert_allclose(
        two.running_pin_statics,
        solve_batch([doubled]).running_pin_statics,
        atol=1e-9 * np.abs(two.running_pin_statics).max(),
    )


@settings(max_examples=30)
@given(engines(layouts=("articulated",), method="exact"))
def test_articulated_rod_on_the_crankpin_is_a_rod_of_its_own(engine: Engine) -> None:
    """With ρ = 0, the same length and masses: a V engine with two rods at one place."""
    m_j, m_2 = point_masses(engine.masses, engine.geometry.rod_length)
    rod = replace(
        engine.articulated[0],
        radius=0.0,
        rod_length=engine.geometry.rod_length,
        reciprocating=m_j,
        big_end=m_2,
    )
    hung = replace(engine, articulated=(rod,) * len(engine.articulated))
    places = tuple(replace(c, master=None) for c in engine.arrangement)
    plain = replace(engine, arrangement=places, articulated=())
    one, other = solve_batch([hung]), solve_batch([plain])
    np.testing.assert_allclose(one.displacement, other.displacement, atol=1e-12)
    for name in ("p", "p_inertia", "N", "S", "journal", "journal_load"):
        ours, theirs = getattr(one, name), getattr(other, name)
        # A pressure at its jump may fall on either side of it.
        close = np.isclose(ours, theirs, atol=1e-8 * np.abs(theirs).max())
        assert close.mean() > 0.97, name
    # The articulated pin's mass is an inertia force of its rod instead of one of the pin.
    np.testing.assert_allclose(one.pin_load, other.pin_load, atol=1e-6 * other.pin_load.max())
    np.testing.assert_allclose(one.torque, other.torque, atol=1e-6 * np.abs(other.torque).max())


@settings(max_examples=30)
@given(engines(strokes=2, step_deg=10))
def test_two_strokes_repeat_after_one_turn(engine: Engine) -> None:
    raw = solve_batch([engine])
    assert np.degrees(raw.phi[-1]) == 360
    later = replace(engine, firing_offsets=tuple(o + 2 * np.pi for o in engine.firing_offsets))
    again = solve_batch([later])
    for name in ("p", "T", "torque_sum", "journal"):
        ours, theirs = getattr(raw, name), getattr(again, name)
        np.testing.assert_allclose(theirs, ours, atol=1e-7 * np.abs(ours).max(), err_msg=name)
        ends = ours[:, 0], ours[:, -1]
        if name == "torque_sum":
            np.testing.assert_allclose(*ends, atol=1e-9 * np.abs(ours).max())


def test_a_basic_engine_is_one_without_any_of_this() -> None:
    assert in_row(3)[2].throw == 2
