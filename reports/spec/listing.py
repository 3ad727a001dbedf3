"""Columns and scalars as a book lists them: a line a value.

``key of quantity every degrees = formula | source``; what is indented deeper continues the line
before.  A key alone is the column of angles, below ``helpers:`` stand the helper columns.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import lru_cache

from reports.spec.blocks import TURN, Column, Grid, GridRow, Scalar

_LINE = re.compile(
    r"(?P<key>\S+)(?: of (?P<of>\S*))?(?: every (?P<every>\S+))?"
    r"(?: = (?P<expr>.*?)(?: \| (?P<source>.*))?)?"
)
_HELPERS = "helpers:"


@lru_cache(maxsize=4096)  # the same for all inputs but for the few names put in
def column_list(*texts: str) -> tuple[Column, ...]:
    """Columns of a table from one listing or several.

    Raises:
        ValueError: a line is no column.
    """
    made: list[Column] = []
    helper = False
    for line in _lines(texts):
        if line == _HELPERS:
            helper = True
        else:
            key, of, every, expr, source = _parts(line)
            made.append(Column(key, expr, source, helper=helper, of=of, every=every))
    return tuple(made)


@lru_cache(maxsize=4096)
def scalar_list(*texts: str) -> tuple[Scalar, ...]:
    """Scalars from one listing or several.

    Raises:
        ValueError: a line is no scalar.
    """
    made = []
    for line in _lines(texts):
        key, of, every, expr, source = _parts(line)
        if expr is None:
            raise ValueError(f"a scalar without a formula: {line!r}")
        made.append(Scalar(key, expr, source, of=of, every=every))
    return tuple(made)


def grid_row(
    of: str, texts: Iterable[str | None], source: str, key: str = "{of}{n}", first: int = 1,
    every: str = TURN,
) -> GridRow:  # fmt: skip
    """A quantity of every instance, from number ``first`` on; ``key`` makes the scalars' keys."""
    cells = (
        None if text is None else Scalar(key.format(of=of, n=n), text, source, of=of, every=every)
        for n, text in enumerate(texts, first)
    )
    return GridRow(of, tuple(cells))


def corners(
    grid: str, title: str, sheet: str, box: str, size: str, of: str = "box",
    source: str = "оси диаграммы",
) -> Grid:  # fmt: skip
    """Corners that keep both axes of a diagram equal whatever its values become."""
    row = grid_row(of, (f"-{size}", size), source, box + "{n}")
    return Grid(grid, title, sheet, ("−", "+"), (row,))


def _lines(texts: Iterable[str]) -> Iterator[str]:
    for text in texts:
        given = [line for line in text.splitlines() if line.strip()]
        indent = min(len(line) - len(line.lstrip()) for line in given)
        whole: list[str] = []
        for line in given:
            if line[indent] == " ":
                whole[-1] += " " + line.strip()
            else:
                whole.append(line.strip())
        yield from whole


def _parts(line: str) -> tuple[str, str, str, str | None, str]:
    """Key, quantity, period, formula and source."""
    found = _LINE.fullmatch(line)
    if found is None:
        raise ValueError(f"not a line of a listing: {line!r}")
    every, source = found["every"] or TURN, found["source"] or ""
    return found["key"], found["of"] or "", every, found["expr"], source
