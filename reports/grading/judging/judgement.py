"""The verdict on an item, and its words."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Item

Array = NDArray[np.float64]

RIGHT, CARRIED, TYPED, STILL, WRONG, EMPTY, GROUNDLESS, BROKEN, UNKNOWN = (
    "right", "carried", "typed", "still", "wrong", "empty", "groundless", "error", "unknown",
)  # fmt: skip

WORDS = {
    WRONG: "неверно",
    BROKEN: "ошибка в ячейке",
    STILL: "формула не считает",
    GROUNDLESS: "считает по пустым ячейкам",
    EMPTY: "не заполнено",
    TYPED: "число вместо формулы",
    UNKNOWN: "нужна ручная проверка",
    CARRIED: "верно по вашим предыдущим значениям",
    RIGHT: "верно",
}


@dataclass(frozen=True)
class Judgement:
    """A verdict with its evidence; rows are indices into the item's values."""

    item: Item
    verdict: str
    expected: Array
    values: Array
    rows: tuple[int, ...] = ()  # rows that the verdict is about
    typed: tuple[int, ...] = ()  # rows with numbers instead of formulas
    reason: str = ""
    precedents: frozenset[str] = field(default_factory=frozenset)
    origins: tuple[str, ...] = ()  # items that it is carried from
    paid: float = 0.0  # share of the points, before the rubric's share for the verdict
    coarse: bool = False  # rounded more than the book prints
