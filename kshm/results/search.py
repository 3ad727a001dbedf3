"""The value of an input that makes a result, and the inputs of the least result.

The methods are scipy's, an optional package: ``pip install "kshm[optimise]"``.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from kshm.arrays import Array
from kshm.engine.checks import check_kind, refuse
from kshm.engine.engine import Engine
from kshm.engine.revised import engine_maker
from kshm.errors import InputError, KshmError, Problem
from kshm.results.study import Row, Study

MAX_NAMES = 3
_TOLERANCE = 1e-10  # of an input, over its range
_PEOPLE, _GENERATIONS, _SEED = 12, 60, 1  # of each input; the same study gives the same numbers
_SCAN = 33  # values at which a result is tried before its roots are sought


@dataclass(frozen=True, slots=True)
class Optimum:
    """What was sought.

    Attributes:
        values: the inputs by name, in their units.
        result: the quantity there, in its unit.
        engine: the engine with these values.
        solved: how many engines were solved for it.

    >>> Optimum({"bore_mm": 90.0}, 2.0, None, 7).values
    {'bore_mm': 90.0}
    """

    values: dict[str, float]
    result: float
    engine: Any
    solved: int


def solve_for(
    engine: Engine, name: str, quantity: str, value: float, *, between: tuple[float, float]
) -> Optimum:
    """Return the value of one input at which a quantity has a value.

    Args:
        engine: the base.
        name: the input that varies, named as in ``kshm.sweep``, in its unit.
        quantity: key of a scalar, its English name, or a column with its part
            (``P4_1.N_MPa.max``).
        value: of the quantity in its unit.
        between: least and greatest value of the input in its unit; of several solutions the
            least.

    Returns:
        The input, by Brent's method (scipy's ``brentq``), to 10⁻¹⁰ of its range.

    Raises:
        InputError: the quantity does not reach the value between the limits; the text says what
            it reaches.
        KshmError: scipy is not installed.

    With ``engine`` as in the example of ``kshm.in_line``:

    >>> found = solve_for(engine, "speed_rpm", "kinematics.mean_piston_speed", 10,
    ...                   between=(1000, 6000))
    >>> round(found.values["speed_rpm"], 6)  # 30 · 10 m/s over a stroke of 0.08 m
    3750.0
    """
    optimize = _scipy()
    low, high = _limits(name, between)
    check_kind("value", value, float)
    refuse((not math.isfinite(value), f"value: must be a finite number, not {value}"))
    search = _QuantitySearch(engine, (name,), quantity)
    inputs = np.linspace(low, high, _SCAN)
    results = search.results([(each,) for each in inputs.tolist()])
    off = results - value
    crossing = np.flatnonzero(off[:-1] * off[1:] <= 0)
    if not crossing.size:
        raise search.unreached(value, results)
    first = int(crossing[0])
    root = inputs[first] if off[first] == 0 else optimize.brentq(
        lambda each: float(search.results([(float(each),)])[0]) - value,
        inputs[first], inputs[first + 1], xtol=_TOLERANCE * (high - low),
    )  # fmt: skip
    return search.optimum((float(root),))


def optimise(
    engine: Engine,
    vary: Mapping[str, tuple[float, float]],
    quantity: str,
    *,
    most: bool = False,
) -> Optimum:
    """Return the values of one to three inputs at which a quantity is least.

    Args:
        engine: the base.
        vary: least and greatest value of each input in its unit, by name as in ``kshm.sweep``.
        quantity: as in ``solve_for``.
        most: the greatest in place of the least.

    Returns:
        The inputs: by scipy's ``differential_evolution``, a generation solved at once, then by
        its ``minimize`` (Nelder-Mead) within the limits.  An engine that is refused loses.

    Raises:
        InputError: a name that there is not, limits that are none, no engine that is solved.
        KshmError: scipy is not installed.

    With ``engine`` as in the example of ``kshm.in_line``:

    >>> best = optimise(engine, {"speed_rpm": (1000, 6000)}, "kinematics.mean_piston_speed")
    >>> round(best.values["speed_rpm"])
    1000
    """
    optimize = _scipy()
    check_kind("vary", vary, Mapping)
    refuse(
        (not 1 <= len(vary) <= MAX_NAMES, f"vary: from 1 to {MAX_NAMES} inputs, not {len(vary)}")
    )
    limits = [_limits(name, between) for name, between in vary.items()]
    search, sign = _QuantitySearch(engine, tuple(vary), quantity), -1.0 if most else 1.0

    def cost(points: Array) -> Array:  # shape (inputs,) or (inputs, points)
        results = search.results([tuple(row) for row in np.atleast_2d(points.T).tolist()])
        return np.where(np.isfinite(results), sign * results, np.inf)

    wide = optimize.differential_evolution(
        cost, limits, popsize=_PEOPLE, maxiter=_GENERATIONS, rng=_SEED, tol=1e-8, polish=False,
        vectorized=True, updating="deferred",
    )  # fmt: skip
    if not math.isfinite(wide.fun):
        raise search.refused()
    fine = optimize.minimize(
        lambda point: float(cost(np.asarray(point))[0]), wide.x, method="Nelder-Mead",
        bounds=limits, options={"xatol": 1e-9, "fatol": 1e-13, "maxiter": 400},
    )  # fmt: skip
    best = fine.x if fine.fun <= wide.fun else wide.x
    return search.optimum(tuple(map(float, best)))


def _limits(name: str, between: Collection[float]) -> tuple[float, float]:
    check_kind("limits", between, Collection[float])
    numbers = [float(each) for each in between]
    if len(numbers) != 2 or not all(map(math.isfinite, numbers)) or numbers[0] >= numbers[1]:
        problem = f"limits must be two numbers that rise, not {between!r}"
        raise InputError(Problem(str(name), problem, "e.g. (80, 95)", value=between))
    return numbers[0], numbers[1]


class _QuantitySearch:
    """One quantity of engines that differ in a few numbers."""

    def __init__(self, engine: Engine, names: tuple[str, ...], quantity: str) -> None:
        check_kind("quantity", quantity, str)
        key, dot, _ = quantity.rpartition(".")
        is_part = bool(dot) and "." in key
        self.study = Study.of(engine, names, [key if is_part else quantity])
        chosen = self.study.chosen.names
        self.name = quantity if is_part else chosen[0]
        refuse(
            (self.name not in chosen, f"{quantity}: the parts of a column are {', '.join(chosen)}"),
            (not is_part and len(chosen) > 1, f"{quantity}: name one of {', '.join(chosen)}"),
        )
        self._make = engine_maker(engine, names)
        self.solved = 0
        self._reason = ""

    def results(self, rows: list[Row]) -> Array:
        """Return the quantity of each row, NaN where an engine is refused, shape (rows,)."""
        solved = self.study.solve(rows, self._make)
        self.solved += len(rows)
        self._reason = next(filter(None, solved.errors), self._reason)
        return solved.values[self.name]

    def optimum(self, row: Row) -> Optimum:
        result = float(self.results([row])[0])
        values = dict(zip(self.study.names, row, strict=True))
        return Optimum(values, result, self.study.engine.with_(values), self.solved)

    def unreached(self, value: float, results: Array) -> InputError:
        finite = results[np.isfinite(results)]
        if not finite.size:
            return self.refused()
        limits = float(finite.min()), float(finite.max())
        problem = f"does not reach {value:g} between these limits"
        hint = f"it goes from {limits[0]:.6g} to {limits[1]:.6g}"
        return InputError(Problem(self.name, problem, hint, limits, value))

    def refused(self) -> InputError:
        return InputError(Problem("", f"no engine within the limits is solved: {self._reason}"))


def _scipy() -> Any:  # noqa: ANN401
    try:
        from scipy import optimize
    except ImportError:
        raise KshmError('this needs scipy: pip install "kshm[optimise]"') from None
    return optimize
