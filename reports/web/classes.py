"""Classes on the disk: issued, handed in, graded and decided by the commands.

A class is a folder with an unguessable name.  ``state.json`` says what is being done to it;
a server that starts does it again.
"""

from __future__ import annotations

import asyncio
import hashlib
import hmac
import re
import secrets
import shutil
import zipfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from reports.grading.issuing.register import Issued, Register, load_register
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import atomic_path, make_dir, write_bytes, write_text
from reports.web.jobs import read_json, run, write_json

GRADE_S = 3600.0
_NAME = re.compile(r"[0-9a-f]{16}")
_LINK = re.compile(r"([0-9a-f]{16})-(\d{1,4})-([0-9a-f]{32})")
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
    def state(self) -> dict[str, Any]:
        """What is being done or was done last, and what the command said."""
        return read_json(self.folder / "state.json")

    @property
    def register(self) -> Register | None:
        """The register, once the books are issued."""
        path = self.folder / "issued"
        return load_register(path) if (path / "register.json").exists() else None

    @property
    def books(self) -> tuple[Issued, ...]:
        """The issued books."""
        register = self.register
        return register.books if register else ()

    @property
    def rows(self) -> list[dict[str, Any]]:
        """Rows of the gradebook, once there are any."""
        found: list[dict[str, Any]] = read_json(self.results / "summary.json").get("rows", [])
        return found

    @property
    def results(self) -> Path:
        """The folder of all that grading has made."""
        return self.folder / "results"

    def page(self, number: int) -> Path | None:
        """The page of a student's work: one that the gradebook names itself."""
        pages = {row["number"]: row["page"] for row in self.rows if row["number"] is not None}
        return self.results / pages[number] if pages.get(number) else None

    def judged(self) -> Iterator[dict[str, Any]]:
        """What is known so far of each file that was handed in."""
        for path in (self.results / "results").glob("*.json"):
            if path.name != "register.json":
                yield read_json(path)

    def unknown(self) -> dict[int, list[str]]:
        """Items of each student that the program could not judge."""
        found: dict[int, list[str]] = {}
        for result in self.judged():
            items = [i["id"] for i in result.get("items", ()) if i["verdict"] == "unknown"]
            if result.get("number") is not None and items:
                found.setdefault(result["number"], []).extend(items)
        return found

    def issued(self, book: Issued) -> Path:
        """A student's work-book."""
        return self.folder / "issued" / book.folder / book.file

    def work(self, book: Issued) -> Path:
        """Where a student's own upload lies."""
        return self.folder / "works" / f"{book.folder}.xlsx"

    def keep_open(self, is_open: bool) -> None:
        """Say whether students see their own pages."""
        write_json(self.folder / "about.json", {**self.about, "open": is_open})

    def keep_work(self, book: Issued, data: bytes) -> None:
        """Keep a student's own upload, looked at by the same intake as all books.

        Raises:
            InputError: it is no workbook.
        """
        from reports.workbook.intake import check_data

        check_data(data, "работа")
        write_bytes(self.work(book), data)

    def issued_zip(self) -> Path:
        """All work-books that were issued, each in its folder."""
        target = self.folder / "issued.zip"
        if not target.exists() and (books := self.books):
            files = ((self.issued(book), f"{book.folder}/{book.file}") for book in books)
            _archive(target, None, files)
        return target


def _archive(target: Path, base: Path | None, files: Iterable[tuple[Path, str]]) -> None:
    """Pack files by name, added to those of another archive."""
    with atomic_path(target) as part:
        if base is not None:
            shutil.copyfile(base, part)
        mode = "w" if base is None else "a"
        with zipfile.ZipFile(part, mode, zipfile.ZIP_DEFLATED) as archive:  # type: ignore[call-overload]
            for path, name in files:
                archive.write(path, name)


class Classes:
    """All classes of a server.

    Args:
        folder: where they lie.
        secret: what makes students' links unguessable.
        dask: address of a cluster that grades.
    """

    def __init__(self, folder: Path, secret: bytes, dask: str | None) -> None:
        self.folder, self.secret, self.dask = folder, secret, dask
        self._turn = asyncio.Semaphore(1)  # grading takes all processors by itself
        self._tasks: dict[str, asyncio.Task[None]] = {}

    def start(self) -> None:
        """Do again what an earlier server has left undone."""
        make_dir(self.folder)
        for each in self.all():
            if each.state.get("doing"):
                self._begin(each, each.state["doing"])

    async def stop(self) -> None:
        """End what runs; the next server does it again."""
        for task in self._tasks.values():
            task.cancel()
        await asyncio.gather(*self._tasks.values(), return_exceptions=True)

    def all(self) -> list[Class]:
        """Every class, the newest first."""
        found = [Class(path.parent) for path in self.folder.glob("*/about.json")]
        return sorted(found, key=lambda each: str(each.about.get("date")), reverse=True)

    def find(self, name: str) -> Class | None:
        """A class by the name of its folder."""
        known = _NAME.fullmatch(name) and (self.folder / name / "about.json").exists()
        return Class(self.folder / name) if known else None

    def issue(self, seed: int, title: str, base: str, roster: str, rubric: str) -> Class:
        """A new class, its books being issued."""
        made = Class(self.folder / secrets.token_hex(8))
        make_dir(made.folder)
        for file, text in (("base.toml", base), ("roster.csv", roster), ("rubric.toml", rubric)):
            if text.strip():
                write_text(made.folder / file, text)
        more = ["--rubric", "rubric.toml"] if rubric.strip() else []
        self._begin(made, ["issue", "base.toml", "--roster", "roster.csv", "-o", "issued",
                           "--seed", str(seed), "--secret", "secret.key", *more])  # fmt: skip
        date = datetime.now().isoformat(timespec="seconds")
        about = {"title": one_line(title, 120) or "Группа", "open": False, "date": date}
        write_json(made.folder / "about.json", about)
        return made

    def grade(self, each: Class, decision: tuple[str, ...] = ()) -> None:
        """Begin to grade what was handed in; what was graded before, the command takes over.

        Args:
            each: the class.
            decision: who, what, points, remark, if the instructor has decided.

        Raises:
            InputError: nothing was, or something is being done already.
        """
        if each.state.get("doing"):
            raise InputError(Problem("", "группа занята", "дождитесь окончания"))
        works = sorted((each.folder / "works").glob("*.xlsx"))
        moodle, sheet = each.folder / "moodle.zip", each.folder / "worksheet.csv"
        if not moodle.exists() and not works:
            raise InputError(Problem("", "нет ни одной работы", "загрузите архив"))
        if not decision:
            base = moodle if moodle.exists() else None
            own = ((path, f"страница/{path.name}") for path in works)
            _archive(each.folder / "submitted.zip", base, own)
        word = ["--decide", *decision, "--author", "преподаватель"] if decision else []
        worksheet = ["--moodle", sheet.name] if sheet.exists() else []
        far = ["--dask", self.dask] if self.dask else []
        self._begin(each, ["grade", "issued", "submitted.zip", "-o", "results",
                           "--secret", "secret.key", *worksheet, *far, *word])  # fmt: skip

    def _begin(self, each: Class, command: list[str]) -> None:
        write_json(each.folder / "state.json", {"doing": command})
        self._tasks[each.folder.name] = asyncio.create_task(self._do(each, command))

    async def _do(self, each: Class, command: list[str]) -> None:
        async with self._turn:
            said = await run(command, each.folder, GRADE_S)
        done = {"done": command[0], "code": said.code, "lines": said.lines}
        write_json(each.folder / "state.json", done)

    def link(self, each: Class, number: int) -> str:
        """The word of a student's own page."""
        text = f"{each.folder.name}-{number}"
        mark = hmac.new(self.secret, text.encode(), hashlib.sha256).hexdigest()[:32]
        return f"{text}-{mark}"

    def student(self, link: str) -> tuple[Class, Issued] | None:
        """The class and the issued book that a link belongs to."""
        match = _LINK.fullmatch(link)
        each = self.find(match[1]) if match else None
        if match is None or each is None:
            return None
        if not hmac.compare_digest(self.link(each, int(match[2])), link):
            return None
        return next(((each, book) for book in each.books if book.number == int(match[2])), None)
