"""Classes: issued, handed in, graded and decided by the commands, seen by both sides.

A class is a folder with an unguessable name, and a job of its own queue.
"""

from __future__ import annotations

import hmac
import secrets
from collections.abc import Mapping
from datetime import datetime
from pathlib import Path

from itsdangerous import BadData, URLSafeSerializer
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.routing import Route

from reports.grading.batch.grade import PAGES
from reports.grading.issuing.register import FILE, SECRET, kept_secret, load_register
from reports.inputs.form_fields import Data
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import make_dir, read_json, write_bytes, write_json, write_zip
from reports.web import engine
from reports.web.doors import Rate, Shown, ask, body, caller, earlier, get, post, shown
from reports.web.jobs import Queue

_TEXTS, _ROSTER = ("base.toml", "rubric.toml"), "Список"
_SECRET = ("--secret", SECRET)


def token_of(secret: bytes) -> str:
    """Instructor's token, derived from the server's secret."""
    return hmac.digest(secret, b"teacher", "sha256").hex()[:32]


class Classes(Queue):
    """All classes of a server; grading takes all processors by itself, so one at a time."""

    timeout_s = 3600.0
    pack = ("issued.zip", "issued", "*/*.xlsx")

    def __init__(
        self, folder: Path, secret: bytes, dask: str | None, more: Mapping[str, str] | None = None
    ) -> None:
        super().__init__(folder, secret, dask, more=more)
        self.signer, self.tries = URLSafeSerializer(secret, "student"), Rate(10, 60)

    def routes(self) -> list[Route]:
        """Routes of the instructor, behind the key but for the first, and of students."""
        return [
            post("/api/login", self._login),
            get("/api/teacher", self._listed),
            post("/api/teacher", self._issue),
            post("/api/teacher/{name}/grade", self._grade),
            post("/api/teacher/{name}/open", self._open),
            *shown("/api/teacher/{name}", self._whole, "/file/{file:path}"),
            *shown("/api/student/{link}", self._own),
        ]

    async def _login(self, request: Request) -> None:
        given = str((await body(request)).get("token", "")).strip().encode("utf-8", "replace")
        if not self.tries.allows(caller(request)):
            raise HTTPException(429, "слишком много попыток; подождите минуту")
        if not hmac.compare_digest(token_of(self.secret).encode(), given):
            raise HTTPException(403, "неверный ключ; его печатает команда kshm serve")
        request.session["teacher"] = True

    def _find(self, name: str) -> Path:
        if name.isalnum() and (self.folder / name / "about.json").exists():  # never a path
            return self.folder / name
        raise HTTPException(404, "нет такой группы")

    def _inside(self, request: Request) -> Path:
        """The class that a request names, else the folder of all: for the instructor alone."""
        if not request.session.get("teacher"):
            raise HTTPException(403, "войдите с ключом преподавателя")
        name = request.path_params.get("name")
        return self._find(name) if name else self.folder

    async def _listed(self, request: Request) -> Data:
        entries = [{"name": path.parent.name, **read_json(path)}
                 for path in self._inside(request).glob("*/about.json")]  # fmt: skip
        return {"classes": sorted(entries, key=lambda each: str(each.get("date")), reverse=True)}

    async def _issue(self, request: Request) -> Data:
        folder, data = self._inside(request), await body(request)
        files = {name: str(data.get(name) or "") for name in _TEXTS}
        base = await ask(request, engine.read_toml, files["base.toml"])
        await ask(request, engine.as_toml, base["raw"])  # without its ranges it is an input too
        lost = (p.parent for p in folder.glob("*/done.json") if not p.with_name("issued").exists())
        folder = next(lost, folder / secrets.token_hex(8))  # in the place of what has failed
        make_dir(folder / "works")
        kept_secret(folder / SECRET)
        title = one_line(str(data.get("title")), 120) or "Группа"
        date = datetime.now().isoformat(timespec="seconds")
        write_json(folder / "about.json", {"title": title, "open": False, "date": date})
        more = ["--rubric", "rubric.toml"] if files["rubric.toml"].strip() else []
        write_bytes(folder / _ROSTER, str(data.get("roster") or "").encode("latin-1", "replace"))
        command = ["issue", "base.toml", "--roster", _ROSTER, "-o", "issued", *_SECRET]
        self.put(folder.name, files, [*command, f"--seed={data.get('seed')}", *more])
        return {"name": folder.name}

    async def _grade(self, request: Request) -> None:
        folder, data = self._inside(request), await body(request)
        if self.about(folder.name).get("state") in ("waiting", "running"):
            raise InputError(Problem("", "группа занята", "дождитесь окончания"))
        command = ["grade", "issued", "submitted.zip", "-o", "results", *_SECRET]
        if "who" in data:
            decision = [str(data.get(key, ""))[:500] for key in ("who", "what", "points", "remark")]
            command += ["--decide", *decision, "--author", "преподаватель"]
        else:
            # An earlier one counts where a later one turns out to be somebody else's.
            works = {
                f"страница/{each.stem}/{path.name}": path
                for each in folder.glob("works/*.xlsx")
                for path in (*earlier(each)[-1:], each)
            }
            write_zip(folder / "submitted.zip", works, folder / "moodle.zip")
        if (folder / "worksheet.csv").exists():
            command += ["--moodle", "worksheet.csv"]
        self.put(folder.name, {}, [*command, *self.far])

    async def _open(self, request: Request) -> None:
        path, data = self._inside(request) / "about.json", await body(request)
        write_json(path, {**read_json(path), "open": bool(data.get("open"))})

    def _whole(self, request: Request) -> Shown:
        folder = self._inside(request)
        results, issued = folder / "results", folder / "issued"
        files = {path.name: path for path in results.glob("[!.]*.*") if path.suffix != ".json"}
        pages = {f"{PAGES}/{path.name}": path for path in results.glob(f"{PAGES}/*.html")}
        students = [
            {"name": book.student.full, "group": book.student.group,
             "link": self.signer.dumps([folder.name, book.number]),
             **_handed(folder / "works" / book.file)}
            for book in (load_register(issued).books if (issued / FILE).exists() else ())
        ]  # fmt: skip
        summary = read_json(results / "summary.json")
        return Shown(
            {**read_json(folder / "about.json"), **self.about(folder.name), "students": students,
             "rows": summary.get("rows", []), "groups": summary.get("groups", []),
             "files": [*files], "graded": len(pages)},
            {**files, **pages, "issued.zip": folder / "issued.zip"},
            {name: folder / name for name in ("moodle.zip", "worksheet.csv")},
        )  # fmt: skip

    def _own(self, request: Request) -> Shown:
        try:
            name, number = self.signer.loads(request.path_params["link"])
            folder = self._find(name)
            books = load_register(folder / "issued").books
            book = next(book for book in books if book.number == number)
        except (BadData, StopIteration):
            raise HTTPException(404, "нет такой страницы") from None
        about, work = read_json(folder / "about.json"), folder / "works" / book.file
        rows = read_json(folder / "results/summary.json").get("rows", ()) if about["open"] else ()
        row: Data = next((row for row in rows if row["number"] == number), {})
        files = {"book": folder / "issued" / book.folder / book.file,
                 "page": folder / "results" / row.get("page", "")}  # fmt: skip
        entry = {
            "title": about["title"], "student": book.student.full, "file": book.file,
            **_handed(work), "open": bool(row.get("page")),
            "points": row.get("points"), "status": row.get("status", ""),
        }  # fmt: skip
        entry["handed"] = entry["handed"] or bool(row.get("file"))
        return Shown(entry, files, {"work": work})


def _handed(work: Path) -> Data:
    """Whether a work was handed in here, when, and when others were before it."""
    if not work.exists():
        return {"handed": False, "when": None, "earlier": []}
    times = [path.stat().st_mtime for path in (*earlier(work), work)]
    return {"handed": True, "when": times[-1], "earlier": times[:-1]}
