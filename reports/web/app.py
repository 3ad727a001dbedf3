"""The pages and what they ask for."""

from __future__ import annotations

import contextlib
import secrets
from collections.abc import AsyncIterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.middleware.gzip import GZipMiddleware
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles

from reports.grading.issuing.ticket import make_secret, read_secret
from reports.inputs.sections.cycle import KINDS
from reports.inputs.sections.input_file import LAYOUTS, STROKES
from reports.inputs.template import list_samples
from reports.shared.errors import KshmError
from reports.shared.files import make_dir
from reports.shared.resources import resource_dir
from reports.web import engine, files, teacher
from reports.web.classes import Classes
from reports.web.guard import BODY_S, Guard, Rate, body, mapping, refusal
from reports.web.jobs import Jobs
from reports.web.pool import Busy, Pool, processors

STATIC = Path(__file__).parent / "static"
MOST_FILE = 100_000_000


@dataclass(frozen=True, slots=True)
class Settings:
    """How the page is served.

    Attributes:
        data: folder of all that is kept.
        hosts: names under which it is known, besides this machine's own.
        prefix: path under which a proxy shows it.
        secure: it is known by https: cookies go no other way.
        dask: address of a cluster that builds the files.
        per_s: requests a second of one address: a class may stand behind one.
        workers: processes that solve; None takes the processors.
        body_s: seconds that the body of a form may take.
    """

    data: Path
    hosts: tuple[str, ...] = ()
    prefix: str = ""
    secure: bool = False
    dask: str | None = None
    per_s: float = 200.0
    workers: int | None = None
    body_s: float = BODY_S


def page(name: str) -> files.Door:
    """A page as it lies beside this module."""

    async def shown(request: Request) -> Response:
        answer = FileResponse(STATIC / name)
        if "kshm" not in request.cookies:  # only the place in the queue hangs on it
            answer.set_cookie("kshm", secrets.token_urlsafe(16), httponly=True, samesite="strict")
        return answer

    return shown


def asked(function: Any, *keys: str) -> files.Door:  # noqa: ANN401
    """A question to the solving processes: values of these keys of a request, or all of it."""

    async def answer(request: Request) -> Response:
        data = await body(request)
        values: list[Any] = [
            mapping(data, key) if key == "raw" else data.get(key, 0 if key == "cylinder" else "")
            for key in keys
        ]
        return JSONResponse(await request.app.state.pool.ask(function, *(values or [data])))

    return answer


async def choices(_: Request) -> Response:
    """What may be chosen before there is an engine."""
    return JSONResponse({"samples": list_samples(), "layouts": LAYOUTS, "strokes": STROKES,
                         "kinds": KINDS, "files": files.kinds()})  # fmt: skip


def server_secret(folder: Path) -> bytes:
    """What makes links unguessable: made once, then kept beside the files."""
    path = folder / "secret.key"
    return read_secret(path) if path.exists() else make_secret(path)


def create_app(settings: Settings) -> Guard:
    """The whole application, the guard before it."""
    make_dir(settings.data)
    secret, pool = server_secret(settings.data), Pool(settings.workers)
    jobs = Jobs(settings.data / "jobs", secret, settings.workers or processors())
    classes = Classes(settings.data / "classes", secret, settings.dask)

    @contextlib.asynccontextmanager
    async def lifespan(_: Starlette) -> AsyncIterator[None]:
        pool.start()
        jobs.start()
        classes.start()
        try:
            yield
        finally:
            await classes.stop()
            await jobs.stop()
            pool.stop()

    questions = {
        "new": asked(engine.fresh),
        "read": asked(engine.read_toml, "text"),
        "start": asked(engine.start, "raw"),
        "solve": asked(engine.answer, "raw", "sheet", "cylinder"),
        "checks": asked(engine.checks, "raw"),
        "toml": asked(engine.as_toml, "raw"),
        "book": files.book,
        "files": files.order(jobs, settings.dask),
    }
    routes = [
        Route("/", page("engine.html")),
        Route("/teacher", page("teacher.html")),
        Route("/s/{link}/", page("student.html")),
        *teacher.routes(classes, secret, settings.secure),
        *teacher.student_routes(classes),
        Mount("/static", StaticFiles(directory=STATIC)),
        Mount("/images", StaticFiles(directory=resource_dir("docs/images"))),
        Route("/api/choices", choices),
        *(Route(f"/api/{name}", door, methods=["POST"]) for name, door in questions.items()),
        Route("/api/files/{job}", files.about(jobs)),
        Route("/api/files/{job}/{name}", files.taken(jobs)),
    ]
    app = Starlette(
        routes=routes, lifespan=lifespan, exception_handlers=handlers(),
        middleware=[Middleware(GZipMiddleware, minimum_size=1000)],
    )  # fmt: skip
    app.state.pool, app.state.settings = pool, settings
    app.state.jobs, app.state.classes = jobs, classes
    hosts = frozenset({"127.0.0.1", "localhost", "::1", *map(str.lower, settings.hosts)})
    rate = Rate(settings.per_s, 2 * settings.per_s)
    return Guard(app, hosts, settings.prefix, MOST_FILE, rate, settings.body_s)


def handlers() -> dict[Any, Any]:
    """What becomes of errors: a line for the person, never a traceback."""

    async def expected(_: Request, error: KshmError) -> Response:
        return JSONResponse({"errors": [engine.as_dict(p) for p in error.problems]}, 422)

    async def busy(_: Request, __: Exception) -> Response:
        return refusal(503, "сервер занят или данные не считаются за отведённое время; повторите")

    async def refused(_: Request, error: HTTPException) -> Response:
        ours = not error.detail.isascii()
        return refusal(error.status_code, error.detail if ours else "нет такой страницы")

    async def unexpected(_: Request, error: Exception) -> Response:
        return refusal(500, f"внутренняя ошибка {type(error).__name__}")

    return {KshmError: expected, Busy: busy, HTTPException: refused, 500: unexpected}
