"""Programs that people open books with besides Excel and LibreOffice: nothing is lost there."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.conftest import missing
from tests.cover import ALL
from tests.referee.compare import errors_in
from tests.workbook.made import MOVING, coarse_book, coarse_model, drawn
from tools.referees.by_gnumeric import COMMAND, Gnumeric
from tools.referees.by_hyperformula import PACKAGE, HyperFormula
from tools.referees.cells import Book, cached_values

SAMPLES = ("gots-diesel", "yamz-236", "ecoboost-10") if ALL else ("yamz-236",)
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


def differing(book: bytes, found: Book) -> list[str]:
    return [
        f"{sheet}!{at}: {value!r}, {found[sheet][at]!r}"
        for sheet, cells in cached_values(book).items()
        for at, value in cells.items()
        if not (
            abs(value - found[sheet][at]) <= _NEAR * max(1, abs(value))
            if isinstance(value, float)
            else found[sheet][at] == value
        )
    ]


@pytest.mark.parametrize("name", SAMPLES)
def test_gnumeric_recalculates_and_draws(name: str, gnumeric: Gnumeric) -> None:
    book = coarse_book(name)
    (found,) = gnumeric.recalculate([book])
    assert errors_in(found) == []
    assert differing(book, found) == []
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
    (found,) = hyperformula.recalculate([book])
    assert errors_in(found) == []
    assert differing(book, found) == []
