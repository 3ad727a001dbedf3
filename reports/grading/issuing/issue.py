"""Issue work-books to a class: draw variants, write books and register."""

from __future__ import annotations

import copy
import hashlib
import itertools
import json
import math
import random
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tomlkit

from reports.exports.department_chapters import refuse_faults
from reports.grading.issuing.assignment import Assignment, assignment_of
from reports.grading.issuing.handout import check_for_leaks, handout_bytes
from reports.grading.issuing.names import latin
from reports.grading.issuing.register import (
    FILE,
    Issued,
    Register,
    kept_secret,
    secret_path,
    ticket_of,
)
from reports.grading.issuing.reissue import reissue
from reports.grading.issuing.roster import Student, roster_of
from reports.grading.issuing.rubric import Rubric, load_rubric
from reports.inputs.department_chapters import with_books
from reports.inputs.diagram_file import with_points
from reports.inputs.fields import iter_fields, set_value, tables_shape
from reports.inputs.load import Loaded, load_mapping, load_text, tables_of
from reports.inputs.normalise import read_text
from reports.inputs.ranges import SECTION, ParameterRange, read_ranges, split_ranges
from reports.shared.background import processors
from reports.shared.errors import InputError, Problem
from reports.shared.files import atomic_dir
from reports.shared.parallel_map import in_order
from reports.shared.progress import Progress
from reports.tables.registry import build_model

TRIES = 300  # random draws for one student before all combinations are tried
MAX_COMBINATIONS = 20_000


@dataclass(frozen=True, slots=True)
class Base:
    """A base file: its sections as they are, and its ranges."""

    source: str
    raw: dict[str, Any]
    ranges: tuple[ParameterRange, ...]
    loaded: Loaded


@dataclass(frozen=True, slots=True)
class Variant:
    """One variant: the sections of its input file and the drawn values by key."""

    raw: dict[str, Any]
    drawn: dict[str, float | int | str]
    loaded: Loaded

    @property
    def key(self) -> str:
        """Identity of a variant."""
        return variant_key(self.drawn)


def load_base(path: Path, beside: Path | None = None) -> Base:
    """Return a base file with its section [variants], or with the ranges in a file beside it.

    Raises:
        InputError: everything that is wrong with it.
    """
    text = read_text(path)
    loaded = load_text(text, source=path.name, folder=path.parent)
    raw, section = split_ranges(tables_of(text, source=path.name))
    raw, _ = with_books(raw, path.parent, path.name)
    raw = with_points(raw, path.parent, path.name).raw
    refuse_faults(loaded.model)
    source = path.name
    if beside is not None:
        if section is not None:
            problem = "диапазоны заданы и в разделе [variants], и ключом --ranges"
            raise InputError(Problem(path.name, problem, "оставьте одно"))
        data, source = tables_of(read_text(beside), source=beside.name), beside.name
        section = data.get(SECTION, data)
    if section is None:
        problem = "нет раздела [variants] с диапазонами параметров"
        hint = 'пример: [variants] и строка "geometry.bore_mm" = {min = 84, max = 92, step = 1}'
        raise InputError(Problem(path.name, problem, hint))
    ranges, problems = read_ranges(section, raw, source)
    if problems:
        raise InputError(problems)
    return Base(path.name, raw, tuple(ranges), loaded)


def variant_key(drawn: Mapping[str, float | int | str]) -> str:
    """Identity of a variant: its drawn values."""
    return json.dumps(drawn, ensure_ascii=False, sort_keys=True)


def draw_variants(
    base: Base, students: Sequence[str], seed: int, taken: Iterable[str] = ()
) -> list[Variant]:
    """Return a variant for each student, the same for the same seed and student; none is ``taken``.

    Raises:
        InputError: the ranges do not give enough different variants that pass the check.
    """
    taken = set(taken)
    total, count = math.prod(len(item.values) for item in base.ranges), len(students) + len(taken)
    if total < count:
        problem = f"вариантов в диапазонах {total}, а студентов {count}"
        raise InputError(Problem(base.source, problem, "расширьте диапазоны или уменьшите шаги"))
    variants: list[Variant] = []
    for student in students:
        variant = _draw(base, random.Random(f"{seed}:{student}"), taken)
        if isinstance(variant, str):
            problem = (
                f"различных вариантов, проходящих проверку, хватило только на {len(variants)} "
                f"из {len(students)} студентов"
            )
            problem += f"; один из отказов — {variant}" if variant else ""
            raise InputError(
                Problem(base.source, problem, "уменьшите шаги или приблизьте их к базе")
            )
        taken.add(variant.key)
        variants.append(variant)
    return variants


def _draw(base: Base, rng: random.Random, taken: set[str]) -> Variant | str:
    """Return a variant that nobody has, or why one of those tried is none."""
    why = ""
    for values in _values(base.ranges, rng):
        variant = _variant(base, values, taken)
        if isinstance(variant, Variant):
            return variant
        why = why or variant
    return why


def _values(
    ranges: Sequence[ParameterRange], rng: random.Random
) -> Iterator[Sequence[float | int | str]]:
    """Values by chance, then all there are."""
    for _ in range(TRIES):
        yield [rng.choice(item.values) for item in ranges]
    if math.prod(len(item.values) for item in ranges) <= MAX_COMBINATIONS:
        combinations = list(itertools.product(*(item.values for item in ranges)))
        rng.shuffle(combinations)
        yield from combinations


def _variant(base: Base, values: Sequence[float | int | str], taken: set[str]) -> Variant | str:
    """Return the variant, or why the check does not accept it; nothing where it is taken."""
    drawn = {item.key: value for item, value in zip(base.ranges, values, strict=True)}
    if variant_key(drawn) in taken:
        return ""
    raw = copy.deepcopy(base.raw)
    for item, value in zip(base.ranges, values, strict=True):
        set_value(raw, item.path, value)
    try:
        loaded = load_mapping(raw, source=base.source)
    except InputError as error:
        return error.lines()[0]
    # A variant may be as odd as its base, but not odder.
    places_warned = {problem.where for problem in base.loaded.warnings}
    odd = [problem.line() for problem in loaded.warnings if problem.where not in places_warned]
    return odd[0] if odd else Variant(raw, drawn, loaded)


# --- the class -----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Result:
    """Result of an issue; ``new_secret`` where one had to be made.

    ``kept`` is how many work-books are those of an earlier issue, ``left`` which lines of the
    list have a name and are no student.
    """

    register: Register
    folder: Path
    new_secret: Path | None
    kept: int = 0
    left: tuple[str, ...] = ()


def issue(
    base_file: Path,
    roster_file: Path,
    folder: Path,
    *,
    seed: int,
    rubric_file: Path | None = None,
    ranges_file: Path | None = None,
    secret_file: Path | None = None,
    jobs: int = 1,
    tries: int | None = None,
) -> Result:
    """Issue a variant to each student; ``jobs`` processes write the books, 0 one a processor.

    ``tries`` takes the place of the rubric's.

    Raises:
        InputError: everything that is wrong with the files.
        OutputError: the folder cannot be written.
    """
    base = load_base(base_file, ranges_file)
    roster = roster_of(roster_file)
    rubric = load_rubric(rubric_file)
    if tries is not None:
        attempts = rubric.attempts.model_copy(update={"tries": tries})
        rubric = rubric.model_copy(update={"attempts": attempts})
    source = rubric_file.name if rubric_file is not None else "рубрика по умолчанию"
    assignment_of(build_model(base.loaded.model), rubric, source)
    _refuse_foreign(folder)
    for read in (base_file, *base.loaded.beside, roster_file, rubric_file, ranges_file):
        _refuse_own(read, folder)
    batch = _batch(base, seed)
    secret_at = secret_path(secret_file)
    _refuse_inside(secret_at, folder)
    fresh = not secret_at.exists()
    again = reissue(folder, batch, secret_at, roster.students)
    taken = [variant_key(book.drawn) for book in (*again.kept, *again.former)]
    variants = draw_variants(base, [student.id for student in again.newcomers], seed, taken)
    secret = kept_secret(secret_at)
    newcomers = enumerate(zip(again.newcomers, variants, strict=True), again.first_number)
    books = (*again.kept, *(_issued(number, *one, secret, batch) for number, one in newcomers))
    register = Register(batch, seed, base.source, rubric, books, again.former, again.identity)
    _write_all(folder, register, source, jobs or processors())
    return Result(register, folder, secret_at if fresh else None, len(again.kept), roster.left)


def _write_all(folder: Path, register: Register, source: str, jobs: int) -> None:
    """Write the work-books and the register in place of what the folder held."""
    count = len(register.books)
    with Progress("Выдача вариантов") as progress, atomic_dir(folder) as temporary:
        files = in_order(Handouts(register.rubric, source), register.books, jobs=min(jobs, count))
        for number, (book, data) in enumerate(zip(register.books, files, strict=True), 1):
            progress.step(f"Выдача вариантов: {number} из {count}")
            _write(temporary, book, data)
        (temporary / FILE).write_text(register.json_text(), encoding="utf-8")
        (temporary / "register.csv").write_text(register.csv_text(), encoding="utf-8")


@dataclass
class Handouts:
    """Maker of work-books that tell no answers; most of one class have the same tables."""

    rubric: Rubric
    source: str
    _first: Assignment | None = None

    def __call__(self, book: Issued) -> bytes:
        """Return the work-book of a student.

        Raises:
            InputError: it would hold answers.
        """
        assignment = assignment_for(book, self.rubric, self._first)
        self._first = self._first or assignment
        data = handout_bytes(assignment, book.ticket)
        check_for_leaks(data, assignment, self.source)
        return data


def assignment_for(book: Issued, rubric: Rubric, like: Assignment | None = None) -> Assignment:
    """Return tables of an issued work-book; ``like`` is another student's, for the same rubric."""
    titled = _with_title(book.raw, book.student, book.number)
    model = load_mapping(titled, source=book.student.full).model
    if like is not None:
        fields = tuple(iter_fields(model))
        if tables_shape(fields) == tables_shape(like.model.inputs):
            return like.with_model(like.model.with_inputs(model, fields))
    return assignment_of(build_model(model), rubric)


def _with_title(raw: dict[str, Any], student: Student, number: int) -> dict[str, Any]:
    report = dict(raw.get("report", {}))
    report |= {"student": student.full, "group": student.group, "variant": str(number)}
    return {**raw, "report": report}


def _issued(number: int, student: Student, variant: Variant, secret: bytes, batch: str) -> Issued:
    stem = f"{number:02d}-{_slug(student.full)}"
    file = f"{stem}.xlsx"
    identifier = ticket_of(secret, batch, student, file, variant.raw)
    return Issued(number, student, stem, file, identifier, variant.drawn, variant.raw)


def _write(folder: Path, book: Issued, data: bytes) -> None:
    folder_of = folder / book.folder
    folder_of.mkdir()
    (folder_of / book.file).write_bytes(data)
    text = tomlkit.dumps(_with_title(book.raw, book.student, book.number))
    (folder_of / f"{book.folder}.toml").write_text(text, encoding="utf-8")


def _slug(name: str) -> str:
    """Return a file name that no system minds."""
    return re.sub(r"[^a-z0-9]+", "-", latin(name)).strip("-")[:60] or "student"


def _batch(base: Base, seed: int) -> str:
    """Identity of an issue."""
    text = tomlkit.dumps(base.raw) + repr([(r.key, r.values) for r in base.ranges]) + str(seed)
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def _refuse_foreign(folder: Path) -> None:
    if folder.is_dir() and any(folder.iterdir()) and not (folder / FILE).exists():
        problem = "в папке есть чужие файлы"
        raise InputError(Problem(str(folder), problem, "укажите пустую папку ключом -o"))


def _refuse_own(read: Path | None, folder: Path) -> None:
    """Refuse a source inside the folder that a new issue replaces."""
    if read is not None and folder.resolve() in read.resolve().parents and folder.is_dir():
        problem = "файл лежит в папке выдачи и пропал бы вместе с прежней выдачей"
        raise InputError(Problem(str(read), problem, "укажите другую папку ключом -o"))


def _refuse_inside(secret: Path, folder: Path) -> None:
    """Refuse a secret that would go out with the work-books."""
    if folder.resolve() in secret.resolve().parents:
        problem = "секрет не должен лежать в папке выдачи"
        raise InputError(Problem(str(secret), problem, "укажите другое место ключом --secret"))
