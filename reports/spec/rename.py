"""Names within expressions: what a model lacks is replaced by what stands in for it."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial

from reports.spec.blocks import Block, Column, Scalar, ScalarTable, TableSpec

_TOKEN = re.compile(r'"[^"]*"|[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)?')


def renamed(expr: str, names: Callable[[str], str]) -> str:
    """An expression with its names passed through ``names``; texts in quotes stay."""

    def swap(match: re.Match[str]) -> str:
        token = match.group()
        return token if token.startswith('"') else names(token)

    return _TOKEN.sub(swap, expr)


def with_names(block: Block, change: Callable[[str], str]) -> Block:
    """A block with ``change`` applied to every expression."""

    def scalar(item: Scalar) -> Scalar:
        return replace(item, expr=change(item.expr))

    def column(item: Column) -> Column:
        return item if item.expr is None else replace(item, expr=change(item.expr))

    if isinstance(block, TableSpec):
        return replace(block, columns=tuple(map(column, block.columns)))
    if isinstance(block, ScalarTable):
        return replace(block, scalars=tuple(map(scalar, block.scalars)))
    rows = tuple(
        replace(row, cells=tuple(None if c is None else scalar(c) for c in row.cells))
        for row in block.rows
    )
    return replace(block, rows=rows)


def substituted(blocks: tuple[Block, ...], names: Mapping[str, str]) -> tuple[Block, ...]:
    """Blocks in which each name of ``names`` is replaced by the one that stands in for it."""
    if not names:
        return blocks
    change = partial(renamed, names=lambda name: names.get(name, name))
    return tuple(with_names(block, change) for block in blocks)
