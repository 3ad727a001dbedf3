"""The sheet as norm control reads it: lettering, scales, the box in the corner, polar diagrams."""

from __future__ import annotations

import re

import pytest

from reports.draw.canvas import Line, Words
from reports.draw.fonts import HEIGHTS, glyphs, is_drawn, strokes_of, width_of
from reports.draw.writers import svg_of
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.sheet.write import designation, sheet_items
from tests.conftest import sample
from tests.sheet.sheet_samples import drawn, terms, terms_of

RUSSIAN = "абвгдеёжзийклмнопрстуфхцчшщъыьэюя"
NAMES = ["gots-diesel", "yamz-236", "two-stroke"]


def test_every_letter_of_russian_and_of_symbols_is_drawn():
    assert is_drawn("ӘәҒғҚқҢңӨөҰұҮүҺһІі")  # of Kazakh names
    assert is_drawn(RUSSIAN + RUSSIAN.upper() + "αβγθλμνπρφψωΔΣ0123456789.,;:()°′×·±−–—«»№Ø%/")
    assert len(glyphs()) > 600


def test_letters_are_as_high_as_they_say_and_lean():
    (stem,) = [s for s in strokes_of("І", 10.0) if len(s) == 2]
    (x1, y1), (x2, y2) = sorted(stem, key=lambda point: point[1])
    assert y2 - y1 == pytest.approx(9.0) and x2 > x1  # the line itself is one more high
    assert width_of("Щ", 5.0) > width_of("г", 5.0) > 0


@pytest.mark.parametrize("name", NAMES)
def test_all_heights_of_the_sheet_are_of_the_standard(name):
    canvas, _, _ = drawn(terms(name))
    assert {w.height for w in canvas.items if isinstance(w, Words)} <= set(HEIGHTS)
    assert HEIGHTS == (1.8, 2.5, 3.5, 5.0, 7.0, 10.0, 14.0, 20.0, 28.0, 40.0)
    box = (0.0, 0.0, 841.0, 594.0)
    assert seen_letters(canvas.items, box) == []
    assert seen_letters([Words((9.0, 9.0), "漢", 3.5)], box)  # in the face that has it


def seen_letters(items, box):
    """Letters that are seen as such: those of the standard are strokes under unseen ones."""
    return re.findall(r'<text(?![^>]*fill-opacity="0")', svg_of(items, box))


@pytest.mark.parametrize("name", NAMES)
def test_scales_are_of_the_series_and_have_units(name):
    canvas, _, _ = drawn(terms(name))
    texts = [w.text for w in canvas.items if isinstance(w, Words)]
    assert not [t for t in texts if re.search(r"М \d[\d,]*(?![\d,]* [^ ]+/мм|[\d,]*:)", t)]
    texts = [text for text in texts if "/мм" in text]
    scales = [s for t in texts for s in re.findall(r"(?:М|горизонтали) ([\d,]+) [^ ]+/мм", t)]
    assert len(scales) >= 10
    for scale in scales:
        digits = scale.replace(",", "").strip("0")
        assert digits in ("1", "2", "25", "4", "5"), scale


def test_a_polar_diagram_takes_two_cells():
    """30 × 60 mm it was, and its labels lay on one another."""
    canvas, _, _ = drawn(terms("gots-diesel"))
    curve = next(i for i in canvas.items if isinstance(i, Line) and i.name.startswith("fig50"))
    left, low, right, high = curve.box
    assert right - left > 40 and high - low > 100


def test_the_designation_is_the_drawings_own_and_stands_in_the_corner():
    raw = to_mapping(sample("gots-diesel"))
    raw["report"]["designation"] = "КП.01.00.000 ПЗ"
    model = load_mapping(raw, source="d").model
    assert designation(model.report) == "КП.01.00.000 Д"
    canvas, _, height = sheet_items(terms_of(model))
    words = [w for w in canvas.items if isinstance(w, Words) and w.text == "КП.01.00.000 Д"]
    (corner,) = [w for w in words if w.angle == 180.0]
    assert len(words) == 2 and corner.place[1] > height - 20 and corner.place[0] < 90
    assert not [w for w in canvas.items if isinstance(w, Words) and w.text.endswith("ПЗ")]


def test_what_the_note_calculates_fills_the_lower_left_of_the_sheet():
    """A sheet of an engine with these chapters had an empty cell there."""
    raw = to_mapping(sample("yamz-236"))
    raw |= {"strength": {"kind": "diesel"}, "torsion": {}, "counterweight": {}, "flywheel": {}}
    canvas, _, _ = sheet_items(terms_of(load_mapping(raw, source="v").model))
    words = [w for w in canvas.items if isinstance(w, Words)]
    titles = " ".join(w.text for w in words)
    assert "Прочность деталей" in titles and "Маховик: " in titles and "кручения вала" in titles
    assert any(w.place[0] < 180 and w.place[1] < 120 for w in words)


def test_a_diesel_of_the_cycle_has_the_branch_of_its_governor():
    model = load_mapping(to_mapping(sample("cycle-turbo-diesel")), source="c").model
    canvas, _, _ = sheet_items(terms_of(model))
    named = {i.name for i in canvas.items if isinstance(i, Line)}
    assert {"speed_Me:speed.speed_Me", "speed_Me:governor.gov_Me"} <= named


def test_symbols_have_their_indices():
    canvas, _, _ = drawn(terms("gots-diesel"))
    texts = " ".join(w.text for w in canvas.items if isinstance(w, Words))
    assert "p_г, МПа" in texts and "R′_ш.ш" in texts and "M_кр" in texts
