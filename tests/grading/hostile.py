"""Files that nobody should have to fear: hostile, broken and foreign ones."""

from __future__ import annotations

import io
import re
import struct
import zipfile
from collections.abc import Callable, Iterator
from functools import lru_cache

from tests.grading.forms import rewritten

SHEET = "xl/worksheets/sheet3.xml"
_OLE2 = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"


def archive(**parts: bytes) -> bytes:
    """A zip of parts."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as target:
        for name, data in parts.items():
            target.writestr(name, data)
    return stream.getvalue()


def more(book: bytes, parts: dict[str, bytes]) -> bytes:
    """A package with more parts."""
    stream = io.BytesIO(book)
    with zipfile.ZipFile(stream, "a", zipfile.ZIP_DEFLATED) as target:
        for name, data in parts.items():
            target.writestr(name, data)
    return stream.getvalue()


def part(book: bytes, name: str, change: Callable[[bytes], bytes]) -> bytes:
    """A package with one part changed."""
    return rewritten(book, lambda match, data: change(data) if match == name else data)


def bare(data: bytes) -> bytes:
    """A part without its declaration, which not every program writes."""
    return data[data.index(b"?>") + 2 :] if data.startswith(b"<?xml") else data


def rows(xml: str) -> Callable[[bytes], bytes]:
    """More rows at the end of a sheet."""
    return lambda data: data.replace(b"</sheetData>", xml.encode() + b"</sheetData>")


def cell(at: str, inside: str, kind: str = "") -> str:
    """One row with one cell."""
    number = at.lstrip("ABCDEFGHIJKLMNOPQRSTUVWXYZ")
    return f'<row r="{number}"><c r="{at}"{kind}>{inside}</c></row>'


def answer(formula: str) -> Callable[[bytes], bytes]:
    """Another formula in the first answer of the sheet of masses."""
    text = formula.replace("&", "&amp;").replace("<", "&lt;")

    def change(data: bytes) -> bytes:
        built, count = re.subn(rb"<f>[^<]*</f>", f"<f>{text}</f>".encode(), data, count=1)
        assert count == 1
        return built

    return change


def chain(step: int, count: int = 15_000) -> Callable[[bytes], bytes]:
    """A column in which each cell needs the next one."""
    lines = "".join(cell(f"Z{r}", f"<f>Z{r + step}+1</f>") for r in range(3000, 3000 + count))
    return lambda data: rows(lines)(answer(f"Z{3000 if step > 0 else 2999 + count}*0+0.047")(data))


@lru_cache(maxsize=1)
def bomb() -> bytes:
    """A sheet that unpacks to 400 MB."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as target:
        target.writestr("xl/workbook.xml", b"<workbook/>")
        with target.open("xl/worksheets/sheet1.xml", "w", force_zip64=True) as member:
            for _ in range(400):
                member.write(b" " * 2**20)
    return stream.getvalue()


def lying(book: bytes) -> bytes:
    """A directory that tells smaller sizes than come out."""
    data = bytearray(book)
    at = data.rfind(b"PK\x01\x02")
    data[at + 24 : at + 28] = struct.pack("<I", 10)
    return bytes(data)


def flagged(book: bytes) -> bytes:
    """All members marked as encrypted."""
    data = bytearray(book)
    for match in re.finditer(rb"PK\x01\x02", book):
        data[match.start() + 8] |= 1
    for match in re.finditer(rb"PK\x03\x04", book):
        data[match.start() + 6] |= 1
    return bytes(data)


def method(book: bytes) -> bytes:
    """All members packed by a method that does not exist."""
    data = bytearray(book)
    for match in re.finditer(rb"PK\x01\x02", book):
        data[match.start() + 10] = 77
    return bytes(data)


LAUGHS = b"""<?xml version="1.0"?><!DOCTYPE x [<!ENTITY a "ha">
<!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">
<!ENTITY c "&b;&b;&b;&b;&b;&b;&b;&b;"><!ENTITY d "&c;&c;&c;&c;&c;&c;&c;&c;">]>"""
XXE = b'<!DOCTYPE x [<!ENTITY e SYSTEM "file:///etc/passwd">]>'


def hostile_files(book: bytes, ticket: str, other: str) -> Iterator[tuple[str, bytes]]:
    """File name → bytes, all made from a right book of a student with a ticket."""
    sheet = SHEET
    yield "empty.xlsx", b""
    yield "text.xlsx", b"hello"
    yield "picture.png", b"\x89PNG\r\n\x1a\n" + bytes(100)
    yield "report.pdf", b"%PDF-1.7\n"
    yield "encrypted.xlsx", _OLE2 + bytes(5000)
    yield "truncated.xlsx", book[: len(book) // 2]
    yield "headless.xlsx", book[1000:]
    yield "letter.docx", archive(**{"word/document.xml": b"<w/>"})
    yield "bomb.xlsx", bomb()
    yield "lying.xlsx", lying(book)
    yield "parts.xlsx", more(book, {f"x/{i}.xml": b"" for i in range(2500)})
    yield "macros.xlsm", more(book, {"xl/vbaProject.bin": b"x"})
    yield "links.xlsx", more(book, {"xl/externalLinks/externalLink1.xml": b"<x/>"})
    yield "locked.xlsx", flagged(book)
    yield "method.xlsx", method(book)
    yield "doctype.xlsx", part(book, sheet, lambda d: LAUGHS + bare(d))
    yield "laughs.xlsx", part(book, "xl/workbook.xml", lambda d: LAUGHS + bare(d))
    late = b"<!--" + b"x" * 5000 + b"-->" + XXE
    yield (
        "late-entity.xlsx",
        part(book, sheet, lambda d: late + bare(d).replace(b"</v>", b"&e;</v>", 1)),
    )
    yield "utf16.xlsx", part(
        book, sheet,
        lambda d: (XXE.decode() + bare(d).decode()).encode("utf-16"),
    )  # fmt: skip
    yield "corner.xlsx", part(book, sheet, rows(cell("XFD1048576", "<v>1</v>")))
    yield "deep-row.xlsx", part(book, sheet, rows(cell("A1048576", "<v>1</v>")))
    yield "no-such-column.xlsx", part(book, sheet, rows(cell("ZZZ5000", "<v>1</v>")))
    yield "row-zero.xlsx", part(book, sheet, rows('<row r="0"><c r="A0"><v>1</v></c></row>'))
    yield "wrong-row.xlsx", part(book, sheet, rows('<row r="900"><c r="A7"><v>1</v></c></row>'))
    yield "long.xlsx", part(book, sheet, answer("+".join(["1"] * 60_000)))
    yield "nested.xlsx", part(book, sheet, answer("(" * 3000 + "1" + ")" * 3000))
    yield "signs.xlsx", part(book, sheet, answer("-" * 5000 + "1"))
    yield "up-chain.xlsx", part(book, sheet, chain(-1))
    yield "down-chain.xlsx", part(book, sheet, chain(1))
    yield "whole-sheet.xlsx", part(book, sheet, answer("SUM(A1:XFD1048576)"))
    yield "product.xlsx", part(book, sheet, answer("SUMPRODUCT(E1:E20000*TRANSPOSE(E1:E20000))"))
    yield "text-growth.xlsx", part(book, sheet, answer('REPT("x",1E9)'))
    # Doubled forty-four times: the library aborts, and with it the worker.
    doubled = cell("Z3000", "<v>abcdefgh</v>", ' t="str"') + "".join(
        cell(f"Z{r}", f"<f>Z{r - 1}&amp;Z{r - 1}</f>") for r in range(3001, 3045)
    )
    yield "doubling.xlsx", part(book, sheet, rows(doubled))
    yield "web.xlsx", part(book, sheet, answer('WEBSERVICE("http://localhost:9/")'))
    yield "dde.xlsx", part(book, sheet, answer("cmd|' /C calc'!A0"))
    yield "other-file.xlsx", part(book, sheet, answer("[1]Sheet1!A1"))
    yield (
        "array.xlsx",
        part(book, sheet, lambda d: d.replace(b"<f>", b'<f t="array" ref="C5:C9">', 1)),
    )
    yield (
        "data-table.xlsx",
        part(book, sheet, lambda d: d.replace(b"<f>", b'<f t="dataTable" ref="C5:C9">', 1)),
    )
    yield "broken-xml.xlsx", part(book, sheet, lambda d: d.replace(b"</row>", b"", 1)[:-30])
    yield "bad-utf8.xlsx", part(book, sheet, lambda d: d.replace(b"<v>", b"<v>\xff\xfe", 1))
    yield "bad-number.xlsx", part(book, sheet, rows(cell("A800", "<v>1e999</v>")))
    yield "bad-string.xlsx", part(book, sheet, rows(cell("A800", "<v>7777</v>", ' t="s"')))
    yield (
        "lost-part.xlsx",
        part(
            book, "xl/_rels/workbook.xml.rels", lambda d: d.replace(b"sheet3.xml", b"sheet333.xml")
        ),
    )
    yield "path.xlsx", part(
        book, "xl/_rels/workbook.xml.rels",
        lambda d: re.sub(rb'Target="[^"]*sheet3.xml"', b'Target="../../../etc/passwd"', d),
    )  # fmt: skip
    yield "sheets.xlsx", part(
        book, "xl/workbook.xml",
        lambda d: d.replace(b"<sheets>", b"<sheets>" + b'<sheet name="x" sheetId="9"/>' * 999),
    )  # fmt: skip
    yield (
        "strict.xlsx",
        rewritten(
            book,
            lambda n, d: d.replace(
                b"http://schemas.openxmlformats.org/spreadsheetml/2006/main",
                b"http://purl.oclc.org/ooxml/spreadsheetml/main",
            ),
        ),
    )
    forged = "K" + "A" * 24
    yield "forged.xlsx", rewritten(book, lambda n, d: d.replace(ticket.encode(), forged.encode()))
    yield (
        "two-owners.xlsx",
        part(book, "docProps/custom.xml", lambda d: d.replace(ticket.encode(), other.encode())),
    )
    yield "=cmd|' !A0<script>alert(1)</script>.xlsx".replace("/", "∕"), b"x"
    yield "markup.xlsx", part(
        book, sheet,
        lambda d: d.replace(b"<f>r_crank/L_rod</f>", b"<f>&quot;&lt;script>&quot;</f>"),
    )  # fmt: skip
