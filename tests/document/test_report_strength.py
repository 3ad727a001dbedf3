"""The chapter on the strength of the parts: no value without its formula, no mass of two values."""

from __future__ import annotations

import re

import pytest

from reports.document.text.terms import Terms
from reports.model.blocks import ScalarTable
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from tests.document.bare_pages import bare_page, formulas_of, plain
from tests.document.test_report_parts import page_of, with_every_part
from tests.document.test_report_sentences import printed_rows

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]

_LISTS = {"strength_loads", "strength_piston", "strength_ring", "strength_pin", "strength_eye",
          "strength_shank", "strength_cap"}  # fmt: skip
# Greatest of a table, coefficients of another book's table: the sentence beside them says of which.
_READ = {"st_pz_MPa", "st_N_max_N", "st_Pg_tdc_N", "st_squeeze_kN", "st_squeeze_kM"}


@pytest.mark.parametrize("name", ["gots-diesel", "vaz-2106", "two-stroke", "V12"])
def test_every_value_has_its_formula_with_numbers(name: str):
    """N0′, Wк, Fк, Jx and a score of others stood in tables alone."""
    given = with_every_part(name)
    page, terms = (
        bare_page(given),
        Terms(model := build_model(given), evaluate_model(build_model(given))),
    )
    sides = {tex.partition("=")[0].replace("&", "").strip() for tex in formulas_of(page)}
    keys = {scalar.key for block in model.blocks if isinstance(block, ScalarTable)
            and block.id in _LISTS for scalar in block.scalars}  # fmt: skip
    assert len(keys) > 60
    told = {"st_m_piston"} if given.masses.reciprocating_kg is None else set()
    lacking = {key for key in keys - _READ - told if terms.tex(key) not in sides}
    assert lacking == set()
    text = plain(page)
    assert all(f"{plain(str(terms.sym(key)))} = " in text for key in _READ & keys)


@pytest.mark.parametrize("name", ["gots-diesel", "yamz-236", "two-stroke", "vaz-2106"])
def test_the_mass_of_the_piston_is_one(name: str):
    """1.519 kg in the chapter on the moment of inertia, 1.300 kg in that on the strength."""
    page = page_of(name)
    inertia = printed_rows(page, "Момент инерции и неравномерность хода")
    loads = printed_rows(page, "Силы, по которым рассчитана прочность")
    (piston,) = {row[2] for row in inertia if row[0] == "Масса поршневой группы"}
    (whole,) = {row[2] for row in loads if row[0] == "Масса комплекта поршня"}
    assert piston == whole and re.fullmatch(r"\d+,\d+", piston)
