"""Chapter on bearings, bending of the pin and the continuous shaft, Gots 2.6 and 2.7."""

from __future__ import annotations

from functools import partial

import numpy as np
from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.chapters.plots import PHI, over_phi, phi
from reports.document.figures import Series as Curve
from reports.document.figures import line_chart, polar_path
from reports.document.page.blocks import TableBlock
from reports.document.page.spec_tables import grid_table, scalar_table
from reports.document.page.writer import Figure, TablePlan
from reports.document.text.terms import Terms
from reports.spec.blocks import Grid

_MOST_SHOWN = 3
_THREE_MOMENTS = (
    r"M_{k-1} l_{k-1} + 2 M_k (l_{k-1} + l_k) + M_{k+1} l_k ="
    r" -\sum P \dfrac{a\,(l_{k-1}^2 - a^2)}{l_{k-1}}"
    r" - \sum P \dfrac{b\,(l_k^2 - b^2)}{l_k}"
)
_BENDING = (
    "alpha_oil_deg", "Ralpha_max", "Ralpha_min", "Malpha_max", "Malpha_min", "Malpha_swing",
    "Malpha_mean", "alpha_best_deg", "Mbest_swing",
)  # fmt: skip


def bearings(chapter: Chapter) -> Markup:
    """Loads on the bearings and what the strength of the shaft needs."""
    terms = chapter.terms
    tables = terms.model.tables
    worst = round(terms.value("worst_main_load"))
    continuous = "continuous" in tables
    figures = {"main": _bearing(terms, f"P4_3_{worst}", "block_", worst)}
    if "rod_bearing" in tables:
        figures["rod"] = _polar(
            terms, "rod_bearing.Bx_MPa", "rod_bearing.By_MPa", "$B_x$, МПа", "$B_y$, МПа",
            "Полярная диаграмма нагрузки на шатунный подшипник", left=False,
        )  # fmt: skip
    if "pin_bending" in tables:
        figures["bending"] = over_phi(
            terms, "Момент, изгибающий шатунную шейку в плоскости масляного отверстия",
            rf"${terms.tex('pin_bending.Malpha_Nm')}$, Н·м", "pin_bending.Malpha_Nm", height=66.0,
        )  # fmt: skip
    shown = [(f"scheme_{k}", _schemes(terms, k)) for k in _supports(terms)] if continuous else []
    return chapter.page(
        "bearings.html.j2",
        figures=figures,
        worst=worst,
        at=chapter.example,
        given=chapter.input.crankshaft.oil_hole_deg is not None,
        bending=TablePlan(
            partial(scalar_table, terms, _BENDING), "Изгиб шатунной шейки", keep=True
        ),
        schemes=TablePlan(partial(_compared, chapter), "Разрезная и неразрезная схемы", keep=True)
        if continuous
        else None,
        shown=shown,
        three_moments=_THREE_MOMENTS,
    )


def _supports(terms: Terms) -> list[int]:
    """Supports whose greatest loads the two schemes find most apart."""
    count = sum(key.startswith("dRc") and key.endswith("_max") for key in terms.model.scalars)
    order = sorted(range(1, count + 1), key=lambda k: -abs(terms.value(f"dRc{k}_max")))
    return sorted(order[:_MOST_SHOWN])


def _schemes(terms: Terms, k: int) -> Figure:
    curves = (
        Curve("разрезная", terms.column(f"P4_3_{k}.R_MPa")),
        Curve("неразрезная", terms.column(f"continuous.Rc{k}_MPa")),
    )
    draw = partial(line_chart, phi(terms, "continuous"), curves, PHI, "$R$, МПа", height=62.0)
    return Figure(draw, f"Реакция опоры {k} по двум схемам")


def _bearing(terms: Terms, table: str, prefix: str, number: int) -> Figure:
    return _polar(
        terms, f"{table}.{prefix}x_MPa", f"{table}.{prefix}y_MPa", "$Q_x$, МПа", "$Q_y$, МПа",
        f"Полярная диаграмма нагрузки на коренной подшипник {number}", left=True,
    )  # fmt: skip


def _polar(
    terms: Terms, x: str, y: str, x_label: str, y_label: str, caption: str, *, left: bool
) -> Figure:
    table = x.partition(".")[0]
    draw = partial(
        polar_path, np.asarray(terms.column(x)), np.asarray(terms.column(y)), phi(terms, table),
        x_label, y_label, invert=(left, False), most=105.0,
    )  # fmt: skip
    return Figure(draw, caption)


def _compared(chapter: Chapter) -> TableBlock:
    found = (b for b in chapter.model.blocks if isinstance(b, Grid) and b.id == "schemes")
    grid = next(found)
    return grid_table(chapter.terms, grid, [row.of for row in grid.rows], "Величина")
