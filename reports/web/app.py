"""Application: pages, static files, routes."""

from __future__ import annotations

import contextlib
import secrets
import shutil
from collections.abc import AsyncIterator
from html import escape
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

from reports.grading.issuing.register import SECRET, kept_secret
from reports.inputs.department_chapters import OWNER
from reports.inputs.form_fields import Data
from reports.inputs.sections.gas import KINDS
from reports.inputs.sections.input_file import LAYOUTS, STROKES
from reports.model.contents import contents_of
from reports.shared.background import processors
from reports.shared.errors import KshmError
from reports.shared.files import private_dir
from reports.shared.resources import resource_dir
from reports.shared.workers import Workers
from reports.web import engine
from reports.web.classes import Classes
from reports.web.http_guards import (
    Desk,
    Guard,
    Settings,
    address_of_server,
    answer,
    book,
    failed,
    get,
    post,
    read,
)  # fmt: skip
from reports.web.jobs import OFFERED, Jobs
from reports.web.shared_engines import Turns, Unfinished
from reports.workbook.chart_parts import COLOURS

STATIC = Path(__file__).parent / "static"
SESSION_S = 12 * 3600
_PAGES = {
    "engine": ("Кривошипно-шатунный механизм: кинематика и динамика", "Двигатель, который считает "
               "сам себя: меняйте размеры, и всё движется: силы, момент, нагрузки, проверки."),
    "teacher": ("Группы: варианты и проверка работ", "Страница преподавателя."),
    "student": ("Моя работа: кинематика и динамика двигателя", "Задание, рабочая книга, срок и "
                "сдача."),
}  # fmt: skip  # title of a page and what its link says of it


async def page(request: Request, name: str, root: str = ".") -> Response:
    """Return a page whose script lies beside this module; ``root`` leads from its address."""
    request.session.setdefault("visitor", secrets.token_urlsafe(16))  # the place in the queue
    text, (title, about) = (
        Template((STATIC / "page.html").read_text(encoding="utf-8")),
        _PAGES[name],
    )
    return HTMLResponse(text.substitute(name=name, root=root, title=title, about=about,
                                        address=escape(address_of_server(request))))  # fmt: skip


async def choices(_: Request) -> Data:
    """Return what may be chosen before there is an engine."""
    chapters = [chapter.colour for chapter in contents_of().chapters]
    return {"samples": engine.samples(), "layouts": LAYOUTS, "strokes": STROKES, "kinds": KINDS,
            "fields": engine.FORM, "shapes": engine.SHAPES,
            "palette": [*COLOURS, chapters[2], chapters[7]],
            "files": {kind: title for kind, (title, _) in OFFERED.items()}}  # fmt: skip


def create_app(settings: Settings) -> Guard:
    """Return the whole application, the guard before it."""
    private_dir(settings.data, SECRET)
    for path in (*settings.data.glob("book-*"), *settings.data.rglob(".kshm-*")):  # half written
        shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
    # What makes links unguessable, kept beside the files.
    secret, count = kept_secret(settings.data / SECRET), settings.workers or processors()
    books = settings.own_books
    folders = {OWNER: books}
    jobs = Jobs(settings.data / "jobs", secret, settings.dask, count, folders)
    classes = Classes(settings.data / "classes", secret, settings.dask, folders)

    @contextlib.asynccontextmanager
    async def lifespan(app: Starlette) -> AsyncIterator[None]:
        async with jobs.working(), classes.working():
            # Numbers and books apart: a book may take seconds, a number takes hundredths.
            numbers = Workers(count, engine.ready, books, most=5_000)
            readers = Workers(1, engine.ready_for_books, books)
            with numbers, readers:
                app.state.answers = Desk(numbers, Turns(count, 200, 4, 0.05))
                app.state.readers = Desk(readers, Turns(1, 60, 2, 2.0))
                yield

    routes = [
        get("/", page, "engine"),
        get("/teacher", page, "teacher"),
        get("/s/{link}/", page, "student", "../.."),
        Mount("/static", StaticFiles(directory=STATIC)),
        Mount("/images", StaticFiles(directory=resource_dir("docs/images"))),
        get("/api/choices", choices),
        post("/api/new", answer, engine.fresh),
        post("/api/read", read),
        post("/api/start", answer, engine.start, "raw"),
        post("/api/settle", answer, engine.settle, "raw"),
        post("/api/book", book),
        *jobs.routes(),
        *classes.routes(),
    ]
    public = urlsplit(settings.public)
    session = Middleware(
        SessionMiddleware, secret.hex(), "kshm", SESSION_S, same_site="lax",
        path=f"{public.path.rstrip('/')}/", https_only=public.scheme == "https",
    )  # fmt: skip
    errors: Any = dict.fromkeys((KshmError, HTTPException, OSError, 500), failed)
    app = Starlette(
        routes=[Mount(at, routes=routes) for at in dict.fromkeys((public.path.rstrip("/"), ""))],
        lifespan=lifespan, exception_handlers=errors,
        middleware=[Middleware(GZipMiddleware, 1000, 4), session],
    )  # fmt: skip
    app.state.settings, app.state.jobs = settings, jobs
    app.state.unfinished, app.state.uploading = Unfinished(2**30), Turns(32, 200, 2, 1.0)
    return Guard(app, settings)
