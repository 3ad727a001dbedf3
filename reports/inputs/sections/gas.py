"""The sections [cycle] and [gas], the latter by its source: polytropes, points, cycle, figure 22.

Speed, cylinders, compression ratio, ambient pressure and mechanical efficiency stand
in their own sections.  Groups of keys that only belong together with a turbocharger,
an own fuel or a wanted power are optional; `reports.inputs.checks.cross_checks` tells which.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Strict

from kshm.cycle.inputs import LIMITS, CycleInputs
from reports.inputs.meta import USUAL, Meta, StrictModel, choice, named, number, title_of
from reports.inputs.units import (
    DEG,
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
    InputUnit,
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
SOURCES = {
    "polytropic": "по политропам",
    "table": "по точкам диаграммы",
    "cycle": "по расчёту цикла",
    "rounded": "скруглённая действительная диаграмма",
}
# Angles of the cycle: combustion's dead centre of four strokes, bottom dead centres.
FIRING_TDC_DEG, BDC_DEG, TWO_STROKE_BDC_DEG = 360.0, 540.0, 180.0
INTERPOLATIONS = {"linear": "прямыми", "monotone": "гладко, без выбросов"}
PEAK_SHARE = {"petrol": 0.85, "diesel": 1.0}
PEAK_DEG = {"petrol": 12.0, "diesel": 10.0}
JOIN_DEG = {"petrol": 40.0, "diesel": 45.0}
_SOURCE = Meta("Индикаторная диаграмма", choices=SOURCES, structural=True)
_ROUNDED = Meta("Индикаторная диаграмма", choices={"rounded": SOURCES["rounded"]}, structural=True)
# The same in every diagram that has them, whatever the point z is called there.
_P_Z = ("p_z", MPA, 0.2, 60)
_RHO = (*named("cyc_rho"), NONE, 1, 6)


def _limited(title: str, symbol: str, unit: InputUnit, field: str, default: object = ...) -> Any:  # noqa: ANN401
    """Return a number whose limits are those of the solver's input ``field``."""
    low, high = (round(unit.from_si(limit), 9) for limit in LIMITS[field])
    return number(title, symbol, unit, low, high, default, solver=field)


class CycleSection(StrictModel, usual=(CycleInputs,)):
    """[cycle]: the engine of appendix 2 of Gots, its regime and the wanted power."""

    kind: Literal["diesel", "petrol"] = choice("Вид двигателя", KINDS, structural=True)
    power_kw: float | None = _limited("Заданная эффективная мощность", "N_e зад", KW, "power", None)
    stroke_bore: float | None = _limited(
        "Отношение хода поршня к диаметру цилиндра", "S/D", NONE, "stroke_bore", None
    )
    size_step_mm: float | None = _limited("Шаг ряда размеров D и S", "Δ_D", MM, "step", None)
    rounding: Literal["nearest", "up"] | None = choice(
        "Округление размеров до ряда", ROUNDINGS, None
    )
    fuel: Literal["diesel", "petrol", "ethanol", "methane", "own"] = choice(
        "Топливо", FUEL_NAMES, structural=True
    )
    fuel_carbon: float | None = number(*named("cyc_C"), NONE, 0, 1, None, solver="fuel.carbon")
    fuel_hydrogen: float | None = number(*named("cyc_H"), NONE, 0, 1, None, solver="fuel.hydrogen")
    fuel_oxygen: float | None = number(*named("cyc_O"), NONE, 0, 1, None, solver="fuel.oxygen")
    fuel_heating_value_mj_kg: float | None = number(
        *named("cyc_Hu"), MJ_KG, 5, 130, None, solver="fuel.heating_value"
    )
    fuel_molar_mass_kg_kmol: float | None = number(
        "Молярная масса паров топлива", "m_т", KG_KMOL, 2, 1000, None,
        solver="fuel.vapour_molar_mass",
    )  # fmt: skip
    excess_air: float = number("Коэффициент избытка воздуха", "α", NONE, 0.6, 8)
    ambient_temperature_k: float = _limited(
        "Температура окружающей среды", "T_0", KELVIN, "t_ambient", USUAL
    )
    charge_heating_k: float = _limited("Подогрев свежего заряда", "ΔT", KELVIN, "charge_heating")
    residual_temperature_k: float = _limited(
        "Температура остаточных газов", "T_r", KELVIN, "t_residual"
    )
    intake_factor: float = _limited(
        "Коэффициент сопротивления впуска pa/pк", "C_a", NONE, "intake_factor"
    )
    exhaust_factor: float = _limited(
        "Коэффициент сопротивления выпуска pr/pк", "C_r", NONE, "exhaust_factor"
    )
    recharge: float = _limited("Коэффициент дозарядки", "φ_доз", NONE, "recharge", USUAL)
    scavenging: float = _limited("Коэффициент очистки", "φ_оч", NONE, "scavenging", USUAL)
    max_pressure_mpa: float | None = _limited(*named("cyc_p_z"), MPA, "p_max", None)
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
    adaptability: float | None = number(*named("spd_K"), NONE, 1.001, 2, None)
    torque_speed_rpm: float | None = number(
        *named("reg_n_M"), RPM, 10, 60000, None, solver="omega_torque"
    )
    idle_speed_rpm: float | None = number(
        *named("reg_n_idle"), RPM, 10, 60000, None, solver="omega_idle"
    )
    governor_irregularity: float | None = number(
        *named("gov_delta"), NONE, 0.005, 0.5, None, solver="governor.irregularity"
    )
    idle_fuel_share: float | None = number(
        *named("gov_idle"), NONE, 0.05, 0.9, None, solver="governor.idle_fuel"
    )


class _Ambient(StrictModel):
    """Keys of every source."""

    source: Annotated[str, _SOURCE]
    ambient_pressure_mpa: float = number(
        "Давление окружающей среды", "p_0", MPA, 0.01, 0.5, 0.1, solver="p_ambient"
    )


class _Pressures(_Ambient):
    """Pressures and exponents of the polytropes."""

    intake_pressure_mpa: float = number("Давление впуска", "p_a", MPA, 0.01, 3, solver="p_intake")
    residual_pressure_mpa: float = number(*named("cyc_p_r"), MPA, 0.01, 3, solver="p_residual")
    max_pressure_mpa: float = number(title_of("cyc_p_z"), *_P_Z, solver="p_max")
    compression_exponent: float = number(*named("cyc_n1"), NONE, 1, 1.7, solver="n_compression")
    expansion_exponent: float = number(*named("cyc_n2"), NONE, 1, 1.7, solver="n_expansion")
    preexpansion_ratio: float = number(*_RHO, solver="rho")


class _Ignition(_Ambient):
    """Timing of ignition."""

    injection_advance_deg: float = number(
        "Угол опережения впрыска (зажигания)", "θ_оп", DEG, 0.5, 90, solver="ignition_advance"
    )
    ignition_delay_deg: float = number("Период задержки воспламенения", "Δφ_з", DEG, 0, 90)


class _DinnAngles(_Ignition):
    """The angles of Dinn's diagram."""

    combustion_start_deg: float | None = number("Угол начала сгорания", "φ_c", DEG, 270, 360, None)
    exhaust_start_before_bdc_deg: float = number("Начало выпуска до НМТ", "φ_в1", DEG, 0, 150)
    exhaust_end_after_bdc_deg: float = number("Конец выпуска после НМТ", "φ_в2", DEG, 0, 180)


class PolytropicGasSection(_DinnAngles, _Pressures):
    """[gas], source = "polytropic": indicator diagram by polytropes, as Dinn built it."""

    source: Annotated[Literal["polytropic"], _SOURCE]
    scavenge_start_before_bdc_deg: float | None = number(
        "Начало продувки до НМТ (двухтактный двигатель)", "φ_пр", DEG, 0, 150, None
    )


class TableGasSection(_Ambient):
    """[gas], source = "table": points (φ, absolute pressure)."""

    source: Annotated[Literal["table"], _SOURCE]
    interpolation: Literal["linear", "monotone"] = choice(
        "Соединение точек", INTERPOLATIONS, "linear", structural=True
    )
    points: Annotated[
        tuple[
            Annotated[
                tuple[
                    Annotated[float, Meta("Точка {n}: угол", "φ_{n}", DEG, 0, 720)],
                    Annotated[float, Meta("Точка {n}: давление", "p_{n}", MPA, 0.001, 60)],
                ],
                Strict(False),
            ],
            ...,
        ],
        Strict(False),
    ]


class CycleGasSection(_DinnAngles):
    """[gas], source = "cycle": pressures from the [cycle] section, the angles of Dinn."""

    source: Annotated[Literal["cycle"], _SOURCE]
    ambient_pressure_mpa: float = number(
        "Давление окружающей среды", "p_0", MPA, 0.03, 0.2, 0.1, solver="p_ambient"
    )
    exhaust_end_after_bdc_deg: float = number(
        "Конец свободного выпуска после НМТ", "φ_в2", DEG, 0, 180
    )


class _Kind(StrictModel):
    """Kind of engine, ahead of its pressures."""

    source: Annotated[str, _ROUNDED]
    kind: Literal["petrol", "diesel"] = choice("Вид двигателя", KINDS, structural=True)


class RoundedGasSection(_Ignition, _Pressures, _Kind):
    """[gas], source = "rounded": c', c'', z_д, b', b'' and r of figure 22 joined smoothly."""

    source: Annotated[Literal["rounded"], _ROUNDED]
    max_pressure_mpa: float = number(
        "Расчётное давление конца сгорания в точке z", *_P_Z, solver="p_max"
    )
    preexpansion_ratio: float = number(*_RHO, 1.0, solver="rho")
    tdc_rise: float = number(
        "Давление в точке c'' к давлению конца сжатия", "p_c''/p_c", NONE, 1, 2, 1.2
    )
    peak_share: float | None = number(
        "Действительное давление z_д к расчётному", "p_zд/p_z", NONE, 0.5, 1, None
    )
    peak_after_tdc_deg: float | None = number("Точка z_д после ВМТ", "φ_zд", DEG, 2, 45, None)
    expansion_after_tdc_deg: float | None = number(
        "Выход на линию расширения после ВМТ", "φ_j", DEG, 4, 90, None
    )
    exhaust_start_before_bdc_deg: float = number(
        "Начало выпуска до НМТ, точка b'", "φ_в1", DEG, 5, 120
    )
    exhaust_end_after_bdc_deg: float = number(
        "Конец свободного выпуска после НМТ", "φ_в2", DEG, 5, 150
    )
    intake_settle_deg: float = number(
        "Угол после ВМТ, при котором устанавливается p_a", "φ_a'", DEG, 2, 90, 30.0, solver="settle"
    )


GasSection = PolytropicGasSection | TableGasSection | CycleGasSection | RoundedGasSection
