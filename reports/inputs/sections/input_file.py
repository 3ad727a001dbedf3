"""The input file as strict pydantic models, user units in the key suffixes.

Limits are hard and physically generous; what only looks odd is a warning
(see `reports.inputs.checks.cross_checks`).  A model alone is checked field by field: use
`reports.inputs.load`, which also checks the fields against each other.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, Strict

from reports.inputs.meta import Strictly, choice, number, text
from reports.inputs.sections.articulated import ArticulatedSection
from reports.inputs.sections.balance import BalanceSection
from reports.inputs.sections.crankshaft import CrankshaftSection
from reports.inputs.sections.cycle import CycleSection
from reports.inputs.sections.gas import INTERPOLATIONS, ROUNDED, RoundedGasSection
from reports.inputs.sections.masses import MassesSection
from reports.inputs.sections.reference import ReferenceSection
from reports.inputs.sections.report import Report
from reports.inputs.units import DEG, KW, MM, MPA, NONE, RPM

MAX_CYLINDERS = 12
STEPS = (1, 2, 3, 5, 10, 15, 30)
LAMBDA_MIN, LAMBDA_MAX = 0.01, 0.99

METHODS = {
    "textbook": "по учебнику: двучленное ускорение",
    "exact": "точное ускорение",
}
LAYOUTS = {"inline": "рядный", "v": "V-образный", "opposed": "оппозитный"}
STROKES = {"4": "4", "2": "2"}
SOURCES = {
    "polytropic": "по политропам",
    "table": "по точкам диаграммы",
    "cycle": "по расчету цикла",
    **ROUNDED,
}


class EngineSection(Strictly):
    """[engine]."""

    name: Annotated[str, text("Название двигателя")] = "Двигатель"
    cylinders: Annotated[
        int,
        choice(
            "Число цилиндров",
            {str(i): str(i) for i in range(1, MAX_CYLINDERS + 1)},
            structural=True,
            symbol="i",
        ),
        Field(ge=1, le=MAX_CYLINDERS),
    ]
    layout: Annotated[
        Literal["inline", "v", "opposed"],
        choice("Расположение цилиндров", LAYOUTS, structural=True),
    ] = "inline"
    strokes: Annotated[Literal[4, 2], choice("Тактность", STROKES, structural=True, symbol="τ")] = 4


class Calculation(Strictly):
    """[calculation]: method and grid."""

    method: Annotated[
        Literal["textbook", "exact"], choice("Метод расчета", METHODS, structural=False)
    ] = "textbook"
    step_deg: Annotated[
        Literal[1, 2, 3, 5, 10, 15, 30],
        choice(
            "Шаг таблиц по углу поворота",
            {str(step): f"{step}°" for step in STEPS},
            structural=True,
            symbol="Δφ",
        ),
    ] = 10
    wear_rays: Annotated[
        Literal[12, 18],
        choice("Число лучей диаграммы износа", {"12": "12", "18": "18"}, structural=True),
    ] = 12


class GeometrySection(Strictly):
    """[geometry]: any two of r (or S = 2r), L and λ; three if they agree."""

    bore_mm: Annotated[float, number("Диаметр цилиндра", "D", MM, 10, 1500)]
    crank_radius_mm: Annotated[float | None, number("Радиус кривошипа", "r", MM, 5, 2000)] = None
    stroke_mm: Annotated[float | None, number("Ход поршня", "S", MM, 10, 4000)] = None
    rod_length_mm: Annotated[float | None, number("Длина шатуна", "L", MM, 10, 6000)] = None
    lambda_: Annotated[float | None, number("Отношение r/L", "λ", NONE, LAMBDA_MIN, LAMBDA_MAX)] = (
        Field(default=None, alias="lambda")
    )
    compression_ratio: Annotated[float, number("Степень сжатия", "ε", NONE, 2, 50)]
    crank_offset_mm: Annotated[
        float | None,
        number("Смещение оси цилиндра от оси вала в сторону вращения", "e_в", MM, -2000, 2000),
    ] = None
    pin_offset_mm: Annotated[
        float | None,
        number(
            "Смещение поршневого пальца от оси цилиндра в сторону вращения",
            "e_п",
            MM,
            -500,
            500,
        ),
    ] = None


class DesignGeometrySection(Strictly):
    """[geometry] of an engine whose bore and stroke follow from the wanted power."""

    lambda_: Annotated[float, number("Отношение r/L", "λ", NONE, LAMBDA_MIN, LAMBDA_MAX)] = Field(
        alias="lambda"
    )
    compression_ratio: Annotated[float, number("Степень сжатия", "ε", NONE, 2, 50)]


class Regime(Strictly):
    """[regime]."""

    name: Annotated[str | None, text("Название режима")] = None
    speed_rpm: Annotated[float, number("Частота вращения", "n", RPM, 10, 30000)]
    mechanical_efficiency: Annotated[float, number("Механический КПД", "η_м", NONE, 0.1, 1)] = 1.0
    indicated_power_kw: Annotated[
        float | None, number("Индикаторная мощность по расчету цикла", "N_i", KW, 0.01, 1e5)
    ] = None
    fullness: Annotated[float, number("Коэффициент полноты диаграммы", "φ_п", NONE, 0.5, 1)] = 1.0


class PolytropicGasSection(Strictly):
    """[gas], source = "polytropic": indicator diagram by polytropes, as Dinn built it."""

    source: Annotated[
        Literal["polytropic"], choice("Индикаторная диаграмма", SOURCES, structural=True)
    ]
    ambient_pressure_mpa: Annotated[
        float, number("Давление окружающей среды", "p_0", MPA, 0.01, 0.5)
    ] = 0.1
    intake_pressure_mpa: Annotated[float, number("Давление впуска", "p_a", MPA, 0.01, 3)]
    residual_pressure_mpa: Annotated[
        float, number("Давление остаточных газов", "p_r", MPA, 0.01, 3)
    ]
    max_pressure_mpa: Annotated[float, number("Максимальное давление цикла", "p_z", MPA, 0.2, 60)]
    compression_exponent: Annotated[
        float, number("Показатель политропы сжатия", "n_1", NONE, 1, 1.7)
    ]
    expansion_exponent: Annotated[
        float, number("Показатель политропы расширения", "n_2", NONE, 1, 1.7)
    ]
    preexpansion_ratio: Annotated[
        float, number("Степень предварительного расширения", "ρ", NONE, 1, 6)
    ]
    injection_advance_deg: Annotated[
        float, number("Угол опережения впрыска (зажигания)", "θ_оп", DEG, 0.5, 90)
    ]
    ignition_delay_deg: Annotated[
        float, number("Период задержки воспламенения", "Δφ_з", DEG, 0, 90)
    ]
    combustion_start_deg: Annotated[
        float | None, number("Угол начала сгорания", "φ_c", DEG, 270, 360)
    ] = None
    exhaust_start_before_bdc_deg: Annotated[
        float, number("Начало выпуска до НМТ", "φ_в1", DEG, 0, 150)
    ]
    exhaust_end_after_bdc_deg: Annotated[
        float, number("Конец выпуска после НМТ", "φ_в2", DEG, 0, 180)
    ]
    scavenge_start_before_bdc_deg: Annotated[
        float | None, number("Начало продувки до НМТ (двухтактный двигатель)", "φ_пр", DEG, 0, 150)
    ] = None


class TableGasSection(Strictly):
    """[gas], source = "table": points (φ, absolute pressure)."""

    source: Annotated[Literal["table"], choice("Индикаторная диаграмма", SOURCES, structural=True)]
    ambient_pressure_mpa: Annotated[
        float, number("Давление окружающей среды", "p_0", MPA, 0.01, 0.5)
    ] = 0.1
    interpolation: Annotated[
        Literal["linear", "monotone"],
        choice("Соединение точек", INTERPOLATIONS, structural=True),
    ] = "linear"
    points: Annotated[
        tuple[
            Annotated[
                tuple[
                    Annotated[float, number("Точка {n}: угол", "φ_{n}", DEG, 0, 720)],
                    Annotated[float, number("Точка {n}: давление", "p_{n}", MPA, 0.001, 60)],
                ],
                Strict(False),
            ],
            ...,
        ],
        Strict(False),
    ]


class CycleGasSection(Strictly):
    """[gas], source = "cycle": pressures from the [cycle] section, the angles of Dinn."""

    source: Annotated[Literal["cycle"], choice("Индикаторная диаграмма", SOURCES, structural=True)]
    ambient_pressure_mpa: Annotated[
        float, number("Давление окружающей среды", "p_0", MPA, 0.03, 0.2)
    ] = 0.1
    injection_advance_deg: Annotated[
        float, number("Угол опережения впрыска (зажигания)", "θ_оп", DEG, 0.5, 90)
    ]
    ignition_delay_deg: Annotated[
        float, number("Период задержки воспламенения", "Δφ_з", DEG, 0, 90)
    ]
    combustion_start_deg: Annotated[
        float | None, number("Угол начала сгорания", "φ_c", DEG, 270, 360)
    ] = None
    exhaust_start_before_bdc_deg: Annotated[
        float, number("Начало выпуска до НМТ", "φ_в1", DEG, 0, 150)
    ]
    exhaust_end_after_bdc_deg: Annotated[
        float, number("Конец свободного выпуска после НМТ", "φ_в2", DEG, 0, 180)
    ]


GasSection = PolytropicGasSection | TableGasSection | CycleGasSection | RoundedGasSection


class RegimeValues(Regime):
    """[[regimes]] without its gas: a further speed and load of the same engine, Gots 2.4."""

    name: Annotated[str, text("Название режима")]
    # None at all is left at idle speed.
    mechanical_efficiency: Annotated[float, number("Механический КПД", "η_м", NONE, 0, 1)] = 1.0


class RegimeSection(RegimeValues):
    """[[regimes]]: a further regime with gas data of its own in [regimes.gas]."""

    gas: Annotated[GasSection, Field(discriminator="source")]


class InputFile(Strictly):
    """The whole input file in user units."""

    report: Report = Field(default_factory=Report)
    engine: EngineSection
    calculation: Calculation = Field(default_factory=Calculation)
    geometry: GeometrySection | DesignGeometrySection
    regime: Regime
    gas: Annotated[GasSection, Field(discriminator="source")]
    cycle: CycleSection | None = None
    masses: MassesSection
    articulated: ArticulatedSection | None = None
    crankshaft: CrankshaftSection
    balance: BalanceSection = Field(default_factory=BalanceSection)
    reference: ReferenceSection | None = None
    regimes: tuple[RegimeSection, ...] = ()
