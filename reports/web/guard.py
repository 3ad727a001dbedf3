"""What stands before every page: host, origin, rate, and headers of safety."""

from __future__ import annotations

import contextlib
import time
from collections import Counter
from dataclasses import dataclass
from ipaddress import ip_address
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

MARK = "x-kshm"  # a header that no foreign page can send without being asked for leave
_HEADERS = {
    "content-security-policy": (
        "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
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
_KINDS = ("application/json", "application/octet-stream")


class Rate:
    """So many requests of one address in so many seconds, counted anew after them."""

    def __init__(self, most: float, seconds: float) -> None:
        self.most, self.seconds = most, seconds
        self._seen, self._end = Counter[str](), 0.0

    def allows(self, who: str) -> bool:
        """Take one request of ``who``, if there is one left."""
        if time.monotonic() >= self._end:
            self._seen, self._end = Counter(), time.monotonic() + self.seconds
        self._seen[who] += 1
        return self._seen[who] <= self.most


def refusal(code: int, what: str) -> JSONResponse:
    """An answer that says in a line why not."""
    return JSONResponse({"errors": [{"where": "", "what": what, "hint": ""}]}, code)


@dataclass(frozen=True, slots=True)
class Guard:
    """Lets through what a person's own page may ask for."""

    app: ASGIApp
    hosts: frozenset[str]  # under which the page is known, «*» any bare address
    public: str  # scheme and host before which a proxy shows it
    rate: Rate  # of one address

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Refuse or hand on."""
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
        if scope["type"] != "http":
            return
        cache = "no-cache" if "/static/" in scope["path"] else "no-store"

        async def sender(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for key, value in (*_HEADERS.items(), ("cache-control", cache)):
                    headers.setdefault(key, value)
            await send(message)

        why = self._refused(scope, Headers(scope=scope))
        await (refusal(*why) if why else self.app)(scope, receive, sender)

    def _refused(self, scope: Scope, headers: Headers) -> tuple[int, str] | None:
        if not self.rate.allows((scope.get("client") or ("",))[0]):
            return 429, "слишком много запросов; подождите немного"
        if len(headers.getlist("host")) != 1 or not self._known(headers["host"]):
            return 421, "страница известна под другим адресом; см. ключ --public"
        if scope["method"] in ("GET", "HEAD"):
            return None
        if scope["method"] != "POST":
            return 405, "нет такого действия"
        own = {f"{scheme}://{headers['host']}" for scheme in ("http", "https")} | {self.public}
        foreign = headers.get("sec-fetch-site", "same-origin") != "same-origin"
        if foreign or MARK not in headers or headers.get("origin", self.public) not in own:
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
