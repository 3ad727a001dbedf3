"""Tiles of the first sheet: the numbers that say which engine this is, each with one more below."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import floor, isfinite, log10

from openpyxl.styles import Alignment, Border, Font, PatternFill, Side
from openpyxl.worksheet.cell_range import CellRange
from openpyxl.worksheet.worksheet import Worksheet

from kshm.nomenclature.quantity import Quantity
from reports.tables.strength_members import SAFETIES
from reports.workbook import styles
from reports.workbook.key_values import NOUGHT, key_values
from reports.workbook.places import DIGIT, column_px, lines_of
from reports.workbook.sheets import BlockWriter

# First and last columns of the tiles, and of the links below them.
SPANS = ((1, 1), (2, 4), (6, 8), (9, 11), (12, 14), (15, 17))
# The first key of a row that the book has, and below it the first of the other row.
_TILES: tuple[tuple[tuple[str, ...], tuple[str, ...]], ...] = (
    (("cyc_N_e", "N_e_calc"), ("N_i_calc",)),
    (("M_mean",), ("M_e",)),
    (("M_max",), ("M_min",)),
    (("Rpin_max",), ("Rpin_mean",)),
    (("delta_work", "c_m"), ("I_flywheel", "j_tdc")),
    (("q_pin_max",), ("q_pin_mean",)),
)
_SAFETIES = (*SAFETIES, "safe_n_pin", "safe_n_main")
_MIN_SAFETY = "Наименьший запас прочности деталей"
_HEIGHTS = (26.0, 22.0, 15.0)  # pt: title of two lines, value, what stands below
_TITLE_LINE, _TITLE_SIZE, _INDENT = 12.0, styles.SIZE - 2, 10  # pt, pt, px
_DIGITS = 4
_FILL, _EDGE, _PALE = "F3F6FA", "2E75B6", "595959"


@dataclass(frozen=True, slots=True)
class _Number:
    """A number of the book for a tile."""

    title: str
    formula: str
    value: float
    symbol: str
    look: str
    nought: str = ""  # what a zero says

    @property
    def with_symbol(self) -> str:
        """Number format with the symbol in the cell."""
        if not self.symbol:
            return self.look
        signed = [f'"{self.symbol} = {sign}"{self.look}' for sign in ("", "−")]
        return ";".join((*signed, f'"{self.symbol}: {self.nought}"') if self.nought else signed)


def write_tiles(sheet: Worksheet, writer: BlockWriter, row: int) -> int:
    """Write the tiles into three rows; return the row below them, the same without numbers."""
    if not any(_first(writer, keys) for keys, _ in _TILES):
        return row  # a book to fill in
    for offset, height in enumerate(_HEIGHTS):
        sheet.row_dimensions[row + offset].height = height
    for span, (keys, further) in zip(SPANS, _TILES, strict=True):
        number, below = _first(writer, keys), _first(writer, further)
        if keys == _TILES[-1][0] and (least := _least_safety(writer)):
            number, below = least, number
        _frame(sheet, row, span)
        if number is not None:
            sheet.cell(row, span[0], number.title)
            _raise(sheet, row, span, number.title)
        for at, each in ((row + 1, number), (row + 2, below)):
            if each is not None:
                writer.formula(sheet, at, span[0], each.formula, each.value)
                look = each.look if each is number else each.with_symbol
                sheet.cell(at, span[0]).number_format = look
    return row + len(_HEIGHTS)


def _first(writer: BlockWriter, keys: Sequence[str]) -> _Number | None:
    """Return the first of some numbers that the book has."""
    for title, measure, formula, value, unit, _ in key_values(writer, keys):
        if isinstance(measure, Quantity) and isinstance(value, float | int):
            look = _few_digits(measure, float(value)) + (f'" {unit}"' if unit else "")
            nought = NOUGHT.get(formula.removeprefix("="), "")
            return _Number(title, formula, float(value), measure.symbol, look, nought)
    return None


def _raise(sheet: Worksheet, row: int, span: tuple[int, int], title: str) -> None:
    """Raise the row of titles until one has room."""
    width = sum(column_px(sheet, index) for index in range(span[0], span[1] + 1)) - _INDENT
    lines = lines_of(title, width / DIGIT * styles.SIZE / _TITLE_SIZE)
    height = sheet.row_dimensions[row].height
    sheet.row_dimensions[row].height = max(height, _TITLE_LINE * lines + 2)


def _few_digits(quantity: Quantity, value: float) -> str:
    """Return the number format with four digits, no more decimals than the quantity has."""
    whole = floor(log10(abs(value))) + 1 if value else 1
    decimals = max(0, min(quantity.digits.decimals, _DIGITS - whole))
    return "0." + "0" * decimals if decimals else "0"


def _least_safety(writer: BlockWriter) -> _Number | None:
    """Return the least safety of parts and journals, where the book has any."""
    values = writer.values.scalars
    keys = [key for key in _SAFETIES if isfinite(float(values.get(key, float("inf"))))]
    if not keys:
        return None
    least = min(float(values[key]) for key in keys)
    return _Number(_MIN_SAFETY, f"=MIN({','.join(keys)})", least, "", "0.00")


def _frame(sheet: Worksheet, row: int, span: tuple[int, int]) -> None:
    """Merge, fill and border of a tile."""
    fonts = (
        Font(name=styles.FONT, size=_TITLE_SIZE, color=_PALE),
        Font(name=styles.FONT, size=styles.SIZE + 4, bold=True, color="1F3864"),
        Font(name=styles.FONT, size=styles.SIZE - 1, color=_PALE),
    )
    edges = (Border(top=Side(style="medium", color=_EDGE)), Border(), Border())
    for offset, (font, edge) in enumerate(zip(fonts, edges, strict=True)):
        for column in range(span[0], span[1] + 1):
            cell = sheet.cell(row + offset, column)
            cell.fill = PatternFill("solid", fgColor=_FILL)
            cell.font, cell.border = font, edge
            cell.alignment = Alignment(
                horizontal="left", vertical="center", indent=1, wrap_text=offset == 0
            )
        if span[1] > span[0]:
            sheet.merged_cells.add(CellRange(
                min_row=row + offset, max_row=row + offset, min_col=span[0], max_col=span[1]
            ))  # fmt: skip
