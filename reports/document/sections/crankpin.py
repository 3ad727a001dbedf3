"""Chapter on the crankpin: polar diagram, unfolded diagram, wear, oil hole (figures 50-52)."""

from __future__ import annotations

from functools import partial

import numpy as np
from markupsafe import Markup

from reports.document.blocks import Column, TableBlock, symbol_head, table_block
from reports.document.figures import Level, Pole, polar_path, roman, wear_diagram
from reports.document.numbers import fixed
from reports.document.sections.chapter import Chapter
from reports.document.sections.dynamics import EXAMPLE
from reports.document.sections.plots import extreme_marks, over_phi, phi
from reports.document.terms import Terms
from reports.document.writer import Figure, TablePlan


def crankpin(chapter: Chapter) -> Markup:
    """Loads on the crankpin."""
    terms, rays = chapter.terms, chapter.input.calculation.wear_rays
    figures = {
        "polar": _polar(terms),
        "unfolded": over_phi(
            terms,
            "Развёрнутая диаграмма нагрузки на шатунную шейку",
            rf"${terms.tex('crankpin.Rpin_MPa')}$, МПа",
            "crankpin.Rpin_MPa",
            levels=(Level(rf"${terms.tex('Rpin_mean')}$", terms.value("Rpin_mean")),),
            marks=extreme_marks(terms, "crankpin.Rpin_MPa"),
        ),
        "wear": wear_figure(
            terms, "pin", rays, "Условная диаграмма износа шатунной шейки", "от оси вала", 112.0
        ),
    }
    return chapter.page(
        "crankpin.html.j2",
        figures=figures,
        at=EXAMPLE,
        rays=rays,
        sums=TablePlan(
            partial(ray_sums, terms, ["pin"], [r"\Sigma R'_{\mathrm{ш.ш}}"], rays),
            "Суммы удельных сил по лучам шатунной шейки",
            keep=True,
        ),
        best=least_ray(terms, "hole_pin_ray"),
    )


def least_ray(terms: Terms, key: str) -> str:
    """Roman number of the least loaded ray."""
    return roman(round(terms.value(key)))


def _polar(terms: Terms) -> Figure:
    rod, throw = terms.value("K_r_rod"), terms.value("K_r_throw")
    poles = (
        Pole("$O$"),
        Pole(r"$O_{\mathrm{ш}}$", 0.0, rod),
        Pole(r"$O_{\mathrm{к}}$", 0.0, rod + throw),
    )
    draw = partial(
        polar_path,
        terms.column("crankpin.T_MPa"),
        terms.column("crankpin.K_MPa"),
        phi(terms, "crankpin"),
        rf"${terms.tex('crankpin.T_MPa')}$, МПа",
        rf"${terms.tex('crankpin.K_MPa')}$, МПа",
        invert=(False, True),
        poles=poles,
        most=122.0,
    )
    return Figure(draw, "Полярная диаграмма удельной нагрузки на шатунную шейку")


def wear_figure(terms: Terms, name: str, rays: int, caption: str, top: str, size: float) -> Figure:
    """Wear diagram of a journal: each sum lies where its forces press on the surface.

    A force directed along a ray presses on the surface half a turn away.
    """
    sums = np.array([terms.value(f"{name}_sum{i}") for i in range(1, rays + 1)])
    places = np.array([terms.value(f"{name}_deg{i}") + 180.0 for i in range(1, rays + 1)])
    key = "hole_pin" if name == "pin" else f"hole_{name}"
    draw = partial(
        wear_diagram,
        sums,
        places,
        terms.value(f"{key}_deg"),
        clockwise=False,
        size=size,
        top_label=top,
    )
    return Figure(draw, caption)


def ray_sums(terms: Terms, names: list[str], heads: list[str], rays: int) -> TableBlock:
    """Sums of the forces by rays, a column for each surface."""
    columns = [Column("Луч"), Column(symbol_head(r"\delta", "°"))]
    columns += [Column(symbol_head(head, "МПа")) for head in heads]
    rows = []
    for i in range(1, rays + 1):
        sums = [fixed(terms.value(f"{name}_sum{i}"), 2) for name in names]
        rows.append([roman(i), fixed(terms.value(f"{names[0]}_deg{i}"), 0), *sums])
    return table_block(columns, rows)
