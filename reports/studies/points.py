"""Combinations of a study checked, solved together and summed up, a chunk at a time."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kshm.chain.solve import solve_chunks
from kshm.cycle.run import CycleRun
from kshm.engine.engine import Engine
from reports.inputs.fields import Path, set_value
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.errors import KshmError
from reports.studies.plan import Plan
from reports.studies.quantities import Wanted, of_batch

Array = NDArray[np.float64]
NOT_FINITE = "расчёт не дал конечного числа"


@dataclass(frozen=True, slots=True)
class Task:
    """A chunk of combinations with all that solving them needs, here or on another machine."""

    raw: dict[str, Any]
    source: str
    paths: tuple[Path, ...]
    wanted: Wanted
    rows: list[tuple[float | int, ...]]


@dataclass(frozen=True, slots=True)
class Chunk:
    """Combinations and their results; ``errors`` says why a row has none."""

    rows: list[tuple[float | int, ...]]
    values: dict[str, Array]
    errors: list[str] = field(default_factory=list)


def tasks(plan: Plan, wanted: Wanted, size: int) -> Any:  # noqa: ANN401
    """The tasks of a plan in order, made as they are needed."""
    paths = tuple(axis.path for axis in plan.axes)
    return (Task(plan.raw, plan.source, paths, wanted, rows) for rows in plan.chunks(size))


def solved(task: Task) -> Chunk:
    """Every combination is checked like an input file; those that fail keep their reason."""
    errors = [""] * len(task.rows)
    engines, places = _engines(task, errors)
    cycles = [cycle for _, cycle in engines]
    values = {name: np.full(len(task.rows), np.nan) for name in task.wanted.names}
    begin = 0
    for raw in solve_chunks(engine for engine, _ in engines):
        these = slice(begin, begin + len(raw.batch.engines))
        begin, here = these.stop, places[these]
        found, reasons = of_batch(raw, task.wanted, cycles[these])
        for name, numbers in found.items():
            values[name][here] = numbers
        for row, reason in zip(here, reasons, strict=True):
            errors[row] = reason
    for row in places:
        if not all(np.isfinite(each[row]) for each in values.values()):
            errors[row] = errors[row] or NOT_FINITE
    return Chunk(task.rows, values, errors)


def _engines(
    task: Task, errors: list[str]
) -> tuple[list[tuple[Engine, CycleRun | None]], list[int]]:
    raw = copy.deepcopy(task.raw)
    engines: list[tuple[Engine, CycleRun | None]] = []
    places: list[int] = []
    for number, row in enumerate(task.rows):
        _put(raw, task.paths, row)
        try:
            engines.append(engine_and_cycle(load_mapping(raw, source=task.source).model))
        except KshmError as error:
            errors[number] = error.lines()[0]
        else:
            places.append(number)
    return engines, places


def _put(raw: dict[str, Any], paths: Sequence[Path], row: Sequence[float | int]) -> None:
    for path, value in zip(paths, row, strict=True):
        set_value(raw, path, value)
