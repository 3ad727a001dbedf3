"""The sheet of sines and cosines that Fourier coefficients sum over, a column an order."""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, radians, sin

from openpyxl.utils import get_column_letter
from openpyxl.worksheet.worksheet import Worksheet

from reports.formula.excel import number
from reports.workbook import styles
from reports.workbook.layout import FIRST_ROW, HEADER_ROW, NUMBER_ROW, Cell, quoted
from reports.workbook.orders import Waves
from reports.workbook.sheets import Writer

_ANGLE, _WAVE = (styles.HELPER, "0.0"), (styles.HELPER, "0.0000")
_TURNS = {"cos": cos, "sin": sin}


def write_waves(sheet: Worksheet, writer: Writer) -> None:
    """Angles as their table has them, orders above the columns; the last row repeats the first."""
    layout = writer.layout
    for run in layout.run_orders:
        _write_run(sheet, writer, run)
    for grid, found in layout.orders.items():
        table, column = layout.columns[found.angle]
        if table.id not in writer.values.columns:  # a work-book has some tables only
            continue
        angles = writer.values.columns[table.id][table.columns[0].key][:-1].tolist()
        place = layout.waves[grid]
        rows = range(FIRST_ROW, FIRST_ROW + len(angles))
        sheet.cell(HEADER_ROW - 1, place, table.sheet).style = styles.SUBTITLE
        sheet.cell(HEADER_ROW, place, table.columns[0].quantity.header).style = styles.HEADER
        letter, home = get_column_letter(place), quoted(table.sheet)
        copies = [f"={home}!{Cell('', row, column).coordinate}" for row in rows]
        writer.column(sheet, place, copies, angles, _ANGLE)
        for at, (turn, order) in enumerate(_each(found), place + 1):
            sheet.cell(HEADER_ROW, at, f"{turn} kφ").style = styles.HEADER
            sheet.cell(NUMBER_ROW, at, order).style = styles.NUMBER
            above = f"{get_column_letter(at)}${NUMBER_ROW}"
            texts = [f"={turn.upper()}(${letter}{row}*({above}*PI()/180))" for row in rows]
            # The same digits for the same angle in every column: they take less room.
            values = [round(_TURNS[turn](radians(order * angle % 360)), 15) for angle in angles]
            writer.column(sheet, at, texts, values, _WAVE)


def _each(waves: Waves) -> Iterator[tuple[str, float]]:
    """Function and order of each wave."""
    for turn, orders in waves.orders.items():
        for order in orders:
            yield turn, order


def _write_run(sheet: Worksheet, writer: Writer, run: str) -> None:
    """Angles of a run side by side, below them a row an order."""
    layout = writer.layout
    keys, top = layout.keys_of_run(run), layout.run_waves[run]
    known = {field.name: field.value for field in layout.model.inputs} | writer.values.scalars
    if not all(key in known for key in keys):  # a work-book has some lists only
        return
    angles = [float(known[key]) for key in keys]
    cells = layout.cells_of_run(run)
    sheet.cell(top - 1, 1, cells[0].sheet).style = styles.SUBTITLE
    for column, (cell, angle) in enumerate(zip(cells, angles, strict=True), 2):
        _cell(sheet, writer, top, column, f"={cell.absolute}", angle)
    for row, (turn, order) in enumerate(_each(layout.run_orders[run]), top + 1):
        writer.formula(sheet, row, 1, f"={number(order)}", order)
        sheet.cell(row, 1).style = styles.NUMBER
        for column, angle in enumerate(angles, 2):
            letter = get_column_letter(column)
            text = f"={turn.upper()}({letter}${top}*($A{row}*PI()/180))"
            value = round(_TURNS[turn](radians(order * angle)), 15)
            _cell(sheet, writer, row, column, text, value)


def _cell(sheet: Worksheet, writer: Writer, row: int, column: int, text: str, value: float) -> None:
    writer.formula(sheet, row, column, text, value)
    cell = sheet.cell(row, column)
    cell.style, cell.number_format = _WAVE
