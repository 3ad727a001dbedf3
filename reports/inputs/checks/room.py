"""Whether journals fit between the webs and cylinders beside each other, by the arms."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import accumulate, combinations

from kshm.engine.arrangement import pin_counts, rods_beside
from kshm.engine.crankshaft import places
from reports.inputs.checks.accepted import Keys, apart
from reports.inputs.findings import Finding, Path
from reports.inputs.firing import arrangement_of
from reports.inputs.sections.input_file import InputFile
from reports.inputs.units import number_text

# Fillets and rounded sizes of real shafts make main journals up to 13 % longer than the arms
# leave; a crankpin stands between two webs.
_MOST_OVER, _MOST_OVER_PIN = 1.25, 1.02
# A pin's length that is told of one rod: the arms leave the rest of the rods their room, and
# what a rod would have of it over the diameter is less than a shaft has.
_ROOM_OF_OTHERS, _LEAST_SHARE = 0.8, 0.35
_SAME_AXIS = 1e-6  # [rad]
Fitted = tuple[Path, float, float]  # place in the file, length, room for it [mm]


def check_room(model: InputFile, accepted: Keys) -> Iterator[Finding]:
    """Yield where a length and the arms of the throws contradict each other; a pin is refused."""
    parts = max(pin_counts(arrangement_of(model)))
    yield from _tight(_mains(model), "l1, l6", _MOST_OVER, accepted=accepted)
    pins = ((path, length, room / parts) for path, length, room, _ in _pins(model))
    yield from _tight(pins, "l2…l5", _MOST_OVER_PIN, "половина шейки" if parts > 1 else "шейка")


def _tight(
    entries: Iterator[Fitted],
    arms: str,
    most: float,
    noun: str = "шейка",
    *,
    accepted: Keys | None = None,
) -> Iterator[Finding]:
    """A finding for what is too long, a warning where it may be accepted."""
    tight = [entry for entry in entries if entry[1] > most * entry[2]]
    for (path, length, room), *others in apart(tight, accepted or frozenset()):
        what = (
            f"{noun} длиной {number_text(round(length, 2))} мм не помещается в колено: "
            f"по плечам {arms} для неё {number_text(round(room, 2))} мм"
        )
        alike = f"; в списке таких ещё {len(others)}" if others else ""
        hint = "проверьте длину шейки и плечи колена"
        yield Finding(path, what + alike, hint, warning=accepted is not None)


def check_one_rod(model: InputFile, accepted: Keys) -> Iterator[Finding]:
    """Yield a warning where the length of a pin with several rods looks like that under one."""
    rods = rods_beside(arrangement_of(model), 0)
    short = [
        entry
        for entry in _pins(model)
        if rods > 1
        and entry[2] >= _ROOM_OF_OTHERS * rods * entry[1]
        and entry[1] / rods < _LEAST_SHARE * entry[3]
    ]
    for (path, length, room, diameter), *_ in apart(short, accepted):
        share = length / rods
        what = (
            f"шатунов на шейке рядом {rods}, и каждому достаётся {number_text(round(share, 2))} мм "
            f"её длины ({number_text(round(share / diameter, 2))} d), а плечи l2…l5 оставляют "
            f"шейке {number_text(round(room, 2))} мм"
        )
        hint = "нужна длина всей шейки: если задана под одним шатуном, впишите "
        yield Finding(path, what, hint + number_text(round(rods * length, 6)), warning=True)


def check_neighbours(model: InputFile, bore_mm: float) -> Iterator[Finding]:
    """Yield a warning where cylinders of one row stand nearer to each other than their bore."""
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
        (abs(place - other_place), number, other)
        for (number, axis, place), (other, other_axis, other_place) in combinations(cylinders, 2)
        if abs(math.remainder(axis - other_axis, math.tau)) < _SAME_AXIS
    ]
    between, number, other = min(beside, default=(math.inf, 0, 0))
    if between < bore_mm:
        what = (
            f"цилиндры {number} и {other} перекрываются: между их осями по плечам колен "
            f"{number_text(round(between, 2))} мм, а диаметр цилиндра "
            f"{number_text(round(bore_mm, 2))} мм"
        )
        hint = "проверьте плечи колен и диаметр цилиндра"
        yield Finding(("crankshaft", "arms"), what, hint, warning=True)


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
        own = shaft.pin_diameters_mm
        diameter = own[index] if own else shaft.pin_diameter_mm or 0.0
        if shaft.pin_lengths_mm:
            path: Path = ("crankshaft", "pin_lengths_mm", index)
            yield path, shaft.pin_lengths_mm[index], room, diameter
        elif shaft.pin_length_mm is not None:
            yield ("crankshaft", "pin_length_mm"), shaft.pin_length_mm, room, diameter
