"""Firefox without a window, driven by its own protocol: commands as JSON over a socket."""

from __future__ import annotations

import json
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from typing import Any

import pytest

NAMES = ("firefox-esr", "firefox")
_SETTINGS = {
    "marionette.port": 0, "network.proxy.type": 1, "network.proxy.socks": '"127.0.0.1"',
    "network.proxy.socks_port": 1, "app.update.auto": "false", "browser.shell.checkDefaultBrowser":
    "false", "datareporting.policy.dataSubmissionEnabled": "false", "ui.prefersReducedMotion": 1,
}  # fmt: skip  # every request beyond the file goes to a port where nobody is


class Firefox:
    """A page in Firefox."""

    def __init__(self, link: socket.socket) -> None:
        self.stream, self.numbers = link.makefile("rwb"), count(1)
        self._answer()  # who it is
        self.do("WebDriver:NewSession", capabilities={"alwaysMatch": {}})

    def _answer(self) -> Any:
        size = b""
        while (letter := self.stream.read(1)) != b":":
            size += letter
        return json.loads(self.stream.read(int(size)))

    def do(self, command: str, **more: Any) -> Any:
        text = json.dumps([0, next(self.numbers), command, more]).encode()
        self.stream.write(b"%d:%b" % (len(text), text))
        self.stream.flush()
        _, _, error, result = self._answer()
        assert error is None, error
        return result

    def evaluate(self, expression: str) -> Any:
        script = f"return ({expression});"
        return self.do("WebDriver:ExecuteScript", script=script, args=[], sandbox=None)["value"]

    def until(self, true: str) -> None:
        for _ in range(300):
            if self.evaluate(true):
                return
            time.sleep(0.1)
        raise AssertionError(true)


@contextmanager
def firefox(folder: Path, width: int, height: int) -> Iterator[Firefox]:
    """A browser until the block ends; a skip where there is none."""
    program = next(filter(None, map(shutil.which, NAMES)), None)
    if program is None:
        pytest.skip("Firefox не установлен: sudo apt-get install firefox-esr")
    folder.mkdir(exist_ok=True)
    lines = (f'user_pref("{key}", {value});' for key, value in _SETTINGS.items())
    (folder / "user.js").write_text("\n".join(lines))
    process = subprocess.Popen(
        [program, "--headless", "--marionette", "--no-remote", f"--width={width}",
         f"--height={height}", "--profile", str(folder), "about:blank"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        port = folder / "MarionetteActivePort"
        for _ in range(600):
            if port.exists() and port.read_text():
                break
            time.sleep(0.1)
        with socket.create_connection(("127.0.0.1", int(port.read_text())), 60) as link:
            yield Firefox(link)
    finally:
        process.terminate()
        process.wait(20)
