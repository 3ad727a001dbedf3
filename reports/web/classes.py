"""Classes on the disk: issued, handed in, graded and decided by the commands.

A class is a folder with an unguessable name, and a job of its own queue.
"""

from __future__ import annotations

import secrets
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from itsdangerous import BadData, URLSafeSerializer
from starlette.exceptions import HTTPException

from reports.grading.batch.grade import PAGES
from reports.grading.issuing.register import FILE, Issued, load_register
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import make_dir, read_json, write_json, write_text, write_zip
from reports.web.jobs import Queue

GRADE_S = 3600.0


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
        return load_register(path).books if (path / FILE).exists() else ()

    @property
    def rows(self) -> list[dict[str, Any]]:
        """Rows of the gradebook, once there are any."""
        return list(read_json(self.folder / "results/summary.json").get("rows", ()))

    def issued(self, book: Issued) -> Path:
        """A student's work-book."""
        return self.folder / "issued" / book.folder / book.file

    def work(self, book: Issued) -> Path:
        """Where a student's own upload lies."""
        return self.folder / "works" / f"{book.folder}.xlsx"

    def files(self) -> dict[str, Path]:
        """All that an instructor may take or look at by its name: what grading has made."""
        results = self.folder / "results"
        found = (*results.glob("[!.]*.*"), *results.glob(f"{PAGES}/*.html"))
        return {path.relative_to(results).as_posix(): path for path in found
                if path.suffix != ".json"}  # fmt: skip

    def issued_zip(self) -> Path:
        """All work-books that were issued, each in its folder."""
        target = self.folder / "issued.zip"
        if not target.exists() and (books := self.books):
            write_zip(target, {f"{each.folder}/{each.file}": self.issued(each) for each in books})
        return target


class Classes(Queue):
    """All classes of a server; grading takes all processors by itself, so one at a time.

    ``secret`` makes students' links unguessable, a cluster at ``dask`` grades.
    """

    def __init__(self, folder: Path, secret: bytes, dask: str | None) -> None:
        super().__init__(folder, at_once=1, timeout_s=GRADE_S)
        self.signer, self.dask = URLSafeSerializer(secret, "student"), dask

    def all(self) -> list[Class]:
        """Every class, the newest first."""
        found = [Class(path.parent) for path in self.folder.glob("*/about.json")]
        return sorted(found, key=lambda each: str(each.about.get("date")), reverse=True)

    def find(self, name: str) -> Class:
        """A class by the name of its folder; HTTPException if there is none."""
        for path in self.folder.glob("*/about.json"):  # never a path from the name
            if path.parent.name == name:
                return Class(path.parent)
        raise HTTPException(404, "нет такой группы")

    def issue(self, seed: int, title: str, files: Mapping[str, str]) -> Class:
        """A new class, its books being issued out of base, roster and rubric."""
        made = Class(self.folder / secrets.token_hex(8))
        make_dir(made.folder / "works")
        for file, text in files.items():
            write_text(made.folder / file, text)
        date = datetime.now().isoformat(timespec="seconds")
        about = {"title": one_line(title, 120) or "Группа", "open": False, "date": date}
        write_json(made.folder / "about.json", about)
        more = ["--rubric", "rubric.toml"] if "rubric.toml" in files else []
        command = ["issue", "base.toml", "--roster", "roster.csv", "-o", "issued",
                   "--seed", str(seed), "--secret", "secret.key", *more]  # fmt: skip
        self.put(made.folder.name, command)
        return made

    def grade(self, each: Class, decision: tuple[str, ...] = ()) -> None:
        """Begin to grade what was handed in, or to decide: who, what, points, remark.

        Raises:
            InputError: nothing was handed in, or something is being done already.
        """
        name, folder = each.folder.name, each.folder
        if name in self.waiting or name in self.running:
            raise InputError(Problem("", "группа занята", "дождитесь окончания"))
        own, archive = sorted((folder / "works").glob("*.xlsx")), folder / "moodle.zip"
        if not own and not archive.exists():
            raise InputError(Problem("", "нет ни одной работы", "загрузите архив"))
        command = ["grade", "issued", "submitted.zip", "-o", "results", "--secret", "secret.key"]
        if decision:
            command += ["--decide", *decision, "--author", "преподаватель"]
        else:
            works = {f"страница/{path.name}": path for path in own}
            write_zip(folder / "submitted.zip", works, archive)
        if (folder / "worksheet.csv").exists():
            command += ["--moodle", "worksheet.csv"]
        self.put(name, command + (["--dask", self.dask] if self.dask else []))

    def link(self, each: Class, book: Issued) -> str:
        """The word of a student's own page."""
        return str(self.signer.dumps([each.folder.name, book.number]))

    def student(self, link: str) -> tuple[Class, Issued]:
        """The class and the issued book that a link belongs to; HTTPException if to none."""
        try:
            name, number = self.signer.loads(link)
            each = self.find(name)
            return each, next(book for book in each.books if book.number == number)
        except (BadData, StopIteration):
            raise HTTPException(404, "нет такой страницы") from None
