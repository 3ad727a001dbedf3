"""Chapters on the torque of the engine and the running-on torques (figures 49, 56, 57)."""

from __future__ import annotations

from functools import partial
from itertools import pairwise

import numpy as np
from markupsafe import Markup

from reports.document.chapters import facts
from reports.document.chapters.chapter import Chapter
from reports.document.page.blocks import Column, TableBlock, symbol_head, table_block
from reports.document.page.writer import TablePlan
from reports.document.text.numbers import of_digits
from reports.document.text.terms import Terms
from reports.model.blocks import YES
from reports.shared.russian import fixed, short
from reports.tables.verdicts import reasons_of

_MOST_PANELS = 2


def torque(chapter: Chapter) -> Markup:
    """Total torque, its mean and extremes, the check against the indicated power."""
    terms = chapter.terms
    mean = terms.value("M_mean")
    return chapter.page(
        "torque",
        cylinders=chapter.input.engine.cylinders,
        intervals=_intervals(chapter),
        has_power=terms.has("T_ref"),
        agrees=terms.values.scalars.get("check_power") == YES,
        accepted=reasons_of(chapter.input).get("power", "").rstrip("."),
        powers=_powers(chapter) if terms.has("cyc_N_gas") else None,
        coarse=any(error.key in ("M_mean", "N_i_calc") for error in chapter.terms.grid_errors),
        swing=of_digits(
            terms.value("M_max") - terms.value("M_min"), terms.quantity("M_max").digits
        ),
        ratio=fixed(terms.value("M_max") / mean, 2) if mean > 0 else "",
    )


def _powers(chapter: Chapter) -> TablePlan:
    """From the pressure of the diagram that is not rounded to the effective one, Gots 2.8."""
    terms, step = chapter.terms, fixed(chapter.input.calculation.step_deg, 0)
    steps = (
        ("Нескруглённая диаграмма без насосных ходов", "cyc_p_theory", ""),
        ("Нескруглённая диаграмма с насосными ходами", "", "cyc_N_gas"),
        (f"Динамический расчёт по той же диаграмме с шагом {step}°", "p_i_calc", "N_i_calc"),
        ("Индикаторные показатели с коэффициентом полноты", "cyc_p_i", "cyc_N_i"),
        ("Эффективные показатели", "cyc_p_e", "cyc_N_e"),
    )
    columns = [Column("Ступень", 4.2, text=True), Column("Среднее давление, МПа", 2.0),
               Column("Мощность, кВт", 1.8)]  # fmt: skip

    def cell(name: str) -> str:
        return f"{terms.sym(name)} = {terms.num(name)}" if name else "—"

    build = partial(
        table_block, columns, [[title, Markup(cell(p)), Markup(cell(n))] for title, p, n in steps]
    )
    return TablePlan(build, "Мощности расчёта цикла и динамического расчёта", keep=True)


def _intervals(chapter: Chapter) -> list[str]:
    """The different intervals between the beginnings of the power strokes [deg]."""
    starts = list(chapter.strokes_at)
    gaps = [b - a for a, b in pairwise([*starts, starts[0] + chapter.shape.period])]
    return [f"{short(gap)}°" for gap in sorted({round(gap, 2) for gap in gaps})]


def running(chapter: Chapter) -> Markup:
    """Running-on torques on main journals and crankpins, ranges, the most loaded ones."""
    terms, count = chapter.terms, chapter.shape.throws
    main = [f"fig56_{k}" for k in range(2, count + 2)]
    pins = [f"fig57_{i}" for i in range(1, count + 1)]
    gap = max(
        float(np.abs(terms.column(f"P4_5s.Mpins{i}_Nm") - terms.column(f"P4_5.Mpin{i}_Nm")).max())
        for i in range(1, count + 1)
    )
    mains, worst = facts.worst_running(terms, count)
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
        beside=not (chapter.shape.single_rods or chapter.shape.articulated),
        mains=mains,
        pins=worst,
    )


def _figures(charts: list[str]) -> list[list[str]]:
    """Charts in as few figures as will do, as many in each."""
    count = -(-len(charts) // _MOST_PANELS)
    size = -(-len(charts) // count)
    return [charts[start : start + size] for start in range(0, len(charts), size)]


def _ranges(terms: Terms, count: int) -> TableBlock:
    heads = (r"M_{\max}", r"M_{\min}", r"\Delta M")
    columns = [Column("Шейка", 2.4, text=True), *(Column(symbol_head(h, "Н·м")) for h in heads)]
    names = [(f"коренная {k}", f"P4_4.Mmain{k}_Nm", f"dM_main{k}") for k in range(2, count + 2)]
    names += [(f"шатунная {i}", f"P4_5.Mpin{i}_Nm", f"dM_pin{i}") for i in range(1, count + 1)]
    rows = []
    for title, column, key in names:
        values = terms.column(column)
        numbers = (float(values.max()), float(values.min()), terms.value(key))
        digits = terms.quantity(key).digits  # as in the text below the table
        rows.append([title, *(of_digits(number, digits) for number in numbers)])
    return table_block(columns, rows)
