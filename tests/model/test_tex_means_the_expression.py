"""The formula that is printed and the formula that is computed are one.

Each expression is printed as TeX with a sign of its own for every name; the TeX is read back as a
person reads it, brackets and products by the rules of print, and gives the same number.
"""

import ast
import math
import re

import numpy as np
import pytest

from reports.document.text.terms import Terms
from reports.formula.numeric import evaluate
from reports.formula.parse import names
from reports.formula.tex import chosen, to_tex
from reports.model.blocks import Node
from reports.model.evaluation import evaluate_model
from reports.shared.errors import NotPrintable
from reports.tables.registry import build_model
from tests.conftest import sample

TOKEN = re.compile(
    r"\\left\||\\right\||\\[a-zA-Z]+|\\[,;! ]|v[0-9]+v"
    r"|[0-9]{1,3}(?:\\,[0-9]{3})+(?![0-9])(?:\{,\}[0-9]+)?|[0-9]+(?:\{,\}[0-9]+)?|\s+|.",
    re.DOTALL,
)
FUNCTIONS = {
    r"\sin": math.sin, r"\cos": math.cos, r"\tg": math.tan, r"\arcsin": math.asin,
    r"\arccos": math.acos, r"\exp": math.exp, r"\ln": math.log, r"\arctg": math.atan,
}  # fmt: skip
ENDS = {None, "+", "-", ")", "]", "}", ";", r"\right", r"\right|"}


class Reader:
    """Numbers from TeX: sums of products of powers; a function takes what stands close to it."""

    def __init__(self, tex, values):
        self.tokens = [t for t in TOKEN.findall(tex) if not t.isspace()]
        self.values, self.at = values, 0

    @property
    def next(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else None

    def take(self, wanted=None):
        token = self.next
        assert wanted is None or token == wanted, (wanted, token, "".join(self.tokens))
        self.at += 1
        return token

    def whole(self):
        value = self.sum()
        assert self.next is None, "".join(self.tokens[self.at :])
        return value

    def sum(self):
        value = -self.product(self.take("-")) if self.next == "-" else self.product()
        while self.next in ("+", "-"):
            value = value + self.product() if self.take() == "+" else value - self.product()
        return value

    def product(self, _sign=None):
        value = self.power()
        while self.next not in ENDS:
            if self.next in (r"\,", r"\cdot", r"\;"):
                self.take()
            if self.next == "/":
                self.take()
                value /= self.power()
            else:
                value *= self.power()
        return value

    def power(self):
        value = self.atom()
        if self.next == "^":
            self.take()
            self.take("{")
            if self.next == r"\circ":
                self.take()
                self.take("}")
                return value
            value **= self.sum()
            self.take("}")
        return value

    def group(self, close="}"):
        value = self.sum()
        self.take(close)
        return value

    def atom(self):
        token = self.take()
        if token[0] == "v":
            return self.values[token]
        if token[0].isdigit():
            return float(token.replace("{,}", ".").replace(r"\,", ""))
        if token == r"\pi":
            return math.pi
        if token == "{":
            return self.group()
        if token == "[":
            return self.group("]")
        if token == r"\left":
            opened = self.take()
            value = self.sum()
            self.take(r"\right")
            self.take({"(": ")", "[": "]"}[opened])
            return value
        if token == r"\left|":
            value = self.sum()
            self.take(r"\right|")
            return abs(value)
        if token == r"\dfrac":
            self.take("{")
            over = self.group()
            self.take("{")
            return over / self.group()
        if token == r"\sqrt":
            self.take("{")
            return math.sqrt(self.group())
        if token in (r"\min", r"\max"):
            self.take(r"\left")
            self.take("(")
            parts = [self.sum()]
            while self.next == ";":
                self.take()
                if self.next == r"\,":
                    self.take()
                parts.append(self.sum())
            self.take(r"\right")
            self.take(")")
            return (min if token == r"\min" else max)(parts)
        if token in FUNCTIONS:
            return self.function(FUNCTIONS[token])
        raise AssertionError(f"not understood: {token} in {''.join(self.tokens)}")

    def function(self, of):
        power = 1.0
        if self.next == "^":
            self.take()
            self.take("{")
            power = self.group()
        if self.next in (r"\left", r"\dfrac"):
            return of(self.atom()) ** power
        value = self.power()  # a product without signs: sin 2φ
        while self.next not in ENDS | {r"\,", r"\cdot", r"\left", r"\dfrac", *FUNCTIONS}:
            value *= self.power()
        return of(value) ** power


def printed(terms, name, row):
    """TeX of a node with a sign for each name, the values of the signs, the value itself."""
    node = terms._node(name)
    table = name.rpartition(".")[0]

    def value(inner):
        key = terms._global(inner, table)
        field = terms.model.fields.get(key)
        if field is not None and isinstance(field.value, str):
            return (field.choices or {}).get(field.value, field.value)
        if key in terms.values.scalars:
            return terms.values.scalars[key]
        if field is not None:
            return float(field.value)
        of, _, column = key.rpartition(".")
        return float(terms.values.columns[of][column][row])

    expr = chosen(node.expr, lambda test: bool(evaluate(test, value)))
    signs, values = {}, {}

    def symbol(inner):
        sign = signs.setdefault(inner, f"v{len(signs)}v")
        values[sign] = value(inner)
        tex = terms.tex(terms._global(inner, table))
        if tex.startswith(r"\dfrac"):
            return rf"\dfrac{{{sign}}}{{1}}"
        return f"{sign}/1" if "/" in tex else sign

    return to_tex(expr, symbol), values, float(evaluate(expr, value))


def plain(expr):
    """Without angles in degrees and other units, aggregates and texts, which print otherwise."""
    hidden = re.compile(r"\b(rad|deg|to_\w+|of_\w+|col_\w+|total|mod|floor|round|atan2|step|"
                        r"fourier\w*|element|following|previous)"
                        r"\(|\"")  # fmt: skip
    tolerances = [
        n.value for n in ast.walk(ast.parse(expr, mode="eval"))
        if isinstance(n, ast.Constant) and isinstance(n.value, float) and abs(n.value) < 1e-5
    ]  # fmt: skip
    return not hidden.search(expr) and not tolerances and " if " not in expr


@pytest.mark.parametrize("name", ["gots-diesel", "two-stroke", "cycle-petrol", "yamz-236"])
def test_a_printed_formula_gives_the_number_that_is_computed(name):
    model = build_model(sample(name))
    terms = Terms(model, evaluate_model(model))
    seen = 0
    for key, node in model.nodes.items():
        if not isinstance(node, Node) or node.expr is None or not plain(node.expr):
            continue
        if not list(names(node.expr)):
            continue
        try:
            tex, values, wanted = printed(terms, key, 3)
        except (NotPrintable, KeyError, TypeError, ValueError):
            continue
        if not np.isfinite(wanted):
            continue
        actual = Reader(tex, values).whole()
        assert actual == pytest.approx(wanted, rel=1e-9, abs=1e-12), (key, tex)
        seen += 1
    assert seen > 100
