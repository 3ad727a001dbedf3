"""Ranges as a formula writes them: two corners, whole columns or rows, a name."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from reports.recalculation.grid import Grid
from reports.recalculation.language import (
    MAX_COLUMN,
    MAX_ROW,
    Ref,
    Token,
    column_number,
    quoted,
    ref_of,
)


class Range(NamedTuple):
    """The corners of a range and the sheet, which a name tells."""

    first: Ref
    last: Ref
    sheet: tuple[Token, ...] = ()


def area_of(tokens: Sequence[Token], grid: Grid) -> Range | None:
    """The range that some tokens without a sheet are, None where they are none."""
    kinds = [kind for kind, _ in tokens]
    value = tokens[0][1] if tokens else ""
    if kinds == ["ref", "op", "ref"] and tokens[1][1] == ":":
        return Range(ref_of(value), ref_of(tokens[2][1]))
    if kinds == ["columns"]:
        left, right = sorted(map(column_number, value.replace("$", "").split(":")))
        return Range(Ref(1, left), Ref(MAX_ROW, right))
    if kinds == ["rows"]:
        top, bottom = sorted(map(int, value.replace("$", "").split(":")))
        return Range(Ref(top, 1), Ref(bottom, MAX_COLUMN))
    area = grid.areas.get(value.casefold()) if kinds == ["name"] else None
    if area is None:
        return None
    corners = Ref(area.first_row, area.first_column), Ref(area.last_row, area.last_column)
    return Range(*corners, (("sheet", quoted(area.sheet)),))
