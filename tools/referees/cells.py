"""The formula cells of a workbook, their saved values, and the workbook without them."""

from __future__ import annotations

import io
import re
import zipfile
from xml.sax.saxutils import unescape

from reports.workbook.caches import sheet_parts

CellValue = float | str | bool | None
Book = dict[str, dict[str, CellValue]]  # sheet → coordinate → value

_PICTURES = ("xl/charts/", "xl/drawings/", "xl/comments")
# Where sheets, their relationships and the list of contents name them; where pages break, which
# takes LibreOffice an eighth of its time.
_NAMED = re.compile(
    rb"<(?:legacyDrawing|drawing) [^>]*/>"
    rb'|<definedName [^>]*name="_xlnm\.Print_[^>]*>[^<]*</definedName>'
    rb'|<(?:Relationship|Override) [^>]*"/?(?:xl|\.\.)/(?:charts|drawings|comments)[^>]*/>'
)
# A formula cell as text: a tree of tens of thousands of elements takes five times as long.
_CELL = re.compile(
    rb'(<c r="([A-Z]+[0-9]+)"(?: (?!t=)[^ >]+)*)(?: t="(\w+)")?([^>]*>)'  # address, type
    rb"(<f(?: [^>]*)?(?:/>|>[^<]*</f>))(<v ?/>|<v>[^<]*</v>)?"  # formula, value
)
_ANY_FORMULA = re.compile(rb"<f[ />]")
_QUOTES = {"&quot;": '"', "&apos;": "'"}


def formula_cells(book: bytes) -> dict[str, list[str]]:
    """Sheet title → coordinates of its formula cells."""
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        return {
            title: [at for at, _, _ in _formulas(archive.read(part))]
            for title, part in sheet_parts(archive).items()
        }


def cached_values(book: bytes) -> Book:
    """Return cached values of all formula cells."""
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        return {
            title: {at: _cached(kind, value) for at, kind, value in _formulas(archive.read(part))}
            for title, part in sheet_parts(archive).items()
        }


def stripped(book: bytes) -> tuple[bytes, dict[str, list[str]]]:
    """Return the workbook without cached values, and its formula cells by sheet."""
    result = io.BytesIO()
    collected: dict[str, list[str]] = {}
    with (
        zipfile.ZipFile(io.BytesIO(book)) as source,
        zipfile.ZipFile(result, "w") as target,  # read at once: not worth compressing
    ):
        titles = {part: title for title, part in sheet_parts(source).items()}
        for name in source.namelist():
            data = source.read(name)
            if name in titles:
                collected[titles[name]] = [at for at, _, _ in _formulas(data)]
                data = _CELL.sub(rb"\1\4\5", data)
            target.writestr(name, data)
    return result.getvalue(), {title: collected[title] for title in titles.values()}


def _formulas(data: bytes) -> list[tuple[str, bytes, bytes]]:
    """Address, type and value of a sheet's formula cells; none is passed over.

    Raises:
        ValueError: a formula cell is written in another way.
    """
    matches = _CELL.findall(data)
    if b"<sheetData" not in data or len(matches) != len(_ANY_FORMULA.findall(data)):
        msg = "a sheet whose formula cells are not written as spreadsheet programs write them"
        raise ValueError(msg)
    return [(at.decode(), kind, value) for _, at, kind, _, _, value in matches]


def _cached(kind: bytes, value: bytes) -> CellValue:
    text = unescape(value[len("<v>") : -len("</v>")].decode(), _QUOTES)
    if kind in (b"str", b"e"):
        return text if value else None
    return float(text) if text else None


def without_pictures(book: bytes) -> bytes:
    """The workbook without charts, notes and what is printed: nothing is calculated from them."""
    result = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(book)) as source, zipfile.ZipFile(result, "w") as target:
        for name in source.namelist():
            if not name.startswith(_PICTURES):
                target.writestr(name, _NAMED.sub(b"", source.read(name)))
    return result.getvalue()


def row_and_column(coordinate: str) -> tuple[int, int]:
    """Row and column numbers of an address such as ``AB12``."""
    match = re.fullmatch(r"([A-Z]{1,3})([1-9][0-9]{0,6})", coordinate)
    if match is None:
        msg = f"not a cell address: {coordinate}"
        raise ValueError(msg)
    column = 0
    for letter in match.group(1):
        column = column * 26 + ord(letter) - 64
    return int(match.group(2)), column
