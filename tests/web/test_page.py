"""The page as friends see it, on a screen and on a phone: motion, charts, layout, forms, files."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from kshm import solve
from reports.inputs.load import load_mapping
from reports.inputs.template import list_samples
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.russian import fixed
from tests.live.node import distance
from tests.web import axe
from tests.web.conftest import Served, opened, photo, until

BORE = "[id='f-geometry.bore_mm']"
CHART = "Chart.getChart(document.querySelector('#chart-fig46 canvas'))"
CP1251 = "# Двигатель\n[engine]\nname = 'Д'\n".encode("cp1251")


@pytest.fixture(scope="module", params=[1366, 390])
def page(browser: Any, served: Served, request: pytest.FixtureRequest) -> Iterator[Any]:
    actual = opened(browser, served.page, request.param)
    actual.wait_for_selector("#checks table")
    yield actual
    assert not actual.faults
    actual.context.close()


@pytest.fixture(autouse=True)
def textbook(page: Any) -> Iterator[None]:
    yield
    if page.evaluate("live.state.isPlaying"):
        page.click("#play")
    page.evaluate("fresh(ask('api/new', {sample: 'gots-diesel'}))")
    settle(page)
    page.evaluate("scrollTo(0, 0)")


def settle(page: Any) -> None:
    page.wait_for_timeout(50)
    until(page, "live.isIdle() && live.state.last && !live.state.wrong.length")


def settled(page: Any) -> None:
    """Wait for what the server says of a value once a person pauses."""
    page.wait_for_timeout(50)
    until(page, "live.isIdle()")


def is_phone(page: Any) -> bool:
    return bool(page.viewport_size["width"] < 500)


# --- motion ---


def test_the_mechanism_is_the_first_thing_and_stays_above_or_beside_the_fields(page: Any) -> None:
    box = page.locator("#mechanism").bounding_box()
    assert box["y"] >= 0 and box["y"] + box["height"] < 620
    until(
        page,
        """performance.getEntriesByType("resource")
        .some(each => each.name.endsWith("chart.umd.min.js"))""",
    )
    loaded = page.evaluate("""Object.fromEntries(performance.getEntriesByType("resource")
        .map(each => [each.name.split("/").pop(), each.startTime]).reverse())""")
    assert loaded["chart.umd.min.js"] > loaded["start"]  # charts come behind the mechanism
    assert ("hammer.min.js" in loaded) == is_phone(page)
    page.locator("[data-key=geometry] summary").scroll_into_view_if_needed()
    page.locator("[data-key=masses] summary").evaluate("e => e.scrollIntoView({block: 'center'})")
    stage, field = (page.locator(each).bounding_box()
                    for each in ("#stage", "[data-key=masses] summary"))  # fmt: skip
    assert stage["y"] >= 0 and stage["y"] + stage["height"] < 640
    beside = field["x"] + field["width"] <= stage["x"]
    assert beside or field["y"] >= stage["y"] + stage["height"]
    assert beside != is_phone(page)


@pytest.mark.parametrize(("sample", "cylinders"), [("yamz-238", 8), ("vw-1600", 4)])
def test_all_cylinders_are_seen_at_once(page: Any, sample: str, cylinders: int) -> None:
    page.evaluate("name => fresh(ask('api/new', {sample: name}))", sample)
    until(page, f"live.state.last.moves.each.length === {cylinders} && live.isIdle()")
    assert page.locator("#strip button").count() == cylinders
    for where in ("#mechanism", "#strip")[: 1 if is_phone(page) else 2]:
        assert page.locator(f"{where} .piston").count() == cylinders
        assert page.locator(f"{where} .piston").first.bounding_box()["width"] > 12
    places = """() => [...document.querySelectorAll("#mechanism .rod")]
        .map(e => e.getAttribute("points"))"""
    page.evaluate("turn(30)")
    before = page.evaluate(places)
    page.evaluate("turn(50)")
    assert all(a != b for a, b in zip(before, page.evaluate(places), strict=True))
    if not is_phone(page):
        photo(page, f"motion-{sample}")


def test_time_moves_it_and_what_does_not_change_is_kept(page: Any) -> None:
    page.wait_for_timeout(1500)  # the checks come later
    page.evaluate("""() => {
        window.touched = 0;
        const watch = new MutationObserver(all => { touched += all.length; });
        for (const id of ["inputs", "files", "tables"])
            watch.observe(document.getElementById(id),
                {subtree: true, childList: true, attributes: true, characterData: true});
        document.getElementById("pace").value = -0.5;
        document.getElementById("pace").dispatchEvent(new Event("input"));
        window.touched = 0;
    }""")
    page.click("#play")
    page.evaluate("touched = 0")
    now = "[performance.now(), live.state.phi]"
    (began, first), _ = page.evaluate(now), page.wait_for_timeout(1500)
    ended, last = page.evaluate(now)
    assert page.evaluate("touched") == 0
    page.click("#play")
    turned = (last - first) % 720
    assert turned == pytest.approx(180 * 10**-0.5 * (ended - began) / 1000, rel=0.2)
    page.evaluate("live.state.pace = 1")


# --- charts ---


def test_a_chart_is_drawn_over_to_set_the_angle(page: Any) -> None:
    plot = page.locator("#chart-fig46 .plot")
    plot.evaluate("e => e.scrollIntoView({block: 'center'})")
    box = plot.bounding_box()
    page.mouse.move(box["x"] + box["width"] * 0.4, box["y"] + 50)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.7, box["y"] + 60, steps=3)
    page.mouse.up()
    phi = page.evaluate("live.state.phi")
    assert 360 < phi < 600
    assert page.inner_text("#angle") == f"{round(phi)}°"
    lines = page.evaluate("""() => [...document.querySelectorAll("#charts .cursor")].map(e => {
        const {scales} = Chart.getChart(e.parentElement.querySelector("canvas"));
        return scales.x.getValueForPixel(new DOMMatrix(getComputedStyle(e).transform).e);
    })""")
    assert len(lines) > 2


def spread_fingers(page: Any, x: float, y: float) -> None:
    touch = page.context.new_cdp_session(page)
    for half in (20, 25, 30, 40, 50, 60, 0):
        points = [{"x": x - half, "y": y}, {"x": x + half, "y": y}] if half else []
        kind = {20: "touchStart", 0: "touchEnd"}.get(half, "touchMove")
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        page.wait_for_timeout(60)


def test_wheel_and_fingers_zoom_and_the_legend_switches_curves(page: Any) -> None:
    plot = page.locator("#chart-fig46 .plot")
    plot.evaluate("e => e.scrollIntoView({block: 'center'})")
    box, span = plot.bounding_box(), f"{CHART}.scales.x.max - {CHART}.scales.x.min"
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.wait_for_selector("#chart-fig46 .tip sub")  # symbols with their subscripts
    assert page.locator("#chart-fig46 figcaption sub").all_inner_texts() == ["г", "j", "s"]
    page.keyboard.down("Control")
    page.mouse.wheel(0, -400)
    page.keyboard.up("Control")
    until(page, f"{span} < 700")
    page.click("#chart-fig46 .whole")
    until(page, f"{span} === 720")
    if is_phone(page):
        for _ in range(5):  # a busy machine drops movements: a person spreads the fingers again
            box = plot.bounding_box()  # a tap may have moved the page
            spread_fingers(page, x, box["y"] + box["height"] / 2)
            if page.evaluate(f"{span} < 600"):
                break
        until(page, f"{span} < 600")
        page.click("#chart-fig46 .whole")
    page.click("#chart-fig46 .legend button >> nth=1")
    assert not page.evaluate(f"{CHART}.isDatasetVisible(1)")
    assert page.get_attribute("#chart-fig46 .legend button >> nth=1", "aria-pressed") == "false"
    page.click("#chart-fig46 .legend button >> nth=1")
    assert page.evaluate(f"{CHART}.isDatasetVisible(1)")
    page.click("#chart-fig46 [title='на весь экран']")
    until(page, "document.fullscreenElement?.id === 'chart-fig46'")
    page.evaluate("document.exitFullscreen()")
    until(page, "!document.fullscreenElement")


def test_sheets_are_named_in_words_and_a_vector_stands_before_and_after(page: Any) -> None:
    names = page.locator("#sheet option").all_inner_texts()
    assert "Набегающие моменты на коренные шейки" in names and "П4.4" not in names
    assert page.locator("#sheet optgroup").count() > 4
    page.select_option("#sheet", "Уравновешивание")
    page.wait_for_selector("#chart-balance_L_vector canvas")
    legend = page.locator("#chart-balance_L_vector .legend span").all_inner_texts()
    assert legend == ["до", "после"]
    page.select_option("#sheet", "П4.1")
    page.wait_for_selector("#chart-fig46 canvas")


# --- layout, samples, task ---


def test_another_layout_is_one_tap_without_a_fault(page: Any) -> None:
    before = page.evaluate("JSON.stringify(live.state.raw)")
    steps = page.evaluate("live.state.past.length")
    for shape, layout, count in (("V8", "v", 8), ("О4", "opposed", 4), ("Р6", "inline", 6)):
        page.click(f"[data-shape={shape}]")
        until(page, f"live.state.raw.engine.cylinders === {count} && live.isIdle()")
        settle(page)
        assert page.evaluate(
            "[live.state.raw.engine.layout, live.state.errors, live.state.wrong]"
        ) == [
            layout,
            [],
            [],
        ]
        assert page.locator("#strip button").count() == count
    page.click("[data-shape=Р3]")  # nothing is lost on the way back
    until(page, "live.state.raw.engine.cylinders === 3 && live.isIdle()")
    assert page.evaluate("JSON.stringify(live.state.raw)") == before
    for count in (6, 4):
        page.click("#undo")
        until(page, f"live.state.raw.engine.cylinders === {count} && live.isIdle()")
    assert page.evaluate("live.state.past.length") == steps + 2


def test_the_number_of_cylinders_in_its_field_makes_another_shaft_too(page: Any) -> None:
    page.locator("[data-key=engine]").evaluate("group => { group.open = true; }")
    page.select_option("[id='f-engine.cylinders']", "5")
    until(page, "live.state.raw.engine.cylinders === 5 && live.isIdle()")
    settle(page)
    assert page.evaluate("live.state.raw.crankshaft.throw_angles_deg.length") == 5


def test_samples_have_pictures_and_russian_names(page: Any) -> None:
    page.locator("#new").evaluate("details => { details.open = true; }")
    samples = page.locator("#samples button")
    assert samples.count() == len(list_samples())
    assert all(any("а" <= c <= "я" for c in text.lower()) for text in samples.all_inner_texts())
    assert page.locator("#samples svg").count() == samples.count()
    page.click("[data-sample=yamz-236]")
    until(page, "live.state.raw.geometry.bore_mm === 130 && live.isIdle()")


def test_an_engine_from_a_task_sheet(page: Any) -> None:
    page.locator("#new").evaluate("details => { details.open = true; }")
    task = {"power": "60,5", "speed": "2200", "bore": "110", "stroke": "125", "lambda": "0,28",
            "compression": "16"}  # fmt: skip
    for key, text in task.items():
        page.fill(f"#task [name={key}]", text)
    page.get_by_role("button", name="Составить").click()
    until(page, "live.state.raw.geometry.bore_mm === 110 && live.isIdle()")
    assert page.evaluate("live.state.raw.regime.speed_rpm") == 2200
    assert page.evaluate("live.state.errors.length + live.state.wrong.length") == 0
    page.evaluate("document.getElementById('task').reset()")


# --- forms ---


def test_a_number_that_is_being_typed_is_no_error(page: Any) -> None:
    page.locator("[data-key=geometry]").evaluate("group => { group.open = true; }")
    for text, value in (("9", 88), ("90", 90), ("90,", 90), ("90,5", 90.5)):
        page.fill(BORE, text)
        until(page, f"document.querySelectorAll('.error').length === {int(text == '9')}")
        settled(page)
        assert page.evaluate("live.state.raw.geometry.bore_mm") == value


def test_a_wrong_value_is_told_in_words_and_keeps_the_last_picture(page: Any) -> None:
    page.locator("[data-key=geometry]").evaluate("group => { group.open = true; }")
    page.evaluate("turn(100)")
    before = page.inner_html("#mechanism")
    page.fill(BORE, "9999")
    page.wait_for_selector("#errors li")
    assert page.inner_text("#errors").startswith("Диаметр цилиндра: ")
    assert "geometry" not in page.inner_text("body")
    assert page.inner_html("#mechanism") == before
    assert page.is_visible("#stale")
    assert axe.faults(page) == []
    page.emulate_media(color_scheme="light")
    photo(page, "wrong")


def test_what_was_said_of_a_wrong_order_goes_when_a_person_goes_on(page: Any) -> None:
    page.evaluate("fresh(ask('api/new', {cylinders: 5, layout: 'opposed'}))")
    page.wait_for_selector("#errors li")
    box = page.locator("#errors li").first.bounding_box()
    assert 0 <= box["y"] < page.viewport_size["height"]
    page.fill("#find", "ход")
    assert not page.locator("#errors li").count()
    page.fill("#find", "")


def test_without_a_server_typing_moves_all_numbers_as_solve_finds_them(page: Any) -> None:
    """The network goes after loading; the numbers, charts and mechanism do not know of it."""
    page.context.set_offline(True)
    before = page.evaluate("live.state.last.moves.forces.Ps_MPa.values")
    page.fill(BORE, "91")
    page.fill("[id='f-regime.speed_rpm']", "4100")
    until(page, "live.state.raw.regime.speed_rpm === 4100")
    solution = solve(
        *engine_and_cycle(load_mapping(page.evaluate("live.state.raw"), source="").model)
    )
    keys = page.evaluate("""keys => keys.filter(key => kshm.keys().includes(key)
        && !live.isFixed(key))""", [*solution.scalars])  # fmt: skip
    assert len(keys) > 100 and {"M_mean", "M_max"} <= {*keys}
    actual = page.evaluate("keys => keys.map(key => kshm.get(key))", keys)
    far = {key: (value, solution.scalars[key]) for key, value in zip(keys, actual, strict=True)
           if distance(solution.scalars[key], value) > 1e-9}  # fmt: skip
    assert far == {}
    for table, columns in solution.columns.items():
        for column, wanted in columns.items():
            value = page.evaluate("""key => live.state.engine.main.has(key) && !live.isFixed(key)
                && kshm.get(key)""", f"{table}.{column}")  # fmt: skip
            assert value is False or distance(wanted.tolist(), value) < 1e-9, (table, column)
    assert page.inner_text("[data-key=N_e_calc] b") == fixed(
        page.evaluate("kshm.get('N_e_calc')"), 2
    )
    assert page.evaluate("live.state.last.moves.forces.Ps_MPa.values") != before
    drawn = f"{CHART}.data.datasets[0].data[90].y"
    until(page, f"{drawn} === live.state.engine.fine.get('P4_1.Pg_MPa')[90]")
    until(page, "document.getElementById('lost').textContent.includes('Нет связи')")
    assert 0 < page.locator("#lost").bounding_box()["y"] < page.viewport_size["height"]
    page.context.set_offline(False)
    until(page, "!document.getElementById('lost').textContent && !live.state.isChanged")
    page.faults[:] = [fault for fault in page.faults if "ERR_INTERNET" not in fault]


# --- files ---


def test_jobs_are_named_survive_a_reload_and_can_be_cancelled(page: Any) -> None:
    page.click("[data-kind=json]")
    page.wait_for_selector("#jobs a[download$='.json']", timeout=60_000)
    with page.expect_download() as download:
        page.click("#jobs a")
    assert download.value.suggested_filename == "Дизель 3Ч 8,8 9,4 (Гоц, раздел 2.9).json"
    page.reload()
    page.wait_for_selector("#jobs a[download$='.json']", timeout=60_000)
    page.click("[data-kind=pdf]")
    page.get_by_role("button", name="Не делать").click()
    until(page, "document.querySelectorAll('#jobs > li').length === 1")
    page.evaluate("localStorage.removeItem('kshm-jobs')")
    page.evaluate("live.state.jobs.length = 0")


def test_a_file_in_another_encoding_is_refused_in_the_words_of_check(page: Any) -> None:
    page.locator("#new").evaluate("details => { details.open = true; }")
    page.set_input_files("#upload", {"name": "Д.toml", "mimeType": "", "buffer": CP1251})
    page.wait_for_selector("#errors li")
    assert "строка 1: не UTF-8 (возможно, Windows-1251)" in page.inner_text("#errors")
    page.faults[:] = [fault for fault in page.faults if "422" not in fault]


def test_a_picture_and_a_clip_of_the_mechanism(page: Any, tmp_path: Path) -> None:
    with page.expect_download() as download:
        page.click("#picture")
    picture = Path(download.value.path()).read_bytes()
    assert picture.startswith(b"\x89PNG")
    assert max(struct.unpack(">II", picture[16:24])) == 1200
    with page.expect_download(timeout=60_000) as download:
        page.click("#clip")
    assert download.value.suggested_filename.endswith((".webm", ".mp4"))
    assert len(Path(download.value.path()).read_bytes()) > 20_000
