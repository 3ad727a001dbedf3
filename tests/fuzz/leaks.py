"""Random classes whose books must hold no answers: ``python -m tests.fuzz.leaks [COUNT [SEED]]``.

Every class has an engine near a sample and a random set of tables to fill in.  Where a table
that is given repeats what is asked, ``issue`` refuses the class: an alarm is genuine when six
digits agree.  Any other alarm is false.  What is planted afterwards must be found.
"""

from __future__ import annotations

import io
import random
import re
import sys
import time
import zipfile
from collections.abc import Callable, Sequence

import numpy as np
from openpyxl import Workbook, load_workbook

from reports.grading.issuing.assignment import Assignment, assignment_of
from reports.grading.issuing.handout import Leak, handout_bytes, leaks_of
from reports.grading.issuing.rubric import rubric_of
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import Evaluation
from reports.shared.errors import InputError
from reports.tables.registry import build_model
from tests.conftest import sample

TICKET = "K" + "A" * 24
SAMPLES = ("gots-diesel", "d-240", "vw-1600", "two-stroke", "yamz-236", "ecoboost-10", "mwm-6",
           "d-240-bearings", "cycle-petrol", "gots-regimes")  # fmt: skip
WILD = (
    "geometry",
    "masses",
    "P3_*",
    "P4_*",
    "table_14*",
    "balance*",
    "gas",
    "P4_1",
    "P4_2",
    "P4_4",
)
# Ways to hide a column among numbers that are given.
DISGUISES: tuple[Callable[[np.ndarray, random.Random], np.ndarray], ...] = (
    lambda v, rng: v,
    lambda v, rng: -v,
    lambda v, rng: v * 10.0 ** rng.choice((-6, -3, 3, 6)),
    lambda v, rng: np.sort(v),
    lambda v, rng: np.roll(v, rng.randrange(1, len(v))),
)


def random_assignment(rng: random.Random) -> Assignment:
    """A random engine near a sample, and a random rubric.

    Raises:
        InputError: no such class can be issued.
    """
    raw = to_mapping(sample(rng.choice(SAMPLES)))
    raw["calculation"]["step_deg"] = rng.choice((10, 15, 30))
    geometry, regime = raw["geometry"], raw["regime"]
    if "bore_mm" in geometry:  # some inputs give the area instead
        geometry["bore_mm"] = round(geometry["bore_mm"] * rng.uniform(0.97, 1.03), 1)
    regime["speed_rpm"] = round(regime["speed_rpm"] * rng.uniform(0.9, 1.05))
    model = build_model(load_mapping(raw, source="random").model)
    blocks = [block.id for block in model.blocks]
    known = [name for name in WILD if "*" in name or name in blocks]
    fill = rng.sample(known, rng.randint(1, 3)) + rng.sample(blocks, rng.randint(0, 4))
    return assignment_of(model, rubric_of({"work": {"fill": fill}}, "random"))


def genuine(book: bytes, leaks: Sequence[Leak], assignment: Assignment) -> set[str]:
    """Items of which a place holds asked values to the sixth digit: the class must be refused."""
    run = Evaluation(assignment.model)
    items = {item.id: item for item in assignment.items}
    sheets = load_workbook(io.BytesIO(book))
    collected = set()
    for leak in leaks:
        item = items[leak.item.split(" ")[0]]
        if leak.item in collected:
            continue
        requested = (np.ravel(np.asarray(run.value(n), dtype=float)) for n in item.nodes)
        if _shown(np.concatenate(list(requested)).tolist()) & _shown(
            _numbers(book, sheets, leak.place)
        ):
            collected.add(leak.item)
    return collected


def _shown(values: Sequence[float]) -> set[str]:
    return {f"{abs(v):.5e}"[:7] for v in values if np.isfinite(v) and v}


def _numbers(book: bytes, sheets: Workbook, position: str) -> list[float]:
    """Numbers of a place of a book, read without the check's own reader."""
    if "!" not in position:
        with zipfile.ZipFile(io.BytesIO(book)) as archive:
            text = archive.read(position.split(",")[0]).decode()
        return [float(v) for v in re.findall(r">(-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)<", text)]
    title, _, where = position.rpartition("!")
    cells = sheets[title][where]
    return [float(cell.value) for cell in cells if isinstance(cell.value, (int, float))]


def planted(book: bytes, assignment: Assignment, rng: random.Random) -> bytes | None:
    """The book with an asked column in it in disguise; None where no column is long enough."""
    run = Evaluation(assignment.model)
    columns = []
    for item in assignment.items:
        copied = len(assignment.graph.references(item.nodes[0])) < 2  # of what may be given
        if item.is_column and not item.helper and not copied:
            values = np.ravel(np.asarray(run.value(item.nodes[0]), dtype=float))
            shown = {f"{abs(v):.3e}" for v in values if np.isfinite(v) and v}
            if len(shown) >= 8:
                columns.append(values)
    if not columns:
        return None
    hidden = rng.choice(DISGUISES)(rng.choice(columns), rng)
    opened: Workbook = load_workbook(io.BytesIO(book))
    sheet = rng.choice(opened.worksheets)
    row, column = rng.randrange(100, 200), rng.randrange(40, 60)
    for i, value in enumerate(hidden.tolist()):
        if np.isfinite(value):
            sheet.cell(row + i, column).value = value
    stream = io.BytesIO()
    opened.save(stream)
    return stream.getvalue()


def main(arguments: Sequence[str]) -> int:
    """Try so many classes; exit code 1 where one was judged wrongly."""
    count = int(arguments[0]) if arguments else 200
    alarms, missed, tried, refused, leaking, hidden = [], [], 0, 0, 0, 0
    seed, started = int(arguments[1]) if len(arguments) > 1 else 0, time.monotonic()
    while tried < count:
        seed += 1
        rng = random.Random(seed)
        try:
            assignment = random_assignment(rng)
            book = handout_bytes(assignment, TICKET)
        except InputError as error:
            refused += 1
            print(f"{seed}: отказ: {error.problems[0].what[:100]}", flush=True)
            continue
        tried += 1
        before = leaks_of(book, assignment)
        known = genuine(book, before, assignment)
        false = [leak for leak in before if leak.item not in known]
        leaking += bool(before) and not false
        if false:
            alarms.append(seed)
            about = f"{assignment.model.input.engine.name}, {assignment.rubric.work.fill}"
            print(f"{seed}: тревога: {about}: {false[:3]}", flush=True)
        if tried % 4 == 0 and (with_answers := planted(book, assignment, rng)) is not None:
            hidden += 1
            if len(leaks_of(with_answers, assignment)) <= len(before):
                missed.append(seed)
                print(f"{seed}: подложенное не найдено", flush=True)
    print(
        f"классов: {tried}, невозможных: {refused}, с ответами в выданном (выдача отказана): "
        f"{leaking}, ложных тревог: {len(alarms)}; "
        f"подложено: {hidden}, не найдено: {len(missed)}; {time.monotonic() - started:.0f} с"
    )
    return 1 if alarms or missed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
