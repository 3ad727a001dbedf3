"""[gas], source = "file": points of the diagram from a text table beside the input.

The file is a plain table of numbers: CSV with commas or semicolons, or columns between
blanks or tabs, such as a results table saved by DIESEL-RK as text.  Its own project
format is not documented and is not read.  The columns of crank angle and of absolute
pressure are named in [gas]; what is not understood is refused.
"""

from __future__ import annotations

import csv
import io
import math
import re
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

from reports.inputs.source import read_text
from reports.inputs.units import MPA, number_text
from reports.shared.errors import InputError, Problem, one_line

MOST_POINTS = 1500
WIDEST_GAP_DEG = 45.0
CLOSING = 0.02  # of the greatest pressure
UNITS_MPA = {
    "mpa": 1.0,
    "bar": 0.1,
    "kpa": 0.001,
    "pa": MPA.from_si(1.0),
    "kgf_cm2": 0.0980665,
    "atm": 0.101325,
}
KEYS = {"file", "angle_column", "pressure_column", "pressure_unit", "firing_tdc_deg"}
_NUMBER = re.compile(r"[-+]?(\d+([.,]\d*)?|[.,]\d+)([eE][-+]?\d+)?")


@dataclass(frozen=True, slots=True)
class _Place:
    source: str
    file: str

    def refused(self, what: str, hint: str = "", key: str = "gas.file") -> InputError:
        text = f"{one_line(self.file, 60)}: {what}" if self.file else what
        return InputError(Problem(f"{self.source}: {key}", text, hint))


def with_points(raw: dict[str, Any], folder: Path, source: str) -> dict[str, Any]:
    """The mapping with the points of the named file in place of ``source = "file"``.

    Raises:
        InputError: the file is missing or is no table of angles and pressures.
    """
    period = 360.0 if _strokes(raw) == 2 else 720.0

    def filled(owner: dict[str, Any]) -> dict[str, Any]:
        gas = owner.get("gas")
        if not isinstance(gas, dict) or gas.get("source") != "file":
            return owner
        return {**owner, "gas": _table(gas, folder, source, period)}

    result = filled(raw)
    regimes = result.get("regimes")
    if isinstance(regimes, list):
        entries = [filled(entry) if isinstance(entry, dict) else entry for entry in regimes]
        result = {**result, "regimes": entries}
    return result


def files_of(raw: dict[str, Any]) -> list[str]:
    """Names of the files that `with_points` reads."""
    regimes = raw.get("regimes")
    owners = [raw, *(regimes if isinstance(regimes, list) else [])]
    parts = [owner.get("gas") for owner in owners if isinstance(owner, dict)]
    return [gas["file"] for gas in parts if isinstance(gas, dict) and gas.get("source") == "file"]


def _strokes(raw: dict[str, Any]) -> object:
    engine = raw.get("engine")
    return engine.get("strokes") if isinstance(engine, dict) else None


def _table(gas: dict[str, Any], folder: Path, source: str, period: float) -> dict[str, Any]:
    name = gas.get("file")
    if not isinstance(name, str) or not name:
        place = _Place(source, "")
        raise place.refused("не указан файл с диаграммой", 'например, file = "diagram.csv"')
    place = _Place(source, name)
    unit = gas.get("pressure_unit")
    if unit not in UNITS_MPA:
        hint = "допустимо: " + ", ".join(UNITS_MPA)
        raise place.refused("не указана единица давления", hint, key="gas.pressure_unit")
    tdc = gas.get("firing_tdc_deg", 360.0 if period == 720.0 else 0.0)
    if isinstance(tdc, bool) or not isinstance(tdc, int | float) or not math.isfinite(tdc):
        raise place.refused("нужно число", "угол ВМТ сгорания в файле", key="gas.firing_tdc_deg")
    path = Path(name)
    if path.is_absolute() or ".." in path.parts:
        raise place.refused("файл должен лежать рядом с исходными данными", "укажите только имя")
    heads, rows = _read(read_text(folder / path), place)
    angle = _column(gas.get("angle_column", 1), heads, rows, place, "gas.angle_column")
    pressure = _column(gas.get("pressure_column", 2), heads, rows, place, "gas.pressure_column")
    turn = (360.0 if period == 720.0 else 0.0) - float(tdc)
    pairs = [(row[angle] + turn, row[pressure] * UNITS_MPA[unit]) for row in rows]
    kept = {key: value for key, value in gas.items() if key not in KEYS}
    return {
        "interpolation": "monotone",
        **kept,
        "source": "table",
        "points": _closed(pairs, period, place),
    }


def _read(text: str, place: _Place) -> tuple[list[str], list[list[float]]]:
    """Heads of the columns, if there are any, and the rows of numbers."""
    lines = [line for line in text.splitlines() if line.strip()]
    delimiter = _delimiter(lines)
    heads: list[str] = []
    rows: list[list[float]] = []
    for number, line in enumerate(lines, 1):
        fields = _fields(line, delimiter)
        values = [_value(field, delimiter) for field in fields]
        found = [value for value in values if value is not None]
        if len(found) == len(values) and len(values) >= 2:
            if rows and len(values) != len(rows[0]):
                what = f"строка {number}: чисел {len(values)}, а выше {len(rows[0])}"
                raise place.refused(what, "в таблице должно быть одно число столбцов")
            rows.append(found)
        elif rows:
            raise place.refused(f"строка {number}: не числа", "оставьте одну таблицу чисел")
        else:
            heads = fields
    if len(rows) < 3:
        raise place.refused("не найдена таблица чисел", "нужны столбцы угла и давления")
    if len(rows) > MOST_POINTS:
        what = f"строк {len(rows)}, а допустимо не больше {MOST_POINTS}"
        raise place.refused(what, "сохраните диаграмму с большим шагом")
    return heads if len(heads) == len(rows[0]) else [], rows


def _delimiter(lines: list[str]) -> str:
    sample = lines[len(lines) // 2] if lines else ""
    for mark in (";", "\t"):
        if mark in sample:
            return mark
    # A comma between digits may be a decimal one: then blanks stand between the columns.
    return "," if ("," in sample and len(sample.split()) < 2) or ", " in sample else " "


def _fields(line: str, delimiter: str) -> list[str]:
    if delimiter == " ":
        return line.split()
    (row,) = csv.reader(io.StringIO(line), delimiter=delimiter)
    fields = [field.strip() for field in row]
    return fields[:-1] if fields and not fields[-1] else fields


def _value(field: str, delimiter: str) -> float | None:
    if not _NUMBER.fullmatch(field):
        return None
    value = float(field.replace(",", ".") if delimiter != "," else field)
    return value if math.isfinite(value) else None


def _column(
    wanted: object, heads: list[str], rows: list[list[float]], place: _Place, key: str
) -> int:
    """Index of a column by its number from 1 or by its head."""
    if isinstance(wanted, int) and not isinstance(wanted, bool):
        if 1 <= wanted <= len(rows[0]):
            return wanted - 1
        what = f"нет столбца {wanted}"
        raise place.refused(what, f"в таблице столбцов {len(rows[0])}", key=key)
    if isinstance(wanted, str) and wanted in heads:
        return heads.index(wanted)
    shown = one_line(str(wanted), 40)
    hint = f"есть: {', '.join(one_line(head, 20) for head in heads[:12])}" if heads else (
        "у столбцов нет заголовков: укажите номер"
    )  # fmt: skip
    raise place.refused(f"нет столбца «{shown}»", hint, key=key)


def _closed(pairs: list[tuple[float, float]], period: float, place: _Place) -> list[list[float]]:
    """Points over one cycle from 0 to its end, the ends being equal."""
    spread = max(a for a, _ in pairs) - min(a for a, _ in pairs)
    if spread > period + 1e-6:
        what = f"углы занимают {number_text(spread)}°, больше цикла {number_text(period)}°"
        raise place.refused(what, "оставьте один цикл")
    points: dict[float, float] = {}
    highest = max(p for _, p in pairs)
    for angle, pressure in pairs:
        at = round(angle % period, 6) % period
        if at in points and abs(points[at] - pressure) > CLOSING * highest:
            what = f"при {number_text(at)}° два разных давления"
            raise place.refused(what, "проверьте столбцы и угол ВМТ")
        points.setdefault(at, pressure)
    ordered = sorted(points.items())
    gaps = [b[0] - a[0] for a, b in pairwise(ordered)]
    gaps.append(ordered[0][0] + period - ordered[-1][0])
    if max(gaps) > WIDEST_GAP_DEG:
        what = f"между точками {number_text(max(gaps))}°, диаграмма не покрывает цикл"
        raise place.refused(what, f"допустимо до {number_text(WIDEST_GAP_DEG)}°")
    if ordered[0][0] > 0:  # the seam of the cycle, on the straight line between its neighbours
        (first, p_first), (last, p_last) = ordered[0], ordered[-1]
        share = (period - last) / (first + period - last)
        ordered.insert(0, (0.0, p_last + share * (p_first - p_last)))
    ordered.append((period, ordered[0][1]))
    return [[angle, pressure] for angle, pressure in ordered]
