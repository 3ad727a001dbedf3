"""Values put into single cells of a workbook; every other byte of its parts stays.

A program that reads a whole book and writes it anew loses what it does not know: text boxes,
pictures in headers, sparklines, looks inside a cell.
"""

from __future__ import annotations

import re
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from io import BytesIO
from xml.sax.saxutils import escape

from openpyxl.utils import column_index_from_string, get_column_letter

from reports.shared.errors import SharedFormulaError
from reports.workbook.caches import sheet_parts
from reports.workbook.intake import repacked

Value = str | float | int
_DATA = re.compile(r"<((?:\w+:)?)sheetData\b([^>]*?)(?:/>|>(.*?)</\1sheetData>)", re.DOTALL)
_ROW = re.compile(r"<((?:\w+:)?)row\b([^>]*?)(?:/>|>(.*?)</\1row>)", re.DOTALL)
_CELL = re.compile(r"<((?:\w+:)?)c\b([^>]*?)(?:/>|>(.*?)</\1c>)", re.DOTALL)
_COL = re.compile(r"<(?:\w+:)?col\b([^>]*?)/?>")
_DIMENSION = re.compile(
    r"""(<(?:\w+:)?dimension\b[^>]*?\bref=["'])([A-Z]+)(\d+)(?::([A-Z]+)(\d+))?"""
)
_FORMULA = re.compile(r"<(?:\w+:)?f\b")
_MASTER = re.compile(r"""<(?:\w+:)?f\b[^>]*\bref=""")
_SAVED = re.compile(
    r"(<(\w+:)?f\b[^>]*?(?:/>|>[^<]*</(?:\w+:)?f>)\s*)<(?:\w+:)?v>[^<]*</(?:\w+:)?v>"
)
_BOOK, _TYPES, _CHAIN = "xl/workbook.xml", "[Content_Types].xml", "xl/calcChain.xml"
_RELATIONS = "xl/_rels/workbook.xml.rels"


def with_cells(data: bytes, title: str, values: Mapping[tuple[int, int], Value]) -> bytes:
    """Return a workbook with values in cells of one sheet, by row and column.

    Formulas are calculated when the book is opened.

    Raises:
        SharedFormulaError: a cell holds the formula of a whole range.
        UnicodeDecodeError: a part is not in UTF-8.
    """
    with zipfile.ZipFile(BytesIO(data)) as archive:
        parts = sheet_parts(archive)
        names = set(archive.namelist())
        texts = {part: archive.read(part).decode("utf-8") for part in {*parts.values(), _BOOK}}
        others = {name: archive.read(name).decode("utf-8") for name in (_TYPES, _RELATIONS)}
    sheet = _SheetText(texts[parts[title]])
    changed = {parts[title]: _unsaved(sheet.filled(values))}
    for name, part in parts.items():
        if name != title and _FORMULA.search(texts[part]) and escape(title) in texts[part]:
            changed[part] = _unsaved(texts[part])
    if any(map(_FORMULA.search, texts.values())):
        changed[_BOOK] = _calculated(texts[_BOOK])
    if sheet.lost and _CHAIN in names:  # it names a cell that has no formula any more
        data = _without_chain(data)
        changed |= {
            name: re.sub(r"<(?:Override|Relationship)\b[^>]*calcChain[^>]*/>", "", text)
            for name, text in others.items()
        }
    return repacked(data, {name: text.encode() for name, text in changed.items()})


def without_caches(data: bytes) -> bytes:
    """Return a workbook whose formulas have no saved values: all is calculated when it is opened.

    Raises:
        UnicodeDecodeError: a part is not in UTF-8.
    """
    with zipfile.ZipFile(BytesIO(data)) as archive:
        parts = [*sheet_parts(archive).values(), _BOOK]
        texts = {part: archive.read(part).decode("utf-8") for part in parts}
    changed = {part: _unsaved(text) for part, text in texts.items() if part != _BOOK}
    changed[_BOOK] = _calculated(texts[_BOOK])
    return repacked(data, {name: text.encode() for name, text in changed.items()})


@dataclass
class _SheetText:
    """The text of a sheet; ``lost`` are cells that had formulas."""

    text: str
    lost: list[str] = field(default_factory=list)

    def filled(self, values: Mapping[tuple[int, int], Value]) -> str:
        """Return the text with the values."""
        match = _DATA.search(self.text)
        if match is None or not values:
            return self.text
        prefix, attributes, inside = match[1], match[2], match[3] or ""
        by_row: dict[int, dict[int, Value]] = {}
        for (row, column), value in values.items():
            by_row.setdefault(row, {})[column] = value
        parts, at, last = [], 0, 0
        for line in _ROW.finditer(inside):
            last = int(_attribute(line[2], "r") or last + 1)
            parts.append(inside[at : line.start()])
            early = sorted(row for row in by_row if row < last)
            parts += [self._row(prefix, f' r="{row}"', "", row, by_row.pop(row)) for row in early]
            cells = by_row.pop(last, None)
            parts.append(
                line[0] if cells is None
                else self._row(line[1], line[2], line[3] or "", last, cells)
            )  # fmt: skip
            at = line.end()
        parts.append(inside[at:])
        parts += [self._row(prefix, f' r="{row}"', "", row, by_row[row]) for row in sorted(by_row)]
        rows = "".join(parts)
        whole = f"<{prefix}sheetData{attributes}>{rows}</{prefix}sheetData>"
        return self._spread(self.text[: match.start()], values) + whole + self.text[match.end() :]

    def _row(
        self, prefix: str, attributes: str, inside: str, row: int, values: dict[int, Value]
    ) -> str:
        """Return a row with values in its columns."""
        left, parts, at, last = dict(values), [], 0, 0
        for match in _CELL.finditer(inside):
            reference = re.match(r"[A-Z]+", _attribute(match[2], "r"))
            last = column_index_from_string(reference[0]) if reference else last + 1
            parts.append(inside[at : match.start()])
            early = sorted(column for column in left if column < last)
            parts += [self._new(prefix, attributes, row, column, left.pop(column))
                      for column in early]  # fmt: skip
            if last in left:
                if _MASTER.search(match[3] or ""):
                    raise SharedFormulaError(f"{get_column_letter(last)}{row}")
                if _FORMULA.search(match[3] or ""):
                    self.lost.append(f"{get_column_letter(last)}{row}")
                style = _attribute(match[2], "s")
                parts.append(_cell(match[1], row, last, style, left.pop(last)))
            else:
                parts.append(match[0])
            at = match.end()
        parts.append(inside[at:])
        parts += [self._new(prefix, attributes, row, column, left[column])
                  for column in sorted(left)]  # fmt: skip
        plain = re.sub(r"""\s+spans=(?:"[^"]*"|'[^']*')""", "", attributes).rstrip()
        return f"<{prefix}row{plain}>{''.join(parts)}</{prefix}row>"

    def _new(self, prefix: str, attributes: str, row: int, column: int, value: Value) -> str:
        """Return a cell that was not there, in the look of its row or column."""
        style = _attribute(attributes, "s")
        for match in () if style else _COL.finditer(self.text):
            first, last = (int(_attribute(match[1], key) or 0) for key in ("min", "max"))
            if first <= column <= last:
                style = _attribute(match[1], "style")
        return _cell(prefix, row, column, style, value)

    @staticmethod
    def _spread(head: str, values: Mapping[tuple[int, int], Value]) -> str:
        """Return the head of a sheet with the extent of its cells."""
        match = _DIMENSION.search(head)
        if match is None:
            return head
        first, last = match[2], match[4] or match[2]
        columns = [column_index_from_string(letters) for letters in (first, last)]
        rows = [int(match[3]), int(match[5] or match[3])]
        wide = [*columns, *(column for _, column in values)]
        high = [*rows, *(row for row, _ in values)]
        if (min(wide), max(wide), min(high), max(high)) == (*columns, *rows):
            return head
        corners = (edge(wide) for edge in (min, max)), (edge(high) for edge in (min, max))
        extent = ":".join(f"{get_column_letter(at)}{row}" for at, row in zip(*corners, strict=True))
        return head[: match.start()] + match[1] + extent + head[match.end() :]


def _cell(prefix: str, row: int, column: int, style: str, value: Value) -> str:
    head = f'<{prefix}c r="{get_column_letter(column)}{row}"' + (f' s="{style}"' if style else "")
    if value == "":
        return f"{head}/>"
    if not isinstance(value, str):
        return f"{head}><{prefix}v>{value:.15g}</{prefix}v></{prefix}c>"
    text = f'<{prefix}t xml:space="preserve">{escape(value)}</{prefix}t>'
    return f'{head} t="inlineStr"><{prefix}is>{text}</{prefix}is></{prefix}c>'


def _attribute(text: str, name: str) -> str:
    match = re.search(rf"""(?:^|\s){name}\s*=\s*(?:"([^"]*)"|'([^']*)')""", text)
    return (match[1] or match[2] or "") if match else ""


def _unsaved(text: str) -> str:
    """Return a sheet whose formulas have no saved values: these belong to other marks."""
    return _SAVED.sub(r"\1", text)


def _calculated(text: str) -> str:
    """Return the book's own part, so that all is calculated when it is opened."""
    match = re.search(r"<((?:\w+:)?)calcPr\b([^>]*?)(/?)>", text)
    if match is None:
        return text
    plain = re.sub(r"""\s+fullCalcOnLoad=(?:"[^"]*"|'[^']*')""", "", match[2])
    new = f'<{match[1]}calcPr{plain} fullCalcOnLoad="1"{match[3]}>'
    return text[: match.start()] + new + text[match.end() :]


def _without_chain(data: bytes) -> bytes:
    stream = BytesIO()
    with zipfile.ZipFile(BytesIO(data)) as source, zipfile.ZipFile(stream, "w") as target:
        for info in source.infolist():
            if info.filename != _CHAIN:
                target.writestr(info, source.read(info))
    return stream.getvalue()
