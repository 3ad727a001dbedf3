"""Reports of small engines, made once for all tests."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path

from reports.document.page.render import render
from reports.document.report import Report
from reports.document.text.terms import Terms
from reports.inputs.load import load_text
from reports.model.evaluation import evaluate_model
from reports.shared.resources import samples_dir
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.kept import kept
from tests.workbook.made import book

# In the place of a figure that nobody looks at.
BOX = '<svg class="fig" viewBox="0 0 2 1" style="width:120.0mm" data-size="2/1"></svg>'
ONE = """
[report]
year = 2024
detail = "full"
[engine]
name = "Одноцилиндровый"
cylinders = 1
[calculation]
method = "exact"
step_deg = 30
wear_rays = 18
[geometry]
bore_mm = 80
stroke_mm = 75
lambda = 0.25
compression_ratio = 9.5
[regime]
speed_rpm = 3600
[gas]
source = "table"
points = [[0, 0.11], [180, 0.09], [300, 0.4], [360, 2.6], [375, 4.5], [450, 0.7], [540, 0.2],
          [560, 0.11], [720, 0.11]]
[masses]
piston_group_kg = 0.4
rod_kg = 0.6
rod_centre_mm = 110
[crankshaft]
firing_offsets_deg = [0]
throw_angles_deg = [0]
pin_diameter_mm = 40
pin_length_mm = 25
main_diameter_mm = 45
main_lengths_mm = [25, 25]
pin_mass_kg = 0.2
[[crankshaft.webs]]
mass_kg = 0.3
[[crankshaft.webs]]
mass_kg = 0.3
[[crankshaft.arms]]
l1_mm = 20
l2_mm = 20
l5_mm = 25
l6_mm = 20
"""


@lru_cache(maxsize=16)
def text_of(name: str) -> str:
    """Input of a sample on a coarse grid; ``one`` is a small engine of this file."""
    if name == "one":
        return ONE
    text = (samples_dir() / f"{name}.toml").read_text(encoding="utf-8")
    text = re.sub(r"^step_deg = \d+", "step_deg = 30", text, flags=re.MULTILINE)
    text = with_detail(text, "full")
    # «раздел 2.9» in the name would look like a number with a point
    return re.sub(r'^name = ".*"', 'name = "Двигатель"', text, flags=re.MULTILINE)


def with_detail(text: str, detail: str) -> str:
    """An input whose report has this profile."""
    text = re.sub(r"^detail = .*\n", "", text, flags=re.MULTILINE)
    head = f'[report]\ndetail = "{detail}"\n'
    return text.replace("[report]\n", head) if "[report]\n" in text else head + text


def terms_of(text: str) -> Terms:
    """Symbols and values of an input."""
    model = build_model(load_text(text, source="t.toml").model)
    return Terms(model, evaluate_model(model))


@lru_cache(maxsize=16)
def terms(name: str) -> Terms:
    """The same for a sample."""
    return terms_of(text_of(name))


@lru_cache(maxsize=16)
def print_page(name: str) -> str:
    """The page for the printer."""
    source = terms(name)
    return Report(source.model, source.values).page("print")


@kept
def pdf(name: str) -> bytes:
    """The finished PDF of a sample, without attachments and without a warning."""
    page = render(print_page(name))
    assert page.warnings == ()
    return page.pdf


@kept
def shipped_pdf(name: str) -> bytes:
    """The finished PDF of a sample as it is shipped, with its files."""
    model = build_model(sample(name))
    source = samples_dir() / f"{name}.toml"
    return Report.of(model, evaluate_model(model), source).pdf(source, book(name))


@lru_cache(maxsize=16)
def html_page(name: str) -> str:
    """The page for the screen."""
    source = terms(name)
    return Report.of(source.model, source.values, Path("t.toml")).page("screen")


def pdf_with_files(name: str, folder: Path) -> bytes:
    """What ``kshm build`` writes."""
    path = folder / f"{name}.toml"
    path.write_text(text_of(name), encoding="utf-8")
    source = terms(name)
    return Report.of(source.model, source.values, path).pdf(path, b"PK-book")
