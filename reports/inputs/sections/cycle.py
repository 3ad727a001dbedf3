"""The [cycle] section of the input file: what the cycle calculation starts from.

Speed, cylinders, compression ratio, ambient pressure and mechanical efficiency stand
in their own sections.  Groups of keys that only belong together with a turbocharger,
an own fuel or a wanted power are optional; `reports.inputs.checks.cycle` tells which.
"""

from __future__ import annotations

from typing import Any, Literal

from kshm.cycle.inputs import LIMITS
from reports.inputs.meta import Strictly, choice, number, title_of
from reports.inputs.units import (
    KELVIN,
    KG_KMOL,
    KJ_KG_K,
    KW,
    MJ_KG,
    MM,
    MPA,
    MPA_S_M,
    NONE,
    RPM,
    Unit,
)

KINDS = {"diesel": "дизель", "petrol": "с искровым зажиганием"}  # whatever its fuel
FUEL_NAMES = {
    "diesel": "дизельное топливо",
    "petrol": "бензин",
    "ethanol": "этанол",
    "methane": "метан",
    "own": "свой состав",
}
ROUNDINGS = {"nearest": "до ближайшего", "up": "вверх"}
PUMPING = {"no": "не вычитать", "yes": "вычитать"}
SPEED_LAWS = {
    "diesel": "дизель с неразделённой камерой",
    "diesel_prechamber": "предкамерный дизель",
    "diesel_swirl": "вихрекамерный дизель",
    "petrol": "бензиновый двигатель",
}
OWN_FUEL = (
    "fuel_carbon",
    "fuel_hydrogen",
    "fuel_oxygen",
    "fuel_heating_value_mj_kg",
)
BOOST = ("compressor_efficiency", "turbine_efficiency")
BOOST_EXTRA = (
    "cooler_loss_mpa",
    "cooler_drop_k",
    "turbine_outlet_ratio",
    "exhaust_heat_kj_kg_k",
)


def _limited(title: str, symbol: str, unit: Unit, field: str, default: object = ...) -> Any:  # noqa: ANN401
    """A number whose limits are those of the solver's input ``field``."""
    low, high = (round(unit.from_si(limit), 9) for limit in LIMITS[field])
    return number(title, symbol, unit, low, high, default)


class CycleSection(Strictly):
    """[cycle]: the engine of appendix 2 of Gots, its regime and the wanted power."""

    kind: Literal["diesel", "petrol"] = choice("Вид двигателя", KINDS, structural=True)
    power_kw: float | None = _limited("Заданная эффективная мощность", "N_e зад", KW, "power", None)
    stroke_bore: float | None = _limited("Отношение S/D", "S/D", NONE, "stroke_bore", None)
    size_step_mm: float | None = _limited("Шаг ряда размеров D и S", "Δ", MM, "step", None)
    rounding: Literal["nearest", "up"] | None = choice(
        "Округление размеров до ряда", ROUNDINGS, None
    )
    fuel: Literal["diesel", "petrol", "ethanol", "methane", "own"] = choice(
        "Топливо", FUEL_NAMES, structural=True
    )
    fuel_carbon: float | None = number(title_of("cyc_C"), "C", NONE, 0, 1, None)
    fuel_hydrogen: float | None = number(title_of("cyc_H"), "H", NONE, 0, 1, None)
    fuel_oxygen: float | None = number(title_of("cyc_O"), "O", NONE, 0, 1, None)
    fuel_heating_value_mj_kg: float | None = number(title_of("cyc_Hu"), "H_u", MJ_KG, 5, 130, None)
    fuel_molar_mass_kg_kmol: float | None = number(
        "Молярная масса паров топлива", "m_т", KG_KMOL, 2, 1000, None
    )
    excess_air: float = number("Коэффициент избытка воздуха", "α", NONE, 0.6, 8)
    ambient_temperature_k: float = _limited(
        "Температура окружающей среды", "T_0", KELVIN, "t_ambient", 298.0
    )
    charge_heating_k: float = _limited("Подогрев свежего заряда", "ΔT", KELVIN, "charge_heating")
    residual_temperature_k: float = _limited(
        "Температура остаточных газов", "T_r", KELVIN, "t_residual"
    )
    intake_factor: float = _limited(
        "Коэффициент сопротивления впуска pa/pк", "C_1", NONE, "intake_factor"
    )
    exhaust_factor: float = _limited(
        "Коэффициент сопротивления выпуска pr/pк", "C_2", NONE, "exhaust_factor"
    )
    recharge: float = _limited("Коэффициент дозарядки", "φ_доз", NONE, "recharge", 1.0)
    scavenging: float = _limited("Коэффициент очистки", "φ_оч", NONE, "scavenging", 1.0)
    max_pressure_mpa: float | None = _limited(title_of("cyc_p_z"), "p_z", MPA, "p_max", None)
    xi_z: float = _limited("Коэффициент использования тепла в точке z", "ξ_z", NONE, "xi_z")
    xi_b: float = _limited("Коэффициент использования тепла в точке b", "ξ_b", NONE, "xi_b")
    fullness: float = _limited("Коэффициент полноты диаграммы", "φ_д", NONE, "fullness")
    h2_co_ratio: float | None = _limited(
        "Отношение H2/CO в продуктах при α < 1", "K_H2", NONE, "h2_co", None
    )
    pumping: Literal["no", "yes"] = choice("Насосные потери pr − pa при расчёте pi", PUMPING, "no")
    friction_a_mpa: float | None = _limited(
        "Механические потери A + B·cm: A", "A", MPA, "mechanical.a", None
    )
    friction_b_mpa_s_m: float | None = _limited(
        "Механические потери A + B·cm: B", "B", MPA_S_M, "mechanical.b", None
    )
    boost_ratio: float | None = _limited(
        "Степень повышения давления в компрессоре", "π_к", NONE, "boost.pressure_ratio", None
    )
    compressor_efficiency: float | None = _limited(
        "КПД компрессора", "η_к", NONE, "boost.compressor_efficiency", None
    )
    turbine_efficiency: float | None = _limited(
        "КПД турбины", "η_т", NONE, "boost.turbine_efficiency", None
    )
    cooler_loss_mpa: float | None = _limited(
        "Потеря давления в охладителе наддува", "Δp_х", MPA, "boost.cooler_pressure_loss", None
    )
    cooler_drop_k: float | None = _limited(
        "Понижение температуры в охладителе", "ΔT_х", KELVIN, "boost.cooler_temperature_drop", None
    )
    turbine_outlet_ratio: float | None = _limited(
        "Давление за турбиной к атмосферному", "π_вых", NONE, "boost.outlet_pressure_ratio", None
    )
    exhaust_heat_kj_kg_k: float | None = _limited(
        "Теплоёмкость отработавших газов", "c_pг", KJ_KG_K, "boost.exhaust_cp", None
    )
    speed_law: Literal["diesel", "diesel_prechamber", "diesel_swirl", "petrol"] | None = choice(
        "Коэффициенты внешней характеристики", SPEED_LAWS, None, structural=True
    )
    adaptability: float | None = number(title_of("spd_K"), "K", NONE, 1.001, 2, None)
    torque_speed_rpm: float | None = number(title_of("reg_n_M"), "n_M", RPM, 10, 30000, None)
    idle_speed_rpm: float | None = number(title_of("reg_n_idle"), "n_х", RPM, 10, 30000, None)
