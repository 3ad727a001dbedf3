"""What stands where: no text over text, nothing outside, every curve at its scale."""

from __future__ import annotations

import itertools

import pytest

from reports.document.chapters.chapter import worst_pin
from reports.document.chapters.oil_hole import Hole, HoleOrigin, in_order, oil_hole
from reports.document.report import Report
from reports.document.text.texts import of_digits
from reports.draw.canvas import CURVES, THIN, Canvas, Line, Words, overlap
from reports.draw.canvas import SIZES as DIMENSIONS
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.report import DIAGRAMS, USUAL, SheetSection
from reports.sheet import cell
from reports.sheet.cell import CellArea, balance
from reports.sheet.write import MARGINS, SIZES, STAMP_HEIGHT, STAMP_WIDTH, cells, title_block
from tests.conftest import sample
from tests.cover import chapters, charts, samples_with, sparse
from tests.layouts import MAKERS, layout_input
from tests.sheet.sheet_samples import drawn, terms, terms_of

# Those that every engine has: others stand in chapters of their own.
# What has a section or a chapter of its own is left out.
_ASKED = {"counterweight", "torsion", "strength", "speed", "flywheel"}
ALWAYS = [name for name in DIAGRAMS if name not in _ASKED]


def faults(t) -> list[str]:
    canvas, width, height = drawn(t)
    collected = []
    texts = [item for item in canvas.items if isinstance(item, Words)]
    for one, other in itertools.combinations(texts, 2):
        if overlap(one.box, other.box):
            collected.append(f"{one.text!r} over {other.text!r} at {one.place}")
    collected += [
        f"a curve through {words.text!r}"
        for words in texts
        if not Canvas([item for item in canvas.items if item.layer is CURVES]).clear(words)
    ]
    for item in canvas.items:
        left, low, right, high = item.box
        edge = 0.0 if not isinstance(item, Words) else 4.9
        if left < edge or low < edge or right > width - edge or high > height - edge:
            collected.append(f"outside: {item}")
    return collected


@pytest.mark.parametrize("name", samples_with(charts, chapters))
def test_nothing_covers_anything(name):
    assert faults(terms(name)) == []


@pytest.mark.parametrize("size", ["A1", "A2"])
@pytest.mark.parametrize("way", ["landscape", "portrait"])
@pytest.mark.parametrize("name", ["d-240", "yamz-236"])
def test_every_sheet(name, size, way):
    assert faults(terms(name, f'\n[sheet]\nsize = "{size}"\norientation = "{way}"\n')) == []


@pytest.mark.parametrize("size", SIZES)
def test_no_place_lies_under_the_title_block(size):
    section = SheetSection(size=size, diagrams=("pv",))
    for width, height in (SIZES[size], SIZES[size][::-1]):
        block = (width - MARGINS[1] - STAMP_WIDTH, 0.0, width, MARGINS[3] + STAMP_HEIGHT)
        for count in range(1, 14):
            rooms = cells(width, height, count, section)
            assert len(rooms) >= count
            for room in rooms:
                assert not overlap((room.left, room.low, room.right, room.high), block)


def test_everything_at_once():
    every = f"\n[sheet]\ndiagrams = {ALWAYS}\n".replace("'", '"')
    assert faults(terms("ecoboost-10", every)) == []
    assert set(USUAL) < set(DIAGRAMS)


@pytest.mark.parametrize("name", sparse(MAKERS))
def test_every_layout_has_a_sheet(name):
    assert faults(terms_of(layout_input(name, step_deg=30))) == []


def test_a_sample_in_the_legend_shows_how_its_line_is_broken():
    canvas, *_ = drawn(terms("d-240"))
    lines = [item for item in canvas.items if isinstance(item, Line) and len(item.points) == 2]
    samples = [line for line in lines if line.dash and line.layer is THIN]
    assert len(samples) > 3
    for shown in samples:
        (left, _), (right, _) = shown.points
        assert right - left >= sum(shown.dash) + shown.dash[0] - 0.1


@pytest.mark.parametrize("name", ["d-240-bearings", "two-stroke", "mwm-6"])
def test_the_oil_hole_is_drilled_where_the_note_concludes(name: str) -> None:
    """By the film, the wear or as given; the sheet drilled at 270° what the note put at 295°."""
    model = terms(name)
    canvas, *_ = drawn(model)
    said = [item.text for item in canvas.items if isinstance(item, Words)]
    hole = oil_hole(model, worst_pin(model))
    assert any(text.endswith(f"отверстие {hole.text}") for text in said)
    concluded = " ".join(Report(model.model, model.values).page("screen").split())
    words = concluded.partition("следует сверлить под углом ")[2]
    assert words.startswith(hole.text.replace("°", "")) or not words


@pytest.mark.parametrize(
    ("angles", "text"),
    [
        ((290, 310), "290…310°"),
        ((310, 290), "290…310°"),
        ((350, 10), "350…10°"),
        ((55, 295), "295° или 55°"),
        ((100, 250), "100° или 250°"),
        ((40, 40), "40°"),
    ],
)
def test_two_angles_of_a_hole_are_a_span_only_near_each_other(angles, text):
    """55° and 295° were told as 55…295°."""
    assert Hole(1, HoleOrigin.FILM, in_order(angles)).text == text


def test_the_place_of_an_oil_hole_is_the_reports():
    model = terms("d-240")
    canvas, *_ = drawn(model)
    said = [item.text for item in canvas.items if isinstance(item, Words)]
    assert any(text.endswith(f"отверстие {model.num('hole_pin_deg')}°") for text in said)
    assert any(text.endswith("противовеса щеки 0; 2,4 кг") for text in said)  # as given


def test_running_on_torques_of_a_small_engine_are_not_rounded_to_nothing() -> None:
    """Of a bore of 15 mm and 2.4 N·m nearly all of them stood as 0."""
    raw = to_mapping(sample("two-stroke"))
    raw["geometry"] |= {"bore_mm": 15.0}
    t = terms_of(load_mapping(raw, source="small").model)
    written = {item.text for item in drawn(t)[0].items if isinstance(item, Words)}
    torques = t.column("P4_4.Mmain2_Nm")
    digits = t.quantity("P4_4.Mmain2_Nm").digits
    assert digits.decimals > 0
    assert of_digits(float(torques[9]), digits) in written


def test_a_long_name_stays_in_its_cell():
    """It ran over its neighbours; a surname alone is what ГОСТ 2.104 asks for."""
    raw = to_mapping(sample("d-240"))
    raw["report"] |= {"student": "Александра Владимировна Константинопольская-Преображенская",
                      "supervisor": "Ржевский К. К.", "controller": "О" * 40,
                      "department": "Тепловые двигатели",
                      "institution": "Казанский национальный технический университет"}  # fmt: skip
    canvas = Canvas()
    title_block(canvas, load_mapping(raw, source="d").model, 0.0, 0.0)
    names = [item for item in canvas.items if isinstance(item, Words) and item.place[1] < 30
             and item.place[0] == 28.5 and item.text]  # fmt: skip
    assert [n.text for n in names] == ["Константинопольская-", "Преображенская", "Ржевский",
                                       "О" * 40]  # fmt: skip
    assert all(n.box[0] >= 17 and n.box[2] <= 40 for n in names)
    places = [i for i in canvas.items if isinstance(i, Words) and i.place[0] > 135
              and i.place[1] < 15]  # fmt: skip
    assert "Казанский" in places[0].text and min(n.height for n in places) >= 1.8
    assert all(n.box[0] >= 135 and n.box[2] <= 185 and n.box[3] < 15.1 for n in places)
    assert not any(overlap(one.box, other.box) for one, other in itertools.combinations(names, 2))


def test_forces_of_the_throws_point_away_from_the_axis():
    t, canvas = terms("d-240"), Canvas()
    balance(canvas, CellArea(0.0, 0.0, 180.0, 120.0), t)
    lines = [item for item in canvas.items if isinstance(item, Line) and not item.filled]
    forces = [line.points for line in lines if line.layer is DIMENSIONS]
    upwards = [angle in (0, 360) for angle in t.model.input.crankshaft.throw_angles_deg]
    assert [start[1] < end[1] for start, end in forces] == upwards == [True, False, False, True]
    second = t.num("balance_orders.F_order_kN", 2.0)
    assert second != t.num("balance_orders.F_order_kN", 1.0)
    assert f"2-й порядок: сила {second} кН" in said(canvas)


def said(canvas):
    return " ".join(item.text for item in canvas.items if isinstance(item, Words))


@pytest.mark.parametrize("share", [0.0, 0.5])
def test_what_is_left_behind_balancing_is_told_where_it_is_asked_for(share):
    """The first order of a shaft without devices stood as what they leave of it."""
    raw = to_mapping(sample("d-240"))
    raw["balance"] = {"first_shafts_share": share, "second_shafts_share": share}
    canvas = Canvas()
    balance(canvas, CellArea(0.0, 0.0, 180.0, 120.0), terms_of(load_mapping(raw, source="d").model))
    for words in ("до уравновешивания", "после", "до балансирных валов"):
        assert (words in said(canvas)) == (share > 0)


def test_the_title_block_declines_the_engine():
    """It read «двигателя. Двигатель …: V-» with the rest of the word in the next line."""
    raw = to_mapping(sample("d-240"))
    raw["engine"]["name"] = "Двигатель с искровым зажиганием: V-образный, четырёхтактный"
    canvas = Canvas()
    title_block(canvas, load_mapping(raw, source="d").model, 0.0, 0.0)
    assert "двигателя с искровым зажиганием (V-образного, четырёхтактного)" in said(canvas)
    lines = [item.text for item in canvas.items if isinstance(item, Words)]
    assert not any(line.endswith("V-") for line in lines)


@pytest.mark.parametrize("name", ["yamz-236", "vw-1600"])
def test_an_angle_of_a_polar_diagram_stands_at_its_point_and_no_curve_runs_through_it(name):
    canvas, *_ = drawn(terms(name))
    (curve,) = (i for i in canvas.items if getattr(i, "name", "").startswith("fig50"))
    angles = [i for i in canvas.items if isinstance(i, Words) and i.text.endswith("°")]
    near = [w.box for w in angles if w.height == 2.5]
    assert len(near) >= 6
    for left, low, right, high in near:
        assert not any(left < x < right and low < y < high for x, y in curve.points)
    left, low, right, high = curve.box
    of_curve = [w for w in angles if left - 9 < w.place[0] < right + 9 and w.height == 2.5]
    for words in of_curve:
        x, y = curve.points[round(float(words.text[:-1]) * (len(curve.points) - 1) / 720)]
        aside = max(words.box[0] - x, x - words.box[2], words.box[1] - y, y - words.box[3])
        assert aside < 8.1, words.text
    assert len(of_curve) > 10


@pytest.mark.parametrize("table", [cell.results, cell.running])
def test_letters_of_a_table_are_of_one_height(table):
    canvas = Canvas()
    table(canvas, CellArea(0.0, 0.0, 150.0, 120.0), terms("d-240"))
    cells = [i for i in canvas.items if isinstance(i, Words) and i.height < cell.TITLE]
    assert len({words.height for words in cells}) == 1
    assert not any(overlap(one.box, other.box) for one, other in itertools.combinations(cells, 2))
