"""Chapters on crankpins and main journals: loads, wear, oil holes (figures 50-55)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial
from itertools import pairwise

import numpy as np
from markupsafe import Markup

from kshm.nomenclature.quantity import roman
from reports.document.chapters.chapter import (
    Chapter,
    leaders,
    pin_stems,
    stretched,
    worst_pin,
)
from reports.document.figures.schemes import crank_scheme
from reports.document.page.blocks import (
    TableBlock,
    TableColumn,
    grid_table,
    symbol_head,
    table_block,
)
from reports.document.page.numbering import Figure, TablePlan
from reports.document.text.symbols import inline_html
from reports.document.text.terms import Terms, crankcase_scavenges, with_unit
from reports.formula.parse import names
from reports.model.shape import pin_figure, pin_table, rays_table
from reports.shared.russian import capital, fixed, instrumental, joined

_FORCES = ("C1", "C2", "C3", "C4", "C5", "C6", "C7", "C8", "C9", "C10", "C11", "C12", "C13",
           "C14", "C15", "C4x", "C5x")  # fmt: skip
_REACTIONS = ("length", "share", "share2", "RKCL", "RTCL", "RKCP", "RTCP")
_ARMS = tuple(f"throw1_{key}" for key in ("arm_left", "arm_rod", "arm_rod2", "arm_pin",
                                          "arm_right", "length"))  # fmt: skip
# Arms of the ends' counterweights with their forces across and along the throw.
_OUTER = {"crankshaft_nose_arm_mm": ("C10", "C11"), "crankshaft_rear_arm_mm": ("C12", "C13")}
_HALVES = "; половины шеек: л — левого ряда, п — правого"
_SUM_DIGITS = 2
_SUM_COLUMNS = 7  # the most journals in one table of sums
# Columns of a table of loads: key of the scalar, symbol, unit.
_LARGEST_ROWS = (("R{}_max", r"R'_{\max}", "МПа"), ("phi_R{}_max_deg", r"\varphi_{\max}", "°"))
_SMALLEST_ROWS = (("R{}_min", r"R'_{\min}", "МПа"), ("phi_R{}_min_deg", r"\varphi_{\min}", "°"))
_MEAN = (
    ("R{}_mean", r"R'_{\mathrm{ср}}", "МПа"),
    ("R{}_max_kN", r"R_{\max}", "кН"),
    ("q_{}_max", r"q_{\max}", "МПа"),
    ("q_{}_mean", r"q_{\mathrm{ср}}", "МПа"),
    ("hole_{}_deg", r"\alpha_{\mathrm{м}}", "°"),
)
_MAX_SHOWN = 3
_THREE_MOMENTS = (
    r"X_{k-1} l_{k-1} + 2 X_k (l_{k-1} + l_k) + X_{k+1} l_k ="
    r" -\sum P \dfrac{u\,(l_{k-1}^2 - u^2)}{l_{k-1}}"
    r" - \sum P \dfrac{u'\,(l_k^2 - \left(u'\right)^2)}{l_k}"
)
_BENDING = (
    "alpha_oil_deg", "Ralpha_max", "Ralpha_min", "Malpha_max", "Malpha_min", "Malpha_swing",
    "Malpha_mean", "alpha_best_deg", "Mbest_swing",
)  # fmt: skip


def crankpin(chapter: Chapter) -> Markup:
    """Return loads on the crankpins, wear and the best place of the oil hole."""
    terms, rays, pins = chapter.terms, chapter.input.calculation.wear_rays, chapter.shape.pins
    numbers = range(1, len(pins) + 1)
    names, worst = pin_stems(chapter.shape), worst_pin(terms)
    others, name = [n for n in numbers if n != worst], names[worst - 1]
    loads = partial(_loads, terms, names, (*_LARGEST_ROWS, *_MEAN), 1.0)
    number = f" {worst}" if others else ""
    head = rf"\Sigma R'_{{\mathrm{{ш.ш}}{number.strip()}}}"
    sums = partial(_ray_sums, terms, [name], [head], rays)
    drawn = {figure: pin_figure(figure, worst) for figure in ("fig50", "fig51", "fig52")}
    return chapter.page(
        "crankpin",
        several=pins[worst - 1] if len(pins[worst - 1]) > 1 else (),
        own_rods=chapter.shape.rods_beside > 1,
        pin=worst,
        name=name,
        own=pin_table(worst),
        own_rays=rays_table(worst),
        number=number,
        drawn=drawn,
        others=others,
        tables=[pin_table(n) for n in others],
        diagrams=[(pin_figure("fig50", n), pin_figure("fig52", n)) for n in others],
        same_curves=_are_alike(terms, [f"{pin_table(n)}.Rpin_MPa" for n in numbers]),
        same_loads=all(
            len(leaders(terms, [key.format(name) for name in names])) == len(names)
            for key, _, _ in (_LARGEST_ROWS[0], *_MEAN)
        ),
        same_gaps=_have_equal_gaps(chapter),
        pin_loads=TablePlan(loads, "Нагрузки на шатунные шейки", size="dense"),
        worst_pins=leaders(terms, [f"R{name}_max" for name in names]),
        pressed=leaders(terms, [f"q_{name}_max" for name in names]),
        rays=rays,
        sums=TablePlan(sums, f"Суммы удельных сил по лучам шатунной шейки{number}", keep=True),
        best=least_ray(terms, name),
        crankcase=crankcase_scavenges(chapter.input),
        film="oil" in chapter.relevant
        and terms.has("oil_film1_deg")
        and chapter.input.crankshaft.oil_hole_deg is None,
        ties=_least_rays(terms, name, rays),
        arc=max(terms.value(f"{name}_arc{i}") for i in range(1, rays + 1)),
    )


def _are_alike(terms: Terms, columns: Sequence[str]) -> bool:
    """Whether columns over a cycle hold the same values, at whatever angles."""
    # The last row repeats the first.
    first, *others = (np.sort(terms.column(name)[:-1]) for name in columns)
    scale = float(np.abs(first).max())
    return all(np.allclose(first, other, rtol=0, atol=1e-6 * scale) for other in others)


def at_once(terms: Terms, numbers: Sequence[int]) -> bool:
    """Whether the most loaded of the main journals are so at the same angle."""
    loads = leaders(terms, [f"Rmain{n}_max" for n in numbers])
    return len({terms.num(f"phi_Rmain{numbers[k - 1]}_max_deg") for k in loads}) == 1


def alike_journals(terms: Terms, throws: int) -> list[tuple[int, ...]]:
    """Main journals in groups that one table of loads serves: at every angle they are the same."""
    groups: list[tuple[int, ...]] = []
    for number in range(1, throws + 2):
        for index, group in enumerate(groups):
            if _is_same_load(terms, group[0], number):
                groups[index] = (*group, number)
                break
        else:
            groups.append((number,))
    return groups


def _is_same_load(terms: Terms, one: int, other: int) -> bool:
    scale = float(np.abs(terms.column(f"P4_3_{one}.R_MPa")).max())
    pairs = ((terms.column(f"P4_3_{one}.{key}"), terms.column(f"P4_3_{other}.{key}"))
             for key in ("Rx_MPa", "Ry_MPa"))  # fmt: skip
    return all(np.allclose(a, b, rtol=0, atol=1e-6 * scale) for a, b in pairs)


def _have_equal_gaps(chapter: Chapter) -> bool:
    """Whether the rods of every pin work at the same intervals, whatever the pin."""
    offsets, period = chapter.input.crankshaft.firing_offsets_deg, chapter.shape.period

    def gaps(pin: tuple[int, ...]) -> list[float]:
        starts = sorted(offsets[i - 1] % period for i in pin)
        return sorted(b - a for a, b in pairwise([*starts, starts[0] + period]))

    first, *others = map(gaps, chapter.shape.pins)
    return all(len(other) == len(first) and np.allclose(other, first) for other in others)


def least_ray(terms: Terms, pin: str) -> str:
    """Roman number of a crankpin's least loaded ray."""
    return roman(round(terms.value(f"hole_{pin}_ray")))


def _least_rays(terms: Terms, pin: str, rays: int) -> list[str]:
    """Roman numbers of the rays whose sums are the least as printed."""
    sums = [fixed(terms.value(f"{pin}_sum{i}"), _SUM_DIGITS) for i in range(1, rays + 1)]
    least = sums[round(terms.value(f"hole_{pin}_ray")) - 1]
    return [roman(i) for i, total in enumerate(sums, 1) if total == least]


def journals(chapter: Chapter) -> Markup:
    """Reactions of the bearings on every main journal."""
    terms, rays, throws = chapter.terms, chapter.input.calculation.wear_rays, chapter.shape.throws
    numbers = range(1, throws + 2)
    k = chapter.worst("worst_main_load")
    drawn = numbers if chapter.whole else [k]
    neighbours = [("a", k - 1, "правой", "i"), ("b", k, "левой", "i + 1")]
    absent = _absent_ends(chapter)
    share = -(-len(numbers) // -(-len(numbers) // _SUM_COLUMNS))  # of each of as few tables
    size = "" if throws <= 5 else "dense" if throws <= 7 else "tiny"
    loads = partial(
        _loads, terms, [f"main{n}" for n in numbers], (*_LARGEST_ROWS, *_SMALLEST_ROWS, *_MEAN), 0.8
    )  # fmt: skip
    idle = _idle_forces(chapter)
    return chapter.page(
        "journals",
        scheme=Figure(
            partial(
                crank_scheme,
                chapter.input.crankshaft.throw_angles_deg,
                split=chapter.input.crankshaft.split_pin_deg or 0.0,
            ),
            "Схема коленчатого вала: вид сбоку и с носка" + _HALVES * chapter.shape.split,
        ),
        throws_text=instrumental(throws, "коленом", "коленами"),
        arms=[name for name in (*_ARMS, *_OUTER) if name in _read_by_first(chapter) - absent],
        absent=absent,
        numbers=numbers,
        tables=[f"P4_3_{alike[0]}" for alike in alike_journals(terms, throws)],
        drawn=drawn,
        curves=[f"fig55_{n}" for n in drawn],
        forces=_throws(
            chapter, [k for k in _FORCES if k not in idle], "Центробежные силы колен", size
        ),
        idle=stretched(
            [Markup(inline_html(terms.tex(f"throw1_{key}"))) for key in _FORCES if key in idle]
        ),
        outer=not {"C10", "C11", "C12", "C13"} <= idle,
        reactions=_throws(
            chapter, _REACTIONS, "Пролёты колен и реакции опор от центробежных сил", size
        ),
        loads=TablePlan(loads, "Нагрузки на коренные шейки", size="dense", keep=True),
        sums=[
            (f"sums_main_{start}", _sums(terms, numbers[start : start + share], rays))
            for start in range(0, len(numbers), share)
        ],
        worst=k,
        pin_wear=pin_figure("fig52", worst_pin(terms)),
        leaders=leaders(terms, [f"Rmain{n}_max" for n in numbers]),
        at_once=at_once(terms, numbers),
        sides=[each for each in neighbours if 1 <= each[1] <= throws],
        forced=chapter.input.crankshaft.force_offsets_deg is not None,
    )


def _absent_ends(chapter: Chapter) -> set[str]:
    """Arms and forces of the counterweights that the ends of the shaft do not have."""
    crank = chapter.input.crankshaft
    masses = (crank.nose_mass_kg, crank.rear_mass_kg)
    return {
        name
        for mass, (arm, forces) in zip(masses, _OUTER.items(), strict=True)
        if not mass
        for name in (arm, *(f"throw1_{key}" for key in forces))
    }


def _read_by_first(chapter: Chapter) -> set[str]:
    """Return what the reactions of the first throw are found from."""
    scalars = chapter.model.scalars
    formulas = (scalars[f"throw1_{key}"].expr for key in ("RKCL", "RTCL", "RKCP", "RTCP"))
    return {name for expr in formulas if expr is not None for name in names(expr)}


def _idle_forces(chapter: Chapter) -> set[str]:
    """Centrifugal forces that are printed as zero on every throw."""
    rows = {row.of: row for row in chapter.grid("throws").rows if row.of in _FORCES}
    return {
        key
        for key, row in rows.items()
        if not any(chapter.terms.num(cell.key).strip("0,−") for cell in row.cells if cell)
    }


def _throws(chapter: Chapter, keys: Iterable[str], caption: str, size: str) -> TablePlan:
    grid = chapter.grid("throws")
    labels = [capital(label) for label in grid.labels]
    build = partial(grid_table, chapter.terms, grid, keys, labels)
    return TablePlan(build, caption, size=size, keep=True)


def _loads(
    terms: Terms, names: Sequence[str], wanted: Sequence[tuple[str, str, str]], last: float
) -> TableBlock:
    """Return loads of all crankpins or main journals side by side."""
    columns = [TableColumn(symbol_head(tex, unit)) for _, tex, unit in wanted[:-1]]
    _, tex, unit = wanted[-1]
    rows = [
        [str(number), *(_load(terms, key, name) for key, _, _ in wanted)]
        for number, name in enumerate(names, 1)
    ]
    return table_block(
        [TableColumn("Шейка", 0.8), *columns, TableColumn(symbol_head(tex, unit), last)], rows
    )


def _load(terms: Terms, key: str, name: str) -> str:
    """Return a load as printed; an unloaded journal has no angle."""
    idle = round(float(terms.value(f"R{name}_max")), 9) == 0
    return "—" if idle and key.endswith("_deg") else terms.num(key.format(name))


def _sums(terms: Terms, numbers: Sequence[int], rays: int) -> TablePlan:
    names = [f"main{k}" for k in numbers]
    heads = [rf"\Sigma R'_{{{k}}}" for k in numbers]
    ends = f"{numbers[0]}–{numbers[-1]}" if len(numbers) > 2 else joined(numbers)
    whose = "коренных шеек" if len(numbers) > 1 else "коренной шейки"
    return TablePlan(
        partial(_ray_sums, terms, names, heads, rays),
        f"Суммы удельных сил по лучам {whose} {ends}",
        keep=True,
        size="dense" if len(numbers) > 4 else "",
    )


def _ray_sums(terms: Terms, names: list[str], heads: list[str], rays: int) -> TableBlock:
    """Return sums of the forces by rays, a column for each surface."""
    columns = [TableColumn("Луч"), TableColumn(symbol_head(r"\alpha_{\mathrm{л}}", "°"))]
    columns += [TableColumn(symbol_head(head, "МПа")) for head in heads]
    rows = []
    for i in range(1, rays + 1):
        sums = [fixed(terms.value(f"{name}_sum{i}"), _SUM_DIGITS) for name in names]
        rows.append([roman(i), fixed(terms.value(f"{names[0]}_deg{i}"), 0), *sums])
    return table_block(columns, rows)


def bearings(chapter: Chapter) -> Markup:
    """Return loads on the bearings and what the strength of the shaft needs."""
    terms, first = chapter.terms, " 1" if chapter.shape.throws > 1 else ""
    schemes, listed = None, []
    if "continuous" in terms.model.tables:
        build = partial(grid_table, terms, chapter.grid("schemes"))
        schemes = TablePlan(build, "Разрезная и неразрезная схемы", keep=True)
        listed = [f"continuous_{k}" for k in _supports(terms)]
    return chapter.page(
        "bearings",
        several=len(chapter.shape.pins[0]) > 1,
        worst=chapter.worst("worst_main_load"),
        given=chapter.input.crankshaft.oil_hole_deg is not None,
        bending=chapter.scalars(f"Изгиб шатунной шейки{first}", _BENDING, keep=True),
        schemes=schemes,
        shown=listed,
        three_moments=_THREE_MOMENTS,
        continuous=concluded(chapter),
    )


def concluded(chapter: Chapter) -> Markup:
    """Return what the continuous shaft adds: its most loaded supports beside the other scheme."""
    terms = chapter.terms
    if "continuous" not in terms.model.tables:
        return Markup("")
    supports = leaders(terms, [f"Rc{k}_max" for k in range(1, chapter.shape.throws + 2)])
    k = supports[0]
    change = terms.value(f"dRc{k}_max")
    return Markup(
        "по схеме неразрезного вала наибольшая реакция — у {} {}: {} (давление {}), на {} {}, "
        "чем по разрезной"
    ).format(
        "опоры" if len(supports) == 1 else "опор", joined(supports), terms.val(f"Rc{k}_max"),
        terms.val(f"qc{k}_max"), with_unit(fixed(abs(change), 1), "%"),
        "больше" if change > 0 else "меньше",
    )  # fmt: skip


def _supports(terms: Terms) -> list[int]:
    """Supports whose greatest loads the two schemes find most apart."""
    count = sum(key.startswith("dRc") and key.endswith("_max") for key in terms.model.scalars)
    order = sorted(range(1, count + 1), key=lambda k: -abs(terms.value(f"dRc{k}_max")))
    return sorted(order[:_MAX_SHOWN])
