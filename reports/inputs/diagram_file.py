"""[gas], source = "file": points of the diagram from a text table beside the input.

The file is a plain table of numbers: CSV with commas or semicolons, or columns between
blanks or tabs, such as a recorder writes or a results table saved by DIESEL-RK as text.  Its
own project format is not documented and is not read.  The columns of crank angle and of
absolute pressure are named in [gas]; what is not understood is refused, what was made of the
rows is told.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reports.inputs.messages import meta_at
from reports.inputs.sections.gas import TableGasSection
from reports.inputs.units import MPA, number_text
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.file_types import CALLED, TEXT, UTF16, kind_of, read_bytes

if TYPE_CHECKING:
    from kshm.arrays import Array


MAX_BYTES = 8_000_000
LEAST_ROWS = 3
# Separators between columns; of blanks any number makes one.
_CALLED = {";": "«;»", "\t": "табуляцию", ",": "запятую", " ": "пробелы"}
_NUMBER = re.compile(r"[-+]?(\d+([.,]\d+|\.)?|\.\d+)([eE][-+]?\d+)?")
Refuse = Callable[..., InputError]
Row = tuple[int, list[str]]


@dataclass(frozen=True, slots=True)
class Recorded:
    """Angles and pressures as the file has them, with the number of each line."""

    lines: tuple[int, ...]
    angles: tuple[float, ...]
    pressures: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class WantedColumns:
    """Columns to read, by number from 1 or by name, and the words for refusals."""

    angle: object
    pressure: object
    units: frozenset[str]  # what a heading says of a unit alone
    refused: Refuse


class _UnfitError(Exception):
    """Separator that does not read the file; ``rows`` counts the rows it did read."""

    def __init__(self, rows: int, error: InputError, *, final: bool = False) -> None:
        super().__init__()
        self.rows, self.error, self.final = rows, error, final


def text_of(file: Path, refused: Refuse) -> str:
    """The text of a recorder's or a spreadsheet's file: UTF-8, UTF-16 or Windows-1251.

    Raises:
        InputError: it is missing, too large or no text.
    """
    data = read_bytes(file, MAX_BYTES, "оставьте в нём только диаграмму")
    kind = kind_of(data)
    if kind not in (TEXT, UTF16):
        raise refused(f"{CALLED[kind]}, а нужна текстовая таблица", "сохраните её как CSV")
    for encoding in ("utf-16",) if kind == UTF16 else ("utf-8-sig", "cp1251"):
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            continue
    raise refused("кодировка не UTF-8, UTF-16 или Windows-1251", "сохраните как «CSV UTF-8»")


def recorded(text: str, wanted: WantedColumns) -> Recorded:
    """Columns of angle and pressure of a table.

    Raises:
        InputError: there is no table of numbers, or it can be read in two ways.
    """
    readings: dict[Recorded, str] = {}
    unfit: list[_UnfitError] = []
    for separator, called in _CALLED.items():
        try:
            reading = _read(_rows(text, separator), separator, wanted)
        except _UnfitError as error:
            unfit.append(error)
        else:
            readings.setdefault(reading, f"столбцы через {called}")
    for reason in unfit:
        if reason.final:
            raise reason.error
    if len(readings) > 1:
        ways = " или ".join(readings.values())
        raise wanted.refused(f"числа читаются двояко: {ways}", "сохраните таблицу через «;»")
    if not readings:
        raise max(unfit, key=lambda reason: reason.rows).error
    return next(iter(readings))


def _rows(text: str, separator: str) -> list[Row]:
    """Numbers of lines and their fields; empty lines are left out."""
    if separator == " ":
        split: Iterator[Row] = ((n, line.split()) for n, line in enumerate(text.splitlines(), 1))
        return [row for row in split if row[1]]
    reader = csv.reader(io.StringIO(text), delimiter=separator, skipinitialspace=True)
    try:
        rows = [(reader.line_num, [field.strip() for field in fields]) for fields in reader]
    except csv.Error:  # a field without end
        return []
    return [row for row in rows if any(row[1])]


def _value(field: str) -> float | None:
    plain = field.replace("−", "-")
    if not _NUMBER.fullmatch(plain):
        return None
    value = float(plain.replace(",", "."))
    return value if math.isfinite(value) else None


def _read(rows: list[Row], separator: str, wanted: WantedColumns) -> Recorded:
    """Columns of angle and pressure between separators of one kind.

    Raises:
        _UnfitError: it is not so that the file is written.
    """
    nothing = wanted.refused("не найдена таблица чисел", "нужны столбцы угла и давления")
    numeric = [i for i, (_, row) in enumerate(rows) if sum(_value(f) is not None for f in row) > 1]
    if not numeric:
        raise _UnfitError(0, nothing)
    columns = tuple(
        _column(column, rows, numeric[0], key, wanted, len(numeric))
        for column, key in (
            (wanted.angle, "gas.angle_column"), (wanted.pressure, "gas.pressure_column"),
        )
    )  # fmt: skip
    cells = [[row[c] if c < len(row) else "" for c in columns] for _, row in rows]
    values = [[_value(cell) for cell in pair] for pair in cells]
    first = next((i for i, pair in enumerate(values) if None not in pair), len(rows))
    while first and values[first - 1][0] is not None:
        first -= 1  # a pressure that is no number is a fault, not a heading
    fault = _fault(rows, cells, values, first, separator, wanted.refused)
    if fault is not None:
        raise fault
    body = rows[first:]
    if len(body) < LEAST_ROWS:
        raise _UnfitError(0, nothing)
    if separator == "," and _torn(rows[:first], body, columns, wanted.units):
        what = "запятая стоит и между столбцами, и в дробях"
        torn = wanted.refused(what, "сохраните таблицу через «;» или числа с точкой")
        raise _UnfitError(len(body), torn, final=True)
    angles, pressures = zip(*values[first:], strict=True)
    return Recorded(tuple(line for line, _ in body), angles, pressures)


def _fault(
    rows: list[Row], cells: list[list[str]], values: list[list[float | None]], first: int,
    separator: str, refused: Refuse,
) -> _UnfitError | None:  # fmt: skip
    """First row that breaks the table of numbers."""
    signs = ["", ""]
    for i in range(first, len(rows)):
        line, fields = rows[i]
        for column, (cell, value) in enumerate(zip(cells[i], values[i], strict=True)):
            if value is None:
                what = f"строка {line}: не числа" + (f" («{one_line(cell, 20)}»)" if cell else "")
                return _UnfitError(i - first, refused(what, "оставьте одну таблицу без пропусков"))
            sign = "".join(mark for mark in ".," if mark in cell)
            signs[column] = signs[column] or sign
            if sign and sign != signs[column]:
                what = f"строка {line}: в столбце стоят и точка, и запятая"
                return _UnfitError(i - first, refused(what, "оставьте один знак дроби"))
        if separator in ", " and len(fields) != len(rows[first][1]):
            what = f"строка {line}: чисел {len(fields)}, а выше {len(rows[first][1])}"
            hint = "в таблице должно быть одно число столбцов"
            return _UnfitError(i - first, refused(what, hint))
    return None


def _column(
    column: object, rows: list[Row], first: int, key: str, wanted: WantedColumns, score: int
) -> int:
    """Index of a column by its number from 1 or by its name in any row of the heading."""
    width = len(rows[first][1])
    if isinstance(column, int) and not isinstance(column, bool):
        if 1 <= column <= width:
            return column - 1
        what, hint = f"нет столбца {column}", f"в таблице столбцов {width}"
        raise _UnfitError(score, wanted.refused(what, hint, key=key))
    names = [fields for _, fields in rows[:first]]
    word = str(column).strip().casefold()
    for fields in names:
        places = [i for i, field in enumerate(fields) if field.casefold() == word]
        exact = [i for i in places if fields[i] == column]
        if len(exact or places) == 1:
            return (exact or places)[0]
        if places:
            what = f"столбцов «{one_line(str(column), 40)}» несколько"
            raise _UnfitError(score, wanted.refused(what, "укажите номер", key=key))
    heads = [one_line(name, 20) for fields in names for name in fields if name]
    hint = f"есть: {', '.join(heads[:12])}" if heads else "у столбцов нет заголовков: укажите номер"
    what = f"нет столбца «{one_line(str(column), 40)}»"
    raise _UnfitError(score, wanted.refused(what, hint, key=key))


def _torn(
    heads: list[Row], body: list[Row], columns: tuple[int, ...], units: frozenset[str]
) -> bool:
    """Whether commas between the columns may be decimal ones."""
    rows = [fields for _, fields in body]
    if any("." in field or "," in field for fields in rows for field in fields):
        return False
    behind = [c + 1 for c in columns if c + 1 not in columns and c + 1 < len(rows[0])]
    if not any(all(fields[c].isdecimal() for fields in rows) for c in behind):
        return False
    return not any(
        len(names) == len(rows[0]) and not any(name.casefold() in units for name in names)
        for _, names in heads
    )


MOST_POINTS = 1500
THINNED_DEG = 0.5
WIDEST_GAP_DEG = 45.0
LONE_GAP = 4.0  # times the gaps on both sides
CLOSING = 0.02  # of the greatest pressure
UNITS_MPA = {
    "mpa": 1.0,
    "bar": 0.1,
    "kpa": 0.001,
    "pa": MPA.from_si(1.0),
    "kgf_cm2": 0.0980665,
    "atm": 0.101325,
    "psi": 0.006894757293168,
}
_ALSO = {
    "мпа": "mpa", "бар": "bar", "кпа": "kpa", "па": "pa", "атм": "atm", "кгс/см2": "kgf_cm2",
    "кгс/см²": "kgf_cm2", "ат": "kgf_cm2", "at": "kgf_cm2", "kgf/cm2": "kgf_cm2",
    "kgf/cm²": "kgf_cm2", "kg/cm2": "kgf_cm2", "кг/см2": "kgf_cm2", "кг/см²": "kgf_cm2",
}  # fmt: skip
_ANGLES = {"°", "deg", "deg.", "град", "град.", "°пкв", "° пкв", "°ca", "rad", "рад"}
KEYS = {
    "file", "angle_column", "pressure_column", "pressure_unit", "firing_tdc_deg",
    "average_cycles",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class _FileRefusal:
    source: str
    file: str

    def refused(self, what: str, hint: str = "", key: str = "gas.file") -> InputError:
        text = f"{one_line(self.file, 60)}: {what}" if self.file else what
        return InputError(Problem(f"{self.source}: {key}", text, hint))


@dataclass(frozen=True, slots=True)
class DiagramFill:
    """Mapping with the points of its files, the files, and notes on the conversion."""

    raw: dict[str, Any]
    files: tuple[Path, ...]
    notes: tuple[str, ...]


def with_points(raw: dict[str, Any], folder: Path, source: str) -> DiagramFill:
    """The mapping with the points of the named file in place of ``source = "file"``.

    Raises:
        InputError: the file is missing or is no table of angles and pressures.
    """
    period = 360.0 if _strokes(raw) == 2 else 720.0
    files: list[Path] = []
    notes: list[str] = []

    def filled(owner: Any) -> Any:  # noqa: ANN401 - a person may have written anything
        gas = owner.get("gas") if isinstance(owner, dict) else None
        if not isinstance(gas, dict) or gas.get("source") != "file":
            return owner
        table, remarks = _table(gas, folder, source, period)
        files.append(folder / gas["file"])
        notes.extend(f"{one_line(gas['file'], 60)}: {note}" for note in remarks)
        return {**owner, "gas": table}

    result = filled(raw)
    regimes = result.get("regimes")
    if isinstance(regimes, list):
        result = {**result, "regimes": [filled(entry) for entry in regimes]}
    return DiagramFill(result, tuple(files), tuple(notes))


def _strokes(raw: dict[str, Any]) -> object:
    engine = raw.get("engine")
    return engine.get("strokes") if isinstance(engine, dict) else None


def _table(
    gas: dict[str, Any], folder: Path, source: str, period: float
) -> tuple[dict[str, Any], list[str]]:
    name = gas.get("file")
    if not isinstance(name, str) or not name:
        refusal = _FileRefusal(source, "")
        raise refusal.refused("не указан файл с диаграммой", 'например, file = "diagram.csv"')
    refusal = _FileRefusal(source, name)
    unit = _unit(gas.get("pressure_unit"), refusal)
    tdc = gas.get("firing_tdc_deg", 360.0 if period == 720.0 else 0.0)
    if isinstance(tdc, bool) or not isinstance(tdc, int | float) or not math.isfinite(tdc):
        raise refusal.refused("нужно число", "угол ВМТ сгорания в файле", key="gas.firing_tdc_deg")
    path = Path(name)
    if path.is_absolute() or ".." in path.parts:
        raise refusal.refused("файл должен лежать рядом с исходными данными", "укажите только имя")
    columns = WantedColumns(
        gas.get("angle_column", 1), gas.get("pressure_column", 2),
        frozenset({*UNITS_MPA, *_ALSO, *_ANGLES}), refusal.refused,
    )  # fmt: skip
    rows = recorded(text_of(folder / path, refusal.refused), columns)
    _check_pressures(rows, unit, str(gas["pressure_unit"]), refusal)
    turn = (360.0 if period == 720.0 else 0.0) - float(tdc)
    points, notes = _closed(rows, turn, period, gas.get("average_cycles", False), refusal)
    kept = {key: value for key, value in gas.items() if key not in KEYS}
    points_mpa = [[angle, pressure * unit] for angle, pressure in points]
    return {"interpolation": "monotone", **kept, "source": "table", "points": points_mpa}, notes


def _unit(given: object, refusal: _FileRefusal) -> float:
    """Unit of pressure in MPa, whatever its case and language."""
    word = str(given or "").strip().casefold().replace(" ", "")
    unit = UNITS_MPA.get(_ALSO.get(word, word))
    if unit is None:
        hint = "допустимо: " + ", ".join(UNITS_MPA)
        what = "не указана единица давления"
        if word:
            what = f"неизвестная единица давления «{one_line(str(given), 20)}»"
        raise refusal.refused(what, hint, key="gas.pressure_unit")
    return unit


def _check_pressures(rows: Recorded, unit: float, called: str, refusal: _FileRefusal) -> None:
    """Refuse impossible absolute pressures, in one line for all."""
    limits = meta_at(TableGasSection, ("points", 0, 1))
    low, high = (limits.minimum or 0.0, limits.maximum or math.inf) if limits else (0.0, math.inf)
    for bad, hint in (
        ([i for i, p in enumerate(rows.pressures) if p * unit < low],
         "нужно абсолютное давление: похоже, в файле избыточное, прибавьте атмосферное"),
        ([i for i, p in enumerate(rows.pressures) if p * unit > high],
         f"допустимо до {MPA.text(high)}: проверьте pressure_unit"),
    ):  # fmt: skip
        if bad:
            value = number_text(rows.pressures[bad[0]])
            more = f", таких строк ещё {len(bad) - 1}" if len(bad) > 1 else ""
            what = f"строка {rows.lines[bad[0]]}: давление {value} {one_line(called, 20)}{more}"
            raise refusal.refused(what, hint)


def _closed(
    rows: Recorded, turn: float, period: float, average: object, refusal: _FileRefusal
) -> tuple[list[tuple[float, float]], list[str]]:
    """Closed points over one cycle from 0 to its end, and notes on the conversion."""
    import numpy as np

    angles, pressures = np.array(rows.angles), np.array(rows.pressures)
    # A new cycle may begin with the angles of the first one.
    angles = angles + period * np.cumsum(np.diff(angles, prepend=angles[0]) < -period / 2)
    cycles, step = _cycles(angles, period, average, refusal)
    at = np.round((angles + turn) % period, 6) % period
    notes = []
    if cycles > 1:
        at, pressures = _means(at, pressures, step, period)
        notes.append(f"давления {cycles} циклов усреднены по углу")
    else:
        at, pressures = _single(at, pressures, refusal)
    if len(at) > MOST_POINTS:
        notes.append(f"{len(at)} строк усреднены до точек через {number_text(THINNED_DEG)}°")
        at, pressures = _means(at, pressures, THINNED_DEG, period)
    notes += _gaps(at, period, refusal)
    points = list(zip(at.tolist(), pressures.tolist(), strict=True))
    (first, p_first), (last, p_last) = points[0], points[-1]
    if first > 0:  # the seam of the cycle, on the straight line between its neighbours
        share = (period - last) / (first + period - last)
        points.insert(0, (0.0, p_last + share * (p_first - p_last)))
    return [*points, (period, points[0][1])], notes


def _cycles(
    angles: Array, period: float, average: object, refusal: _FileRefusal
) -> tuple[int, float]:
    """Number of whole cycles and their step; refuse several unless averaging is wanted."""
    import numpy as np

    spread = float(angles.max() - angles.min())
    gaps = np.diff(np.sort(angles))
    step = float(np.median(gaps[gaps > 1e-6])) if (gaps > 1e-6).any() else period
    if spread <= period + 1e-6:
        return 1, step
    if average is not True:
        given = number_text(round(spread, 3))
        what = f"углы занимают {given}°, больше цикла {number_text(period)}°"
        hint = "оставьте один цикл или задайте average_cycles = true: давления будут усреднены"
        raise refusal.refused(what, hint)
    cycles = round((spread + step / 2) / period)
    if cycles < 2 or abs(spread + step / 2 - cycles * period) > step / 2 + 1e-6:
        what = f"углы занимают {number_text(round(spread / period, 2))} цикла"
        raise refusal.refused(what, "оставьте целое число циклов")
    return cycles, step


def _means(at: Array, pressures: Array, width: float, period: float) -> tuple[Array, Array]:
    """Mean angle and pressure of each stretch around the multiples of a width."""
    import numpy as np

    count = round(period / width)
    # Beyond the last middle lies the first one.
    near = np.where(at >= period - width / 2 - 1e-9, at - period, at)
    places = np.floor(near / width + 0.5 + 1e-9).astype(int)
    held = np.bincount(places, minlength=count)
    filled = held > 0
    means = (np.bincount(places, values, count)[filled] / held[filled]
             for values in (near, pressures))  # fmt: skip
    middle, mean = means
    middle = np.round(middle, 6)
    if middle[0] < 0:
        middle, mean = np.append(middle[1:], middle[0] + period), np.append(mean[1:], mean[0])
    return middle, mean


def _single(at: Array, pressures: Array, refusal: _FileRefusal) -> tuple[Array, Array]:
    """Points in the order of angles, the ends of the cycle merged."""
    import numpy as np

    angles, which = np.unique(at, return_inverse=True)
    held = np.bincount(which)
    means = np.bincount(which, pressures) / held
    off = np.abs(pressures - means[which]) > CLOSING / 2 * pressures.max()
    if off.any():
        what = f"при {number_text(float(at[off][0]))}° два разных давления"
        raise refusal.refused(what, "проверьте столбцы и угол ВМТ")
    return angles, means


def _gaps(at: Array, period: float, refusal: _FileRefusal) -> Iterator[str]:
    """Yield a note on a lone gap; refuse a gap too wide."""
    import numpy as np

    gaps = np.diff(at, append=at[0] + period)
    if gaps.max() > WIDEST_GAP_DEG:
        what = f"между точками {number_text(round(float(gaps.max()), 6))}°, "
        hint = f"допустимо до {number_text(WIDEST_GAP_DEG)}°"
        raise refusal.refused(f"{what}диаграмма не покрывает цикл", hint)
    beside = np.maximum(np.roll(gaps, 1), np.roll(gaps, -1))
    for i in np.flatnonzero(gaps > LONE_GAP * beside):
        ends = (number_text(float(angle)) for angle in (at[i], at[i] + gaps[i]))
        yield f"между {' и '.join(ends)}° точек нет"
