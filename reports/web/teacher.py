"""The instructor's door and the students' own pages."""

from __future__ import annotations

import hashlib
import hmac
import time
from collections.abc import Awaitable, Callable
from pathlib import Path

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Route

from reports.grading.issuing.register import Issued
from reports.shared.errors import InputError, Problem
from reports.shared.files import atomic_path
from reports.web import engine
from reports.web.classes import RESULTS, Class, Classes
from reports.web.files import Door, attachment, save_body
from reports.web.guard import Rate, body

COOKIE, HOURS = "kshm_teacher", 12
_TEXTS = ("title", "base", "roster", "rubric")
_ROW = ("number", "student", "status", "points", "provisional", "manual", "remark", "page")
_MOST_WORK = 30 * 2**20
_DONE = {"ok": True}
ClassDoor = Callable[[Request, Class], Awaitable[Response]]
StudentDoor = Callable[[Request, Class, Issued], Awaitable[Response]]


def token_of(secret: bytes) -> str:
    """What the instructor logs in with; the same as long as the server keeps its secret."""
    return hmac.new(secret, b"teacher", hashlib.sha256).hexdigest()[:32]


def _pass(secret: bytes, until: int) -> str:
    mark = hmac.new(secret, f"pass {until}".encode(), hashlib.sha256).hexdigest()
    return f"{until}.{mark}"


def _is_same(one: str, other: str) -> bool:
    return hmac.compare_digest(one.encode(), other.encode("utf-8", "replace"))


def _is_teacher(secret: bytes, given: str) -> bool:
    until = given.partition(".")[0]
    if not (until.isdigit() and until.isascii() and len(until) < 12) or int(until) < time.time():
        return False
    return _is_same(_pass(secret, int(until)), given)


def routes(classes: Classes, secret: bytes, secure: bool) -> list[Route]:
    """Doors of the instructor, all but the first behind the token."""
    tries = Rate(0.1, 10)

    async def login(request: Request) -> Response:
        given = str((await body(request)).get("token", ""))
        if not tries.allows(request.client.host if request.client else ""):
            raise HTTPException(429, "слишком много попыток; подождите минуту")
        if not _is_same(token_of(secret), given.strip()):
            raise HTTPException(403, "неверный ключ; его печатает команда kshm serve")
        answer = JSONResponse(_DONE)
        until = int(time.time()) + HOURS * 3600
        answer.set_cookie(COOKIE, _pass(secret, until), max_age=HOURS * 3600, httponly=True,
                          samesite="strict", secure=secure)  # fmt: skip
        return answer

    def guarded(door: Door) -> Door:
        async def behind(request: Request) -> Response:
            if not _is_teacher(secret, request.cookies.get(COOKIE, "")):
                raise HTTPException(403, "войдите с ключом преподавателя")
            return await door(request)

        return behind

    def of_class(door: ClassDoor) -> Door:
        async def inside(request: Request) -> Response:
            each = classes.find(request.path_params["name"])
            if each is None:
                raise HTTPException(404, "нет такой группы")
            return await door(request, each)

        return guarded(inside)

    async def listed(_: Request) -> Response:
        found = [{"name": each.folder.name, **each.about} for each in classes.all()]
        return JSONResponse({"classes": found})

    async def issue(request: Request) -> Response:
        data = await body(request)
        texts, seed = [str(data.get(key) or "") for key in _TEXTS], data.get("seed", 1)
        if not isinstance(seed, int) or isinstance(seed, bool) or abs(seed) > 10**9:
            raise InputError(Problem("seed", "нужно целое число", "например 1"))
        checked = await request.app.state.pool.ask(engine.checked_text, texts[1])
        if "errors" in checked:
            return JSONResponse(checked, 422)
        return JSONResponse({"name": classes.issue(seed, *texts).folder.name})

    async def about(_: Request, each: Class) -> Response:
        students = [
            {"number": book.number, "name": book.student.full, "group": book.student.group,
             "link": classes.link(each, book.number), "handed": each.work(book).exists()}
            for book in each.books
        ]  # fmt: skip
        return JSONResponse({
            **each.about, "state": each.state, "students": students, "unknown": each.unknown(),
            "rows": [{key: row.get(key) for key in _ROW} for row in each.rows],
            "files": [name for name in RESULTS if (each.results / name).exists()],
            "graded": sum(1 for _ in each.judged()),
        })  # fmt: skip

    async def works(request: Request, each: Class) -> Response:
        return await _kept(request, each.folder / "moodle.zip", b"PK\x03\x04")

    async def worksheet(request: Request, each: Class) -> Response:
        return await _kept(request, each.folder / "worksheet.csv", b"")

    async def grade(_: Request, each: Class) -> Response:
        classes.grade(each)
        return JSONResponse(_DONE)

    async def decide(request: Request, each: Class) -> Response:
        data = await body(request)
        words = tuple(str(data.get(key, ""))[:500] for key in ("who", "what", "points", "remark"))
        classes.grade(each, words)
        return JSONResponse(_DONE)

    async def show(request: Request, each: Class) -> Response:
        each.keep_open(bool((await body(request)).get("open")))
        return JSONResponse(_DONE)

    async def result(request: Request, each: Class) -> Response:
        name = request.path_params["file"]
        if name == "issued.zip":
            return attachment(each.issued_zip())
        path = each.results / name if name in RESULTS else None
        return shown(path) if path and path.suffix == ".html" else attachment(path)

    async def page(request: Request, each: Class) -> Response:
        return shown(each.page(request.path_params["number"]))

    mine = "/api/teacher/{name}"
    doors = {"works": works, "worksheet": worksheet, "grade": grade, "decide": decide, "open": show}
    return [
        Route("/api/login", login, methods=["POST"]),
        Route("/api/teacher", guarded(listed)),
        Route("/api/teacher", guarded(issue), methods=["POST"]),
        Route(mine, of_class(about)),
        Route(f"{mine}/page/{{number:int}}", of_class(page)),
        Route(f"{mine}/file/{{file}}", of_class(result)),
        *(
            Route(f"{mine}/{word}", of_class(door), methods=["POST"])
            for word, door in doors.items()
        ),
    ]


def student_routes(classes: Classes) -> list[Route]:
    """Doors of the students: each knows the own one alone."""

    def of_student(door: StudentDoor) -> Door:
        async def inside(request: Request) -> Response:
            known = classes.student(request.path_params["link"])
            if known is None:
                raise HTTPException(404, "нет такой страницы")
            return await door(request, *known)

        return inside

    async def own(_: Request, each: Class, book: Issued) -> Response:
        row = next((row for row in each.rows if row["number"] == book.number), {})
        seen = row if each.about.get("open") else {}
        return JSONResponse({
            "title": each.about["title"], "student": book.student.full, "file": book.file,
            "handed": each.work(book).exists(), "open": bool(seen.get("page")),
            "points": seen.get("points"), "status": seen.get("status", ""),
        })  # fmt: skip

    async def own_book(_: Request, each: Class, book: Issued) -> Response:
        return attachment(each.issued(book))

    async def own_page(_: Request, each: Class, book: Issued) -> Response:
        return shown(each.page(book.number) if each.about.get("open") else None)

    async def hand_in(request: Request, each: Class, book: Issued) -> Response:
        data = await request.body()
        if len(data) > _MOST_WORK:
            raise HTTPException(413, f"книга больше {_MOST_WORK // 2**20} МБ")
        each.keep_work(book, data)
        return JSONResponse(_DONE)

    student = "/api/student/{link}"
    return [
        Route(student, of_student(own)),
        Route(f"{student}/book", of_student(own_book)),
        Route(f"{student}/page", of_student(own_page)),
        Route(f"{student}/work", of_student(hand_in), methods=["POST"]),
    ]


def shown(path: Path | None) -> FileResponse:
    """A page about a work, which may hold a student's words: nothing in it may act."""
    if path is None or not path.exists():
        raise HTTPException(404, "такой страницы ещё нет")
    policy = "sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data:; font-src data:"
    return FileResponse(
        path, media_type="text/html; charset=utf-8", headers={"content-security-policy": policy}
    )


async def _kept(request: Request, target: Path, begin: bytes) -> Response:
    """Keep an uploaded file whole or not at all."""
    with atomic_path(target) as part:
        size = await save_body(request, part)
        with part.open("rb") as stream:
            if not size or stream.read(len(begin)) != begin:
                raise InputError(Problem("", "это не тот файл", "загрузите архив .zip"))
    return JSONResponse({"size": size})
