"""Names, codes and units of the inputs and outputs, as appendix 2 of Gots lists them.

A path such as "boost.pressure_ratio" leads from `CycleInputs` or `Cycle` to the
number in SI; ``scale`` is SI per unit of the listing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ListedNumber:
    """A number of the cycle: path, code of the listing, title, symbol, unit, SI per unit.

    ``decimals`` is the number of printed decimals of the listing.
    """

    key: str
    code: str
    title: str
    symbol: str
    unit: str
    scale: float
    decimals: int


_RPM = math.pi / 30
_CONSUMPTION = 1 / 3.6e9  # kg/J per g/(kW·h)
_HOURLY = 1 / 3600.0

INPUTS: tuple[ListedNumber, ...] = (
    ListedNumber("p_ambient", "PO", "Атмосферное давление", "p_0", "МПа", 1e6, 3),
    ListedNumber("t_ambient", "TO", "Температура окружающей среды", "T_0", "К", 1, 1),
    ListedNumber("omega", "OV", "Частота вращения коленчатого вала", "n", "мин⁻¹", _RPM, 0),
    ListedNumber("cylinders", "KC", "Число цилиндров", "i", "", 1, 0),
    ListedNumber("compression_ratio", "SG", "Степень сжатия", "ε", "", 1, 1),
    ListedNumber("bore", "DI", "Диаметр цилиндра", "D", "мм", 1e-3, 1),
    ListedNumber("stroke", "SI", "Ход поршня", "S", "мм", 1e-3, 1),
    ListedNumber("offset", "DEZ", "Дезаксаж", "e", "мм", 1e-3, 3),
    ListedNumber("lam", "ORL", "Отношение радиуса кривошипа к длине шатуна", "λ", "", 1, 3),
    ListedNumber("excess_air", "AL", "Коэффициент избытка воздуха", "α", "", 1, 3),
    ListedNumber("mechanical", "ETM", "Механический КПД", "η_м", "", 1, 3),
    ListedNumber("boost.pressure_ratio", "PIK", "Степень повышения давления", "π_к", "", 1, 3),
    ListedNumber("p_max", "PZ", "Максимальное давление цикла", "p_z", "МПа", 1e6, 2),
    ListedNumber("charge_heating", "DT", "Подогрев свежего заряда", "ΔT", "К", 1, 1),
    ListedNumber("t_residual", "TR", "Температура остаточных газов", "T_r", "К", 1, 1),
    ListedNumber("intake_factor", "C1", "Коэффициент сопротивления впуска", "C1", "", 1, 2),
    ListedNumber("exhaust_factor", "C2", "Коэффициент сопротивления выпуска", "C2", "", 1, 2),
    ListedNumber("recharge", "DOZ", "Коэффициент дозарядки", "φ_доз", "", 1, 2),
    ListedNumber("scavenging", "FIO", "Коэффициент очистки", "φ_оч", "", 1, 2),
    ListedNumber("fullness", "FID", "Коэффициент полноты диаграммы", "φ_д", "", 1, 2),
    ListedNumber("xi_z", "CIZ", "Коэффициент использования тепла в точке z", "ξ_z", "", 1, 2),
    ListedNumber("xi_b", "CIB", "Коэффициент использования тепла в точке b", "ξ_b", "", 1, 2),
    ListedNumber(
        "boost.cooler_pressure_loss", "DPX", "Потери давления в ОНВ", "Δp_х", "МПа", 1e6, 4
    ),
    ListedNumber(
        "boost.cooler_temperature_drop", "DTX", "Понижение температуры в ОНВ", "ΔT_х", "К", 1, 1
    ),
    ListedNumber("boost.compressor_efficiency", "SK", "КПД нагнетателя", "η_к", "", 1, 3),
    ListedNumber("boost.turbine_efficiency", "ST", "КПД турбины", "η_т", "", 1, 3),
)

OUTPUTS: tuple[ListedNumber, ...] = (
    ListedNumber("charge.p_k", "", "Давление на впуске", "p_к", "МПа", 1e6, 4),
    ListedNumber("charge.t_k", "", "Температура на впуске", "T_к", "К", 1, 1),
    ListedNumber("effective.piston_area", "", "Площадь поршня", "F_п", "дм²", 1e-2, 4),
    ListedNumber("effective.displacement", "", "Рабочий объём цилиндра", "V_h", "дм³", 1e-3, 4),
    ListedNumber("charge.gamma", "", "Коэффициент остаточных газов", "γ", "", 1, 3),
    ListedNumber("charge.eta_v", "", "Коэффициент наполнения", "η_v", "", 1, 3),
    ListedNumber("charge.p_a", "", "Давление начала сжатия", "p_a", "МПа", 1e6, 4),
    ListedNumber("charge.t_a", "", "Температура начала сжатия", "T_a", "К", 1, 1),
    ListedNumber("compression.n_1", "", "Показатель политропы сжатия", "n_1", "", 1, 3),
    ListedNumber("compression.p_c", "", "Давление конца сжатия", "p_c", "МПа", 1e6, 4),
    ListedNumber("compression.t_c", "", "Температура конца сжатия", "T_c", "К", 1, 1),
    ListedNumber("combustion.t_z", "", "Температура сгорания", "T_z", "К", 1, 1),
    ListedNumber("combustion.rho", "", "Степень предварительного расширения", "ρ", "", 1, 3),
    ListedNumber("combustion.delta", "", "Степень последующего расширения", "δ", "", 1, 3),
    ListedNumber("expansion.n_2", "", "Показатель политропы расширения", "n_2", "", 1, 3),
    ListedNumber("expansion.p_b", "", "Давление конца расширения", "p_b", "МПа", 1e6, 4),
    ListedNumber("expansion.t_b", "", "Температура конца расширения", "T_b", "К", 1, 1),
    ListedNumber("indicated.p_i", "", "Среднее индикаторное давление", "p_i", "МПа", 1e6, 4),
    ListedNumber("effective.power_i", "", "Индикаторная мощность", "N_i", "кВт", 1e3, 1),
    ListedNumber(
        "indicated.g_i",
        "",
        "Индикаторный удельный расход топлива",
        "g_i",
        "г/(кВт·ч)",
        _CONSUMPTION,
        1,
    ),
    ListedNumber("indicated.eta_i", "", "Индикаторный КПД", "η_i", "", 1, 3),
    ListedNumber("effective.p_e", "", "Среднее эффективное давление", "p_e", "МПа", 1e6, 4),
    ListedNumber("effective.power_e", "", "Эффективная мощность", "N_e", "кВт", 1e3, 1),
    ListedNumber(
        "effective.g_e",
        "",
        "Эффективный удельный расход топлива",
        "g_e",
        "г/(кВт·ч)",
        _CONSUMPTION,
        1,
    ),
    ListedNumber("effective.eta_e", "", "Эффективный КПД", "η_e", "", 1, 3),
    ListedNumber("effective.torque", "", "Крутящий момент", "M_e", "Н·м", 1, 2),
    ListedNumber("effective.mean_piston_speed", "", "Средняя скорость поршня", "c_m", "м/с", 1, 2),
    ListedNumber("effective.fuel_flow", "", "Часовой расход топлива", "G_т", "кг/ч", _HOURLY, 2),
    ListedNumber("effective.air_flow", "", "Часовой расход воздуха", "G_в", "кг/ч", _HOURLY, 2),
    ListedNumber(
        "turbo.compressor_flow", "", "Расход воздуха через компрессор", "G_к", "кг/с", 1, 4
    ),
    ListedNumber(
        "turbo.compressor_power", "", "Мощность на привод компрессора", "N_к", "кВт", 1e3, 2
    ),
    ListedNumber("turbo.turbine_flow", "", "Расход газов через турбину", "G_тб", "кг/с", 1, 4),
    ListedNumber("turbo.p_t", "", "Давление газов перед турбиной", "p_т", "МПа", 1e6, 4),
    ListedNumber("turbo.t_t", "", "Температура газов перед турбиной", "T_т", "К", 1, 1),
)

# What the usual ranges and the report show besides the lists of the appendix
EXTRA: tuple[ListedNumber, ...] = (
    ListedNumber("combustion.lambda_p", "", "Степень повышения давления", "λ_p", "", 1, 3),
    ListedNumber("combustion.p_z", "", "Максимальное давление цикла", "p_z", "МПа", 1e6, 4),
    ListedNumber("combustion.mu", "", "Коэффициент молекулярного изменения", "μ", "", 1, 4),
    ListedNumber("indicated.p_theory", "", "Теоретическое среднее давление", "p_i'", "МПа", 1e6, 4),
    ListedNumber("effective.eta_m", "", "Механический КПД", "η_м", "", 1, 3),
    ListedNumber("turbo.turbine_power", "", "Мощность турбины", "N_т", "кВт", 1e3, 2),
    ListedNumber("t_residual_check", "", "Проверка T_r", "T_r", "К", 1, 1),
)

_SCALES = {q.key: q.scale for q in (*INPUTS, *OUTPUTS, *EXTRA)}


def value_of(source: object, key: str) -> float:
    """The number at a path in the cycle or in its inputs, in the unit of the listing.

    Raises:
        AttributeError: no such number in this cycle (no turbocharger, no bore yet).
        KeyError: the path is in none of the lists above.
    """
    value = source
    for name in key.split("."):
        value = getattr(value, name)
    if not isinstance(value, int | float):
        raise AttributeError(f"{key} is no number in this cycle")
    return value / _SCALES[key.removeprefix("inputs.")]
