"""Checks of the [bearings] section: widths and roughness."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from kshm.engine.arrangement import rods_beside
from kshm.engine.bearings import LEAST_WIDTH, MOST_WIDTH
from reports.inputs.checks.layout import arrangement_given
from reports.inputs.findings import Finding, Values
from reports.inputs.units import number_text, span_text

_WORDS = {"pin": "шатунного", "main": "коренного"}


def check_bearings(values: Values) -> Iterator[Finding]:
    """Yield what contradicts itself about clearances, widths, oil and bores."""
    if "bearings" not in values.sections:
        return
    for part in ("pin", "main"):
        diameters, lengths = _sizes(values, part, "diameter"), _sizes(values, part, "length")
        if diameters and lengths:
            yield from _widths(values, part, diameters, lengths)
    if not sum(values.get("bearings", f"{key}_um") or 0 for key in
               ("journal_roughness", "shell_roughness", "form")):  # fmt: skip
        what = "сумма неровностей и отклонений равна нулю: не с чем сравнить плёнку"
        yield Finding(("bearings", "journal_roughness_um"), what, "задайте неровности больше нуля")


def _sizes(values: Values, part: str, size: str) -> Sequence[float]:
    each = values.get("crankshaft", f"{part}_{size}s_mm")
    one = values.get("crankshaft", f"{part}_{size}_mm")
    return tuple(each) if each else () if one is None else (one,)


def _widths(
    values: Values, part: str, diameters: Sequence[float], lengths: Sequence[float]
) -> Iterator[Finding]:
    given, groove = (
        values.get("bearings", f"{part}_width_mm"),
        values.get("bearings", f"{part}_groove_mm") or 0,
    )
    rods = _rods(values) if part == "pin" else 1
    count = max(len(diameters), len(lengths))
    for k in range(count):
        d, length = diameters[min(k, len(diameters) - 1)], lengths[min(k, len(lengths) - 1)]
        land = (given or length / rods) - groove
        share = land / (2 if groove else 1) / d
        hole = values.get("bearings", "hole_mm") or 0
        if (land <= hole and not groove) or not LEAST_WIDTH <= share <= MOST_WIDTH:
            what = (
                f"ширина {_WORDS[part]} подшипника к диаметру B/d = {number_text(round(share, 3))}:"
                " формулы масляной плёнки для неё не проверены"
            )
            path = ("bearings", f"{part}_{'width' if given is not None else 'groove'}_mm")
            if given is None and not groove:
                path = ("crankshaft", f"{part}_diameter_mm")
            hint = f"нужно {span_text(LEAST_WIDTH, MOST_WIDTH)} и шире масляного отверстия"
            yield Finding(path, what, hint)
            return


def _rods(values: Values) -> int:
    places = arrangement_given(values)
    return rods_beside(places, 0) if places else 1
