import math
import re
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from reports.document.figures import (
    Level,
    Mark,
    Panel,
    Pole,
    Series,
    crank_scheme,
    line_chart,
    mechanism_sketch,
    polar_path,
    pv_diagram,
    roman,
    stacked_panels,
    twin_chart,
    wear_diagram,
)
from reports.document.figures import axes as ax
from reports.document.figures.labels import Room, box_at, dense, label_point, shown

PHI = np.arange(0, 721, 10.0)
RAD = np.radians(PHI)
FORCE = 5 * np.exp(-(((PHI - 375) / 30) ** 2)) - 3 * np.cos(RAD) - np.cos(2 * RAD)
T, K = FORCE * np.sin(RAD), FORCE * np.cos(RAD)

FIGURES = {
    "line": lambda: line_chart(
        PHI,
        [Series("$N$", T), Series(r"$S_{\mathrm{уд}}$", K), Series(r"$p'_j$", FORCE)],
        r"$\varphi$, °ПКВ",
        "$p$, МПа",
        levels=[Level("среднее", 0.4)],
        marks=[Mark("max", 370.0, float(FORCE[37]))],
    ),
    "legend": lambda: line_chart(
        PHI, [Series("$a$", T), Series("$b$", K)], "x", "y, мин⁻¹", direct=False
    ),
    "twin": lambda: twin_chart(
        PHI, Panel([Series("", T)], r"$\omega$, с⁻¹"), Panel([Series("", 1e5 * K)], "ε"), "φ, °"
    ),
    "stacked": lambda: stacked_panels(
        PHI, [Panel([Series("", T * n)], f"$M_{n}$, Н·м") for n in (1, 2, 3)], "φ, °"
    ),
    "pv": lambda: pv_diagram(1.1 - np.cos(RAD), FORCE + 5, marks=[Mark("$z$", 0.1, 9.0)]),
    "polar": lambda: polar_path(
        T, K, PHI, "$T$", "$K$", invert=(False, True), poles=[Pole("$O$"), Pole("$O_1$", 0, 1.5)]
    ),
    "wear": lambda: wear_diagram(np.arange(1, 13), np.arange(12) * 30.0, 95.0),
    "mechanism": lambda: mechanism_sketch(0.3176),
    "cranks": lambda: crank_scheme([0, 120, 240]),
}


def texts(svg: str) -> list[str]:
    tree = ET.fromstring(svg)
    found = [node for node in tree.iter() if node.tag.endswith("}text")]
    return ["".join(node.itertext()) for node in found]


@pytest.fixture(scope="module")
def drawn():
    return {name: make() for name, make in FIGURES.items()}


@pytest.mark.parametrize("name", FIGURES)
def test_same_bytes_again(drawn, name):
    assert FIGURES[name]() == drawn[name]


@pytest.mark.parametrize("name", FIGURES)
def test_fit_to_stand_in_a_page_with_others(drawn, name):
    svg = drawn[name]
    tree = ET.fromstring(svg)
    assert not [node for node in tree.iter() if "id" in node.attrib or "clip-path" in node.attrib]
    assert ' style="' not in svg.split(">", 1)[1]
    assert "<metadata" not in svg and "DOCTYPE" not in svg and "xlink" not in svg
    families = set(re.findall(r'font-family="([^"]*)"', svg))
    assert families == {"STIXGeneral"}
    colours = set(re.findall(r"#[0-9a-f]{6}", svg))
    assert all(c[1:3] == c[3:5] == c[5:7] for c in colours), "only greys"


@pytest.mark.parametrize("name", FIGURES)
def test_everything_lies_on_the_sheet(drawn, name):
    tree = ET.fromstring(drawn[name])
    width, height = map(float, tree.attrib["viewBox"].split()[2:])
    assert width <= 165.01 / 25.4 * 72 and height <= 190 / 25.4 * 72
    for node in tree.iter():
        for x, y in re.findall(r"[ML] ?(-?[\d.]+) (-?[\d.]+)", node.attrib.get("d", "")):
            assert -1 <= float(x) <= width + 1 and -1 <= float(y) <= height + 1
        if node.tag.endswith("}text") and "x" in node.attrib:
            assert 0 <= float(node.attrib["x"].split()[0]) <= width
            assert 0 < float(node.attrib["y"].split()[0]) <= height


@pytest.mark.parametrize("name", FIGURES)
def test_no_decimal_point_and_no_hyphen_minus(drawn, name):
    for text in texts(drawn[name]):
        assert not re.search(r"\d\.\d", text)
        assert not re.search(r"-\d", text)


def test_patterns_differ_without_colour(drawn):
    dashes = set(re.findall(r'stroke-dasharray="([^"]*)"', drawn["line"]))
    assert len(dashes) >= 3  # two curves dashed differently and the level


def test_angle_marks():
    assert ax.angle_ticks(0, 720).texts[:3] == ("0", "60", "120")
    assert ax.angle_ticks(0, 360).texts[:3] == ("0", "30", "60")
    assert ax.angle_ticks(0, 720, step=90).places[-1] == 720
    assert ax.angle_ticks(0, 700).texts[-1] == ""


@pytest.mark.parametrize(
    ("low", "high", "texts"),
    [
        (-0.3, 0.9, ("−0,4", "−0,2", "0,0", "0,2", "0,4", "0,6", "0,8", "1,0")),
        (0, 13128, ("0", "2500", "5000", "7500", "10\u00a0000", "12\u00a0500", "15\u00a0000")),
        (0, 0.25, ("0,00", "0,05", "0,10", "0,15", "0,20", "0,25")),
        (5.0, 5.0, ("0", "1", "2", "3", "4", "5")),
    ],
)
def test_value_marks(low, high, texts):
    assert ax.value_ticks(low, high).texts == texts


def test_flat_curve_has_an_axis():
    ticks = ax.value_ticks(0.0, 0.0)
    assert ticks.low < 0 < ticks.high


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_not_finite_is_refused(bad):
    curve = FORCE.copy()
    curve[3] = bad
    with pytest.raises(ValueError, match="не число"):
        line_chart(PHI, [Series("a", curve)], "x", "y")
    with pytest.raises(ValueError, match="не число"):
        polar_path(curve, K, PHI, "x", "y")
    with pytest.raises(ValueError, match="не число"):
        wear_diagram([1, 2, bad], [0, 120, 240], 0)


def test_shapes_are_checked():
    with pytest.raises(ValueError, match="Кривая «a»"):
        line_chart(PHI, [Series("a", T[:-1])], "x", "y")
    with pytest.raises(ValueError, match="не равны"):
        polar_path(T, K[:-1], PHI, "x", "y")
    with pytest.raises(ValueError, match="лучах"):
        wear_diagram([1, 2, 3], [0, 90], 0)
    with pytest.raises(ValueError, match="отрицательна"):
        wear_diagram([1, -2, 3], [0, 120, 240], 0)
    with pytest.raises(ValueError, match="λ"):
        mechanism_sketch(1.2)
    with pytest.raises(ValueError, match="колена"):
        crank_scheme([])
    with pytest.raises(ValueError, match="Непарный"):
        shown("цена $5")


def test_polar_scales_are_equal_and_path_is_not_smoothed(drawn):
    width, height = map(float, ET.fromstring(drawn["polar"]).attrib["viewBox"].split()[2:])
    assert height > width
    paths = [p for p in re.findall(r' d="([^"]*)"', drawn["polar"]) if p.count("L") >= PHI.size - 1]
    assert len(paths) == 1 and "C" not in paths[0]
    points = np.array(re.findall(r"[ML] ?(-?[\d.]+) (-?[\d.]+)", paths[0]), dtype=float)
    dx, dy = np.ptp(points[:, 0]) / np.ptp(T), np.ptp(points[:, 1]) / np.ptp(K)
    assert dx == pytest.approx(dy, rel=1e-3)
    assert points[0, 1] != points[36, 1]
    down = points[:, 1][int(K.argmax())]
    assert down == points[:, 1].max()  # K positive downwards: SVG's y grows downwards


def test_polar_angle_labels_do_not_collide(drawn):
    tree = ET.fromstring(drawn["polar"])
    boxes = []
    for node in tree.iter():
        text = "".join(node.itertext())
        if node.tag.endswith("}text") and node.attrib.get("font-size") == "8.5":
            x, y = float(node.attrib["x"].split()[0]), float(node.attrib["y"].split()[0])
            half = len(text) * 8.5 * 0.25
            boxes.append((x - half, y - 6, x + half, y, text))
    assert len(boxes) >= 12
    assert any(box[4].startswith("0,") for box in boxes)
    for i, a in enumerate(boxes):
        for b in boxes[i + 1 :]:
            apart = a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]
            assert apart, (a, b)


def test_wear_is_to_scale():
    sums = np.array([4.0, 3.0, 2.0, 1.0, 2.0, 3.0])
    svg = wear_diagram(sums, np.arange(6) * 60.0, None)
    tree = ET.fromstring(svg)
    paths = [node.attrib["d"] for node in tree.iter() if node.attrib.get("fill") == "#ffffff"]
    outline = max(paths, key=lambda d: d.count("L"))
    points = np.array(re.findall(r"[ML] ?(-?[\d.]+) (-?[\d.]+)", outline), dtype=float)
    width = float(tree.attrib["viewBox"].split()[2])
    radius = width / 2 - 34
    ends = points[:72:12]
    centre = np.array([width / 2, ends[0, 1] + (radius - 0.62 * radius)])
    depth = radius - np.hypot(*(ends - centre).T)
    assert depth / depth[0] == pytest.approx(sums / sums[0], abs=0.01)
    distance = np.hypot(*(points - centre).T)
    assert distance.max() <= radius + 0.5  # the smooth curve never leaves the journal


def test_wear_direction_and_numerals(drawn):
    assert set(texts(drawn["wear"])) >= {"I", "II", "III", "IV", "IX", "XII", "95°"}
    assert [roman(n) for n in (1, 4, 9, 14, 18)] == ["I", "IV", "IX", "XIV", "XVIII"]
    with pytest.raises(ValueError, match="римской"):
        roman(40)

    def second_ray(clockwise):
        svg = wear_diagram(np.ones(4), np.arange(4) * 90.0, None, clockwise=clockwise)
        tree = ET.fromstring(svg)
        node = next(
            n for n in tree.iter() if n.tag.endswith("}text") and "".join(n.itertext()) == "II"
        )
        return float(node.attrib["x"]) - float(tree.attrib["viewBox"].split()[2]) / 2

    assert second_ray(True) > 0 > second_ray(False)


def test_room_and_labels():
    room = Room((0, 0, 100, 100))
    room.curves.append(dense(np.array([[0.0, 50.0], [100.0, 50.0]])))
    assert not room.free((10, 45, 20, 55))
    assert room.free((10, 60, 20, 70))
    place = label_point(room, (50, 50), (10, 6), first=(0, 1))
    assert place is not None and place[1] > 53
    again = label_point(room, (50, 50), (10, 6), first=(0, 1))
    assert again != place
    assert label_point(Room((0, 0, 5, 5)), (2, 2), (10, 6)) is None
    assert box_at((0, 0), (10, 4), (1, 0), 2) == pytest.approx((2, -2, 12, 2))


def test_cranks_of_one_direction_share_a_ray(drawn):
    assert "1, 4" in texts(crank_scheme([0, 180, 180, 360]))
