"""Chapter on the working cycle: step by step, sizes, diagram, speed characteristic."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.chapters.plots import PHI, series
from reports.document.figures import Mark, Panel, line_chart, pv_diagram, stacked_panels
from reports.document.page.blocks import Column, TableBlock, table_block
from reports.document.page.spec_tables import angle_table, list_block, scalar_table, unit_cell
from reports.document.page.writer import Figure, TablePlan
from reports.document.text import numbers
from reports.document.text.symbols import inline_html
from reports.document.text.terms import Terms
from reports.shared.russian import fixed
from reports.spec.blocks import Grid
from reports.tables.gas.cycle_names import friction_by_speed, is_boosted, section_of
from reports.tables.gas.cycle_speed import INSIDE

_MOST_DECIMALS = 8  # of values in passes

# Equations of the method that the sheets solve in passes or in parts.
_EQUATIONS = {
    "n1": r"n_1 - 1 = g(n_1) = \dfrac{8{,}315}{20{,}6 + 0{,}002638\,(t_a + t_c)},"
    r"\quad T_c = T_a\,\varepsilon^{n_1 - 1}",
    "petrol": r"\xi_z q + U_c = \mu\, c''_{vz}\, t_z",
    "diesel": r"\xi_z q + U_c + R\,[\lambda_p t_c + 273\,(\lambda_p - \mu)]"
    r" = \mu\,(c''_{vz} + R)\, t_z",
    "n2": r"n_2 - 1 = \dfrac{R\,(T_z - T_b)}{Q + U_z - U_b},"
    r"\quad Q = \dfrac{(\xi_b - \xi_z)\, q}{\mu},\quad T_b = \dfrac{T_z}{\delta^{n_2 - 1}}",
    "speed": r"M_e = M_N\,(a + b x - c x^2),\quad g_e = g_N\,(a' + b' x + c' x^2)",
}
_BALANCE = ("useful", "exhaust", "incomplete", "rest")


def cycle(chapter: Chapter) -> Markup:
    """The cycle calculation; empty when the pressures are given otherwise."""
    section = section_of(chapter.input)
    if section is None:
        return Markup("")
    terms = chapter.terms
    petrol = section.kind == "petrol"
    species = ("CO2", "CO", "H2O", "H2", "O2", "N2") if petrol else ("CO2", "H2O", "O2", "N2")
    return chapter.page(
        "cycle.html.j2",
        equations=_EQUATIONS,
        petrol=petrol,
        boosted=is_boosted(section),
        friction=friction_by_speed(section),
        design=terms.has("cyc_D"),
        given_law=section.adaptability is not None,
        derived_torque=section.torque_speed_rpm is None,
        derived_idle=section.idle_speed_rpm is None,
        newton=terms.value("cyc_t_root") < 1500,
        species=[f"mix_{name}" for name in species],
        tables=_tables(terms),
        figures=_figures(terms),
        inside=_counts(terms),
        turbine_enough=is_boosted(section) and terms.value("cyc_N_t") >= terms.value("cyc_N_k"),
        residual_gap=_percent(terms.value("value_cycle_Tr")),
    )


def _percent(value: float) -> str:
    return fixed(value, 1)


def _tables(terms: Terms) -> dict[str, TablePlan]:
    heat = ["heat_a", "heat_b", "heat_c", "hot_a", "hot_b"]
    energies = [
        name
        for name in ("cyc_w_c", "cyc_U_air", "cyc_U_rest", "cyc_U_c", "cyc_content", "cyc_t_root")
        if terms.has(name)
    ]
    return {
        "heat": TablePlan(
            partial(_coefficients, terms, heat),
            "Коэффициенты средней мольной теплоёмкости продуктов сгорания",
            size="dense",
            keep=True,
        ),
        "energies": TablePlan(
            partial(scalar_table, terms, energies),
            "Величины уравнения сгорания",
            size="dense",
            keep=True,
        ),
        "n1": TablePlan(
            partial(_passes, terms, "cycle_n1"),
            "Последовательные приближения показателя политропы сжатия",
            keep=True,
        ),
        "n2": TablePlan(
            partial(_passes, terms, "cycle_n2"),
            "Последовательные приближения показателя политропы расширения",
            keep=True,
        ),
        "effective": TablePlan(
            partial(scalar_table, terms, _effective(terms)),
            "Эффективные показатели",
            size="dense",
            keep=True,
        ),
        "balance": TablePlan(partial(_balance, terms), "Тепловой баланс", keep=True),
        "diagram": TablePlan(
            partial(angle_table, terms, "cycle_diagram"), "Индикаторная диаграмма цикла по точкам"
        ),
        "speed": TablePlan(
            partial(angle_table, terms, "speed"), "Внешняя скоростная характеристика", keep=True
        ),
        "ranges": TablePlan(
            partial(_ranges, terms), "Результаты и обычные пределы", size="dense", lined=True
        ),
    }


def _effective(terms: Terms) -> list[str]:
    names = (
        "cyc_p_i", "cyc_p_m", "cyc_p_e", "cyc_eta_i", "cyc_eta_m", "cyc_eta_e", "cyc_g_i",
        "cyc_g_e", "cyc_N_i", "cyc_N_e", "cyc_M_e", "cyc_G_f", "cyc_G_a", "cyc_N_error",
    )  # fmt: skip
    return [name for name in names if terms.has(name)]


def _coefficients(terms: Terms, names: Sequence[str]) -> TableBlock:
    """Coefficients of a heat capacity: small numbers, so significant digits."""
    rows = []
    for name in names:
        tex, value = terms.tex(name), terms.value(name)
        text = fixed(value, 4) if abs(value) >= 1 else f"{value * 1e6:.4f}".replace(".", ",")
        text = text.replace("-", "−")
        scale = "" if abs(value) >= 1 else Markup("·10<sup>−6</sup>")
        title = terms.title(name)
        rows.append(
            [
                title[:1].upper() + title[1:],
                inline_html(tex),
                Markup("{}{}").format(text, scale),
                unit_cell(terms.unit(name)),
            ]
        )
    return list_block(rows)


def _passes(terms: Terms, grid_id: str) -> TableBlock:
    """A grid of passes turned: one row a pass."""
    grid = next(b for b in terms.model.blocks if isinstance(b, Grid) and b.id == grid_id)
    columns = [Column("Проход")]
    cells: list[list[str]] = [[str(i + 1) for i in range(len(grid.labels))]]
    for row in grid.rows:
        unit = f", {row.quantity.unit_label}" if row.quantity.unit_label else ""
        columns.append(Column(inline_html(row.quantity.tex) + Markup(unit)))
        digits = replace(
            row.quantity.digits, decimals=min(row.quantity.digits.decimals, _MOST_DECIMALS)
        )
        cells.append(
            [numbers.of_digits(terms.value(c.key), digits) for c in row.cells if c is not None]
        )
    return table_block(columns, list(zip(*cells, strict=True)))


def _balance(terms: Terms) -> TableBlock:
    columns = [
        Column("Составляющая", 5.0, text=True),
        Column("Обозначение", 1.5),
        Column("кВт", 1.3),
        Column("%", 1.2),
    ]
    rows = [_part(terms, f"bal_{name}", f"bal_{name}_share") for name in _BALANCE]
    rows.append(_part(terms, "bal_total", ""))
    if terms.has("bal_cooler"):
        rows.append(_part(terms, "bal_cooler", None))
    return table_block(columns, rows)


def _part(terms: Terms, name: str, share: str | None) -> list[str]:
    title = terms.title(name)
    percent = "—" if share is None else terms.num(share) if share else "100,0"
    return [title[:1].upper() + title[1:], terms.sym(name), terms.num(name), percent]


def _range_keys(terms: Terms) -> list[str]:
    prefix = "range_value_"
    return [k.removeprefix(prefix) for k in terms.model.scalars if k.startswith(prefix)]


def _ranges(terms: Terms) -> TableBlock:
    columns = [
        Column("Величина", 4.6, text=True),
        Column("Значение", 1.3),
        Column("Обычно", 1.5),
        Column("Вывод", 1.6),
        Column("Откуда предел", 2.8, text=True),
    ]
    rows = []
    for key in _range_keys(terms):
        scalar = terms.model.scalars[f"range_value_{key}"]
        title, _, usual = scalar.note.partition(": обычно ")
        value = terms.value(f"range_value_{key}")
        digits = 0 if abs(value) >= 100 else 2 if abs(value) >= 1 else 3
        verdict = str(terms.values.scalars[f"range_{key}"])
        rows.append([title, fixed(value, digits), usual.replace("-", "−"), verdict, scalar.source])
    return table_block(columns, rows)


def _counts(terms: Terms) -> tuple[int, int]:
    """How many results lie inside their usual range, and of how many."""
    keys = _range_keys(terms)
    inside = sum(terms.values.scalars[f"range_{key}"] == INSIDE for key in keys)
    return inside, len(keys)


def _figures(terms: Terms) -> dict[str, Figure]:
    volume, pressure = (
        terms.column("cycle_diagram.cd_V_dm3"),
        terms.column("cycle_diagram.cd_p_MPa"),
    )
    angles = terms.model.tables["cycle_diagram"].rows
    closed_v = np.append(volume, volume[0])
    closed_p = np.append(pressure, pressure[0])
    rows = {"$a$": 0, "$z'$": terms.row("cycle_diagram", 360.0), "$b$": len(volume) - 1}
    marks = tuple(Mark(k, float(volume[i]), float(pressure[i])) for k, i in rows.items())
    speed = terms.column("speed.speed_n")
    curves = (
        ("speed_Ne", "$N_e$, кВт"),
        ("speed_Me", "$M_e$, Н·м"),
        ("speed_ge", "$g_e$, г/(кВт·ч)"),
        ("speed_Gf", r"$G_{\mathrm{т}}$, кг/ч"),
    )
    panels = tuple(Panel(series(terms, f"speed.{key}"), label) for key, label in curves)
    return {
        "cycle_pv": Figure(
            partial(
                pv_diagram,
                closed_v,
                closed_p,
                marks=marks,
                volume_label="$V$, дм³",
                pressure_label="$p$, МПа",
                ambient=terms.value("gas_ambient_pressure_mpa"),
            ),
            "Нескруглённая индикаторная диаграмма рассчитанного цикла",
        ),
        "cycle_T": Figure(
            partial(
                line_chart,
                angles,
                series(terms, "cycle_diagram.cd_T_K"),
                PHI,
                "$T$, К",
                height=70.0,
                zero=False,
            ),
            "Температура газов в цилиндре при сжатии, сгорании и расширении",
        ),
        "speed": Figure(
            partial(
                stacked_panels,
                speed,
                panels,
                "$n$, мин⁻¹",
                panel_height=42.0,
                x_step=_speed_step(float(speed[-1])),
            ),
            "Внешняя скоростная характеристика: а\u00a0— мощность; б\u00a0— крутящий момент; "
            "в\u00a0— удельный расход топлива; г\u00a0— часовой расход топлива",
        ),
    }


def _speed_step(highest: float) -> float:
    return 500.0 if highest <= 5000 else 1000.0
