"""User units become SI; derived dimensions are right."""

from __future__ import annotations

import math
from dataclasses import dataclass

import pytest

from kshm.engine.crankshaft import Web
from kshm.engine.gas import PolytropicGas, TabulatedGas
from kshm.engine.masses import DirectMasses, RodMasses
from reports.inputs import units
from reports.inputs.firing import fitting_angle
from reports.inputs.load import load_mapping, load_toml
from reports.inputs.meta import USUAL, StrictModel, choice, number, solver_values
from reports.inputs.to_si.engine import to_engine
from reports.shared.resources import samples_dir


def engine_of(raw):
    return to_engine(load_mapping(raw, source="f").model)


def sample(name):
    return to_engine(load_toml(samples_dir() / f"{name}.toml").model)


def test_the_diesel_in_si(raw):
    engine = engine_of(raw)
    assert engine.geometry.bore == 0.088
    assert engine.geometry.crank_radius == 0.047
    assert engine.geometry.rod_length == 0.148
    assert engine.omega == pytest.approx(4400 * math.pi / 30, rel=1e-15)
    assert engine.firing_offsets == tuple(math.radians(x) for x in (0, 240, 480))
    assert engine.indicated_power == 89300
    assert (engine.mechanical_efficiency, engine.fullness) == (0.79, 0.91)
    assert engine.masses == DirectMasses(2.0, 1.269)
    assert (engine.step_deg, engine.rays, engine.method) == (10, 12, "textbook")
    assert engine.force_offsets is None
    assert engine.gas == PolytropicGas(
        p_ambient=0.1e6,
        p_intake=0.165e6,
        p_residual=0.182e6,
        p_max=10.5e6,
        n_compression=1.368,
        n_expansion=1.288,
        rho=1.366,
        combustion_start=math.radians(357),
        ignition_advance=math.radians(15),
        exhaust_open=math.radians(498),
        exhaust_close=math.radians(565),
    )


def test_the_shaft_in_si(raw):
    raw["crankshaft"]["webs"][2] |= {"angle_deg": 5, "counterweight_angle_deg": 7, "mass_kg": 0.3}
    raw["crankshaft"]["rear_angle_deg"] = 200
    raw["crankshaft"]["arms"][1] |= {
        "l1_mm": 11,
        "l6_mm": 16,
        "left_web_mm": 20,
        "right_web_mm": 21,
    }
    shaft = engine_of(raw).crankshaft
    second = shaft.throws[1]
    assert second.left_web == Web(0.3, math.radians(5), 0.9, math.radians(7))
    assert second.right_web == Web(0.245, 0, 0.9, 0)
    assert second.arms == (0.011, 0.032, 0, 0, 0.032, 0.016)
    assert (second.left_web_thickness, second.right_web_thickness) == (0.02, 0.021)
    assert second.angle == math.radians(120)
    assert (shaft.nose.mass, shaft.nose.angle, shaft.nose.arm) == (0.426, math.radians(210), 0.13)
    assert (shaft.rear.mass, shaft.rear.angle, shaft.rear.arm) == (0.426, math.radians(200), 0.08)
    assert (shaft.pin_diameters, shaft.pin_lengths) == ((0.056,) * 3, (0.028,) * 3)
    assert shaft.main_diameters == (0.064,) * 4
    assert shaft.main_lengths == (0.032,) * 4
    assert [throw.pin_mass for throw in shaft.throws] == [0.425] * 3


@pytest.mark.parametrize(
    "given",
    [
        {"crank_radius_mm": 47, "lambda": 47 / 148},
        {"stroke_mm": 94, "rod_length_mm": 148},
        {"stroke_mm": 94, "lambda": 47 / 148},
        {"rod_length_mm": 148, "lambda": 47 / 148},
        {"crank_radius_mm": 47, "rod_length_mm": 148, "lambda": 0.3176},
    ],
)
def test_any_two_fix_the_mechanism(raw, given):
    raw["geometry"] = {"bore_mm": 88, "compression_ratio": 18} | given
    geometry = engine_of(raw).geometry
    assert geometry.crank_radius == pytest.approx(0.047, rel=1e-14)
    assert geometry.rod_length == pytest.approx(0.148, rel=1e-14)


def test_combustion_start_from_advance_and_delay(raw):
    del raw["gas"]["combustion_start_deg"]
    assert engine_of(raw).gas.combustion_start == math.radians(358)


@pytest.mark.parametrize("centre", [{"rod_centre_mm": 111}, {"rod_small_end_share": 0.25}])
def test_rod_masses(raw, centre):
    raw["masses"] = {"piston_group_kg": 1.52, "rod_kg": 1.752} | centre
    masses = engine_of(raw).masses
    assert isinstance(masses, RodMasses)
    assert (masses.piston_group, masses.rod) == (1.52, 1.752)
    assert masses.centre == pytest.approx(0.111, rel=1e-14)  # 0.75 of 148 mm from the pin


def test_table(raw):
    raw["gas"] = {"source": "table", "points": [[0, 0.1], [360, 8], [720, 0.1]]}
    assert engine_of(raw).gas == TabulatedGas(
        0.1e6, (0.0, math.radians(360), math.radians(720)), (0.1e6, 8e6, 0.1e6)
    )


def test_p3_has_the_rounded_lambda_and_speed():
    engine = sample("gots-p3")
    assert engine.omega == pytest.approx(460.53, rel=1e-15)
    assert engine.geometry.lam == pytest.approx(0.317, rel=1e-15)


def test_p43_has_the_constants_of_the_table():
    engine = sample("gots-p43")
    geometry, throw, masses = engine.geometry, engine.crankshaft.throws[1], engine.masses
    unit = geometry.crank_radius * engine.omega**2 / geometry.piston_area / 1e6
    assert masses.reciprocating * unit == pytest.approx(1.9236, abs=5e-5)
    webs = (throw.left_web, throw.right_web)
    surplus = sum(web.counterweight_mass - web.mass for web in webs)
    half = (surplus - masses.rod_big_end - throw.pin_mass) * unit / 2
    # Throws 2 and 3 stand at 120 and 240: their halves add up to minus one half along y.
    angles = [engine.crankshaft.throws[i].angle for i in (1, 2)]
    assert sum(half * math.cos(angle) for angle in angles) == pytest.approx(-0.7068, abs=5e-5)
    assert sum(half * math.sin(angle) for angle in angles) == pytest.approx(0, abs=1e-12)
    assert [math.degrees(x) for x in engine.force_offsets] == pytest.approx([0, 480, 240])
    assert engine.step_deg == 3


def test_appendix_1_is_as_printed():
    engine = sample("gots-appendix1")
    assert engine.gas.rho == 1.69
    assert engine.gas.combustion_start == math.radians(358)
    assert engine.gas.exhaust_open == math.radians(490)
    assert engine.gas.exhaust_close == math.radians(560)
    assert [throw.arms[1] for throw in engine.crankshaft.throws] == [0.032] * 3


def test_d240():
    engine = sample("d-240")
    volume = engine.cylinders * engine.geometry.piston_area * 2 * engine.geometry.crank_radius
    assert volume == pytest.approx(4.75e-3, abs=5e-6)
    for offset, throw in zip(engine.firing_offsets, engine.crankshaft.throws, strict=True):
        assert math.cos(offset + throw.angle) == pytest.approx(1)


@pytest.mark.parametrize("unit", [units.MM, units.KG, units.DEG, units.MPA, units.RPM, units.KW])
def test_units_there_and_back(unit):
    assert unit.from_si(unit.to_si(12.5)) == pytest.approx(12.5, rel=1e-15)


def test_unit_text():
    assert units.DEG.text(15) == "15°"
    assert units.MM.text(-0.5) == "−0,5 мм"
    assert units.NONE.text(0.317) == "0,317"
    assert units.NONE.text(1e12) == "1000000000000"
    assert units.NONE.text(1e-7) == "0,0000001"
    assert units.NM_RAD.limit(1e12) == "10¹² Н·м/рад"
    assert units.RPM.limit(30_000) == "30000 мин⁻¹"
    assert units.KG.limit(1.5e6) == "1500000 кг"


@pytest.mark.parametrize(
    ("value", "inside"),
    [(0.15, True), (0.45, True), (0.15 - 1e-10, True), (0.45 + 1e-10, True),
     (0.15 - 1e-8, False), (0.45 + 1e-8, False)],
)  # fmt: skip
def test_a_span_holds_its_ends_whatever_a_quotient_adds_to_them(value, inside):
    assert units.is_within(value, (0.15, 0.45)) == inside


@pytest.mark.parametrize(
    ("angle_deg", "shown"),
    [(-30, "330"), (-1e-9, "0"), (719.9999999, "0"), (450.1, "90,1"), (359.1234567, "359,123457")],
)
def test_an_angle_of_a_message_lies_in_one_turn(angle_deg, shown):
    assert fitting_angle(angle_deg) == shown


@dataclass(frozen=True)
class Spring:
    length: float
    stiffness: float
    turns: tuple[float, ...] = ()
    kind: str = "coil"
    gap: float = 0.002


class SpringSection(StrictModel, usual=(Spring,)):
    length_mm: float = number("Длина", "l", units.MM, 1, 100)
    rate_nm_rad: float = number("Жёсткость", "c", units.NM_RAD, 0, 9, solver="stiffness")
    turns_deg: tuple[float, ...] | None = number("Виток {n}", "n_{n}", units.DEG, 0, 360, None)
    kind: str | None = choice("Вид", {"coil": "витая", "leaf": "листовая"}, None)
    gap_mm: float = number("Зазор", "δ", units.MM, 0, 9, USUAL)
    friction: float = number("Трение", "f", units.NONE, 0, 1, 0.5, solver="law.friction")


def test_a_key_becomes_si_by_its_description_alone():
    section = SpringSection(length_mm=47.0, rate_nm_rad=3.0, turns_deg=(90.0, 180.0), kind="leaf")
    assert solver_values(section, Spring) == {
        "length": 0.047,
        "stiffness": 3.0,
        "turns": (math.pi / 2, math.pi),
        "kind": "leaf",
        "gap": 0.002,
    }


def test_a_key_left_out_takes_the_default_of_the_solver():
    section = SpringSection(length_mm=47.0, rate_nm_rad=3.0)
    assert Spring(**solver_values(section, Spring)) == Spring(0.047, 3.0)
    assert SpringSection.model_fields["gap_mm"].default == 2.0
    assert "friction" not in solver_values(section, Spring)
