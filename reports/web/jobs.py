"""Files made by the commands in processes of their own: a queue that stands on the disk.

A job is a folder named by its content and the server's secret: the same order is made once,
and nobody guesses another's.  ``order.json`` stands from the beginning, ``done.json`` at the
end; what has the first alone when the server starts is made again.
"""

from __future__ import annotations

import asyncio
import contextlib
import hashlib
import hmac
import json
import os
import shutil
import signal
import sys
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import make_dir, write_text

TIMEOUT_S = 300.0
MOST_WAITING, MOST_OWN = 500, 6
MOST_BYTES = 2 * 10**9  # of all files kept
KEEP_S = 14 * 86400.0
_LINES = 40  # of what a command said
# The command with little memory, which ends with a server that is killed; who waits for a number
# comes before who waits for a file.
_KSHM = """
import ctypes, os, sys
if sys.platform == "linux":
    ctypes.CDLL(None).prctl(1, 9)
if os.getppid() != int(sys.argv.pop(1)):
    sys.exit("server is gone")
from reports.grading.batch.worker import limit_memory
from reports.__main__ import start
limit_memory(3 * 2**30)
getattr(os, "nice", abs)(5)
start()
"""
_SYSTEM = ("PATH", "HOME", "LANG", "LC_ALL", "TMPDIR", "PYTHONPATH", "SYSTEMROOT", "TEMP",
           "FONTCONFIG_PATH", "FONTCONFIG_FILE", "XDG_CACHE_HOME")  # fmt: skip


@dataclass(frozen=True, slots=True)
class Said:
    """How a command ended: its code and what it said."""

    code: int
    lines: tuple[str, ...]


def read_json(path: Path) -> dict[str, Any]:
    """What a file says; nothing if it is not there or damaged."""
    try:
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found


def write_json(path: Path, data: Mapping[str, Any]) -> None:
    """Keep plain data, whole or not at all."""
    write_text(path, json.dumps(data, ensure_ascii=False))


async def run(arguments: Sequence[str], folder: Path, timeout_s: float = TIMEOUT_S) -> Said:
    """Run a command of kshm in a folder with limits; its whole group ends with it."""
    kept = {key: os.environ[key] for key in _SYSTEM if key in os.environ}
    home = [str(Path(__file__).resolve().parents[2]), kept.get("PYTHONPATH", "")]
    kept |= {"PYTHONPATH": os.pathsep.join(filter(None, home)), "PYTHONIOENCODING": "utf-8"}
    kept |= {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}  # as many jobs as processors
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-c", _KSHM, str(os.getpid()), *arguments, cwd=folder, env=kept,
        start_new_session=True, stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.DEVNULL, stderr=asyncio.subprocess.PIPE,
    )  # fmt: skip
    try:
        _, said = await asyncio.wait_for(process.communicate(), timeout_s)
    except TimeoutError:
        return Said(-1, (f"не сделано за {timeout_s:.0f} с: уменьшите расчёт",))
    finally:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL) if hasattr(os, "killpg") else process.kill()
        with contextlib.suppress(asyncio.CancelledError):
            await process.wait()
    code = process.returncode or 0
    if code < 0:
        return Said(code, ("процесс прерван: повторите",))
    lines = (one_line(line, 400) for line in said.decode("utf-8", "replace").splitlines())
    return Said(code, tuple(filter(None, lines))[:_LINES])


class Jobs:
    """The queue: everybody's first order before anybody's second.

    Args:
        folder: where the jobs lie.
        secret: what makes their names unguessable.
        at_once: how many are made at the same time.
    """

    def __init__(self, folder: Path, secret: bytes, at_once: int) -> None:
        self.folder, self.secret, self.at_once = folder, secret, at_once
        self.waiting: dict[str, str] = {}  # job → visitor, in the order of coming
        self.running: dict[str, tuple[str, float]] = {}  # job → visitor, beginning
        self._wake = asyncio.Event()
        self._tasks: list[asyncio.Task[None]] = []

    def start(self) -> None:
        """Take up what an earlier server has left, and begin."""
        make_dir(self.folder)
        left = [path for path in self.folder.glob("*/order.json")
                if not (path.parent / "done.json").exists()]  # fmt: skip
        for path in sorted(left, key=lambda path: path.stat().st_mtime):
            shutil.rmtree(path.parent / "out", ignore_errors=True)
            self.waiting[path.parent.name] = read_json(path).get("visitor", "")
        self._clean()
        self._tasks = [asyncio.create_task(self._work()) for _ in range(self.at_once)]

    async def stop(self) -> None:
        """End what runs; it is made again by the next server."""
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    def add(self, files: Mapping[str, str], commands: Sequence[Sequence[str]], visitor: str) -> str:
        """An order: files by name, commands to run beside them; the name of the job.

        Raises:
            InputError: the queue is full, or the visitor has enough in it.
        """
        text = json.dumps([files, commands, version("kshm")], ensure_ascii=False, sort_keys=True)
        name = hmac.new(self.secret, text.encode(), hashlib.sha256).hexdigest()[:40]
        folder = self.folder / name
        about = self.about(name) or {}
        if about.get("state") == "done":
            os.utime(folder / "done.json")
        if about.get("state") in ("waiting", "running", "done"):
            return name
        busy = (*self.waiting.values(), *(who for who, _ in self.running.values()))
        own = busy.count(visitor)
        if len(self.waiting) >= MOST_WAITING or own >= MOST_OWN:
            what = "очередь полна" if own < MOST_OWN else f"у вас уже {own} файлов в очереди"
            raise InputError(Problem("", what, "дождитесь их"))
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(mode=0o700)
        for file, content in files.items():
            write_text(folder / file, content)
        write_json(folder / "order.json", {"visitor": visitor, "commands": commands})
        self.waiting[name] = visitor
        self._wake.set()
        return name

    def line(self) -> list[str]:
        """The waiting jobs in the order in which they will be made."""
        turn = Counter(who for who, _ in self.running.values())
        ordered = []
        for place, (name, visitor) in enumerate(self.waiting.items()):
            ordered.append((turn[visitor], place, name))
            turn[visitor] += 1
        return [name for _, _, name in sorted(ordered)]

    def about(self, name: str) -> dict[str, Any] | None:
        """How far a job is; None if there is no such job."""
        if name in self.waiting:
            return {"state": "waiting", "place": self.line().index(name) + len(self.running)}
        if name in self.running:
            return {"state": "running", "seconds": round(time.monotonic() - self.running[name][1])}
        if not (len(name) == 40 and name.isalnum() and name.isascii()):  # a name, never a path
            return None
        return read_json(self.folder / name / "done.json") or None

    def file(self, name: str, file: str) -> Path | None:
        """A file that a job has made; only those that it names itself."""
        files = [each["name"] for each in (self.about(name) or {}).get("files", ())]
        return self.folder / name / "out" / file if file in files else None

    async def _work(self) -> None:
        while True:
            if not (line := self.line()):
                self._wake.clear()
                await self._wake.wait()
                continue
            name = line[0]
            self.running[name] = self.waiting.pop(name), time.monotonic()
            try:
                await self._make(name)
            finally:
                self.running.pop(name, None)

    async def _make(self, name: str) -> None:
        folder, code = self.folder / name, 0
        out, lines, files = folder / "out", list[str](), list[dict[str, Any]]()
        try:
            out.mkdir(exist_ok=True)
            for command in read_json(folder / "order.json")["commands"]:
                said = await run(command, folder)
                lines += said.lines
                code = said.code
                if code not in (0, 1):
                    break
            if (folder / "csv").exists():  # many tables are taken as one file
                await asyncio.to_thread(
                    shutil.make_archive, str(out / "tables"), "zip", folder / "csv"
                )
            files = [{"name": path.name, "size": path.stat().st_size}
                     for path in sorted(out.iterdir()) if path.is_file()]  # fmt: skip
        except (OSError, KeyError):
            code, files, lines = 2, [], ["на сервере не удаётся записать файл; сообщите кафедре"]
        good = code in (0, 1, 3) and bool(files)
        lines = [line.replace(f"{folder}/", "") for line in lines]
        state = "done" if good else "failed"
        with contextlib.suppress(Exception):  # a full disk must not end the queue
            done = {"state": state, "files": files if good else [], "lines": lines}
            write_json(folder / "done.json", done)
            self._clean()

    def _clean(self) -> None:
        """Forget the oldest files where they are too old or too many."""
        done = sorted(self.folder.glob("*/done.json"), key=lambda path: -path.stat().st_mtime)
        size = 0
        for path in done:
            size += sum(each.stat().st_size for each in path.parent.rglob("*") if each.is_file())
            if size > MOST_BYTES or time.time() - path.stat().st_mtime > KEEP_S:
                shutil.rmtree(path.parent, ignore_errors=True)
