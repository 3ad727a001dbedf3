"""Which value depends on which: one graph for all books whose formulas are the same."""

from __future__ import annotations

from functools import cached_property

from reports.formula.parse import names
from reports.spec.blocks import Block, Grid, Model, TableSpec, scalars_of

_KEPT = 8
_graphs: dict[tuple[tuple[str, str | None], ...], Graph] = {}


def graph_of(model: Model) -> Graph:
    """The graph of a model; made once for a class, whose books differ in numbers only."""
    key = tuple(_formulas(model).items())
    found = _graphs.get(key)
    if found is None:
        if len(_graphs) >= _KEPT:
            _graphs.clear()
        found = _graphs[key] = Graph(model)
    return found


def nodes_of(block: Block) -> list[str]:
    """Keys of all computed values of a block: scalars, and columns as ``table.column``."""
    if isinstance(block, TableSpec):
        return [f"{block.id}.{column.key}" for column in block.columns if column.expr is not None]
    return [scalar.key for scalar in scalars_of(block)]


def node_of(name: str, table: str, model: Model) -> str:
    """A bare name in a table's formula is a column of the same table first."""
    spec = model.tables.get(table)
    if spec is not None and any(column.key == name for column in spec.columns):
        return f"{table}.{name}"
    return name


def _formulas(model: Model) -> dict[str, str | None]:
    """Formula of every column and scalar; None for the column of angles."""
    found: dict[str, str | None] = {}
    for block in model.blocks:
        if isinstance(block, TableSpec):
            found.update({f"{block.id}.{c.key}": c.expr for c in block.columns})
        else:
            found.update({scalar.key: scalar.expr for scalar in scalars_of(block)})
    return found


class Graph:
    """Formulas of a model's nodes and what they refer to."""

    def __init__(self, model: Model) -> None:
        self._formulas = _formulas(model)
        self._runs = {
            f"{block.id}.{row.of}": [cell.key for cell in row.cells if cell is not None]
            for block in model.blocks
            if isinstance(block, Grid)
            for row in block.rows
        }
        self.owners = {node: block.id for block in model.blocks for node in nodes_of(block)}
        self._references: dict[str, frozenset[str]] = {}
        self._ancestors: dict[str, frozenset[str]] = {}

    def expression(self, node: str) -> str | None:
        """Formula of a node; None for an input or an angle."""
        return self._formulas.get(node)

    def references(self, node: str) -> frozenset[str]:
        """Nodes and inputs that a node's formula names."""
        found = self._references.get(node)
        if found is None:
            text = self.expression(node)
            table = node.split(".", maxsplit=1)[0] if "." in node else ""
            made: set[str] = set()
            for name in names(text) if text is not None else ():
                local = f"{table}.{name}"
                key = local if local in self._formulas else name
                made.update(self._runs.get(key, (key,)))
            found = self._references[node] = frozenset(made)
        return found

    def ancestors(self, node: str) -> frozenset[str]:
        """Every node and input that a node depends on."""
        found = self._ancestors.get(node)
        if found is None:
            seen: set[str] = set()
            stack = [node]
            while stack:
                for name in self.references(stack.pop()):
                    if name not in seen:
                        seen.add(name)
                        stack.append(name)
            found = self._ancestors[node] = frozenset(seen)
        return found

    @cached_property
    def columns(self) -> frozenset[str]:
        """All columns as ``table.column``, columns of angles too."""
        return frozenset(node for node in self._formulas if "." in node)
