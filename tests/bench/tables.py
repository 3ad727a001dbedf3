"""The tables of all samples, and what it buys to leave alone what no renaming changes."""

from __future__ import annotations

from collections.abc import Iterator
from unittest import mock

from reports.inputs.load import load_toml
from reports.model import chapter_source, rename
from reports.shared.resources import samples_dir
from reports.tables.registry import build_model
from tests.bench._figure import Figure, interleaved, median, ratio

INPUTS = [load_toml(path).model for path in sorted(samples_dir().glob("*.toml"))]


def every() -> None:
    """The tables of each sample."""
    for model in INPUTS:
        build_model(model)


def all_renamed() -> None:
    """The same, every expression read for names to replace."""
    built = rename._Expressions
    with mock.patch.object(rename, "_Expressions", lambda names, only=(): built(names)):
        every()


def read_anew() -> None:
    """Every book read as by a new process."""
    chapter_source.environment_of.cache_clear()
    build_model(INPUTS[0])


def compiled_anew() -> None:
    """The same, and no compiled book is kept."""
    with mock.patch.object(chapter_source, "_compiled", lambda folder: None):
        read_anew()
    chapter_source.environment_of.cache_clear()


def figures() -> Iterator[Figure]:
    """Figures."""
    times = interleaved({"now": every, "all": all_renamed}, rounds=5)
    yield Figure("таблицы всех образцов: процессор", median(times["now"]), "с",
                 f"{len(INPUTS)} образцов")  # fmt: skip
    yield Figure("каждое выражение переписано / как есть", ratio(times, "all", "now"), "раз")
    times = interleaved({"kept": read_anew, "anew": compiled_anew}, rounds=5)
    yield Figure("книги таблиц, первый двигатель процесса: процессор", median(times["kept"]), "с")
    yield Figure("скомпилированные книги / каждая заново", ratio(times, "kept", "anew"), "раз")
