"""Chapters on kinematics, dynamics and torque (figures 41-49, 56, 57), reference tables."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np
from markupsafe import Markup

from reports.document.chapters.chapter import (
    Chapter,
    half_torque_gap,
    pin_torque,
    worst_running,
)
from reports.document.chapters.rationale import judge, several_rods
from reports.document.figures.schemes import mechanism_sketch, velocity_sketch
from reports.document.page.blocks import TableBlock, TableColumn, symbol_head, table_block
from reports.document.page.charts import Row, mechanism_of
from reports.document.page.numbering import Figure, TablePlan
from reports.document.text.terms import Terms, with_unit
from reports.document.text.tex import cases
from reports.document.text.texts import of_digits, rich
from reports.formula.numeric import evaluate
from reports.inputs.checks.gas import indicated_of
from reports.inputs.sections.gas import RoundedGasSection, TableGasSection
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.masses import Sizes, sizes_of
from reports.model.blocks import NO, Grid, ScalarTable
from reports.model.charts import Series
from reports.model.context import diagram_kind
from reports.model.shape import rods_table
from reports.shared.russian import NBSP, fixed, short
from reports.tables.cycle_members import section_of
from reports.tables.verdicts import reasons_of

EXAMPLE = 30.0  # crank angle of the worked lines [deg]; every grid has it
# Sizes of the mechanism, one of which follows from another.
_SIZES = {
    "r_crank": "радиус кривошипа", "L_rod": "длина шатуна",
    "lam": "отношение радиуса кривошипа к длине шатуна", "S_stroke": "ход поршня",
    "F_piston": "площадь поршня",
}  # fmt: skip
_ERRORS = tuple(
    key
    for name in ("s", "v", "j", "Pj", "N", "T", "M")
    for key in (f"e{name}_max", f"phi_e{name}_deg", f"e{name}_rel")
)
_POINTS = (
    "phi_c_deg", "p_start", "p_c_end", "gas_max_pressure_mpa", "cyc_p_z",
    "phi_open_deg", "p_open", "phi_scavenge_deg", "phi_close_deg",
)  # fmt: skip
_DIGITS = 2  # decimals of a pressure in a sentence
_TDC = "(360 + phi_tdc_deg)"
_BEFORE = "min({pz}, p_start + ({pz} - p_start)*({tdc} - phi_c_deg)/gas_injection_advance_deg)"
# Ratios of table 4 as the chapter on the data calls them.
_RATIOS = {"area_piston": "piston_mass", "area_rod": "rod_mass", "area_throw": "throw_mass",
           "rod_share": "rod_share"}  # fmt: skip
_BY_FORMULA = ("geometry", "masses")  # lists whose values stand behind their formulas
_PRESSURE = "gas.p_MPa"
_MAX_PANELS = 2


def kinematics(chapter: Chapter) -> Markup:
    """Kinematics of piston and rod, and of articulated rods where there are some."""
    terms, offset = chapter.terms, chapter.shape.offset
    lam = min(max(terms.value("lam"), 0.1), 0.6)
    k = min(max(terms.value("k_offset"), -0.6), 0.6) if offset else 0.0
    word = "дезаксиального" if offset else "центрального"
    sketch = Figure(
        partial(mechanism_sketch, lam, k=k),
        f"Схема {word} кривошипно-шатунного механизма: а{NBSP}— размеры и углы; б{NBSP}— силы",
    )
    half = terms.value("P3_1.s_mm", 90.0) / (1000 * terms.value("S_stroke"))
    following = {key: words for key, words in _SIZES.items() if key not in _given_sizes(terms)}
    template = "offset" if offset else "kinematics"
    page = chapter.page(template, sketch=sketch, at=EXAMPLE, half=fixed(half, 3),
                        following=following)  # fmt: skip
    return page + (chapter.page("articulated") if chapter.shape.articulated else "")


def _given_sizes(terms: Terms) -> set[str]:
    """Sizes of the mechanism that the input gives; those from which they would follow are not."""
    sizes = {
        "r_crank": terms.has("geometry_crank_radius_mm"),
        "L_rod": terms.has("geometry_rod_length_mm"),
        "lam": terms.has("geometry_lambda"),
        "S_stroke": terms.has("geometry_stroke_mm"),
    }
    return {key for key, is_given in sizes.items() if is_given}


def reference(chapter: Chapter) -> Markup:
    """Errors of the approximation, figure 20 and, where asked for, tables 1-8."""
    terms, section = chapter.terms, chapter.input.reference
    sketch = velocity = None
    tables: list[tuple[str, TablePlan]] = []
    if section is not None:
        lam, angle = terms.value("lam"), section.angle_deg
        velocity = Figure(
            partial(velocity_sketch, lam, angle), "Графическое определение скорости поршня"
        )
        if 0.1 <= lam <= 0.6 and 10 <= angle <= 80:
            sketch = Figure(partial(mechanism_sketch, lam, angle), "Движение шатуна: схема и силы")
        for name, table in chapter.model.tables.items():
            if table.columns[-1].key.startswith("ref_lambda"):
                build = partial(_table, terms, name, len(section.lambdas))
                tables.append((name, TablePlan(build, table.title, size="dense")))
    return chapter.page(
        "reference",
        errors=chapter.scalars("Наибольшие погрешности", _ERRORS, size="dense"),
        asked=section is not None,
        sketch=sketch,
        velocity=velocity,
        tables=tables,
        left_out=_left_out(chapter),
    )


def _left_out(chapter: Chapter) -> str:
    """λk: what the offset's force is of the first order, beside the vectors; nothing without."""
    value = chapter.terms.value
    return fixed(abs(value("lam") * value("k_offset")), 3) if chapter.shape.offset else ""


def _table(terms: Terms, table: str, count: int) -> TableBlock:
    numbers = range(1, count + 1)
    rows = [
        [
            fixed(angle, 0),
            *(fixed(terms.value(f"{table}.ref_lambda{n}", angle), 3) for n in numbers),
        ]
        for angle in terms.model.tables[table].rows
    ]
    heads = (short(terms.value(f"reference_lambda_{n}_value"), 4) for n in numbers)
    columns = [
        TableColumn(symbol_head(r"\varphi", "°")),
        *(TableColumn(f"λ = {head}") for head in heads),
    ]
    return table_block(columns, rows)


def dynamics(chapter: Chapter) -> Markup:
    """Masses, pressure of the gases and the forces of one cylinder."""
    terms, gas = chapter.terms, chapter.input.gas
    polytropic = not isinstance(gas, TableGasSection | RoundedGasSection)
    return chapter.page(
        "dynamics",
        peak=greatest_pressure(chapter).between,
        corners=_corners(terms, two_stroke=chapter.shape.strokes == 2),
        points=chapter.scalars("Характерные точки индикаторной диаграммы", _POINTS, keep=True),
        polytropic=polytropic,
        rounded=partial(_rounded_text, chapter),
        smooth=diagram_kind(chapter.input.gas) == "smooth",
        indicated=_indicated(chapter.input),
        jump=_jump(terms) if polytropic else None,
        pressure=_pressure_tex(terms) if polytropic else "",
        pressure_at=partial(_pressure_at, terms),
        masses=[key for key in ("m_1", "m_2", "m_j") if _is_computed(chapter, key)],
        mass_notes=partial(_mass_notes, chapter),
        rods=partial(rods_text, chapter),
        inertia={"tdc": terms.num("P4_1.Pj_MPa", 360.0), "bdc": terms.num("P4_1.Pj_MPa", 180.0)},
        from_cycle=chapter.input.gas.source == "cycle",
    )


@dataclass(frozen=True, slots=True)
class GasPeak:
    """The greatest pressure of the gases, printed, with its place in words.

    ``angle`` [deg] is its row in the table, None after a jump in the dead centre; ``between`` is
    the greatest one where it stands between the rows, empty without.
    """

    pressure: Markup
    where: str
    angle: float | None
    between: Markup | str


def greatest_pressure(chapter: Chapter) -> GasPeak:
    """Greatest pressure: that after a jump in the dead centre, else that of the table."""
    terms = chapter.terms
    column, unit = terms.column("gas.p_MPa"), terms.unit("gas.p_MPa")
    row = int(column.argmax())
    names = [name for name in ("cyc_p_z", "gas_max_pressure_mpa") if terms.has(name)]
    most = terms.value(names[0]) if names else 0.0
    angle = float(terms.model.tables["gas"].rows[row])
    in_table, peak = (fixed(float(value), _DIGITS) for value in (column[row], most))
    missed = most > column[row] + 0.5 * 10.0**-_DIGITS
    between = with_unit(peak, unit) if missed else ""
    if not isinstance(chapter.input.gas, TableGasSection | RoundedGasSection) and _jump(terms):
        return GasPeak(with_unit(peak, unit), "в ВМТ после скачка", None, between)
    return GasPeak(with_unit(in_table, unit), f"при φ = {fixed(angle, 0)}°", angle, between)


def _jump(terms: Terms) -> tuple[Markup, Markup] | None:
    """Pressures before and after the top dead centre where they are printed apart."""
    name = "cyc_p_z" if terms.has("cyc_p_z") else "gas_max_pressure_mpa"
    text = _BEFORE.format(pz=name, tdc=_TDC if terms.has("phi_tdc_deg") else "360")
    before, after = float(evaluate(text, terms.value)), terms.value(name)
    texts = [fixed(value, 2) for value in (before, after)]
    if texts[0] == texts[1]:
        return None
    return with_unit(texts[0], "МПа"), with_unit(texts[1], "МПа")


def _is_computed(chapter: Chapter, key: str) -> bool:
    """Whether a mass follows from others and is not simply given."""
    scalar = chapter.model.scalars.get(key)
    return scalar is not None and any(sign in scalar.expr for sign in "+-*/")


def _mass_notes(chapter: Chapter) -> Markup:
    """How the masses and the rod were found, Gots 2.2, with their table."""
    masses, scalars = chapter.input.masses, chapter.terms.values.scalars
    lists = [block for block in chapter.model.blocks if isinstance(block, ScalarTable)]
    sheet = next(block.sheet for block in lists if block.id == "specific_masses")
    listed = [
        scalar
        for block in lists
        if block.sheet == sheet and block.id not in _BY_FORMULA
        for scalar in block.scalars
    ]
    keys = [scalar.key for scalar in listed if scalar.of != "verdict"]
    verdicts = [
        scalar
        for block in lists
        if block.id == "specific_masses"
        for scalar in block.scalars
        if scalar.of == "verdict" and scalars[scalar.key] == NO
    ]
    # What the chapter on the data judges is not judged twice.
    written = "rationale" in chapter.relevant
    mentioned = {each.reason.key for each in judge(chapter)} if written else set()
    shown = [v for v in verdicts if _RATIOS[v.key.removesuffix("_fits")] not in mentioned]
    return chapter.page(
        "masses",
        plan=chapter.scalars("Массы и шатун", keys, size="dense"),
        keys=keys,
        estimated=masses.estimate_fuel is not None,
        weighed=masses.rod_weighed_small_end_kg is not None,
        swung=masses.swing_edges_mm is not None,
        outside=[_outside(chapter.terms, verdict.key, verdict.note) for verdict in shown],
        of_one_rod=[_RATIOS[v.key.removesuffix("_fits")] for v in shown] == ["throw_mass"]
        and several_rods(chapter.input),
        grown=Sizes(mechanism_of(chapter.terms).bore, 0.0, 0.0).heavier > 1,
    )


def _outside(terms: Terms, verdict: str, limits: str) -> Markup:
    """Return what lies outside the limits of table 4, with its value."""
    name = verdict.removesuffix("_fits")
    said = limits.partition(": ")[2] or limits.rpartition(" ")[2]
    return Markup("{} {} ({})").format(terms.title(name), terms.val(name), rich(said))


def _indicated(model: InputFile) -> dict[str, str]:
    """Figures of a diagram by points as they are printed; nothing of another one."""
    if not isinstance(model.gas, TableGasSection):
        return {}
    indicated = indicated_of(model, model.gas, sizes_of(model))
    printed = {
        "peak": (indicated.peak, 3), "peak_at": (indicated.peak_at, 1),
        "intake": (indicated.intake, 3),
        "compression": (indicated.compression, 2), "expansion": (indicated.expansion, 2),
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
    return table_block([TableColumn("Точка", text=True), *map(TableColumn, heads)], rows)


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
    """Return the pressure at an angle with numbers, by the process that is in force there."""
    symbol = terms.tex(_PRESSURE)
    formula = terms.formula(_PRESSURE, at).removeprefix(f"{symbol} = ")
    process = _processes(terms).get(formula, _PRESSURE)
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


def rods_text(chapter: Chapter) -> Markup:
    """Return sums of the forces of two rods on a throw; nothing where throws carry one."""
    shape = chapter.shape
    if shape.single_rods:
        return Markup("")
    tables = [rods_table(k) for k in range(1, shape.throws + 1)]
    hung = f"cylinder_{shape.cylinders}" if shape.articulated else ""
    return chapter.page("rods", rods=rods_table(1), group=shape.groups[0], hung=hung, tables=tables)


def torque(chapter: Chapter) -> Markup:
    """Total torque, its mean and extremes, the check against the indicated power."""
    terms = chapter.terms
    mean = terms.value("M_mean")
    return chapter.page(
        "torque",
        cylinders=chapter.input.engine.cylinders,
        intervals=_intervals(chapter),
        has_power=terms.has("T_ref"),
        agrees=terms.agrees("check_power"),
        accepted=reasons_of(chapter.input).get("power", "").rstrip("."),
        powers=_powers(chapter) if terms.has("cyc_N_gas") else None,
        coarse=any(error.key in ("M_mean", "N_i_calc") for error in chapter.grid_errors),
        swing=chapter.told_range("M_max", "M_min"),
        ratio=fixed(terms.value("M_max") / mean, 1) if mean > 0 else "",
    )


def _powers(chapter: Chapter) -> TablePlan:
    """From the pressure of the diagram that is not rounded to the effective one, Gots 2.8."""
    terms, step = chapter.terms, fixed(chapter.input.calculation.step_deg, 0)
    section = section_of(chapter.input)
    subtracted = section is not None and section.pumping == "yes"
    losses = " и за вычетом насосных потерь" if subtracted else ""
    steps = (
        ("Нескруглённая диаграмма без насосных ходов", "cyc_p_theory", "", ""),
        ("Нескруглённая диаграмма с насосными ходами", "", "cyc_N_gas", ""),
        (
            f"Динамический расчёт по той же диаграмме с шагом {step}°",
            "p_i_calc",
            "N_i_calc",
            "M_mean",
        ),
        (
            f"Первая диаграмма с коэффициентом полноты {terms.sym('cycle_fullness')} = "
            f"{terms.num('cycle_fullness')}{losses}",
            "cyc_p_i",
            "cyc_N_i",
            "",
        ),
        (
            f"То же с механическим КПД {terms.sym('cyc_eta_m')} = {terms.num('cyc_eta_m')}",
            "cyc_p_e",
            "cyc_N_e",
            "cyc_M_e",
        ),
    )
    columns = [TableColumn("Диаграмма", 3.6, text=True), TableColumn("Среднее давление, МПа", 1.9),
               TableColumn("Мощность, кВт", 1.9), TableColumn("Момент, Н·м", 1.7)]  # fmt: skip

    def cell(name: str) -> str:
        return f"{terms.sym(name)} = {terms.num(name)}" if name else "—"

    build = partial(
        table_block,
        columns,
        [[Markup(title), *(Markup(cell(name)) for name in names)] for title, *names in steps],
    )
    return TablePlan(build, "Мощности расчёта цикла и динамического расчёта", keep=True)


def _intervals(chapter: Chapter) -> list[str]:
    """Return the different intervals between the beginnings of the power strokes [deg]."""
    starts = list(chapter.strokes_at)
    gaps = [b - a for a, b in pairwise([*starts, starts[0] + chapter.shape.period])]
    return [f"{short(gap)}°" for gap in sorted({round(gap, 2) for gap in gaps})]


def running(chapter: Chapter) -> Markup:
    """Running-on torques on main journals and crankpins, ranges, the most loaded ones."""
    terms, count = chapter.terms, chapter.shape.throws
    main = [f"fig56_{k}" for k in range(2, count + 2)]
    pins = [f"fig57_{i}" for i in range(1, count + 1)]
    gap = half_torque_gap(terms, count)
    mains, worst = worst_running(terms, count)
    if not chapter.whole:
        main, pins = [f"fig56_{mains[0]}"], [f"fig57_{worst[0]}"]
    digits = terms.quantity("dM_pin1").digits  # as in the table of the ranges
    return chapter.page(
        "running",
        shown=[*_figures(main), *_figures(pins)],
        some=not chapter.whole and count > 1,
        ranges=TablePlan(partial(_ranges, terms, count), "Размах набегающих моментов", keep=True),
        last=count + 1,
        count=count,
        gap=of_digits(gap, digits) if gap > 0.5 * 10**-digits.decimals else "",
        statics=_statics(terms, count),
        beside=not (chapter.shape.single_rods or chapter.shape.articulated),
        mains=mains,
        pins=worst,
    )


def _statics(terms: Terms, count: int) -> dict[str, tuple[Series, ...]]:
    """Curves of figure 57 by statics, where they differ from the rule."""
    columns = {i: pin_torque(terms, count, i) for i in range(1, count + 1)}
    return {
        f"fig57_{i}": (Series(f"{name.partition('.')[0]}.phi_deg", name),)
        for i, name in columns.items()
    }


def _figures(charts: list[str]) -> list[list[str]]:
    """Charts in as few figures as will do, as many in each."""
    count = -(-len(charts) // _MAX_PANELS)
    size = -(-len(charts) // count)
    return [charts[start : start + size] for start in range(0, len(charts), size)]


def _ranges(terms: Terms, count: int) -> TableBlock:
    heads = (r"M_{\max}", r"M_{\min}", r"\Delta M")
    columns = [
        TableColumn("Шейка", 2.4, text=True),
        *(TableColumn(symbol_head(h, "Н·м")) for h in heads),
    ]
    names = [(f"коренная {k}", f"P4_4.Mmain{k}_Nm", f"dM_main{k}") for k in range(2, count + 2)]
    names += [(f"шатунная {i}", pin_torque(terms, count, i), "") for i in range(1, count + 1)]
    rows = []
    for title, column, key in names:
        values = terms.column(column)
        swing = terms.value(key) if key else float(np.ptp(values))
        numbers = (float(values.max()), float(values.min()), swing)
        digits = terms.quantity("dM_pin1").digits  # as in the text below the table
        rows.append([title, *(of_digits(number, digits) for number in numbers)])
    return table_block(columns, rows)
