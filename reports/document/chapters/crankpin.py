"""Chapter on the crankpin: polar diagram, unfolded diagram, wear, oil hole (figures 50-52)."""

from __future__ import annotations

from functools import partial

import numpy as np
from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.chapters.plots import extreme_marks, over_phi, phi
from reports.document.figures import Level, Pole, polar_path, roman, wear_diagram
from reports.document.page.blocks import Column, TableBlock, symbol_head, table_block
from reports.document.page.writer import Figure, TablePlan
from reports.document.text.terms import Terms
from reports.shared.russian import fixed
from reports.spec.shape import pin_name


def crankpin(chapter: Chapter) -> Markup:
    """Loads on the crankpin."""
    terms, rays, shape = chapter.terms, chapter.input.calculation.wear_rays, chapter.shape
    rods = sum(not shape.is_hung(cylinder) for cylinder in shape.pins[0])
    figures = {
        "polar": _polar(terms, "crankpin", rods),
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
        at=chapter.example,
        several=shape.pins[0] if len(shape.pins[0]) > 1 else (),
        others=[(n, _other(terms, n, rods, rays)) for n in range(2, len(shape.pins) + 1)],
        pin_loads=TablePlan(
            partial(_loads, terms, len(shape.pins)), "Нагрузки на шатунные шейки", size="dense"
        ),
        worst_pin=round(terms.value("worst_pin_load")) if len(shape.pins) > 1 else 1,
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


def _other(terms: Terms, number: int, rods: int, rays: int) -> dict[str, Figure]:
    """Diagrams of a further crankpin of a V engine."""
    wear = wear_figure(
        terms, f"pin{number}", rays, f"Условная диаграмма износа шатунной шейки {number}",
        "от оси вала", 84.0,
    )  # fmt: skip
    return {"polar": _polar(terms, f"crankpin_{number}", rods, f" {number}", 100.0), "wear": wear}


def _loads(terms: Terms, count: int) -> TableBlock:
    """Loads of all crankpins side by side."""
    columns = [
        Column("Шейка", 0.8),
        Column(symbol_head(r"R'_{\max}", "МПа")),
        Column(symbol_head(r"\varphi_{\max}", "°")),
        Column(symbol_head(r"R'_{\mathrm{ср}}", "МПа")),
        Column(symbol_head(r"R_{\max}", "кН")),
        Column(symbol_head(r"q_{\max}", "МПа")),
        Column(symbol_head(r"q_{\mathrm{ср}}", "МПа")),
        Column(symbol_head(r"\alpha_{\mathrm{м}}", "°")),
    ]
    rows = []
    for number in range(1, count + 1):
        n = pin_name(number)
        keys = (
            f"Rpin{n}_max", f"phi_Rpin{n}_max_deg", f"Rpin{n}_mean", f"Rpin{n}_max_kN",
            f"q_pin{n}_max", f"q_pin{n}_mean", f"hole_pin{n}_deg",
        )  # fmt: skip
        rows.append([str(number), *(terms.num(key) for key in keys)])
    return table_block(columns, rows)


def _polar(terms: Terms, table: str, rods: int, words: str = "", most: float = 122.0) -> Figure:
    rod = rods * terms.value("K_r_rod")
    poles = [Pole("$O$"), Pole(r"$O_{\mathrm{ш}}$", 0.0, rod)]
    if terms.has(f"{table}.Ksum_MPa"):
        poles.append(Pole(r"$O_{\mathrm{к}}$", 0.0, rod + terms.value("K_r_throw")))
    draw = partial(
        polar_path,
        terms.column(f"{table}.T_MPa"),
        terms.column(f"{table}.K_MPa"),
        phi(terms, table),
        rf"${terms.tex(f'{table}.T_MPa')}$, МПа",
        rf"${terms.tex(f'{table}.K_MPa')}$, МПа",
        invert=(False, True),
        poles=tuple(poles),
        most=most,
    )
    return Figure(draw, f"Полярная диаграмма удельной нагрузки на шатунную шейку{words}")


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
