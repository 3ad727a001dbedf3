"""The [gas] section of the input file, by its source: polytropes, points, a cycle, figure 22."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Strict

from reports.inputs.meta import Meta, Strictly, choice, number, title_of
from reports.inputs.sections.cycle import KINDS
from reports.inputs.units import DEG, MPA, NONE

SOURCES = {
    "polytropic": "по политропам",
    "table": "по точкам диаграммы",
    "cycle": "по расчёту цикла",
    "rounded": "скруглённая действительная диаграмма",
}
INTERPOLATIONS = {"linear": "прямыми", "monotone": "гладко, без выбросов"}
PEAK_SHARE = {"petrol": 0.85, "diesel": 1.0}
PEAK_DEG = {"petrol": 12.0, "diesel": 10.0}
JOIN_DEG = {"petrol": 40.0, "diesel": 45.0}
_SOURCE = Meta("Индикаторная диаграмма", choices=SOURCES, structural=True)
_ROUNDED = Meta("Индикаторная диаграмма", choices={"rounded": SOURCES["rounded"]}, structural=True)
# The same in every diagram that has them, whatever the point z is called there.
_P_Z = ("p_z", MPA, 0.2, 60)
_RHO = (title_of("cyc_rho"), "ρ", NONE, 1, 6)


class _Ambient(Strictly):
    """What every source has."""

    source: Annotated[str, _SOURCE]
    ambient_pressure_mpa: float = number("Давление окружающей среды", "p_0", MPA, 0.01, 0.5, 0.1)


class _Pressures(_Ambient):
    """Pressures and exponents of the polytropes."""

    intake_pressure_mpa: float = number("Давление впуска", "p_a", MPA, 0.01, 3)
    residual_pressure_mpa: float = number(title_of("cyc_p_r"), "p_r", MPA, 0.01, 3)
    max_pressure_mpa: float = number(title_of("cyc_p_z"), *_P_Z)
    compression_exponent: float = number(title_of("cyc_n1"), "n_1", NONE, 1, 1.7)
    expansion_exponent: float = number(title_of("cyc_n2"), "n_2", NONE, 1, 1.7)
    preexpansion_ratio: float = number(*_RHO)


class _Ignition(_Ambient):
    """When the charge takes fire."""

    injection_advance_deg: float = number(
        "Угол опережения впрыска (зажигания)", "θ_оп", DEG, 0.5, 90
    )
    ignition_delay_deg: float = number("Период задержки воспламенения", "Δφ_з", DEG, 0, 90)


class _Timing(_Ignition):
    """The angles of Dinn's diagram."""

    combustion_start_deg: float | None = number("Угол начала сгорания", "φ_c", DEG, 270, 360, None)
    exhaust_start_before_bdc_deg: float = number("Начало выпуска до НМТ", "φ_в1", DEG, 0, 150)
    exhaust_end_after_bdc_deg: float = number("Конец выпуска после НМТ", "φ_в2", DEG, 0, 180)


class PolytropicGasSection(_Timing, _Pressures):
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


class CycleGasSection(_Timing):
    """[gas], source = "cycle": pressures from the [cycle] section, the angles of Dinn."""

    source: Annotated[Literal["cycle"], _SOURCE]
    ambient_pressure_mpa: float = number("Давление окружающей среды", "p_0", MPA, 0.03, 0.2, 0.1)
    exhaust_end_after_bdc_deg: float = number(
        "Конец свободного выпуска после НМТ", "φ_в2", DEG, 0, 180
    )


class _Kind(Strictly):
    """The kind of engine stands before its pressures."""

    source: Annotated[str, _ROUNDED]
    kind: Literal["petrol", "diesel"] = choice("Вид двигателя", KINDS, structural=True)


class RoundedGasSection(_Ignition, _Pressures, _Kind):
    """[gas], source = "rounded": c', c'', z_д, b', b'' and r of figure 22 joined smoothly."""

    source: Annotated[Literal["rounded"], _ROUNDED]
    max_pressure_mpa: float = number("Расчётное давление конца сгорания в точке z", *_P_Z)
    preexpansion_ratio: float = number(*_RHO, 1.0)
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
        "Угол после ВМТ, при котором устанавливается p_a", "φ_a'", DEG, 2, 90, 30.0
    )


GasSection = PolytropicGasSection | TableGasSection | CycleGasSection | RoundedGasSection
