"""Balance by orders: standard layouts, statics, ellipses, balance shafts, firing orders."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from kshm import solve
from kshm.chain import firing_orders
from kshm.chain.solve import solve_batch
from kshm.engine.engine import Engine
from kshm.mechanics import balance, dimensionless, kinematics
from kshm.mechanics.masses import point_masses
from reports.inputs.to_si.engine import to_engine
from tests.kshm.engines import basic_engines
from tests.layouts import MAKERS, layout_input
from tests.textbook.book import solution

PITCH = 0.1


def cylinders(phases: list[float], places: list[float], axes: list[float]) -> balance.Cylinders:
    """Phases are TDC positions of the shaft, places in pitches, axes in degrees."""
    return balance.Cylinders(
        np.radians(phases), PITCH * np.array(places, dtype=float), np.radians(axes)
    )


def inline(cranks: list[float]) -> balance.Cylinders:
    count = len(cranks)
    places = [i - (count - 1) / 2 for i in range(count)]
    return cylinders([-c % 360 for c in cranks], places, [0.0] * count)


def vee(cranks: list[float], bank: float) -> balance.Cylinders:
    """Two cylinders on each throw, axes half a bank angle to the left and to the right.

    A crank at γ stands under an axis at δ when the shaft has turned by δ − γ.
    """
    count = len(cranks)
    phases, places, axes = [], [], []
    for i, crank in enumerate(cranks):
        for axis in (-bank / 2, bank / 2):
            phases.append((axis - crank) % 360)
            places.append(i - (count - 1) / 2)
            axes.append(axis)
    return cylinders(phases, places, axes)


def opposed(cranks: list[float], axes: list[float]) -> balance.Cylinders:
    count = len(cranks)
    places = [i - (count - 1) / 2 for i in range(count)]
    phases = [(axis - crank) % 360 for crank, axis in zip(cranks, axes, strict=True)]
    return cylinders(phases, places, axes)


def largest(actual: balance.Cylinders, order: int, *, moment: bool) -> float:
    weights = actual.position if moment else None
    return balance.ellipse(balance.order_phasors(actual, order, weights)).largest


# Force and moment of orders 1, 2, 4 in units of one cylinder's amplitude (and of the pitch).
STANDARD = {
    "one": (inline([0]), (1, 1, 1), (0, 0, 0)),
    "two at 180": (inline([0, 180]), (0, 2, 2), (1, 0, 0)),
    "two at 360": (inline([0, 0]), (2, 2, 2), (0, 0, 0)),
    "three": (inline([0, 120, 240]), (0, 0, 0), (3**0.5, 3**0.5, 3**0.5)),
    "four": (inline([0, 180, 180, 0]), (0, 4, 4), (0, 0, 0)),
    "four, cross": (inline([0, 90, 270, 180]), (0, 0, 4), (10**0.5, 0, 0)),
    "five": (inline([0, 144, 216, 288, 72]), (0, 0, 0), (0.44902798, 4.97979657, 0.44902798)),
    "six": (inline([0, 120, 240, 240, 120, 0]), (0, 0, 0), (0, 0, 0)),
    "V2 at 90": (vee([0], 90), (1, 2**0.5, 2**0.5), (0, 0, 0)),
    "V8 cross": (vee([0, 90, 270, 180], 90), (0, 0, 4 * 2**0.5), (10**0.5, 0, 0)),
    "V8 flat": (vee([0, 180, 180, 0], 90), (0, 4 * 2**0.5, 4 * 2**0.5), (0, 0, 0)),
    "V6 at 60": (vee([0, 120, 240], 60), (0, 0, 0), (1.5 * 3**0.5, 1.5, 1.5)),
    "V12 at 60": (vee([0, 120, 240, 240, 120, 0], 60), (0, 0, 0), (0, 0, 0)),
    "boxer 2": (opposed([0, 180], [-90, 90]), (0, 0, 0), (1, 1, 1)),
    "boxer 4": (opposed([0, 180, 180, 0], [-90, 90, -90, 90]), (0, 0, 0), (0, 2, 2)),
    "boxer 6": (
        opposed([0, 180, 240, 60, 120, 300], [-90, 90] * 3), (0, 0, 0), (0, 0, 0),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", [name for name in STANDARD if name not in ("five", "V6 at 60")])
def test_standard_table_of_forces_and_moments(name: str) -> None:
    """Zero where it must be zero to 1e-12; the rest by the text-book factors."""
    actual, forces, moments = STANDARD[name]
    for order, force, moment in zip((1, 2, 4), forces, moments, strict=True):
        assert largest(actual, order, moment=False) == pytest.approx(force, abs=1e-12), order
        assert largest(actual, order, moment=True) / PITCH == pytest.approx(moment, abs=1e-12)


def test_five_cylinders_and_v6_have_moments_alone() -> None:
    for name in ("five", "V6 at 60"):
        actual, _, moments = STANDARD[name]
        for order, moment in zip((1, 2), moments, strict=False):
            assert largest(actual, order, moment=False) < 1e-12
            assert largest(actual, order, moment=True) / PITCH == pytest.approx(moment, abs=1e-6)


@settings(max_examples=30)
@given(basic_engines(method="exact"))
def test_orders_add_up_to_the_inertia_of_all_pistons(engine: Engine) -> None:
    """Phasors against the exact accelerations of every piston, force and moment."""
    geometry = engine.geometry
    m_j, _ = point_masses(engine.masses, geometry.rod_length)
    actual = balance.cylinders_of(engine)
    phi = np.radians(np.arange(0, 360, 7.0))
    lam = np.array(geometry.lam)
    local = phi[None, :] - actual.phase[:, None]
    unit = m_j * geometry.crank_radius * engine.omega**2
    thrown = unit * dimensionless.exact(local, lam).j
    force, moment = np.zeros_like(phi), np.zeros_like(phi)
    for order in (1, *range(2, 41, 2)):
        one, two = balance.reciprocating(engine, actual, order)
        force += np.real(one[0] * np.exp(1j * order * phi))
        moment += np.real(two[0] * np.exp(1j * order * phi))
    scale = unit * engine.cylinders
    np.testing.assert_allclose(force, thrown.sum(axis=0), atol=1e-8 * scale)
    arms = thrown * actual.position[:, None]
    np.testing.assert_allclose(moment, arms.sum(axis=0), atol=1e-8 * scale)


@settings(max_examples=30)
@given(basic_engines())
def test_rotating_masses_are_what_the_main_bearings_hold(engine: Engine) -> None:
    """Force and moment of the shaft = minus the constant reactions of all supports."""
    raw = solve_batch([engine])
    left, right = raw.constants
    starts = balance.throw_starts(engine)
    turn = np.exp(1j * np.array([throw.angle for throw in engine.crankshaft.throws]))
    reactions = [
        (side[0, :, 1] - 1j * side[0, :, 0]) * turn for side in (left, right)
    ]  # fmt: skip
    force, moment = balance.rotating(engine, counterweights=True)
    total = reactions[0].sum() + reactions[1].sum()
    arms = (reactions[0] * starts[:-1]).sum() + (reactions[1] * starts[1:]).sum()
    scale = max(1.0, np.abs(reactions).max())
    assert abs(force + total) <= 1e-9 * scale
    assert abs(moment + arms) <= 1e-9 * scale


@pytest.mark.parametrize("angles", [(0.3, 1.1), (-2.0, 0.4), (0.0, np.pi / 2)])
def test_ellipse_against_the_curve(angles: tuple[float, float]) -> None:
    vector = np.array([2 * np.exp(1j * angles[0]), 0.7 * np.exp(1j * angles[1])])
    t = np.linspace(0, 2 * np.pi, 200001)
    up = np.real(vector[0] * np.exp(1j * t))
    right = np.real(vector[1] * np.exp(1j * t))
    length = np.hypot(up, right)
    shape = balance.ellipse(vector)
    assert shape.largest == pytest.approx(length.max(), rel=1e-8)
    assert shape.smallest == pytest.approx(length.min(), abs=1e-6)
    at = length.argmax()
    direction = np.arctan2(right[at], up[at])
    assert np.tan(shape.direction) == pytest.approx(np.tan(direction), abs=1e-3)


def one_cylinder(share: float) -> Engine:
    """The three-cylinder sample cut to its first throw without its own counterweights."""
    engine = solution("gots-p3").engine
    throw = engine.crankshaft.throws[0]
    webs = [replace(web, counterweight_mass=0.0) for web in (throw.left_web, throw.right_web)]
    throw = replace(throw, left_web=webs[0], right_web=webs[1])
    nothing = replace(engine.crankshaft.nose, mass=0.0)
    whole = engine.crankshaft
    shaft = replace(
        whole, throws=(throw,), nose=nothing, rear=nothing,
        pin_diameters=whole.pin_diameters[:1], pin_lengths=whole.pin_lengths[:1],
        main_diameters=whole.main_diameters[:2], main_lengths=whole.main_lengths[:2],
    )  # fmt: skip
    choice = replace(engine.balancing, counterweight_share=share)
    alone = {"firing_offsets": (0.0,), "arrangement": ()}
    return replace(engine, crankshaft=shaft, balancing=choice, **alone)


def test_half_of_the_first_order_on_the_counterweights_gives_a_constant_vector() -> None:
    """One cylinder, share 1/2, rotating masses balanced: a circle of half the amplitude."""
    engine = one_cylinder(0.5)
    unit = balance.ideal_counterweights(engine)[0]
    force, _ = balance.reciprocating(engine, balance.cylinders_of(engine), 1)
    shape = balance.ellipse(force + balance.turning(0.5 * unit))
    assert shape.largest == pytest.approx(shape.smallest, rel=1e-12)
    assert shape.largest == pytest.approx(abs(force[0]) / 2, rel=1e-12)
    whole = balance.ellipse(force + balance.turning(unit))
    assert whole.largest == pytest.approx(abs(force[0]))
    assert abs(whole.direction) == pytest.approx(np.pi / 2)


def test_a_pair_of_shafts_takes_the_order_away() -> None:
    """2·m·e·(2ω)² = F₂ of four cylinders, and the table's residual is zero."""
    solved = solution("d-240")
    (first, first_back), (second, second_back) = balance.shaft_moments(solved.engine)
    assert first_back == pytest.approx(first) and second_back == pytest.approx(second)
    orders = solved.columns["balance_orders"]
    taken = (second + second_back) * (2 * solved.engine.omega) ** 2
    assert taken == pytest.approx(1000 * orders["F_order_kN"][1], rel=1e-12)
    assert orders["F_left_kN"][1] == 0 < orders["F_order_kN"][1]
    assert first == 0
    assert orders["F_left_kN"][3] == orders["F_order_kN"][3] > 0


def test_table_over_a_turn_holds_the_orders() -> None:
    solved = solution("d-240")
    table, orders = solved.columns["balance"], solved.columns["balance_orders"]
    assert table["F2_kN"].max() == pytest.approx(orders["F_order_kN"][1], rel=1e-9)
    assert np.abs(table["F1_kN"]).max() < 1e-9
    after = table["Fup_after_kN"] - table["F4_kN"]
    assert np.abs(after).max() < 0.05 * orders["F_order_kN"][1]


def test_firing_orders_of_four_cylinders() -> None:
    ranked = firing_orders.rank_firing_orders(solution("d-240").engine)
    assert len(ranked) == 8
    assert {collected.order for collected in ranked[:2]} == {(1, 3, 4, 2), (1, 2, 4, 3)}
    assert ranked[0].unevenness == pytest.approx(0, abs=1e-12)
    assert ranked[2].unevenness > 0.9
    assert ranked[0].half_order == pytest.approx(0, abs=1e-12)
    assert ranked[0].journal_load <= ranked[1].journal_load


def test_own_order_is_among_the_ranked_and_has_its_own_load() -> None:
    solved = solution("d-240")
    own = tuple(np.degrees(solved.engine.firing_offsets).round(6))
    ranked = firing_orders.rank_firing_orders(solved.engine)
    (collected,) = [f for f in ranked if tuple(np.degrees(f.offsets).round(6)) == own]
    coarse = solve(replace(solved.engine, step_deg=10))
    load = max(value for key, value in coarse.scalars.items() if key.endswith("_max_kN")
               and key.startswith("Rmain"))  # fmt: skip
    assert collected.journal_load == pytest.approx(1000 * load, rel=1e-9)


def test_six_cylinders_have_even_orders_known_from_practice() -> None:
    cranks = np.radians([0.0, 120, 240, 240, 120, 0])
    table = firing_orders.offsets_table(-cranks)
    assert table.shape == (32, 6)
    even = {
        firing_orders.sequence(row)
        for row, rough in zip(table, firing_orders.unevenness(table), strict=True)
        if rough < 1e-9
    }
    assert (1, 5, 3, 6, 2, 4) in even or (1, 3, 5, 6, 4, 2) in even
    assert len(even) == 4


def test_too_many_cylinders_are_refused() -> None:
    with pytest.raises(ValueError, match="up to 7"):
        firing_orders.rank_firing_orders(solution("yamz-238").engine)


NAMES = ("four", "v_six", "v_apart", "split", "opposed_four", "two_stroke", "two_stroke_v")
ORDERS = (1, 2, 4, 6, 8, 10, 12)


@pytest.mark.parametrize("name", NAMES)
def test_orders_add_up_to_the_inertia_forces_of_all_pistons(name: str) -> None:
    engine = to_engine(layout_input(name))
    assert balance.is_balanced_by_orders(engine)
    phi = np.radians(np.arange(0.0, 360.0, 7.0))
    r, lam = np.array(engine.geometry.crank_radius), np.array(engine.geometry.lam)
    m_j, _ = point_masses(engine.masses, engine.geometry.rod_length)
    actual = balance.cylinders_of(engine)
    waves = {order: np.exp(1j * order * phi) for order in ORDERS}
    parts = [balance.reciprocating(engine, actual, order) for order in ORDERS]
    force, moment = np.zeros((2, len(phi))), np.zeros((2, len(phi)))
    for theta, position, axis in zip(
        engine.firing_offsets, actual.position, actual.axis, strict=True
    ):
        thrown = m_j * kinematics.acceleration_exact(phi - theta, r, lam, np.array(engine.omega))
        direction = np.array([[np.cos(axis)], [np.sin(axis)]])
        force += direction * thrown
        moment += position * direction * thrown
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
    engine = to_engine(layout_input(name))
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
    engine = to_engine(layout_input("two_stroke_v"))
    actual = balance.cylinders_of(engine)
    force, _ = balance.reciprocating(engine, actual, 1)
    against = balance.turning_parts(force)[1]
    scale = abs(balance.turning_parts(force)[0]) + 1.0
    assert abs(against) < 1e-9 * scale
    weights, _ = balance.ideal_counterweights(engine)
    rest = force + balance.turning(0.5 * weights)
    assert balance.ellipse(rest).largest < 1e-9 * scale + 1e-6


def test_offset_and_articulated_engines_have_no_series() -> None:
    for name in ("offset", "articulated"):
        assert not balance.is_balanced_by_orders(to_engine(layout_input(name)))
    assert set(NAMES) <= set(MAKERS)


@pytest.mark.parametrize("name", ["four", "v_six", "split", "opposed_four"])
def test_the_own_firing_order_is_among_those_of_the_shaft(name: str) -> None:
    engine = to_engine(layout_input(name))
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
        firing_orders.rank_firing_orders(to_engine(layout_input("two_stroke")))
