"""Sketches of the parts: letters of the very sizes, none on another, on sheets and in the note."""

from __future__ import annotations

import copy
import io
import itertools
import re
import zipfile
from dataclasses import replace
from functools import lru_cache, partial

import openpyxl
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from openpyxl.worksheet.worksheet import Worksheet
from PIL import Image

from kshm.ranges import PART_SHARES
from reports.draw.canvas import (
    SIZES,
    THIN,
    Canvas,
    Circle,
    Item,
    Line,
    Words,
    bounds,
    fitted,
    overlap,
)
from reports.draw.fonts import plain
from reports.draw.lettered import LetteredCanvas
from reports.draw.pixels import png_of
from reports.draw.sketched import LETTERS, SKETCHED, part_sizes, sketch
from reports.draw.sketches import PartSizes
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.blocks import Model, ScalarTable, TableSpec, nodes_in
from reports.model.evaluation import Graph, Values, evaluate_model
from reports.new.generate import generate_engine
from reports.tables.registry import build_model
from reports.workbook.pictures import SKETCH_OF
from reports.workbook.places import Box, column_px, row_px
from reports.workbook.write import workbook_bytes
from tests.conftest import sample
from tests.document.bare_pages import bare_page
from tests.layouts import MAKERS

_EMU = 9525
_MOST = 3 * 1024  # bytes of a picture
NEW = {"petrol": (4, "inline", 4, "petrol"), "v-diesel": (8, "v", 4, "diesel"),
       "two-stroke": (3, "inline", 2, "diesel")}  # fmt: skip
# Sizes of the formulas that are no length of the drawn part: gaps and plays, an oil hole, threads,
# deformations, the span whose other support is not drawn; the crown's stress is a result.
UNSEEN = {"st_ring_gap_mm", "st_hot_head_mm", "st_hot_skirt_mm", "strength_oil_hole_mm",
          "strength_ring_play_mm", "st_oval_mm", "st_bush_gap_mm", "st_bolt_core_mm",
          "strength_bolt_pitch_mm", "r_crank", "throw1_length"}  # fmt: skip
ELSEWHERE = {"piston": {"st_crown_mm"}}


@lru_cache(maxsize=8)
def engine(name: str) -> tuple[Model, Values]:
    cylinders, layout, strokes, kind = NEW[name]
    raw = generate_engine(cylinders, layout=layout, strokes=strokes, kind=kind, strength=True).data
    raw = copy.deepcopy(raw) | {"bearings": {}}
    raw.setdefault("calculation", {})["step_deg"] = 30
    model = build_model(load_mapping(raw, source=name).model)
    return model, evaluate_model(model)


@lru_cache(maxsize=4)
def book(name: str) -> bytes:
    return workbook_bytes(*engine(name))


@lru_cache(maxsize=4)
def opened(name: str) -> openpyxl.Workbook:
    return openpyxl.load_workbook(io.BytesIO(book(name)), data_only=True)


def words_of(items: list[Item]) -> list[Words]:
    return [item for item in items if isinstance(item, Words)]


def sheet_of(model: Model, part: str) -> str:
    return next(b.sheet for b in model.blocks if SKETCH_OF.get(b.id) == part)


def lengths_on(model: Model, sheet: str) -> set[str]:
    """Lengths that the formulas of a sheet read or give; of numbered ones the first."""
    graph, names = Graph(model), set[str]()
    for block in model.blocks:
        if block.sheet == sheet and isinstance(block, ScalarTable | TableSpec):
            for key, _ in nodes_in(block):
                names |= {key, *graph.references(key)}
    units = {name: model.fields[name].unit if name in model.fields
             else model.nodes[name].quantity.unit_label for name in names}  # fmt: skip
    lengths = {name for name, unit in units.items() if unit in ("мм", "м")}
    return {name for name in lengths if not re.match("throw[2-9]|throw1_arm_right", name)}


def unlike(name: str, part: str) -> set[str]:
    """Letters of a sketch that no formula of its sheet has, and the other way round."""
    model, values = engine(name)
    letters = [plain(words.text) for words in words_of(sketch(part, model, values.scalars))]
    assert len(letters) == len(set(letters))
    lengths = lengths_on(model, sheet_of(model, part)) - UNSEEN | ELSEWHERE.get(part, set())
    symbols = {model.fields[key].symbol.replace("_", "") if key in model.fields
               else model.nodes[key].quantity.symbol for key in lengths}  # fmt: skip
    return symbols ^ set(letters)


# --- letters --------------------------------------------------------------------------


@pytest.mark.parametrize("part", ["piston", "pin", "rod", "web"])
@pytest.mark.parametrize("name", NEW)
def test_letters_are_those_of_the_lengths_in_the_formulas(name: str, part: str) -> None:
    assert unlike(name, part) == set()


@pytest.mark.parametrize(
    ("part", "key", "letter"), [("piston", "land", "hп"), ("web", "arm", "aщ.л")]
)
def test_a_missing_letter_is_seen(
    part: str, key: str, letter: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = SKETCHED[part]
    lettered = tuple(each for each in whole.lettered if each != key)
    planted = replace(whole, lettered=lettered, plain=(*whole.plain, key))
    monkeypatch.setitem(SKETCHED, part, planted)
    assert unlike("petrol", part) == {letter}


@pytest.mark.parametrize("name", NEW)
def test_journals_have_the_letters_of_their_lengths(name: str) -> None:
    model, values = engine(name)
    letters = {plain(words.text) for words in words_of(sketch("crank", model, values.scalars))}
    assert letters == {"dк.ш", "dш.ш", "dм", "ρг"}


def test_what_is_not_known_is_not_sketched() -> None:
    model = build_model(sample("gots-diesel"))
    values = evaluate_model(model)
    assert [
        name for name in SKETCHED if name != "crank" and sketch(name, model, values.scalars)
    ] == []
    with_parts, values = engine("petrol")
    scalars = values.scalars | {"st_land_mm": float("nan")}
    assert sketch("piston", with_parts, scalars) is None


# --- places of the letters ------------------------------------------------------------


def faults(items: list[Item]) -> list[str]:
    """Letters that are run through, that lie on others or on the end of a line."""
    canvas, texts = Canvas(list(items)), words_of(items)
    said = [words.text for words in texts if not canvas.clear(words)]
    said += [f"{one.text} on {other.text}" for one, other in itertools.combinations(texts, 2)
             if overlap(one.box, other.box)]  # fmt: skip
    ends = [end for item in items if isinstance(item, Line) for end in item.points]
    for words in texts:
        left, low, right, high = words.box
        said += [f"{words.text} on an end" for x, y in ends if left < x < right and low < y < high]
    return said


def test_the_lint_sees_a_letter_on_an_end_and_on_another() -> None:
    letter = Words((0, 0), "H", 2.5, align=0.5)
    assert faults([letter, Line(((0, 1), (9, 1)), THIN)]) == ["H on an end"]
    assert faults([letter, Line(((-9, 1), (9, 1)), SIZES)]) == ["H"]
    assert faults([letter, Words((0.5, 1), "D", 2.5)]) == ["H on D"]


def drawn(part: str, sizes: dict[str, float]) -> list[Item]:
    whole, (model, values) = SKETCHED[part], engine("petrol")
    names = part_sizes(whole, model, values.scalars).names
    draw = partial(whole.draw, PartSizes(sizes, names), letters=LETTERS)
    return fitted(draw, whole.room)


@st.composite
def part_lengths(draw: st.DrawFn) -> dict[str, float]:
    """Sizes of the parts of an engine, some beyond what is usual."""
    bore = draw(st.floats(40, 500))
    sizes = {"bore": bore, "crankpin": bore * draw(st.floats(0.45, 0.8))}
    for key, (base, petrol, diesel) in PART_SHARES.items():
        low, high = min(petrol[0], diesel[0]), max(petrol[1], diesel[1])
        sizes[key] = sizes[base] * draw(st.floats(0.95 * low, 1.15 * high))
    play = 0.01 * bore
    sizes["groove"] = bore - 2 * (sizes["ring_radial"] + play)
    sizes["inner"] = sizes["groove"] - 2 * sizes["head_wall"]
    sizes["eye_bore"] = sizes["pin"] + 2 * sizes["bush_wall"]
    sizes["eye_outer"] = max(sizes["eye_outer"], 1.08 * sizes["eye_bore"])
    sizes["eye_wall"] = (sizes["eye_outer"] - sizes["eye_bore"]) / 2
    sizes["eye_mean"] = (sizes["eye_outer"] + sizes["eye_bore"]) / 4
    bearing = sizes["crankpin"] / 2 + sizes["shell"]
    sizes["cap_wall"] = max(sizes["bolts_apart"] / 2 - bearing, 0.03 * bore)
    radius = bore * draw(st.floats(0.35, 0.8))
    thick = bore * draw(st.floats(0.12, 0.4))
    return sizes | {
        "rod": radius * draw(st.floats(3, 5)), "radius": radius, "main": sizes["crankpin"] * 1.1,
        "web_thickness": thick, "web_width": bore * draw(st.floats(0.7, 1.6)),
        "arm": thick / 2 + bore * draw(st.floats(0.05, 0.4)),
    }  # fmt: skip


@pytest.mark.parametrize("part", ["piston", "pin", "rod", "web"])
@settings(max_examples=25, deadline=None)
@given(sizes=part_lengths())
def test_no_letter_lies_on_another_or_on_a_line(part: str, sizes: dict[str, float]) -> None:
    items = drawn(part, sizes)
    assert faults(items) == []
    assert sorted(words.name for words in words_of(items)) == sorted(SKETCHED[part].lettered)
    left, low, right, high = bounds(items)
    wide, tall = SKETCHED[part].room
    assert right - left < 1.01 * wide and high - low < 1.01 * tall


@settings(max_examples=25, deadline=None)
@given(arms=st.lists(st.integers(8, 60), min_size=3, max_size=3), web=st.integers(0, 40),
       radius=st.integers(30, 90), pin=st.integers(40, 90), second=st.integers(0, 40),
       bored=st.booleans(), fillet=st.floats(2, 6))  # fmt: skip
def test_no_letter_of_any_throw_lies_on_another_or_on_a_line(
    arms: list[int], web: int, radius: int, pin: int, second: int, bored: bool, fillet: float
) -> None:
    sizes = {"l1": arms[0], "l2": arms[1], "l3": second / 2, "l4": second / 2, "l5": arms[1],
             "l6": arms[2], "left_web": web, "right_web": web, "left_usual": 20, "right_usual": 20,
             "main": pin + 5, "crankpin": pin, "radius": radius, "main_length": 30,
             "next_length": 36, "hole": 5, "fillet": fillet, "main_bore": 0.4 * pin * bored,
             "crankpin_bore": 0.4 * pin * bored}  # fmt: skip
    keys = {key for key in SKETCHED["crank"].lettered if sizes[key]}
    names = {key: f"d_{key[:3]}" for key in keys}
    draw = partial(SKETCHED["crank"].draw, PartSizes(sizes, names), letters=LETTERS)
    items = fitted(draw, SKETCHED["crank"].room)
    assert faults(items) == []
    assert {words.name for words in words_of(items)} == keys


def test_a_hatch_stays_within_its_outline_and_out_of_holes() -> None:
    canvas = LetteredCanvas(letters=2.5)
    canvas.hatch([(0, 0), (40, 0), (40, 30), (0, 30)], [(10, 10), (30, 10), (30, 20), (10, 20)])
    points = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in (i.points for i in canvas.items)]
    assert len(points) > 15
    assert all(0 < x < 40 and 0 < y < 30 for x, y in points)
    assert not [(x, y) for x, y in points if 10 < x < 30 and 10 < y < 20]


# --- workbook -------------------------------------------------------------------------


def placed(sheet: Worksheet) -> list[tuple[str, Box]]:
    """Alternative texts of a sheet's pictures and where they stand."""
    collected = []
    for image in sheet._images:  # openpyxl has no other list of what it read
        at, size = image.anchor._from, image.anchor.ext
        x = sum(column_px(sheet, i) for i in range(1, at.col + 1)) + at.colOff // _EMU
        y = sum(row_px(sheet, i) for i in range(1, at.row + 1)) + at.rowOff // _EMU
        words = image.anchor.pic.nvPicPr.cNvPr.descr
        collected.append((words, Box(x, y, size.width // _EMU, size.height // _EMU)))
    return collected


def cell_box(sheet: Worksheet, row: int, column: int) -> Box:
    x = sum(column_px(sheet, i) for i in range(1, column))
    y = sum(row_px(sheet, i) for i in range(1, row))
    return Box(x, y, column_px(sheet, column), row_px(sheet, row))


def covered(sheet: Worksheet, box: Box) -> list[str]:
    """Cells with content under a box."""
    said = []
    for row in sheet.iter_rows():
        for cell in row:
            at = cell_box(sheet, cell.row, cell.column)
            is_under = (at.x < box.right and box.x < at.right
                        and at.y < box.bottom and box.y < at.bottom)  # fmt: skip
            if cell.value is not None and is_under:
                said.append(f"{sheet.title}!{cell.coordinate}")
    return said


@pytest.mark.parametrize("name", NEW)
def test_every_part_has_its_sketch_on_its_sheet(name: str) -> None:
    model, values = engine(name)
    workbook = opened(name)
    expected = {}
    for part in SKETCHED:
        letters = (plain(w.text) for w in words_of(sketch(part, model, values.scalars)))
        expected[sheet_of(model, part)] = f"{SKETCHED[part].title}, размеры: {', '.join(letters)}"
    seen = {sheet.title: placed(sheet)[0][0] for sheet in workbook.worksheets if sheet._images}
    assert seen == expected and len(seen) == 5
    for title in seen:
        sheet, (_, box) = workbook[title], placed(workbook[title])[0]
        assert len(placed(sheet)) == 1 and covered(sheet, box) == []
        _, _, column, row = openpyxl.utils.range_boundaries(sheet.print_area.rpartition("!")[2])
        last = cell_box(sheet, row, column)
        assert box.right <= last.right and box.bottom <= last.bottom


def test_the_lint_sees_covered_cells() -> None:
    sheet = opened("petrol")["Палец"]
    assert covered(sheet, Box(0, 0, 300, 100))


@pytest.mark.parametrize("name", NEW)
def test_pictures_are_small_and_black_and_white(name: str) -> None:
    with zipfile.ZipFile(io.BytesIO(book(name))) as archive:
        pictures = [archive.read(n) for n in archive.namelist() if n.startswith("xl/media/")]
    assert len(pictures) == 5 and max(map(len, pictures)) <= _MOST
    assert {Image.open(io.BytesIO(png)).mode for png in pictures} == {"1"}


def test_a_book_without_strength_has_no_pictures() -> None:
    raw = to_mapping(sample("gots-diesel"))
    raw["calculation"]["step_deg"] = 30
    data = workbook_bytes(build_model(load_mapping(raw, source="").model))
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert [name for name in archive.namelist() if "media" in name] == []
        assert b"png" not in archive.read("[Content_Types].xml")


def test_a_picture_has_dashes_circles_and_letters() -> None:
    items = [Circle((10, 10), 5), Line(((0, 10), (20, 10)), SIZES), Words((8, 18), "H_п", 2.5)]
    image = Image.open(io.BytesIO(png_of(items, (0, 0, 20, 22), 254)))
    assert image.size == (200, 220)
    assert not image.getpixel((50, 120)) and not image.getpixel((100, 120))
    assert image.getpixel((100, 100)) and image.getpixel((2, 2))
    dashed = [Line(((0, 10), (20, 10)), THIN, dash=(5.0, 5.0))]
    image = Image.open(io.BytesIO(png_of(dashed, (0, 0, 20, 20), 254)))
    assert [bool(image.getpixel((x, 100))) for x in (20, 70, 120, 170)] == [False, True] * 2


# --- note -----------------------------------------------------------------------------


@pytest.mark.usefixtures("nothing_is_drawn")
@pytest.mark.parametrize("name", NEW)
def test_the_note_shows_each_part_where_it_is_calculated(name: str) -> None:
    page = bare_page(engine(name)[0].input)
    for heading, key, caption in (
        ("Поршень", "piston_sketch", "Поршень, размеры"),
        ("Поршневой палец", "rod_sketch", "Палец и шатун, размеры: а"),
        ("Щёки коленчатого вала", "web_sketch", "Щека, размеры"),
        ("Запасы прочности шеек", "crank_sketch", "Шейки колена, размеры"),
    ):
        chapter = re.split(r"<h2", page.partition(f"{heading}</h2>")[2])[0]
        assert chapter, heading
        mention, figure = chapter.find(f'href="#ris-{key}"'), chapter.find(f'id="ris-{key}"')
        assert 0 <= mention < figure and caption in chapter
        assert page.count(f'id="ris-{key}"') == 1


@pytest.mark.parametrize("maker", MAKERS)
def test_every_layout_has_its_sketches(maker: str) -> None:
    raw = MAKERS[maker](copy.deepcopy(to_mapping(sample("gots-diesel"))))
    raw |= {"strength": {"kind": "diesel"}, "bearings": {}}
    raw["calculation"]["step_deg"] = 30
    model = build_model(load_mapping(raw, source=maker).model)
    scalars = evaluate_model(model).scalars
    for part in SKETCHED:
        assert faults(sketch(part, model, scalars)) == [], part
