"""The live page in Chromium: its size, opening, an edit, frames of a slider; idle and slowed."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from pathlib import Path
from statistics import median
from typing import Any

from reports.exports.build import build, load_input
from reports.shared.resources import samples_dir
from tests.bench._figure import Figure
from tests.browser import chromium

ENGINES = ("gots-diesel", "yamz-238")
EDITS = """count => Array.from({length: count}, (_, i) => {
    const was = kshm.get("regime_speed_rpm"), began = performance.now();
    kshm.set("regime.speed_rpm", was + (i % 2 ? -1 : 1));
    WHOLE
    return performance.now() - began;
})"""
SEEN = EDITS.replace("WHOLE", "")
WHOLE = EDITS.replace("WHOLE", "kshm.keys().forEach(key => kshm.get(key));")
FRAMES = """async seconds => {
    const slider = document.querySelector("#five [type=range]"), began = performance.now();
    let frames = 0;
    while (performance.now() - began < 1000 * seconds) {
        slider.value = Number(slider.value) + (frames % 40 < 20 ? 1 : -1) * Number(slider.step);
        slider.dispatchEvent(new Event("input", {bubbles: true}));
        await new Promise(requestAnimationFrame);
        frames++;
    }
    return frames / seconds;
}"""


def figures() -> Iterator[Figure]:
    """Of an engine in line and of a V8."""
    from playwright.sync_api import sync_playwright

    with tempfile.TemporaryDirectory(prefix="kshm-bench-") as name, sync_playwright() as driver:
        browser = driver.chromium.launch(
            executable_path=chromium(), args=["--no-sandbox", "--disable-gpu"]
        )
        for engine in ENGINES:
            source = samples_dir() / f"{engine}.toml"
            (file,) = build(source, load_input(source), Path(name), ("live",)).files
            yield Figure(f"{engine}: файл", file.stat().st_size / 1e6, "МБ")
            for slow in (1, 4):
                yield from _at(browser, file, engine, slow)
        browser.close()


def _at(browser: Any, file: Path, engine: str, slow: int) -> Iterator[Figure]:
    page = browser.new_page(viewport={"width": 1366, "height": 800}, reduced_motion="reduce")
    inside = page.context.new_cdp_session(page)
    inside.send("Emulation.setCPUThrottlingRate", {"rate": slow})
    page.goto(file.as_uri())
    page.wait_for_selector("#charts canvas")
    where = f"{engine}, замедление {slow}"
    yield Figure(f"{where}: загрузка машины за минуту", os.getloadavg()[0], "")
    yield Figure(f"{where}: открытие", page.evaluate("performance.now()") / 1000, "с")
    page.wait_for_timeout(500)
    yield Figure(f"{where}: правка, что видно", median(page.evaluate(SEEN, 20)), "мс")
    yield Figure(f"{where}: правка, весь двигатель", median(page.evaluate(WHOLE, 20)), "мс")
    yield Figure(f"{where}: кадров в секунду, ползунок", page.evaluate(FRAMES, 3), "")
    page.close()
