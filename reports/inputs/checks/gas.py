"""Checks of the [gas] section against itself and the geometry."""

from __future__ import annotations

from collections.abc import Iterator

from reports.inputs.checks.rounded import check_rounded
from reports.inputs.checks.volume import volume_ratio
from reports.inputs.findings import Finding, Path, Values, radius_and_rod
from reports.inputs.units import MPA, number_text

FIRING_TDC_DEG = 360.0
PRESSURE_TOLERANCE_MPA = 1e-6


def check_gas(values: Values) -> Iterator[Finding]:
    """Yield what is wrong or odd about timing, pressures or the table of points."""
    yield from _two_stroke(values)
    source = values.get("gas", "source")
    if source == "cycle":
        yield from _timing(values)
    elif source == "polytropic":
        yield from _timing(values)
        yield from _pressures(values)
        yield from _odd_pressures(values)
    elif source == "rounded":
        yield from _central_only(values)
        yield from check_rounded(values)
    else:
        yield from _table(values)


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
    ratio = values.get("geometry", "compression_ratio")
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
    begin, lam = ratio, pair[0] / pair[1]
    if values.get("engine", "strokes") == 2:  # compression begins where the exhaust closes
        closes = values.get("gas", "exhaust_end_after_bdc_deg") or 0.0
        begin = volume_ratio(180 + closes, lam, ratio)
    end = intake * (begin / volume_ratio(start, lam, ratio)) ** exponent
    pure = intake * begin**exponent
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


def _odd_pressures(values: Values) -> Iterator[Finding]:
    ambient = values.get("gas", "ambient_pressure_mpa")
    intake = values.get("gas", "intake_pressure_mpa")
    residual = values.get("gas", "residual_pressure_mpa")
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
    cycle = 180 * (values.get("engine", "strokes") or 4)
    if first[0] != 0 or last[0] != cycle:
        what = (
            f"точки не покрывают цикл: от {number_text(first[0])} до {number_text(last[0])}°, "
            f"а нужно от 0 до {cycle}°"
        )
        yield Finding(path, what, "добавьте крайние точки")
    elif abs(first[1] - last[1]) > PRESSURE_TOLERANCE_MPA:
        what = f"давление при {cycle}° {MPA.text(last[1])} не равно давлению при 0° "
        yield Finding((*path, len(points) - 1), what + MPA.text(first[1]), "цикл должен замыкаться")


def _central_only(values: Values) -> Iterator[Finding]:
    keys = ("crank_offset_mm", "pin_offset_mm")
    others = [key for key in keys if values.get("geometry", key) is not None]
    if others or "articulated" in values.sections:
        what = "скруглённая диаграмма построена только для центрального механизма"
        yield Finding(("gas", "source"), what, "задайте точки или политропы")


def _two_stroke(values: Values) -> Iterator[Finding]:
    strokes = values.get("engine", "strokes")
    if strokes == 2 and values.get("gas", "source") == "cycle":
        what = "рабочий цикл рассчитывается только для четырёхтактного двигателя"
        yield Finding(("gas", "source"), what, 'задайте source = "polytropic" или "table"')
    if values.get("gas", "source") != "polytropic" or strokes is None:
        return
    path = ("gas", "scavenge_start_before_bdc_deg")
    scavenge = values.get(*path)
    if strokes == 4:
        if scavenge is not None:
            what = "продувка есть только у двухтактного двигателя"
            yield Finding(path, what, "удалите ключ или задайте strokes = 2")
        return
    closes = values.get("gas", "exhaust_end_after_bdc_deg")
    if scavenge is None and values.sure("gas", path[1]):
        yield Finding(path, "начало продувки не задано", "двухтактному двигателю оно нужно")
    if closes is not None and closes + (scavenge or 0.0) <= 0:
        what = "продувка и выпуск кончаются там же, где начинаются"
        yield Finding(("gas", "exhaust_end_after_bdc_deg"), what, "увеличьте угол")
