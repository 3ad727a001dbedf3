"""Free forces of every layout: the sum of the orders is what the moving masses exert."""

from __future__ import annotations

import numpy as np
import pytest

from kshm.chain import firing_orders
from kshm.mechanics import balance, kinematics
from kshm.mechanics.masses import point_masses
from reports.inputs.to_si.engine import to_engine
from tests.layouts import MAKERS, made

NAMES = ("four", "v_six", "v_apart", "split", "opposed_four", "two_stroke", "two_stroke_v")
ORDERS = (1, 2, 4, 6, 8, 10, 12)


@pytest.mark.parametrize("name", NAMES)
def test_orders_add_up_to_the_inertia_forces_of_all_pistons(name: str) -> None:
    engine = to_engine(made(name))
    assert balance.is_balanced_by_orders(engine)
    phi = np.radians(np.arange(0.0, 360.0, 7.0))
    r, lam = np.array(engine.geometry.crank_radius), np.array(engine.geometry.lam)
    m_j, _ = point_masses(engine.masses, engine.geometry.rod_length)
    found = balance.cylinders_of(engine)
    waves = {order: np.exp(1j * order * phi) for order in ORDERS}
    parts = [balance.reciprocating(engine, found, order) for order in ORDERS]
    force, moment = np.zeros((2, len(phi))), np.zeros((2, len(phi)))
    for theta, place, axis in zip(engine.firing_offsets, found.place, found.axis, strict=True):
        thrown = m_j * kinematics.acceleration_exact(phi - theta, r, lam, np.array(engine.omega))
        direction = np.array([[np.cos(axis)], [np.sin(axis)]])
        force += direction * thrown
        moment += place * direction * thrown
    scale = m_j * float(r) * engine.omega**2
    for which, direct in enumerate((force, moment)):
        for side in (0, 1):
            total = sum(
                np.real(part[which][side] * wave)
                for part, wave in zip(parts, waves.values(), strict=True)
            )
            assert np.abs(total - direct[side]).max() < 1e-6 * scale


@pytest.mark.parametrize("name", NAMES)
def test_rotating_masses_stand_where_the_throws_and_pins_are(name: str) -> None:
    engine = to_engine(made(name))
    _, m_2 = point_masses(engine.masses, engine.geometry.rod_length)
    unit = engine.geometry.crank_radius * engine.omega**2
    direct = 0j
    for cylinder in engine.arrangement:
        throw = engine.crankshaft.throws[cylinder.throw]
        direct += m_2 * np.exp(1j * (throw.angle + cylinder.pin_angle))
    split = {c.throw: c.pin_angle for c in engine.arrangement}
    for number, throw in enumerate(engine.crankshaft.throws):
        halves = (1 + np.exp(1j * split[number])) / 2
        direct += throw.pin_mass * np.exp(1j * throw.angle) * halves
        for web in (throw.left_web, throw.right_web):
            direct += web.mass * np.exp(1j * (throw.angle - web.angle))
    force, _ = balance.rotating(engine, counterweights=False)
    assert abs(force - direct * unit) < 1e-9 * unit


def test_a_v_of_90_degrees_is_balanced_in_the_first_order_by_counterweights() -> None:
    """The resultant of a pair turns with the crank: masses m_j opposite it take it away."""
    engine = to_engine(made("two_stroke_v"))
    found = balance.cylinders_of(engine)
    force, _ = balance.reciprocating(engine, found, 1)
    against = balance.turning_parts(force)[1]
    scale = abs(balance.turning_parts(force)[0]) + 1.0
    assert abs(against) < 1e-9 * scale
    weights, _ = balance.ideal_counterweights(engine)
    rest = force + balance.turning(0.5 * weights)
    assert balance.ellipse(rest).largest < 1e-9 * scale + 1e-6


def test_offset_and_articulated_engines_have_no_series() -> None:
    for name in ("offset", "articulated"):
        assert not balance.is_balanced_by_orders(to_engine(made(name)))
    assert set(NAMES) <= set(MAKERS)


@pytest.mark.parametrize("name", ["four", "v_six", "split", "opposed_four"])
def test_the_own_firing_order_is_among_those_of_the_shaft(name: str) -> None:
    engine = to_engine(made(name))
    table = firing_orders.offsets_table(firing_orders.dead_centres(engine))
    own = np.mod(engine.firing_offsets, 4 * np.pi)
    first = np.mod(own - own[0], 4 * np.pi)
    rows = np.mod(table - table[:, :1], 4 * np.pi)
    gap = np.abs(np.mod(rows - first + np.pi, 4 * np.pi) - np.pi).max(axis=1)
    assert (gap < 1e-9).sum() == 1
    ranked = firing_orders.rank_firing_orders(engine)
    assert len(ranked) == len(table) and ranked[0].unevenness <= ranked[-1].unevenness


def test_a_two_stroke_engine_has_no_choice_of_orders() -> None:
    with pytest.raises(ValueError, match="two-stroke"):
        firing_orders.rank_firing_orders(to_engine(made("two_stroke")))
