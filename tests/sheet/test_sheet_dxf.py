"""The DXF read back: layers, closed polylines, real text, curves where the tables say."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
from functools import cache

import ezdxf
import numpy as np
import pytest
from ezdxf import recover
from hypothesis import given, settings
from hypothesis import strategies as st

from reports.draw.canvas import CURVES, LAYERS, SIZE, Line, Words
from reports.draw.fonts import HEIGHTS, INDEX, larger
from reports.draw.parts import ThrowSizes
from reports.draw.writers import DIMSTYLE, STYLE, dxf_bytes, parts_placed
from reports.inputs.load import load_text
from reports.new.generate import file_text, generate_engine
from reports.sheet.write import _throws, sheet_files, sheet_items
from tests.cover import chapters, charts, examples, samples_with
from tests.sheet.sheet_samples import drawn, terms, terms_of
from tests.sheet.test_sheet_places import faults

NEAR = 0.1  # mm


def read(data: bytes) -> ezdxf.document.Drawing:
    """The file by the strict reader, which refuses what a lenient one mends."""
    document = ezdxf.read(io.StringIO(data.decode()))
    auditor = document.audit()
    assert not auditor.errors and not auditor.fixes
    return document


@cache
def files() -> dict[str, bytes]:
    """What is written of one engine."""
    return anew()


def anew() -> dict[str, bytes]:
    t = terms("d-240")
    return sheet_files(t.model, t.values)


def distance(points: np.ndarray, path: np.ndarray) -> np.ndarray:
    """From each point to the nearest place of a polyline."""
    start, step = path[:-1], np.diff(path, axis=0)
    long = np.maximum((step**2).sum(axis=1), 1e-12)
    separate = points[:, None, :] - start[None]
    share = np.clip((separate * step[None]).sum(axis=2) / long, 0, 1)
    return np.sqrt(((separate - share[..., None] * step[None]) ** 2).sum(axis=2).min(axis=1))


def number(text: str) -> float:
    return float(text.replace("−", "-").replace(",", ".").replace("\u00a0", ""))


def marks(texts: list[Words], path: np.ndarray) -> list[np.ndarray]:
    """Places of the marks along both axes and what is written there, as a person reads them."""
    (left, low), (right, high) = path.min(axis=0), path.max(axis=0)
    numbers = [t for t in texts if re.fullmatch(r"−?[\d\u00a0]+(,\d+)?", t.text)]
    up = [t for t in numbers if t.align == 1.0 and t.place[0] < left + 0.1
          and low - 12 < t.place[1] < high + 12]  # fmt: skip
    column = max(t.place[0] for t in up)
    across = [t for t in numbers if t.align == 0.5 and t.place[1] < low
              and left - 12 < t.place[0] < right + 12]  # fmt: skip
    row = max(t.place[1] for t in across)
    return [
        np.array([(t.place[0], number(t.text)) for t in across if abs(t.place[1] - row) < 0.1]),
        np.array([(t.place[1] + t.height / 2, number(t.text)) for t in up
                  if abs(t.place[0] - column) < 0.1]),
    ]  # fmt: skip


def check_curves(t) -> int:
    """Points of the tables on the curves of the file; how many were looked at."""
    canvas, _, _ = drawn(t)
    document = read(dxf_bytes(canvas.items))
    lines = [np.array([p[:2] for p in e.get_points("xy")])
             for e in document.modelspace().query('LWPOLYLINE[layer=="Кривые"]')]  # fmt: skip
    named = [item for item in canvas.items if isinstance(item, Line) and item.layer is CURVES]
    texts = [item for item in canvas.items if isinstance(item, Words)]
    assert len(lines) == len(named)
    fields = {}  # the first curve of a diagram finds its marks, the others share them
    for item, path in zip(named, lines, strict=True):
        chart = item.name.partition(":")[0]
        fields[chart] = np.vstack([fields.get(chart, path), path])
    count = 0
    for item, path in zip(named, lines, strict=True):
        key, _, column = item.name.partition(":")
        chart = t.model.charts_by_id[key]
        if chart.kind == "wear":
            continue
        everything = (s for each in (chart, *t.model.charts) for s in each.series)
        series = next(s for s in everything if s.y == column)
        table = np.column_stack([t.column(series.x), t.column(column)])
        where = np.empty_like(table)
        for axis, match in enumerate(marks(texts, fields[key])):
            slope, at_zero = np.polyfit(match[:, 1], match[:, 0], 1)
            assert np.abs(slope * match[:, 1] + at_zero - match[:, 0]).max() < 0.01, item.name
            where[:, axis] = slope * table[:, axis] + at_zero
            unit = abs(1 / slope)
            assert any(_says(text.text, unit) for text in texts), (item.name, unit)
        ends = np.vstack([path, path[:1]]) if item.closed else path
        assert distance(where, ends).max() < NEAR, item.name
        count += len(table)
    return count


def _says(text: str, unit: float) -> bool:
    """Whether a line of the sheet names this scale."""
    if "/мм" not in text:
        return False
    named = re.findall(r"(?:М|горизонтали) ([\d,]+)", text)
    return any(abs(number(n) - unit) < 1e-6 * unit for n in named)


@pytest.mark.parametrize("name", samples_with(charts, chapters))
def test_every_curve_lies_where_the_table_says(name):
    assert check_curves(terms(name)) > 400


@settings(max_examples=examples(4, 20))
@given(
    cylinders=st.integers(1, 12), layout=st.sampled_from(["inline", "v", "opposed"]),
    strokes=st.sampled_from([4, 2]), kind=st.sampled_from(["petrol", "diesel"]),
    speed=st.integers(900, 6000),
)  # fmt: skip
def test_random_engines(cylinders, layout, strokes, kind, speed):
    if layout != "inline":
        cylinders += cylinders % 2
    engine = generate_engine(cylinders, layout=layout, strokes=strokes, kind=kind, speed_rpm=speed)
    text = re.sub(r"step_deg = \d+", "step_deg = 30", file_text(engine))
    t = terms_of(load_text(text, source="own.toml").model)
    assert faults(t) == []
    assert check_curves(t) > 100


def test_wear_is_laid_off_from_the_circle():
    t = terms("gots-diesel")
    canvas, _, _ = sheet_items(t)
    curve = next(i for i in canvas.items if getattr(i, "name", "") == "fig52:table_14_sums.ray_sum")
    sums = [t.value(key) for key in t.model.grid_runs["table_14_sums.ray_sum"][:-1]]
    path = np.array(curve.points)
    document = read(dxf_bytes(canvas.items))
    circles = document.modelspace().query('CIRCLE[layer=="Контур"]')
    circle = min(circles, key=lambda c: np.hypot(*(np.array(c.dxf.center)[:2] - path.mean(axis=0)))
                 + (0 if c.dxf.radius > 20 else 1e3))  # fmt: skip
    depth = circle.dxf.radius - np.hypot(*(path - np.array(circle.dxf.center)[:2]).T)
    rays = depth[:: len(path) // len(sums)]
    unit = max(sums) / depth.max()
    assert np.abs(rays - np.array(sums) / unit).max() < NEAR
    assert abs(unit - round(unit, 4)) < 1e-6


def test_layers_texts_and_closed_lines():
    assert set(files()) == {"-sheet.pdf", "-sheet.dxf", "-throw.dxf", "-mechanism.dxf"}
    _, auditor = recover.read(io.BytesIO(files()["-sheet.dxf"]))
    assert not auditor.errors and not auditor.fixes  # nor has a lenient reader anything to mend
    document = read(files()["-sheet.dxf"])
    assert document.dxfversion == "AC1024" and document.units == ezdxf.units.MM
    names = {layer.dxf.name for layer in document.layers}
    assert {layer.name for layer in LAYERS} <= names
    space = document.modelspace()
    texts = {text.dxf.text for text in space.query("TEXT")}
    assert {"Разраб.", "Схема уравновешивания", "Порядок работы 1–3–4–2"} <= texts
    dashed = [line for line in space.query('LWPOLYLINE[layer=="Кривые"]')
              if line.dxf.linetype not in ("BYLAYER", "Continuous")]  # fmt: skip
    assert dashed and all(line.dxf.flags & 128 for line in dashed)  # else their pieces are solid
    closed = [line for line in space.query("LWPOLYLINE") if line.closed]
    assert len(closed) > 10
    assert {e.dxf.layer for e in space} <= {layer.name for layer in LAYERS}
    # Programs that open a drawing by its extents would show a point in place of the sheet.
    corners = [tuple(document.header[key])[:2] for key in ("$EXTMIN", "$EXTMAX", "$LIMMAX")]
    assert corners == [(0, 0), (841, 594), (841, 594)]


def words_of(file: str) -> list[str]:
    """Texts of a drawing, those of its dimensions too."""
    return [e.dxf.text for e in read(files()[file]).modelspace().query("TEXT DIMENSION")]


def test_dimensions_measure_what_they_say():
    dimensions = read(files()["-throw.dxf"]).modelspace().query("DIMENSION")
    assert len(dimensions) == 4 * 10
    for entity in dimensions:
        said = float(re.search(r"[\d,]+$", entity.dxf.text)[0].replace(",", "."))
        assert entity.get_measurement() == pytest.approx(said, abs=0.01)
        assert entity.dxf.dimstyle == DIMSTYLE


def test_lettering_is_that_of_the_standard():
    """ГОСТ 2.304: heights 1.8 to 10 alone, one style, which a drawing program finds by name."""
    space = read(files()["-sheet.dxf"]).modelspace()
    texts = space.query("TEXT")
    assert {round(text.dxf.height, 3) for text in texts} <= set(HEIGHTS)
    assert {text.dxf.style for text in texts} == {STYLE} == {"lc_opengost-br"}  # of LibreCAD
    style = read(files()["-sheet.dxf"]).styles.get(STYLE)
    assert (style.dxf.font, style.dxf.oblique) == ("isocpeur.ttf", 15)  # of AutoCAD, КОМПАС
    assert any(text.dxf.height == 2.5 and text.dxf.text == "г" for text in texts)  # an index


def test_line_types_have_names_that_programs_know():
    names = {kind.dxf.name for kind in read(files()["-sheet.dxf"]).linetypes}
    assert names <= {"ByBlock", "ByLayer", "Continuous", "CENTER2", "DASHED2", "DOT2", "DIVIDE2"}


def test_parts_are_true_to_size():
    t = terms("d-240")
    circles = read(files()["-mechanism.dxf"]).modelspace().query("CIRCLE")
    radius = max(circle.dxf.radius for circle in circles)
    assert radius == pytest.approx(1000 * t.value("r_crank"))
    said = set(words_of("-mechanism.dxf"))
    assert said == {"ØD = 110", "S = 125", "L = 230", "r = 62,5"}
    texts = words_of("-throw.dxf")
    for size in ("l1 = 18", "hЛ = 26", "l2 = 25", "l5 = 25", "l6 = 18", "r = 62,5", "Ø68,25"):
        assert texts.count(size) == 4
    assert [f"Колено {n}" for n in range(1, 5)] == [x for x in texts if x.startswith("Колено")]


def test_the_same_bytes():
    assert anew() == files()


def test_the_same_bytes_in_another_process():
    """Where sets of words have another order."""
    program = (
        "import sys; from reports.draw.writers import dxf_bytes;"
        "from reports.draw.canvas import Line;"
        "sys.stdout.buffer.write(dxf_bytes([Line(((0, 0), (9, 9)))]))"
    )
    values = {
        subprocess.run(
            [sys.executable, "-c", program], check=True, capture_output=True,
            env={**os.environ, "PYTHONHASHSEED": seed},
        ).stdout
        for seed in "14"  # two orders
    }  # fmt: skip
    assert len(values) == 1 and b"ENTITIES" in values.pop()


def test_words_stand_in_the_file_where_the_list_has_them():
    canvas, _, _ = sheet_items(terms("d-240"))
    words = [part for item in canvas.items if isinstance(item, Words) and item.name != SIZE
             for part in parts_placed(item)]  # fmt: skip
    texts = list(read(dxf_bytes(canvas.items)).modelspace().query("TEXT"))
    assert len(words) == len(texts)
    for item, text in zip(words, texts, strict=True):
        assert text.dxf.text == item.text and text.dxf.height == pytest.approx(item.height)
        assert tuple(text.get_placement()[1])[:2] == pytest.approx(item.place)


@pytest.mark.parametrize("size", [1.0, 0.1, 10.0])
def test_of_any_engine_dashes_go_with_the_letters(size: float) -> None:
    """Drawn true to size, the axes of a small crank were two dashes, of a large one dust."""
    lengths = (18.0, 19.0, 10.0, 10.0, 19.0, 18.0)
    throw = ThrowSizes(
        tuple(size * arm for arm in lengths), (19 * size, 19 * size), 43 * size, 59 * size,
        (71 * size, 71 * size), (37 * size, 37 * size),
    )  # fmt: skip
    document = read(_throws([throw]))
    titles = {text.dxf.height for text in document.modelspace().query("TEXT")}
    letters = [height for height in (*HEIGHTS, INDEX * min(titles)) if larger(height) in titles]
    assert any(document.header["$LTSCALE"] == pytest.approx(height / 3.5) for height in letters)
    assert size < 1 or titles <= set(HEIGHTS)  # ГОСТ 2.304, but for what is smaller than its row


def test_on_paper_dashes_are_as_long_as_they_say() -> None:
    assert read(files()["-sheet.dxf"]).header["$LTSCALE"] == 1.0


def test_a_pattern_begins_with_its_dash_and_gaps_are_negative() -> None:
    types = read(dxf_bytes([Line(((0, 0), (99, 0)), dash=(12, 2, 1, 2))])).linetypes
    lengths = [tag.value for tag in types.get("CENTER2").pattern_tags.tags if tag.code in (40, 49)]
    assert lengths == [17, 12, -2, 1, -2]


def test_letters_of_the_mechanism_are_read_where_all_of_it_is_seen() -> None:
    document = read(files()["-mechanism.dxf"])
    low, high = document.header["$EXTMIN"], document.header["$EXTMAX"]
    heights = {text.dxf.height for text in document.modelspace().query("TEXT")}
    assert all(0.015 < height / (high[1] - low[1]) < 0.025 for height in heights)
    assert document.header["$LTSCALE"] == pytest.approx(min(heights) / 3.5)


def test_a_drawing_is_opened_with_all_of_it_in_the_middle() -> None:
    document = read(dxf_bytes([Line(((10, 20), (110, 80)))]))
    (view,) = document.viewports.get("*Active")
    assert tuple(view.dxf.center)[:2] == (60, 50) and 60 < view.dxf.height < 70
