"""Tables and figures of the chapter on the working cycle; results beyond what is usual."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.figures.curves import Mark, PlotCurve, ScaledCurve, bands_figure
from reports.document.page.blocks import (
    TableBlock,
    TableColumn,
    list_block,
    symbol_head,
    table_block,
    unit_cell,
)
from reports.document.page.charts import axis_name
from reports.document.page.numbering import Figure, TablePlan
from reports.document.text.symbols import inline_html, titled_html
from reports.document.text.terms import Terms, with_unit
from reports.document.text.texts import limits, of_digits
from reports.shared.russian import capital, fixed, short, uncapital
from reports.shared.standing import Standing

_MAX_DECIMALS = 8  # of values in passes
_BALANCE = ("useful", "exhaust", "incomplete", "rest")
_ENERGIES = ("cyc_w_c", "cyc_U_air", "cyc_U_rest", "cyc_U_c", "cyc_content", "cyc_t_root")
_EFFECTIVE = (
    "cyc_p_i", "cyc_p_m", "cyc_p_e", "cyc_eta_i", "cyc_eta_m", "cyc_eta_e", "cyc_g_i",
    "cyc_g_e", "cyc_N_i", "cyc_N_e", "cyc_M_e", "cyc_G_f", "cyc_G_a", "cyc_N_error",
)  # fmt: skip
_HEAT = ("heat_a", "heat_b", "heat_c", "hot_a", "hot_b")
# Curves of the external characteristic: rows of the grid, the right scale, from zero.
_SPEED = {
    "speed_Gf": ((0, 3), True, True),
    "speed_Ne": ((0, 5), False, True),
    "speed_ge": ((4, 5), True, False),
    "speed_Me": ((6, 5), False, False),
}
_SPEED_MM = 118.0
_READABLE = 1.6  # of the greatest consumption of the external characteristic


def _characteristic(chapter: Chapter) -> Markup:
    """Power, torque and fuel over the speed in one field; both torques of K are marked."""
    return chapter.shared("cycle_speed", _SPEED, partial(_characteristic_plan, chapter.terms))


def _characteristic_plan(terms: Terms) -> Figure:
    speed, ratio = terms.value("regime_speed_rpm"), terms.value("spd_K")
    rated = terms.value("cyc_M_e")
    marks = [
        Mark(f"${symbol}$ = {of_digits(value, terms.quantity('cyc_M_e').digits)} Н·м", at, value)
        for symbol, at, value in (
            (r"M_{e\,\max}", terms.value("spd_Kc") * speed, ratio * rated),
            ("M_{eN}", speed, rated),
        )
    ]
    speeds, governed = terms.column("speed.speed_n"), terms.has("governor.gov_n")
    if governed:
        speeds = np.concatenate([speeds, terms.column("governor.gov_n")[1:]])
    bands = [
        ScaledCurve(
            PlotCurve(f"${terms.tex(f'speed.{name}')}$", _with_governor(terms, name)),
            axis_name(terms, f"speed.{name}"), rows, right=right, zero=zero,
            marks=marks if name == "speed_Me" else (),
            rise=f"$K$ = {terms.num('spd_K')}" if name == "speed_Me" else "",
        )
        for name, (rows, right, zero) in _SPEED.items()
    ]  # fmt: skip
    draw = partial(
        bands_figure, speeds, bands, axis_name(terms, "speed.speed_n"),
        height=_SPEED_MM, x_step=500.0 if speeds[-1] <= 5000 else 1000.0,
    )  # fmt: skip
    return Figure(draw, "Внешняя скоростная характеристика" + " с регуляторной ветвью" * governed)


def _with_governor(terms: Terms, name: str) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """Return a curve of the characteristic, of a diesel with the governor's branch after it."""
    curve, beyond = terms.column(f"speed.{name}"), name.replace("speed", "governor.gov")
    if not terms.has(beyond):
        return curve
    branch = terms.column(beyond)[1:]
    if name == "speed_ge":  # it grows without bounds: as far as the curve is readable
        branch = branch[:-1][branch[:-1] < _READABLE * curve.max()]
    return np.concatenate([curve, branch])


def _pressures(chapter: Chapter) -> Markup:
    """Return the diagram of the cycle with its corners marked."""
    last = len(chapter.terms.model.tables["cycle_diagram"].rows) - 1
    top = chapter.terms.row("cycle_diagram", 360.0)
    corners = [("$a$", 0), ("$z'$", top), ("$b$", last)]
    return chapter.chart("cycle_pv", 95, rows=corners, closed=True)


def _coefficients(terms: Terms) -> TableBlock:
    """Coefficients of a heat capacity: the small ones with a power of ten."""
    rows = []
    for name in _HEAT:
        value = terms.value(name)
        power = math.floor(math.log10(abs(value))) if 0 < abs(value) < 1 else 0
        number = fixed(value / 10.0**power, 4)
        text = Markup("{}·10<sup>{}</sup>").format(number, fixed(power, 0)) if power else number
        unit = unit_cell(terms.unit(name))
        rows.append([capital(terms.title(name)), inline_html(terms.tex(name)), text, unit])
    return list_block(rows)


def _passes(chapter: Chapter, name: str) -> TableBlock:
    """Return a grid of passes turned: one row a pass."""
    grid, terms = chapter.grid(name), chapter.terms
    columns = [TableColumn("Приближение", 1.3)]
    cells: list[list[str]] = [[str(i + 1) for i in range(len(grid.labels))]]
    for row in grid.rows:
        q = row.quantity
        tex = q.tex.replace("n -", f"n_{name[-1]} -")  # of n₁ or n₂
        columns.append(TableColumn(symbol_head(tex, q.unit_label)))
        digits = replace(q.digits, decimals=min(q.digits.decimals, _MAX_DECIMALS))
        cells.append([of_digits(terms.value(c.key), digits) for c in row.cells if c is not None])
    rows = list(zip(*cells, strict=True))
    while len(rows) > 2 and rows[-1][1:] == rows[-2][1:] == rows[-3][1:]:
        rows.pop()  # the last two that are alike show that the passes have converged
    return table_block(columns, rows)


def _balance(terms: Terms) -> TableBlock:
    columns = [
        TableColumn("Составляющая", 5.0, text=True),
        TableColumn("Обозначение", 1.5),
        TableColumn("кВт", 1.3),
        TableColumn("%", 1.2),
    ]
    parts = {f"bal_{name}": terms.num(f"bal_{name}_share") for name in _BALANCE}
    parts["bal_total"] = "100,0"
    if terms.has("bal_cooler"):
        parts["bal_cooler"] = "—"
    rows = [
        [capital(terms.title(name)), terms.sym(name), terms.num(name), share]
        for name, share in parts.items()
    ]
    return table_block(columns, rows)


def _range_keys(terms: Terms) -> list[str]:
    prefix = "range_value_"
    return [k.removeprefix(prefix) for k in terms.model.scalars if k.startswith(prefix)]


def _outside(terms: Terms) -> list[str]:
    """Names of the results outside their usual limits."""
    return [
        each.key.removeprefix("range_")
        for each in terms.judged
        if each.block == "cycle_ranges" and each.standing is not Standing.INSIDE
    ]


def _range_of(terms: Terms, key: str) -> tuple[str, str, str, str]:
    """Title with the symbol, unit, value and usual limits of a result, in print."""
    scalar = terms.model.scalars[f"range_value_{key}"]
    usual = "…".join(map(short, scalar.usual or ()))
    value = terms.value(f"range_value_{key}")
    text = fixed(value, 0 if abs(value) >= 100 else 2 if abs(value) >= 1 else 3)
    return scalar.note, scalar.usual_unit, text, limits(usual)


def outside_lines(terms: Terms, mentioned: set[str]) -> list[Markup]:
    """Results outside their usual limits, with value and limits, but for those told elsewhere."""
    lines = []
    for key in _outside(terms):
        if key not in mentioned:
            title, unit, text, usual = _range_of(terms, key)
            words = titled_html(uncapital(title)), with_unit(text, unit), usual
            lines.append(Markup("{} {} (обычно {})").format(*words))
    return lines


def _ranges(terms: Terms) -> TableBlock:
    columns = [
        TableColumn("Величина", 4.6, text=True),
        TableColumn("Значение", 1.3),
        TableColumn("Обычно", 1.5),
        TableColumn("Вывод", 1.6),
    ]
    rows = []
    for key in _range_keys(terms):
        title, unit, text, usual = _range_of(terms, key)
        name = titled_html(f"{title}, {unit}" if unit else title)
        rows.append([name, text, usual, str(terms.values.scalars[f"range_{key}"])])
    return table_block(columns, rows)


def _of_terms(
    build: Callable[[Terms], TableBlock],
    caption: str,
    **manner: Any,  # noqa: ANN401
) -> Callable[[Chapter], TablePlan]:
    return lambda chapter: TablePlan(partial(build, chapter.terms), caption, **manner)


def _of_passes(name: str, of: str) -> Callable[[Chapter], TablePlan]:
    caption = f"Последовательные приближения показателя политропы {of}"
    return lambda chapter: TablePlan(partial(_passes, chapter, name), caption, keep=True)


VIEWS: dict[str, Callable[[Chapter], TablePlan | Figure]] = {
    "cycle_heat": _of_terms(
        _coefficients, "Коэффициенты средней мольной теплоёмкости продуктов сгорания",
        size="dense", keep=True,
    ),
    "cycle_energies": lambda chapter: chapter.scalars(
        "Величины уравнения сгорания", _ENERGIES, size="dense", keep=True
    ),
    "cycle_n1": _of_passes("cycle_n1", "сжатия"),
    "cycle_n2": _of_passes("cycle_n2", "расширения"),
    "cycle_effective": lambda chapter: chapter.scalars(
        "Эффективные показатели", _EFFECTIVE, size="dense", keep=True
    ),
    "cycle_balance": _of_terms(_balance, "Тепловой баланс", keep=True),
    "cycle_diagram": lambda chapter: chapter.columns(
        "cycle_diagram", caption="Индикаторная диаграмма цикла по точкам", step=chapter.table_step
    ),
    "cycle_speed": lambda chapter: chapter.columns(
        "speed", caption="Внешняя скоростная характеристика", keep=True
    ),
    "cycle_governor": lambda chapter: chapter.columns(
        "governor", caption="Регуляторная ветвь", keep=True
    ),
    "cycle_ranges": _of_terms(_ranges, "Результаты и обычные пределы", size="dense", lined=True),
}  # fmt: skip
INSERTS = {"cycle_pv": _pressures, "cycle_speed": _characteristic}
