"""The runs that make our numbers: samples solved, tables looked up by printed labels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from kshm import solve
from kshm.cycle.cycle import Listing, cycle
from kshm.cycle.fuel import FUELS
from kshm.cycle.inputs import Boost, CycleInputs
from kshm.cycle.result import Cycle
from kshm.nomenclature.dizdn_listing import INPUTS
from kshm.results.solution import Solution
from reports.inputs.load import load_toml
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.resources import samples_dir
from reports.validation.checks import Lookup, Ours
from reports.validation.printed import rows_of

DINN_STEP = 3  # degrees of the program's grid


@lru_cache(maxsize=8)
def solution(sample: str, step_deg: int | None = None) -> Solution:
    """A sample solved, on its own or another grid of angles."""
    engine, run = engine_and_cycle(load_toml(samples_dir() / f"{sample}.toml").model)
    if step_deg is not None:
        engine = replace(engine, step_deg=step_deg)
    return solve(engine, run)


def on_grid(label: str, step: float = DINN_STEP) -> float:
    """The point of the program's grid that a rounded row label stands for."""
    return float(np.floor(float(label) / step + 0.5) * step)


def by_angle(
    columns: Mapping[str, Sequence[Any] | np.ndarray[Any, Any]],
    *,
    rename: Mapping[str, str] | None = None,
    step: float | None = None,
) -> Lookup:
    """Look-up in a table over φ.

    Args:
        columns: our table with ``phi_deg``.
        rename: printed column → ours, where they differ.
        step: grid that the printed labels are rounded from.
    """
    places = {round(float(angle), 6): index for index, angle in enumerate(columns["phi_deg"])}

    def look(row: str, column: str) -> Ours:
        angle = float(row) if step is None else on_grid(row, step)
        value = columns[(rename or {}).get(column, column)][places[angle]]
        return value if isinstance(value, str) else float(value) + 0.0

    return look


def printed_inputs() -> CycleInputs:
    """The inputs of the listing as printed, each by its code, in SI."""
    codes = {row["code"]: float(row["value"]) for row in rows_of("app2_inputs")}
    si: dict[str, Any] = {q.key: codes[q.code] * q.scale for q in INPUTS}
    boost = {key.removeprefix("boost."): si.pop(key) for key in list(si) if "boost." in key}
    si["cylinders"] = int(si["cylinders"])
    return CycleInputs(kind="diesel", fuel=FUELS["diesel"], boost=Boost(**boost), **si)


@lru_cache(maxsize=1)
def listing() -> Cycle:
    """The cycle of the listing with the program's peculiarities."""
    return cycle(printed_inputs(), Listing())
