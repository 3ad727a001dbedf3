"""Limits of the keys fit each other: engines at the corners of the catalogue are allowed."""

from __future__ import annotations

import re

import pytest

from reports.inputs.load import load_text
from reports.new.generate import file_text, generate_engine

CORNERS = [
    (bore, stroke, cylinders, strokes, kind)
    for bore in (10.0, 960.0, 1000.0)
    for stroke in (1.0, 2.6)
    for cylinders, strokes, kind in ((1, 2, "petrol"), (12, 4, "petrol"), (6, 2, "diesel"))
]


def corner(bore, stroke, cylinders, strokes, kind):
    sizes = {"bore_mm": bore, "stroke_mm": bore * stroke}
    return file_text(generate_engine(cylinders, strokes=strokes, kind=kind, **sizes))


@pytest.mark.parametrize("case", CORNERS)
def test_an_engine_of_the_least_and_of_the_largest_size_is_allowed(case):
    load_text(corner(*case), source="corner.toml")


def test_a_crosshead_engine_has_its_masses():
    """960 × 2,500 mm: what goes to and fro weighs some ten tonnes."""
    text = corner(960.0, 2500 / 960, 6, 2, "diesel")
    for key, kilograms in (("piston_group_kg", 9800), ("rod_kg", 11200), ("pin_mass_kg", 7400)):
        text, count = re.subn(rf"(?m)^{key} = [\d.]+", f"{key} = {kilograms}", text)
        assert count == 1
    text, count = re.subn(r"(?m)^(mass_kg|counterweight_kg) = [\d.]+", r"\1 = 12500", text)
    assert count == 24
    load_text(text, source="crosshead.toml")
