"""Titles stand once; the new file explains every key."""

from __future__ import annotations

import ast
import importlib
import inspect
import pkgutil
import tomllib
from datetime import UTC, datetime
from pathlib import Path
from types import ModuleType

import pytest

from kshm import nomenclature
from kshm.nomenclature import dizdn_listing
from kshm.nomenclature.quantity import UNITS
from reports.inputs import sections
from reports.inputs.load import load_text
from reports.inputs.meta import hints
from reports.inputs.registry import SECTIONS
from reports.inputs.template import list_samples, new_file
from reports.inputs.units import MPA
from reports.shared.errors import InputError
from reports.shared.resources import samples_dir

SUBJECTS = [
    importlib.import_module(f"{nomenclature.__name__}.{item.name}")
    for item in pkgutil.iter_modules(nomenclature.__path__)
]
TITLES = {row[3] for subject in SUBJECTS for row in getattr(subject, "ROWS", ()) if row[3]}
# Of other things: the pressure ratio of the compressor, a place on the shaft that may be chosen.
ALIKE = {"степень повышения давления", "шатунная шейка"}


def texts(file: Path) -> set[str]:
    """Texts of a module, in small letters."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    collected = [node.value for node in ast.walk(tree) if isinstance(node, ast.Constant)]
    return {text.lower() for text in collected if isinstance(text, str)}


@pytest.mark.parametrize("place", [sections, dizdn_listing], ids=["sections", "listing"])
def test_a_title_of_the_tables_stands_there_alone(place: ModuleType) -> None:
    file = Path(inspect.getfile(place))
    files = sorted(file.parent.glob("*.py")) if file.stem == "__init__" else [file]
    assert "максимальное давление цикла" in TITLES
    assert {text for one in files for text in texts(one) & TITLES} <= ALIKE


def test_the_size_of_a_megapascal_is_that_of_the_tables() -> None:
    assert (MPA.times, MPA.over, MPA.label) == (UNITS["MPa"].si, 1.0, UNITS["MPa"].label)


def test_samples():
    assert list_samples() == (
        "cycle-petrol",
        "cycle-tractor-diesel",
        "cycle-turbo-diesel",
        "cycle-turbo-petrol",
        "d-240",
        "d-240-bearings",
        "d-260",
        "ecoboost-10",
        "gots-appendix1",
        "gots-diesel",
        "gots-p3",
        "gots-p43",
        "gots-regimes",
        "mwm-6",
        "two-stroke",
        "vaz-2106",
        "vw-1600",
        "yamz-236",
        "yamz-238",
    )


def test_the_blank_file_explains_every_key():
    text = new_file()
    models = {name: section.model for name, section in SECTIONS.items()}
    for section in SECTIONS:
        for key in hints(models[section]):
            assert key in text
    assert "bore_mm = 88.0 # Диаметр цилиндра D; допустимо от 10 до 1500 мм" in text
    assert "# lambda = …" in text
    assert load_text(text, source="new").warnings == ()


@pytest.mark.parametrize("sample", list_samples())
def test_a_sample_keeps_its_comments_and_data(sample):
    text = new_file(sample)
    original = (samples_dir() / f"{sample}.toml").read_text(encoding="utf-8")
    comments = [line for line in original.splitlines() if "#" in line]
    assert [line for line in text.splitlines() if "#" in line] == comments
    new, old = tomllib.loads(text), tomllib.loads(original)
    assert new.pop("report")["year"] == datetime.now(tz=UTC).year
    del old["report"]
    assert new == old


def test_an_unknown_sample_is_refused():
    with pytest.raises(InputError) as caught:
        new_file("gots-disel")
    (line,) = caught.value.lines()
    assert "нет образца «gots-disel»; возможно, gots-diesel" in line


@pytest.mark.parametrize("name", ["../samples/gots-diesel", "/etc/passwd", "", "gots-diesel.toml"])
def test_a_path_is_no_sample(name):
    with pytest.raises(InputError, match="нет образца"):
        new_file(name)
