"""Engines of usual values, and alternatives by the similarity rules."""

from __future__ import annotations

import itertools
import math
import tomllib

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st

from kshm import solve
from kshm.mechanics.balance import rod_places
from kshm.ranges import THROW_MASSES
from reports.cli import main
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping, load_text, load_toml
from reports.inputs.to_si.engine import engine_and_cycle, to_engine
from reports.inputs.units import number_text
from reports.new.generate import LINE, file_text, generate_engine, table_masses
from reports.new.part_sizes import decimals
from reports.new.scale_engine import alternative
from reports.new.sizing import USUAL
from reports.shared.errors import InputError
from reports.shared.resources import samples_dir
from tests import cover
from tests.cover import sparse

LAYOUTS, KINDS = ("inline", "v", "opposed"), ("petrol", "diesel")
ALL = [
    (cylinders, layout, strokes, kind)
    for layout, strokes, kind in itertools.product(LAYOUTS, (4, 2), KINDS)
    for cylinders in range(1, 13)
    if layout == "inline" or cylinders % 2 == 0
]
# Twelve of them, one for each number of cylinders, which are built whole.
TWELVE = [
    (1, "inline", 2, "petrol"), (2, "opposed", 4, "petrol"), (3, "inline", 4, "diesel"),
    (4, "opposed", 2, "diesel"), (5, "inline", 4, "petrol"), (6, "v", 4, "diesel"),
    (7, "inline", 2, "diesel"), (8, "v", 4, "petrol"), (9, "inline", 4, "diesel"),
    (10, "v", 2, "diesel"), (11, "inline", 2, "petrol"), (12, "v", 4, "petrol"),
]  # fmt: skip
SHOWN = {1, 6, 12}  # of which the report is set as well


def built() -> list[tuple]:
    """Those of which files are made: every two of layout, strokes and kind meet."""
    held = {
        engine: set(itertools.combinations(enumerate(engine[1:]), 2)) | ({engine[0]} & SHOWN)
        for engine in TWELVE
    }
    return TWELVE if cover.ALL else cover.smallest(held, {engine: engine[0] for engine in TWELVE})


def run(*args):
    done = CliRunner().invoke(main, [str(arg) for arg in args])
    return done.exit_code, done.output


def made(cylinders, layout="inline", strokes=4, kind="petrol", **more):
    text = file_text(generate_engine(cylinders, layout=layout, strokes=strokes, kind=kind, **more))
    return load_text(text, source="own.toml")


@pytest.mark.parametrize(
    ("layout", "strokes", "kind"), list(itertools.product(LAYOUTS, (4, 2), KINDS))
)
def test_every_engine_passes_without_a_warning(layout, strokes, kind):
    for case in (case for case in ALL if case[1:] == (layout, strokes, kind)):
        assert made(*case).warnings == (), case


@pytest.mark.parametrize(("cylinders", "layout", "strokes", "kind"), sparse(TWELVE))
def test_twelve_engines_pass_and_are_built(tmp_path, cylinders, layout, strokes, kind):
    file = tmp_path / "own.toml"
    options = ("--cylinders", cylinders, "--layout", layout, "--strokes", strokes, "--kind", kind)
    assert run("new", *options, "-o", file)[0] == 0
    assert run("check", file)[0] == 0
    file.write_text(file.read_text("utf-8").replace("step_deg = 10", "step_deg = 30"), "utf-8")
    kinds = ["xlsx", *(["html"] if cylinders in SHOWN else [])]
    for only in kinds if (cylinders, layout, strokes, kind) in built() else ():
        code, output = run("build", file, "--only", only, "-o", tmp_path)
        assert code == 0, output
        assert (tmp_path / f"own.{only}").stat().st_size > 10_000


@pytest.mark.parametrize(("kind", "strokes"), USUAL)
def test_the_diagram_gives_the_pressure_the_size_was_found_with(kind, strokes):
    model = made(4, strokes=strokes, kind=kind).model
    engine, cycle = engine_and_cycle(model)
    power = solve(engine, cycle).scalars["N_i_calc"] * model.regime.mechanical_efficiency
    swept = engine.geometry.piston_area * 2 * engine.geometry.crank_radius * 4
    actual = power / 1000 / (swept * model.regime.speed_rpm / 30 / strokes)
    assert actual == pytest.approx(USUAL[kind, strokes].effective_mpa, rel=0.005)


@settings(max_examples=25, deadline=None)
@given(
    case=st.sampled_from(ALL),
    power=st.floats(2, 40),
    speed=st.sampled_from([None, 0.8, 1.0, 1.2]),
)
def test_an_engine_has_the_power_that_was_asked_for(case, power, speed):
    cylinders, layout, strokes, kind = case
    usual = made(*case).model.regime.speed_rpm
    wanted = None if speed is None else round(usual * speed)
    actual = made(cylinders, layout, strokes, kind, power_kw=power * cylinders, speed_rpm=wanted)
    assert actual.warnings == ()
    model = actual.model
    if wanted is not None:
        assert model.regime.speed_rpm == wanted
    moment = solve(*engine_and_cycle(model)).scalars["M_e"]
    given_kw = moment * model.regime.speed_rpm * math.pi / 30 / 1000
    assert given_kw == pytest.approx(power * cylinders, rel=0.02)


@pytest.mark.parametrize(("kind", "strokes"), sorted(USUAL))
@pytest.mark.parametrize("bore_mm", [22, 61, 160, 400, 950])
def test_engines_of_every_size_pass_without_a_warning(bore_mm, kind, strokes):
    usual = USUAL[kind, strokes]
    speed = round(usual.piston_speed * 30000 / usual.stroke_bore / bore_mm)
    actual = made(4, "inline", strokes, kind, speed_rpm=speed)
    assert actual.warnings == ()
    assert actual.model.geometry.bore_mm == pytest.approx(bore_mm, rel=0.02)


def test_firing_is_even_where_one_order_says_it():
    for case in ALL:
        shaft = generate_engine(case[0], layout=case[1], strokes=case[2], kind=case[3]).data[
            "crankshaft"
        ]
        assert ("firing_order" in shaft) != ("firing_offsets_deg" in shaft)
        assert len(shaft["webs"]) == 2 * len(shaft["arms"]) == 2 * len(shaft["throw_angles_deg"])


def test_what_a_beginner_must_know_stands_first():
    text = file_text(generate_engine(4))
    first, rest = text.split(f"# {LINE}\n")
    heads = ["[engine]", "[geometry]", "[regime]", "[gas]"]
    assert [line.split(" #")[0] for line in first.splitlines() if line.startswith("[")] == heads
    for key in ("pin_diameter_mm", "piston_group_kg", "firing_order", "l1_mm"):
        line = next(line for line in rest.splitlines() if line.startswith(f"{key} ="))
        assert "обычн" in line or "таблица 4" in line or "половина" in line, line


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--cylinders", 3, "--layout", "opposed"),
         "--cylinders: число цилиндров 3 нечётное, а рядов у оппозитного двигателя два; задайте "
         "чётное число или --layout inline"),
        (("--cylinders", 1, "--layout", "v"),
         "--cylinders: число цилиндров 1 нечётное, а рядов у V-образного двигателя два; задайте "
         "чётное число или --layout inline"),
        (("--cylinders", 13), "--cylinders: число цилиндров 13; команда знает от 1 до 12"),
        (("--cylinders", 0), "--cylinders: число цилиндров 0; команда знает от 1 до 12"),
        (("--cylinders", 4, "--power", 0), "--power: значение должно быть больше нуля"),
        (("--cylinders", 4, "--speed", "nan"), "--speed: значение должно быть больше нуля"),
        (("--power", 50), "--power: ключ для своего двигателя; добавьте --cylinders"),
        (("--cylinders", 4, "--sample", "d-240"),
         "--sample и --cylinders вместе не нужны; оставьте один из ключей"),
        (("--from", "SAMPLE"),
         "--from: не указано число цилиндров варианта; добавьте --cylinders"),
        (("--from", "SAMPLE", "--cylinders", 6, "--strokes", 2),
         "--strokes: у варианта они те же, что в SAMPLE; уберите ключ"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_in_a_line(options, message):
    sample = str(samples_dir() / "d-240.toml")
    given_options = [sample if option == "SAMPLE" else option for option in options]
    code, output = run("new", *given_options)
    assert code == 2
    assert output.splitlines() == [message.replace("SAMPLE", sample)]


@pytest.mark.parametrize("options", [("--power", "1e9"), ("--power", "1e-3"), ("--speed", "1")])
def test_a_bore_that_cannot_be_is_refused(options):
    code, output = run("new", "--cylinders", 4, *options)
    assert code == 2
    assert output.startswith(f"{options[0]}: получается диаметр цилиндра ")
    assert "возможно от 10 до 1000 мм" in output


def drawn(size):
    return round(size, decimals(size))


@pytest.mark.parametrize("sample", ["d-240", "ecoboost-10", "vw-1600", "two-stroke", "yamz-238"])
@pytest.mark.parametrize("cylinders", [2, 6, 12])
def test_the_similarity_rules_hold_to_the_digit_of_a_drawing(sample, cylinders):
    old = load_toml(samples_dir() / f"{sample}.toml").model
    data = tomllib.loads(file_text(alternative(old, cylinders)))
    geometry = engine_and_cycle(old)[0].geometry
    third = (old.engine.cylinders / cylinders) ** (1 / 3)
    half = (old.engine.cylinders / cylinders) ** (1 / 2)
    # The way of a piston with an offset is longer than 2r: the radius is told.
    way, turns = ("crank_radius_mm", 1) if sample == "ecoboost-10" else ("stroke_mm", 2)
    for key, size, share in (
        ("bore_mm", geometry.bore, 1), (way, 2 * geometry.crank_radius, turns / 2),
        ("rod_length_mm", geometry.rod_length, 1),
    ):  # fmt: skip
        assert data["geometry"][key] == drawn(size * 1000 * third) * share
    for key in ("pin_diameter_mm", "pin_length_mm", "main_diameter_mm"):
        before = getattr(old.crankshaft, key)
        least = 0 if key == "pin_length_mm" else 0.3 * data["geometry"]["bore_mm"]
        edge = math.ceil(round(least * 10 ** decimals(least), 6)) / 10 ** decimals(least)
        assert data["crankshaft"][key] == max(drawn(before * half), edge)
    new = load_text(file_text(alternative(old, cylinders)), source="alt.toml").model
    other = engine_and_cycle(new)[0].geometry
    swept = [
        size.piston_area * size.crank_radius * count
        for size, count in ((geometry, old.engine.cylinders), (other, cylinders))
    ]
    # Half of the last digit of D counts twice in the displacement, that of S once.
    lost = 2 * 0.05 / data["geometry"]["bore_mm"] + 0.05 / data["geometry"][way]
    assert swept[0] == pytest.approx(swept[1], rel=lost)


def test_an_alternative_of_another_power_says_so(tmp_path):
    sample = samples_dir() / "d-240.toml"
    file = tmp_path / "alt.toml"
    assert run("new", "--from", sample, "--cylinders", 6, "--power", 100, "-o", file)[0] == 0
    text = file.read_text(encoding="utf-8")
    assert "Мощность 100 кВт вместо 58,52 кВт при прежнем p_e" in text
    model = load_toml(file).model
    moment = solve(*engine_and_cycle(model)).scalars["M_e"]
    assert moment * 2200 * math.pi / 30 / 1000 == pytest.approx(100, rel=1e-3)


@pytest.mark.parametrize(
    "path", sparse(sorted(samples_dir().glob("*.toml"))), ids=lambda path: path.stem
)
def test_every_sample_has_an_alternative_that_passes(path):
    old = load_toml(path)
    actual = load_text(file_text(alternative(old.model, 6)), source="alt.toml")
    # What the sample accepts with a reason of its own is told of the alternative.
    raw = to_mapping(old.model)
    raw.pop("checks", None)
    bare = load_mapping(raw, source="bare.toml").warnings
    assert {problem.what for problem in actual.warnings} <= {problem.what for problem in bare}
    masses = file_text(alternative(old.model, 6))
    assert "таблица 4: от " in masses


def test_cylinders_of_an_alternative_stand_beside_each_other():
    """By the rule alone twelve would overlap: journals shrink faster than the bore."""
    for sample, separate in (("two-stroke", 0.77), ("yamz-238", None), ("cycle-petrol", 0.82)):
        old = load_toml(samples_dir() / f"{sample}.toml").model
        text = file_text(alternative(old, 12))
        engine = to_engine(load_text(text, source="alt.toml").model)
        between = np.diff(np.unique(rod_places(engine)))[:: 2 if sample == "yamz-238" else 1]
        assert between.min() >= (1.08 if separate else 0) * engine.geometry.bore * (1 - 1e-6)
        assert ("шейки и щёки удлинены до 1,08 D" in text) == (separate is not None)
        assert separate is None or f"вышло бы 0,{round(separate * 100)}" in text


def test_an_alternative_has_a_train_and_bearings_of_its_own():
    """Throws and stiffnesses of six are not those of four; clearances follow the journals."""
    text = file_text(alternative(load_toml(samples_dir() / "mwm-6.toml").model, 4))
    made_ = load_text(text, source="alt.toml").model
    assert made_.torsion.masses == ()
    assert len(made_.torsion.peaks) == 16
    assert "Крутильная схема прежнего вала не перенесена" in text
    old = load_toml(samples_dir() / "d-240-bearings.toml").model
    new = load_text(file_text(alternative(old, 10)), source="alt.toml").model
    share = new.crankshaft.pin_diameter_mm / old.crankshaft.pin_diameter_mm
    for key in ("pin_clearance_min_mm", "pin_clearance_max_mm", "hole_mm"):
        before, after = (getattr(model.bearings, key) for model in (old, new))
        assert after == drawn(before * share)
    assert new.bearings.journal_roughness_um == old.bearings.journal_roughness_um


@pytest.mark.parametrize(("cylinders", "words"), [(1, "принято 0,95 D"), (12, "принято 0,3 D")])
def test_journals_of_an_alternative_stay_within_their_bounds(cylinders, words):
    """Journals by ½ and the bore by ⅓: from 1 to 12 cylinders the rule alone leaves d = 0.275 D."""
    base = made(12) if cylinders == 1 else load_toml(samples_dir() / "two-stroke.toml")
    text = file_text(alternative(base.model, cylinders, speed_rpm=2000 if cylinders == 1 else None))
    assert load_text(text, source="alt.toml").warnings == ()
    (line,) = (row for row in text.splitlines() if row.startswith("pin_diameter_mm ="))
    assert words in line


@pytest.mark.parametrize(
    ("layout", "strokes", "kind"), list(itertools.product(LAYOUTS, (4, 2), KINDS))
)
def test_every_alternative_of_made_engines_passes(layout, strokes, kind):
    for first, last in ((2, 12), (12, 2), (4, 6), (6, 1 if layout == "inline" else 8)):
        model = made(first, layout, strokes, kind).model
        actual = load_text(file_text(alternative(model, last)), source="alt.toml")
        assert actual.warnings == (), (first, last)


def test_what_is_known_by_memory_says_so():
    for case in ALL:
        text = file_text(generate_engine(case[0], layout=case[1], strokes=case[2], kind=case[3]))
        keys = ("firing_order =", "firing_offsets_deg =")
        (line,) = (row for row in text.splitlines() if row.startswith(keys))
        assert "по памяти: сверьте со своим" in line


def test_an_alternative_of_an_impossible_layout_is_refused():
    old = load_toml(samples_dir() / "yamz-238.toml").model
    with pytest.raises(InputError, match="число цилиндров 5 нечётное"):
        alternative(old, 5)


def test_an_engine_with_a_spark_is_not_said_to_burn_petrol():
    """Whoever writes methane into [cycle] keeps the name."""
    assert "ензин" not in file_text(generate_engine(4, kind="petrol"))
    assert generate_engine(4).data["engine"]["name"].startswith("Двигатель с искровым зажиганием: ")


@pytest.mark.parametrize("kind", ["petrol", "diesel"])
def test_masses_of_a_throw_are_within_the_table_they_are_taken_from(kind):
    """Four digits of the pin and of the webs made 200.003 kg/m² of 200."""
    low, high = THROW_MASSES["steel", kind]
    for tenths in range(500, 1500, 7):
        bore = tenths / 10
        shaft = table_masses("inline", kind, bore, bore)[1]
        area = math.pi * (bore / 1000) ** 2 / 4
        assert low <= (shaft.pin + 2 * shaft.web) / area <= high, bore


@pytest.mark.parametrize("options", [{}, {"power_kw": 106.0, "speed_rpm": 5200.0}])
def test_the_note_at_the_bore_tells_this_engines_piston_speed(options):
    built = generate_engine(4, **options)
    speed = built.data["geometry"]["stroke_mm"] * built.data["regime"]["speed_rpm"] / 30000
    assert f"Sn/30 ≈ {number_text(round(speed, 1))} м/с" in built.notes["geometry.bore_mm"]


def test_masses_of_a_large_engine_grow_with_its_bore():
    """Table 4 is of engines up to about 150 mm; beyond it alike engines weigh as D³."""
    small, large = (
        table_masses("inline", "diesel", bore, 1.1 * bore)[0]["piston_group_kg"]
        for bore in (150.0, 300.0)
    )
    assert large / small == pytest.approx(8, rel=0.01)


@pytest.mark.parametrize(("bore", "pitch"), [(60.0, 1.0), (110.0, 1.5), (300.0, 3.0), (900.0, 4.0)])
def test_the_thread_of_a_rod_bolt_follows_its_diameter(bore, pitch):
    """A bolt of 43.5 mm had a thread of 1 mm."""
    part = generate_engine(4, kind="diesel", bore_mm=bore, strength=True).data["strength"]
    assert part["bolt_pitch_mm"] == pitch and 0.02 < pitch / part["bolt_mm"] < 0.15
