"""A person at the page: Chromium by Playwright, wide and narrow, light and dark."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from kshm import solve
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import engine_and_cycle
from tests.web import axe
from tests.web.conftest import Served, opened, photo, until


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (390, "dark")])
def test_the_page_fits_and_shows_the_solvers_numbers(
    browser: Any, served: Served, width: int, scheme: str, tmp_path: Path
) -> None:
    page = opened(browser, served.page, width, scheme)
    page.wait_for_selector("#chart-fig46 output")
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
    assert axe.faults(page, (scheme,)) == []
    photo(page, "engine")
    page.context.close()


def test_an_own_engine_by_the_keyboard_to_workbook_and_pdf(
    browser: Any, served: Served, tmp_path: Path
) -> None:
    page = opened(browser, served.page)
    page.wait_for_selector("#chart-fig46 output")
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


def test_every_control_has_a_name(browser: Any, served: Served) -> None:
    page = opened(browser, served.page)
    page.wait_for_selector("#chart-fig46 output")
    nameless = page.evaluate("""[...document.querySelectorAll('input,select,button,a,svg[role]')]
        .filter(e => !(e.getAttribute('aria-label') || e.labels?.length || e.textContent.trim()))
        .map(e => e.outerHTML.slice(0, 100))""")
    assert nameless == []
    assert page.evaluate("new Set([...document.querySelectorAll('[id]')].map(e => e.id)).size "
                         "=== document.querySelectorAll('[id]').length")  # fmt: skip
    page.context.close()
