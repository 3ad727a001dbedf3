"""Numeric values of a model's expressions: the second statement of the mechanics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reports.formula.numeric import evaluate
from reports.tables.spec import Column, Grid, Model, Scalar

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Values:
    """Values by scalar key and by (table, column)."""

    scalars: dict[str, float | str]
    columns: dict[str, dict[str, Array]]


class Evaluation:
    """Evaluates every node once, whatever the order in which the tables stand.

    Args:
        model: the specifications.
        known: values that take the place of the formulas of their nodes, by the key of a
            scalar or input or by ``table.column``.
    """

    def __init__(self, model: Model, known: Mapping[str, Any] | None = None) -> None:
        self.model = model
        self.done: dict[str, Any] = {}
        self.running: set[str] = set()
        self.nodes: dict[str, Scalar | Column] = dict(model.scalars)
        for table in model.tables.values():
            for column in table.columns:
                self.nodes[f"{table.id}.{column.key}"] = column
        self.runs = {
            f"{block.id}.{row.of}": [cell.key for cell in row.cells if cell is not None]
            for block in model.blocks
            if isinstance(block, Grid)
            for row in block.rows
        }
        for field in model.inputs:
            value = field.value
            if field.choices is not None and isinstance(value, str):
                value = field.choices[value]
            self.done[field.name] = value
        for key, names in model.input_runs.items():
            points = [model.fields[name].value for name in names]
            self.done[key] = np.array(points, dtype=float)
        self.inputs = dict(self.done)
        self.done.update(known or {})

    def fork(self, known: Mapping[str, Any]) -> Evaluation:
        """The same model with other known values, nothing else evaluated yet."""
        other = Evaluation.__new__(Evaluation)
        other.model, other.nodes, other.running = self.model, self.nodes, set()
        other.inputs, other.runs = self.inputs, self.runs
        other.done = {**self.inputs, **known}
        return other

    def value(self, key: str) -> Any:  # noqa: ANN401
        """Value of a node or input: a number, a text, or an array of one value per row."""
        if key in self.done:
            return self.done[key]
        if key in self.runs:
            self.done[key] = np.array([self.value(name) for name in self.runs[key]], dtype=float)
            return self.done[key]
        if key in self.running:
            msg = f"the formulas refer to each other in a circle at {key}"
            raise ValueError(msg)
        self.running.add(key)
        node = self.nodes[key]
        table = key.split(".", maxsplit=1)[0] if isinstance(node, Column) else ""
        if node.expr is None:
            result: Any = np.array(self.model.tables[table].rows)
        else:
            result = evaluate(node.expr, lambda name: self.value(self._global(name, table)))
            if isinstance(node, Column):
                count = len(self.model.tables[table].rows)
                result = np.broadcast_to(np.asarray(result), (count,))
        self.running.discard(key)
        self.done[key] = result
        return result

    def _global(self, name: str, table: str) -> str:
        """A bare name is a column of the same table first, then a scalar."""
        local = f"{table}.{name}"
        return local if table and local in self.nodes else name


def evaluate_model(model: Model) -> Values:
    """Evaluate all expressions of a model in numpy."""
    run = Evaluation(model)
    scalars = {key: run.value(key) for key in model.scalars}
    columns = {
        table.id: {column.key: run.value(f"{table.id}.{column.key}") for column in table.columns}
        for table in model.tables.values()
    }
    return Values({k: v if isinstance(v, str) else float(v) for k, v in scalars.items()}, columns)
