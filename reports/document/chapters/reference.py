"""Chapter on the error of the two-term formulas, vectors of inertia forces, reference tables."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.figures.mechanism import mechanism_sketch, velocity_sketch
from reports.document.page.blocks import Column, TableBlock, symbol_head, table_block
from reports.document.page.writer import Figure, TablePlan
from reports.document.text.terms import Terms
from reports.shared.russian import fixed, short

_ERRORS = tuple(
    key
    for name in ("s", "v", "j", "Pj", "N", "T", "M")
    for key in (f"e{name}_max", f"phi_e{name}_deg", f"e{name}_rel")
)


def reference(chapter: Chapter) -> Markup:
    """Errors of the approximation, figure 20 and, where asked for, tables 1-8."""
    terms, asked = chapter.terms, chapter.input.reference
    sketch = velocity = None
    tables: list[tuple[str, TablePlan]] = []
    if asked is not None:
        lam, angle = terms.value("lam"), asked.angle_deg
        velocity = Figure(
            partial(velocity_sketch, lam, angle), "Графическое определение скорости поршня"
        )
        if 0.1 <= lam <= 0.6 and 10 <= angle <= 80:
            sketch = Figure(partial(mechanism_sketch, lam, angle), "Движение шатуна: схема и силы")
        for name, table in chapter.model.tables.items():
            if table.columns[-1].key.startswith("ref_lambda"):
                build = partial(_table, terms, name, len(asked.lambdas))
                tables.append((name, TablePlan(build, table.title, size="dense")))
    return chapter.page(
        "reference",
        errors=chapter.scalars("Наибольшие погрешности", _ERRORS, size="dense"),
        asked=asked is not None,
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
    columns = [Column(symbol_head(r"\varphi", "°")), *(Column(f"λ = {head}") for head in heads)]
    return table_block(columns, rows)
