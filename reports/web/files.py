"""Which files the page offers, and what a person's files go through on the way in and out."""

from __future__ import annotations

import tempfile
from collections.abc import Awaitable, Callable
from pathlib import Path

import click
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response

from reports.commands.engine import build
from reports.shared.errors import InputError, Problem
from reports.web import engine
from reports.web.guard import body, mapping
from reports.web.jobs import Jobs

Door = Callable[[Request], Awaitable[Response]]
NO_FILE = "нет такого файла; закажите заново"
_TITLES = {
    "xlsx": "Книга Excel", "pdf": "Отчёт PDF", "html": "Отчёт HTML", "docx": "Отчёт Word",
    "sheet": "Лист А1",
}  # fmt: skip
_MOST_BOOK = 30 * 2**20
_BOOK_S = 60.0


def kinds() -> dict[str, str]:
    """Kinds of files and their titles: those of ``kshm build --only``, numbers, a comparison."""
    only = next(option for option in build.params if option.name == "only")
    assert isinstance(only.type, click.Choice)
    return {
        **{str(kind): _TITLES.get(str(kind), str(kind)) for kind in only.type.choices},
        "csv": "Таблицы CSV", "json": "Числа JSON",
        "compare-xlsx": "Сравнение: книга", "compare-pdf": "Сравнение: PDF",
    }  # fmt: skip


def command(kind: str, dask: str | None) -> list[str]:
    """What makes a kind of file out of ``engine.toml`` (and ``other.toml``) into ``out``."""
    if kind.startswith("compare-"):
        return ["compare", "engine.toml", "other.toml", "-o", f"out/compare.{kind[8:]}"]
    if kind in ("csv", "json"):
        where = "csv" if kind == "csv" else "out/engine.json"
        return ["solve", "engine.toml", f"--{kind}", where]
    far = ["--dask", dask] if dask else []
    return ["build", "engine.toml", "-o", "out", "--only", kind, *far]


def order(jobs: Jobs, dask: str | None) -> Door:
    """The door at which files are ordered."""
    known = kinds()

    async def ordered(request: Request) -> Response:
        data = await body(request)
        kind = data.get("kind")
        if not isinstance(kind, str) or kind not in known:
            raise InputError(Problem("kind", "нет такого вида файла", "обновите страницу"))
        wanted = {"engine.toml": mapping(data, "raw")}
        if kind.startswith("compare-"):
            if not isinstance(data.get("other"), dict):
                raise InputError(Problem("", "нет второго двигателя", "нажмите «Сравнить с этим»"))
            wanted["other.toml"] = data["other"]
        files = {}
        for name, raw in wanted.items():
            text = await request.app.state.pool.ask(engine.as_toml, raw)
            if "errors" in text:
                return JSONResponse(text, 422)
            files[name] = text["text"]
        return JSONResponse({"id": jobs.add(files, [command(kind, dask)], visitor(request))})

    return ordered


def visitor(request: Request) -> str:
    """Who orders: a browser by its cookie, else an address."""
    return request.cookies.get("kshm", "")[:64] or (request.client.host if request.client else "")


def about(jobs: Jobs) -> Door:
    """How far an order is."""

    async def told(request: Request) -> Response:
        found = jobs.about(request.path_params["job"])
        if found is None:
            raise HTTPException(404, NO_FILE)
        return JSONResponse(found)

    return told


def taken(jobs: Jobs) -> Door:
    """A file that was made."""

    async def given(request: Request) -> Response:
        return attachment(jobs.file(request.path_params["job"], request.path_params["name"]))

    return given


def attachment(path: Path | None) -> FileResponse:
    """A file to be kept, never to be shown by the browser as a page of ours."""
    if path is None or not path.exists():
        raise HTTPException(404, NO_FILE)
    return FileResponse(path, filename=path.name, media_type="application/octet-stream")


async def save_body(request: Request, target: Path) -> int:
    """Write the body of a request to a file as it comes; its size."""
    with target.open("wb") as stream:
        async for chunk in request.stream():
            stream.write(chunk)
        return stream.tell()


async def book(request: Request) -> Response:
    """The input that an edited workbook holds, read by a solving process."""
    state = request.app.state
    with tempfile.TemporaryDirectory(prefix="book-", dir=state.settings.data) as name:
        path = Path(name) / "книга.xlsx"
        if await save_body(request, path) > _MOST_BOOK:
            raise HTTPException(413, f"книга больше {_MOST_BOOK // 2**20} МБ")
        found = await state.pool.ask(engine.read_book, str(path), seconds=_BOOK_S)
    return JSONResponse(found, 422 if "errors" in found else 200)
