"""The files that the page offers: ordered, made by the commands, kept for a while, taken."""

from __future__ import annotations

import hmac
import json
import os
import shutil
import time
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.routing import Route

from reports.inputs.described import Data
from reports.inputs.sections.report import FORMATS
from reports.shared.errors import InputError, Problem
from reports.shared.files import write_text
from reports.web import engine
from reports.web.doors import Shown, ask, body, caller, route, shown
from reports.web.jobs import Queue

TIMEOUT_S = 300.0
MOST_WAITING, MOST_OWN = 500, 6
MOST_BYTES = 2 * 10**9  # of all files kept
KEEP_S = 14 * 86400.0
KINDS = {
    **{kind: title[0].upper() + title[1:] for kind, title in FORMATS.items()},
    "csv": "Таблицы CSV", "json": "Числа JSON",
    "compare-xlsx": "Сравнение: книга", "compare-pdf": "Сравнение: PDF",
}  # fmt: skip


def command(kind: str, dask: str | None) -> list[str]:
    """What makes a kind of file out of ``engine.toml`` (and ``other.toml``) into ``out``."""
    if kind.startswith("compare-"):
        return ["compare", "engine.toml", "other.toml", "-o", f"out/compare.{kind[8:]}"]
    if kind in ("csv", "json"):
        where = "csv" if kind == "csv" else "out/engine.json"
        return ["solve", "engine.toml", f"--{kind}", where]
    far = ["--dask", dask] if dask else []
    return ["build", "engine.toml", "-o", "out", "--only", kind, *far]


class Jobs(Queue):
    """Files made by commands, each named by its content and the server's secret.

    The same order is made once, nobody guesses another's, and the oldest are forgotten.
    """

    def __init__(self, folder: Path, secret: bytes, at_once: int, dask: str | None = None) -> None:
        super().__init__(folder, at_once, TIMEOUT_S, ("out/tables.zip", "csv", "*.csv"))
        self.secret, self.dask = secret, dask

    def add(self, files: Mapping[str, str], command: Sequence[str], visitor: str) -> str:
        """An order: files by name, the command to run beside them; the name of the job.

        Raises:
            InputError: the queue is full, or the visitor has enough in it.
        """
        text = json.dumps([files, command, version("kshm")], ensure_ascii=False, sort_keys=True)
        name = hmac.digest(self.secret, text.encode(), "sha256").hex()[:40]
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
        self.clean()
        self.put(name, command, visitor)
        return name

    def clean(self) -> None:
        """Forget the oldest files where they are too old or too many."""
        done = sorted(self.folder.glob("*/done.json"), key=lambda path: -path.stat().st_mtime)
        size = 0
        for path in done:
            size += sum(each.stat().st_size for each in path.parent.rglob("*") if each.is_file())
            if size > MOST_BYTES or time.time() - path.stat().st_mtime > KEEP_S:
                shutil.rmtree(path.parent, ignore_errors=True)

    def routes(self) -> list[Route]:
        """Doors at which files are ordered, asked after and taken."""
        order = route("/api/files", self._ordered, "POST")
        return [order, *shown("/api/files/{name}", self._made)]

    async def _ordered(self, request: Request) -> Data:
        data = await body(request)
        kind = str(data.get("kind"))
        if kind not in KINDS:
            raise InputError(Problem("kind", "нет такого вида файла", "обновите страницу"))
        wanted = {"engine.toml": data.get("raw")}
        if kind.startswith("compare-"):
            wanted["other.toml"] = data.get("other")
            if not wanted["other.toml"]:
                raise InputError(Problem("", "нет второго двигателя", "нажмите «Сравнить с этим»"))
        texts = {name: (await ask(request, engine.as_toml, raw))["text"]
                 for name, raw in wanted.items()}  # fmt: skip
        who = request.session.get("visitor") or caller(request)
        return {"id": self.add(texts, command(kind, self.dask), who)}

    def _made(self, request: Request) -> Shown:
        name = request.path_params["name"]
        if not (about := self.about(name)):
            raise HTTPException(404, "нет такого файла; закажите заново")
        made = sorted((self.folder / name / "out").glob("[!.]*"))
        sizes = [{"name": path.name, "size": path.stat().st_size} for path in made]
        return Shown({**about, "files": sizes}, {path.name: path for path in made})
