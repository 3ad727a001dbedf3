"""Chapter on bearings, bending of the pin and the continuous shaft, Gots 2.6 and 2.7."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.page.spec_tables import grid_table
from reports.document.page.writer import TablePlan
from reports.document.text.terms import Terms

_MOST_SHOWN = 3
_THREE_MOMENTS = (
    r"X_{k-1} l_{k-1} + 2 X_k (l_{k-1} + l_k) + X_{k+1} l_k ="
    r" -\sum P \dfrac{u\,(l_{k-1}^2 - u^2)}{l_{k-1}}"
    r" - \sum P \dfrac{w\,(l_k^2 - w^2)}{l_k}"
)
_BENDING = (
    "alpha_oil_deg", "Ralpha_max", "Ralpha_min", "Malpha_max", "Malpha_min", "Malpha_swing",
    "Malpha_mean", "alpha_best_deg", "Mbest_swing",
)  # fmt: skip


def bearings(chapter: Chapter) -> Markup:
    """Loads on the bearings and what the strength of the shaft needs."""
    terms, first = chapter.terms, " 1" if chapter.shape.throws > 1 else ""
    schemes, shown = None, []
    if "continuous" in terms.model.tables:
        build = partial(grid_table, terms, chapter.grid("schemes"))
        schemes = TablePlan(build, "Разрезная и неразрезная схемы", keep=True)
        shown = [f"continuous_{k}" for k in _supports(terms)]
    return chapter.page(
        "bearings",
        several=len(chapter.shape.pins[0]) > 1,
        worst=chapter.worst("worst_main_load"),
        given=chapter.input.crankshaft.oil_hole_deg is not None,
        bending=chapter.scalars(f"Изгиб шатунной шейки{first}", _BENDING, keep=True),
        schemes=schemes,
        shown=shown,
        three_moments=_THREE_MOMENTS,
    )


def _supports(terms: Terms) -> list[int]:
    """Supports whose greatest loads the two schemes find most apart."""
    count = sum(key.startswith("dRc") and key.endswith("_max") for key in terms.model.scalars)
    order = sorted(range(1, count + 1), key=lambda k: -abs(terms.value(f"dRc{k}_max")))
    return sorted(order[:_MOST_SHOWN])
