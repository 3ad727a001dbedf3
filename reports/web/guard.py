"""What stands before every page: host, origin, rate, and headers of safety."""

from __future__ import annotations

import contextlib
import time
from collections import OrderedDict
from dataclasses import dataclass, field
from ipaddress import ip_address
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

MARK = "x-kshm"  # a header that no foreign page can send without being asked for leave
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
_KINDS = ("application/json", "application/octet-stream")
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
        self.left[who] = (tokens - (tokens >= 1), now)
        if len(self.left) > _MOST_VISITORS:
            self.left.popitem(last=False)
        return tokens >= 1


def refusal(code: int, what: str) -> JSONResponse:
    """An answer that says in a line why not."""
    return JSONResponse({"errors": [{"where": "", "what": what, "hint": ""}]}, code)


@dataclass(frozen=True, slots=True)
class Guard:
    """Lets through what a person's own page may ask for.

    Attributes:
        app: what answers.
        hosts: names under which the page is known, «*» any bare address; others are answered 421.
        prefix: path under which a proxy shows the page, ``/kshm``.
        rate: requests of one address.
    """

    app: ASGIApp
    hosts: frozenset[str]
    prefix: str
    rate: Rate

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Refuse or hand on."""
        if scope["type"] != "http":
            if scope["type"] == "lifespan":
                await self.app(scope, receive, send)
            return
        path = scope["path"]
        if self.prefix and path.startswith(self.prefix + "/"):
            path = path.removeprefix(self.prefix)
        cache = "no-cache" if path.startswith("/static/") else "no-store"

        async def sender(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for key, value in (*_HEADERS.items(), ("cache-control", cache)):
                    headers.setdefault(key, value)
            await send(message)

        why = self._refused(scope, Headers(scope=scope))
        app = self.app if why is None else refusal(*why)
        await app({**scope, "path": path}, receive, sender)

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
            return 403, "запрос с чужой страницы"
        if not headers.get("content-type", "").startswith(_KINDS):
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
