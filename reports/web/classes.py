"""Classes on the disk: issued, handed in, graded and decided by the commands.

A class is a folder with an unguessable name, and a job of its own queue.
"""

from __future__ import annotations

import secrets
import shutil
import zipfile
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from itsdangerous import BadData, URLSafeSerializer
from starlette.exceptions import HTTPException

from reports.grading.issuing.register import Issued, load_register
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import atomic_path, make_dir, write_text
from reports.web.jobs import Queue, read_json, write_json

GRADE_S = 3600.0
RESULTS = ("gradebook.xlsx", "gradebook.csv", "moodle.csv", "moodle-worksheet.csv",
           "moodle-feedback.zip", "summary.html")  # fmt: skip


@dataclass(frozen=True, slots=True)
class Class:
    """A class by its folder."""

    folder: Path

    @property
    def about(self) -> dict[str, Any]:
        """Title, date, whether pages are open to their students."""
        return read_json(self.folder / "about.json")

    @property
    def books(self) -> tuple[Issued, ...]:
        """The books, once they are issued."""
        path = self.folder / "issued"
        return load_register(path).books if (path / "register.json").exists() else ()

    @property
    def results(self) -> Path:
        """The folder of all that grading has made."""
        return self.folder / "results"

    @property
    def rows(self) -> list[dict[str, Any]]:
        """Rows of the gradebook, once there are any."""
        found: list[dict[str, Any]] = read_json(self.results / "summary.json").get("rows", [])
        return found

    def row(self, number: int) -> dict[str, Any]:
        """The row of a student, empty before the work is graded."""
        return next((row for row in self.rows if row["number"] == number), {})

    def page(self, number: int) -> Path | None:
        """The page of a student's work: one that the gradebook names itself."""
        name = self.row(number).get("page")
        return self.results / name if name else None

    def issued(self, book: Issued) -> Path:
        """A student's work-book."""
        return self.folder / "issued" / book.folder / book.file

    def issued_zip(self) -> Path:
        """All work-books that were issued, each in its folder."""
        target = self.folder / "issued.zip"
        if not target.exists() and (books := self.books):
            _pack(target, ((self.issued(each), f"{each.folder}/{each.file}") for each in books))
        return target

    def work(self, book: Issued) -> Path:
        """Where a student's own upload lies."""
        return self.folder / "works" / f"{book.folder}.xlsx"

    def keep_open(self, is_open: bool) -> None:
        """Say whether students see their own pages."""
        write_json(self.folder / "about.json", {**self.about, "open": is_open})


def _pack(target: Path, files: Iterable[tuple[Path, str]], base: Path | None = None) -> None:
    """Pack files by name, added to those of another archive."""
    with atomic_path(target) as part:
        if base is not None and base.exists():
            shutil.copyfile(base, part)
        with zipfile.ZipFile(part, "a", zipfile.ZIP_DEFLATED) as archive:
            for path, name in files:
                archive.write(path, name)


class Classes(Queue):
    """All classes of a server; grading takes all processors by itself, so one at a time.

    Args:
        folder: where they lie.
        secret: what makes students' links unguessable.
        dask: address of a cluster that grades.
    """

    def __init__(self, folder: Path, secret: bytes, dask: str | None) -> None:
        super().__init__(folder, at_once=1, timeout_s=GRADE_S)
        self.signer, self.dask = URLSafeSerializer(secret, "student"), dask

    def all(self) -> list[Class]:
        """Every class, the newest first."""
        found = [Class(path.parent) for path in self.folder.glob("*/about.json")]
        return sorted(found, key=lambda each: str(each.about.get("date")), reverse=True)

    def find(self, name: str) -> Class:
        """A class by the name of its folder.

        Raises:
            HTTPException: there is none.
        """
        for path in self.folder.glob("*/about.json"):  # never a path from the name
            if path.parent.name == name:
                return Class(path.parent)
        raise HTTPException(404, "нет такой группы")

    def issue(self, seed: int, title: str, base: str, roster: str, rubric: str) -> Class:
        """A new class, its books being issued."""
        made = Class(self.folder / secrets.token_hex(8))
        make_dir(made.folder / "works")
        for file, text in (("base.toml", base), ("roster.csv", roster), ("rubric.toml", rubric)):
            if text.strip():
                write_text(made.folder / file, text)
        more = ["--rubric", "rubric.toml"] if rubric.strip() else []
        date = datetime.now().isoformat(timespec="seconds")
        about = {"title": one_line(title, 120) or "Группа", "open": False, "date": date}
        write_json(made.folder / "about.json", about)
        command = ["issue", "base.toml", "--roster", "roster.csv", "-o", "issued",
                   "--seed", str(seed), "--secret", "secret.key", *more]  # fmt: skip
        self.put(made.folder.name, command)
        return made

    def grade(self, each: Class, decision: tuple[str, ...] = ()) -> None:
        """Begin to grade what was handed in; what was graded before, the command takes over.

        Args:
            each: the class.
            decision: who, what, points, remark, if the instructor has decided.

        Raises:
            InputError: nothing was, or something is being done already.
        """
        name, folder = each.folder.name, each.folder
        if name in self.waiting or name in self.running:
            raise InputError(Problem("", "группа занята", "дождитесь окончания"))
        works = sorted((folder / "works").glob("*.xlsx"))
        if not works and not (folder / "moodle.zip").exists():
            raise InputError(Problem("", "нет ни одной работы", "загрузите архив"))
        if not decision:
            own = ((path, f"страница/{path.name}") for path in works)
            _pack(folder / "submitted.zip", own, folder / "moodle.zip")
        word = ["--decide", *decision, "--author", "преподаватель"] if decision else []
        worksheet = ["--moodle", "worksheet.csv"] if (folder / "worksheet.csv").exists() else []
        far = ["--dask", self.dask] if self.dask else []
        command = ["grade", "issued", "submitted.zip", "-o", "results", "--secret", "secret.key"]
        self.put(name, [*command, *worksheet, *far, *word])

    def link(self, each: Class, number: int) -> str:
        """The word of a student's own page."""
        return str(self.signer.dumps([each.folder.name, number]))

    def student(self, link: str) -> tuple[Class, Issued]:
        """The class and the issued book that a link belongs to.

        Raises:
            HTTPException: there are none.
        """
        try:
            name, number = self.signer.loads(link)
            each = self.find(name)
            return each, next(book for book in each.books if book.number == number)
        except (BadData, StopIteration):
            raise HTTPException(404, "нет такой страницы") from None
