"""Routes: guards, bounded bodies, rate limits, answers and refusals."""

from __future__ import annotations

import asyncio
import contextlib
import io
import json
import re
import shutil
import sys
import tempfile
import time
from collections import Counter
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from datetime import datetime
from functools import partial
from ipaddress import ip_address
from pathlib import Path
from typing import Any, BinaryIO
from urllib.parse import unquote, urlsplit

from starlette.exceptions import HTTPException
from starlette.middleware.base import BaseHTTPMiddleware, RequestResponseEndpoint
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Route
from starlette.types import ASGIApp

from reports.grading.batch.tries import told_of_try
from reports.grading.pages.moodle import check_upload
from reports.grading.reading.selfcheck import refuse_foreign, remarks
from reports.inputs.form_fields import Data
from reports.shared.errors import Died, InputError, KshmError, NeverStarted, OutputError, Problem
from reports.shared.files import make_dir
from reports.shared.workers import Workers
from reports.web import engine
from reports.web.shared_engines import Turns

_FOLDER = "earlier"
_MAX_NAME = 60  # letters of a file's name, four bytes each at most
_MAX_FILES = 20  # of one student: thirty megabytes each
Door = Callable[..., Awaitable[Response | Data | None]]
MAX_JSON, MAX_BOOK, MAX_ARCHIVE = 2_000_000, 30 * 2**20, 100_000_000
FILE_S = 300.0  # for an uploaded file
BOOK_S = 15.0  # to read an edited workbook: two seconds are usual
ANSWER_S = 20.0
WAIT_S = 30.0  # before a process is free
GRACE_S, MIN_BYTES_S = 10.0, 20_000  # a body that comes more slowly after that is given up
MARK = "x-kshm"  # a header that no foreign page can send without being asked for leave
_SLOWED, SLOWED_S = (429, 503), 2.0
_KINDS = ("application/json", "application/octet-stream")
_HEADERS = {
    "content-security-policy": (
        "default-src 'none'; script-src 'self' blob:; style-src 'self' 'unsafe-inline'; "
        "img-src 'self' data:; font-src 'self' data:; connect-src 'self'; form-action 'none'; "
        "base-uri 'none'; frame-ancestors 'none'"
    ),
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "permissions-policy": "camera=(), microphone=(), geolocation=()",
}
# A page about a work may hold a student's words: nothing in a file that is shown may act.
_SANDBOX = "sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data:; font-src data:"
_FOLDERS = re.compile(
    "(?:" + "|".join(sorted({re.escape(str(path.resolve()).rstrip("/\\")) for path in (
        Path(tempfile.gettempdir()), Path(__file__).parents[2], Path(sys.prefix), Path.home(),
        Path.cwd(),
    ) if path != Path(path.anchor)}, key=len, reverse=True)) + r")[^\s:;,«»]*[/\\]"
)  # fmt: skip


def keep_earlier(work: Path, coming: Path) -> None:
    """Copy a work that counts aside before ``coming`` takes its place; the same file once."""
    if not work.exists() or work.read_bytes() == coming.read_bytes():
        return
    make_dir(_folder(work))
    when = datetime.fromtimestamp(work.stat().st_mtime)
    shutil.copy2(work, _folder(work) / f"{when:%Y-%m-%d %H-%M-%S-%f}{work.suffix}")
    for old in earlier(work)[:-_MAX_FILES]:
        old.unlink(missing_ok=True)


def earlier(work: Path) -> list[Path]:
    """Works of the same student that have counted before, the first first."""
    return sorted(_folder(work).glob(f"*{work.suffix}"))


def _folder(work: Path) -> Path:
    return work.parent / _FOLDER / work.stem


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
    addresses: tuple[str, ...] = ()  # what the command has printed: a phone may know the first
    books: Path | None = None  # folder of own books that the owner allows; None allows none

    @property
    def own_books(self) -> str:
        """The folder as processes are told of it, empty where no books are allowed."""
        return "" if self.books is None else str(self.books.resolve())


class Rate:
    """Rate limit of an address in a fixed window."""

    def __init__(self, most: float, seconds: float) -> None:
        self.most, self.seconds = most, seconds
        self._seen, self._end = Counter[str](), 0.0

    def allows(self, who: str) -> bool:
        """Take one request of ``who``, if there is one left."""
        if time.monotonic() >= self._end:
            self._seen, self._end = Counter(), time.monotonic() + self.seconds
        self._seen[who] += 1
        return self._seen[who] <= self.most


class Guard(BaseHTTPMiddleware):
    """Check host, origin and rate; add security headers."""

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        super().__init__(app)
        public = urlsplit(settings.public)
        self.public = f"{public.scheme}://{public.netloc}"
        hosts = ("127.0.0.1", "localhost", "::1", *settings.hosts, public.hostname or "")
        self.hosts = {name.lower() for name in hosts if name}
        self.rate = Rate(10 * settings.per_s, 10)

    async def dispatch(self, request: Request, call_next: RequestResponseEndpoint) -> Response:
        """Refuse or hand on."""
        why = self._refused(request)
        if why and why[0] in _SLOWED:
            await asyncio.sleep(SLOWED_S)
        answer = refusal(*why) if why else await call_next(request)
        cache = "no-cache" if "/static/" in request.scope["path"] else "no-store"
        for key, value in (*_HEADERS.items(), ("cache-control", cache)):
            answer.headers.setdefault(key, value)
        return answer

    def _refused(self, request: Request) -> tuple[int, str] | None:
        headers = request.headers
        if not self.rate.allows(caller(request)):
            return 429, "слишком много запросов; подождите немного"
        if len(headers.getlist("host")) != 1 or not self._known(headers["host"]):
            return 421, "страница известна под другим адресом; см. ключ --public"
        if request.method in ("GET", "HEAD"):
            return None
        if request.method != "POST":
            return 405, "нет такого действия"
        origins = {f"{scheme}://{headers['host']}" for scheme in ("http", "https")} | {self.public}
        foreign = headers.get("sec-fetch-site", "same-origin") != "same-origin"
        if foreign or MARK not in headers or headers.get("origin", self.public) not in origins:
            return 403, "запрос с чужой страницы"
        if not headers.get("content-type", "").startswith(_KINDS):
            return 415, "неверный вид данных"
        return None

    def _known(self, host: str) -> bool:
        """Whether a host is allowed: bare addresses cannot be rebound by DNS."""
        with contextlib.suppress(ValueError):
            name = urlsplit(f"//{host}").hostname or ""
            return name in self.hosts or ("*" in self.hosts and bool(ip_address(name)))
        return False


def caller(request: Request) -> str:
    """Return the address from which a request comes."""
    return request.client.host if request.client else ""


def address_of_server(request: Request) -> str:
    """Return the address of this server as a telephone in the same network knows it."""
    settings: Settings = request.app.state.settings
    origin = f"{request.url.scheme}://{request.url.netloc}"
    is_local = urlsplit(origin).hostname in ("127.0.0.1", "localhost", "::1")
    printed = next(iter(settings.addresses), "") if is_local else ""
    return str(settings.public or printed or origin).rstrip("/")


def visitor(request: Request) -> str:
    """Who asks: address and cookie together, the latter only if this server has given it."""
    return f"{caller(request)}/{request.session.get('visitor', '')}"


def public_words(text: str) -> str:
    """Return a message without the folders of the server."""
    return _FOLDERS.sub("", text)


def refusal(
    code: int, why: KshmError | str, headers: Mapping[str, str] | None = None
) -> JSONResponse:
    """Error response with one line a problem."""
    error = KshmError(why) if isinstance(why, str) else why
    lines = [{key: public_words(words) for key, words in problem.words().items()}
             for problem in error.problems]  # fmt: skip
    return JSONResponse({"errors": lines}, code, headers)


async def failed(_: Request, error: Exception) -> Response:
    """Return what becomes of an error."""
    if isinstance(error, OSError | OutputError):
        return refusal(507, "на сервере не удаётся записать файл; сообщите тому, кто его держит")
    if isinstance(error, KshmError):
        return refusal(422, error)
    if isinstance(error, HTTPException):
        if error.status_code in _SLOWED:  # who asks again at once costs the others nothing
            await asyncio.sleep(SLOWED_S)
        ours = not error.detail.isascii()
        why = error.detail if ours else "нет такой страницы"
        return refusal(error.status_code, why, error.headers)
    return refusal(500, "внутренняя ошибка: повторите; если останется, сообщите, что вы делали")


def route(method: str, path: str, door: Door, *options: Any) -> Route:  # noqa: ANN401
    """Route that passes a request and given values to a handler; data go as JSON."""

    async def answer(request: Request) -> Response:
        answer_body = await door(request, *options)
        return answer_body if isinstance(answer_body, Response) else JSONResponse(answer_body or {})

    return Route(path, answer, methods=[method])


get, post = partial(route, "GET"), partial(route, "POST")


@dataclass(frozen=True, slots=True)
class Desk:
    """Processes that answer, and the line before them."""

    workers: Workers
    line: Turns


async def ask(
    request: Request, function: Callable[..., Data], *values: object, seconds: float = ANSWER_S
) -> Data:
    """Answer of a worker process; HTTPException after the time limit.

    Books have processes of their own, so that they do not stand in the way of numbers.
    """
    desks = request.app.state
    desk: Desk = desks.answers if seconds == ANSWER_S else desks.readers
    async with desk.line.turn(visitor(request), WAIT_S):
        future = desk.workers.ask(function, *values, seconds=seconds)
        try:
            reply: Data = await asyncio.wait_for(asyncio.wrap_future(future), WAIT_S + seconds)
        except TimeoutError:
            problem = f"считается дольше {seconds:.0f} с: отклонено"
            raise InputError(Problem("", problem, "уменьшите расчёт или книгу")) from None
        except (Died, NeverStarted):
            problem = "не считается: не хватило памяти"
            raise InputError(Problem("", problem, "уменьшите расчёт или книгу")) from None
    return reply


async def _read(request: Request, target: BinaryIO, most: int, seconds: float) -> None:
    """Read a body within its size and time; refuse more than a share of all unfinished ones."""
    loop, state = asyncio.get_running_loop(), request.app.state
    began = loop.time()
    try:
        with state.unfinished.body() as came:
            async with asyncio.timeout_at(began + min(seconds, GRACE_S)) as limit:
                async for chunk in request.stream():
                    if target.tell() + len(chunk) > most:
                        raise HTTPException(413, f"данных больше {most // 10**6} МБ")
                    came(len(chunk))
                    target.write(chunk)
                    late = began + GRACE_S + target.tell() / MIN_BYTES_S
                    limit.reschedule(min(began + seconds, late))
    except TimeoutError:
        raise HTTPException(408, "данные не приходят; повторите") from None


async def body(request: Request) -> Data:
    """Return the JSON object of a request; InputError if it is none."""
    content: Any = None
    stream = io.BytesIO()
    await _read(request, stream, MAX_JSON, request.app.state.settings.body_s)
    with contextlib.suppress(ValueError, RecursionError):
        content = json.loads(stream.getvalue(), parse_constant=int)  # no NaN
    if not isinstance(content, dict):
        raise InputError(Problem("", "запрос не читается", "обновите страницу"))
    return content


@contextlib.asynccontextmanager
async def uploaded(request: Request, most: int, name: str = "книга.xlsx") -> AsyncIterator[Path]:
    """Yield the body of a request as a file that goes with the block, unless it is moved.

    It is called as its sender calls it, else ``name``.
    """
    state, sent = request.app.state, unquote(request.headers.get("x-name", ""))
    stem = re.sub(r'[\\/:*?"<>|\x00-\x1f]+', " ", Path(sent).stem).strip(" .")[:_MAX_NAME]
    with tempfile.TemporaryDirectory(prefix="book-", dir=state.settings.data) as folder:
        path = Path(folder, f"{stem or Path(name).stem}{Path(name).suffix}")
        async with state.uploading.turn(visitor(request), WAIT_S):
            with path.open("wb") as stream:
                await _read(request, stream, most, FILE_S)
        yield path


async def answer(request: Request, function: Callable[..., Data], *keys: str) -> Response | Data:
    """Return handler that asks a worker with values of these keys, or the whole body."""
    data = await body(request)
    try:
        return await ask(request, function, *([data.get(key) for key in keys] or [data]))
    except KshmError as error:  # usual while one types
        return refusal(200, error)


async def read(request: Request) -> Data:
    """Read an input file in a worker, as ``check`` does."""
    async with uploaded(request, MAX_JSON, "файл.toml") as path:
        return await ask(request, engine.read_toml, str(path))


async def book(request: Request) -> Data:
    """Read the input of an edited workbook in a worker."""
    async with uploaded(request, MAX_BOOK) as path:
        return await ask(request, engine.read_book, str(path), seconds=BOOK_S)


@dataclass(frozen=True, slots=True)
class Shown:
    """What a thing at a path tells; which files it gives and takes, by words of its own.

    ``names`` are what files are called where that is not their name; ``closed`` says why none
    is taken; a book is tried by the register of the folder ``tries``.
    """

    content: Data
    gives: Mapping[str, Path]
    takes: Mapping[str, Path] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)
    closed: str = ""
    tries: str = ""


def shown(path: str, find: Callable[[Request], Shown], files: str = "/{file}") -> list[Route]:
    """Doors of things that ``find`` finds; HTTPException where there is no such file."""

    async def data(request: Request) -> Data:
        return find(request).content

    async def given(request: Request) -> Response:
        thing, word = find(request), request.path_params["file"]
        file = thing.gives.get(word)
        if file is None or not file.is_file():
            raise HTTPException(404, "нет такого файла; закажите заново")
        how = "inline" if file.suffix == ".html" else "attachment"  # a page can do nothing
        heads = {"content-security-policy": _SANDBOX}
        name = thing.names.get(word, file.name)
        return FileResponse(file, headers=heads, filename=name, content_disposition_type=how)

    async def taken(request: Request) -> Data:
        job = find(request)
        if (target := job.takes.get(request.path_params["file"])) is None:
            raise HTTPException(404, "такого файла здесь не ждут")
        if job.closed:
            raise HTTPException(409, job.closed)
        is_book, data = target.suffix == ".xlsx", Data()
        async with uploaded(request, MAX_BOOK if is_book else MAX_ARCHIVE, target.name) as file:
            if is_book:
                with contextlib.suppress(HTTPException):  # a busy server turns no work away
                    book = str(job.gives["book"])
                    await ask(request, refuse_foreign, str(file), book, seconds=BOOK_S)
                    data = await ask(request, remarks, str(file), book, seconds=BOOK_S)
                    if job.tries:
                        data |= await ask(request, told_of_try, str(file), job.tries,
                                          seconds=BOOK_S)  # fmt: skip
                keep_earlier(target, file)
            else:
                check_upload(file, target.suffix)
            file.replace(target)
        return data

    return [get(path, data), get(f"{path}{files}", given), post(f"{path}{files}", taken)]
