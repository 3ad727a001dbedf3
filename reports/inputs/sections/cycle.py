"""The [cycle] section of the input file: what the cycle calculation starts from.

Speed, cylinders, compression ratio, ambient pressure and mechanical efficiency stand
in their own sections.  Groups of keys that only belong together with a turbocharger,
an own fuel or a wanted power are optional; `reports.inputs.checks.cycle` tells which.
"""

from __future__ import annotations

from typing import Annotated, Literal

from reports.inputs.meta import Strictly, choice, number
from reports.inputs.units import KELVIN, KG_KMOL, KJ_KG_K, KW, MJ_KG, MM, MPA, MPA_S_M, NONE, RPM

KINDS = {"diesel": "дизель", "petrol": "бензиновый"}
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
    "diesel": "дизель с неразделенной камерой",
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


class CycleSection(Strictly):
    """[cycle]: the engine of appendix 2 of Gots, its regime and the wanted power."""

    kind: Annotated[Literal["diesel", "petrol"], choice("Вид двигателя", KINDS, structural=True)]
    power_kw: (
        Annotated[float, number("Заданная эффективная мощность", "N_e зад", KW, 0.5, 50000)] | None
    ) = None
    stroke_bore: Annotated[float, number("Отношение S/D", "S/D", NONE, 0.5, 2.5)] | None = None
    size_step_mm: Annotated[float, number("Шаг ряда размеров D и S", "Δ", MM, 0.1, 20)] | None = (
        None
    )
    rounding: (
        Annotated[
            Literal["nearest", "up"],
            choice("Округление размеров до ряда", ROUNDINGS, structural=False),
        ]
        | None
    ) = None
    fuel: Annotated[
        Literal["diesel", "petrol", "ethanol", "methane", "own"],
        choice("Топливо", FUEL_NAMES, structural=True),
    ]
    fuel_carbon: Annotated[float, number("Доля углерода в топливе", "C", NONE, 0, 1)] | None = None
    fuel_hydrogen: Annotated[float, number("Доля водорода в топливе", "H", NONE, 0, 1)] | None = (
        None
    )
    fuel_oxygen: Annotated[float, number("Доля кислорода в топливе", "O", NONE, 0, 1)] | None = None
    fuel_heating_value_mj_kg: (
        Annotated[float, number("Низшая теплота сгорания", "H_u", MJ_KG, 5, 130)] | None
    ) = None
    fuel_molar_mass_kg_kmol: (
        Annotated[float, number("Молярная масса паров топлива", "m_т", KG_KMOL, 2, 1000)] | None
    ) = None
    excess_air: Annotated[float, number("Коэффициент избытка воздуха", "α", NONE, 0.6, 8)]
    ambient_temperature_k: Annotated[
        float, number("Температура окружающей среды", "T_0", KELVIN, 220, 340)
    ] = 298.0
    charge_heating_k: Annotated[float, number("Подогрев свежего заряда", "ΔT", KELVIN, -60, 120)]
    residual_temperature_k: Annotated[
        float, number("Температура остаточных газов", "T_r", KELVIN, 450, 1500)
    ]
    intake_factor: Annotated[
        float, number("Коэффициент сопротивления впуска pa/pк", "C_1", NONE, 0.5, 1.1)
    ]
    exhaust_factor: Annotated[
        float, number("Коэффициент сопротивления выпуска pr/pк", "C_2", NONE, 0.5, 2)
    ]
    recharge: Annotated[float, number("Коэффициент дозарядки", "φ_доз", NONE, 0.8, 1.3)] = 1.0
    scavenging: Annotated[float, number("Коэффициент очистки", "φ_оч", NONE, 0, 1)] = 1.0
    max_pressure_mpa: (
        Annotated[float, number("Максимальное давление цикла", "p_z", MPA, 1, 40)] | None
    ) = None
    xi_z: Annotated[float, number("Коэффициент использования тепла в точке z", "ξ_z", NONE, 0, 1)]
    xi_b: Annotated[float, number("Коэффициент использования тепла в точке b", "ξ_b", NONE, 0.3, 1)]
    fullness: Annotated[float, number("Коэффициент полноты диаграммы", "φ_д", NONE, 0.8, 1)]
    h2_co_ratio: (
        Annotated[float, number("Отношение H2/CO в продуктах при α < 1", "K_H2", NONE, 0.3, 0.6)]
        | None
    ) = None
    pumping: Annotated[
        Literal["no", "yes"],
        choice("Насосные потери pr − pa при расчете pi", PUMPING, structural=False),
    ] = "no"
    friction_a_mpa: (
        Annotated[float, number("Механические потери A + B·cm: A", "A", MPA, 0, 0.4)] | None
    ) = None
    friction_b_mpa_s_m: (
        Annotated[float, number("Механические потери A + B·cm: B", "B", MPA_S_M, 0, 0.04)] | None
    ) = None
    boost_ratio: (
        Annotated[float, number("Степень повышения давления в компрессоре", "π_к", NONE, 1, 6)]
        | None
    ) = None
    compressor_efficiency: (
        Annotated[float, number("КПД компрессора", "η_к", NONE, 0.3, 0.95)] | None
    ) = None
    turbine_efficiency: Annotated[float, number("КПД турбины", "η_т", NONE, 0.3, 0.95)] | None = (
        None
    )
    cooler_loss_mpa: (
        Annotated[float, number("Потеря давления в охладителе наддува", "Δp_х", MPA, 0, 0.1)] | None
    ) = None
    cooler_drop_k: (
        Annotated[float, number("Понижение температуры в охладителе", "ΔT_х", KELVIN, 0, 250)]
        | None
    ) = None
    turbine_outlet_ratio: (
        Annotated[float, number("Давление за турбиной к атмосферному", "π_вых", NONE, 1, 1.5)]
        | None
    ) = None
    exhaust_heat_kj_kg_k: (
        Annotated[float, number("Теплоемкость отработавших газов", "c_pг", KJ_KG_K, 1, 1.4)] | None
    ) = None
    speed_law: (
        Annotated[
            Literal["diesel", "diesel_prechamber", "diesel_swirl", "petrol"],
            choice("Коэффициенты внешней характеристики", SPEED_LAWS, structural=True),
        ]
        | None
    ) = None
    adaptability: (
        Annotated[float, number("Коэффициент приспособляемости", "K", NONE, 1.001, 2)] | None
    ) = None
    torque_speed_rpm: (
        Annotated[float, number("Частота наибольшего момента", "n_M", RPM, 10, 30000)] | None
    ) = None
    idle_speed_rpm: (
        Annotated[float, number("Частота холостого хода", "n_х", RPM, 10, 30000)] | None
    ) = None
