"""Checks of layout, phases and lists of the crankshaft, and clearances between its parts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import accumulate, combinations

from kshm.engine.arrangement import (
    MAX_GAP,
    Arrangement,
    firing_gap,
    pin_counts,
    rods_beside,
    side_reach,
    throw_angle,
)
from kshm.engine.crankshaft import places
from kshm.ranges import RANGES
from reports.inputs.checks.bands import OFFSET
from reports.inputs.fields import Path
from reports.inputs.findings import Finding, Keys, ValidValues, in_lines, radius_and_rod
from reports.inputs.firing import OPPOSED_BANK_DEG, arrangement, arrangement_of, fitting_angle
from reports.inputs.sections.input_file import InputFile
from reports.inputs.units import number_text

ANGLE_TOLERANCE_DEG = 0.01
# Fillets and rounded sizes of real shafts make main journals up to 13 % longer than the arms
# leave; a crankpin stands between two webs.
_MAX_OVER, _MAX_OVER_PIN = 1.25, 1.02
# A pin's length that is told of one rod: the arms leave the rest of the rods their room, and
# what a rod would have of it over the diameter is less than a shaft has.
_ROOM_OF_OTHERS, _MIN_SHARE = 0.8, RANGES["pin_length"].of()[0]
_MAX_OFFSET = RANGES["offset"].doubtful[""][1]
_SAME_AXIS = 1e-6  # [rad]
Fitted = tuple[Path, float, float]  # place in the file, length, room for it [mm]


def check_layout(values: ValidValues) -> Iterator[Finding]:
    """Yield contradictions in the arrangement of the engine."""
    yield from _banks(values)
    yield from _counts(values)
    yield from _sizes(values)
    yield from _phases(values)
    yield from _offset(values)
    yield from _articulated(values)


def arrangement_given(values: ValidValues) -> Arrangement | None:
    """Arrangement of the cylinders as far as the file gives it."""
    cylinders, layout = values.get("engine", "cylinders"), values.get("engine", "layout")
    if cylinders is None or layout is None:
        return None
    return arrangement(
        layout,
        cylinders,
        values.get("crankshaft", "bank_angle_deg"),
        values.get("crankshaft", "split_pin_deg"),
        articulated="articulated" in values.sections,
    )


def _banks(values: ValidValues) -> Iterator[Finding]:
    cylinders, layout = values.get("engine", "cylinders"), values.get("engine", "layout")
    bank = values.get("crankshaft", "bank_angle_deg")
    split = values.get("crankshaft", "split_pin_deg")
    if layout is None:
        return
    if layout != "inline" and cylinders is not None and cylinders % 2:
        problem = f"число цилиндров {cylinders} нечётное, а рядов два"
        yield Finding(
            ("engine", "cylinders"), problem, 'задайте чётное число или layout = "inline"'
        )
    if layout == "v" and bank is None and values.sure("crankshaft", "bank_angle_deg"):
        problem = "угол развала не задан"
        yield Finding(("crankshaft", "bank_angle_deg"), problem, "V-образному двигателю он нужен")
    if layout == "inline":
        for key, value in (("bank_angle_deg", bank), ("split_pin_deg", split)):
            if value is not None:
                problem = "у рядного двигателя один ряд цилиндров"
                yield Finding(("crankshaft", key), problem, 'удалите ключ или задайте layout = "v"')
    if layout == "opposed":
        if bank is not None and bank != OPPOSED_BANK_DEG:
            problem = f"угол развала {number_text(bank)}°, а у оппозитного двигателя он 180°"
            hint = 'удалите ключ или задайте layout = "v"'
            yield Finding(("crankshaft", "bank_angle_deg"), problem, hint)
        if split is not None:
            problem = "у оппозитного двигателя на каждой шейке один шатун"
            yield Finding(
                ("crankshaft", "split_pin_deg"), problem, 'удалите ключ: он для layout = "v"'
            )


def _counts(values: ValidValues) -> Iterator[Finding]:
    cylinders, layout = values.get("engine", "cylinders"), values.get("engine", "layout")
    if cylinders is None or (layout != "inline" and cylinders % 2):
        return
    throws = cylinders // 2 if layout == "v" else cylinders
    required = {
        "firing_offsets_deg": (cylinders, "по одному на цилиндр"),
        "throw_angles_deg": (throws, "по одному на колено"),
        "pin_diameters_mm": (throws, "по одному на колено"),
        "pin_lengths_mm": (throws, "по одной на колено"),
        "main_diameters_mm": (throws + 1, "на один больше, чем колен"),
        "main_lengths_mm": (throws + 1, "на одну шейку больше, чем колен"),
        "force_offsets_deg": (throws, "по одному на колено"),
        "webs": (2 * throws, "по две щеки на колено"),
        "arms": (throws, "по одной записи на колено"),
    }
    for key, (count, rule) in required.items():
        written = values.counts.get(("crankshaft", key))
        if written is not None and written != count:
            problem = f"записей {written}, а нужно {count}"
            knees = f", колен {throws}" if throws != cylinders else ""
            hint = f"{rule}, цилиндров {cylinders}{knees}"
            yield Finding(("crankshaft", key), problem, hint)


def _sizes(values: ValidValues) -> Iterator[Finding]:
    """Journal sizes: one for all or a list, exactly one of both."""
    for each in ("pin_diameters_mm", "pin_lengths_mm", "main_diameters_mm"):
        one = each.replace("s_mm", "_mm")
        if not values.sure("crankshaft", one, each):
            continue
        stated = [key for key in (one, each) if values.get("crankshaft", key) is not None]
        if len(stated) == 2:
            problem = f"размер задан дважды: {one} и {each}"
            yield Finding(("crankshaft", each), problem, "оставьте один ключ")
        elif not stated:
            problem = "обязательный ключ не задан"
            hint = f"один размер для всех шеек, или список {each}, если они разные"
            yield Finding(("crankshaft", one), problem, hint)


def _phases(values: ValidValues) -> Iterator[Finding]:
    offsets = values.get("crankshaft", "firing_offsets_deg")
    angles = values.get("crankshaft", "throw_angles_deg")
    for key, listed in (("firing_offsets_deg", offsets), ("throw_angles_deg", angles)):
        if listed and listed[0] != 0:
            problem = f"первое значение {number_text(listed[0])}°, а нужно 0"
            yield Finding(("crankshaft", key, 0), problem, "углы отсчитываются от первого цилиндра")
    if values.get("crankshaft", "force_offsets_deg") is not None:
        yield from _forced(values)
    strokes = values.get("engine", "strokes")
    for index, offset in enumerate(offsets or ()):
        if strokes == 2 and offset >= 360:
            problem = (
                f"начало рабочего хода {number_text(offset)}° вне цикла двухтактного двигателя"
            )
            yield Finding(("crankshaft", "firing_offsets_deg", index), problem, "допустимо до 360°")
        first = offsets.index(offset) if strokes == 4 else index
        if first < index:
            problem = (
                f"начало рабочего хода то же, что у цилиндра {first + 1}: {number_text(offset)}°"
            )
            hint = "проверьте порядок работы: обычно цилиндры работают по очереди"
            yield Finding(("crankshaft", "firing_offsets_deg", index), problem, hint, warning=True)
    placement = arrangement_given(values)
    if offsets and strokes:
        yield from _unfilled(offsets, 180.0 * strokes)
    if not offsets or not angles or placement is None or len(offsets) != len(placement):
        return
    if len(angles) != 1 + max(cylinder.throw for cylinder in placement):
        return
    for index, (cylinder, offset) in enumerate(zip(placement, offsets, strict=True)):
        finding = _phase(placement, index, float(offset), float(angles[cylinder.throw]))
        if finding is not None:
            yield finding
            if cylinder.axis or cylinder.pin_angle:
                return  # a wrong bank angle is one mistake for the whole bank


def _unfilled(offsets: Sequence[float], period: float) -> Iterator[Finding]:
    """Yield a finding where the firings leave much of the cycle without one."""
    gap, mean = firing_gap(offsets, period)
    if gap > MAX_GAP * mean and max(offsets) < period:
        problem = (
            f"вспышки не заполняют цикл: наибольший промежуток {number_text(gap)}°, "
            f"средний {number_text(round(mean, 6))}°"
        )
        hint = "проверьте начала рабочих ходов"
        yield Finding(("crankshaft", "firing_offsets_deg"), problem, hint, warning=True)


def _phase(placement: Arrangement, index: int, offset: float, angle: float) -> Finding | None:
    """Return the finding where a throw contradicts its cylinder's firing offset."""
    fitting = math.degrees(throw_angle(placement[index], math.radians(offset)))
    if index == 0 or abs(math.remainder(angle - fitting, 360.0)) <= ANGLE_TOLERANCE_DEG:
        return None
    problem = (
        f"угол колена {number_text(angle)}° не соответствует началу рабочего хода "
        f"{number_text(offset)}° (firing_offsets_deg[{index + 1}])"
    )
    rule = "γ = −θ"
    axis, pin = math.degrees(placement[index].axis), math.degrees(placement[index].pin_angle)
    if axis or pin:
        rule = f"γ = {number_text(round(axis, 6))}° − θ"
        rule += f" − δ, δ = {number_text(round(pin, 6))}°," if pin else ""
    hint = f"по {rule} (mod 360) нужно {fitting_angle(fitting)}°"
    return Finding(("crankshaft", "throw_angles_deg", placement[index].throw), problem, hint)


def _forced(values: ValidValues) -> Iterator[Finding]:
    path = ("crankshaft", "force_offsets_deg")
    if values.get("engine", "layout") not in ("inline", None):
        problem = "особые фазы сил возможны только у рядного двигателя"
        yield Finding(path, problem, "удалите ключ")
        return
    problem = "фазы сил заданы отдельно и могут противоречить валу"
    hint = "ключ нужен только для воспроизведения таблицы П4.3"
    yield Finding(path, problem, hint, warning=True)


def offset_of(values: ValidValues) -> tuple[str, float] | None:
    """Return the key to name and the whole offset e [mm], if one is given."""
    stated = {
        key: values.get("geometry", key)
        for key in ("crank_offset_mm", "pin_offset_mm")
        if values.get("geometry", key) is not None
    }
    if not stated:
        return None
    return next(iter(stated)), float(sum(stated.values()))


def _offset(values: ValidValues) -> Iterator[Finding]:
    keyed, pair = offset_of(values), radius_and_rod(values)
    if keyed is None or pair is None:
        return
    key, offset = keyed
    radius, rod = pair
    path = ("geometry", key)
    if radius < rod <= radius + abs(offset):
        problem = (
            f"смещение {number_text(offset)} мм не меньше L − r = "
            f"{number_text(round(rod - radius, 6))} мм: механизм не провернётся"
        )
        yield Finding(path, problem, "уменьшите смещение или удлините шатун")
        return
    if offset and values.get("geometry", "stroke_mm") is not None:
        way = math.sqrt((rod + radius) ** 2 - offset**2) - math.sqrt(
            (rod - radius) ** 2 - offset**2
        )
        problem = (
            f"при смещении stroke_mm понимается как 2r, действительный ход поршня "
            f"{number_text(round(way, 3))} мм"
        )
        hint = "задайте радиус кривошипа crank_radius_mm"
        yield Finding(("geometry", "stroke_mm"), problem, hint, warning=True)
    if abs(offset) > _MAX_OFFSET * radius:
        problem = (
            f"относительное смещение k = e/r = {number_text(round(offset / radius, 4))} необычно"
        )
        yield Finding(path, problem, OFFSET.usual, warning=True)


def _articulated(values: ValidValues) -> Iterator[Finding]:
    if "articulated" not in values.sections:
        return
    if values.get("engine", "layout") not in ("v", None):
        problem = "прицепные шатуны бывают только у V-образного двигателя"
        yield Finding(("articulated",), problem, 'удалите раздел или задайте layout = "v"')
        return
    if values.get("crankshaft", "split_pin_deg") is not None:
        problem = "прицепной шатун висит на главном, а не на шейке"
        yield Finding(
            ("crankshaft", "split_pin_deg"), problem, "удалите ключ или раздел [articulated]"
        )
    pair, bank = radius_and_rod(values), values.get("crankshaft", "bank_angle_deg")
    sizes = [values.get("articulated", key) for key in ("rod_length_mm", "radius_mm", "angle_deg")]
    if pair is None or bank is None or None in sizes or pair[0] >= pair[1]:
        return
    length, radius, angle = (float(value) for value in sizes)
    keyed = offset_of(values)
    offset = keyed[1] if keyed else 0.0
    if pair[1] <= pair[0] + abs(offset):
        return
    if radius >= pair[1]:
        return
    reach = side_reach(*pair, offset, radius, math.radians(angle), math.radians(bank))
    if reach >= length:
        problem = (
            f"прицепной шатун {number_text(length)} мм не достаёт до оси своего цилиндра: "
            f"его палец отходит от неё на {number_text(round(reach, 2))} мм"
        )
        hint = "удлините шатун или поставьте палец ближе к углу развала"
        yield Finding(("articulated", "rod_length_mm"), problem, hint)


def check_room(model: InputFile, accepted: Keys) -> Iterator[Finding]:
    """Yield journals and pins longer than the arms of their throws allow."""
    parts = max(pin_counts(arrangement_of(model)))
    yield from _tight(_mains(model), "l1, l6", _MAX_OVER, accepted=accepted)
    pins = ((path, length, room / parts) for path, length, room, _ in _pins(model))
    yield from _tight(pins, "l2…l5", _MAX_OVER_PIN, "половина шейки" if parts > 1 else "шейка")


def _tight(
    entries: Iterator[Fitted],
    arms: str,
    most: float,
    noun: str = "шейка",
    *,
    accepted: Keys | None = None,
) -> Iterator[Finding]:
    """Error for an excessive length, a warning where it may be accepted."""
    tight = [entry for entry in entries if entry[1] > most * entry[2]]
    for (path, length, room), *others in in_lines(tight, accepted or frozenset()):
        problem = (
            f"{noun} длиной {number_text(round(length, 2))} мм не помещается в колено: "
            f"по плечам {arms} для неё {number_text(round(room, 2))} мм"
        )
        alike = f"; в списке таких ещё {len(others)}" if others else ""
        hint = "проверьте длину шейки и плечи колена"
        yield Finding(path, problem + alike, hint, warning=accepted is not None)


def check_one_rod(model: InputFile, accepted: Keys) -> Iterator[Finding]:
    """Yield a warning where a shared pin's length looks like that under one rod."""
    rods = rods_beside(arrangement_of(model), 0)
    short = [
        entry
        for entry in _pins(model)
        if rods > 1
        and entry[2] >= _ROOM_OF_OTHERS * rods * entry[1]
        and entry[1] / rods < _MIN_SHARE * entry[3]
    ]
    for (path, length, room, diameter), *_ in in_lines(short, accepted):
        share = length / rods
        problem = (
            f"шатунов на шейке рядом {rods}, и каждому достаётся {number_text(round(share, 2))} мм "
            f"её длины ({number_text(round(share / diameter, 2))} d), а плечи l2…l5 оставляют "
            f"шейке {number_text(round(room, 2))} мм"
        )
        hint = "нужна длина всей шейки: если задана под одним шатуном, впишите "
        yield Finding(path, problem, hint + number_text(round(rods * length, 6)), warning=True)


def check_neighbours(model: InputFile, bore_mm: float) -> Iterator[Finding]:
    """Yield a warning where cylinders of one row stand nearer than their bore."""
    shaft = model.crankshaft
    throws = [
        places(
            (arm.l1_mm, arm.l2_mm, arm.l3_mm, arm.l4_mm, arm.l5_mm, arm.l6_mm),
            arm.left_web_mm,
            arm.right_web_mm,
        )
        for arm in shaft.arms
    ]
    starts = [0.0, *accumulate(throw.length for throw in throws)]
    cylinders = [
        (number, one.axis, starts[one.throw] + throws[one.throw].rod_at(one.rod_place))
        for number, one in enumerate(arrangement_of(model), start=1)
    ]
    beside = [
        (abs(along - other_place), number, other)
        for (number, axis, along), (other, other_axis, other_place) in combinations(cylinders, 2)
        if abs(math.remainder(axis - other_axis, math.tau)) < _SAME_AXIS
    ]
    between, number, other = min(beside, default=(math.inf, 0, 0))
    if between < bore_mm:
        problem = (
            f"цилиндры {number} и {other} перекрываются: между их осями по плечам колен "
            f"{number_text(round(between, 2))} мм, а диаметр цилиндра "
            f"{number_text(round(bore_mm, 2))} мм"
        )
        hint = "проверьте плечи колен и диаметр цилиндра"
        yield Finding(("crankshaft", "arms"), problem, hint, warning=True)


def _mains(model: InputFile) -> Iterator[Fitted]:
    shaft = model.crankshaft
    lefts = [arm.l6_mm for arm in shaft.arms]
    rights = [arm.l1_mm for arm in shaft.arms]
    # Of an end journal only the half within the shaft is in the arms.
    halves = zip([rights[0], *lefts], [*rights, lefts[-1]], strict=True)
    for index, (length, (left, right)) in enumerate(
        zip(shaft.main_lengths_mm, halves, strict=True)
    ):
        yield ("crankshaft", "main_lengths_mm", index), length, left + right


def _pins(model: InputFile) -> Iterator[tuple[Path, float, float, float]]:
    """Place in the file, length, room between the webs and diameter of every pin [mm]."""
    shaft = model.crankshaft
    for index, arm in enumerate(shaft.arms):
        room = arm.l2_mm + arm.l3_mm + arm.l4_mm + arm.l5_mm
        diameters = shaft.pin_diameters_mm
        diameter = diameters[index] if diameters else shaft.pin_diameter_mm or 0.0
        if shaft.pin_lengths_mm:
            path: Path = ("crankshaft", "pin_lengths_mm", index)
            yield path, shaft.pin_lengths_mm[index], room, diameter
        elif shaft.pin_length_mm is not None:
            yield ("crankshaft", "pin_length_mm"), shaft.pin_length_mm, room, diameter
