"""A person at the page: Chromium by Playwright, wide and narrow, light and dark."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from kshm import solve
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import engine_and_cycle
from tests.browser import chromium

playwright = pytest.importorskip("playwright.sync_api")
ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, str]]:
    """Addresses of the page and of the instructor, as the command prints them."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    data = tmp_path_factory.mktemp("served")
    command = [sys.executable, "-m", "reports", "serve", "--port", str(port), "--data", str(data)]
    home = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path])}
    process = subprocess.Popen(
        command, cwd=data, env=home, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    assert process.stdout is not None
    lines = [process.stdout.readline().partition(": ")[2].strip() for _ in range(2)]
    for _ in range(200):
        with socket.socket() as probe:
            if probe.connect_ex(("127.0.0.1", port)) == 0:
                break
        time.sleep(0.1)
    yield lines[0], lines[1]
    process.send_signal(signal.SIGINT)
    assert process.wait(20) in (0, -signal.SIGINT, 2)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    path = chromium()
    with playwright.sync_playwright() as driver:
        found = driver.chromium.launch(
            executable_path=path, args=["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"]
        )
        yield found
        found.close()


def opened(browser: Any, address: str, width: int = 1280, scheme: str = "light") -> Any:
    context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme)
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


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (390, "dark")])
def test_the_page_fits_and_shows_the_solvers_numbers(
    browser: Any, served: tuple[str, str], width: int, scheme: str, tmp_path: Path
) -> None:
    page = opened(browser, served[0], width, scheme)
    page.wait_for_selector("#chart-fig46 path")
    page.wait_for_selector("#checks table")
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    raw = page.evaluate("kshm.raw")
    solution = solve(*engine_and_cycle(load_mapping(raw, source="").model))
    shown = page.inner_text("tr[data-key=M_mean] td:nth-child(3)")
    assert float(shown.replace(",", ".")) == pytest.approx(solution.scalars["M_mean"], abs=0.06)
    page.evaluate("document.getElementById('phi').value = 370; turn()")
    value = page.inner_text("#chart-fig46 output >> nth=0").replace(",", ".").replace("−", "-")
    wanted = dict(zip(solution.columns["P4_1"]["phi_deg"], solution.columns["P4_1"]["Pg_MPa"],
                      strict=True))[370]  # fmt: skip
    assert float(value) == pytest.approx(wanted, rel=1e-4)
    assert not page.faults
    page.screenshot(path=os.environ.get("KSHM_SHOTS", str(tmp_path)) + f"/page-{width}.png")
    page.context.close()


def test_an_own_engine_by_the_keyboard_to_workbook_and_pdf(
    browser: Any, served: tuple[str, str], tmp_path: Path
) -> None:
    page = opened(browser, served[0])
    page.wait_for_selector("#chart-fig46 path")
    page.focus("#cylinders")
    page.keyboard.press("Control+A")
    page.keyboard.type("4")
    page.keyboard.press("Enter")  # the form's own button
    until(page, "kshm.raw?.engine.cylinders === 4 && kshm.last?.moves.throws.length === 4")
    bore = page.locator("[id='f-geometry.bore_mm']")
    before = page.evaluate("kshm.raw.geometry.bore_mm")
    bore.focus()
    page.keyboard.press("Control+A")
    page.keyboard.type("9999")
    page.wait_for_selector("[data-key='geometry.bore_mm'] .error")
    assert "1500" in page.inner_text("[data-key='geometry.bore_mm'] .error")
    page.keyboard.press("Control+A")
    page.keyboard.type("84,5")
    until(page, "!document.querySelector('.error') && kshm.raw.geometry.bore_mm === 84.5")
    for kind in ("xlsx", "pdf"):
        page.focus(f"[data-kind={kind}]")
        page.keyboard.press("Enter")
    for name in ("engine.xlsx", "engine.pdf"):
        page.wait_for_selector(f"#jobs a[download='{name}']", timeout=90_000)
    with page.expect_download() as download:
        page.click("#jobs a[download='engine.xlsx']")
    book = tmp_path / "engine.xlsx"
    download.value.save_as(book)
    page.click("#undo")
    until(page, f"kshm.raw.geometry.bore_mm === {before}")
    page.set_input_files("#upload", book)
    until(page, "kshm.raw.geometry.bore_mm === 84.5")
    assert not page.faults
    page.context.close()


def test_every_control_has_a_name(browser: Any, served: tuple[str, str]) -> None:
    page = opened(browser, served[0])
    page.wait_for_selector("#chart-fig46 path")
    nameless = page.evaluate("""[...document.querySelectorAll('input,select,button,a,svg[role]')]
        .filter(e => !(e.getAttribute('aria-label') || e.labels?.length || e.textContent.trim()))
        .map(e => e.outerHTML.slice(0, 100))""")
    assert nameless == []
    assert page.evaluate("new Set([...document.querySelectorAll('[id]')].map(e => e.id)).size "
                         "=== document.querySelectorAll('[id]').length")  # fmt: skip
    page.context.close()


def test_the_instructor_enters_by_the_printed_address(
    browser: Any, served: tuple[str, str]
) -> None:
    page = opened(browser, served[1])
    page.wait_for_selector("#inside:not([hidden])")
    assert "#" not in page.url
    stranger = opened(browser, served[0] + "teacher")
    stranger.wait_for_selector("#login:not([hidden])")
    assert not stranger.is_visible("#inside")
    page.context.close()
    stranger.context.close()
