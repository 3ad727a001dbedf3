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
        near = min(dead, key=lambda i: abs(angles[i] - angles[at]), default=at)
        if not dead or angles[at] % _DEAD == 0:
            return None
        if abs(values[at]) <= abs(values[near]) * (1 + _TELLING):
            return None
        name = f"{item.indexed} ({item.title})"
        word = "наибольшее" if values[at] > 0 else "наименьшее"
        text = (
            f"Почему {name} принимает {word} значение при φ = {short(angles[at])}°, а не в мёртвой "
            f"точке φ = {short(angles[near])}°?"
        )
        answer = (
            f"{self._is(item, values[at])} при {short(angles[at])}° и "
            f"{self._is(item, values[near])} при {short(angles[near])}°. {self._formula(item)}"
            f"{self._beside(item, table, at, near)}"
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
            f"Между какими углами около φ = {short(angles[at])}° {item.indexed} ({item.title}) "
            "меняет знак и что в формуле его меняет?"
        )
        turned = [
            self._symbol(node)
            for node, own in self._columns_of(item, table)
            if own[at - 1] * own[at] < 0
        ]
        why = f" Знак меняет: {', '.join(turned)}." if turned else ""
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
            and field.unit
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
        what = "наибольшее по модулю значение " if item.is_column else ""
        title = uncapital(field.title)
        text = (
            f"Как изменится {what}{item.indexed} ({item.title}), если увеличить на 10 % величину "
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
        table, values, angles = column
        at = chance.choice(np.flatnonzero(_clear(values)).tolist() or [0])
        where = f"φ = {short(angles[at])}°"
        text = f"Подставьте числа и получите {item.indexed} ({item.title}) при {where}."
        answer = f"{self._is(item, values[at])}. {self._formula(item)}"
        return Question("substitution", item.id, text, answer + self._beside(item, table, at, at))

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
            shown = written(float(values[at]), digits)
            if other != at:
                shown += f" и {written(float(values[other]), digits)}"
            parts.append(f"{self._symbol(node)} = {shown}")
        return f" В этих строках: {'; '.join(parts)}." if parts else ""

    def _formula(self, item: Item) -> str:
        expression = self.assignment.graph.expression(item.nodes[0]) or "0"
        text = plain(expression, lambda name: self._symbol(node_of(name, item.block, self.model)))
        telling = text != item.indexed and len(text) < 160
        return f"Формула: {item.indexed} = {text}." if telling else ""

    def _symbol(self, node: str) -> str:
        key = self.model.grid_runs.get(node, (node,))[0]
        if key in self.model.nodes:
            about = self.model.nodes[key].quantity
            return indexed(about.tex, about.symbol)
        field = self.model.fields.get(node)
        return field.title if field is not None else node

    def _is(self, item: Item, value: float) -> str:
        unit = item.quantity.unit_label
        space = "" if unit == "°" else " "
        return f"{written(float(value) + 0.0, item.quantity.digits)}{space}{unit}".strip()


def _clear(values: Array) -> Array:
    """Values with noughts for what print may show as nought."""
    return np.where(np.abs(values) > _TELLING * np.abs(values).max(), values, 0.0)
