"""The live page in Chromium: a file, no network, the numbers of a new build after every edit."""

from __future__ import annotations

import random
import re
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from reports.inputs.fields import key_text, to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import Evaluation
from reports.shared.russian import fixed
from reports.tables.registry import build_model
from reports.workbook.course import short_model
from reports.workbook.layout import Layout
from reports.workbook.read import load_workbook_input
from tests.conftest import sample
from tests.cover import model_of, sparse
from tests.live.conftest import Opened
from tests.live.node import distance
from tests.referee.changes import changed_everywhere
from tests.web import axe
from tests.web.conftest import tab_to, until
from tools.referees.by_libreoffice import LibreOffice

MAX_BYTES = 3_000_000
SET = "([key, value]) => { try { kshm.set(key, value) } catch (e) { return e.message } }"
MOVING = "keys => keys.filter(key => !live.isFixed(key))"
GET = "keys => keys.map(key => kshm.get(key))"
NAMES = sparse(("gots-diesel", "articulated", "two-stroke", "yamz-238", "cycle-petrol"))


@pytest.mark.parametrize("name", NAMES)
def test_an_edit_gives_the_numbers_of_a_new_build(
    name: str, live: Opened, live_file: Callable[[str], Path]
) -> None:
    assert live_file(name).stat().st_size < MAX_BYTES
    page, model = live(name), model_of(name)
    page.wait_for_selector("#numbers")
    assert "NaN" not in page.content().partition("<script")[0]
    changes, changed = changed_everywhere(model.input, random.Random(name), 0.02)
    free, titles = page.evaluate("[kshm.keys(), live.state.titles]")
    refused = []
    for change in changes:
        if key_text(change.field.path) not in titles:
            continue  # nothing of the short book reads it
        message = page.evaluate(
            SET,
            [key_text(change.field.path), change.value],
        )
        refused += [message] if message else []
    assert "\n".join(refused) == ""
    second = Evaluation(build_model(changed))
    keys = page.evaluate(MOVING, [key for key in model.nodes if key in free])
    actual = page.evaluate(GET, keys)
    far = {key: distance(np.asarray(second.value(key)).tolist(), value)
           for key, value in zip(keys, actual, strict=True)}  # fmt: skip
    assert {key: each for key, each in far.items() if each > 1e-9} == {}
    shown = page.inner_text("[data-key=M_mean] b")
    assert shown == fixed(
        float(second.value("M_mean")), model.scalars["M_mean"].quantity.digits.decimals
    )
    assert not page.faults


def test_of_several_pins_the_most_loaded_one_is_told(live: Opened) -> None:
    """Sheet 1 told of pin 4, the page of pin 1."""
    page, model = live("yamz-238"), model_of("yamz-238")
    page.wait_for_selector("#numbers")
    raw, pins = to_mapping(model.input), set[int]()
    for speed in (raw["regime"]["speed_rpm"], 3000.0):
        assert page.evaluate(SET, ["regime.speed_rpm", speed]) is None
        raw["regime"]["speed_rpm"] = speed
        values = Evaluation(build_model(load_mapping(raw, source="").model))
        pins.add(worst := round(float(values.value("worst_pin_load"))))
        key = f"Rpin{worst if worst > 1 else ''}_max"
        shown = page.inner_text(f"[data-key={key}] b")
        assert shown == fixed(float(values.value(key)), model.scalars[key].quantity.digits.decimals)
        titles = " ".join(page.locator("#charts").all_inner_texts())
        assert set(re.findall(r"на шатунную шейку (\d)", titles)) == {str(worst)}
    assert len(pins) == 2


def test_a_value_beyond_its_limits_leaves_the_last_good_engine(live: Opened) -> None:
    page = live("gots-diesel")
    before = page.inner_text("[data-key=M_mean] b")
    box = page.locator("#five input").first
    for text in ("5000", "abc"):
        box.fill(text)
        page.wait_for_selector("#five .error")
        assert page.inner_text("[data-key=M_mean] b") == before
        assert page.is_visible("#stale")
    assert "нужно число" in page.inner_text("#five .error")
    box.fill("90,5")
    page.wait_for_selector("#stale", state="hidden")
    assert page.evaluate("kshm.get('geometry_bore_mm')") == 90.5
    assert page.inner_text("[data-key=M_mean] b") != before
    message = page.evaluate(SET, ["engine.cylinders", 4])
    assert message == "engine.cylinders: это строение двигателя; нужен build"


SIZES = [(390, 844), (844, 390), (768, 1024), (1366, 768), (1920, 1080)]


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_the_page_fits_and_a_reader_of_screens_finds_its_way(
    width: int, height: int, live: Opened
) -> None:
    page = live("gots-diesel", width, height)
    page.wait_for_selector("#chart-fig50 canvas")
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert axe.faults(page) == []  # light and dark
    if width == 390:
        tops = page.evaluate("""["#five [data-key='geometry.bore_mm'] input", "#charts figure"]
            .map(each => document.querySelector(each).getBoundingClientRect().top)""")
        assert max(tops) < 2 * height
    assert not page.faults


def test_nothing_is_announced_while_it_moves_and_once_when_it_stops(live: Opened) -> None:
    page = live("gots-diesel")
    page.wait_for_selector("#chart-fig50 canvas")
    page.evaluate("live.state.spoken = []; new MutationObserver(all => live.state.spoken.push("
                  "...all.map(e => e.target.textContent).filter(Boolean)))"
                  ".observe(document.querySelector('[role=status]'), {subtree: true, "
                  "childList: true, characterData: true})")  # fmt: skip
    page.get_by_role("button", name="Пуск").click()
    page.wait_for_timeout(500)
    assert page.evaluate("live.state.spoken.length") == 0
    assert page.evaluate(
        "[...document.querySelectorAll('output')].every(e => e.ariaLive === 'off')"
    )
    page.get_by_role("button", name="Стоп").click()
    until(page, "new Set(live.state.spoken).size === 1")
    assert not page.faults


# A phone on its side; windows of 1366 × 768 and 1024 × 768 at 200 %.
@pytest.mark.parametrize(("width", "height"), [(844, 390), (683, 384), (512, 384)])
def test_the_mechanism_is_usable_in_a_low_window(width: int, height: int, live: Opened) -> None:
    page = live("yamz-238", width, height)
    page.wait_for_selector("#charts canvas")
    page.locator("#drive").evaluate("e => e.scrollIntoView({block: 'end'})")
    boxes = {each: page.locator(each).bounding_box() for each in ("#mechanism", "#play", "#phi")}
    for each, box in boxes.items():
        assert box["y"] >= -1 and box["y"] + box["height"] <= height + 1, each
        assert box["x"] >= 0 and box["x"] + box["width"] <= width, each
    assert boxes["#mechanism"]["height"] > 0.5 * height
    assert boxes["#phi"]["width"] > 150
    page.locator("#five input[type=range]").first.scroll_into_view_if_needed()
    box = page.locator("#five input[type=range]").first.bounding_box()  # nothing lies over it
    hit = page.evaluate("([x, y]) => document.elementFromPoint(x, y).type",
                        [box["x"] + box["width"] / 2, box["y"] + box["height"] / 2])  # fmt: skip
    assert hit == "range"


def test_the_keyboard_alone_changes_turns_reads_and_takes_home(live: Opened) -> None:
    page = live("gots-diesel")
    page.wait_for_selector("#charts canvas")
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.hash") == "#results"  # past the fields
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.id") == "sheet"
    page.keyboard.press("ArrowDown")
    until(page, "live.state.sheet !== ''")
    page.evaluate("document.activeElement.blur(); scrollTo(0, 0)")
    tab_to(page, "#five [data-key='geometry.bore_mm'] input")
    before = page.inner_text("[data-key=M_mean] b")
    page.keyboard.press("Control+A")
    page.keyboard.type("91,5")
    until(page, "kshm.get('geometry_bore_mm') === 91.5")
    page.keyboard.press("Tab")
    page.keyboard.press("ArrowRight")
    until(page, "kshm.get('geometry_bore_mm') > 91.5")
    assert page.inner_text("[data-key=M_mean] b") != before
    tab_to(page, "#play")
    page.keyboard.press("Enter")
    until(page, "live.state.phi > 20")
    page.keyboard.press("Enter")
    tab_to(page, "#phi")
    page.keyboard.press("Home")
    page.keyboard.press("ArrowRight")
    until(page, "live.state.phi === 1")
    tab_to(page, "#tables summary")
    page.keyboard.press("Enter")
    page.wait_for_selector("#tables details[open] table")
    page.evaluate("document.activeElement.blur(); scrollTo(0, 0)")
    tab_to(page, "#save")
    with page.expect_download():
        page.keyboard.press("Enter")
    assert not page.faults


GATE = Path("reports/web/static/gate.js")


def test_an_old_browser_reads_one_sentence_above_the_results(live: Opened) -> None:
    for lost in ("delete Array.prototype.toSorted", "CSS.supports = () => false",
                 "delete HTMLScriptElement.supports"):  # fmt: skip
        page = live("gots-diesel", before=lost)
        assert page.inner_text("#old").startswith("Браузер слишком старый"), lost
        assert "113,5" in page.inner_text("#plain")
        assert not page.faults and not page.locator("#scene").count()
    # What says so is read by a browser of ten years ago: words of its language alone.
    text = re.sub(r'"(?:[^"\\]|\\.)*"|//[^\n]*', "", GATE.read_text("utf-8"))
    assert not re.search(r"=>|`|\?\.(?!\d)|\?\?|\.\.\.|\b(let|const|class|async|import)\b", text)


def test_without_a_script_the_results_are_there(live: Opened) -> None:
    page = live("gots-diesel", java_script_enabled=False)
    text = page.inner_text("#plain")
    assert "113,5" in text
    about = page.get_attribute("[property='og:description']", "content")
    assert "113,5 Н·м" in about and "кВт" in about  # what its link says
    assert "Числа сборки" in text or "числа сборки" in text


def test_what_is_taken_home_is_the_changed_engine(live: Opened, tmp_path: Path) -> None:
    page = live("gots-diesel")
    page.evaluate("kshm.set('geometry.bore_mm', 91.25)")
    page.evaluate("kshm.set('calculation.method', 'exact')")
    raw = to_mapping(sample("gots-diesel"))
    raw["geometry"]["bore_mm"], raw["calculation"]["method"] = 91.25, "exact"
    wanted = load_mapping(raw, source="").model
    assert load_mapping(tomllib.loads(page.evaluate("live.toml()")), source="").model == wanted
    for button, name in (("#save", "правка.toml"), ("#book", "правка.xlsx"), ("#card", ".png")):
        with page.expect_download() as coming:
            page.click(button)
        assert coming.value.suggested_filename.endswith(name)
        coming.value.save_as(tmp_path / f"taken{Path(name).suffix}")
    assert load_workbook_input(tmp_path / "taken.xlsx").model == wanted
    assert not page.faults


@pytest.mark.libreoffice
def test_libreoffice_finds_the_page_s_numbers_in_the_book_that_it_gave(
    live: Opened, libreoffice: LibreOffice, tmp_path: Path
) -> None:
    page, short = live("gots-diesel"), short_model(model_of("gots-diesel"))
    page.evaluate("kshm.set('geometry.bore_mm', 91.25)")
    page.evaluate("kshm.set('regime.speed_rpm', 4000)")
    with page.expect_download() as coming:
        page.click("#book")
    coming.value.save_as(tmp_path / "taken.xlsx")
    (book,) = libreoffice.recalculate([(tmp_path / "taken.xlsx").read_bytes()])
    layout = Layout.of(short)
    keys = page.evaluate(MOVING, list(short.scalars))
    cells = [layout.cells[key] for key in keys]
    theirs = [book[cell.sheet][cell.coordinate] for cell in cells]
    ours = page.evaluate(GET, keys)
    far = [key for key, own, value in zip(keys, ours, theirs, strict=True)
           if distance(own, value) > 1e-9]  # fmt: skip
    assert len(keys) > 300
    assert far == []
