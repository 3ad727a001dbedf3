"""Counterweights of the webs: sector, scan of the share, loads, both statements."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest

from kshm.engine.engine import Engine
from kshm.mechanics.counterweight import Crank, SectorRing
from kshm.mechanics.masses import point_masses
from kshm.results.case import Case
from kshm.results.counterweight import with_counterweights
from kshm.results.solution import Solution, solve
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import to_engine
from reports.model.blocks import Model
from reports.model.evaluation import evaluate_model
from reports.new.generate import generate_engine
from reports.shared.errors import InputError
from reports.tables.registry import build_model
from reports.workbook.write import workbook_bytes
from tests.conftest import sample
from tests.referee.compare import differences_from_caches, errors_in
from tools.referees.by_formualizer import Formualizer

# V6, V8, in line 3 and 5, one cylinder, two strokes, articulated rods, an offset cylinder.
SAMPLES = ("yamz-236", "yamz-238", "gots-diesel", "two-stroke", "vw-1600")
NEW = {"V8": (8, "v", 4), "three": (3, "inline", 4), "five": (5, "inline", 4),
       "one": (1, "inline", 4), "opposed": (4, "opposed", 4)}  # fmt: skip
RING = SectorRing(0.03585, 0.087, 0.01909, 7860.0)  # of a car's V engine, bore 82, stroke 93 mm
RELATIVE = 1e-8


@lru_cache(maxsize=16)
def model_of(name: str, **section: object) -> Model:
    if name in NEW:
        cylinders, layout, strokes = NEW[name]
        raw = generate_engine(cylinders, layout=layout, strokes=strokes, kind="petrol").data
    else:
        raw = to_mapping(sample(name))
    return build_model(load_mapping({**raw, "counterweight": section}, source="").model)


def solved(name: str, **section: object) -> Solution:
    return solve(to_engine(model_of(name, **section).input))


def test_angle_of_a_known_sector():
    """3.285 kg at 15.984 mm and two rods of 200 kg/m², two thirds of each at the crankpin."""
    area, radius = np.pi * 0.082**2 / 4, 0.0465
    throw = 3.285 * 0.015984 + 2 * (2 / 3) * 200 * area * radius
    sector = RING.sector(throw / 2)  # two webs
    assert np.degrees(sector.angle) == pytest.approx(148.7349, abs=5e-5)


@pytest.mark.parametrize("share", [0.1, 0.6, 1.0])
def test_sector_by_summing_its_parts(share: float):
    moment = share * RING.half_moment
    sector = RING.sector(moment)
    r = np.linspace(RING.inner, RING.outer, 2001)
    turn = np.linspace(-sector.angle / 2, sector.angle / 2, 2001)
    per_angle = RING.density * RING.width
    mass = per_angle * np.trapezoid(r, r) * sector.angle
    first = per_angle * np.trapezoid(r**2, r) * np.trapezoid(np.cos(turn), turn)
    assert sector.mass == pytest.approx(mass, rel=1e-6)
    assert (first, sector.mass * sector.centre) == pytest.approx((moment, moment), rel=1e-6)


def test_half_a_ring_is_all_that_there_is():
    sector = RING.sector(1.3 * RING.half_moment)
    assert (sector.fullness, sector.angle) == pytest.approx((1.3, np.pi))
    wider = RING._replace(width=RING.width_for(1.3 * RING.half_moment))
    assert wider.half_moment == pytest.approx(1.3 * RING.half_moment)


def test_partial_balance_is_the_worst_at_an_end():
    """The greatest residue of one crank is the larger of what is left along and put across."""
    crank = Crank(40.0, 60.0, 0.16, 2 * np.pi)
    angles = np.linspace(0, 2 * np.pi, 361)
    for share in (0.3, 0.5, 2 / 3):
        most = max(crank.residue(share, angle) for angle in angles)
        unit = 60.0 * 0.16 * (2 * np.pi) ** 2
        assert most == pytest.approx(max(share, 1 - share) * unit)
        assert crank.balance_mass(share, 0.35) * 0.35 == pytest.approx((40 + share * 60) * 0.16)


def test_scan_of_one_cylinder_is_partial_balance():
    actual = solved("one", goal="residue")
    engine = actual.engine
    m_j, _ = point_masses(engine.masses, engine.geometry.rod_length)
    m_r = actual.scalar("m_r")
    crank = Crank(m_r, m_j, engine.geometry.crank_radius, engine.omega)
    angles = np.linspace(0, 2 * np.pi, 721)
    scan = actual.columns["counterweight_scan"]
    for k, left in zip(scan["cw_k"][::4], scan["cw_F_kN"][::4], strict=True):
        share = (k - 1) * m_r / m_j
        most = max(crank.residue(share, angle) for angle in angles)
        assert 1000 * left == pytest.approx(most, rel=1e-5)
    # Half of the reciprocating mass leaves the least.
    assert abs(actual.scalar("cw_best") - 1 - m_j / m_r / 2) <= 0.025 + 1e-9


@pytest.mark.parametrize("goal", ["loads", "residue"])
@pytest.mark.parametrize("name", [*SAMPLES, *NEW])
def test_both_statements_agree(name: str, goal: str):
    model = model_of(name, goal=goal)
    values, actual = evaluate_model(model), solve(to_engine(model.input))
    numbers = {key: each for key, each in actual.scalars.items() if key.startswith("cw_")}
    assert len(numbers) > 20
    for key, each in numbers.items():
        assert values.scalars[key] == pytest.approx(each, rel=RELATIVE, abs=1e-9), key
    for table in ("counterweight_scan", "counterweight_turn"):
        for key, column in actual.columns[table].items():
            scale = np.abs(column).max() + 1e-3
            assert np.abs(values.columns[table][key] - column).max() < 1e-7 * scale, key


@pytest.mark.parametrize("share", [0.0, 0.65, 1.3])
def test_scan_is_the_engine_with_these_counterweights(share: float):
    """The chain of forces itself, run for an engine with the counterweights of a row."""
    actual = solved("yamz-236")
    engine = with_counterweights(actual.engine, share)
    again = solve(engine)
    area = engine.geometry.piston_area
    loads = again.raw.journal_load[0][:, :-1] * area / 1000
    row = round(share / 0.05)
    scan = actual.columns["counterweight_scan"]
    assert scan["cw_k"][row] == pytest.approx(share)
    assert scan["cw_sum_kN"][row] == pytest.approx(np.sqrt((loads**2).mean(axis=1)).sum())


def test_chosen_share_is_the_least_of_the_scan_or_all_there_is_room_for():
    for name in (*SAMPLES, *NEW):
        actual = solved(name)
        scan = actual.columns["counterweight_scan"]
        assert actual.scalar("cw_best") == scan["cw_k"][np.argmin(scan["cw_sum_kN"])]
        room = actual.scalar("cw_limit")
        taken = actual.scalar("cw_taken")
        assert taken <= room and taken in (actual.scalar("cw_best"), np.floor(100 * room) / 100)
        assert actual.scalar("cw_new_sum_kN") < actual.scalar("cw_bare_sum_kN")


def test_new_engine_has_the_counterweights_that_are_proposed():
    raw = generate_engine(6, layout="v", kind="petrol").data
    model = load_mapping(raw, source="").model
    actual: Engine = to_engine(model)
    numbers = solve(actual).scalars
    weights = {web.counterweight_mass for t in actual.crankshaft.throws
               for web in (t.left_web, t.right_web)}  # fmt: skip
    assert list(weights) == [pytest.approx(numbers["cw_reduced"], rel=5e-4)]
    assert numbers["cw_now_sum_kN"] == pytest.approx(numbers["cw_new_sum_kN"], rel=1e-3)


def test_a_given_share_that_the_section_cannot_hold_fails_its_check():
    for share, fits in ((0.3, "да"), (1.9, "НЕТ")):
        values = evaluate_model(model_of("yamz-236", share=share))
        assert values.scalars["check_cw_fits"] == fits


def test_workbook_is_live():
    model = model_of("yamz-236", goal="residue", outer_mm=130.0)
    book = workbook_bytes(model, evaluate_model(model))
    (again,) = Formualizer().recalculate([book])
    assert errors_in(again) == [] and differences_from_caches(book, again) == []


def test_case_without_the_section_has_none():
    actual = solve(to_engine(sample("gots-diesel")))
    assert isinstance(actual._case, Case)
    assert not [key for key in actual.scalars if key.startswith("cw_")]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"outer_mm": 10.0}, "counterweight.outer_mm: наружный радиус противовеса 10 мм"),
        ({"skirt_mm": 400.0}, "counterweight.skirt_mm: радиус, свободный под поршнем,"),
    ],
)
def test_a_sector_without_room_is_refused_at_the_door(changes, said) -> None:
    raw = to_mapping(sample("gots-diesel")) | {"counterweight": changes}
    with pytest.raises(InputError) as caught:
        load_mapping(raw, source="")
    assert any(said in line for line in caught.value.lines())
