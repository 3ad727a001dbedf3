"""Microsoft's schema validator on finished workbooks and Word files, where node is present."""

from __future__ import annotations

import io
import json
import re
import shutil
import subprocess
import zipfile
from collections.abc import Mapping
from pathlib import Path

import pytest
from lxml import etree

from tests.conftest import missing
from tests.cover import ALL
from tests.grading.forms import rewritten
from tests.word.docx_samples import docx_of, styled
from tests.workbook.made import coarse_book

VALIDATOR = "@ooxml-tools/validate@0.4.6"


def validator() -> Path:
    """The validator's module; a skip where it cannot be fetched."""
    npx = shutil.which("npx")
    if npx is None:
        missing("node", "nodejs npm")
    actual = subprocess.run(
        [npx, "--yes", "-p", VALIDATOR, "-c", "command -v ooxml-validate"],
        capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    if actual.returncode:
        pytest.skip("пакет проверки схемой недоступен")
    return Path(actual.stdout.strip()).resolve().parents[1] / "index.js"


def validated(files: Mapping[str, bytes], folder: Path) -> dict[str, list[str]]:
    """What the validator says of each file."""
    for name, data in files.items():
        (folder / name).write_bytes(data)
    program = Path(__file__).with_name("validated.mjs")
    # WebAssembly is compiled once and quickly: its life is too short for a better code.
    done = subprocess.run(
        ["node", "--liftoff-only", str(program), str(validator()), *files],
        capture_output=True, text=True, timeout=600, check=False, cwd=folder,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-3000:]
    message = json.loads(done.stdout.splitlines()[-1])
    return {name: [fault["description"] for fault in message[name]] for name in files}


# What repeats: rows of sheets and of Word's tables, points of charts.
_REPEATING = {"sheetData": "row", "numCache": "pt", "strCache": "pt", "tbl": "tr"}
_OWN = re.compile(rb' (r|idx|spans|[a-z0-9]*:?rsid\w*)="[^"]*"|(?<=>)[^<]+(?=<)')


def thinned(data: bytes) -> bytes:
    """The file with one row or point of each form: the others say nothing new to a schema."""
    built = io.BytesIO()
    forms: set[tuple[str, bytes]] = set()
    with (
        zipfile.ZipFile(io.BytesIO(data)) as given,
        zipfile.ZipFile(built, "w", zipfile.ZIP_DEFLATED) as parts,
    ):
        for name in given.namelist():
            part = given.read(name)
            if name.endswith(".xml"):
                root = etree.fromstring(part)
                for outer, inner in _REPEATING.items():
                    for position in root.iter(f"{{*}}{outer}"):
                        for child in position.findall(f"{{*}}{inner}"):
                            form = outer, _OWN.sub(b"", etree.tostring(child, with_tail=False))
                            if form in forms:
                                position.remove(child)
                            forms.add(form)
                part = etree.tostring(root, xml_declaration=True, encoding="UTF-8", standalone=True)
            parts.writestr(name, part)
    return built.getvalue()


def test_one_row_of_each_form_stays() -> None:
    def sheet(book: bytes, name: str) -> str:
        return zipfile.ZipFile(io.BytesIO(book)).read(name).decode()

    rows = (
        '<row r="1"><c r="A1" s="1"><v>1</v></c></row>',
        '<row r="2"><c r="A2" s="1"><v>2</v></c></row>',
        '<row r="3"><c r="A3" s="2"><v>3</v></c></row>',
        '<row r="4"><c r="A4" bad=""><v>4</v></c></row>',
    )
    book = io.BytesIO()
    with zipfile.ZipFile(book, "w") as parts:
        parts.writestr("a.xml", f"<sheetData>{''.join(rows)}</sheetData>")
        parts.writestr("b.xml", f"<sheetData>{rows[0]}</sheetData>")
        parts.writestr("c.xml", f"<sheetData>{rows[0]}</sheetData>".replace("sheetData", "other"))
    left = thinned(book.getvalue())
    assert [f'r="{n}"' in sheet(left, "a.xml") for n in range(1, 5)] == [True, False, True, True]
    # What a sheet has shown says nothing new in another; what is no row of a sheet stays.
    assert ['r="1"' in sheet(left, name) for name in ("b.xml", "c.xml")] == [False, True]


def spoilt(data: bytes) -> bytes:
    """A Word file with an element that the schema has not at the end of its text."""
    bad = b"<w:wrong/></w:body>"
    return rewritten(data, lambda name, part: part.replace(b"</w:body>", bad))


def test_the_schema_validator_finds_nothing(tmp_path: Path) -> None:
    """All files in one start of the validator, which takes as long as a file.

    What has been put in is found, and nothing else.
    """
    engine = "cycle-turbo-diesel"
    files = {
        "book.xlsx": coarse_book("d-240"),
        "framed.docx": spoilt(styled(engine, frame="eskd", numbering="chapter")),
    }
    if ALL:  # what the framed one holds and nothing else
        files["note.docx"] = docx_of(engine)
    lines = validated({name: thinned(data) for name, data in files.items()}, tmp_path)
    (fault,) = lines.pop("framed.docx")
    assert "wrong" in fault
    assert lines == {name: [] for name in files if name != "framed.docx"}
