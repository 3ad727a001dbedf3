"""Finished rows of a study beside its target, so that a stopped study goes on where it was.

The file ``TARGET.part`` begins with a line of JSON that says what the study is made of; a record
for each chunk of rows follows: its length, its checksum, its numbers and reasons.  A record that a
killed process left unfinished is cut off.
"""

from __future__ import annotations

import hashlib
import io
import json
import os
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

import kshm
from kshm.results.chosen import ChosenQuantities
from reports.inputs.units import number_text
from reports.shared.errors import InputError, OutputError, Problem
from reports.shared.files import is_stream, reason
from reports.shared.resources import source_digest
from reports.studies.plan import Chunk, Plan

SUFFIX = ".part"
_FORMAT = "kshm-study"
_HEAD = struct.Struct("<QI")  # length and checksum of a record


def journal_path(target: Path) -> Path:
    """Return the file of finished rows of a target."""
    return target.with_name(target.name + SUFFIX)


@dataclass(frozen=True, slots=True)
class Making:
    """What a study is made of."""

    plan: Plan
    wanted: ChosenQuantities
    size: int  # combinations of a chunk

    def head(self) -> dict[str, Any]:
        """Return it as a person and the program read it."""
        axes = {axis.key: [len(axis.values), *_ends(axis.values)] for axis in self.plan.axes}
        whole = json.dumps(
            [self.plan.raw, [axis.values for axis in self.plan.axes], self.wanted.names],
            sort_keys=True, ensure_ascii=False,
        )  # fmt: skip
        return {
            "format": _FORMAT,
            "kshm": kshm.__version__,
            "program": source_digest(),
            "source": self.plan.source,
            "vary": axes,
            "pairwise": self.plan.pairwise,
            "quantities": self.wanted.names,
            "rows": self.plan.count,
            "chunk": self.size,
            "input": hashlib.sha256(whole.encode()).hexdigest(),
        }


def _ends(values: tuple[float | int, ...]) -> tuple[str, str]:
    return number_text(float(values[0])), number_text(float(values[-1]))


class Journal:
    """The finished chunks of a study, read back and written on.

    Raises:
        InputError: the file is of another study or of another program, or is there although
            the study is to begin anew.
        OutputError: the file cannot be written.
    """

    def __init__(self, target: Path, making: Making, *, resume: bool) -> None:
        self.path, self._making = journal_path(target), making
        self.rows = 0
        self._stream: BinaryIO | None = None
        self._end = 0
        self._keeps = not is_stream(target)
        if not self._keeps or not self.path.exists():
            return
        if not resume:
            problem, hint = "здесь незаконченное исследование", "продолжите его ключом --resume"
            raise InputError(Problem(str(self.path), problem, f"{hint} или удалите этот файл"))
        self._check()

    def _check(self) -> None:
        with self.path.open("rb") as stream:
            try:
                head = json.loads(stream.readline())
            except ValueError:
                head = {}
            expected = self._making.head()
            if not isinstance(head, dict) or head.get("format") != _FORMAT:
                problem, hint = "это не начатое исследование", "удалите файл и начните заново"
                raise InputError(Problem(str(self.path), problem, hint))
            for key, problem in (("program", "начато другой версией программы"),
                              ("input", "начато с другими данными, ключами или величинами"),
                              ("chunk", "начато другими порциями")):  # fmt: skip
                if head.get(key) != expected[key]:
                    hint = "удалите файл и начните заново или повторите прежнюю команду"
                    raise InputError(Problem(str(self.path), problem, hint))
            self._end = stream.tell()

    def chunks(self, rows: Iterator[list[Any]]) -> Iterator[Chunk]:
        """Yield the finished chunks in order; `rows` yields the combinations of each."""
        if not self._end:
            return
        with self.path.open("rb") as stream:
            stream.seek(self._end)
            while record := _record(stream):
                self._end = stream.tell()
                chunk = self._chunk(record, next(rows))
                self.rows += len(chunk.rows)
                yield chunk

    def _chunk(self, record: bytes, rows: list[Any]) -> Chunk:
        stream = io.BytesIO(record)
        columns = np.load(stream, allow_pickle=False)
        errors = json.loads(stream.read())
        names = self._making.wanted.names
        values = dict(zip(names, columns, strict=True))
        return Chunk(rows, values, [errors.get(str(at), "") for at in range(len(rows))])

    def write(self, chunk: Chunk) -> None:
        """Append a finished chunk; the system has it when this returns.

        Raises:
            OutputError: the file cannot be written.
        """
        if not self._keeps:  # a pipe has no file beside it
            return
        stream = io.BytesIO()
        np.save(stream, np.array(list(chunk.values.values())), allow_pickle=False)
        errors = {str(at): error for at, error in enumerate(chunk.errors) if error}
        stream.write(json.dumps(errors, ensure_ascii=False).encode())
        record = stream.getvalue()
        try:
            if self._stream is None:
                self._stream = self._opened()
            self._stream.write(_HEAD.pack(len(record), zlib.crc32(record)) + record)
        except OSError as error:
            raise OutputError(f"{self.path}: не записать: {reason(error)}") from None
        self.rows += len(chunk.rows)

    def _opened(self) -> BinaryIO:
        if self._end:
            stream = self.path.open("r+b", buffering=0)
            stream.truncate(self._end)
            stream.seek(self._end)
            return stream
        stream = self.path.open("wb", buffering=0)
        stream.write(json.dumps(self._making.head(), ensure_ascii=False).encode() + b"\n")
        return stream

    def close(self, *, done: bool) -> None:
        """Close the file; remove it when the study is done."""
        if self._stream is not None:
            self._stream.close()
        if done and self._keeps:
            self.path.unlink(missing_ok=True)


def _record(stream: BinaryIO) -> bytes:
    """Return the next whole record, nothing at the end or where it was torn."""
    head = stream.read(_HEAD.size)
    if len(head) < _HEAD.size:
        return b""
    length, checksum = _HEAD.unpack(head)
    size = os.fstat(stream.fileno()).st_size
    record = stream.read(length) if length <= size else b""
    return record if len(record) == length and zlib.crc32(record) == checksum else b""
