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

Door = Callable[[Request], Awaitable[Response | Data | None]]
MOST_JSON, MOST_BOOK, MOST_ARCHIVE = 2_000_000, 30 * 2**20, 100_000_000
FILE_S = 300.0  # for an uploaded file
# A page about a work may hold a student's words: nothing in a file that is shown may act.
_SANDBOX = "sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data:; font-src data:"


def route(path: str, door: Door, method: str = "GET") -> Route:
    """A door at a path, its plain data as JSON."""

    async def answer(request: Request) -> Response:
        found = await door(request)
        return found if isinstance(found, Response) else JSONResponse(found or {})

    return Route(path, answer, methods=[method])


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
    """The JSON object of a request; InputError if it is none."""
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
        path = Path(name, "книга.xlsx")
        with path.open("wb") as stream:
            await _read(request, stream, most, FILE_S)
        yield path


def handed(path: Path | None) -> FileResponse:
    """A file to be kept, or a page that can do nothing; HTTPException if there is none."""
    if path is None or not path.is_file():
        raise HTTPException(404, "нет такого файла; закажите заново")
    how = "inline" if path.suffix == ".html" else "attachment"
    return FileResponse(
        path, headers={"content-security-policy": _SANDBOX}, filename=path.name,
        content_disposition_type=how,
    )  # fmt: skip
