"""A check is a proof only if a mistake in what it checks makes it fail."""

from dataclasses import replace

import pytest

from reports.model.blocks import Grid, Held, ScalarTable
from reports.model.evaluation import evaluate_model
from reports.shared.standing import Standing
from reports.tables.registry import build_model
from reports.tables.verdicts import outcomes
from tests.conftest import sample


def mistaken(model, key, right, wrong):
    """The model with another formula of one node."""

    def node(known):
        if known is None or known.key != key or not known.expr:
            return known
        assert right in known.expr
        return replace(known, expr=known.expr.replace(right, wrong, 1))

    def block(known):
        if isinstance(known, Grid):
            rows = (replace(row, cells=tuple(map(node, row.cells))) for row in known.rows)
            return replace(known, rows=tuple(rows))
        if isinstance(known, ScalarTable):
            return replace(known, scalars=tuple(map(node, known.scalars)))
        return replace(known, columns=tuple(map(node, known.columns))) if known.id in (
            "P4_1", "P4_2") else known  # fmt: skip

    return replace(model, blocks=tuple(map(block, model.blocks)))


def standings(model):
    judged = outcomes(model, evaluate_model(model).scalars)
    return {each.name: each.standing for each in judged if each.held is Held.CHECK}


# A check of a sample and a mistake in what it checks.
MISTAKES = [
    # the sign that formulas (48) and (49) of the textbook have
    ("gots-diesel", "supports", "throw1_RKCL", "- throw1_C11*", "+ throw1_C11*"),
    ("gots-diesel", "supports", "throw2_RKCP", "throw2_arm_pin", "throw2_arm_rod*1.1"),
    ("gots-diesel", "supports", "throw1_RTCL", "throw1_C10*(", "throw1_C10*2*("),
    ("gots-diesel", "virtual", "T_MPa", "+ beta_rad", "- beta_rad"),
    ("gots-diesel", "virtual", "M_Nm", "r_crank", "L_rod"),
    ("gots-diesel", "work", "Msum_Nm", "M2_Nm", "M1_Nm*1.2"),
    ("gots-diesel", "lam", "lam", "r_crank", "2*r_crank"),
    ("gots-diesel", "phases", "rank_phase2", "firing_offset_2_deg", "firing_offset_1_deg"),
    ("gots-diesel", "symmetry", "rank_share1", "0.5", "0.4"),
    ("vaz-2106", "power", "T_mean", "r_crank", "(1.1*r_crank)"),
    ("yamz-236", "share", "m_1", "masses_rod_kg", "2*masses_rod_kg"),
    ("cycle-tractor-diesel", "cycle_rho", "cyc_rho", "cyc_mu*", "0.5*cyc_mu*"),
    ("cycle-tractor-diesel", "cycle_pz", "cyc_lambda_p", "/cyc_p_c", "/(3*cyc_p_c)"),
    ("cycle-tractor-diesel", "cycle_Tr", "cyc_T_r_check", "cyc_T_b*", "1.2*cyc_T_b*"),
]


@pytest.mark.parametrize(("name", "check", "key", "right", "wrong"), MISTAKES)
def test_a_mistake_fails_its_check(name, check, key, right, wrong):
    model = build_model(sample(name))
    assert standings(model)[check] is Standing.INSIDE
    assert standings(mistaken(model, key, right, wrong))[check] is not Standing.INSIDE


ENGINES = ("gots-diesel", "yamz-236", "ecoboost-10", "two-stroke", "cycle-tractor-diesel",
           "cycle-turbo-petrol")  # fmt: skip


@pytest.mark.parametrize("name", ENGINES)
def test_every_check_has_its_mistake(name):
    """The running-on torque of the last journal is the sum of the cylinders by its formula.

    Such a check passes whatever the torques are: no mistake in them fails it.
    """
    assert set(standings(build_model(sample(name)))) <= {check for _, check, *_ in MISTAKES}
