"""Sixty people at one page: they change values all the time and order a file now and then.

The people are simulated in this process, on the same processors as the server.  A person waits
one to four seconds between changes; one change in twenty is followed by an order of a workbook.
``KSHM_BENCH_S`` sets the seconds.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import random
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from statistics import median, quantiles

import httpx2
import psutil

from tests.bench._figure import Figure

PEOPLE = 60
SECONDS = float(os.environ.get("KSHM_BENCH_S", "300"))
HEADS = {"X-Kshm": "1"}


@dataclass
class Seen:
    """What all people have seen: seconds of answers, of files by person, faults, memory [MB]."""

    took: list[float] = field(default_factory=list)
    files: dict[int, list[float]] = field(default_factory=dict)
    bad: list[str] = field(default_factory=list)
    memory: list[float] = field(default_factory=list)


async def person(base: str, number: int, until: float, seen: Seen) -> None:
    """One browser."""
    chance, files = random.Random(number), seen.files.setdefault(number, [])
    async with httpx2.AsyncClient(
        base_url=base, headers=HEADS, timeout=120, trust_env=False
    ) as web:
        await web.get("/")
        raw = (await web.post("/api/new", json={"sample": "gots-diesel"})).json()["raw"]
        await asyncio.sleep(chance.uniform(0, 3))
        while time.monotonic() < until:
            raw["geometry"]["bore_mm"] = round(chance.uniform(84, 92), 3)
            began = time.perf_counter()
            answer = await web.post("/api/solve", json={"raw": raw, "sheet": "П4.1"})
            seen.took.append(time.perf_counter() - began)
            if answer.status_code != 200 or "charts" not in answer.json():
                seen.bad.append(answer.text[:200])
            if chance.random() < 0.05:
                ordered = time.perf_counter()
                job = (await web.post("/api/files", json={"raw": raw, "kind": "xlsx"})).json()["id"]
                while (state := (await web.get(f"/api/files/{job}")).json()["state"]) not in (
                    "done", "failed",
                ):  # fmt: skip
                    await asyncio.sleep(1)
                files.append(time.perf_counter() - ordered)
                if state == "failed":
                    seen.bad.append("failed file")
            await asyncio.sleep(chance.uniform(1, 4))


async def watch(server: int, seen: Seen) -> None:
    """Memory of the server with all its processes, every five seconds."""
    while True:
        total = 0
        for process in (tree := psutil.Process(server), *tree.children(recursive=True)):
            with contextlib.suppress(psutil.Error):
                total += process.memory_info().rss
        seen.memory.append(total / 2**20)
        await asyncio.sleep(5)


async def everybody(base: str, server: int) -> Seen:
    """All people at once."""
    seen, until = Seen(), time.monotonic() + SECONDS
    watching = asyncio.create_task(watch(server, seen))
    await asyncio.gather(*(person(base, i, until, seen) for i in range(PEOPLE)))
    watching.cancel()
    return seen


def figures() -> Iterator[Figure]:
    """Answers to changes, faults, files and memory under sixty people."""
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
            seen = asyncio.run(everybody(f"http://127.0.0.1:{port}", server.pid))
        finally:
            server.terminate()
            server.wait()
    cuts, files = quantiles(seen.took, n=100), sorted(chain.from_iterable(seen.files.values()))
    early, late = seen.memory[: len(seen.memory) // 2], seen.memory[len(seen.memory) // 2 :]
    yield Figure("загрузка машины за минуту", os.getloadavg()[0], "")
    yield Figure("ответов на правку", float(len(seen.took)), "")
    yield Figure("ответ на правку, медиана", 1000 * median(seen.took), "мс")
    yield Figure("ответ на правку, 99 %", 1000 * cuts[98], "мс")
    yield Figure("ошибок", float(len(seen.bad)), "")
    yield Figure("книг", float(len(files)), "")
    yield Figure("ждали книгу, медиана", median(files), "с")
    yield Figure("ждали книгу, дольше всех", files[-1], "с")
    each = sorted(median(found) for found in seen.files.values() if found)
    yield Figure("ждали книгу, медиана самого терпеливого", each[-1], "с")
    yield Figure("память в первой половине, наибольшая", max(early), "МБ")
    yield Figure("память во второй половине, наибольшая", max(late), "МБ")
