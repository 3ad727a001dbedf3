"""Chapter on the main journals: throws, reactions, diagrams of each (figures 53-55)."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.chapters.crankpin import ray_sums, wear_figure
from reports.document.chapters.plots import over_phi, phi
from reports.document.chapters.torque import firing_order, worst
from reports.document.figures import Level, Pole, crank_scheme, polar_path
from reports.document.page.blocks import Column, TableBlock, symbol_head, table_block
from reports.document.page.spec_tables import grid_table
from reports.document.page.writer import Figure, TablePlan
from reports.document.text.terms import Terms
from reports.spec.blocks import Grid

_FORCES = ("C1", "C2", "C3", "C4", "C5", "C6", "C7", "C8", "C9", "C10", "C11", "C12", "C13",
           "C14", "C15", "C4x", "C5x")  # fmt: skip
_REACTIONS = ("length", "share", "share2", "RKCL", "RTCL", "RKCP", "RTCP")
_SUM_COLUMNS = 7  # journals in one table of sums


def journals(chapter: Chapter) -> Markup:
    """Reactions of the bearings on every main journal."""
    terms, rays = chapter.terms, chapter.input.calculation.wear_rays
    throws = chapter.shape.throws
    numbers = list(range(1, throws + 2))
    k = worst(terms, "worst_main_load")
    neighbours = [("a", k - 1, "правой"), ("b", k, "левой")]
    size = "" if throws <= 5 else "dense" if throws <= 7 else "tiny"
    return chapter.page(
        "journals.html.j2",
        scheme=Figure(
            partial(crank_scheme, chapter.input.crankshaft.throw_angles_deg),
            "Схема коленчатого вала: вид сбоку и с носка",
        ),
        order=firing_order(chapter),
        throws=throws,
        forces=TablePlan(
            partial(_throws, terms, _FORCES), "Центробежные силы колен", size=size, keep=True
        ),
        reactions=TablePlan(
            partial(_throws, terms, _REACTIONS),
            "Пролёты колен и реакции опор от центробежных сил",
            size=size,
            keep=True,
        ),
        loads=TablePlan(
            partial(_loads, terms, numbers), "Нагрузки на коренные шейки", size="dense", keep=True
        ),
        sums=_sum_plans(terms, numbers, rays),
        figures=[(number, _figures(terms, number, rays)) for number in numbers],
        worst=k,
        sides=[(side, i, word) for side, i, word in neighbours if 1 <= i <= throws],
        forced=chapter.input.crankshaft.force_offsets_deg is not None,
        at=chapter.example,
    )


def _throws(terms: Terms, keys: tuple[str, ...]) -> TableBlock:
    grid = next(b for b in terms.model.blocks if isinstance(b, Grid) and b.id == "throws")
    block = grid_table(terms, grid, keys, "Величина")
    columns = [block.columns[0], *(Column(label.capitalize()) for label in grid.labels)]
    return table_block(columns, block.rows)


def _loads(terms: Terms, numbers: list[int]) -> TableBlock:
    columns = [
        Column("Шейка", 0.8),
        Column(symbol_head(r"R'_{\max}", "МПа")),
        Column(symbol_head(r"\varphi_{\max}", "°")),
        Column(symbol_head(r"R'_{\min}", "МПа")),
        Column(symbol_head(r"\varphi_{\min}", "°")),
        Column(symbol_head(r"R'_{\mathrm{ср}}", "МПа")),
        Column(symbol_head(r"R_{\max}", "кН")),
        Column(symbol_head(r"q_{\max}", "МПа")),
        Column(symbol_head(r"q_{\mathrm{ср}}", "МПа")),
        Column(symbol_head(r"\alpha_{\mathrm{м}}", "°"), 0.8),
    ]
    rows = []
    for k in numbers:
        keys = (
            f"Rmain{k}_max", f"phi_Rmain{k}_max_deg", f"Rmain{k}_min", f"phi_Rmain{k}_min_deg",
            f"Rmain{k}_mean", f"Rmain{k}_max_kN", f"q_main{k}_max", f"q_main{k}_mean",
            f"hole_main{k}_deg",
        )  # fmt: skip
        rows.append([str(k), *(terms.num(key) for key in keys)])
    return table_block(columns, rows)


def _sum_plans(terms: Terms, numbers: list[int], rays: int) -> list[tuple[str, TablePlan]]:
    plans = []
    for start in range(0, len(numbers), _SUM_COLUMNS):
        chunk = numbers[start : start + _SUM_COLUMNS]
        names = [f"main{k}" for k in chunk]
        heads = [rf"\Sigma R'_{{{k}}}" for k in chunk]
        last = f"{chunk[0]}–{chunk[-1]}" if len(chunk) > 1 else str(chunk[0])
        plan = TablePlan(
            partial(ray_sums, terms, names, heads, rays),
            f"Суммы удельных сил по лучам коренных шеек {last}",
            keep=True,
            size="dense" if len(chunk) > 4 else "",
        )
        plans.append((f"sums_main_{start}", plan))
    return plans


def _figures(terms: Terms, k: int, rays: int) -> dict[str, Figure]:
    table = f"P4_3_{k}"
    x, y = (terms.tex(f"{table}.{key}") for key in ("Rx_MPa", "Ry_MPa"))
    polar = partial(
        polar_path,
        terms.column(f"{table}.Rx_MPa"),
        terms.column(f"{table}.Ry_MPa"),
        phi(terms, table),
        f"${x}$, МПа",
        f"${y}$, МПа",
        invert=(True, False),
        poles=(Pole("$O$"),),
        most=100.0,
    )
    return {
        "polar": Figure(polar, f"Полярная диаграмма удельной нагрузки на коренную шейку {k}"),
        "wear": wear_figure(
            terms, f"main{k}", rays, f"Условная диаграмма износа коренной шейки {k}", "ось y", 84.0
        ),
        "unfolded": over_phi(
            terms,
            f"Развёрнутая диаграмма нагрузки на коренную шейку {k}",
            rf"${terms.tex(f'{table}.R_MPa')}$, МПа",
            f"{table}.R_MPa",
            height=64.0,
            levels=(Level(r"$R'_{\mathrm{ср}}$", terms.value(f"Rmain{k}_mean")),),
        ),
    }
