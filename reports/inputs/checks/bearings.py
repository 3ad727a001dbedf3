"""Checks of the [bearings] section."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from kshm.engine.arrangement import rods_beside
from kshm.engine.bearings import MAX_WIDTH, MIN_WIDTH
from reports.inputs.checks.layout import arrangement_given
from reports.inputs.findings import Finding, ValidValues, journal_sizes
from reports.inputs.units import number_text, span_text

_WORDS = {"pin": "шатунного", "main": "коренного"}


def check_bearings(values: ValidValues) -> Iterator[Finding]:
    """Yield contradictions among clearances, widths, oil and bores."""
    if "bearings" not in values.sections:
        return
    for part in ("pin", "main"):
        diameters, lengths = (
            journal_sizes(values, part, "diameter"),
            journal_sizes(values, part, "length"),
        )
        if diameters and lengths:
            yield from _widths(values, part, diameters, lengths)
    if not sum(values.get("bearings", f"{key}_um") or 0 for key in
               ("journal_roughness", "shell_roughness", "form")):  # fmt: skip
        problem = "сумма неровностей и отклонений равна нулю: не с чем сравнить плёнку"
        yield Finding(
            ("bearings", "journal_roughness_um"), problem, "задайте неровности больше нуля"
        )


def _widths(
    values: ValidValues, part: str, diameters: Sequence[float], lengths: Sequence[float]
) -> Iterator[Finding]:
    stated, groove = (
        values.get("bearings", f"{part}_width_mm"),
        values.get("bearings", f"{part}_groove_mm") or 0,
    )
    rods = _rods(values) if part == "pin" else 1
    count = max(len(diameters), len(lengths))
    for k in range(count):
        d, length = diameters[min(k, len(diameters) - 1)], lengths[min(k, len(lengths) - 1)]
        land = (stated or length / rods) - groove
        share = land / (2 if groove else 1) / d
        hole = values.get("bearings", "hole_mm") or 0
        if (land <= hole and not groove) or not MIN_WIDTH <= share <= MAX_WIDTH:
            problem = (
                f"ширина {_WORDS[part]} подшипника к диаметру B/d = {number_text(round(share, 3))}:"
                " формулы масляной плёнки для неё не проверены"
            )
            path = ("bearings", f"{part}_{'width' if stated is not None else 'groove'}_mm")
            if stated is None and not groove:
                path = ("crankshaft", f"{part}_diameter_mm")
            hint = f"нужно {span_text(MIN_WIDTH, MAX_WIDTH)} и шире масляного отверстия"
            yield Finding(path, problem, hint)
            return


def _rods(values: ValidValues) -> int:
    placement = arrangement_given(values)
    return rods_beside(placement, 0) if placement else 1
