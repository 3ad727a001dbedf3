"""The text of an input file, and its values in the types of their keys.

Text is bounded, decoded and harmless to the parser.  Values: choices by their Russian words,
whole numbers with a point, numbers in quotes ("88,0").  An ambiguous value stays as it is:
the check of its section refuses it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from decimal import Decimal
from numbers import Real
from pathlib import Path
from typing import Any

from reports.inputs.meta import Key, Meta, StrictModel, hints
from reports.inputs.registry import SECTIONS
from reports.inputs.sections.gas import SOURCES
from reports.inputs.sections.input_file import RegimeValues
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.file_types import CALLED, TEXT, UTF16, kind_of, read_bytes

MAX_BYTES = 2_000_000
MAX_LINES = 20_000
MAX_DOTS = 40
MAX_ENTRIES = 10_000  # of a list: longer ones only hold a process up
_DECIMAL = re.compile(r"(?<![\w.])\d+\.\d+(?:[eE][-+]?\d+)?(?![\w.])")
_SOURCE = Meta("", choices={**SOURCES, "file": "из файла"})
_NUMBER = re.compile(r"[-+−]?(\d+|\d{1,3}([ \u00a0\u202f]\d{3})+)([.,]\d+)?([eE][-+]?\d+)?")
# "1,234" is one and a bit to one reader and more than a thousand to another.
_AMBIGUOUS = re.compile(r"[-+−]?[1-9]\d{0,2}[.,]\d{3}")
_PLAIN = (bool, int, float, str)
_ONE_WORD = {  # besides the labels of the choices
    "да": "yes",
    "нет": "no",
    "дизельный": "diesel",
    "бензин": "petrol",
    "бензиновый": "petrol",
    "искровой": "petrol",
    "солярка": "diesel",
    "четырехтактный": "4",
    "двухтактный": "2",
    "v": "v",
    "v-образный": "v",
    "в-образный": "v",
    "точное": "exact",
    "точный": "exact",
    "по учебнику": "textbook",
}


def read_text(file: Path) -> str:
    """Return the text of an input file.

    Raises:
        InputError: It is missing, unreadable, too large or no UTF-8 text.
    """
    return text_of(read_bytes(file, MAX_BYTES, "это не файл исходных данных"), file.name)


def text_of(data: bytes, source: str) -> str:
    """Return the text of an input file's bytes; `source` names it.

    Raises:
        InputError: It is too large or no UTF-8 text.
    """
    if len(data) > MAX_BYTES:
        fault = f"файл больше {MAX_BYTES // 10**6} МБ"
        raise refused(source, fault, "это не файл исходных данных")
    kind = kind_of(data)
    if kind == UTF16:
        raise refused(source, "кодировка UTF-16", "сохраните файл в UTF-8")
    if kind != TEXT:
        raise refused(source, f"{CALLED[kind]}, а нужен текст TOML", "выберите другой файл")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        if error.reason == "unexpected end of data":
            problem = "файл обрывается посреди знака"
            raise refused(source, problem, "восстановите его конец") from None
        row = data.count(b"\n", 0, error.start) + 1
        problem = f"строка {row}: не UTF-8 (возможно, Windows-1251)"
        raise refused(source, problem, "сохраните файл в UTF-8") from None


def refuse_bomb(source: str, text: str) -> None:
    """Refuse text that would exhaust the TOML parser."""
    # tomllib's memory grows with the square of a dotted key's length: a file of
    # 400 KB takes all there is.
    lines = text.split("\n")
    if len(lines) > MAX_LINES:
        problem = f"в файле больше {MAX_LINES} строк"
        raise refused(source, problem, "это не файл исходных данных")
    for row, line in enumerate(lines, start=1):
        if line.count(".") <= MAX_DOTS or line.lstrip().startswith("#"):
            continue
        if _DECIMAL.sub("", line).count(".") > MAX_DOTS:
            problem = f"строка {row}: слишком длинный составной ключ"
            raise refused(source, problem, "ключ состоит из одного слова")


def plain(source: str, raw: object, where: str = "") -> Any:  # noqa: ANN401
    """Return Python's own values for those of numpy, pandas and fractions, lists for arrays.

    Raises:
        InputError: a key is no text; `source` and `where` name its table.
    """
    if isinstance(raw, Mapping):
        for key in raw:
            if not isinstance(key, str):
                address = ": ".join(filter(None, (one_line(source, 120), where)))
                problem = f"ключ {one_line(repr(key), 40)} — не строка"
                hint = "ключи пишут словами, например bore_mm"
                raise InputError(Problem(address, problem, hint, value=key))
        return {key: plain(source, part, f"{where}.{key}".strip(".")) for key, part in raw.items()}
    if isinstance(raw, list | tuple):
        return [plain(source, part, where) for part in raw]
    if isinstance(raw, _PLAIN):
        return raw
    if hasattr(raw, "tolist"):  # an array or a scalar of numpy, a column of pandas
        return raw.tolist()
    return float(raw) if isinstance(raw, Real | Decimal) else raw


def refuse_endless(source: str, raw: Mapping[str, Any]) -> None:
    """Refuse a non-mapping and excessive lists."""
    if not isinstance(raw, Mapping):
        raise refused(source, "нет исходных данных", "откройте файл двигателя")
    for name, part in raw.items():
        for key, value in part.items() if isinstance(part, dict) else [("", part)]:
            if isinstance(value, list | tuple) and len(value) > MAX_ENTRIES:
                address = ": ".join(filter(None, (source, f"{name}.{key}".rstrip("."))))
                problem = f"в списке {len(value)} строк"
                raise refused(address, problem, f"допустимо не больше {MAX_ENTRIES}")


def refused(source: str, problem: str, hint: str) -> InputError:
    """Return the error of an unreadable file."""
    return InputError(Problem(one_line(source, 120), problem, hint))


def normalise(data: Mapping[str, Any], source: str = "") -> dict[str, Any]:
    """Return the mapping of a file with its values in the types of their keys.

    Raises:
        InputError: It is none, or has a list without end; `source` names it.
    """
    refuse_endless(source, data)
    data = plain(source, data)
    result = {name: _section(name, part) for name, part in data.items()}
    regimes = result.get("regimes")
    if isinstance(regimes, list | tuple):
        result["regimes"] = [_regime(entry) for entry in regimes]
    return result


def _section(name: str, part: object) -> Any:  # noqa: ANN401
    if name not in SECTIONS or not isinstance(part, dict):
        return part
    if name != "gas":
        return in_types(part, SECTIONS[name].model)
    if "source" in part:
        part = {**part, "source": _value(part["source"], str, _SOURCE)}
    source, sources = part.get("source"), SECTIONS["gas"].sources
    model = sources.get(source) if isinstance(source, str) else None
    return in_types(part, model or SECTIONS["gas"].model)


def _regime(entry: object) -> object:
    if not isinstance(entry, dict):
        return entry
    done = in_types(entry, RegimeValues)
    return {**done, "gas": _section("gas", entry["gas"])} if "gas" in entry else done


def in_types(part: dict[str, Any], model: type[StrictModel]) -> dict[str, Any]:
    """Return the values of a section in the types of its keys."""
    specs = hints(model)
    return {
        key: _entry(value, specs[key]) if key in specs else value for key, value in part.items()
    }


def _entry(value: object, spec: Key) -> Any:  # noqa: ANN401
    if isinstance(value, list | tuple):
        return [_entry(item, spec) for item in value]
    if isinstance(value, dict):
        return in_types(value, spec.inner) if spec.inner is not None else value
    if len(spec.types) != 1 or not spec.metas:
        return value
    return _value(value, next(iter(spec.types)), spec.metas[0])


def _value(value: object, kind: type, meta: Meta) -> object:
    if isinstance(value, str) and meta.choices is not None:
        value = choice_of(value, meta.choices)
    if kind is float and isinstance(value, str):
        return number_of(value)
    if kind is int:
        if isinstance(value, str):
            value = number_of(value.strip().removesuffix("°"))
        return int(value) if isinstance(value, float) and value.is_integer() else value
    return value


def choice_of(text: str, choices: Mapping[str, str]) -> str:
    """Choice named by key or label; the text itself if none."""
    folded = _folded(text)
    names = {_folded(name): key for key, label in choices.items() for name in (label, key)}
    if folded in names:
        return names[folded]
    meant = _ONE_WORD.get(folded)
    return meant if meant is not None and meant in choices else text


def _folded(text: str) -> str:
    """Text without spelling variants: spaces, case, ё, kinds of dashes."""
    folded = " ".join(text.casefold().split()).replace("ё", "е")
    return re.sub(r"\s*[-‐‑–—]\s*", "-", folded)


def number_of(text: str) -> object:
    """Return the number of an unambiguous text; else the text itself."""
    plain = text.strip()
    if not _NUMBER.fullmatch(plain) or _AMBIGUOUS.fullmatch(plain):
        return text
    plain = re.sub(r"[ \u00a0\u202f]", "", plain).replace(",", ".").replace("−", "-")
    return int(plain) if re.fullmatch(r"[-+]?\d{1,15}", plain) else float(plain)


def is_ambiguous(text: str) -> bool:
    """Whether a text is a number of two readings."""
    return _AMBIGUOUS.fullmatch(text.strip()) is not None
