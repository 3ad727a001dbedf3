"""Checks of the layout: banks, throws, phases, offset, articulated rods."""

from __future__ import annotations

import math
from collections.abc import Iterator

from kshm.engine.arrangement import Arrangement, side_reach, throw_angle
from reports.inputs.findings import Finding, Values, radius_and_rod
from reports.inputs.firing import OPPOSED_BANK_DEG, arrangement, fitting_angle
from reports.inputs.units import number_text, span_text

ANGLE_TOLERANCE_DEG = 0.01
USUAL_OFFSET = 0.25  # k = e/r; the book names 0.05…0.20


def check_layout(values: Values) -> Iterator[Finding]:
    """Yield what contradicts itself in the arrangement of the engine."""
    yield from _banks(values)
    yield from _counts(values)
    yield from _sizes(values)
    yield from _phases(values)
    yield from _offset(values)
    yield from _articulated(values)


def arrangement_given(values: Values) -> Arrangement | None:
    """Return the places of the cylinders as far as the file gives them."""
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


def _banks(values: Values) -> Iterator[Finding]:
    cylinders, layout = values.get("engine", "cylinders"), values.get("engine", "layout")
    bank = values.get("crankshaft", "bank_angle_deg")
    split = values.get("crankshaft", "split_pin_deg")
    if layout is None:
        return
    if layout != "inline" and cylinders is not None and cylinders % 2:
        what = f"число цилиндров {cylinders} нечётное, а рядов два"
        yield Finding(("engine", "cylinders"), what, 'задайте чётное число или layout = "inline"')
    if layout == "v" and bank is None and values.sure("crankshaft", "bank_angle_deg"):
        what = "угол развала не задан"
        yield Finding(("crankshaft", "bank_angle_deg"), what, "V-образному двигателю он нужен")
    if layout == "inline":
        for key, value in (("bank_angle_deg", bank), ("split_pin_deg", split)):
            if value is not None:
                what = "у рядного двигателя один ряд цилиндров"
                yield Finding(("crankshaft", key), what, 'удалите ключ или задайте layout = "v"')
    if layout == "opposed":
        if bank is not None and bank != OPPOSED_BANK_DEG:
            what = f"угол развала {number_text(bank)}°, а у оппозитного двигателя он 180°"
            hint = 'удалите ключ или задайте layout = "v"'
            yield Finding(("crankshaft", "bank_angle_deg"), what, hint)
        if split is not None:
            what = "у оппозитного двигателя на каждой шейке один шатун"
            yield Finding(
                ("crankshaft", "split_pin_deg"), what, 'удалите ключ: он для layout = "v"'
            )


def _counts(values: Values) -> Iterator[Finding]:
    cylinders, layout = values.get("engine", "cylinders"), values.get("engine", "layout")
    if cylinders is None or (layout != "inline" and cylinders % 2):
        return
    throws = cylinders // 2 if layout == "v" else cylinders
    wanted = {
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
    for key, (count, rule) in wanted.items():
        found = values.counts.get(("crankshaft", key))
        if found is not None and found != count:
            what = f"записей {found}, а нужно {count}"
            knees = f", колен {throws}" if throws != cylinders else ""
            hint = f"{rule}, цилиндров {cylinders}{knees}"
            yield Finding(("crankshaft", key), what, hint)


def _sizes(values: Values) -> Iterator[Finding]:
    """Sizes of journals: one for all or a list, not both and not neither."""
    for each in ("pin_diameters_mm", "pin_lengths_mm", "main_diameters_mm"):
        one = each.replace("s_mm", "_mm")
        if not values.sure("crankshaft", one, each):
            continue
        given = [key for key in (one, each) if values.get("crankshaft", key) is not None]
        if len(given) == 2:
            what = f"размер задан дважды: {one} и {each}"
            yield Finding(("crankshaft", each), what, "оставьте один ключ")
        elif not given:
            what = "обязательный ключ не задан"
            hint = f"один размер для всех шеек, или список {each}, если они разные"
            yield Finding(("crankshaft", one), what, hint)


def _phases(values: Values) -> Iterator[Finding]:
    offsets = values.get("crankshaft", "firing_offsets_deg")
    angles = values.get("crankshaft", "throw_angles_deg")
    for key, listed in (("firing_offsets_deg", offsets), ("throw_angles_deg", angles)):
        if listed and listed[0] != 0:
            what = f"первое значение {number_text(listed[0])}°, а нужно 0"
            yield Finding(("crankshaft", key, 0), what, "углы отсчитываются от первого цилиндра")
    if values.get("crankshaft", "force_offsets_deg") is not None:
        yield from _forced(values)
    strokes = values.get("engine", "strokes")
    for index, offset in enumerate(offsets or ()):
        if strokes == 2 and offset >= 360:
            what = f"начало рабочего хода {number_text(offset)}° вне цикла двухтактного двигателя"
            yield Finding(("crankshaft", "firing_offsets_deg", index), what, "допустимо до 360°")
        first = offsets.index(offset) if strokes == 4 else index
        if first < index:
            what = f"начало рабочего хода то же, что у цилиндра {first + 1}: {number_text(offset)}°"
            hint = "проверьте порядок работы: обычно цилиндры работают по очереди"
            yield Finding(("crankshaft", "firing_offsets_deg", index), what, hint, warning=True)
    places = arrangement_given(values)
    if not offsets or not angles or places is None or len(offsets) != len(places):
        return
    if len(angles) != 1 + max(place.throw for place in places):
        return
    for index, (place, offset) in enumerate(zip(places, offsets, strict=True)):
        found = _phase(places, index, float(offset), float(angles[place.throw]))
        if found is not None:
            yield found
            if place.axis or place.pin_angle:
                return  # a wrong bank angle is one mistake for the whole bank


def _phase(places: Arrangement, index: int, offset: float, angle: float) -> Finding | None:
    """What is wrong with the throw under a cylinder, with both numbers."""
    fitting = math.degrees(throw_angle(places[index], math.radians(offset)))
    if index == 0 or abs(math.remainder(angle - fitting, 360.0)) <= ANGLE_TOLERANCE_DEG:
        return None
    what = (
        f"угол колена {number_text(angle)}° не соответствует началу рабочего хода "
        f"{number_text(offset)}° (firing_offsets_deg[{index + 1}])"
    )
    rule = "γ = −θ"
    axis, pin = math.degrees(places[index].axis), math.degrees(places[index].pin_angle)
    if axis or pin:
        rule = f"γ = {number_text(round(axis, 6))}° − θ"
        rule += f" − δ, δ = {number_text(round(pin, 6))}°," if pin else ""
    hint = f"по {rule} (mod 360) нужно {fitting_angle(fitting)}°"
    return Finding(("crankshaft", "throw_angles_deg", places[index].throw), what, hint)


def _forced(values: Values) -> Iterator[Finding]:
    path = ("crankshaft", "force_offsets_deg")
    if values.get("engine", "layout") not in ("inline", None):
        what = "особые фазы сил возможны только у рядного двигателя"
        yield Finding(path, what, "удалите ключ")
        return
    what = "фазы сил заданы отдельно и могут противоречить валу"
    hint = "ключ нужен только для воспроизведения таблицы П4.3"
    yield Finding(path, what, hint, warning=True)


def offset_of(values: Values) -> tuple[str, float] | None:
    """Return the key to name and the whole offset e [mm], if one is given."""
    given = {
        key: values.get("geometry", key)
        for key in ("crank_offset_mm", "pin_offset_mm")
        if values.get("geometry", key) is not None
    }
    if not given:
        return None
    return next(iter(given)), float(sum(given.values()))


def _offset(values: Values) -> Iterator[Finding]:
    found, pair = offset_of(values), radius_and_rod(values)
    if found is None or pair is None:
        return
    key, offset = found
    radius, rod = pair
    path = ("geometry", key)
    if radius < rod <= radius + abs(offset):
        what = (
            f"смещение {number_text(offset)} мм не меньше L − r = "
            f"{number_text(round(rod - radius, 6))} мм: механизм не провернётся"
        )
        yield Finding(path, what, "уменьшите смещение или удлините шатун")
        return
    if offset and values.get("geometry", "stroke_mm") is not None:
        way = math.sqrt((rod + radius) ** 2 - offset**2) - math.sqrt(
            (rod - radius) ** 2 - offset**2
        )
        what = (
            f"при смещении stroke_mm понимается как 2r, действительный ход поршня "
            f"{number_text(round(way, 3))} мм"
        )
        hint = "задайте радиус кривошипа crank_radius_mm"
        yield Finding(("geometry", "stroke_mm"), what, hint, warning=True)
    if abs(offset) > USUAL_OFFSET * radius:
        what = f"относительное смещение k = e/r = {number_text(round(offset / radius, 4))} необычно"
        yield Finding(path, what, f"обычно {span_text(0.05, 0.2)}", warning=True)


def _articulated(values: Values) -> Iterator[Finding]:
    if "articulated" not in values.sections:
        return
    if values.get("engine", "layout") not in ("v", None):
        what = "прицепные шатуны бывают только у V-образного двигателя"
        yield Finding(("articulated",), what, 'удалите раздел или задайте layout = "v"')
        return
    if values.get("crankshaft", "split_pin_deg") is not None:
        what = "прицепной шатун висит на главном, а не на шейке"
        yield Finding(
            ("crankshaft", "split_pin_deg"), what, "удалите ключ или раздел [articulated]"
        )
    pair, bank = radius_and_rod(values), values.get("crankshaft", "bank_angle_deg")
    own = [values.get("articulated", key) for key in ("rod_length_mm", "radius_mm", "angle_deg")]
    if pair is None or bank is None or None in own or pair[0] >= pair[1]:
        return
    length, radius, angle = (float(value) for value in own)
    found = offset_of(values)
    offset = found[1] if found else 0.0
    if pair[1] <= pair[0] + abs(offset):
        return
    if radius >= pair[1]:
        return
    reach = side_reach(*pair, offset, radius, math.radians(angle), math.radians(bank))
    if reach >= length:
        what = (
            f"прицепной шатун {number_text(length)} мм не достаёт до оси своего цилиндра: "
            f"его палец отходит от неё на {number_text(round(reach, 2))} мм"
        )
        hint = "удлините шатун или поставьте палец ближе к углу развала"
        yield Finding(("articulated", "rod_length_mm"), what, hint)
