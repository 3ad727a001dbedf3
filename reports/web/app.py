"""The pages and what they ask for."""

from __future__ import annotations

import contextlib
import secrets
from collections.abc import AsyncIterator, Callable
from dataclasses import dataclass
from pathlib import Path
from string import Template
from typing import Any
from urllib.parse import urlsplit

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.middleware.gzip import GZipMiddleware
from starlette.middleware.sessions import SessionMiddleware
from starlette.requests import Request
from starlette.responses import HTMLResponse, Response
from starlette.routing import Mount
from starlette.staticfiles import StaticFiles

from reports.grading.issuing.ticket import make_secret, read_secret
from reports.inputs.described import Data
from reports.inputs.sections.cycle import KINDS
from reports.inputs.sections.input_file import LAYOUTS, STROKES
from reports.inputs.template import list_samples
from reports.shared.aside import processors
from reports.shared.errors import KshmError
from reports.shared.files import make_dir
from reports.shared.resources import resource_dir
from reports.shared.workers import Workers
from reports.web import engine, files
from reports.web.classes import Classes
from reports.web.doors import (
    MOST_BOOK,
    Door,
    Guard,
    Rate,
    ask,
    body,
    failed,
    refusal,
    route,
    uploaded,
)

STATIC = Path(__file__).parent / "static"
BOOK_S = 60.0
SESSION_S = 12 * 3600
_OWN_NAMES = ("127.0.0.1", "localhost", "::1")
_ANSWERS = 5_000  # of a solving process


@dataclass(frozen=True, slots=True)
class Settings:
    """How the page is served."""

    data: Path  # folder of all that is kept
    hosts: tuple[str, ...] = ()  # names under which it is known, besides this machine's own
    public: str = ""  # where a proxy shows it; by https cookies go no other way
    dask: str | None = None  # address of a cluster that builds the files
    per_s: float = 200.0  # requests a second of one address: a class may stand behind one
    workers: int | None = None  # processes that solve; None takes the processors
    body_s: float = 30.0  # seconds that the body of a form may take


def page(name: str, root: str = ".") -> Door:
    """A page whose script lies beside this module; ``root`` leads from its address."""
    text = Template((STATIC / "page.html").read_text(encoding="utf-8"))

    async def shown(request: Request) -> Response:
        request.session.setdefault("visitor", secrets.token_urlsafe(16))  # the place in the queue
        return HTMLResponse(text.substitute(name=name, root=root))

    return shown


def asked(function: Callable[..., Data], *keys: str) -> Door:
    """A question to the solving processes: values of these keys of a request, or all of it."""

    async def answer(request: Request) -> Response | Data:
        data = await body(request)
        try:
            return await ask(request, function, *([data.get(key) for key in keys] or [data]))
        except KshmError as error:  # usual while one types
            return refusal(200, error)

    return answer


async def choices(_: Request) -> Data:
    """What may be chosen before there is an engine."""
    return {"samples": list_samples(), "layouts": LAYOUTS, "strokes": STROKES, "kinds": KINDS,
            "files": files.KINDS}  # fmt: skip


async def book(request: Request) -> Data:
    """The input that an edited workbook holds, read by a solving process."""
    async with uploaded(request, MOST_BOOK) as path:
        return await ask(request, engine.read_book, str(path), seconds=BOOK_S)


def server_secret(folder: Path) -> bytes:
    """What makes links unguessable: made once, then kept beside the files."""
    path = folder / "secret.key"
    return read_secret(path) if path.exists() else make_secret(path)


def create_app(settings: Settings) -> Guard:
    """The whole application, the guard before it."""
    make_dir(settings.data)
    secret, count = server_secret(settings.data), settings.workers or processors()
    jobs = files.Jobs(settings.data / "jobs", secret, count, settings.dask)
    classes = Classes(settings.data / "classes", secret, settings.dask)

    @contextlib.asynccontextmanager
    async def lifespan(app: Starlette) -> AsyncIterator[None]:
        async with jobs.working(), classes.working():
            with Workers(count, engine.ready, most=_ANSWERS) as app.state.workers:
                yield

    routes = [
        route("/", page("engine")),
        route("/teacher", page("teacher")),
        route("/s/{link}/", page("student", "../..")),
        Mount("/static", StaticFiles(directory=STATIC)),
        Mount("/images", StaticFiles(directory=resource_dir("docs/images"))),
        route("/api/choices", choices),
        route("/api/new", asked(engine.fresh), "POST"),
        route("/api/read", asked(engine.read_toml, "text"), "POST"),
        route("/api/start", asked(engine.start, "raw"), "POST"),
        route("/api/solve", asked(engine.answer, "raw", "sheet", "cylinder"), "POST"),
        route("/api/checks", asked(engine.checks, "raw"), "POST"),
        route("/api/toml", asked(engine.as_toml, "raw"), "POST"),
        route("/api/book", book, "POST"),
        *jobs.routes(),
        *classes.routes(),
    ]
    public = urlsplit(settings.public)
    prefixed = [Mount(public.path.rstrip("/"), routes=routes)] if public.path.strip("/") else []
    session = Middleware(
        SessionMiddleware, secret.hex(), "kshm", SESSION_S, same_site="lax",
        https_only=public.scheme == "https",
    )  # fmt: skip
    errors: Any = dict.fromkeys((KshmError, HTTPException, 500), failed)
    app = Starlette(
        routes=[*prefixed, *routes], lifespan=lifespan, exception_handlers=errors,
        middleware=[Middleware(GZipMiddleware, minimum_size=1000), session],
    )  # fmt: skip
    app.state.settings, app.state.jobs = settings, jobs
    hosts = frozenset({*_OWN_NAMES, *map(str.lower, settings.hosts), public.hostname or ""} - {""})
    origin = f"{public.scheme}://{public.netloc}" if public.netloc else ""
    return Guard(app, hosts, origin, Rate(10 * settings.per_s, 10))
