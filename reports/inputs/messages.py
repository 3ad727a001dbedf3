"""Russian messages for errors of pydantic."""

from __future__ import annotations

import datetime as dt
import difflib
import re
from collections.abc import Iterable
from dataclasses import replace

from pydantic_core import ErrorDetails

from reports.inputs import units
from reports.inputs.meta import MAX_TEXT, Key, Meta, StrictModel, hints
from reports.inputs.normalise import is_ambiguous
from reports.inputs.registry import homes
from reports.shared.errors import NO_LIMITS, Problem, one_line

_LIKE_DIGITS = str.maketrans("ОоOoЗзlI", "00003311")
_PLAIN_NUMBER = re.compile(r"[-+]?\d+(\.\d+)?")
_LOOK_ALIKE = str.maketrans("аеорсухкмтіАВЕКМНОРСТХУ", "aeopcyxkmtiABEKMHOPCTXY")


def shown(value: object) -> str:
    """Return a value as a message may show it: one line, short."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        # str() of an int of more than 4300 digits raises.
        return units.number_text(value) if abs(value) < 10**15 else "слишком большое целое число"
    if isinstance(value, float):
        return units.number_text(value)
    if isinstance(value, str):
        return f"«{one_line(value, 40)}»"
    return kind(value)


def kind(value: object) -> str:
    """Return the Russian name of a value's type."""
    if isinstance(value, dict):
        return "таблица"
    if isinstance(value, list | tuple):
        return "список"
    if isinstance(value, dt.date | dt.time):
        return "дата или время"
    if value is None:
        return "пустое значение (None)"
    if isinstance(value, bool):
        return "логическое значение"
    if isinstance(value, str):
        return "строка"
    return "число" if isinstance(value, int | float) else f"объект {type(value).__name__}"


def explain(error: ErrorDetails, meta: Meta | None, *, in_book: bool = False) -> tuple[str, str]:
    """Return (what, hint) for one pydantic error of a field with this metadata."""
    fault = error["type"]
    value = error["input"]
    hint = meta.range_text(labels=in_book) if meta is not None else ""
    if fault == "missing":
        title = f" ({meta.title})" if meta is not None and "{" not in meta.title else ""
        return f"обязательный ключ не задан{title}", hint
    if fault in ("greater_than_equal", "less_than_equal", "greater_than", "less_than"):
        return f"значение {shown(value)} вне допустимых пределов", hint
    if fault == "finite_number":
        return "нужно конечное число, а не inf или nan", hint
    if fault == "literal_error":
        return f"недопустимое значение {shown(value)}", hint
    if fault in ("float_type", "int_type", "int_from_float", "int_parsing_size"):
        number = "целое число" if fault.startswith("int") else "число"
        return f"нужно {number}, а задано: {_given(value)}", _number_hint(
            value, in_book=in_book
        ) or hint
    if fault == "string_type":
        return f"нужна строка в кавычках, а задано: {_given(value)}", ""
    if fault == "string_too_long":
        return f"слишком длинная строка, {len(str(value))} знаков", f"допустимо до {MAX_TEXT}"
    if fault == "control_character":
        if "\n" not in str(value).strip() and set(str(value)) & set("\t\b\f\r"):
            problem = "в строке обратная черта «\\» со знаком, как в «\\t»"
            return problem, "пишите в путях прямую черту: «папка/файл.csv»"
        return "в строке есть управляющие символы", "оставьте одну строку обычного текста"
    return _explain_shape(fault, value)


def measured(problem: Problem, error: ErrorDetails, meta: Meta | None) -> Problem:
    """Return the problem of a pydantic error with the limits of its field and the value."""
    limits = NO_LIMITS if meta is None else (meta.minimum, meta.maximum)
    if meta is not None and meta.choices and all(map(str.isdigit, meta.choices)):
        numbers = [float(choice) for choice in meta.choices]
        limits = min(numbers), max(numbers)
    value = None if error["type"] == "missing" else error["input"]
    return replace(problem, limits=limits, value=value)


def _explain_shape(fault: str, value: object) -> tuple[str, str]:
    if fault in ("model_type", "model_attributes_type", "dict_type"):
        return f"нужна таблица ключей, а задано: {_given(value)}", ""
    if fault in ("tuple_type", "list_type"):
        return f"нужен список, а задано: {_given(value)}", "запишите в квадратных скобках"
    if fault in ("too_long", "too_short"):
        return "нужна пара чисел [угол, давление]", "например [360.0, 8.4]"
    return f"недопустимое значение {shown(value)}", ""


def _given(value: object) -> str:
    if not isinstance(value, bool | int | float | str):
        return kind(value)
    if isinstance(value, int) and abs(value) >= 10**15:
        return shown(value)
    return f"{kind(value)} {shown(value)}"


def _number_hint(value: object, *, in_book: bool) -> str:
    if isinstance(value, dt.date | dt.time):
        return "сделайте ячейку числом" if in_book else ""
    if not isinstance(value, str):
        return ""
    if is_ambiguous(value):
        whole, part = re.split("[.,]", value.strip())
        readings = f"{whole}.{part} или {whole}{part}"
        return f"неясно, {readings}; " + (
            "сделайте ячейку числом" if in_book else "пишите без кавычек"
        )
    digits = value.strip().translate(_LIKE_DIGITS).replace(",", ".")
    if digits != value.strip().replace(",", ".") and _PLAIN_NUMBER.fullmatch(digits):
        return f"в числе буква вместо цифры; возможно, {digits}"
    number = re.match(r"\s*([-+]?\d+([.,]\d+)?)", value)
    if in_book or number is None:
        return "сделайте ячейку числом" if in_book else ""
    return f"напишите одно число: {number[1].replace(',', '.')}"


def likely_key(key: str, model: type[StrictModel]) -> str | None:
    """Return the key of `model` that `key` was probably meant to be."""
    close = difflib.get_close_matches(key.lower(), list(hints(model)), n=1, cutoff=0.6)
    return close[0] if close else None


def likely_word(word: str, words: Iterable[str]) -> str | None:
    """Return the word of `words` nearest to `word`, if one is near."""
    close = difflib.get_close_matches(word.lower(), list(words), n=1, cutoff=0.6)
    return close[0] if close else None


def latin(word: str) -> str:
    """Return a word with Latin letters for the Cyrillic ones that look the same."""
    return word.translate(_LOOK_ALIKE)


def unknown_key(key: str, model: type[StrictModel]) -> tuple[str, str]:
    """Return (what, hint) for a key `model` does not know."""
    problem = "неизвестный ключ"
    for home, models in homes():
        if any(key in hints(candidate) for candidate in models):
            other = "при другом source" if model in models else f"в разделе {home}"
            return problem, f"такой ключ есть {other}"
    strange = next((sign for sign in key if sign != latin(sign)), "")
    if strange and latin(key) in hints(model):
        return f"в ключе русская буква «{strange}»", f"напишите латиницей: {latin(key)}"
    likely = likely_key(key, model)
    return problem, f"возможно, имелся в виду {likely}" if likely else "удалите его"


def meta_at(model: type[StrictModel], path: tuple[str | int, ...]) -> Meta | None:
    """Return the metadata of the field at `path` inside `model`, if it is a single value."""
    spec: Key | None = None
    current: type[StrictModel] | None = model
    for part in path:
        if isinstance(part, str):
            spec = hints(current).get(part) if current is not None else None
            if spec is None:
                return None
            current = spec.inner
    metas = spec.metas if spec is not None and current is None else ()
    numbers = [part for part in path if isinstance(part, int)]
    if len(metas) == 2:
        metas = metas[numbers[1] :] if len(numbers) > 1 else ()
    if not metas:
        return None
    return metas[0].numbered(numbers[0] + 1) if numbers else metas[0]
