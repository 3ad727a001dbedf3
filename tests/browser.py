"""Headless Chromium: a page measured and photographed at a given width."""

from __future__ import annotations

import http.server
import json
import os
import re
import shutil
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from html import unescape
from pathlib import Path
from typing import Any

import pytest

# The first has no window to draw: the same pages take a quarter less of the processor.
BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser")
_FLAGS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
)

# A window cannot be narrower than about 500 px: the page stands in a frame of its own width.
_FRAME = """<!DOCTYPE html><meta charset="utf-8"><style>body{{margin:0}}iframe{{border:0}}</style>
<iframe src="page.html" style="width:{width}px;height:{height}px"></iframe><pre id="found"></pre>
<script>
addEventListener("load", () => {{
  const view = document.querySelector("iframe").contentWindow, page = view.document;
  const wide = [...page.querySelectorAll("body *")].filter(e =>
    e.getBoundingClientRect().right > view.innerWidth + 1 && !boxed(e));
  function boxed(e) {{
    for (; e && e !== page.body; e = e.parentElement)
      if (["auto", "scroll", "hidden", "clip"].includes(view.getComputedStyle(e).overflowX))
        return true;
    return false;
  }}
  const found = {{
    scroll: page.documentElement.scrollWidth,
    width: view.innerWidth,
    scripts: page.scripts.length,
    wide: wide.slice(0, 5).map(e => e.outerHTML.slice(0, 120)),
    boxes: [...page.querySelectorAll("{boxes}")].map(e => [e.clientWidth, e.scrollWidth]),
    images: [...page.querySelectorAll("svg, img")].map(e => e.getBoundingClientRect().width),
    fonts: [...page.fonts].filter(f => f.status === "loaded").map(f => f.family),
  }};
  document.getElementById("found").textContent = JSON.stringify(found);
}});
</script>"""


def chromium() -> str:
    """The browser's path; without it a skip, in CI a failure."""
    measured = next(filter(None, map(shutil.which, BROWSERS)), None)
    if measured is None:
        if os.environ.get("CI") == "true":
            pytest.fail("chromium is missing: ./run test installs it")
        pytest.skip("Chromium не установлен: sudo apt-get install chromium")
    return measured


@contextmanager
def _served(folder: Path) -> Iterator[str]:
    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_: object) -> None:
            pass

    handler = partial(Quiet, directory=str(folder))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}"
    finally:
        server.shutdown()
        server.server_close()


def _run(folder: Path, address: str, *flags: str) -> str:
    command = [chromium(), *_FLAGS, f"--user-data-dir={folder / 'profile'}", *flags, address]
    done = subprocess.run(command, capture_output=True, text=True, timeout=180, check=True)
    return done.stdout


def measure(page: str, width: int, folder: Path, *, boxes: str = ".tbox") -> dict[str, Any]:
    """Widths of a page shown ``width`` px wide; ``boxes`` selects what may scroll by itself.

    Keys: scroll (of the page), width, scripts, wide (elements sticking out), boxes
    (client and scroll width of each), images (widths), fonts (loaded families).
    """
    folder.mkdir(exist_ok=True)
    (folder / "page.html").write_text(page, encoding="utf-8")
    frame = _FRAME.format(width=width, height=900, boxes=boxes)
    (folder / "frame.html").write_text(frame, encoding="utf-8")
    with _served(folder) as base:
        dom = _run(folder, f"{base}/frame.html", "--virtual-time-budget=20000", "--dump-dom")
    match = re.search(r'<pre id="found">(.*?)</pre>', dom, re.DOTALL)
    assert match and match.group(1), "the page did not load"
    collected: dict[str, Any] = json.loads(unescape(match.group(1)))
    return collected


def print_out(page: str, target: Path, folder: Path) -> Path:
    """Print a page as a person does from the browser; its PDF."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "page.html").write_text(page, encoding="utf-8")
    with _served(folder) as address:
        _run(folder, f"{address}/page.html", "--no-pdf-header-footer", f"--print-to-pdf={target}")
    return target


def photograph(page: str, width: int, height: int, target: Path, folder: Path) -> Path:
    """A picture of the page's beginning, ``width`` × ``height`` px."""
    folder.mkdir(exist_ok=True)
    (folder / "page.html").write_text(page, encoding="utf-8")
    frame = f'<style>body{{margin:0}}iframe{{border:0;width:{width}px;height:{height}px}}</style><iframe src="page.html"></iframe>'  # noqa: E501
    (folder / "frame.html").write_text(frame, encoding="utf-8")
    size = f"--window-size={max(width, 600)},{height}"
    with _served(folder) as base:
        _run(folder, f"{base}/frame.html", size, f"--screenshot={target}")
    return target
