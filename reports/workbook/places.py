"""Chart placement: on screen, several to a row, without overlap.

Everything is measured in pixels of a screen at 100 %; a program's columns are as wide as their
widths say for the standard font, its rows as high as is written or 15 points.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import ceil

from openpyxl.drawing.spreadsheet_drawing import AnchorMarker, OneCellAnchor
from openpyxl.drawing.xdr import XDRPositiveSize2D
from openpyxl.styles import Alignment
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.cell_range import CellRange
from openpyxl.worksheet.worksheet import Worksheet

SCREEN = 1475  # px: 1600 less row numbers, bars, and what other programs' columns are wider
FOLD = 640  # px: 900 less ribbon, formula bar, tabs
GAP = 8
LINE, SMALL = 15, 12  # pt of height, that of a line of notes
TITLE_HEIGHT = 21  # pt
NOTE_LETTER = 0.92  # width of a letter of a note, in those of the sheet
_EMU = 9525  # in a pixel
DIGIT, COLUMN, ROW = 7, 64, 20  # px
_LETTERS = 0.93  # letters of a text in the room of a digit
_SURE, _EDGES = 0.97, 0.7  # of a column's width, blank digits at its edges
# Widths of letters in digits, those of Arial; most small letters are as wide as a digit.
_CAPITALS = "АБВГДЕЁЖЗИЙКЛМНОПРСТУФХЦЧШЩЪЫЬЭЮЯABCDEFGHIJKLMNOPQRSTUVWXYZ"
_WIDTH = defaultdict(lambda: 1.0, dict.fromkeys(_CAPITALS, 1.25)) | {
    letter: width
    for width, letters in (
        (0.66, "r()-г"), (0.82, "з т к"), (0.91, "с у х э ч ь cksvxyz"), (1.1, "ГТFTZ=+−×σΣъ"),
        (1.3, "ж м ы ю wω"), (1.5, "ш щ ф mОQ"), (1.7, "М Ж Ш Щ Ы Ю MW%—"),
        (0.5, " .,:;/·Iftijl"),
    )
    for letter in letters
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle on a sheet [px]."""

    x: int
    y: int
    width: int
    height: int

    @property
    def right(self) -> int:
        """Right edge."""
        return self.x + self.width

    @property
    def bottom(self) -> int:
        """Lower edge."""
        return self.y + self.height


def column_px(sheet: Worksheet, index: int) -> int:
    """Width of a column as it is seen."""
    letter = get_column_letter(index)
    if letter not in sheet.column_dimensions:
        return COLUMN
    dimension = sheet.column_dimensions[letter]
    return 0 if dimension.hidden else round(dimension.width * DIGIT) if dimension.width else COLUMN


def row_px(sheet: Worksheet, index: int) -> int:
    """Height of a row."""
    height = sheet.row_dimensions[index].height if index in sheet.row_dimensions else None
    return ROW if height is None else round(height * 4 / 3)


def extent(sheet: Worksheet) -> tuple[int, int]:
    """Width and height of all that is written on a sheet."""
    return (
        sum(column_px(sheet, i) for i in range(1, sheet.max_column + 1)),
        sum(row_px(sheet, i) for i in range(1, sheet.max_row + 1)),
    )


def lines_of(text: str, width: float) -> int:
    """Lines that a text takes in a column: no program measures them before the file is opened."""
    room, lines, filled = width * _SURE - _EDGES, 1, 0.0
    for word in text.split():
        size = sum(map(_WIDTH.__getitem__, word))
        if filled and filled + _WIDTH[" "] + size > room:
            lines, filled = lines + 1, 0.0
        lines += int(size // room)  # broken where a line cannot hold it
        filled += (_WIDTH[" "] if filled else 0) + size % room
    return lines


def room_of(letters: int) -> int:
    """Width of a column in which so many letters are one line."""
    return ceil(letters / _LETTERS) + 1


def wrap_across(
    sheet: Worksheet, row: int, first: int, last: int, wider: float = 1.0, line: float = LINE
) -> None:
    """Let the text of a cell wrap within its columns to the last, the row as high as it asks.

    ``wider`` is how much wider its letters are than those of the sheet, ``line`` the height of
    a line of them [pt].
    """
    cell = sheet.cell(row, first)
    cell.alignment = Alignment(wrap_text=True, vertical="top")
    # Not merge_cells, which compares the borders of cells that have none.
    sheet.merged_cells.add(CellRange(min_row=row, min_col=first, max_row=row, max_col=last))
    sheet.cell(row, last)  # the width counts as the sheet's
    width = sum(column_px(sheet, i) for i in range(first, last + 1))
    lines = lines_of(str(cell.value), width / DIGIT / wider)
    if lines > 1:
        height = sheet.row_dimensions[row].height or LINE
        sheet.row_dimensions[row].height = max(height, line * lines + LINE - line)


def raise_row(sheet: Worksheet, row: int, texts: Mapping[str, float]) -> None:
    """Room for texts that wrap, with the widths of their columns."""
    lines = max(lines_of(text, width) for text, width in texts.items())
    if lines > 1:
        height = sheet.row_dimensions[row].height or LINE
        sheet.row_dimensions[row].height = max(height, LINE * lines)


def wrap_within(sheet: Worksheet, at: tuple[int, int], text: str, width: float) -> None:
    """Let a text of a cell wrap in its column, made so wide."""
    row, column = at
    sheet.column_dimensions[get_column_letter(column)].width = width
    sheet.cell(row, column).alignment = Alignment(wrap_text=True, vertical="center")
    raise_row(sheet, row, {text: width})


def top_of(sheet: Worksheet, row: int) -> int:
    """Upper edge of a row."""
    return sum(row_px(sheet, i) for i in range(1, row))


def flow(sizes: Sequence[tuple[int, int]], x: int, y: int, right: int) -> list[Box]:
    """Boxes from left to right, and below where the row is full."""
    boxes: list[Box] = []
    left, row, bottom = x, y, y
    for width, height in sizes:
        if left > x and left + width > right:
            # Where a page of the print may end, rows of cells end too.
            left, row = x, row + ceil((bottom + GAP - row) / ROW) * ROW
        boxes.append(Box(left, row, width, height))
        left, bottom = left + width + GAP, max(bottom, row + height)
    return boxes


def anchor(sheet: Worksheet, box: Box) -> OneCellAnchor:
    """Return a box as a drawing's anchor: a cell and what is left over within it."""
    column, x = 1, box.x
    while x >= column_px(sheet, column):
        x -= column_px(sheet, column)
        column += 1
    row, y = 1, box.y
    while y >= row_px(sheet, row):
        y -= row_px(sheet, row)
        row += 1
    at = AnchorMarker(col=column - 1, colOff=x * _EMU, row=row - 1, rowOff=y * _EMU)
    return OneCellAnchor(_from=at, ext=XDRPositiveSize2D(box.width * _EMU, box.height * _EMU))


def keep_columns(sheet: Worksheet, boxes: Sequence[Box]) -> None:
    """Give the columns below charts the width that was reckoned with: programs differ in theirs."""
    for index in range(1, last_cell(sheet, boxes)[1] + 1 if boxes else 0):
        letter = get_column_letter(index)
        if letter not in sheet.column_dimensions:
            sheet.column_dimensions[letter].width = COLUMN / DIGIT


def last_cell(sheet: Worksheet, boxes: Sequence[Box]) -> tuple[int, int]:
    """Row and column of the cell under the lower right corner of all boxes."""
    corner = Box(max(b.right for b in boxes), max(b.bottom for b in boxes), 0, 0)
    at = anchor(sheet, corner)._from
    return at.row + 1, at.col + 1
