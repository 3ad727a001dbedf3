"""Strength of the parts: the solver and the expressions agree, and both with counts by hand."""

from __future__ import annotations

import json
import random
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

from kshm.chain.solve import solve_batch
from kshm.ranges import PART_SHARES
from kshm.results.chosen import choose, of_batch
from reports.exports.numbers import export_tables, json_text
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping, load_text
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.strength import PART_MATERIALS
from reports.inputs.solve_input import solved
from reports.inputs.to_si.engine import engine_and_cycle
from reports.model.evaluation import Evaluation
from reports.new.generate import file_text, generate_engine
from reports.studies.comparison import Compared, results
from reports.tables.registry import build_model
from reports.tables.strength_members import SAFETIES, usual_stresses
from tests.conftest import sample
from tests.tables.test_two_statements import assert_agree, results_of

CYLINDERS = {"inline": (1, 2, 3, 4, 6), "v": (2, 6, 8, 12), "opposed": (2, 4, 6)}
KINDS = [(layout, strokes, kind) for layout in CYLINDERS for strokes in (4, 2)
         for kind in ("petrol", "diesel")]  # fmt: skip


@lru_cache(maxsize=32)
def drawn(seed: int) -> InputFile:
    """A new engine of a kind that the seed picks; some sizes left out, forms and steels drawn."""
    draw = random.Random(seed)
    layout, strokes, kind = KINDS[seed % len(KINDS)]
    bore = round(draw.uniform(55, 160), 1)
    engine = generate_engine(draw.choice(CYLINDERS[layout]), layout=layout, strokes=strokes,
                             kind=kind, strength=True, bore_mm=bore)  # fmt: skip
    raw = to_mapping(load_text(file_text(engine), source="drawn").model)
    section = raw["strength"]
    for key in PART_SHARES:
        if draw.random() < 0.4:
            section[f"{key}_mm"] = None
    section |= {
        "speed_factor": round(draw.uniform(1, 1.3), 2),
        "piston_material": draw.choice(("aluminium", "iron")),
        "crown_form": draw.choice(("full", "quarter")),
        "pin_form": draw.choice(("minus", "plus")),
        "oval_form": draw.choice(("curved", "program")),
        "bolt_form": draw.choice(("each", "all")),
        "embedding_deg": draw.choice((90, 97, 110, 123, 130)),
        "mean_factor": draw.choice((0, 0.2, 0.6)),
        "bush_warming_k": draw.choice((0, 110)),
        "web_width_mm": draw.choice((None, round(2 * bore, 1))),  # beyond the sides' ratio of 4
    }
    section |= {f"{part}_material": draw.choice(list(PART_MATERIALS))
                for part in ("rod", "bolt", "web")}  # fmt: skip
    if draw.random() < 0.5:
        section["piston_kg"] = raw["masses"]["piston_group_kg"] * 0.9
    raw["calculation"] |= {"step_deg": draw.choice((5, 10, 15)),
                           "method": draw.choice(("exact", "textbook"))}  # fmt: skip
    return load_mapping(raw, source=f"drawn {seed}").model


CHAPTER = {"ring_pressure", "webs_load", "rod_load"}


def assert_whole(data: InputFile) -> None:
    """Both statements agree on every scalar and table of the chapter, none left out."""
    model, solution = build_model(data), solved(data)
    run = Evaluation(model)
    keys = {key for key in model.scalars if key.startswith("st_")}
    assert keys == {key for key in solution.scalars if key.startswith("st_")}
    assert len(keys) > 90 and SAFETIES[0] in keys
    for key in keys:
        theirs = solution.scalars[key]
        assert abs(run.value(key) - theirs) <= 1e-10 * max(1.0, abs(theirs)), key
    tables = CHAPTER & set(solution.columns)
    assert CHAPTER & results_of(model) == tables
    for name in tables:
        shown = [c.key for c in model.tables[name].columns if not c.helper]
        assert shown == list(solution.columns[name])
        for key, theirs in solution.columns[name].items():
            scale = max(1.0, float(np.abs(theirs).max()))
            assert (np.abs(run.value(f"{name}.{key}") - theirs) <= 1e-10 * scale).all(), key


def test_the_sample() -> None:
    data = sample("vaz-2106")
    assert_whole(data)
    assert_agree(data)  # with all other chapters


@pytest.mark.parametrize("seed", range(24))
def test_drawn_engines(seed: int) -> None:
    """Petrol, diesel, in line, V, opposed, of two and four strokes."""
    assert_whole(drawn(seed))


@pytest.mark.parametrize("name", ["yamz-236", "cycle-petrol", "two-stroke"])
def test_samples_with_the_section(name: str) -> None:
    """Split crankpins have no webs; masses and pressures of a cycle."""
    raw = to_mapping(sample(name)) | {"strength": {"kind": "petrol"}}
    assert_whole(load_mapping(raw, source=name).model)


def test_an_estimated_piston_is_the_estimate() -> None:
    """Of masses by table 4 the piston's own is taken, not a share of what moves."""
    raw = to_mapping(sample("gots-diesel")) | {"strength": {"kind": "diesel"}}
    raw["masses"] = {"estimate_fuel": "diesel", "rod_small_end_share": 0.275}
    data = load_mapping(raw, source="estimate").model
    assert_whole(data)
    values = Evaluation(build_model(data))
    assert solved(data).scalars["st_m_piston"] == pytest.approx(values.value("m_piston"))


@pytest.mark.parametrize("seed", range(6, 12))
def test_the_least_force_of_the_rod_by_hand(seed: int) -> None:
    """Gas and inertia at TDC of gas exchange; of two strokes the least sum over the cycle."""
    data = drawn(seed)
    solution = solved(data)
    s, table = solution.scalars, solution.columns["P4_1"]
    area = np.pi / 4 * (1000 * (4 * s["F_piston"] / np.pi) ** 0.5) ** 2  # mm²
    factor = data.strength.speed_factor
    inertia = s["m_j"] * (factor * s["omega"]) ** 2 * s["r_crank"] * (1 + s["lam"])
    if data.engine.strokes == 4:
        assert s["st_drawn_N"] == pytest.approx(table["Pg_MPa"][0] * area - inertia)
        assert s["st_drawn_N"] != pytest.approx(-inertia, rel=1e-4)
    else:
        force = (table["Pg_MPa"] + factor**2 * table["Pj_MPa"]) * area
        assert s["st_drawn_N"] == pytest.approx(force.min())
        assert s["st_drawn_N"] > -0.9 * inertia  # gas presses at every TDC


def test_numbers_without_documents_have_the_chapter() -> None:
    data = sample("vaz-2106")
    solution = solved(data)
    summary = json.loads(json_text(data, solution))["summary"]
    assert summary["st_bolt_n"]["value"] == solution.scalars["st_bolt_n"]
    tables = export_tables(solution)
    assert {"ring_pressure", "webs_load"} <= tables.keys()
    assert len(tables["ring_pressure"]["st_ring_deg"]) == 13


def test_studies_and_comparisons_take_the_solvers_numbers() -> None:
    data = sample("vaz-2106")
    engine, cycle = engine_and_cycle(data)
    raw, scalars = solve_batch([engine]), solved(data).scalars
    values, _ = of_batch(raw, choose(raw, ["st_bolt_n", "st_web_n"]), [cycle])
    assert {key: each[0] for key, each in values.items()} == {
        key: scalars[key] for key in ("st_bolt_n", "st_web_n")
    }
    rows = results([Compared("one", Path("one.toml"), data, solved(data))] * 2)
    strength = {row.key: row.values for row in rows if row.group == "Прочность деталей"}
    assert strength["st_pin_bend_MPa"] == (scalars["st_pin_bend_MPa"],) * 2
    assert set(SAFETIES) <= strength.keys()


def test_new_engines_hold_their_usual_ranges() -> None:
    """The middle of every usual span put 18 of 40 new engines outside, whatever their load."""
    outside = 0
    for seed in range(30):
        draw = random.Random(seed)
        layout, strokes, kind = KINDS[seed % len(KINDS)]
        given = {"bore_mm": round(draw.uniform(60, 150), 1)} if draw.random() < 0.6 else {}
        engine = generate_engine(draw.choice(CYLINDERS[layout]), layout=layout, strokes=strokes,
                                 kind=kind, strength=True, **given)  # fmt: skip
        data = load_text(file_text(engine), source="new").model
        s = solved(data).scalars
        above = [each for each in usual_stresses(data.strength) if each.side(s[each.key]) > 0]
        weak = [key for key in SAFETIES if s[key] < data.strength.safety_allowed]
        outside += bool(above or weak)
    assert outside <= 1


def test_sizes_that_follow_the_load_say_so() -> None:
    """A boosted engine has a thicker pin and crown than the middle, still within the span."""
    plain = generate_engine(4, kind="petrol", strength=True, bore_mm=80.0)
    boosted = generate_engine(4, kind="petrol", strength=True, bore_mm=80.0, power_kw=110.0,
                              speed_rpm=5000.0)  # fmt: skip
    for key in ("crown_mm", "pin_mm"):
        assert boosted.data["strength"][key] > plain.data["strength"][key]
    assert "; по нагрузке)" in boosted.notes["strength.crown_mm"]
    assert 0.05 * 80 <= boosted.data["strength"]["crown_mm"] <= 0.10 * 80
