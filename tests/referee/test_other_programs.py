"""Programs that people open books with besides Excel and LibreOffice: nothing is lost there."""

from __future__ import annotations

import io
import shutil
import subprocess
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import pytest
from openpyxl import load_workbook

from reports.inputs.fields import iter_fields, to_mapping
from reports.workbook.layout import INPUT_SHEET, Layout
from reports.workbook.read import load_workbook_input
from tests.conftest import missing
from tests.cover import ALL
from tests.referee.changes import Change, with_values, without_charts
from tests.referee.compare import errors_in, near_enough, same_text
from tests.workbook.made import MOVING, coarse, coarse_book, coarse_model, drawn
from tools.referees.by_gnumeric import COMMAND, Gnumeric
from tools.referees.by_hyperformula import PACKAGE, HyperFormula
from tools.referees.by_libreoffice import LibreOffice
from tools.referees.cells import Book, cached_values

SAMPLES = ("gots-diesel", "yamz-236", "ecoboost-10") if ALL else ("yamz-236",)
EDITS = {"geometry_rod_length_mm": 121.5, "regime_speed_rpm": 5250.0}
Saved = Callable[[bytes, Sequence[Change]], bytes]
_NEAR = 1e-7  # a power's last digits, in a difference of nearly equal numbers


@pytest.fixture(scope="session")
def gnumeric() -> Gnumeric:
    """The third referee."""
    if shutil.which(COMMAND) is None:
        missing("Gnumeric", "gnumeric")
    return Gnumeric()


@pytest.fixture(scope="session")
def hyperformula(tmp_path_factory: pytest.TempPathFactory) -> HyperFormula:
    """The fourth referee; a skip where its package cannot be fetched."""
    npm = shutil.which("npm")
    if npm is None:
        missing("node", "nodejs npm")
    folder = tmp_path_factory.mktemp("hyperformula")
    done = subprocess.run(
        [npm, "install", "--silent", "--no-audit", "--prefix", str(folder), PACKAGE],
        capture_output=True, timeout=300, check=False,
    )  # fmt: skip
    if done.returncode:
        pytest.skip("пакет HyperFormula недоступен")
    return HyperFormula(Path(folder, "node_modules", "hyperformula"))


def differing(book: bytes, actual: Book) -> list[str]:
    return [
        f"{sheet}!{at}: {value!r}, {actual[sheet][at]!r}"
        for sheet, cells in cached_values(book).items()
        for near in [near_enough(sheet, cells)]
        for at, value in cells.items()
        if not (
            abs(value - actual[sheet][at]) <= near.get(at, _NEAR * max(1, abs(value)))
            if isinstance(value, float)
            else same_text(value, actual[sheet][at], sheet, at)
        )
    ]


@pytest.mark.parametrize("name", SAMPLES)
def test_gnumeric_recalculates_and_draws(name: str, gnumeric: Gnumeric) -> None:
    book = coarse_book(name)
    (actual,) = gnumeric.recalculate([book])
    assert errors_in(actual) == []
    assert differing(book, actual) == []
    charts, curves, links = gnumeric.drawn(book)
    specs = drawn(coarse_model(name))
    assert charts == len(specs) + MOVING
    assert curves > sum(len(spec.drawn_by("workbook")) for spec in specs)
    assert links >= {f"{_quoted(sheet)}!A1" for sheet in coarse_model(name).sheets}


def _quoted(sheet: str) -> str:
    """A sheet's title as Gnumeric writes it."""
    plain = all(c.isalnum() or c in "_." for c in sheet) and not sheet[0].isdigit()
    return sheet if plain else f"'{sheet}'"


@pytest.mark.parametrize("name", SAMPLES)
def test_hyperformula_recalculates(name: str, hyperformula: HyperFormula) -> None:
    book = coarse_book(name)
    (actual,) = hyperformula.recalculate([book])
    assert errors_in(actual) == []
    assert differing(book, actual) == []


def saved_by_openpyxl(book: bytes, changes: Sequence[Change]) -> bytes:
    opened, stream = load_workbook(io.BytesIO(book)), io.BytesIO()
    for sheet, at, value in typed(changes):
        opened[sheet][at].value = value
    opened.save(stream)
    return stream.getvalue()


def saved_by_gnumeric(book: bytes, changes: Sequence[Change]) -> bytes:
    """Its command types into the first sheet only: that of the inputs is put there."""
    own, stream = Gnumeric(), io.BytesIO()
    opened = load_workbook(io.BytesIO(book), rich_text=True)
    opened.move_sheet(INPUT_SHEET, -opened.sheetnames.index(INPUT_SHEET))
    opened.save(stream)
    return own.edited(stream.getvalue(), {at: value for _, at, value in typed(changes)})


def saved_by_libreoffice(book: bytes, changes: Sequence[Change]) -> bytes:
    """What is typed into it the tests of the first edit type."""
    return LibreOffice().converted([saved_by_openpyxl(book, changes)])[0]


def typed(changes: Sequence[Change]) -> Iterator[tuple[str, str, float]]:
    cells = Layout.of(coarse_model(EDITED)).cells
    for change in changes:
        cell = cells[change.field.name]
        yield cell.sheet, cell.coordinate, float(change.value)


EDITED = "two-stroke"


@pytest.mark.libreoffice
@pytest.mark.usefixtures("gnumeric", "libreoffice")
@pytest.mark.parametrize("saved", [saved_by_openpyxl, saved_by_gnumeric, saved_by_libreoffice])
def test_a_book_edited_and_saved_is_built_as_its_input_is(saved: Saved, tmp_path: Path) -> None:
    """Then all numbers are the same: they follow from the input alone."""
    data = coarse(EDITED)
    fields = {field.name: field for field in iter_fields(data)}
    changes = [Change(fields[key], value) for key, value in EDITS.items()]
    path = tmp_path / "edited.xlsx"
    path.write_bytes(saved(without_charts(coarse_book(EDITED)), changes))
    wanted = with_values(data, changes)
    assert to_mapping(load_workbook_input(path).model) == to_mapping(wanted)
    assert to_mapping(wanted) != to_mapping(data)
