"""Drawings of the input page: current, readable, with everything they explain."""

from pathlib import Path

import pytest
from lxml import etree

from tests.manual.pages import DOCS
from tools.manual.drawings import DRAWINGS, write_drawings


@pytest.mark.parametrize("name", DRAWINGS)
def test_the_drawing_is_current_and_a_picture(name):
    text = (DOCS / "images" / name).read_text(encoding="utf-8")
    assert text == DRAWINGS[name](), "./run docs обновит"
    root = etree.fromstring(text.encode())
    width, height = (float(root.get(side)) for side in ("width", "height"))
    for item in root.iterfind(".//{*}text"):
        assert 0 <= float(item.get("x")) <= width
        assert 0 <= float(item.get("y")) <= height
    assert f"images/{name}" in (DOCS / "input.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("arms.svg", ("l₁", "l₂", "l₅", "l₆", "щека 1")),
        ("arms-v.svg", ("l₁", "l₂", "l₃", "l₄", "l₅", "l₆")),
        ("signs.svg", ("φ", "β", "γ", "вращение", "противовес")),
        ("phases.svg", ("θ = 540°", "γ = 180°")),
    ],
)
def test_the_drawing_shows_what_it_explains(name, words):
    text = DRAWINGS[name]()
    for word in words:
        assert word in text, word


def test_only_what_changed_is_written(tmp_path: Path):
    assert len(write_drawings(tmp_path)) == len(DRAWINGS)
    assert write_drawings(tmp_path) == []
