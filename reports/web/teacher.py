"""The instructor's door and the students' own pages."""

from __future__ import annotations

import hashlib
import hmac

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from reports.grading.issuing.register import Issued
from reports.inputs.described import Data
from reports.shared.errors import InputError, Problem
from reports.web import engine
from reports.web.classes import RESULTS, Class, Classes
from reports.web.doors import (
    MOST_ARCHIVE,
    MOST_BOOK,
    Door,
    attachment,
    body,
    good,
    route,
    shown,
    uploaded,
)
from reports.web.guard import Rate
from reports.workbook.intake import check_data

_TEXTS = ("title", "base", "roster", "rubric")
_UPLOADS = {"moodle.zip": b"PK\x03\x04", "worksheet.csv": b""}  # how they begin
_DONE = {"ok": True}


def token_of(secret: bytes) -> str:
    """What the instructor logs in with; the same as long as the server keeps its secret."""
    return hmac.new(secret, b"teacher", hashlib.sha256).hexdigest()[:32]


def routes(classes: Classes, secret: bytes) -> list[Route]:
    """Doors of the instructor, all but the first behind the token."""
    tries = Rate(0.1, 10)

    def asked_for(request: Request) -> Class:
        return classes.find(request.path_params["name"])

    async def login(request: Request) -> Data:
        given = str((await body(request)).get("token", "")).strip()
        if not tries.allows(request.client.host if request.client else ""):
            raise HTTPException(429, "слишком много попыток; подождите минуту")
        if not hmac.compare_digest(token_of(secret).encode(), given.encode("utf-8", "replace")):
            raise HTTPException(403, "неверный ключ; его печатает команда kshm serve")
        request.session["teacher"] = True
        return _DONE

    async def listed(_: Request) -> Data:
        return {"classes": [{"name": each.folder.name, **each.about} for each in classes.all()]}

    async def issue(request: Request) -> Data:
        data = await body(request)
        texts, seed = [str(data.get(key) or "") for key in _TEXTS], data.get("seed", 1)
        if not isinstance(seed, int) or isinstance(seed, bool) or abs(seed) > 10**9:
            raise InputError(Problem("seed", "нужно целое число", "например 1"))
        ask = request.app.state.pool.ask  # a base without its ranges is an input of its own
        good(await ask(engine.as_toml, good(await ask(engine.read_toml, texts[1]))["raw"]))
        return {"name": classes.issue(seed, *texts).folder.name}

    async def about(request: Request) -> Data:
        each = asked_for(request)
        students = [
            {"number": book.number, "name": book.student.full, "group": book.student.group,
             "link": classes.link(each, book.number), "handed": each.work(book).exists()}
            for book in each.books
        ]  # fmt: skip
        return {
            **each.about, **classes.about(each.folder.name), "students": students,
            "graded": max(0, len([*each.results.glob("results/*.json")]) - 1),  # and the register
            "rows": each.rows,
            "files": [name for name in RESULTS if (each.results / name).exists()],
        }  # fmt: skip

    async def upload(request: Request) -> Data:
        folder, name = asked_for(request).folder, request.path_params["file"]
        if name not in _UPLOADS:
            raise HTTPException(404, "такого файла здесь не ждут")
        async with uploaded(request, MOST_ARCHIVE) as path:
            with path.open("rb") as stream:
                begin = stream.read(4)
            if not begin or not begin.startswith(_UPLOADS[name]):
                raise InputError(Problem("", "это не тот файл", "загрузите архив .zip"))
            path.replace(folder / name)
        return _DONE

    async def grade(request: Request) -> Data:
        each, data = asked_for(request), await body(request)
        words = ("who", "what", "points", "remark") if "who" in data else ()
        classes.grade(each, tuple(str(data.get(key, ""))[:500] for key in words))
        return _DONE

    async def show(request: Request) -> Data:
        each = asked_for(request)
        each.keep_open(bool((await body(request)).get("open")))
        return _DONE

    async def result(request: Request) -> Response:
        each, name = asked_for(request), request.path_params["file"]
        if name == "issued.zip":
            return attachment(each.issued_zip())
        path = each.results / name if name in RESULTS else None
        return shown(path) if path and path.suffix == ".html" else attachment(path)

    async def page(request: Request) -> Response:
        return shown(asked_for(request).page(request.path_params["number"]))

    def behind(door: Door) -> Door:
        async def inside(request: Request) -> Response | Data:
            if not request.session.get("teacher"):
                raise HTTPException(403, "войдите с ключом преподавателя")
            return await door(request)

        return inside

    mine = "/api/teacher/{name}"
    return [
        route("/api/login", login, "POST"),
        route("/api/teacher", behind(listed)),
        route("/api/teacher", behind(issue), "POST"),
        route(mine, behind(about)),
        route(f"{mine}/page/{{number:int}}", behind(page)),
        route(f"{mine}/file/{{file}}", behind(result)),
        route(f"{mine}/file/{{file}}", behind(upload), "POST"),
        route(f"{mine}/grade", behind(grade), "POST"),
        route(f"{mine}/open", behind(show), "POST"),
    ]


def student_routes(classes: Classes) -> list[Route]:
    """Doors of the students: each knows the own one alone."""

    def own(request: Request) -> tuple[Class, Issued]:
        return classes.student(request.path_params["link"])

    async def about(request: Request) -> Data:
        each, book = own(request)
        seen = each.row(book.number) if each.about.get("open") else {}
        return {
            "title": each.about["title"], "student": book.student.full, "file": book.file,
            "handed": each.work(book).exists(), "open": bool(seen.get("page")),
            "points": seen.get("points"), "status": seen.get("status", ""),
        }  # fmt: skip

    async def issued(request: Request) -> Response:
        each, book = own(request)
        return attachment(each.issued(book))

    async def page(request: Request) -> Response:
        each, book = own(request)
        return shown(each.page(book.number) if each.about.get("open") else None)

    async def hand_in(request: Request) -> Data:
        each, book = own(request)
        async with uploaded(request, MOST_BOOK) as path:
            check_data(path.read_bytes(), "работа")
            path.replace(each.work(book))
        return _DONE

    student = "/api/student/{link}"
    return [
        route(student, about),
        route(f"{student}/book", issued),
        route(f"{student}/page", page),
        route(f"{student}/work", hand_in, "POST"),
    ]
