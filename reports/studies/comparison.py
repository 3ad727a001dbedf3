"""Engines compared: data, results, curves, conclusions from the numbers alone."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from kshm.nomenclature.quantity import Quantity, quantity
from reports.exports.department_chapters import own_numbers
from reports.inputs.fields import Field, iter_fields
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.engine import smallness_of
from reports.model.charts import PHI
from reports.model.shape import most_loaded_pin, pin_name, pin_table
from reports.shared.errors import InputError, Problem
from reports.shared.russian import NBSP, capital, fixed, joined, short, uncapital, written
from reports.tables.cycle_members import given_by_cycle

if TYPE_CHECKING:
    from kshm.results.solution import Solution


FEWEST, MOST = 2, 6
_ROUNDING = 1e-9  # kN, N·m: forces that cancel
_NOUGHT = 1e-6  # of the greatest: no base for a difference in per cent
MIN_PERCENT = -99.95  # below it −100,0 would be printed of what is not nought
_NOT_COMPARED = ("report", "workbook", "prototype", "reference", "checks")
# Groups of results: keys of scalars, or a pattern of them and the title of its greatest.
_MAIN, _PIN = "по коренным шейкам", "по шатунным шейкам"
RESULTS: tuple[tuple[str, tuple[str | tuple[str, str], ...]], ...] = (
    ("Размеры и массы", (
        "S_stroke", "L_rod", "lam", "F_piston", "V_engine", "c_m", "m_j", "m_2", "m_r",
    )),
    ("Крутящий момент и мощность", (
        "M_mean", "M_max", "M_min", "M_e", "N_i_calc", "p_i_calc",
    )),
    ("Нагрузки", (
        "Rpin_max_kN", "Rpin_max", "Rpin_mean", "q_pin_max", "q_pin_mean",
        (r"Rmain\d+_max_kN", f"Наибольшая нагрузка {_MAIN}"),
        (r"q_main\d+_max", f"Наибольшее удельное давление {_MAIN}"),
    )),
    ("Набегающие моменты", (
        (r"dM_main\d+", f"Наибольший размах набегающего момента {_MAIN}"),
        (r"dM_pin\d+", f"Наибольший размах набегающего момента {_PIN}"),
    )),
    ("Уравновешенность и маховик", (
        "F1_before_max", "F1_after_max", "Frot", "L1_before_max", "L1_after_max", "Lrot",
        "I_engine_mean", "I_flywheel", "delta_speed",
    )),
    ("Прочность деталей", (
        "st_crown_MPa", "st_land_MPa", "st_pin_bend_MPa", "st_oval_mm", "st_cap_MPa",
        "st_eye_top_n", "st_eye_n", "st_shank_nx", "st_shank_ny", "st_bolt_n", "st_web_n",
    )),
)  # fmt: skip
X_TITLE = PHI
CHARTS = (
    ("gas.p_MPa", "Давление газов в цилиндре", "p, МПа"),
    ("P4_2.Msum_Nm", "Крутящий момент двигателя", "ΣM, Н·м"),
    ("crankpin.Rpin_MPa", "Нагрузка на шатунную шейку", "R_шш, МПа"),
    ("P4_4.", "Набегающий момент шейки с наибольшим размахом", "M, Н·м"),
    ("balance.Fup_kN", "Свободная сила инерции по оси первого цилиндра", "F, кН"),
)
SAME = 0.01  # share within which values count as equal
STILL = 1e-3  # of the engine's own load or torque: what is smaller is nought
_THOUSANDS = 1000.0
_TIMES = 2.0  # from here on "so many times" is said
# Key of the result, the superlative, its name.
_GREATEST = (
    ("M_e", "Наибольший", "эффективный момент"),
    ("N_i_calc", "Наибольшая", "индикаторная мощность"),
    ("c_m", "Наибольшая", "средняя скорость поршня"),
    ("Rpin_max_kN", "Наибольшая", "нагрузка на шатунную шейку"),
    (r"Rmain\d+_max_kN", "Наибольшая", "нагрузка на коренную шейку"),
    (r"dM_main\d+", "Наибольший", "размах набегающего момента коренных шеек"),
    ("I_flywheel", "Самый тяжёлый", "маховик"),
)
# And what an engine's own size is measured by.
_BALANCE = (
    ("F1_before_max", "силы инерции 1-го порядка", "Rpin_max_kN"),
    ("L1_before_max", "моменты сил инерции 1-го порядка", "M_max"),
)


@dataclass(frozen=True, slots=True)
class Compared:
    """An engine with a short name that no other one has."""

    label: str
    source: Path
    model: InputFile
    solution: Solution


@dataclass(frozen=True, slots=True)
class Row:
    """A result of all engines; None where an engine has no such result.

    ``smalls`` are their smallnesses: each has its own decimals.
    """

    group: str
    key: str
    title: str
    symbol: str
    about: Quantity
    values: tuple[float | None, ...]
    smalls: tuple[int, ...] = ()

    def quantity(self, number: int) -> Quantity:
        """Return the quantity with the decimals of an engine."""
        return quantity(self.about.key, self.smalls[number]) if self.smalls else self.about

    @property
    def unit(self) -> str:
        """Russian label of the unit."""
        return self.about.unit_label

    def change(self, number: int) -> float | None:
        """Difference of an engine from the first one [%], if the first has a base for it.

        A value of the other sign is no part of the base: per cent would say nothing of it.
        """
        base, value = self.values[0], self.values[number]
        largest = max(abs(value) for value in self.values if value is not None)
        if base is None or value is None or abs(base) <= _NOUGHT * largest or base * value < 0:
            return None
        return (value / base - 1) * 100


@dataclass(frozen=True, slots=True)
class Difference:
    """A field of the data whose values are not all the same.

    ``group`` names its section where the engines without the field have nothing of that.
    """

    title: str
    symbol: str
    unit: str
    values: tuple[str | int | float | None, ...]
    group: str = ""


AnyRow = TypeVar("AnyRow", Row, Difference)


@dataclass(frozen=True, slots=True)
class Chart:
    """A column over φ of every engine that has it."""

    key: str
    title: str
    y_title: str
    curves: tuple[tuple[int, list[float], list[float]], ...]  # engine, φ, values


def read_engines(sources: Sequence[Path], models: Sequence[InputFile]) -> tuple[Compared, ...]:
    """Solve the engines.

    Raises:
        InputError: an engine gives no finite result.
    """
    from reports.inputs.solve_input import solved

    engines = []
    for label, source, model in zip(labels(sources), sources, models, strict=True):
        engines.append(Compared(label, source, model, solved(model)))
    return tuple(engines)


def check_sources(
    sources: Sequence[Path], target: Path | None = None, where: str = "compare"
) -> None:
    """Refuse what cannot be compared, before anything is read.

    Raises:
        InputError: too few or too many files, a file twice, an output over an input.
    """
    count = len(sources)
    if not FEWEST <= count <= MOST:
        hint = f"сравниваются от {FEWEST} до {MOST} двигателей"
        raise InputError(Problem(where, f"файлов {count}", hint))
    paths = [source.resolve() for source in sources]
    for number, path in enumerate(paths):
        if path in paths[:number]:
            problem, hint = "файл назван дважды", "уберите повтор или сделайте копию с правками"
            raise InputError(Problem(str(sources[number]), problem, hint))
    if target is not None and target.resolve() in paths:
        problem = "результат записался бы поверх исходного файла"
        raise InputError(Problem(str(target), problem, "укажите другое имя ключом -o"))


def labels(sources: Sequence[Path]) -> list[str]:
    """File stems as unique labels."""
    stems = [source.stem for source in sources]
    return [
        stem if stems.count(stem) == 1 else f"{stem} ({stems[: number + 1].count(stem)})"
        for number, stem in enumerate(stems)
    ]


def differences(engines: Sequence[Compared]) -> tuple[Difference, ...]:
    """Fields whose values differ, in the order of the file; lists as one text."""
    columns = [dict(_gathered(engine.model)) for engine in engines]
    keys = list(dict.fromkeys(key for column in columns for key in column))
    sections = [{field.section for field, _ in column.values()} for column in columns]
    rows = []
    for key in keys:
        by_engine = [column.get(key) for column in columns]
        values = tuple(None if item is None else item[1] for item in by_engine)
        if len(set(values)) > 1:
            field = next(item[0] for item in by_engine if item is not None)
            title = re.sub(r"(?<=\D) 1(?=:)", "", field.title)  # a list is told at once
            lacking = [field.section not in held for held in sections]
            group = field.section if lacking == [value is None for value in values] else ""
            rows.append(Difference(title, field.symbol, field.unit, values, group))
    return tuple(rows)


def split_rows(rows: Sequence[AnyRow], labels: Sequence[str]) -> tuple[list[AnyRow], str]:
    """Rows that are complete or differ, and a sentence on the rest.

    Nothing is compared where one engine alone has a result, or where all that have a datum
    agree: rows of dashes.  A group that some engines lack wholly is named as one.
    """
    owners = [tuple(value is not None for value in row.values) for row in rows]
    groups = {(row.group, has) for row, has in zip(rows, owners, strict=True)}
    rows_shown, left = [], dict[str, dict[str, None]]()
    for row, has in zip(rows, owners, strict=True):
        if all(has) or len({value for value in row.values if value is not None}) > 1:
            rows_shown.append(row)
            continue
        whole = row.group and sum(group == row.group for group, _ in groups) == 1
        names = joined([label for label, there in zip(labels, has, strict=True) if there])
        left.setdefault(names, {})[uncapital(row.group if whole else row.title)] = None
    sentence = "; ".join(f"{names} — {', '.join(things)}" for names, things in left.items())
    return rows_shown, f"Есть не у всех: {sentence}." if sentence else ""


def _gathered(model: InputFile) -> Iterator[tuple[str, tuple[Field, str | int | float]]]:
    lists: dict[str, list[Field]] = {}
    by_cycle = given_by_cycle(model)
    for field in iter_fields(model):
        path = field.path
        if path[0] in _NOT_COMPARED or path == ("engine", "name") or field.name in by_cycle:
            continue
        keys = path[2:] if path[0] == "regimes" else path
        if not any(isinstance(part, int) for part in keys):
            label = (field.choices or {}).get(str(field.value), field.value)
            title = field.title
            if path[0] == "regimes":
                title = f"{field.section}: {uncapital(title)}"
            yield field.name, (replace(field, title=title), label)
        else:
            key = ".".join(str(part) for part in path if not isinstance(part, int))
            key += f".{path[1]}" if path[0] == "regimes" else ""
            lists.setdefault(key, []).append(field)
    for key, fields in lists.items():
        values = [short(f.value) if isinstance(f.value, float) else str(f.value) for f in fields]
        alike = len(set(values)) == 1 and len(values) > 1
        text = f"{len(values)} × {values[0]}" if alike else "; ".join(values)
        yield key, (fields[0], text)


def results(engines: Sequence[Compared]) -> tuple[Row, ...]:
    """Key results of all engines, groups one after the other."""
    rows = []
    for group, entries in RESULTS:
        for entry in entries:
            row = _result(engines, group, entry)
            if row is not None:
                rows.append(row)
    return (*rows, *_own_results(engines))


def _own_results(engines: Sequence[Compared]) -> Iterator[Row]:
    """Scalars of own books, in the order of the first engine that has them."""
    results = [own_numbers(engine.model).scalars for engine in engines]
    for key in dict.fromkeys(key for scalars in results for key in scalars):
        quantity = next(scalars[key][0] for scalars in results if key in scalars)
        values = [scalars[key][1] if key in scalars else None for scalars in results]
        numbers = tuple(None if isinstance(value, str) or value is None else float(value)
                        for value in values)  # fmt: skip
        if any(number is not None for number in numbers):
            yield Row(
                "Свои книги", key, capital(quantity.title), quantity.symbol, quantity, numbers
            )


def _result(engines: Sequence[Compared], group: str, entry: str | tuple[str, str]) -> Row | None:
    pattern, title = (entry, "") if isinstance(entry, str) else entry
    values: list[float | None] = []
    known = ""
    for engine in engines:
        scalars = engine.solution.scalars
        # Of unequal crankpins the most loaded one is told, as in the report.
        pin = pin_name(most_loaded_pin(scalars))
        key_of_pin = re.sub("^(R|q_)pin_", rf"\1pin{pin}_", pattern)
        names = [name for name in scalars if re.fullmatch(key_of_pin, name)]
        known = known or (names[0] if names else "")
        largest = max((float(scalars[name]) for name in names), default=None)
        values.append(0.0 if largest is not None and abs(largest) < _ROUNDING else largest)
    if not known:
        return None
    about = quantity(entry if isinstance(entry, str) else known)
    smalls = tuple(smallness_of(engine.model) for engine in engines)
    symbol = "" if title else about.symbol
    key = entry if isinstance(entry, str) else pattern
    numbers = tuple(values)
    return Row(group, key, capital(title or about.title), symbol, about, numbers, smalls)


def charts(engines: Sequence[Compared]) -> tuple[Chart, ...]:
    """Curves of all engines over the crank angle."""
    drawn = []
    for key, title, y_title in CHARTS:
        table, column = key.split(".")
        curves = []
        for number, engine in enumerate(engines):
            worst = most_loaded_pin(engine.solution.scalars)
            of = pin_table(worst) if table == pin_table(1) else table
            columns = engine.solution.columns.get(of)
            if columns is None:
                continue
            name = column or _widest(columns)
            if name in columns:
                phi, values = columns["phi_deg"], columns[name]
                curves.append((number, [float(v) for v in phi], [float(v) for v in values]))
        if curves:
            drawn.append(Chart(key, title, y_title, tuple(curves)))
    return tuple(drawn)


def _widest(columns: object) -> str:
    """Return the main journal whose running-on torque swings most."""
    widths = {
        name: max(values) - min(values)
        for name, values in columns.items()  # type: ignore[attr-defined]
        if name.startswith("Mmain")
    }
    return max(widths, key=lambda name: widths[name], default="")


def conclusions(names: Sequence[str], rows: Sequence[Row]) -> tuple[str, ...]:
    """Sentences about the engines of these names."""
    by_key = {row.key: row for row in rows}
    parts = (_volumes, _greatest, _unevenness, _balance)
    return tuple(sentence for part in parts for sentence in part(names, by_key))


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
    for key, most, name in _GREATEST:
        row = rows.get(key)
        values = _known(row)
        if row is None or values is None or min(values) <= 0:
            continue
        big, small = values.index(max(values)), values.index(min(values))
        number = written(values[big], row.quantity(big).digits, group=True)
        text = f"{number} {row.unit}".rstrip().replace(" ", NBSP)
        if spread(values) <= SAME:
            yield f"Одинаковы с точностью 1{NBSP}%: {name}, {text}."
        else:
            more = _more(values[big] / values[small])
            yield f"{most} {name} — {names[big]}: {text}, {more} больше, чем у {names[small]}."


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
            for name, value, size in zip(names, values, sizes, strict=True)
            if abs(value) <= max(STILL * abs(size), _NOUGHT)
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
    """Return the values if every engine has one."""
    if row is None or None in row.values:
        return None
    return [value for value in row.values if value is not None]
