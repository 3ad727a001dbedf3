"""Tables of the chapter on the oil film of the bearings and on the safety of the journals."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.page.blocks import TableBlock, TableColumn, symbol_head, table_block
from reports.document.page.charts import sketches_figure
from reports.document.page.numbering import Figure, TablePlan
from reports.document.text.symbols import titled_html
from reports.document.text.terms import Terms
from reports.model.blocks import Grid
from reports.model.shape import Scope
from reports.shared.russian import capital, fixed
from reports.tables.oil_members import FilmCase, film_cases

_SAFE_MAINS = ("safe_tau_a2_MPa", "safe_tau_m2_MPa", "safe_fillet2", "safe_hole2", "safe_n2")
_SAFE_PINS = (
    "safe_pin_bend_a1_MPa", "safe_pin_bend_m1_MPa", "safe_pin_a1_MPa", "safe_pin_m1_MPa",
    "safe_pin_bend_hole1", "safe_pin_turn_hole1", "safe_pin_hole1",
    "safe_pin_crank_a1_MPa", "safe_pin_crank_m1_MPa", "safe_pin_bend_fillet1",
    "safe_pin_turn_fillet1", "safe_pin_fillet1", "safe_pin_n1", "safe_Q_fillet1", "safe_Q_hole1",
)  # fmt: skip


def _safety(chapter: Chapter, grid: str, keys: Sequence[str], caption: str) -> TablePlan:
    """Stresses and safety of all journals of a kind side by side."""
    block = chapter.grid(grid)
    build = partial(_beside, chapter.terms, block, keys)
    return TablePlan(build, caption, keep=True, size="dense" if len(block.labels) > 5 else "")


def _beside(terms: Terms, grid: Grid, keys: Sequence[str]) -> TableBlock:
    """Titles of a grid's quantities with units; a column of values for each journal."""
    by_key = {row.of: row for row in grid.rows}
    rows = []
    for row in (by_key[key] for key in keys if key in by_key):
        q = row.quantity
        head = Markup("{}{}").format(
            symbol_head(f"{q.tex}", q.unit_label), Markup(" — {}").format(titled_html(q.title))
        )
        rows.append([head, *(terms.num(cell.key) for cell in row.cells if cell is not None)])
    columns = [
        TableColumn("Величина", 5.0, text=True),
        *(TableColumn(capital(n)) for n in grid.labels),
    ]
    return table_block(columns, rows)


def _steady(terms: Terms, cases: list[FilmCase]) -> TableBlock:
    keys = (
        "oil_k{}_MPa", "oil_chi{}", "oil_temp{}_C", "oil_visc{}_mPas", "oil_hmin{}_um", "oil_K{}",
        "oil_friction{}_W", "oil_through{}_l_min",
    )  # fmt: skip
    measures = [terms.quantity(key.format(cases[0].number)) for key in keys]
    heads = [
        TableColumn("Подшипник", 3.2, text=True),
        *(TableColumn(symbol_head(each.tex, each.unit_label)) for each in measures),
    ]
    rows = [
        [titled_html(case.label), *(terms.num(key.format(case.number)) for key in keys)]
        for case in cases
    ]
    return table_block(heads, rows)


def _sizes(terms: Terms, cases: list[FilmCase]) -> TableBlock:
    """Diameter, width of the carrying part and clearances of every bearing."""
    heads = [
        TableColumn("Подшипник", 3.0, text=True),
        TableColumn(symbol_head("d", "мм")),
        TableColumn(symbol_head("B", "мм")),
        TableColumn(symbol_head(r"\Delta_{\min}", "мм")),
        TableColumn(symbol_head(r"\Delta_{\max}", "мм")),
    ]
    rows = []
    for least, most in zip(cases[::2], cases[1::2], strict=True):
        n, parts = least.number, round(terms.value(f"oil_lands{least.number}"))
        width = terms.num(f"oil_land{n}_mm")
        rows.append([
            titled_html(least.label.partition(",")[0]),
            terms.num(f"oil_d{n}_mm"),
            f"{parts} × {width}" if parts > 1 else width,
            terms.num(f"oil_gap{n}_mm"),
            terms.num(f"oil_gap{most.number}_mm"),
        ])  # fmt: skip
    return table_block(heads, rows)


def _orbits(terms: Terms, cases: list[FilmCase]) -> TableBlock:
    keys = (
        ("oil_eps_max", 4), ("oil_orb_h_um", 2), ("oil_orb_phi_deg", 0), ("oil_shell_deg", 0),
        ("oil_journal_deg", 0), ("oil_under", 1), ("oil_orb_W", 1), ("oil_orb_l_min", 3),
    )  # fmt: skip
    measures = [terms.quantity(f"oil_orbits.{key}") for key, _ in keys]
    heads = [
        TableColumn("Подшипник", 3.2, text=True),
        *(TableColumn(symbol_head(each.tex, each.unit_label)) for each in measures),
    ]
    rows = [
        [
            titled_html(case.label),
            *(fixed(float(terms.column(f"oil_orbits.{key}")[k]), digits) for key, digits in keys),
        ]
        for k, case in enumerate(cases)
    ]
    return table_block(heads, rows)


def _films(
    build: Callable[[Terms, list[FilmCase]], TableBlock], caption: str
) -> Callable[[Chapter], TablePlan]:
    """Return a table with a line for every bearing and clearance."""
    return lambda chapter: TablePlan(
        partial(build, chapter.terms, film_cases(Scope(chapter.input))), caption, keep=True
    )


VIEWS: dict[str, Callable[[Chapter], TablePlan | Figure]] = {
    "oil_sizes": _films(_sizes, "Размеры подшипников и зазоры"),
    "oil_steady": _films(_steady, "Плёнка при средней нагрузке"),
    "oil_orbits": _films(_orbits, "Плёнка за цикл по орбитам"),
    "oil_mains": lambda chapter: _safety(
        chapter, "safe_main", _SAFE_MAINS, "Запасы прочности коренных шеек"
    ),
    "oil_pins": lambda chapter: _safety(
        chapter, "safe_pins", _SAFE_PINS, "Запасы прочности шатунных шеек"
    ),
    "crank_sketch": lambda chapter: sketches_figure(
        chapter.terms, "Шейки колена, размеры", "crank"
    ),
}
