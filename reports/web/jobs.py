"""Commands run in subprocesses with limits, queued on disk; the files they make.

A job is a folder.  Its ``order.json`` stands from the beginning, ``done.json`` at the end; what
has the first alone when the server starts is done again.
"""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import json
import os
import re
import shutil
import signal
import sys
import time
from collections.abc import AsyncIterator, Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.routing import Route

from reports.inputs.form_fields import Data
from reports.inputs.sections.report import FORMATS
from reports.shared.errors import InputError, KshmError, Problem, one_line
from reports.shared.files import make_dir, read_json, write_json, write_text, write_zip
from reports.shared.resources import source_digest
from reports.web import engine
from reports.web.http_guards import Shown, ask, body, post, public_words, shown, visitor
from reports.web.shared_engines import address_of, fair

_LINES = 40  # of what a command said
_NO_ROOM = "на сервере не удаётся записать файл; сообщите тому, кто его держит"
# The command with little memory. When its stdin ends, the server is gone, however it ended: the
# command goes with all that it has started. Who waits for a number comes before a file.
_KSHM = """
import os, sys, threading
def end():
    while os.read(0, 1):
        pass
    os.killpg(0, 9) if hasattr(os, "killpg") else os._exit(1)
threading.Thread(target=end, daemon=True).start()
from reports.shared.workers import limit_memory
from reports.__main__ import start
limit_memory(3 * 2**30)
getattr(os, "nice", abs)(15)
start()
"""
_SYSTEM = (
    "PATH", "HOME", "LANG", "LC_ALL", "TMPDIR", "PYTHONPATH", "FONTCONFIG_PATH", "FONTCONFIG_FILE",
    "XDG_CACHE_HOME",
    # Windows: where programs, fonts, settings, temporary files and the parts of WeasyPrint are
    "SYSTEMROOT", "WINDIR", "USERPROFILE", "LOCALAPPDATA", "TEMP", "WEASYPRINT_DLL_DIRECTORIES",
)  # fmt: skip
Texts = Mapping[str, str]  # of files by name
MAX_WAITING, MAX_NEAR, MAX_OWN = 500, 200, 6  # of all, of an address, of a visitor
MAX_BYTES = 2 * 10**9  # of all files kept
KEEP_S = 14 * 86400.0
_BUILD = ("build", "engine.toml", "-o", "out", "--only")
_COMPARE = ("compare", "engine.toml", "other.toml", "-o")
OFFERED = {  # titles of files and what makes them
    **{kind: (title[0].upper() + title[1:], (*_BUILD, kind)) for kind, title in FORMATS.items()},
    "csv": ("Таблицы CSV", ("solve", "engine.toml", "--csv", "csv")),
    "json": ("Числа JSON", ("solve", "engine.toml", "--json", "out/engine.json")),
    "compare-xlsx": ("Сравнение: книга", (*_COMPARE, "out/compare.xlsx")),
    "compare-pdf": ("Сравнение: PDF", (*_COMPARE, "out/compare.pdf")),
}


def failed(why: str) -> dict[str, Any]:
    """How a command ended that could not be done."""
    return {"state": "failed", "lines": [why]}


async def _said(process: asyncio.subprocess.Process) -> bytes:
    """What a command has said at its end; its stdin stays open as long as this server lives."""
    assert process.stderr is not None
    said = await process.stderr.read()
    await process.wait()
    return said


async def run(
    arguments: Sequence[str], folder: Path, timeout_s: float, more: Mapping[str, str] | None = None
) -> dict[str, Any]:
    """Run a command of kshm in a folder with limits; kill its process group at the end.

    ``more`` are variables of its environment.

    Returns:
        Whether it is done or failed, and what it said.
    """
    environment = {key: os.environ[key] for key in _SYSTEM if key in os.environ}
    home = [str(Path(__file__).resolve().parents[2]), environment.get("PYTHONPATH", "")]
    environment |= {"PYTHONPATH": os.pathsep.join(filter(None, home)), "PYTHONIOENCODING": "utf-8"}
    environment |= more or {}
    environment |= {
        "OPENBLAS_NUM_THREADS": "1",
        "OMP_NUM_THREADS": "1",
    }  # as many jobs as processors
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-c", _KSHM, *arguments, cwd=folder, env=environment,
        start_new_session=True, stdin=asyncio.subprocess.PIPE,
        stdout=asyncio.subprocess.DEVNULL, stderr=asyncio.subprocess.PIPE,
    )  # fmt: skip
    try:
        said = await asyncio.wait_for(_said(process), timeout_s)
    except TimeoutError:
        return failed(f"не сделано за {timeout_s:.0f} с: уменьшите расчёт")
    finally:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL) if hasattr(os, "killpg") else process.kill()
        with contextlib.suppress(asyncio.CancelledError):
            await process.wait()
    code = process.returncode or 0
    if code < 0:
        return failed("процесс прерван: повторите")
    text = said.decode("utf-8", "replace").replace(f"{folder}{os.sep}", "")
    lines = public_words(text).splitlines()
    return {
        "state": "done" if code in (0, 1) else "failed",
        "lines": [one_line(line, 400) for line in lines if line.strip()][:_LINES],
    }


class Queue:
    """Commands in folders of one folder, ``at_once`` together.

    ``secret`` makes names unguessable; ``more`` are variables of the commands' environment; a
    cluster at ``dask`` does what commands leave to it.
    """

    timeout_s: ClassVar[float]  # that a command may take
    pack: ClassVar[tuple[str, str, str]]  # archive of its many files, their folder and pattern

    def __init__(self, folder: Path, secret: bytes, dask: str | None, at_once: int = 1,
                 more: Mapping[str, str] | None = None) -> None:  # fmt: skip
        self.folder, self.secret, self.at_once = folder, secret, at_once
        self.far = ["--dask", dask] if dask else []
        self.more = more or {}
        self.waiting: dict[str, str] = {}  # job → visitor, in the order of coming
        self.running: dict[str, tuple[str, float]] = {}  # job → visitor, beginning
        self.tasks: dict[str, asyncio.Task[dict[str, Any]]] = {}
        self.unwritten: dict[str, dict[str, Any]] = {}  # ends for which the disk has no room
        self.took = 10.0  # seconds of a job, a moving mean
        self._ready = asyncio.Semaphore(0)  # as many as wait

    @contextlib.asynccontextmanager
    async def working(self) -> AsyncIterator[None]:
        """Resume queued jobs of an earlier server; leave running ones to the next server."""
        make_dir(self.folder)
        for folder in self.folder.iterdir():
            if folder.is_dir() and not (folder / "order.json").exists():  # half made
                shutil.rmtree(folder, ignore_errors=True)
        left = [path for path in self.folder.glob("*/order.json")
                if not path.with_name("done.json").exists()]  # fmt: skip
        for path in sorted(left, key=lambda path: path.stat().st_mtime):
            self.waiting[path.parent.name] = read_json(path).get("visitor", "")
        self._ready = asyncio.Semaphore(len(self.waiting))
        async with asyncio.TaskGroup() as group:
            tasks = [group.create_task(self._work()) for _ in range(self.at_once)]
            yield
            for task in tasks:
                task.cancel()

    def put(self, name: str, files: Texts, command: Sequence[str], visitor: str = "") -> None:
        """Queue a command to be run in the folder of that name, beside these files."""
        folder = self.folder / name
        folder.mkdir(mode=0o700, exist_ok=True)
        (folder / "done.json").unlink(missing_ok=True)
        for file, text in files.items():
            write_text(folder / file, text)
        write_json(folder / "order.json", {"visitor": visitor, "command": command})
        self.waiting[name] = visitor
        self.unwritten.pop(name, None)
        self._ready.release()

    def line(self) -> list[str]:
        """Return the waiting jobs in their order: everybody's first before anybody's second."""
        return fair(self.waiting, (visitor for visitor, _ in self.running.values()))

    def about(self, name: str) -> dict[str, Any]:
        """How far a job is; nothing if there is no such job."""
        if name in self.waiting:
            position = self.line().index(name) + len(self.running)
            return {"state": "waiting", "place": position,
                    "wait": round(self.took * position / self.at_once)}  # fmt: skip
        if name in self.running:
            return {"state": "running", "seconds": round(time.monotonic() - self.running[name][1])}
        done = read_json(self.folder / name / "done.json") if name.isalnum() else {}  # never a path
        return done or self.unwritten.get(name, {})

    async def _work(self) -> None:
        while await self._ready.acquire():
            if not self.waiting:  # what had come was cancelled
                continue
            name = self.line()[0]
            began = time.monotonic()
            self.running[name] = self.waiting.pop(name), began
            task = self.tasks[name] = asyncio.ensure_future(self._make(self.folder / name))
            try:
                done = await task
                self.took += 0.2 * (time.monotonic() - began - self.took)
            except asyncio.CancelledError:
                if (current := asyncio.current_task()) and current.cancelling():  # the server ends
                    raise
                shutil.rmtree(self.folder / name, ignore_errors=True)
                del self.running[name], self.tasks[name]
                continue
            except OSError:
                done = failed(_NO_ROOM)
            except Exception:  # a bug must cost one job, never the queue
                done = failed("внутренняя ошибка: повторите")
            try:
                write_json(self.folder / name / "done.json", done)
            except (OSError, KshmError):  # a full disk must not end the queue
                self.unwritten[name] = failed(_NO_ROOM)
            del self.running[name], self.tasks[name]

    def cancel(self, name: str) -> None:
        """Give up a job that waits or is running."""
        if self.waiting.pop(name, None) is not None:
            shutil.rmtree(self.folder / name, ignore_errors=True)
        elif name in self.tasks:
            self.tasks[name].cancel()

    async def _make(self, folder: Path) -> dict[str, Any]:
        command = read_json(folder / "order.json").get("command", ())
        done = await run(command, folder, self.timeout_s, self.more)
        target, into, pattern = self.pack
        files = {path.relative_to(folder / into).as_posix(): path
                 for path in sorted((folder / into).glob(pattern))}  # fmt: skip
        if files:
            await asyncio.to_thread(write_zip, folder / target, files)
        return done


class Jobs(Queue):
    """Files made by commands, each named by its content and the server's secret.

    The same order is made once, nobody guesses another's, and the oldest are forgotten.
    """

    timeout_s = 300.0
    pack = ("out/tables.zip", "csv", "*.csv")

    def add(self, files: Texts, command: Sequence[str], visitor: str, title: str = "engine") -> str:
        """Return name of a job: a command beside files; InputError where enough jobs wait already.

        ``title`` is what its files are called.
        """
        text = json.dumps(
            [files, command, title, source_digest()], ensure_ascii=False, sort_keys=True
        )
        name = hmac.digest(self.secret, text.encode(), "sha256").hex()[:40]
        folder, state = self.folder / name, self.about(name).get("state")
        if state == "done":
            os.utime(folder / "done.json")
        if state in ("waiting", "running", "done"):
            return name
        everybody = [*self.waiting.values(), *(who for who, _ in self.running.values())]
        count = everybody.count(visitor)
        neighbours = sum(address_of(who) == address_of(visitor) for who in everybody)
        if len(self.waiting) >= MAX_WAITING or neighbours >= MAX_NEAR or count >= MAX_OWN:
            problem = "очередь полна" if count < MAX_OWN else f"у вас уже {count} файлов в очереди"
            raise InputError(Problem("", problem, "дождитесь их"))
        shutil.rmtree(folder, ignore_errors=True)
        self.clean()
        self.put(name, files, command, visitor)
        write_json(folder / "title.json", {"title": title})
        return name

    def clean(self) -> None:
        """Forget the oldest files where they are too old or too many."""
        done = sorted(self.folder.glob("*/done.json"), key=lambda path: -path.stat().st_mtime)
        size = 0
        for path in done:
            size += sum(each.stat().st_size for each in path.parent.rglob("*") if each.is_file())
            if size > MAX_BYTES or time.time() - path.stat().st_mtime > KEEP_S:
                shutil.rmtree(path.parent, ignore_errors=True)

    def routes(self) -> list[Route]:
        """Routes to order, poll and download files."""
        return [post("/api/files", self._ordered), post("/api/files/{name}/cancel", self._cancel),
                *shown("/api/files/{name}", self._made)]  # fmt: skip

    async def _cancel(self, request: Request) -> None:
        name = request.path_params["name"]
        owner = self.waiting.get(name) or self.running.get(name, ("", 0.0))[0]
        if owner != visitor(request):
            raise HTTPException(409, "этот файл уже сделан или заказан другим")
        self.cancel(name)

    async def _ordered(self, request: Request) -> Data:
        data = await body(request)
        _, command = OFFERED.get(str(data.get("kind")), ("", ()))
        if not command:
            raise InputError(Problem("kind", "нет такого вида файла", "обновите страницу"))
        inputs = {"engine.toml": data.get("raw"), "other.toml": data.get("other")}
        if "other.toml" in command and not data.get("other"):
            raise InputError(Problem("", "нет второго двигателя", "нажмите «Сравнить с этим»"))
        texts = {name: (await ask(request, engine.as_toml, raw))["text"]
                 for name, raw in inputs.items() if name in command}  # fmt: skip
        whole = [*command, *(self.far if "build" in command else ())]
        return {"id": self.add(texts, whole, visitor(request), _file_name(data["raw"]))}

    def _made(self, request: Request) -> Shown:
        name = request.path_params["name"]
        if not (record := self.about(name)):
            raise HTTPException(404, "нет такого файла; закажите заново")
        files = sorted((self.folder / name / "out").glob("[!.]*"))
        title = read_json(self.folder / name / "title.json").get("title", "engine")
        names = {path.name: path.name.replace("engine", title) if "engine" in path.name
                 else f"{title}, {path.name}" for path in files}  # fmt: skip
        sizes = [{"file": path.name, "name": names[path.name], "size": path.stat().st_size}
                 for path in files]  # fmt: skip
        return Shown({**record, "files": sizes}, {path.name: path for path in files}, names=names)


def _file_name(raw: Mapping[str, Any]) -> str:
    """Return what files of an engine are called, whatever a file system allows."""
    name = str((raw.get("engine") or {}).get("name") or "engine")
    return re.sub(r'[\\/:*?"<>|\s\x00-\x1f]+', " ", name).strip(" .")[:80] or "engine"
