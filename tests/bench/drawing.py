"""The sheet's drawings: what it gains to ask only lines near a text whether they cut it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from unittest import mock

from reports.drawing import primitives
from reports.sheet.layout import sheet_items
from tests.bench._figure import Figure, interleaved, median, ratio
from tests.sheet.sheet_samples import terms

_SAMPLES = ("gots-diesel", "two-stroke", "yamz-236")


def figures() -> Iterator[Figure]:
    """Figures."""
    sheets = [terms(name) for name in _SAMPLES]

    def near() -> list[object]:
        return [sheet_items(sheet) for sheet in sheets]

    def all_lines() -> list[object]:
        with mock.patch.object(primitives, "_NEAR", math.inf):
            return near()

    assert near() == all_lines()
    times = interleaved({"near": near, "all": all_lines}, rounds=5)
    yield Figure("листов", len(sheets))
    yield Figure("чертежи листов: процессор", median(times["near"]), "с")
    gained = ratio(times, "near", "all")
    yield Figure("линии у надписи / все линии: процессор", gained, "раз")
