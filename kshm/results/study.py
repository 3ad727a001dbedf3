"""A parameter study: many engines that differ in a few numbers, solved together."""

from __future__ import annotations

import itertools
import math
import multiprocessing
import signal
import sys
import time
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

from kshm.arrays import Array
from kshm.chain.solve import chunk_size, solve_batch
from kshm.chain.stack import structure
from kshm.cycle.cycle import CycleRun
from kshm.engine.checks import as_scalar, check_kind, refuse
from kshm.engine.engine import Engine
from kshm.engine.revised import VARIED, engine_maker
from kshm.engine.source import MakeEngine
from kshm.errors import InputError, KshmError, Problem, UnknownNameError, one_line
from kshm.nomenclature.quantity import UNITS
from kshm.results.chosen import ChosenQuantities, choose, described, of_batch

if TYPE_CHECKING:
    import pandas as pd

MAIN = ("M_mean", "M_max", "M_min", "N_i_calc", "Rpin_max_kN", "Rpin_mean", "q_pin_max")
ERROR = "error"
_LACKS = Problem("", "an engine of this structure has not all quantities")
NOT_FINITE = "the calculation gave no finite number"
Row = tuple[float, ...]
Progress = Callable[[int, int], object]  # rows done, rows in all


class StudyInterrupted(KeyboardInterrupt):
    """Ctrl-C during a study; ``partial`` has the rows that were done.

    With ``engine`` as in the example of ``kshm.in_line``:

    >>> def press_ctrl_c(done, total):
    ...     raise KeyboardInterrupt
    >>> try:
    ...     sweep(engine, {"bore_mm": [95, 100]}, progress=press_ctrl_c)
    ... except StudyInterrupted as interrupted:
    ...     print(interrupted, len(interrupted.partial))
    2 of 2 rows are done 2
    """

    partial: pd.DataFrame


def sweep(
    engine: Engine,
    vary: Mapping[str, Collection[float]],
    *,
    quantities: Collection[str] = MAIN,
    pairwise: bool = False,
    jobs: int = 1,
    progress: bool | Progress = False,
) -> pd.DataFrame:
    """Solve an engine with other numbers; a row for each combination, the first name fastest.

    Args:
        engine: the base.
        vary: values by name: a key of the file that the engine was read from, in the file's units
            (``geometry.bore_mm``, ``crankshaft.webs.*.counterweight_kg``), a name of
            ``kshm.assemble`` (``bore_mm``), or a path within the engine in SI (``geometry.bore``);
            each list of shape (values,), in the unit of its name.
        quantities: keys of scalars (``M_mean``), English names (``loads.crankpin_max``), columns
            of tables (``P4_1.N_MPa``), which give ``.max``, ``.max_deg``, ``.min``, ``.min_deg``
            and ``.mean``.
        pairwise: the first of all, then the second of all, in place of all combinations.
        jobs: processes; with more than one a script needs ``if __name__ == "__main__":``.
        progress: print rows done and time left to stderr, or call a function of both counts.

    Returns:
        Columns of the names and of the quantities, in the units of their quantities, and
        ``error``: why a row has no numbers, with its values; empty where it has.
        ``attrs["units"]`` and ``attrs["titles"]`` tell of each.

    Raises:
        InputError: a name or key that is none, nothing to vary, values that are no numbers, lists
            of different lengths with ``pairwise``.
        StudyInterrupted: Ctrl-C; its ``partial`` has the rows that were done.

    With ``engine`` as in the example of ``kshm.in_line``:

    >>> study = sweep(engine, {"speed_rpm": [1000, 2000], "bore_mm": [95, 100, -1]})
    >>> study.shape, study.attrs["units"]["M_mean"]
    ((6, 10), 'Н·м')
    >>> study.loc[4, "error"]
    'speed_rpm = 1000, bore_mm = -1: Geometry.bore: must be positive, not -0.001'
    """
    rows = _rows(vary, pairwise=pairwise)
    study = Study.of(engine, tuple(vary), quantities)
    parts: list[Solved] = []
    try:
        for part in in_order(study, rows, jobs, progress=progress):
            parts.append(part)
    except KeyboardInterrupt:
        done = sum(len(part.rows) for part in parts)
        interrupted = StudyInterrupted(f"{done} of {len(rows)} rows are done")
        interrupted.partial = study.frame(parts)
        raise interrupted from None
    return study.frame(parts)


@dataclass(frozen=True, slots=True)
class Solved:
    """Rows with their numbers by name, each of shape (rows,), and why a row has none."""

    rows: list[Row]
    values: dict[str, Array]
    errors: list[str]


@dataclass(frozen=True, slots=True)
class Study:
    """A base, names that vary and quantities."""

    engine: Engine
    names: tuple[str, ...]
    chosen: ChosenQuantities

    @classmethod
    def of(cls, engine: Engine, names: tuple[str, ...], quantities: Collection[str]) -> Study:
        """Return the study, its names and quantities checked.

        Raises:
            InputError: a name or a quantity that there is not.
        """
        check_kind("engine", engine, Engine)
        refuse(
            (isinstance(quantities, str), "quantities: must be a list of keys, not a text"),
            (not isinstance(quantities, Collection), "quantities: must be a list of keys"),
        )
        engine_maker(engine, names)
        chosen = choose(solve_batch([engine]), quantities, cycle_of(engine))
        return cls(engine, names, chosen)

    @property
    def size(self) -> int:
        """Rows of a chunk."""
        return chunk_size(self.engine)

    def solve(self, rows: Sequence[Row], make: MakeEngine | None = None) -> Solved:
        """Return the numbers of rows; a wrong one has its reason.

        ``make`` is an `engine_maker` of the study, where one serves for many calls.
        """
        make = make or engine_maker(self.engine, self.names)
        errors = [""] * len(rows)
        values = {name: np.full(len(rows), np.nan) for name in self.chosen.names}
        groups: dict[tuple[object, ...], list[tuple[int, Engine]]] = {}
        for at, row in enumerate(rows):
            try:
                engine = make(row)
            except KshmError as error:
                errors[at] = self._reason(row, error.lines()[0])
            else:
                groups.setdefault(structure(engine), []).append((at, engine))
        for group in groups.values():
            here, engines = [at for at, _ in group], [engine for _, engine in group]
            cycles = [cycle_of(engine) for engine in engines]
            try:
                numbers, reasons = of_batch(solve_batch(engines), self.chosen, cycles)
            except KeyError as error:  # of another structure
                numbers, reasons = {}, [UnknownNameError(str(error.args[0]), _LACKS)] * len(here)
            for name, each in numbers.items():
                values[name][here] = each
            finite = np.all([np.isfinite(each) for each in values.values()], axis=0)
            for at, reason in zip(here, reasons, strict=True):
                text = reason.lines()[0] if reason else "" if finite[at] else NOT_FINITE
                errors[at] = self._reason(rows[at], text) if text else ""
        return Solved(list(rows), values, errors)

    def _reason(self, row: Row, text: str) -> str:
        pairs = zip(self.names, row, strict=True)
        return f"{', '.join(f'{name} = {value:g}' for name, value in pairs)}: {text}"

    def frame(self, parts: Sequence[Solved]) -> pd.DataFrame:
        """Return solved rows as a table that knows its units."""
        import pandas as pd

        rows = [row for part in parts for row in part.rows]
        empty = np.empty(0)
        inputs = dict(zip(self.names, zip(*rows, strict=True), strict=True)) if rows else {}
        columns: dict[str, Any] = {name: inputs.get(name, ()) for name in self.names}
        for name in self.chosen.names:
            columns[name] = np.concatenate([empty, *(part.values[name] for part in parts)])
        columns[ERROR] = [error for part in parts for error in part.errors]
        frame = pd.DataFrame(columns)
        descriptions = {name: described(name, self.chosen) for name in self.chosen.names}
        frame.attrs["units"] = {name: self._unit(name) for name in self.names}
        frame.attrs["units"] |= {name: unit for name, (_, unit) in descriptions.items()}
        frame.attrs["titles"] = {name: title for name, (title, _) in descriptions.items()}
        return frame

    def _unit(self, name: str) -> str:
        if name in VARIED:
            return UNITS[VARIED[name][1]].label
        source = self.engine.source
        key = source.find(name) if source is not None else ""
        return source.unit(key) if source is not None and key else ""


def cycle_of(engine: Engine) -> CycleRun | None:
    """Return the calculation that an engine's gas comes from, if it is as it was read."""
    source = engine.source
    run: CycleRun | None = source.cycle if source is not None and source.has_made(engine) else None
    return run


def _checked(vary: Mapping[str, Collection[float]]) -> dict[str, tuple[float, ...]]:
    """Return the values by name, each a number.

    Raises:
        InputError: there are none, or one is no number.
    """
    refuse(
        (not isinstance(vary, Mapping), "vary: must be a mapping of names to lists of values"),
        (not vary, "name something to vary"),
    )
    lists = {}
    for name, values in vary.items():
        one = isinstance(values, Real | str) or not isinstance(values, Collection)
        each = () if one else tuple(map(as_scalar, values))
        if not each:
            problem = "the list of values is empty" if not one else "must be a list of numbers"
            raise InputError(Problem(one_line(str(name), 80), problem, "e.g. [84, 88, 92]"))
        for value in each:
            if not isinstance(value, Real) or isinstance(value, bool):
                problem = f"must be a number, not {one_line(repr(value), 40)}"
                raise InputError(Problem(one_line(str(name), 80), problem, value=value))
        lists[name] = tuple(map(_whole_or_float, each))
    return lists


def _whole_or_float(value: float) -> float:
    """Return Python's own number; a whole one stays whole, as files want it."""
    return int(value) if isinstance(value, int | np.integer) else float(value)


def _rows(vary: Mapping[str, Collection[float]], *, pairwise: bool) -> list[Row]:
    lists = list(_checked(vary).values())
    lengths = {len(values) for values in lists}
    refuse((pairwise and len(lengths) > 1, "pairwise lists must have one length"))
    if pairwise:
        return list(zip(*lists, strict=True))
    # The first name changes fastest.
    return [row[::-1] for row in itertools.product(*lists[::-1])]


def _chunks(rows: list[Row], size: int) -> Iterator[list[Row]]:
    """Yield the rows, so many at a time."""
    for begin in range(0, len(rows), size):
        yield rows[begin : begin + size]


def in_order(
    study: Study, rows: list[Row], jobs: int = 1, *, progress: bool | Progress = False
) -> Iterator[Solved]:
    """Yield the solved rows in order, from this process or from several, a chunk at a time.

    Raises:
        InputError: there is no process to work.
    """
    check_kind("jobs", jobs, int)
    refuse((jobs < 1, f"jobs: must be 1 or more, not {jobs}"))
    progressed = _Told(len(rows), progress)
    for part in _solved(study, _chunks(rows, study.size), jobs):
        yield part
        progressed.step(len(part.rows))


def _solved(study: Study, chunks: Iterator[list[Row]], jobs: int) -> Iterator[Solved]:
    if jobs == 1:
        yield from map(study.solve, chunks)
        return
    # A copy of a process with threads, as a notebook is, may hang.
    context = multiprocessing.get_context("spawn" if sys.platform == "win32" else "forkserver")
    ignore = partial(signal.signal, signal.SIGINT, signal.SIG_IGN)
    with ProcessPoolExecutor(jobs, context, initializer=ignore) as pool:
        try:
            yield from pool.map(study.solve, chunks)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


class _Told:
    """What of a study is done, told to a function or printed."""

    def __init__(self, total: int, progress: bool | Progress) -> None:
        self.total, self.done, self._begun = total, 0, time.monotonic()
        self._tell = self._print if progress is True else progress or None

    def step(self, rows: int) -> None:
        """Count rows."""
        self.done += rows
        if self._tell is not None:
            self._tell(self.done, self.total)

    def _print(self, done: int, total: int) -> None:
        left = (time.monotonic() - self._begun) * (total - done) / done
        end = "\n" if done == total else ""
        print(f"\r{done} of {total}, {math.ceil(left)} s left ", end=end, file=sys.stderr)
