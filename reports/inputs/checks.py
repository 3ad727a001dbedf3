"""Checks of the input's fields against each other.

Each check sees the valid fields of a possibly broken file (`Values`), so that
all errors are found at once; it keeps silent about what it cannot judge.
"""

from __future__ import annotations

from collections.abc import Iterator

from reports.inputs.checks_cycle import check_cycle
from reports.inputs.checks_gas import check_gas
from reports.inputs.checks_layout import check_layout
from reports.inputs.findings import Finding, Path, Values, radius_and_rod
from reports.inputs.model import LAMBDA_MAX, LAMBDA_MIN
from reports.units import number_text

LENGTH_TOLERANCE = 1e-3
USUAL_LAMBDA = (0.15, 0.45)
USUAL_SHARE = (0.2, 0.3)


def check(values: Values) -> Iterator[Finding]:
    """Yield everything that does not fit together, errors and warnings."""
    yield from _geometry(values)
    yield from check_layout(values)
    yield from _arms(values)
    yield from _masses(values)
    yield from check_gas(values)
    yield from check_cycle(values)


def _geometry(values: Values) -> Iterator[Finding]:
    keys = ("crank_radius_mm", "stroke_mm", "rod_length_mm", "lambda")
    if not values.sure("geometry", *keys):
        return
    if "crank_radius_mm" not in values.sections["geometry"]:  # sizes follow from the power
        lam = values.get("geometry", "lambda")
        yield from () if lam is None else _ratio(lam, ("geometry", "lambda"))
        return
    radius, stroke, rod, lam = (values.get("geometry", key) for key in keys)
    if radius is not None and stroke is not None and abs(stroke - 2 * radius) > 1e-9 * stroke:
        what = f"ход {number_text(stroke)} мм не равен 2r = {number_text(2 * radius)} мм"
        yield Finding(("geometry", "stroke_mm"), what, "оставьте один из двух ключей")
        return
    pair = radius_and_rod(values)
    if pair is None:
        what = "размеров недостаточно: нужны любые два из crank_radius_mm (или stroke_mm), "
        yield Finding(("geometry",), what + "rod_length_mm, lambda", "добавьте недостающий ключ")
        return
    r, rod_length = pair
    ratio = r / rod_length
    given = radius if radius is not None else None if stroke is None else stroke / 2
    if None not in (given, rod, lam) and abs(ratio - lam) > LENGTH_TOLERANCE * lam:
        what = f"λ = {number_text(lam)} не согласуется с r/L = {number_text(round(ratio, 6))}"
        yield Finding(("geometry", "lambda"), what, "оставьте любые два из r, L, λ")
        return
    yield from _ratio(ratio, ("geometry", "lambda" if lam is not None else "rod_length_mm"))


def _ratio(ratio: float, path: Path) -> Iterator[Finding]:
    text = number_text(round(ratio, 6))
    if ratio >= 1:
        what = f"λ = r/L = {text}: шатун не длиннее кривошипа, механизм не провернется"
        yield Finding(path, what, f"допустимо λ от {LAMBDA_MIN} до {LAMBDA_MAX}")
    elif not LAMBDA_MIN <= ratio <= LAMBDA_MAX:
        what = f"λ = r/L = {text} вне допустимых пределов"
        yield Finding(path, what, f"допустимо λ от {LAMBDA_MIN} до {LAMBDA_MAX}")
    elif not USUAL_LAMBDA[0] <= ratio <= USUAL_LAMBDA[1]:
        what = f"λ = {text} необычно"
        hint = f"обычно от {USUAL_LAMBDA[0]} до {USUAL_LAMBDA[1]}"
        yield Finding(path, what, hint, warning=True)


def _arms(values: Values) -> Iterator[Finding]:
    for index, arms in enumerate(values.get("crankshaft", "arms") or ()):
        lengths = (arms.l1_mm, arms.l2_mm, arms.l3_mm, arms.l4_mm, arms.l5_mm, arms.l6_mm)
        left = arms.l1_mm + arms.l2_mm + arms.left_web_mm
        right = arms.l5_mm + arms.l6_mm + arms.right_web_mm
        if left <= 0 or right <= 0:
            what = f"длина колена с одной стороны шатуна равна нулю (сумма плеч {sum(lengths):g})"
            hint = "задайте l1, l2 и l5, l6 больше нуля"
            yield Finding(("crankshaft", "arms", index), what, hint)


def _masses(values: Values) -> Iterator[Finding]:
    direct = ("reciprocating_kg", "rod_big_end_kg")
    parts = ("piston_group_kg", "rod_kg")
    centre = ("rod_centre_mm", "rod_small_end_share")
    if not values.sure("masses", *direct, *parts, *centre):
        return
    given = {key for key in (*direct, *parts, *centre) if values.get("masses", key) is not None}
    advice = (
        "задайте либо reciprocating_kg и rod_big_end_kg, "
        "либо piston_group_kg, rod_kg и одно из rod_centre_mm, rod_small_end_share"
    )
    rest = given - set(direct)
    if given & set(direct) and rest:
        yield Finding(("masses",), "смешаны два способа задания масс", advice)
    elif rest and set(centre) <= given:
        yield Finding(("masses",), "заданы и rod_centre_mm, и rod_small_end_share", advice)
    elif given != set(direct) and not (set(parts) <= given and given & set(centre)):
        yield Finding(("masses",), "масс недостаточно", advice)
    else:
        yield from _rod_centre(values)


def _rod_centre(values: Values) -> Iterator[Finding]:
    pair = radius_and_rod(values)
    place = values.get("masses", "rod_centre_mm")
    share = values.get("masses", "rod_small_end_share")
    key = "rod_small_end_share"
    if place is not None:
        key = "rod_centre_mm"
        if pair is None:
            return
        if place >= pair[1]:
            what = f"центр масс {number_text(place)} мм лежит не между головками шатуна"
            yield Finding(("masses", key), what, f"длина шатуна {number_text(pair[1])} мм")
            return
        share = 1 - place / pair[1]
    if share is not None and not USUAL_SHARE[0] <= share <= USUAL_SHARE[1]:
        what = f"доля массы шатуна у пальца {number_text(round(share, 4))} необычна"
        hint = f"обычно от {USUAL_SHARE[0]} до {USUAL_SHARE[1]}"
        yield Finding(("masses", key), what, hint, warning=True)
