"""Sixty people at one page while ten documents are built; then the same with a hostile visitor.

The people are simulated in this process, on the same processors as the server, each behind an
address of his own.  A person waits one to four seconds between changes.  Ten documents are always
being built or waiting.  The hostile visitor floods numbers without a cookie, sends books that cost
much, orders files and holds connections whose heads do not end.  All is on loopback and ends.
``KSHM_BENCH_S`` sets the seconds of each half.
"""

from __future__ import annotations

import asyncio
import contextlib
import io
import os
import random
import socket
import subprocess
import sys
import tempfile
import time
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median, quantiles
from typing import Any

import httpx2
import psutil

from reports.shared.resources import samples_dir
from tests.bench._figure import Figure
from tests.bench._process import kshm, run

PEOPLE, DOCUMENTS, FLOOD = 60, 10, 40
SECONDS = float(os.environ.get("KSHM_BENCH_S", "25"))
MARK = {"X-Kshm": "1"}
_INPUTS = "xl/worksheets/sheet2.xml"


@dataclass
class Seen:
    """What people have seen: seconds of answers, faults, documents, memory [MB] and refusals."""

    took: list[float] = field(default_factory=list)
    bad: list[str] = field(default_factory=list)
    documents: int = 0
    memory: list[float] = field(default_factory=list)
    refused: int = 0
    served: int = 0


def browser(base: str, address: str) -> httpx2.AsyncClient:
    """A browser behind an address of its own."""
    heads = {**MARK, "X-Forwarded-For": address}
    limits = httpx2.Limits(max_connections=FLOOD)
    return httpx2.AsyncClient(
        base_url=base, headers=heads, timeout=120, trust_env=False, limits=limits
    )


async def person(base: str, number: int, until: float, seen: Seen) -> None:
    """One who changes a value now and then."""
    chance = random.Random(number)
    async with browser(base, f"10.0.0.{number}") as web:
        await web.get("/")
        raw = (await web.post("/api/new", json={"sample": "gots-diesel"})).json()["raw"]
        await asyncio.sleep(chance.uniform(0, 3))
        while time.monotonic() < until:
            raw["geometry"]["bore_mm"] = round(chance.uniform(84, 92), 3)
            began = time.perf_counter()
            answer = await web.post("/api/settle", json={"raw": raw})
            seen.took.append(time.perf_counter() - began)
            if answer.status_code != 200 or "built" not in answer.json():
                seen.bad.append(answer.text[:200])
            await asyncio.sleep(chance.uniform(1, 4))


async def documents(base: str, number: int, until: float, seen: Seen) -> None:
    """One whose report is always being built."""
    async with browser(base, f"10.0.1.{number}") as web:
        await web.get("/")
        raw = (await web.post("/api/new", json={"sample": "gots-diesel"})).json()["raw"]
        for turn in range(1000):
            raw["geometry"]["bore_mm"] = 80 + number + turn / 1000
            job = (await web.post("/api/files", json={"raw": raw, "kind": "pdf"})).json()["id"]
            while time.monotonic() < until:
                if (await web.get(f"/api/files/{job}")).json()["state"] == "done":
                    seen.documents += 1
                    break
                await asyncio.sleep(1)
            if time.monotonic() >= until:
                return


def costly_book() -> bytes:
    """A workbook of ours whose inputs go on with a million cells without addresses."""
    stream = io.BytesIO()
    rows = b"<row>" + b"<c><f>A1+1</f></c>" * 20 + b"</row>"
    with tempfile.TemporaryDirectory(prefix="kshm-bench-") as folder:
        sample = str(samples_dir() / "gots-diesel.toml")
        run(kshm("build", sample, "--only", "xlsx", "-o", folder))
        source = zipfile.ZipFile(next(Path(folder).glob("*.xlsx")))
        with source, zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
            for name in source.namelist():
                part = source.read(name)
                if name == _INPUTS:
                    part = part.replace(b"</sheetData>", rows * 60_000 + b"</sheetData>")
                archive.writestr(name, part)
    return stream.getvalue()


async def hostile(base: str, until: float, seen: Seen) -> None:
    """One who asks for all there is at once, always with the same address and no cookie."""
    port, book = int(base.rpartition(":")[2]), costly_book()
    async with browser(base, "10.9.9.9") as web:
        raw = (await web.post("/api/new", json={"sample": "yamz-238"})).json()["raw"]

        async def flood(path: str, **body: Any) -> None:
            while time.monotonic() < until:
                with contextlib.suppress(httpx2.HTTPError):
                    code = (await web.post(path, **body)).status_code
                    seen.refused += code in (429, 503)
                    seen.served += code == 200
                    web.cookies.clear()

        async def dangle() -> None:
            while time.monotonic() < until:
                with contextlib.suppress(OSError):
                    _, writer = await asyncio.open_connection("127.0.0.1", port)
                    writer.write(b"GET / HTTP/1.1\r\nhost: localhost\r\n")
                    await asyncio.sleep(2)
                    writer.close()

        heads = {"content-type": "application/octet-stream"}
        await asyncio.gather(
            *(flood("/api/settle", json={"raw": raw}) for _ in range(FLOOD)),
            *(flood("/api/book", content=book, headers=heads) for _ in range(4)),
            *(flood("/api/files", json={"raw": raw, "kind": "pdf"}) for _ in range(2)),
            *(dangle() for _ in range(50)),
        )


async def watch(server: int, seen: Seen) -> None:
    """Memory of the server with all its processes, every five seconds."""
    while True:
        total = 0
        for process in (tree := psutil.Process(server), *tree.children(recursive=True)):
            with contextlib.suppress(psutil.Error):
                total += process.memory_info().rss
        seen.memory.append(total / 2**20)
        await asyncio.sleep(5)


async def everybody(base: str, server: int, is_attacked: bool) -> Seen:
    """All people at once."""
    seen, until = Seen(), time.monotonic() + SECONDS
    watching = asyncio.create_task(watch(server, seen))
    more = [hostile(base, until, seen)] if is_attacked else []
    await asyncio.gather(
        *(person(base, i, until, seen) for i in range(PEOPLE)),
        *(documents(base, i, until, seen) for i in range(DOCUMENTS)),
        *more,
    )
    watching.cancel()
    return seen


def figures() -> Iterator[Figure]:
    """Answers to changes, faults, documents and memory under sixty people."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with tempfile.TemporaryDirectory(prefix="kshm-bench-") as name:
        command = [sys.executable, "-m", "reports", "serve", "--port", str(port), "--data", name]
        server = subprocess.Popen(
            command, stdout=subprocess.PIPE, cwd=Path(__file__).parents[2], text=True
        )
        assert server.stdout is not None
        began = time.perf_counter()
        while socket.socket().connect_ex(("127.0.0.1", port)):
            time.sleep(0.05)
        yield Figure("начало работы", time.perf_counter() - began, "с")
        try:
            for words, is_attacked in (("", False), (", с враждебным посетителем", True)):
                seen = asyncio.run(everybody(f"http://127.0.0.1:{port}", server.pid, is_attacked))
                yield from _told(words, seen)
        finally:
            server.terminate()
            server.wait()


def _told(words: str, seen: Seen) -> Iterator[Figure]:
    cuts = quantiles(seen.took, n=100)
    yield Figure(f"загрузка машины за минуту{words}", os.getloadavg()[0], "")
    yield Figure(f"ответов на правку{words}", float(len(seen.took)), "")
    yield Figure(f"ответ на правку, медиана{words}", 1000 * median(seen.took), "мс")
    yield Figure(f"ответ на правку, 95 %{words}", 1000 * cuts[94], "мс")
    yield Figure(f"ответ на правку, 99 %{words}", 1000 * cuts[98], "мс")
    yield Figure(f"ошибок{words}", float(len(seen.bad)), "", "; ".join(seen.bad[:1]))
    yield Figure(f"отчётов PDF построено{words}", float(seen.documents), "")
    yield Figure(f"отказов враждебному{words}", float(seen.refused), "")
    yield Figure(f"ответов враждебному{words}", float(seen.served), "")
    yield Figure(f"память, наибольшая{words}", max(seen.memory), "МБ")
