"""The instructor's door and the students' own pages."""

from __future__ import annotations

import hashlib
import hmac
import time
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Route

from reports.shared.errors import InputError, Problem
from reports.web import engine
from reports.web.asked import body
from reports.web.classes import RESULTS, Class, Classes, issued_zip, keep_open, keep_work
from reports.web.files import attachment, save_body
from reports.web.guard import Rate, refusal

COOKIE, HOURS = "kshm_teacher", 12
_TEXTS = ("title", "base", "roster", "rubric")
_MOST_WORK = 30 * 2**20


def token_of(secret: bytes) -> str:
    """What the instructor logs in with; the same as long as the server keeps its secret."""
    return hmac.new(secret, b"teacher", hashlib.sha256).hexdigest()[:32]


def _pass(secret: bytes, until: int) -> str:
    mark = hmac.new(secret, f"pass {until}".encode(), hashlib.sha256).hexdigest()
    return f"{until}.{mark}"


def _is_teacher(secret: bytes, given: str) -> bool:
    until = given.partition(".")[0]
    if not (until.isdigit() and until.isascii() and len(until) < 12) or int(until) < time.time():
        return False
    return hmac.compare_digest(_pass(secret, int(until)).encode(), given.encode("utf-8", "replace"))


Door = Callable[[Request], Awaitable[Response]]
ClassDoor = Callable[[Request, Class], Awaitable[Response]]


def routes(classes: Classes, secret: bytes, secure: bool) -> list[Route]:
    """Doors of the instructor, all but the first behind the token."""
    tries = Rate(0.1, 10)

    async def login(request: Request) -> Response:
        given = str((await body(request)).get("token", ""))
        if not tries.allows(request.client.host if request.client else ""):
            return refusal(429, "слишком много попыток; подождите минуту")
        if not hmac.compare_digest(
            token_of(secret).encode(), given.strip().encode("utf-8", "replace")
        ):
            return refusal(403, "неверный ключ; его печатает команда kshm serve")
        answer = JSONResponse({"ok": True})
        until = int(time.time()) + HOURS * 3600
        answer.set_cookie(COOKIE, _pass(secret, until), max_age=HOURS * 3600, httponly=True,
                          samesite="strict", secure=secure)  # fmt: skip
        return answer

    def guarded(door: Door) -> Door:
        async def behind(request: Request) -> Response:
            if not _is_teacher(secret, request.cookies.get(COOKIE, "")):
                return refusal(403, "войдите с ключом преподавателя")
            return await door(request)

        return behind

    def of_class(door: ClassDoor) -> Door:
        async def found(request: Request) -> Response:
            each = classes.find(request.path_params["name"])
            return refusal(404, "нет такой группы") if each is None else await door(request, each)

        return guarded(found)

    async def listed(_: Request) -> Response:
        return JSONResponse({"classes": [
            {"name": each.folder.name, **each.about, "state": each.state} for each in classes.all()
        ]})  # fmt: skip

    async def issue(request: Request) -> Response:
        data = await body(request)
        texts = [str(data.get(key) or "") for key in _TEXTS]
        seed = data.get("seed", 1)
        if not isinstance(seed, int) or isinstance(seed, bool) or abs(seed) > 10**9:
            raise InputError(Problem("seed", "нужно целое число", "например 1"))
        checked = await request.app.state.pool.ask(engine.checked_text, texts[1])
        if "errors" in checked:
            return JSONResponse(checked, 422)
        return JSONResponse({"name": classes.issue(seed, *texts).folder.name})

    async def about(_: Request, each: Class) -> Response:
        register = each.register
        students = [
            {"number": book.number, "name": book.student.full, "group": book.student.group,
             "link": classes.link(each, book.number), "handed": each.work(book.folder).exists()}
            for book in (register.books if register else ())
        ]  # fmt: skip
        keys = ("number", "student", "status", "points", "provisional", "manual", "remark", "page")
        rows = [{key: row.get(key) for key in keys} for row in each.rows]
        files = [name for name in RESULTS if (each.folder / "results" / name).exists()]
        return JSONResponse({
            **each.about, "state": each.state, "students": students, "rows": rows, "files": files,
            "unknown": each.unknown(), "graded": each.graded(),
        })  # fmt: skip

    async def works(request: Request, each: Class) -> Response:
        return await _kept(request, each.folder / "moodle.zip", b"PK\x03\x04")

    async def worksheet(request: Request, each: Class) -> Response:
        return await _kept(request, each.folder / "worksheet.csv", b"")

    async def grade(_: Request, each: Class) -> Response:
        classes.grade(each)
        return JSONResponse({"ok": True})

    async def decide(request: Request, each: Class) -> Response:
        data = await body(request)
        who, what, points, remark = (str(data.get(key, ""))[:500] for key in
                                     ("who", "what", "points", "remark"))  # fmt: skip
        classes.decide(each, (who, what or "всё", points, remark))
        return JSONResponse({"ok": True})

    async def show(request: Request, each: Class) -> Response:
        keep_open(each, bool((await body(request)).get("open")))
        return JSONResponse({"ok": True})

    async def result(request: Request, each: Class) -> Response:
        name = request.path_params["file"]
        path = issued_zip(each) if name == "issued.zip" else each.folder / "results" / name
        if name not in (*RESULTS, "issued.zip") or not path.exists():
            return refusal(404, "нет такого файла")
        return shown(path) if name.endswith(".html") else attachment(path)

    async def page(request: Request, each: Class) -> Response:
        path = each.page(request.path_params["number"])
        return shown(path) if path else refusal(404, "нет такой страницы")

    mine = "/api/teacher/{name}"
    return [
        Route("/api/login", login, methods=["POST"]),
        Route("/api/teacher", guarded(listed)),
        Route("/api/teacher", guarded(issue), methods=["POST"]),
        Route(mine, of_class(about)),
        Route(f"{mine}/page/{{number:int}}", of_class(page)),
        Route(f"{mine}/file/{{file}}", of_class(result)),
        *(Route(f"{mine}/{word}", of_class(door), methods=["POST"]) for word, door in
          (("works", works), ("worksheet", worksheet), ("grade", grade), ("decide", decide),
           ("open", show))),
    ]  # fmt: skip


def student_routes(classes: Classes) -> list[Route]:
    """Doors of the students: each knows the own one alone."""

    def of_student(door: Callable[[Request, Class, Any], Awaitable[Response]]) -> Door:
        async def found(request: Request) -> Response:
            known = classes.student(request.path_params["link"])
            return (
                refusal(404, "нет такой страницы") if known is None else await door(request, *known)
            )

        return found

    async def own(_: Request, each: Class, book: Any) -> Response:  # noqa: ANN401
        is_open = bool(each.about.get("open"))
        row = next((row for row in each.rows if row["number"] == book.number), {})
        return JSONResponse({
            "title": each.about["title"], "student": book.student.full, "file": book.file,
            "handed": each.work(book.folder).exists(), "open": is_open and bool(row.get("page")),
            "points": row.get("points") if is_open else None,
            "status": row.get("status", "") if is_open else "",
        })  # fmt: skip

    async def own_book(_: Request, each: Class, book: Any) -> Response:  # noqa: ANN401
        return attachment(each.folder / "issued" / book.folder / book.file)

    async def own_page(_: Request, each: Class, book: Any) -> Response:  # noqa: ANN401
        path = each.page(book.number) if each.about.get("open") else None
        return shown(path) if path else refusal(404, "страница ещё не открыта")

    async def hand_in(request: Request, each: Class, book: Any) -> Response:  # noqa: ANN401
        data = await request.body()
        if len(data) > _MOST_WORK:
            return refusal(413, f"книга больше {_MOST_WORK // 2**20} МБ")
        keep_work(each, book.folder, data)
        return JSONResponse({"ok": True})

    student = "/api/student/{link}"
    return [
        Route(student, of_student(own)),
        Route(f"{student}/book", of_student(own_book)),
        Route(f"{student}/page", of_student(own_page)),
        Route(f"{student}/work", of_student(hand_in), methods=["POST"]),
    ]


def shown(path: Path) -> FileResponse:
    """A page about a work, which may hold a student's words: nothing in it may act."""
    policy = "sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data:; font-src data:"
    return FileResponse(
        path, media_type="text/html; charset=utf-8", headers={"content-security-policy": policy}
    )


async def _kept(request: Request, target: Path, begin: bytes) -> Response:
    """Keep an uploaded file whole or not at all."""
    part = target.with_name(f"{target.name}.{time.time_ns()}.part")
    try:
        size = await save_body(request, part)
        with part.open("rb") as stream:
            if not size or not stream.read(len(begin)) == begin:
                raise InputError(Problem("", "это не тот файл", "загрузите архив .zip"))
        part.replace(target)
    finally:
        part.unlink(missing_ok=True)
    return JSONResponse({"size": size})
