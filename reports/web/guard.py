"""What stands before every page: host, origin, size, time, rate, and headers of safety."""

from __future__ import annotations

import asyncio
import contextlib
import json
import time
from collections import OrderedDict
from dataclasses import dataclass, field
from ipaddress import ip_address
from typing import Any
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from reports.shared.errors import InputError, Problem

MARK = "x-kshm"  # a header that no foreign page can send without being asked for leave
MOST_JSON = 2_000_000
BODY_S = 30.0  # for a body of a form; files have longer
FILE_S = 300.0
POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data:; font-src 'self' data:; connect-src 'self'; form-action 'none'; "
    "base-uri 'none'; frame-ancestors 'none'"
)
_HEADERS = {
    "content-security-policy": POLICY,
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "permissions-policy": "camera=(), microphone=(), geolocation=()",
}
_FOREIGN = "запрос с чужой страницы"
_MOST_VISITORS = 10_000


@dataclass(slots=True)
class Rate:
    """So many requests a second from one address, with a burst."""

    per_s: float
    burst: float
    left: OrderedDict[str, tuple[float, float]] = field(default_factory=OrderedDict)

    def allows(self, who: str) -> bool:
        """Take one request of ``who``, if there is one left."""
        now = time.monotonic()
        tokens, since = self.left.pop(who, (self.burst, now))
        tokens = min(self.burst, tokens + (now - since) * self.per_s)
        allowed = tokens >= 1
        self.left[who] = (tokens - allowed, now)
        while len(self.left) > _MOST_VISITORS:
            self.left.popitem(last=False)
        return allowed


def refusal(code: int, what: str) -> JSONResponse:
    """An answer that says in a line why not."""
    return JSONResponse({"errors": [{"where": "", "what": what, "hint": ""}]}, code)


async def body(request: Request) -> dict[str, Any]:
    """The JSON object of a request.

    Raises:
        InputError: it is none.
    """
    found = None
    with contextlib.suppress(ValueError, RecursionError):
        found = json.loads(await request.body(), parse_constant=int)  # no NaN
    if not isinstance(found, dict):
        raise InputError(Problem("", "запрос не читается", "обновите страницу"))
    return found


def mapping(data: dict[str, Any], key: str) -> dict[str, Any]:
    """A mapping within a request.

    Raises:
        InputError: there is none.
    """
    found = data.get(key)
    if not isinstance(found, dict):
        raise InputError(Problem(key, "нет исходных данных", "обновите страницу"))
    return found


@dataclass(frozen=True, slots=True)
class Guard:
    """Lets through what a person's own page may ask for.

    Attributes:
        app: what answers.
        hosts: names under which the page is known, «*» any bare address; others are answered 421.
        prefix: path under which a proxy shows the page, ``/kshm``.
        most_file: bytes of an uploaded file.
        rate: requests of one address.
        body_s: seconds that the body of a form may take.
    """

    app: ASGIApp
    hosts: frozenset[str]
    prefix: str
    most_file: int
    rate: Rate
    body_s: float = BODY_S

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Refuse, or hand on with a body that is bounded in size and time."""
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
        if scope["type"] != "http":
            return
        path, headers = scope["path"], Headers(scope=scope)
        if self.prefix and path.startswith(self.prefix + "/"):
            path = path.removeprefix(self.prefix)
        sender = _with_headers(send, "no-cache" if path.startswith("/static/") else "no-store")
        why = self._refused(scope, headers)
        if why is not None:
            await refusal(*why)(scope, receive, sender)
            return
        most, seconds = MOST_JSON, self.body_s
        if headers.get("content-type", "").startswith("application/octet-stream"):
            most, seconds = self.most_file, max(FILE_S, self.body_s)
        await self.app({**scope, "path": path}, _bounded(receive, most, seconds), sender)

    def _refused(self, scope: Scope, headers: Headers) -> tuple[int, str] | None:
        client = scope.get("client")
        if not self.rate.allows(client[0] if client else ""):
            return 429, "слишком много запросов; подождите немного"
        if len(headers.getlist("host")) != 1 or not self._known(headers["host"]):
            return 421, "страница известна под другим адресом; см. ключ --public"
        if scope["method"] in ("GET", "HEAD"):
            return None
        if scope["method"] != "POST":
            return 405, "нет такого действия"
        if not self._own(headers) or MARK not in headers:
            return 403, _FOREIGN
        kind = headers.get("content-type", "")
        if not kind.startswith(("application/json", "application/octet-stream")):
            return 415, "неверный вид данных"
        return None

    def _known(self, host: str) -> bool:
        """Whether a host is ours; a bare address, unlike a name, cannot be made to lead here."""
        with contextlib.suppress(ValueError):
            name = urlsplit(f"//{host}").hostname or ""
            return name in self.hosts or ("*" in self.hosts and bool(ip_address(name)))
        return False

    def _own(self, headers: Headers) -> bool:
        """Whether a page of ours asks: behind a proxy its host is any of ours."""
        origin = urlsplit(headers.get("origin", ""))
        if headers.get("sec-fetch-site", "same-origin") != "same-origin":
            return False
        if "origin" not in headers or origin.netloc.lower() == headers["host"].lower():
            return True
        return bool(self.prefix or origin.scheme == "https") and self._known(origin.netloc)


def _bounded(receive: Receive, most: int, seconds: float) -> Receive:
    """A body of at most so many bytes within so many seconds."""
    size, until = 0, time.monotonic() + seconds

    async def bounded() -> Message:
        nonlocal size
        if size < 0:  # all of it came: this waits for the person to leave
            return await receive()
        try:
            message = await asyncio.wait_for(receive(), max(0.01, until - time.monotonic()))
        except TimeoutError:
            raise HTTPException(408, "данные не приходят; повторите") from None
        size += len(message.get("body", b""))
        if size > most:
            raise HTTPException(413, "слишком много данных")
        if not message.get("more_body", False):
            size = -1
        return message

    return bounded


def _with_headers(send: Send, cache: str) -> Send:
    async def sender(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            for key, value in (*_HEADERS.items(), ("cache-control", cache)):
                headers.setdefault(key, value)
        await send(message)

    return sender
