"""Any valid engine gives a sound cycle or one clear line."""

import math
from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from kshm.cycle.cycle import cycle, design
from kshm.cycle.diagram import indicator_diagram
from kshm.cycle.fuel import FUELS
from kshm.cycle.inputs import Boost
from kshm.cycle.performance import heat_balance
from kshm.cycle.processes import compress, fill
from kshm.errors import CycleError
from reports.inputs.to_si.cycle import text_of
from tests.cycle.cycle_engines import ENGINES
from tests.cycle.energy import cycle_energy


def within(low, high):
    return st.floats(low, high, allow_nan=False)


@st.composite
def random_engines(draw):
    kind = draw(st.sampled_from(["diesel", "petrol"]))
    diesel = kind == "diesel"
    xi_z = draw(within(0.65, 0.95))
    boost = None
    if draw(st.booleans()):
        boost = Boost(
            draw(within(1.1, 3.5)),
            draw(within(0.6, 0.85)),
            draw(within(0.6, 0.85)),
            draw(within(0, 0.01e6)),
            draw(within(0, 60)),
        )
    engine = replace(
        ENGINES["turbo_diesel"],
        kind=kind,
        fuel=FUELS[draw(st.sampled_from(["diesel"] if diesel else ["petrol", "ethanol"]))],
        compression_ratio=draw(within(12, 24) if diesel else within(6, 13)),
        excess_air=draw(within(1.1, 4.0) if diesel else within(0.75, 1.4)),
        charge_heating=draw(within(-5, 40)),
        t_residual=draw(within(600, 1100)),
        intake_factor=draw(within(0.8, 1.0)),
        exhaust_factor=draw(within(0.85, 1.25)),
        xi_z=xi_z,
        xi_b=min(1.0, xi_z + draw(within(-0.05, 0.15))),
        boost=boost,
        p_max=None,
        bore=draw(within(0.06, 0.2)),
        stroke=draw(within(0.06, 0.2)),
        lam=draw(within(0.2, 0.35)),
    )
    if diesel:
        p_c = compress(fill(engine), engine.compression_ratio).p_c
        engine = replace(engine, p_max=p_c * draw(within(1.02, 1.8)))
    return engine


def numbers(value):
    """Every float of a nested dataclass."""
    if isinstance(value, float):
        yield value
    for name in getattr(value, "__dataclass_fields__", ()):
        yield from numbers(getattr(value, name))


@settings(max_examples=300, deadline=None)
@given(random_engines())
def test_sound_or_refused(engine):
    try:
        r = cycle(engine)
    except CycleError as error:
        assert error.remark.field in ("p_max", "xi_b", "xi_z")
        assert "\n" not in text_of(error.remark)
        return
    assert all(math.isfinite(x) for x in numbers(r))
    assert abs(cycle_energy(r).gap) < 1e-11
    assert abs(sum(heat_balance(r).shares.values()) - 1) < 1e-12
    assert r.charge.t_a > engine.t_ambient - 70
    assert 1.3 < r.compression.n_1 < 1.4
    assert r.compression.p_c < r.combustion.p_z
    assert r.combustion.rho >= 1
    whole = r.combustion.delta * r.combustion.rho
    assert math.isclose(whole, engine.compression_ratio, rel_tol=1e-12)
    assert r.compression.t_c < r.combustion.t_z
    assert r.charge.t_a < r.expansion.t_b < r.combustion.t_z
    assert 0 < r.effective.eta_e < r.indicated.eta_i < 0.75


@settings(max_examples=60, deadline=None)
@given(random_engines(), within(0.7, 1.4))
def test_design_returns_the_sizes(engine, ratio):
    try:
        power = cycle(replace(engine, stroke=engine.bore * ratio)).effective.power_e
    except CycleError:
        return
    actual = design(engine, power, ratio)
    assert math.isclose(actual.bore_exact, engine.bore, rel_tol=1e-11)
    assert abs(actual.power_error) < 0.05


@settings(max_examples=60, deadline=None)
@given(random_engines(), st.sampled_from([1, 2, 5, 10, 30]))
def test_diagram_stays_between_its_corners(engine, step):
    try:
        r = cycle(engine)
    except CycleError:
        return
    d = indicator_diagram(r, step)
    assert np.all(np.isfinite([d.pressure, d.volume, d.temperature]))
    assert d.pressure.max() <= r.combustion.p_z * (1 + 1e-12)
    assert d.temperature.max() <= r.combustion.t_z * (1 + 1e-12)
