"""Run a parameter study; write Parquet, CSV or a workbook as results come."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any, Protocol, TextIO

import click
import numpy as np

from kshm.chain.solve import chunk_size, solve_batch
from kshm.results.chosen import ChosenQuantities, described
from reports.exports.build import load_input
from reports.exports.department_chapters import own_numbers
from reports.exports.numbers import PLAIN, CsvForm, neutralised
from reports.inputs.to_si.engine import engine_and_cycle
from reports.inputs.units import number_text
from reports.shared.background import processors
from reports.shared.errors import KshmError, OutputError, SystemPartMissing
from reports.shared.files import atomic_path, reason, refuse_own
from reports.shared.interrupt import stopped
from reports.shared.parallel_map import in_order
from reports.shared.progress import Progress
from reports.studies.journal import Journal, Making
from reports.studies.plan import Chunk, Plan, make_plan, solved, tasks
from reports.studies.quantities import choose

ERROR = "error"
SUFFIXES = (".parquet", ".csv", ".xlsx")
ROW_GROUP = 16_384
# Starting processes takes longer than that many combinations.
_FEW = 4000


class Sink(Protocol):
    """Takes the chunks in order."""

    def write(self, chunk: Chunk) -> None:
        """Append the rows of a chunk."""


@contextmanager
def sink(
    path: Path, suffix: str, plan: Plan, quantities: ChosenQuantities, form: CsvForm = PLAIN
) -> Iterator[Sink]:
    """Yield a writer into ``path`` for one of ``SUFFIXES``.

    Raises:
        KshmError: the suffix is none of them.
        SystemPartMissing: Parquet is asked for without its package.
    """
    if suffix == ".parquet":
        with _parquet(path, plan, quantities) as writer:
            yield writer
    elif suffix == ".csv":
        with path.open("w", encoding=form.encoding, newline="") as stream:
            yield _Csv(form, stream, plan, quantities)
    elif suffix == ".xlsx":
        from reports.studies.workbooks import StudyBook

        book = StudyBook(plan, quantities)
        try:
            yield book
        except BaseException:
            book.close()
            raise
        path.write_bytes(book.data())
    else:
        raise KshmError(f"{path.name}: нужно окончание {', '.join(SUFFIXES)}")


class _Csv:
    def __init__(
        self, form: CsvForm, stream: TextIO, plan: Plan, quantities: ChosenQuantities
    ) -> None:
        self._form, self._writer, self._names = form, form.writer(stream), quantities.names
        descriptions = _descriptions(plan, quantities)
        heads = form.heads([*descriptions, ERROR], lambda key: descriptions.get(key, ("", ""))[1])
        self._writer.writerows(heads)

    def write(self, chunk: Chunk) -> None:
        number = self._form.number
        columns = [chunk.values[name].tolist() for name in self._names]
        rows = zip(chunk.rows, zip(*columns, strict=True), chunk.errors, strict=True)
        for inputs, values, error in rows:
            texts = ["" if error else number(value) for value in values]
            self._writer.writerow([*map(number, inputs), *texts, neutralised(error)])


def _descriptions(plan: Plan, quantities: ChosenQuantities) -> dict[str, tuple[str, str]]:
    """Title and unit of every column of numbers."""
    axes = {axis.key: (axis.title, axis.unit) for axis in plan.axes}
    return axes | {name: described(name, quantities) for name in quantities.names}


@contextmanager
def _parquet(path: Path, plan: Plan, quantities: ChosenQuantities) -> Iterator[Sink]:
    try:
        import pyarrow as pa
        from pyarrow import parquet
    except ImportError:
        raise SystemPartMissing(
            "пакет pyarrow", 'pip install "kshm[sweep]"', purpose="для файлов .parquet"
        ) from None
    numbers = [
        pa.field(name, pa.float64(), metadata={"title": title, "unit": unit})
        for name, (title, unit) in _descriptions(plan, quantities).items()
    ]
    schema = pa.schema([*numbers, pa.field(ERROR, pa.string())])
    with parquet.ParquetWriter(path, schema) as writer:
        rows = _Parquet(writer, schema, pa)
        yield rows
        rows.flush()


class _Parquet:
    """Gathers rows to groups, so that columns are long enough to be read quickly."""

    def __init__(self, writer: Any, schema: Any, pa: Any) -> None:  # noqa: ANN401
        self._writer, self._schema, self._pa = writer, schema, pa
        self._chunks: list[Chunk] = []
        self._rows = 0

    def write(self, chunk: Chunk) -> None:
        self._chunks.append(chunk)
        self._rows += len(chunk.rows)
        if self._rows >= ROW_GROUP:
            self.flush()

    def flush(self) -> None:
        """Write what has gathered as one row group."""
        if not self._rows:
            return
        chunks = self._chunks
        inputs = np.array([row for chunk in chunks for row in chunk.rows], dtype=float)
        values = [
            np.concatenate([chunk.values[name] for chunk in chunks]) for name in chunks[0].values
        ]
        errors = [error or None for chunk in chunks for error in chunk.errors]
        arrays = [self._pa.array(column) for column in (*inputs.T, *values)]
        arrays.append(self._pa.array(errors, self._pa.string()))
        table = self._pa.Table.from_arrays(arrays, schema=self._schema)
        self._writer.write_table(table, row_group_size=self._rows)
        self._chunks, self._rows = [], 0


@dataclass(frozen=True, slots=True)
class SweepOptions:
    """How a study runs; the results do not depend on it."""

    jobs: int = 0  # 0: all cores
    dask: str | None = None
    chunk: int | None = None  # combinations at a time
    form: CsvForm = PLAIN
    resume: bool = False  # go on with what a stopped study has left


@dataclass(frozen=True, slots=True)
class Studied:
    """How many combinations a study had and how many have no result."""

    points: int
    failed: int
    first_error: str = ""


def sweep(
    source: Path,
    vary: Sequence[str],
    target: Path,
    *,
    quantities: Sequence[str] = (),
    pairwise: bool = False,
    options: SweepOptions | None = None,
) -> Studied:
    """Vary keys of a base file and write the results to ``target``, whole or not at all.

    Raises:
        InputError: the base or what is asked for is wrong.
        OutputError: the file cannot be written.
    """
    options = options or SweepOptions()
    suffix = target.suffix.lower()
    if suffix not in SUFFIXES:
        raise KshmError(f"{target}: нужно окончание {', '.join(SUFFIXES)}; укажите его в ключе -o")
    loaded = load_input(source)
    refuse_own([target], [source, *loaded.beside])
    model = loaded.model
    plan = make_plan(model, source.name, vary, pairwise=pairwise)
    engine, cycle = engine_and_cycle(model)
    department = {key: about for key, (about, value) in own_numbers(model).scalars.items()
           if not isinstance(value, str)}  # fmt: skip
    chosen = choose(solve_batch([engine]), quantities, cycle, department)
    size = options.chunk or chunk_size(engine)
    journal = Journal(target, Making(plan, chosen, size), resume=options.resume)
    study = _Running(plan, chosen, size, options, journal)
    try:
        with (
            Progress("Исследование") as progress,
            atomic_path(target) as temporary,
            _disk_errors(target),
            sink(temporary, suffix, plan, chosen, options.form) as out,
        ):
            study.run(out, progress)
    except BaseException as error:
        journal.close(done=False)
        if journal.rows and (isinstance(error, KeyboardInterrupt) or stopped()):
            hint = "продолжит та же команда с ключом --resume"
            click.echo(f"сделано {journal.rows} из {plan.count}; {hint}", err=True)
        raise
    journal.close(done=True)
    return Studied(study.done, study.failed, study.first_error)


@contextmanager
def _disk_errors(target: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise OutputError(f"{target}: не записать: {reason(error)}") from None


class _Running:
    """A study under way: finished chunks of an earlier run first, then the others."""

    def __init__(
        self, plan: Plan, quantities: ChosenQuantities, size: int, options: SweepOptions,
        journal: Journal,
    ) -> None:  # fmt: skip
        self.plan, self.wanted, self.size, self.options = plan, quantities, size, options
        self.journal = journal
        self.done = self.failed = 0
        self.first_error = ""

    def run(self, out: Sink, progress: Progress) -> None:
        """Write all chunks in order; what is done is kept."""
        begun = time.monotonic()
        for chunk in self.journal.chunks(self.plan.chunks(self.size)):
            self._take(out, chunk)
        earlier = self.done
        work = islice(tasks(self.plan, self.wanted, self.size), -(-earlier // self.size), None)
        jobs = self.options.jobs or processors()
        if self.plan.count - earlier <= _FEW and not self.options.jobs:
            jobs = 1
        for chunk in in_order(solved, work, jobs=jobs, dask=self.options.dask):
            self._take(out, chunk)
            if self.done < self.plan.count or earlier:
                self.journal.write(chunk)
            left = (time.monotonic() - begun) / (self.done - earlier)
            progress.step(self._state(left * (self.plan.count - self.done)))

    def _take(self, out: Sink, chunk: Chunk) -> None:
        out.write(chunk)
        self.done += len(chunk.rows)
        errors = [number for number, error in enumerate(chunk.errors) if error]
        self.failed += len(errors)
        if errors and not self.first_error:
            row = chunk.rows[errors[0]]
            values = (
                f"{axis.key} = {number_text(float(value))}"
                for axis, value in zip(self.plan.axes, row, strict=True)
            )
            self.first_error = f"{', '.join(values)}: {chunk.errors[errors[0]]}"

    def _state(self, left_s: float) -> str:
        minutes, seconds = divmod(math.ceil(left_s), 60)
        left = f"{minutes} мин {seconds} с" if minutes else f"{seconds} с"
        return f"Исследование: {self.done} из {self.plan.count}, осталось {left}"
