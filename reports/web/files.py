"""Which files the page offers, ordered and taken."""

from __future__ import annotations

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from reports.inputs.described import Data
from reports.inputs.sections.report import FORMATS
from reports.shared.errors import InputError, Problem
from reports.web import engine
from reports.web.doors import body, handed, route
from reports.web.jobs import Jobs

KINDS = {
    **{kind: title[0].upper() + title[1:] for kind, title in FORMATS.items()},
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


def routes(jobs: Jobs, dask: str | None) -> list[Route]:
    """Doors at which files are ordered, asked after and taken."""

    async def ordered(request: Request) -> Data:
        data = await body(request)
        kind = str(data.get("kind"))
        if kind not in KINDS:
            raise InputError(Problem("kind", "нет такого вида файла", "обновите страницу"))
        wanted = {"engine.toml": data.get("raw")}
        if kind.startswith("compare-"):
            wanted["other.toml"] = data.get("other")
            if not wanted["other.toml"]:
                raise InputError(Problem("", "нет второго двигателя", "нажмите «Сравнить с этим»"))
        ask = request.app.state.pool.ask
        files = {name: (await ask(engine.as_toml, raw))["text"] for name, raw in wanted.items()}
        who = request.session.get("visitor") or (request.client.host if request.client else "")
        return {"id": jobs.add(files, command(kind, dask), who)}

    async def about(request: Request) -> Data:
        if found := jobs.about(**request.path_params):
            return found
        raise HTTPException(404, "нет такого файла; закажите заново")

    async def taken(request: Request) -> Response:
        return handed(jobs.file(**request.path_params))

    return [
        route("/api/files", ordered, "POST"),
        route("/api/files/{name}", about),
        route("/api/files/{name}/{file}", taken),
    ]
