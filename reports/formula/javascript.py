"""Expressions as JavaScript functions, which call the functions of ``functions.js``."""

from __future__ import annotations

import ast
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from reports.formula.parse import AGGREGATES, SCALE_FUNCTIONS, SCALES, SHIFTS, parse
from reports.shared.errors import FormulaError

LIBRARY = Path(__file__).with_name("functions.js")
_FUNCTIONS = {
    "sin": "Math.sin", "cos": "Math.cos", "tan": "Math.tan", "asin": "Math.asin",
    "acos": "Math.acos", "atan2": "Math.atan2", "sqrt": "Math.sqrt", "exp": "Math.exp",
    "ln": "Math.log", "abs": "Math.abs", "floor": "Math.floor", "min": "Math.min",
    "max": "Math.max", "round": "F.round", "round_up": "F.round_up", "mod": "F.mod",
    "rad": "F.rad", "deg": "F.deg",
}  # fmt: skip
# Which arguments of a function are whole runs: from the first to the one before this.
_RUNS = {
    "rank": (1, 2), "place": (1, 2), "first_largest": (0, 1), "run_sum": (0, 1), "element": (0, 1),
    "fourier_cos": (0, 2), "fourier_sin": (0, 2), "wave_cos": (0, -1), "wave_sin": (0, -1),
}  # fmt: skip
_OPERATORS: dict[type[ast.AST], str] = {
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Lt: "<", ast.LtE: "<=",
    ast.Gt: ">", ast.GtE: ">=", ast.Eq: "===", ast.NotEq: "!==",
}  # fmt: skip
KNOWN = frozenset(_FUNCTIONS) | frozenset(_RUNS) | {"total"} | AGGREGATES | SCALE_FUNCTIONS | SHIFTS


@dataclass(frozen=True, slots=True)
class Script:
    """A function as text and the keys of its arguments in order.

    Of a value it is ``(a0, …) => value``.  Of columns it is ``(n, o0, …, a0, …)``: it fills
    ``n`` rows of the columns ``o0, …``.
    """

    text: str
    names: tuple[str, ...]


def value_script(text: str, key_of: Callable[[str], str]) -> Script:
    """Return function of one value; ``key_of`` gives the key of a name.

    Raises:
        FormulaError: a construct or function outside the language, a column that is no argument
            of a function of columns.
    """
    writer = _Writer(key_of, lambda _: False)
    said = writer.text(parse(text))
    return Script(f"({','.join(writer.marks.values())})=>{said}", tuple(writer.marks))


def columns_script(
    texts: Sequence[str], keys: Sequence[str], key_of: Callable[[str], str],
    is_column: Callable[[str], bool],
) -> Script:  # fmt: skip
    """Return function of columns that are found together, a row at a time, in their order.

    Args:
        texts: their formulas.
        keys: their own keys.
        key_of: gives the key of a name.
        is_column: whether what has a key has one value per row.

    Raises:
        FormulaError: a construct or function outside the language.
    """
    outs = {key: f"o{i}" for i, key in enumerate(keys)}
    writer = _Writer(key_of, is_column, outs)
    lines = [f"o{i}[i]={writer.text(parse(text))};" for i, text in enumerate(texts)]
    head = ",".join(("n", *outs.values(), *writer.marks.values()))
    before = "".join(f"const h{i}={said};" for i, said in enumerate(writer.before))
    loop = f"for(let i=0;i<n;i++){{{''.join(lines)}}}"
    return Script(f"({head})=>{{{before}{loop}}}", tuple(writer.marks))


def gives_text(text: str) -> bool:
    """Whether the value of an expression is a text."""
    node: ast.expr = parse(text)
    while isinstance(node, ast.IfExp):
        node = node.body
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


@dataclass
class _Writer:
    """One function in the making: its arguments, and what it finds once before its rows."""

    key_of: Callable[[str], str]
    is_column: Callable[[str], bool]
    outs: dict[str, str] = field(default_factory=dict)
    marks: dict[str, str] = field(default_factory=dict)
    before: list[str] = field(default_factory=list)

    def text(self, node: ast.expr) -> str:
        """Return a part of an expression; what is no single word stands in brackets."""
        match node:
            case ast.Constant(value=str() as value):
                return json.dumps(value, ensure_ascii=False)
            case ast.Constant(value=value):
                return repr(value)
            case ast.Name(id="pi"):
                return "Math.PI"
            case ast.Name() | ast.Attribute():
                key = self.key_of(_name(node))
                return f"{self.run(node)}[i]" if self.is_column(key) else self.run(node)
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                return f"Math.pow({self.text(left)},{self.text(right)})"
            case ast.BinOp(left=left, op=op, right=right):
                return f"({self.text(left)}{_OPERATORS[type(op)]}{self.text(right)})"
            case ast.Compare(left=left, ops=[op], comparators=[right]):
                return f"({self.text(left)}{_OPERATORS[type(op)]}{self.text(right)})"
            case ast.UnaryOp(op=op, operand=operand):
                return f"({'!' if isinstance(op, ast.Not) else '-'}{self.text(operand)})"
            case ast.BoolOp(op=op, values=values):
                return (
                    f"({('&&' if isinstance(op, ast.And) else '||').join(map(self.text, values))})"
                )
            case ast.IfExp(test=test, body=body, orelse=orelse):
                return f"({self.text(test)}?{self.text(body)}:{self.text(orelse)})"
            case ast.Call(func=ast.Name(id=name), args=args):
                return self.call(name, args)
        raise AssertionError(f"unexpected node {ast.dump(node)}")

    def call(self, name: str, args: list[ast.expr]) -> str:
        """Return a function with its arguments."""
        if name in SCALE_FUNCTIONS:
            way, unit = name.split("_", 1)
            return f"({self.text(args[0])}{'/' if way == 'to' else '*'}{SCALES[unit]!r})"
        if name == "total":
            return f"({'+'.join(map(self.text, args))})"
        if name in SHIFTS:
            return f"F.{name}({self.run(args[0])},i)"
        if name in _FUNCTIONS:
            return f"{_FUNCTIONS[name]}({','.join(map(self.text, args))})"
        first, last = (0, 1) if name in AGGREGATES else _RUNS[name]
        last %= len(args) + (last > 0)
        said = [self.run(arg) if first <= at < last else self.text(arg)
                for at, arg in enumerate(args)]  # fmt: skip
        call = f"F.{name}({','.join(said)})"
        if not self.outs or any("[i]" in each or ",i)" in each for each in said):
            return call
        if call not in self.before:  # the same in every row
            self.before.append(call)
        return f"h{self.before.index(call)}"

    def run(self, node: ast.expr) -> str:
        """Return the variable of a value or of a whole column."""
        key = self.key_of(_name(node))
        return self.outs.get(key) or self.marks.setdefault(key, f"a{len(self.marks)}")


def _name(node: ast.expr) -> str:
    match node:
        case ast.Name(id=name):
            return name
        case ast.Attribute(value=ast.Name(id=table), attr=column):
            return f"{table}.{column}"
    raise FormulaError("a whole-column function takes a column")
