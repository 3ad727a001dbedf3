"""Doubtful values of engine data, by the kind of engine that a file states.

No range spans a factor of ten: a value in it, ten times larger or smaller, is outside.
What is known by heart and was not checked against a book says so in its source.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from kshm.ranges import RANGES
from reports.inputs.sections.input_file import InputFile
from reports.inputs.units import span_text

MEMORY = "по памяти"
TABLE_4 = "таблица 4 учебника с запасом"
# One size for all journals, or one for each.
PIN_DIAMETERS = ("pin_diameter_mm", "pin_diameters_mm")
PIN_LENGTHS = ("pin_length_mm", "pin_lengths_mm")
MAIN_DIAMETERS = ("main_diameter_mm", "main_diameters_mm")
LARGE_BORE_MM = 250.0
_AREA_MASS = {"source": TABLE_4, "unit": "кг/м²"}
# A point of the diagram stands out from both its neighbours by these factors: from near
# ones and from those further than so many degrees.
LONE_POINT, LONE_POINT_FAR, NEAR_DEG = 2.5, 4.0, 30.0
# Combustion at a constant pressure; what is usual of spark ignition stays below.
_DIESEL_RHO = 1.2
_WORDS = {
    "diesel": ("дизел", "diesel"),
    "petrol": ("бензин", "искров", "карбюратор", "petrol", "gasoline"),
}
_RATIO = "compression_ratio", "geometry.compression_ratio", "", "ε"


@dataclass(frozen=True, slots=True)
class Band:
    """Usual values of a key over a base, ends included.

    ``key`` is a path of the file with the numbers of lists left out.  ``base`` divides the
    value: D, r, L [mm], n [min⁻¹], F (piston area in m²: the bounds of a large engine are
    ``scaled``), ΣF (that of a throw's pistons) or "".
    ``kind`` limits the band to an engine's kind (or number of strokes), ``zero`` lets a
    plain zero pass: there is no such part.
    """

    key: str
    base: str
    words: str
    low: float
    high: float
    source: str = MEMORY
    unit: str = ""
    zero: bool = False
    kind: str = ""

    @property
    def span(self) -> tuple[float, float]:
        """Both bounds."""
        return self.low, self.high

    @property
    def usual(self) -> str:
        """Both bounds as a hint."""
        return f"обычно {span_text(self.low, self.high)}"

    def scaled(self, times: float) -> Band:
        """Return the band with bounds so many times as large."""
        source = f"{self.source}, для такого D" if times > 1 else self.source
        return replace(self, low=self.low * times, high=self.high * times, source=source)


def _doubtful(
    quantity: str, key: str, base: str, words: str, kind: str = "", **more: str | bool
) -> Band:
    """Band of a quantity whose ranges the solver states; of all kinds, or of ``kind``."""
    return Band(key, base, words, *RANGES[quantity].doubtful[kind], kind=kind, **more)  # type: ignore[arg-type]


def _by_kind(quantity: str, key: str, base: str, words: str, **more: str | bool) -> Iterator[Band]:
    """Bands of a quantity, one for each kind that has its own."""
    for kind in RANGES[quantity].doubtful:
        yield _doubtful(quantity, key, base, words, kind, **more)


def _arm(key: str, words: str, low: float, high: float) -> Band:
    return Band(f"crankshaft.arms.{key}", "D", f"{words}/D", low, high, zero=True)


def _mass(
    key: str, words: str, low: float, high: float, source: str = MEMORY, **more: str | bool
) -> Band:
    return Band(key, "F", f"{words}/F_п", low, high, source, "кг/м²", **more)  # type: ignore[arg-type]


def _counterweight(low: float, high: float, kind: str = "") -> Band:
    """Band of a web's counterweight, which balances the rods of a throw's pistons."""
    key, words = "crankshaft.webs.counterweight_kg", "m_пр/ΣF_п"
    return Band(key, "ΣF", words, low, high, unit="кг/м²", zero=True, kind=kind)


def _share(key: str, words: str, low: float, high: float, **more: bool) -> Band:
    return Band(f"balance.{key}", "", words, low, high, **more)  # type: ignore[arg-type]


def _cycle(key: str, words: str, low: float, high: float, unit: str = "", kind: str = "") -> Band:
    return Band(f"cycle.{key}", "", words, low, high, unit=unit, kind=kind)


DIESEL = _doubtful(*_RATIO, "diesel")
BANDS: tuple[Band, ...] = (
    *(_doubtful("pin", f"crankshaft.{key}", "D", "d_шш/D") for key in PIN_DIAMETERS),
    *(_doubtful("main", f"crankshaft.{key}", "D", "d_кш/D") for key in MAIN_DIAMETERS),
    _arm("l1_mm", "l_1", 0.065, 0.64),
    _arm("l2_mm", "l_2", 0.065, 0.64),
    _arm("l3_mm", "l_3", 0.04, 0.39),
    _arm("l4_mm", "l_4", 0.04, 0.39),
    _arm("l5_mm", "l_5", 0.065, 0.64),
    _arm("l6_mm", "l_6", 0.065, 0.64),
    _arm("left_web_mm", "h_Л", 0.06, 0.59),
    _arm("right_web_mm", "h_П", 0.06, 0.59),
    Band("crankshaft.nose_arm_mm", "D", "l_p1/D", 0.25, 2.45, zero=True),
    Band("crankshaft.rear_arm_mm", "D", "l_p2/D", 0.25, 2.45, zero=True),
    *_by_kind("piston_mass", "masses.piston_group_kg", "F", "m_п/F_п", **_AREA_MASS),
    *_by_kind("rod_mass", "masses.rod_kg", "F", "m_ш/F_п", **_AREA_MASS),
    *(
        _doubtful("reciprocating_mass", key, "F", f"{symbol}/F_п", **_AREA_MASS)
        for key, symbol in (
            ("masses.reciprocating_kg", "m_j"),
            ("articulated.reciprocating_kg", "m_jп"),
        )
    ),
    _mass("masses.rod_big_end_kg", "m_2", 46, 400, TABLE_4),
    _mass("crankshaft.pin_mass_kg", "m_ш.ш", 35, 340),
    _mass("crankshaft.webs.mass_kg", "m_щ", 26, 255, zero=True),
    _counterweight(42, 415),
    _counterweight(22, 215, kind="petrol"),
    _mass("crankshaft.nose_mass_kg", "m_вп1", 18, 175, zero=True),
    _mass("crankshaft.rear_mass_kg", "m_вп2", 18, 175, zero=True),
    _mass("articulated.big_end_kg", "m_2п", 40, 390, zero=True),
    Band("articulated.rod_length_mm", "L", "L_п/L", 0.4, 1.3),
    Band("articulated.radius_mm", "r", "ρ_п/r", 0.4, 2.5, zero=True),
    Band("masses.small_end_radius_mm", "D", "r_1/D", 0.07, 0.36, zero=True),
    Band("masses.swing_edges_mm", "L", "l_ш3/L", 0.7, 1.7),
    *(
        _doubtful(f"{part}_mass", f"masses.estimate_{part}_kg_per_m2", "", symbol, **_AREA_MASS)
        for part, symbol in (("piston", "m'_п"), ("rod", "m'_ш"), ("throw", "m'_к"))
    ),
    Band("masses.estimate_pin_share", "", "m_шш/m_к", 0.2, 0.8),
    *_by_kind(*_RATIO),
    _doubtful("offset", "geometry.crank_offset_mm", "r", "e_в/r", zero=True),
    Band("geometry.pin_offset_mm", "D", "e_п/D", 0.003, 0.029, zero=True),
    Band("regime.fullness", "", "φ_д", 0.85, 1),
    Band("gas.ambient_pressure_mpa", "", "p_0", 0.05, 0.2, unit="МПа"),
    Band("gas.intake_pressure_mpa", "", "p_a", 0.05, 0.49, unit="МПа"),
    _doubtful("compression.n_1", "gas.compression_exponent", "", "n_1"),
    _doubtful("expansion.n_2", "gas.expansion_exponent", "", "n_2"),
    Band("gas.preexpansion_ratio", "", "ρ", 1, 2.5),
    Band("gas.injection_advance_deg", "", "θ_оп", 4.6, 45, unit="°"),
    Band("gas.ignition_delay_deg", "", "Δφ_з", 2.5, 24, unit="°", zero=True),
    Band("gas.exhaust_start_before_bdc_deg", "", "φ_в1", 20, 100, unit="°"),
    Band("gas.exhaust_end_after_bdc_deg", "", "φ_в2", 9, 85, unit="°"),
    Band("gas.scavenge_start_before_bdc_deg", "", "φ_пр", 20, 90, unit="°"),
    Band("gas.intake_settle_deg", "", "φ_a'", 9, 85, unit="°"),
    Band("gas.tdc_rise", "", "p_c''/p_c", 1.02, 1.5),
    Band("gas.peak_share", "", "p_zд/p_z", 0.75, 1),
    Band("gas.peak_after_tdc_deg", "", "φ_zд", 4, 25, unit="°"),
    Band("gas.expansion_after_tdc_deg", "", "φ_j", 20, 75, unit="°"),
    _share("counterweight_share", "ε_п", 0.11, 1, zero=True),
    _share("first_shafts_share", "ψ_1", 0.11, 1, zero=True),
    _share("second_shafts_share", "ψ_2", 0.11, 1, zero=True),
    _share("suppression", "ψ", 0.11, 1.05, zero=True),
    Band("balance.shaft_radius_mm", "r", "e_б/r", 0.15, 1.45),
    _share("irregularity", "[δх]", 0.0025, 0.024),
    _doubtful("rod_share", "balance.rod_small_end_share", "", "m_1/m_ш"),
    _share("rod_mass_factor", "k_ш", 0.5, 1.3),
    _share("web_width_share", "b/D", 0.5, 2),
    _share("web_thickness_share", "h/D", 0.06, 0.5),
    Band("reference.lambdas", "", "λ", 0.1, 0.5),
    *_by_kind("inputs.excess_air", "cycle.excess_air", "", "α"),
    _cycle("ambient_temperature_k", "T_0", 250, 325, "К"),
    _doubtful("inputs.charge_heating", "cycle.charge_heating_k", "", "ΔT", unit="К"),
    _doubtful("inputs.t_residual", "cycle.residual_temperature_k", "", "T_r", unit="К"),
    _cycle("intake_factor", "C_a", 0.7, 1.05),
    _cycle("exhaust_factor", "C_r", 0.7, 1.4),
    _doubtful("inputs.recharge", "cycle.recharge", "", "φ_доз"),
    _doubtful("inputs.scavenging", "cycle.scavenging", "", "φ_оч"),
    _doubtful("combustion.p_z", "cycle.max_pressure_mpa", "", "p_z", "diesel", unit="МПа"),
    _doubtful("inputs.xi_z", "cycle.xi_z", "", "ξ_z"),
    _doubtful("inputs.xi_b", "cycle.xi_b", "", "ξ_b"),
    _doubtful("inputs.fullness", "cycle.fullness", "", "φ_д"),
    _cycle("h2_co_ratio", "K_H2", 0.3, 0.6),
    _cycle("friction_a_mpa", "A", 0.02, 0.19, "МПа"),
    _cycle("friction_b_mpa_s_m", "B", 0.004, 0.039, "МПа·с/м"),
    _cycle("boost_ratio", "π_к", 1.1, 5),
    _cycle("compressor_efficiency", "η_к", 0.5, 0.9),
    _cycle("turbine_efficiency", "η_т", 0.5, 0.9),
    Band("cycle.cooler_loss_mpa", "", "Δp_х", 0.0015, 0.0145, unit="МПа", zero=True),
    Band("cycle.cooler_drop_k", "", "ΔT_х", 10, 99, unit="К", zero=True),
    _cycle("turbine_outlet_ratio", "π_вых", 1, 1.2),
    _cycle("exhaust_heat_kj_kg_k", "c_pг", 1, 1.3, "кДж/(кг·К)"),
    _cycle("adaptability", "K", 1.02, 1.6),
    _doubtful("stroke_bore", "cycle.stroke_bore", "", "S/D"),
    _cycle("size_step_mm", "Δ", 0.5, 4.9, "мм"),
    Band("cycle.torque_speed_rpm", "n", "n_M/n", 0.3, 0.95),
    Band("cycle.idle_speed_rpm", "n", "n_х/n", 0.08, 0.5),
    Band("counterweight.inner_mm", "D", "R_пв1/D", 0.14, 1.3),
    Band("counterweight.outer_mm", "D", "R_пв2/D", 0.35, 3.4),
    Band("counterweight.width_mm", "D", "b_пв/D", 0.06, 0.59),
    Band("counterweight.skirt_mm", "D", "h_пор/D", 0.08, 0.75),
    Band("counterweight.density_kg_m3", "", "ρ_пв", 2500, 20000, unit="кг/м³"),
    Band("flywheel.outer_mm", "D", "D_м/D", 1.2, 11),
    Band("flywheel.disc_mm", "D", "h_м/D", 0.03, 0.29),
    Band("torsion.loss_factor", "", "η", 0.012, 0.11, zero=True),
    Band("torsion.shear_modulus_mpa", "", "G", 25000, 95000, unit="МПа"),
    Band("torsion.stress_allowed_mpa", "", "[τ]", 12, 110, unit="МПа"),
    Band("torsion.speed_min_rpm", "n", "n_min/n", 0.12, 1.1),
    Band("torsion.speed_max_rpm", "n", "n_max/n", 0.5, 2.5),
    Band("torsion.web_width_mm", "D", "b/D", 0.4, 3),
    Band("torsion.web_thickness_mm", "D", "h/D", 0.06, 0.59),
    *(
        Band(f"bearings.{part}_clearance_{end}_mm", "D", "Δ/D", low, 9.5 * low)
        for part in ("pin", "main")
        for end, low in (("min", 0.0002), ("max", 0.0004))
    ),
    *(
        Band(f"bearings.{part}_um", "", "высота", 0.25, 2.4, unit="мкм", zero=True)
        for part in ("journal_roughness", "shell_roughness", "form")
    ),
    Band("bearings.supply_mpa", "", "давление масла", 0.12, 0.95, unit="МПа"),
    Band("bearings.viscosity_40_mpa_s", "", "η_40", 25, 240, unit="мПа·с"),
    Band("bearings.viscosity_100_mpa_s", "", "η_100", 3, 28, unit="мПа·с"),
    Band("bearings.reserve_allowed", "", "[K_h]", 1, 9),
    Band("bearings.torsion_limit_mpa", "", "τ_−1", 60, 580, unit="МПа"),
    Band("bearings.mean_bending", "", "ψ_σ", 0.04, 0.38, zero=True),
    Band("bearings.mean_torsion", "", "ψ_τ", 0.02, 0.19, zero=True),
    Band("bearings.sensitivity", "", "q", 0.2, 1, zero=True),
    Band("bearings.fillet_mm", "D", "ρ_г/D", 0.012, 0.115),
    *(
        Band(f"{section}.{part}_bore_mm", "D", "отверстие/D", 0.07, 0.69, zero=True)
        for section in ("bearings", "torsion")
        for part in ("pin", "main")
    ),
    Band("bearings.hole_mm", "D", "d_м/D", 0.015, 0.14),
    Band("bearings.supply_c", "", "температура масла", 40, 120, unit="°C"),
    Band("torsion.peaks.speed_rpm", "n", "n/n_ном", 0.16, 1.55),
    Band("torsion.peaks.pressure_mpa", "", "наибольшее давление", 2.6, 25, unit="МПа"),
)

# Values that follow from more than one key; `plausibility` says from which.
SIZES = _doubtful("stroke_bore", "geometry", "", "S/D")
LAMBDA = _doubtful("lam", "geometry.lambda", "", "λ")
OFFSET = Band("geometry.crank_offset_mm", "", "e/r", *RANGES["offset"].of())
SMALL_END = Band(
    "masses.rod_small_end_share", "", "m_1/m_ш", *RANGES["rod_share"].of(), "Гоц, п. 2.2"
)
ROD_INERTIA = Band("masses.rod_inertia_kg_m2", "", "I_ш/(m_ш·l²)", 0.05, 0.45)
LARGE_SIZES = Band("geometry", "", "S/D", *RANGES["stroke_bore"].doubtful["crosshead"])
SPEED = _doubtful(
    "piston_speed", "regime.speed_rpm", "", "средняя скорость поршня Sn/30", unit="м/с"
)
LOWER_SPEED = Band("regimes.speed_rpm", "", "частота вращения к номинальной", 0.12, 1.19)
PIN_LENGTH = _doubtful("pin_length", "crankshaft.pin_length_mm", "", "l_шш/d_шш под шатуном")
MAIN_LENGTH = Band("crankshaft.main_lengths_mm", "", "l_к.ш/d_к.ш", 0.2, 1.6)
MAIN_TO_PIN = Band("crankshaft.main_diameter_mm", "", "d_кш/d_шш", 0.97, 1.75)
REDUCED_WEB = Band("crankshaft.webs.centre_mm", "F", "m_щ·ρ/r/F_п", 26, 255, unit="кг/м²")
EFFICIENCY = _doubtful("effective.eta_m", "regime.mechanical_efficiency", "", "η_м")
RESIDUAL = Band("gas.residual_pressure_mpa", "", "p_r/p_a", 0.5, 4)
RISE = Band("gas.max_pressure_mpa", "", "p_z/p_c", 0.6, 5.5)
POWER = Band("regime.indicated_power_kw", "", "N_i к работе диаграммы", 0.4, 2.5)
MEAN_PRESSURE = Band("gas.max_pressure_mpa", "", "p_i диаграммы", 0.2, 3.5, unit="МПа")
MEAN_PRESSURE_OF_POWER = Band("regime.indicated_power_kw", "", "p_i по N_i", 0.3, 2.9, unit="МПа")
POINTS = _doubtful("combustion.p_z", "gas.points", "", "наибольшее давление", unit="МПа")
MIN_POINT = Band("gas.points", "", "наименьшее давление", 0.02, 0.4, unit="МПа")
TRACE_COMPRESSION = _doubtful("compression.n_1", "gas.points", "", "показатель сжатия по точкам")
TRACE_EXPANSION = Band("gas.points", "", "показатель расширения по точкам", 1.0, 1.6)
THROW_INERTIA = Band("torsion.throws_kg_m2", "", "J/(F_п r²) на шатун", 200, 1950, unit="кг/м²")
THROW_STIFFNESS = Band("torsion.throws_nm_rad", "", "c к гладкому валу коренных шеек", 0.26, 2.5)
DAMPING = Band("torsion.damping_nms_rad", "", "b/(F_п r²)", 12, 118, unit="кН·с/м³")


def band_of(key: str) -> Band:
    """First band of a key."""
    return next(band for band in BANDS if band.key == key)


def stated_kind(model: InputFile) -> str:
    """Kind of engine that the file states, else an empty text."""
    if model.cycle is not None:
        return model.cycle.kind
    stated = getattr(model.gas, "kind", None) or model.masses.estimate_fuel or _kind_of_parts(model)
    if stated:
        return str(stated)
    name = model.engine.name.lower()
    named = [kind for kind, words in _WORDS.items() if any(word in name for word in words)]
    return named[0] if len(named) == 1 else ""


def _kind_of_parts(model: InputFile) -> str:
    """Kind that the strength of the parts is calculated for, where the file says it."""
    section = model.strength
    return section.kind if section is not None and "kind" in section.model_fields_set else ""


def with_kind(model: InputFile) -> InputFile:
    """Return the input, its parts of the kind of engine that it states elsewhere."""
    section, kind = model.strength, stated_kind(model)
    if section is None or not kind or "kind" in section.model_fields_set:
        return model
    return model.model_copy(update={"strength": section.model_copy(update={"kind": kind})})


def diesel_rho(model: InputFile) -> float:
    """ρ of the diagram where it alone implies a diesel, else 0."""
    rho = float(getattr(model.gas, "preexpansion_ratio", None) or 0)
    return rho if rho >= _DIESEL_RHO and not stated_kind(model) else 0.0
