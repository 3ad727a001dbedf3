from __future__ import annotations

import asyncio
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Coroutine, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from reports.web.app import Settings, create_app

MARK = {"X-Kshm": "1"}
ROOT = Path(__file__).parents[2]


def finished(coroutine: Coroutine[Any, Any, Any]) -> Any:
    """What a coroutine gives, in a thread of its own: the browser's driver keeps a loop here."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, coroutine).result()


class Page:
    """A person's browser without its window."""

    def __init__(self, client: TestClient) -> None:
        self.client = client

    def post(self, path: str, data: Any, code: int = 200) -> Any:
        answer = self.client.post(path, json=data, headers=MARK)
        assert answer.status_code == code, answer.text
        return answer.json()

    def get(self, path: str, code: int = 200) -> Any:
        answer = self.client.get(path)
        assert answer.status_code == code, answer.text
        return answer.json()

    def sample(self, name: str = "gots-diesel") -> dict[str, Any]:
        raw: dict[str, Any] = self.post("/api/new", {"sample": name})["raw"]
        return raw


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    data: Path = tmp_path_factory.mktemp("data")
    app = create_app(Settings(data, per_s=1e6, workers=1))
    with TestClient(app, base_url="http://127.0.0.1:8321") as client:
        yield client


@pytest.fixture(scope="module")
def page(client: TestClient) -> Page:
    return Page(client)


@dataclass(frozen=True)
class Served:
    """A server as the command starts it: its two printed addresses, its folder, its process."""

    page: str
    teacher: str
    data: Path
    process: subprocess.Popen[str]


@contextmanager
def serving(path: Path, folder: str = ".", *more: str) -> Iterator[Served]:
    """The command ``serve`` until the block ends, or is ended within; ``folder`` is within."""
    data = path / folder
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    command = [
        sys.executable,
        "-m",
        "reports",
        "serve",
        "--port",
        str(port),
        "--data",
        str(data),
        *more,
    ]
    home = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path])}
    process = subprocess.Popen(
        command, cwd=path, env=home, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    assert process.stdout is not None
    page, teacher = (process.stdout.readline().partition(": ")[2].strip() for _ in range(2))
    for _ in range(200):
        with socket.socket() as probe:
            if probe.connect_ex(("127.0.0.1", port)) == 0:
                break
        time.sleep(0.1)
    yield Served(page, teacher, data, process)
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
        assert process.wait(20) in (0, -signal.SIGINT, 2)


@pytest.fixture(scope="session")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    """One server for all that a real browser does."""
    with serving(tmp_path_factory.mktemp("served")) as actual:
        yield actual


def opened(browser: Any, address: str, width: int = 1280, scheme: str = "light") -> Any:
    """A page of a person of his own; what goes wrong in it is kept in ``faults``."""
    context = browser.new_context(
        viewport={"width": width, "height": 900}, color_scheme=scheme, reduced_motion="reduce",
        has_touch=width < 500,
    )  # fmt: skip
    page = context.new_page()
    page.faults = []
    page.on("pageerror", lambda error: page.faults.append(str(error)))
    page.on("console", lambda m: m.type == "error" and page.faults.append(m.text))
    page.goto(address)
    return page


def until(page: Any, true: str) -> None:
    """Wait for what a page says; its own policy forbids a driver's loop inside it."""
    for _ in range(300):
        if page.evaluate(true):
            return
        page.wait_for_timeout(100)
    raise AssertionError(true)


def tab_to(page: Any, selector: str) -> None:
    """Go on by the Tab key alone; every stop on the way is seen and has its outline."""
    for _ in range(400):
        page.keyboard.press("Tab")
        stop = page.evaluate("""selector => {
            const e = document.activeElement, held = e.closest(".button") || e;
            const seen = held.getBoundingClientRect().width > 0 &&
                [e, held].some(each => getComputedStyle(each).outlineStyle !== "none");
            return [e.matches(selector), seen || e === document.body, e.outerHTML.slice(0, 120)];
        }""", selector)  # fmt: skip
        assert stop[1], stop[2]
        if stop[0]:
            return
    raise AssertionError(selector)


def photo(page: Any, name: str) -> None:
    """Pictures of a page for a person to look at, where ``KSHM_SHOTS`` names a folder."""
    folder = os.environ.get("KSHM_SHOTS")
    for scheme in ("light", "dark") if folder else ():
        for width in (1280, 390):
            page.emulate_media(color_scheme=scheme)
            page.set_viewport_size({"width": width, "height": 900})
            page.screenshot(path=f"{folder}/{name}-{width}-{scheme}.png", full_page=True)
