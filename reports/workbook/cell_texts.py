"""Cells as text of XML, by rows: openpyxl takes most of its time for cells that look alike."""

from __future__ import annotations

import math
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby

from openpyxl.utils import get_column_letter

from reports.shared.errors import CacheError
from reports.workbook.sheets import (
    BareCell,
    FilledColumn,
    SharedColumn,
    column_texts,
    number_text,
)

_ROW = "\x01"  # stands for the number of a row
_REFERENCE = re.compile(r"(?<![\w$.])([A-Z]{1,3})(\d+)\b")
_SEVERAL = 3  # cells with one formula, from which on it is written once
CellTexts = dict[int, dict[int, str]]  # by row and first column


def escaped(text: str) -> str:
    """Text for XML; hardly any formula has a sign that needs it."""
    if "&" in text or "<" in text or ">" in text:
        return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return text


def finite(value: float | str | None, where: str) -> float | str:
    """Return a value that a formula cell can have.

    Raises:
        CacheError: there is none, or it is not finite.
    """
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        raise CacheError(f"formula without a finite value: {where}: {value!r}")
    return value


def cell_texts(
    title: str, columns: Sequence[FilledColumn | SharedColumn], bare: Sequence[BareCell],
    looks: Mapping[str, str],
) -> CellTexts:  # fmt: skip
    """Return cells of a sheet by rows; ``looks`` are those of the cells above its columns."""
    texts: CellTexts = defaultdict(dict)
    columns = sorted(columns, key=lambda column: column.index)
    for run in _plain_runs(columns):
        for row, cells in _side_by_side(run):
            texts[row][run[0].index] = cells
    for column in columns:
        if isinstance(column, SharedColumn) and column.is_plain:
            continue
        letter = get_column_letter(column.index)
        style = looks[f"{letter}{column.first_row - 1}"]
        begin, middle = f'<c r="{letter}', f'" s="{style}">'
        if isinstance(column, SharedColumn):
            for row, cell in _shared(column, begin, middle):
                texts[row][column.index] = cell
            continue
        numbers = column_texts([value for _, value in column.cells])
        pairs = zip(column.cells, numbers, strict=True)
        for row, ((formula, value), number) in enumerate(pairs, column.first_row):
            if not math.isfinite(value):
                finite(value, f"{title}!{letter}{row}")
            text = f"<f>{escaped(formula[1:])}</f>" if formula else ""
            cell = f"{begin}{row}{middle}{text}<v>{number}</v></c>"
            texts[row][column.index] = cell
    for at, text in _bare(bare, title):
        texts[at.row][at.column] = text
    return texts


def _plain_runs(
    columns: Sequence[FilledColumn | SharedColumn],
) -> Iterator[list[SharedColumn]]:
    """Yield columns without a look of their own, those side by side together."""
    run: list[SharedColumn] = []
    for column in columns:
        if not (isinstance(column, SharedColumn) and column.is_plain):
            continue
        if run and (column.index, column.first_row) != (run[-1].index + 1, run[0].first_row):
            yield run
            run = []
        run.append(column)
    if run:
        yield run


def _side_by_side(run: Sequence[SharedColumn]) -> Iterator[tuple[int, str]]:
    """Yield rows and their cells, a whole row from one pattern."""
    first = run[0].first_row
    begins = [f'<c r="{get_column_letter(column.index)}{_ROW}">' for column in run]
    formulas = (
        [_master(column).replace("%", "%%") for column in run],
        [f'<f t="shared" si="{column.index}"/>' for column in run],
    )
    top, others = (
        "".join(f"{begin}{text}<v>%s</v></c>" for begin, text in zip(begins, each, strict=True))
        for each in formulas
    )
    rows = zip(*(column.numbers for column in run), strict=True)
    for row, numbers in enumerate(rows, first):
        yield row, (top if row == first else others).replace(_ROW, str(row)) % numbers


def _master(column: SharedColumn) -> str:
    """Return the formula of all cells of a column, for its first."""
    letter, first = get_column_letter(column.index), column.first_row
    extent = f"{letter}{first}:{letter}{first + len(column.numbers) - 1}"
    text = escaped(column.formula[1:])
    return f'<f t="shared" ref="{extent}" si="{column.index}">{text}</f>'


def _shared(column: SharedColumn, begin: str, middle: str) -> Iterator[tuple[int, str]]:
    """Yield rows and cells of a column; the first cell says the formula of all."""
    first = column.first_row
    yield first, f"{begin}{first}{middle}{_master(column)}<v>{column.numbers[0]}</v></c>"
    middle += f'<f t="shared" si="{column.index}"/><v>'
    for row, number in enumerate(column.numbers[1:], first + 1):
        yield row, f"{begin}{row}{middle}{number}</v></c>"


def _bare(cells: Sequence[BareCell], title: str) -> Iterator[tuple[BareCell, str]]:
    """Yield cells without a look; those one below the other that have one formula share it."""
    in_order = sorted(cells, key=lambda cell: (cell.column, cell.row))
    runs = groupby(enumerate(in_order), lambda pair: (pair[1].column, pair[1].row - pair[0],
                                                      _alike(pair[1])))  # fmt: skip
    for key, run in enumerate(run for _, run in runs):
        group = [cell for _, cell in run]
        letter, first = get_column_letter(group[0].column), group[0].row
        is_shared = len(group) >= _SEVERAL and bool(group[0].formula)
        extent = f"{letter}{first}:{letter}{first + len(group) - 1}"
        for number, cell in enumerate(group):
            text = f"<f>{escaped(cell.formula[1:])}</f>" if cell.formula else ""
            if is_shared:
                text = text[3:] if not number else ""
                about = f' ref="{extent}"' if not number else ""
                text = f'<f t="shared"{about} si="{key}"' + (f">{text}" if text else "/>")
            yield cell, _bare_text(cell, f"{letter}{cell.row}", text, title)


def _alike(cell: BareCell) -> str:
    """Return what cells of one shared formula have alike: the formula without its own row."""
    row = str(cell.row)
    return _REFERENCE.sub(
        lambda match: match[1] + _ROW if match[2] == row else match[0], cell.formula
    )


def _bare_text(cell: BareCell, where: str, formula: str, title: str) -> str:
    value = finite(cell.value, f"{title}!{where}")
    if not isinstance(value, str):
        return f'<c r="{where}">{formula}<v>{number_text(value)}</v></c>'
    said = escaped(value)
    if formula:
        return f'<c r="{where}" t="str">{formula}<v>{said}</v></c>'
    space = ' xml:space="preserve"' if value != value.strip() else ""
    said = f"<t{space}>{said}</t>"
    return f'<c r="{where}" t="inlineStr"><is>{said}</is></c>'
