"""Frequencies of torsional vibration of published trains."""

from __future__ import annotations

from functools import lru_cache, partial

import numpy as np

from kshm.mechanics.torsion import Modes, modes_of
from kshm.mechanics.torsional_train import Train, train_of
from reports.validation.gots_text import Number
from reports.validation.runs import solution


@lru_cache(maxsize=1)
def _mwm() -> Modes:
    engine = solution("mwm-6").engine
    if engine.torsion is None:
        raise ValueError("the sample has no train")
    return modes_of(train_of(engine, engine.torsion, 0.0))


def _frequency(number: int) -> float:
    return float(_mwm().hertz[number - 1])


DISCS: dict[str, Number] = {
    "first": lambda: float(modes_of(Train(np.array([211.4, 8.3]), np.array([9.775e6]))).hertz[0]),
}
MWM: dict[str, Number] = {f"f{number}": partial(_frequency, number) for number in range(1, 9)}
