"""Which value depends on which: one graph for all books whose formulas are the same."""

from __future__ import annotations

from reports.formula.parse import names
from reports.spec.blocks import Block, Model, nodes_in

_KEPT = 8
_graphs: dict[tuple[tuple[str, str | None], ...], Graph] = {}


def graph_of(model: Model) -> Graph:
    """The graph of a model; made once for a class, whose books differ in numbers only."""
    key = tuple((name, node.expr) for name, node in model.nodes.items())
    found = _graphs.get(key)
    if found is None:
        if len(_graphs) >= _KEPT:
            _graphs.clear()
        found = _graphs[key] = Graph(model)
    return found


def nodes_of(block: Block) -> list[str]:
    """Keys of all computed values of a block: scalars, and columns as ``table.column``."""
    return [key for key, node in nodes_in(block) if node.expr is not None]


def node_of(name: str, table: str, model: Model) -> str:
    """A bare name in a table's formula is a column of the same table first."""
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
