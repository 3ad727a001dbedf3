"""Axes of a study, their combinations, and solving them in chunks."""

from __future__ import annotations

import difflib
import fnmatch
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kshm.chain.solve import solve_chunks
from kshm.cycle.cycle import CycleRun
from kshm.engine.engine import Engine
from kshm.errors import FilmError
from kshm.results.chosen import ChosenQuantities, of_batch
from reports.inputs.fields import Field, Path, iter_fields, to_mapping
from reports.inputs.revisions import Revisions
from reports.inputs.sections.input_file import InputFile
from reports.inputs.solve_input import film_lost
from reports.inputs.units import number_text
from reports.model.evaluation import Evaluation
from reports.shared.errors import InputError, KshmError, Problem, one_line
from reports.tables.registry import kept_model

MAX_POINTS = 10_000_000
_EXAMPLE = "пример: --vary geometry.bore_mm=84:92:9"
Array = NDArray[np.float64]
NOT_FINITE = "расчёт не дал конечного числа"


@dataclass(frozen=True, slots=True)
class Axis:
    """One varied input: its key in the file, where it stands, its values in user units."""

    key: str
    paths: tuple[Path, ...]  # several of a key with a star
    title: str
    unit: str
    values: tuple[float | int, ...]


@dataclass(frozen=True, slots=True)
class Plan:
    """The base file's sections and the axes; the first axis changes fastest."""

    source: str
    raw: dict[str, Any]
    axes: tuple[Axis, ...]
    pairwise: bool

    @property
    def count(self) -> int:
        """Number of combinations."""
        if self.pairwise:
            return len(self.axes[0].values)
        return math.prod(len(axis.values) for axis in self.axes)

    def point(self, number: int) -> tuple[float | int, ...]:
        """Values of the axes in a combination, counted from 0."""
        if self.pairwise:
            return tuple(axis.values[number] for axis in self.axes)
        values = []
        for axis in self.axes:
            number, index = divmod(number, len(axis.values))
            values.append(axis.values[index])
        return tuple(values)

    def chunks(self, size: int) -> Iterator[list[tuple[float | int, ...]]]:
        """All combinations in order, so many at a time."""
        for begin in range(0, self.count, size):
            yield [self.point(number) for number in range(begin, min(begin + size, self.count))]


def make_plan(model: InputFile, source: str, vary: Sequence[str], *, pairwise: bool) -> Plan:
    """Return the plan of ``--vary`` texts.

    Raises:
        InputError: a text that is no range, a key that cannot be varied, too many points.
    """
    fields = {dotted(field.path): field for field in iter_fields(model)}
    axes = tuple(_axis(text, fields) for text in vary)
    plan = Plan(source, to_mapping(model), axes, pairwise)
    if len({axis.key for axis in axes}) < len(axes):
        raise _wrong(vary[-1], "ключ задан дважды", "оставьте один")
    if pairwise and len({len(axis.values) for axis in axes}) > 1:
        raise _wrong(vary[-1], "у ключей разное число значений, а задано --pairwise",
                     "задайте одинаковое число точек N")  # fmt: skip
    if plan.count > MAX_POINTS:
        raise _wrong(vary[-1], f"сочетаний {plan.count}, это больше {MAX_POINTS}",
                     "уменьшите число точек")  # fmt: skip
    return plan


def dotted(path: Path) -> str:
    """Return a path as ``--vary`` and ``[variants]`` name it: ``crankshaft.webs.1.mass_kg``."""
    return ".".join(str(part + 1) if isinstance(part, int) else part for part in path)


def _axis(text: str, fields: dict[str, Field]) -> Axis:
    key, equals, span = text.partition("=")
    key = key.strip()
    if not equals:
        raise _wrong(text, "нужно КЛЮЧ=ОТ:ДО:ЧИСЛО", _EXAMPLE)
    every = fields if "*" in key else ()
    meant = [fields[name] for name in every if fnmatch.fnmatchcase(name, key)]
    field = fields.get(key) or next(iter(meant), None)
    if field is None:
        similar = difflib.get_close_matches(key, list(fields), n=3, cutoff=0.5)
        hint = f"похожи: {', '.join(similar)}" if similar else "ключи смотрите в файле"
        raise _wrong(text, f"в файле нет ключа {one_line(key, 80)}", hint)
    if field.structural:
        raise _wrong(text, f"ключ {key} меняет строение расчёта", "сделайте отдельный файл")
    number = isinstance(field.value, int | float) and not isinstance(field.value, bool)
    if not number or field.choices is not None:
        raise _wrong(text, f"значение ключа {key} — не число", "выберите числовой ключ")
    values = _values(text, span, whole=isinstance(field.value, int))
    paths = tuple(each.path for each in meant) if key not in fields else (field.path,)
    return Axis(key, paths, field.title, field.unit, values)


def _values(text: str, span: str, *, whole: bool) -> tuple[float | int, ...]:
    parts = span.split(":")
    try:
        start, stop, count = float(parts[0]), float(parts[1]), int(parts[2])
        ok = len(parts) == 3 and math.isfinite(start) and math.isfinite(stop) and count >= 1
    except (ValueError, IndexError):
        ok = False
    if not ok:
        raise _wrong(text, "нужно ОТ:ДО:ЧИСЛО, числа с точкой", _EXAMPLE)
    if count > MAX_POINTS:
        raise _wrong(text, f"точек больше {MAX_POINTS}", "уменьшите их число")
    step = (stop - start) / max(1, count - 1)
    values = [start + step * i for i in range(count)]
    if count > 1:
        values[-1] = stop
    # 84 + 0.1·3 reads 84.30000000000001: round off what the division left.
    tidy = [float(f"{value:.12g}") for value in values]
    if whole and all(value.is_integer() for value in tidy):
        return tuple(int(value) for value in tidy)
    return tuple(tidy)


def span_text(axis: Axis) -> str:
    """Return the values of an axis in words."""
    first, last = (number_text(float(value)) for value in (axis.values[0], axis.values[-1]))
    unit = f" {axis.unit}" if axis.unit else ""
    return f"{axis.title}: {first}…{last}{unit}, точек {len(axis.values)}"


def _wrong(text: str, problem: str, hint: str) -> InputError:
    return InputError(Problem(f"--vary {one_line(text, 80)}", problem, hint))


@dataclass(frozen=True, slots=True)
class SweepTask:
    """A chunk of combinations with all that solving them needs, here or on another machine."""

    raw: dict[str, Any]
    source: str
    paths: tuple[tuple[Path, ...], ...]  # of each value of a row
    wanted: ChosenQuantities
    rows: list[tuple[float | int, ...]]


@dataclass(frozen=True, slots=True)
class Chunk:
    """Combinations and their results; ``errors`` says why a row has none."""

    rows: list[tuple[float | int, ...]]
    values: dict[str, Array]
    errors: list[str] = field(default_factory=list)


def tasks(plan: Plan, quantities: ChosenQuantities, size: int) -> Any:  # noqa: ANN401
    """Return the tasks of a plan in order, made as they are needed."""
    paths = tuple(axis.paths for axis in plan.axes)
    return (SweepTask(plan.raw, plan.source, paths, quantities, rows) for rows in plan.chunks(size))


def solved(task: SweepTask) -> Chunk:
    """Every combination is checked like an input file; those that fail keep their reason."""
    errors = [""] * len(task.rows)
    models, engines, indices = _engines(task, errors)
    cycles = [cycle for _, cycle in engines]
    values = {name: np.full(len(task.rows), np.nan) for name in task.wanted.names}
    begin = 0
    for raw in solve_chunks(engine for engine, _ in engines):
        these = slice(begin, begin + len(raw.batch.engines))
        begin, here = these.stop, indices[these]
        numbers_of, reasons = of_batch(raw, task.wanted, cycles[these])
        for name, numbers in numbers_of.items():
            values[name][here] = numbers
        for name, numbers in _of_own(models[these], task.wanted).items():
            values[name][here] = numbers
        for row, reason in zip(here, reasons, strict=True):
            errors[row] = _in_words(reason)
    finite = np.all([np.isfinite(each) for each in values.values()], axis=0)
    for row in indices:
        if not finite[row]:
            errors[row] = errors[row] or NOT_FINITE
    return Chunk(task.rows, values, errors)


def _in_words(reason: KshmError | None) -> str:
    if isinstance(reason, FilmError):
        return film_lost(reason)
    return reason.lines()[0] if reason else ""


def _of_own(models: Sequence[InputFile], quantities: ChosenQuantities) -> dict[str, Array]:
    """Values of own books, by their formulas for each engine."""
    runs = [Evaluation(kept_model(model)) for model in models if quantities.own]
    return {name: np.array([float(run.value(name)) for run in runs]) for name in quantities.own}


def _engines(
    task: SweepTask, errors: list[str]
) -> tuple[list[InputFile], list[tuple[Engine, CycleRun | None]], list[int]]:
    revisions = Revisions(task.raw, task.source, [path for each in task.paths for path in each])
    repeated = [len(paths) for paths in task.paths]
    models: list[InputFile] = []
    engines: list[tuple[Engine, CycleRun | None]] = []
    indices: list[int] = []
    for number, row in enumerate(task.rows):
        try:
            values = (value for value, count in zip(row, repeated, strict=True)
                      for value in [value] * count)  # fmt: skip
            engines.append(revisions.engine(list(values)))
        except KshmError as error:
            errors[number] = error.lines()[0]
        else:
            models.append(revisions.revised)
            indices.append(number)
    return models, engines, indices
