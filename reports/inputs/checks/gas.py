"""Checks of the [gas] section: by polytropes, rounded, and by points."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from reports.inputs.checks import bands
from reports.inputs.fields import Path
from reports.inputs.findings import Finding, ValidValues, radius_and_rod
from reports.inputs.sections.gas import (
    BDC_DEG,
    FIRING_TDC_DEG,
    JOIN_DEG,
    PEAK_DEG,
    PEAK_SHARE,
    GasSection,
    TableGasSection,
)
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.masses import Sizes
from reports.inputs.units import MPA, is_within, number_text

if TYPE_CHECKING:
    from kshm.arrays import Array

PRESSURE_TOLERANCE_MPA = 1e-6
# Angles from the TDC of combustion [deg]: valves are closed and nothing burns there.
COMPRESSION, EXPANSION = (-90.0, -40.0), (50.0, 90.0)
INTAKE = (-330.0, -210.0)
FARTHEST_PEAK_DEG = 45.0
_GAUGE, _LATE = 1.15, 1.4  # exponents of expansion that speak for the pressure and for the angle


def volume_ratio(angle_deg: float, lam: float, ratio: float) -> float:
    """V/V_c at a crank angle of a central mechanism with this λ and compression ratio."""
    return float(volume_ratios(angle_deg, lam, ratio))


def volume_ratios(angles_deg: Array | float, lam: float, ratio: float) -> Array:
    """V/V_c [-] at the crank angles of a central mechanism, elementwise."""
    # Only a file whose pressures are judged pays for the numeric part.
    import numpy as np

    from kshm.mechanics.kinematics import displacement_exact
    from kshm.mechanics.kinematics import volume_ratio as at_displacement

    crank = np.array(1.0)
    displacement = displacement_exact(np.radians(angles_deg), crank, np.array(lam))
    return at_displacement(displacement, 2 * crank, np.array(ratio))


def check_rounded(values: ValidValues) -> Iterator[Finding]:
    """Yield points of figure 22 that cannot be joined."""
    strokes = values.get("engine", "strokes")
    if strokes is not None and int(strokes) != 4:
        problem = "скруглённая диаграмма построена только для четырёхтактного двигателя"
        yield Finding(("gas", "source"), problem, "задайте точки или политропы")
        return
    kind = values.get("gas", "kind")
    if kind is None:
        return
    wrong = list(_angles(values, kind))
    yield from wrong
    if not wrong:
        yield from _rounded_pressures(values, kind)


def _angles(values: ValidValues, kind: str) -> Iterator[Finding]:
    start = _start(values)
    if start is not None and not 181 < start < FIRING_TDC_DEG:
        problem = f"сгорание начинается при {number_text(start)}°"
        hint = "точка c' должна лежать до ВМТ: уменьшите задержку воспламенения"
        yield Finding(("gas", "ignition_delay_deg"), problem, hint)
    peak, join = (
        _place(values, "peak_after_tdc_deg", PEAK_DEG[kind]),
        _place(values, "expansion_after_tdc_deg", JOIN_DEG[kind]),
    )
    if join <= peak:
        problem = f"выход на линию расширения при {number_text(join)}° не позже точки z_д"
        hint = f"задайте больше {number_text(peak)}°"
        yield Finding(("gas", "expansion_after_tdc_deg"), problem, hint)
    before = values.get("gas", "exhaust_start_before_bdc_deg")
    if before is not None and BDC_DEG - before <= FIRING_TDC_DEG + join:
        problem = "выпуск начинается раньше линии расширения"
        yield Finding(("gas", "exhaust_start_before_bdc_deg"), problem, "уменьшите угол")


def _rounded_pressures(values: ValidValues, kind: str) -> Iterator[Finding]:
    names = ("intake_pressure_mpa", "residual_pressure_mpa", "max_pressure_mpa",
             "compression_exponent", "expansion_exponent", "preexpansion_ratio", "tdc_rise",
             "exhaust_start_before_bdc_deg")  # fmt: skip
    pressures = [values.get("gas", name) for name in names]
    ratio, pair, start = values.get("geometry", "compression_ratio"), radius_and_rod(values), None
    if None in pressures or ratio is None or pair is None or pair[0] >= pair[1]:
        return
    start = _start(values)
    if start is None:
        return
    p_a, p_r, p_z, n_1, n_2, rho, rise, before = pressures
    lam = pair[0] / pair[1]
    share = values.get("gas", "peak_share")
    top = p_z * (PEAK_SHARE[kind] if share is None else share)
    at_start = p_a * (ratio / volume_ratio(start, lam, ratio)) ** n_1
    at_tdc = rise * p_a * ratio**n_1

    def expanded(angle: float) -> float:
        return float(p_z * (rho / volume_ratio(angle, lam, ratio)) ** n_2)

    join = expanded(FIRING_TDC_DEG + _place(values, "expansion_after_tdc_deg", JOIN_DEG[kind]))
    opening, bottom = expanded(BDC_DEG - before), (expanded(BDC_DEG) + p_r) / 2
    chain: tuple[tuple[str, Path, float, float, str], ...] = (
        ("давление в c'' не выше давления в c'", ("gas", "tdc_rise"), at_start, at_tdc,
         "увеличьте tdc_rise"),
        ("p_zд не выше давления в c''", ("gas", "max_pressure_mpa"), at_tdc, top,
         "увеличьте p_z или уменьшите tdc_rise"),
        ("линия расширения в точке выхода не ниже p_zд", ("gas", "expansion_after_tdc_deg"),
         join, top, "увеличьте угол"),
        ("давление в b'' не ниже давления в b'", ("gas", "residual_pressure_mpa"), bottom,
         opening, "уменьшите p_r"),
        ("p_r не ниже давления в b''", ("gas", "residual_pressure_mpa"), p_r, bottom,
         "уменьшите p_r"),
    )  # fmt: skip
    for words, path, low, high, hint in chain:
        if not low < high:
            numbers = f" ({MPA.text(round(low, 3))} и {MPA.text(round(high, 3))})"
            yield Finding(path, words + numbers, hint)
            return


def _start(values: ValidValues) -> float | None:
    advance = values.get("gas", "injection_advance_deg")
    delay = values.get("gas", "ignition_delay_deg")
    return None if advance is None or delay is None else FIRING_TDC_DEG - advance + delay


def _place(values: ValidValues, key: str, usual: float) -> float:
    angle = values.get("gas", key)
    return usual if angle is None else float(angle)


def check_gas(values: ValidValues) -> Iterator[Finding]:
    """Yield errors and oddities of timing, pressures and tabulated points."""
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


def _combustion_start(values: ValidValues) -> tuple[Path, float] | None:
    start = values.get("gas", "combustion_start_deg")
    if start is not None:
        return ("gas", "combustion_start_deg"), start
    advance = values.get("gas", "injection_advance_deg")
    delay = values.get("gas", "ignition_delay_deg")
    if advance is None or delay is None or ("gas", "combustion_start_deg") in values.broken:
        return None
    return ("gas", "ignition_delay_deg"), FIRING_TDC_DEG - advance + delay


def _timing(values: ValidValues) -> Iterator[Finding]:
    ignition = _combustion_start(values)
    advance = values.get("gas", "injection_advance_deg")
    if ignition is not None and advance is not None:
        path, start = ignition
        if start > FIRING_TDC_DEG:
            problem = f"сгорание начинается при {number_text(start)}°, после ВМТ"
            yield Finding(path, problem, "допустимо не позже 360°: уменьшите задержку")
        elif start < FIRING_TDC_DEG - advance:
            problem = f"сгорание начинается при {number_text(start)}°, раньше впрыска"
            hint = f"допустимо от {number_text(FIRING_TDC_DEG - advance)} до 360°"
            yield Finding(path, problem, hint)
    before = values.get("gas", "exhaust_start_before_bdc_deg")
    after = values.get("gas", "exhaust_end_after_bdc_deg")
    if before is not None and after is not None and before + after <= 0:
        problem = "начало и конец выпуска совпадают"
        hint = "сумма углов до и после НМТ должна быть больше 0"
        yield Finding(("gas", "exhaust_end_after_bdc_deg"), problem, hint)


def _pressures(values: ValidValues) -> Iterator[Finding]:
    ratio = values.get("geometry", "compression_ratio")
    intake = values.get("gas", "intake_pressure_mpa")
    exponent = values.get("gas", "compression_exponent")
    highest = values.get("gas", "max_pressure_mpa")
    pair = radius_and_rod(values)
    ignition = _combustion_start(values)
    if None in (intake, exponent, highest, ratio) or pair is None or ignition is None:
        return
    start = ignition[1]
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
        problem = (
            f"p_z = {MPA.text(highest)} ниже давления конца сжатия {MPA.text(round(end, 3))} "
            f"(при {number_text(start)}°)"
        )
        yield Finding(path, problem, "увеличьте p_z или уменьшите p_a, ε, n_1")
    elif highest < pure:
        problem = f"p_z = {MPA.text(highest)} ниже давления чистого сжатия в ВМТ"
        yield Finding(path, problem, f"оно равно {MPA.text(round(pure, 3))}", warning=True)


def _odd_pressures(values: ValidValues) -> Iterator[Finding]:
    ambient = values.get("gas", "ambient_pressure_mpa")
    intake = values.get("gas", "intake_pressure_mpa")
    residual = values.get("gas", "residual_pressure_mpa")
    if None in (ambient, intake, residual):
        return
    highest = 1.5 * max(intake, ambient)
    if not ambient <= residual <= highest:
        problem = f"давление остаточных газов {MPA.text(residual)} необычно"
        hint = f"обычно от {number_text(ambient)} до {MPA.text(round(highest, 4))}"
        yield Finding(("gas", "residual_pressure_mpa"), problem, hint, warning=True)


def _table(values: ValidValues) -> Iterator[Finding]:
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
            problem = f"угол {number_text(here)}° не больше предыдущего {number_text(before)}°"
            yield Finding((*path, index), problem, "углы должны строго возрастать")
    first, last = points[0], points[-1]
    cycle = 180 * (values.get("engine", "strokes") or 4)
    if first[0] != 0 or last[0] != cycle:
        problem = (
            f"точки не покрывают цикл: от {number_text(first[0])} до {number_text(last[0])}°, "
            f"а нужно от 0 до {cycle}°"
        )
        yield Finding(path, problem, "добавьте крайние точки")
    elif abs(first[1] - last[1]) > PRESSURE_TOLERANCE_MPA:
        problem = f"давление при {cycle}° {MPA.text(last[1])} не равно давлению при 0° "
        yield Finding(
            (*path, len(points) - 1), problem + MPA.text(first[1]), "цикл должен замыкаться"
        )


def _central_only(values: ValidValues) -> Iterator[Finding]:
    keys = ("crank_offset_mm", "pin_offset_mm")
    others = [key for key in keys if values.get("geometry", key) is not None]
    if others or "articulated" in values.sections:
        problem = "скруглённая диаграмма построена только для центрального механизма"
        yield Finding(("gas", "source"), problem, "задайте точки или политропы")


def _two_stroke(values: ValidValues) -> Iterator[Finding]:
    strokes = values.get("engine", "strokes")
    if strokes == 2 and values.get("gas", "source") == "cycle":
        problem = "рабочий цикл рассчитывается только для четырёхтактного двигателя"
        yield Finding(("gas", "source"), problem, 'задайте source = "polytropic" или "table"')
    if values.get("gas", "source") != "polytropic" or strokes is None:
        return
    path = ("gas", "scavenge_start_before_bdc_deg")
    scavenge = values.get(*path)
    if strokes == 4:
        if scavenge is not None:
            problem = "продувка есть только у двухтактного двигателя"
            yield Finding(path, problem, "удалите ключ или задайте strokes = 2")
        return
    closes = values.get("gas", "exhaust_end_after_bdc_deg")
    if scavenge is None and values.sure("gas", path[1]):
        yield Finding(path, "начало продувки не задано", "двухтактному двигателю оно нужно")
    if closes is not None and closes + (scavenge or 0.0) <= 0:
        problem = "продувка и выпуск кончаются там же, где начинаются"
        yield Finding(("gas", "exhaust_end_after_bdc_deg"), problem, "увеличьте угол")


@dataclass(frozen=True, slots=True)
class DiagramFigures:
    """Figures of a diagram by points; None where too few points stand in the stretch.

    Pressures in MPa; ``peak_deg`` is counted from the TDC of combustion, ``peak_at`` is the
    angle of the cycle.
    """

    work: float
    peak: float
    peak_at: float
    peak_deg: float
    compression: float | None
    expansion: float | None
    intake: float | None
    ambient: float


def indicated_of(model: InputFile, gas: TableGasSection, sizes: Sizes) -> DiagramFigures:
    """Figures of a diagram by points."""
    import numpy as np

    from kshm.mechanics.gas import mean_pressure, polytropic_exponent

    angles, pressures = np.array(gas.points, dtype=float).T
    lam, eps = sizes.radius / sizes.rod, float(model.geometry.compression_ratio)
    ratio = volume_ratios(angles, lam, eps)
    period = 180.0 * model.engine.strokes
    firing = 360.0 if model.engine.strokes == 4 else 0.0
    past = np.mod(angles - firing + period / 2, period) - period / 2

    def exponent(stretch: tuple[float, float]) -> float | None:
        inside = (past >= stretch[0]) & (past <= stretch[1])
        return polytropic_exponent(pressures[inside], ratio[inside]) if inside.sum() > 1 else None

    top = int(pressures.argmax())
    taken_in = (past >= INTAKE[0]) & (past <= INTAKE[1])
    return DiagramFigures(
        mean_pressure(pressures, ratio, eps), float(pressures[top]), float(angles[top]),
        float(past[top]), exponent(COMPRESSION), exponent(EXPANSION),
        float(pressures[taken_in].mean()) if taken_in.any() else None, gas.ambient_pressure_mpa,
    )  # fmt: skip


def check_indicated(model: InputFile, sizes: Sizes) -> Iterator[Finding]:
    """Yield likely faults in the angles and pressures of a diagram by points."""
    gases: list[tuple[Path, GasSection]] = [((), model.gas)]
    gases += [(("regimes", i), regime.gas) for i, regime in enumerate(model.regimes)]
    for owner, gas in gases:
        if isinstance(gas, TableGasSection):
            yield from _suggested(indicated_of(model, gas, sizes), (*owner, "gas", "points"))


def _suggested(figures: DiagramFigures, path: Path) -> Iterator[Finding]:
    """Yield one line for the first cause; it makes all others doubtful."""
    first = next((finding for finding in _causes(figures, path)), None)
    if first is not None:
        yield first


def _causes(figures: DiagramFigures, path: Path) -> Iterator[Finding]:
    yield from _turned(figures, path)
    n_1, n_2 = figures.compression, figures.expansion
    usual = bands.TRACE_COMPRESSION
    if n_1 is not None and not is_within(n_1, (usual.low, usual.high)):
        yield _odd_compression(n_1, n_2, figures, path)
    if n_2 is not None and not is_within(n_2, bands.TRACE_EXPANSION.span):
        problem = f"показатель расширения по точкам {_short(n_2)} необычен"
        hint = f"{_usual(bands.TRACE_EXPANSION)}; проверьте ВМТ, единицу и степень сжатия"
        yield Finding(path, problem, hint, warning=True)
    intake = bands.band_of("gas.intake_pressure_mpa")
    if figures.intake is not None and not is_within(figures.intake, intake.span):
        problem = f"на впуске в среднем {MPA.text(_rounded(figures.intake))}, это необычно"
        hint = f"{_usual(intake)} МПа; нужно абсолютное давление"
        yield Finding(path, problem, hint, warning=True)


def _turned(figures: DiagramFigures, path: Path) -> Iterator[Finding]:
    """Peak far from the TDC of combustion, or negative work."""
    if abs(figures.peak_deg) <= FARTHEST_PEAK_DEG and figures.work > 0:
        return
    problem = (
        f"наибольшее давление стоит при {number_text(figures.peak_at)}°, "
        f"работа цикла p_i = {MPA.text(_rounded(figures.work))}"
    )
    turn = 90 * round(figures.peak_deg / 90)
    hint = "проверьте порядок углов и ВМТ"
    if abs(turn) == 360:
        hint = "похоже, за ВМТ сгорания принята ВМТ газообмена: сдвиньте углы на 360°"
    elif turn:
        hint = f"похоже, ВМТ сдвинута примерно на {abs(turn)}°"
    yield Finding(path, problem, f"{hint} (firing_tdc_deg у файла)", warning=True)


def _odd_compression(n_1: float, n_2: float | None, figures: DiagramFigures, path: Path) -> Finding:
    """Exponent of compression out of its band, with its likely cause."""
    high = n_1 > bands.TRACE_COMPRESSION.high
    level = "" if figures.intake is None else f", на впуске {MPA.text(_rounded(figures.intake))}"
    cause, mend = "занижен нуль давления или неверны ВМТ и степень сжатия", "проверьте их"
    low = figures.intake is None or figures.intake < figures.ambient
    if high and low and n_2 is not None and n_2 >= _GAUGE:
        cause, mend = "давление избыточное", "нужно абсолютное: прибавьте атмосферное"
    elif n_2 is not None and (n_2 < _GAUGE if high else n_2 > _LATE):
        late = "позже" if high else "раньше"
        cause, mend = f"ВМТ принята {late} действительной", "проверьте firing_tdc_deg"
    elif not high:
        cause, mend = "нуль давления завышен или ВМТ сдвинута", "проверьте их и степень сжатия"
    problem = f"похоже, что {cause}: показатель сжатия {_short(n_1)}{level}"
    return Finding(path, problem, f"{_usual(bands.TRACE_COMPRESSION)}; {mend}", warning=True)


def _usual(band: bands.Band) -> str:
    return f"обычно от {number_text(band.low)} до {number_text(band.high)}"


def _short(value: float) -> str:
    return number_text(round(value, 2))


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")
