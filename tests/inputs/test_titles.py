"""A title is stated once: what the tables name is not named a second time beside them."""

from __future__ import annotations

import ast
import importlib
import inspect
import pkgutil
from pathlib import Path
from types import ModuleType

import pytest

from kshm import nomenclature
from kshm.nomenclature import dizdn_listing
from kshm.nomenclature.quantity import UNITS
from reports.inputs import sections
from reports.inputs.units import MPA

SUBJECTS = [
    importlib.import_module(f"{nomenclature.__name__}.{found.name}")
    for found in pkgutil.iter_modules(nomenclature.__path__)
]
TITLES = {row[4] for subject in SUBJECTS for row in getattr(subject, "ROWS", ()) if row[4]}
# Of other things: the pressure ratio of the compressor, a place on the shaft that may be chosen.
ALIKE = {"степень повышения давления", "шатунная шейка"}


def texts(file: Path) -> set[str]:
    """Texts of a module, in small letters."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    found = [node.value for node in ast.walk(tree) if isinstance(node, ast.Constant)]
    return {text.lower() for text in found if isinstance(text, str)}


@pytest.mark.parametrize("place", [sections, dizdn_listing], ids=["sections", "listing"])
def test_a_title_of_the_tables_stands_there_alone(place: ModuleType) -> None:
    file = Path(inspect.getfile(place))
    files = sorted(file.parent.glob("*.py")) if file.stem == "__init__" else [file]
    assert "максимальное давление цикла" in TITLES
    assert {text for one in files for text in texts(one) & TITLES} <= ALIKE


def test_the_size_of_a_megapascal_is_that_of_the_tables() -> None:
    assert (MPA.times, MPA.over, MPA.label) == (UNITS["MPa"].si, 1.0, UNITS["MPa"].label)
