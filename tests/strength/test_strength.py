"""Strength of the parts: the books' formulas against plates, beams and rings; known numbers."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest

from kshm.mechanics import strength as first
from kshm.mechanics.strength import EYE_M0, EYE_N0, TORSION, SectionLoad, StressCycle
from kshm.ranges import side_of
from reports.commands.new_engine import new_text
from reports.document.chapters.closing import checked
from reports.document.report import Report
from reports.document.text.terms import Terms
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.blocks import Held, Model
from reports.model.evaluation import Evaluation, evaluate_model
from reports.tables.registry import build_model
from reports.tables.strength_members import SAFETIES, usual_sizes
from reports.tables.verdicts import failed_checks, weak_values
from reports.workbook.layout import Layout
from reports.workbook.sheets import BlockWriter
from reports.workbook.verdict import judged_lists
from reports.workbook.write import workbook_bytes
from tests.conftest import sample
from tests.document.bare_pages import bare_page, plain
from tests.referee.compare import differences_from_caches, errors_in
from tests.strength import statics
from tools.referees.by_formualizer import Formualizer

SAMPLES = {"vw-1600": "petrol", "gots-diesel": "diesel", "yamz-236": "diesel",
           "two-stroke": "diesel", "cycle-petrol": "petrol"}  # fmt: skip


@lru_cache(maxsize=16)
def model_of(name: str = "gots-diesel", kind: str = "diesel", **more: object) -> Model:
    """A sample with the section."""
    raw = to_mapping(sample(name)) | {"strength": {"kind": kind, **more}}
    return build_model(load_mapping(raw, source="").model)


@pytest.mark.parametrize(
    ("name", "section", "kind"),
    [
        ("cycle-petrol", {}, "petrol"),
        ("cycle-petrol", {"kind": "diesel"}, "diesel"),
        ("cycle-turbo-diesel", {}, "diesel"),
        ("gots-diesel", {"kind": "petrol"}, "petrol"),
    ],
)
def test_parts_are_of_the_kind_of_engine_that_the_file_states(name, section, kind):
    """The parts of a petrol engine were those of a diesel where [strength] was empty."""
    raw = to_mapping(sample(name)) | {"strength": section}
    section = load_mapping(raw, source="").model.strength
    assert section is not None and section.kind == kind


@pytest.fixture(params=SAMPLES)
def run(request: pytest.FixtureRequest) -> Evaluation:
    return Evaluation(model_of(request.param, SAMPLES[request.param]))


def test_the_crown_lies_between_a_clamped_and_a_resting_plate(run: Evaluation):
    size = run.value("st_inner_mm") / 2000, run.value("st_crown_mm") / 1000
    clamped, resting = statics.crown_stress(run.value("st_pz_MPa"), *size)
    assert clamped < run.value("st_crown_MPa") < resting


def test_the_bush_is_two_thick_rings(run: Evaluation):
    inner, common, outer = (run.value(f"st_{key}_mm") / 2000
                            for key in ("pin", "eye_bore", "eye_outer"))  # fmt: skip
    alpha = 1.8e-5 - run.value("rod_expansion") * 1e-6
    gap = run.value("strength_bush_fit_um") * 1e-6
    gap += 2 * common * alpha * run.value("strength_bush_warming_k")
    moduli = (run.value("strength_bush_modulus_mpa"), run.value("rod_modulus"))
    actual = first.fit_pressure(gap, (inner, common, outer), moduli)
    assert run.value("st_bush_MPa") == pytest.approx(actual, rel=1e-9)


def test_the_pin_is_a_beam_and_its_shear_that_of_a_ring(run: Evaluation):
    outer, inner = run.value("st_pin_mm"), run.value("st_pin_bore_mm")
    force = run.value("st_pin_N")
    modulus = np.pi / 32 * (outer**4 - inner**4) / outer
    sizes = (run.value(f"st_{key}_mm") for key in ("pin_length", "bosses", "eye_length"))
    actual = statics.pin_bending(force, *sizes, modulus)
    assert run.value("st_pin_bend_MPa") == pytest.approx(actual, rel=0.02)  # 1.2 for 12π/32
    shear = statics.pin_shear(force, outer, inner)
    assert run.value("st_pin_shear_MPa") == pytest.approx(shear, rel=0.002)  # 0.85 for 0.8488


def test_the_ovality_is_that_of_a_ring_in_size(run: Evaluation):
    sizes = (run.value(f"st_{key}_mm") for key in ("pin_length", "pin", "pin_bore"))
    actual = statics.pin_oval(run.value("st_pin_N"), *sizes, run.value("strength_pin_modulus_mpa"))
    assert 0.3 < run.value("st_oval_mm") / actual < 3


def test_the_shank_is_a_column(run: Evaluation):
    limit, area = run.value("rod_tensile"), 100 * run.value("st_shank_cm2")
    second, modulus = run.value("st_shank_Jx"), run.value("rod_modulus")
    actual = first.column_factor(limit, area, second, 1000 * run.value("L_rod"), modulus)
    assert run.value("st_shank_Kx") == pytest.approx(actual, rel=1e-9)


def test_safety_is_the_nearer_of_two_lines(run: Evaluation):
    pairs = {
        "st_bolt_n": ("bolt", "st_bolt_max_MPa", "st_bolt_min_MPa"),
        "st_shank_nx": ("rod", "st_shank_x_MPa", "st_shank_min_MPa"),
        "st_shank_ny": ("rod", "st_shank_y_MPa", "st_shank_min_MPa"),
    }
    for key, (part, most, least) in pairs.items():
        limits = run.value(f"{part}_pull"), run.value(f"{part}_yield")
        k, mean = run.value(f"strength_{part}_concentration"), run.value("strength_mean_factor")
        actual = StressCycle.of(run.value(most), run.value(least)).safety(limits, k, mean)
        assert run.value(key) == pytest.approx(actual, rel=1e-9), key


@pytest.mark.parametrize("angle", [90, 100, 105, 110, 115, 120, 125, 130])
def test_the_eye_by_statics_and_how_far_the_books_fits_are(angle: int):
    force, moment = first.eye_forces(np.radians(angle), drawn=True)
    assert 0.572 - 0.0008 * angle == pytest.approx(force, abs=0.0085)
    assert 0 <= 0.00033 * angle - 0.0297 - moment < 0.0046  # overstated, fivefold near 105°
    force, moment = first.eye_forces(np.radians(angle), drawn=False)
    assert np.interp(angle, *zip(*EYE_N0, strict=True)) == pytest.approx(force, abs=5e-4)
    assert -np.interp(angle, *zip(*EYE_M0, strict=True)) == pytest.approx(moment, abs=1.6e-4)


def test_the_beam_of_the_notes():
    """Four numbers of statics, to the digits they were given with."""
    assert first.eye_forces(np.radians(110), drawn=True) == pytest.approx(
        (0.4922, 0.00213), abs=5e-5
    )
    assert first.eye_forces(np.radians(120), drawn=False) == pytest.approx(
        (0.00339, -0.00105), abs=5e-6
    )


def test_torsion_of_a_rectangle():
    """As printed up to 4, by the series beyond, where the print's last number stood still."""
    for ratio, factor in TORSION:
        assert first.torsion_series(ratio) == pytest.approx(factor, abs=6e-4)
        assert first.torsion_factor(ratio) == pytest.approx(factor, abs=6e-4)
    for ratio in (4.0, 4.5, 6.0, 12.0, 300.0):
        thin = (1 - 0.63 / ratio + 0.052 / ratio**5) / 3  # Timoshenko's J, the slope being 1
        assert first.torsion_factor(ratio) == pytest.approx(thin, rel=4e-3)
        sizes = {"st_web_width_mm": 12.0 * ratio, "st_web_thickness_mm": 12.0}
        book = Evaluation(model_of(), sizes)
        assert book.value("st_web_rho") == pytest.approx(first.torsion_series(ratio), rel=1e-10)
        w = first.torsion_series(ratio) * 12.0 * ratio * 12.0**2 / 1000
        assert book.value("st_web_W") == pytest.approx(w, rel=1e-10)


def test_the_outer_fibre_is_that_of_a_curved_bar_in_size():
    for wall in (3.0, 6.0, 9.0):
        for moment, force in ((-2.0, 4000.0), (3.0, 0.0)):
            fit = first.outer_fibre(SectionLoad(force, moment), 0.02, wall / 1000, 0.03, 1.0)
            bar = statics.curved_fibre(moment, force, 0.02, wall / 1000, 0.03)
            assert fit == pytest.approx(bar, rel=0.03)


def known(values: dict[str, float], **forms: str) -> Evaluation:
    return Evaluation(model_of(**forms), values)


def test_numbers_of_a_land_and_a_crown():
    run = known({"st_pz_MPa": 12, "geometry_bore_mm": 130, "st_land_mm": 6.5}, crown_form="quarter")
    assert run.value("st_land_shear_MPa") == pytest.approx(7.536, abs=5e-4)
    assert run.value("st_land_bend_MPa") == pytest.approx(21.600, abs=5e-4)
    assert run.value("st_land_MPa") == pytest.approx(26.339, abs=5e-4)
    ratio = (4 * 73.2 / 12) ** 0.5
    run = known({"st_pz_MPa": 12, "st_inner_mm": ratio, "st_crown_mm": 1}, crown_form="quarter")
    assert run.value("st_crown_MPa") == pytest.approx(73.2, abs=0.05)


@pytest.mark.parametrize("form", ["curved", "program"])
def test_numbers_of_a_pin(form: str):
    """Inner stresses of the numbers are the program's; those of a curved bar are others."""
    run = known({"st_pin_N": 169678.3, "st_pin_mm": 48, "st_pin_bore_mm": 26.4,
                 "st_pin_length_mm": 110.5, "st_bosses_mm": 50, "st_eye_length_mm": 58,
                 "strength_pin_modulus_mpa": 2.1e5}, oval_form=form)  # fmt: skip
    lines = {"st_pin_bend_MPa": 173.807, "st_pin_shear_MPa": 127.644, "st_oval_out0_MPa": 68.914,
            "st_oval_in0_MPa": -415.674, "st_oval_out90_MPa": -223.002,
            "st_oval_in90_MPa": 220.779}  # fmt: skip
    if form == "curved":  # (1 + 2α)/(2 + α) of its first part
        lines |= {"st_oval_in0_MPa": -360.5028, "st_oval_in90_MPa": 170.2537}
    for key, value in lines.items():
        assert run.value(key) == pytest.approx(value, rel=5e-6), key
    assert run.value("st_oval_mm") == pytest.approx(0.038979, rel=2e-4)


@pytest.mark.parametrize(("form", "stress"), [("each", 261.3), ("all", 249.4)])
def test_two_readings_of_the_bolts(form: str, stress: float):
    run = known({"st_bolt_mm": 10, "strength_bolt_pitch_mm": 1, "st_Pj_rod_N": 13800,
                 "strength_bolt_preload": 2, "strength_bolt_share": 0.2},
                bolt_form=form)  # fmt: skip
    assert run.value("st_bolt_max_MPa") == pytest.approx(stress, abs=0.06)


def test_two_forms_of_the_pins_force():
    minus, plus = (Evaluation(model_of(pin_form=form)) for form in ("minus", "plus"))
    swing = minus.value("strength_pin_share") * minus.value("st_Pj_N")
    assert plus.value("st_pin_N") - minus.value("st_pin_N") == pytest.approx(2 * swing)


def test_a_given_size_takes_the_place_of_the_usual_one():
    usual, given = Evaluation(model_of()), Evaluation(model_of(crown_mm=12.0))
    assert given.value("st_crown_mm") == 12.0 != usual.value("st_crown_mm")
    assert model_of().scalars["st_crown_mm"].source.startswith("оценка: 0,16 D")


@pytest.mark.parametrize("kind", ["petrol", "diesel"])
def test_usual_sizes_lie_within_their_spans(kind: str):
    for size in usual_sizes(kind):
        assert size.low < size.share < size.high


def test_the_workbook_is_recalculated_and_the_chapter_says_its_results():
    model = model_of(pin_form="plus", oval_form="program")
    values = evaluate_model(model)
    book = workbook_bytes(model, values)
    (recalculated,) = Formualizer().recalculate([book])
    assert errors_in(recalculated) == [] and differences_from_caches(book, recalculated) == []
    page = Report(model, values).page("screen")
    assert "Прочность деталей</h1>" in page
    assert values.scalars["check_range_oval_in0"] == "вне пределов"
    assert "напряжение овализации пальца (увеличить толщину стенки пальца)." in page
    for key in ("st_crown_MPa", "st_pin_bend_MPa", "st_shank_Kx", "st_cap_MPa", "st_bolt_max_MPa"):
        assert f'id="eq-n.3a.{key}"' in page, key


def test_new_gives_usual_sizes_with_their_ratio():
    text = new_text(None, sample=None, cylinders=4, strength=True, kind="petrol", bore_mm=80.0)
    assert "land_mm = 3.2 # Первая кольцевая перемычка: 0,04 D (обычно 0,03…0,05)" in text


def test_every_safety_says_what_mends_it():
    blocks = {block.id: block for block in model_of().blocks}
    keys = [scalar.key for scalar in blocks["strength_allowed"].scalars[::2]]
    (told,) = model_of().chapters
    mends = {line.key for line in told.lines if line.kind == "mend"}
    usual = {verdict.key.removeprefix("check_") for _, verdict in blocks["strength_ranges"].pairs}
    assert mends == {key.removeprefix("value_") for key in {*keys, *usual}}


@pytest.mark.parametrize(("value", "side"), [(10, -1), (20, 0), (150, 0), (151, 1), (-151, 1)])
def test_the_side_of_a_usual_range(value: float, side: int):
    assert side_of(value, (20, 150)) == side
    assert side_of(value, (-150, 150)) == side_of(-value, (-150, 150)) == max(side, 0)


@pytest.mark.parametrize(
    ("inputs", "weak", "above"),
    [
        ({}, False, False),
        ({"safety_allowed": 9.0}, True, False),
        ({"crown_mm": 3.0, "land_mm": 1.0}, False, True),
        ({"bolt_mm": 5.0, "crown_mm": 3.0}, True, True),
    ],
)
@pytest.mark.usefixtures("nothing_is_drawn")
def test_a_weak_part_or_a_large_stress_is_a_failed_check(
    inputs: dict[str, float], weak: bool, above: bool
):
    """«Все проверки выполнены» after a safety of 0.74 and nine large stresses was a lie."""
    model = model_of("vw-1600", "petrol", **inputs)
    values = evaluate_model(model)
    terms, writer = Terms(model, values), BlockWriter(Layout.of(model), values)
    lists = [block.id for block in judged_lists(writer) if block.held is Held.CHECK]
    assert lists == ["checks", "strength_checks"]
    assert not {each.key for each in checked(terms) if "range_" in each.key}
    bad = {check.key for check in failed_checks(model, values)}
    assert ("st_least" in bad, "st_usual" in bad) == (weak, above)
    assert not any(key.startswith("range_") for key in bad)  # each is counted by st_usual
    assert any("Запас прочности" in line for line in weak_values(model, values)) == weak
    counted = [part for check in failed_checks(model, values) for part in check.counted]
    assert len(counted) == (terms.value("value_st_usual") if above else 0)
    assert all("обычно" in part for part in counted)
    least = min(terms.value(key) for key in SAFETIES)
    assert terms.value("value_st_least") == pytest.approx(
        least / model.input.strength.safety_allowed
    )
    end = plain(bare_page(model.input)).rpartition("наименьший запас прочности")[2]
    assert ("Все проверки расчёта" in end) == (not weak and not above)


@pytest.mark.parametrize(("name", "kind"), [("vw-1600", "petrol"), ("gots-diesel", "diesel")])
def test_a_web_is_bent_by_the_support_and_pressed_by_the_pin(name: str, kind: str):
    """A throw as a beam on two supports; the web is cut between journal and pin."""
    run = Evaluation(model_of(name, kind))
    arm, right, length = (run.value(f"throw1_{key}") / 1000
                          for key in ("arm_left", "arm_right", "length"))  # fmt: skip
    area = run.value("F_piston")
    pin = (run.value("P4_1.K_MPa") - run.value("K_r_rod") - run.value("K_r_throw")) * area * 1e6
    weights = run.value("throw1_C1"), run.value("throw1_C7")
    # Moments about the far support: half of the pin's force by the split of the books.
    support = pin / 2 + (weights[0] * (length - arm) + weights[1] * right) / length
    through = pin / 2  # the counterweight stands on the journal's side of the cut
    width, thick = run.value("st_web_width_mm") / 1000, run.value("st_web_thickness_mm") / 1000
    stress = support * arm / (width * thick**2 / 6) + through / (width * thick)
    assert run.value("webs_load.st_web_bend1_MPa") == pytest.approx(stress / 1e6, rel=1e-9)
    assert (sum(weights) > 0) == (name != "vw-1600")  # which has none
