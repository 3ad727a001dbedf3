"""Names, codes and units of the inputs and outputs, as appendix 2 of Gots lists them.

A path such as "boost.pressure_ratio" leads from `CycleInputs` or `Cycle` to the
number in SI; ``scale`` is SI per unit of the listing.
"""

from __future__ import annotations

from dataclasses import dataclass

from kshm.nomenclature.quantity import UNITS, quantity


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


def _own(
    key: str, title: str, symbol: str, unit: str, decimals: int, code: str = ""
) -> ListedNumber:
    """Return a number that the tables have not; ``unit`` is a key of ``UNITS``."""
    unit_of = UNITS[unit]
    return ListedNumber(key, code, title, symbol, unit_of.label, unit_of.si, decimals)


def _title(name: str) -> str:
    title = quantity(name).title
    return title[:1].upper() + title[1:]


def _known(key: str, name: str, symbol: str, decimals: int, code: str = "") -> ListedNumber:
    """Return a number that the tables have too, by the title and in the unit that it has there."""
    return _own(key, _title(name), symbol, quantity(name).unit, decimals, code)


INPUTS: tuple[ListedNumber, ...] = (
    _own("p_ambient", "Атмосферное давление", "p_0", "MPa", 3, "PO"),
    _own("t_ambient", "Температура окружающей среды", "T_0", "K", 1, "TO"),
    _own("omega", "Частота вращения коленчатого вала", "n", "rpm", 0, "OV"),
    _own("cylinders", "Число цилиндров", "i", "", 0, "KC"),
    _own("compression_ratio", "Степень сжатия", "ε", "", 1, "SG"),
    _own("bore", "Диаметр цилиндра", "D", "mm", 1, "DI"),
    _own("stroke", _title("S_stroke"), "S", "mm", 1, "SI"),
    _own("offset", "Дезаксаж", "e", "mm", 3, "DEZ"),
    _known("lam", "lam", "λ", 3, "ORL"),
    _own("excess_air", "Коэффициент избытка воздуха", "α", "", 3, "AL"),
    _known("mechanical", "cyc_eta_m", "η_м", 3, "ETM"),
    _own("boost.pressure_ratio", "Степень повышения давления", "π_к", "", 3, "PIK"),
    _known("p_max", "cyc_p_z", "p_z", 2, "PZ"),
    _own("charge_heating", "Подогрев свежего заряда", "ΔT", "K", 1, "DT"),
    _own("t_residual", "Температура остаточных газов", "T_r", "K", 1, "TR"),
    _own("intake_factor", "Коэффициент сопротивления впуска", "C1", "", 2, "C1"),
    _own("exhaust_factor", "Коэффициент сопротивления выпуска", "C2", "", 2, "C2"),
    _own("recharge", "Коэффициент дозарядки", "φ_доз", "", 2, "DOZ"),
    _own("scavenging", "Коэффициент очистки", "φ_оч", "", 2, "FIO"),
    _own("fullness", "Коэффициент полноты диаграммы", "φ_д", "", 2, "FID"),
    _own("xi_z", "Коэффициент использования тепла в точке z", "ξ_z", "", 2, "CIZ"),
    _own("xi_b", "Коэффициент использования тепла в точке b", "ξ_b", "", 2, "CIB"),
    _own("boost.cooler_pressure_loss", "Потери давления в ОНВ", "Δp_х", "MPa", 4, "DPX"),
    _own("boost.cooler_temperature_drop", "Понижение температуры в ОНВ", "ΔT_х", "K", 1, "DTX"),
    _own("boost.compressor_efficiency", "КПД нагнетателя", "η_к", "", 3, "SK"),
    _own("boost.turbine_efficiency", "КПД турбины", "η_т", "", 3, "ST"),
)

OUTPUTS: tuple[ListedNumber, ...] = (
    _known("charge.p_k", "cyc_p_k", "p_к", 4),
    _known("charge.t_k", "cyc_T_k", "T_к", 1),
    _own("effective.piston_area", _title("F_piston"), "F_п", "dm2", 4),
    _known("effective.displacement", "V_h", "V_h", 4),
    _known("charge.gamma", "cyc_gamma", "γ", 3),
    _known("charge.eta_v", "cyc_eta_v", "η_v", 3),
    _known("charge.p_a", "cyc_p_a", "p_a", 4),
    _known("charge.t_a", "cyc_T_a", "T_a", 1),
    _known("compression.n_1", "cyc_n1", "n_1", 3),
    _known("compression.p_c", "cyc_p_c", "p_c", 4),
    _known("compression.t_c", "cyc_T_c", "T_c", 1),
    _own("combustion.t_z", "Температура сгорания", "T_z", "K", 1),
    _known("combustion.rho", "cyc_rho", "ρ", 3),
    _known("combustion.delta", "cyc_delta", "δ", 3),
    _known("expansion.n_2", "cyc_n2", "n_2", 3),
    _known("expansion.p_b", "cyc_p_b", "p_b", 4),
    _known("expansion.t_b", "cyc_T_b", "T_b", 1),
    _known("indicated.p_i", "cyc_p_i", "p_i", 4),
    _own("effective.power_i", "Индикаторная мощность", "N_i", "kW", 1),
    _known("indicated.g_i", "cyc_g_i", "g_i", 1),
    _known("indicated.eta_i", "cyc_eta_i", "η_i", 3),
    _known("effective.p_e", "cyc_p_e", "p_e", 4),
    _known("effective.power_e", "cyc_N_e", "N_e", 1),
    _known("effective.g_e", "cyc_g_e", "g_e", 1),
    _known("effective.eta_e", "cyc_eta_e", "η_e", 3),
    _own("effective.torque", "Крутящий момент", "M_e", "Nm", 2),
    _known("effective.mean_piston_speed", "c_m", "c_m", 2),
    _known("effective.fuel_flow", "cyc_G_f", "G_т", 2),
    _known("effective.air_flow", "cyc_G_a", "G_в", 2),
    _known("turbo.compressor_flow", "cyc_G_k", "G_к", 4),
    _known("turbo.compressor_power", "cyc_N_k", "N_к", 2),
    _known("turbo.turbine_flow", "cyc_G_t", "G_тб", 4),
    _known("turbo.p_t", "cyc_p_t", "p_т", 4),
    _known("turbo.t_t", "cyc_T_t", "T_т", 1),
)

# What the usual ranges and the report show besides the lists of the appendix
EXTRA: tuple[ListedNumber, ...] = (
    _known("combustion.lambda_p", "cyc_lambda_p", "λ_p", 3),
    _known("combustion.p_z", "cyc_p_z", "p_z", 4),
    _own("combustion.mu", "Коэффициент молекулярного изменения", "μ", "", 4),
    _own("indicated.p_theory", "Теоретическое среднее давление", "p_i'", "MPa", 4),
    _known("effective.eta_m", "cyc_eta_m", "η_м", 3),
    _known("turbo.turbine_power", "cyc_N_t", "N_т", 2),
    _own("t_residual_check", "Проверка T_r", "T_r", "K", 1),
)

_SCALES = {q.key: q.scale for q in (*INPUTS, *OUTPUTS, *EXTRA)}


def value_of(source: object, key: str) -> float:
    """Return the number at a path in the cycle or in its inputs, in the unit of the listing.

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
