"""Chapter on kinematics: dimensions, piston, rod (figures 41-45 of the textbook)."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.chapters.layout import articulated_text, offset_kinematics
from reports.document.chapters.plots import PHI, over_phi, phi, series
from reports.document.figures import Panel, mechanism_sketch, twin_chart
from reports.document.page.writer import Figure
from reports.document.text.terms import Terms
from reports.shared.russian import fixed

EXAMPLE = 30.0  # crank angle of the worked lines [deg]; every grid has it


def kinematics(chapter: Chapter) -> Markup:
    """Kinematics of piston and rod."""
    if chapter.shape.offset:
        return offset_kinematics(chapter, EXAMPLE) + articulated_text(chapter)
    terms = chapter.terms
    lam = min(max(terms.value("lam"), 0.1), 0.6)
    half = terms.value("P3_1.s_mm", 90.0) / (1000 * terms.value("S_stroke"))
    figures = {
        "sketch": Figure(
            partial(mechanism_sketch, lam),
            "Схема центрального кривошипно-шатунного механизма: а\u00a0— размеры и углы; "
            "б\u00a0— силы",
        ),
        "s": over_phi(terms, "Перемещение поршня и его гармоники",
                      "$s$, мм", "P3_1.s_mm", "P3_1.s1_mm", "P3_1.s2_mm"),
        "v": over_phi(terms, "Скорость поршня и её гармоники",
                      "$v$, м/с", "P3_1.v_m_s", "P3_1.v1_m_s", "P3_1.v2_m_s"),
        "j": over_phi(terms, "Ускорение поршня и его гармоники",
                      "$j$, м/с²", "P3_1.j_m_s2", "P3_1.j1_m_s2", "P3_1.j2_m_s2"),
        "beta": over_phi(terms, "Угол отклонения шатуна", r"$\beta$, рад", "P3_2.beta_rad",
                         height=58.0),
        "rod": _rod(terms),
    }  # fmt: skip
    page = chapter.page("kinematics.html.j2", figures=figures, at=EXAMPLE, half=fixed(half, 3))
    return page + articulated_text(chapter)


def _rod(terms: Terms) -> Figure:
    omega = series(terms, "P3_2.omega_rod_exact_1_s", "P3_2.omega_rod_approx_1_s")
    eps = series(terms, "P3_2.eps_rod_exact_1_s2", "P3_2.eps_rod_approx_1_s2")
    draw = partial(
        twin_chart,
        phi(terms, "P3_2"),
        Panel(omega, r"$\omega_{\mathrm{ш}}$, с⁻¹"),
        Panel(eps, r"$\varepsilon_{\mathrm{ш}}$, с⁻²"),
        PHI,
        panel_height=50.0,
    )
    return Figure(
        draw,
        "Качание шатуна: а\u00a0— угловая скорость; б\u00a0— угловое ускорение "
        "(со штрихом\u00a0— по приближённым формулам)",
    )
