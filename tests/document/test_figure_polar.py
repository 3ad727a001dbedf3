import math
import re
from functools import lru_cache
from itertools import pairwise
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from reports.document.figures.canvas import SMALL
from reports.document.figures.labels import text_size
from reports.document.figures.polar import polar_path, wear_diagram
from tests.document.figure_samples import FIGURES, PHI, K, T, texts


@lru_cache(maxsize=1)
def drawn() -> str:
    return FIGURES["polar"]()


def test_polar_scales_are_equal_and_path_is_not_smoothed():
    width, height = map(float, ET.fromstring(drawn()).attrib["viewBox"].split()[2:])
    assert height > width
    paths = [p for p in re.findall(r' d="([^"]*)"', drawn()) if p.count("L") >= PHI.size - 1]
    assert len(paths) == 1 and "C" not in paths[0]
    points = np.array(re.findall(r"[ML] ?(-?[\d.]+) (-?[\d.]+)", paths[0]), dtype=float)
    dx, dy = np.ptp(points[:, 0]) / np.ptp(T), np.ptp(points[:, 1]) / np.ptp(K)
    assert dx == pytest.approx(dy, rel=1e-3)
    assert points[0, 1] != points[36, 1]
    down = points[:, 1][int(K.argmax())]
    assert down == points[:, 1].max()  # K positive downwards: SVG's y grows downwards


def test_polar_angle_labels_do_not_collide():
    tree = ET.fromstring(drawn())
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
            separate = a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]
            assert separate, (a, b)


def test_bad_components_are_refused():
    with pytest.raises(ValueError, match="не равны"):
        polar_path(T, K[:-1], PHI, ("x", "y"))
    with pytest.raises(ValueError, match="не число"):
        polar_path(np.full(73, math.nan), K, PHI, ("x", "y"))


def test_numbers_of_an_axis_do_not_touch():
    turn = np.radians(np.arange(0, 361, 10.0))
    svg = polar_path(11000 * np.cos(turn), 11000 * np.sin(turn), np.degrees(turn), ("$x$", "$y$"),
                     most=80.0)  # fmt: skip
    nodes = [node for node in ET.fromstring(svg).iter() if node.tag.endswith("}text")]
    collected = [("".join(n.itertext()), float(n.attrib["x"]), float(n.attrib["y"])) for n in nodes]
    lowest = max(y for _, _, y in collected)
    row = sorted((x, text) for text, x, y in collected if y == lowest)
    assert any(text == "0" for _, text in row)
    for (left, before), (right, after) in pairwise(row):
        assert right - left > (text_size(before, SMALL)[0] + text_size(after, SMALL)[0]) / 2 + 2


@pytest.mark.parametrize("reverse", [(False, False), (True, False), (True, True)])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_name_of_an_axis_at_an_edge_is_not_cut_off(reverse, sign):
    """Of a load on one side of the journal the axis stands at the edge of the figure."""
    turn = np.radians(np.arange(0, 370, 10))
    x, y = sign * (2 + np.cos(turn)), np.sin(turn)
    names = "$R'_{x}$, МПа", "$R'_{y}$, МПа"
    svg = polar_path(x, y, np.degrees(turn), names, reverse=reverse)
    width = float(re.search(r'data-size="([\d.]+)/', svg).group(1))
    halos = re.findall(r'<rect x="([\d.-]+)" y="[\d.-]+" width="([\d.]+)"', svg)
    assert len(halos) > 2 and all(float(x) + float(wide) <= width + 1 for x, wide in halos)


def test_points_that_are_counted_all_have_their_numbers():
    """Cylinders of a star of phases: of five only the farthest had its number."""
    x, y = [0, 0, -1, 0, -0.6, 0.2], [0, 1, 1.3, 1.6, 0.8, 0.1]
    svg = polar_path(x, y, range(6), ("$x$", "$y$"), most=70.0, least_step=1)
    nodes = [n for n in ET.fromstring(svg).iter() if n.attrib.get("font-size") == "8.5"]
    assert {str(k) for k in range(1, 6)} <= {"".join(n.itertext()) for n in nodes}


def test_wear_is_to_scale():
    sums = np.array([4.0, 3.0, 2.0, 1.0, 2.0, 3.0])
    svg = wear_diagram(sums, np.arange(6) * 60.0, None)
    tree = ET.fromstring(svg)
    paths = [node.get("d", "") for node in tree.iter() if node.get("fill") == "#ffffff"]
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


def test_rays_are_numbered_against_the_clock():
    assert set(texts(FIGURES["wear"]())) >= {"I", "II", "III", "IV", "IX", "XII", "95°"}
    tree = ET.fromstring(wear_diagram(np.ones(4), np.arange(4) * 90.0, None))
    nodes = [node for node in tree.iter() if node.tag.endswith("}text")]
    (second,) = (node for node in nodes if "".join(node.itertext()) == "II")
    assert float(second.attrib["x"]) < float(tree.attrib["viewBox"].split()[2]) / 2


def test_the_hole_has_the_angle_that_the_text_names():
    for angle in (30.0, 210.0, 300.0, 660.0):
        svg = wear_diagram(np.ones(12), np.arange(12) * 30.0, angle)
        assert f"{angle % 360:.0f}°" in texts(svg)


def test_bad_sums_are_refused():
    with pytest.raises(ValueError, match="лучах"):
        wear_diagram([1, 2, 3], [0, 90], 0)
    with pytest.raises(ValueError, match="отрицательна"):
        wear_diagram([1, -2, 3], [0, 120, 240], 0)
    with pytest.raises(ValueError, match="не число"):
        wear_diagram([1, 2, math.nan], [0, 120, 240], 0)
