"""A diagram by points judged as an engineer does: work, peak, exponents, level at intake."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from reports.inputs.checks import bands
from reports.inputs.checks.volume import volume_ratios
from reports.inputs.findings import Finding, Path
from reports.inputs.sections.gas import GasSection, TableGasSection
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.geometry import Sizes
from reports.inputs.units import MPA, is_within, number_text

# Angles from the TDC of combustion [deg]: valves are closed and nothing burns there.
COMPRESSION, EXPANSION = (-90.0, -40.0), (50.0, 90.0)
INTAKE = (-330.0, -210.0)
FARTHEST_PEAK_DEG = 45.0
_GAUGE, _LATE = 1.15, 1.4  # exponents of expansion that speak for the pressure and for the angle


@dataclass(frozen=True, slots=True)
class Indicated:
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


def indicated_of(model: InputFile, gas: TableGasSection, sizes: Sizes) -> Indicated:
    """The figures of a diagram by points in this engine."""
    import numpy as np

    from kshm.mechanics.indicated import mean_pressure, polytropic_exponent

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
    return Indicated(
        mean_pressure(pressures, ratio, eps), float(pressures[top]), float(angles[top]),
        float(past[top]), exponent(COMPRESSION), exponent(EXPANSION),
        float(pressures[taken_in].mean()) if taken_in.any() else None, gas.ambient_pressure_mpa,
    )  # fmt: skip


def check_indicated(model: InputFile, sizes: Sizes) -> Iterator[Finding]:
    """Yield what a diagram by points suggests of its angles and of its pressures."""
    gases: list[tuple[Path, GasSection]] = [((), model.gas)]
    gases += [(("regimes", i), regime.gas) for i, regime in enumerate(model.regimes)]
    for owner, gas in gases:
        if isinstance(gas, TableGasSection):
            yield from _suggested(indicated_of(model, gas, sizes), (*owner, "gas", "points"))


def _suggested(found: Indicated, path: Path) -> Iterator[Finding]:
    """One line for one cause: the first that is met makes all others doubtful."""
    first = next((finding for finding in _causes(found, path)), None)
    if first is not None:
        yield first


def _causes(found: Indicated, path: Path) -> Iterator[Finding]:
    yield from _turned(found, path)
    n_1, n_2 = found.compression, found.expansion
    usual = bands.TRACE_COMPRESSION
    if n_1 is not None and not is_within(n_1, (usual.low, usual.high)):
        yield _odd_compression(n_1, n_2, found, path)
    if n_2 is not None and not is_within(n_2, bands.TRACE_EXPANSION.span):
        what = f"показатель расширения по точкам {_short(n_2)} необычен"
        hint = f"{_usual(bands.TRACE_EXPANSION)}; проверьте ВМТ, единицу и степень сжатия"
        yield Finding(path, what, hint, warning=True)
    intake = bands.band_of("gas.intake_pressure_mpa")
    if found.intake is not None and not is_within(found.intake, intake.span):
        what = f"на впуске в среднем {MPA.text(_rounded(found.intake))}, это необычно"
        hint = f"{_usual(intake)} МПа; нужно абсолютное давление"
        yield Finding(path, what, hint, warning=True)


def _turned(found: Indicated, path: Path) -> Iterator[Finding]:
    """The peak stands far from the TDC of combustion, or the gases take work."""
    if abs(found.peak_deg) <= FARTHEST_PEAK_DEG and found.work > 0:
        return
    what = (
        f"наибольшее давление стоит при {number_text(found.peak_at)}°, "
        f"работа цикла p_i = {MPA.text(_rounded(found.work))}"
    )
    turn = 90 * round(found.peak_deg / 90)
    hint = "проверьте порядок углов и ВМТ"
    if abs(turn) == 360:
        hint = "похоже, за ВМТ сгорания принята ВМТ газообмена: сдвиньте углы на 360°"
    elif turn:
        hint = f"похоже, ВМТ сдвинута примерно на {abs(turn)}°"
    yield Finding(path, what, f"{hint} (firing_tdc_deg у файла)", warning=True)


def _odd_compression(n_1: float, n_2: float | None, found: Indicated, path: Path) -> Finding:
    """An exponent of compression out of its band, and what speaks for which cause."""
    high = n_1 > bands.TRACE_COMPRESSION.high
    level = "" if found.intake is None else f", на впуске {MPA.text(_rounded(found.intake))}"
    cause, mend = "занижен нуль давления или неверны ВМТ и степень сжатия", "проверьте их"
    low = found.intake is None or found.intake < found.ambient
    if high and low and n_2 is not None and n_2 >= _GAUGE:
        cause, mend = "давление избыточное", "нужно абсолютное: прибавьте атмосферное"
    elif n_2 is not None and (n_2 < _GAUGE if high else n_2 > _LATE):
        late = "позже" if high else "раньше"
        cause, mend = f"ВМТ принята {late} действительной", "проверьте firing_tdc_deg"
    elif not high:
        cause, mend = "нуль давления завышен или ВМТ сдвинута", "проверьте их и степень сжатия"
    what = f"похоже, что {cause}: показатель сжатия {_short(n_1)}{level}"
    return Finding(path, what, f"{_usual(bands.TRACE_COMPRESSION)}; {mend}", warning=True)


def _usual(band: bands.Band) -> str:
    return f"обычно от {number_text(band.low)} до {number_text(band.high)}"


def _short(value: float) -> str:
    return number_text(round(value, 2))


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")
