"""What people write in place of the language of formulas, and what they mean by it."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable

# Functions of spreadsheets and of the blackboard, and the language's own word for them.
MEANT = {
    "abs": "abs", "модуль": "abs", "sqrt": "sqrt", "корень": "sqrt", "exp": "exp", "ln": "ln",
    "log": "ln", "sin": "sin", "cos": "cos", "tan": "tan", "tg": "tan", "asin": "asin",
    "arcsin": "asin", "acos": "acos", "arccos": "acos", "atan2": "atan2", "round": "round",
    "округл": "round", "roundup": "round_up", "округлвверх": "round_up", "ceil": "round_up",
    "ceiling": "round_up", "int": "floor", "целое": "floor", "trunc": "floor", "mod": "mod",
    "остат": "mod", "radians": "rad", "радианы": "rad", "degrees": "deg", "градусы": "deg",
    "min": "min", "мин": "min", "max": "max", "макс": "max", "floor": "floor",
}  # fmt: skip
_COLUMN = {
    "sum": ("total", "col_sum"), "сумм": ("total", "col_sum"), "total": ("total", "col_sum"),
    "average": ("(a + b)/2", "col_mean"), "mean": ("(a + b)/2", "col_mean"),
    "avg": ("(a + b)/2", "col_mean"), "срзнач": ("(a + b)/2", "col_mean"),
    "min": ("min", "col_min"), "мин": ("min", "col_min"),
    "max": ("max", "col_max"), "макс": ("max", "col_max"),
}  # fmt: skip
_WRITTEN = {
    "if": "пишите ЗНАЧЕНИЕ if УСЛОВИЕ else ДРУГОЕ",
    "если": "пишите ЗНАЧЕНИЕ if УСЛОВИЕ else ДРУГОЕ",
    "and": "пишите a and b", "и": "пишите a and b", "or": "пишите a or b", "или": "пишите a or b",
    "not": "пишите not a", "не": "пишите not a", "pi": "пишите pi без скобок",
    "пи": "пишите pi без скобок", "pow": "пишите a**b", "power": "пишите a**b",
    "степень": "пишите a**b", "log10": "пишите ln(x)/ln(10)", "lg": "пишите ln(x)/ln(10)",
    "atan": "пишите atan2(y, x)", "arctan": "пишите atan2(y, x)", "arctg": "пишите atan2(y, x)",
    "sign": "пишите x/abs(x)", "ctg": "пишите 1/tan(x)", "cot": "пишите 1/tan(x)",
    "sumproduct": "пишите столбец произведений и col_sum от него",
}  # fmt: skip
# Signs in place of the language's own: pattern, mend.
_SIGNS = (
    (r"\^", "степень пишут **: x**2"),
    (r"[²³⁴]", "степень пишут **: x**2"),
    (r"<>|≠", "«не равно» пишут !="),
    (r"≤|=<", "«не больше» пишут <="),
    (r"≥|=>", "«не меньше» пишут >="),
    (r"&&", "пишите a and b"),
    (r"\|\|", "пишите a or b"),
    (r"!(?!=)", "пишите not a"),
    (r"[−–—]", "минус — обычный знак -"),
    (r"[×·∙⋅]", "умножение пишут *"),
    (r"÷|//", "деление пишут /"),
    (r"π", "пишите pi"),
    (r"√", "пишите sqrt(x)"),
    (r"\d\s*%", "процент пишут дробью: 5 % — 0.05"),
    (r"%", "остаток от деления пишут mod(a, b)"),
    (r"(?<![<>=!])=(?!=)", "«равно» пишут =="),
    (r";", "между числами в скобках — запятая"),
    (r"\d,\d", "в дроби — точка: 0.6; между числами — запятая с пробелом"),
    (r"\$?\b[A-Z]{1,2}\$?\d+\b", "ячейки не называют: назовите величину или столбец ТАБЛИЦА.КЛЮЧ"),
    (r"\b\d+(?:\.\d+)?\s*(?!(?:if|else|and|or|not)\b)[^\W\d]|\d\s*\(|\)\s*\("
     r"|\)\s*(?!(?:if|else|and|or)\b)\w", "знак умножения пишут: 2*x"),
)  # fmt: skip
_CALL = re.compile(r"(?<![\w.])([^\W\d]\w*)\s*\(")
_QUOTED = re.compile(r'"[^"]*"')
_USUAL = "язык формул и его функции — в docs/books.md"


def mended(text: str, is_function: Callable[[str], bool]) -> tuple[str, str]:
    """Return the part of an expression that is none, and how to mend it.

    ``is_function`` tells the functions of the language.
    """
    plain = _QUOTED.sub(lambda text: '"' + "_" * (len(text[0]) - 2) + '"', text)
    for call in _CALL.finditer(plain):
        name = call[1]
        if not is_function(name) and name not in ("if", "else", "and", "or", "not"):
            return text[call.start() : call.end()], _function(name)
    if re.search(r"\bif\b", plain) and not re.search(r"\belse\b", plain):
        return text, _WRITTEN["if"]
    for pattern, mend in _SIGNS:
        sign = re.search(pattern, plain)
        if sign is not None:
            return text[sign.start() : sign.end()], mend
    if plain.count("(") != plain.count(")"):
        return text, "скобки не парные"
    if plain.count('"') % 2:
        return text, "кавычки не парные"
    if "'" in plain:
        return text, 'текст берут в кавычки "…"'
    return text, _USUAL


def _function(name: str) -> str:
    """How to write a function that the language has under another name or not at all."""
    word = name.casefold()
    if word in _WRITTEN:
        return _WRITTEN[word]
    if word in _COLUMN:
        row, column = _COLUMN[word]
        return f"пишите {row} для чисел или {column}(ТАБЛИЦА.СТОЛБЕЦ) для столбца"
    if word in MEANT:
        return f"пишите {MEANT[word]}"
    similar = difflib.get_close_matches(word, MEANT, n=1, cutoff=0.8)
    likely = f"возможно, {MEANT[similar[0]]}; " if similar else ""
    return f"{likely}функции перечислены в docs/books.md"
