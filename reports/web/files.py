"""Which files the page offers, and what a person's files go through on the way in and out."""

from __future__ import annotations

import tempfile
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response

from reports.commands.engine import build
from reports.shared.errors import InputError, Problem
from reports.web import engine
from reports.web.asked import body, mapping, visitor
from reports.web.guard import refusal
from reports.web.jobs import Jobs, run

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


def commands(kind: str, dask: str | None) -> list[list[str]]:
    """What makes a kind of file out of ``engine.toml`` (and ``other.toml``) into ``out``."""
    if kind.startswith("compare-"):
        return [["compare", "engine.toml", "other.toml", "-o", f"out/compare.{kind[8:]}"]]
    if kind == "csv":
        return [["solve", "engine.toml", "--csv", "csv"], ["zip"]]
    if kind == "json":
        return [["solve", "engine.toml", "--json", "out/engine.json"]]
    far = ["--dask", dask] if dask else []
    return [["build", "engine.toml", "-o", "out", "--only", kind, *far]]


def order(jobs: Jobs, dask: str | None) -> Any:  # noqa: ANN401
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
        return JSONResponse({"id": jobs.add(files, commands(kind, dask), visitor(request))})

    return ordered


def about(jobs: Jobs) -> Any:  # noqa: ANN401
    """How far an order is."""

    async def told(request: Request) -> Response:
        found = jobs.about(request.path_params["job"])
        return JSONResponse(found) if found else refusal(404, "нет такого файла; закажите заново")

    return told


def taken(jobs: Jobs) -> Any:  # noqa: ANN401
    """A file that was made."""

    async def given(request: Request) -> Response:
        path = jobs.file(request.path_params["job"], request.path_params["name"])
        if path is None or not path.exists():
            return refusal(404, "нет такого файла; закажите заново")
        return attachment(path)

    return given


def attachment(path: Path, name: str = "") -> FileResponse:
    """A file to be kept, never to be shown by the browser as a page of ours."""
    return FileResponse(path, filename=name or path.name, media_type="application/octet-stream")


async def save_body(request: Request, target: Path) -> int:
    """Write the body of a request to a file as it comes; its size."""
    size = 0
    with target.open("wb") as stream:
        async for chunk in request.stream():
            stream.write(chunk)
            size += len(chunk)
    return size


async def book(request: Request) -> Response:
    """The input that an edited workbook holds, read by a process of its own."""
    folder = request.app.state.settings.data
    with tempfile.TemporaryDirectory(prefix="book-", dir=folder) as name:
        path = Path(name) / "книга.xlsx"
        if await save_body(request, path) > _MOST_BOOK:
            return refusal(413, f"книга больше {_MOST_BOOK // 2**20} МБ")
        said = await run(["book", path.name], Path(name), _BOOK_S)
    if said.code != 0:
        lines = said.lines or ("книга не читается",)
        return JSONResponse({"errors": [{"where": "", "what": x, "hint": ""} for x in lines]}, 422)
    return JSONResponse(await request.app.state.pool.ask(engine.read_toml, said.out))


def zip_folder(folder: Path, target: Path, names: Mapping[str, Path] | None = None) -> None:
    """All files of a folder, or those named, in one archive."""
    found = names or {path.name: path for path in sorted(folder.iterdir()) if path.is_file()}
    part = target.with_name(target.name + ".part")
    with zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, path in found.items():
            archive.write(path, name)
    part.replace(target)
