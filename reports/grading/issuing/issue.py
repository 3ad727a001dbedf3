"""What ``kshm issue`` does: variants, input files, work-books and the register."""

from __future__ import annotations

import hashlib
import re
import unicodedata
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tomlkit

from reports.grading.issuing.assignment import Assignment, assignment_of
from reports.grading.issuing.handout import handout_bytes
from reports.grading.issuing.leaks import check_for_leaks
from reports.grading.issuing.register import FILE, Issued, Register, ticket_of
from reports.grading.issuing.roster import Student, read_roster
from reports.grading.issuing.rubric import Rubric, load_rubric
from reports.grading.issuing.ticket import kept_secret, secret_path
from reports.grading.issuing.variants import Base, Variant, draw_variants, load_base
from reports.inputs.fields import iter_fields, tables_shape
from reports.inputs.load import load_mapping
from reports.shared.errors import InputError, Problem
from reports.shared.files import atomic_dir
from reports.shared.progress import Progress
from reports.tables.registry import build_model

# Russian letters and those of neighbours.
_LATIN = dict(
    zip(
        "абвгдеёжзийклмнопрстуфхцчшщъыьэюя",
        ("a", "b", "v", "g", "d", "e", "e", "zh", "z", "i", "y", "k", "l", "m", "n", "o", "p", "r",
         "s", "t", "u", "f", "kh", "ts", "ch", "sh", "shch", "", "y", "", "e", "yu", "ya"),
        strict=True,
    )
) | dict(zip("іїєґўәғқңөұүһҳҷҗӯ", "iieguagknouuhhjju", strict=True))  # fmt: skip


@dataclass(frozen=True, slots=True)
class Result:
    """What was written; ``new_secret`` where one had to be made."""

    register: Register
    folder: Path
    new_secret: Path | None


def issue(
    base_file: Path,
    roster_file: Path,
    folder: Path,
    *,
    seed: int,
    rubric_file: Path | None = None,
    ranges_file: Path | None = None,
    secret_file: Path | None = None,
) -> Result:
    """Issue a variant to each student.

    Raises:
        InputError: everything that is wrong with the files.
        OutputError: the folder cannot be written.
    """
    base = load_base(base_file, ranges_file)
    students = read_roster(roster_file)
    rubric = load_rubric(rubric_file)
    source = rubric_file.name if rubric_file is not None else "рубрика по умолчанию"
    assignment_of(build_model(base.loaded.model), rubric, source)
    _refuse_foreign(folder)
    for read in (base_file, *base.loaded.beside, roster_file, rubric_file, ranges_file):
        _refuse_own(read, folder)
    variants = draw_variants(base, [student.id for student in students], seed)
    place = secret_path(secret_file)
    _refuse_inside(place, folder)
    fresh = not place.exists()
    secret = kept_secret(place)
    batch = _batch(base, seed)
    with Progress("Выдача вариантов") as progress, atomic_dir(folder) as temporary:
        books = []
        first: Assignment | None = None
        for number, (student, variant) in enumerate(zip(students, variants, strict=True), 1):
            progress.step(f"Выдача вариантов: {number} из {len(students)}")
            book = _issued(number, student, variant, secret, batch)
            assignment = assignment_for(book, rubric, first)
            first = first or assignment
            _write(temporary, book, assignment, source)
            books.append(book)
        register = Register(batch, seed, base.source, rubric, tuple(books))
        (temporary / FILE).write_text(register.json_text(), encoding="utf-8")
        (temporary / "register.csv").write_text(register.csv_text(), encoding="utf-8")
    return Result(register, folder, place if fresh else None)


def assignment_for(book: Issued, rubric: Rubric, like: Assignment | None = None) -> Assignment:
    """The tables of an issued work-book; ``like`` is another student's, for the same rubric."""
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
    made = ticket_of(secret, batch, student, file, variant.raw)
    return Issued(number, student, stem, file, made, variant.drawn, variant.raw)


def _write(folder: Path, book: Issued, assignment: Assignment, source: str) -> None:
    own = folder / book.folder
    own.mkdir()
    data = handout_bytes(assignment, book.ticket)
    check_for_leaks(data, assignment, source)
    (own / book.file).write_bytes(data)
    text = tomlkit.dumps(_with_title(book.raw, book.student, book.number))
    (own / f"{book.folder}.toml").write_text(text, encoding="utf-8")


def _slug(name: str) -> str:
    """A file name that no system minds."""
    return re.sub(r"[^a-z0-9]+", "-", latin(name)).strip("-")[:60] or "student"


def latin(text: str) -> str:
    """Small letters, Cyrillic ones spelt in Latin, without accents."""
    plain = unicodedata.normalize("NFC", text.casefold())
    spelled = "".join(_LATIN.get(char, char) for char in plain)
    return "".join(
        char for char in unicodedata.normalize("NFKD", spelled) if not unicodedata.combining(char)
    )


def _batch(base: Base, seed: int) -> str:
    """What tells one issue from another."""
    text = tomlkit.dumps(base.raw) + repr([(r.key, r.values) for r in base.ranges]) + str(seed)
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def _refuse_foreign(folder: Path) -> None:
    if folder.is_dir() and any(folder.iterdir()) and not (folder / FILE).exists():
        what = "в папке есть чужие файлы"
        raise InputError(Problem(str(folder), what, "укажите пустую папку ключом -o"))


def _refuse_own(read: Path | None, folder: Path) -> None:
    """A new issue takes the folder's place: what it is made from must not lie there."""
    if read is not None and folder.resolve() in read.resolve().parents and folder.is_dir():
        what = "файл лежит в папке выдачи и пропал бы вместе с прежней выдачей"
        raise InputError(Problem(str(read), what, "укажите другую папку ключом -o"))


def _refuse_inside(secret: Path, folder: Path) -> None:
    """The secret must not go out with the work-books."""
    if folder.resolve() in secret.resolve().parents:
        what = "секрет не должен лежать в папке выдачи"
        raise InputError(Problem(str(secret), what, "укажите другое место ключом --secret"))
