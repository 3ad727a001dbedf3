"""Shares of what there is little of: turns at processes, unfinished bodies, connections.

A visitor is an address with a cookie, ``address/cookie``: everybody's first comes before
anybody's second, and of equals who has less from the same address.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import math
import time
from collections import Counter, defaultdict
from collections.abc import AsyncIterator, Callable, Iterable, Iterator, Mapping
from typing import Any, ClassVar

from starlette.exceptions import HTTPException
from uvicorn.protocols.http.h11_impl import H11Protocol

from reports.shared.errors import Problem

SPENT_S = 20.0  # for which it is remembered who has had turns
HEAD_S = 10.0  # that the head of a request may take
MAX_CONNECTIONS = 250  # of one address: a class may stand behind one


def address_of(visitor: str) -> str:
    """Return the address of a visitor."""
    return visitor.partition("/")[0]


def fair(
    waiting: Mapping[Any, str], running: Iterable[str], spent: Mapping[str, float] | None = None
) -> list[Any]:
    """Who waits, in the order of turns; ``spent`` is what visitor and address have had lately."""
    busy, had = [*running], spent or {}
    per_visitor, per_address = Counter(busy), Counter(map(address_of, busy))
    rank = {}
    for each, who in waiting.items():
        address = address_of(who)
        rank[each] = per_visitor[who], had.get(who, 0), had.get(address, 0), per_address[address]
        per_visitor[who] += 1
        per_address[address] += 1
    return sorted(waiting, key=lambda each: rank[each])


def busy(seconds: float) -> HTTPException:
    """Refusal that says when to come again."""
    wait = max(1, math.ceil(seconds))
    problem = f"сервер занят: повторите примерно через {wait} с"
    return HTTPException(503, problem, {"retry-after": str(wait)})


class Turns:
    """Turns at what serves ``at_once``; of more than ``most`` who wait the last is refused.

    Args:
        at_once: how many turns go on together.
        most: how many may wait.
        own: how many one visitor may have, waiting and going on.
        usual_s: what a turn takes until it is known.
    """

    def __init__(self, at_once: int, most: int, per_person: int, usual_s: float) -> None:
        self.at_once, self.most, self.own, self.took = at_once, most, per_person, usual_s
        self.waiting: dict[asyncio.Future[None], str] = {}
        self.running: list[str] = []
        self.spent, self._end = defaultdict[str, float](float), 0.0  # s of visitors, addresses

    def seconds(self) -> float:
        """How long who comes now would wait."""
        return self.took * (len(self.waiting) + len(self.running)) / self.at_once

    @contextlib.asynccontextmanager
    async def turn(self, who: str, patience_s: float) -> AsyncIterator[None]:
        """Yield a turn of a visitor; HTTPException 503 where it does not come in time."""
        if [*self.waiting.values(), *self.running].count(who) >= self.own:
            raise busy(self.took * self.own / self.at_once)
        ticket = asyncio.get_running_loop().create_future()
        self.waiting[ticket] = who
        self._call()
        if len(self.waiting) > self.most:
            last = self._order()[-1]
            del self.waiting[last]
            last.set_exception(busy(self.seconds()))
        try:
            await asyncio.wait_for(asyncio.shield(ticket), patience_s)
        except TimeoutError:
            self._leave(ticket, who)
            raise busy(self.seconds()) from None
        except BaseException:
            self._leave(ticket, who)
            raise
        began = time.monotonic()
        try:
            yield
        finally:
            now = time.monotonic()
            if now > self._end:
                self.spent, self._end = defaultdict(float), now + SPENT_S
            for each in {who, address_of(who)}:
                self.spent[each] += now - began
            self.took += 0.2 * (now - began - self.took)
            self._leave(ticket, who)

    def _order(self) -> list[asyncio.Future[None]]:
        return fair(self.waiting, self.running, self.spent)

    def _leave(self, ticket: asyncio.Future[None], who: str) -> None:
        if self.waiting.pop(ticket, None) is None and ticket.done() and not ticket.exception():
            self.running.remove(who)
        ticket.cancel()
        self._call()

    def _call(self) -> None:
        while self.waiting and len(self.running) < self.at_once:
            ticket = self._order()[0]
            self.running.append(self.waiting.pop(ticket))
            ticket.set_result(None)


class Unfinished:
    """Bytes of bodies that are still coming, together at most so many."""

    def __init__(self, most: int) -> None:
        self.most, self.bytes = most, 0

    @contextlib.contextmanager
    def body(self) -> Iterator[Callable[[int], None]]:
        """What counts bytes of a body until its end; HTTPException 503 where they are too many."""
        own = 0

        def came(count: int) -> None:
            nonlocal own
            own += count
            self.bytes += count
            if self.bytes > self.most:
                raise busy(10)

        try:
            yield came
        finally:
            self.bytes -= own


class Connection(H11Protocol):
    """A connection whose heads come in time, of an address that has not too many."""

    count: ClassVar[Counter[str]] = Counter()
    most: ClassVar[float] = MAX_CONNECTIONS

    def connection_made(self, transport: Any) -> None:  # noqa: ANN401
        """Begin, or refuse in one answer."""
        super().connection_made(transport)
        self.address = self.client[0] if self.client else ""
        self.count[self.address] += 1
        self.timer: asyncio.TimerHandle | None = None
        if self.count[self.address] > self.most:
            problem = Problem("", "с вашего адреса слишком много соединений", "закройте лишние")
            body = json.dumps({"errors": [problem.words()]}).encode()
            transport.write(
                b"HTTP/1.1 503 Service Unavailable\r\ncontent-type: application/json\r\n"
                b"retry-after: 5\r\nconnection: close\r\ncontent-length: %d\r\n\r\n%b"
                % (len(body), body)
            )
            transport.close()
            return
        self._wait_for_head()

    def data_received(self, data: bytes) -> None:
        """Take what has come."""
        super().data_received(data)
        self._wait_for_head()

    def connection_lost(self, exc: Exception | None) -> None:
        """End."""
        self.count[self.address] -= 1
        if self.timer:
            self.timer.cancel()
        super().connection_lost(exc)

    def _wait_for_head(self) -> None:
        is_idle = self.cycle is None or self.cycle.response_complete
        if is_idle and self.timer is None:
            self.timer = self.loop.call_later(HEAD_S, self.transport.close)
        elif not is_idle and self.timer is not None:
            self.timer.cancel()
            self.timer = None


class ProxyConnection(Connection):
    """A connection of a proxy, which has them all and counts them itself."""

    most = math.inf
