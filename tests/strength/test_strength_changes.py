"""Sizes that the note proposes: what the books' own formulas give with them."""

from __future__ import annotations

import pytest

from kshm.nomenclature.quantity import quantity
from reports.document.chapters.strength_changes import changed
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import to_engine
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from reports.tables.strength_members import SAFETIES, usual_stresses
from tests.conftest import sample

# More pressure than the usual sizes are made for; masses and lengths stay.
BOOSTED = {"gots-diesel": 14.0, "two-stroke": 16.0}


@pytest.mark.parametrize("name", BOOSTED)
def test_with_the_changes_made_all_is_within_its_limits(name: str):
    raw = to_mapping(sample(name))
    raw["gas"] = {**raw["gas"], "max_pressure_mpa": BOOSTED[name]}
    raw["strength"] = {"kind": "petrol"}
    raw.pop("checks", None)
    model = load_mapping(raw, source="").model
    stresses = usual_stresses(model.strength)
    built = changed(to_engine(model), stresses, model.strength.safety_allowed)
    assert len(built.changes) > 3 and not built.left
    first = to_engine(model)
    sizes = first.strength.sizes(first.geometry.bore, first.crankshaft.pin_diameters[0])
    raw["strength"] |= {f"{key}_mm": round(1e3 * size, 6) for key, size in sizes.items()
                        if key not in ("bore", "crankpin")}  # fmt: skip
    keys = {"bush_fit": ("bush_fit_um", 1e6)}
    for each in built.changes:
        key, scale = keys.get(each.key, (f"{each.key}_mm", 1e3))
        raw["strength"][key] = round(scale * each.after, 6)
    again = evaluate_model(build_model(load_mapping(raw, source="").model)).scalars
    for each in stresses:
        assert again[each.key] == pytest.approx(built.after[each.key] / quantity(each.key).si)
        assert each.side(again[each.key]) <= 0, each.key
    for key in set(SAFETIES) & again.keys():
        assert again[key] == pytest.approx(built.after[key])
        assert again[key] >= model.strength.safety_allowed - 1e-6


def test_an_engine_within_its_limits_is_left_alone():
    model = sample("vaz-2106")
    built = changed(to_engine(model), usual_stresses(model.strength), model.strength.safety_allowed)
    assert built.changes == () and built.left == ()
