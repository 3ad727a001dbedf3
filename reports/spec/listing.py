"""Columns and scalars as a book lists them: a line a value.

``key of quantity = formula | source``; what is indented deeper continues the line before.  A
key alone is the column of angles, below ``helpers:`` stand the helper columns.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

from reports.spec.blocks import Column, Scalar

_LINE = re.compile(r"(?P<key>\S+)(?: of (?P<of>\S*))?(?: = (?P<expr>.*?)(?: \| (?P<source>.*))?)?")
_HELPERS = "helpers:"


@lru_cache(maxsize=4096)  # the same for all inputs but for the few names put in
def column_list(text: str) -> tuple[Column, ...]:
    """Columns of a table.

    Raises:
        ValueError: a line is no column.
    """
    made: list[Column] = []
    helper = False
    for line in _lines(text):
        if line == _HELPERS:
            helper = True
        else:
            found = _parts(line)
            source, of = found["source"] or "", found["of"] or ""
            made.append(Column(found["key"] or "", found["expr"], source, helper=helper, of=of))
    return tuple(made)


@lru_cache(maxsize=4096)
def scalar_list(text: str) -> tuple[Scalar, ...]:
    """Scalars of a list.

    Raises:
        ValueError: a line is no scalar.
    """
    made = []
    for line in _lines(text):
        found = _parts(line)
        if found["expr"] is None:
            msg = f"a scalar without a formula: {line!r}"
            raise ValueError(msg)
        key, expr = found["key"] or "", found["expr"]
        made.append(Scalar(key, expr, found["source"] or "", of=found["of"] or ""))
    return tuple(made)


def _lines(text: str) -> Iterator[str]:
    given = [line for line in text.splitlines() if line.strip()]
    indent = min(len(line) - len(line.lstrip()) for line in given)
    whole: list[str] = []
    for line in given:
        if line[indent] == " ":
            whole[-1] += " " + line.strip()
        else:
            whole.append(line.strip())
    yield from whole


def _parts(line: str) -> dict[str, str | None]:
    found = _LINE.fullmatch(line)
    if found is None:
        msg = f"not a line of a listing: {line!r}"
        raise ValueError(msg)
    return found.groupdict()
