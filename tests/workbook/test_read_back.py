"""A workbook edited by a person and built again."""

from __future__ import annotations

import io
import re
import zipfile
from functools import lru_cache
from pathlib import Path

import pytest
from openpyxl import Workbook, load_workbook

from reports.exports.build import load_input
from reports.inputs.fields import to_mapping
from reports.shared.errors import InputError
from reports.workbook.intake import check_data
from reports.workbook.layout import INPUT_SHEET, Layout
from reports.workbook.read import load_workbook_input
from tests.conftest import sample
from tests.workbook.made import book, coarse, coarse_book, coarse_model

OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"


@lru_cache(maxsize=1)
def opened_input_sheet() -> Workbook:
    """The book as a person's program opens it; sheets that no input stands on are left out."""
    opened = load_workbook(io.BytesIO(coarse_book()))
    for sheet in opened.sheetnames[2:]:
        del opened[sheet]
    return opened


def edited(tmp_path: Path, changes: dict[str, object]) -> Path:
    opened, layout = opened_input_sheet(), Layout.of(coarse_model())
    cells = {field: layout.cells[field] for field in changes}
    kept = {field: opened[cell.sheet][cell.coordinate].value for field, cell in cells.items()}
    for field, cell in cells.items():
        opened[cell.sheet][cell.coordinate].value = changes[field]
    path = tmp_path / "edited.xlsx"
    opened.save(path)
    for field, cell in cells.items():
        opened[cell.sheet][cell.coordinate].value = kept[field]
    return path


def test_an_untouched_workbook_gives_its_input_back(tmp_path: Path) -> None:
    """On its own grid; the samples on the coarse one: ``test_every_sample``."""
    path = tmp_path / "book.xlsx"
    path.write_bytes(book())
    assert to_mapping(load_workbook_input(path).model) == to_mapping(sample("gots-diesel"))


def test_edited_cells_are_read(tmp_path: Path) -> None:
    path = edited(
        tmp_path,
        {
            "masses_reciprocating_kg": 1.75,
            "regime_speed_rpm": 3000,
            "calculation_method": "точное ускорение",
            "web_3_counterweight_kg": 0.5,
        },
    )
    changed = load_workbook_input(path).model
    assert changed.masses.reciprocating_kg == 1.75
    assert changed.regime.speed_rpm == 3000
    assert changed.calculation.method == "exact"
    assert changed.crankshaft.webs[2].counterweight_kg == 0.5


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("geometry_bore_mm", -88),
        ("geometry_bore_mm", None),
        ("regime_speed_rpm", "быстро"),
        ("gas_max_pressure_mpa", 0.5),
        ("throw_angle_2_deg", 90),
    ],
)
def test_what_check_refuses_is_refused_with_sheet_and_cell(
    tmp_path: Path, field: str, value: object
) -> None:
    path = edited(tmp_path, {field: value})
    with pytest.raises(InputError) as caught:
        load_workbook_input(path)
    cell = Layout.of(coarse_model()).cells[field]
    assert f"{cell.sheet}!{cell.coordinate}" in "\n".join(caught.value.lines())
    assert all("\n" not in line for line in caught.value.lines())


def test_a_foreign_workbook_is_refused(tmp_path: Path) -> None:
    from openpyxl import Workbook

    path = tmp_path / "foreign.xlsx"
    Workbook().save(path)
    with pytest.raises(InputError, match="не книга, созданная"):
        load_workbook_input(path)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "файл пуст"),
        (b"Rar!\x1a\x07", "это архив RAR или 7z, а не книга"),
        (b"%PDF-1.4", "это документ PDF, а не книга"),
        (b"PK\x03\x04 broken", "повреждён"),
        (OLE + b"\0" * 100, "это старый или зашифрованный документ Office"),
        (OLE + "EncryptedPackage".encode("utf-16-le"), "книга закрыта паролем"),
        (OLE + "Workbook\0".encode("utf-16-le"), "книга в старом формате .xls"),
        (b"PK\x03\x04\x14\0\0\0word/document.xml", "это повреждённый документ Word, а не книга"),
        (b"[engine]\n", "не книга"),
    ],
)
def test_files_that_are_no_workbooks(tmp_path: Path, content: bytes, message: str) -> None:
    path = tmp_path / "x.xlsx"
    path.write_bytes(content)
    with pytest.raises(InputError, match=message):
        load_workbook_input(path)


def test_a_wrong_size_of_a_sheet_hides_nothing(tmp_path: Path) -> None:
    """Some programs write a size of their own or none."""
    path = tmp_path / "book.xlsx"
    with zipfile.ZipFile(io.BytesIO(coarse_book())) as source, zipfile.ZipFile(path, "w") as target:
        for name in source.namelist():
            content = source.read(name)
            target.writestr(
                name, re.sub(rb'<dimension ref="[^"]*"', b'<dimension ref="A1"', content)
            )
    assert to_mapping(load_workbook_input(path).model) == to_mapping(coarse("gots-diesel"))


def test_the_same_input_gives_the_same_bytes() -> None:
    from reports.workbook.write import workbook_bytes

    assert workbook_bytes(coarse_model()) == coarse_book()


def changed(tmp_path: Path, change) -> Path:
    """The book on the coarse grid as a person left it."""
    opened = load_workbook(io.BytesIO(coarse_book()))
    for sheet in opened.sheetnames[2:]:
        del opened[sheet]
    change(opened)
    path = tmp_path / "changed.xlsx"
    opened.save(path)
    return path


def test_a_renamed_sheet_of_inputs_is_found(tmp_path: Path) -> None:
    def rename(opened: Workbook) -> None:
        opened["Исходные данные"].title = "Мои данные"
        for defined in opened.defined_names.values():  # as every program does
            defined.attr_text = defined.attr_text.replace("Исходные данные", "Мои данные")

    loaded = load_workbook_input(changed(tmp_path, rename))
    assert to_mapping(loaded.model) == to_mapping(coarse_model().input)


@pytest.mark.parametrize(("said", "wrong"), [("см", True), (" ММ ", False), (None, False)])
def test_a_changed_unit_is_refused(tmp_path: Path, said: str | None, wrong: bool) -> None:
    at = Layout.of(coarse_model()).cells["geometry_bore_mm"]

    def write(opened: Workbook) -> None:
        opened[at.sheet].cell(at.row, at.column + 1).value = said

    path = changed(tmp_path, write)
    if not wrong:
        load_workbook_input(path)
        return
    with pytest.raises(InputError, match="единица «см» вместо «мм»") as error:
        load_workbook_input(path)
    assert f"{at.sheet}!{at.coordinate}" in str(error.value)


def test_words_of_lists_are_forgiving(tmp_path: Path) -> None:
    path = edited(tmp_path, {"calculation_method": "  Точное  ускорение "})
    assert load_workbook_input(path).model.calculation.method == "exact"


def test_a_book_of_libreoffice_says_what_to_do(tmp_path: Path) -> None:
    path = tmp_path / "book.ods"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mimetype", "application/vnd.oasis.opendocument.spreadsheet")
        archive.writestr("content.xml", "<x/>")
    with pytest.raises(InputError, match=r"\.ods.*Сохранить как"):
        load_input(path)


@pytest.mark.parametrize(
    ("typed", "value"),
    [("=80+10", 90.0), ("=2*44", 88.0), ("=(80 + 8)/1", 88.0), ("=-2*-44", 88.0)],
)
def test_a_yellow_cell_takes_arithmetic(tmp_path: Path, typed: str, value: float) -> None:
    path = edited(tmp_path, {"geometry_bore_mm": typed})
    assert load_workbook_input(path).model.geometry.bore_mm == value


@pytest.mark.parametrize("typed", ["=A1+2", "=SUM(80,8)", "=80+", "=88/0", "=8^2", '="88"'])
def test_any_other_formula_is_refused_in_words(tmp_path: Path, typed: str) -> None:
    with pytest.raises(InputError, match="стоит формула, а не число") as refused:
        load_workbook_input(edited(tmp_path, {"geometry_bore_mm": typed}))
    assert len(refused.value.problems) == 1


def test_a_lost_sheet_of_inputs_is_one_message(tmp_path: Path) -> None:
    opened = load_workbook(io.BytesIO(coarse_book()))
    del opened[INPUT_SHEET]
    path = tmp_path / "lost.xlsx"
    opened.save(path)
    with pytest.raises(InputError, match="нет листа исходных данных") as refused:
        load_workbook_input(path)
    assert len(refused.value.problems) == 1


_CONTENT = b"application/vnd.openxmlformats-officedocument.spreadsheetml.sheet.main+xml"


@pytest.mark.parametrize(
    ("parts", "said"),
    [
        ({"xl/workbook.xml": b'<workbook xmlns="http://purl.oclc.org/ooxml/spreadsheetml/main"/>'},
         "строгом формате Open XML; сохраните её как обычную"),
        ({"xl/workbook.bin": b"x"}, r"двоичная книга \.xlsb; .*сохраните как \.xlsx"),
        ({"Index/Document.iwa": b"x"}, "документ Numbers; выгрузите"),
        ({"[Content_Types].xml": b"<Types><Override ContentType='" + _CONTENT + b"'/></Types>",
          "book/main.xml": b"<x/>"}, "названы не так, как пишет Excel"),
        ({"content.xml": b"<x/>"}, r"книга \.ods"),
        ({"word/document.xml": b"<x/>"}, "архив или документ"),
    ],
)  # fmt: skip
def test_other_kinds_of_books_are_named_with_what_to_do(parts: dict[str, bytes], said: str) -> None:
    package = io.BytesIO()
    with zipfile.ZipFile(package, "w") as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    with pytest.raises(InputError, match=said):
        check_data(package.getvalue(), "книга.xlsx")
