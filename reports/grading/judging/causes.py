"""Likely cause of a wrong column: usual mistakes tried one after the other."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reports.formula.numeric import evaluate_tree
from reports.formula.parse import names, parse
from reports.grading.issuing.assignment import Item
from reports.grading.judging.few_rows import moved, row_indices, rows_text, slips
from reports.grading.judging.foreign import OtherVariant, Variants
from reports.grading.judging.judgement import (
    Array,
    Judgement,
    close,
    distance,
    explains,
    tolerance,
    values_of,
)
from reports.grading.judging.literal_tables import literals, typed_numbers
from reports.grading.judging.mistakes import (
    MIXED,
    OPPOSITE,
    ROOTLESS,
    TAKEN_SPEEDS,
    Changes,
    exchanges,
    mistakes,
    signs,
    symbol_of,
)
from reports.grading.judging.response import FormulaResponse
from reports.grading.judging.spelling import squares_a_cosine, squares_a_minus
from reports.grading.reading.student import StudentBook, known_values
from reports.inputs.sections.input_file import METHODS
from reports.model.evaluation import Evaluation
from reports.shared.errors import FormulaError
from reports.shared.russian import fixed, short, uncapital

_FACTORS = (10.0, 60.0, 100.0, 1000.0, 1e4, 1e5, 1e6, 1e9)
_EXACT = "exact"  # in the key of a column by the exact formula
_VARIED = 4  # different values of a column that tells anything
Change = Callable[[ast.expr], Any]


@dataclass(frozen=True, slots=True)
class Scene:
    """An engine: its right values of an item, and what the student has for it."""

    run: Evaluation
    known: Mapping[str, object]  # by which it differs from the student's
    right: Array
    values: Array


Attempt = tuple[str, Callable[[Scene], Array | None]]  # a mistake in words, and what it gives


class Causes:
    """Tries the usual mistakes on one student's wrong columns."""

    def __init__(
        self,
        student: StudentBook,
        others: Sequence[OtherVariant],
        titles: dict[str, str],
        whole: dict[int, Evaluation] | None = None,
        response: FormulaResponse | None = None,
        judgements: Sequence[Judgement] = (),
    ) -> None:
        self.student, self.response = student, response
        self.variants = Variants(
            student, others, {} if whole is None else whole, titles, judgements
        )

    def find(self, judgement: Judgement) -> str:
        """Return the cause in words, empty where none fits."""
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
        cause = self._as_written(item, cause)
        rows = [] if cause or judgement.coarse else slips(judgement, good)
        return rows_text(judgement, rows, self._explained(judgement, rows)) if rows else cause

    def _as_written(self, item: Item, cause: str) -> str:
        """Return the same cause in the words of what the student has written."""
        runs = [run for node in item.nodes for run in self.student.runs(node)]
        formulas = [run.formula for run in runs if run.formula is not None]
        model = self.student.assignment.model
        of_sign = {OPPOSITE, *signs(self._tree(item.nodes[0]), item.block, model)}
        if cause in of_sign and any(map(squares_a_minus, formulas)):
            return f"{cause}: −x^2 в таблице — это (−x)², а надо −(x^2)"
        if cause == ROOTLESS and any(map(squares_a_cosine, formulas)):
            return "косинус в квадрате, а надо в первой степени"
        return cause

    def gives(self, judgement: Judgement, text: str) -> bool:
        """Whether a formula in the language of the tables gives the wrong values of an item."""
        item, values = judgement.item, judgement.values
        values_read = self._known(judgement)
        for base in [values_read, {}] if values_read else [{}]:
            run = self.student.expected.fork(base)
            attempt = self._rewritten(item, run, lambda _: parse(text))
            if attempt is not None and explains(
                item, values, attempt, judgement.expected, self.student
            ):
                return True
        return False

    def _common(self, judgement: Judgement) -> str:
        """Return a cause that all values have in common."""
        finite = judgement.values[np.isfinite(judgement.values)]
        if not finite.any():  # anything small enough is nought
            return "все значения равны нулю" if len(judgement.values) > 1 else "получен нуль"
        if judgement.coarse:
            return "округлено грубее, чем печатает книга"
        few = judgement.item.is_column and np.unique(finite).size < _VARIED
        return "" if few else self._explained(judgement)

    def _explained(self, judgement: Judgement, rows: Sequence[int] = ()) -> str:
        """Return the first usual mistake that gives the values, or those of some rows."""
        item, values = judgement.item, judgement.values
        values_read = self._known(judgement)
        for base in [values_read, {}] if values_read else [{}]:
            cause = self._first(judgement, values, base, rows)
            if cause:
                return cause
        # Mistakes before this one, in what the program calculates from them too: its formula is
        # looked at without them.
        alone = self.response.tryout.alone(item) if self.response is not None else None
        if alone is None or np.allclose(alone, values, equal_nan=True):
            return ""
        return self._first(judgement, alone, {}, rows)

    def _first(
        self,
        judgement: Judgement,
        values: Array,
        values_read: Mapping[str, object],
        rows: Sequence[int],
    ) -> str:
        item, run = judgement.item, self.student.expected.fork(values_read)
        # No row explains itself.
        beyond = np.full(len(values), np.nan) if rows else values
        scene = Scene(run, values_read, values_of(item, run), beyond)
        fitting = self._fitting(judgement, values, scene, rows)
        cause = next(fitting, "")
        # What a condition picks, many wrong ones pick.
        picks = any(isinstance(self._tree(node), ast.IfExp) for node in item.nodes)
        return "" if picks and any(words != cause for words in fitting) else cause

    def _fitting(
        self, judgement: Judgement, values: Array, scene: Scene, rows: Sequence[int]
    ) -> Iterator[str]:
        """Words of all mistakes that give the values, for this engine and for the trials."""
        item = judgement.item

        def fits(attempt: Array | None) -> bool:
            return attempt is not None and explains(
                item, values, attempt, scene.right, self.student, rows
            )

        def fitting(attempts: Iterator[Attempt]) -> Iterator[str]:
            for words, change in attempts:
                if fits(change(scene)) and self._holds_elsewhere(item, change, rows):
                    yield words

        yield from fitting(self._likely(item, scene))
        yield from self.variants.words(judgement, fits)
        yield from self._typed_in(item, scene, fits)
        yield from fitting(self._last())
        yield from fitting(self._changed_formulas(item, exchanges))

    def _holds_elsewhere(
        self, item: Item, change: Callable[[Scene], Array | None], rows: Sequence[int]
    ) -> bool:
        """Whether the formulas make the same mistake with other input data: twice 2 is 2²."""
        for scene in self._elsewhere(item):
            attempt = change(scene)
            at = np.asarray(rows) if rows else np.arange(len(scene.values))
            there = at[np.isfinite(scene.values[at])]
            if attempt is None or attempt.shape != scene.values.shape or not there.size:
                continue
            allowed = tolerance(item, attempt, self.student)
            if not (np.abs(scene.values - attempt)[there] <= allowed).all():
                return False
        return True

    def _elsewhere(self, item: Item) -> list[Scene]:
        """Return the values of an item's formulas with the inputs of the trials.

        The input data that are alike for the class are varied where no number of the formulas
        may stand for them.
        """
        if self.response is None or not all(map(self.student.runs, item.nodes)):
            return []
        if item.id not in self._scenes:
            scenes = []
            tried = [self.response.tried(node) for node in item.nodes]
            literal = bool(typed_numbers(self.student, item))
            for at, trial in enumerate(self.response.trials):
                if not (trial.decides or not literal) or any(isinstance(t, str) for t in tried):
                    continue
                values = np.concatenate([values[at] for values in tried])
                right = values_of(item, trial.expected)
                scenes.append(Scene(trial.expected, trial.inputs, right, values))
            self._scenes[item.id] = scenes
        return self._scenes[item.id]

    @cached_property
    def _scenes(self) -> dict[str, list[Scene]]:
        return {}

    def _known(self, judgement: Judgement) -> dict[str, object]:
        """Return the student's own earlier values, where they are not the right ones."""
        nodes = frozenset().union(*(self.student.precedents(n) for n in judgement.item.nodes))
        values_read = known_values(self.student.answers, nodes - set(judgement.item.nodes))
        return (
            values_read
            if any(self._is_off(node, value) for node, value in values_read.items())
            else {}
        )

    def _is_off(self, node: str, value: object) -> bool:
        right = self.student.expected.value(node)
        if isinstance(right, str):
            return False
        actual, expected = (np.ravel(np.asarray(one, dtype=float)) for one in (value, right))
        away = distance([node], actual, expected, self.student.expected)
        is_close = away <= 1e-8 + 1e-9 * np.abs(expected)
        return not (is_close | (np.isnan(actual) & np.isnan(expected))).all()

    def _likely(self, item: Item, scene: Scene) -> Iterator[Attempt]:
        yield OPPOSITE, lambda s: -s.right
        for factor in _FACTORS:
            times = fixed(factor, 0)
            for more, words in ((factor, "больше"), (1 / factor, "меньше")):
                yield (f"значения {words} правильных в {times} раз: проверьте единицы",
                       partial(_times, more))  # fmt: skip
        if not item.is_column:
            yield from self._inputs(item)
        yield "результат в градусах вместо радиан", lambda s: np.degrees(s.right)
        yield "результат в радианах вместо градусов", lambda s: np.radians(s.right)
        yield from self._changed_formulas(item, mistakes)
        if len(scene.right) > 3 and item.is_column:
            yield "значения сдвинуты на одну строку вниз", lambda s: moved(s.right, s.values, 1)
            yield "значения сдвинуты на одну строку вверх", lambda s: moved(s.right, s.values, -1)
        yield from self._columns(item, scene)
        yield from self._methods(item)

    @staticmethod
    def _last() -> Iterator[Attempt]:
        for factor, times in ((2, "вдвое"), (4, "вчетверо")):
            for more, words in ((factor, "больше"), (1 / factor, "меньше")):
                yield f"результат {times} {words} правильного", partial(_times, more)
        yield "получена обратная величина", lambda s: _inverse(s.right)
        for one, other in TAKEN_SPEEDS:
            words = next(words for *pair, words in MIXED if pair == [one, other])
            yield words, partial(_in_place, one, other)

    # --- the formula itself -------------------------------------------------------------

    def _changed_formulas(self, item: Item, changes: Changes) -> Iterator[Attempt]:
        tree, model = self._tree(item.nodes[0]), self.student.assignment.model
        for words, change in changes(tree, item.block, model):
            yield words, partial(self._changed, item, change)

    def _changed(self, item: Item, change: Change, scene: Scene) -> Array | None:
        return self._rewritten(item, scene.run, change)

    def _inputs(self, item: Item) -> Iterator[Attempt]:
        """Return an input of the formula taken for its result."""
        fields = self.student.assignment.model.fields
        for name in sorted(self._names(item.nodes[0])):
            if name in fields and isinstance(fields[name].value, (int, float)):
                title = fields[name].title
                title = "частота вращения n" if name == "regime_speed_rpm" else uncapital(title)
                yield f"{title} вместо {item.symbol}", partial(_one, name)

    def _typed_in(self, item: Item, scene: Scene, fits: Callable[[Array], bool]) -> Iterator[str]:
        """Return a wrong number that stands in the formulas for what the textbook's refers to."""
        graph, model = self.student.assignment.graph, self.student.assignment.model
        names_ = frozenset().union(*map(graph.references, item.nodes))
        names_ -= frozenset().union(*map(self.student.refers, item.nodes))
        numbers = literals(self.student, item)
        for name in sorted(n for n in names_ if "." not in n and numbers):
            right = scene.run.value(name)
            if isinstance(right, str) or np.ndim(right):
                continue
            for number in sorted(numbers):
                run = scene.run.fork({**scene.known, name: number})
                if number != right and fits(values_of(item, run)):
                    symbol = symbol_of(name, item.block, model)
                    yield f"{symbol}: вписано число {short(number)}, а у вас {short(right)}"

    def _moved_reference(self, item: Item) -> str:
        """Return a reference to one cell that was filled down without its $."""
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

    def _text(self, node: str) -> str:
        """Return the formula of a node, as changed ones are spelt."""
        if node not in self._texts:
            self._texts[node] = ast.unparse(self._tree(node))
        return self._texts[node]

    @cached_property
    def _texts(self) -> dict[str, str]:
        return {}

    def _names(self, node: str) -> frozenset[str]:
        return names(self.student.assignment.graph.expression(node) or "0")

    def _rewritten(self, item: Item, run: Evaluation, change: Change) -> Array | None:
        """Values of a changed formula, None where it stays the same or is no formula of numbers."""
        try:
            return self._calculated(item, run, change)
        except (ArithmeticError, FormulaError, LookupError, TypeError, ValueError):
            return None

    def _calculated(self, item: Item, run: Evaluation, change: Change) -> Array | None:
        parts = []
        changed = False
        for node in item.nodes:
            text = self._text(node)
            other = change(ast.parse(text, mode="eval").body)
            changed = changed or ast.unparse(other) != text
            with np.errstate(all="ignore"):
                value = evaluate_tree(other, run.values_for(node))
            if isinstance(value, str):
                return None
            length = self.student.assignment.length(node)
            parts.append(np.broadcast_to(np.asarray(value, dtype=float), (length,)))
        return np.concatenate(parts) if changed else None

    # --- other columns, methods and variants ---------------------------------------------

    def _columns(self, item: Item, scene: Scene) -> Iterator[Attempt]:
        """Values of another column: of the same table, then of any table with the same rows."""
        if not item.is_column:
            for key, scalar in self._neighbours(item):
                value = scene.run.value(key)
                # A nought is no value of another quantity that happens to be one.
                if not isinstance(value, str) and round(value, item.quantity.digits.decimals):
                    yield f"это значение величины {scalar}", partial(_one, key)
            yield from self._largest(item, scene)
            return
        model = self.student.assignment.model
        spec = model.tables[item.block]
        tables = [spec, *(table for table in model.tables.values() if table is not spec)]
        for table in tables:
            rows = row_indices(spec, table)
            if rows is None:
                continue
            for column in table.columns:
                node = f"{table.id}.{column.key}"
                if node == item.nodes[0] or column.expr is None:
                    continue
                quantity = column.quantity
                where = "соседнего столбца" if table is spec else "столбца"
                words = f"это значения {where} {quantity.symbol} ({quantity.title})"
                if _EXACT in column.key:
                    words = (
                        f"точная формула вместо двучленной: {quantity.symbol} ({quantity.title})"
                    )
                yield words, partial(_at_rows, node, rows)

    def _largest(self, item: Item, scene: Scene) -> Iterator[Attempt]:
        """Yield the largest of a column, whose rows may be on either side of the largest of all."""
        if not item.quantity.unit:
            return
        for table in self.student.assignment.model.tables.values():
            for column in table.columns:
                if column.expr is None or column.quantity.unit != item.quantity.unit:
                    continue
                where = table.number or f"«{table.title}»"
                words = f"это наибольшее из строк таблицы {where}, {column.quantity.symbol}"
                change = partial(_greatest, f"{table.id}.{column.key}")
                largest = change(scene)
                if largest is not None and (np.abs(scene.right) > largest).all():
                    words += ": между ними есть и большее"
                yield words, change

    def _neighbours(self, item: Item) -> Iterator[tuple[str, str]]:
        for other in self.student.assignment.items:
            if other.block == item.block and other.id != item.id and len(other.nodes) == 1:
                yield other.nodes[0], f"{other.symbol} ({other.title})"

    def _methods(self, item: Item) -> Iterator[Attempt]:
        model = self.student.assignment.model
        field = model.fields.get("calculation_method")
        if field is None or field.choices is None:
            return
        now = field.choices[str(field.value)]
        other = next(label for label in METHODS.values() if label != now)
        exact = other == METHODS["exact"]
        words = "точная формула вместо двучленной" if exact else "двучленная формула вместо точной"
        yield words, lambda s: values_of(item, s.run.fork({**s.known, field.name: other}))


def _times(factor: float, scene: Scene) -> Array:
    """Return the right values times a factor."""
    return scene.right * factor


def _in_place(one: str, other: str, scene: Scene) -> Array:
    """Return the right values with another quantity for one that they are proportional to."""
    return scene.right * float(scene.run.value(other)) / float(scene.run.value(one))


def _one(name: str, scene: Scene) -> Array:
    """Return the value of an input or a scalar."""
    return np.array([float(scene.run.value(name))])


def _at_rows(node: str, rows: NDArray[np.intp], scene: Scene) -> Array | None:
    """Values of a column in the rows of another table."""
    value = scene.run.value(node)
    return None if isinstance(value, str) else np.asarray(value, dtype=float)[rows]


def _greatest(node: str, scene: Scene) -> Array | None:
    """Return the largest of a column, None where there is none."""
    value = scene.run.value(node)
    if isinstance(value, str) or not np.isfinite(value).any():
        return None
    largest = np.nanmax(np.abs(value), keepdims=True)
    return largest if round(float(largest[0]), 6) else None


def _inverse(right: Array) -> Array:
    with np.errstate(divide="ignore"):
        return 1 / right


def _is_place(item: Item) -> bool:
    """Whether a result is the number of a journal, a mass, a cylinder."""
    has_parts = item.quantity.unit or item.quantity.digits.decimals
    return len(item.nodes) == 1 and not item.is_column and not has_parts
