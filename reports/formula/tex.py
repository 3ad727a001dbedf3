"""Expressions as TeX for the report: in symbols and with numbers substituted."""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Callable, Collection
from dataclasses import dataclass

from reports.formula.parse import AGGREGATES, SCALE_FUNCTIONS, SCALES, parse
from reports.shared.errors import NotPrintable
from reports.shared.russian import NBSP, grouped

Symbols = Callable[[str], str]
Numbers = Callable[[str], float | str]

_NAMES = {
    "sin": r"\sin", "cos": r"\cos", "tan": r"\tg", "asin": r"\arcsin",
    "acos": r"\arccos", "exp": r"\exp", "ln": r"\ln",
}  # fmt: skip
_COMPARISONS = {
    ast.Lt: "<", ast.LtE: r"\leq", ast.Gt: ">", ast.GtE: r"\geq", ast.Eq: "=", ast.NotEq: r"\neq",
}  # fmt: skip
_SUM, _PRODUCT, _POWER, _ATOM = 1, 2, 3, 4


# Constants below this are tolerances of comparisons; a printed formula leaves them out.
_TOLERANCE = 1e-5
_WIDEST = 40  # signs of a numerator that still fits a line
_WHOLE = 6  # digits of the longest number that has no power of ten
_INVERSE = {"asin", "acos", "atan", "atan2"}


class Raw(str):
    """A value that is TeX already and is put in as it stands."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class Piece:
    """One branch of a formula with choices: the formula and when it holds (None: else)."""

    formula: str
    condition: str | None


def to_tex(text: str, symbols: Symbols, zeros: Collection[str] = ()) -> str:
    """Return the expression in symbols.

    Args:
        text: the expression.
        symbols: TeX of a name; columns of other tables come as ``table.column``.
        zeros: names whose terms are left out.

    Raises:
        NotPrintable: the expression is a choice or an interpolation.
    """
    return _Printer(symbols, None, zeros).text(parse(text))


def to_tex_numbers(text: str, symbols: Symbols, numbers: Numbers) -> str:
    """Return the expression with the numbers of one row or of the scalars put in."""
    return _Printer(symbols, numbers).text(parse(text))


def pieces(text: str, symbols: Symbols) -> list[Piece]:
    """Branches of a nested choice in order; one piece where there is no choice."""
    printer = _Printer(symbols, None)
    result: list[Piece] = []
    node = parse(text)
    while isinstance(node, ast.IfExp):
        result.append(Piece(printer.text(node.body), printer.text(node.test)))
        node = node.orelse
    result.append(Piece(printer.text(node), None))
    return result


def chosen(text: str, holds: Callable[[str], bool]) -> str:
    """Return branch of a nested choice that is in force; the expression itself without a choice.

    Args:
        text: the expression.
        holds: tells whether a condition, given as an expression, is true.
    """
    node = parse(text)
    while isinstance(node, ast.IfExp):
        node = node.body if holds(ast.unparse(node.test)) else node.orelse
    return ast.unparse(node)


def number_tex(value: float, digits: int = 4) -> str:
    """Return a number for TeX: significant digits, decimal comma, powers of ten for extremes."""
    if value == 0:
        return "0"
    exponent = math.floor(math.log10(abs(value)))
    if -3 <= exponent < _WHOLE:
        decimals = max(0, digits - 1 - exponent)
        text = f"{value:.{decimals}f}"
        text = text.rstrip("0").rstrip(".") if "." in text else text
        return grouped(text).replace(".", "{,}").replace(NBSP, r"\,")
    mantissa = f"{value / 10**exponent:.{digits - 1}f}".rstrip("0").rstrip(".")
    return mantissa.replace(".", "{,}") + rf" \cdot 10^{{{exponent}}}"


def as_put_in(value: float, digits: int = 4) -> float:
    """Return the number that :func:`number_tex` writes: a whole part stands whole."""
    if value == 0:
        return 0.0
    exponent = math.floor(math.log10(abs(value)))
    most = max(digits, exponent + 1) if exponent < _WHOLE else digits
    return float(f"{value:.{most - 1}e}")


def input_symbol_tex(symbol: str) -> str:
    """TeX of an input field's symbol such as ``p_a``, ``η_м``, ``K_H2`` or ``m_1/m_ш``."""
    if "/" in symbol:
        return "/".join(map(input_symbol_tex, symbol.split("/")))
    base, _, index = symbol.partition("_")
    greek = {"λ": r"\lambda", "ε": r"\varepsilon", "ρ": r"\rho", "η": r"\eta", "φ": r"\varphi",
             "θ": r"\theta", "γ": r"\gamma", "α": r"\alpha", "ω": r"\omega", "τ": r"\tau",
             "Δ": r"\Delta", "δ": r"\delta", "ψ": r"\psi", "ξ": r"\xi", "π": r"\pi"}  # fmt: skip
    text = "".join(f"{greek[char]} " if char in greek else char for char in base).strip()
    if re.search("[а-яА-Я]", text):
        text = rf"\mathrm{{{text}}}"
    if not index:
        return text
    index = re.sub(r"^([A-Z])(\d)$", r"\\mathrm{\1_\2}", index)  # a substance: H2
    index = index.replace(" ", r"\,")
    body = rf"\mathrm{{{index}}}" if re.search("[а-яА-Я.]", index) else index
    return f"{text}_{{{body}}}"


def exponent_of(scale: str) -> int:
    """Power of ten of a scale function: −6 of ``to_MPa``."""
    way, unit = scale.split("_", 1)
    return round(math.log10(SCALES[unit])) * (1 if way == "of" else -1)


def _is_tolerance(node: ast.expr) -> bool:
    return (
        isinstance(node, ast.Constant)
        and isinstance(node.value, float)
        and 0 < abs(node.value) < _TOLERANCE
    )


def _is_angle(node: ast.expr) -> bool:
    """Whether an inverse function gives the value, which is an angle of itself."""
    calls = (each.func for each in ast.walk(node) if isinstance(each, ast.Call))
    return any(isinstance(f, ast.Name) and f.id in _INVERSE for f in calls)


def _is_long(node: ast.expr, text: str) -> bool:
    """Whether the numerator is a sum too wide for a line."""
    return (
        isinstance(node, ast.BinOp)
        and isinstance(node.op, ast.Add | ast.Sub)
        and len(re.sub(r"\\[A-Za-z]+|[{}_^ ]", "", text)) > _WIDEST
    )


def _level(symbol: str) -> int:
    """Return a symbol that is itself a ratio, such as ``m_1/m_ш``, needs brackets in a product."""
    if symbol.startswith(r"\dfrac"):
        return _PRODUCT
    return _SUM if "/" in symbol else _ATOM


class _Printer:
    def __init__(
        self, symbols: Symbols, numbers: Numbers | None, zeros: Collection[str] = ()
    ) -> None:
        self.symbols = symbols
        self.numbers = numbers
        self.zeros = zeros

    def text(self, node: ast.expr) -> str:
        return self._emit(node)[0]

    def _wrap(self, node: ast.expr, least: int) -> str:
        text, level = self._emit(node)
        if level >= least and not text.startswith("-"):
            return text
        return rf"\left({text}\right)"

    def _first(self, node: ast.expr) -> str:
        """First factor: −a·b, not (−a)·b; the whole product has the minus then."""
        text, level = self._emit(node)
        is_sum = level < _PRODUCT and not isinstance(node, ast.UnaryOp)
        return rf"\left({text}\right)" if is_sum else text

    def _emit(self, node: ast.expr) -> tuple[str, int]:
        match node:
            case ast.Constant(value=str() as word):
                return rf"\mathrm{{{word}}}", _ATOM
            case ast.Constant(value=value):
                return number_tex(float(value), 9), _ATOM  # type: ignore[arg-type]
            case ast.Name(id="pi"):
                return r"\pi", _ATOM
            case ast.Name(id=name):
                return self._name(name)
            case ast.Attribute(value=ast.Name(id=table), attr=column):
                return self._name(f"{table}.{column}")
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return "-" + self._wrap(operand, _PRODUCT), _SUM
            case ast.BinOp():
                return self._binary(node)
            case ast.Compare(left=left, ops=[op], comparators=[right]):
                return f"{self.text(left)} {_COMPARISONS[type(op)]} {self.text(right)}", _SUM
            case ast.Call(func=ast.Name(id=name), args=args):
                return self._call(name, args)
        raise NotPrintable(f"no printed form: {ast.unparse(node)}")

    def _name(self, name: str) -> tuple[str, int]:
        if self.numbers is None:
            symbol = self.symbols(name)
            return symbol, _level(symbol)
        value = self.numbers(name)
        if isinstance(value, Raw):
            return value, _POWER if value.startswith("-") else _ATOM
        if isinstance(value, str):
            return rf"\mathrm{{{value}}}", _ATOM
        text = number_tex(value)
        return text, _POWER if r"\cdot" in text or text.startswith("-") else _ATOM

    def _binary(self, node: ast.BinOp) -> tuple[str, int]:
        left, right = node.left, node.right
        match node.op:
            case ast.Add() if _is_tolerance(right):
                return self._emit(left)
            case ast.Add() | ast.Sub() if self._is_zero(right):
                return self._emit(left)
            case ast.Add() if self._is_zero(left):
                return self._emit(right)
            case ast.Sub() if self._is_zero(left):
                return "-" + self._wrap(right, _PRODUCT), _SUM
            case ast.Add():
                return f"{self.text(left)} + {self._wrap(right, _SUM)}", _SUM
            case ast.Sub():
                return f"{self.text(left)} - {self._wrap(right, _PRODUCT)}", _SUM
            case ast.Mult():
                first, second = self._first(left), self._wrap(right, _PRODUCT)
                return f"{first}{self._times(left, first, second)}{second}", _PRODUCT
            case ast.Div() if _is_long(left, self.text(left)):
                # Brackets without \left may be broken between lines, a fraction may not.
                return rf"\dfrac{{1}}{{{self.text(right)}}} \,[{self.text(left)}]", _PRODUCT
            case ast.Div() if isinstance(left, ast.UnaryOp):
                over = self._emit(left.operand)[0]
                return rf"-\dfrac{{{over}}}{{{self.text(right)}}}", _PRODUCT
            case ast.Div():
                over, sign = self.text(left), ""
                if self.numbers is not None and not isinstance(left, ast.BinOp):
                    sign, over = ("-", over[1:]) if over.startswith("-") else ("", over)
                return rf"{sign}\dfrac{{{over}}}{{{self.text(right)}}}", _PRODUCT
        return self._power(left, right)

    def _is_zero(self, node: ast.expr) -> bool:
        """Whether a term is a plain zero, which no one writes."""
        match node:
            case ast.Name(id=name) if name in self.zeros:
                return True
            case _ if self.numbers is None and not self.zeros:
                return False
            case ast.Name(id=name) if name != "pi":
                return self.numbers is not None and self._name(name)[0] == "0"
            case ast.Attribute(value=ast.Name(id=table), attr=column):
                return self.numbers is not None and self._name(f"{table}.{column}")[0] == "0"
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return self._is_zero(operand)
            case ast.BinOp(left=left, op=ast.Mult(), right=right):
                return self._is_zero(left) or self._is_zero(right)
            case ast.BinOp(left=left, op=ast.Div()):
                return self._is_zero(left)
            case ast.BinOp(left=left, op=ast.Add() | ast.Sub(), right=right):
                return self._is_zero(left) and self._is_zero(right)
            case ast.Call(func=ast.Name(id=name), args=[arg]) if name in SCALE_FUNCTIONS:
                return self._is_zero(arg)
        return False

    def _times(self, left: ast.expr, first: str, second: str) -> str:
        if self.numbers is not None or second[:1].isdigit():
            return r" \cdot "
        # A coefficient stands close to its symbol, brackets and functions keep their own room.
        close = isinstance(left, ast.Constant) or second.startswith((r"\left", r"\sin", r"\cos"))
        if second.startswith((r"\dfrac", r"\max", r"\min")) or first.endswith(r"\right)"):
            return r" \, "
        return " " if close else r" \, "

    def _power(self, base: ast.expr, exponent: ast.expr) -> tuple[str, int]:
        power = self.text(exponent)
        match base:
            case ast.Call(func=ast.Name(id=name), args=[argument]) if name in ("sin", "cos"):
                return rf"{_NAMES[name]}^{{{power}}} {self._argument(argument)}", _PRODUCT
            case ast.Call(func=ast.Name(id="sqrt"), args=[argument]):
                inside = self._power(argument, exponent)[0]
                return rf"\sqrt{{{inside}}}", _ATOM
        text = self._wrap(base, _ATOM)
        if "'" in text and not text.startswith(r"\left"):
            text = rf"\left({text}\right)"  # a prime and a power on one letter collide
        if text.startswith(r"\dfrac"):
            text = rf"\left({text}\right)"
        return f"{text}^{{{power}}}", _POWER

    def _argument(self, node: ast.expr) -> str:
        """Argument of a function: without brackets where it is one symbol or number."""
        text, level = self._emit(node)
        simple = level == _ATOM or (
            self.numbers is None and level == _PRODUCT and "frac" not in text
        )
        function = any(name in text for name in (r"\sin", r"\cos", r"\tg"))
        if simple and not function and "+" not in text:
            return text
        return rf"\left({text}\right)"

    def _call(self, name: str, args: list[ast.expr]) -> tuple[str, int]:
        if name == "rad":
            text, level = self._emit(args[0])
            if self.numbers is None:
                return text, level
            return (rf"{text}^{{\circ}}", _ATOM) if level == _ATOM else (text, level)
        if name == "deg":
            # Inverse functions are read in degrees at once, other angles are turned into them.
            if self.numbers is None or _is_angle(args[0]):
                return self._emit(args[0])
            return rf"{self._first(args[0])} \cdot \dfrac{{180}}{{\pi}}", _PRODUCT
        if name in SCALE_FUNCTIONS:
            return self._scale(name, args[0])
        if name == "sqrt":
            return rf"\sqrt{{{self.text(args[0])}}}", _ATOM
        if name == "abs":
            return rf"\left|{self.text(args[0])}\right|", _ATOM
        if name == "round":
            return rf"\mathrm{{окр}}\left({self.text(args[0])}\right)", _ATOM
        if name in ("min", "max"):
            parts = r";\, ".join(self.text(arg) for arg in args)
            return rf"\{name}\left({parts}\right)", _ATOM
        if name == "mod":
            inside, modulus = self.text(args[0]), self.text(args[1])
            return rf"{inside} \;\left(\mathrm{{mod}}\; {modulus}^{{\circ}}\right)", _SUM
        if name == "atan2":
            ratio = rf"\dfrac{{{self.text(args[0])}}}{{{self.text(args[1])}}}"
            return rf"\arctg {ratio}", _PRODUCT
        if name in ("wave_cos", "wave_sin"):
            *weight, angle = (_Printer(self.symbols, None).text(arg) for arg in args[:-1])
            turn, order = name.removeprefix("wave_"), self.text(args[-1])
            return rf"\sum {''.join(weight)} \{turn}\left({order} {angle}\right)", _PRODUCT
        if name == "run_sum":
            return rf"\sum {_Printer(self.symbols, None).text(args[0])}", _PRODUCT
        if name == "total":
            return " + ".join(self._wrap(arg, _SUM) for arg in args), _SUM
        if name in _NAMES:
            return f"{_NAMES[name]} {self._argument(args[0])}", _PRODUCT
        if name in AGGREGATES:
            return self._aggregate(name, args[0]), _ATOM
        raise NotPrintable(f"no printed form: {name}")

    def _scale(self, name: str, arg: ast.expr) -> tuple[str, int]:
        if self.numbers is None:
            return self._emit(arg)
        text, level = self._emit(arg)
        factor = text if level >= _PRODUCT else rf"\left({text}\right)"
        return rf"{factor} \cdot 10^{{{exponent_of(name)}}}", _PRODUCT

    def _aggregate(self, name: str, arg: ast.expr) -> str:
        symbol = _Printer(self.symbols, None).text(arg)
        if name == "col_mean":
            return rf"\dfrac{{1}}{{m}}\sum_{{j=1}}^{{m}} {symbol}"
        if name == "col_sum":
            return rf"\sum_{{j=1}}^{{m}} {symbol}"
        return {"col_max": r"\max ", "col_min": r"\min "}.get(name, "") + symbol
