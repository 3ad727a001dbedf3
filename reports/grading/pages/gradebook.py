"""The tables of grades: CSV and a workbook for the instructor, CSV for Moodle."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from typing import Any

from reports.exports.numbers import neutralised
from reports.grading.pages.summary import HELD

_HEAD = ("Вариант", "Студент", "Группа", "Баллы", "Из", "Состояние", "Файл", "Замечания")
# Filled in by the instructor, read back by the next run.
DECISION = ("Решение: баллы", "Решение: примечание")
OF_FILE = "SHA-256"  # in a hidden column: the file that was decided on


def gradebook_csv(rows: Sequence[dict[str, Any]], maximum: float) -> str:
    """The gradebook: a row a student, a column a table; opens in Excel as it is."""
    stream = io.StringIO()
    writer = csv.writer(stream, delimiter=";", lineterminator="\n")
    blocks = _blocks(rows)
    writer.writerow([*_HEAD, *blocks])
    for row in rows:
        shares = _shares(row)
        writer.writerow(
            [
                "" if row["number"] is None else row["number"],
                neutralised(row["student"]),
                neutralised(row["group"]),
                _decimal(row["points"]),
                _decimal(maximum),
                row["status"],
                neutralised(row["file"]),
                neutralised(row["remark"]),
                *(_decimal(shares.get(block)) for block in blocks),
            ]
        )
    return "\ufeff" + stream.getvalue()


def moodle_csv(rows: Sequence[dict[str, Any]]) -> str:
    """Grades as Moodle's import of grades from a CSV file takes them."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["Identifier", "Full name", "Email address", "ID number", "Grade", "Feedback"])
    for row in rows:
        result = row["result"]
        if row["number"] is None or result is None:
            continue
        participant = f"Participant {row['moodle_id']}" if row["moodle_id"] else ""
        # No grade where a person has to look first; whom he suspects of what students do not read.
        grade = "" if row["points"] is None or row["manual"] else f"{row['points']:g}"
        texts = [participant, row["student"], row["email"], row["id"]]
        remark = "" if row["status"] == HELD else neutralised(row["remark"])
        writer.writerow([*map(neutralised, texts), grade, remark])
    return stream.getvalue()


def gradebook_xlsx(rows: Sequence[dict[str, Any]], maximum: float) -> bytes:
    """The gradebook as a workbook: for reading, for deciding, and a sheet for the printer."""
    from openpyxl import Workbook
    from openpyxl.styles import Alignment, Font, PatternFill, Protection
    from openpyxl.worksheet.pagebreak import Break, ColBreak

    from reports.grading.pages.printed import add_printed
    from reports.workbook.caches import finish
    from reports.workbook.styles import as_text

    book = Workbook()
    sheet = book.active
    sheet.title = "Оценки"
    blocks = _blocks(rows)
    head = ("Вариант", "Студент", "Группа", "Баллы", "Из", "Состояние", "Замечания", *DECISION)
    sheet.append([*head, *blocks, "Файл", OF_FILE])
    wrapped = Alignment(wrap_text=True, vertical="top")
    yellow = PatternFill("solid", fgColor="FFF9DB")
    for row in rows:
        shares, word = _shares(row), row["decision"] or {}
        points = "+" if word and word["points"] is None else word.get("points")
        sheet.append(
            [row["number"], row["student"], row["group"], row["points"], maximum, row["status"],
             row["remark"], points, word.get("remark"), *(shares.get(block) for block in blocks),
             row["file"], row["result"].sha256 if row["result"] else ""]
        )  # fmt: skip
        for cell in sheet[sheet.max_row]:
            as_text(cell)
            cell.alignment = wrapped
        for column in (8, 9):
            sheet.cell(sheet.max_row, column).fill = yellow
            sheet.cell(sheet.max_row, column).protection = Protection(locked=False)
        if row["manual"]:
            sheet.cell(sheet.max_row, 6).fill = PatternFill("solid", fgColor="F8CBAD")
    for cell in sheet[1]:
        cell.font = Font(name="Calibri", bold=True)
        cell.alignment = wrapped
        cell.fill = PatternFill("solid", fgColor="D9E2F3")
    sheet.row_dimensions[1].height = 76  # points: titles of tables in five lines
    widths = (9, 28, 11, 9, 7, 17, 46, 10, 26, *(11 for _ in blocks), 30, 9)
    for cell, width in zip(sheet[1], widths, strict=True):
        sheet.column_dimensions[cell.column_letter].width = width
    sheet.column_dimensions[sheet.cell(1, sheet.max_column).column_letter].hidden = True
    sheet.freeze_panes = sheet.cell(2, 3)
    sheet.auto_filter.ref = sheet.dimensions
    sheet.page_setup.orientation, sheet.page_setup.paperSize = "landscape", sheet.PAPERSIZE_A4
    sheet.page_setup.fitToWidth, sheet.page_setup.fitToHeight = 2, 0
    sheet.sheet_properties.pageSetUpPr.fitToPage = True
    sheet.print_options.gridLines = True
    sheet.print_title_rows, sheet.print_title_cols = "1:1", "A:B"
    sheet.col_breaks = ColBreak()
    sheet.col_breaks.append(Break(id=len(head)))
    sheet.oddFooter.center.text = "Лист &P из &N"
    sheet.page_margins.left = sheet.page_margins.right = 0.4
    add_printed(book, rows, [_shares(row) for row in rows], blocks)
    return finish(book)


def _blocks(rows: Sequence[dict[str, Any]]) -> list[str]:
    found: dict[str, None] = {}
    for row in rows:
        for line in row["result"].items if row["result"] else ():
            if line.of:
                found.setdefault(line.heading)
    return list(found)


def _shares(row: dict[str, Any]) -> dict[str, float]:
    """Points of each table before the factor for lateness."""
    found: dict[str, float] = {}
    for line in row["result"].items if row["result"] else ():
        if line.of:
            found[line.heading] = found.get(line.heading, 0.0) + line.points
    return {block: round(value, 2) for block, value in found.items()}


def _decimal(value: float | None) -> str:
    return "" if value is None else f"{value:g}".replace(".", ",")
