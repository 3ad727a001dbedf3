"""Sheets in any form that is well-formed XML."""

from __future__ import annotations

import re

from lxml import etree

from reports.recalculation.by_columns.form_maker import FormMaker
from reports.recalculation.by_columns.grid import BadBook, Grid
from reports.recalculation.by_columns.sheet_form import NOTHING
from reports.recalculation.by_columns.syntax import column_number

MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
_CELL = re.compile(r"([A-Za-z]{1,3})([0-9]{1,7})")


def parse_xml(data: bytes) -> etree._Element:
    """Root of a part; nothing is fetched or expanded.

    Raises:
        BadBook: no well-formed XML.
    """
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    try:
        return etree.fromstring(data, parser)
    except etree.XMLSyntaxError:
        msg = "часть книги не читается как XML"
        raise BadBook(msg) from None


def rich_text(item: etree._Element) -> str:
    """Text of a string item; phonetic hints are no text."""
    parts = []
    for text in item.iter("{*}t"):
        parent = text.getparent()
        if parent is None or not str(parent.tag).endswith("}rPh"):
            parts.append(text.text or "")
    return "".join(parts)


def read_xml(grid: Grid, title: str, data: bytes, strings: list[str]) -> None:
    """Put a sheet into a grid.

    Raises:
        BadBook: no well-formed XML, cells out of bounds, or values that are none.
    """
    maker = FormMaker(title)
    values: list[bytes] = []
    row = 0
    for line in parse_xml(data).iter(f"{MAIN}row"):
        given = line.get("r")
        row = int(given) if given is not None and given.isdigit() else row + 1
        column = 0
        for cell in line.iterchildren(f"{MAIN}c"):
            address = cell.get("r")
            if address is None:
                column += 1
            else:
                row, column = _place(address, title)
            _put(maker, row, column, cell, values)
    maker.form.fill(grid, title, values, strings, escaped=False)


def _place(address: str, title: str) -> tuple[int, int]:
    match = _CELL.fullmatch(address)
    if match is None:
        msg = f"на листе «{title}» ячейка с неверным адресом"
        raise BadBook(msg)
    return int(match[2]), column_number(match[1])


def _put(
    maker: FormMaker, row: int, column: int, cell: etree._Element, values: list[bytes]
) -> None:
    kind = cell.get("t", "n")
    formula = cell.find(f"{MAIN}f")
    about = None
    if formula is not None:
        about = (formula.get("t", "normal"), formula.text or "", formula.get("si", ""))
    inline = cell.find(f"{MAIN}is")
    text = cell.findtext(f"{MAIN}v") or None
    if inline is not None:
        text, kind = rich_text(inline), "str"
    number = NOTHING
    if text is not None:
        number = len(values)
        values.append(text.encode())
    maker.put(row, column, kind, about, number)
