"""Chapter on dynamics: masses, gas pressure, forces (figures 46-48 of the textbook)."""

from __future__ import annotations

from functools import partial

import numpy as np
from markupsafe import Markup

from reports.document.chapters import facts
from reports.document.chapters.chapter import Chapter
from reports.document.chapters.layout import rods_text
from reports.document.page.blocks import Column, TableBlock, table_block
from reports.document.page.charts import Row
from reports.document.page.writer import TablePlan
from reports.document.text.terms import Terms
from reports.document.text.texcases import cases
from reports.document.text.texts import rich
from reports.inputs.checks.indicated import indicated_of
from reports.inputs.sections.gas import RoundedGasSection, TableGasSection
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.geometry import sizes_of
from reports.model.blocks import NO, Grid, ScalarTable
from reports.model.context import diagram_kind
from reports.shared.russian import fixed

_POINTS = (
    "phi_c_deg", "p_start", "p_c_end", "gas_max_pressure_mpa", "cyc_p_z",
    "phi_open_deg", "p_open", "phi_scavenge_deg", "phi_close_deg",
)  # fmt: skip


def dynamics(chapter: Chapter) -> Markup:
    """Masses, pressure of the gases and the forces of one cylinder."""
    terms, gas = chapter.terms, chapter.input.gas
    polytropic = not isinstance(gas, TableGasSection | RoundedGasSection)
    return chapter.page(
        "dynamics",
        peak=facts.greatest_pressure(terms)[2],
        corners=_corners(terms, two_stroke=chapter.shape.strokes == 2),
        points=chapter.scalars("Характерные точки индикаторной диаграммы", _POINTS, keep=True),
        polytropic=polytropic,
        rounded=partial(_rounded_text, chapter),
        smooth=diagram_kind(chapter.input.gas) == "smooth",
        indicated=_indicated(chapter.input),
        pressure=_pressure_tex(terms) if polytropic else "",
        pressure_at=partial(_pressure_at, terms),
        masses=[key for key in ("m_1", "m_2", "m_j") if _is_computed(chapter, key)],
        mass_notes=partial(_mass_notes, chapter),
        rods=partial(rods_text, chapter),
        inertia={"tdc": terms.num("P4_1.Pj_MPa", 360.0), "bdc": terms.num("P4_1.Pj_MPa", 180.0)},
        from_cycle=chapter.input.gas.source == "cycle",
    )


def _is_computed(chapter: Chapter, key: str) -> bool:
    """Whether a mass follows from others and is not simply given."""
    scalar = chapter.model.scalars.get(key)
    return scalar is not None and any(sign in scalar.expr for sign in "+-*/")


def _mass_notes(chapter: Chapter) -> Markup:
    """How the masses and the rod were found, Gots 2.2, with their table."""
    given, scalars = chapter.input.masses, chapter.terms.values.scalars
    lists = [block for block in chapter.model.blocks if isinstance(block, ScalarTable)]
    sheet = next(block.sheet for block in lists if block.id == "specific_masses")
    listed = [scalar for block in lists if block.sheet == sheet for scalar in block.scalars]
    keys = [scalar.key for scalar in listed if scalar.of != "verdict"]
    verdicts = [
        scalar
        for block in lists
        if block.id == "specific_masses"
        for scalar in block.scalars
        if scalar.of == "verdict" and scalars[scalar.key] == NO
    ]
    return chapter.page(
        "masses",
        plan=chapter.scalars("Массы и шатун", keys, size="dense"),
        keys=keys,
        estimated=given.estimate_fuel is not None,
        weighed=given.rod_weighed_small_end_kg is not None,
        swung=given.swing_edges_mm is not None,
        outside=[_outside(chapter.terms, verdict.key, verdict.note) for verdict in verdicts],
    )


def _outside(terms: Terms, verdict: str, limits: str) -> Markup:
    """What lies outside the limits of table 4, with its value."""
    name = verdict.removesuffix("_fits")
    said = limits.partition(": ")[2] or limits.rpartition(" ")[2]
    return Markup("{} {} ({})").format(terms.title(name), terms.val(name), rich(said))


def _indicated(model: InputFile) -> dict[str, str]:
    """Figures of a diagram by points as they are printed; nothing of another one."""
    if not isinstance(model.gas, TableGasSection):
        return {}
    found = indicated_of(model, model.gas, sizes_of(model))
    printed = {
        "peak": (found.peak, 3), "peak_at": (found.peak_at, 1), "intake": (found.intake, 3),
        "compression": (found.compression, 2), "expansion": (found.expansion, 2),
    }  # fmt: skip
    return {
        key: "" if value is None else fixed(value, digits)
        for key, (value, digits) in printed.items()
    }


def _rounded_text(chapter: Chapter) -> Markup:
    """Text and table of the rounded diagram of figure 22; nothing for another one."""
    if not isinstance(chapter.input.gas, RoundedGasSection):
        return Markup("")
    build = partial(_nodes, chapter.terms)
    plan = TablePlan(build, "Точки скруглённой индикаторной диаграммы", keep=True)
    return chapter.page("diagram", plan=plan)


def _nodes(terms: Terms) -> TableBlock:
    nodes = next(b for b in terms.model.blocks if isinstance(b, Grid) and b.id == "nodes")
    wanted = (("node_deg{}", 1), ("node_MPa{}", 3), ("node_slope{}", 4))
    rows = [
        [name.replace("′", "'").replace("″", "''"),
         *(fixed(terms.value(key.format(n)), digits) for key, digits in wanted)]
        for n, name in enumerate(nodes.labels, 1)
    ]  # fmt: skip
    heads = ("φ, °", "p, МПа", "Наклон, МПа/°")
    return table_block([Column("Точка", text=True), *map(Column, heads)], rows)


_PRESSURE = "gas.p_MPa"


def _processes(terms: Terms) -> dict[str, str]:
    """Symbol of each process of the gas that has a column of its own → the column."""
    columns = terms.model.tables["gas"].columns
    names = [f"gas.{c.key}" for c in columns if c.helper and c.key.startswith("p_")]
    return {terms.tex(name): name for name in names}


def _pressure_tex(terms: Terms) -> str:
    """All branches of the pressure with the ranges of angles in which they hold."""
    branches, low, processes = [], "", _processes(terms)
    for outer in terms.branches(_PRESSURE):
        process = processes.get(outer.formula)
        inner = terms.branches(process) if process else [outer]
        for piece in inner:
            condition = piece.condition or outer.condition
            if condition is None:
                branches.append((piece.formula, rf"\varphi > {low},"))
                continue
            limit = condition.split(r"\leq ")[1]
            limit += r"^{\circ}" if limit.isdigit() and limit != "0" else ""
            span = rf"{low} < \varphi \leq {limit}" if low else rf"\varphi = {limit}"
            branches.append((piece.formula, span))
            low = limit
    return cases(f"{terms.tex(_PRESSURE)} =", branches)


def _pressure_at(terms: Terms, at: float) -> str:
    """The pressure at an angle with numbers, by the process that is in force there."""
    symbol = terms.tex(_PRESSURE)
    shown = terms.formula(_PRESSURE, at).removeprefix(f"{symbol} = ")
    process = _processes(terms).get(shown, _PRESSURE)
    return symbol + terms.substitution(process, at).removeprefix(terms.tex(process))


def _corners(terms: Terms, *, two_stroke: bool) -> list[Row]:
    """Points of the cycle that lie on the grid: a, z, r, b."""
    start = terms.value("phi_close_deg") if two_stroke and terms.has("phi_close_deg") else 180.0
    corners = [("$a$", terms.row("gas", start)), ("$z$", int(terms.column("gas.p_MPa").argmax()))]
    if not two_stroke:
        corners.append(("$r$", 0))
    if terms.has("phi_open_deg"):
        before = np.asarray(terms.model.tables["gas"].rows) <= terms.value("phi_open_deg") + 1e-9
        corners.append(("$b$", int(np.flatnonzero(before)[-1])))
    return corners
