"""Sines and cosines of the orders that a book's Fourier sums use."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from reports.formula.parse import parse
from reports.model.blocks import Model, TableSpec, nodes_in

# Angles of a grid and the step that they follow, None the step of the calculation.
Grid = tuple[tuple[float, ...], float | None]


@dataclass
class Waves:
    """Of a grid of angles the column that has them, and the orders of ``cos`` and of ``sin``."""

    angle: str
    orders: dict[str, tuple[float, ...]] = field(default_factory=dict)


def grid_of(table: TableSpec) -> Grid:
    """Return the grid of a table's angles: tables of one grid sum over the same waves."""
    return table.rows, table.step


def runs_of(model: Model) -> Mapping[str, Waves]:
    """Orders of the sums over a run of a grid, by the run of their angles."""
    waves: dict[str, Waves] = {}
    for table, turn, angle, order in _met(model, "wave_"):
        _add(waves.setdefault(angle, Waves(angle)), table, turn, order)
    return waves


def waves_of(model: Model) -> Mapping[Grid, Waves]:
    """Orders by grid; the rows of a table of orders follow one another.

    Raises:
        ValueError: an order is neither a number nor the first column of its table.
    """
    waves: dict[Grid, Waves] = {}
    for table, turn, angle, order in _met(model, "fourier_"):
        full = angle if "." in angle or table is None else f"{table.id}.{angle}"
        grid = grid_of(model.tables[full.partition(".")[0]])
        _add(waves.setdefault(grid, Waves(full)), table, turn, order)
    return waves


def _add(waves: Waves, table: TableSpec | None, turn: str, order: float | str) -> None:
    """More orders; those of a table's rows stand side by side."""
    required = (order,) if isinstance(order, float) else _rows(table, order)
    orders = waves.orders.setdefault(turn, ())
    if place_of(orders, required) is None:
        waves.orders[turn] = (*orders, *required)


def place_of(orders: tuple[float, ...], required: tuple[float, ...]) -> int | None:
    """Where some orders stand side by side among others."""
    count = len(required)
    positions = range(len(orders) - count + 1)
    return next((i for i in positions if orders[i : i + count] == required), None)


def _met(model: Model, beginning: str) -> Iterator[tuple[TableSpec | None, str, str, float | str]]:
    """Table, function, angles and order of each call of the functions of such a name."""
    for block in model.blocks:
        table = block if isinstance(block, TableSpec) else None
        for _, node in nodes_in(block):
            if node.expr is None or beginning not in node.expr:
                continue
            for call in ast.walk(parse(node.expr)):
                if not (isinstance(call, ast.Call) and isinstance(call.func, ast.Name)):
                    continue
                if call.func.id.startswith(beginning):
                    # After what is summed: the angles and the order.
                    angle, order = call.args[-2:]
                    said = (
                        float(order.value)  # type: ignore[arg-type]
                        if isinstance(order, ast.Constant)
                        else ast.unparse(order)
                    )
                    yield table, call.func.id.removeprefix(beginning), ast.unparse(angle), said


def _rows(table: TableSpec | None, order: str) -> tuple[float, ...]:
    if table is None or order != table.columns[0].key:
        raise ValueError(f"an order that is no number and no first column: {order}")
    return table.rows
