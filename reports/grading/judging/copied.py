"""By which numbers a student's own cells are known to repeat the input data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isclose, nan

from reports.grading.judging.trials import Trial
from reports.inputs.fields import Field
from reports.inputs.units import MPA

_METRES = 1e-3
# In what else a student may write the input data down: cm, g, kPa, bar, Pa, thousands of turns and
# turns a second, W.
_OTHER_UNITS = {
    "мм": (_METRES, 0.1),
    "кг": (1e3,),
    MPA.label: (1e3, 10.0, MPA.times),
    "мин⁻¹": (1e-3, 1 / 60),
    "кВт": (1e3,),
}


def known_numbers(
    fields: Mapping[str, Field], trials: Sequence[Trial]
) -> dict[float, tuple[str, float]]:
    """Number → the input that it is, and how many of its units one of the book's has."""
    wanted: dict[float, tuple[str, float]] = {}
    drawn = trials[0].inputs if trials else {}
    names = sorted({name for trial in trials for name in trial.inputs})
    for own in (False, True):  # a number is rather an input in the unit of the book
        for name in sorted(names, key=lambda name: name in drawn):  # and one of the variant
            value, unit = float(fields[name].value), fields[name].unit
            for factor in (1.0,) if own else _OTHER_UNITS.get(unit, ()):
                number = float(f"{value * factor:.12g}")
                sure = (unit, factor) == ("мм", _METRES) or (own and (bool(unit) or name in drawn))
                if sure or number != float(f"{number:.1g}"):
                    wanted[number] = (name, factor)  # 1 or 100 may be anything
    return wanted


def stepping(cells: Mapping[tuple[str, int, int], float]) -> set[tuple[str, int, int]]:
    """Cells of numbers that go down by equal steps: one of many angles is no bore of 90 mm."""
    found = set()
    for sheet, column, row in cells:
        three = [(sheet, column, row + i) for i in range(3)]
        first, second, third = (cells.get(cell, nan) for cell in three)
        if first != second and isclose(third - second, second - first, rel_tol=1e-9):
            found.update(three)
    return found
