"""Counterweights of a new engine: a sector on every web, chosen by the loads of the journals."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from kshm.results.solution import solve
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import to_engine
from reports.inputs.units import number_text

_GOAL = "loads"
_MIN_SHARE = 0.15  # of a throw's rotating masses: less is not worth a part
_SIZES = {
    "skirt_mm": "вырезы юбки под противовес",
    "inner_mm": "радиус коренной шейки",
    "outer_mm": "проходит под поршнем в НМТ",
    "width_mm": "толщина щеки",
}


@dataclass(frozen=True, slots=True)
class NewCounterweights:
    """The section, the mass of a web at the crank radius [kg], notes by «section.key»."""

    section: dict[str, Any]
    reduced_kg: float
    notes: dict[str, str]


def counterweights_for(data: Mapping[str, Any]) -> NewCounterweights:
    """Counterweights for an engine as a mapping of the file.

    Raises:
        InputError: there is no such engine.
    """
    model = load_mapping({**data, "counterweight": {"goal": _GOAL}}, source="kshm new").model
    sizes = solve(to_engine(model)).scalars
    rounded = {key: math.floor(10 * sizes[f"cw_{key}"] + 1e-6) / 10 for key in _SIZES}
    section = {"goal": _GOAL, **rounded}
    model = load_mapping({**data, "counterweight": section}, source="kshm new").model
    scalars = solve(to_engine(model)).scalars
    share = number_text(round(scalars["cw_taken"], 2))
    limited = scalars["cw_taken"] < scalars["cw_best"]
    why = "больше сектор не берёт" if limited else "с ней сумма нагрузок коренных шеек наименьшая"
    notes = {f"counterweight.{key}": text for key, text in _SIZES.items()}
    words, reduced = f"доля {share} вращающихся масс колена: {why}", scalars["cw_reduced"]
    if scalars["cw_taken"] < _MIN_SHARE:
        words, reduced = f"нет: {words}", 0.0
    notes["crankshaft.webs.counterweight_kg"] = words
    return NewCounterweights(section, float(f"{reduced:.4g}"), notes)
