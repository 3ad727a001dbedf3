"""What is graded: the columns, grid rows and scalars of a model that the rubric asks for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from functools import cached_property

from kshm.nomenclature.quantity import Quantity
from reports.grading.issuing.rubric import Rubric
from reports.shared.errors import InputError, Problem
from reports.spec.blocks import Block, Column, Grid, Model, Scalar, TableSpec
from reports.spec.graph import Graph, graph_of, nodes_of


@dataclass(frozen=True, slots=True)
class Item:
    """One line of the feedback.

    ``nodes`` are the computed values it consists of: a column ``table.column``, or
    scalars.  ``helper`` items are filled in for convenience and worth nothing.
    """

    id: str
    block: str
    title: str
    symbol: str
    quantity: Quantity
    nodes: tuple[str, ...]
    labels: tuple[str, ...]
    source: str
    helper: bool

    @property
    def is_column(self) -> bool:
        """Whether this is a column of a table."""
        return "." in self.nodes[0]


@dataclass(frozen=True)
class Assignment:
    """A model under a rubric: blocks to fill in, blocks given as numbers, items."""

    model: Model
    rubric: Rubric
    fill: tuple[Block, ...]
    given: tuple[Block, ...]

    @cached_property
    def graph(self) -> Graph:
        """What depends on what."""
        return graph_of(self.model)

    def ancestors(self, item: Item) -> frozenset[str]:
        """Every node and input that an item depends on."""
        if len(item.nodes) == 1:
            return self.graph.ancestors(item.nodes[0])
        return frozenset().union(*(self.graph.ancestors(node) for node in item.nodes))

    @cached_property
    def items(self) -> tuple[Item, ...]:
        """All items, in the order of the book."""
        return tuple(item for block in self.fill for item in _items(block, self.model))

    @cached_property
    def points(self) -> Mapping[str, float]:
        """Points of each item; together they make the maximum of the rubric."""
        raw = {item.id: 0.0 if item.helper else 1.0 for item in self.items}
        blocks: dict[str, list[Item]] = {}
        for item in self.items:
            blocks.setdefault(item.block, []).append(item)
        for pattern, value in self.rubric.points.items():
            if "." not in pattern:  # points of a whole table, shared by its columns
                for block, items in blocks.items():
                    paid = [item for item in items if not item.helper]
                    if fnmatchcase(block, pattern) and paid:
                        raw.update({item.id: value / len(paid) for item in paid})
        for pattern, value in self.rubric.points.items():
            if "." in pattern:
                raw.update({id_: value for id_ in raw if fnmatchcase(id_, pattern)})
        total = sum(raw.values())
        scale = self.rubric.maximum / total if total else 0.0
        return {id_: value * scale for id_, value in raw.items()}

    @cached_property
    def blocks(self) -> tuple[Block, ...]:
        """All blocks of the work-book, in the model's order."""
        kept = {block.id for block in (*self.fill, *self.given)}
        return tuple(block for block in self.model.blocks if block.id in kept)

    @cached_property
    def kept_model(self) -> Model:
        """The model of the work-book: only the blocks that stand in it."""
        return replace(self.model, blocks=self.blocks)

    def with_model(self, model: Model) -> Assignment:
        """The same tables for a model with the same blocks."""
        made = Assignment(model, self.rubric, self.fill, self.given)
        for name in ("graph", "items", "points", "blocks", "fill_nodes", "given_nodes"):
            made.__dict__[name] = getattr(self, name)
        made.__dict__["kept_model"] = self.kept_model.with_inputs(model.input, model.inputs)
        return made

    @staticmethod
    def nodes(block: Block) -> list[str]:
        """Keys of the computed values of a block."""
        return nodes_of(block)

    def length(self, node: str) -> int:
        """Number of values of a node."""
        return len(self.model.tables[node.split(".", maxsplit=1)[0]].rows) if "." in node else 1

    @cached_property
    def fill_nodes(self) -> frozenset[str]:
        """Computed values that the student fills in."""
        return frozenset(node for block in self.fill for node in nodes_of(block))

    @cached_property
    def given_nodes(self) -> frozenset[str]:
        """Computed values that stand in the work-book as numbers."""
        return frozenset(node for block in self.given for node in nodes_of(block))

    def formulas_demanded(self, item: Item) -> bool:
        """Whether a number typed in does not do."""
        optional = self.rubric.formulas.optional
        return self.rubric.formulas.required and not matches((item.id, item.block), optional)


def assignment_of(model: Model, rubric: Rubric, source: str = "рубрика") -> Assignment:
    """Apply a rubric to a model.

    Raises:
        InputError: the rubric names a table that the engine does not have.
    """
    ids = [block.id for block in model.blocks]
    problems = []
    for key, patterns in (("fill", rubric.work.fill), ("given", rubric.work.given)):
        for pattern in patterns:
            if not any(fnmatchcase(id_, pattern) for id_ in ids):
                where = f"{source}: work.{key}"
                hint = "есть: " + ", ".join(ids[:12]) + "…"
                problems.append(Problem(where, f"нет таблицы {pattern}", hint))
    fill = [block for block in model.blocks if _wanted(block, rubric.work.fill)]
    filled = {block.id for block in fill}
    needed = _needed(model, fill)
    given = [
        block
        for block in model.blocks
        if block.id not in filled
        and (block.id in needed or matches((block.id,), rubric.work.given))
    ]
    made = Assignment(model, rubric, tuple(fill), tuple(given))
    known = {item.id for item in made.items} | filled
    for key, named in (
        ("points", list(rubric.points)),
        ("tolerance.items", list(rubric.tolerance.items)),
        ("formulas.optional", list(rubric.formulas.optional)),
    ):
        for pattern in named:
            if not any(fnmatchcase(id_, pattern) for id_ in known):
                what = f"нет заполняемой таблицы или столбца {pattern}"
                problems.append(Problem(f"{source}: {key}", what, "имена — в register.json"))
    if not problems and made.rubric.maximum and not sum(made.points.values()):
        problems.append(Problem(source, "ни один столбец не оценивается", "исправьте [points]"))
    if problems:
        raise InputError(problems)
    return made


def matches(ids: Iterable[str], patterns: Iterable[str]) -> bool:
    """Whether any of the ids fits any of the patterns."""
    patterns = tuple(patterns)
    return any(fnmatchcase(id_, pattern) for id_ in ids for pattern in patterns)


def _wanted(block: Block, patterns: tuple[str, ...]) -> bool:
    if isinstance(block, TableSpec) and block.helper:
        return block.id in patterns  # only when named in full
    return matches((block.id,), patterns)


def _needed(model: Model, fill: Iterable[Block]) -> set[str]:
    """Blocks that the formulas of some blocks depend on."""
    graph = graph_of(model)
    nodes = frozenset().union(*(graph.ancestors(n) for block in fill for n in nodes_of(block)))
    return {graph.owners[name] for name in nodes if name in graph.owners}


def _items(block: Block, model: Model) -> Iterable[Item]:
    if isinstance(block, TableSpec):
        for column in block.columns:
            if column.expr is not None:
                yield _column_item(block, column)
    elif isinstance(block, Grid):
        for row in block.rows:
            cells = [
                (label, cell)
                for label, cell in zip(block.labels, row.cells, strict=True)
                if cell is not None
            ]
            nodes, labels = tuple(c.key for _, c in cells), tuple(label for label, _ in cells)
            about = row.quantity
            source = cells[0][1].source
            yield Item(f"{block.id}.{row.of}", block.id, about.title, about.symbol, about, nodes,
                       labels, source, False)  # fmt: skip
    else:
        for scalar in block.scalars:
            yield _scalar_item(block.id, scalar)


def _column_item(table: TableSpec, column: Column) -> Item:
    about = column.quantity
    labels = tuple(f"{row:g}" for row in table.rows)
    node = f"{table.id}.{column.key}"
    helper = column.helper or table.helper
    return Item(node, table.id, about.title, about.symbol, about, (node,), labels, column.source,
                helper)  # fmt: skip


def _scalar_item(block: str, scalar: Scalar) -> Item:
    about = scalar.quantity
    return Item(f"{block}.{scalar.key}", block, scalar.note or about.title, about.symbol, about,
                (scalar.key,), ("",), scalar.source, False)  # fmt: skip
