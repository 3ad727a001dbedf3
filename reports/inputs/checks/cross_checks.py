"""Checks of the input's fields against each other.

Each check sees the valid fields of a possibly broken file (`Values`), so that
all errors are found at once; it keeps silent about what it cannot judge.
"""

from __future__ import annotations

from collections.abc import Iterator

from reports.inputs.checks.accepted import check_accepted
from reports.inputs.checks.bearings import check_bearings
from reports.inputs.checks.cycle import check_cycle
from reports.inputs.checks.gas import check_gas
from reports.inputs.checks.layout import check_layout
from reports.inputs.checks.masses import check_masses
from reports.inputs.checks.pairs import check_pairs
from reports.inputs.checks.reference import check_reference
from reports.inputs.checks.torsion import check_torsion
from reports.inputs.findings import Finding, Path, Values, radius_and_rod
from reports.inputs.sections.input_file import LAMBDA_MAX, LAMBDA_MIN
from reports.inputs.units import is_within, number_text, span_text

LENGTH_TOLERANCE = 1e-3
USUAL_LAMBDA = (0.15, 0.45)


def check(values: Values) -> Iterator[Finding]:
    """Yield everything that does not fit together, errors and warnings."""
    yield from _geometry(values)
    yield from check_pairs(values)
    yield from check_layout(values)
    yield from _arms(values)
    yield from check_masses(values)
    yield from check_gas(values)
    yield from check_cycle(values)
    yield from check_torsion(values)
    yield from check_bearings(values)
    yield from check_reference(values)
    yield from check_accepted(values)


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
        return
    if not LAMBDA_MIN <= ratio <= LAMBDA_MAX:
        what = f"λ = r/L = {text} вне допустимых пределов"
        yield Finding(path, what, f"допустимо λ {span_text(LAMBDA_MIN, LAMBDA_MAX)}")
    elif not is_within(ratio, USUAL_LAMBDA):
        what = f"λ = {text} необычно"
        hint = f"обычно {span_text(USUAL_LAMBDA[0], USUAL_LAMBDA[1])}"
        yield Finding(path, what, hint, warning=True)


def _arms(values: Values) -> Iterator[Finding]:
    for index, arms in enumerate(values.get("crankshaft", "arms") or ()):
        lengths = (arms.l1_mm, arms.l2_mm, arms.l3_mm, arms.l4_mm, arms.l5_mm, arms.l6_mm)
        left = arms.l1_mm + arms.l2_mm + arms.left_web_mm
        right = arms.l5_mm + arms.l6_mm + arms.right_web_mm
        if left <= 0 or right <= 0:
            whole = number_text(sum(lengths))
            what = f"длина колена с одной стороны шатуна равна нулю (сумма плеч {whole})"
            hint = "задайте l1, l2 и l5, l6 больше нуля"
            yield Finding(("crankshaft", "arms", index), what, hint)
