"""Checks of the input's fields against each other.

Each check sees the valid fields of a possibly broken file (`Values`), so that
all errors are found at once; it keeps silent about what it cannot judge.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from reports.inputs.checks.bands import LAMBDA
from reports.inputs.checks.bearings import check_bearings
from reports.inputs.checks.gas import check_gas
from reports.inputs.checks.layout import check_layout
from reports.inputs.checks.masses import check_masses
from reports.inputs.checks.pairs import PAIRS, check_pair
from reports.inputs.checks.torsion import check_torsion
from reports.inputs.fields import Path
from reports.inputs.findings import Finding, ValidValues, check_accepted, radius_and_rod
from reports.inputs.sections.gas import BOOST, BOOST_EXTRA, OWN_FUEL
from reports.inputs.sections.input_file import LAMBDA_MAX, LAMBDA_MIN
from reports.inputs.sections.report import MAX_LAMBDAS
from reports.inputs.units import is_within, number_text, span_text

_DESIGN = ("stroke_bore", "size_step_mm", "rounding")
LENGTH_TOLERANCE = 1e-3
Check = Callable[[ValidValues], Iterator[Finding]]


def check_cycle(values: ValidValues) -> Iterator[Finding]:
    """Yield missing and superfluous keys of [cycle], [gas], [geometry], [regime]."""
    source, has_cycle = values.get("gas", "source"), "cycle" in values.sections
    if source == "cycle" and not has_cycle and "cycle" not in values.unsure:
        hint = "добавьте раздел [cycle] или выберите другой gas.source"
        yield Finding(("cycle",), "нет раздела, а gas.source = cycle", hint)
    if not has_cycle:
        return
    if source is not None and source != "cycle":
        problem = f"задан расчёт цикла, а gas.source = {source}"
        yield Finding(("gas", "source"), problem, "запишите source = cycle или уберите [cycle]")
    if values.get("regime", "indicated_power_kw") is not None:
        problem = "индикаторная мощность следует из расчёта цикла"
        yield Finding(("regime", "indicated_power_kw"), problem, "уберите ключ")
    if values.get("regime", "fullness") not in (None, 1.0):
        problem = "полнота диаграммы при расчёте цикла задаётся в cycle.fullness"
        yield Finding(("regime", "fullness"), problem, "уберите ключ")
    for key in ("crank_offset_mm", "pin_offset_mm"):
        if values.get("geometry", key):
            problem = "расчёт цикла ведётся для центрального механизма"
            yield Finding(
                ("geometry", key), problem, "уберите ключ или задайте давления газов сами"
            )
    yield from _engine(values)
    yield from _groups(values)


def _has(values: ValidValues, key: str) -> bool:
    return values.get("cycle", key) is not None or ("cycle", key) in values.broken


def _together(
    values: ValidValues,
    why: str,
    required: bool,
    needed: tuple[str, ...],
    extra: tuple[str, ...] = (),
) -> Iterator[Finding]:
    """All of ``needed`` when wanted; none of them, nor of ``extra``, when not."""
    for key in (*needed, *extra):
        if required and key in needed and not _has(values, key):
            yield Finding(("cycle", key), f"обязательный ключ не задан ({why})", "добавьте его")
        elif not required and _has(values, key):
            yield Finding(("cycle", key), f"лишний ключ: {why}", "уберите его")


def _engine(values: ValidValues) -> Iterator[Finding]:
    kind = values.get("cycle", "kind")
    if kind == "diesel":
        yield from _together(values, "для дизеля p_z задаётся", True, ("max_pressure_mpa",))
        yield from _together(
            values, "нужен только двигателю с искровым зажиганием", False, (), ("h2_co_ratio",)
        )
    elif kind == "petrol":
        why = "у двигателя с искровым зажиганием p_z получается из расчёта"
        yield from _together(values, why, False, (), ("max_pressure_mpa",))
    fuel = values.get("cycle", "fuel")
    if fuel == "own":
        needed = OWN_FUEL if kind == "diesel" else (*OWN_FUEL, "fuel_molar_mass_kg_kmol")
        yield from _together(values, "fuel = own", True, needed)
    elif fuel is not None:
        why = "состав задаётся только при fuel = own"
        yield from _together(values, why, False, (), (*OWN_FUEL, "fuel_molar_mass_kg_kmol"))


def _groups(values: ValidValues) -> Iterator[Finding]:
    design, boost = _has(values, "power_kw"), _has(values, "boost_ratio")
    why = "задана мощность power_kw" if design else "нужен только вместе с power_kw"
    yield from _together(values, why, design, ("stroke_bore",), _DESIGN[1:])
    why = "задан наддув boost_ratio" if boost else "нужен только вместе с boost_ratio"
    yield from _together(values, why, boost, BOOST, BOOST_EXTRA)
    law = _has(values, "friction_a_mpa") or _has(values, "friction_b_mpa_s_m")
    if law:
        keys = ("friction_a_mpa", "friction_b_mpa_s_m")
        yield from _together(values, "потери A + B·c_m", True, keys)
        if values.get("regime", "mechanical_efficiency") not in (None, 1.0):
            problem = "заданы и механический КПД, и потери A + B·c_m"
            yield Finding(("regime", "mechanical_efficiency"), problem, "оставьте одно из двух")
    if _has(values, "adaptability") and not _has(values, "torque_speed_rpm"):
        problem = "обязательный ключ не задан (задан K = adaptability)"
        yield Finding(("cycle", "torque_speed_rpm"), problem, "добавьте частоту n_M")


def check_reference(values: ValidValues) -> Iterator[Finding]:
    """Yield errors in the list of λ."""
    count = values.counts.get(("reference", "lambdas"))
    if count is not None and not 1 <= count <= MAX_LAMBDAS:
        problem = f"значений {count}, а нужно от 1 до {MAX_LAMBDAS}"
        yield Finding(("reference", "lambdas"), problem, "исправьте список")


def _geometry(values: ValidValues) -> Iterator[Finding]:
    keys = ("crank_radius_mm", "stroke_mm", "rod_length_mm", "lambda")
    if not values.sure("geometry", *keys):
        return
    if "crank_radius_mm" not in values.sections["geometry"]:  # sizes follow from the power
        lam = values.get("geometry", "lambda")
        yield from () if lam is None else _ratio(lam, ("geometry", "lambda"))
        return
    radius, stroke, rod, lam = (values.get("geometry", key) for key in keys)
    if radius is not None and stroke is not None and abs(stroke - 2 * radius) > 1e-9 * stroke:
        problem = f"ход {number_text(stroke)} мм не равен 2r = {number_text(2 * radius)} мм"
        yield Finding(("geometry", "stroke_mm"), problem, "оставьте один из двух ключей")
        return
    pair = radius_and_rod(values)
    if pair is None:
        problem = "размеров недостаточно: нужны любые два из crank_radius_mm (или stroke_mm), "
        yield Finding(("geometry",), problem + "rod_length_mm, lambda", "добавьте недостающий ключ")
        return
    r, rod_length = pair
    ratio = r / rod_length
    stated_radius = radius if radius is not None else None if stroke is None else stroke / 2
    if None not in (stated_radius, rod, lam) and abs(ratio - lam) > LENGTH_TOLERANCE * lam:
        problem = f"λ = {number_text(lam)} не согласуется с r/L = {number_text(round(ratio, 6))}"
        yield Finding(("geometry", "lambda"), problem, "оставьте любые два из r, L, λ")
        return
    yield from _ratio(ratio, ("geometry", "lambda" if lam is not None else "rod_length_mm"))


def _ratio(ratio: float, path: Path) -> Iterator[Finding]:
    text = number_text(round(ratio, 6))
    if ratio >= 1:
        return
    if not LAMBDA_MIN <= ratio <= LAMBDA_MAX:
        problem = f"λ = r/L = {text} вне допустимых пределов"
        yield Finding(path, problem, f"допустимо λ {span_text(LAMBDA_MIN, LAMBDA_MAX)}")
    elif not is_within(ratio, LAMBDA.span):
        problem = f"λ = {text} необычно"
        yield Finding(path, problem, LAMBDA.usual, warning=True)


def _arms(values: ValidValues) -> Iterator[Finding]:
    for index, arms in enumerate(values.get("crankshaft", "arms") or ()):
        lengths = (arms.l1_mm, arms.l2_mm, arms.l3_mm, arms.l4_mm, arms.l5_mm, arms.l6_mm)
        left = arms.l1_mm + arms.l2_mm + arms.left_web_mm
        right = arms.l5_mm + arms.l6_mm + arms.right_web_mm
        if left <= 0 or right <= 0:
            whole = number_text(sum(lengths))
            problem = f"длина колена с одной стороны шатуна равна нулю (сумма плеч {whole})"
            hint = "задайте l1, l2 и l5, l6 больше нуля"
            yield Finding(("crankshaft", "arms", index), problem, hint)


CHECKS: tuple[Check, ...] = (
    _geometry, *(partial(check_pair, pair) for pair in PAIRS), check_layout, _arms, check_masses,
    check_gas, check_cycle, check_torsion, check_bearings, check_reference, check_accepted,
)  # fmt: skip


def check(values: ValidValues) -> Iterator[Finding]:
    """Yield all contradictions between fields, errors and warnings."""
    for each in CHECKS:
        yield from each(values)
