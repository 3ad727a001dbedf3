"""Questions for the defence from a student's own numbers, with answers for the instructor.

Nothing here knows mechanics: where a column is largest, where its sign turns, what follows from an
input, all comes from the tables and their formulas.
"""

from __future__ import annotations

import ast
import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reports.document.text.symbols import indexed
from reports.formula.numeric import evaluate_tree
from reports.formula.parse import names, parse
from reports.formula.plain import plain
from reports.grading.issuing.assignment import Assignment, Item
from reports.model.blocks import TableSpec
from reports.model.evaluation import Evaluation, node_of
from reports.shared.russian import short, uncapital, written

Array = NDArray[np.float64]
COUNT = 5  # questions for a student
_MORE = 1.1  # an input is made larger by a tenth
_TELLING = 0.005  # change of a value that is worth a question
_DIGITS = (3, 4, 5, 6, 8, 10)  # of operands, as few as give the printed answer
_WAVES = frozenset(("sin", "cos", "tan"))
_DEAD = 180.0  # degrees between the dead centres


@dataclass(frozen=True, slots=True)
class Question:
    """A question with its answer; ``kind`` tells questions of one sort."""

    kind: str
    item: str
    text: str
    answer: str


def questions_for(
    assignment: Assignment, seed: str, wrong: Sequence[str] = (), count: int = COUNT
) -> list[Question]:
    """Questions about a student's variant, those on ``wrong`` items first; the same for a seed."""
    chance = random.Random(seed)
    maker = _Maker(assignment)
    items = list(assignment.items)
    chance.shuffle(items)
    items.sort(key=lambda item: item.id not in wrong)
    chosen: list[Question] = []
    kinds = [maker.largest, maker.change, maker.sign, maker.change, maker.substitution]
    for number in range(count):
        kind = kinds[number % len(kinds)]
        taken = {each.item for each in chosen}
        question = next(_of(kind, (i for i in items if i.id not in taken), chance), None)
        if question is not None:
            chosen.append(question)
    return chosen


def _of(
    kind: Callable[[Item, random.Random], Question | None], items: Iterator[Item] | Any,  # noqa: ANN401
    chance: random.Random,
) -> Iterator[Question]:  # fmt: skip
    return (question for item in items if (question := kind(item, chance)) is not None)


class _Maker:
    """Questions of each kind about one variant."""

    def __init__(self, assignment: Assignment) -> None:
        self.assignment, self.model = assignment, assignment.model
        self.run = Evaluation(assignment.model)

    def largest(self, item: Item, chance: random.Random) -> Question | None:
        """Where a column is largest, and why there."""
        column = self._column(item)
        if column is None:
            return None
        table, values, angles = column
        at = int(np.argmax(np.abs(values)))
        dead = [i for i, angle in enumerate(angles) if angle % (2 * _DEAD) == 0]
        nearby = min(dead, key=lambda i: abs(angles[i] - angles[at]), default=at)
        if not dead or angles[at] % _DEAD == 0:
            return None
        if abs(values[at]) <= abs(values[nearby]) * (1 + _TELLING):
            return None
        name = self._called(item)
        word = "наибольшее" if values[at] > 0 else "наименьшее"
        text = (
            f"Почему {name} принимает {word} значение при φ = {short(angles[at])}°, а не в мёртвой "
            f"точке φ = {short(angles[nearby])}°?"
        )
        answer = (
            f"{self._is(item, values[at])} при {short(angles[at])}° и "
            f"{self._is(item, values[nearby])} при {short(angles[nearby])}°. {self._formula(item)}"
            f"{self._reason(item, at, nearby)}{self._beside(item, table, at, nearby)}"
        )
        return Question("largest", item.id, text, answer)

    def sign(self, item: Item, chance: random.Random) -> Question | None:
        """Where the sign of a column turns, and what turns it."""
        column = self._column(item)
        if column is None:
            return None
        table, values, angles = column
        clear = _clear(values)
        turns = [i for i in range(1, len(clear)) if clear[i - 1] * clear[i] < 0]
        if not turns:
            return None
        at = chance.choice(turns)
        text = (
            f"Между какими углами около φ = {short(angles[at])}° {self._called(item)} "
            "меняет знак и что в формуле его меняет?"
        )
        turned = [
            self._symbol(node)
            for node, values in self._columns_of(item, table)
            if values[at - 1] * values[at] < 0
        ]
        why = f" Знак меняет: {', '.join(turned)}." if turned else self._reason(item, at, at - 1)
        answer = (
            f"Между {short(angles[at - 1])}° ({self._is(item, values[at - 1])}) и "
            f"{short(angles[at])}° ({self._is(item, values[at])}). {self._formula(item)}{why}"
        )
        return Question("sign", item.id, text, answer)

    def change(self, item: Item, chance: random.Random) -> Question | None:
        """Tell what becomes of a value when an input is larger."""
        before = self._peak(item, self.run)
        inputs = [
            name
            for name in sorted(self.assignment.graph.ancestors(item.nodes[0]))
            if (field := self.model.fields.get(name)) is not None
            and isinstance(field.value, float)
            and field.value > 0
            and field.unit not in ("", "°")  # an angle of the layout is no quantity of so much
            and field.title.casefold() != item.title.casefold()
        ]
        if not before or not inputs or self._is_copy(item):
            return None
        name = chance.choice(inputs)
        field = self.model.fields[name]
        value = self.run.value(name)
        after = self._peak(item, self.run.fork({name: float(value) * _MORE}))
        share = after / before - 1
        if not np.isfinite(share) or abs(share) < _TELLING:
            return None
        words = "наибольшее по модулю значение " if item.is_column else ""
        title = uncapital(field.title)
        text = (
            f"Как изменится {words}{self._called(item)}, если увеличить на 10 % величину "
            f"«{title}» ({short(float(value))} {field.unit}), а остальное оставить?"
        )
        word = "вырастет" if share > 0 else "уменьшится"
        answer = (
            f"По модулю {word} на {short(abs(share) * 100, 3)} %: было "
            f"{self._is(item, before)}, станет {self._is(item, after)}. {self._formula(item)}"
        )
        return Question("change", item.id, text, answer)

    def substitution(self, item: Item, chance: random.Random) -> Question | None:
        """Return a row calculated by hand."""
        column = self._column(item)
        if column is None:
            return None
        _, values, angles = column
        rows = np.flatnonzero(_clear(values)).tolist() or [0]
        at = chance.choice(rows)
        operands = self._operands(item, at, float(values[at]))
        if operands is None:
            return None
        where = f"φ = {short(angles[at])}°"
        text = f"Подставьте числа и получите {self._called(item)} при {where}."
        answer = f"{self._is(item, values[at])}. {self._formula(item)} Числа: {operands}."
        return Question("substitution", item.id, text, answer)

    def _operands(self, item: Item, at: int, value: float) -> str | None:
        """What stands in a formula in a row, in so many digits that they give what is printed."""
        node = item.nodes[0]
        expression = self.assignment.graph.expression(node) or "0"
        known = {name: self._in_row(name, node, at) for name in sorted(names(expression))}
        numbers = {name: number for name, number in known.items() if number is not None}
        if len(numbers) < len(known):
            return None
        printed = written(value + 0.0, item.quantity.digits)
        for digits in _DIGITS:
            rounded = {name: float(f"{number:.{digits}g}") for name, number in numbers.items()}
            with np.errstate(all="ignore"):
                result = float(np.ravel(evaluate_tree(parse(expression), rounded.__getitem__))[0])
            if np.isfinite(result) and written(result + 0.0, item.quantity.digits) == printed:
                return "; ".join(
                    f"{self._symbol(node_of(name, item.block, self.model))} = "
                    f"{short(number, digits)}"
                    for name, number in rounded.items()
                )
        return None

    def _in_row(self, name: str, node: str, at: int) -> float | None:
        """The number of a name of a formula in a row, None where it is a text or a whole column."""
        value = self.run.values_for(node)(name)
        if isinstance(value, str):
            return None
        numbers = np.ravel(np.asarray(value, dtype=float))
        is_row = numbers.size == np.size(self.run.value(node))
        return float(numbers[at if is_row else 0]) if is_row or numbers.size == 1 else None

    def _reason(self, item: Item, at: int, other: int) -> str:
        """Return what in a formula makes most of the difference between two rows."""
        node = item.nodes[0]
        tree = parse(self.assignment.graph.expression(node) or "0")

        def in_rows(part: ast.expr) -> tuple[float, float]:
            with np.errstate(all="ignore"):
                value = evaluate_tree(part, self.run.values_for(node))
            rows = np.broadcast_to(np.asarray(value, dtype=float), (len(item.labels),))
            return float(rows[at]), float(rows[other])

        part = _decisive(tree, in_rows)
        if part is tree:
            return ""
        first, second = (short(number, 4) for number in in_rows(part))
        text = plain(
            ast.unparse(part), lambda name: self._symbol(node_of(name, item.block, self.model))
        )
        return f" Решает {text}: {first} против {second}."

    def _called(self, item: Item) -> str:
        """An item with its title, and its sheet where other sheets have one of the same symbol."""
        twins = {other.block for other in self.assignment.items if other.symbol == item.symbol}
        table = self.model.tables.get(item.block)
        where = f", лист «{table.sheet}»" if table is not None and len(twins) > 1 else ""
        return f"{item.indexed} ({item.title}{where})"

    # --- what the tables say ----------------------------------------------------------------

    def _column(self, item: Item) -> tuple[TableSpec, Array, list[float]] | None:
        table = self.model.tables.get(item.block)
        if table is None or not item.is_column or item.quantity.unit in ("", "deg"):
            return None
        if self._is_copy(item):
            return None
        values = np.asarray(self.run.value(item.nodes[0]), dtype=float)
        moving = np.isfinite(values).all() and np.unique(np.round(values, 9)).size > len(values) / 4
        return (table, values, [float(label) for label in item.labels]) if moving else None

    def _is_copy(self, item: Item) -> bool:
        """Whether the formula only repeats another value."""
        expression = self.assignment.graph.expression(item.nodes[0]) or "0"
        return not isinstance(parse(expression), (ast.BinOp, ast.Call))

    def _peak(self, item: Item, run: Evaluation) -> float:
        values = np.ravel(np.asarray(run.value(item.nodes[0]), dtype=float))
        finite = np.abs(values[np.isfinite(values)])
        return float(finite.max()) if finite.size else 0.0

    def _columns_of(self, item: Item, table: TableSpec) -> list[tuple[str, Array]]:
        """Columns of the same rows that the formula of an item reads."""
        columns = []
        for name in sorted(names(self.assignment.graph.expression(item.nodes[0]) or "0")):
            node = node_of(name, table.id, self.model)
            value = self.run.value(node) if "." in node and node in self.model.nodes else ""
            if not isinstance(value, str) and np.size(value) == len(table.rows):
                columns.append((node, np.asarray(value, dtype=float)))
        return columns

    def _beside(self, item: Item, table: TableSpec, at: int, other: int) -> str:
        """Tell what the formula reads in two rows."""
        parts = []
        for node, values in self._columns_of(item, table):
            digits = self.model.nodes[node].quantity.digits
            printed = written(float(values[at]), digits)
            if other != at:
                printed += f" и {written(float(values[other]), digits)}"
            parts.append(f"{self._symbol(node)} = {printed}")
        return f" В этих строках: {'; '.join(parts)}." if parts else ""

    def _formula(self, item: Item) -> str:
        expression = self.assignment.graph.expression(item.nodes[0]) or "0"
        text = plain(expression, lambda name: self._symbol(node_of(name, item.block, self.model)))
        telling = text != item.indexed and len(text) < 160
        return f"Формула: {item.indexed} = {text}." if telling else ""

    def _symbol(self, node: str) -> str:
        key = self.model.grid_runs.get(node, (node,))[0]
        if key in self.model.nodes:
            quantity = self.model.nodes[key].quantity
            return indexed(quantity.tex, quantity.symbol)
        field = self.model.fields.get(node)
        return field.title if field is not None else node

    def _is(self, item: Item, value: float) -> str:
        unit = item.quantity.unit_label
        space = "" if unit == "°" else " "
        return f"{written(float(value) + 0.0, item.quantity.digits)}{space}{unit}".strip()


def _decisive(tree: ast.expr, in_rows: Callable[[ast.expr], tuple[float, float]]) -> ast.expr:
    """Return the term or factor of a formula whose values in two rows differ most."""
    while True:
        parts: list[ast.expr] = []
        if isinstance(tree, ast.UnaryOp):
            parts = [tree.operand]
        elif isinstance(tree, ast.Call) and ast.unparse(tree.func) not in _WAVES:
            parts = list(tree.args)
        elif isinstance(tree, ast.BinOp):
            parts = [tree.left, tree.right]
        is_sum = isinstance(tree, ast.BinOp) and isinstance(tree.op, ast.Add | ast.Sub)
        changes = [_change(*in_rows(part), is_sum=is_sum) for part in parts]
        if not parts or max(changes) <= _TELLING:
            return tree
        tree = parts[changes.index(max(changes))]


def _change(first: float, second: float, *, is_sum: bool) -> float:
    """How much two values differ: what a term adds, by what share a factor changes."""
    size = max(abs(first), abs(second))
    return abs(first - second) if is_sum or not size else abs(first - second) / size


def _clear(values: Array) -> Array:
    """Values with noughts for what print may show as nought."""
    return np.where(np.abs(values) > _TELLING * np.abs(values).max(), values, 0.0)
