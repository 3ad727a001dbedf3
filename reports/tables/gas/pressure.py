"""Gas pressure over the crank angle: corner points and the steps between them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from reports.inputs.sections.gas import RoundedGasSection, TableGasSection
from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Column, Scalar, ScalarTable
from reports.spec.shape import Shape
from reports.tables.gas.diagram import (
    by_angle,
    is_smooth,
    process_columns,
    rounded_pressure,
    smooth_pressure,
    straight_pressure,
)

WORK = "(p_MPa + following(p_MPa))/2*(following(volume_dm3) - volume_dm3)*1000"
_P_A, _P_R, _P_Z = "gas_intake_pressure_mpa", "gas_residual_pressure_mpa", "gas_max_pressure_mpa"
_OPENS, _CLOSES = "gas_exhaust_start_before_bdc_deg", "gas_exhaust_end_after_bdc_deg"
_EPS, _N_1 = "geometry_compression_ratio", "gas_compression_exponent"


@dataclass(frozen=True, slots=True)
class Corners:
    """A kind of cylinder: its volume and the names of its dead centres' angles.

    ``tdc`` and ``bdc`` are empty where these stand at 0 and 180°; ``suffix`` tells its scalars
    from those of the cylinders with rods of their own.
    """

    shape: Shape
    ratio: Callable[[str], str]
    tdc: str = ""
    bdc: str = ""
    suffix: str = ""

    def after_tdc(self, angle: str) -> str:
        """Angle [deg] that is counted from a TDC as if this stood at 0 or 360°."""
        if angle == "0" and self.tdc:
            return self.tdc
        return f"{angle} + {self.tdc}" if self.tdc else angle

    def after_bdc(self, angle: str) -> str:
        """Angle [deg] that is counted from a BDC as if this stood at 180 or 540°."""
        if angle == "180" and self.bdc:
            return self.bdc
        return f"{angle} + ({self.bdc} - 180)" if self.bdc else angle

    def name(self, key: str) -> str:
        """Key of one of its scalars: ``phi_c_art_deg``."""
        if not self.suffix:
            return key
        degrees = "_deg" if key.endswith("_deg") else ""
        return key.removesuffix("_deg") + self.suffix + degrees


def corner_points(model: InputFile, corners: Corners) -> ScalarTable:
    """Corner points of the polytropic diagram of one kind of cylinder."""
    gas, two = model.gas, corners.shape.strokes == 2
    start = (
        "gas_combustion_start_deg"
        if getattr(gas, "combustion_start_deg", None) is not None
        else "360 - gas_injection_advance_deg + gas_ignition_delay_deg"
    )
    bottom = "180" if two else "540"
    name, ratio = corners.name, corners.ratio
    begin = name("x_close") if two else _EPS
    source = "Гоц (12)" if corners.shape.offset else "Гоц (1)"
    if corners.suffix:
        source = "геометрия прицепного шатуна"

    def scalar(key: str, text: str, where: str) -> Scalar:
        return Scalar(name(key), text, where, every=f"{corners.shape.period}")

    scalars = [
        scalar("phi_c_deg", corners.after_tdc(start), "Dinn: 360° − УОВ + УЗВ"),
        scalar("phi_open_deg", corners.after_bdc(f"{bottom} - {_OPENS}"), "Dinn"),
    ]
    if two:
        scavenge = corners.after_bdc(f"{bottom} - gas_scavenge_start_before_bdc_deg")
        scalars.append(scalar("phi_scavenge_deg", scavenge, "исходные данные"))
    scalars.append(scalar("phi_close_deg", corners.after_bdc(f"{bottom} + {_CLOSES}"), "Dinn"))
    if two:
        scalars.append(scalar("x_close", ratio(name("phi_close_deg")), source))
    scalars += [
        scalar("x_start", ratio(name("phi_c_deg")), source),
        scalar("p_start", f"{_P_A}*({begin}/{name('x_start')})**{_N_1}", "политропа сжатия"),
        scalar("p_c_end", f"{_P_A}*{begin}**{_N_1}", "политропа сжатия"),
        scalar("x_open", ratio(name("phi_open_deg")), source),
        scalar(
            "p_open",
            f"{_P_Z}*min(1, (gas_preexpansion_ratio/{name('x_open')})**gas_expansion_exponent)",
            "политропа расширения",
        ),
    ]
    title = "Характерные точки индикаторной диаграммы"
    if corners.suffix:
        title += ", цилиндры с прицепными шатунами"
    return ScalarTable(f"gas_points{corners.suffix}", title, "Газы", tuple(scalars), _note(corners))


def _note(corners: Corners) -> str:
    notes = []
    if corners.shape.strokes == 2:
        notes.append(
            "Двухтактный цикл: угол отсчитан от ВМТ сгорания (0 = 360°). От открытия выпуска до "
            "начала продувки давление падает по прямой до p_r, затем по прямой меняется до p_a у "
            "закрытия выпуска, откуда начинается сжатие. Давление p_0 под поршнем при кривошипно-"
            "камерной продувке — давление продувки."
        )
    if corners.tdc:
        notes.append("Углы опережения и выпуска отсчитаны от действительных мёртвых точек поршня.")
    return " ".join(notes)


def pressure(
    model: InputFile, phi: str, ratio: str, corners: Corners
) -> tuple[str, tuple[Column, ...]]:
    """Absolute gas pressure [MPa] at the angle and volume ratio of the named columns.

    With it the helper columns that it takes: every process has its own.
    """
    if isinstance(model.gas, RoundedGasSection):
        return rounded_pressure(phi, ratio)
    if is_smooth(model):
        return smooth_pressure(phi)
    if isinstance(model.gas, TableGasSection):
        return straight_pressure(phi)
    steps = _two_stroke if corners.shape.strokes == 2 else _four_stroke
    return steps(phi, ratio, corners)


def _rise(phi: str, corners: Corners) -> str:
    start, begin = corners.name("p_start"), corners.name("phi_c_deg")
    slope = f"({_P_Z} - {start})*({phi} - {begin})/gas_injection_advance_deg"
    return f"min({_P_Z}, {start} + {slope})"


def _expansion(ratio: str) -> str:
    return f"{_P_Z}*min(1, (gas_preexpansion_ratio/{ratio})**gas_expansion_exponent)"


def _line(phi: str, begin: str, at_begin: str, end: str, at_end: str) -> str:
    return f"{at_begin} + ({at_end} - {at_begin})*({phi} - {begin})/({end} - {begin})"


def _four_stroke(phi: str, ratio: str, corners: Corners) -> tuple[str, tuple[Column, ...]]:
    name = corners.name
    opens, closes = name("phi_open_deg"), name("phi_close_deg")
    top = corners.after_tdc("360")
    parts = {
        "p_compression_MPa": f"{_P_A}*({_EPS}/{ratio})**{_N_1}",
        "p_burning_MPa": f"{_rise(phi, corners)} if {phi} <= {top} else {_expansion(ratio)}",
        "p_exhaust_MPa": _line(phi, opens, name("p_open"), closes, _P_R),
    }
    text = by_angle(phi, (
        (corners.after_tdc("0"), _P_R),
        (corners.after_bdc("180"), _P_A),
        (name("phi_c_deg"), "p_compression_MPa"),
        (opens, "p_burning_MPa"),
        (closes, "p_exhaust_MPa"),
    ), _P_R)  # fmt: skip
    return text, process_columns(parts)


def _two_stroke(phi: str, ratio: str, corners: Corners) -> tuple[str, tuple[Column, ...]]:
    name = corners.name
    opens, scavenge, closes = (name(f"phi_{key}_deg") for key in ("open", "scavenge", "close"))
    top = corners.after_tdc("0")
    rise = _rise(f"({corners.after_tdc('360')})", corners)
    parts = {
        "p_compression_MPa": f"{_P_A}*({name('x_close')}/{ratio})**{_N_1}",
        "p_burning_MPa": f"{rise} if {phi} <= {top} else {_expansion(ratio)}",
        "p_exhaust_MPa": _line(phi, opens, name("p_open"), scavenge, _P_R),
        "p_scavenge_MPa": _line(phi, scavenge, _P_R, closes, _P_A),
    }
    text = by_angle(phi, (
        (opens, "p_burning_MPa"),
        (scavenge, "p_exhaust_MPa"),
        (closes, "p_scavenge_MPa"),
        (name("phi_c_deg"), "p_compression_MPa"),
    ), _rise(phi, corners))  # fmt: skip
    return text, process_columns(parts)
