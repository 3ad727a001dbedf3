"""Variants of a base engine: parameters drawn from ranges, repeatable, no two alike."""

from __future__ import annotations

import copy
import itertools
import json
import math
import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from reports.inputs.diagram_file import with_points
from reports.inputs.fields import set_value
from reports.inputs.load import Loaded, load_mapping, load_text, tables_of
from reports.inputs.ranges import SECTION, Range, read_ranges, split_ranges
from reports.inputs.source import read_text
from reports.shared.errors import InputError, Problem

TRIES = 300  # random draws for one student before all combinations are tried
MAX_COMBINATIONS = 20_000


@dataclass(frozen=True, slots=True)
class Base:
    """A base file: its sections as they are, and its ranges."""

    source: str
    raw: dict[str, Any]
    ranges: tuple[Range, ...]
    loaded: Loaded


@dataclass(frozen=True, slots=True)
class Variant:
    """One variant: the sections of its input file and the drawn values by key."""

    raw: dict[str, Any]
    drawn: dict[str, float | int | str]
    loaded: Loaded

    @property
    def key(self) -> str:
        """What tells variants apart."""
        return json.dumps(self.drawn, ensure_ascii=False, sort_keys=True)


def load_base(path: Path, beside: Path | None = None) -> Base:
    """A base file with its section [variants], or with the ranges in a file beside it.

    Raises:
        InputError: everything that is wrong with it.
    """
    text = read_text(path)
    loaded = load_text(text, source=path.name, folder=path.parent)
    raw, section = split_ranges(tables_of(text, source=path.name))
    raw = with_points(raw, path.parent, path.name).raw
    source = path.name
    if beside is not None:
        if section is not None:
            what = "диапазоны заданы и в разделе [variants], и ключом --ranges"
            raise InputError(Problem(path.name, what, "оставьте одно"))
        data, source = tables_of(read_text(beside), source=beside.name), beside.name
        section = data.get(SECTION, data)
    if section is None:
        what = "нет раздела [variants] с диапазонами параметров"
        hint = 'пример: [variants] и строка "geometry.bore_mm" = {min = 84, max = 92, step = 1}'
        raise InputError(Problem(path.name, what, hint))
    ranges, problems = read_ranges(section, raw, source)
    if problems:
        raise InputError(problems)
    return Base(path.name, raw, tuple(ranges), loaded)


def draw_variants(base: Base, students: Sequence[str], seed: int) -> list[Variant]:
    """A variant for each student, the same for the same seed and student.

    Raises:
        InputError: the ranges do not give enough different variants that pass the check.
    """
    total = math.prod(len(item.values) for item in base.ranges)
    if total < len(students):
        what = f"вариантов в диапазонах {total}, а студентов {len(students)}"
        raise InputError(Problem(base.source, what, "расширьте диапазоны или уменьшите шаги"))
    taken: set[str] = set()
    variants: list[Variant] = []
    for student in students:
        variant = _draw(base, random.Random(f"{seed}:{student}"), taken)
        if isinstance(variant, str):
            what = (
                f"различных вариантов, проходящих проверку, хватило только на {len(variants)} "
                f"из {len(students)} студентов"
            )
            what += f"; один из отказов — {variant}" if variant else ""
            raise InputError(Problem(base.source, what, "уменьшите шаги или приблизьте их к базе"))
        taken.add(variant.key)
        variants.append(variant)
    return variants


def _draw(base: Base, rng: random.Random, taken: set[str]) -> Variant | str:
    """A variant that nobody has, or why one of those tried is none."""
    why = ""
    for values in _values(base.ranges, rng):
        variant = _variant(base, values, taken)
        if isinstance(variant, Variant):
            return variant
        why = why or variant
    return why


def _values(ranges: Sequence[Range], rng: random.Random) -> Iterator[Sequence[float | int | str]]:
    """Values by chance, then all there are."""
    for _ in range(TRIES):
        yield [rng.choice(item.values) for item in ranges]
    if math.prod(len(item.values) for item in ranges) <= MAX_COMBINATIONS:
        combinations = list(itertools.product(*(item.values for item in ranges)))
        rng.shuffle(combinations)
        yield from combinations


def _variant(base: Base, values: Sequence[float | int | str], taken: set[str]) -> Variant | str:
    """The variant, or why the check does not accept it; nothing where it is taken."""
    drawn = {item.key: value for item, value in zip(base.ranges, values, strict=True)}
    if json.dumps(drawn, ensure_ascii=False, sort_keys=True) in taken:
        return ""
    raw = copy.deepcopy(base.raw)
    for item, value in zip(base.ranges, values, strict=True):
        set_value(raw, item.path, value)
    try:
        loaded = load_mapping(raw, source=base.source)
    except InputError as error:
        return error.lines()[0]
    # A variant may be as odd as its base, but not odder.
    known = {problem.where for problem in base.loaded.warnings}
    odd = [problem.line() for problem in loaded.warnings if problem.where not in known]
    return odd[0] if odd else Variant(raw, drawn, loaded)
