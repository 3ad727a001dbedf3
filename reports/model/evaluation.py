"""Numeric values of a model's expressions: the second statement of the mechanics."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reports.formula.numeric import compiled
from reports.formula.parse import names
from reports.model.blocks import Block, Column, Model, TableSpec, nodes_in

Array = NDArray[np.float64]
_PREVIOUS = re.compile(r"\bprevious\((\w+)\)")
_ABOVE = "above_"  # before the name of a column: its value in the row above
_KEPT = 8
_graphs: dict[tuple[tuple[str, str | None], ...], Graph] = {}


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

    def __init__(self, model: Model, values: Mapping[str, Any] | None = None) -> None:
        self.model = model
        self.done: dict[str, Any] = {}
        self.running: set[str] = set()
        self.nodes, self.runs, self.programs = model.nodes, model.grid_runs, model.programs
        for field in model.inputs:
            value = field.value
            if field.choices is not None and isinstance(value, str):
                value = field.choices[value]
            self.done[field.name] = value
        for key, cells in model.input_runs.items():
            points = [model.fields[name].value for name in cells]
            self.done[key] = np.array(points, dtype=float)
        self.inputs = dict(self.done)
        self.done.update(values or {})

    def fork(self, values: Mapping[str, Any]) -> Evaluation:
        """Return the same model with other known values, nothing else evaluated yet."""
        other = Evaluation.__new__(Evaluation)
        other.model, other.nodes, other.running = self.model, self.nodes, set()
        other.inputs, other.runs, other.programs = self.inputs, self.runs, self.programs
        other.done = {**self.inputs, **values}
        return other

    def value(self, key: str) -> Any:  # noqa: ANN401
        """Value of a node or input: a number, a text, or an array of one value per row."""
        if key in self.done:
            return self.done[key]
        if not self.running:
            with np.errstate(all="ignore"):  # branches not taken may divide by zero
                return self._calculated(key)
        return self._calculated(key)

    def values_for(self, node: str) -> Callable[[str], Any]:
        """Values of the names in a node's formula."""
        table = node.split(".", maxsplit=1)[0] if "." in node else ""
        return lambda name: self.value(node_of(name, table, self.model))

    def _calculated(self, key: str) -> Any:  # noqa: ANN401
        done = self.done
        if key in self.runs:
            done[key] = np.array([self.value(name) for name in self.runs[key]], dtype=float)
            return done[key]
        if key in self.running:
            raise ValueError(f"the formulas refer to each other in a circle at {key}")
        self.running.add(key)
        table = self.model.whole_tables.get(key)
        if table is not None:
            columns = self._by_rows(table) if self.nodes[key].expr else self._computed(table)
            done.update({node: values for node, values in columns.items() if node not in done})
            self.running.discard(key)
            return done[key]
        program = self.programs.get(key)
        if program is None:
            program = self.programs[key] = _program(self.model, key)
        for name in program.needs:
            if name not in done:
                self._calculated(name)
        result = program.act(done)
        if program.rows:
            result = np.asarray(result)
            if result.shape != (program.rows,):
                result = np.broadcast_to(result, (program.rows,))
        self.running.discard(key)
        done[key] = result
        return result

    def _computed(self, table: TableSpec) -> dict[str, Array]:
        """Columns that the table's own function gives."""
        if table.computed is None:
            raise ValueError(f"nothing computes {table.id}")
        columns = table.computed(self.model.input)
        return {f"{table.id}.{key}": np.asarray(columns[key]) for key in columns}

    def _by_rows(self, table: TableSpec) -> dict[str, Array]:
        """All columns of a table whose rows follow from those before, a row at a time."""
        keys = [column.key for column in table.columns]
        acts, needs = _row_acts(table.columns)
        row: dict[str, Any] = {name: self._needed(name) for name in needs}
        columns = {key: np.zeros(len(table.rows)) for key in keys}
        columns_done = {key: self.done.get(f"{table.id}.{key}") for key in keys}
        columns_done[keys[0]] = np.array(table.rows)
        for i in range(len(table.rows)):
            row.update({f"{_ABOVE}{key}": row.get(key, 0.0) for key in keys})
            for key, act in zip(keys, acts, strict=True):
                known = columns_done[key]
                row[key] = columns[key][i] = act(row) if known is None else known[i]
        return {f"{table.id}.{key}": values for key, values in columns.items()}

    def _needed(self, name: str) -> Any:  # noqa: ANN401
        return self.done[name] if name in self.done else self._calculated(name)


@lru_cache(maxsize=256)
def _row_acts(
    columns: tuple[Column, ...],
) -> tuple[tuple[Callable[[dict[str, Any]], Any], ...], frozenset[str]]:
    """What each column of a table does with the values of a row, and the names from outside."""
    keys = {column.key for column in columns}
    texts = [_PREVIOUS.sub(rf"{_ABOVE}\1", column.expr or "0") for column in columns]
    outside = frozenset().union(*(names(column.expr) for column in columns if column.expr)) - keys
    return tuple(compiled(text, str) for text in texts), outside


@dataclass(frozen=True, slots=True)
class Program:
    """How a node is calculated; ``rows`` of a column, 0 of a scalar."""

    needs: tuple[str, ...]
    act: Callable[[dict[str, Any]], Any]
    rows: int


def _program(model: Model, key: str) -> Program:
    node = model.nodes[key]
    if not isinstance(node, Column):
        return Program(tuple(names(node.expr)), _act(node.expr, "", frozenset()), 0)
    table = model.tables[key.split(".", maxsplit=1)[0]]
    if node.expr is None:
        return Program((), lambda _: np.array(table.rows), len(table.rows))
    # A bare name is a column of the same table first, then a scalar.
    local = frozenset(name for name in names(node.expr) if f"{table.id}.{name}" in model.nodes)
    needs = tuple(f"{table.id}.{name}" if name in local else name for name in names(node.expr))
    return Program(needs, _act(node.expr, table.id, local), len(table.rows))


@lru_cache(maxsize=8192)  # many models have the same formulas
def _act(text: str, table: str, local: frozenset[str]) -> Callable[[dict[str, Any]], Any]:
    return compiled(text, lambda name: f"{table}.{name}" if name in local else name)


def evaluate_model(model: Model) -> Values:
    """Evaluate all expressions of a model in numpy."""
    run = Evaluation(model)
    scalars = {key: run.value(key) for key in model.scalars}
    columns = {
        table.id: {column.key: run.value(f"{table.id}.{column.key}") for column in table.columns}
        for table in model.tables.values()
    }
    return Values({k: v if isinstance(v, str) else float(v) for k, v in scalars.items()}, columns)


def graph_of(model: Model) -> Graph:
    """Return the graph of a model; made once for a class, whose books differ in numbers only."""
    key = tuple((name, node.expr) for name, node in model.nodes.items())
    graph = _graphs.get(key)
    if graph is None:
        if len(_graphs) >= _KEPT:
            _graphs.clear()
        graph = _graphs[key] = Graph(model)
    return graph


def nodes_of(block: Block) -> list[str]:
    """Keys of all computed values of a block: scalars, and columns as ``table.column``."""
    return [key for key, node in nodes_in(block) if node.expr is not None]


def node_of(name: str, table: str, model: Model) -> str:
    """Resolve a bare name in a table's formula: a column of the same table first."""
    spec = model.tables.get(table)
    if spec is not None and any(column.key == name for column in spec.columns):
        return f"{table}.{name}"
    return name


class Graph:
    """Formulas of a model's nodes and what they refer to."""

    def __init__(self, model: Model) -> None:
        self._formulas = {key: node.expr for key, node in model.nodes.items()}
        self._runs = model.grid_runs
        self.owners = {node: block.id for block in model.blocks for node in nodes_of(block)}
        self._references: dict[str, frozenset[str]] = {}
        self._ancestors: dict[str, frozenset[str]] = {}

    def expression(self, node: str) -> str | None:
        """Return the formula of a node; None for an input or an angle."""
        return self._formulas.get(node)

    def references(self, node: str) -> frozenset[str]:
        """Nodes and inputs that a node's formula names."""
        cached = self._references.get(node)
        if cached is None:
            text = self.expression(node)
            table = node.split(".", maxsplit=1)[0] if "." in node else ""
            keys: set[str] = set()
            for name in names(text) if text is not None else ():
                local = f"{table}.{name}"
                key = local if local in self._formulas else name
                keys.update(self._runs.get(key, (key,)))
            cached = self._references[node] = frozenset(keys)
        return cached

    def ancestors(self, node: str) -> frozenset[str]:
        """Every node and input that a node depends on."""
        nodes = self._ancestors.get(node)
        if nodes is None:
            seen: set[str] = set()
            stack = [node]
            while stack:
                for name in self.references(stack.pop()):
                    if name not in seen:
                        seen.add(name)
                        stack.append(name)
            nodes = self._ancestors[node] = frozenset(seen)
        return nodes
