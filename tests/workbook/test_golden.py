"""Workbooks compared part by part with stored ones, and saved by LibreOffice without loss."""

from __future__ import annotations

import io
import re
import zipfile
from pathlib import Path

import pytest
from openpyxl import load_workbook

from reports.inputs.fields import to_mapping
from reports.workbook.caches import sheet_parts
from reports.workbook.read import load_workbook_input
from tests.layouts import layout_input
from tests.workbook import golden
from tests.workbook.lint import LITERAL
from tools.referees.by_libreoffice import LibreOffice

NAME = "basic"


@pytest.mark.parametrize("name", golden.BOOKS)
def test_every_part_is_the_stored_one(name: str) -> None:
    actual = golden.differences(golden.stored(name), golden.describe(golden.book(name)))
    assert not actual, golden.report(actual)


def test_the_stored_texts_are_small() -> None:
    stored = sorted(path.name for path in golden.FOLDER.iterdir())
    assert stored == sorted(f"{name}.txt.xz" for name in golden.BOOKS)
    assert sum(path.stat().st_size for path in golden.FOLDER.iterdir()) < 300_000


def content(part: str) -> bytes:
    with zipfile.ZipFile(io.BytesIO(golden.book(NAME))) as archive:
        return archive.read(part)


def test_a_changed_formula_is_named_with_its_cell() -> None:
    with zipfile.ZipFile(io.BytesIO(golden.book(NAME))) as archive:
        part = sheet_parts(archive)["П4.1"]
    old = content(part)
    assert old.count(b"<f>B6+C6</f>") == 1
    new = old.replace(b"<f>B6+C6</f>", b"<f>B6-C6</f>")
    actual = golden.differences({part: golden.lines_of(part, old)},
                               {part: golden.lines_of(part, new)})  # fmt: skip
    assert [line.partition(" ")[0] for line in actual[part][3:] if line[0] in "+-"] == [
        "-D6:30", "+D6", "+D7:30",
    ]  # fmt: skip
    assert actual[part][4].endswith("=B{+0}+C{+0}")
    assert actual[part][5].endswith("=B{+0}-C{+0}")
    report = golden.report(actual)
    assert part in report
    assert "--renew" in report


@pytest.mark.parametrize(
    ("part", "old", "new", "differs"),
    [
        ("docProps/core.xml", b"2006-", b"2026-", False),
        ("docProps/core.xml", b"<dc:creator", b'<dc:creator more="1"', True),
        ("xl/charts/chart2.xml", b'<pt idx="0"><v>', b'<pt idx="0"><v>9', False),
        ("xl/charts/chart2.xml", b'delete val="0"', b'delete val="1"', True),
        ("xl/styles.xml", b"<fonts", b'<fonts more="1"', True),
        ("xl/theme/theme1.xml", b"Office", b"office", True),
        ("[Content_Types].xml", b"<Default", b'<Default more="1"', True),
    ],
)
def test_what_matters_and_what_is_ignored(part: str, old: bytes, new: bytes, differs: bool) -> None:
    data = content(part)
    assert old in data
    changed = golden.lines_of(part, data.replace(old, new, 1))
    assert (changed != golden.lines_of(part, data)) == differs


def test_parts_that_come_and_go_are_named() -> None:
    assert golden.differences({"a": ["1"]}, {"b": ["1"]}) == {
        "a": ["the part has gone"], "b": ["the part is new"],
    }  # fmt: skip


@pytest.mark.parametrize(
    ("formula", "row", "text"),
    [
        ("B7-$C6*D$5+$E$4", 6, "B{+1}-$C{+0}*D$5+$E$4"),
        ("'П4.1'!A12+LN(2)+r_1", 6, "'П4.1'!A{+6}+LN(2)+r_1"),
        ('IF(A6="A6",M2_Nm,1E-07)', 6, 'IF(A{+0}="A6",M2_Nm,1E-07)'),
    ],
)
def test_formulas_with_rows_counted_from_their_own(formula: str, row: int, text: str) -> None:
    assert golden.relative(formula, row) == text


def formulas(data: bytes) -> dict[tuple[str, str], str]:
    """Sheet and cell → formula without the freedoms of writing it."""
    return {
        (sheet.title, cell.coordinate): plain(cell.value)
        for sheet in load_workbook(io.BytesIO(data)).worksheets
        for line in sheet.iter_rows()
        for cell in line
        if cell.data_type == "f"
    }


def plain(formula: str) -> str:
    """Sheet names without quotes, numbers in one notation."""
    pieces = re.split(r'("[^"]*")', re.sub(r"'([^']+)'!", r"\1!", formula))
    return "".join(
        piece if index % 2 else LITERAL.sub(lambda match: repr(float(match[0])), piece)
        for index, piece in enumerate(pieces)
    )


@pytest.mark.libreoffice
def test_saved_by_libreoffice_nothing_is_lost(tmp_path: Path, libreoffice: LibreOffice) -> None:
    """Every formula comes back as it was, and the input cells read the same."""
    (saved,) = libreoffice.converted([golden.book(NAME)])
    before, after = formulas(golden.book(NAME)), formulas(saved)
    assert len(before) > 10_000
    assert set(before) == set(after)
    assert [(key, text, after[key]) for key, text in before.items() if text != after[key]] == []
    path = tmp_path / "saved.xlsx"
    path.write_bytes(saved)
    expected = layout_input(NAME, step_deg=golden.STEP)
    assert to_mapping(load_workbook_input(path).model) == to_mapping(expected)
