"""Items of a class: columns, grid rows and scalars that the rubric asks for.

A number is given only where it is no function of what is asked.  What follows from the
student's own columns is a live formula of them: it tells nothing before they are there.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from functools import cached_property
from math import sqrt

import numpy as np

from kshm.nomenclature.quantity import Quantity
from reports.document.text.symbols import indexed
from reports.formula.parse import names, parse
from reports.grading.issuing.rubric import Rubric
from reports.inputs.messages import likely_word
from reports.model.blocks import Block, Column, Grid, Model, Scalar, TableSpec
from reports.model.evaluation import Evaluation, Graph, graph_of, nodes_of
from reports.shared.errors import InputError, Problem

_LIKE = re.compile(r"\s*\(\d+\)$")  # sheets of one kind: «П4.3 (2)»
_COPY, _PICKS = 0.3, ("element", "col_last")
# What models with the same blocks have in common.
_SHARED = ("graph", "items", "points", "blocks", "fill_nodes", "states", "given_nodes",
           "live_nodes")  # fmt: skip
NUMBER, LIVE, HIDDEN = "number", "live", "hidden"
_PHASE, _CHECKS = "phase_deg", ("check", "check_value")


@dataclass(frozen=True, slots=True)
class Item:
    """One line of the feedback.

    ``nodes`` are the computed values it consists of: a column ``table.column``, or
    scalars.  ``helper`` items serve other columns of the book; they are asked and paid too.
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

    @property
    def indexed(self) -> str:
        """The symbol with «_» before its index."""
        plain = self.quantity.symbol
        return indexed(self.quantity.tex, plain) if self.symbol == plain else self.symbol


@dataclass(frozen=True)
class Assignment:
    """A model under a rubric: blocks to fill in, blocks given as numbers, items."""

    model: Model
    rubric: Rubric
    fill: tuple[Block, ...]
    given: tuple[Block, ...]

    @cached_property
    def graph(self) -> Graph:
        """Graph of dependencies."""
        return graph_of(self.model)

    def ancestors(self, item: Item) -> frozenset[str]:
        """Every node and input that an item depends on."""
        if len(item.nodes) == 1:
            return self.graph.ancestors(item.nodes[0])
        return frozenset().union(*(self.graph.ancestors(node) for node in item.nodes))

    @cached_property
    def items(self) -> tuple[Item, ...]:
        """All items, in the order of the book: what a person would calculate."""
        items = [item for block in self.fill for item in _items(block)]
        left = self.rubric.work.without
        items = [
            item
            for item in items
            if not all(map(self._is_fixed, item.nodes)) and not matches((item.id,), left)
        ]
        helpers = frozenset(node for item in items if item.helper for node in item.nodes)
        read: dict[str, list[str]] = {}
        for node in self.model.nodes if helpers else ():
            for name in self.graph.references(node) & helpers:
                read.setdefault(name, []).append(node)
        return tuple(
            item
            for item in items
            if not (item.helper and all(self._is_idle(n, read.get(n, ())) for n in item.nodes))
        )

    def _is_fixed(self, node: str) -> bool:
        """Whether a value only marks or remarks something, or is a number from a book.

        What words of the input data pick among such numbers is one too: of a steel its strength.
        """
        text = self.graph.expression(node)
        if text is None:
            return False
        tree = parse(text)
        if _is_pick(tree):  # marks pick among numbers from a book
            return all(map(self._is_fixed, self.graph.references(node)))
        return all(map(_is_constant, _outcomes(tree)))

    def _is_idle(self, node: str, readers: Sequence[str]) -> bool:
        """Tell whether a helper column feeds no graded value."""
        checks = {key for key, scalar in self.model.scalars.items() if scalar.of in _CHECKS}
        if readers and all(n in checks or self._is_fixed(n) for n in readers):
            return True
        before = self.graph.ancestors(node)
        return all("." in n and self.graph.expression(n) is None for n in before)

    @cached_property
    def points(self) -> Mapping[str, float]:
        """Points of each item; together they make what the rubric gives for the book."""
        raw = dict(self._usual_points)
        blocks: dict[str, list[Item]] = {}
        for item in self.items:
            blocks.setdefault(item.block, []).append(item)
        for pattern, value in self.rubric.points.items():
            if "." not in pattern:  # points of a whole table, shared by its columns
                for block, items in blocks.items():
                    if fnmatchcase(block, pattern):
                        whole = sum(self._usual_points[item.id] for item in items)
                        share = value / whole
                        raw.update({i.id: self._usual_points[i.id] * share for i in items})
        for pattern, value in self.rubric.points.items():
            if "." in pattern:
                raw.update({id_: value for id_ in raw if fnmatchcase(id_, pattern)})
        total = sum(raw.values())
        scale = self.rubric.calculated / total if total else 0.0
        return {id_: value * scale for id_, value in raw.items()}

    @cached_property
    def _usual_points(self) -> Mapping[str, float]:
        """Points where the rubric names none, one a column on the average.

        A sheet is a step of the work, the like sheets of the journals are one.  A large step
        is worth more, but not as many times more as it has columns.  Within a step an item
        is worth more the more of what is asked follows from it; a plain copy is worth less.
        """
        asks = {item.id: self._asks(item) for item in self.items}
        followers = dict.fromkeys(self.fill_nodes, 0)
        for item in self.items:
            for node in self.ancestors(item) & self.fill_nodes:
                followers[node] += 1
        sheets = {block.id: _LIKE.sub("", block.sheet) for block in self.fill}
        steps: dict[str, list[Item]] = {}
        for item in self.items:
            steps.setdefault(sheets[item.block], []).append(item)
        weights: dict[str, float] = {}
        for items in steps.values():
            inside = {
                item.id: asks[item.id] * sqrt(1 + max(followers[node] for node in item.nodes))
                for item in items
            }
            whole = sqrt(sum(asks[item.id] for item in items))
            scale = whole / sum(inside.values())
            weights |= {id_: value * scale for id_, value in inside.items()}
        mean = sum(weights.values()) / max(1, len(weights))
        return {id_: value / mean for id_, value in weights.items()}

    def _asks(self, item: Item) -> float:
        """Effort of an item: a formula, or a mere copy."""
        texts = [self.graph.expression(node) or "" for node in item.nodes]
        return _COPY if all(map(_is_copy, texts)) else 1.0

    @cached_property
    def blocks(self) -> tuple[Block, ...]:
        """All blocks of the work-book, in the model's order."""
        ids = {block.id for block in (*self.fill, *self.given)}
        return tuple(block for block in self.model.blocks if block.id in ids)

    @cached_property
    def kept_model(self) -> Model:
        """The model of the work-book: only the blocks that stand in it."""
        return replace(self.model, blocks=self.blocks)

    def with_model(self, model: Model) -> Assignment:
        """Return the same tables for a model with the same blocks."""
        other = Assignment(model, self.rubric, self.fill, self.given)
        for name in _SHARED:
            other.__dict__[name] = getattr(self, name)
        if "issued_formulas" in self.__dict__:
            other.__dict__["issued_formulas"] = self.__dict__["issued_formulas"]
        other.__dict__["kept_model"] = self.kept_model.with_inputs(model.input, model.inputs)
        return other

    @staticmethod
    def nodes(block: Block) -> list[str]:
        """Keys of the computed values of a block."""
        return nodes_of(block)

    def length(self, node: str) -> int:
        """Return number of values of a node."""
        return len(self.model.tables[node.partition(".")[0]].rows) if "." in node else 1

    @cached_property
    def fill_nodes(self) -> frozenset[str]:
        """Computed values that the student fills in."""
        return frozenset(node for item in self.items for node in item.nodes)

    @cached_property
    def states(self) -> Mapping[str, str]:
        """State in the work-book of each computed value that is not asked."""
        return states(self.model, self.graph, self.blocks, self.fill_nodes)

    @cached_property
    def given_nodes(self) -> frozenset[str]:
        """Computed values that stand in the work-book as numbers."""
        return frozenset(node for node, state in self.states.items() if state == NUMBER)

    @cached_property
    def live_nodes(self) -> frozenset[str]:
        """Computed values that stand in the work-book as formulas of the student's own."""
        return frozenset(node for node, state in self.states.items() if state == LIVE)

    def formulas_demanded(self, item: Item) -> bool:
        """Whether a number typed in does not do."""
        optional = self.rubric.formulas.optional
        return self.rubric.formulas.required and not matches((item.id, item.block), optional)


def assignment_of(model: Model, rubric: Rubric, source: str = "рубрика") -> Assignment:
    """Apply a rubric to a model.

    Raises:
        InputError: the rubric names a table that the engine does not have.
    """
    problems: list[Problem] = []

    def check(key: str, patterns: Iterable[str], names: Collection[str], kind: str) -> None:
        for pattern in patterns:
            if not any(fnmatchcase(id_, pattern) for id_ in names):
                where, hint = f"{source}: {key}", _near(pattern, names)
                problems.append(Problem(where, f"нет {kind} {pattern}", hint))

    ids = [block.id for block in model.blocks]
    check("work.fill", rubric.work.fill, ids, "таблицы")
    check("work.given", rubric.work.given, ids, "таблицы")
    fill = [block for block in model.blocks if _wanted(block, rubric.work.fill)]
    model = with_own_shifts(model, fill)
    fill = [block for block in model.blocks if _wanted(block, rubric.work.fill)]
    filled = {block.id for block in fill}
    needed = _needed(model, fill)
    given_blocks = [
        block
        for block in model.blocks
        if block.id not in filled
        and (block.id in needed or matches((block.id,), rubric.work.given))
    ]
    problems += [
        Problem(f"{source}: work.given", f"таблица {pattern} и дана, и заполняется",
                "оставьте её либо в given, либо в fill")
        for pattern in rubric.work.given
        if (named := {id_ for id_ in ids if fnmatchcase(id_, pattern)}) and named <= filled
    ]  # fmt: skip
    assignment = Assignment(model, rubric, tuple(fill), tuple(given_blocks))
    items = [item.id for block in fill for item in _items(block)]
    check("work.without", rubric.work.without, items, "столбца")
    names = [*dict.fromkeys(item.id for item in assignment.items), *sorted(filled)]
    kind = "заполняемой таблицы или столбца"
    check("points", rubric.points, names, kind)
    check("tolerance.items", rubric.tolerance.items, names, kind)
    check("formulas.optional", rubric.formulas.optional, names, kind)
    check("messages.items", (message.items for message in rubric.messages), names, kind)
    check("minimum.tables", rubric.minimum.tables, sorted(filled), "заполняемой таблицы")
    check("needs", rubric.needs, names, kind)
    check("needs", (name for needed in rubric.needs.values() for name in needed), names, kind)
    if not problems and assignment.rubric.calculated and not sum(assignment.points.values()):
        hint = "исправьте [points] или [work]"
        problems.append(Problem(source, "ни один столбец не оценивается", hint))
    if problems:
        raise InputError(problems)
    return assignment


def _near(pattern: str, names: Collection[str]) -> str:
    """Likely name, else the known names."""
    likely, table = likely_word(pattern, names), pattern.partition(".")[0]
    beside = sorted(names, key=lambda id_: not id_.startswith(table))  # those of its table first
    return f"возможно, {likely}" if likely else f"есть: {', '.join(beside[:12])}…"


def matches(ids: Iterable[str], patterns: Iterable[str]) -> bool:
    """Whether any of the ids fits any of the patterns."""
    patterns = tuple(patterns)
    return any(fnmatchcase(id_, pattern) for id_ in ids for pattern in patterns)


def _wanted(block: Block, patterns: tuple[str, ...]) -> bool:
    if isinstance(block, TableSpec) and block.helper:
        return block.id in patterns  # only when named in full
    return matches((block.id,), patterns)


def _needed(model: Model, fill: Iterable[Block]) -> set[str]:
    """Blocks that the formulas of some blocks depend on, and where columns without any stand."""
    graph = graph_of(model)
    nodes = frozenset().union(*(graph.ancestors(n) for block in fill for n in nodes_of(block)))
    return {graph.owners.get(name, name.partition(".")[0]) for name in nodes}


def _items(block: Block) -> Iterator[Item]:
    if isinstance(block, TableSpec):
        for column in block.columns:
            if column.expr is not None and not _is_mark(column):
                yield _column_item(block, column)
    elif isinstance(block, Grid):
        for row in block.rows:
            named = zip(block.labels, row.cells, strict=True)
            cells = [(label, cell) for label, cell in named if cell is not None]
            about = row.quantity
            words = [(label, c) for label, c in cells if c.quantity.digits.kind == "text"]
            numbers = [(label, c) for label, c in cells if c.quantity.digits.kind != "text"]
            if numbers:
                yield Item(f"{block.id}.{row.of}", block.id, about.title, about.symbol, about,
                           tuple(cell.key for _, cell in numbers),
                           tuple(label for label, _ in numbers), cells[0][1].source,
                           False)  # fmt: skip
            for label, cell in words:  # where the number is the greatest
                title, symbol = f"{about.title}: {label}", f"{about.symbol}, {cell.quantity.symbol}"
                yield Item(f"{block.id}.{cell.key}", block.id, title, symbol, cell.quantity,
                           (cell.key,), (label,), cell.source, False)  # fmt: skip
    else:
        for scalar in block.scalars:
            yield _scalar_item(block.id, scalar)


def _is_mark(column: Column) -> bool:
    """Return a column that only marks where an extreme lies: nobody would make it by hand."""
    return column.helper and column.quantity.digits.hides == "unused"


def _is_copy(text: str) -> bool:
    """Whether a formula only repeats another value, or its opposite, or picks it from a run."""
    tree = parse(text)
    if isinstance(tree, ast.UnaryOp):
        tree = tree.operand
    if isinstance(tree, ast.Call) and isinstance(tree.func, ast.Name):
        tree = tree.args[0] if tree.func.id in _PICKS else tree
    return isinstance(tree, (ast.Name, ast.Attribute))


def _outcomes(tree: ast.expr) -> Iterator[ast.expr]:
    """Tell what a formula may come to, whatever its conditions say."""
    if isinstance(tree, ast.IfExp):
        yield from _outcomes(tree.body)
        yield from _outcomes(tree.orelse)
    else:
        yield tree


def _is_pick(tree: ast.expr) -> bool:
    """Whether a formula sums products: a mark and what it picks, or a share of what is picked."""
    match tree:
        case ast.Call(func=ast.Name(id="total"), args=terms):
            return all(map(_is_pick, terms))
        case ast.BinOp(left=ast.Name() | ast.Constant(), op=ast.Mult(), right=ast.Name()):
            return True
    return False


def _is_constant(tree: ast.expr) -> bool:
    return not names(ast.unparse(tree))  # sines of numbers are no calculation either


def _column_item(table: TableSpec, column: Column) -> Item:
    about = column.quantity
    labels = tuple(f"{row:g}" for row in table.rows)
    node = f"{table.id}.{column.key}"
    helper = column.helper or table.helper
    return Item(node, table.id, about.title, about.symbol, about, (node,), labels, column.source,
                helper)  # fmt: skip


def _scalar_item(block: str, scalar: Scalar) -> Item:
    about = scalar.quantity
    return Item(f"{block}.{scalar.key}", block, scalar.label or about.title, about.symbol, about,
                (scalar.key,), ("",), scalar.source, False)  # fmt: skip


# --- what stands beside the cells to fill in -----------------------------------------------------


def with_own_shifts(model: Model, fill: Collection[Block]) -> Model:
    """Return the model in which tables that repeat a filled one at a phase are read from that one.

    The forces of cylinder 2 are those of cylinder 1 some degrees later: given as numbers
    they would be the answers, given by the same formulas they would be the textbook.
    """
    tables_to_fill = [block for block in fill if isinstance(block, TableSpec)]
    run = Evaluation(model)
    changed: dict[str, TableSpec] = {}
    for table in model.tables.values():
        keys = {column.key for column in table.columns}
        if table in tables_to_fill or _PHASE not in keys or len(table.rows) < 2:
            continue
        phase = np.asarray(run.value(f"{table.id}.{_PHASE}"), dtype=float)
        tables = [_read_from(table, table_of, phase, run) for table_of in tables_to_fill]
        best = max(tables, key=lambda shifted: _count_changed(shifted, table), default=table)
        if best is not table:
            changed[table.id] = best
    if not changed:
        return model
    blocks = tuple(
        changed.get(block.id, block) if isinstance(block, TableSpec) else block
        for block in model.blocks
    )
    return replace(model, blocks=blocks)


def _count_changed(shifted: TableSpec, table: TableSpec) -> int:
    return sum(
        mine is not theirs for mine, theirs in zip(shifted.columns, table.columns, strict=True)
    )


def _read_from(
    table: TableSpec, target: TableSpec, phase: np.ndarray, run: Evaluation
) -> TableSpec:
    """Return a table with those columns read from another that are the same at the phase."""
    step = target.rows[1] - target.rows[0] if len(target.rows) > 1 else 0.0
    if not step or not np.allclose(np.diff(target.rows), step):
        return table
    at = (phase - target.rows[0]) / step
    rows = np.rint(at).astype(int)
    if not np.allclose(at, rows) or rows.min() < 0 or rows.max() >= len(target.rows):
        return table
    first = f" - {target.rows[0]:g}" if target.rows[0] else ""
    shared = {column.key for column in target.columns if column.expr is not None}
    columns = []
    for given in table.columns:
        column = given
        if column.key in shared and column.key != _PHASE:
            theirs = np.asarray(run.value(f"{table.id}.{column.key}"), dtype=float)
            mine = np.asarray(run.value(f"{target.id}.{column.key}"), dtype=float)[rows]
            scale = float(np.nanmax(np.abs(mine))) or 1.0
            if np.allclose(theirs, mine, rtol=0, atol=1e-9 * scale):
                expr = f"element({target.id}.{column.key}, round(({_PHASE}{first})/{step:g}) + 1)"
                column = replace(column, expr=expr, source=f"{target.number} в фазе цилиндра")
        columns.append(column)
    return table if columns == list(table.columns) else replace(table, columns=tuple(columns))


def states(
    model: Model, graph: Graph, blocks: Collection[Block], to_fill: Collection[str]
) -> Mapping[str, str]:
    """State of each computed value of some blocks that is not asked."""
    to_fill = frozenset(to_fill)
    there = {node for block in blocks for node in nodes_of(block)}
    inputs = set(model.fields) | {
        f"{table.id}.{column.key}"
        for table in model.tables.values()
        for column in table.columns
        if column.expr is None
    }
    states_of: dict[str, str] = {}

    def outside(node: str) -> frozenset[str]:
        """Tell what a node refers to; rows that follow from those before them refer in circles."""
        table = model.whole_tables.get(node)
        if table is None:
            return graph.references(node)
        columns = frozenset(f"{table.id}.{column.key}" for column in table.columns)
        return frozenset().union(*(graph.references(name) for name in columns)) - columns

    def state(node: str) -> str:
        if node in inputs or node in to_fill or node in model.input_runs:
            return LIVE
        if node not in there:
            return HIDDEN
        if node not in states_of:
            states_of[node] = HIDDEN  # while it is looked at: no circles
            states_of[node] = (
                NUMBER
                if to_fill.isdisjoint(graph.ancestors(node))
                else LIVE
                if all(state(name) != HIDDEN for name in outside(node))
                else HIDDEN
            )
        return states_of[node]

    return {node: state(node) for node in sorted(there - to_fill)}
