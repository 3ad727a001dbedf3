"""What the input itself explains is told and is no reason for a person's eye."""

import pytest

from reports.inputs.load import load_mapping
from reports.inputs.sections.checks import CHECKS
from reports.spec.evaluation import evaluate_model
from reports.tables.overview.verdicts import failed_checks
from reports.tables.registry import build_model


def accepted(*pairs):
    return {"accepted": [{"what": what, "reason": reason} for what, reason in pairs]}


def test_an_explained_oddity_is_no_warning(raw):
    raw["regime"]["mechanical_efficiency"] = 1.0
    (warning,) = load_mapping(raw, source="f").warnings
    assert "regime.mechanical_efficiency: η_м = 1 необычно" in warning.line()
    raw["checks"] = accepted(("regime.mechanical_efficiency", "потери не нужны"))
    loaded = load_mapping(raw, source="f")
    assert loaded.warnings == ()
    (item,) = loaded.accepted
    assert item.line().endswith("η_м = 1 необычно; причина: потери не нужны")


@pytest.mark.parametrize(
    ("pair", "line"),
    [
        (("powr", "так надо"), "checks.accepted[1].what: нет проверки или ключа «powr»; "
         "возможно, power"),
        (("geometry.bor_mm", "так"), "checks.accepted[1].what: нет проверки или ключа "
         "«geometry.bor_mm»; возможно, geometry.bore_mm"),
        (("power", "  "), "checks.accepted[1].reason: причина не названа; напишите, почему "
         "это верно"),
    ],
)  # fmt: skip
def test_only_what_exists_is_explained_and_with_a_reason(raw, refused, pair, line):
    raw["checks"] = accepted(pair)
    assert refused(raw) == [f"f.toml: {line}"]


def test_keys_of_lists_and_regimes_may_be_explained(raw):
    names = ("crankshaft.webs[3].mass_kg", "regimes[1].gas.max_pressure_mpa", "cycle", "power_R2")
    raw["checks"] = accepted(*((name, "проверено") for name in names))
    assert load_mapping(raw, source="f").warnings == ()


def test_a_failed_check_asks_for_a_person_unless_explained(raw):
    explained = build_model(load_mapping(raw, source="f").model)
    (check,) = failed_checks(explained, evaluate_model(explained))
    assert (check.key, check.value) == ("power", "−46,71")
    assert check.reason and explained.remarks[0].startswith("Принято расхождение «Средняя")
    del raw["checks"]
    bare = build_model(load_mapping(raw, source="f").model)
    (check,) = failed_checks(bare, evaluate_model(bare))
    assert not check.reason and not bare.remarks
    assert 'what = "power"' in check.line()


def test_the_names_of_checks_are_those_of_the_tables(raw):
    from tests.inputs.test_plausibility import sample

    raw["masses"] = {"piston_group_kg": 1.5, "rod_kg": 1.7, "rod_small_end_share": 0.275}
    found = set()
    for data in (raw, sample("cycle-turbo-diesel")):
        model = build_model(load_mapping(data, source="f").model)
        found |= {key.removeprefix("check_") for key in model.scalars if key.startswith("check_")}
    assert found == set(CHECKS)
