"""Names within expressions: the one place that replaces them."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TypeVar

from reports.model.blocks import Block, Column, Grid, Scalar, ScalarTable, TableSpec
from reports.model.charts import ChartSpec

Names = Callable[[str], str]
Kind = TypeVar("Kind", Scalar, Column)
_TOKEN = re.compile(r'"[^"]*"|(?<![\w.])[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)?')


def renamed(expr: str, names: Names) -> str:
    """Return an expression with its names passed through ``names``; texts in quotes stay."""

    def swap(match: re.Match[str]) -> str:
        token = match.group()
        return token if token.startswith('"') else names(token)

    return _TOKEN.sub(swap, expr)


def substituted(blocks: tuple[Block, ...], names: Mapping[str, str]) -> tuple[Block, ...]:
    """Blocks in which each name of ``names`` is replaced by the one that stands in for it."""
    if not names:
        return blocks
    change = _Expressions(lambda name: names.get(name, name), only=tuple(names))
    return tuple(_changed(block, change, change) for block in blocks)


def copied(block: Block, names: Names) -> Block:
    """Return a block under other names: its id, its scalars and all that its formulas name.

    The columns of a table keep their keys.
    """
    keys = {column.key for column in block.columns} if isinstance(block, TableSpec) else set()
    change = _Expressions(lambda name: name if name in keys else names(name))

    def scalar(item: Scalar) -> Scalar:
        return replace(change(item), key=names(item.key), of=item.of or item.key)

    return replace(_changed(block, scalar, change), id=names(block.id))


def sized(blocks: tuple[Block, ...], small: int) -> tuple[Block, ...]:
    """Blocks of an engine of that smallness: its values have more decimals."""

    def sized_block(block: Block) -> Block:
        if isinstance(block, Grid):
            rows = tuple(replace(row, small=small) for row in block.rows)
            block = replace(block, rows=rows)
        return _changed(
            block, lambda item: replace(item, small=small), lambda item: replace(item, small=small)
        )

    return tuple(map(sized_block, blocks)) if small else blocks


def copied_chart(chart: ChartSpec, names: Names) -> ChartSpec:
    """Return a chart of what ``copied`` made of its tables."""
    return replace(
        chart,
        series=tuple(replace(s, x=names(s.x), y=names(s.y)) for s in chart.series),
        levels=tuple(map(names, chart.levels)),
        hole=names(chart.hole),
        contact=tuple(renamed(column, names) for column in chart.contact),
        poles=tuple((symbol, renamed(expr, names)) for symbol, expr in chart.poles),
    )


class _Expressions:
    """Changes the expression of a scalar or column."""

    def __init__(self, names: Names, only: tuple[str, ...] = ("",)) -> None:
        self._names = names
        self._only = only  # no other name is changed

    def __call__(self, item: Kind) -> Kind:
        if item.expr is None or not any(name in item.expr for name in self._only):
            return item
        expr = renamed(item.expr, self._names)
        return item if expr == item.expr else replace(item, expr=expr)  # most name none of them


def _changed(
    block: Block, scalar: Callable[[Scalar], Scalar], column: Callable[[Column], Column]
) -> Block:
    if isinstance(block, TableSpec):
        return replace(block, columns=tuple(map(column, block.columns)))
    if isinstance(block, ScalarTable):
        return replace(block, scalars=tuple(map(scalar, block.scalars)))
    rows = tuple(
        replace(row, cells=tuple(None if cell is None else scalar(cell) for cell in row.cells))
        for row in block.rows
    )
    return replace(block, rows=rows)
