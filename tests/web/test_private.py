"""What the server keeps is for its own account: the folder from the first moment, every file."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
import threading
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from reports.cli import main
from reports.shared.errors import OutputError
from reports.shared.files import private_dir
from tests.web.conftest import MARK, serving

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has no modes")


@pytest.fixture
def open_place() -> Iterator[Path]:
    """A folder that every account may enter, as it is usual on a server."""
    built = Path(tempfile.mkdtemp(prefix="kshm-open-", dir="/tmp"))
    built.chmod(0o755)
    before = os.umask(0o022)
    yield built
    os.umask(before)
    shutil.rmtree(built)


def mode(path: Path) -> int:
    return path.stat().st_mode & 0o777


def asked(address: str, data: Any = None) -> Any:
    """What the server answers."""
    heads = {**MARK, "Content-Type": "application/json"}
    body = None if data is None else json.dumps(data).encode()
    with urllib.request.urlopen(urllib.request.Request(address, body, heads)) as answer:
        return json.load(answer)


def as_nobody(path: Path) -> str:
    """What another account is told of a path."""
    done = subprocess.run(
        ["ls", str(path)], user="nobody", group="nogroup", extra_groups=[], cwd="/",
        env={"LC_ALL": "C", "PATH": os.environ["PATH"]}, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    return done.stdout + done.stderr


def test_nobody_else_reads_the_data(open_place: Path) -> None:
    """The server is asked for a file, so that its processes write too."""
    data = open_place / "kshm-data"
    seen: set[int] = set()
    ended = threading.Event()

    def watch() -> None:
        while not ended.is_set():
            if data.exists():
                seen.add(mode(data))
            time.sleep(0.0005)

    watcher = threading.Thread(target=watch)
    watcher.start()
    try:
        with serving(open_place, "kshm-data") as served:
            raw = asked(f"{served.page}api/new", {"sample": "gots-diesel"})["raw"]
            page = asked(f"{served.page}api/files", {"kind": "json", "raw": raw})["id"]
            for _ in range(300):
                if asked(f"{served.page}api/files/{page}").get("state") == "done":
                    break
                time.sleep(0.2)
            kept = [data, *data.rglob("*")]
            assert any(path.name == "engine.json" for path in kept)
            wrong = [str(p) for p in kept if mode(p) != (0o700 if p.is_dir() else 0o600)]
            assert wrong == []
            if os.getuid() == 0:  # as another account sees it
                assert as_nobody(open_place) == "kshm-data\n"
                assert "Permission denied" in as_nobody(data)
                assert "Permission denied" in as_nobody(data / "secret.key")
    finally:
        ended.set()
        watcher.join()
    assert seen == {0o700}


def test_a_folder_that_an_earlier_server_has_left_open_is_closed(open_place: Path) -> None:
    for name in ("secret.key", None):
        folder = open_place / f"data-{name}"
        folder.mkdir()
        assert mode(folder) == 0o755
        if name:
            (folder / name).write_text("0")
        private_dir(folder, "secret.key")
        assert mode(folder) == 0o700


def test_a_folder_of_others_is_neither_closed_nor_used(open_place: Path) -> None:
    (open_place / "чужое").write_text("1", encoding="utf-8")
    with pytest.raises(OutputError, match="чужие файлы"):
        private_dir(open_place, "secret.key")
    assert mode(open_place) == 0o755
    done = CliRunner().invoke(main, ["serve", "--data", str(open_place)])
    assert done.exit_code == 2 and len(done.stderr.splitlines()) == 1
    assert os.umask(0o022) == 0o022  # nothing is left behind in this process
