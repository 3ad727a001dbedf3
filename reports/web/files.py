"""Which files the page offers, ordered and taken."""

from __future__ import annotations

import click
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from reports.commands.engine import build
from reports.inputs.described import Data
from reports.shared.errors import InputError, Problem
from reports.web import engine
from reports.web.doors import attachment, body, good, route
from reports.web.jobs import Jobs

_TITLES = {
    "xlsx": "Книга Excel", "pdf": "Отчёт PDF", "html": "Отчёт HTML", "docx": "Отчёт Word",
    "sheet": "Лист А1", "csv": "Таблицы CSV", "json": "Числа JSON",
    "compare-xlsx": "Сравнение: книга", "compare-pdf": "Сравнение: PDF",
}  # fmt: skip


def kinds() -> dict[str, str]:
    """Kinds of files and their titles: those of ``kshm build --only``, numbers, a comparison."""
    only = next(option for option in build.params if option.name == "only")
    assert isinstance(only.type, click.Choice)
    return {str(kind): str(kind) for kind in only.type.choices} | _TITLES


def command(kind: str, dask: str | None) -> list[str]:
    """What makes a kind of file out of ``engine.toml`` (and ``other.toml``) into ``out``."""
    if kind.startswith("compare-"):
        return ["compare", "engine.toml", "other.toml", "-o", f"out/compare.{kind[8:]}"]
    if kind in ("csv", "json"):
        where = "csv" if kind == "csv" else "out/engine.json"
        return ["solve", "engine.toml", f"--{kind}", where]
    far = ["--dask", dask] if dask else []
    return ["build", "engine.toml", "-o", "out", "--only", kind, *far]


def routes(jobs: Jobs, dask: str | None) -> list[Route]:
    """Doors at which files are ordered, asked after and taken."""
    known = kinds()

    async def ordered(request: Request) -> Data:
        data = await body(request)
        kind = data.get("kind")
        if not isinstance(kind, str) or kind not in known:
            raise InputError(Problem("kind", "нет такого вида файла", "обновите страницу"))
        wanted = {"engine.toml": data.get("raw")}
        if kind.startswith("compare-"):
            if not data.get("other"):
                raise InputError(Problem("", "нет второго двигателя", "нажмите «Сравнить с этим»"))
            wanted["other.toml"] = data["other"]
        ask = request.app.state.pool.ask
        files = {name: good(await ask(engine.as_toml, raw))["text"] for name, raw in wanted.items()}
        who = request.session.get("visitor") or (request.client.host if request.client else "")
        return {"id": jobs.add(files, command(kind, dask), who)}

    async def about(request: Request) -> Data:
        found = jobs.about(request.path_params["job"])
        if not found:
            raise HTTPException(404, "нет такого файла; закажите заново")
        return found

    async def taken(request: Request) -> Response:
        return attachment(jobs.file(request.path_params["job"], request.path_params["name"]))

    return [
        route("/api/files", ordered, "POST"),
        route("/api/files/{job}", about),
        route("/api/files/{job}/{name}", taken),
    ]
