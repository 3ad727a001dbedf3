"""Parsing and checking of expressions against the whitelist."""

from __future__ import annotations

import ast
import re
from functools import lru_cache

from kshm.nomenclature.quantity import UNITS
from reports.formula.mends import mended
from reports.shared.errors import FormulaError

# Row-wise functions and the number of their arguments (least, most).
FUNCTIONS: dict[str, tuple[int, int]] = {
    "sin": (1, 1), "cos": (1, 1), "tan": (1, 1), "asin": (1, 1), "acos": (1, 1),
    "atan2": (2, 2), "sqrt": (1, 1), "exp": (1, 1), "ln": (1, 1), "abs": (1, 1), "floor": (1, 1),
    "round": (1, 2),  # and to how many decimals
    "round_up": (1, 1),  # to a whole number, away from zero
    "mod": (2, 2), "min": (1, 40), "max": (1, 40), "total": (1, 40),
    "rad": (1, 1), "deg": (1, 1),
    "place": (2, 2),  # number of the last of some rising points that is not beyond a value
    "rank": (2, 2),  # place of a value among a run's, the least has 1
    "first_largest": (1, 1),  # its number in a run, from 1
    "run_sum": (1, 1),  # of all values of a run
    "element": (2, 2),  # of a run by its number from 1
    "fourier_cos": (3, 3), "fourier_sin": (3, 3),
    # Sum of cos of (weights,) angles [deg] times an order.
    "wave_cos": (2, 3), "wave_sin": (2, 3),
}  # fmt: skip

# Functions of a whole column; the last row repeats the first angle and is left out of
# means and sums.
AGGREGATES = frozenset({"col_max", "col_min", "col_mean", "col_sum", "col_last"})

# Scale factors between SI and the units of the tables; invisible in printed formulas.
SCALES = {unit: UNITS[unit].si for unit in ("MPa", "kN", "mm", "kW", "dm3")}
SCALE_FUNCTIONS = frozenset(f"{way}_{unit}" for unit in SCALES for way in ("to", "of"))

# Values of the following row of a column (in the last row the row itself), of the row before
# (in the first row there is none: only where a condition keeps it out) and the sum of a column
# from its first row down to this one.
SHIFTS = frozenset({"following", "previous", "running_sum"})

CONSTANTS = frozenset({"pi"})

_OPERATORS = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.Pow)
_COMPARISONS = (ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.Eq, ast.NotEq)


MAX_LETTERS, MAX_DEEP = 8000, 150  # of an expression: longer ones no spreadsheet takes


_COMMA = re.compile(r'^(?:[^"]|"[^"]*")*?(?<![\w.])\d+,\d')  # outside of texts


def is_known_function(name: str) -> bool:
    """Whether ``name`` is a function of the language."""
    return name in FUNCTIONS or name in AGGREGATES | SCALE_FUNCTIONS | SHIFTS


@lru_cache(maxsize=4096)
def parse(text: str) -> ast.expr:
    """Parse and check an expression; bounds on both sides of a value are two comparisons.

    Raises:
        FormulaError: a construct or function outside the language.
    """
    if len(text) > MAX_LETTERS:
        problem = f"an expression of more than {MAX_LETTERS} signs"
        raise FormulaError(problem, text[:40], "разделите формулу")
    try:
        tree = ast.parse(text.strip(), mode="eval").body
    except SyntaxError as error:
        problem = f"not an expression: {text!r} ({error.msg})"
        raise FormulaError(problem, *mended(text, is_known_function)) from error
    except (RecursionError, MemoryError, ValueError):
        raise FormulaError("an expression too deep", text, "разделите формулу") from None
    if _COMMA.search(text):
        raise FormulaError(f"a comma within a number: {text!r}", *mended(text, is_known_function))
    if any(isinstance(node, ast.Compare) and len(node.ops) > 1 for node in ast.walk(tree)):
        tree = _Paired().visit(tree)
    _check(tree, text)
    return tree


class _Paired(ast.NodeTransformer):
    """``a <= x <= b`` as ``a <= x and x <= b``."""

    def visit_Compare(self, node: ast.Compare) -> ast.expr:
        self.generic_visit(node)
        sides = [node.left, *node.comparators]
        pairs: list[ast.expr] = [
            ast.copy_location(ast.Compare(left, [op], [right]), node)
            for left, op, right in zip(sides[:-1], node.ops, sides[1:], strict=True)
        ]
        return (
            pairs[0] if len(pairs) == 1 else ast.copy_location(ast.BoolOp(ast.And(), pairs), node)
        )


def _check(node: ast.expr, text: str, depth: int = 1) -> None:
    if depth >= MAX_DEEP:  # below it the operators
        raise FormulaError(f"an expression deeper than {MAX_DEEP}", text, "разделите формулу")
    children: list[ast.expr] = []
    match node:
        case ast.Constant(value=bool()):
            _refuse(node, text)
        case ast.Constant(value=int() | float() | str()) | ast.Name():
            pass
        case ast.Attribute(value=ast.Name()):
            pass
        case ast.BinOp(op=op) if isinstance(op, _OPERATORS):
            children = [node.left, node.right]
        case ast.UnaryOp(op=ast.USub() | ast.Not()):
            children = [node.operand]
        case ast.Compare(ops=[op]) if isinstance(op, _COMPARISONS):
            children = [node.left, node.comparators[0]]
        case ast.BoolOp():
            children = node.values
        case ast.IfExp():
            children = [node.test, node.body, node.orelse]
        case ast.Call(func=ast.Name(id=name), keywords=[]) if is_known_function(name):
            least, most = FUNCTIONS.get(name, (1, 1))
            if not least <= len(node.args) <= most:
                count = str(least) if least == most else f"от {least} до {most}"
                _refuse(node, text, f"у {name} чисел в скобках {len(node.args)}, а нужно {count}")
            children = node.args
        case _:
            _refuse(node, text)
    for child in children:
        _check(child, text, depth + 1)


def _refuse(node: ast.expr, text: str, mend: str = "") -> None:
    fragment = ast.get_source_segment(text.strip(), node) or ""
    if not mend:
        fragment, mend = mended(fragment, is_known_function)
    problem = f"not allowed in an expression: {ast.unparse(node)!r} in {text!r}"
    raise FormulaError(problem, fragment, mend)


def is_condition(text: str) -> bool:
    """Whether an expression is true or false, and no number.

    Raises:
        FormulaError: it is no expression.
    """
    return _is_condition(parse(text))


def _is_condition(node: ast.expr) -> bool:
    match node:
        case ast.BoolOp(values=parts):
            return all(map(_is_condition, parts))
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return _is_condition(operand)
        case ast.IfExp(test=test, body=body, orelse=orelse):
            return all(map(_is_condition, (test, body, orelse)))
    return isinstance(node, ast.Compare)


def scales(text: str) -> list[str]:
    """Scale functions of an expression in their order, each once."""
    calls = (node.func for node in ast.walk(parse(text)) if isinstance(node, ast.Call))
    named = (func.id for func in calls if isinstance(func, ast.Name))
    return list(dict.fromkeys(name for name in named if name in SCALE_FUNCTIONS))


@lru_cache(maxsize=4096)
def names(text: str) -> frozenset[str]:
    """All names an expression refers to; columns of other tables as ``table.column``."""
    used: set[str] = set()
    stack: list[ast.expr] = [parse(text)]
    while stack:
        node = stack.pop()
        match node:
            case ast.Name(id=name) if name not in CONSTANTS:
                used.add(name)
            case ast.Attribute(value=ast.Name(id=table), attr=column):
                used.add(f"{table}.{column}")
            case ast.Call():
                stack.extend(node.args)
            case _:
                stack.extend(c for c in ast.iter_child_nodes(node) if isinstance(c, ast.expr))
    return frozenset(used)
