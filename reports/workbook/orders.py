"""Which sines and cosines of a multiple of an angle the Fourier coefficients of a book sum over."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from dataclasses import dataclass, field

from reports.formula.parse import parse
from reports.spec.blocks import Model, TableSpec, nodes_in

# Angles of a grid and the step that they follow, None the step of the calculation.
Grid = tuple[tuple[float, ...], float | None]


@dataclass
class Waves:
    """Of a grid of angles the column that has them, and the orders of ``cos`` and of ``sin``."""

    angle: str
    orders: dict[str, tuple[float, ...]] = field(default_factory=dict)


def grid_of(table: TableSpec) -> Grid:
    """The grid of a table's angles: tables of one grid sum over the same waves."""
    return table.rows, table.step


def waves_of(model: Model) -> Mapping[Grid, Waves]:
    """Orders by grid; the rows of a table of orders follow one another.

    Raises:
        ValueError: an order is neither a number nor the first column of its table.
    """
    found: dict[Grid, Waves] = {}
    for block in model.blocks:
        table = block if isinstance(block, TableSpec) else None
        for _, node in nodes_in(block):
            if node.expr is None or "fourier_" not in node.expr:
                continue
            for turn, angle, order in _calls(node.expr):
                full = angle if "." in angle or table is None else f"{table.id}.{angle}"
                grid = grid_of(model.tables[full.partition(".")[0]])
                orders_of = found.setdefault(grid, Waves(full)).orders
                known = orders_of.get(turn, ())
                # Rows first: their orders stand side by side.
                rows = () if isinstance(order, float) else _rows(table, order)
                last = (order,) if isinstance(order, float) else ()
                orders_of[turn] = tuple(dict.fromkeys((*rows, *known, *last)))
    return found


def _calls(text: str) -> list[tuple[str, str, float | str]]:
    """Function, angle column and order of each Fourier coefficient of an expression."""
    return [
        (
            call.func.id.removeprefix("fourier_"),
            ast.unparse(call.args[1]),
            float(order.value) if isinstance(order, ast.Constant) else ast.unparse(order),  # type: ignore[arg-type]
        )
        for call in ast.walk(parse(text))
        if isinstance(call, ast.Call)
        and isinstance(call.func, ast.Name)
        and call.func.id.startswith("fourier_")
        for order in call.args[2:]
    ]


def _rows(table: TableSpec | None, order: str) -> tuple[float, ...]:
    if table is None or order != table.columns[0].key:
        raise ValueError(f"an order that is no number and no first column: {order}")
    return table.rows
