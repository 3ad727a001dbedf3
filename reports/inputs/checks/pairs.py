"""Pairs of inputs of which one is less than the other, checked in the file and on the sheet."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import permutations

from pydantic import BaseModel

from kshm.defaults import CLEARANCE_SHARES, SPEED_RANGE
from kshm.engine.strength import PartStrength
from kshm.ranges import PART_SHARES
from reports.inputs.fields import Path
from reports.inputs.findings import Finding, ValidValues, journal_sizes, radius_and_rod
from reports.inputs.sections.bearings import OILS, OilGrade
from reports.inputs.sections.input_file import LAMBDA_MAX, LAMBDA_MIN
from reports.inputs.units import number_text, span_text

_TERM = re.compile(r"(?:(?P<times>[\d.]+)\*)?(?P<key>=?[a-z0-9_.]+)(?:\^(?P<power>[\d.]+))?")
_SHAFTS = (("bearings", "в расчёте подшипников"), ("torsion", "в крутильной схеме"))
_Entry = tuple[Path, float]


@dataclass(frozen=True, slots=True)
class Term:
    """Numbers at a key, times a factor and to a power; ``=name`` is what follows from others."""

    key: str
    times: float
    power: float

    def of(self, value: float) -> float:
        """Return the term with this number at its key."""
        return self.times * float(value**self.power)


@dataclass(frozen=True, slots=True)
class Pair:
    """Each number of one side is less than each of the other (or no greater, if not strict).

    A side is the first of its terms, parted by ``|``, that is there; a pair whose sides both fall
    back to later terms says nothing.  Without ``what`` the file's door has words of its own.

    Attributes:
        title: What must hold, as the sheet of checks names it.
        what: What does not hold, with ``{less}``, ``{more}`` and their ``{ratio}``.
        at: The side that is blamed, if it is given.
        warning: It is only odd.
        strokes: Only of engines of so many strokes.
        given, unless: Keys that must, or must not, be there.
    """

    less: str
    more: str
    title: str
    what: str = ""
    hint: str = ""
    at: str = "less"
    strict: bool = True
    warning: bool = False
    strokes: int = 0
    given: str = ""
    unless: str = ""

    def holds(self, less: float, more: float) -> bool:
        """Whether the two numbers are in order."""
        return less < more if self.strict else less <= more


def terms_of(side: str) -> Iterator[Term]:
    """Yield the terms of a side, the one to be preferred first."""
    for text in side.split(" | "):
        match = _TERM.fullmatch(text)
        if match is None:
            raise ValueError(f"no term: {text}")
        yield Term(match["key"], float(match["times"] or 1), float(match["power"] or 1))


def _journals(part: str, whose: str, mark: str) -> tuple[Pair, ...]:
    """Clearances and bores of the pins or of the main journals."""
    size = f"crankshaft.{part}_diameter"
    sizes = f"{size}s_mm | {size}_mm"
    rules = [" | ".join(f"{share}*{key}^0.5" for key in sizes.split(" | "))
             for share in CLEARANCE_SHARES.values()]  # fmt: skip
    return (
        Pair(f"bearings.{part}_clearance_min_mm | {rules[0]}",
             f"bearings.{part}_clearance_max_mm | {rules[1]}",
             f"Наименьший зазор {whose} подшипника не больше наибольшего",
             "наименьший зазор {less} мм больше наибольшего {more} мм",
             "нужно clearance_min ≤ clearance_max", at="more", strict=False),
        Pair(f"bearings.{part}_bore_mm", sizes,
             f"Отверстие {mark} шеек меньше их диаметра",
             f"отверстие {{less}} мм не меньше {whose} диаметра", "уменьшите отверстие"),
        Pair(f"torsion.{part}_bore_mm", sizes,
             f"Крутильная схема: отверстие {mark} шеек меньше их диаметра",
             "отверстие {less} мм не меньше шейки {more} мм", "уменьшите отверстие"),
        *(
            Pair(f"{one}.{part}_bore_mm", f"{other}.{part}_bore_mm",
                 f"Отверстие {mark} шеек {here} не больше, чем {there}",
                 f"отверстие {mark} шеек {here} {{less}} мм, а {there} {{more}} мм: вал один",
                 "задайте одинаковые", strict=False, warning=True)
            for (one, here), (other, there) in permutations(_SHAFTS)
        ),
    )  # fmt: skip


def _parts() -> Iterator[Pair]:
    """Yield sizes of parts of which one goes into the other."""

    def side(key: str, times: str = "") -> str:
        return f"{times}strength.{key}_mm | {times}=st_{key}_mm"

    for less, more, title, what, hint in (
        ("pin_bore", "pin", "Отверстие пальца меньше его диаметра",
         "отверстие пальца {less} мм не меньше его диаметра {more} мм", "уменьшите отверстие"),
        ("pin", "eye_outer", "Палец тоньше верхней головки шатуна",
         "палец {less} мм не тоньше головки {more} мм", "увеличьте головку"),
        ("bosses", "pin_length", "Палец длиннее промежутка между бобышками",
         "палец {more} мм не длиннее промежутка между бобышками {less} мм", "удлините палец"),
        ("skirt", "height", "Юбка ниже поршня",
         "юбка {less} мм не ниже поршня {more} мм", "уменьшите высоту юбки"),
        ("crown", "height", "Днище тоньше высоты поршня",
         "днище {less} мм не тоньше высоты поршня {more} мм", "уменьшите толщину днища"),
        ("shank_web", "shank_width", "Стенка стержня шатуна уже его полки",
         "стенка {less} мм не уже полки {more} мм", "уменьшите стенку"),
    ):  # fmt: skip
        yield Pair(side(less), side(more), title, what, hint)
    yield Pair(
        side("shank_flange", "2*"),
        side("shank_height"),
        "Полки стержня шатуна вдвоём ниже его сечения",
        "две полки {less} мм не ниже сечения стержня {more} мм",
        "уменьшите полки",
    )
    yield Pair(
        side("pin_length"),
        "geometry.bore_mm",
        "Палец короче диаметра цилиндра",
        "палец {less} мм не короче диаметра цилиндра {more} мм",
        "укоротите палец",
    )
    yield Pair(
        side("eye_length"),
        side("bosses"),
        "Головка шатуна уже промежутка между бобышками",
        "головка {less} мм не проходит между бобышками, {more} мм",
        "уменьшите l_ш или раздвиньте бобышки",
        warning=True,
    )


PAIRS = (
    Pair("geometry.crank_radius_mm | 0.5*geometry.stroke_mm", "geometry.rod_length_mm",
         "Радиус кривошипа меньше длины шатуна",
         "λ = r/L = {ratio}: шатун не длиннее кривошипа, механизм не провернётся",
         f"допустимо λ {span_text(LAMBDA_MIN, LAMBDA_MAX)}", at="more"),
    Pair("articulated.radius_mm", "geometry.rod_length_mm | =rod",
         "Палец прицепного шатуна ближе длины главного",
         "палец прицепного шатуна дальше длины главного ({more} мм)", "уменьшите расстояние ρ"),
    Pair("masses.rod_weighed_small_end_kg", "masses.rod_kg",
         "Взвешенная головка легче шатуна",
         "весы показали {less} кг, не меньше массы шатуна", "масса шатуна {more} кг"),
    Pair("masses.rod_centre_mm", "geometry.rod_length_mm | =rod",
         "Центр масс между головками шатуна",
         "центр масс {less} мм лежит не между головками шатуна", "длина шатуна {more} мм"),
    Pair("=p_start", "gas.max_pressure_mpa",
         "Давление в начале сгорания не выше наибольшего", strict=False),
    Pair("gas.preexpansion_ratio", "geometry.compression_ratio",
         "Степень предварительного расширения меньше степени сжатия",
         "ρ = {less} не меньше степени сжатия {more}", "уменьшите ρ"),
    Pair("gas.ignition_delay_deg", "gas.injection_advance_deg",
         "Сгорание начинается не позже ВМТ: задержка не больше опережения",
         strict=False, unless="gas.combustion_start_deg"),
    Pair("gas.ignition_delay_deg", "gas.injection_advance_deg",
         "Задержка воспламенения не больше опережения",
         "задержка воспламенения {less}° больше опережения {more}°",
         "обычно она меньше: не переставлены ли углы",
         strict=False, warning=True, given="gas.combustion_start_deg"),
    Pair("gas.expansion_exponent", "gas.compression_exponent",
         "Показатель расширения меньше показателя сжатия",
         "показатель расширения n_2 = {less} не меньше показателя сжатия n_1 = {more}",
         "обычно n_2 меньше n_1: не переставлены ли они", warning=True),
    Pair("gas.exhaust_end_after_bdc_deg", "gas.exhaust_start_before_bdc_deg",
         "Выпуск кончается после НМТ не дальше, чем начинается до неё",
         "выпуск начинается за {more}° до НМТ, а кончается через {less}°",
         "обычно первый угол больше: не переставлены ли они",
         at="more", strict=False, warning=True, strokes=4),
    Pair("gas.scavenge_start_before_bdc_deg", "gas.exhaust_start_before_bdc_deg",
         "Продувка начинается позже выпуска",
         "продувка начинается за {less}° до НМТ, не позже выпуска ({more}°)",
         "выпуск должен открываться раньше продувки", strokes=2),
    Pair("gas.peak_after_tdc_deg", "gas.expansion_after_tdc_deg",
         "Выход на линию расширения позже наибольшего давления"),
    Pair(f"torsion.speed_min_rpm | {SPEED_RANGE[0]}*regime.speed_rpm",
         f"torsion.speed_max_rpm | {SPEED_RANGE[1]}*regime.speed_rpm",
         "Крутильные колебания: наименьшая частота вращения меньше наибольшей",
         "диапазон от {less} до {more} мин⁻¹ пуст", "нужно speed_min_rpm < speed_max_rpm",
         at="more"),
    *_journals("pin", "шатунного", "шатунных"),
    *_journals("main", "коренного", "коренных"),
    Pair("torsion.main_bore_mm", "torsion.masses.diameter_mm",
         "Крутильная схема: участки вала толще отверстия",
         "вал {more} мм не толще отверстия main_bore_mm", "увеличьте диаметр", at="more"),
    Pair("bearings.viscosity_100_mpa_s | =oil_100", "bearings.viscosity_40_mpa_s | =oil_40",
         "Вязкость масла при 100 °C меньше, чем при 40 °C",
         "вязкость при 40 °C не больше вязкости при 100 °C",
         "задайте обе вязкости одного масла", at="more"),
    Pair("bearings.supply_c", "bearings.oil_temperature_c",
         "Масло в плёнке не холоднее, чем перед подшипником",
         "масло в плёнке холоднее, чем перед подшипником", "проверьте обе температуры",
         at="more", strict=False, warning=True),
    Pair("bearings.torsion_limit_mpa", "bearings.bending_limit_mpa",
         "Предел выносливости при кручении меньше, чем при изгибе",
         "предел при кручении {less} МПа не меньше предела при изгибе {more} МПа",
         "обычно он меньше: не переставлены ли они", warning=True),
    Pair("bearings.bending_limit_mpa", "bearings.tensile_mpa",
         "Предел выносливости меньше предела прочности",
         "предел выносливости {less} МПа не меньше предела прочности {more} МПа",
         "обычно он вдвое меньше: проверьте оба", warning=True),
    *_parts(),
)  # fmt: skip


def check_pairs(values: ValidValues) -> Iterator[Finding]:
    """Yield the pairs of a file that do not hold, each once."""
    for pair in PAIRS:
        yield from check_pair(pair, values)


def check_pair(pair: Pair, values: ValidValues) -> Iterator[Finding]:
    """Yield one pair if it does not hold."""
    if pair.what and is_of(pair, values.get("engine", "strokes"), lambda k: _at(values, k)):
        yield from _told(pair, values)


def is_of(pair: Pair, strokes: int | None, there: Callable[[str], object]) -> bool:
    """Whether a pair applies to this engine."""
    if pair.strokes not in (0, strokes):
        return False
    return not (pair.given and not there(pair.given)) and not (pair.unless and there(pair.unless))


def _told(pair: Pair, values: ValidValues) -> Iterator[Finding]:
    sides = {"less": _side(values, pair.less), "more": _side(values, pair.more)}
    blamed = pair.at if sides[pair.at][0] else "more" if pair.at == "less" else "less"
    if not sides[blamed][0]:
        return
    for less in sides["less"][1]:
        for more in sides["more"][1]:
            if pair.holds(less[1], more[1]):
                continue
            said = {"less": number_text(less[1]), "more": number_text(more[1])}
            ratio = number_text(round(less[1] / more[1], 6)) if more[1] else "∞"
            problem = pair.what.format(ratio=ratio, **said)
            path = (less if blamed == "less" else more)[0]
            yield Finding(path, problem, pair.hint.format(**said), warning=pair.warning)
            return


def _side(values: ValidValues, side: str) -> tuple[bool, list[_Entry]]:
    """Whether the side's own key is given, and the numbers of the term that is there."""
    for index, term in enumerate(terms_of(side)):
        if entries := _at(values, term.key):
            plain = term.times == term.power == 1
            return not index, entries if plain else [
                (path, round(term.of(value), 4)) for path, value in entries
            ]
    return False, []


def _at(values: ValidValues, key: str) -> list[_Entry]:
    if key.startswith("="):
        number = _FOLLOWING[key](values)
        return [] if number is None else [((), number)]
    section, name, *inner = key.split(".")
    return list(_numbers(values.get(section, name), inner, (section, name)))


def _numbers(part: object, keys: list[str], path: Path) -> Iterator[_Entry]:
    if isinstance(part, tuple):
        for index, item in enumerate(part):
            yield from _numbers(item, keys, (*path, index))
    elif isinstance(part, BaseModel) and keys:
        yield from _numbers(getattr(part, keys[0]), keys[1:], (*path, keys[0]))
    elif isinstance(part, int | float):
        yield path, float(part)


def _rod(values: ValidValues) -> float | None:
    pair = radius_and_rod(values)
    return None if pair is None else pair[1]


def _grade(values: ValidValues) -> OilGrade:
    return OILS[values.get("bearings", "oil") or "sae30"]


def _part_size(key: str) -> Callable[[ValidValues], float | None]:
    """Size of a part [mm], as given or as it follows from bore and crankpin."""

    def size(values: ValidValues) -> float | None:
        bore, pins = values.get("geometry", "bore_mm"), journal_sizes(values, "pin", "diameter")
        if "strength" not in values.sections or bore is None or not pins:
            return None
        given = {name: values.get("strength", f"{name}_mm") for name in PART_SHARES}
        kind = values.get("strength", "kind") or PartStrength().kind
        return PartStrength(kind=kind, **given).sizes(bore, pins[0])[key]

    return size


# What follows from other keys; what is not here has its value in the book alone.
_FOLLOWING: dict[str, Callable[[ValidValues], float | None]] = {
    "=rod": _rod,
    "=oil_40": lambda values: _grade(values).at_40,
    "=oil_100": lambda values: _grade(values).at_100,
    **{f"=st_{key}_mm": _part_size(key) for key in PART_SHARES},
}
