"""Sixty people at one page: they change values all the time and order a file now and then.

The people are simulated in this process, on the same processors as the server.  A person waits
one to four seconds between changes; one change in twenty is followed by an order of a workbook.
``KSHM_BENCH_S`` sets the seconds.
"""

from __future__ import annotations

import asyncio
import os
import random
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from statistics import median, quantiles

import httpx2
import psutil

from tests.bench._figure import Figure

PEOPLE = 60
SECONDS = float(os.environ.get("KSHM_BENCH_S", "300"))
HEADS = {"X-Kshm": "1"}


async def person(base: str, number: int, until: float, took: list[float], bad: list[str]) -> int:
    """One browser; how many files it got."""
    chance, files = random.Random(number), 0
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
            took.append(time.perf_counter() - began)
            if answer.status_code != 200 or answer.json()["errors"]:
                bad.append(answer.text[:200])
            if chance.random() < 0.05:
                job = (await web.post("/api/files", json={"raw": raw, "kind": "xlsx"})).json()["id"]
                while (state := (await web.get(f"/api/files/{job}")).json()["state"]) not in (
                    "done", "failed",
                ):  # fmt: skip
                    await asyncio.sleep(1)
                files += state == "done"
                if state == "failed":
                    bad.append("failed file")
            await asyncio.sleep(chance.uniform(1, 4))
    return files


async def everybody(base: str) -> tuple[list[float], list[str], int]:
    """Seconds of every answer, what went wrong, files made."""
    took: list[float] = []
    bad: list[str] = []
    until = time.monotonic() + SECONDS
    made = await asyncio.gather(*(person(base, i, until, took, bad) for i in range(PEOPLE)))
    return took, bad, sum(made)


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
            took, bad, files = asyncio.run(everybody(f"http://127.0.0.1:{port}"))
            tree = psutil.Process(server.pid)
            memory = sum(p.memory_info().rss for p in (tree, *tree.children(recursive=True)))
        finally:
            server.terminate()
            server.wait()
    cuts = quantiles(took, n=100)
    yield Figure("ответов на правку", float(len(took)), "")
    yield Figure("ответ на правку, медиана", 1000 * median(took), "мс")
    yield Figure("ответ на правку, 99 %", 1000 * cuts[98], "мс")
    yield Figure("ошибок", float(len(bad)), "")
    yield Figure("книг", float(files), "")
    yield Figure("память сервера с процессами", memory / 2**20, "МБ")
