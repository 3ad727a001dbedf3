"""Likely cause of a wrong column: usual mistakes tried one after the other."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reports.formula.numeric import evaluate_tree
from reports.formula.parse import FormulaError, names, parse
from reports.grading.issuing.assignment import Item
from reports.grading.judging.judgement import Array, Judgement, close, distance, tolerance
from reports.grading.judging.mistakes import mistakes, symbol_of
from reports.grading.judging.response import FormulaResponse
from reports.grading.reading.student import StudentBook, known_values
from reports.inputs.sections.input_file import METHODS
from reports.model.blocks import TableSpec
from reports.model.evaluation import Evaluation
from reports.shared.russian import fixed, short, uncapital

_FACTORS = (10.0, 60.0, 100.0, 1000.0, 1e4, 1e5, 1e6, 1e9)
_OTHERS = 200  # variants that are tried
_ENOUGH, _SAME = 3, 1e-7  # of fewer wrong rows the values must be the very same
_CLEAR = 50  # tolerances that a number has at least which tells its cause alone
_EXACT = "exact"  # in the key of a column by the exact formula
_VARIED = 4  # different values of a column that tells anything


@dataclass(frozen=True, slots=True)
class OtherVariant:
    """Drawn values of another student's variant by the name of their input cell."""

    number: int
    values: dict[str, float]


class Causes:
    """Tries the usual mistakes on one student's wrong columns."""

    def __init__(
        self,
        student: StudentBook,
        others: Sequence[OtherVariant],
        titles: dict[str, str],
        whole: dict[int, Evaluation] | None = None,
        response: FormulaResponse | None = None,
    ) -> None:
        self.student, self.others, self.titles = student, others, titles
        self.whole = {} if whole is None else whole  # other variants, the same for a class
        self.response = response

    def find(self, judgement: Judgement) -> str:
        """The cause in words, empty where none fits."""
        item, values = judgement.item, judgement.values
        finite = values[np.isfinite(values)]
        if not finite.size:
            return ""
        shifted = self._moved_reference(item)
        if shifted:
            return shifted
        if _is_place(item):
            return ""  # 2 for 4 may come of anything
        cause = self._common(judgement)
        allowed = tolerance(item, judgement.expected, self.student)
        good = close(item, judgement.values, judgement.expected, allowed, self.student.expected)
        rows = [] if cause or judgement.coarse else slips(judgement, good)
        return rows_text(judgement, rows, self._explained(judgement, rows)) if rows else cause

    def gives(self, judgement: Judgement, text: str) -> bool:
        """Whether a formula in the language of the tables gives the wrong values of an item."""
        item, values = judgement.item, judgement.values
        known = self._known(judgement)
        for base in [known, {}] if known else [{}]:
            run = self.student.expected.fork(base)
            try:
                attempt = self._rewritten(item, run, lambda _: parse(text))
            except (KeyError, ValueError, TypeError, FormulaError):  # no formula of this table
                return False
            if attempt is not None and self._fits(item, values, attempt, judgement.expected, ()):
                return True
        return False

    def _common(self, judgement: Judgement) -> str:
        """A cause that all values have in common."""
        finite = judgement.values[np.isfinite(judgement.values)]
        if not finite.any():  # anything small enough is nought
            return "все значения равны нулю" if len(judgement.values) > 1 else "получен нуль"
        if judgement.coarse:
            return "округлено грубее, чем печатает книга"
        few = judgement.item.is_column and np.unique(finite).size < _VARIED
        return "" if few else self._explained(judgement)

    def _explained(self, judgement: Judgement, rows: Sequence[int] = ()) -> str:
        """The first usual mistake that gives the values, or those of some rows."""
        item, values = judgement.item, judgement.values
        known = self._known(judgement)
        for base in [known, {}] if known else [{}]:
            cause = self._first(item, values, self.student.expected.fork(base), rows)
            if cause:
                return cause
        # Mistakes before this one, in what the program calculates from them too: its formula is
        # looked at without them.
        alone = self.response.tryout.alone(item) if self.response is not None else None
        if alone is None or np.allclose(alone, values, equal_nan=True):
            return ""
        return self._first(item, alone, self.student.expected, rows)

    def _first(self, item: Item, values: Array, run: Evaluation, rows: Sequence[int]) -> str:
        right = self._values(item, run)
        if right is None:
            return ""
        beyond = np.full(len(values), np.nan) if rows else values  # no row explains itself
        fitting = (
            words
            for words, attempt in self._attempts(item, run, right, beyond)
            if attempt is not None and self._fits(item, values, attempt, right, rows)
        )
        cause = next(fitting, "")
        # What a condition picks, many wrong ones pick.
        picks = any(isinstance(self._tree(node), ast.IfExp) for node in item.nodes)
        return "" if picks and any(words != cause for words in fitting) else cause

    def _known(self, judgement: Judgement) -> dict[str, object]:
        """The student's own earlier values, where they are not the right ones."""
        nodes = frozenset().union(*(self.student.precedents(n) for n in judgement.item.nodes))
        known = known_values(self.student.answers, nodes - set(judgement.item.nodes))
        return known if any(self._is_off(node, value) for node, value in known.items()) else {}

    def _is_off(self, node: str, value: object) -> bool:
        right = self.student.expected.value(node)
        if isinstance(right, str):
            return False
        own, wanted = (np.ravel(np.asarray(one, dtype=float)) for one in (value, right))
        away = distance([node], own, wanted, self.student.expected)
        near = away <= 1e-8 + 1e-9 * np.abs(wanted)
        return not (near | (np.isnan(own) & np.isnan(wanted))).all()

    def _fits(
        self, item: Item, values: Array, attempt: Array, right: Array, rows: Sequence[int]
    ) -> bool:
        """Whether an attempt explains the values, and differs from what is right."""
        if attempt.shape != values.shape or not np.isfinite(attempt).any():
            return False
        allowed = tolerance(item, attempt, self.student)
        at = np.asarray(rows) if rows else np.arange(len(values))
        if rows:
            if (np.abs(values[at]) < _CLEAR * allowed).any():
                return False  # so few digits may come of anything
            if len(rows) < _ENOUGH:  # and among so many columns there is always one that is near
                allowed = min(allowed, _SAME * float(np.abs(values[at]).max()))
        there = np.isfinite(values[at])
        if there.sum() < max(1, len(at) // 2):
            return False
        # Any angle is a hundred times another, but for whole turns.
        explained = np.abs(values - attempt)[at][there] <= allowed
        known = close(item, attempt, right, allowed, self.student.expected)[at]
        return bool(explained.all()) and not known.all()

    def _attempts(
        self, item: Item, run: Evaluation, right: Array, values: Array
    ) -> Iterator[tuple[str, Array | None]]:
        yield "обратный знак", -right
        for factor in _FACTORS:
            times = fixed(factor, 0)
            yield f"значения больше правильных в {times} раз: проверьте единицы", right * factor
            yield f"значения меньше правильных в {times} раз: проверьте единицы", right / factor
        if not item.is_column:
            yield from self._inputs(item, run)
        yield "результат в градусах вместо радиан", np.degrees(right)
        yield "результат в радианах вместо градусов", np.radians(right)
        yield from self._changed_formulas(item, run)
        if len(right) > 3 and item.is_column:
            yield "значения сдвинуты на одну строку вниз", moved(right, values, 1)
            yield "значения сдвинуты на одну строку вверх", moved(right, values, -1)
        yield from self._columns(item, run)
        yield from self._methods(item)
        yield from self._variants(item)
        for factor, times in ((2, "вдвое"), (4, "вчетверо")):
            yield f"результат {times} больше правильного", right * factor
            yield f"результат {times} меньше правильного", right / factor
        with np.errstate(divide="ignore"):
            yield "получена обратная величина", 1 / right

    def _values(self, item: Item, run: Evaluation) -> Array | None:
        parts = [np.ravel(np.asarray(run.value(node), dtype=float)) for node in item.nodes]
        return np.concatenate(parts)

    # --- the formula itself -------------------------------------------------------------

    def _changed_formulas(self, item: Item, run: Evaluation) -> Iterator[tuple[str, Array | None]]:
        for words, change in mistakes(
            self._tree(item.nodes[0]), item.block, self.student.assignment.model
        ):
            yield words, self._rewritten(item, run, change)

    def _inputs(self, item: Item, run: Evaluation) -> Iterator[tuple[str, Array | None]]:
        """An input of the formula taken for its result."""
        fields = self.student.assignment.model.fields
        for name in sorted(self._names(item.nodes[0])):
            if name in fields and isinstance(fields[name].value, (int, float)):
                title = fields[name].title
                title = "частота вращения n" if name == "regime_speed_rpm" else uncapital(title)
                yield f"{title} вместо {item.symbol}", np.array([float(run.value(name))])

    def _moved_reference(self, item: Item) -> str:
        """A reference to one cell that was filled down without its $."""
        grid, placement = self.student.grid, self.student.placement
        single = {
            (location.sheet, location.column, location.rows[0]): name
            for name, location in placement.places.items()
            if len(location.rows) == 1
        }
        for node in item.nodes if item.is_column else ():
            for run in self.student.runs(node):
                for reference, area in grid.located(run) if run.count > 1 else ():
                    one = reference.first == reference.last and not reference.name
                    name = single.get((area.sheet, area.first_column, area.first_row))
                    if one and name and not reference.first.row_fixed:
                        symbol = symbol_of(name, item.block, self.student.assignment.model)
                        return f"в ссылке на {symbol} нет знака $: при протягивании она сдвигается"
        return ""

    def _tree(self, node: str) -> ast.expr:
        return parse(self.student.assignment.graph.expression(node) or "0")

    def _names(self, node: str) -> frozenset[str]:
        return names(self.student.assignment.graph.expression(node) or "0")

    def _rewritten(
        self, item: Item, run: Evaluation, change: Callable[[ast.expr], Any]
    ) -> Array | None:
        parts = []
        changed = False
        for node in item.nodes:
            tree = self._tree(node)
            other = change(ast.parse(ast.unparse(tree), mode="eval").body)
            changed = changed or ast.unparse(other) != ast.unparse(tree)
            with np.errstate(all="ignore"):
                value = evaluate_tree(other, run.values_for(node))
            if isinstance(value, str):
                return None
            length = self.student.assignment.length(node)
            parts.append(np.broadcast_to(np.asarray(value, dtype=float), (length,)))
        return np.concatenate(parts) if changed else None

    # --- other columns, methods and variants ---------------------------------------------

    def _columns(self, item: Item, run: Evaluation) -> Iterator[tuple[str, Array | None]]:
        """Values of another column: of the same table, then of any table with the same rows."""
        if not item.is_column:
            for key, scalar in self._neighbours(item):
                value = run.value(key)
                # A nought is no value of another quantity that happens to be one.
                if not isinstance(value, str) and round(value, item.quantity.digits.decimals):
                    yield f"это значение величины {scalar}", np.array([float(value)])
            yield from self._largest(item, run)
            return
        model = self.student.assignment.model
        own = model.tables[item.block]
        tables = [own, *(table for table in model.tables.values() if table is not own)]
        for table in tables:
            rows = row_indices(own, table)
            if rows is None:
                continue
            for column in table.columns:
                node = f"{table.id}.{column.key}"
                if node == item.nodes[0] or column.expr is None:
                    continue
                about = column.quantity
                where = "соседнего столбца" if table is own else "столбца"
                words = f"это значения {where} {about.symbol} ({about.title})"
                if _EXACT in column.key:
                    words = f"точная формула вместо двучленной: {about.symbol} ({about.title})"
                value = run.value(node)
                if not isinstance(value, str):
                    yield words, np.asarray(value, dtype=float)[rows]

    def _largest(self, item: Item, run: Evaluation) -> Iterator[tuple[str, Array | None]]:
        """The largest of a column, whose rows may be on either side of the largest of all."""
        right = self._values(item, run)
        if not item.quantity.unit:
            return
        for table in self.student.assignment.model.tables.values():
            for column in table.columns:
                if column.expr is None or column.quantity.unit != item.quantity.unit:
                    continue
                value = run.value(f"{table.id}.{column.key}")
                if isinstance(value, str) or not np.isfinite(value).any():
                    continue
                largest = np.nanmax(np.abs(value), keepdims=True)
                where = table.number or f"«{table.title}»"
                words = f"это наибольшее из строк таблицы {where}, {column.quantity.symbol}"
                if right is not None and (np.abs(right) > largest).all():
                    words += ": между ними есть и большее"
                yield words, largest if round(float(largest[0]), 6) else None

    def _neighbours(self, item: Item) -> Iterator[tuple[str, str]]:
        for other in self.student.assignment.items:
            if other.block == item.block and other.id != item.id and len(other.nodes) == 1:
                yield other.nodes[0], f"{other.symbol} ({other.title})"

    def _methods(self, item: Item) -> Iterator[tuple[str, Array | None]]:
        model = self.student.assignment.model
        field = model.fields.get("calculation_method")
        if field is None or field.choices is None:
            return
        now = field.choices[str(field.value)]
        other = next(label for label in METHODS.values() if label != now)
        exact = other == METHODS["exact"]
        words = "точная формула вместо двучленной" if exact else "двучленная формула вместо точной"
        run = self.student.expected.fork({"calculation_method": other})
        yield words, self._values(item, run)

    def _variants(self, item: Item) -> Iterator[tuple[str, Array | None]]:
        """One parameter of another variant, its λ, then the whole other variant."""
        expected = self.student.expected
        graph = self.student.assignment.graph
        near = frozenset().union(*(graph.references(node) for node in item.nodes))
        known = {node: expected.value(node) for node in near if "." in node}
        inside = near | frozenset().union(*(graph.ancestors(n) for n in near if "." not in n))
        tried: set[tuple[str, float]] = set()
        for other in self.others[:_OTHERS]:
            for name, value in other.values.items():
                if (name, value) in tried or name not in inside:
                    continue
                tried.add((name, value))
                run = expected.fork({**known, name: value})
                title = self.titles.get(name, name)
                words = f"{title} из варианта {other.number}: {short(value)}"
                yield words, self._values(item, run)
        for other in self.others[:_OTHERS]:
            theirs = self.whole.get(other.number)
            if theirs is None:
                theirs = self.whole[other.number] = expected.fork(dict(other.values))
            if "lam" in inside:
                lam = theirs.value("lam")
                run = expected.fork({**known, "lam": lam})
                yield f"λ из варианта {other.number}: {short(lam, 4)}", self._values(item, run)
            words = f"исходные данные варианта {other.number}, а не вашего"
            yield words, self._values(item, theirs)


def _is_place(item: Item) -> bool:
    """Whether a result is the number of a journal, a mass, a cylinder."""
    has_parts = item.quantity.unit or item.quantity.digits.decimals
    return len(item.nodes) == 1 and not item.is_column and not has_parts


# --- rows ----------------------------------------------------------------------------------------

_LEAST = 3  # values of an item that one of them is told distance from


def moved(right: Array, values: Array, by: int) -> Array:
    """Right values moved by a row; the row without a right value is the student's own."""
    shifted = np.roll(right, by)
    shifted[0 if by > 0 else -1] = values[0 if by > 0 else -1]
    return shifted


def row_indices(own: TableSpec, other: TableSpec) -> NDArray[np.intp] | None:
    """For each row of a table the row of another table with the same angle."""
    if own.rows == other.rows:
        return np.arange(len(own.rows))
    places = {angle: i for i, angle in enumerate(other.rows)}
    if any(angle not in places for angle in own.rows):
        return None
    return np.array([places[angle] for angle in own.rows])


def slips(judgement: Judgement, good: NDArray[np.bool_]) -> list[int]:
    """The wrong rows where they are few and all others are right; ``good`` are right numbers."""
    rows = list(judgement.rows)
    ready = set(judgement.typed)
    wrong = [i for i in rows if np.isfinite(judgement.values[i]) and not (i in ready and good[i])]
    few = len(good) >= _LEAST and 0 < len(rows) <= len(good) / 2
    return rows if few and wrong == rows else []


def rows_text(judgement: Judgement, rows: list[int], cause: str) -> str:
    """Cause of a few wrong rows in words."""
    column, count = judgement.item.is_column, len(judgement.values)
    if len(rows) == 1:
        which = f"неверна одна строка из {count}" if column else f"неверно одно из {count} значений"
    else:
        kind = "строк" if column else "значений"
        which = f"неверно {kind}: {len(rows)} из {count}"
    if not cause:
        ready = set(rows) <= set(judgement.typed)
        cause = "вместо формулы вписано число" if ready else "сравните формулу с соседними"
    return f"{which}, остальные верны: {cause}"
