"""Inputs of the counterweights that are proposed for the webs; SI units.

A size that is None follows from the rest of the engine.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from kshm.defaults import SKIRT_PLAY, STEEL_DENSITY
from kshm.engine.checks import NOT_NEGATIVE, POSITIVE, check_numbers, refuse

CounterweightGoal = Literal["loads", "residue"]


@dataclass(frozen=True, slots=True)
class Counterweight:
    """A sector on every web: radii and width [m], density [kg/m³], share of the masses taken.

    ``share`` is of the rotating mass of a throw, None for the best of the scan by the ``goal``:
    the least sum of the main journals' loads, or the least moment, else force, of the first
    order that is left.  ``skirt`` is how far the piston reaches below its pin, ``play`` what
    stays between it and the counterweight.
    """

    goal: CounterweightGoal = "loads"
    share: float | None = None
    inner: float | None = None
    outer: float | None = None
    width: float | None = None
    density: float = STEEL_DENSITY
    skirt: float | None = None
    play: float = SKIRT_PLAY

    def __post_init__(self) -> None:
        """Refuse what no sector can be."""
        check_numbers(self, POSITIVE, "inner", "outer", "width", "density", "skirt")
        check_numbers(self, NOT_NEGATIVE, "share", "play")
        inner, outer = self.inner or 0.0, self.outer or math.inf
        refuse((inner >= outer, "a sector's outer radius exceeds its inner one"))
