"""Values of a grid's formulas, calculated anew by formualizer.

Whatever cannot be calculated for certain is unknown, and so is all that depends on it:
an error of the library is never taken for an error of the student's.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from math import isfinite
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reports.recalculation.array_functions import NOT_LIFTED, WRONG, register
from reports.recalculation.formulas import PLACES, TEXT_NUMBER, is_doubtful
from reports.recalculation.grid import Area, CellGrid, Run, is_backwards
from reports.recalculation.minimal_xlsx import simple_workbook
from reports.shared.errors import UnknownFormula

if TYPE_CHECKING:
    from formualizer import Workbook

Array = NDArray[np.float64]
BLANK, NUMBER, TEXT, ERROR = "b", "n", "t", "e"

# Errors of formulas; whatever else formualizer says is its own trouble.
_ERRORS = {
    "Div": "#DIV/0!", "Num": "#NUM!", "Value": "#VALUE!", "Ref": "#REF!", "Na": "#N/A",
    "Null": "#NULL!", "Circ": "#CIRC!",
}  # fmt: skip
ERROR_WORDS = {  # as a Russian program shows them, and what they are
    "#DIV/0!": "#ДЕЛ/0! — деление на ноль", "#N/A": "#Н/Д — значение не найдено",
    "#VALUE!": "#ЗНАЧ! — в вычислении текст", "#REF!": "#ССЫЛКА! — ссылка на удалённую ячейку",
    "#NUM!": "#ЧИСЛО! — вычислить нельзя", "#NAME?": "#ИМЯ? — неизвестное имя",
    "#CIRC!": "#ЦИКЛ! — круговая ссылка", "#NULL!": "#ПУСТО! — области не пересекаются",
}  # fmt: skip
_LIMIT_MS = 40_000
ONE_WANTED = "диапазон там, где нужно одно значение"


class Evaluator:
    """Values of a grid's cells.

    A formula that cannot be calculated for certain raises ``UnknownFormula`` from every
    method that needs its value.
    """

    def __init__(self, grid: CellGrid) -> None:
        self.grid = grid
        self._singly: dict[tuple[str, int, int], Any] = {}  # calculated cell by cell

    def values(self, sheet: str, column: int, first: int, last: int) -> tuple[Array, str]:
        """Numbers of a column's cells and a letter for the kind of each.

        The letters: ``n`` number, ``b`` blank, ``t`` text, ``e`` error; the number of
        a blank, a text and an error is NaN.
        """
        cells = self.grid.column(sheet, column)
        numbers = np.full(last - first + 1, np.nan)
        kinds = [BLANK] * len(numbers)
        for row, constant in cells.constants.items():
            if first <= row <= last:
                is_text = isinstance(constant, str)
                numbers[row - first] = np.nan if is_text else float(constant)
                kinds[row - first] = TEXT if is_text else NUMBER
        for row in cells.errors:
            if first <= row <= last:
                kinds[row - first] = ERROR
        for run in cells.runs_in(first, last):
            block, letters = self._of(run)
            low, high = max(first, run.first), min(last, run.last)
            inside = slice(low - run.first, high - run.first + 1)
            numbers[low - first : high - first + 1] = block[inside]
            kinds[low - first : high - first + 1] = letters[inside]
        return numbers, "".join(kinds)

    def all_of(self, run: Run) -> Array:
        """Numbers of all cells of a run, NaN where there is none."""
        return self._of(run)[0]

    def shown(self, sheet: str, column: int, row: int) -> float | str | None:
        """What stands in a cell; a calculated text is folded by case, an error as ``#DIV/0!``."""
        cells = self.grid.column(sheet, column)
        for run in cells.runs_in(row, row):
            index = row - run.first
            number, kind = self._of(run)[0][index], self._of(run)[1][index]
            value = self._raw[run][index]
            if kind == ERROR:
                return _ERRORS[value["kind"]] if isinstance(value, dict) else "#NUM!"
            return str(value) if kind == TEXT else float(number)
        return cells.errors.get(row, cells.constants.get(row))

    def put(self, cells: Iterable[Any]) -> None:
        """Replace constants of some cells; all is calculated anew at the next question."""
        book = self._book
        for part in cells:
            first, last = part.rows[0], part.rows[-1]
            if last - first + 1 == len(part.rows):
                values = [[value] for value in part.values]
                book.set_values_batch(part.sheet, first, part.column, values)
            else:
                for row, value in zip(part.rows, part.values, strict=True):
                    book.set_value(part.sheet, row, part.column, value)
        for name in ("_values", "_raw"):
            self.__dict__.pop(name, None)
        self._singly.clear()

    def is_circular(self, sheet: str, column: int, first: int, last: int) -> bool:
        """Whether some of a column's formulas go round in a circle."""
        return any(
            isinstance(value, dict) and value.get("kind") == "Circ"
            for run in self.grid.column(sheet, column).runs_in(first, last)
            if run not in self._unknown
            for value in self._raw[run]
        )

    # --- what is known --------------------------------------------------------------------

    def _of(self, run: Run) -> tuple[Array, str]:
        values = self._values
        if run in self._unknown:
            raise UnknownFormula(self._unknown[run])
        return values[run]

    @cached_property
    def _values(self) -> dict[Run, tuple[Array, str]]:
        """Numbers and kinds of every run that is known; fills ``_unknown``."""
        values_by_cell = {}
        for run, values in self._raw.items():
            try:
                values_by_cell[run] = _numbers(values)
            except UnknownFormula as error:
                self._unknown[run] = str(error)
        if len(values_by_cell) < len(self._raw):
            self._spread(self._unknown)
        return values_by_cell

    @cached_property
    def _unknown(self) -> dict[Run, str]:
        """Runs that are not calculated, and why."""
        refused: dict[Run, str] = {}
        for run in self.grid.runs():
            reason = self._refusal(run)
            if reason:
                refused[run] = reason
        self._spread(refused)
        return refused

    def _spread(self, unknown: dict[Run, str]) -> None:
        """Mark dependents of unknown cells as unknown."""
        if not unknown:
            return
        dependents: dict[Run, list[Run]] = {}
        for run in self.grid.runs():
            if run.formula is not None and run not in unknown:
                for area in self.grid.precedents(run):
                    for other in self.grid.runs_of(area):
                        dependents.setdefault(other, []).append(run)
        stack = list(unknown)
        while stack:
            run = stack.pop()
            for other in dependents.get(run, ()):
                if other not in unknown:
                    unknown[other] = unknown[run]
                    stack.append(other)

    def _refusal(self, run: Run) -> str:
        """Why a run is not calculated, empty where it is."""
        if run.formula is None or run.problem:
            return run.problem
        try:
            references = run.formula.references
        except UnknownFormula as error:
            return str(error)
        if run.formula.refusal:
            return run.formula.refusal
        for reference in references:
            if "[" in (reference.sheet or ""):
                return "ссылка на другую книгу"
            area = self.grid.named(reference.name) if reference.name else None
            if reference.name and area is None and "LET" not in run.formula.functions:
                return f"имя {reference.name}"
            one = reference.first == reference.last if area is None else _is_cell(area)
            if not (one or run.array or reference.whole or reference.spread):
                return ONE_WANTED
            if area is None and is_backwards(run, reference):
                return "диапазон кончается раньше, чем начинается"
        spread = run.array is not None or run.formula.takes_arrays
        if spread and not run.formula.functions.isdisjoint(PLACES):
            return ONE_WANTED
        if run.formula.gives_array and not run.array:
            return ONE_WANTED
        return TEXT_NUMBER if self._reads_doubtful(run) else ""

    def _reads_doubtful(self, run: Run) -> bool:
        """Whether a run calculates with a text that only some spreadsheets take for a number."""
        return any(
            area.first_column <= column <= area.last_column
            and area.first_row <= row <= area.last_row
            and (reference.spread or is_doubtful(text))
            for reference, area in (self.grid.located(run) if self._doubtful else ())
            if not reference.whole
            for column, row, text in self._doubtful.get(area.sheet, ())
        )

    @cached_property
    def _doubtful(self) -> dict[str, list[tuple[int, int, str]]]:
        """Column, row and text of such cells by sheets."""
        cells: dict[str, list[tuple[int, int, str]]] = {}
        for sheet, columns in self.grid.sheets.items():
            for number, column in columns.items():
                for row, value in column.constants.items():
                    if isinstance(value, str) and is_doubtful(value, in_product=True):
                        cells.setdefault(sheet, []).append((number, row, value))
        return cells

    # --- formualizer ----------------------------------------------------------------------

    @cached_property
    def _book(self) -> Workbook:
        import formualizer

        config = formualizer.EvaluationConfig()
        config.cycle_detection = "runtime"
        config.enable_parallel = False
        config.max_eval_time_ms = _LIMIT_MS
        runs = [run for run in self.grid.runs() if run not in self._unknown]
        book = formualizer.Workbook.from_bytes(
            simple_workbook(self.grid, runs),
            config=formualizer.WorkbookConfig(
                mode=formualizer.WorkbookMode.Interactive, eval_config=config
            ),
        )
        register(book, self._replaced(runs))
        return book

    @staticmethod
    def _replaced(runs: list[Run]) -> frozenset[str]:
        """Functions that formualizer would get wrong in some of these runs."""
        names: frozenset[str] = frozenset()
        for run in runs:
            assert run.formula is not None
            over_rectangles = run.array is not None or run.formula.takes_arrays
            names |= run.formula.functions & (NOT_LIFTED if over_rectangles else WRONG)
        return names

    @cached_property
    def _raw(self) -> dict[Run, list[Any]]:
        """Return the results of formualizer for the cells of each run."""
        runs = [run for run in self.grid.runs() if run not in self._unknown]
        if not runs:
            return {}
        self._evaluate(
            (run.sheet, row, run.column) for run in runs for row in range(run.first, run.last + 1)
        )
        return {run: self._read(run.sheet, run) for run in runs}

    def _evaluate(self, cells: Iterable[tuple[str, int, int]]) -> None:
        """Evaluate all runs at once, cell by cell after a failure."""
        from formualizer import ExcelEvaluationError

        try:
            self._book.evaluate_all()
        except ExcelEvaluationError:
            for cell in cells:
                try:
                    self._singly[cell] = self._book.evaluate_cell(*cell)
                except ExcelEvaluationError as error:
                    self._singly[cell] = {"kind": str(error)}

    def _read(self, sheet: str, run: Run) -> list[Any]:
        from formualizer import RangeAddress

        area = RangeAddress(sheet, run.first, run.column, run.last, run.column)
        values = self._book.sheet(sheet).get_values(area)
        return [
            self._singly.get((sheet, run.first + i, run.column), value)
            for i, (value,) in enumerate(values)
        ]


def _is_cell(area: Area) -> bool:
    return area.first_row == area.last_row and area.first_column == area.last_column


def _numbers(values: list[Any]) -> tuple[Array, str]:
    """Numbers and kinds of values as formualizer gives them.

    Raises:
        UnknownFormula: it could not tell one of them.
    """
    if all(type(value) is float for value in values):
        numbers = np.array(values)
        if np.isfinite(numbers).all():
            return numbers, NUMBER * len(values)
    numbers = np.full(len(values), np.nan)
    kinds = []
    for index, value in enumerate(values):
        kind = ERROR
        if isinstance(value, (bool, int, float)):
            if isfinite(value):
                numbers[index], kind = float(value), NUMBER
        elif isinstance(value, str):
            kind = TEXT
        elif not (isinstance(value, dict) and value.get("kind") in _ERRORS):
            raise UnknownFormula("действие, которого программа не умеет")
        kinds.append(kind)
    return numbers, "".join(kinds)
