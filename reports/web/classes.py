"""Classes on the disk: issued, handed in, graded and decided by the commands.

A class is a folder with an unguessable name.  ``state.json`` says what is being done to it;
a server that starts does it again.
"""

from __future__ import annotations

import asyncio
import hashlib
import hmac
import json
import re
import secrets
import shutil
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from reports.grading.issuing.register import Register, load_register
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import make_dir, write_bytes, write_text
from reports.web.jobs import run

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
        return _json(self.folder / "about.json")

    @property
    def state(self) -> dict[str, Any]:
        """What is being done or was done last, and what the command said."""
        return _json(self.folder / "state.json")

    @property
    def register(self) -> Register | None:
        """The register, once the books are issued."""
        path = self.folder / "issued"
        return load_register(path) if (path / "register.json").exists() else None

    @property
    def rows(self) -> list[dict[str, Any]]:
        """Rows of the gradebook, once there are any."""
        found: list[dict[str, Any]] = _json(self.folder / "results" / "summary.json").get(
            "rows", []
        )
        return found

    def page(self, number: object) -> Path | None:
        """The page of a student's work: one that the gradebook names itself."""
        pages = {row["number"]: row["page"] for row in self.rows if row["number"] is not None}
        name = pages.get(number)
        path = self.folder / "results" / name if name else None
        return path if path and path.exists() else None

    def unknown(self) -> dict[int, list[str]]:
        """Items of each student that the program could not judge."""
        found: dict[int, list[str]] = {}
        for path in (self.folder / "results" / "results").glob("*.json"):
            result = _json(path)
            items = [i["id"] for i in result.get("items", ()) if i["verdict"] == "unknown"]
            if result.get("number") is not None and items:
                found.setdefault(result["number"], []).extend(items)
        return found

    def graded(self) -> int:
        """How many files are graded so far."""
        folder = self.folder / "results" / "results"
        return sum(path.name != "register.json" for path in folder.glob("*.json"))

    def work(self, folder: str) -> Path:
        """Where a student's own upload lies; ``folder`` is the register's word."""
        return self.folder / "works" / f"{folder}.xlsx"


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
            command = each.state.get("doing")
            if command:
                self._begin(each, command)

    async def stop(self) -> None:
        """End what runs; the next server does it again."""
        for task in self._tasks.values():
            task.cancel()
        await asyncio.gather(*self._tasks.values(), return_exceptions=True)

    def all(self) -> Iterator[Class]:
        """Every class, the newest first."""
        folders = [path.parent for path in self.folder.glob("*/about.json")]
        for path in sorted(folders, key=lambda path: _json(path / "about.json")["date"])[::-1]:
            yield Class(path)

    def find(self, name: str) -> Class | None:
        """A class by the name of its folder."""
        place = self.folder / name
        known = _NAME.fullmatch(name) and (place / "about.json").exists()
        return Class(place) if known else None

    def issue(self, seed: int, title: str, base: str, roster: str, rubric: str) -> Class:
        """A new class, its books being issued."""
        name = secrets.token_hex(8)
        made = Class(self.folder / name)
        make_dir(made.folder)
        for file, text in (("base.toml", base), ("roster.csv", roster), ("rubric.toml", rubric)):
            if text.strip():
                write_text(made.folder / file, text)
        about = {"title": one_line(title, 120) or "Группа", "open": False,
                 "date": datetime.now().isoformat(timespec="seconds")}  # fmt: skip
        more = ["--rubric", "rubric.toml"] if rubric.strip() else []
        command = ["issue", "base.toml", "--roster", "roster.csv", "-o", "issued",
                   "--seed", str(seed), "--secret", "secret.key", *more]  # fmt: skip
        self._begin(made, command)
        write_text(made.folder / "about.json", json.dumps(about, ensure_ascii=False))
        return made

    def grade(self, each: Class) -> None:
        """Begin to grade what was handed in.

        Raises:
            InputError: nothing was, or something is being done already.
        """
        self._refuse_busy(each)
        works = each.folder / "works"
        archive = each.folder / "submitted.zip"
        part = archive.with_suffix(".part")
        moodle = each.folder / "moodle.zip"
        if moodle.exists():
            shutil.copyfile(moodle, part)
        if not moodle.exists() and not any(works.glob("*.xlsx")):
            raise InputError(Problem("", "нет ни одной работы", "загрузите архив"))
        with zipfile.ZipFile(part, "a") as target:
            for path in sorted(works.glob("*.xlsx")):
                target.write(path, f"страница/{path.name}")
        part.replace(archive)
        self._begin(each, self._grading(each))

    def _grading(self, each: Class) -> list[str]:
        """The command that grades; what was graded before, it takes over."""
        known = (each.folder / "worksheet.csv").exists()
        worksheet = ["--moodle", "worksheet.csv"] if known else []
        far = ["--dask", self.dask] if self.dask else []
        return ["grade", "issued", "submitted.zip", "-o", "results", "--secret", "secret.key",
                *worksheet, *far]  # fmt: skip

    def decide(self, each: Class, words: tuple[str, str, str, str]) -> None:
        """Take a decision: who, what, points, remark.

        Raises:
            InputError: something is being done already.
        """
        self._refuse_busy(each)
        command = [*self._grading(each), "--decide", *words, "--author", "преподаватель"]
        self._begin(each, command)

    def _refuse_busy(self, each: Class) -> None:
        if each.state.get("doing"):
            raise InputError(Problem("", "группа занята", "дождитесь окончания"))

    def _begin(self, each: Class, command: list[str]) -> None:
        write_text(each.folder / "state.json", json.dumps({"doing": command}, ensure_ascii=False))
        task = asyncio.create_task(self._do(each, command))
        self._tasks[each.folder.name] = task

    async def _do(self, each: Class, command: list[str]) -> None:
        async with self._turn:
            said = await run(command, each.folder, GRADE_S)
        done = {"done": command[0], "code": said.code, "lines": said.lines}
        write_text(each.folder / "state.json", json.dumps(done, ensure_ascii=False))

    def link(self, each: Class, number: int) -> str:
        """The word of a student's own page."""
        name = each.folder.name
        text = f"{name}-{number}"
        mark = hmac.new(self.secret, text.encode(), hashlib.sha256).hexdigest()[:32]
        return f"{text}-{mark}"

    def student(self, link: str) -> tuple[Class, Any] | None:
        """The class and the issued book that a link belongs to."""
        match = _LINK.fullmatch(link)
        each = self.find(match[1]) if match else None
        if match is None or each is None:
            return None
        if not hmac.compare_digest(self.link(each, int(match[2])), link):
            return None
        register = each.register
        books = register.books if register else ()
        return next(((each, book) for book in books if book.number == int(match[2])), None)


def issued_zip(each: Class) -> Path:
    """All work-books that were issued, each in its folder."""
    target = each.folder / "issued.zip"
    register = each.register
    if register is not None and not target.exists():
        part = target.with_suffix(".part")
        with zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as archive:
            for book in register.books:
                archive.write(each.folder / "issued" / book.folder / book.file,
                              f"{book.folder}/{book.file}")  # fmt: skip
        part.replace(target)
    return target


def keep_open(each: Class, is_open: bool) -> None:
    """Whether students see their own pages."""
    text = json.dumps({**each.about, "open": is_open}, ensure_ascii=False)
    write_text(each.folder / "about.json", text)


def keep_work(each: Class, folder: str, data: bytes) -> None:
    """A student's own upload, looked at by the same intake as all books.

    Raises:
        InputError: it is no workbook.
    """
    from reports.workbook.intake import check_data

    check_data(data, "работа")
    write_bytes(each.work(folder), data)


def _json(path: Path) -> dict[str, Any]:
    try:
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found
