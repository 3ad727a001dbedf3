"""Sheets of a class that differ in nothing but values: parsed once, filled in after that.

A sheet whose text is equal to a known one but for the contents of its ``<v>`` elements has the
same formulas in the same cells, so that only its values are read.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from hashlib import blake2b
from itertools import count
from math import isfinite, nan

from reports.recalculation.grid import MAX_CELLS, Column, Constant, Grid, Run

_VALUE = re.compile(rb"<v>([^<]+)</v>")
_UTF8 = re.compile(rb"\s*(<\?xml[^>]*encoding=[\"'](?i:utf-8)[\"'][^>]*\?>|<(?!\?))")
_DIGITS = b"0123456789+-.eE"  # of numbers as programs save them
_KEPT = 400  # a class of thirty has some twenty

Slot = tuple[int, int, str, bool, str]  # row, column, kind and text of a value, of a formula or not
Parser = Callable[[Grid, str, bytes, list[str]], list[Slot]]


def value_of(kind: str, text: str | None, strings: list[str]) -> Constant | None:
    """Value of a cell as a number, a text or a flag; ``ValueError`` where it is none."""
    if not text:
        return None
    if kind == "n":
        number = float(text)
        if not isfinite(number) or "_" in text:
            raise ValueError
        return number
    if kind == "s":
        number = int(text)
        return strings[number] if number >= 0 else None
    return text.strip() == "1" if kind == "b" else text


@dataclass(frozen=True, slots=True)
class _Part:
    """A column of a form, and which of the sheet's values stand where."""

    column: Column  # with the texts that stand in cells themselves, without values
    saved: tuple[int, ...]  # numbers of the values, -1 where none is a number
    constants: tuple[tuple[int, int, str], ...]  # row, number of the value, kind
    errors: tuple[tuple[int, int], ...]


@dataclass
class Forms:
    """The forms that are known; of too many the oldest is forgotten."""

    _known: dict[tuple[str, bytes], tuple[dict[int, _Part], int] | None] = field(
        default_factory=dict  # None where it was seen once
    )

    def fill(self, grid: Grid, title: str, data: bytes, strings: list[str]) -> bool:
        """Put a sheet of a known form into a grid; False where it must be parsed."""
        form = self._known.get(_key(title, data))
        if form is None or grid.cells + form[1] > MAX_CELLS:
            return False
        parts, cells = form
        texts = _VALUE.findall(data)
        try:
            columns = {number: _filled(part, texts, strings) for number, part in parts.items()}
        except (ValueError, IndexError):  # the parser says what is wrong
            return False
        grid.sheets[title].update(columns)
        grid.cells += cells
        return True

    def learn(self, grid: Grid, title: str, data: bytes, cells: int, parse: Parser) -> None:
        """Keep the form of a sheet that was just parsed, when it has come for the second time."""
        key = _key(title, data)
        while len(self._known) >= _KEPT:
            self._known.pop(next(iter(self._known)))
        if key not in self._known:
            self._known[key] = None
            return
        columns = grid.sheets[title]
        plain = not any(run.array for column in columns.values() for run in column.runs)
        once = cells == sum(len(c.saved) + len(c.constants) + len(c.errors)
                            for c in columns.values())  # fmt: skip
        if not (plain and once and _UTF8.match(data)):
            return
        # Each value's number in its place shows which value the parser finds in which cell:
        # one that is written in another manner, or in a comment, would shift them.
        numbers = count()
        probe = _VALUE.sub(lambda _: b"<v>%d</v>" % next(numbers), data)
        many = next(numbers)
        slots = parse(Grid(sheets={title: {}}), title, probe, [""] * many)
        if [slot[-1] for slot in slots] != [str(k) for k in range(many)] or not columns.keys() >= {
            slot[1] for slot in slots
        }:
            return
        of_column: dict[int, list[tuple[int, Slot]]] = {number: [] for number in columns}
        for index, slot in enumerate(slots):
            of_column[slot[1]].append((index, slot))
        parts = {number: _part(columns[number], found) for number, found in of_column.items()}
        self._known[key] = (parts, cells)


def _key(title: str, data: bytes) -> tuple[str, bytes]:
    return title, blake2b(_VALUE.sub(b"<v/>", data)).digest()


def _part(column: Column, slots: list[tuple[int, Slot]]) -> _Part:
    numbers = {row: k for k, (row, _, kind, formula, _) in slots if formula and kind == "n"}
    typed = [(row, k, kind) for k, (row, _, kind, formula, _) in slots if not formula]
    constants = tuple(entry for entry in typed if entry[2] != "e")
    errors = tuple((row, k) for row, k, kind in typed if kind == "e")
    own = {row: v for row, v in column.constants.items() if row not in {c[0] for c in constants}}
    form = Column(own, {}, [replace(run) for run in column.runs], list(column.saved_rows))
    return _Part(form, tuple(numbers.get(r, -1) for r in column.saved_rows), constants, errors)


def _filled(part: _Part, texts: list[bytes], strings: list[str]) -> Column:
    """A column with the values of another book.

    Raises:
        ValueError: a value that is none, or is not written plainly.
        IndexError: no such string.
    """
    form = part.column
    saved = [float(texts[k]) if k >= 0 else nan for k in part.saved]
    plain = b"".join([texts[k] for k in part.saved if k >= 0])
    if plain.translate(None, _DIGITS) or float("inf") in map(abs, saved):
        raise ValueError
    made = Column(dict(form.constants), {}, [], list(form.saved_rows), saved)
    made.runs = [Run(r.sheet, r.column, r.first, r.count, r.formula, r.text, r.problem)
                 for r in form.runs]  # fmt: skip
    for row, k, kind in part.constants:
        value = value_of(kind, _text(texts[k]), strings)
        if value is None:
            raise ValueError
        if value != "":
            made.constants[row] = value
    for row, k in part.errors:
        made.errors[row] = _text(texts[k])
    return made


def _text(data: bytes) -> str:
    if b"&" in data:  # an entity is the parser's
        raise ValueError
    return data.decode()
