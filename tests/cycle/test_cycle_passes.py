"""The passes that the spreadsheet repeats arrive at the converged values."""

from dataclasses import replace
from itertools import pairwise

import pytest

from kshm.cycle.cycle import cycle
from kshm.cycle.dizdn_listing import plain_exponent
from kshm.cycle.fuel import AIR, R_GAS, ZERO_C
from kshm.cycle.processes import (
    N1_PASSES,
    N1_START,
    N2_PASSES,
    N2_START,
    compression_pass,
    expansion_pass,
)
from tests.cycle.refusals import refused


def history(step, start, count):
    values = [start]
    for _ in range(count):
        values.append(step(values[-1]))
    return values


def compression_history(engine, count=N1_PASSES):
    t_a = cycle(engine).charge.t_a
    return history(
        lambda x: compression_pass(x, t_a, engine.compression_ratio), N1_START - 1, count
    )


def expansion_history(engine, count=N2_PASSES):
    result = cycle(engine)
    comb = result.combustion
    released = (engine.xi_b - engine.xi_z) * comb.heat / comb.mu
    return history(
        lambda x: expansion_pass(x, comb.t_z, comb.delta, released, comb.products),
        N2_START - 1,
        count,
    )


@pytest.mark.parametrize("passes", [compression_history, expansion_history])
def test_two_passes_are_to_spare(engine, passes):
    values = passes(engine)
    final = passes(engine, 40)[-1]
    assert values[-3] == pytest.approx(final, rel=1e-12)
    assert values[-1] == pytest.approx(final, rel=1e-14)


@pytest.mark.parametrize("passes", [compression_history, expansion_history])
def test_convergence_is_quadratic(engine, passes):
    values = passes(engine)
    final = passes(engine, 40)[-1]
    errors = [abs(v - final) for v in values[:3]]
    for before, after in pairwise(errors):
        assert after <= 2.0 * before**2 + 1e-15


def test_n1_solves_its_own_equation_by_bisection(engine):
    """Reached without Newton: R/x − (a + b (t_a + t_c)) changes sign once."""
    result = cycle(engine)
    t_a = result.charge.t_a - ZERO_C
    low, high = 0.2, 0.5
    for _ in range(60):
        x = (low + high) / 2
        t_c = result.charge.t_a * engine.compression_ratio**x - ZERO_C
        mean = (AIR.energy(t_c) - AIR.energy(t_a)) / (t_c - t_a)
        low, high = (x, high) if R_GAS / x > mean else (low, x)
    assert result.compression.n_1 - 1 == pytest.approx(low, rel=1e-13)


def test_n1_is_the_limit_of_plain_substitution(engine):
    result = cycle(engine)
    n_1 = 1.35
    for _ in range(40):
        n_1 = plain_exponent(n_1, result.charge.t_a, engine.compression_ratio)
    assert result.compression.n_1 == pytest.approx(n_1, rel=1e-14)


def test_n2_solves_its_own_equation_by_bisection(engine):
    result = cycle(engine)
    comb = result.combustion
    late = (engine.xi_b - engine.xi_z) * comb.heat / comb.mu
    u_z = comb.products.energy(comb.t_z - ZERO_C)
    low, high = 0.05, 0.6
    for _ in range(60):
        x = (low + high) / 2
        t_b = comb.t_z / comb.delta**x
        h = (late + u_z - comb.products.energy(t_b - ZERO_C)) / (comb.t_z - t_b)
        low, high = (x, high) if R_GAS / x > h else (low, x)
    assert result.expansion.n_2 - 1 == pytest.approx(low, rel=1e-13)


def test_starved_of_passes_the_solver_says_so(engine, monkeypatch):
    import kshm.cycle.processes as process

    for name, symbol in (("N1_PASSES", "n_1"), ("N2_PASSES", "n_2")):
        with monkeypatch.context() as patch:
            patch.setattr(process, name, 1)
            with refused(symbol):
                cycle(engine)
    assert cycle(replace(engine))
