"""The sheet's drawings: what is gained where few lines are asked whether they cut a text.

Only lines and pieces of them near a text are asked, and a line finds its bounds once.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from unittest import mock

from reports.draw import canvas
from reports.sheet.write import sheet_items
from tests.bench._figure import Figure, interleaved, median, ratio
from tests.sheet.sheet_samples import terms

_SAMPLES = ("gots-diesel",)


def figures() -> Iterator[Figure]:
    """Figures."""
    sheets = [terms(name) for name in _SAMPLES]

    def near() -> list[object]:
        return [sheet_items(sheet) for sheet in sheets]

    among_all: list[object] = []

    def all_lines() -> list[object]:
        with mock.patch.object(canvas, "_NEAR", math.inf):
            among_all[:] = near()
        return among_all

    def bounds_anew() -> list[object]:
        actual = vars(canvas.Line)["box"].func
        with mock.patch.object(canvas.Line, "box", property(actual)):
            return near()

    times = interleaved({"near": near, "all": all_lines, "anew": bounds_anew}, rounds=2)
    assert near() == among_all == bounds_anew()
    yield Figure("листов", len(sheets))
    yield Figure("чертежи листов: процессор", median(times["near"]), "с")
    gained = ratio(times, "near", "all")
    yield Figure("линии у надписи / все линии: процессор", gained, "раз")
    once = ratio(times, "near", "anew")
    yield Figure("границы линии один раз / каждый раз: процессор", once, "раз")
