"""The sheet of sines and cosines that Fourier coefficients sum over, a column an order."""

from __future__ import annotations

from math import cos, radians, sin

from openpyxl.utils import get_column_letter
from openpyxl.worksheet.worksheet import Worksheet

from reports.workbook import styles
from reports.workbook.layout import FIRST_ROW, HEADER_ROW, NUMBER_ROW, Cell, quoted
from reports.workbook.sheets import Writer

_ANGLE, _WAVE = (styles.HELPER, "0.0"), (styles.HELPER, "0.0000")
_TURNS = {"cos": cos, "sin": sin}


def write_waves(sheet: Worksheet, writer: Writer) -> None:
    """Angles as their table has them, orders above the columns; the last row repeats the first."""
    layout = writer.layout
    for grid, found in layout.orders.items():
        table, column = layout.columns[found.angle]
        angles = writer.values.columns[table.id][table.columns[0].key][:-1].tolist()
        place = layout.waves[grid]
        rows = range(FIRST_ROW, FIRST_ROW + len(angles))
        sheet.cell(HEADER_ROW - 1, place, table.sheet).style = styles.SUBTITLE
        sheet.cell(HEADER_ROW, place, table.columns[0].quantity.header).style = styles.HEADER
        letter, home = get_column_letter(place), quoted(table.sheet)
        copies = [f"={home}!{Cell('', row, column).coordinate}" for row in rows]
        writer.column(sheet, place, copies, angles, _ANGLE)
        for turn, orders in found.orders.items():
            for order in orders:
                at = layout.wave_column(turn, grid, order)
                sheet.cell(HEADER_ROW, at, f"{turn} kφ").style = styles.HEADER
                sheet.cell(NUMBER_ROW, at, order).style = styles.NUMBER
                above = f"{get_column_letter(at)}${NUMBER_ROW}"
                texts = [f"={turn.upper()}(${letter}{row}*({above}*PI()/180))" for row in rows]
                # The same digits for the same angle in every column: they take less room.
                values = [round(_TURNS[turn](radians(order * angle % 360)), 15) for angle in angles]
                writer.column(sheet, at, texts, values, _WAVE)
