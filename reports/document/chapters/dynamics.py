"""Chapter on dynamics: masses, gas pressure, forces (figures 46-48 of the textbook)."""

from __future__ import annotations

from functools import partial

import numpy as np
from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.chapters.diagram import rounded_text
from reports.document.chapters.layout import rods_text
from reports.document.chapters.masses import mass_notes
from reports.document.chapters.plots import PHI, over_phi, phi, series
from reports.document.figures import Level, Mark, line_chart, pv_diagram
from reports.document.page.blocks import TableBlock
from reports.document.page.spec_tables import scalar_table
from reports.document.page.writer import Figure, TablePlan
from reports.document.text.terms import Terms
from reports.inputs.sections.gas import RoundedGasSection, TableGasSection
from reports.tables.gas.diagram import is_smooth


def dynamics(chapter: Chapter) -> Markup:
    """Masses, pressure of the gases and the forces of one cylinder."""
    terms, gas = chapter.terms, chapter.input.gas
    polytropic = not isinstance(gas, TableGasSection | RoundedGasSection)
    figures = {
        "pv": _pv(terms, two_stroke=chapter.shape.strokes == 2),
        "p_phi": _p_phi(terms, two_stroke=chapter.shape.strokes == 2),
        "specific": over_phi(terms, "Удельные силы давления газов, инерции и их сумма",
                             "$p'$, МПа", "P4_1.Pg_MPa", "P4_1.Pj_MPa", "P4_1.Ps_MPa", height=80.0),
        "ns": over_phi(terms, "Удельные силы на стенку цилиндра и вдоль шатуна",
                       "МПа", "P4_1.N_MPa", "P4_1.S_MPa", height=76.0),
        "kt": over_phi(terms, "Удельные нормальная и тангенциальная силы на кривошипе",
                       "МПа", "P4_1.K_MPa", "P4_1.T_MPa", height=76.0),
    }  # fmt: skip
    points = TablePlan(partial(_points, terms), "Характерные точки индикаторной диаграммы")
    masses = [key for key in ("m_1", "m_2", "m_j") if _is_computed(chapter, key)]
    inertia = {"tdc": terms.num("P4_1.Pj_MPa", 360.0), "bdc": terms.num("P4_1.Pj_MPa", 180.0)}
    return chapter.page(
        "dynamics.html.j2",
        figures=figures,
        points=points,
        polytropic=polytropic,
        rounded=partial(rounded_text, chapter),
        smooth=is_smooth(chapter.input),
        pressure=_pressure_tex(terms) if polytropic else "",
        masses=masses,
        mass_notes=partial(mass_notes, chapter),
        rods=partial(rods_text, chapter),
        at=chapter.example,
        exact=chapter.input.calculation.method == "exact",
        inertia=inertia,
        from_cycle=chapter.input.gas.source == "cycle",
    )


def _is_computed(chapter: Chapter, key: str) -> bool:
    """Whether a mass follows from others and is not simply given."""
    scalar = chapter.model.scalars.get(key)
    return scalar is not None and any(sign in scalar.expr for sign in "+-*/")


def _points(terms: Terms) -> TableBlock:
    names = (
        "phi_c_deg", "p_start", "p_c_end", "gas_max_pressure_mpa", "cyc_p_z",
        "phi_open_deg", "p_open", "phi_scavenge_deg", "phi_close_deg",
    )  # fmt: skip
    return scalar_table(terms, [name for name in names if terms.has(name)])


def _pressure_tex(terms: Terms) -> str:
    """All branches of the pressure with the ranges of angles in which they hold."""
    lines, low = [], ""
    for piece in terms.branches("gas.p_MPa"):
        left = rf"{terms.tex('gas.p_MPa')} = {piece.formula},\quad "
        if piece.condition is None:
            lines.append(rf"{left}\varphi > {low}")
            continue
        limit = piece.condition.split(r"\leq ")[1]
        limit += r"^{\circ}" if limit.isdigit() and limit != "0" else ""
        lines.append(rf"{left}{low} < \varphi \leq {limit}" if low else rf"{left}\varphi = {limit}")
        low = limit
    return r" \\ ".join(lines)


def _marks(
    terms: Terms, x: np.ndarray[tuple[int, ...], np.dtype[np.float64]], *, two_stroke: bool
) -> tuple[Mark, ...]:
    """Points of the cycle that lie on the grid: a, z, b, r."""
    p = terms.column("gas.p_MPa")
    angles = np.asarray(phi(terms, "gas"))
    start = terms.value("phi_close_deg") if two_stroke and terms.has("phi_close_deg") else 180.0
    rows = {"$a$": terms.row("gas", start), "$z$": int(np.argmax(p))}
    if not two_stroke:
        rows["$r$"] = 0
    if terms.has("phi_open_deg"):
        opening = terms.value("phi_open_deg")
        rows["$b$"] = int(np.flatnonzero(angles <= opening + 1e-9)[-1])
    return tuple(Mark(name, float(x[row]), float(p[row])) for name, row in rows.items())


def _pv(terms: Terms, *, two_stroke: bool) -> Figure:
    volume = terms.column("gas.volume_dm3")
    draw = partial(
        pv_diagram,
        volume,
        terms.column("gas.p_MPa"),
        marks=_marks(terms, volume, two_stroke=two_stroke),
        volume_label="$V$, дм³",
        pressure_label=rf"${terms.tex('gas.p_MPa')}$, МПа",
        ambient=terms.value("gas_ambient_pressure_mpa"),
        height=82.0,
    )
    return Figure(draw, "Индикаторная диаграмма в координатах p–V")


def _p_phi(terms: Terms, *, two_stroke: bool) -> Figure:
    angles = np.asarray(phi(terms, "gas"))
    draw = partial(
        line_chart,
        phi(terms, "gas"),
        series(terms, "gas.p_MPa"),
        PHI,
        rf"${terms.tex('gas.p_MPa')}$, МПа",
        height=72.0,
        levels=(Level("$p_0$", terms.value("gas_ambient_pressure_mpa")),),
        marks=_marks(terms, angles, two_stroke=two_stroke),
    )
    return Figure(draw, "Индикаторная диаграмма, развёрнутая по углу поворота вала")
