"""Names, codes and units of the inputs and outputs, as appendix 2 of Gots lists them.

A path such as "boost.pressure_ratio" leads from `CycleInputs` or `Cycle` to the
number in SI; ``scale`` is SI per unit of the listing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from kshm.cycle.inputs import CycleInputs
from kshm.cycle.result import Cycle


@dataclass(frozen=True, slots=True)
class Quantity:
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

INPUTS: tuple[Quantity, ...] = (
    Quantity("p_ambient", "PO", "Атмосферное давление", "p_0", "МПа", 1e6, 3),
    Quantity("t_ambient", "TO", "Температура окружающей среды", "T_0", "К", 1, 1),
    Quantity("omega", "OV", "Частота вращения коленчатого вала", "n", "мин⁻¹", _RPM, 0),
    Quantity("cylinders", "KC", "Число цилиндров", "i", "", 1, 0),
    Quantity("compression_ratio", "SG", "Степень сжатия", "ε", "", 1, 1),
    Quantity("bore", "DI", "Диаметр цилиндра", "D", "мм", 1e-3, 1),
    Quantity("stroke", "SI", "Ход поршня", "S", "мм", 1e-3, 1),
    Quantity("offset", "DEZ", "Дезаксаж", "e", "мм", 1e-3, 3),
    Quantity("lam", "ORL", "Отношение радиуса кривошипа к длине шатуна", "λ", "", 1, 3),
    Quantity("excess_air", "AL", "Коэффициент избытка воздуха", "α", "", 1, 3),
    Quantity("mechanical", "ETM", "Механический КПД", "η_м", "", 1, 3),
    Quantity("boost.pressure_ratio", "PIK", "Степень повышения давления", "π_к", "", 1, 3),
    Quantity("p_max", "PZ", "Максимальное давление цикла", "p_z", "МПа", 1e6, 2),
    Quantity("charge_heating", "DT", "Подогрев свежего заряда", "ΔT", "К", 1, 1),
    Quantity("t_residual", "TR", "Температура остаточных газов", "T_r", "К", 1, 1),
    Quantity("intake_factor", "C1", "Коэффициент сопротивления впуска", "C1", "", 1, 2),
    Quantity("exhaust_factor", "C2", "Коэффициент сопротивления выпуска", "C2", "", 1, 2),
    Quantity("recharge", "DOZ", "Коэффициент дозарядки", "φ_доз", "", 1, 2),
    Quantity("scavenging", "FIO", "Коэффициент очистки", "φ_оч", "", 1, 2),
    Quantity("fullness", "FID", "Коэффициент полноты диаграммы", "φ_д", "", 1, 2),
    Quantity("xi_z", "CIZ", "Коэффициент использования тепла в точке z", "ξ_z", "", 1, 2),
    Quantity("xi_b", "CIB", "Коэффициент использования тепла в точке b", "ξ_b", "", 1, 2),
    Quantity("boost.cooler_pressure_loss", "DPX", "Потери давления в ОНВ", "Δp_х", "МПа", 1e6, 4),
    Quantity(
        "boost.cooler_temperature_drop", "DTX", "Понижение температуры в ОНВ", "ΔT_х", "К", 1, 1
    ),
    Quantity("boost.compressor_efficiency", "SK", "КПД нагнетателя", "η_к", "", 1, 3),
    Quantity("boost.turbine_efficiency", "ST", "КПД турбины", "η_т", "", 1, 3),
)

OUTPUTS: tuple[Quantity, ...] = (
    Quantity("charge.p_k", "", "Давление на впуске", "p_к", "МПа", 1e6, 4),
    Quantity("charge.t_k", "", "Температура на впуске", "T_к", "К", 1, 1),
    Quantity("effective.piston_area", "", "Площадь поршня", "F_п", "дм²", 1e-2, 4),
    Quantity("effective.displacement", "", "Рабочий объём цилиндра", "V_h", "дм³", 1e-3, 4),
    Quantity("charge.gamma", "", "Коэффициент остаточных газов", "γ", "", 1, 3),
    Quantity("charge.eta_v", "", "Коэффициент наполнения", "η_v", "", 1, 3),
    Quantity("charge.p_a", "", "Давление начала сжатия", "p_a", "МПа", 1e6, 4),
    Quantity("charge.t_a", "", "Температура начала сжатия", "T_a", "К", 1, 1),
    Quantity("compression.n_1", "", "Показатель политропы сжатия", "n_1", "", 1, 3),
    Quantity("compression.p_c", "", "Давление конца сжатия", "p_c", "МПа", 1e6, 4),
    Quantity("compression.t_c", "", "Температура конца сжатия", "T_c", "К", 1, 1),
    Quantity("combustion.t_z", "", "Температура сгорания", "T_z", "К", 1, 1),
    Quantity("combustion.rho", "", "Степень предварительного расширения", "ρ", "", 1, 3),
    Quantity("combustion.delta", "", "Степень последующего расширения", "δ", "", 1, 3),
    Quantity("expansion.n_2", "", "Показатель политропы расширения", "n_2", "", 1, 3),
    Quantity("expansion.p_b", "", "Давление конца расширения", "p_b", "МПа", 1e6, 4),
    Quantity("expansion.t_b", "", "Температура конца расширения", "T_b", "К", 1, 1),
    Quantity("indicated.p_i", "", "Среднее индикаторное давление", "p_i", "МПа", 1e6, 4),
    Quantity("effective.power_i", "", "Индикаторная мощность", "N_i", "кВт", 1e3, 1),
    Quantity(
        "indicated.g_i",
        "",
        "Индикаторный удельный расход топлива",
        "g_i",
        "г/(кВт·ч)",
        _CONSUMPTION,
        1,
    ),
    Quantity("indicated.eta_i", "", "Индикаторный КПД", "η_i", "", 1, 3),
    Quantity("effective.p_e", "", "Среднее эффективное давление", "p_e", "МПа", 1e6, 4),
    Quantity("effective.power_e", "", "Эффективная мощность", "N_e", "кВт", 1e3, 1),
    Quantity(
        "effective.g_e",
        "",
        "Эффективный удельный расход топлива",
        "g_e",
        "г/(кВт·ч)",
        _CONSUMPTION,
        1,
    ),
    Quantity("effective.eta_e", "", "Эффективный КПД", "η_e", "", 1, 3),
    Quantity("effective.torque", "", "Крутящий момент", "M_e", "Н·м", 1, 2),
    Quantity("effective.mean_piston_speed", "", "Средняя скорость поршня", "c_m", "м/с", 1, 2),
    Quantity("effective.fuel_flow", "", "Часовой расход топлива", "G_т", "кг/ч", _HOURLY, 2),
    Quantity("effective.air_flow", "", "Часовой расход воздуха", "G_в", "кг/ч", _HOURLY, 2),
    Quantity("turbo.compressor_flow", "", "Расход воздуха через компрессор", "G_к", "кг/с", 1, 4),
    Quantity("turbo.compressor_power", "", "Мощность на привод компрессора", "N_к", "кВт", 1e3, 2),
    Quantity("turbo.turbine_flow", "", "Расход газов через турбину", "G_тб", "кг/с", 1, 4),
    Quantity("turbo.p_t", "", "Давление газов перед турбиной", "p_т", "МПа", 1e6, 4),
    Quantity("turbo.t_t", "", "Температура газов перед турбиной", "T_т", "К", 1, 1),
)

# What the usual ranges and the report show besides the lists of the appendix
EXTRA: tuple[Quantity, ...] = (
    Quantity("combustion.lambda_p", "", "Степень повышения давления", "λ_p", "", 1, 3),
    Quantity("combustion.p_z", "", "Максимальное давление цикла", "p_z", "МПа", 1e6, 4),
    Quantity("combustion.mu", "", "Коэффициент молекулярного изменения", "μ", "", 1, 4),
    Quantity("indicated.p_theory", "", "Теоретическое среднее давление", "p_i'", "МПа", 1e6, 4),
    Quantity("effective.eta_m", "", "Механический КПД", "η_м", "", 1, 3),
    Quantity("turbo.turbine_power", "", "Мощность турбины", "N_т", "кВт", 1e3, 2),
    Quantity("t_residual_check", "", "Проверка T_r", "T_r", "К", 1, 1),
)

_SCALES = {q.key: q.scale for q in (*OUTPUTS, *EXTRA)}
_SCALES |= {f"inputs.{q.key}": q.scale for q in INPUTS}


def value_of(source: Cycle | CycleInputs, key: str) -> float:
    """The number at a path, in the unit of the listing.

    Raises:
        AttributeError: no such number in this cycle (no turbocharger, no bore yet).
        KeyError: the path is in none of the lists above.
    """
    value: object = source
    for name in key.split("."):
        value = getattr(value, name)
    if not isinstance(value, int | float):
        msg = f"{key} is no number in this cycle"
        raise AttributeError(msg)
    path = f"inputs.{key}" if isinstance(source, CycleInputs) else key
    return value / _SCALES[path]
