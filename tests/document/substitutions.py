"""Formulas of the report with numbers put in: evaluated from their TeX, beside what is printed."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

_NAMES = {r"\arcsin": "ASIN", r"\arccos": "ACOS", r"\arctg": "ATAN", r"\sin": "SIN",
          r"\cos": "COS", r"\tg": "TAN", r"\max": "max", r"\min": "min"}  # fmt: skip
_SIGNS = {r"\left|": "abs(", r"\right|": ")", "{,}": ".", r"\left": "", r"\right": "",
          r"\;": "", r"\,": "", r"\cdot": "*",
          "[": "(", "]": ")", r"\pi": "PI", ";": ","}  # fmt: skip
# Angles are in degrees at both ends.
_FUNCTIONS = {
    "PI": math.pi, "DEG": math.pi / 180, "SQRT": math.sqrt, "SIN": math.sin, "COS": math.cos,
    "TAN": math.tan, "max": max, "min": min, "abs": abs,
    **{name: lambda x, of=of: math.degrees(of(x))
       for name, of in (("ASIN", math.asin), ("ACOS", math.acos), ("ATAN", math.atan))},
}  # fmt: skip
_GROUP = r"\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)"  # brackets within brackets, three deep


def _closing(text: str, start: int) -> int:
    depth = 0
    for at in range(start, len(text)):
        depth += (text[at] == "{") - (text[at] == "}")
        if depth == 0:
            return at
    raise ValueError(text)


def _grouped(text: str, word: str, count: int, form: str) -> str:
    """Groups in braces after a word as an expression, the outer ones first."""
    while (at := text.find(word + "{")) >= 0:
        groups, end = [], at + len(word)
        for _ in range(count):
            close = _closing(text, end)
            groups.append(text[end + 1 : close])
            end = close + 1
        text = text[:at] + form.format(*groups) + text[end:]
    return text


def expression(tex: str) -> str:
    """A numeric TeX expression in Python."""
    for sign, plain in _SIGNS.items():
        tex = tex.replace(sign, plain)
    tex = _grouped(tex, r"\dfrac", 2, "(({})/({}))")
    tex = _grouped(tex, r"\sqrt", 1, "SQRT({})")
    tex = _grouped(tex.replace(r"^{\circ}", "*DEG"), "^", 1, "**({})")
    for name, word in _NAMES.items():
        tex = tex.replace(name, f" {word} ")
    argument = rf"({_GROUP}|[\d.]+(?:\*DEG)?)"
    tex = re.sub(rf"(SIN|COS|TAN)\s*\*\*\((\d+)\)\s*{argument}", r"(\1(\3))**(\2)", tex)
    tex = re.sub(r"(A?(?:SIN|COS|TAN))\s+(?!\()([\d.]+(?:\*DEG)?)", r"\1(\2)", tex)
    return re.sub(r"([\d)])\s*\(", r"\1*(", tex)  # a product without its sign


def _zeros(whole: str) -> int:
    return len(whole) - len(whole.rstrip("0"))


def substitutions(formulas: list[str]) -> Iterator[tuple[str, float, float, float]]:
    """Formula, value of its numbers, printed result, half a unit of its last digit."""
    for tex in formulas:
        *before, numbers, result = tex.split(" = ")
        bare = re.sub(r"\\[a-zA-Z]+", "", numbers)
        shown = re.match(r"(-?[\d.]+)(?:\\cdot10\^\{(-?\d+)\})?(.*)",
                         re.sub(r"\{,\}", ".", re.sub(r"\\,|\s", "", result)))  # fmt: skip
        if not before or shown is None or re.search(r"[a-zA-Zа-яА-Я]", bare):
            continue
        if r"\mathrm{окр}" in tex or r"\sum" in tex:
            continue
        scale = 10.0 ** int(shown[2] or 0)
        whole, _, fraction = shown[1].partition(".")
        # Of a number of four significant digits the last may stand before the unit.
        decimals = len(fraction) if fraction or len(whole.lstrip("-")) < 5 else -_zeros(whole)
        value = float(eval(expression(numbers), dict(_FUNCTIONS)))
        if "рад" in shown[3] and r"\arc" in numbers:
            value = math.radians(value)
        yield tex, value, float(shown[1]) * scale, 0.5 * 10.0**-decimals * scale
