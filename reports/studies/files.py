"""Results of a study as they come: Parquet by row groups, CSV, or a workbook with charts."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from reports.exports.numbers import neutralised
from reports.shared.errors import KshmError, SystemPartMissing
from reports.studies.plan import Plan
from reports.studies.points import Chunk
from reports.studies.quantities import Wanted

ERROR = "error"
SUFFIXES = (".parquet", ".csv", ".xlsx")
ROW_GROUP = 16_384


class Sink(Protocol):
    """Takes the chunks in order."""

    def write(self, chunk: Chunk) -> None:
        """Append the rows of a chunk."""


@contextmanager
def sink(path: Path, suffix: str, plan: Plan, wanted: Wanted) -> Iterator[Sink]:
    """A writer into ``path`` for one of ``SUFFIXES``.

    Raises:
        KshmError: the suffix is none of them.
        SystemPartMissing: Parquet is asked for without its package.
    """
    keys = [axis.key for axis in plan.axes]
    if suffix == ".parquet":
        with _parquet(path, keys, wanted) as made:
            yield made
    elif suffix == ".csv":
        with path.open("w", encoding="utf-8", newline="") as stream:
            yield _Csv(csv.writer(stream, lineterminator="\n"), keys, wanted)
    elif suffix == ".xlsx":
        from reports.studies.book import StudyBook

        book = StudyBook(plan, wanted)
        try:
            yield book
        except BaseException:
            book.close()
            raise
        path.write_bytes(book.data())
    else:
        raise KshmError(f"{path.name}: нужно окончание {', '.join(SUFFIXES)}")


class _Csv:
    def __init__(self, writer: Any, keys: list[str], wanted: Wanted) -> None:  # noqa: ANN401
        self._writer = writer
        self._names = wanted.names
        writer.writerow([*keys, *self._names, ERROR])

    def write(self, chunk: Chunk) -> None:
        columns = [chunk.values[name].tolist() for name in self._names]
        rows = zip(chunk.rows, zip(*columns, strict=True), chunk.errors, strict=True)
        for inputs, values, error in rows:
            texts = ["" if error else repr(value) for value in values]
            self._writer.writerow([*map(repr, inputs), *texts, neutralised(error)])


@contextmanager
def _parquet(path: Path, keys: list[str], wanted: Wanted) -> Iterator[Sink]:
    try:
        import pyarrow as pa
        from pyarrow import parquet
    except ImportError:
        raise SystemPartMissing(
            "пакет pyarrow", 'pip install "kshm[sweep]"', purpose="для файлов .parquet"
        ) from None
    numbers = [pa.field(name, pa.float64()) for name in (*keys, *wanted.names)]
    schema = pa.schema([*numbers, pa.field(ERROR, pa.string())])
    with parquet.ParquetWriter(path, schema) as writer:
        made = _Parquet(writer, schema, pa)
        yield made
        made.flush()


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
