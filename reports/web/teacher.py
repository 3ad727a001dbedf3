"""The instructor's door and the students' own pages."""

from __future__ import annotations

import hashlib
import hmac
import zipfile

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from reports.grading.issuing.register import Issued
from reports.inputs.described import Data
from reports.shared.errors import InputError, Problem
from reports.shared.files import write_json
from reports.web import engine
from reports.web.classes import Class, Classes
from reports.web.doors import (
    MOST_ARCHIVE,
    MOST_BOOK,
    Door,
    Rate,
    ask,
    body,
    caller,
    handed,
    route,
    uploaded,
)
from reports.workbook.intake import check_data

_TEXTS = ("base.toml", "roster.csv", "rubric.toml")
_UPLOADS = ("moodle.zip", "worksheet.csv")


def token_of(secret: bytes) -> str:
    """What the instructor logs in with; the same as long as the server keeps its secret."""
    return hmac.new(secret, b"teacher", hashlib.sha256).hexdigest()[:32]


def routes(classes: Classes, secret: bytes) -> list[Route]:
    """Doors of the instructor, all but the first behind the token."""
    tries = Rate(10, 60)

    def asked_for(request: Request) -> Class:
        return classes.find(request.path_params["name"])

    async def login(request: Request) -> None:
        given = str((await body(request)).get("token", "")).strip()
        if not tries.allows(caller(request)):
            raise HTTPException(429, "слишком много попыток; подождите минуту")
        if not hmac.compare_digest(token_of(secret).encode(), given.encode("utf-8", "replace")):
            raise HTTPException(403, "неверный ключ; его печатает команда kshm serve")
        request.session["teacher"] = True

    async def listed(_: Request) -> Data:
        return {"classes": [{"name": each.folder.name, **each.about} for each in classes.all()]}

    async def issue(request: Request) -> Data:
        data = await body(request)
        files = {name: text for name in _TEXTS if (text := str(data.get(name) or "")).strip()}
        if not (seed := str(data.get("seed", ""))).lstrip("-").isdecimal() or len(seed) > 9:
            raise InputError(Problem("seed", "нужно целое число", "например 1"))
        base = await ask(request, engine.read_toml, files.get("base.toml", ""))
        await ask(
            request, engine.as_toml, base["raw"]
        )  # without its ranges it is an input of its own
        return {"name": classes.issue(int(seed), str(data.get("title")), files).folder.name}

    async def about(request: Request) -> Data:
        each = asked_for(request)
        students = [
            {"name": book.student.full, "group": book.student.group,
             "link": classes.link(each, book), "handed": each.work(book).exists()}
            for book in each.books
        ]  # fmt: skip
        results = each.folder / "results/results"
        return {
            **each.about, **classes.about(each.folder.name), "students": students,
            "graded": max(0, len([*results.glob("*.json")]) - 1),  # and the register
            "rows": each.rows, "files": [name for name in each.files() if "/" not in name],
        }  # fmt: skip

    async def upload(request: Request) -> None:
        folder, name = asked_for(request).folder, request.path_params["file"]
        if name not in _UPLOADS:
            raise HTTPException(404, "такого файла здесь не ждут")
        async with uploaded(request, MOST_ARCHIVE) as path:
            if not path.stat().st_size or zipfile.is_zipfile(path) != name.endswith(".zip"):
                raise InputError(Problem("", "это не тот файл", "загрузите архив .zip"))
            path.replace(folder / name)

    async def grade(request: Request) -> None:
        each, data = asked_for(request), await body(request)
        words = ("who", "what", "points", "remark") if "who" in data else ()
        classes.grade(each, tuple(str(data.get(key, ""))[:500] for key in words))

    async def show(request: Request) -> None:
        each, data = asked_for(request), await body(request)
        write_json(each.folder / "about.json", {**each.about, "open": bool(data.get("open"))})

    async def given(request: Request) -> Response:
        each, name = asked_for(request), request.path_params["file"]
        return handed(each.issued_zip() if name == "issued.zip" else each.files().get(name))

    def behind(path: str, door: Door, method: str = "GET") -> Route:
        async def inside(request: Request) -> Response | Data | None:
            if not request.session.get("teacher"):
                raise HTTPException(403, "войдите с ключом преподавателя")
            return await door(request)

        return route(f"/api/teacher{path}", inside, method)

    return [
        route("/api/login", login, "POST"),
        behind("", listed),
        behind("", issue, "POST"),
        behind("/{name}", about),
        behind("/{name}/file/{file:path}", given),
        behind("/{name}/file/{file}", upload, "POST"),
        behind("/{name}/grade", grade, "POST"),
        behind("/{name}/open", show, "POST"),
    ]


def student_routes(classes: Classes) -> list[Route]:
    """Doors of the students: each knows the own one alone."""

    def own(request: Request) -> tuple[Class, Issued, Data]:
        each, book = classes.student(request.path_params["link"])
        rows = each.rows if each.about.get("open") else ()
        return each, book, next((row for row in rows if row["number"] == book.number), {})

    async def about(request: Request) -> Data:
        each, book, row = own(request)
        return {
            "title": each.about["title"], "student": book.student.full, "file": book.file,
            "handed": each.work(book).exists(), "open": bool(row.get("page")),
            "points": row.get("points"), "status": row.get("status", ""),
        }  # fmt: skip

    async def issued(request: Request) -> Response:
        each, book, _ = own(request)
        return handed(each.issued(book))

    async def page(request: Request) -> Response:
        each, _, row = own(request)
        return handed(each.files().get(row.get("page", "")))

    async def hand_in(request: Request) -> None:
        each, book, _ = own(request)
        async with uploaded(request, MOST_BOOK) as path:
            check_data(path.read_bytes(), "работа")
            path.replace(each.work(book))

    student = "/api/student/{link}"
    return [
        route(student, about),
        route(f"{student}/book", issued),
        route(f"{student}/page", page),
        route(f"{student}/work", hand_in, "POST"),
    ]
