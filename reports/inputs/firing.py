"""Expand shorthand: a firing order as text, throw angles that follow from it.

`expand` works on the raw mapping, before its sections are checked: afterwards the offsets
and the angles stand in it as if they had been written out.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from kshm.engine.arrangement import Arrangement, fan, in_row, opposed, throw_angle
from reports.inputs.findings import Finding
from reports.inputs.sections.input_file import MAX_CYLINDERS
from reports.inputs.units import number_text

if TYPE_CHECKING:
    from reports.inputs.sections.input_file import EngineSection, InputFile
    from reports.inputs.sections.mechanism import ArticulatedSection, CrankshaftSection

_ORDER = re.compile(r"\d{1,2}(\s*[-–—,]\s*\d{1,2})*")
_PATH = ("crankshaft", "firing_order")
OPPOSED_BANK_DEG = 180.0
FOLLOWING = ("firing_offsets_deg", "throw_angles_deg")  # what an order stands for


def arrangement(
    layout: str,
    cylinders: int,
    bank_angle_deg: float | None = None,
    split_pin_deg: float | None = None,
    *,
    articulated: bool = False,
) -> Arrangement | None:
    """Return the arrangement of the cylinders; None where the data make no engine."""
    if layout == "inline":
        return in_row(cylinders)
    if cylinders % 2 or cylinders < 2:
        return None
    if layout == "opposed":
        return opposed(cylinders)
    if bank_angle_deg is None:
        return None
    split = None if split_pin_deg is None else (0.0, math.radians(split_pin_deg))
    axes = (0.0, math.radians(bank_angle_deg))
    return fan(cylinders // 2, axes, pin_angles=split, articulated=articulated)


def arrangement_of(model: InputFile) -> Arrangement:
    """Return the arrangement of a checked input."""
    return places_of(model.engine, model.crankshaft, model.articulated)


def places_of(
    engine: EngineSection, shaft: CrankshaftSection, articulated: ArticulatedSection | None
) -> Arrangement:
    """Return the arrangement of the sections of a checked input."""
    placement = arrangement(
        engine.layout,
        engine.cylinders,
        shaft.bank_angle_deg,
        shaft.split_pin_deg,
        articulated=articulated is not None,
    )
    if placement is None:
        raise ValueError("the layout has no arrangement")
    return placement


def expand(data: Mapping[str, Any]) -> tuple[dict[str, Any], list[Finding]]:
    """Return the mapping with offsets and throw angles written out, and findings.

    What is of a wrong type is left to the check of its section.
    """
    engine, shaft = data.get("engine"), data.get("crankshaft")
    result, findings = dict(data), list[Finding]()
    if not isinstance(engine, dict) or not isinstance(shaft, dict):
        return result, findings
    cylinders, strokes = engine.get("cylinders"), engine.get("strokes", 4)
    if not isinstance(cylinders, int) or isinstance(cylinders, bool) or strokes not in (2, 4):
        return result, findings
    if not 1 <= cylinders <= MAX_CYLINDERS:  # before anything is laid out for so many
        return result, findings
    shaft = dict(shaft)
    result["crankshaft"] = shaft
    layout = engine.get("layout", "inline")
    if layout == "opposed":
        shaft.setdefault("bank_angle_deg", OPPOSED_BANK_DEG)
    order = shaft.get("firing_order")
    if isinstance(order, str):
        del shaft["firing_order"]
        findings += _write_out(order, cylinders, 180 * strokes, shaft)
    if "throw_angles_deg" not in shaft and not findings:
        placement = _places(data, str(layout), cylinders, shaft)
        offsets: Any = shaft.get("firing_offsets_deg")
        if placement is not None and _numbers(offsets, len(placement)):
            shaft["throw_angles_deg"] = list(throw_angles(placement, offsets))
    return result, findings


def sequence(offsets: Sequence[float]) -> tuple[int, ...]:
    """Return the numbers of the cylinders in the order in which they fire."""
    rows = sorted((offset, i) for i, offset in enumerate(offsets, 1))
    return tuple(i for _, i in rows)


def strokes_at(offsets: Sequence[float], period: float) -> dict[float, tuple[int, ...]]:
    """Cylinders whose power strokes begin at each angle of the cycle [deg], in its order."""
    angles = [round(offset % period, 6) % period for offset in offsets]
    return {
        at: tuple(i for i, angle in enumerate(angles, 1) if angle == at)
        for at in sorted(set(angles))
    }


def order_text(offsets: Sequence[float], period: float) -> str:
    """``1–3–4–2``; cylinders that fire together stand in brackets: ``(1, 2)–(3, 4)``."""
    groups = strokes_at(offsets, period).values()
    return "–".join(
        str(group[0]) if len(group) == 1 else f"({', '.join(map(str, group))})" for group in groups
    )


def _write_out(text: str, cylinders: int, period: float, shaft: dict[str, Any]) -> list[Finding]:
    if not _ORDER.fullmatch(text.strip()):
        problem = "порядок работы записан непонятно"
        return [Finding(_PATH, problem, 'пример записи: "1-3-4-2"')]
    numbers = [int(part) for part in re.findall(r"\d+", text)]
    if sorted(numbers) != list(range(1, cylinders + 1)):
        problem = f"в порядке работы {'-'.join(map(str, numbers))} не все цилиндры по одному разу"
        return [Finding(_PATH, problem, f"назовите каждый цилиндр от 1 до {cylinders} один раз")]
    first = numbers.index(1)
    numbers = numbers[first:] + numbers[:first]
    stated = shaft.get("firing_offsets_deg")
    if stated is None:
        positions = {number: position for position, number in enumerate(numbers)}
        step = period / cylinders
        shaft["firing_offsets_deg"] = [positions[i] * step for i in range(1, cylinders + 1)]
        return []
    if _numbers(stated, cylinders) and list(sequence(stated)) != numbers:
        order = "-".join(map(str, sequence(stated)))
        problem = (
            f"порядок работы {'-'.join(map(str, numbers))} противоречит firing_offsets_deg, "
            f"по которым порядок {order}"
        )
        return [Finding(_PATH, problem, "оставьте один из двух ключей")]
    return []


def _numbers(values: object, count: int) -> bool:
    return (
        isinstance(values, list | tuple)
        and len(values) == count
        and all(isinstance(v, int | float) and math.isfinite(v) for v in values)
    )


def _places(
    data: Mapping[str, Any], layout: str, cylinders: int, shaft: Mapping[str, Any]
) -> Arrangement | None:
    bank, split = shaft.get("bank_angle_deg"), shaft.get("split_pin_deg")
    for value in (bank, split):
        if value is not None and not isinstance(value, int | float):
            return None
    return arrangement(layout, cylinders, bank, split, articulated="articulated" in data)


def throw_angles(placement: Arrangement, offsets: Sequence[float]) -> tuple[float, ...]:
    """Throw angles in 0…360 [deg] that fit the first cylinder on every throw."""
    angles: dict[int, float] = {}
    for cylinder, offset in zip(placement, offsets, strict=True):
        angle = round(math.degrees(throw_angle(cylinder, math.radians(offset))), 6)
        angles.setdefault(cylinder.throw, angle % 360)
    return tuple(angles[throw] for throw in sorted(angles))


def fitting_angle(angle_deg: float) -> str:
    """Return an angle in 0…360 as messages show it."""
    return number_text(round(angle_deg, 6) % 360)
