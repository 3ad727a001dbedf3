"""Workbooks recalculated by two engines against their caches and against the solver."""

from __future__ import annotations

import io
import random
import zipfile
from functools import cache

import pytest

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from reports.recalculation.by_formualizer import Formualizer
from reports.recalculation.by_libreoffice import LibreOffice
from reports.recalculation.protocol import formula_cells
from reports.spec.blocks import Model
from reports.tables.registry import build_model
from reports.workbook.caches import sheet_parts
from reports.workbook.write import workbook_bytes
from tests.conftest import sample, sample_names
from tests.layouts import MAKERS as LAYOUTS
from tests.layouts import made
from tests.referee.changes import random_change, type_into, without_charts
from tests.referee.compare import (
    differences_from_caches,
    differences_from_solver,
    errors_in,
)

CHANGES = 20
OTHERS = 2  # LibreOffice needs a second or more for each book
# Samples of the other layouts, on a coarse grid: the same formulas in fewer rows.
COARSE = {"d-260", "ecoboost-10", "two-stroke", "vw-1600", "yamz-236", "yamz-238"}
LARGE = COARSE | {"gots-regimes"}
FEW = 4


def grid_of(name: str) -> InputFile:
    """A sample on its own grid or on the coarse one."""
    raw = to_mapping(sample(name))
    if name in COARSE:
        raw["calculation"]["step_deg"] = 30
    return load_mapping(raw, source=name).model


@cache
def book_of(name: str) -> bytes:
    return workbook_bytes(build_model(grid_of(name)))


def check(name: str, book: bytes, recalculated: dict) -> None:
    check_model(build_model(grid_of(name)), book, recalculated)


def check_model(model: Model, book: bytes, recalculated: dict) -> None:
    assert errors_in(recalculated) == []
    assert differences_from_caches(book, recalculated) == []
    compared, wrong = differences_from_solver(model, recalculated)
    assert wrong == []
    assert compared > 1000


@pytest.mark.parametrize("name", sample_names())
def test_formualizer_agrees(name: str) -> None:
    check(name, book_of(name), Formualizer().recalculate([book_of(name)])[0])


@pytest.mark.parametrize("name", LAYOUTS)
def test_formualizer_agrees_on_every_layout(name: str) -> None:
    model = build_model(made(name, step_deg=30))
    book = workbook_bytes(model)
    check_model(model, book, Formualizer().recalculate([book])[0])


@pytest.mark.libreoffice
def test_libreoffice_agrees_on_layouts_without_a_sample(libreoffice: LibreOffice) -> None:
    models = [build_model(made(name, step_deg=30)) for name in ("offset_articulated", "split")]
    own = [workbook_bytes(model) for model in models]
    for model, book, result in zip(models, own, libreoffice.recalculate(own), strict=True):
        check_model(model, book, result)


@pytest.mark.libreoffice
@pytest.mark.parametrize("half", [0, 1])
def test_libreoffice_agrees(libreoffice: LibreOffice, half: int) -> None:
    names = sample_names()[half::2]
    # Charts hold no formula and take a third of the time; one book keeps its own.
    own = [book_of(n) if n == "gots-diesel" else without_charts(book_of(n)) for n in names]
    for name, book, result in zip(names, own, libreoffice.recalculate(own), strict=True):
        check(name, book, result)


def changed_books(name: str, count: int = CHANGES) -> list[tuple]:
    """Random changes of a sample on a coarse grid: the same formulas in fewer rows."""
    raw = to_mapping(sample(name))
    raw["calculation"]["step_deg"] = 30
    coarse = load_mapping(raw, source=name).model
    book = without_charts(workbook_bytes(build_model(coarse)))  # no formula stands in them
    rng = random.Random(f"changes of {name}")
    changes = []
    for _ in range(count):
        change, data = random_change(coarse, rng)
        changes.append((change, data, type_into(book, coarse, change)))
    return changes


@pytest.mark.parametrize("name", sample_names())
def test_formualizer_follows_random_changes(name: str) -> None:
    for change, data, book in changed_books(name, FEW if name in LARGE else CHANGES):
        (result,) = Formualizer().recalculate([book])
        assert errors_in(result) == [], change
        compared, wrong = differences_from_solver(build_model(data), result)
        assert wrong == [], change
        assert compared > 1000


@pytest.mark.libreoffice
@pytest.mark.parametrize("which", ["textbook", "others"])
def test_libreoffice_follows_random_changes(libreoffice: LibreOffice, which: str) -> None:
    """All changes of the textbook's diesel, the first of every other sample."""
    made = []
    for name in sample_names():
        if (name == "gots-diesel") == (which == "textbook"):
            made += changed_books(name, CHANGES if which == "textbook" else OTHERS)
    results = libreoffice.recalculate([book for _, _, book in made])
    for (change, data, _), result in zip(made, results, strict=True):
        assert errors_in(result) == [], change
        assert differences_from_solver(build_model(data), result)[1] == [], change


def tampered(book: bytes, sheet: str, cell: str) -> bytes:
    """The workbook with one cached value replaced by a lie."""
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(book)) as source,
        zipfile.ZipFile(stream, "w") as target,
    ):
        part = sheet_parts(source)[sheet]
        for name in source.namelist():
            data = source.read(name)
            if name == part:
                before, found, after = data.partition(f'r="{cell}"'.encode())
                start = after.index(b"<v>") + 3
                after = after[:start] + b"123456.5" + after[after.index(b"</v>") :]
                data = before + found + after
            target.writestr(name, data)
    return stream.getvalue()


def test_formualizer_does_not_believe_a_tampered_cache() -> None:
    book = tampered(book_of("gots-diesel"), "П4.1", "H20")
    (result,) = Formualizer().recalculate([book])
    (difference,) = differences_from_caches(book, result)
    assert difference.startswith("П4.1!H20: cached 123456.5")


@pytest.mark.libreoffice
def test_libreoffice_does_not_believe_a_tampered_cache(libreoffice: LibreOffice) -> None:
    book = tampered(book_of("gots-diesel"), "П4.1", "H20")
    (result,) = libreoffice.recalculate([book])
    (difference,) = differences_from_caches(book, result)
    assert difference.startswith("П4.1!H20: cached 123456.5")


def test_size_of_the_textbook_diesel() -> None:
    """At least 8,000 formula cells and 25 charts at 10°."""
    book = book_of("gots-diesel")
    assert sum(len(cells) for cells in formula_cells(book).values()) >= 8000
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        charts = [name for name in archive.namelist() if name.startswith("xl/charts/chart")]
    assert len(charts) >= 25
