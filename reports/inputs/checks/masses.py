"""Checks of the [masses] section: one way at a time, usual values."""

from __future__ import annotations

import math
from collections.abc import Iterator

from reports.inputs.checks.bands import ROD_INERTIA, SMALL_END
from reports.inputs.findings import Finding, ValidValues, radius_and_rod
from reports.inputs.sections.mechanism import ESTIMATE_EXTRA, SWUNG, WEIGHED
from reports.inputs.units import is_within, number_text

DIRECT = ("reciprocating_kg", "rod_big_end_kg")
PARTS = ("piston_group_kg", "rod_kg")
CENTRE = ("rod_centre_mm", "rod_small_end_share")
_REST = (*WEIGHED, *SWUNG, "rod_inertia_kg_m2", "estimate_fuel", *ESTIMATE_EXTRA)
_ADVICE = (
    "задайте либо reciprocating_kg и rod_big_end_kg, "
    "либо piston_group_kg, rod_kg и одно из rod_centre_mm, rod_small_end_share"
)
_MORE = "; ещё способы: взвешивание, качания, оценка estimate_fuel"
_GRAVITY_MM = 9810.0


def check_masses(values: ValidValues) -> Iterator[Finding]:
    """Yield errors and oddities of the masses."""
    yield from _webs(values)
    keys = (*DIRECT, *PARTS, *CENTRE, *_REST)
    if not values.sure("masses", *keys):
        return
    stated = {key for key in keys if values.get("masses", key) is not None}
    wrong = list(_ways(stated))
    yield from wrong
    if wrong:
        return
    yield from _shaft_masses(values, estimated="estimate_fuel" in stated)
    if "estimate_fuel" in stated:
        yield from _estimated(values, stated)
    yield from _centre(values)
    yield from _swung(values)
    yield from _inertia(values)


def _ways(stated: set[str]) -> Iterator[Finding]:
    """Whether the keys belong to one way and are complete."""
    path = ("masses",)
    others = stated - set(DIRECT)
    centres = [
        name
        for name, keys in (
            *((key, (key,)) for key in CENTRE),
            ("взвешивание", WEIGHED),
            ("качания", SWUNG),
        )
        if stated & set(keys)
    ]
    estimate = "estimate_fuel" in stated
    if stated & set(DIRECT) and others - {"estimate_fuel", *ESTIMATE_EXTRA}:
        yield Finding(path, "смешаны два способа задания масс", _ADVICE)
    elif not estimate and stated & set(ESTIMATE_EXTRA):
        key = sorted(stated & set(ESTIMATE_EXTRA))[0]
        yield Finding((*path, key), "ключ нужен только при оценке", "добавьте estimate_fuel")
    elif len(centres) > 1:
        yield Finding(path, f"заданы и {centres[0]}, и {centres[1]}", _ADVICE)
    elif set(SWUNG) & stated and not set(SWUNG) <= stated:
        missing = next(key for key in SWUNG if key not in stated)
        yield Finding((*path, missing), "не хватает данных качаний", "нужны " + ", ".join(SWUNG))
    elif "swing_edges_mm" in stated and "rod_inertia_kg_m2" in stated:
        hint = "оставьте что-нибудь одно"
        yield Finding((*path, "rod_inertia_kg_m2"), "I_ш следует из качаний", hint)
    elif not (
        set(DIRECT) <= stated
        or (estimate and not stated & set(DIRECT))
        or (set(PARTS) <= stated and centres)
    ):
        yield Finding(path, "масс недостаточно", _ADVICE + _MORE)


def _webs(values: ValidValues) -> Iterator[Finding]:
    """Each web by its reduced mass or by mass and radius, all webs alike."""
    if not values.sure("crankshaft", "webs"):
        return
    ways = set()
    for index, web in enumerate(values.get("crankshaft", "webs") or ()):
        actual = web.actual_mass_kg is not None
        if actual != (web.centre_mm is not None) or (actual and web.mass_kg is not None):
            problem = "нужна либо mass_kg, либо actual_mass_kg с centre_mm"
            yield Finding(("crankshaft", "webs", index), problem, "уберите лишний ключ")
            return
        ways.add((actual, web.mass_kg is None))
    if len(ways) > 1:
        problem = "массы щёк заданы разными способами"
        yield Finding(("crankshaft", "webs"), problem, "задайте все щёки одинаково")


def _shaft_masses(values: ValidValues, *, estimated: bool) -> Iterator[Finding]:
    """Yield missing masses of pin and webs, required without an estimate."""
    webs = values.get("crankshaft", "webs") or ()
    bare = [i for i, web in enumerate(webs) if web.mass_kg is None and web.actual_mass_kg is None]
    lacks_pin = values.get("crankshaft", "pin_mass_kg") is None
    hint = "впишите массу или задайте masses.estimate_fuel для оценки"
    if estimated or not values.sure("crankshaft", "pin_mass_kg", "webs"):
        return
    problem = "масса не задана"
    if lacks_pin:
        yield Finding(("crankshaft", "pin_mass_kg"), problem, hint)
    if bare:
        yield Finding(("crankshaft", "webs", bare[0], "mass_kg"), problem, hint)


def _estimated(values: ValidValues, stated: set[str]) -> Iterator[Finding]:
    webs = values.get("crankshaft", "webs") or ()
    lacking = [] if stated & set(DIRECT) else [
        name
        for key, name in (("piston_group_kg", "поршневая группа"), ("rod_kg", "шатун"))
        if key not in stated
    ]  # fmt: skip
    if values.get("crankshaft", "pin_mass_kg") is None:
        lacking.append("шатунная шейка")
    if any(web.mass_kg is None and web.actual_mass_kg is None for web in webs):
        lacking.append("щёки")
    path = ("masses", "estimate_fuel")
    if not lacking:
        yield Finding(path, "оценивать нечего: все массы заданы", "уберите estimate_fuel")
        return
    problem = f"оценены по таблице 4 учебника: {', '.join(lacking)}"
    yield Finding(path, problem, "замените их массами вашего двигателя", warning=True)


def _centre(values: ValidValues) -> Iterator[Finding]:
    pair = radius_and_rod(values)
    centre = values.get("masses", "rod_centre_mm")
    share = values.get("masses", "rod_small_end_share")
    weighed, rod = values.get("masses", "rod_weighed_small_end_kg"), values.get("masses", "rod_kg")
    key = "rod_small_end_share"
    if weighed is not None and rod is not None:
        key = "rod_weighed_small_end_kg"
        share = weighed / rod
    if centre is not None:
        key = "rod_centre_mm"
        if pair is None:
            return
        share = 1 - centre / pair[1]
    if share is not None and not is_within(share, SMALL_END.span):
        problem = f"доля массы шатуна у пальца {number_text(round(share, 4))} необычна"
        hint = SMALL_END.usual
        yield Finding(("masses", key), problem, hint, warning=True)


def _swung(values: ValidValues) -> Iterator[Finding]:
    """Check centre and inertia by the swings, Gots (25)-(27)."""
    swings = [values.get("masses", key) for key in SWUNG]
    if None in swings:
        return
    n_a, n_c, radius, edges = swings
    k_a, k_c = (_GRAVITY_MM / (2 * math.pi * n / 60) ** 2 for n in (n_a, n_c))
    below = k_a + k_c - 2 * edges
    path = ("masses", "swing_edges_mm")
    if abs(below) < 1e-9 * edges:
        yield Finding(path, "по этим качаниям центр масс не определяется", "повторите опыт")
        return
    arm = edges * (k_c - edges) / below
    centre = arm - radius
    pair = radius_and_rod(values)
    if not 0 < arm < edges or centre <= 0 or (pair is not None and centre >= pair[1]):
        problem = f"по качаниям l1 = {number_text(round(centre, 2))} мм, вне шатуна"
        length = "" if pair is None else f"длина шатуна {number_text(pair[1])} мм; "
        yield Finding(path, problem, length + "проверьте n_A, n_C, r_1 и l_3")
        return
    if k_a * arm - arm**2 <= 0:
        problem = "по качаниям момент инерции шатуна отрицателен"
        yield Finding(path, problem, "проверьте n_A, n_C, r_1 и l_3")
        return
    if pair is not None and not is_within(1 - centre / pair[1], SMALL_END.span):
        share = number_text(round(1 - centre / pair[1], 4))
        problem = f"доля массы шатуна у пальца {share} необычна"
        yield Finding(
            path,
            problem,
            SMALL_END.usual,
            warning=True,
        )


def _inertia(values: ValidValues) -> Iterator[Finding]:
    """Yield a moment of inertia that two masses on the ends cannot exceed by much."""
    inertia, rod = values.get("masses", "rod_inertia_kg_m2"), values.get("masses", "rod_kg")
    pair = radius_and_rod(values)
    if None in (inertia, rod) or pair is None:
        return
    ratio = inertia / (rod * (pair[1] / 1000) ** 2)
    if not is_within(ratio, ROD_INERTIA.span):
        problem = f"I_ш/(m_ш·l²) = {number_text(round(ratio, 4))} необычно"
        path = ("masses", "rod_inertia_kg_m2")
        hint = f"{ROD_INERTIA.usual}: проверьте кг·м²"
        yield Finding(path, problem, hint, warning=True)
