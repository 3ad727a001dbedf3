"""Classes: issued, handed in, graded and decided by the commands; doors of both sides.

A class is a folder with an unguessable name, and a job of its own queue.
"""

from __future__ import annotations

import hmac
import secrets
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from itsdangerous import BadData, URLSafeSerializer
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.routing import Route

from reports.grading.batch.grade import PAGES
from reports.grading.issuing.register import FILE, Issued, load_register
from reports.inputs.described import Data
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import make_dir, read_json, write_json, write_text, write_zip
from reports.web import engine
from reports.web.doors import Rate, Shown, ask, body, caller, route, shown
from reports.web.jobs import Queue

GRADE_S = 3600.0
_TEXTS = ("base.toml", "roster.csv", "rubric.toml")
_SECRET = ("--secret", "secret.key")
_DECISION = ("who", "what", "points", "remark")


@dataclass(frozen=True, slots=True)
class Class:
    """A class by its folder."""

    folder: Path

    @property
    def about(self) -> Data:
        """Title, date, whether pages are open to their students."""
        return read_json(self.folder / "about.json")

    @property
    def books(self) -> tuple[Issued, ...]:
        """The books, once they are issued."""
        path = self.folder / "issued"
        return load_register(path).books if (path / FILE).exists() else ()

    @property
    def rows(self) -> list[Data]:
        """Rows of the gradebook, once there are any."""
        return list(read_json(self.folder / "results/summary.json").get("rows", ()))

    def work(self, book: Issued) -> Path:
        """Where a student's own upload lies."""
        return self.folder / "works" / f"{book.folder}.xlsx"


class Classes(Queue):
    """All classes of a server; grading takes all processors by itself, so one at a time.

    ``secret`` makes students' links unguessable, a cluster at ``dask`` grades.
    """

    def __init__(self, folder: Path, secret: bytes, dask: str | None) -> None:
        super().__init__(folder, 1, GRADE_S, ("issued.zip", "issued", "*/*.xlsx"))
        self.signer, self.dask = URLSafeSerializer(secret, "student"), dask

    def all(self) -> list[Class]:
        """Every class, the newest first."""
        found = [Class(path.parent) for path in self.folder.glob("*/about.json")]
        return sorted(found, key=lambda each: str(each.about.get("date")), reverse=True)

    def find(self, name: str) -> Class:
        """A class by the name of its folder, never a path; HTTPException if there is none."""
        for each in self.all():
            if each.folder.name == name:
                return each
        raise HTTPException(404, "нет такой группы")

    def link(self, each: Class, book: Issued) -> str:
        """The word of a student's own page."""
        return str(self.signer.dumps([each.folder.name, book.number]))

    def student(self, link: str) -> tuple[Class, Issued, Data]:
        """Class, book and open row of the gradebook of a link; HTTPException if it is none."""
        try:
            name, number = self.signer.loads(link)
            each = self.find(name)
            book = next(book for book in each.books if book.number == number)
        except (BadData, StopIteration):
            raise HTTPException(404, "нет такой страницы") from None
        rows = each.rows if each.about.get("open") else ()
        return each, book, next((row for row in rows if row["number"] == number), {})

    def issue(self, title: str, seed: str, files: dict[str, str]) -> str:
        """A new class, its books being issued out of base, roster and rubric; its name."""
        folder = self.folder / secrets.token_hex(8)
        make_dir(folder / "works")
        for file, text in files.items():
            write_text(folder / file, text)
        date = datetime.now().isoformat(timespec="seconds")
        about = {"title": one_line(title, 120) or "Группа", "open": False, "date": date}
        write_json(folder / "about.json", about)
        more = ["--rubric", "rubric.toml"] if "rubric.toml" in files else []
        self.put(folder.name, ["issue", "base.toml", "--roster", "roster.csv", "-o", "issued",
                               "--seed", seed, *_SECRET, *more])  # fmt: skip
        return folder.name

    def grade(self, folder: Path, decision: Sequence[str]) -> None:
        """Begin to grade what was handed in, or to decide; InputError while the class is busy."""
        if self.about(folder.name).get("state") in ("waiting", "running"):
            raise InputError(Problem("", "группа занята", "дождитесь окончания"))
        command = ["grade", "issued", "submitted.zip", "-o", "results", *_SECRET]
        if decision:
            command += ["--decide", *decision, "--author", "преподаватель"]
        else:
            works = {f"страница/{path.name}": path for path in folder.glob("works/*.xlsx")}
            write_zip(folder / "submitted.zip", works, folder / "moodle.zip")
        if (folder / "worksheet.csv").exists():
            command += ["--moodle", "worksheet.csv"]
        self.put(folder.name, command + (["--dask", self.dask] if self.dask else []))


def token_of(secret: bytes) -> str:
    """What the instructor logs in with; the same as long as the server keeps its secret."""
    return hmac.digest(secret, b"teacher", "sha256").hex()[:32]


def routes(classes: Classes, secret: bytes) -> list[Route]:
    """Doors of the instructor, all but the first behind the token, and of the students."""
    tries = Rate(10, 60)

    async def login(request: Request) -> None:
        given = str((await body(request)).get("token", "")).strip()
        if not tries.allows(caller(request)):
            raise HTTPException(429, "слишком много попыток; подождите минуту")
        if not hmac.compare_digest(token_of(secret).encode(), given.encode("utf-8", "replace")):
            raise HTTPException(403, "неверный ключ; его печатает команда kshm serve")
        request.session["teacher"] = True

    def enter(request: Request) -> None:
        if not request.session.get("teacher"):
            raise HTTPException(403, "войдите с ключом преподавателя")

    def chosen(request: Request) -> Class:
        enter(request)
        return classes.find(request.path_params["name"])

    async def listed(request: Request) -> Data:
        enter(request)
        return {"classes": [{"name": each.folder.name, **each.about} for each in classes.all()]}

    async def issue(request: Request) -> Data:
        enter(request)
        data = await body(request)
        files = {name: text for name in _TEXTS if (text := str(data.get(name) or "")).strip()}
        if not (seed := str(data.get("seed", ""))).lstrip("-").isdecimal() or len(seed) > 9:
            raise InputError(Problem("seed", "нужно целое число", "например 1"))
        base = await ask(request, engine.read_toml, files.get("base.toml", ""))
        await ask(request, engine.as_toml, base["raw"])  # valid without its ranges
        return {"name": classes.issue(str(data.get("title")), seed, files)}

    async def grade(request: Request) -> None:
        each, data = chosen(request), await body(request)
        words = _DECISION if "who" in data else ()
        classes.grade(each.folder, [str(data.get(key, ""))[:500] for key in words])

    async def show(request: Request) -> None:
        each, data = chosen(request), await body(request)
        write_json(each.folder / "about.json", {**each.about, "open": bool(data.get("open"))})

    def whole(request: Request) -> Shown:
        each = chosen(request)
        results = each.folder / "results"
        made = {path.name: path for path in results.glob("[!.]*.*") if path.suffix != ".json"}
        pages = {f"{PAGES}/{path.name}": path for path in results.glob(f"{PAGES}/*.html")}
        students = [
            {"name": book.student.full, "group": book.student.group,
             "link": classes.link(each, book), "handed": each.work(book).exists()}
            for book in each.books
        ]  # fmt: skip
        return Shown(
            {**each.about, **classes.about(each.folder.name), "students": students,
             "rows": each.rows, "files": [*made], "graded": len(pages)},
            {**made, **pages, "issued.zip": each.folder / "issued.zip"},
            {name: each.folder / name for name in ("moodle.zip", "worksheet.csv")},
        )  # fmt: skip

    def own(request: Request) -> Shown:
        each, book, row = classes.student(request.path_params["link"])
        work, page = each.work(book), row.get("page")
        told = {
            "title": each.about["title"], "student": book.student.full, "file": book.file,
            "handed": work.exists(), "open": bool(page), "points": row.get("points"),
            "status": row.get("status", ""),
        }  # fmt: skip
        files = {"book": each.folder / "issued" / book.folder / book.file}
        if page:
            files["page"] = each.folder / "results" / page
        return Shown(told, files, {"work": work})

    return [
        route("/api/login", login, "POST"),
        route("/api/teacher", listed),
        route("/api/teacher", issue, "POST"),
        route("/api/teacher/{name}/grade", grade, "POST"),
        route("/api/teacher/{name}/open", show, "POST"),
        *shown("/api/teacher/{name}", whole, "/file/{file:path}"),
        *shown("/api/student/{link}", own),
    ]
