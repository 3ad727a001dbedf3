"""``docs/sheets.md``: every sheet of the workbook with its formulas as Excel sees them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from reports.formula.excel import compile_formula
from reports.inputs.load import load_toml
from reports.inputs.template import list_samples
from reports.model.blocks import Block, Grid, Model, ScalarTable, TableSpec
from reports.shared.resources import samples_dir
from reports.shared.russian import capital
from reports.tables.registry import build_model
from reports.workbook.layout import FIRST_ROW, Layout, RowReferences, at_row
from tools.manual.markdown import code, escaped, table
from tools.manual.words import (
    SAME_BLOCK,
    SHEET_CHARTS,
    SHEET_FROM,
    SHEET_HEADS,
    SHEET_LIKE,
    SHEETS_HEAD,
)

# The textbook's engine comes first; each further sample adds the sheets nobody had before.
FIRST_SAMPLE = "gots-diesel"
_LONGEST = 160  # characters of a formula; longer ones are cut, the workbook holds them whole
_NUMBERS = re.compile(r"\d+")
_ONE_OF_MANY = re.compile(r"(?<=\()\d+(?=\))|(?<=Колено )\d+")
_OF_REGIME = re.compile(r" р\d+$")
_FIRST_FORMULA_ROW = FIRST_ROW + 1


@dataclass
class _Seen:
    """Sheets and shapes of blocks that the page already describes."""

    sheets: set[str] = field(default_factory=set)
    shapes: dict[str, str] = field(default_factory=dict)


def sheets_page(samples: Sequence[str] = ()) -> str:
    """The whole page; ``samples`` in the order in which they are read."""
    seen = _Seen()
    parts = [SHEETS_HEAD]
    for name in samples or (FIRST_SAMPLE, *(n for n in list_samples() if n != FIRST_SAMPLE)):
        model = build_model(load_toml(samples_dir() / f"{name}.toml").model)
        parts += _sheets(model, name, seen)
    return "\n\n".join(parts) + "\n"


def _sheets(model: Model, sample: str, seen: _Seen) -> Iterator[str]:
    layout = Layout.of(model)
    for sheet in model.sheets:
        shape = _ONE_OF_MANY.sub("#", sheet)
        if shape in seen.sheets or _OF_REGIME.search(sheet):
            continue
        seen.sheets.add(shape)
        yield f"## {sheet}"
        if shape != sheet:
            yield SHEET_LIKE
        if sample != FIRST_SAMPLE:
            yield SHEET_FROM.format(sample=sample)
        for block in model.blocks:
            if block.sheet == sheet:
                yield from _block(block, layout, seen)
        titles = [chart.title for chart in model.charts if chart.sheet == sheet]
        if titles:
            yield SHEET_CHARTS + "; ".join(escaped(title) for title in titles) + "."


def _block(block: Block, layout: Layout, seen: _Seen) -> Iterator[str]:
    title = block.title
    if isinstance(block, TableSpec) and block.number:
        title = f"{block.number}. {title}"
    rows = list(_rows(block, layout))
    if not rows:
        return
    # Cylinders, throws and supports repeat their formulas: once is enough.
    shape = _NUMBERS.sub("#", repr([row[:2] for row in rows]))
    first = seen.shapes.setdefault(shape, title)
    yield f"### {escaped(title)}"
    if block.note:
        yield escaped(block.note)
    if first != title:
        yield SAME_BLOCK.format(title=escaped(first))
        return
    yield table(SHEET_HEADS, rows)


def _rows(block: Block, layout: Layout) -> Iterator[tuple[str, ...]]:
    if isinstance(block, TableSpec):
        refs = RowReferences(layout, block)
        for column in block.columns:
            if column.expr is None:
                at = _FIRST_FORMULA_ROW, layout.column_of(f"{block.id}.{column.key}")
                formula = layout.step_formula(block, *at)
            else:
                formula = at_row(compile_formula(column.expr, refs), _FIRST_FORMULA_ROW)
            quantity = column.quantity
            yield _row(quantity.title, quantity.symbol, quantity.unit_label, column.source, formula)
        return
    refs = RowReferences(layout, None)
    if isinstance(block, ScalarTable):
        for scalar in block.scalars:
            quantity = scalar.quantity
            title = scalar.note or quantity.title
            symbol = "" if scalar.of in ("check", "check_value") else quantity.symbol
            formula = compile_formula(scalar.expr, refs)
            yield _row(title, symbol, quantity.unit_label, scalar.source, formula)
    elif isinstance(block, Grid):
        for row in block.rows:
            cell = next(cell for cell in row.cells if cell is not None)
            quantity = row.quantity
            formula = compile_formula(cell.expr, refs)
            yield _row(quantity.title, quantity.symbol, quantity.unit_label, cell.source, formula)


def _row(title: str, symbol: str, unit: str, source: str, formula: str) -> tuple[str, ...]:
    if len(formula) > _LONGEST:
        formula = formula[:_LONGEST] + "…"
    return (
        escaped(capital(title)),
        escaped(symbol) or "—",
        escaped(unit) or "—",
        escaped(source) or "—",
        code(formula),
    )
