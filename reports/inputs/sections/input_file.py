"""The input file as strict pydantic models, user units in the key suffixes.

Limits are hard and physically generous; what only looks odd is a warning
(see `reports.inputs.checks.cross_checks`).  A model alone is checked field by field: use
`reports.inputs.load`, which also checks the fields against each other.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, Field, SerializeAsAny

from reports.inputs.meta import StrictModel, borrowed, choice, named, number, text
from reports.inputs.sections.bearings import BearingsSection
from reports.inputs.sections.counterweight import CounterweightSection
from reports.inputs.sections.flywheel import FlywheelSection
from reports.inputs.sections.gas import CycleSection, GasSection, PolytropicGasSection
from reports.inputs.sections.mechanism import (
    ArticulatedSection,
    BalanceSection,
    CrankshaftSection,
    MassesSection,
)
from reports.inputs.sections.report import (
    ChecksSection,
    ReferenceSection,
    ReportSection,
    SheetSection,
    WorkbookSection,
)
from reports.inputs.sections.strength import StrengthSection
from reports.inputs.sections.torsion import TorsionSection
from reports.inputs.units import KW, MM, NONE, RPM

MAX_CYLINDERS = 24
STEPS = (1, 2, 3, 5, 10, 15, 30)
LAMBDA_MIN, LAMBDA_MAX = 0.01, 0.99

METHODS = {
    "textbook": "по учебнику: двучленное ускорение",
    "exact": "точное ускорение",
}
LAYOUTS = {"inline": "рядный", "v": "V-образный", "opposed": "оппозитный"}
STROKES = {"4": "4", "2": "2"}
_PROTOTYPE = "Прототип"


class EngineSection(StrictModel):
    """[engine]."""

    name: str = text("Название двигателя", "Двигатель")
    cylinders: Annotated[int, Field(ge=1, le=MAX_CYLINDERS)] = choice(
        "Число цилиндров",
        {str(i): str(i) for i in range(1, MAX_CYLINDERS + 1)},
        structural=True,
        symbol="i",
    )
    layout: Literal["inline", "v", "opposed"] = choice(
        "Расположение цилиндров", LAYOUTS, "inline", structural=True
    )
    strokes: Literal[4, 2] = choice("Тактность", STROKES, 4, structural=True, symbol="τ")


class Calculation(StrictModel):
    """[calculation]: method and grid."""

    method: Literal["textbook", "exact"] = choice("Метод расчёта", METHODS, "textbook")
    step_deg: Literal[1, 2, 3, 5, 10, 15, 30] = choice(
        "Шаг таблиц по углу поворота", {str(step): f"{step}°" for step in STEPS}, 10,
        structural=True, symbol="Δφ",
    )  # fmt: skip
    wear_rays: Literal[12, 18] = choice(
        "Число лучей диаграммы износа", {"12": "12", "18": "18"}, 12, structural=True, solver="rays"
    )


class GeometrySection(StrictModel):
    """[geometry]: any two of r (or S = 2r), L and λ; three if they agree.

    With an offset S is still twice the radius; the piston's way is a little longer.
    """

    bore_mm: float = number("Диаметр цилиндра", "D", MM, 10, 1500)
    crank_radius_mm: float | None = number(*named("r_crank"), MM, 5, 2000, None)
    stroke_mm: float | None = number(*named("S_stroke"), MM, 10, 4000, None)
    rod_length_mm: float | None = number(*named("L_rod"), MM, 10, 6000, None)
    lambda_: float | None = number(
        *named("lam"),
        NONE,
        LAMBDA_MIN,
        LAMBDA_MAX,
        None,
        alias="lambda",
        solver="lam",
    )
    compression_ratio: float = number("Степень сжатия", "ε", NONE, 2, 50)
    crank_offset_mm: float | None = number(
        "Смещение оси цилиндра от оси вала в сторону вращения", "e_в", MM, -2000, 2000, None
    )
    pin_offset_mm: float | None = number(
        "Смещение поршневого пальца от оси цилиндра в сторону вращения", "e_п", MM, -500, 500, None
    )

    @property
    def is_offset(self) -> bool:
        """Whether an offset other than zero is given."""
        return bool(self.crank_offset_mm or self.pin_offset_mm)


class DesignGeometrySection(StrictModel):
    """[geometry] of an engine whose bore and stroke follow from the wanted power."""

    lambda_: float = number(
        *named("lam"),
        NONE,
        LAMBDA_MIN,
        LAMBDA_MAX,
        alias="lambda",
        solver="lam",
    )
    compression_ratio: float = number("Степень сжатия", "ε", NONE, 2, 50)


class Regime(StrictModel):
    """[regime]."""

    name: str | None = text("Название режима", None)
    speed_rpm: float = number(*named("n_rpm"), RPM, 10, 60000, solver="omega")
    mechanical_efficiency: float = number(*named("cyc_eta_m"), NONE, 0.1, 1, 1.0)
    indicated_power_kw: float | None = number(
        "Индикаторная мощность по расчёту цикла", "N_i", KW, 0.01, 1e5, None
    )
    fullness: float = number("Коэффициент полноты диаграммы", "φ_д", NONE, 0.5, 1, 1.0)


class RegimeValues(Regime):
    """[[regimes]] without its gas: a further speed and load of the same engine, Gots 2.4."""

    name: str = text("Название режима")
    # None at all is left at idle speed.
    mechanical_efficiency: float = number(*named("cyc_eta_m"), NONE, 0, 1, 1.0)


class RegimeSection(RegimeValues):
    """[[regimes]]: a further regime with gas data of its own in [regimes.gas]."""

    gas: Annotated[GasSection, Field(discriminator="source")]


class PrototypeSection(StrictModel):
    """[prototype]: the engine that the report's one is held against: a file, or its main values."""

    name: str = text(f"{_PROTOTYPE}: название", "")
    file: str = text(f"{_PROTOTYPE}: файл исходных данных", "")
    description: str = text(f"{_PROTOTYPE}: описание конструкции", "")
    cylinders: int | None = number(
        f"{_PROTOTYPE}: число цилиндров", "i", NONE, 1, MAX_CYLINDERS, None
    )
    bore_mm: float | None = borrowed(GeometrySection, "bore_mm", _PROTOTYPE)
    stroke_mm: float | None = borrowed(GeometrySection, "stroke_mm", _PROTOTYPE)
    rod_length_mm: float | None = borrowed(GeometrySection, "rod_length_mm", _PROTOTYPE)
    compression_ratio: float | None = borrowed(GeometrySection, "compression_ratio", _PROTOTYPE)
    speed_rpm: float | None = borrowed(Regime, "speed_rpm", _PROTOTYPE)
    power_kw: float | None = number(
        f"{_PROTOTYPE}: эффективная мощность", "N_e", KW, 0.01, 1e5, None
    )
    mechanical_efficiency: float | None = borrowed(Regime, "mechanical_efficiency", _PROTOTYPE)
    max_pressure_mpa: float | None = borrowed(PolytropicGasSection, "max_pressure_mpa", _PROTOTYPE)
    piston_group_kg: float | None = borrowed(MassesSection, "piston_group_kg", _PROTOTYPE)
    rod_kg: float | None = borrowed(MassesSection, "rod_kg", _PROTOTYPE)
    pin_diameter_mm: float | None = borrowed(CrankshaftSection, "pin_diameter_mm", _PROTOTYPE)
    main_diameter_mm: float | None = borrowed(CrankshaftSection, "main_diameter_mm", _PROTOTYPE)


class InputFile(StrictModel):
    """The whole input file in user units."""

    report: ReportSection = Field(default_factory=ReportSection)
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
    flywheel: FlywheelSection | None = None
    counterweight: CounterweightSection | None = None
    torsion: TorsionSection | None = None
    bearings: BearingsSection | None = None
    strength: StrengthSection | None = None
    reference: ReferenceSection | None = None
    prototype: PrototypeSection | None = None
    sheet: SheetSection | None = None
    workbook: WorkbookSection = Field(default_factory=WorkbookSection)
    checks: ChecksSection | None = None
    regimes: tuple[RegimeSection, ...] = ()
    books: tuple[tuple[str, str], ...] = ()  # names and texts of own books
    own: SerializeAsAny[StrictModel] | None = None  # their sections

    @property
    def web_sections(self) -> dict[str, BaseModel]:
        """Sections that may give a size of the webs, by name."""
        sections = ((name, getattr(self, name)) for name in type(self).model_fields)
        return {name: section for name, section in sections if isinstance(section, BaseModel)
                and "web_thickness_mm" in type(section).model_fields}  # fmt: skip
