"""Chapter on the regimes: forces of figures 23-25, loads side by side, what governs."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.chapters.plots import over_phi
from reports.document.page.blocks import Column, TableBlock, table_block
from reports.document.page.spec_tables import list_block, unit_cell
from reports.document.page.writer import Figure, TablePlan
from reports.document.text import numbers
from reports.document.text.symbols import inline_html
from reports.document.text.terms import Terms, input_text
from reports.formula.tex import input_symbol_tex
from reports.spec.blocks import Grid
from reports.tables.loads.comparison import regime_titles

_PARTS = (
    ("Ps_max", "поршень, палец и сжатие шатуна"),
    ("Ps_min", "растяжение шатуна"),
    ("Rpin_max", "шатунная шейка и её подшипник"),
)


def regimes(chapter: Chapter) -> Markup:
    """Comparison of the regimes; nothing for one regime."""
    if not chapter.input.regimes:
        return Markup("")
    terms, titles = chapter.terms, regime_titles(chapter.input)
    return chapter.page(
        "regimes.html.j2",
        titles=titles,
        data=TablePlan(partial(_inputs, chapter), "Данные дополнительных режимов", size="dense"),
        figures=[(f"regime_{n}", _forces(terms, n, title)) for n, title in enumerate(titles, 1)],
        loads=TablePlan(partial(_loads, chapter), "Силы и нагрузки по режимам", size="dense"),
        governing=_governing(chapter),
    )


def _forces(terms: Terms, number: int, title: str) -> Figure:
    table = "P4_1" if number == 1 else f"P4_1_R{number}"
    return over_phi(
        terms,
        f"Удельные силы: {title}",
        "$p'$, МПа",
        *(f"{table}.{key}" for key in ("Pg_MPa", "Pj_MPa", "Ps_MPa")),
        height=70.0,
    )


def _inputs(chapter: Chapter) -> TableBlock:
    rows = [
        [
            f"{field.section}. {field.title}",
            inline_html(input_symbol_tex(field.symbol)) if field.symbol else "—",
            input_text(field),
            unit_cell(field.unit),
        ]
        for field in chapter.model.inputs
        if field.path[0] == "regimes" and not field.listed
    ]
    return list_block(rows)


def _grid(chapter: Chapter) -> Grid:
    found = (b for b in chapter.model.blocks if isinstance(b, Grid) and b.id == "regime_loads")
    return next(found)


def _loads(chapter: Chapter) -> TableBlock:
    scalars, titles = chapter.terms.values.scalars, regime_titles(chapter.input)
    rows = []
    for row in _grid(chapter).rows:
        q = row.quantity
        values = [scalars[cell.key] for cell in row.cells if cell is not None]
        unit = f", {q.unit_label}" if q.unit_label else ""
        shown = [numbers.of_digits(float(value), q.digits) for value in values[:-1]]
        rows.append([q.title[:1].upper() + q.title[1:] + unit, *shown, str(values[-1])])
    columns = [
        Column("Величина", 3.0, text=True),
        *(Column(title, 1.6) for title in titles),
        Column("Определяющий режим", 1.6, text=True),
    ]
    return table_block(columns, rows)


def _governing(chapter: Chapter) -> list[tuple[str, str]]:
    """Parts of the mechanism with the regime that governs each."""
    scalars = chapter.terms.values.scalars
    found = [(part, str(scalars[f"governs_{key}"])) for key, part in _PARTS]
    worst = round(chapter.terms.value("worst_main_load"))
    found.append((f"коренная шейка {worst}", str(scalars[f"governs_Rmain{worst}_max"])))
    pin = round(chapter.terms.value("worst_pin_torque"))
    name = f"кручение шатунной шейки {pin}"
    return [*found, (name, str(scalars[f"governs_dM_pin{pin}"]))]
