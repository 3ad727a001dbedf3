from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from reports.live.page import live_page
from reports.model.evaluation import evaluate_model
from reports.workbook.course import short_model
from reports.workbook.write import workbook_bytes
from tests.cover import model_of

Opened = Callable[..., Any]


@pytest.fixture(scope="session")
def live_file(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """The live page of an engine, made once."""
    folder = tmp_path_factory.mktemp("live")

    def made(name: str) -> Path:
        path = folder / f"{name}-live.html"
        if not path.exists():
            model = model_of(name)
            book = workbook_bytes(short_model(model), evaluate_model(model))
            path.write_bytes(live_page(model, book, name))
        return path

    return made


@pytest.fixture
def live(browser: Any, live_file: Callable[[str], Path]) -> Opened:
    """Open a live page from its file with the network off; any request is a fault."""
    contexts = []

    def opened(
        name: str, width: int = 1366, height: int = 844, before: str = "", **more: Any
    ) -> Any:
        more = {"viewport": {"width": width, "height": height}, "reduced_motion": "reduce"} | more
        context = browser.new_context(offline=True, **more)
        contexts.append(context)
        page = context.new_page()
        page.faults = []
        page.on("pageerror", lambda error: page.faults.append(str(error)))
        page.on("console", lambda m: m.type == "error" and page.faults.append(m.text))
        page.on("request", lambda r: r.url.startswith(("file:", "data:", "blob:"))
                or page.faults.append(r.url))  # fmt: skip
        page.add_init_script(before)
        page.goto(live_file(name).as_uri())
        return page

    yield opened
    for context in contexts:
        context.close()
