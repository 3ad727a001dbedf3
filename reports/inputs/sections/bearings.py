"""The [bearings] section of the input file: clearances, oil, roughness, material."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from kshm.engine.bearings import Bearings, Oil, Strength
from reports.inputs.meta import USUAL, StrictModel, choice, named, number
from reports.inputs.units import CELSIUS, J_KG_K, KG_M3, MM, MPA, MPA_S, NONE, UM

MEMORY = "по памяти, без источника"
_STRENGTH = "σв и σт — {} (по памяти), пределы выносливости — оценка 0,43σв и 0,25σв"


@dataclass(frozen=True, slots=True)
class OilGrade:
    """Dynamic viscosities [mPa·s] at 40 and 100 °C."""

    label: str
    at_40: float
    at_100: float


@dataclass(frozen=True, slots=True)
class Material:
    """Limits [MPa]: tensile, yield, bending and torsion, both symmetric; K of the class rule."""

    label: str
    tensile: float
    yielding: float
    bending: float
    torsion: float
    making: float
    source: str


# Middles of the classes; the viscosity over the temperature follows Vogel's law between them.
OILS = {
    "sae20": OilGrade("SAE 20", 56.0, 6.4),
    "sae30": OilGrade("SAE 30", 88.0, 8.9),
    "sae40": OilGrade("SAE 40", 125.0, 11.7),
    "sae50": OilGrade("SAE 50", 185.0, 15.5),
    "m8": OilGrade("М-8", 62.0, 6.8),
    "m10": OilGrade("М-10", 90.0, 9.1),
}
MATERIALS = {
    "40h2n2ma": Material("40Х2Н2МА", 1080.0, 930.0, 465.0, 270.0, 1.05,
                         _STRENGTH.format("ГОСТ 4543")),
    "40h": Material("40Х", 980.0, 785.0, 420.0, 245.0, 1.05, _STRENGTH.format("ГОСТ 4543")),
    "45": Material("45", 600.0, 355.0, 260.0, 150.0, 1.05, _STRENGTH.format("ГОСТ 1050")),
    "vch60": Material("ВЧ 60", 600.0, 370.0, 230.0, 180.0, 0.93,
                      "σв и σт — ГОСТ 7293 (по памяти), пределы выносливости — оценка"),
    "sch35": Material("СЧ 35", 350.0, 280.0, 140.0, 110.0, 0.93,
                      "σв — ГОСТ 1412 (по памяти), остальное — оценка"),
}  # fmt: skip
OIL_NAMES = {key: oil.label for key, oil in OILS.items()}
MATERIAL_NAMES = {key: material.label for key, material in MATERIALS.items()}


class BearingsSection(StrictModel, usual=(Bearings, Oil, Strength)):
    """[bearings]: a key that is not given follows from a rule, which the workbook names."""

    pin_clearance_min_mm: float | None = number(
        "Шатунный подшипник: наименьший зазор по диаметру", "Δ_ш1", MM, 0.001, 5, None
    )
    pin_clearance_max_mm: float | None = number(
        "Шатунный подшипник: наибольший зазор по диаметру", "Δ_ш2", MM, 0.001, 5, None
    )
    main_clearance_min_mm: float | None = number(
        "Коренные подшипники: наименьший зазор по диаметру", "Δ_к1", MM, 0.001, 5, None
    )
    main_clearance_max_mm: float | None = number(
        "Коренные подшипники: наибольший зазор по диаметру", "Δ_к2", MM, 0.001, 5, None
    )
    pin_width_mm: float | None = number(
        "Шатунный подшипник: рабочая ширина", "B_ш", MM, 1, 2000, None
    )
    main_width_mm: float | None = number(
        "Коренные подшипники: рабочая ширина", "B_к", MM, 1, 2000, None
    )
    pin_groove_mm: float = number(
        "Шатунный подшипник: ширина кольцевой канавки, 0 — нет", "g_ш", MM, 0, 500, USUAL
    )
    main_groove_mm: float = number(
        "Коренные подшипники: ширина кольцевой канавки, 0 — нет", "g_к", MM, 0, 500, USUAL
    )
    hole_mm: float = number("Диаметр масляного отверстия", "d_м", MM, 0.5, 100, USUAL)
    oil: Literal["sae20", "sae30", "sae40", "sae50", "m8", "m10"] = choice(
        "Масло", OIL_NAMES, "sae30"
    )
    viscosity_40_mpa_s: float | None = number(
        *named("oil_eta40"), MPA_S, 0.5, 5000, None, solver="at_40"
    )
    viscosity_100_mpa_s: float | None = number(
        *named("oil_eta100"), MPA_S, 0.5, 1000, None, solver="at_100"
    )
    oil_temperature_c: float | None = number(
        "Температура масла в плёнке (нет — по тепловому балансу)", "t_м", CELSIUS, -20, 200, None,
        solver="temperature",
    )  # fmt: skip
    supply_c: float = number(
        "Температура масла перед подшипниками", "t_0", CELSIUS, -20, 150, USUAL
    )
    supply_mpa: float = number(
        "Давление масла перед подшипниками", "p_вх", MPA, 0.01, 5, USUAL, solver="pressure"
    )
    density_kg_m3: float = number("Плотность масла", "ρ_м", KG_M3, 700, 1000, USUAL)
    heat_j_kg_k: float = number("Удельная теплоёмкость масла", "c_м", J_KG_K, 1000, 3000, USUAL)
    journal_roughness_um: float = number("Высота неровностей шейки", "R_z1", UM, 0, 50, 0.8)
    shell_roughness_um: float = number("Высота неровностей вкладыша", "R_z2", UM, 0, 50, 1.2)
    form_um: float = number("Изгиб вала и отклонение формы", "h_3", UM, 0, 100, 1.0)
    reserve_allowed: float = number("Допускаемый запас плёнки", "[K_h]", NONE, 1, 20, 1.5)
    material: Literal["40h2n2ma", "40h", "45", "vch60", "sch35"] = choice(
        "Материал вала", MATERIAL_NAMES, "45"
    )
    tensile_mpa: float | None = number(*named("mat_tensile_MPa"), MPA, 50, 3000, None)
    bending_limit_mpa: float | None = number(
        *named("mat_bending_MPa"), MPA, 20, 2000, None, solver="bending"
    )
    torsion_limit_mpa: float | None = number(
        *named("mat_torsion_MPa"), MPA, 20, 2000, None, solver="torsion"
    )
    mean_bending: float = number(
        "Чувствительность к асимметрии при изгибе", "ψ_σ", NONE, 0, 1, USUAL
    )
    mean_torsion: float = number(
        "Чувствительность к асимметрии при кручении", "ψ_τ", NONE, 0, 1, USUAL
    )
    fillet_mm: float | None = number(*named("safe_fillet1_mm"), MM, 0.2, 200, None)
    pin_bore_mm: float = number("Диаметр отверстия шатунных шеек", "d_о.ш", MM, 0, 2000, USUAL)
    main_bore_mm: float = number("Диаметр отверстия коренных шеек", "d_о.к", MM, 0, 2000, USUAL)
    fillet_bending: float = number("Концентрация у галтели при изгибе", "α_σг", NONE, 1, 10, USUAL)
    fillet_torsion: float = number(
        "Концентрация у галтели при кручении", "α_τг", NONE, 1, 10, USUAL
    )
    hole_bending: float = number("Концентрация у отверстия при изгибе", "α_σо", NONE, 1, 10, USUAL)
    hole_torsion: float = number(
        "Концентрация у отверстия при кручении", "α_τо", NONE, 1, 10, USUAL
    )
    sensitivity: float = number("Чувствительность к концентрации", "q_σ", NONE, 0, 1, USUAL)
    size_factor: float = number(
        "Масштабный коэффициент", "ε_м", NONE, 0.3, 1.2, USUAL, solver="size"
    )
    surface_factor: float = number(
        "Коэффициент поверхности", "ε_пов", NONE, 0.3, 2.5, USUAL, solver="surface"
    )
    safety_allowed: float = number("Допускаемый запас прочности", "[n]", NONE, 1, 20, 2.0)
