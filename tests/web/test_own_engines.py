"""Own engines in the browser: none is lost to a link, another tab, F5 or a file that is opened."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from tests.web.conftest import Served, opened, until

BORE = "[id='f-geometry.bore_mm']"
STORED = """Object.keys(localStorage).filter(key => key.startsWith("kshm:"))
    .map(key => JSON.parse(localStorage[key]).raw.geometry.bore_mm).sort()"""


@pytest.fixture
def first(browser: Any, served: Served) -> Iterator[Any]:
    """A tab of a person who has an own engine of 91,5 mm."""
    page = opened(browser, served.page)
    ready(page)
    bore(page, "91,5")
    yield page
    assert not page.faults
    page.context.close()


def ready(page: Any) -> None:
    until(page, "Boolean(window.live?.state.last) && live.isIdle()")


def bore(page: Any, text: str) -> None:
    page.evaluate("document.querySelector('[data-key=geometry]').open = true")
    page.fill(BORE, text)
    until(page, f"live.state.raw.geometry.bore_mm === {text.replace(',', '.')} && live.isIdle()")


def another(page: Any, address: str) -> Any:
    """A second tab of the same browser."""
    output = page.context.new_page()
    output.goto(address)
    ready(output)
    return output


def link_of(page: Any) -> str:
    page.click("#link")
    until(page, "location.hash.length > 100")
    return str(page.url)


def friends(browser: Any, served: Served, text: str = "85") -> str:
    """The link of a friend with another engine."""
    page = opened(browser, served.page)
    ready(page)
    bore(page, text)
    actual = link_of(page)
    page.context.close()
    return actual


def test_an_engine_is_there_after_f5_and_only_what_was_changed_is_listed(first: Any) -> None:
    assert first.evaluate(STORED) == [91.5]
    assert first.locator("select#own option").count() == 1
    first.reload()
    ready(first)
    assert first.evaluate("live.state.raw.geometry.bore_mm") == 91.5


def test_a_friends_link_opens_beside_the_own_engine(
    browser: Any, served: Served, first: Any
) -> None:
    address = friends(browser, served)
    second = another(first, address)
    assert second.evaluate("live.state.raw.geometry.bore_mm") == 85
    assert "#" not in second.url  # read once
    first.reload()
    ready(first)
    assert first.evaluate("live.state.raw.geometry.bore_mm") == 91.5
    assert first.evaluate(STORED) == [85, 91.5]
    bore(second, "86")
    second.reload()
    ready(second)
    assert second.evaluate("live.state.raw.geometry.bore_mm") == 86
    assert first.evaluate(STORED) == [86, 91.5]
    again = another(first, address)  # it has been changed since: the link is an engine of its own
    assert again.evaluate(STORED) == [85, 86, 91.5]
    third = another(first, served.page)  # comes back to what was made, not to what was looked at
    assert third.evaluate("live.state.raw.geometry.bore_mm") == 86
    assert third.locator("select#own option").count() == 3


def test_a_link_in_the_address_of_the_same_tab_opens_beside(
    browser: Any, served: Served, first: Any
) -> None:
    address = friends(browser, served, "84")
    first.evaluate("hash => { location.hash = hash; }", address.partition("#")[2])
    until(first, "live.state.raw.geometry.bore_mm === 84 && live.isIdle()")
    assert first.evaluate(STORED) == [84, 91.5]
    assert "#" not in first.url


def test_f5_after_the_link_keeps_what_was_changed_since(first: Any) -> None:
    link_of(first)
    first.reload()  # nothing was changed: nothing is doubled
    ready(first)
    assert first.evaluate(STORED) == [91.5]
    link_of(first)
    bore(first, "92")
    assert "#" not in first.url
    first.reload()
    ready(first)
    assert first.evaluate("live.state.raw.geometry.bore_mm") == 92
    assert first.evaluate(STORED) == [92]


def test_two_tabs_with_one_engine_keep_both(served: Served, first: Any) -> None:
    second = another(first, served.page)
    assert second.evaluate("live.state.raw.geometry.bore_mm") == 91.5
    bore(second, "93")
    bore(first, "94")
    assert first.evaluate(STORED) == [93, 94]
    assert "записан рядом" in first.inner_text("#news")
    options = first.locator("select#own option").all_inner_texts()  # of one name
    assert sorted("диаметр цилиндра 93" in text for text in options) == [False, True]
    assert sorted("диаметр цилиндра 94" in text for text in options) == [False, True]


def test_a_sample_or_a_file_does_not_take_the_own_engines_place(first: Any) -> None:
    first.evaluate("fresh(ask('api/new', {sample: 'yamz-236'}))")
    until(first, "live.state.raw.geometry.bore_mm === 130 && live.isIdle()")
    assert first.evaluate(STORED) == [130, 91.5] or first.evaluate(STORED) == [91.5, 130]
    first.click("#undo")
    until(first, "live.state.raw.geometry.bore_mm === 91.5 && live.isIdle()")
    bore(first, "90")
    assert sorted(first.evaluate(STORED)) == [90, 130]
    first.select_option("select#own", index=1)
    until(first, "live.state.raw.geometry.bore_mm === 130 && live.isIdle()")
    assert first.is_disabled("#undo")  # its steps are those of another engine


def test_an_engine_goes_only_when_asked(first: Any) -> None:
    first.on("dialog", lambda dialog: dialog.dismiss())
    first.click("#away")
    assert first.evaluate(STORED) == [91.5]
    first.evaluate("window.confirm = () => true")
    first.click("#away")
    until(first, "live.state.raw.geometry.bore_mm === 88 && live.isIdle()")
    assert first.evaluate(STORED) == []


@pytest.mark.parametrize("hash_", ["broken", "%E0%A4%A"])
def test_a_damaged_link_is_told_and_nothing_is_lost(first: Any, hash_: str) -> None:
    first.evaluate("hash => { location.hash = hash; }", hash_)
    until(first, "live.state.news.includes('ссылка повреждена')")
    assert first.evaluate("live.state.raw.geometry.bore_mm") == 91.5
    assert first.evaluate(STORED) == [91.5]


def test_a_full_store_is_told(first: Any) -> None:
    first.evaluate("""() => {
        let size = 2 ** 22;
        for (let i = 0; size > 1; i++)
            try { localStorage[`full${i}`] = "x".repeat(size); } catch { size /= 2; }
    }""")
    first.click("#keep")  # a second engine beside it: twice as much
    until(first, "Boolean(live.state.other) && live.isIdle()")
    assert "не сохранил" in first.inner_text("#news")
