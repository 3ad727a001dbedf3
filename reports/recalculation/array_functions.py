"""Functions that formualizer lacks over arrays or computes wrongly."""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable, Iterable
from decimal import ROUND_DOWN, ROUND_HALF_UP, Decimal
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from formualizer import Workbook

# Unit → kind and size: what CONVERT is known to turn into each other.
UNITS = {
    "mm": ("length", 1e-3), "cm": ("length", 1e-2), "m": ("length", 1.0), "km": ("length", 1e3),
    "g": ("mass", 1e-3), "kg": ("mass", 1.0),
    "rad": ("angle", 1.0), "deg": ("angle", math.pi / 180),
}  # fmt: skip
_COUNTS: dict[int, Callable[[list[float]], float]] = {
    1: statistics.fmean, 2: len, 4: max, 5: min, 6: math.prod, 7: statistics.stdev,
    8: statistics.pstdev, 9: math.fsum, 10: statistics.variance, 11: statistics.pvariance,
    12: statistics.median,
}  # fmt: skip


def _decimal(value: float, digits: float = 0.0, *, rounding: str) -> float:
    # A spreadsheet rounds the decimal number that it shows, halves away from zero.
    unit = Decimal(1).scaleb(-int(digits))
    return float((Decimal(f"{value:.15g}") / unit).quantize(Decimal(1), rounding) * unit)


def _log(value: float, base: float = 10.0) -> float:
    return math.log(value, base) if base != 1 else math.nan


def _sign(value: float) -> float:
    return float((value > 0) - (value < 0))


def _mod(value: float, divisor: float) -> float:
    return value - divisor * math.floor(value / divisor)


def _ceiling(value: float, step: float = 1.0) -> float:
    if value > 0 > step:
        raise ValueError
    return step * math.ceil(value / step) if step else 0.0


def _floor(value: float, step: float = 1.0) -> float:
    if value > 0 > step:
        raise ValueError
    return step * math.floor(value / step)


_FUNCTIONS: dict[str, tuple[Callable[..., Any], int, int]] = {
    "RADIANS": (math.radians, 1, 1), "DEGREES": (math.degrees, 1, 1), "ABS": (abs, 1, 1),
    "SQRT": (math.sqrt, 1, 1), "ASIN": (math.asin, 1, 1), "ACOS": (math.acos, 1, 1),
    "ATAN": (math.atan, 1, 1), "EXP": (math.exp, 1, 1), "LN": (math.log, 1, 1),
    "LOG": (_log, 1, 2), "LOG10": (math.log10, 1, 1), "INT": (math.floor, 1, 1),
    "TRUNC": (partial(_decimal, rounding=ROUND_DOWN), 1, 2), "SIGN": (_sign, 1, 1),
    "ROUND": (partial(_decimal, rounding=ROUND_HALF_UP), 2, 2),
    "POWER": (math.pow, 2, 2), "MOD": (_mod, 2, 2), "NOT": (lambda value: not value, 1, 1),
    "CEILING": (_ceiling, 1, 2), "FLOOR": (_floor, 1, 2),
}  # fmt: skip


def _convert(value: Any, unit: Any, other: Any) -> Any:  # noqa: ANN401
    (kind, size), (target_kind, into) = (UNITS.get(name, (name, 0.0)) for name in (unit, other))
    if kind != target_kind or not into:
        return {"type": "Error", "kind": "Na"}
    return _one(lambda number: number * size / into, [value])


def _aggregate(code: float, option: float, block: Any) -> Any:  # noqa: ANN401
    """AGGREGATE of the options that hidden rows do not matter to: 4 and 6."""
    cells = [cell for line in block for cell in line] if isinstance(block, list) else [block]
    errors = [cell for cell in cells if isinstance(cell, dict)]
    if errors and option == 4:
        return errors[0]
    numbers = [float(c) for c in cells if isinstance(c, (int, float)) and not isinstance(c, bool)]
    try:
        return float(_COUNTS[int(code)](numbers))
    except (KeyError, ValueError, statistics.StatisticsError):
        return {"type": "Error", "kind": "Value"}


def _matrix(block: Any) -> NDArray[np.float64]:  # noqa: ANN401
    """Return the numbers of a rectangle; ValueError where a cell is blank or holds a text."""
    lines = block if isinstance(block, list) else [[block]]
    if any(isinstance(c, bool) or not isinstance(c, (int, float)) for line in lines for c in line):
        raise ValueError
    return np.array(lines, dtype=float)


def _of_matrices(function: Callable[..., Any], *blocks: Any) -> Any:  # noqa: ANN401
    try:
        result = np.asarray(function(*map(_matrix, blocks)))
    except np.linalg.LinAlgError:  # of a singular matrix
        return {"type": "Error", "kind": "Num"}
    except ValueError:
        return {"type": "Error", "kind": "Value"}
    return result.tolist()


# Functions of texts and rectangles, called as they are, and how many arguments they take.
_WHOLE: dict[str, tuple[Callable[..., Any], int]] = {
    "CONVERT": (_convert, 3), "AGGREGATE": (_aggregate, 3),
    "MMULT": (partial(_of_matrices, np.matmul), 2),
    "MDETERM": (partial(_of_matrices, np.linalg.det), 1),
    "MINVERSE": (partial(_of_matrices, np.linalg.inv), 1),
}  # fmt: skip
# Of negative numbers, of angles, of ranges.
WRONG = frozenset(("CEILING", "FLOOR", *_WHOLE))
NOT_LIFTED = frozenset((*_FUNCTIONS, "MMULT", "MDETERM", "MINVERSE"))


def register(book: Workbook, names: Iterable[str]) -> None:
    """Register the functions in place of formualizer's own; errors keep their kind."""
    for name in names:
        if name in _WHOLE:
            whole, count = _WHOLE[name]
            book.register_function(
                name, whole, min_args=count, max_args=count, allow_override_builtin=True
            )
            continue
        function, least, most = _FUNCTIONS[name]
        book.register_function(
            name, _over_rectangles(function), min_args=least, max_args=most,
            allow_override_builtin=True,
        )  # fmt: skip


def _over_rectangles(function: Callable[..., Any]) -> Callable[..., Any]:
    def call(*args: Any) -> Any:  # noqa: ANN401
        blocks = [arg for arg in args if isinstance(arg, list)]
        if not blocks:
            return _one(function, args)
        height = max(len(block) for block in blocks)
        width = max(len(block[0]) for block in blocks)
        return [
            [_one(function, [_at(arg, i, j) for arg in args]) for j in range(width)]
            for i in range(height)
        ]

    return call


def _at(arg: Any, row: int, column: int) -> Any:  # noqa: ANN401
    """Element of a block, whose only row or column stands for all."""
    if not isinstance(arg, list):
        return arg
    line = arg[row if len(arg) > 1 else 0] if row < len(arg) or len(arg) == 1 else []
    if len(line) == 1:
        return line[0]
    return line[column] if column < len(line) else {"type": "Error", "kind": "Na"}


def _one(function: Callable[..., Any], args: Iterable[Any]) -> Any:  # noqa: ANN401
    numbers = []
    for arg in args:
        if isinstance(arg, dict):
            return arg
        try:
            numbers.append(float(arg or 0.0))
        except (TypeError, ValueError):
            return {"type": "Error", "kind": "Value"}
    try:
        result = function(*numbers)
        return result if math.isfinite(result) else {"type": "Error", "kind": "Num"}
    except ZeroDivisionError:
        return {"type": "Error", "kind": "Div"}
    except (ValueError, OverflowError, ArithmeticError):
        return {"type": "Error", "kind": "Num"}
