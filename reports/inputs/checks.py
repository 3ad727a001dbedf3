"""Checks of the input's fields against each other.

Each check sees the valid fields of a possibly broken file (`Values`), so that
all errors are found at once; it keeps silent about what it cannot judge.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from reports.inputs.model import LAMBDA_MAX, LAMBDA_MIN
from reports.units import MPA, number_text

Path = tuple[str | int, ...]

BDC_DEG = 540.0
FIRING_TDC_DEG = 360.0
CYCLE_DEG = 720.0
ANGLE_TOLERANCE_DEG = 0.01
LENGTH_TOLERANCE = 1e-3
PRESSURE_TOLERANCE_MPA = 1e-6
USUAL_LAMBDA = (0.15, 0.45)
USUAL_SHARE = (0.2, 0.3)


@dataclass(frozen=True, slots=True)
class Finding:
    """What is wrong (or odd, if a warning) at a path; the file's name is added later."""

    path: Path
    what: str
    hint: str = ""
    warning: bool = False


@dataclass(slots=True)
class Values:
    """The valid fields of a file by section and TOML key, defaults filled in.

    `broken` holds the (section, key) that are wrong in themselves, `unsure`
    the sections with unknown or missing keys; `counts` the list lengths as
    written, known even where an entry is wrong.
    """

    sections: dict[str, dict[str, Any]] = field(default_factory=dict)
    counts: dict[tuple[str, str], int] = field(default_factory=dict)
    broken: set[tuple[str, str]] = field(default_factory=set)
    unsure: set[str] = field(default_factory=set)

    def get(self, section: str, key: str) -> Any:  # noqa: ANN401 - as various as the fields
        """Return a valid value, or None."""
        return self.sections.get(section, {}).get(key)

    def sure(self, section: str, *keys: str) -> bool:
        """Tell whether the absence of these keys may be judged."""
        if section not in self.sections or section in self.unsure:
            return False
        return not any((section, key) in self.broken for key in keys)


def check(values: Values) -> Iterator[Finding]:
    """Yield everything that does not fit together, errors and warnings."""
    yield from _geometry(values)
    yield from _counts(values)
    yield from _phases(values)
    yield from _arms(values)
    yield from _masses(values)
    if values.get("gas", "source") == "polytropic":
        yield from _timing(values)
        yield from _pressures(values)
        yield from _odd_pressures(values)
    else:
        yield from _table(values)


def radius_and_rod(values: Values) -> tuple[float, float] | None:
    """Return (r, L) [mm] if the geometry fixes them."""
    radius = values.get("geometry", "crank_radius_mm")
    stroke = values.get("geometry", "stroke_mm")
    rod = values.get("geometry", "rod_length_mm")
    lam = values.get("geometry", "lambda")
    if radius is None and stroke is not None:
        radius = stroke / 2
    if radius is None and rod is not None and lam is not None:
        radius = lam * rod
    if rod is None and radius is not None and lam is not None:
        rod = radius / lam
    return None if radius is None or rod is None else (radius, rod)


def _geometry(values: Values) -> Iterator[Finding]:
    keys = ("crank_radius_mm", "stroke_mm", "rod_length_mm", "lambda")
    if not values.sure("geometry", *keys):
        return
    radius, stroke, rod, lam = (values.get("geometry", key) for key in keys)
    if radius is not None and stroke is not None and abs(stroke - 2 * radius) > 1e-9 * stroke:
        what = f"ход {number_text(stroke)} мм не равен 2r = {number_text(2 * radius)} мм"
        yield Finding(("geometry", "stroke_mm"), what, "оставьте один из двух ключей")
        return
    pair = radius_and_rod(values)
    if pair is None:
        what = "размеров недостаточно: нужны любые два из crank_radius_mm (или stroke_mm), "
        yield Finding(("geometry",), what + "rod_length_mm, lambda", "добавьте недостающий ключ")
        return
    r, rod_length = pair
    ratio = r / rod_length
    given = radius if radius is not None else None if stroke is None else stroke / 2
    if None not in (given, rod, lam) and abs(ratio - lam) > LENGTH_TOLERANCE * lam:
        what = f"λ = {number_text(lam)} не согласуется с r/L = {number_text(round(ratio, 6))}"
        yield Finding(("geometry", "lambda"), what, "оставьте любые два из r, L, λ")
        return
    yield from _ratio(ratio, ("geometry", "lambda" if lam is not None else "rod_length_mm"))


def _ratio(ratio: float, path: Path) -> Iterator[Finding]:
    text = number_text(round(ratio, 6))
    if ratio >= 1:
        what = f"λ = r/L = {text}: шатун не длиннее кривошипа, механизм не провернется"
        yield Finding(path, what, f"допустимо λ от {LAMBDA_MIN} до {LAMBDA_MAX}")
    elif not LAMBDA_MIN <= ratio <= LAMBDA_MAX:
        what = f"λ = r/L = {text} вне допустимых пределов"
        yield Finding(path, what, f"допустимо λ от {LAMBDA_MIN} до {LAMBDA_MAX}")
    elif not USUAL_LAMBDA[0] <= ratio <= USUAL_LAMBDA[1]:
        what = f"λ = {text} необычно"
        hint = f"обычно от {USUAL_LAMBDA[0]} до {USUAL_LAMBDA[1]}"
        yield Finding(path, what, hint, warning=True)


def _counts(values: Values) -> Iterator[Finding]:
    cylinders = values.get("engine", "cylinders")
    if cylinders is None:
        return
    wanted = {
        "firing_offsets_deg": (cylinders, "по одному на цилиндр"),
        "throw_angles_deg": (cylinders, "по одному на колено"),
        "main_lengths_mm": (cylinders + 1, "на одну шейку больше, чем колен"),
        "force_offsets_deg": (cylinders, "по одному на колено"),
        "webs": (2 * cylinders, "по две щеки на колено"),
        "arms": (cylinders, "по одной записи на колено"),
    }
    for key, (count, rule) in wanted.items():
        found = values.counts.get(("crankshaft", key))
        if found is not None and found != count:
            what = f"записей {found}, а нужно {count}"
            hint = f"{rule}, цилиндров {cylinders}"
            yield Finding(("crankshaft", key), what, hint)


def _phases(values: Values) -> Iterator[Finding]:
    offsets = values.get("crankshaft", "firing_offsets_deg")
    angles = values.get("crankshaft", "throw_angles_deg")
    for key, listed in (("firing_offsets_deg", offsets), ("throw_angles_deg", angles)):
        if listed and listed[0] != 0:
            what = f"первое значение {number_text(listed[0])}°, а нужно 0"
            yield Finding(("crankshaft", key, 0), what, "углы отсчитываются от первого цилиндра")
    if values.get("crankshaft", "force_offsets_deg") is not None:
        what = "фазы сил заданы отдельно и могут противоречить валу"
        hint = "ключ нужен только для воспроизведения таблицы П4.3"
        yield Finding(("crankshaft", "force_offsets_deg"), what, hint, warning=True)
    if not offsets or not angles or len(offsets) != len(angles):
        return
    for index, (offset, angle) in enumerate(zip(offsets, angles, strict=True)):
        if abs(math.remainder(angle + offset, 360.0)) > ANGLE_TOLERANCE_DEG:
            fitting = number_text(round(-offset % 360.0, 6))
            what = (
                f"угол колена {number_text(angle)}° не соответствует началу рабочего хода "
                f"{number_text(offset)}° (firing_offsets_deg[{index + 1}])"
            )
            hint = f"по γ = −θ (mod 360) нужно {fitting}°"
            yield Finding(("crankshaft", "throw_angles_deg", index), what, hint)


def _arms(values: Values) -> Iterator[Finding]:
    for index, arms in enumerate(values.get("crankshaft", "arms") or ()):
        lengths = (arms.l1_mm, arms.l2_mm, arms.l3_mm, arms.l4_mm, arms.l5_mm, arms.l6_mm)
        left = arms.l1_mm + arms.l2_mm + arms.left_web_mm
        right = arms.l5_mm + arms.l6_mm + arms.right_web_mm
        if left <= 0 or right <= 0:
            what = f"длина колена с одной стороны шатуна равна нулю (сумма плеч {sum(lengths):g})"
            hint = "задайте l1, l2 и l5, l6 больше нуля"
            yield Finding(("crankshaft", "arms", index), what, hint)


def _masses(values: Values) -> Iterator[Finding]:
    direct = ("reciprocating_kg", "rod_big_end_kg")
    parts = ("piston_group_kg", "rod_kg")
    centre = ("rod_centre_mm", "rod_small_end_share")
    if not values.sure("masses", *direct, *parts, *centre):
        return
    given = {key for key in (*direct, *parts, *centre) if values.get("masses", key) is not None}
    advice = (
        "задайте либо reciprocating_kg и rod_big_end_kg, "
        "либо piston_group_kg, rod_kg и одно из rod_centre_mm, rod_small_end_share"
    )
    rest = given - set(direct)
    if given & set(direct) and rest:
        yield Finding(("masses",), "смешаны два способа задания масс", advice)
    elif rest and set(centre) <= given:
        yield Finding(("masses",), "заданы и rod_centre_mm, и rod_small_end_share", advice)
    elif given != set(direct) and not (set(parts) <= given and given & set(centre)):
        yield Finding(("masses",), "масс недостаточно", advice)
    else:
        yield from _rod_centre(values)


def _rod_centre(values: Values) -> Iterator[Finding]:
    pair = radius_and_rod(values)
    place = values.get("masses", "rod_centre_mm")
    share = values.get("masses", "rod_small_end_share")
    key = "rod_small_end_share"
    if place is not None:
        key = "rod_centre_mm"
        if pair is None:
            return
        if place >= pair[1]:
            what = f"центр масс {number_text(place)} мм лежит не между головками шатуна"
            yield Finding(("masses", key), what, f"длина шатуна {number_text(pair[1])} мм")
            return
        share = 1 - place / pair[1]
    if share is not None and not USUAL_SHARE[0] <= share <= USUAL_SHARE[1]:
        what = f"доля массы шатуна у пальца {number_text(round(share, 4))} необычна"
        hint = f"обычно от {USUAL_SHARE[0]} до {USUAL_SHARE[1]}"
        yield Finding(("masses", key), what, hint, warning=True)


def _combustion_start(values: Values) -> tuple[Path, float] | None:
    start = values.get("gas", "combustion_start_deg")
    if start is not None:
        return ("gas", "combustion_start_deg"), start
    advance = values.get("gas", "injection_advance_deg")
    delay = values.get("gas", "ignition_delay_deg")
    if advance is None or delay is None or ("gas", "combustion_start_deg") in values.broken:
        return None
    return ("gas", "ignition_delay_deg"), FIRING_TDC_DEG - advance + delay


def _timing(values: Values) -> Iterator[Finding]:
    found = _combustion_start(values)
    advance = values.get("gas", "injection_advance_deg")
    if found is not None and advance is not None:
        path, start = found
        if start > FIRING_TDC_DEG:
            what = f"сгорание начинается при {number_text(start)}°, после ВМТ"
            yield Finding(path, what, "допустимо не позже 360°: уменьшите задержку")
        elif start < FIRING_TDC_DEG - advance:
            what = f"сгорание начинается при {number_text(start)}°, раньше впрыска"
            hint = f"допустимо от {number_text(FIRING_TDC_DEG - advance)} до 360°"
            yield Finding(path, what, hint)
    before = values.get("gas", "exhaust_start_before_bdc_deg")
    after = values.get("gas", "exhaust_end_after_bdc_deg")
    if before is not None and after is not None and before + after <= 0:
        what = "начало и конец выпуска совпадают"
        hint = "сумма углов до и после НМТ должна быть больше 0"
        yield Finding(("gas", "exhaust_end_after_bdc_deg"), what, hint)


def _pressures(values: Values) -> Iterator[Finding]:
    rho = values.get("gas", "preexpansion_ratio")
    ratio = values.get("geometry", "compression_ratio")
    if rho is not None and ratio is not None and rho >= ratio:
        what = f"ρ = {number_text(rho)} не меньше степени сжатия {number_text(ratio)}"
        yield Finding(("gas", "preexpansion_ratio"), what, "уменьшите ρ")
    intake = values.get("gas", "intake_pressure_mpa")
    exponent = values.get("gas", "compression_exponent")
    highest = values.get("gas", "max_pressure_mpa")
    pair = radius_and_rod(values)
    found = _combustion_start(values)
    if None in (intake, exponent, highest, ratio) or pair is None or found is None:
        return
    start = found[1]
    if pair[0] >= pair[1] or not 180 <= start <= FIRING_TDC_DEG:
        return
    end = intake * (ratio / _volume(start, pair[0] / pair[1], ratio)) ** exponent
    pure = intake * ratio**exponent
    path = ("gas", "max_pressure_mpa")
    if highest < end:
        what = (
            f"p_z = {MPA.text(highest)} ниже давления конца сжатия {MPA.text(round(end, 3))} "
            f"(при {number_text(start)}°)"
        )
        yield Finding(path, what, "увеличьте p_z или уменьшите p_a, ε, n_1")
    elif highest < pure:
        what = f"p_z = {MPA.text(highest)} ниже давления чистого сжатия в ВМТ"
        yield Finding(path, what, f"оно равно {MPA.text(round(pure, 3))}", warning=True)


def _volume(angle_deg: float, lam: float, ratio: float) -> float:
    # V/V_c from the exact displacement, Gots (1); only to judge p_z before there is an engine.
    phi = math.radians(angle_deg)
    rod = (1 - math.sqrt(1 - (lam * math.sin(phi)) ** 2)) / lam
    return 1 + (ratio - 1) / 2 * (1 - math.cos(phi) + rod)


def _odd_pressures(values: Values) -> Iterator[Finding]:
    ambient = values.get("gas", "ambient_pressure_mpa")
    intake = values.get("gas", "intake_pressure_mpa")
    residual = values.get("gas", "residual_pressure_mpa")
    if intake is not None and not 0.03 <= intake <= 0.5:
        what = f"давление впуска {MPA.text(intake)} необычно"
        path = ("gas", "intake_pressure_mpa")
        yield Finding(path, what, "обычно от 0.03 до 0.5 МПа", warning=True)
    if None in (ambient, intake, residual):
        return
    highest = 1.5 * max(intake, ambient)
    if not ambient <= residual <= highest:
        what = f"давление остаточных газов {MPA.text(residual)} необычно"
        hint = f"обычно от {number_text(ambient)} до {MPA.text(round(highest, 4))}"
        yield Finding(("gas", "residual_pressure_mpa"), what, hint, warning=True)


def _table(values: Values) -> Iterator[Finding]:
    points = values.get("gas", "points")
    path = ("gas", "points")
    if points is None:
        return
    if len(points) < 3:
        yield Finding(path, f"точек {len(points)}, а нужно не меньше 3", "добавьте точки")
        return
    for index in range(1, len(points)):
        before, here = points[index - 1][0], points[index][0]
        if here <= before:
            what = f"угол {number_text(here)}° не больше предыдущего {number_text(before)}°"
            yield Finding((*path, index), what, "углы должны строго возрастать")
    first, last = points[0], points[-1]
    if first[0] != 0 or last[0] != CYCLE_DEG:
        what = (
            f"точки не покрывают цикл: от {number_text(first[0])} до {number_text(last[0])}°, "
            "а нужно от 0 до 720°"
        )
        yield Finding(path, what, "добавьте крайние точки")
    elif abs(first[1] - last[1]) > PRESSURE_TOLERANCE_MPA:
        what = f"давление при 720° {MPA.text(last[1])} не равно давлению при 0° "
        yield Finding((*path, len(points) - 1), what + MPA.text(first[1]), "цикл должен замыкаться")
