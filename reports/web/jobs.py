"""Commands that run in processes of their own: queues that stand on the disk.

A job is a folder.  Its ``order.json`` stands from the beginning, ``done.json`` at the end; what
has the first alone when the server starts is done again.
"""

from __future__ import annotations

import asyncio
import contextlib
import hashlib
import hmac
import json
import os
import shutil
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

from reports.commands.apart import failed, run
from reports.shared.errors import InputError, KshmError, Problem
from reports.shared.files import make_dir, read_json, write_json, write_text

TIMEOUT_S = 300.0
MOST_WAITING, MOST_OWN = 500, 6
MOST_BYTES = 2 * 10**9  # of all files kept
KEEP_S = 14 * 86400.0


class Queue:
    """Commands in folders of one folder, ``at_once`` together, each for ``timeout_s`` at most."""

    def __init__(self, folder: Path, at_once: int, timeout_s: float = TIMEOUT_S) -> None:
        self.folder, self.at_once, self.timeout_s = folder, at_once, timeout_s
        self.waiting: dict[str, str] = {}  # job → visitor, in the order of coming
        self.running: dict[str, tuple[str, float]] = {}  # job → visitor, beginning
        self._wake = asyncio.Event()

    def start(self) -> None:
        """Take up what an earlier server has left, and begin."""
        make_dir(self.folder)
        left = [path for path in self.folder.glob("*/order.json")
                if not path.with_name("done.json").exists()]  # fmt: skip
        for path in sorted(left, key=lambda path: path.stat().st_mtime):
            self.waiting[path.parent.name] = read_json(path).get("visitor", "")
        self._wake.set()
        self._tasks = [asyncio.create_task(self._work()) for _ in range(self.at_once)]

    async def stop(self) -> None:
        """End what runs; it is done again by the next server."""
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    def put(self, name: str, command: Sequence[str], visitor: str = "") -> None:
        """A command to be run in the folder of that name."""
        folder = self.folder / name
        (folder / "done.json").unlink(missing_ok=True)
        write_json(folder / "order.json", {"visitor": visitor, "command": command})
        self.waiting[name] = visitor
        self._wake.set()

    def line(self) -> list[str]:
        """The waiting jobs in their order: everybody's first before anybody's second."""
        turn = Counter(who for who, _ in self.running.values())
        ordered = []
        for place, (name, visitor) in enumerate(self.waiting.items()):
            ordered.append((turn[visitor], place, name))
            turn[visitor] += 1
        return [name for _, _, name in sorted(ordered)]

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
                done = await self.make(self.folder / name)
            except OSError:
                done = failed("на сервере не удаётся записать файл; сообщите кафедре")
            with contextlib.suppress(OSError, KshmError):  # a full disk must not end the queue
                write_json(self.folder / name / "done.json", done)
            del self.running[name]

    async def make(self, folder: Path) -> dict[str, Any]:
        """Run the command of a job; how it ended."""
        command = read_json(folder / "order.json").get("command", ())
        return await run(command, folder, self.timeout_s)


class Jobs(Queue):
    """Files made by commands, each named by its content and the server's secret.

    The same order is made once, nobody guesses another's, and the oldest are forgotten.
    """

    def __init__(self, folder: Path, secret: bytes, at_once: int) -> None:
        super().__init__(folder, at_once)
        self.secret = secret

    def add(self, files: Mapping[str, str], command: Sequence[str], visitor: str) -> str:
        """An order: files by name, the command to run beside them; the name of the job.

        Raises:
            InputError: the queue is full, or the visitor has enough in it.
        """
        text = json.dumps([files, command, version("kshm")], ensure_ascii=False, sort_keys=True)
        name = hmac.new(self.secret, text.encode(), hashlib.sha256).hexdigest()[:40]
        folder, state = self.folder / name, self.about(name).get("state")
        if state == "done":
            os.utime(folder / "done.json")
        if state in ("waiting", "running", "done"):
            return name
        own = [*self.waiting.values(), *(who for who, _ in self.running.values())].count(visitor)
        if len(self.waiting) >= MOST_WAITING or own >= MOST_OWN:
            what = "очередь полна" if own < MOST_OWN else f"у вас уже {own} файлов в очереди"
            raise InputError(Problem("", what, "дождитесь их"))
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(mode=0o700)
        for file, content in files.items():
            write_text(folder / file, content)
        self.put(name, command, visitor)
        return name

    def file(self, name: str, file: str) -> Path | None:
        """A file that a job has made; only those that it names itself."""
        files = [each["name"] for each in self.about(name).get("files", ())]
        return self.folder / name / "out" / file if file in files else None

    async def make(self, folder: Path) -> dict[str, Any]:
        """Make the files of a job anew, many tables as one file."""
        out = folder / "out"
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir()
        done = await super().make(folder)
        if (folder / "csv").exists():
            pack = shutil.make_archive
            await asyncio.to_thread(pack, str(out / "tables"), "zip", folder / "csv")
        files = [{"name": path.name, "size": path.stat().st_size}
                 for path in sorted(out.iterdir()) if path.is_file()]  # fmt: skip
        self.clean()
        return {**done, "files": files} if files else {**done, "state": "failed"}

    def clean(self) -> None:
        """Forget the oldest files where they are too old or too many."""
        done = sorted(self.folder.glob("*/done.json"), key=lambda path: -path.stat().st_mtime)
        size = 0
        for path in done:
            size += sum(each.stat().st_size for each in path.parent.rglob("*") if each.is_file())
            if size > MOST_BYTES or time.time() - path.stat().st_mtime > KEEP_S:
                shutil.rmtree(path.parent, ignore_errors=True)
