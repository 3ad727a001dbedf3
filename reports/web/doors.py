"""What every door does: reads what is brought within bounds, and hands out answers and files."""

from __future__ import annotations

import asyncio
import contextlib
import io
import json
import tempfile
from collections.abc import AsyncIterator, Awaitable, Callable
from pathlib import Path
from typing import Any, BinaryIO

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Route

from reports.inputs.described import Data
from reports.shared.errors import InputError, Problem

Door = Callable[[Request], Awaitable[Response | Data]]
MOST_JSON, MOST_BOOK, MOST_ARCHIVE = 2_000_000, 30 * 2**20, 100_000_000
FILE_S = 300.0  # for an uploaded file
_WORK_POLICY = (
    "sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data:; font-src data:"
)


def route(path: str, door: Door, *methods: str) -> Route:
    """A door at a path, GET where nothing is said, its plain data as JSON."""

    async def answer(request: Request) -> Response:
        found = await door(request)
        return found if isinstance(found, Response) else JSONResponse(found)

    return Route(path, answer, methods=list(methods) or None)


async def _read(request: Request, target: BinaryIO, most: int, seconds: float) -> None:
    try:
        async with asyncio.timeout(seconds):
            async for chunk in request.stream():
                if target.tell() + len(chunk) > most:
                    raise HTTPException(413, f"данных больше {most // 10**6} МБ")
                target.write(chunk)
    except TimeoutError:
        raise HTTPException(408, "данные не приходят; повторите") from None


async def body(request: Request) -> Data:
    """The JSON object of a request.

    Raises:
        InputError: it is none.
    """
    found: Any = None
    stream = io.BytesIO()
    await _read(request, stream, MOST_JSON, request.app.state.settings.body_s)
    with contextlib.suppress(ValueError, RecursionError):
        found = json.loads(stream.getvalue(), parse_constant=int)  # no NaN
    if not isinstance(found, dict):
        raise InputError(Problem("", "запрос не читается", "обновите страницу"))
    return found


@contextlib.asynccontextmanager
async def uploaded(request: Request, most: int) -> AsyncIterator[Path]:
    """The body of a request as a file that goes with the block, unless it is moved."""
    with tempfile.TemporaryDirectory(prefix="book-", dir=request.app.state.settings.data) as name:
        path = Path(name) / "книга.xlsx"
        with path.open("wb") as stream:
            await _read(request, stream, most, FILE_S)
        yield path


def good(found: Data) -> Data:
    """An answer of the solving processes without errors.

    Raises:
        InputError: its errors.
    """
    if found.get("errors"):
        raise InputError([Problem(**each) for each in found["errors"]])
    return found


def attachment(path: Path | None) -> FileResponse:
    """A file to be kept, never to be shown by the browser as a page of ours."""
    if path is None or not path.exists():
        raise HTTPException(404, "нет такого файла; закажите заново")
    return FileResponse(path, filename=path.name, media_type="application/octet-stream")


def shown(path: Path | None) -> FileResponse:
    """A page about a work, which may hold a student's words: nothing in it may act."""
    if path is None or not path.exists():
        raise HTTPException(404, "такой страницы ещё нет")
    return FileResponse(path, headers={"content-security-policy": _WORK_POLICY})
