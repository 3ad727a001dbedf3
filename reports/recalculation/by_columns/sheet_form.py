"""A sheet without its values: which cells there are and which formulas.

Books of a class that were saved by the same program differ in the values of a sheet only.
The form of the sheet is then made once, and filled with the values of each book.
"""

from __future__ import annotations

import html
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from reports.recalculation.by_columns.formulas import Formula
from reports.recalculation.by_columns.grid import (
    MAX_CELLS,
    BadBook,
    Cached,
    Column,
    Grid,
    Run,
)

_ESCAPES = (("&lt;", "<"), ("&gt;", ">"), ("&quot;", '"'), ("&apos;", "'"), ("&amp;", "&"))
NOTHING = -1  # instead of the number of a value


@dataclass(slots=True)
class RunForm:
    """Cells of one column below each other with the same formula."""

    first: int
    count: int
    formula: Formula | None
    text: str
    problem: str


@dataclass(slots=True)
class ColumnForm:
    """Rows of one column and the numbers of their values."""

    typed_rows: list[int] = field(default_factory=list)
    typed: list[int] = field(default_factory=list)
    error_rows: list[int] = field(default_factory=list)
    errors: list[int] = field(default_factory=list)
    saved_rows: list[int] = field(default_factory=list)
    saved: list[int] = field(default_factory=list)
    runs: list[RunForm] = field(default_factory=list)
    _saved: tuple[NDArray[np.intc], NDArray[np.intc]] | None = None

    @property
    def saved_places(self) -> tuple[NDArray[np.intc], NDArray[np.intc]]:
        """Rows of the cells with formulas and the numbers of their values, as arrays."""
        if self._saved is None:
            self._saved = np.array(self.saved_rows, np.intc), np.array(self.saved, np.intc)
        return self._saved


@dataclass(slots=True)
class SheetForm:
    """Columns by number; values that are no plain numbers, with their kind, by number."""

    columns: dict[int, ColumnForm] = field(default_factory=dict)
    special: dict[int, str] = field(default_factory=dict)
    fixed: list[str] = field(default_factory=list)  # texts that stand in the form itself
    cells: int = 0

    def fill(
        self,
        grid: Grid,
        title: str,
        values: list[bytes],
        strings: list[str],
        *,
        escaped: bool = True,
    ) -> None:
        """Put a sheet with these values into a grid; ``escaped`` as in XML.

        Raises:
            BadBook: a value that is none, or too many cells.
            UnicodeDecodeError: a value that is no UTF-8.
        """
        grid.cells += self.cells
        check_count(grid.cells)
        try:
            numbers = self._numbers(values, escaped)
            found = self._converted(numbers, values, strings, escaped)
        except UnicodeDecodeError:
            raise
        except (ValueError, IndexError):
            msg = f"на листе «{title}» есть ячейка с неверным значением"
            raise BadBook(msg) from None
        numbers[list(self.special)] = np.nan
        hollow = any(found[i] is None or found[i] == "" for i in self.special) or "" in self.fixed
        columns = grid.sheets[title]
        for number, form in self.columns.items():
            made = columns[number] = Column()
            typed = [found[i] for i in form.typed]
            if hollow:
                pairs = zip(form.typed_rows, typed, strict=True)
                made.constants = {r: v for r, v in pairs if v is not None and v != ""}
            else:
                made.constants = dict(zip(form.typed_rows, typed, strict=True))  # type: ignore[arg-type]
            if form.errors:
                texts = [str(found[i] or "#VALUE!") for i in form.errors]
                made.errors = dict(zip(form.error_rows, texts, strict=True))
            if form.runs:
                made.saved_rows, places = form.saved_places
                made.saved = numbers[places]
                made.runs = [
                    Run(title, number, run.first, run.count, run.formula, run.text, run.problem)
                    for run in form.runs
                ]

    def _numbers(self, values: list[bytes], escaped: bool) -> NDArray[np.float64]:
        """Values as numbers; behind them a NaN for each text of the form, and for NOTHING."""
        plain = values
        if self.special:
            plain = values.copy()
            for i in self.special:
                plain[i] = b"0"
        try:
            numbers = list(map(float, plain))
        except ValueError:
            if not escaped:
                raise
            numbers = [float(plain_text(value.decode())) for value in plain]
        made = np.full(len(numbers) + len(self.fixed) + 1, np.nan)
        made[: len(numbers)] = numbers
        if not np.isfinite(made[: len(numbers)]).all():
            raise ValueError
        return made

    def _converted(
        self,
        numbers: NDArray[np.float64],
        values: list[bytes],
        strings: list[str],
        escaped: bool,
    ) -> list[Cached]:
        """Values as numbers, texts and flags, the texts of the form, and None for NOTHING."""
        found: list[Cached] = numbers[: len(values)].tolist()
        for i, kind in self.special.items():
            if kind == "s":
                number = int(values[i])
                found[i] = strings[number] if number >= 0 else None
                continue
            text = values[i].decode()
            text = plain_text(text) if escaped else text
            found[i] = text.strip() == "1" if kind == "b" else text
        return [*found, *self.fixed, None]


def check_count(cells: int) -> None:
    """Refuse a workbook with too many cells.

    Raises:
        BadBook: there are too many.
    """
    if cells > MAX_CELLS:
        msg = f"в книге больше {MAX_CELLS} заполненных ячеек"
        raise BadBook(msg)


def plain_text(text: str) -> str:
    """Text without the escapes of XML."""
    if "&" not in text:
        return text
    if "&#" in text:
        return html.unescape(text)
    for escaped, sign in _ESCAPES:
        text = text.replace(escaped, sign)
    return text
