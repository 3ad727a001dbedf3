"""Makes the form of a sheet cell by cell: formulas that were filled down become one run."""

from __future__ import annotations

from reports.recalculation.by_columns.formulas import formula_at
from reports.recalculation.by_columns.grid import MAX_COLUMN, MAX_ROW, BadBook
from reports.recalculation.by_columns.sheet_form import (
    NOTHING,
    ColumnForm,
    RunForm,
    SheetForm,
    check_count,
)
from reports.recalculation.by_columns.syntax import UnknownFormula, filled, row_template


class FormMaker:
    """Makes the form of one sheet from its cells; each column's come from the top."""

    def __init__(self, title: str) -> None:
        self.title = title
        self.form = SheetForm()
        self._shared: dict[str, tuple[str, int, int]] = {}  # si → text, row, column
        self._open: dict[int, tuple[RunForm, str | list[str | int] | None, str]] = {}

    def put(
        self,
        row: int,
        column: int,
        kind: str,
        formula: tuple[str, str, str] | None,
        value: int,
    ) -> None:
        """One cell with the number of its value.

        ``formula`` is its kind, its text and its key among the shared ones.

        Raises:
            BadBook: the cell lies far out, or there are too many.
        """
        if formula is None and value == NOTHING:
            return
        if not (0 < row <= MAX_ROW and 0 < column <= MAX_COLUMN):
            msg = f"на листе «{self.title}» есть ячейки далеко за таблицами"
            raise BadBook(msg)
        self.form.cells += 1
        check_count(self.form.cells)
        known = self.form.columns.get(column)
        if known is None:
            known = self.form.columns[column] = ColumnForm()
        if kind != "n" and value != NOTHING:
            self.form.special[value] = kind
        if formula is not None:
            known.saved_rows.append(row)
            known.saved.append(value)
            self._formula(known, row, column, *formula)
        elif kind == "e":
            known.error_rows.append(row)
            known.errors.append(value)
        else:
            known.typed_rows.append(row)
            known.typed.append(value)

    def follow(
        self,
        column: int,
        rows: list[str],
        formulas: list[str],
        values: list[int],
        at: int,
        end: int,
    ) -> int:
        """Take the cells from ``at`` on that continue the run above them; tell how many."""
        current = self._open.get(column)
        if current is None or current[1] is None:
            return 0
        run, template = current[0], current[1]
        row = first = run.first + run.count
        for i in range(at, end):
            digits = str(row)
            if rows[i] != digits or row > MAX_ROW or formulas[i] != filled(template, row):
                break
            row += 1
        count = row - first
        run.count += count
        self.form.cells += count
        check_count(self.form.cells)
        known = self.form.columns[column]
        known.saved_rows.extend(range(first, row))
        known.saved.extend(values[at : at + count])
        return count

    def _formula(
        self, known: ColumnForm, row: int, column: int, kind: str, text: str, key: str
    ) -> None:
        current = self._open.get(column)
        if kind == "shared" and text:
            self._shared.setdefault(key, (text, row, column))
        if kind == "shared" and not text:
            if current is not None and current[2] == key and _ends_above(current[0], row):
                current[0].count += 1
                return
            master = self._shared.get(key)
            if master is None:
                self._start(known, row, column, "", "общая формула без образца", key)
            else:
                self._start(known, row, column, master[0], "", key, origin=master[1:])
            return
        if kind not in ("normal", "shared"):
            self._start(known, row, column, text, "формула массива", "")
            return
        if (
            current is not None
            and current[1] is not None
            and _ends_above(current[0], row)
            and filled(current[1], row) == text
        ):
            current[0].count += 1
            if kind == "shared":
                self._open[column] = (current[0], current[1], key)
            return
        self._start(known, row, column, text, "", key if kind == "shared" else "")

    def _start(
        self,
        known: ColumnForm,
        row: int,
        column: int,
        text: str,
        problem: str,
        key: str,
        origin: tuple[int, int] | None = None,
    ) -> None:
        made = None
        at_row, at_column = origin or (row, column)
        if not problem and not text.strip(" ="):
            problem = "пустая формула"
        if not problem:
            try:
                made = formula_at(text.removeprefix("="), at_row, at_column)
            except UnknownFormula as error:
                problem = str(error)
        run = RunForm(row, 1, made, text, problem)
        known.runs.append(run)
        template = row_template(text, row) if made is not None and origin is None else None
        self._open[column] = (run, template, key)


def _ends_above(run: RunForm, row: int) -> bool:
    return run.first + run.count == row
