"""The live page in Firefox, from its file: the same numbers as a new build, at two widths."""

from __future__ import annotations

import os
from base64 import b64decode
from collections.abc import Callable
from pathlib import Path

import pytest

from reports.model.evaluation import Evaluation
from reports.tables.registry import build_model
from tests.cover import model_of
from tests.live.firefox import firefox
from tests.live.node import distance


@pytest.mark.parametrize("width", [1366, 500])
def test_firefox_calculates_and_draws_the_page(
    width: int, live_file: Callable[[str], Path], tmp_path: Path
) -> None:
    with firefox(tmp_path / "profile", width, 844) as page:
        page.do("WebDriver:Navigate", url=live_file("gots-diesel").as_uri())
        page.until("document.documentElement.className === 'alive' && window.kshm")
        page.until("document.querySelectorAll('#charts canvas').length === 4")
        page.evaluate("kshm.set('geometry.bore_mm', 91.25)")
        model = model_of("gots-diesel")
        changed = model.input.geometry.model_copy(update={"bore_mm": 91.25})
        second = Evaluation(build_model(model.input.model_copy(update={"geometry": changed})))
        keys = [key for key in page.evaluate("kshm.keys().filter(key => !live.isFixed(key))")
                if key in model.scalars]  # fmt: skip
        actual = page.evaluate(f"{keys}.map(key => kshm.get(key))")
        assert len(keys) > 300
        far = [key for key, value in zip(keys, actual, strict=True)
               if distance(second.value(key), value) > 1e-9]  # fmt: skip
        assert far == []
        page.evaluate("document.getElementById('play').click()")
        page.until("live.state.phi > 90")
        page.evaluate("document.getElementById('play').click()")
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
        heights = page.evaluate(
            "['#mechanism', '#chart-fig49 canvas'].map(e =>"
            " document.querySelector(e).getBoundingClientRect().height)"
        )
        assert min(heights) > 120
        if folder := os.environ.get("KSHM_SHOTS"):
            picture = page.do("WebDriver:TakeScreenshot", full=False)["value"]
            Path(folder, f"firefox-{width}.png").write_bytes(b64decode(picture))
