"""A check is a proof only if a mistake in what it checks makes it fail."""

from dataclasses import replace

import pytest

from reports.model.blocks import Grid, ScalarTable
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
    return {each.name: each.standing for each in outcomes(model, evaluate_model(model).scalars)}


@pytest.mark.parametrize(
    ("check", "key", "right", "wrong"),
    [
        # the sign that formulas (48) and (49) of the textbook have
        ("supports", "throw1_RKCL", "- throw1_C11*", "+ throw1_C11*"),
        ("supports", "throw2_RKCP", "throw2_arm_pin", "throw2_arm_rod*1.1"),
        ("supports", "throw1_RTCL", "throw1_C10*(", "throw1_C10*2*("),
        ("virtual", "T_MPa", "+ beta_rad", "- beta_rad"),
        ("virtual", "M_Nm", "r_crank", "L_rod"),
        ("work", "Msum_Nm", "M2_Nm", "M1_Nm*1.2"),
    ],
)
def test_a_mistake_fails_its_check(check, key, right, wrong):
    model = build_model(sample("gots-diesel"))
    assert standings(model)[check] is Standing.INSIDE
    assert standings(mistaken(model, key, right, wrong))[check] is not Standing.INSIDE


@pytest.mark.parametrize("name", ["gots-diesel", "yamz-236", "ecoboost-10", "two-stroke"])
def test_no_check_compares_what_is_added_up_alike(name):
    """The running-on torque of the last journal is the sum of the cylinders by its formula."""
    model = build_model(sample(name))
    kept = {"supports", "virtual", "work", "lam", "phases", "symmetry", "power", "share"}
    assert {each.name for each in outcomes(model, evaluate_model(model).scalars)} <= kept
