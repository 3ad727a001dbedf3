"""[gas], source = "file": points of the diagram from a text table beside the input.

The file is a plain table of numbers: CSV with commas or semicolons, or columns between
blanks or tabs, such as a recorder writes or a results table saved by DIESEL-RK as text.  Its
own project format is not documented and is not read.  The columns of crank angle and of
absolute pressure are named in [gas]; what is not understood is refused, what was made of the
rows is told.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reports.inputs.diagram_rows import Recorded, Wanted, recorded, text_of
from reports.inputs.messages import meta_at
from reports.inputs.sections.gas import TableGasSection
from reports.inputs.units import MPA, number_text
from reports.shared.errors import InputError, Problem, one_line

if TYPE_CHECKING:
    from kshm.arrays import Array

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
class _Place:
    source: str
    file: str

    def refused(self, what: str, hint: str = "", key: str = "gas.file") -> InputError:
        text = f"{one_line(self.file, 60)}: {what}" if self.file else what
        return InputError(Problem(f"{self.source}: {key}", text, hint))


@dataclass(frozen=True, slots=True)
class Filled:
    """A mapping with the points of its files, the files and what was made of them."""

    raw: dict[str, Any]
    files: tuple[Path, ...]
    notes: tuple[str, ...]


def with_points(raw: dict[str, Any], folder: Path, source: str) -> Filled:
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
        table, told = _table(gas, folder, source, period)
        files.append(folder / gas["file"])
        notes.extend(f"{one_line(gas['file'], 60)}: {note}" for note in told)
        return {**owner, "gas": table}

    result = filled(raw)
    regimes = result.get("regimes")
    if isinstance(regimes, list):
        result = {**result, "regimes": [filled(entry) for entry in regimes]}
    return Filled(result, tuple(files), tuple(notes))


def _strokes(raw: dict[str, Any]) -> object:
    engine = raw.get("engine")
    return engine.get("strokes") if isinstance(engine, dict) else None


def _table(
    gas: dict[str, Any], folder: Path, source: str, period: float
) -> tuple[dict[str, Any], list[str]]:
    name = gas.get("file")
    if not isinstance(name, str) or not name:
        place = _Place(source, "")
        raise place.refused("не указан файл с диаграммой", 'например, file = "diagram.csv"')
    place = _Place(source, name)
    unit = _unit(gas.get("pressure_unit"), place)
    tdc = gas.get("firing_tdc_deg", 360.0 if period == 720.0 else 0.0)
    if isinstance(tdc, bool) or not isinstance(tdc, int | float) or not math.isfinite(tdc):
        raise place.refused("нужно число", "угол ВМТ сгорания в файле", key="gas.firing_tdc_deg")
    path = Path(name)
    if path.is_absolute() or ".." in path.parts:
        raise place.refused("файл должен лежать рядом с исходными данными", "укажите только имя")
    asked = Wanted(
        gas.get("angle_column", 1), gas.get("pressure_column", 2),
        frozenset({*UNITS_MPA, *_ALSO, *_ANGLES}), place.refused,
    )  # fmt: skip
    rows = recorded(text_of(folder / path, place.refused), asked)
    _check_pressures(rows, unit, str(gas["pressure_unit"]), place)
    turn = (360.0 if period == 720.0 else 0.0) - float(tdc)
    points, notes = _closed(rows, turn, period, gas.get("average_cycles", False), place)
    kept = {key: value for key, value in gas.items() if key not in KEYS}
    made = [[angle, pressure * unit] for angle, pressure in points]
    return {"interpolation": "monotone", **kept, "source": "table", "points": made}, notes


def _unit(given: object, place: _Place) -> float:
    """How many MPa the unit of pressure is, in whatever case and language it is written."""
    word = str(given or "").strip().casefold().replace(" ", "")
    unit = UNITS_MPA.get(_ALSO.get(word, word))
    if unit is None:
        hint = "допустимо: " + ", ".join(UNITS_MPA)
        what = "не указана единица давления"
        if word:
            what = f"неизвестная единица давления «{one_line(str(given), 20)}»"
        raise place.refused(what, hint, key="gas.pressure_unit")
    return unit


def _check_pressures(rows: Recorded, unit: float, called: str, place: _Place) -> None:
    """Refuse pressures that no absolute pressure can be: one line for all of them."""
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
            raise place.refused(what, hint)


def _closed(
    rows: Recorded, turn: float, period: float, average: object, place: _Place
) -> tuple[list[tuple[float, float]], list[str]]:
    """Points over one cycle from 0 to its end, the ends being equal, and what was done."""
    import numpy as np

    angles, pressures = np.array(rows.angles), np.array(rows.pressures)
    # A new cycle may begin with the angles of the first one.
    angles = angles + period * np.cumsum(np.diff(angles, prepend=angles[0]) < -period / 2)
    cycles, step = _cycles(angles, period, average, place)
    at = np.round((angles + turn) % period, 6) % period
    notes = []
    if cycles > 1:
        at, pressures = _means(at, pressures, step, period)
        notes.append(f"давления {cycles} циклов усреднены по углу")
    else:
        at, pressures = _single(at, pressures, place)
    if len(at) > MOST_POINTS:
        notes.append(f"{len(at)} строк усреднены до точек через {number_text(THINNED_DEG)}°")
        at, pressures = _means(at, pressures, THINNED_DEG, period)
    notes += _gaps(at, period, place)
    points = list(zip(at.tolist(), pressures.tolist(), strict=True))
    (first, p_first), (last, p_last) = points[0], points[-1]
    if first > 0:  # the seam of the cycle, on the straight line between its neighbours
        share = (period - last) / (first + period - last)
        points.insert(0, (0.0, p_last + share * (p_first - p_last)))
    return [*points, (period, points[0][1])], notes


def _cycles(angles: Array, period: float, average: object, place: _Place) -> tuple[int, float]:
    """How many whole cycles there are, and their step; more than one must be asked for."""
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
        raise place.refused(what, hint)
    cycles = round((spread + step / 2) / period)
    if cycles < 2 or abs(spread + step / 2 - cycles * period) > step / 2 + 1e-6:
        what = f"углы занимают {number_text(round(spread / period, 2))} цикла"
        raise place.refused(what, "оставьте целое число циклов")
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


def _single(at: Array, pressures: Array, place: _Place) -> tuple[Array, Array]:
    """Points in the order of their angles; both ends of the cycle give one."""
    import numpy as np

    angles, which = np.unique(at, return_inverse=True)
    held = np.bincount(which)
    means = np.bincount(which, pressures) / held
    off = np.abs(pressures - means[which]) > CLOSING / 2 * pressures.max()
    if off.any():
        what = f"при {number_text(float(at[off][0]))}° два разных давления"
        raise place.refused(what, "проверьте столбцы и угол ВМТ")
    return angles, means


def _gaps(at: Array, period: float, place: _Place) -> Iterator[str]:
    """Tell of a lone gap; refuse one that is no diagram."""
    import numpy as np

    gaps = np.diff(at, append=at[0] + period)
    if gaps.max() > WIDEST_GAP_DEG:
        what = f"между точками {number_text(round(float(gaps.max()), 6))}°, "
        hint = f"допустимо до {number_text(WIDEST_GAP_DEG)}°"
        raise place.refused(f"{what}диаграмма не покрывает цикл", hint)
    beside = np.maximum(np.roll(gaps, 1), np.roll(gaps, -1))
    for i in np.flatnonzero(gaps > LONE_GAP * beside):
        ends = (number_text(float(angle)) for angle in (at[i], at[i] + gaps[i]))
        yield f"между {' и '.join(ends)}° точек нет"
