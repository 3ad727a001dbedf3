"""Shares of visitors: whose turn it is, who is refused, what a connection may take."""

from __future__ import annotations

import asyncio
import contextlib
import json
import socket
import time
from collections import Counter
from pathlib import Path
from tempfile import gettempdir
from typing import Any

import httpx2
import pytest
from starlette.exceptions import HTTPException

from reports.shared.workers import GROWN, Workers
from reports.web import shared_engines
from reports.web.http_guards import public_words
from reports.web.shared_engines import Connection, Turns, Unfinished, fair
from tests.web.conftest import MARK, Served, finished


def test_everybodys_first_comes_first_and_of_equals_who_has_less_from_an_address() -> None:
    waiting = dict(enumerate(["1/a", "1/a", "1/b", "2/c", "1/", "3/d"]))
    assert fair(waiting, ["1/a"]) == [3, 5, 2, 4, 0, 1]


async def served(turns: Turns, who: str, seconds: float, order: list[str]) -> None:
    async with turns.turn(who, 5):
        order.append(who)
        await asyncio.sleep(seconds)


def run(turns: Turns, *visitors: str) -> tuple[list[str], list[Any]]:
    """In which order turns came, and what each got."""
    order: list[str] = []

    async def everybody() -> list[Any]:
        coming = (served(turns, who, 0.02, order) for who in visitors)
        return await asyncio.gather(*coming, return_exceptions=True)

    return order, finished(everybody())


def test_turns_go_round() -> None:
    turns = Turns(1, 20, 9, 0.1)
    order, _ = run(turns, *["1/"] * 5, "2/a", "3/b")
    assert order == ["1/", "2/a", "3/b", *["1/"] * 4]
    assert turns.running == [] and not turns.waiting


def test_who_has_enough_is_refused_and_told_when_to_come_again() -> None:
    order, got = run(Turns(1, 20, 2, 3.0), *["1/"] * 4, "2/a")
    refused = [each for each in got if isinstance(each, HTTPException)]
    assert Counter(order) == {"1/": 2, "2/a": 1} and len(refused) == 2
    assert refused[0].status_code == 503 and "примерно через 6 с" in refused[0].detail
    assert refused[0].headers == {"retry-after": "6"}


def test_of_too_many_the_one_goes_who_has_most() -> None:
    order, got = run(Turns(1, 3, 9, 0.1), *["1/"] * 4, "2/a", "3/b")
    assert {"2/a", "3/b"} < set(order)
    assert sum(isinstance(each, HTTPException) for each in got) == 2


def test_a_turn_that_does_not_come_is_given_up_and_holds_nothing() -> None:
    turns = Turns(1, 9, 9, 0.1)

    async def impatient() -> None:
        async with turns.turn("1/", 1):
            with pytest.raises(HTTPException, match="занят"):
                async with turns.turn("2/", 0.02):
                    pass
            task = asyncio.create_task(served(turns, "3/", 0, []))
            await asyncio.sleep(0.01)
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await task
        assert not turns.waiting and not turns.running

    finished(impatient())


def test_bodies_that_do_not_end_are_counted_together() -> None:
    unfinished = Unfinished(100)
    with unfinished.body() as one, pytest.raises(HTTPException), unfinished.body() as other:
        one(60)
        other(60)
    assert unfinished.bytes == 0


def test_folders_of_the_server_stand_in_no_message() -> None:
    path = Path(__file__).resolve().parents[2]
    assert public_words(f"{path}/data/x/книга.xlsx: не читается") == "книга.xlsx: не читается"
    assert public_words(f"{gettempdir()}/book-1/a.toml, строка 3") == "a.toml, строка 3"
    assert public_words("кг/м²/с, 5/6") == "кг/м²/с, 5/6"


_kept: list[bytes] = []


def hoard(size: int) -> int:
    """What a hostile book leaves behind."""
    _kept.append(b"x" * size)
    return len(_kept)


def ready() -> Any:
    return hoard


def test_a_process_that_keeps_much_memory_is_replaced() -> None:
    with Workers(1, ready) as workers:
        assert [workers.ask(1, seconds=20).result() for _ in range(2)] == [1, 2]
        assert workers.ask(GROWN + 2**24, seconds=20).result() == 3
        assert workers.ask(1, seconds=20).result() == 1


# --- connections ---


def address(served: Served) -> tuple[str, int]:
    return "127.0.0.1", int(served.page.rstrip("/").rpartition(":")[2])


def test_a_head_that_does_not_end_is_given_up(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The numbers of the running server stand; here the protocol alone, with less time."""
    monkeypatch.setattr(shared_engines, "HEAD_S", 0.2)

    async def slow() -> tuple[float, bytes]:
        import uvicorn

        async def app(scope: Any, receive: Any, send: Any) -> None:
            await asyncio.sleep(0.4)  # an answer may take longer than a head
            await send({"type": "http.response.start", "status": 204, "headers": []})
            await send({"type": "http.response.body"})

        config = uvicorn.Config(app, http=Connection, ws="none", log_level="error", lifespan="off")
        server = uvicorn.Server(config)
        bound = socket.create_server(("127.0.0.1", 0))
        task = asyncio.create_task(server.serve([bound]))
        while not server.started:
            await asyncio.sleep(0.01)
        reader, writer = await asyncio.open_connection(*bound.getsockname())
        writer.write(b"GET / HTTP/1.1\r\nhost: x\r\n")
        began = time.monotonic()
        assert await reader.read() == b""
        took = time.monotonic() - began
        reader, writer = await asyncio.open_connection(*bound.getsockname())
        writer.write(b"GET / HTTP/1.1\r\nhost: x\r\n\r\n")
        said = await reader.readline()
        server.should_exit = True
        await task
        return took, said

    took, said = finished(slow())
    assert 0.1 < took < 2 and b"204" in said


def test_an_address_has_no_more_than_its_connections(served: Served) -> None:
    with contextlib.ExitStack() as stack:
        for _ in range(shared_engines.MAX_CONNECTIONS):
            stack.enter_context(socket.create_connection(address(served)))
        time.sleep(0.5)
        with socket.create_connection(address(served)) as last:
            said = last.recv(2000)
    assert said.startswith(b"HTTP/1.1 503")
    (problem,) = json.loads(said.partition(b"\r\n\r\n")[2])["errors"]
    assert "слишком много соединений" in problem["what"]
    time.sleep(0.5)
    assert httpx2.get(served.page, headers=MARK, trust_env=False).status_code == 200
