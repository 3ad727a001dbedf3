import math
import re
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from reports.document.figures.wear import wear_diagram
from tests.document.figure_samples import FIGURES, texts


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
