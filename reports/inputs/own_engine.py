"""Engines made of usual values: what ``kshm new --cylinders …`` and ``--from`` write.

The rules are data: gas data and sizes by kind and number of strokes, the crankshaft over the
bore by layout, the phases in `reports.inputs.own_phases`.  The ratios of the crankshaft are
those of Kolchin and Demidov («Расчет автомобильных и тракторных двигателей», sizes of
crankshafts), by memory; the opposed ones are those of the sample vw-1600; masses are table 4
of the textbook.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from kshm.engine.masses import Estimate
from kshm.mechanics.rod_masses import PISTON, ROD, THROW, area_masses
from reports.inputs.own_phases import Phases, phases
from reports.inputs.sections.input_file import LAYOUTS
from reports.inputs.to_si.geometry import Sizes
from reports.inputs.to_si.masses import PIN_SHARE, ROD_SHARE
from reports.inputs.units import number_text, span_text
from reports.shared.errors import InputError, Problem

BORES_MM = (20.0, 1000.0)
# Two rods share a pin: its mass over table 4, as of the sample yamz-238.
_SHARED_PIN = 1.4
Notes = dict[str, str]


@dataclass(frozen=True, slots=True)
class Usual:
    """An engine without its size.

    Attributes:
        gas: keys of [gas]: polytropes that give ``effective_mpa``.
        ratio: compression ratio.
        stroke_bore: S/D.
        lam: λ = r/L.
        efficiency: mechanical efficiency.
        effective_mpa: mean effective pressure that the diagram gives; a test holds it.
        piston_speed: Sn/30 at the rated speed [m/s].
        bore_mm: bore where neither power nor speed is given.
    """

    gas: dict[str, float]
    ratio: float
    stroke_bore: float
    lam: float
    efficiency: float
    effective_mpa: float
    piston_speed: float
    bore_mm: float


_GAS = (
    "ambient_pressure_mpa", "intake_pressure_mpa", "residual_pressure_mpa", "max_pressure_mpa",
    "compression_exponent", "expansion_exponent", "preexpansion_ratio", "injection_advance_deg",
    "ignition_delay_deg", "exhaust_start_before_bdc_deg", "exhaust_end_after_bdc_deg",
    "scavenge_start_before_bdc_deg",
)  # fmt: skip


def _gas(*values: float) -> dict[str, float]:
    return dict(zip(_GAS, values, strict=False))


USUAL: dict[tuple[str, int], Usual] = {
    ("petrol", 4): Usual(
        _gas(0.1, 0.085, 0.115, 6.2, 1.37, 1.25, 1.1, 30, 12, 55, 25),
        9.5, 0.95, 0.28, 0.8, 0.81, 13.0, 82.0,
    ),
    ("diesel", 4): Usual(
        _gas(0.1, 0.09, 0.11, 7.8, 1.37, 1.26, 1.27, 24, 14, 56, 25),
        16.5, 1.15, 0.27, 0.78, 0.645, 9.0, 105.0,
    ),
    ("petrol", 2): Usual(
        _gas(0.115, 0.11, 0.12, 4.3, 1.33, 1.28, 1.05, 28, 10, 78, 70, 60),
        8.2, 1.0, 0.26, 0.85, 0.557, 12.0, 66.0,
    ),
    ("diesel", 2): Usual(
        _gas(0.1, 0.12, 0.125, 7.8, 1.36, 1.27, 1.2, 18, 8, 80, 60, 48),
        16.0, 1.15, 0.26, 0.8, 0.603, 8.0, 108.0,
    ),
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Ratios:
    """The crankshaft: diameters over the bore, lengths over diameters, web over the bore.

    ``pin_length`` is that under all the rods of a pin; ``counterweights`` is the share of the
    rotating masses that they take.
    """

    pin: float
    pin_length: float
    main: float
    main_length: float
    web: float
    counterweights: float = 1.0


SHAFTS: dict[tuple[str, str], Ratios] = {
    ("inline", "petrol"): Ratios(0.65, 0.6, 0.78, 0.52, 0.21),
    ("inline", "diesel"): Ratios(0.68, 0.58, 0.8, 0.52, 0.245),
    ("v", "petrol"): Ratios(0.6, 0.9, 0.7, 0.5, 0.21, 0.8),
    ("v", "diesel"): Ratios(0.68, 0.9, 0.75, 0.52, 0.245, 0.8),
    ("opposed", "petrol"): Ratios(0.62, 0.4, 0.64, 0.4, 0.14),
    ("opposed", "diesel"): Ratios(0.66, 0.4, 0.7, 0.4, 0.15),
}


@dataclass(frozen=True, slots=True)
class Made:
    """An engine as a mapping of the file, notes to its keys by «section.key», words above it."""

    data: dict[str, Any]
    notes: Notes
    head: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ShaftSizes:
    """Journals and webs [mm]; ``pin_length`` of the whole pin, ``main_lengths`` from the nose."""

    pin: float
    pin_length: float
    main: float
    main_lengths: tuple[float, ...]
    web: float
    notes: Notes = field(default_factory=dict)


def own_engine(
    cylinders: int,
    *,
    layout: str = "inline",
    strokes: int = 4,
    kind: str = "petrol",
    power_kw: float | None = None,
    speed_rpm: float | None = None,
) -> Made:
    """An engine of usual values for a power and a speed, or for the usual ones.

    Raises:
        InputError: there is no such engine.
    """
    timing = phases(cylinders, layout, strokes)
    usual = USUAL[kind, strokes]
    bore, stroke, speed = _size(usual, cylinders, strokes, power_kw, speed_rpm)
    area = math.pi * bore**2 / 4
    swept = area * stroke * cylinders
    power = usual.effective_mpa * swept * speed / (30 * strokes * 1e6)  # MPa·mm³/s = 1e-3 W
    notes = {
        "geometry.bore_mm": f"при p_e = {number_text(usual.effective_mpa)} МПа и Sn/30 ≈ "
        f"{number_text(round(stroke * speed / 30000, 1))} м/с; впишите свой",
        "geometry.stroke_mm": f"обычное S/D = {number_text(usual.stroke_bore)}; впишите свой",
        "geometry.rod_length_mm": f"обычное λ = {number_text(usual.lam)}",
        "regime.mechanical_efficiency": "обычное",
        "gas.max_pressure_mpa": f"диаграмма даёт p_e ≈ {number_text(usual.effective_mpa)} МПа",
    }
    if speed_rpm is None:
        words = f"обычная: средняя скорость поршня {number_text(usual.piston_speed)} м/с"
        notes["regime.speed_rpm"] = words
    data = {
        "engine": _engine(cylinders, layout, strokes, _named(kind, layout, cylinders, strokes)),
        "geometry": {
            "bore_mm": bore,
            "stroke_mm": stroke,
            "rod_length_mm": round(stroke / 2 / usual.lam, 1),
            "compression_ratio": usual.ratio,
        },
        "regime": {"speed_rpm": speed, "mechanical_efficiency": usual.efficiency},
        "gas": {"source": "polytropic", **usual.gas},
    }
    sizes = usual_shaft(layout, kind, bore, throws_of(cylinders, layout))
    masses, found = table_masses(layout, kind, bore, stroke)
    data["masses"], data["crankshaft"] = masses, shaft(layout, timing, sizes, found)
    head = (
        f"Двигатель составлен из обычных значений: около {number_text(round(power, 1))} кВт при "
        f"{number_text(speed)} мин⁻¹, рабочий объём {number_text(round(swept / 1e6, 2))} л.",
    )
    return Made(data, {**notes, **found.notes, **sizes.notes, **timing_notes(timing)}, head)


def _size(
    usual: Usual, cylinders: int, strokes: int, power_kw: float | None, speed_rpm: float | None
) -> tuple[float, float, float]:
    """Bore, stroke [mm] and speed [min⁻¹]."""
    metres = usual.piston_speed * 30 * 1000  # S·n [mm/min]
    if power_kw is None:
        bore = usual.bore_mm
        if speed_rpm is not None:
            bore = metres / speed_rpm / usual.stroke_bore
    elif speed_rpm is None:  # N_e = p_e·F·c_m·i/τ
        area = power_kw * 1000 * strokes / (
            usual.effective_mpa * usual.piston_speed * cylinders
        )  # fmt: skip
        bore = math.sqrt(4 * area / math.pi)
    else:  # N_e = p_e·V·n/(30τ)
        swept = power_kw * 30e6 * strokes / (usual.effective_mpa * speed_rpm * cylinders)
        bore = (4 * swept / math.pi / usual.stroke_bore) ** (1 / 3)
    bore = round(bore, 1)
    if not BORES_MM[0] <= bore <= BORES_MM[1]:
        raise _no_such_bore(bore, power_kw)
    stroke = round(bore * usual.stroke_bore, 1)
    if speed_rpm is None:
        step = 50 if metres / stroke > 1000 else 5
        speed_rpm = step * round(metres / stroke / step)
        if power_kw is not None:  # the rounded speed gives the same power
            swept = power_kw * 30e6 * strokes / (usual.effective_mpa * speed_rpm * cylinders)
            bore = round((4 * swept / math.pi / usual.stroke_bore) ** (1 / 3), 1)
            stroke = round(bore * usual.stroke_bore, 1)
    return bore, stroke, speed_rpm


def _no_such_bore(bore: float, power_kw: float | None) -> InputError:
    what = f"получается диаметр цилиндра {number_text(bore)} мм"
    low, high = (number_text(value) for value in BORES_MM)
    where = "--speed" if power_kw is None else "--power"
    hint = f"возможно от {low} до {high} мм: задайте другую мощность, частоту или число цилиндров"
    return InputError(Problem(where, what, hint))


def _engine(cylinders: int, layout: str, strokes: int, name: str) -> dict[str, Any]:
    return {"name": name, "cylinders": cylinders, "layout": layout, "strokes": strokes}


def _named(kind: str, layout: str, cylinders: int, strokes: int) -> str:
    words = "двухтактный" if strokes == 2 else "четырёхтактный"
    # The kind that burns petrol burns gas and ethanol as well: the spark is what they share.
    noun = "Дизель" if kind == "diesel" else "Двигатель с искровым зажиганием"
    return f"{noun}: {LAYOUTS[layout]}, {words}, цилиндров {cylinders}"


def rods_of(layout: str) -> int:
    """Rods side by side on a pin: two of a V engine share one."""
    return 2 if layout == "v" else 1


def throws_of(cylinders: int, layout: str) -> int:
    """Number of throws."""
    return cylinders // rods_of(layout)


def usual_shaft(layout: str, kind: str, bore: float, throws: int) -> ShaftSizes:
    """Journals and webs over the bore."""
    ratios = SHAFTS[layout, kind]
    pin, main = round(ratios.pin * bore, 1), round(ratios.main * bore, 1)
    length = round(ratios.main_length * main, 1)
    notes = {
        "crankshaft.pin_diameter_mm": f"обычно {number_text(ratios.pin)} D",
        "crankshaft.pin_length_mm": f"обычно {number_text(ratios.pin_length)} d"
        + (" под двумя шатунами" if rods_of(layout) == 2 else ""),
        "crankshaft.main_diameter_mm": f"обычно {number_text(ratios.main)} D",
        "crankshaft.main_lengths_mm": f"обычно {number_text(ratios.main_length)} d",
        "crankshaft.arms.left_web_mm": f"обычно {number_text(ratios.web)} D",
    }
    return ShaftSizes(
        pin, round(ratios.pin_length * pin, 1), main, (length,) * (throws + 1),
        round(ratios.web * bore, 1), notes,
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class ThrowMasses:
    """Masses of a throw [kg] by table 4, and what a counterweight of a web takes."""

    pin: float
    web: float
    counterweight: float
    notes: Notes


def table_masses(
    layout: str, kind: str, bore: float, stroke: float, share: float = ROD_SHARE
) -> tuple[dict[str, Any], ThrowMasses]:
    """Section [masses] and the masses of a throw by table 4 of the textbook."""
    size = Sizes(bore, stroke / 2, stroke)
    area = size.piston_area * size.heavier
    near = area_masses(Estimate(fuel="diesel" if kind == "diesel" else "petrol"),
                       bore / 1000, stroke / 1000)  # fmt: skip
    rods = rods_of(layout)
    pin = near.throw * PIN_SHARE * (_SHARED_PIN if rods == 2 else 1.0)
    web = near.throw * (1 - PIN_SHARE) / 2
    rotating = pin + 2 * web + rods * (1 - share) * near.rod
    taken = rotating * SHAFTS[layout, kind].counterweights
    larger = f" × {number_text(round(size.heavier, 2))} для такого D" if size.heavier > 1 else ""
    piston, rod, throw = (
        f"таблица 4: {span_text(low, high)} кг/м², принято {value:.0f}{larger}"
        for (low, high), value in (
            (PISTON["aluminium", kind], near.piston),
            (ROD[kind], near.rod),
            (THROW["steel", kind], near.throw),
        )
    )
    notes = {
        "masses.piston_group_kg": piston,
        "masses.rod_kg": rod,
        "masses.rod_small_end_share": "обычная",
        "crankshaft.pin_mass_kg": f"колено: {throw}"
        + ("; шейка длиннее: под двумя шатунами" if rods == 2 else ""),
        "crankshaft.webs.counterweight_kg": "берёт вращающиеся массы колена: "
        f"{SHAFTS[layout, kind].counterweights:.0%}".replace("%", " %"),
    }
    masses = {
        "piston_group_kg": _inside(near.piston * area, PISTON["aluminium", kind], near.piston),
        "rod_kg": _inside(near.rod * area, ROD[kind], near.rod),
        "rod_small_end_share": share,
    }
    throw_span = THROW["steel", kind]
    return masses, ThrowMasses(
        _inside(pin * area, throw_span, near.throw),
        _inside(web * area, throw_span, near.throw),
        _grams(taken * area / 2),
        notes,
    )


def _inside(value: float, bounds: tuple[float, float], taken: float) -> float:
    """A mass to four digits, rounded away from the nearer bound of the value ``taken``."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 3)
    up = taken < sum(bounds) / 2
    # What has four digits already is noise away from a whole number of units.
    steps = round(value / unit, 6)
    return _grams((math.ceil if up else math.floor)(steps) * unit)


def _grams(value: float) -> float:
    """A mass to four significant digits."""
    return float(f"{value:.4g}")


def shaft(layout: str, timing: Phases, sizes: ShaftSizes, masses: ThrowMasses) -> dict[str, Any]:
    """Section [crankshaft]: phases, journals, two webs and the arms of every throw."""
    made: dict[str, Any] = {}
    if timing.bank_deg is not None and layout == "v":
        made["bank_angle_deg"] = timing.bank_deg
    if timing.order:
        made["firing_order"] = timing.order
    else:
        made["firing_offsets_deg"] = list(timing.offsets)
    made |= {
        "throw_angles_deg": list(timing.angles),
        "pin_diameter_mm": sizes.pin,
        "pin_length_mm": sizes.pin_length,
        "main_diameter_mm": sizes.main,
        "main_lengths_mm": list(sizes.main_lengths),
        "pin_mass_kg": masses.pin,
    }
    webs = {"mass_kg": masses.web, "counterweight_kg": masses.counterweight}
    throws = len(timing.angles)
    made["webs"] = [dict(webs) for _ in range(2 * throws)]
    made["arms"] = [_arms(layout, sizes, number) for number in range(throws)]
    return made


def _arms(layout: str, sizes: ShaftSizes, number: int) -> dict[str, float]:
    """Figure 35: half a main journal, half the pin under a rod, and so to the other side."""
    half = round(sizes.pin_length / rods_of(layout) / 2, 6)
    left, right = (round(sizes.main_lengths[number + side] / 2, 6) for side in (0, 1))
    between = {"l3_mm": half, "l4_mm": half} if layout == "v" else {}
    return {
        "l1_mm": left, "l2_mm": half, **between, "l5_mm": half, "l6_mm": right,
        "left_web_mm": sizes.web, "right_web_mm": sizes.web,
    }  # fmt: skip


def timing_notes(timing: Phases) -> Notes:
    """What the file says of the phases."""
    bank = "угол из обычных для такого числа цилиндров; впишите свой вместе с фазами"
    memory = "по памяти: сверьте со своим"
    return {
        "crankshaft.bank_angle_deg": bank,
        "crankshaft.firing_order": f"обычный для такого двигателя, {memory}",
        "crankshaft.firing_offsets_deg": f"порядок работы {timing.sequence}, {memory}",
        "crankshaft.throw_angles_deg": "следуют из порядка работы",
        "crankshaft.arms.l1_mm": "половина коренной шейки",
        "crankshaft.arms.l2_mm": "половина шейки под шатуном",
    }
