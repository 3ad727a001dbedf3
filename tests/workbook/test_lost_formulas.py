"""A number typed over a formula is named by its address, and nothing else is."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest
from lxml import etree
from openpyxl.utils.cell import coordinate_to_tuple

from reports.exports.build import load_input
from reports.shared.errors import Problem
from reports.workbook.caches import sheet_parts
from reports.workbook.lost_formulas import is_shifted
from reports.workbook.write import formula_places
from tests.workbook.made import coarse_book, coarse_model
from tools.referees.by_libreoffice import LibreOffice

SHEET = "П4.1"
CELL = re.compile(r'<c r="([A-Z]+)(\d+)"([^>]*)>(<f[^>]*/>|<f[^>]*>[^<]*</f>)?<v>([^<]*)</v></c>')
Change = Callable[[re.Match[str]], str]


def changed(tmp_path: Path, change: Change | None, title: str = SHEET) -> Path:
    """The book with cells of a sheet written anew."""
    path = tmp_path / "book.xlsx"
    with zipfile.ZipFile(io.BytesIO(coarse_book())) as old, zipfile.ZipFile(path, "w") as new:
        part = sheet_parts(old)[title]
        for name in old.namelist():
            data = old.read(name)
            if name == part and change:
                data = CELL.sub(change, data.decode()).encode()
            new.writestr(name, data)
    return path


def named(path: Path) -> list[str]:
    """Sheets and addresses of the warnings about formulas."""
    lost = [each for each in load_input(path).warnings if "вместо формулы" in each.what]
    assert all(isinstance(each, Problem) for each in lost)
    return [each.where.partition(", ")[2] for each in lost]


def typed(*addresses: str) -> Change:
    def change(cell: re.Match[str]) -> str:
        if cell[1] + cell[2] not in addresses:
            return cell[0]
        assert cell[4]
        return f'<c r="{cell[1]}{cell[2]}"{cell[3]}><v>55</v></c>'

    return change


@pytest.mark.parametrize("name", ["gots-diesel", "vaz-2106", "cycle-turbo-petrol"])
def test_places_of_formulas_are_those_of_the_file(name: str) -> None:
    places: dict[str, set[tuple[int, int]]] = {}
    with zipfile.ZipFile(io.BytesIO(coarse_book(name))) as archive:
        for title, part in sheet_parts(archive).items():
            cells = etree.fromstring(archive.read(part)).iter("{*}c")
            places[title] = {
                coordinate_to_tuple(cell.get("r"))
                for cell in cells
                if cell.find("{*}f") is not None
            }
    assert formula_places(coarse_model(name)) == places
    assert sum(map(len, places.values())) > 1000


def test_an_untouched_book_has_none(tmp_path: Path) -> None:
    assert named(changed(tmp_path, None)) == []


@pytest.mark.parametrize(
    ("addresses", "words"),
    [
        (["C10"], "П4.1!C10"),
        (["C6", "D10"], "П4.1!C6, D10"),
        (
            ["C10", "D10", "E10", "F10", "G10", "H10", "I10"],
            "П4.1!C10, D10, E10, F10, G10 и ещё 2",
        ),
    ],
)
def test_what_is_typed_over_is_named(tmp_path: Path, addresses: list[str], words: str) -> None:
    assert named(changed(tmp_path, typed(*addresses))) == [words]


def test_a_value_of_a_list_is_named(tmp_path: Path) -> None:
    assert named(changed(tmp_path, typed("C6"), "Итоги")) == ["Итоги!C6"]


def test_a_row_put_in_names_nothing(tmp_path: Path) -> None:
    def lower(cell: re.Match[str]) -> str:
        row = int(cell[2]) + 1
        return cell[0].replace(f'r="{cell[1]}{cell[2]}"', f'r="{cell[1]}{row}"')

    assert named(changed(tmp_path, lower)) == []


def test_formulas_of_the_persons_own_hide_nothing() -> None:
    table = {(row, column) for row in range(6, 30) for column in range(2, 9)}
    own = {(row, 12) for row in range(6, 30)}
    assert not is_shifted(table, table - {(10, 3)} | own)
    assert is_shifted(table, {(row, column + 1) for row, column in table})


def test_libreoffice_loses_none(tmp_path: Path, libreoffice: LibreOffice) -> None:
    path = tmp_path / "saved.xlsx"
    path.write_bytes(libreoffice.converted([coarse_book()])[0])
    assert named(path) == []


def test_another_structure_names_nothing(tmp_path: Path) -> None:
    """Its tables have more rows than those of the book."""

    def finer(cell: re.Match[str]) -> str:
        return cell[0].replace("<v>30</v>", "<v>10</v>") if cell[1] == "C" else cell[0]

    path = changed(tmp_path, finer, "Исходные данные")
    assert load_input(path).model.calculation.step_deg == 10
    assert named(path) == []
