"""From the [cycle] section to the solver's cycle; its remarks in Russian by keys of the file."""

from __future__ import annotations

import functools
from dataclasses import replace
from typing import Any

from kshm.cycle.cycle import CycleRun, Wanted, run_cycle
from kshm.cycle.fuel import FUELS, Fuel
from kshm.cycle.governor import Governor
from kshm.cycle.inputs import Boost, CycleInputs, FrictionLaw
from kshm.cycle.speed_characteristic import LEIDERMAN, Leiderman, from_adaptability
from kshm.errors import CycleError, Remark
from kshm.nomenclature.quantity import quantity
from reports.inputs import units
from reports.inputs.fields import Path
from reports.inputs.findings import Finding
from reports.inputs.meta import Meta, StrictModel, hints, solver_name, solver_values
from reports.inputs.sections.gas import BOOST, CycleGasSection, CycleSection
from reports.inputs.sections.input_file import (
    EngineSection,
    GeometrySection,
    InputFile,
    RegimeSection,
)
from reports.inputs.to_si.masses import crank_radius_mm, rod_length_mm
from reports.inputs.units import MM, RPM
from reports.shared.russian import short

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
    "governor_off": "степень неравномерности регулятора и доля топлива на холостом ходу: нужны "
    "числа от 0 до 1",
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


_SECTIONS: dict[str, type[StrictModel]] = {  # of two that have a name the first
    "cycle": CycleSection,
    "engine": EngineSection,
    "geometry": GeometrySection,
    "regime": RegimeSection,
    "gas": CycleGasSection,
}


@functools.cache
def _paths() -> dict[str, Path]:
    """Key of the file by the solver's name of the input."""
    paths: dict[str, Path] = {
        "mechanical": ("regime", "mechanical_efficiency"),
        "speed_ratio": ("cycle", "torque_speed_rpm"),
    }
    for name, model in _SECTIONS.items():
        for key, spec in hints(model).items():
            for meta in spec.metas[:1]:
                paths.setdefault(solver_name(key, meta), (name, key))
    return paths


class _Shown(float):
    """A number whose format specification names its unit."""

    def __format__(self, unit: str) -> str:
        return short(getattr(units, unit).from_si(float(self)) if unit else float(self), 4)


def path_of(field: str) -> Path:
    """Key of the file behind an input of the cycle; other names are keys of [cycle]."""
    return _paths().get(field, ("cycle", field))


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
    numbers = [short(meta.unit.from_si(number), 4) for number in (value, low, high)]
    label = f" {meta.unit.label}" if meta.unit.label else ""
    return (
        f"{meta.symbol} = {numbers[0]}{label}: допускается от {numbers[1]} до {numbers[2]}; "
        f"{verb} {meta.symbol}{_REASONS[remark.key]}"
    )


def _meta(path: Path) -> Meta:
    """Metadata of a key."""
    return hints(_SECTIONS[str(path[0])])[str(path[1])].metas[0]


def cycle_run(model: InputFile) -> CycleRun | None:
    """Cycle calculation behind an input's gas forces, None without one.

    Raises:
        CycleError: no cycle follows from the input.
    """
    section = model.cycle
    if section is None or not isinstance(model.gas, CycleGasSection):
        return None
    target = None
    if section.power_kw is not None and section.stroke_bore is not None:
        target = Wanted(**solver_values(section, Wanted))
    return run_cycle(
        cycle_inputs(model, section, model.gas),
        target,
        speed_law(model, section),
        omega_torque=RPM.given(section.torque_speed_rpm),
        omega_idle=RPM.given(section.idle_speed_rpm),
        governor=Governor(**solver_values(section, Governor, "governor")),
    )


def size_step_mm(section: CycleSection) -> float:
    """Step of the series of bores and strokes [mm], 1 mm unless given."""
    return 1.0 if section.size_step_mm is None else float(section.size_step_mm)


def cycle_inputs(model: InputFile, section: CycleSection, gas: CycleGasSection) -> CycleInputs:
    """Return the solver's inputs in SI; bore and stroke stay open when a power is wanted."""
    geometry = model.geometry
    values: dict[str, Any] = {}
    for part in (model.engine, geometry, model.regime, gas, section):
        values |= solver_values(part, CycleInputs)
    if isinstance(geometry, GeometrySection):
        radius, rod = crank_radius_mm(geometry), rod_length_mm(geometry)
        values |= {"stroke": 2 * MM.to_si(radius), "lam": radius / rod}
    mechanical: float | FrictionLaw = float(model.regime.mechanical_efficiency)
    if section.friction_a_mpa is not None:
        law = {"a": 0.0, "b": 0.0} | solver_values(section, FrictionLaw, "mechanical")
        mechanical = FrictionLaw(**law)
    composed = {
        "fuel": fuel_of(section),
        "mechanical": mechanical,
        "boost": _boost(section),
        "cylinders": model.engine.cylinders,
        "subtract_pumping": section.pumping == "yes",
    }
    return CycleInputs(**values | composed)


def fuel_of(section: CycleSection) -> Fuel:
    """Return a fuel of the list or of the file's own composition."""
    if section.fuel != "own":
        return FUELS[section.fuel]
    usual = dict.fromkeys(("carbon", "hydrogen", "oxygen", "heating_value"), 0.0)
    usual |= {"vapour_molar_mass": 100.0}
    return Fuel(**usual | solver_values(section, Fuel, "fuel"), source="input")


def _boost(section: CycleSection) -> Boost | None:
    if section.boost_ratio is None:
        return None
    return Boost(**dict.fromkeys(BOOST, 0.0) | solver_values(section, Boost, "boost"))


def speed_law(model: InputFile, section: CycleSection) -> Leiderman:
    """Coefficients of the external speed characteristic.

    Raises:
        CycleError: K and n_M that no characteristic has.
    """
    base = LEIDERMAN[section.speed_law or section.kind]
    if section.adaptability is None or section.torque_speed_rpm is None:
        return base
    ratio = section.torque_speed_rpm / model.regime.speed_rpm
    return from_adaptability(float(section.adaptability), ratio, base)


def cycle_and_findings(model: InputFile) -> tuple[CycleRun | None, list[Finding]]:
    """Cycle calculation, and its error or remarks as findings."""
    try:
        run = cycle_run(model)
    except CycleError as error:
        return None, [_finding(error.remark)]
    if run is None:
        return None, []
    return run, [
        replace(_finding(remark), path=("cycle",), warning=True) for remark in run.cycle.warnings
    ]


def _finding(remark: Remark) -> Finding:
    problem, _, hint = text_of(remark).partition("; ")
    return Finding(path_of(remark.field), problem, hint)
