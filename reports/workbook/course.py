"""Short workbook: the sheets of a course project, and what their formulas need of the others."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from reports.model.blocks import Block, Grid, GridRow, Model, ScalarTable, TableSpec, nodes_in
from reports.model.charts import Series
from reports.model.evaluation import Graph
from reports.workbook.chapters import contents_for, in_course, ordered
from reports.workbook.motion import nodes_read


def short_model(model: Model) -> Model:
    """Return the model of the workbook that the input asks for.

    Of a sheet beyond the course the blocks keep what formulas and charts of the course refer to;
    such sheets are folded, the others left out.
    """
    if model.input.workbook.sheets == "full":
        return model
    contents = contents_for(model)
    beyond = {title for title in model.sheets if not in_course(title, contents)}
    if not beyond:
        return model
    charts = tuple(chart for chart in model.charts if chart.sheet not in {"", *beyond})
    needed = _needed(model, beyond, [line for chart in charts for line in chart.series])
    parts = (block if block.sheet not in beyond else _part(block, needed) for block in model.blocks)
    blocks = tuple(block for block in parts if block is not None)
    folded = frozenset(beyond & {block.sheet for block in blocks})
    left_out = tuple(ordered(beyond - folded, contents))
    return replace(model, blocks=blocks, charts=charts, left_out=left_out, folded=folded)


def _needed(model: Model, beyond: set[str], series: list[Series]) -> set[str]:
    """Nodes that stand in the course's sheets, and all that they refer to."""
    graph, runs = Graph(model), model.grid_runs
    together = {key: keys for block in model.blocks for keys in _together(block) for key in keys}
    waiting = [
        key for block in model.blocks if block.sheet not in beyond for key, _ in nodes_in(block)
    ]
    waiting += nodes_read(model)
    for line in series:
        waiting += [key for axis in (line.x, line.y) for key in runs.get(axis, (axis,))]
    needed: set[str] = set()
    while waiting:
        key = waiting.pop()
        if key in needed:
            continue
        needed.add(key)
        waiting += [*graph.references(key), *together.get(key, ())]
    return needed


def _together(block: Block) -> Iterator[tuple[str, ...]]:
    """Groups of nodes that stand only together."""
    keys = tuple(key for key, _ in nodes_in(block))
    if isinstance(block, TableSpec) and not block.row_by_row and block.computed is None:
        yield from ((key, keys[0]) for key in keys)
    elif isinstance(block, Grid):
        yield from (_cells(row) for row in block.rows)
    elif isinstance(block, ScalarTable) and block.verdicts is None:
        yield from ((key,) for key in keys)
    else:
        yield keys


def _cells(row: GridRow) -> tuple[str, ...]:
    return tuple(cell.key for cell in row.cells if cell is not None)


def _part(block: Block, needed: set[str]) -> Block | None:
    """Return what is needed of a block; None where nothing is."""
    if isinstance(block, TableSpec):
        columns = tuple(c for c in block.columns if f"{block.id}.{c.key}" in needed)
        return replace(block, columns=columns, note="") if columns else None
    if isinstance(block, Grid):
        rows = tuple(row for row in block.rows if needed.intersection(_cells(row)))
        return replace(block, rows=rows, note="") if rows else None
    scalars = tuple(scalar for scalar in block.scalars if scalar.key in needed)
    return replace(block, scalars=scalars, note="") if scalars else None
