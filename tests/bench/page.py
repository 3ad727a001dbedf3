"""Frames of the running mechanism in Chromium: wide and narrow, at full speed and slowed."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

from tests.bench._figure import Figure

COUNT = "window.count = 0; (function next() { count++; requestAnimationFrame(next); })()"


def figures() -> Iterator[Figure]:
    """Frames a second and processor time of one."""
    from playwright.sync_api import sync_playwright

    from tests.browser import chromium
    from tests.web.conftest import serving

    with (
        tempfile.TemporaryDirectory(prefix="kshm-bench-") as folder,
        serving(Path(folder), "data") as served,
        sync_playwright() as driver,
    ):
        browser = driver.chromium.launch(
            executable_path=chromium(), args=["--no-sandbox", "--disable-gpu"]
        )
        for width, slow in ((1366, 1), (1366, 4), (390, 1), (390, 4)):
            page = browser.new_page(
                viewport={"width": width, "height": 800}, reduced_motion="reduce"
            )
            page.goto(served.page)
            page.wait_for_selector("#checks table", timeout=60_000)
            inside = page.context.new_cdp_session(page)
            inside.send("Performance.enable")
            inside.send("Emulation.setCPUThrottlingRate", {"rate": slow})
            page.get_by_role("button", name="Пуск").click()
            page.evaluate(COUNT)

            def now(page=page, inside=inside) -> tuple[float, float, float]:  # type: ignore[no-untyped-def]
                actual = inside.send("Performance.getMetrics")["metrics"]
                task = next(each["value"] for each in actual if each["name"] == "TaskDuration")
                return page.evaluate("performance.now()") / 1000, page.evaluate("count"), task

            began = now()
            page.wait_for_timeout(3000)
            seconds, frames, task = (b - a for a, b in zip(began, now(), strict=True))
            where = f"{width} px, замедление {slow}"
            yield Figure(f"кадров в секунду, {where}", frames / seconds, "")
            yield Figure(f"процессор на кадр, {where}", 1000 * task / frames, "мс")
            page.context.close()
        browser.close()
