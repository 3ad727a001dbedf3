"""Sheets in the form in which the usual programs write them, read without an XML parser."""

from __future__ import annotations

import hashlib
import re
from collections import OrderedDict
from itertools import accumulate

from reports.recalculation.by_columns.form_maker import FormMaker
from reports.recalculation.by_columns.grid import Grid
from reports.recalculation.by_columns.sheet_form import NOTHING, SheetForm, plain_text
from reports.recalculation.by_columns.syntax import column_number

MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"

# The form in which Excel, LibreOffice, Google Sheets and openpyxl write cells.  A sheet that
# is anything else goes through the XML parser, which takes three times as long.  A value is
# taken out before, a \0 stands for it.
_CELL = re.compile(
    r'<c r="([A-Z]{1,3})([1-9][0-9]{0,6})"(?: s="[0-9]+")?(?: t="([a-zA-Z]+)")?(?:/>|>'
    r"(?:<f([^>/]*)(?:/>|>([^<\0]*)</f>))?(?:(\0)|<v></v>|<v/>)?"
    r'(?:<is><t(?: xml:space="preserve")?>([^<\0]*)</t></is>)?</c>)'
)
_VALUE = re.compile(rb"<v>([^<]+)</v>")
_LETTER = re.compile(r"&#([1-9][0-9]{2,4});")  # from 100 up: no sign of the markup
_EMPTY_ROW = re.compile(rb"<row [^>]*/>")
_ATTRIBUTE = re.compile(r'(t|si)="([^"&]*)"')
_BETWEEN = "\x01"  # no XML has it

_KEPT_CELLS = 100_000
_forms: OrderedDict[bytes, SheetForm] = OrderedDict()


def read_text(grid: Grid, title: str, data: bytes, strings: list[str]) -> bool:
    """Put a sheet in the usual form into a grid; False, and nothing done, where it is not.

    Raises:
        BadBook: cells out of bounds, or values that are none.
    """
    if b"\0" in data:
        return False
    pieces = _VALUE.split(data)
    form = _form_of(title, b"\0".join(pieces[::2]))
    if form is None:
        return False
    try:
        form.fill(grid, title, pieces[1::2], strings)
    except UnicodeDecodeError:
        return False
    return True


def _form_of(title: str, bare: bytes) -> SheetForm | None:
    """The form of a sheet without values; those used last are kept."""
    key = hashlib.sha256(bare).digest()
    found = _forms.get(key)
    if found is not None:
        _forms.move_to_end(key)
        return found
    found = _form(title, bare)
    if found is not None:
        _forms[key] = found
        while sum(form.cells for form in _forms.values()) > _KEPT_CELLS:
            _forms.popitem(last=False)
    return found


def _form(title: str, data: bytes) -> SheetForm | None:
    """The form of a sheet, None where it is not the usual one."""
    head, _, rest = data.partition(b"<sheetData>")
    body, _, tail = rest.partition(b"</sheetData>")
    if b"<!" in data or b"<?" in body or not _is_whole(head, body, tail):
        return None
    try:
        bare = body.decode("utf-8")
    except UnicodeDecodeError:
        return None
    if _BETWEEN in bare or b"\0" in head or b"\0" in tail:
        return None
    if "&#" in bare:  # letters that a writer of ASCII has spelt out
        bare = _LETTER.sub(lambda match: chr(int(match[1])), bare)
    cells = _CELL.findall(bare)
    if len(cells) != bare.count("<c ") or sum(bool(cell[5]) for cell in cells) != bare.count("\0"):
        return None
    maker = FormMaker(title)
    if not cells:
        return maker.form
    letters, rows, kinds, about, escaped, marks, inlines = zip(*cells, strict=True)
    formulas = plain_text(_BETWEEN.join(escaped)).split(_BETWEEN)
    numbers = [n - 1 for n in accumulate(map(len, marks))]
    of_column: dict[str, list[int]] = {}
    for i, name in enumerate(letters):
        of_column.setdefault(name, []).append(i)
    count = numbers[-1] + 1
    for name, places in of_column.items():
        column = _Column(
            [rows[i] for i in places],
            [kinds[i] or "n" for i in places],
            [about[i] for i in places],
            [formulas[i] for i in places],
            [numbers[i] if marks[i] else NOTHING for i in places],
            [inlines[i] for i in places],
        )
        column.into(maker, column_number(name), count)
    return maker.form


class _Column:
    """Cells of one column from the top, each of their parts as a list."""

    def __init__(
        self,
        rows: list[str],
        kinds: list[str],
        about: list[str],
        formulas: list[str],
        values: list[int],
        inlines: list[str],
    ) -> None:
        self.rows, self.kinds, self.about = rows, kinds, about
        self.formulas, self.values, self.inlines = formulas, values, inlines

    def into(self, maker: FormMaker, column: int, count: int) -> None:
        """Hand the cells over, formulas that were filled down all at once."""
        plain = self._plain()
        at = 0
        while at < len(self.rows):
            taken = maker.follow(column, self.rows, self.formulas, self.values, at, plain[at])
            if taken:
                at += taken
                continue
            self._one(maker, column, at, count)
            at += 1

    def _plain(self) -> list[int]:
        """For each cell the end of the ordinary formulas that begin there, 0 for none."""
        ends = [0] * len(self.rows)
        end = 0
        for i in range(len(self.rows) - 1, -1, -1):
            about = self.about[i]
            if (
                self.formulas[i]
                and self.kinds[i] == "n"
                and "t=" not in about
                and "si=" not in about
            ):
                end = end or i + 1
                ends[i] = end
            else:
                end = 0
        return ends

    def _one(self, maker: FormMaker, column: int, at: int, count: int) -> None:
        made = None
        if self.formulas[at] or self.about[at]:
            known = dict(_ATTRIBUTE.findall(self.about[at]))
            made = (known.get("t", "normal"), self.formulas[at], known.get("si", ""))
        value = self.values[at]
        kind = self.kinds[at]
        if self.inlines[at]:
            value = count + len(maker.form.fixed)
            maker.form.fixed.append(plain_text(self.inlines[at]))
            kind = "n"  # it is text already
        maker.put(int(self.rows[at]), column, kind, made, value)


def _is_whole(head: bytes, body: bytes, tail: bytes) -> bool:
    """Whether a sheet in the usual form has its end and closes its rows."""
    closed = body.count(b"</row>") + len(_EMPTY_ROW.findall(body))
    return (
        f'<worksheet xmlns="{MAIN}"'.encode() in head
        and tail.rstrip().endswith(b"</worksheet>")
        and body.count(b"<row") == closed
    )
