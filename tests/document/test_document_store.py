"""The store of formulas and figures: keeps, tells contents apart, never stands in the way."""

import sqlite3
from functools import partial

import pytest

from reports.document import store
from reports.document.text import mathsvg


@pytest.fixture
def own(tmp_path, monkeypatch):
    monkeypatch.setenv("KSHM_CACHE", str(tmp_path))
    store.store.cache_clear()
    mathsvg.formula.cache_clear()
    yield tmp_path
    store.store.cache_clear()
    mathsvg.formula.cache_clear()


def anew() -> None:
    """As a new process: nothing remembered but the file."""
    store.store().save()
    store.store.cache_clear()
    mathsvg.formula.cache_clear()


def test_a_formula_is_set_once(own, monkeypatch):
    first = mathsvg.formula(r"\dfrac{a}{b}")
    anew()
    monkeypatch.setattr(mathsvg, "_parse", None)  # would fail if asked
    assert mathsvg.formula(r"\dfrac{a}{b}") == first
    with pytest.raises(TypeError):
        mathsvg.formula(r"\dfrac{a}{c}")


def test_a_wrong_formula_is_not_kept(own):
    for _ in range(2):
        with pytest.raises(mathsvg.FormulaError):
            mathsvg.formula(r"\dfrac{a}{")
        anew()


def picture(size: float) -> str:
    drawn.append(size)
    return f"<svg>{size}</svg>"


drawn: list[float] = []


def test_a_changed_figure_is_drawn_anew(own):
    drawn.clear()
    for size in (1.0, 1.0, 2.0, 1.0):
        made = store.kept("figure", str(size).encode(), partial(picture, size))
        assert made == f"<svg>{size}</svg>"
        anew()
    assert drawn == [1.0, 2.0]


def test_other_code_gives_another_key(own, monkeypatch):
    before = store.key("figure", b"x")
    assert store.key("formula", b"x") != before
    monkeypatch.setattr(store, "_code", lambda: b"other")
    assert store.key("figure", b"x") != before


@pytest.mark.parametrize("content", [b"", b"no database", b"SQLite format 3\0" + b"\0" * 200])
def test_a_broken_file_does_no_harm(own, content):
    (own / "document.sqlite").write_bytes(content)
    assert "svg" in mathsvg.formula("a+b").svg
    anew()
    assert "svg" in mathsvg.formula("a+b").svg


def test_a_broken_entry_is_made_anew(own):
    good = mathsvg.formula("a+b")
    anew()
    with sqlite3.connect(own / "document.sqlite") as base:
        base.execute("UPDATE texts SET text = x'00'")
    assert mathsvg.formula("a+b") == good


def test_a_locked_file_and_a_folder_that_cannot_be_made_do_no_harm(own, monkeypatch):
    monkeypatch.setattr(store, "_WAIT", 0.01)
    mathsvg.formula("a-b")
    anew()
    with sqlite3.connect(own / "document.sqlite", isolation_level=None) as base:
        base.execute("BEGIN EXCLUSIVE")
        assert "svg" in mathsvg.formula("a-b").svg
        anew()
        base.execute("ROLLBACK")
    (own / "file").write_text("x")
    monkeypatch.setenv("KSHM_CACHE", str(own / "file" / "below"))
    anew()
    assert "svg" in mathsvg.formula("a-b").svg


def test_it_can_be_turned_off(own, monkeypatch):
    monkeypatch.setenv("KSHM_CACHE", "")
    anew()
    mathsvg.formula("x")
    anew()
    assert store.store().get(store.key("formula", b"x")) is None
