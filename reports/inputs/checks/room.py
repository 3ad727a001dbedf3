"""Whether journals fit between the webs and cylinders beside each other, by the arms."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import accumulate, combinations

from kshm.engine.crankshaft import places
from reports.inputs.findings import Finding, Path
from reports.inputs.firing import arrangement_of
from reports.inputs.sections.input_file import InputFile
from reports.inputs.units import number_text

# Fillets and rounded sizes of real shafts make journals up to 13 % longer than the arms leave.
_MOST_OVER = 1.25
_SAME_AXIS = 1e-6  # [rad]
Fitted = tuple[Path, float, float]  # place in the file, length, room for it [mm]


def check_room(model: InputFile) -> Iterator[Finding]:
    """Yield a warning where a length and the arms of the throws contradict each other."""
    for entries, arms in ((_mains(model), "l1, l6"), (_pins(model), "l2…l5")):
        tight = [entry for entry in entries if entry[1] > _MOST_OVER * entry[2]]
        if tight:
            (path, length, room), more = tight[0], len(tight) - 1
            what = (
                f"шейка длиной {number_text(round(length, 2))} мм не помещается в колено: "
                f"по плечам {arms} для неё {number_text(round(room, 2))} мм"
            )
            alike = f"; в списке таких ещё {more}" if more else ""
            yield Finding(path, what + alike, "проверьте длину шейки и плечи колена", warning=True)


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


def _pins(model: InputFile) -> Iterator[Fitted]:
    shaft = model.crankshaft
    for index, arm in enumerate(shaft.arms):
        room = arm.l2_mm + arm.l3_mm + arm.l4_mm + arm.l5_mm
        if shaft.pin_lengths_mm:
            yield ("crankshaft", "pin_lengths_mm", index), shaft.pin_lengths_mm[index], room
        elif shaft.pin_length_mm is not None:
            yield ("crankshaft", "pin_length_mm"), shaft.pin_length_mm, room
