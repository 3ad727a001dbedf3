"""Classes: issued, handed in, graded and decided by the commands, seen by both sides.

A class is a folder with an unguessable name, and a job of its own queue.
"""

from __future__ import annotations

import asyncio
import csv
import hashlib
import hmac
import io
import secrets
import shutil
import tempfile
from collections.abc import Mapping
from datetime import datetime
from pathlib import Path

from itsdangerous import BadData, URLSafeSerializer
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from reports.exports.numbers import neutralised
from reports.grading.batch.grade import PAGES
from reports.grading.issuing.register import FILE, SECRET, Issued, kept_secret, load_register
from reports.grading.pages.side_by_side import COMPARED
from reports.inputs.form_fields import Data, groups
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import make_dir, read_json, write_bytes, write_json, write_zip
from reports.web import engine
from reports.web.http_guards import (
    Rate,
    Shown,
    address_of_server,
    ask,
    body,
    caller,
    earlier,
    get,
    post,
    shown,
)
from reports.web.jobs import Queue

_FILES = {"base.toml": "base.toml", "rubric.toml": "rubric.toml", "roster": "Список"}
_TITLES = {
    "summary.html": "Сводка по группе", "gradebook.csv": "Ведомость .csv",
    "gradebook.xlsx": "Ведомость .xlsx", "moodle.csv": "Оценки и замечания для Moodle .csv",
    "moodle-worksheet.csv": "Заполненная ведомость Moodle .csv",
    "moodle-feedback.zip": "Отзывы для Moodle .zip",
}  # fmt: skip  # what a link to a file is called
_SECRET = ("--secret", SECRET)
_ENTERED, _MAX_ENTERED = "sessions.json", 200  # of the instructor's browsers


def token_of(secret: bytes) -> str:
    """Instructor's token, derived from the server's secret."""
    return hmac.digest(secret, b"teacher", "sha256").hex()[:32]


def _digest(entry: object) -> str:
    """Return what is kept of a session: who reads the file cannot enter with it."""
    return hashlib.sha256(str(entry).encode()).hexdigest()


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
            post("/api/logout", self._logout),
            get("/api/teacher", self._listed),
            post("/api/teacher", self._issue),
            post("/api/teacher/{name}/grade", self._grade),
            post("/api/teacher/{name}/rules", self._rules),
            post("/api/teacher/{name}/delete", self._delete),
            get("/api/teacher/{name}/links.csv", self._links),
            get("/api/teacher/{name}/qr/{number:int}.svg", self._code),
            *shown("/api/teacher/{name}", self._whole, "/file/{file:path}"),
            post("/api/student/{link}/ask", self._ask),
            *shown("/api/student/{link}", self._own),
        ]

    async def _login(self, request: Request) -> None:
        token = str((await body(request)).get("token", "")).strip().encode("utf-8", "replace")
        # The right key is never kept out, whoever tries wrong ones beside it.
        if not hmac.compare_digest(token_of(self.secret).encode(), token):
            if not self.tries.allows(caller(request)):
                raise HTTPException(429, "слишком много попыток; подождите минуту")
            raise HTTPException(403, "неверный ключ; его печатает команда kshm serve")
        request.session["teacher"] = entry = secrets.token_urlsafe(16)
        self._keep([*self._entered(), _digest(entry)])

    async def _logout(self, request: Request) -> None:
        """End the session here: a copy of its cookie opens nothing any more."""
        entry = _digest(request.session.pop("teacher", None))
        self._keep([each for each in self._entered() if each != entry])

    def _entered(self) -> list[str]:
        """Digests of the sessions that the instructor has begun and not ended."""
        entered = read_json(self.folder / _ENTERED).get("sessions", [])
        return entered if isinstance(entered, list) else []

    def _keep(self, entered: list[str]) -> None:
        write_json(self.folder / _ENTERED, {"sessions": entered[-_MAX_ENTERED:]})

    def _find(self, name: str) -> Path:
        if name.isalnum() and (self.folder / name / "about.json").exists():  # never a path
            return self.folder / name
        raise HTTPException(404, "нет такой группы")

    def _inside(self, request: Request) -> Path:
        """Return class that a request names, else the folder of all: for the instructor alone."""
        if _digest(request.session.get("teacher")) not in self._entered():
            raise HTTPException(403, "войдите с ключом преподавателя")
        name = request.path_params.get("name")
        return self._find(name) if name else self.folder

    async def _listed(self, request: Request) -> Data:
        entries = [{"name": path.parent.name, **read_json(path)}
                 for path in self._inside(request).glob("*/about.json")]  # fmt: skip
        return {"classes": sorted(entries, key=lambda each: str(each.get("date")), reverse=True)}

    async def _issue(self, request: Request) -> Data:
        folder, data = self._inside(request), await body(request)
        files = {file: _bytes(data.get(key)) for key, file in _FILES.items()}
        with tempfile.TemporaryDirectory(prefix="book-", dir=folder.parent) as scratch:
            path = Path(scratch, "base.toml")
            path.write_bytes(files["base.toml"])
            base = await ask(request, engine.read_toml, str(path))
        await ask(request, engine.as_toml, base["raw"])  # without its ranges it is an input too
        lost = (p.parent for p in folder.glob("*/done.json") if not p.with_name("issued").exists())
        folder = next(lost, folder / secrets.token_hex(8))  # in the place of what has failed
        make_dir(folder / "works")
        kept_secret(folder / SECRET)
        title = one_line(str(data.get("title")), 120) or "Группа"
        date = datetime.now().isoformat(timespec="seconds")
        write_json(folder / "about.json", {"title": title, "open": False, "date": date})
        more = ["--rubric", "rubric.toml"] if files["rubric.toml"].strip() else []
        for file, content in files.items():
            write_bytes(folder / file, content)
        command = ["issue", "base.toml", "--roster", _FILES["roster"], "-o", "issued", *_SECRET]
        self.put(folder.name, {}, [*command, f"--seed={data.get('seed')}", *more])
        return {"name": folder.name}

    async def _grade(self, request: Request) -> None:
        folder, data = self._inside(request), await body(request)
        if self.about(folder.name).get("state") in ("waiting", "running"):
            raise InputError(Problem("", "группа занята", "дождитесь окончания"))
        command = ["grade", "issued", "submitted.zip", "-o", "results", *_SECRET]
        if "who" in data:
            decision = [str(data.get(key, ""))[:500] for key in ("who", "what", "points", "remark")]
            command += ["--decide", *decision, "--author", "преподаватель"]
            if data.get("preview"):
                command = ["grade", "-o", "results", "--decide", *decision, "--preview"]
        else:
            # An earlier one counts where a later one turns out to be somebody else's.
            tries = load_register(folder / "issued").rubric.attempts.tries
            works = {
                f"страница/{each.stem}/{path.name}": path
                for each in folder.glob("works/*.xlsx")
                for path in (*earlier(each)[-max(1, tries - 1) :], each)
            }
            write_zip(folder / "submitted.zip", works, folder / "moodle.zip")
        if (folder / "worksheet.csv").exists() and not data.get("preview"):
            command += ["--moodle", "worksheet.csv"]
        self.put(folder.name, {}, [*command, *([] if data.get("preview") else self.far)])

    async def _rules(self, request: Request) -> None:
        """Whether pages are shown, until when and whether later works count."""
        path, data = self._inside(request) / "about.json", await body(request)
        until = str(data.get("deadline") or "")
        if until:
            try:
                datetime.fromisoformat(until)
            except ValueError:
                raise InputError(Problem("", "срок не разобран", "выберите день и час")) from None
        rules = {"open": bool(data.get("open")), "late": bool(data.get("late")), "deadline": until}
        write_json(path, {**read_json(path), **rules})

    async def _delete(self, request: Request) -> None:
        folder = self._inside(request)
        if self.about(folder.name).get("state") in ("waiting", "running"):
            raise InputError(Problem("", "группа занята", "дождитесь окончания"))
        (folder / "about.json").unlink()  # from now on there is no such class
        await asyncio.to_thread(shutil.rmtree, folder, ignore_errors=True)

    def _books(self, folder: Path) -> list[Data]:
        """Students of a class with their links and works."""
        issued = folder / "issued"
        books = load_register(issued).books if (issued / FILE).exists() else ()
        until = read_json(folder / "about.json").get("deadline") or ""
        return [
            {"number": book.number, "name": book.student.full, "group": book.student.group,
             "link": self.signer.dumps([folder.name, book.number]),
             **_handed(folder / "works" / book.file, until)}
            for book in books
        ]  # fmt: skip

    async def _links(self, request: Request) -> Response:
        folder, stream = self._inside(request), io.StringIO(newline="")
        writer, address = csv.writer(stream, delimiter=";"), address_of_server(request)
        writer.writerow(["№", "Студент", "Группа", "Ссылка", "Сдано", "Попыток"])
        for each in self._books(folder):
            when = f"{datetime.fromtimestamp(each['when']):%d.%m.%Y %H:%M}" if each["when"] else ""
            writer.writerow([each["number"], neutralised(each["name"]), neutralised(each["group"]),
                             f"{address}/s/{each['link']}/", when,
                             len(each["earlier"]) + each["handed"]])  # fmt: skip
        heads = {"content-disposition": 'attachment; filename="links.csv"'}
        return Response(stream.getvalue().encode("utf-8-sig"), headers=heads, media_type="text/csv")

    async def _code(self, request: Request) -> Response:
        """Return the link of a student as a QR code, of number 0 the address itself."""
        import segno

        number, address = request.path_params["number"], f"{address_of_server(request)}/"
        books = self._books(self._inside(request)) if number else [{"number": 0}]
        each = next((book for book in books if book["number"] == number), None)
        if each is None:
            raise HTTPException(404, "нет такого студента")
        stream = io.BytesIO()
        path = f"s/{each['link']}/" if number else ""
        segno.make(address + path, micro=False).save(stream, "svg", scale=4, border=3, light="#fff")
        return Response(stream.getvalue(), media_type="image/svg+xml")

    def _whole(self, request: Request) -> Shown:
        folder = self._inside(request)
        results = folder / "results"
        files = {path.name: path for path in results.glob("[!.]*.*") if path.suffix != ".json"}
        pages = {f"{path.parent.name}/{path.name}": path
                 for folder_name in (PAGES, COMPARED)
                 for path in results.glob(f"{folder_name}/*.html")}  # fmt: skip
        students = self._books(folder)
        works = {f"works/{path.relative_to(folder / 'works').as_posix()}": path
                 for path in (folder / "works").rglob("*.xlsx")}  # fmt: skip
        summary = read_json(results / "summary.json")
        return Shown(
            {**read_json(folder / "about.json"), **self.about(folder.name), "students": students,
             "rows": summary.get("rows", []), "groups": summary.get("groups", []),
             "decided": summary.get("decided", []),
             "files": [[name, _TITLES.get(name, name)] for name in files],
             "graded": sum(name.startswith(PAGES) for name in pages),
             "address": address_of_server(request)},
            {**files, **pages, **works, "issued.zip": folder / "issued.zip"},
            {name: folder / name for name in ("moodle.zip", "worksheet.csv")},
        )  # fmt: skip

    async def _ask(self, request: Request) -> None:
        """Take a student's request for another look at one column of an open page."""
        own, data = self._own(request).content, await body(request)
        name, number = self.signer.loads(request.path_params["link"])
        if not own["open"]:
            raise HTTPException(409, "страница проверки ещё не открыта")
        if self.about(name).get("state") in ("waiting", "running"):
            raise InputError(Problem("", "группа занята", "повторите через минуту"))
        words = [str(data.get(key, ""))[:500] for key in ("column", "text")]
        self.put(name, {}, ["grade", "-o", "results", "--request", str(number), *words])

    def _own(self, request: Request) -> Shown:
        try:
            name, number = self.signer.loads(request.path_params["link"])
            folder = self._find(name)
            register = load_register(folder / "issued")
            book = next(book for book in register.books if book.number == number)
        except (BadData, StopIteration):
            raise HTTPException(404, "нет такой страницы") from None
        record, work = read_json(folder / "about.json"), folder / "works" / book.file
        rows = read_json(folder / "results/summary.json").get("rows", ()) if record["open"] else ()
        row: Data = next((row for row in rows if row["number"] == number), {})
        files = {"book": folder / "issued" / book.folder / book.file,
                 "page": folder / "results" / row.get("page", "")}  # fmt: skip
        entry = {
            "title": record["title"], "student": book.student.full, "file": book.file,
            **_handed(work, record.get("deadline") or ""), "open": bool(row.get("page")),
            "deadline": record.get("deadline") or "",
            "points": row.get("points"), "status": row.get("status", ""), "task": _task(book),
        }  # fmt: skip
        limit, tried = register.rubric.attempts.tries, len(entry["earlier"]) + entry["handed"]
        entry["handed"] = entry["handed"] or bool(row.get("file"))
        closed = ""
        if limit and tried >= limit:
            closed = f"попытки кончились: {tried} из {limit}"
        elif record["open"] and not record.get("late"):
            closed = (
                "страницы проверки уже открыты: новая книга не засчитывается, пока преподаватель "
                "не разрешит"
            )
        # After the deadline nobody learns how his work stands.
        early = limit and not _is_past(record.get("deadline") or "")
        return Shown(
            {**entry, "closed": closed, "tries": [tried, limit]}, files, {"work": work},
            closed=closed, tries=str(folder / "issued") if early else "",
        )  # fmt: skip


def _task(book: Issued) -> Data:
    """Return what a student calculates: the engine and the data of his variant."""
    fields = (each for group in groups(book.raw) for entry in group["entries"] for each in entry)
    return {"engine": book.raw["engine"]["name"], "rows": [
        {key: each[key] for key in ("title", "symbol", "value", "unit")}
        for each in fields if each["key"] in book.drawn
    ]}  # fmt: skip


def _is_past(until: str) -> bool:
    return bool(until) and datetime.now() > datetime.fromisoformat(until)


def _handed(work: Path, until: str) -> Data:
    """Whether a work was handed in here, when, whether too late, and when others were before it."""
    if not work.exists():
        return {"handed": False, "when": None, "late": False, "file": work.name, "earlier": []}
    before = [{"when": path.stat().st_mtime, "file": f"earlier/{work.stem}/{path.name}"}
              for path in earlier(work)]  # fmt: skip
    when = work.stat().st_mtime
    late = bool(until) and when > datetime.fromisoformat(until).timestamp()
    return {"handed": True, "when": when, "late": late, "file": work.name, "earlier": before}


def _bytes(text: object) -> bytes:
    """Return a file that has come as one character a byte."""
    return str(text or "").encode("latin-1", "replace")
