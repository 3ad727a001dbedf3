"""Checks of the [cycle] section: which keys go together."""

from __future__ import annotations

from collections.abc import Iterator

from reports.inputs.findings import Finding, Values
from reports.inputs.sections.cycle import BOOST, BOOST_EXTRA, OWN_FUEL

_DESIGN = ("stroke_bore", "size_step_mm", "rounding")


def check_cycle(values: Values) -> Iterator[Finding]:
    """Yield what is missing or superfluous between [cycle], [gas], [geometry], [regime]."""
    source, given = values.get("gas", "source"), "cycle" in values.sections
    if source == "cycle" and not given and "cycle" not in values.unsure:
        hint = "добавьте раздел [cycle] или выберите другой gas.source"
        yield Finding(("cycle",), "нет раздела, а gas.source = cycle", hint)
    if not given:
        return
    if source is not None and source != "cycle":
        what = f"задан расчёт цикла, а gas.source = {source}"
        yield Finding(("gas", "source"), what, "запишите source = cycle или уберите [cycle]")
    if values.get("regime", "indicated_power_kw") is not None:
        what = "индикаторная мощность следует из расчёта цикла"
        yield Finding(("regime", "indicated_power_kw"), what, "уберите ключ")
    if values.get("regime", "fullness") not in (None, 1.0):
        what = "полнота диаграммы при расчёте цикла задаётся в cycle.fullness"
        yield Finding(("regime", "fullness"), what, "уберите ключ")
    for key in ("crank_offset_mm", "pin_offset_mm"):
        if values.get("geometry", key):
            what = "расчёт цикла ведётся для центрального механизма"
            yield Finding(("geometry", key), what, "уберите ключ или задайте давления газов сами")
    yield from _engine(values)
    yield from _groups(values)


def _has(values: Values, key: str) -> bool:
    return values.get("cycle", key) is not None or ("cycle", key) in values.broken


def _together(
    values: Values, why: str, wanted: bool, needed: tuple[str, ...], extra: tuple[str, ...] = ()
) -> Iterator[Finding]:
    """All of ``needed`` when wanted; none of them, nor of ``extra``, when not."""
    for key in (*needed, *extra):
        if wanted and key in needed and not _has(values, key):
            yield Finding(("cycle", key), f"обязательный ключ не задан ({why})", "добавьте его")
        elif not wanted and _has(values, key):
            yield Finding(("cycle", key), f"лишний ключ: {why}", "уберите его")


def _engine(values: Values) -> Iterator[Finding]:
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


def _groups(values: Values) -> Iterator[Finding]:
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
            what = "заданы и механический КПД, и потери A + B·c_m"
            yield Finding(("regime", "mechanical_efficiency"), what, "оставьте одно из двух")
    if _has(values, "adaptability") and not _has(values, "torque_speed_rpm"):
        what = "обязательный ключ не задан (задан K = adaptability)"
        yield Finding(("cycle", "torque_speed_rpm"), what, "добавьте частоту n_M")
