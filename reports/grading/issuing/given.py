"""What stands in a work-book beside the cells to fill in: numbers, live formulas, or nothing.

A number is given only where it is no function of what is asked.  What follows from the
student's own columns is a live formula of them: it tells nothing before they are there.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np

from reports.model.blocks import Block, Model, TableSpec
from reports.model.evaluation import Evaluation, Graph, nodes_of

NUMBER, LIVE, HIDDEN = "number", "live", "hidden"
_PHASE = "phase_deg"


def with_own_shifts(model: Model, fill: Collection[Block]) -> Model:
    """The model in which tables that repeat a filled one at a phase are read from that one.

    The forces of cylinder 2 are those of cylinder 1 some degrees later: given as numbers
    they would be the answers, given by the same formulas they would be the textbook.
    """
    asked = [block for block in fill if isinstance(block, TableSpec)]
    run = Evaluation(model)
    changed: dict[str, TableSpec] = {}
    for table in model.tables.values():
        keys = {column.key for column in table.columns}
        if table in asked or _PHASE not in keys or len(table.rows) < 2:
            continue
        phase = np.asarray(run.value(f"{table.id}.{_PHASE}"), dtype=float)
        tables = [_read_from(table, own, phase, run) for own in asked]
        best = max(tables, key=lambda made: _count_changed(made, table), default=table)
        if best is not table:
            changed[table.id] = best
    if not changed:
        return model
    blocks = tuple(
        changed.get(block.id, block) if isinstance(block, TableSpec) else block
        for block in model.blocks
    )
    return replace(model, blocks=blocks)


def _count_changed(made: TableSpec, table: TableSpec) -> int:
    return sum(mine is not theirs for mine, theirs in zip(made.columns, table.columns, strict=True))


def _read_from(table: TableSpec, own: TableSpec, phase: np.ndarray, run: Evaluation) -> TableSpec:
    """A table with those columns read from another that are the same at the phase."""
    step = own.rows[1] - own.rows[0] if len(own.rows) > 1 else 0.0
    if not step or not np.allclose(np.diff(own.rows), step):
        return table
    at = (phase - own.rows[0]) / step
    rows = np.rint(at).astype(int)
    if not np.allclose(at, rows) or rows.min() < 0 or rows.max() >= len(own.rows):
        return table
    first = f" - {own.rows[0]:g}" if own.rows[0] else ""
    shared = {column.key for column in own.columns if column.expr is not None}
    columns = []
    for given in table.columns:
        column = given
        if column.key in shared and column.key != _PHASE:
            theirs = np.asarray(run.value(f"{table.id}.{column.key}"), dtype=float)
            mine = np.asarray(run.value(f"{own.id}.{column.key}"), dtype=float)[rows]
            scale = float(np.nanmax(np.abs(mine))) or 1.0
            if np.allclose(theirs, mine, rtol=0, atol=1e-9 * scale):
                expr = f"element({own.id}.{column.key}, round(({_PHASE}{first})/{step:g}) + 1)"
                column = replace(column, expr=expr, source=f"{own.number} в фазе цилиндра")
        columns.append(column)
    return table if columns == list(table.columns) else replace(table, columns=tuple(columns))


def states(
    model: Model, graph: Graph, blocks: Collection[Block], asked: Collection[str]
) -> Mapping[str, str]:
    """How each computed value of some blocks stands in the work-book that is not asked."""
    asked = frozenset(asked)
    there = {node for block in blocks for node in nodes_of(block)}
    inputs = set(model.fields) | {
        f"{table.id}.{column.key}"
        for table in model.tables.values()
        for column in table.columns
        if column.expr is None
    }
    known: dict[str, str] = {}

    def outside(node: str) -> frozenset[str]:
        """What a node refers to; rows that follow from those before them refer in circles."""
        table = model.whole_tables.get(node)
        if table is None:
            return graph.references(node)
        own = frozenset(f"{table.id}.{column.key}" for column in table.columns)
        return frozenset().union(*(graph.references(name) for name in own)) - own

    def state(node: str) -> str:
        if node in inputs or node in asked or node in model.input_runs:
            return LIVE
        if node not in there:
            return HIDDEN
        if node not in known:
            known[node] = HIDDEN  # while it is looked at: no circles
            known[node] = (
                NUMBER
                if asked.isdisjoint(graph.ancestors(node))
                else LIVE
                if all(state(name) != HIDDEN for name in outside(node))
                else HIDDEN
            )
        return known[node]

    return {node: state(node) for node in sorted(there - asked)}
