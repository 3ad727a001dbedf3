"""The bytes of an input file: bounded, decoded, and harmless to the parser."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from reports.shared.errors import InputError, Problem, one_line
from reports.shared.kinds import CALLED, TEXT, UTF16, kind_of
from reports.shared.reading import read_bytes

MAX_BYTES = 2_000_000
MAX_LINES = 20_000
MAX_DOTS = 40
MAX_ENTRIES = 10_000  # of a list: longer ones only hold a process up
_DECIMAL = re.compile(r"(?<![\w.])\d+\.\d+(?:[eE][-+]?\d+)?(?![\w.])")


def read_text(file: Path) -> str:
    """Return the text of a file a person gave.

    Raises:
        InputError: It is missing, unreadable, too large or no UTF-8 text.
    """
    data, source = read_bytes(file, MAX_BYTES, "это не файл исходных данных"), file.name
    kind = kind_of(data)
    if kind == UTF16:
        raise refused(source, "кодировка UTF-16", "сохраните файл в UTF-8")
    if kind != TEXT:
        raise refused(source, f"{CALLED[kind]}, а нужен текст TOML", "выберите другой файл")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        if error.reason == "unexpected end of data":
            what = "файл обрывается посреди знака"
            raise refused(source, what, "восстановите его конец") from None
        row = data.count(b"\n", 0, error.start) + 1
        what = f"строка {row}: не UTF-8 (возможно, Windows-1251)"
        raise refused(source, what, "сохраните файл в UTF-8") from None


def refuse_bomb(source: str, text: str) -> None:
    """Refuse text that would exhaust the TOML parser."""
    # tomllib's memory grows with the square of a dotted key's length: a file of
    # 400 KB takes all there is.
    lines = text.split("\n")
    if len(lines) > MAX_LINES:
        what = f"в файле больше {MAX_LINES} строк"
        raise refused(source, what, "это не файл исходных данных")
    for row, line in enumerate(lines, start=1):
        if line.count(".") <= MAX_DOTS or line.lstrip().startswith("#"):
            continue
        if _DECIMAL.sub("", line).count(".") > MAX_DOTS:
            what = f"строка {row}: слишком длинный составной ключ"
            raise refused(source, what, "ключ состоит из одного слова")


def refuse_endless(source: str, raw: Mapping[str, Any]) -> None:
    """Refuse what is no mapping, or has a list so long that to count it holds all up."""
    if not isinstance(raw, dict):
        raise refused(source, "нет исходных данных", "откройте файл двигателя")
    for name, part in raw.items():
        for key, value in part.items() if isinstance(part, dict) else [("", part)]:
            if isinstance(value, list | tuple) and len(value) > MAX_ENTRIES:
                place = ": ".join(filter(None, (source, f"{name}.{key}".rstrip("."))))
                what = f"в списке {len(value)} строк"
                raise refused(place, what, f"допустимо не больше {MAX_ENTRIES}")


def refused(source: str, what: str, hint: str) -> InputError:
    """Return the error of a file that cannot be read at all."""
    return InputError(Problem(one_line(source, 120), what, hint))
