"""Commands that run in processes of their own: queues that stand on the disk.

A job is a folder.  Its ``order.json`` stands from the beginning, ``done.json`` at the end; what
has the first alone when the server starts is done again.
"""

from __future__ import annotations

import asyncio
import contextlib
import time
from collections import Counter
from collections.abc import AsyncIterator, Sequence
from pathlib import Path
from typing import Any

from reports.commands.apart import failed, run
from reports.shared.errors import KshmError
from reports.shared.files import make_dir, read_json, write_json, write_zip


class Queue:
    """Commands in folders of one folder.

    Args:
        folder: where they all lie.
        at_once: how many run together.
        timeout_s: seconds that one may take.
        pack: archive made of the many files of a command, their folder and pattern.
    """

    def __init__(
        self, folder: Path, at_once: int, timeout_s: float, pack: tuple[str, str, str]
    ) -> None:
        self.folder, self.at_once, self.timeout_s, self.pack = folder, at_once, timeout_s, pack
        self.waiting: dict[str, str] = {}  # job → visitor, in the order of coming
        self.running: dict[str, tuple[str, float]] = {}  # job → visitor, beginning
        self._wake = asyncio.Event()

    @contextlib.asynccontextmanager
    async def working(self) -> AsyncIterator[None]:
        """Take up what an earlier server has left; what runs at the end is left to the next."""
        make_dir(self.folder)
        left = [path for path in self.folder.glob("*/order.json")
                if not path.with_name("done.json").exists()]  # fmt: skip
        for path in sorted(left, key=lambda path: path.stat().st_mtime):
            self.waiting[path.parent.name] = read_json(path).get("visitor", "")
        self._wake.set()
        tasks = [asyncio.create_task(self._work()) for _ in range(self.at_once)]
        try:
            yield
        finally:
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)

    def put(self, name: str, command: Sequence[str], visitor: str = "") -> None:
        """A command to be run in the folder of that name."""
        folder = self.folder / name
        (folder / "done.json").unlink(missing_ok=True)
        write_json(folder / "order.json", {"visitor": visitor, "command": command})
        self.waiting[name] = visitor
        self._wake.set()

    def line(self) -> list[str]:
        """The waiting jobs in their order: everybody's first before anybody's second."""
        turns = Counter(visitor for visitor, _ in self.running.values())
        turn = {}
        for name, visitor in self.waiting.items():
            turn[name] = turns[visitor]
            turns[visitor] += 1
        return sorted(turn, key=lambda name: turn[name])

    def about(self, name: str) -> dict[str, Any]:
        """How far a job is; nothing if there is no such job."""
        if name in self.waiting:
            return {"state": "waiting", "place": self.line().index(name) + len(self.running)}
        if name in self.running:
            return {"state": "running", "seconds": round(time.monotonic() - self.running[name][1])}
        is_name = name.isalnum() and name.isascii() and len(name) <= 40  # never a path
        return read_json(self.folder / name / "done.json") if is_name else {}

    async def _work(self) -> None:
        while await self._wake.wait():
            if not (line := self.line()):
                self._wake.clear()
                continue
            name = line[0]
            self.running[name] = self.waiting.pop(name), time.monotonic()
            try:
                done = await self._make(self.folder / name)
            except OSError:
                done = failed("на сервере не удаётся записать файл; сообщите кафедре")
            with contextlib.suppress(OSError, KshmError):  # a full disk must not end the queue
                write_json(self.folder / name / "done.json", done)
            del self.running[name]

    async def _make(self, folder: Path) -> dict[str, Any]:
        command = read_json(folder / "order.json").get("command", ())
        done = await run(command, folder, self.timeout_s)
        target, place, pattern = self.pack
        files = {path.relative_to(folder / place).as_posix(): path
                 for path in sorted((folder / place).glob(pattern))}  # fmt: skip
        if files:
            await asyncio.to_thread(write_zip, folder / target, files)
        return done
