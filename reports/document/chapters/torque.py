"""Chapters on the torque of the engine and the running-on torques (figures 49, 56, 57)."""

from __future__ import annotations

from collections import Counter
from functools import partial

import numpy as np
from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.chapters.plots import extreme_marks, over_phi, panels
from reports.document.figures import Level
from reports.document.page.blocks import Column, TableBlock, symbol_head, table_block
from reports.document.page.writer import TablePlan
from reports.document.text.terms import Terms
from reports.shared.russian import fixed


def torque(chapter: Chapter) -> Markup:
    """Total torque, its mean and extremes, the check against the indicated power."""
    terms = chapter.terms
    figure = over_phi(
        terms,
        "Индикаторный крутящий момент двигателя",
        r"$M_{\mathrm{кр}}$, Н·м",
        "P4_2.Msum_Nm",
        levels=(Level(rf"${terms.tex('M_mean')}$", terms.value("M_mean")),),
        marks=extreme_marks(terms, "P4_2.Msum_Nm"),
        height=78.0,
    )
    cylinders = chapter.input.engine.cylinders
    return chapter.page(
        "torque.html.j2",
        figures={"torque": figure},
        cylinders=cylinders,
        order=firing_order(chapter),
        intervals=_intervals(chapter),
        has_power=terms.has("T_ref"),
        swing=fixed(terms.value("M_max") - terms.value("M_min"), 0),
        ratio=_ratio(terms),
    )


def firing_order(chapter: Chapter) -> str:
    """Order in which the power strokes begin: ``1–3–4–2``."""
    offsets = chapter.input.crankshaft.firing_offsets_deg
    period = chapter.shape.period
    order = sorted(range(len(offsets)), key=lambda i: (offsets[i] % period, i))
    return "–".join(str(i + 1) for i in order)


def _intervals(chapter: Chapter) -> str:
    """Equal interval of the power strokes in degrees, empty if they are not equal."""
    period = chapter.shape.period
    offsets = sorted(value % period for value in chapter.input.crankshaft.firing_offsets_deg)
    gaps = [b - a for a, b in zip(offsets, [*offsets[1:], offsets[0] + period], strict=True)]
    counted = Counter(round(gap, 3) for gap in gaps)
    return fixed(gaps[0], 0) if len(counted) == 1 else ""


def _ratio(terms: Terms) -> str:
    mean = terms.value("M_mean")
    return fixed(terms.value("M_max") / mean, 2) if mean > 0 else ""


def running(chapter: Chapter) -> Markup:
    """Running-on torques on main journals and crankpins, ranges, the most loaded ones."""
    terms, count = chapter.terms, chapter.shape.throws
    main = [f"P4_4.Mmain{k}_Nm" for k in range(2, count + 2)]
    pin = [f"P4_5.Mpin{i}_Nm" for i in range(1, count + 1)]
    main_figures = panels(
        terms, main, "$M$, Н·м", [f"шейка {k}" for k in range(2, count + 2)],
        "Набегающие моменты на коренные шейки",
    )  # fmt: skip
    pin_figures = panels(
        terms, pin, "$M$, Н·м", [f"шейка {i}" for i in range(1, count + 1)],
        "Набегающие моменты на шатунные шейки",
    )  # fmt: skip
    gap = max(
        float(np.abs(terms.column(f"P4_5s.Mpins{i}_Nm") - terms.column(f"P4_5.Mpin{i}_Nm")).max())
        for i in range(1, count + 1)
    )
    return chapter.page(
        "running.html.j2",
        main_figures=main_figures,
        pin_figures=pin_figures,
        ranges=TablePlan(partial(_ranges, terms, count), "Размах набегающих моментов", lined=False),
        last=count + 1,
        count=count,
        gap=fixed(gap, 1) if gap > 0.05 else "",
        worst_main=worst(terms, "worst_main_torque"),
        worst_pin=worst(terms, "worst_pin_torque"),
    )


def worst(terms: Terms, key: str) -> int:
    """Number of the most loaded journal."""
    return round(terms.value(key))


def _ranges(terms: Terms, count: int) -> TableBlock:
    columns = [
        Column("Шейка", 2.4, text=True),
        Column(symbol_head(r"M_{\max}", "Н·м")),
        Column(symbol_head(r"M_{\min}", "Н·м")),
        Column(symbol_head(r"\Delta M", "Н·м")),
    ]
    rows = []
    names = [(f"коренная {k}", f"P4_4.Mmain{k}_Nm", f"dM_main{k}") for k in range(2, count + 2)]
    names += [(f"шатунная {i}", f"P4_5.Mpin{i}_Nm", f"dM_pin{i}") for i in range(1, count + 1)]
    for title, column, key in names:
        values = terms.column(column)
        top, low = float(values.max()), float(values.min())
        rows.append([title, fixed(top, 0), fixed(low, 0), fixed(terms.value(key), 0)])
    return table_block(columns, rows)
