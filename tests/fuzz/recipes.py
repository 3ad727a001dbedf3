"""Short byte strings as recipes of changes to a workbook: what a fuzzer can mutate well.

A workbook is a zip: nearly every change of its bytes ends at the checksum.  A recipe changes
the parts before they are packed, so that the changes reach the parsers.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Mapping

TOKENS: tuple[bytes, ...] = tuple(
    text.encode()
    for text in (
        "", "0", "-0", "1", "-1", "7777", "1e999", "-1e308", "1e308", "5e-324", "nan", "inf",
        "-inf", "1_0", " 1 ", "1,5", "0x10", "٣", "99999999999999999999", "TRUE", "да", "s", "str",
        "inlineStr", "e", "b", "d", "n", "shared", "array", "dataTable", "normal", "#REF!", "#N/A",
        "A1", "A0", "$A$1", "a1", "XFD1048576", "A1048577", "ZZZZ1", "A1:XFD1048576", "A1:B2",
        "'П4.1'!A1", "Sheet9!A1", "[1]A!A1", "geometry_bore_mm", "regime_speed_rpm", "omega",
        "1/0", "SUM(A1:A9)", "SUM(A:A)", "-1^2", "INDIRECT(\"A1\")", "LET(x,1,x)", "{1,2}", "A1#",
        "OFFSET(A1,1,1)", "RAND()", "IF(1,2", "MATCH(1,A1:A9,1)", "INDEX(A1:B2,1,9)", "\"a\"&\"b\"",
        "VLOOKUP(1,A1:B2,2)", "SUMPRODUCT(A1:A3,B1:B2)", "ROUND(1,1E9)", "1E9^1E9", "A1:A1048576",
        "(" * 300, ")" * 9, "-" * 300, "+1" * 3000, "A" * 40_000, "9" * 5000, "я" * 300,
        "&#0;", "&#x41;", "&#65;", "&#1114112;", "&amp;", "&lt;", "&quot;", "&nbsp;", "&what;", "&",
        "<", ">", "<v>1</v>", "</c>", "<c r=\"A9\"/>", "<f>1</f>", "<row r=\"1\">", "</sheetData>",
        "<mergeCell ref=\"A1:XFD1048576\"/>", "<![CDATA[1]]>", "<!-- -->", "<!DOCTYPE x>", "<?x?>",
        "\0", "\1", "\x7f", "\r\n", "\ufeff", "\u202e", "\U0001f600", "../../etc/passwd", "/",
        "sheet1.xml", "worksheets/sheet2.xml", "sharedStrings.xml", "rId1", "rId99", "Strict",
    )
)  # fmt: skip
_INTERESTING = re.compile(r"xl/(workbook\.xml|sharedStrings|worksheets/sheet|_rels)|docProps/c")
_TEXT = re.compile(rb">([^<>]*)<")
_ATTRIBUTE = re.compile(rb'="([^"<>]*)"')
_ELEMENT = re.compile(rb"<(c|f|v|is|t|row|si|definedName|sheet|Relationship|property)[ >/]")
MAX_STEPS = 16


class _Bytes:
    """Takes numbers from a byte string, zeros after its end."""

    def __init__(self, data: bytes) -> None:
        self.data, self.at = data, 0

    def __bool__(self) -> bool:
        return self.at < len(self.data)

    def number(self, below: int) -> int:
        size = 1 if below <= 256 else 2 if below <= 65_536 else 3
        part = self.data[self.at : self.at + size]
        self.at += size
        return int.from_bytes(part, "big") % max(1, below)

    def bytes(self) -> bytes:
        count = self.number(64)
        part = self.data[self.at : self.at + count]
        self.at += count
        return part


def parts_of(book: bytes) -> dict[str, bytes]:
    """Parts of a workbook by name."""
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def changed_book(parts: Mapping[str, bytes], recipe: bytes) -> bytes:
    """A workbook with the changes of a recipe; the same recipe makes the same workbook."""
    source = _Bytes(recipe)
    values = dict(parts)
    raw: list[tuple[int, bytes]] = []
    for _ in range(MAX_STEPS):
        if not source:
            break
        kind = source.number(16)
        if kind == 15:
            raw.append((source.number(2**24), source.bytes()))
            continue
        names = sorted(values, key=lambda name: (not _INTERESTING.match(name), name))
        # Half of the changes go to the parts that are read at all.
        near = [name for name in names if _INTERESTING.match(name)] or names
        name = near[source.number(len(near))] if kind % 2 else names[source.number(len(names))]
        _step(values, name, kind, source)
        if not values:
            break
    data = _packed(values)
    for at, patch in raw:
        position = at % max(1, len(data))
        data = data[:position] + patch + data[position + len(patch) :]
    return data


def _step(built: dict[str, bytes], name: str, kind: int, source: _Bytes) -> None:
    data = built[name]
    if kind in (0, 1, 2, 3):
        built[name] = _replaced(data, _TEXT, source, TOKENS[source.number(len(TOKENS))])
    elif kind in (4, 5):
        built[name] = _replaced(data, _ATTRIBUTE, source, TOKENS[source.number(len(TOKENS))])
    elif kind in (6, 7):
        built[name] = _replaced(data, _TEXT, source, source.bytes())
    elif kind in (8, 9):
        at = source.number(2**24) % max(1, len(data))
        built[name] = data[:at] + TOKENS[source.number(len(TOKENS))] + data[at:]
    elif kind == 10:
        at = source.number(2**24) % max(1, len(data))
        built[name] = data[:at] + data[at + source.number(4096) :]
    elif kind in (11, 13):
        built[name] = _doubled(data, source)
    elif kind == 12:
        del built[name]
    else:
        others = sorted(built)
        built[others[source.number(len(others))]] = data


def _replaced(data: bytes, what: re.Pattern[bytes], source: _Bytes, by: bytes) -> bytes:
    places = [match.span(1) for match in what.finditer(data)]
    if not places:
        return data
    start, end = places[source.number(len(places))]
    return data[:start] + by + data[end:]


def _doubled(data: bytes, source: _Bytes) -> bytes:
    """An element once more, there or elsewhere."""
    places = [match.start() for match in _ELEMENT.finditer(data)]
    if not places:
        return data
    start = places[source.number(len(places))]
    end = data.find(b">", start) + 1
    if data[end - 2 : end] != b"/>":
        tag = re.match(rb"<(\w+)", data[start:])
        assert tag is not None
        closing = b"</" + tag[1] + b">"
        actual = data.find(closing, end)
        end = actual + len(closing) if actual >= 0 else end
    at = places[source.number(len(places))]
    return data[:at] + data[start:end] + data[at:]


def _packed(parts: Mapping[str, bytes]) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, data in parts.items():
            archive.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_DEFLATED)
    return stream.getvalue()
