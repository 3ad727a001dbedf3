"""Expressions as Excel formulas in the subset that Excel, LibreOffice and formualizer share."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Sequence
from decimal import Decimal
from typing import Protocol

from reports.formula.parse import AGGREGATES, SCALE_FUNCTIONS, SCALES, parse

_FUNCTIONS = {
    "sin": "SIN", "cos": "COS", "tan": "TAN", "asin": "ASIN", "acos": "ACOS", "sqrt": "SQRT",
    "exp": "EXP", "ln": "LN", "abs": "ABS", "floor": "INT", "mod": "MOD", "min": "MIN",
    "max": "MAX", "total": "SUM", "rad": "RADIANS", "deg": "DEGREES",
}  # fmt: skip
_PRECEDENCE: dict[type[ast.AST], tuple[str, int]] = {
    ast.Lt: ("<", 1), ast.LtE: ("<=", 1), ast.Gt: (">", 1), ast.GtE: (">=", 1),
    ast.Eq: ("=", 1), ast.NotEq: ("<>", 1),
    ast.Add: ("+", 2), ast.Sub: ("-", 2), ast.Mult: ("*", 3), ast.Div: ("/", 3), ast.Pow: ("^", 5),
}  # fmt: skip
_ATOM = 9
_ROWS = re.compile(r"\$(\d+):\$[A-Z]+\$(\d+)$")  # first and last of a range
_ONE_CELL = re.compile(r"(\$[A-Z]+\$\d+):\1$")


class References(Protocol):
    """What the compiler asks of the layout: references as text."""

    def name(self, key: str) -> str:
        """Return reference to a scalar or to this row's cell of a column."""

    def column(self, key: str, *, repeat_last: bool) -> str:
        """Range of a whole column; without the repeated last row unless asked for."""

    def last(self, key: str) -> str:
        """Return reference to the last cell of a column."""

    def following(self, key: str) -> str:
        """Return reference to the next row's cell of a column; in the last row to its own."""

    def previous(self, key: str) -> str:
        """Return reference to the cell of a column in the row above."""

    def down_to_here(self, key: str) -> str:
        """Range of a column from its first row down to this one."""

    def each(self, key: str) -> Sequence[str]:
        """All cells of a run, one by one."""

    def wave(self, turn: str, angle: str, order: float | str) -> str:
        """Range of ``cos`` or ``sin`` of an order times an angle column, but its last row.

        ``order`` is a number or the key of the table's first column.
        """

    def run_wave(self, turn: str, angles: str, order: float | str) -> str:
        """Return the same for the angles of a run, all of them."""


def number(value: float | str) -> str:
    """Return a literal in a formula."""
    if isinstance(value, str):
        return '"' + value.replace('"', '""') + '"'
    if float(value).is_integer() and abs(value) < 1e15:
        return str(int(value))
    return f"{Decimal(repr(float(value))):f}"  # an exponent is no number to every parser


def compile_formula(text: str, refs: References) -> str:
    """Excel formula with its leading ``=``."""
    return "=" + _emit(parse(text), refs)[0]


def _emit(node: ast.expr, refs: References) -> tuple[str, int]:
    """Text and the precedence of its outermost operator."""
    match node:
        case ast.Constant(value=value):
            return number(value), _ATOM  # type: ignore[arg-type]
        case ast.Name(id="pi"):
            return "PI()", _ATOM
        case ast.Name(id=name):
            return refs.name(name), _ATOM
        case ast.Attribute(value=ast.Name(id=table), attr=column):
            return refs.name(f"{table}.{column}"), _ATOM
        case ast.BinOp(left=left, op=op, right=right):
            return _binary(left, type(op), right, refs)
        case ast.Compare(left=left, ops=[op], comparators=[right]):
            return _binary(left, type(op), right, refs)
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return f"NOT({_emit(operand, refs)[0]})", _ATOM
        case ast.UnaryOp(operand=operand):
            # In Excel the sign binds tighter than ^ and *, and one engine misreads -(A*B).
            text, precedence = _emit(operand, refs)
            if precedence == _ATOM:
                return f"-{text}", 4
            return f"0-{_wrapped(operand, 3, refs)}", 2
        case ast.BoolOp(op=op, values=values):
            parts = ",".join(_emit(value, refs)[0] for value in values)
            return f"{'AND' if isinstance(op, ast.And) else 'OR'}({parts})", _ATOM
        case ast.IfExp(test=test, body=body, orelse=orelse):
            parts = ",".join(_emit(part, refs)[0] for part in (test, body, orelse))
            return f"IF({parts})", _ATOM
        case ast.Call(func=ast.Name(id=name), args=args):
            return _call(name, args, refs)
    raise AssertionError(f"unexpected node {ast.dump(node)}")


def _wrapped(node: ast.expr, least: int, refs: References) -> str:
    text, precedence = _emit(node, refs)
    return text if precedence >= least else f"({text})"


def _binary(
    left: ast.expr, op: type[ast.AST], right: ast.expr, refs: References
) -> tuple[str, int]:
    sign, precedence = _PRECEDENCE[op]
    # Everything is left-associative in Excel, ^ included, and -x^2 is (-x)^2 there.
    # A comparison of comparisons keeps its brackets: not all programs read it from the left.
    inner = _ATOM if op is ast.Pow else max(precedence, 2)
    first = _wrapped(left, inner, refs)
    second = _wrapped(right, precedence + 1, refs)
    if second.startswith("-"):
        second = f"({second})"
    return f"{first}{sign}{second}", precedence


def _call(name: str, args: list[ast.expr], refs: References) -> tuple[str, int]:
    if name in SCALE_FUNCTIONS:
        way, unit = name.split("_", 1)
        factor = SCALES[unit] if way == "of" else 1 / SCALES[unit]
        # Multiply or divide by a whole number: 0.001 is not exact, 1000 is.
        sign, value = ("*", factor) if factor >= 1 else ("/", round(1 / factor))
        return f"{_wrapped(args[0], 3, refs)}{sign}{number(value)}", 3
    if name in AGGREGATES:
        return _aggregate(name, args[0], refs), _ATOM
    if name == "following":
        return refs.following(_key(args[0])), _ATOM
    if name == "previous":
        return refs.previous(_key(args[0])), _ATOM
    if name == "running_sum":
        return f"SUM({refs.down_to_here(_key(args[0]))})", _ATOM
    if name in ("fourier_cos", "fourier_sin"):
        return _fourier(name, args, refs), 3
    if name in ("wave_cos", "wave_sin"):
        return _wave(name, args, refs), _ATOM
    if name == "first_largest":
        run = refs.column(_key(args[0]), repeat_last=True)
        return f"MATCH(MAX({run}),{run},0)", _ATOM
    if name == "run_sum":
        return f"SUM({refs.column(_key(args[0]), repeat_last=True)})", _ATOM
    if name == "place":
        body = refs.column(_key(args[1]), repeat_last=False)
        return f"MATCH({_emit(args[0], refs)[0]},{body},1)", _ATOM
    if name == "rank":
        than = _wrapped(args[0], 2, refs)
        return "+".join(["1", *(f"({one}<{than})*1" for one in refs.each(_key(args[1])))]), 2
    if name == "round":
        decimals = _emit(args[1], refs)[0] if args[1:] else "0"
        return f"ROUND({_emit(args[0], refs)[0]},{decimals})", _ATOM
    if name == "round_up":
        return f"ROUNDUP({_emit(args[0], refs)[0]},0)", _ATOM
    if name == "atan2":
        # Excel takes (x, y) where everybody else takes (y, x).
        y, x = (_emit(arg, refs)[0] for arg in args)
        return f"ATAN2({x},{y})", _ATOM
    if name == "element":
        run = refs.column(_key(args[0]), repeat_last=True)
        return _index(run, _emit(args[1], refs)[0]), _ATOM
    return f"{_FUNCTIONS[name]}({','.join(_emit(arg, refs)[0] for arg in args)})", _ATOM


def _index(run: str, position: str) -> str:
    """Cell of a range by its number; of a row with the row named, which not all programs guess.

    A range of one cell is no range to Gnumeric.
    """
    if one := _ONE_CELL.search(run):
        return f"CHOOSE({position},{run[: one.start()]}{one[1]})"
    rows = _ROWS.search(run)
    return f"INDEX({run},{'1,' if rows and rows[1] == rows[2] else ''}{position})"


def _key(node: ast.expr) -> str:
    match node:
        case ast.Name(id=name):
            return name
        case ast.Attribute(value=ast.Name(id=table), attr=column):
            return f"{table}.{column}"
    raise TypeError("a whole-column function takes a column")


def _aggregate(name: str, node: ast.expr, refs: References) -> str:
    key = _key(node)
    functions: dict[str, Callable[[], str]] = {
        "col_max": lambda: f"MAX({refs.column(key, repeat_last=True)})",
        "col_min": lambda: f"MIN({refs.column(key, repeat_last=True)})",
        "col_mean": lambda: f"AVERAGE({refs.column(key, repeat_last=False)})",
        "col_sum": lambda: f"SUM({refs.column(key, repeat_last=False)})",
        "col_last": lambda: refs.last(key),
    }
    return functions[name]()


def _fourier(name: str, args: list[ast.expr], refs: References) -> str:
    """Fourier coefficient of a column over an angle in degrees, without the repeated last row."""
    # No function over a range: Gnumeric wants such a cell to be an array formula, and LibreOffice
    # loads those dirty: at the first edit what depends on them keeps its old values.
    values = refs.column(_key(args[0]), repeat_last=False)
    wave = refs.wave(name.removeprefix("fourier_"), _key(args[1]), _order(args[2]))
    return f"2*SUMPRODUCT({values},{wave})/COUNT({values})"


def _wave(name: str, args: list[ast.expr], refs: References) -> str:
    """Waves, weighted or not, over all of a run."""
    *weights, angles = map(_key, args[:-1])
    waves = refs.run_wave(name.removeprefix("wave_"), angles, _order(args[-1]))
    if not weights:
        return f"SUM({waves})"
    return f"SUMPRODUCT({refs.column(weights[0], repeat_last=True)},{waves})"


def _order(node: ast.expr) -> float | str:
    """Return a number, or the key of a column of orders."""
    return float(node.value) if isinstance(node, ast.Constant) else _key(node)  # type: ignore[arg-type]
