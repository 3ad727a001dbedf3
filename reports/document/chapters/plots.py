"""Figures over the crank angle from the chart specifications."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from reports.document.figures import Level, Mark, Panel, Series, line_chart, stacked_panels
from reports.document.page.writer import Figure
from reports.document.text import numbers
from reports.document.text.mathsvg import plain
from reports.document.text.terms import Terms
from reports.shared.russian import fixed

PHI = r"$\varphi$, °"
_MOST_PANELS = 2


def phi(terms: Terms, table: str) -> tuple[float, ...]:
    """Crank angles of a table [deg]."""
    return terms.model.tables[table].rows


def series(terms: Terms, *names: str) -> tuple[Series, ...]:
    """Curves of columns with their symbols."""
    return tuple(Series(f"${terms.tex(name)}$", terms.column(name)) for name in names)


def over_phi(
    terms: Terms,
    caption: str,
    y_label: str,
    *names: str,
    height: float = 76.0,
    levels: Sequence[Level] = (),
    marks: Sequence[Mark] = (),
) -> Figure:
    """Columns of one table over the crank angle."""
    x = phi(terms, names[0].rpartition(".")[0])
    curves = series(terms, *names)
    draw = partial(
        line_chart, x, curves, PHI, y_label, height=height, levels=tuple(levels), marks=tuple(marks)
    )
    return Figure(draw, caption, spoken(terms, caption, names))


def spoken(terms: Terms, caption: str, names: Sequence[str]) -> str:
    """Alternative text of curves over the crank angle: the caption and each one's extremes."""
    said = []
    for name in names:
        x, y = phi(terms, name.rpartition(".")[0]), terms.column(name)
        unit = terms.unit(name)
        parts = (
            f"{word} {numbers.significant(float(y[row]), 4)}{' ' if unit else ''}{unit}"
            f" при φ = {fixed(x[row], 0)}°"
            for word, row in (("наибольшее", int(np.argmax(y))), ("наименьшее", int(np.argmin(y))))
        )
        said.append(f"{plain(terms.tex(name))}: {', '.join(parts)}")
    return f"{caption}. {'; '.join(said)}"


def extreme_marks(terms: Terms, name: str) -> tuple[Mark, ...]:
    """Greatest and least value of a column, marked ``max`` and ``min``."""
    x, y = phi(terms, name.rpartition(".")[0]), terms.column(name)
    places = (("max", int(np.argmax(y))), ("min", int(np.argmin(y))))
    return tuple(Mark(label, x[row], float(y[row])) for label, row in places)


def panels(
    terms: Terms, names: Sequence[str], y_label: str, captions: Sequence[str], title: str
) -> list[tuple[str, Figure]]:
    """Columns one below the other, as many figures as needed; (key suffix, figure)."""
    if len(names) == 1:
        return [("1", over_phi(terms, f"{title}: {captions[0]}", y_label, names[0]))]
    count = -(-len(names) // _MOST_PANELS)
    size = -(-len(names) // count)
    result = []
    for start in range(0, len(names), size):
        chunk = names[start : start + size]
        x = phi(terms, chunk[0].rpartition(".")[0])
        shown = tuple(Panel(series(terms, name), y_label) for name in chunk)
        letters = "абвгдежиклмн"
        words = "; ".join(
            f"{letters[i]}\u00a0—\u00a0{text}"
            for i, text in enumerate(captions[start : start + size])
        )
        caption = f"{title}: {words}" if len(chunk) > 1 else f"{title}: {captions[start]}"
        draw = partial(stacked_panels, x, shown, PHI, panel_height=50.0, same_scale=True)
        result.append(
            (str(start // size + 1), Figure(draw, caption, spoken(terms, caption, chunk)))
        )
    return result
