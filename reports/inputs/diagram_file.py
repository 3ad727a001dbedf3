"""[gas], source = "file": points of the diagram from a text table beside the input.

A results table saved by DIESEL-RK as text is read as well; its own project format is not
documented and is not read.  The columns of crank angle and of absolute pressure are named in
[gas]; what is not understood is refused, what was made of the rows is told.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reports.inputs.messages import meta_at
from reports.inputs.recorded_table import Recorded, WantedColumns, recorded, text_of
from reports.inputs.sections.gas import TableGasSection
from reports.inputs.units import MPA, number_text
from reports.shared.errors import InputError, Problem, one_line

if TYPE_CHECKING:
    from kshm.arrays import Array


MAX_POINTS = 1500
THINNED_DEG = 0.5
LONE_GAP = 4.0  # times the gaps on both sides
CLOSING = 0.02  # of the greatest pressure
ATMOSPHERE_MPA = 0.101325  # a gauge reads no less than minus that
_LIMITS = meta_at(TableGasSection, ("points", 0, 1))
assert _LIMITS is not None
LIMITS = _LIMITS.minimum or 0.0, _LIMITS.maximum or math.inf  # of a pressure [MPa]
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

    def refused(self, problem: str, hint: str = "", key: str = "gas.file") -> InputError:
        text = f"{one_line(self.file, 60)}: {problem}" if self.file else problem
        return InputError(Problem(f"{self.source}: {key}", text, hint))


@dataclass(frozen=True, slots=True)
class DiagramFill:
    """Mapping with the points of its files, the files, and notes on the conversion."""

    raw: dict[str, Any]
    files: tuple[Path, ...]
    notes: tuple[str, ...]


def with_points(raw: dict[str, Any], folder: Path, source: str) -> DiagramFill:
    """Return the mapping with the points of the named file in place of ``source = "file"``.

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
        table, remarks = _table(gas, folder, source, period, _speed(owner, raw))
        files.append(folder / gas["file"])
        notes.extend(f"{one_line(gas['file'], 60)}: {note}" for note in remarks)
        return {**owner, "gas": table}

    result = filled(raw)
    regimes = result.get("regimes")
    if isinstance(regimes, list):
        result = {**result, "regimes": [filled(entry) for entry in regimes]}
    return DiagramFill(result, tuple(files), tuple(notes))


def _speed(owner: dict[str, Any], raw: dict[str, Any]) -> float | None:
    """Speed [rpm] of a regime, or of the engine."""
    regime = raw.get("regime")
    speeds = (owner.get("speed_rpm"), regime.get("speed_rpm") if isinstance(regime, dict) else None)
    return next((float(n) for n in speeds if isinstance(n, int | float) and 0 < n < math.inf), None)


def _strokes(raw: dict[str, Any]) -> object:
    engine = raw.get("engine")
    return engine.get("strokes") if isinstance(engine, dict) else None


def _table(
    gas: dict[str, Any], folder: Path, source: str, period: float, speed: float | None
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
    pressures, average = gas.get("pressure_column", 2), gas.get("average_cycles", False)
    listed = tuple(pressures) if isinstance(pressures, list) else (pressures,)
    if len(listed) != 1 and (average is not True or not listed):
        problem, hint = (
            "столбцов давления несколько",
            "задайте average_cycles = true или один столбец",
        )
        raise refusal.refused(problem, hint, key="gas.pressure_column")
    columns = WantedColumns(
        gas.get("angle_column", 1), listed, frozenset({*UNITS_MPA, *_ALSO, *_ANGLES}),
        refusal.refused,
    )  # fmt: skip
    rows = recorded(text_of(folder / path, refusal.refused), columns)
    if average is True and not isinstance(pressures, list):
        rows = _with_cycles_beside(rows, refusal)
    called = one_line(str(gas["pressure_unit"]), 20)
    _check_highest(rows, unit, called, refusal)
    turn = (360.0 if period == 720.0 else 0.0) - float(tdc)
    points, notes = _closed(rows, turn, period, (average, speed), refusal)
    _check_lowest(points, rows, unit, called, average is True, refusal)
    others = {key: value for key, value in gas.items() if key not in KEYS}
    points_mpa = [[angle, pressure * unit] for angle, pressure in points]
    return {"interpolation": "monotone", **others, "source": "table", "points": points_mpa}, notes


def _with_cycles_beside(rows: Recorded, refusal: _FileRefusal) -> Recorded:
    """Take the columns behind that of pressures, where each is a cycle."""
    import numpy as np

    from reports.inputs.recorded_angles import alike_columns

    columns = [np.array(column) for column in rows.beside]
    count = alike_columns(np.array(rows.pressures[0]), columns)
    if 0 < count < len(columns):
        problem = f"столбцов циклов подряд {count + 1}, а за ними другие числа"
        hint = "назовите столбцы циклов: pressure_column = [2, 3, 4]"
        raise refusal.refused(problem, hint, key="gas.pressure_column")
    return replace(rows, pressures=(*rows.pressures, *rows.beside[:count]))


def _unit(text: object, refusal: _FileRefusal) -> float:
    """Return the unit of pressure in MPa, whatever its case and language."""
    word = str(text or "").strip().casefold().replace(" ", "")
    unit = UNITS_MPA.get(_ALSO.get(word, word))
    if unit is None:
        hint = "допустимо: " + ", ".join(UNITS_MPA)
        problem = "не указана единица давления"
        if word:
            problem = f"неизвестная единица давления «{one_line(str(text), 20)}»"
        raise refusal.refused(problem, hint, key="gas.pressure_unit")
    return unit


def _check_highest(rows: Recorded, unit: float, called: str, refusal: _FileRefusal) -> None:
    """Refuse pressures beyond the limit, in one line for all."""
    high = LIMITS[1]
    bad = [
        i for i, group in enumerate(zip(*rows.pressures, strict=True)) if max(group) * unit > high
    ]
    if bad:
        value = number_text(max(column[bad[0]] for column in rows.pressures))
        problem = f"строка {rows.lines[bad[0]]}: давление {value} {called}{_more(bad)}"
        raise refusal.refused(problem, f"допустимо до {MPA.text(high)}: проверьте pressure_unit")


def _check_lowest(
    points: list[tuple[float, float]], rows: Recorded, unit: float, called: str,
    is_mean: bool, refusal: _FileRefusal,
) -> None:  # fmt: skip
    """Refuse absolute pressures that are none, with what they look like."""
    import numpy as np

    low = LIMITS[0]
    if min(pressure for _, pressure in points) * unit >= low:
        return
    if is_mean:
        bad = [i for i, (_, pressure) in enumerate(points) if pressure * unit < low]
        where, value = f"при {number_text(round(points[bad[0]][0], 3))}°", points[bad[0]][1]
        pressures = np.array([pressure for _, pressure in points]) * unit
    else:
        bad = [i for i, pressure in enumerate(rows.pressures[0]) if pressure * unit < low]
        where, value = f"строка {rows.lines[bad[0]]}", rows.pressures[0][bad[0]]
        pressures = np.array(rows.pressures[0]) * unit
    problem = f"{where}: давление {number_text(float(f'{value:.6g}'))} {called}{_more(bad)}"
    width = max(5, len(pressures) // 72)  # ten degrees of a cycle
    level = np.convolve(pressures, np.full(width, 1 / width), "valid").min()
    if level >= low:
        hint = "похоже на шум датчика: запишите несколько циклов, подряд или в столбцах, и задайте "
        raise refusal.refused(problem, hint + "average_cycles = true: давления будут усреднены")
    if pressures.min() < -ATMOSPHERE_MPA:
        hint = "ниже −1,013 бар не бывает ни абсолютного, ни избыточного давления: проверьте нуль "
        raise refusal.refused(problem, hint + "датчика, столбец и единицу")
    hint = "нужно абсолютное давление: похоже, в файле избыточное, прибавьте атмосферное"
    raise refusal.refused(problem, hint)


def _more(bad: list[int]) -> str:
    return f", таких строк ещё {len(bad) - 1}" if len(bad) > 1 else ""


def _closed(
    rows: Recorded, turn: float, period: float, how: tuple[object, float | None],
    refusal: _FileRefusal,
) -> tuple[list[tuple[float, float]], list[str]]:  # fmt: skip
    """Return closed points over one cycle from 0 to its end, and notes on the conversion.

    ``how`` is whether cycles are averaged, and the speed [rpm].
    """
    import numpy as np

    from reports.inputs.recorded_angles import angles_fault

    average, speed = how
    angles, pressures = np.array(rows.angles), np.mean(rows.pressures, axis=0)
    fault = angles_fault(angles, pressures, rows.heads, period, speed)
    if fault is not None:
        raise refusal.refused(*fault)
    # A new cycle may begin with the angles of the first one.
    angles = angles + period * np.cumsum(np.diff(angles, prepend=angles[0]) < -period / 2)
    cycles, step = _cycles(angles, period, average, refusal)
    at = np.round((angles + turn) % period, 6) % period
    notes = []
    if len(rows.pressures) > 1:
        notes.append(f"давления столбцов усреднены: {len(rows.pressures)}")
    if cycles > 1:
        at, pressures = _means(at, pressures, step, period)
        notes.append(f"давления {cycles} циклов усреднены по углу")
    else:
        at, pressures = _single(at, pressures, refusal)
    if len(at) > MAX_POINTS:
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
    """Return number of whole cycles and their step; refuse several unless averaging is wanted."""
    import numpy as np

    from reports.inputs.recorded_angles import is_several

    spread = float(angles.max() - angles.min())
    gaps = np.diff(np.sort(angles))
    step = float(np.median(gaps[gaps > 1e-6])) if (gaps > 1e-6).any() else period
    if not is_several(angles, period):
        return 1, step
    if average is not True:
        span = number_text(round(spread, 3))
        problem = f"углы занимают {span}°, больше цикла {number_text(period)}°"
        hint = "оставьте один цикл или задайте average_cycles = true: давления будут усреднены"
        raise refusal.refused(problem, hint)
    cycles = round((spread + step / 2) / period)
    if cycles < 2 or abs(spread + step / 2 - cycles * period) > step / 2 + 1e-6:
        problem = f"углы занимают {number_text(round(spread / period, 2))} цикла"
        raise refusal.refused(problem, "оставьте целое число циклов")
    return cycles, step


def _means(at: Array, pressures: Array, width: float, period: float) -> tuple[Array, Array]:
    """Mean angle and pressure of each stretch around the multiples of a width."""
    import numpy as np

    count = round(period / width)
    # Beyond the last middle lies the first one.
    wrapped = np.where(at >= period - width / 2 - 1e-9, at - period, at)
    indices = np.floor(wrapped / width + 0.5 + 1e-9).astype(int)
    held = np.bincount(indices, minlength=count)
    filled = held > 0
    means = (np.bincount(indices, values, count)[filled] / held[filled]
             for values in (wrapped, pressures))  # fmt: skip
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
        problem = f"при {number_text(float(at[off][0]))}° два разных давления"
        raise refusal.refused(problem, "проверьте столбцы и угол ВМТ")
    return angles, means


def _gaps(at: Array, period: float, refusal: _FileRefusal) -> Iterator[str]:
    """Yield a note on a lone gap; refuse a gap too wide."""
    import numpy as np

    from reports.inputs.recorded_angles import WIDEST_GAP_DEG

    gaps = np.diff(at, append=at[0] + period)
    if gaps.max() > WIDEST_GAP_DEG:
        problem = f"между точками {number_text(round(float(gaps.max()), 6))}°, "
        hint = f"допустимо до {number_text(WIDEST_GAP_DEG)}°"
        raise refusal.refused(f"{problem}диаграмма не покрывает цикл", hint)
    beside = np.maximum(np.roll(gaps, 1), np.roll(gaps, -1))
    for i in np.flatnonzero(gaps > LONE_GAP * beside):
        ends = (number_text(float(angle)) for angle in (at[i], at[i] + gaps[i]))
        yield f"между {' и '.join(ends)}° точек нет"
