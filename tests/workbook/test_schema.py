"""Microsoft's schema validator on finished workbooks, where node is present."""

from __future__ import annotations

import io
import re
import shutil
import subprocess
import zipfile
from functools import cache
from pathlib import Path

import pytest
from lxml import etree

from tests.conftest import missing
from tests.workbook.made import coarse_book

VALIDATOR = "@ooxml-tools/validate@0.4.6"


@cache
def validator() -> str:
    """Path of the validator; a skip where it cannot be fetched."""
    npx = shutil.which("npx")
    if npx is None:
        missing("node", "nodejs npm")
    found = subprocess.run(
        [npx, "--yes", "-p", VALIDATOR, "-c", "command -v ooxml-validate"],
        capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    if found.returncode:
        pytest.skip("пакет проверки схемой недоступен")
    return found.stdout.strip()


def validated(path: Path) -> str:
    """What the validator says of a file."""
    done = subprocess.run(
        [validator(), str(path), "-f", path.suffix[1:], "--office-version", "Microsoft365"],
        capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    return (done.stdout + done.stderr)[-3000:]


# What repeats: rows of sheets and of Word's tables, points of charts.
_REPEATING = ("sheetData", "numCache", "strCache", "tbl")
_OWN = re.compile(rb' (r|idx|spans|[a-z0-9]*:?rsid\w*)="[^"]*"|(?<=>)[^<]+(?=<)')


def thinned(data: bytes) -> bytes:
    """The file with one row or point of each form: the others say nothing new to a schema."""
    made = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(data)) as given,
        zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as parts,
    ):
        for name in given.namelist():
            part = given.read(name)
            if name.endswith(".xml"):
                root = etree.fromstring(part)
                for place in root.iter(*(f"{{*}}{tag}" for tag in _REPEATING)):
                    forms: set[bytes] = set()
                    for child in list(place):
                        form = _OWN.sub(b"", etree.tostring(child, with_tail=False))
                        if form in forms:
                            place.remove(child)
                        forms.add(form)
                part = etree.tostring(root, xml_declaration=True, encoding="UTF-8", standalone=True)
            parts.writestr(name, part)
    return made.getvalue()


def test_one_row_of_each_form_stays() -> None:
    def sheet(book: bytes) -> str:
        return zipfile.ZipFile(io.BytesIO(book)).read("a.xml").decode()

    rows = (
        '<row r="1"><c r="A1" s="1"><v>1</v></c></row>',
        '<row r="2"><c r="A2" s="1"><v>2</v></c></row>',
        '<row r="3"><c r="A3" s="2"><v>3</v></c></row>',
        '<row r="4"><c r="A4" bad=""><v>4</v></c></row>',
    )
    book = io.BytesIO()
    with zipfile.ZipFile(book, "w") as parts:
        parts.writestr("a.xml", f"<sheetData>{''.join(rows)}</sheetData>")
    left = sheet(thinned(book.getvalue()))
    assert [f'r="{n}"' in left for n in range(1, 5)] == [True, False, True, True]


def test_the_schema_validator_finds_nothing(tmp_path: Path) -> None:
    path = tmp_path / "book.xlsx"
    path.write_bytes(thinned(coarse_book("d-240")))
    assert "Found 0 errors" in validated(path)
