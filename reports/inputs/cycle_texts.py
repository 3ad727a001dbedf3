"""The words for what the cycle calculation says of its inputs."""

from __future__ import annotations

from kshm.cycle.errors import Remark
from kshm.nomenclature.quantity import quantity
from reports.inputs import units
from reports.inputs.findings import Path
from reports.inputs.meta import Meta, Strictly, hints
from reports.inputs.sections.cycle import CycleSection
from reports.inputs.sections.gas import CycleGasSection
from reports.inputs.sections.input_file import EngineSection, GeometrySection, RegimeSection
from reports.shared.russian import short

# Inputs of the solver → keys of the file, where the names differ.
_PATHS: dict[str, Path] = {
    "omega": ("regime", "speed_rpm"),
    "cylinders": ("engine", "cylinders"),
    "strokes": ("engine", "strokes"),
    "compression_ratio": ("geometry", "compression_ratio"),
    "bore": ("geometry", "bore_mm"),
    "stroke": ("geometry", "stroke_mm"),
    "lam": ("geometry", "lambda"),
    "p_ambient": ("gas", "ambient_pressure_mpa"),
    "mechanical": ("regime", "mechanical_efficiency"),
    "mechanical.a": ("cycle", "friction_a_mpa"),
    "mechanical.b": ("cycle", "friction_b_mpa_s_m"),
    "charge_heating": ("cycle", "charge_heating_k"),
    "t_residual": ("cycle", "residual_temperature_k"),
    "t_ambient": ("cycle", "ambient_temperature_k"),
    "p_max": ("cycle", "max_pressure_mpa"),
    "h2_co": ("cycle", "h2_co_ratio"),
    "boost.pressure_ratio": ("cycle", "boost_ratio"),
    "boost.compressor_efficiency": ("cycle", "compressor_efficiency"),
    "boost.turbine_efficiency": ("cycle", "turbine_efficiency"),
    "boost.cooler_pressure_loss": ("cycle", "cooler_loss_mpa"),
    "boost.cooler_temperature_drop": ("cycle", "cooler_drop_k"),
    "boost.outlet_pressure_ratio": ("cycle", "turbine_outlet_ratio"),
    "boost.exhaust_cp": ("cycle", "exhaust_heat_kj_kg_k"),
    "power": ("cycle", "power_kw"),
    "step": ("cycle", "size_step_mm"),
    "speed_ratio": ("cycle", "torque_speed_rpm"),
    "omega_torque": ("cycle", "torque_speed_rpm"),
    "omega_idle": ("cycle", "idle_speed_rpm"),
}

# "{name:unit}" is a number in that unit of `reports.inputs.units`, "{name}" one in SI.
TEXTS = {
    "too_hot": "T_z = {t_z} К неправдоподобно; уменьшите ξ_z или H_u",
    "friction_eats_all_sizes": "механические потери больше индикаторной работы при "
    "c_m = {speed} м/с; уменьшите частоту вращения, S/D или потери",
    "stroke_not_found": "S: подбор хода не сходится; уменьшите мощность на цилиндр или "
    "частоту вращения",
    "bore_too_small": "N_e = {power:KW} кВт требует D = {bore:MM} мм, допускается от {low:MM} до "
    "{high:MM} мм; увеличьте мощность или уменьшите число цилиндров",
    "bore_too_large": "N_e = {power:KW} кВт требует D = {bore:MM} мм, допускается от {low:MM} до "
    "{high:MM} мм; увеличьте число цилиндров, частоту вращения или наддув",
    "diagram_needs_stroke": "S: для индикаторной диаграммы задайте ход поршня",
    "step_must_divide": "шаг диаграммы {step}°: задайте делитель числа 180",
    "listing_is_for_turbo_diesels": "режим распечатки воспроизводит только дизель с "
    "турбонаддувом; отключите его",
    "fuel_shares": "состав топлива: доли C, H, O должны лежать от 0 до 1; исправьте доли",
    "fuel_total": "состав топлива: C + H + O = {total}, а должно быть 1; исправьте доли",
    "fuel_oxygen": "состав топлива: кислорода хватает без воздуха; уменьшите долю O",
    "fuel_heat": "H_u = {value:MJ_KG} МДж/кг: допускается от 5 до 130; проверьте единицы",
    "fuel_molar_mass": "m_т = {value} кг/кмоль: допускается от 2 до 1000",
    "air_too_little": "α = {value}: воздуха не хватает даже на неполное сгорание; увеличьте α",
    "cooled_too_far": "ΔT_х: за охладителем T_к = {t_k} К; уменьшите ΔT_х",
    "cooler_loss_too_large": "Δp_х: за охладителем p_к = {p_k:MPA} МПа; уменьшите Δp_х",
    "hardly_filled": "η_v = {eta_v}: цилиндр почти не наполняется; увеличьте C_1 или уменьшите C_2",
    "n1_not_found": "n_1: расчёт показателя сжатия не сходится; уменьшите ε или ΔT",
    "p_max_below_compression": "p_z = {p_max:MPA} МПа не выше давления конца сжатия "
    "p_c = {p_c:MPA} МПа; увеличьте p_z или уменьшите ε",
    "p_max_too_high": "p_z = {p_max:MPA} МПа слишком велико (ρ < 1); уменьшите p_z, наибольшее "
    "возможное {largest:MPA} МПа, или уменьшите α",
    "burning_too_long": "ρ = {rho}: сгорание занимает треть хода и больше; увеличьте p_z или α",
    "n2_not_found_heat_lost": "n_2: показатель расширения не сходится к числу от {low} до {high}; "
    "увеличьте ξ_b или уменьшите ξ_z",
    "n2_not_found_heat_added": "n_2: показатель расширения не сходится к числу от {low} до "
    "{high}; уменьшите ξ_b",
    "no_work": "p_i = {p_i:MPA} МПа: цикл не даёт работы; увеличьте ξ_z или уменьшите α",
    "sizes_missing": "D и S: задайте диаметр и ход или мощность для подбора размеров",
    "friction_eats_all": "p_м = {p_m:MPA} МПа не меньше p_i = {p_i:MPA} МПа: двигатель не даёт "
    "мощности; уменьшите механические потери или частоту вращения",
    "adaptability_off": "K = {k}: допускается больше 1 и до 2; исправьте K",
    "speed_ratio_off": "K_c = {k_c}: допускается от 0,3 до 0,95; исправьте частоту n_M",
    "torque_vanishes": "K = {k} и K_c = {k_c}: момент на малых частотах вращения исчезает; "
    "уменьшите K или K_c",
    "speeds_do_not_rise": "частоты вращения: холостой ход {idle:RPM}, наибольший момент "
    "{torque:RPM}, номинал {rated:RPM} мин⁻¹ должны возрастать; исправьте их",
    "kind_unknown": "вид двигателя неизвестен; выберите diesel или petrol",
    "four_strokes_only": "τ = {strokes}: рассчитывается только четырёхтактный цикл; задайте τ = 4",
    "central_only": "дезаксаж: цикл рассчитывается для центрального механизма; задайте 0",
    "cylinders_not_whole": "i = {cylinders}: число цилиндров целое; исправьте i",
    "diesel_needs_p_max": f"p_z: для дизеля задайте {quantity('cyc_p_z').title}",
    "petrol_has_no_p_max": "p_z: у двигателя с искровым зажиганием оно получается из расчёта; "
    "уберите его",
    "residual_temperature_off": "T_r = {given} К расходится с проверкой T_b/(p_b/p_r)^(1/3) = "
    "{check} К на {gap:PERCENT} %; задайте T_r ближе к {check} К",
    "heat_capacity_extended": "T_z = {t_z} К выше 2800 °C: формулы теплоёмкостей продолжены за "
    "свой предел",
    "turbine_too_weak": "мощность турбины {turbine:KW} кВт меньше мощности компрессора "
    "{compressor:KW} кВт; увеличьте C_2 примерно до {balance} или КПД агрегата",
}
_REASONS = {
    "out_of_range": "",
    "diesel_smokes": " (дизель при α < 1 дымит и этим методом не считается)",
    "petrol_knocks": " (двигатель с искровым зажиганием при такой ε детонирует)",
}


_SECTIONS: dict[str, type[Strictly]] = {
    "engine": EngineSection,
    "geometry": GeometrySection,
    "regime": RegimeSection,
    "gas": CycleGasSection,
    "cycle": CycleSection,
}


class _Shown(float):
    """A number whose format specification names its unit."""

    def __format__(self, unit: str) -> str:
        return short(getattr(units, unit).from_si(float(self)) if unit else float(self), 4)


def path_of(field: str) -> Path:
    """Key of the file behind an input of the cycle; other names are keys of [cycle]."""
    return _PATHS.get(field, ("cycle", field))


def text_of(remark: Remark) -> str:
    """One Russian line: what is wrong and, after a semicolon, what to change."""
    if remark.key in _REASONS:
        return _out_of_range(remark)
    numbers = {name: _Shown(value) for name, value in remark.numbers.items()}
    return TEXTS[remark.key].format_map(numbers)


def _out_of_range(remark: Remark) -> str:
    meta = _meta(path_of(remark.field))
    low, value, high = (remark.numbers[name] for name in ("low", "value", "high"))
    verb = "увеличьте" if value < low else "уменьшите" if value > high else "задайте число:"
    shown = [short(meta.unit.from_si(number), 4) for number in (value, low, high)]
    label = f" {meta.unit.label}" if meta.unit.label else ""
    return (
        f"{meta.symbol} = {shown[0]}{label}: допускается от {shown[1]} до {shown[2]}; "
        f"{verb} {meta.symbol}{_REASONS[remark.key]}"
    )


def _meta(path: Path) -> Meta:
    """What a person is told about a key of any of the section's models."""
    return hints(_SECTIONS[str(path[0])])[str(path[1])].metas[0]
