"""Evaluates the runs of a grid on demand; a run whose cells need each other goes cell by cell."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

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
from reports.recalculation.by_columns.grid import MAX_COLUMN, MAX_ROW, Grid, Run
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
    parse,
)

MAX_BLOCK = 2_000_000  # numbers in an intermediate array


class _Again(Exception):  # noqa: N818 - a signal, no error
    """A run needs its own cells."""

    def __init__(self, run: Run) -> None:
        self.run = run
        super().__init__()


@dataclass(frozen=True, slots=True)
class Area:
    """A rectangle of cells that a formula refers to."""

    sheet: str
    first_row: int
    last_row: int
    first_column: int
    last_column: int


@dataclass(slots=True)
class _At:
    """The cells under evaluation: rows of one column from ``row``."""

    sheet: str
    row: int
    column: int
    count: int


class Engine:
    """Values of a grid's cells.

    A formula outside the whitelist raises ``UnknownFormula`` from every method
    that needs its value.
    """

    def __init__(self, grid: Grid) -> None:
        self.grid = grid

    def evaluate_all(self) -> None:
        """Evaluate every run."""
        with np.errstate(all="ignore"):
            for columns in self.grid.sheets.values():
                for column in columns.values():
                    for run in column.runs:
                        self.run(run)

    def values(self, sheet: str, column: int, first: int, last: int) -> tuple[Array, list[str]]:
        """Numbers of a column's cells and a letter for the kind of each.

        The letters: ``n`` number, ``b`` blank, ``t`` text, ``e`` error; the number of
        a blank, a text and an error is NaN.
        """
        known = self.grid.column(sheet, column)
        if len(known.runs) == 1 and not known.errors:
            only = known.runs[0]
            if only.first <= first and last <= only.last:
                with np.errstate(all="ignore"):
                    part = self._part(only, first, last)
                if not only.texts:
                    good = np.isfinite(part)
                    count = last - first + 1
                    return part, ["n"] * count if good.all() else ["n" if g else "e" for g in good]
        numbers = np.full(last - first + 1, np.nan)
        kinds = ["b"] * len(numbers)
        for row, constant in known.constants.items():
            if first <= row <= last:
                is_text = isinstance(constant, str)
                numbers[row - first] = np.nan if is_text else float(constant)
                kinds[row - first] = "t" if is_text else "n"
        for row in known.errors:
            if first <= row <= last:
                kinds[row - first] = "e"
        with np.errstate(all="ignore"):
            for run in known.runs:
                low, high = max(first, run.first), min(last, run.last)
                if low <= high:
                    numbers[low - first : high - first + 1] = self._part(run, low, high)
                    for row in range(low, high + 1):
                        good = np.isfinite(numbers[row - first])
                        kinds[row - first] = "t" if row in run.texts else "n" if good else "e"
        return numbers, kinds

    def once(self, run: Run) -> Array:
        """Values that a run's formula would have on this grid, which need not hold the run."""
        if run.pattern is None:
            raise UnknownFormula(run.problem)
        tree = parse(run.pattern)
        values = np.empty(run.count)
        with np.errstate(all="ignore"):
            if _fits(tree):
                at = _At(run.sheet, run.first, run.column, run.count)
                found = np.asarray(numeric(_Evaluation(self, at).value(tree)), dtype=float)
                values[:] = found.reshape(-1)
            else:
                for i in range(run.count):
                    at = _At(run.sheet, run.first + i, run.column, 1)
                    found = np.asarray(numeric(_Evaluation(self, at).value(tree)), dtype=float)
                    values[i] = found.reshape(-1)[0]
        return np.where(np.isfinite(values), values, np.nan)

    def areas(self, run: Run) -> Iterator[Area]:
        """All rectangles that a run refers to, over all its rows."""
        if run.pattern is None:
            return
        stack: list[Node] = [parse(run.pattern)]
        while stack:
            node = stack.pop()
            match node:
                case Ref():
                    yield self._area(node, node, run)
                case Range(first, last):
                    yield self._area(first, last, run)
                case Name(name):
                    cell = self.grid.names.get(name.casefold())
                    if cell is not None:
                        yield Area(cell[0], cell[1], cell[1], cell[2], cell[2])
                case Unary(_, operand):
                    stack.append(operand)
                case Binary(_, left, right):
                    stack += [left, right]
                case Call(_, args):
                    stack += args
                case _:
                    pass

    def _area(self, first: Ref, last: Ref, run: Run) -> Area:
        rows = []
        columns = []
        for ref in (first, last):
            if ref.row_fixed:
                rows.append(ref.row)
            else:
                rows += [run.first + ref.row, run.last + ref.row]
            columns.append(ref.column if ref.column_fixed else run.column + ref.column)
        title = self._sheet(first.sheet, run.sheet)
        return Area(title, min(rows), max(rows), min(columns), max(columns))

    def _sheet(self, named: str | None, own: str) -> str:
        if named is None:
            return own
        title = self.grid.title(named)
        if title is None:
            msg = f"no sheet {named}"
            raise UnknownFormula(msg)
        return title

    # --- runs -------------------------------------------------------------------------

    def run(self, run: Run) -> None:
        """Evaluate one run."""
        if run.state == "done":
            return
        if run.state in ("running", "cells"):
            if run.state == "running":
                raise _Again(run)
            self._cells(run, run.first, run.last)
            return
        if run.pattern is None or run.state == "unknown":
            raise UnknownFormula(run.problem)
        run.state = "running"
        try:
            result = self._evaluate(run, run.first, run.count)
            self._keep(run, run.first, result, run.count)
            run.state = "done"
        except _Again as again:
            run.state = "new"
            if again.run is not run:
                raise
            self._start_cells(run)
            self._cells(run, run.first, run.last)
            run.state = "done"
        except UnknownFormula:
            run.state = "new"
            raise

    def _start_cells(self, run: Run) -> None:
        run.state = "cells"
        run.values = np.full(run.count, np.nan)
        run.done = np.zeros(run.count, dtype=bool)

    def _evaluate(self, run: Run, row: int, count: int) -> Value:
        assert run.pattern is not None
        tree = parse(run.pattern)
        if count > 1 and not _fits(tree):
            self._start_cells(run)
            self._cells(run, run.first, run.last)
            return run.values
        return _Evaluation(self, _At(run.sheet, row, run.column, count)).value(tree)

    def _keep(self, run: Run, row: int, result: Value, count: int) -> None:
        if run.values is None:
            run.values = np.full(run.count, np.nan)
        flat = np.asarray(result).reshape(-1)
        if flat.size != count:
            flat = np.full(count, flat[0])
        start = row - run.first
        if flat.dtype.kind in "OUS":
            for i, item in enumerate(flat):
                if isinstance(item, str):
                    run.texts[row + i] = str(item)
                else:
                    run.values[start + i] = float(item)
            return
        run.values[start : start + count] = finite(flat)

    def _cells(self, run: Run, first: int, last: int) -> None:
        """One cell after the other; a cell that needs itself is an error."""
        assert run.done is not None
        for row in range(first, last + 1):
            at = row - run.first
            if run.done[at]:
                continue
            run.done[at] = True  # NaN while it runs: a circle is an error
            try:
                result = self._evaluate(run, row, 1)
            except RecursionError:
                msg = "formulas chained too deeply"
                raise UnknownFormula(msg) from None
            self._keep(run, row, result, 1)

    def _part(self, run: Run, first: int, last: int) -> Array:
        if run.state == "cells":
            self._cells(run, first, last)
        elif run.state != "done":
            self.run(run)
        assert run.values is not None
        return run.values[first - run.first : last - run.first + 1]

    # --- reading ----------------------------------------------------------------------

    def block(
        self, sheet: str, first_row: int, last_row: int, column: int
    ) -> tuple[Array, NDArray[np.bool_] | None, dict[int, str]]:
        """Numbers of a column's cells (blank 0), where they are numbers, and its texts."""
        known = self.grid.column(sheet, column)
        for run in known.runs:
            if run.first <= first_row and last_row <= run.last:
                part = self._part(run, first_row, last_row)
                texts = {r: t for r, t in run.texts.items() if first_row <= r <= last_row}
                return part, None, texts
        numbers = np.zeros(last_row - first_row + 1)
        there = np.zeros(len(numbers), dtype=bool)
        texts = {}
        rows = known.constants
        inside = (
            [r for r in rows if first_row <= r <= last_row]
            if len(rows) < len(numbers)
            else [r for r in range(first_row, last_row + 1) if r in rows]
        )
        for row in inside:
            constant = rows[row]
            if isinstance(constant, str):
                texts[row] = constant
            else:
                numbers[row - first_row] = float(constant)
                there[row - first_row] = not isinstance(constant, bool)
        for row in known.errors:
            if first_row <= row <= last_row:
                numbers[row - first_row], there[row - first_row] = np.nan, True
        for run in known.runs:
            low, high = max(first_row, run.first), min(last_row, run.last)
            if low <= high:
                numbers[low - first_row : high - first_row + 1] = self._part(run, low, high)
                there[low - first_row : high - first_row + 1] = True
                for row, text in run.texts.items():
                    if low <= row <= high:
                        texts[row] = text
                        there[row - first_row] = False
        return numbers, there, texts


def _fits(node: Node) -> bool:
    """Whether all rows of a run can be taken at once: no range that grows or slides."""
    match node:
        case Range(first, last):
            return first.row_fixed == last.row_fixed and (first.row_fixed or first.row == last.row)
        case Unary(_, operand):
            return _fits(operand)
        case Binary(_, left, right):
            return _fits(left) and _fits(right)
        case Call(_, args):
            return all(_fits(arg) for arg in args)
    return True


class _Evaluation:
    """One formula over the rows of a run."""

    def __init__(self, engine: Engine, at: _At) -> None:
        self.engine, self.at = engine, at

    def value(self, node: Node, *, block: bool = False) -> Value:
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
        sheet = self.engine._sheet(ref.sheet, at.sheet)
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
        return numbers.reshape(-1, 1, 1)

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
        sheet = self.engine._sheet(node.first.sheet, at.sheet)
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
