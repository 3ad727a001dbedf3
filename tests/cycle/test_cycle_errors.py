"""Bad input gets one Russian line: which input, which way to change it."""

import ast
import math
import re
from dataclasses import replace
from pathlib import Path

import pytest

import kshm
from kshm.cycle.cycle import cycle
from kshm.cycle.dizdn_listing import Listing
from kshm.cycle.fuel import FUELS
from kshm.cycle.inputs import FrictionLaw
from kshm.errors import CycleError
from reports.inputs.to_si.cycle import TEXTS, text_of
from reports.shared.russian import short
from tests.cycle.refusals import refused

NAN = float("nan")
REMARKS = ("CycleError", "Remark")

DIESEL = [
    ({"p_max": 7e6}, "p_max", "p_z = 7 МПа не выше давления конца сжатия .*; увеличьте p_z"),
    ({"p_max": 20e6}, "p_max", r"p_z = 20 МПа слишком велико \(ρ < 1\); уменьшите p_z"),
    ({"p_max": None}, "p_max", "задайте максимальное давление"),
    ({"p_max": 50e6}, "p_max", "уменьшите p_z"),
    (
        {"p_max": 3.4e6, "excess_air": 1.0, "xi_z": 1.0, "compression_ratio": 10.0},
        "p_max",
        "ρ = 3,.*увеличьте p_z или α",
    ),
    ({"excess_air": 0.9}, "excess_air", "α = 0,9: допускается от 1 до 8; увеличьте α .*дымит"),
    ({"excess_air": 9.0}, "excess_air", "уменьшите α"),
    ({"excess_air": NAN}, "excess_air", "задайте число"),
    ({"compression_ratio": 8.0}, "compression_ratio", "увеличьте ε"),
    ({"compression_ratio": 30.0}, "compression_ratio", "уменьшите ε"),
    ({"xi_b": 0.35}, "xi_b", "n_2: .* увеличьте ξ_b"),
    ({"xi_z": 0.45, "xi_b": 1.0, "excess_air": 1.2, "p_max": 9e6}, "xi_b", "уменьшите ξ_b"),
    ({"xi_z": 1.2}, "xi_z", "уменьшите ξ_z"),
    ({"omega": 0.0}, "omega", "увеличьте n"),
    ({"cylinders": 2.5}, "cylinders", "целое"),
    ({"strokes": 2}, "strokes", "τ = 2"),
    ({"offset": 0.01}, "offset", "дезаксаж"),
    ({"bore": None}, "bore", "задайте диаметр и ход"),
    ({"stroke": 0.0}, "stroke", "увеличьте S"),
    ({"mechanical": 0.1}, "mechanical", "увеличьте η_м"),
    (
        {"mechanical": FrictionLaw(0.39e6, 0.04e6), "stroke": 0.3},
        "mechanical",
        "двигатель не даёт мощности",
    ),
    ({"mechanical": FrictionLaw(0.9e6, 0.01e6)}, "mechanical.a", "уменьшите A"),
    ({"intake_factor": 0.2}, "intake_factor", "увеличьте C_a"),
    ({"t_residual": 100.0}, "t_residual", "увеличьте T_r"),
    ({"kind": "gas"}, "kind", "diesel или petrol"),
    ({"fuel": replace(FUELS["diesel"], carbon=0.5)}, "fuel", r"C \+ H \+ O = 0,63"),
    ({"fuel": replace(FUELS["diesel"], heating_value=42.5)}, "fuel", "проверьте единицы"),
    ({"fuel": replace(FUELS["diesel"], carbon=-0.1)}, "fuel", "от 0 до 1"),
    (
        {"fuel": replace(FUELS["diesel"], carbon=0.1, hydrogen=0.01, oxygen=0.89)},
        "fuel",
        "кислорода хватает",
    ),
]
PETROL = [
    ({"p_max": 6e6}, "p_max", "получается из расчёта"),
    ({"compression_ratio": 20.0}, "compression_ratio", "уменьшите ε .*детонирует"),
    ({"excess_air": 0.3}, "excess_air", "увеличьте α"),
    ({"h2_co": 2.0}, "h2_co", "уменьшите K_H2"),
    ({"fuel": replace(FUELS["petrol"], vapour_molar_mass=0.0)}, "fuel", "m_т"),
    ({"fuel": replace(FUELS["petrol"], heating_value=100e6)}, "xi_z", "неправдоподобно"),
    ({"xi_z": 0.01, "xi_b": 0.3}, "xi_b", "n_2"),
    ({"xi_z": 0.0, "xi_b": 0.3}, "xi_b", "n_2"),
]
BOOST = [
    ({"pressure_ratio": 9.0}, "boost.pressure_ratio", "уменьшите π_к"),
    ({"cooler_temperature_drop": 200.0}, "boost.cooler_temperature_drop", "уменьшите ΔT_х"),
    (
        {"pressure_ratio": 1.0, "cooler_pressure_loss": 0.06e6},
        "boost.cooler_pressure_loss",
        "p_к = 0,04 МПа; уменьшите Δp_х",
    ),
    ({"cooler_pressure_loss": NAN}, "boost.cooler_pressure_loss", "задайте число"),
    ({"turbine_efficiency": 0.0}, "boost.turbine_efficiency", "увеличьте η_т"),
]


def check(inputs, field, text):
    with pytest.raises(CycleError) as caught:
        cycle(inputs)
    message = text_of(caught.value.remark)
    assert caught.value.remark.field == field, message
    assert re.search(text, message), message
    assert "\n" not in message
    assert isinstance(caught.value, ValueError)


@pytest.mark.parametrize(("changes", "field", "text"), DIESEL)
def test_diesel(diesel, changes, field, text):
    check(replace(diesel, **changes), field, text)


@pytest.mark.parametrize(("changes", "field", "text"), PETROL)
def test_petrol(gasoline, changes, field, text):
    check(replace(gasoline, **changes), field, text)


@pytest.mark.parametrize(("changes", "field", "text"), BOOST)
def test_boost(diesel, changes, field, text):
    check(replace(diesel, boost=replace(diesel.boost, **changes)), field, text)


def test_the_named_highest_pressure_is_right(diesel):
    with pytest.raises(CycleError) as caught:
        cycle(replace(diesel, p_max=20e6))
    named = float(
        re.search(r"возможное ([\d,]+)", text_of(caught.value.remark))[1].replace(",", ".")
    )
    assert cycle(replace(diesel, p_max=(named - 0.01) * 1e6)).combustion.rho > 1
    with pytest.raises(CycleError):
        cycle(replace(diesel, p_max=(named + 0.01) * 1e6))


def test_listing_mode_is_for_the_turbo_diesel_only(engines):
    for name in ("petrol", "natural_diesel"):
        with refused("режим распечатки"):
            cycle(engines[name], Listing())


def test_warnings_do_not_stop_the_calculation(engines):
    off = cycle(replace(engines["petrol"], t_residual=900.0))
    assert "задайте T_r ближе" in text_of(off.warnings[0])
    assert cycle(engines["turbo_diesel"]).warnings == ()
    weak = replace(engines["turbo_diesel"], exhaust_factor=0.75)
    assert any("мощность турбины" in text_of(w) for w in cycle(weak).warnings)
    hot = replace(engines["petrol"], xi_z=1.0, xi_b=1.0, excess_air=1.0)
    assert any("2800" in text_of(w) for w in cycle(hot).warnings)


def test_messages_name_their_numbers_in_user_units(engines):
    diesel, petrol = engines["turbo_diesel"], engines["petrol"]
    cases = {
        "H_u = 4,25 МДж/кг": replace(diesel, fuel=replace(diesel.fuel, heating_value=4.25e6)),
        "p_м = 2,157 МПа не меньше p_i = 1,352 МПа": replace(
            diesel, mechanical=FrictionLaw(0.397e6, 0.04e6), stroke=0.3
        ),
        "n = 30 мин⁻¹: допускается от 50 до 20000; увеличьте n": replace(petrol, omega=math.pi),
    }
    for text, inputs in cases.items():
        with pytest.raises(CycleError) as caught:
            cycle(inputs)
        assert text in text_of(caught.value.remark)
    warning = text_of(cycle(replace(diesel, exhaust_factor=0.75)).warnings[-1])
    turbo = cycle(replace(diesel, exhaust_factor=0.75)).turbo
    for number in (turbo.turbine_power / 1e3, turbo.compressor_power / 1e3, turbo.c2_balance):
        assert f"{number:.4g}".replace(".", ",") in warning


@pytest.mark.parametrize(
    ("value", "text"),
    [(1.5, "1,5"), (20000, "20000"), (123456.0, "123500"), (2e-5, "0,00002"), (8, "8")],
)
def test_numbers_are_written_out(value, text):
    assert short(value, 4) == text


def test_every_remark_has_its_words():
    keys = set()
    for path in (Path(kshm.__file__).parent / "cycle").glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in REMARKS:
                first = node.args[0]
                keys |= {first.value} if isinstance(first, ast.Constant) else set()
    assert keys <= set(TEXTS)
    named = {"bore_too_small", "bore_too_large", "n2_not_found_heat_lost"}
    assert set(TEXTS) - keys == named | {"n2_not_found_heat_added"}
