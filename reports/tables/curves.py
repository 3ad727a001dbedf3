"""Curves of the workbook's charts on a finer grid than its tables: the books of ``place drawn``."""

from __future__ import annotations

from dataclasses import replace

from kshm.defaults import FINE_STEP
from reports.inputs.to_si.engine import smallness_of
from reports.model.blocks import Model, TableSpec, scalars_of
from reports.model.chapter_source import shelf_of
from reports.model.contents import contents_of
from reports.model.evaluation import Evaluation, Values
from reports.model.rename import sized, substituted
from reports.model.shape import Scope
from reports.tables.contexts import books
from reports.tables.registry import stand_ins


def with_curves(model: Model) -> Model:
    """Return a model with the tables that its charts are drawn from; as it is where its own do."""
    if not model.charts or model.input.calculation.step_deg <= FINE_STEP:
        return model
    names = contents_of(shelf_of(model.input.books)).parts["drawn"]
    part = books(Scope(model.input), names)
    blocks = sized(substituted(part.blocks, stand_ins(model.input)), smallness_of(model.input))
    drawn = frozenset(block.sheet for block in blocks)
    return replace(model, blocks=(*model.blocks, *blocks), drawn=drawn)


def with_values(model: Model, values: Values) -> Values:
    """Return values of a model with those of its curves, which it has not."""
    known = values.scalars | {
        f"{table}.{key}": column
        for table, columns in values.columns.items()
        for key, column in columns.items()
    }
    run = Evaluation(model, known)
    scalars, columns = dict(values.scalars), dict(values.columns)
    for block in (block for block in model.blocks if block.sheet in model.drawn):
        if isinstance(block, TableSpec):
            keys = [column.key for column in block.columns]
            columns[block.id] = {key: run.value(f"{block.id}.{key}") for key in keys}
        for scalar in scalars_of(block):
            value = run.value(scalar.key)
            scalars[scalar.key] = value if isinstance(value, str) else float(value)
    return Values(scalars, columns)
