"""A person at the page: Chromium by Playwright, wide and narrow, light and dark."""

from __future__ import annotations

import io
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from openpyxl import load_workbook

from kshm import solve
from kshm.results.solution import Solution
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import engine_and_cycle
from tests.web import axe
from tests.web.conftest import Served, opened, photo, tab_to, until

# What a chart on the page holds: the numbers that are drawn, not what the server sent.
CURVES = """id => Chart.getChart(document.querySelector(`#chart-${id} canvas`)).data.datasets
    .map(d => [d.data.map(p => p.x), d.data.map(p => p.y)])"""


@pytest.fixture(scope="module")
def page(browser: Any, served: Served) -> Any:
    """A wide page with the textbook's engine, for the tests that need no own one."""
    actual = opened(browser, served.page)
    actual.wait_for_selector("#checks table")
    yield actual
    assert not actual.faults
    actual.context.close()


def solved(page: Any) -> Solution:
    return solve(*engine_and_cycle(load_mapping(page.evaluate("live.state.raw"), source="").model))


def settle(page: Any) -> None:
    until(page, "live.isIdle()")


def opened_sheet(page: Any, key: str) -> None:
    """Open the tables of the sheet on which a result stands."""
    page.evaluate("""key => {
        const {engine, open, redraw} = live.state;
        open.add(engine.sheets.find(({blocks}) => blocks.some(({kind, rows}) =>
            kind === "list" && rows.some(row => row.key === key))).title);
        redraw();
    }""", key)  # fmt: skip


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (390, "dark")])
def test_the_page_fits_and_shows_the_solvers_numbers(
    browser: Any, served: Served, width: int, scheme: str
) -> None:
    page = opened(browser, served.page, width, scheme)
    page.wait_for_selector("#chart-fig46 output")
    page.wait_for_selector("#checks table")
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    cut = page.evaluate("""() => [...Array(73).keys()].map(i => 10 * i).filter(phi => {
        turn(phi);
        const {scrollWidth, clientWidth} = document.querySelector("#scene [role=region]");
        return scrollWidth > clientWidth; // a unit beside the mechanism would not be seen
    })""")
    assert cut == []
    opened_sheet(page, "M_mean")
    cut = page.evaluate("""() => [...document.querySelectorAll("#checks [role=region]")]
        .filter(e => e.scrollWidth > e.clientWidth).map(e => e.ariaLabel)""")
    assert cut == []  # nor the units of the results
    if width < 900:  # a finger is wider than a pointer
        heights = """[...document.querySelectorAll("main :is(button, select, [type=search])")]
            .map(e => e.offsetHeight).filter(height => height > 0)"""
        assert min(page.evaluate(heights)) >= 44
    solution = solved(page)
    shown = page.inner_text("tr[data-key=M_mean] td:nth-child(3)")
    assert float(shown.replace(",", ".")) == pytest.approx(solution.scalars["M_mean"], abs=0.06)
    page.evaluate("turn(370)")
    value = page.inner_text("#chart-fig46 output >> nth=0").replace(",", ".").replace("−", "-")
    wanted = dict(zip(solution.columns["P4_1"]["phi_deg"], solution.columns["P4_1"]["Pg_MPa"],
                      strict=True))[370]  # fmt: skip
    assert float(value) == pytest.approx(wanted, rel=1e-4)
    assert axe.faults(page) == []
    assert not page.faults
    photo(page, f"engine-{width}")
    page.context.close()


DRAWN = {
    "П3.1": {"fig41": ("P3_1", ("s_mm",))},
    "П4.1": {"fig46": ("P4_1", ("Pg_MPa", "Pj_MPa", "Ps_MPa")), "fig47": ("P4_1", ("N_MPa",))},
    "П4.2": {"fig49": ("P4_2", ("Msum_Nm",))},
    "П4.3 (2)": {"fig55_2": ("P4_3_2", ("R_MPa",))},
}


def test_what_the_charts_draw_is_what_the_solver_says(page: Any) -> None:
    columns = solved(page).columns
    for sheet, charts in DRAWN.items():
        page.select_option("#sheet", sheet)
        settle(page)
        for chart, (table, keys) in charts.items():
            curves = page.evaluate(CURVES, chart)
            for key in keys:
                wanted, phi = columns[table][key], columns[table]["phi_deg"]
                near = [np.array(y)[np.isin(x, phi)] for x, y in curves if len(y) > len(phi)]
                worst = min(np.max(np.abs(y - wanted)) for y in near)
                assert worst <= 1e-7 * np.max(np.abs(wanted)), (chart, key)
    page.select_option("#sheet", "П4.1")


def test_every_chart_has_room_for_all_that_it_draws(page: Any) -> None:
    for sheet in page.evaluate("[...document.querySelectorAll('#sheet option')].map(e => e.value)"):
        page.select_option("#sheet", sheet)
        settle(page)
        narrow = page.evaluate("""[...document.querySelectorAll("#charts canvas")]
            .map(canvas => Chart.getChart(canvas))
            .flatMap(({scales, data}) => ["x", "y"].filter(key => {
                const values = data.datasets.flatMap(d => d.data.map(p => p[key]));
                const {min, max} = scales[key];
                return values.some(value => value !== null && !(value >= min && value <= max));
            }))""")
        assert narrow == [], sheet
    page.select_option("#sheet", "П4.1")
    settle(page)


def test_charts_are_as_wide_as_their_places_whichever_way_a_window_changes(page: Any) -> None:
    gaps = """[...document.querySelectorAll("#charts canvas")]
        .map(canvas => Math.abs(canvas.clientWidth - canvas.parentElement.clientWidth))"""
    for width in (390, 1280):
        page.set_viewport_size({"width": width, "height": 900})
        until(page, f"{gaps}.every(gap => gap < 2) && {gaps}.length > 1")


def test_every_fields_error_is_shown_at_the_field(page: Any) -> None:
    # All at once, as all errors are told at once: a field that stays silent is found all the same.
    silent = page.evaluate(r"""async () => {
        const ids = [...document.querySelectorAll(":is(#five, #fields) .field input[inputmode]")]
            .map(({id}) => id).filter(id => !/[[](?!1[\]])/.test(id)); // of lists the first entry
        const was = ids.map(id => document.getElementById(id).value);
        const type = async texts => {
            ids.forEach((id, i) => {
                const input = document.getElementById(id);
                input.value = texts[i];
                input.dispatchEvent(new Event("input"));
            });
            do await new Promise(done => setTimeout(done, 300)); while (!live.isIdle());
        };
        await type(ids.map(() => "abc"));
        const silent = ids.filter(id => {
            const error = document.getElementById(id.replace("f-", "e-")).querySelector(".error");
            const input = document.getElementById(id);
            return !error?.textContent || input.getAttribute("aria-invalid") !== "true";
        });
        await type(was);
        return [ids.length, silent];
    }""")
    assert silent[0] > 60 and silent[1] == []
    assert not page.locator(".error").count()


def test_entries_of_lists_come_and_go(page: Any) -> None:
    page.evaluate("fresh(ask('api/new', {sample: 'mwm-6'}))")
    until(page, "live.state.raw.torsion?.masses?.length > 3")
    for key in ("torsion.masses", "crankshaft.webs", "gas.points"):
        section, name = key.split(".")
        size = f"live.state.raw.{section}.{name}.length"
        before = page.evaluate(size)
        group = page.locator(f"details[data-key='{key}']")
        group.evaluate("group => { group.open = true; }")
        group.get_by_role("button", name="Добавить").click()
        until(page, f"{size} === {before + 1} && live.isIdle()")
        fields = page.locator(f"[id^='f-{key}[{before + 1}]']")
        assert fields.count() >= 2 and fields.first.is_visible()
        group.get_by_role("button", name=f"Убрать {before + 1}", exact=True).click()
        until(page, f"{size} === {before} && live.isIdle()")
    assert not page.locator(".error").count()
    page.click("#undo")
    until(page, f"{size} === {before + 1} && live.isIdle()")
    # A whole section, and a further regime, go and come alike.
    page.locator("details[data-key=torsion]").evaluate("group => { group.open = true; }")
    page.locator("details[data-key=torsion]").get_by_role("button", name="Убрать раздел").click()
    until(page, "!live.state.raw.torsion && live.isIdle()")
    page.get_by_role("button", name="Ещё один режим").click()
    until(page, "live.state.raw.regimes?.length === 1 && live.isIdle()")
    page.fill("[id='f-regimes[1].speed_rpm']", "777")
    until(page, "live.state.raw.regimes[0].speed_rpm === 777 && live.isIdle()")
    page.evaluate("fresh(ask('api/new', {sample: 'gots-diesel'}))")
    until(page, "!live.state.raw.regimes?.length && live.isIdle()")


def test_two_engines_over_each_other_and_another_cylinder(page: Any) -> None:
    opened_sheet(page, "M_mean")
    curves = len(page.evaluate(CURVES, "fig46"))
    mean = page.inner_text("tr[data-key=M_mean] td:nth-child(3)")
    page.click("#keep")
    page.fill("[id='f-geometry.bore_mm']", "95,5")
    until(page, "live.state.raw.geometry.bore_mm === 95.5 && live.isIdle()")
    assert len(page.evaluate(CURVES, "fig46")) == 2 * curves
    assert "диаметр цилиндра 88" in page.inner_text("#other")  # the names are the same
    both = [page.inner_text(f"tr[data-key=M_mean] td:nth-child({i})") for i in (3, 4)]
    assert both[1] == mean != both[0]
    page.click("#drop")
    page.click("#undo")
    until(page, "live.state.raw.geometry.bore_mm === 88 && live.isIdle()")
    first = page.inner_html("#mechanism")
    page.click("#strip button >> nth=2")
    settle(page)
    assert page.inner_html("#mechanism") != first
    wanted = solved(page).columns["cylinder_3"]["Ps_MPa"]
    shown = page.evaluate("live.state.last.moves.forces.Ps_MPa.values")[::10]
    np.testing.assert_allclose(shown, wanted, atol=1e-6)
    page.click("#strip button >> nth=0")


def test_what_is_wrong_with_a_new_engine_is_seen_on_a_phone(page: Any) -> None:
    wide = page.viewport_size
    page.set_viewport_size({"width": 390, "height": 600})
    page.evaluate("scrollTo(0, 0)")
    page.evaluate("fresh(ask('api/new', {cylinders: 5, layout: 'opposed'}))")
    box = page.locator("#errors").bounding_box()
    page.set_viewport_size(wide)
    page.evaluate("live.state.errors.length = 0")
    page.evaluate("turn(0)")
    assert 0 <= box["y"] < box["y"] + box["height"] < 556  # the bar of the parts stands below


def test_the_names_of_the_forces_stand_within_the_picture(page: Any) -> None:
    """At any angle, and upwards too, as inertia pulls the piston of a fast engine."""
    cut = page.evaluate("""async () => {
        const {last} = live.state, {forces} = last.moves, {Ps_MPa: {values: held}} = forces;
        const most = Math.max(...Object.values(forces).flatMap(f => f.values.map(Math.abs)));
        const cut = [];
        for (const sign of [1, -1]) {
            const pull = {...forces.Ps_MPa, values: held.map(() => sign * most)};
            live.state.last = {...last, moves: {...last.moves, forces: {...forces, Ps_MPa: pull}}};
            live.state.redraw();
            for (let phi = 0; phi < 360; phi += 30) {
                turn(phi);
                await new Promise(requestAnimationFrame);
                const frame = document.querySelector("#mechanism").getBoundingClientRect();
                for (const name of document.querySelectorAll("#mechanism text")) {
                    const box = name.getBoundingClientRect();
                    if (box.height && (box.top < frame.top || box.bottom > frame.bottom))
                        cut.push([phi, name.textContent]);
                }
            }
        }
        live.state.last = last;
        live.state.redraw();
        turn(0);
        return cut;
    }""")
    assert cut == []


def typed(page: Any, text: str) -> None:
    page.keyboard.press("Control+A")
    page.keyboard.type(text)


def taken(page: Any, *kinds: str) -> list[bytes]:
    """Files ordered one after another and downloaded, the last one first, by the keyboard."""
    for count, kind in enumerate(kinds, page.locator("#jobs li").count() + 1):
        tab_to(page, f"[data-kind={kind}]")
        page.keyboard.press("Enter")
        until(page, f"document.querySelectorAll('#jobs li').length === {count}")
    collected = []
    for index, kind in enumerate(reversed(kinds), 1):
        link = f"#jobs li:nth-child({index}) a[href$='engine.{kind}']"
        page.wait_for_selector(link, timeout=120_000)
        tab_to(page, link)
        with page.expect_download() as download:
            page.keyboard.press("Enter")
        collected.append(Path(download.value.path()).read_bytes())
    return collected


def test_an_own_engine_by_the_keyboard_alone_to_workbook_and_pdf(
    browser: Any, served: Served, tmp_path: Path
) -> None:
    page = opened(browser, served.page, 800)  # narrow: all groups are closed at first
    page.wait_for_selector("#chart-fig46 output")
    tab_to(page, ".skip")
    tab_to(page, "#new summary")
    page.keyboard.press("Enter")
    tab_to(page, "#cylinders")
    typed(page, "5")
    page.evaluate("turn(10)")  # what is typed stays, whatever is drawn anew
    assert page.input_value("#cylinders") == "5"
    typed(page, "4")
    page.keyboard.press("Enter")  # the form's own button
    until(
        page,
        "live.state.raw?.engine.cylinders === 4 && "
        "live.state.last?.moves.throws.flatMap(([, numbers]) => numbers).length === 4",
    )
    page.evaluate("document.activeElement.blur()")
    tab_to(page, "[id='f-geometry.bore_mm']")
    typed(page, "9999")
    page.wait_for_selector("[data-key='geometry.bore_mm'] .error")
    assert "1500" in page.inner_text("[data-key='geometry.bore_mm'] .error")
    typed(page, "84,5")
    until(page, "!document.querySelector('.error') && live.state.raw.geometry.bore_mm === 84.5")
    tab_to(page, "[data-key='geometry.bore_mm'] [type=range]")
    page.keyboard.press("ArrowRight")
    until(page, "live.state.raw.geometry.bore_mm > 84.5 && live.isIdle()")
    tab_to(page, "[data-key=report] summary")
    page.keyboard.press("Enter")
    tab_to(page, "[data-key='report.chapters'] summary")
    page.keyboard.press("Enter")
    tab_to(page, "[data-key='report.chapters'] button")
    page.keyboard.press("Enter")
    until(page, "live.state.raw.report.chapters?.length === 1 && live.isIdle()")
    page.keyboard.press("Shift+Tab")
    chapter = "live.state.raw.report.chapters[0]"  # one: the less to wait for
    while (first := page.evaluate(chapter)) != "kinematics":
        page.keyboard.press("ArrowDown")
        until(page, f"{chapter} !== '{first}' && live.isIdle()")
    pdf, book = taken(page, "xlsx", "pdf")
    assert pdf.startswith(b"%PDF")

    # The workbook is edited elsewhere, comes back, and makes another report.
    edited = load_workbook(io.BytesIO(book))
    ((sheet, cell),) = edited.defined_names["geometry_bore_mm"].destinations
    edited[sheet][cell.replace("$", "")].value = 91.25
    edited.save(tmp_path / "edited.xlsx")
    page.evaluate("scrollTo(0, 0); document.activeElement.blur()")
    tab_to(page, "#new summary")
    page.keyboard.press("Enter")
    tab_to(page, "#upload")  # its dialog is the browser's own
    page.set_input_files("#upload", tmp_path / "edited.xlsx")
    until(page, "live.state.raw.geometry.bore_mm === 91.25 && live.isIdle()")
    assert "91,25" in taken(page, "html")[0].decode()
    tab_to(page, "#undo")
    page.keyboard.press("Enter")
    until(page, "live.state.raw.geometry.bore_mm < 90 && live.isIdle()")
    assert not page.faults
    page.context.close()


def test_every_control_has_a_name(page: Any) -> None:
    nameless = page.evaluate("""[...document.querySelectorAll('input,select,button,a,[role=img]')]
        .filter(e => !(e.getAttribute('aria-label') || e.labels?.length || e.textContent.trim()))
        .map(e => e.outerHTML.slice(0, 100))""")
    assert nameless == []
    ids = page.evaluate("[...document.querySelectorAll('[id]')].map(e => e.id)")
    assert len(ids) == len(set(ids))
    assert not re.search(r"undefined|NaN|\[object", page.inner_text("body"))
