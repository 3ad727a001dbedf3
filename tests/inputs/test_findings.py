"""What the input itself explains is told and is no reason for a person's eye."""

from __future__ import annotations

import pytest

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.report import CHECKS
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from reports.tables.verdicts import failed_checks
from tests.conftest import sample


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
    collected = set()
    for data in (raw, sample("cycle-turbo-diesel")):
        model = build_model(load_mapping(data, source="f").model)
        collected |= {
            key.removeprefix("check_") for key in model.scalars if key.startswith("check_")
        }
    assert collected == set(CHECKS)


def lines_of(raw):
    return [problem.line() for problem in load_mapping(raw, source="f").warnings]


def test_an_accepted_check_silences_no_oddity_of_its_own_numbers(raw):
    assert raw["checks"]["accepted"][0]["what"] == "power"
    raw["regime"]["indicated_power_kw"] = 8.93
    raw["geometry"]["compression_ratio"] = 7.2
    lines = "".join(lines_of(raw))
    assert "indicated_power_kw: N_i" in lines
    assert "ε = 7,2 необычно" in lines


def test_an_accepted_bore_leaves_the_sizes_their_own_lines(raw):
    raw["geometry"]["bore_mm"] = 880.0
    (bore,) = lines_of(raw)
    assert "D = 880 мм не вяжется" in bore
    raw["checks"]["accepted"].append({"what": "geometry.bore_mm", "reason": "так в задании"})
    lines = lines_of(raw)
    assert bore not in lines
    for key in ("geometry.crank_radius_mm", "crankshaft.pin_diameter_mm", "masses.reciprocating_kg",
                "crankshaft.arms", "crankshaft.webs[1].mass_kg"):  # fmt: skip
        assert any(f"f: {key}" in line for line in lines), key


def test_an_accepted_entry_of_a_list_leaves_the_others_told(raw):
    for web in raw["crankshaft"]["webs"][:4]:
        web["mass_kg"] = 2.45
    (line,) = lines_of(raw)
    assert "webs[1].mass_kg" in line
    assert "ещё 3" in line
    raw["checks"]["accepted"].append({"what": "crankshaft.webs[1].mass_kg", "reason": "взвешена"})
    (line,) = lines_of(raw)
    assert "webs[2].mass_kg" in line
    assert "ещё 2" in line


@pytest.mark.parametrize("number", [1, 2, 4])
def test_an_accepted_journal_leaves_the_others_told(raw, number):
    raw["crankshaft"]["main_lengths_mm"] = [90.0] * 4
    room = [line for line in lines_of(raw) if "не помещается" in line]
    assert len(room) == 1
    what = f"crankshaft.main_lengths_mm[{number}]"
    raw["checks"]["accepted"].append({"what": what, "reason": "так по чертежу"})
    (left,) = (line for line in lines_of(raw) if "не помещается" in line)
    assert f"f: {what}:" not in left
    assert "ещё 2" in left


def test_an_accepted_pin_leaves_the_others_told():
    raw = to_mapping(sample("yamz-236"))
    del raw["crankshaft"]["pin_length_mm"]
    raw["crankshaft"]["pin_lengths_mm"] = [42.0, 42.0, 84.0]
    assert ["pin_lengths_mm[1]" in line for line in lines_of(raw)] == [True]
    raw["checks"] = accepted(("crankshaft.pin_lengths_mm[1]", "узкий шатун"))
    assert ["pin_lengths_mm[2]" in line for line in lines_of(raw)] == [True]


def test_a_reason_is_that_of_one_line(raw):
    raw["crankshaft"]["main_lengths_mm"] = [120.0, 32.0, 32.0, 32.0]
    both = [line for line in lines_of(raw) if "main_lengths_mm[1]" in line]
    assert len(both) == 2
    what = "crankshaft.main_lengths_mm[1]"
    for left in (1, 0):
        raw["checks"]["accepted"].append({"what": what, "reason": "так по чертежу"})
        assert len([line for line in lines_of(raw) if "main_lengths_mm[1]" in line]) == left
