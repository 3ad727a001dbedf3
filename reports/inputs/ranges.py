"""Section [variants] of a base file: parameters that differ between students."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from reports.shared.errors import Problem, one_line

SECTION = "variants"
MAX_VALUES = 100_000
_IDLE = ("report", "sheet", "workbook", "checks")  # sections that nothing is calculated from


@dataclass(frozen=True, slots=True)
class ParameterRange:
    """Values of a parameter; ``path`` as in ``reports.inputs.fields``."""

    key: str
    path: tuple[str | int, ...]
    values: tuple[float | int | str, ...]

    @staticmethod
    def path_of(key: str) -> tuple[str | int, ...]:
        """``"crankshaft.webs.1.mass_kg"`` as a path with an index from 0."""
        return tuple(int(part) - 1 if part.isdigit() else part for part in key.split("."))


def split_ranges(raw: Mapping[str, Any]) -> tuple[dict[str, Any], Any]:
    """Return the sections of the engine, and the section [variants] or None."""
    others = {key: value for key, value in raw.items() if key != SECTION}
    return others, raw.get(SECTION)


def read_ranges(
    section: object, base: Mapping[str, Any], source: str
) -> tuple[list[ParameterRange], list[Problem]]:
    """Ranges of a base file, and problems with them.

    Each key names a parameter of the file, ``"geometry.bore_mm"``; lists count from 1:
    ``"crankshaft.webs.1.mass_kg"``.  Its value is ``{min, max, step}`` or ``{values = [...]}``.
    """
    where = one_line(source, 120)
    if not isinstance(section, Mapping) or not section:
        text = "раздел [variants] пуст"
        return [], [
            Problem(where, text, 'пример: "geometry.bore_mm" = {min = 84, max = 92, step = 1}')
        ]
    ranges: list[ParameterRange] = []
    problems: list[Problem] = []
    for key, entry in section.items():
        spot = f"{where}: variants.{one_line(str(key), 80)}"
        path = ParameterRange.path_of(str(key))
        current = _at(base, path)
        if current is None:
            problems.append(Problem(spot, "в файле нет такого параметра", "задайте его значение"))
            continue
        if path[0] in _IDLE or path == ("engine", "name"):
            problem = "расчёт от этого параметра не зависит"
            problems.append(Problem(spot, problem, "назовите другой параметр"))
            continue
        values, problem, hint = _values(entry, current)
        if problem:
            problems.append(Problem(spot, problem, hint))
        else:
            ranges.append(ParameterRange(str(key), path, values))
    return ranges, problems


def _at(base: Mapping[str, Any], path: tuple[str | int, ...]) -> float | int | str | None:
    value: Any = base
    for part in path:
        if part == -1:  # lists count from 1
            return None
        try:
            value = value[part]
        except (KeyError, IndexError, TypeError):
            return None
    return value if isinstance(value, (int, float, str)) and not isinstance(value, bool) else None


def _values(
    entry: object, current: float | int | str
) -> tuple[tuple[float | int | str, ...], str, str]:
    """Values, or the error and a hint."""
    example = "нужно {min = 84, max = 92, step = 1} или {values = [84, 88]}"
    if not isinstance(entry, Mapping):
        return (), "это не диапазон", example
    if set(entry) == {"values"} and isinstance(entry["values"], list):
        values = entry["values"]
        kind = (str,) if isinstance(current, str) else (int, float)
        if not values or not all(isinstance(v, kind) and not isinstance(v, bool) for v in values):
            return (), "неверный список values", "перечислите значения того же рода, что в файле"
        if len({repr(v) for v in values}) < len(values):
            return (), "в списке values есть повторы", "удалите их"
        return tuple(_like(v, current) for v in values), "", ""
    if set(entry) != {"min", "max", "step"}:
        return (), "неверные ключи диапазона", example
    low, high, step = (entry[key] for key in ("min", "max", "step"))
    for number in (low, high, step):
        if isinstance(number, bool) or not isinstance(number, (int, float)):
            return (), "min, max и step должны быть числами", example
        if not math.isfinite(number):
            return (), "min, max и step должны быть конечными числами", example
    if isinstance(current, str):
        return (), "у текстового параметра нет диапазона", "перечислите значения: {values = [...]}"
    if step <= 0 or high < low:
        return (), "нужно min ≤ max и step > 0", example
    # Of whole numbers a quotient may be beyond the floats, of floats infinite.
    if high - low > step * (MAX_VALUES - 1):
        return (), "слишком мелкий шаг", "увеличьте step"
    count = math.floor((high - low) / step + 1e-9) + 1
    # Decimal steps as a person writes them: 0.1 + 0.2 must give 0.3.
    digits = max(_digits(low), _digits(step))
    return tuple(_like(round(low + i * step, digits), current) for i in range(count)), "", ""


def _digits(number: float) -> int:
    text = repr(float(number))
    if "e" in text:
        return 12
    return len(text.rpartition(".")[2].rstrip("0"))


def _like(value: float | int | str, current: float | int | str) -> float | int | str:
    """Return a value as an integer where the file has an integer."""
    if isinstance(value, str):
        return value
    if isinstance(current, int) and float(value).is_integer():
        return int(value)
    return float(value) if isinstance(current, float) else value
