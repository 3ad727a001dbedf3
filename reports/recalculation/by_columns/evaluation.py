"""One formula over the rows of a run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from reports.recalculation.by_columns.functions import (
    AGGREGATES,
    BINARY,
    SINGLE,
    Array,
    Value,
    aggregate,
    finite,
    index,
    match,
    numeric,
)
from reports.recalculation.by_columns.grid import MAX_COLUMN, MAX_ROW
from reports.recalculation.by_columns.syntax import (
    Binary,
    Call,
    Name,
    Node,
    Number,
    Range,
    Ref,
    Text,
    Unary,
    UnknownFormula,
)

if TYPE_CHECKING:
    from reports.recalculation.by_columns.engine import Engine

MAX_BLOCK = 2_000_000  # numbers in an intermediate array


@dataclass(slots=True)
class At:
    """The cells under evaluation: rows of one column from ``row``."""

    sheet: str
    row: int
    column: int
    count: int


class Evaluation:
    """One formula over the rows of a run."""

    def __init__(self, engine: Engine, at: At) -> None:
        self.engine, self.at = engine, at

    def result(self, tree: Node) -> Value:
        """Value of the whole formula.

        Raises:
            UnknownFormula: something outside the whitelist.
        """
        try:
            return self.value(tree)
        except UnknownFormula:
            raise
        except ValueError:  # of numpy
            msg = "ranges of different sizes"
            raise UnknownFormula(msg) from None

    def value(self, node: Node, *, block: bool = False) -> Value:
        """Value of a part of the formula; ``block`` where a rectangle may stand for one value.

        Raises:
            UnknownFormula: something outside the whitelist.
        """
        if isinstance(node, Binary):
            return self._binary(node.op, node.left, node.right, block)
        if isinstance(node, Ref):
            return self._cell(node)
        if isinstance(node, (Number, Text)):
            return node.value
        if isinstance(node, Call):
            return self._call(node.name, node.args, block)
        if isinstance(node, Name):
            return self._name(node.name)
        if isinstance(node, Unary):
            value = numeric(self.value(node.operand, block=block))
            return value if node.op == "+" else value / 100 if node.op == "%" else -1.0 * value
        if not block:
            msg = "a range where one value is wanted"
            raise UnknownFormula(msg)
        return self._range(node)[0]

    def _binary(self, op: str, left: Node, right: Node, block: bool) -> Value:
        first, second = self.value(left, block=block), self.value(right, block=block)
        if op in ("=", "<>") and (_is_text(first) or _is_text(second)):
            return self._same_text(first, second) == (op == "=")
        if op not in BINARY:
            msg = f"operator {op}"
            raise UnknownFormula(msg)
        result = BINARY[op](numeric(first), numeric(second))
        self._check_size(result)
        if op in "<=>=<>":
            errors = np.isnan(first) | np.isnan(second)
            return np.where(errors, np.nan, result) if np.any(errors) else result
        return finite(result) if op in "/^" else result

    @staticmethod
    def _same_text(first: Value, second: Value) -> Value:
        if not (_is_text(first) and _is_text(second)):
            msg = "text against a number"
            raise UnknownFormula(msg)
        if isinstance(first, str) and isinstance(second, str):
            return first.casefold() == second.casefold()
        return np.char.lower(np.asarray(first, dtype=str)) == np.char.lower(
            np.asarray(second, dtype=str)
        )

    def _call(self, name: str, args: tuple[Node, ...], block: bool) -> Value:
        if name in SINGLE:
            function, least, most = SINGLE[name]
            if not least <= len(args) <= most:
                msg = f"{name} with {len(args)} arguments"
                raise UnknownFormula(msg)
            return finite(function(*(numeric(self.value(arg, block=block)) for arg in args)))
        if name in AGGREGATES:
            return aggregate(name, [self._counted(arg) for arg in args])
        special = getattr(self, f"_{name.lower()}", None)
        if special is None or name not in ("IF", "AND", "OR", "NOT", "IFERROR", "SUMPRODUCT",
                                           "INDEX", "MATCH"):  # fmt: skip
            msg = f"function {name}"
            raise UnknownFormula(msg)
        return special(args)

    def _counted(self, node: Node) -> tuple[Array, NDArray[np.bool_]]:
        """Numbers for an aggregate, and which of them count."""
        if isinstance(node, Range):
            return self._range(node)
        if isinstance(node, Ref):
            return self._range(Range(node, node))
        value = np.asarray(numeric(self.value(node, block=False)), dtype=float)
        value = value.reshape((-1, 1, 1)) if value.ndim < 3 else value
        return value, np.ones(value.shape, dtype=bool)

    def _if(self, args: tuple[Node, ...]) -> Value:
        if not 2 <= len(args) <= 3:
            msg = "IF"
            raise UnknownFormula(msg)
        test = numeric(self.value(args[0]))
        if np.ndim(test) == 0 or np.size(test) == 1:
            number = float(np.asarray(test).reshape(-1)[0])
            if np.isnan(number):
                return np.nan
            if number:
                return self.value(args[1])
            return self.value(args[2]) if len(args) == 3 else False
        good = self.value(args[1])
        bad = self.value(args[2]) if len(args) == 3 else False
        chosen = np.asarray(test, dtype=float)
        if _is_text(good) or _is_text(bad):
            result = np.where(chosen != 0, np.asarray(good, object), np.asarray(bad, object))
            return np.where(np.isnan(chosen), np.asarray(np.nan, object), result)
        return np.where(np.isnan(chosen), np.nan, np.where(chosen != 0, good, bad))

    def _logic(self, args: tuple[Node, ...], both: bool) -> Value:
        result: Value = both
        for arg in args:
            value = np.asarray(numeric(self.value(arg)), dtype=float)
            now = np.logical_and(result, value) if both else np.logical_or(result, value)
            known = np.asarray(result, dtype=float)
            result = np.where(np.isnan(value) | np.isnan(known), np.nan, now)
        return result

    def _and(self, args: tuple[Node, ...]) -> Value:
        return self._logic(args, True)

    def _or(self, args: tuple[Node, ...]) -> Value:
        return self._logic(args, False)

    def _not(self, args: tuple[Node, ...]) -> Value:
        value = np.asarray(numeric(self.value(args[0])), dtype=float)
        return np.where(np.isnan(value), np.nan, value == 0)

    def _iferror(self, args: tuple[Node, ...]) -> Value:
        value = numeric(self.value(args[0]))
        return np.where(np.isnan(value), numeric(self.value(args[1])), value)

    def _sumproduct(self, args: tuple[Node, ...]) -> Value:
        product: Value = 1.0
        for arg in args:
            product = product * np.asarray(numeric(self.value(arg, block=True)), dtype=float)
            self._check_size(product)
        if np.ndim(product) == 0:
            return product
        return np.asarray(product).sum(axis=(1, 2)).reshape(-1, 1, 1)

    def _match(self, args: tuple[Node, ...]) -> Value:
        if len(args) not in (2, 3) or not isinstance(args[1], Range):
            msg = "MATCH"
            raise UnknownFormula(msg)
        kind = float(np.asarray(self.value(args[2])).reshape(-1)[0]) if len(args) == 3 else 1.0
        block, there = self._range(args[1])
        if block.shape[0] != 1 or not there.all():
            msg = "MATCH in a sliding range or among blanks"
            raise UnknownFormula(msg)
        return match(numeric(self.value(args[0])), block, kind)

    def _index(self, args: tuple[Node, ...]) -> Value:
        if len(args) not in (2, 3) or not isinstance(args[0], Range):
            msg = "INDEX"
            raise UnknownFormula(msg)
        block, _ = self._range(args[0])
        if block.shape[0] != 1:
            msg = "INDEX in a sliding range"
            raise UnknownFormula(msg)
        column = numeric(self.value(args[2])) if len(args) == 3 else None
        return index(block, numeric(self.value(args[1])), column)

    # --- references -------------------------------------------------------------------

    def _name(self, name: str) -> Value:
        if name.upper() in ("TRUE", "FALSE"):
            return name.upper() == "TRUE"
        cell = self.engine.grid.names.get(name.casefold())
        if cell is None:
            msg = f"name {name}"
            raise UnknownFormula(msg)
        return self._rows(cell[0], cell[1], cell[1], cell[2])

    def _cell(self, ref: Ref) -> Value:
        at = self.at
        column = ref.column if ref.column_fixed else at.column + ref.column
        sheet = self.engine.sheet(ref.sheet, at.sheet)
        if ref.row_fixed:
            return self._rows(sheet, ref.row, ref.row, column)
        first = at.row + ref.row
        return self._rows(sheet, first, first + at.count - 1, column)

    def _rows(self, sheet: str, first: int, last: int, column: int) -> Value:
        _check_bounds(first, last, column, column)
        numbers, _, texts = self.engine.block(sheet, first, last, column)
        if texts:
            if len(texts) < len(numbers):
                msg = "text among numbers"
                raise UnknownFormula(msg)
            if len(numbers) == 1:
                return texts[first]
            return np.array([texts[first + i] for i in range(len(numbers))], dtype=object).reshape(
                -1, 1, 1
            )
        return numbers.reshape(-1, 1, 1) if first < last else float(numbers[0])

    def _range(self, node: Range) -> tuple[Array, NDArray[np.bool_]]:
        at = self.at
        ends = []
        for ref in (node.first, node.last):
            ends.append(
                (
                    ref.row if ref.row_fixed else at.row + ref.row,
                    ref.column if ref.column_fixed else at.column + ref.column,
                )
            )
        sheet = self.engine.sheet(node.first.sheet, at.sheet)
        (row_a, column_a), (row_b, column_b) = ends
        rows, columns = sorted((row_a, row_b)), sorted((column_a, column_b))
        moving = not node.first.row_fixed and at.count > 1
        last_row = rows[1] + at.count - 1 if moving else rows[1]
        _check_bounds(rows[0], last_row, columns[0], columns[1])
        if (last_row - rows[0] + 1) * (columns[1] - columns[0] + 1) > MAX_BLOCK:
            msg = "range too large"
            raise UnknownFormula(msg)
        numbers: list[Array] = []
        there: list[NDArray[np.bool_]] = []
        for column in range(columns[0], columns[1] + 1):
            values, present, _ = self.engine.block(sheet, rows[0], last_row, column)
            numbers.append(values)
            there.append(np.ones(len(values), dtype=bool) if present is None else present)
        if len(numbers) == 1:
            count, height = (at.count, 1) if moving else (1, len(numbers[0]))
            return numbers[0].reshape(count, height, 1), there[0].reshape(count, height, 1)
        # (rows, columns): of one row each for a run, one block for all otherwise.
        shape = (at.count, 1, -1) if moving else (1, rows[1] - rows[0] + 1, -1)
        return np.stack(numbers, axis=-1).reshape(shape), np.stack(there, axis=-1).reshape(shape)

    @staticmethod
    def _check_size(value: Value) -> None:
        if np.size(value) > MAX_BLOCK:
            msg = "intermediate result too large"
            raise UnknownFormula(msg)


def _is_text(value: Value) -> bool:
    return isinstance(value, str) or (isinstance(value, np.ndarray) and value.dtype.kind == "O")


def _check_bounds(first: int, last: int, left: int, right: int) -> None:
    if first < 1 or last > MAX_ROW or left < 1 or right > MAX_COLUMN:
        msg = "reference out of bounds"
        raise UnknownFormula(msg)
