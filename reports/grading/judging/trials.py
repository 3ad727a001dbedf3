"""Other input values on which every formula of a class is tried.

A formula must give the right column for other engines too.  Two sets change what differs
between the students: values of other variants, and values between them, drawn with a secret
seed when the works are graded.  The third changes every number of the input: it shows
a constant where the students' variants do not, but does not decide, for what is the same
for the whole class may be typed in.  The student's own engine between the angles of the tables
tells what calculates from what only repeats.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.register import Issued
from reports.grading.judging.tolerances import apart
from reports.inputs.fields import Field, cell_name
from reports.inputs.ranges import Range
from reports.model.evaluation import Evaluation

_TRIES = 12
_LEAST, _MOST = 0.02, 0.08  # how much the third set changes a number
_GOLDEN = 0.618034  # of three in a row no two come nearer than a quarter
_EDGE, _APART = 0.02, 0.25  # of the range: from its ends, between the first two sets
_TURN = 1.7  # ° or %, which no table has as its step
_NOUGHT = 1e-6  # of the last digit that is printed: what is left of A − A
_NARROW = 0.05  # where all variants have the same value


@dataclass(frozen=True)
class Trial:
    """One set of input values; ``decides`` where a formula must be right for it."""

    inputs: Mapping[str, float]
    expected: Evaluation
    decides: bool
    angles: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)  # of tables


def trials_of(assignment: Assignment, books: Sequence[Issued], seed: str) -> tuple[Trial, ...]:
    """The sets for a class, the same for the same seed."""
    rng = random.Random(seed)
    values = _varied(assignment, books)
    found = [_first(assignment, _others(values, rng), decides=True)]
    first = found[0].inputs if found[0] is not None else {}
    found.append(_first(assignment, _between(values, first, rng), decides=True))
    start = found[-1].inputs if found[-1] is not None else {}
    found.append(_first(assignment, _everything(assignment, start, rng), decides=False))
    return tuple(trial for trial in found if trial is not None)


def turned(own: Evaluation) -> Trial:
    """The engine itself at angles between those of its tables: a list has no number there."""
    angles = {
        f"{table.id}.{table.columns[0].key}": np.array(table.rows) + _TURN
        for table in own.model.tables.values()
        if table.columns[0].quantity.unit and not table.row_by_row
    }
    return Trial({}, own.fork(angles), decides=False, angles=angles)


def fixed(node: str, own: Evaluation, trials: Sequence[Trial]) -> NDArray[np.bool_]:
    """Where the right value is the same whatever the engine: 0 at dead centre."""
    right, *others = [
        np.ravel(run.value(node)) for run in (own, *(trial.expected for trial in trials))
    ]
    if not others or right.dtype.kind == "U":
        return np.zeros(len(right), dtype=bool)
    digit = 10.0 ** -own.model.nodes[node].quantity.digits.decimals
    allowed = max(1e-9 * float(np.nanmax(np.abs(right))), _NOUGHT * digit)
    near = [apart([node], other, right, own) <= allowed for other in others]
    return np.asarray(np.logical_and.reduce(near))


def _first(
    assignment: Assignment, draws: Iterator[dict[str, float]], *, decides: bool
) -> Trial | None:
    """The first draw for which the engine can be calculated."""
    own = Evaluation(assignment.model)
    nodes = [node for item in assignment.items for node in item.nodes]
    for _, inputs in zip(range(_TRIES), draws, strict=False):
        run = own.fork(inputs)
        try:
            if all(_as_finite(run.value(node), own.value(node)) for node in nodes):
                return Trial(inputs, run, decides)
        except (ArithmeticError, ValueError, IndexError):
            continue
    return None


def _as_finite(value: object, own: object) -> bool:
    if isinstance(value, str) or isinstance(own, str):
        return True
    return bool((np.isfinite(value) | ~np.isfinite(own)).all())  # type: ignore[call-overload]


def _varied(assignment: Assignment, books: Sequence[Issued]) -> dict[str, list[float]]:
    """Values of the numbers that differ between the students, by the name of their cell."""
    found: dict[str, list[float]] = {}
    fields = assignment.model.fields
    for book in books:
        for key, value in book.drawn.items():
            name = cell_name(Range.path_of(key))
            if name in fields and _may_change(fields[name]) and isinstance(value, (int, float)):
                found.setdefault(name, []).append(float(value))
    return found


def _may_change(field: Field) -> bool:
    """Numbers that do not decide the shape of the tables, nor by how much they are shifted."""
    number = isinstance(field.value, (int, float)) and not isinstance(field.value, bool)
    shifts = field.path[0] == "crankshaft" and field.name.endswith("_deg")
    point = "_point_" in field.name
    return number and not field.structural and not shifts and not point


def _others(values: Mapping[str, list[float]], rng: random.Random) -> Iterator[dict[str, float]]:
    """Values of other variants, each key of a variant of its own."""
    while True:
        yield {name: rng.choice(known) for name, known in values.items()}


def _between(
    values: Mapping[str, list[float]], first: Mapping[str, float], rng: random.Random
) -> Iterator[dict[str, float]]:
    """Values in the range of all variants, far from those of the first set.

    What a student has typed in may be near one of the two, but not near both.
    """
    while True:
        made = {}
        for name, known in values.items():
            low, high = min(known), max(known)
            if high - low < 1e-9 * max(1.0, abs(high)):
                low, high = low * (1 - _NARROW), high * (1 + _NARROW)
            near = (first.get(name, low) - low) / (high - low)
            below, above = max(0.0, near - _APART - _EDGE), max(0.0, 1 - _EDGE - near - _APART)
            share = rng.uniform(0, below + above)
            share += _EDGE if share < below else near + _APART - below
            made[name] = low + (high - low) * share
        yield made


def _everything(
    assignment: Assignment, start: Mapping[str, float], rng: random.Random
) -> Iterator[dict[str, float]]:
    """All numbers changed a little; equal ones stay equal, for a student may use either.

    Those that stand together differ in by how much: no ratio of theirs stays as it was.
    """
    fields = [
        field
        for field in assignment.model.inputs
        if _may_change(field) and not field.name.endswith("_deg") and field.path[0] != "report"
    ]
    most = _MOST
    while True:
        factors: dict[tuple[str, float], float] = {}
        up = rng.choice((-1, 1))  # all the same way, so that no sum stays as it was
        share = rng.random()
        made = dict(start)
        for given in fields:
            value = float(given.value)
            key = (given.unit, value)
            if given.name in start or not value:
                continue
            if key not in factors:
                share = (share + _GOLDEN) % 1
                factors[key] = 1 + up * most * (1 + 3 * share) / 4
            made[given.name] = value * factors[key]
        yield made
        most = max(most / 2, _LEAST / 2)
