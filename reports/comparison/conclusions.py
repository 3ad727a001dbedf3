"""Conclusions that follow from the compared numbers alone, a sentence each."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from reports.comparison.engines import Row
from reports.shared.russian import NBSP, fixed, short, written

SAME = 0.01  # share within which values count as equal
STILL = 1e-3  # of the engine's own load or torque: what is smaller is nought
_NOUGHT = 1e-6  # kN, N·m: rounding
_THOUSANDS = 1000.0
_TIMES = 2.0  # from here on "so many times" is said

# Key of the result, what is said of the greatest of it.
_GREATEST = (
    ("M_e", "Наибольший эффективный момент"),
    ("N_i_calc", "Наибольшая индикаторная мощность"),
    ("c_m", "Наибольшая средняя скорость поршня"),
    ("Rpin_max_kN", "Наибольшая нагрузка на шатунную шейку"),
    (r"Rmain\d+_max_kN", "Наибольшая нагрузка на коренную шейку"),
    (r"dM_main\d+", "Наибольший размах набегающего момента коренных шеек"),
    ("I_flywheel", "Самый тяжёлый маховик"),
)
# And what an engine's own size is measured by.
_BALANCE = (
    ("F1_before_max", "силы инерции 1-го порядка", "Rpin_max_kN"),
    ("L1_before_max", "моменты сил инерции 1-го порядка", "M_max"),
)


def conclusions(names: Sequence[str], rows: Sequence[Row]) -> tuple[str, ...]:
    """Sentences about the engines of these names."""
    found = {row.key: row for row in rows}
    parts = (_volumes, _greatest, _unevenness, _balance)
    return tuple(sentence for part in parts for sentence in part(names, found))


def _volumes(names: Sequence[str], rows: Mapping[str, Row]) -> Iterator[str]:
    values = _known(rows.get("V_engine"))
    if values is None:
        return
    if spread(values) <= SAME:
        yield f"Рабочий объём у всех одинаков: {_litres(values[0])} л."
    else:
        big, small = values.index(max(values)), values.index(min(values))
        yield (
            f"Рабочие объёмы разные: от {_litres(values[small])} л ({names[small]}) до "
            f"{_litres(values[big])} л ({names[big]}); "
            "силы и моменты сравниваются с этой оговоркой."
        )


def _litres(volume: float) -> str:
    return fixed(volume, 2) if 1 <= volume < 100 else short(volume, 4)


def _greatest(names: Sequence[str], rows: Mapping[str, Row]) -> Iterator[str]:
    for key, words in _GREATEST:
        row = rows.get(key)
        values = _known(row)
        if row is None or values is None or min(values) <= 0:
            continue
        big, small = values.index(max(values)), values.index(min(values))
        shown = written(values[big], row.quantity(big).digits, group=True)
        text = f"{shown} {row.unit}".rstrip().replace(" ", NBSP)
        if spread(values) <= SAME:
            what = words.removeprefix("Наибольшая ").removeprefix("Наибольший ")
            what = what.removeprefix("Самый тяжёлый ")
            yield f"Одинаковы с точностью 1{NBSP}%: {what}, {text}."
        else:
            more = _more(values[big] / values[small])
            yield f"{words} — {names[big]}: {text}, {more} больше, чем у {names[small]}."


def _more(ratio: float) -> str:
    """By how much something is larger: nobody reads 1800 %."""
    if ratio < _TIMES:
        return f"на {fixed((ratio - 1) * 100, 1)}{NBSP}%"
    if ratio < _THOUSANDS:
        return f"в {fixed(ratio, 1)}{NBSP}раза"
    return f"в {fixed(float(f'{ratio:.3g}'), 0)}{NBSP}раз"


def _unevenness(names: Sequence[str], rows: Mapping[str, Row]) -> Iterator[str]:
    parts = [_known(rows.get(key)) for key in ("M_max", "M_min", "M_mean")]
    high, low, mean = parts
    if high is None or low is None or mean is None or min(mean) <= 0:
        return
    swings = [(a - b) / c for a, b, c in zip(high, low, mean, strict=True)]
    even, rough = swings.index(min(swings)), swings.index(max(swings))
    if spread(swings) <= SAME:
        yield f"Неравномерность крутящего момента одинакова: {fixed(swings[0], 2)}."
    else:
        yield (
            f"Равномернее всех крутящий момент {names[even]}: размах к среднему "
            f"{fixed(swings[even], 2)} против {fixed(swings[rough], 2)} у {names[rough]}."
        )


def _balance(names: Sequence[str], rows: Mapping[str, Row]) -> Iterator[str]:
    for key, words, size in _BALANCE:
        values = _known(rows.get(key))
        if values is None:
            continue
        sizes = _known(rows.get(size)) or [0.0] * len(values)
        still = [
            name
            for name, value, own in zip(names, values, sizes, strict=True)
            if abs(value) <= max(STILL * abs(own), _NOUGHT)
        ]
        if len(still) == len(names):
            yield f"У всех {words} уравновешены самим расположением колен."
        elif still:
            yield f"Уравновешены {words}: {', '.join(still)}; у остальных — нет."
        else:
            yield f"Ни у одного двигателя {words} не уравновешены."


def spread(values: Sequence[float]) -> float:
    """(Greatest − least)/greatest by size, zero of noughts."""
    largest = max(map(abs, values))
    return 0.0 if largest == 0 else (max(values) - min(values)) / largest


def _known(row: Row | None) -> list[float] | None:
    """The values if every engine has one."""
    if row is None or None in row.values:
        return None
    return [value for value in row.values if value is not None]
