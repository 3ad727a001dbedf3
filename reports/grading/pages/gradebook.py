"""Gradebook as a workbook and CSV, with a sheet for the printer."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from reports.exports.numbers import neutralised
from reports.grading.pages.states import State

if TYPE_CHECKING:
    from openpyxl import Workbook

_HEAD = ("Вариант", "Студент", "Группа", "Баллы", "Из", "Состояние", "Файл", "Замечания")
# Filled in by the instructor, read back by the next run.
DECISION = ("Решение: баллы", "Решение: примечание")
OF_FILE = "SHA-256"  # in a hidden column: the file that was decided on
_FOR_TEACHER = ("State", "For the teacher")  # Moodle's import passes by what nobody maps
_AS_TYPED = "@"  # a spreadsheet makes 5 of «+5» and 0.5 of «50%»
GROUPS, DECIDED = "Решения", "решено"
_GROUP_HEAD = ("Группа", "Работ", "Что", "Почему ждёт", "Формула", "Из", *DECISION, "Студенты")
_GROUP_WIDTHS = (11, 8, 20, 46, 40, 7, 10, 26, 60)
TITLE = "Для печати"
_PRINTED = ("№", "Студент", "Группа", "Баллы", "Состояние")
_POINTS_COLUMN, _STATE_COLUMN = 4, 5  # points stand in the others behind them as well
_WIDTHS = (3.2, 20.0, 7.0, 5.0, 11.0)  # in digits of the default font, for letters of _SIZE_PT
_TABLE = 4.2  # width of a table's points
_SIZE_PT, _PAGE = 5.6, 142.0  # size of the letters, width of a page
_HEAD_PT, _PAGE_PT = 56.0, 538.0  # heights: of the titles, of a page without margins
_MIN_PT, _MAX_PT = 6.8, 13.0  # height of a row
_LARGE = 42  # students on one page; more take two, as many as these hold


def gradebook_csv(rows: Sequence[dict[str, Any]], maximum: float) -> str:
    """Return the gradebook: a row a student, a column a table; opens in Excel as it is."""
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
                neutralised(whole_remark(row)),
                *(_decimal(shares.get(block)) for block in blocks),
            ]
        )
    return "\ufeff" + stream.getvalue()


def whole_remark(row: Mapping[str, Any]) -> str:
    """Return the remark on a work with what it shares with others: for the teacher."""
    return "; ".join(filter(None, (row["remark"], row.get("similar"))))


def moodle_csv(rows: Sequence[dict[str, Any]]) -> str:
    """Grades as Moodle's import of grades from a CSV file takes them."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["Identifier", "Full name", "Email address", "ID number", "Grade", "Feedback",
                     *_FOR_TEACHER])  # fmt: skip
    for row in rows:
        result = row["result"]
        if row["number"] is None or result is None:
            continue
        participant = f"Participant {row['moodle_id']}" if row["moodle_id"] else ""
        # No grade where a person has to look first; whom he suspects of what students do not read.
        grade = "" if row["points"] is None or row["manual"] else f"{row['points']:g}"
        texts = [participant, row["student"], row["email"], row["id"]]
        remark = "" if row["status"] == State.HELD else row["remark"]
        cells = [remark, row["status"], whole_remark(row)]
        writer.writerow([*map(neutralised, texts), grade, *map(neutralised, cells)])
    return stream.getvalue()


def gradebook_xlsx(
    rows: Sequence[dict[str, Any]], maximum: float, groups: Sequence[Mapping[str, Any]] = (),
    decided: Sequence[Mapping[str, Any]] = (),
) -> bytes:  # fmt: skip
    """Return gradebook as a workbook: for reading, for deciding, and a sheet for the printer."""
    from openpyxl import Workbook
    from openpyxl.styles import Alignment, Font, PatternFill, Protection
    from openpyxl.worksheet.pagebreak import Break, ColBreak

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
        points = word.get("word") or ("+" if word and word["points"] is None
                                      else word.get("points"))  # fmt: skip
        sheet.append(
            [row["number"], row["student"], row["group"], row["points"], maximum, row["status"],
             whole_remark(row), points, word.get("remark"),
             *(shares.get(block) for block in blocks), row["file"],
             row["result"].sha256 if row["result"] else ""]
        )  # fmt: skip
        for cell in sheet[sheet.max_row]:
            as_text(cell)
            cell.alignment = wrapped
        for column in (8, 9):
            sheet.cell(sheet.max_row, column).fill = yellow
            sheet.cell(sheet.max_row, column).protection = Protection(locked=False)
            sheet.cell(sheet.max_row, column).number_format = _AS_TYPED
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
    if groups or decided:
        _add_groups(book, groups, decided)
    add_printed(book, rows, [_shares(row) for row in rows], blocks)
    return finish(book)


def _add_groups(
    book: Workbook, groups: Sequence[Mapping[str, Any]], decided: Sequence[Mapping[str, Any]]
) -> None:
    """Add the sheet on which one decision serves all works of a group, and can be taken back."""
    from openpyxl.styles import Alignment, Font, PatternFill

    from reports.workbook.styles import as_text

    sheet = book.create_sheet(GROUPS)
    sheet.append(_GROUP_HEAD)
    wrapped = Alignment(wrap_text=True, vertical="top")
    lines = [
        [group["name"], len(group["numbers"]), group["what"], group["why"], group["formula"],
         group["of"], None, None, ", ".join(with_points(group))]
        for group in groups
    ]  # fmt: skip
    waiting = {group["name"] for group in groups}
    lines += [
        [group["name"], len(group["numbers"]), group["what"], DECIDED, None, None,
         group["points"], group["remark"], ", ".join(group["students"])]
        for group in decided
        if group["name"] not in waiting
    ]  # fmt: skip
    for line in lines:
        sheet.append(line)
        for cell in sheet[sheet.max_row]:
            as_text(cell)
            cell.alignment = wrapped
        for column in (7, 8):
            sheet.cell(sheet.max_row, column).fill = PatternFill("solid", fgColor="FFF9DB")
            sheet.cell(sheet.max_row, column).number_format = _AS_TYPED
    for cell, width in zip(sheet[1], _GROUP_WIDTHS, strict=True):
        cell.font, cell.alignment = Font(name="Calibri", bold=True), wrapped
        cell.fill = PatternFill("solid", fgColor="D9E2F3")
        sheet.column_dimensions[cell.column_letter].width = width
    sheet.freeze_panes = "B2"
    sheet.page_setup.orientation, sheet.page_setup.paperSize = "landscape", sheet.PAPERSIZE_A4
    sheet.page_setup.fitToWidth, sheet.page_setup.fitToHeight = 1, 0
    sheet.sheet_properties.pageSetUpPr.fitToPage = True
    sheet.print_title_rows = "1:1"


def with_points(group: Mapping[str, Any]) -> list[str]:
    """Students of a group with the points that they have: what a factor is a factor of."""
    pairs = zip(group["students"], group["points"], strict=True)
    return [f"{name} ({'—' if points is None else _decimal(points)})" for name, points in pairs]


def _blocks(rows: Sequence[dict[str, Any]]) -> list[str]:
    blocks: dict[str, None] = {}
    for row in rows:
        for line in row["result"].items if row["result"] else ():
            if line.of:
                blocks.setdefault(line.heading)
    return list(blocks)


def _shares(row: dict[str, Any]) -> dict[str, float]:
    """Points of each table before the factor for lateness."""
    shares: dict[str, float] = {}
    for line in row["result"].items if row["result"] else ():
        if line.of:
            shares[line.heading] = shares.get(line.heading, 0.0) + line.points
    return {block: round(value, 2) for block, value in shares.items()}


def _decimal(value: float | None) -> str:
    return "" if value is None else f"{value:g}".replace(".", ",")


# --- the printer's sheet -------------------------------------------------------------------------


def add_printed(
    book: Workbook, rows: Sequence[Mapping[str, Any]], shares: Sequence[Mapping[str, float]],
    blocks: Sequence[str],
) -> None:  # fmt: skip
    """Add the sheet; ``shares`` are the points of each row's tables."""
    from openpyxl.styles import Alignment, Border, Font, PatternFill, Side

    from reports.workbook.styles import as_text

    sheet = book.create_sheet(TITLE)
    sheet.append([*_PRINTED, *(block.removeprefix("Таблица ") for block in blocks)])
    on_page = len(rows) if len(rows) <= _LARGE else -(-len(rows) // 2)
    height = min(_MAX_PT, max(_MIN_PT, (_PAGE_PT - _HEAD_PT) / max(1, on_page)))
    for row, of in zip(rows, shares, strict=True):
        sheet.append([row["number"], row["student"], row["group"], row["points"], row["status"],
                      *(of.get(block) for block in blocks)])  # fmt: skip
    widths = (*_WIDTHS, *(_TABLE for _ in blocks))
    large = min(height * 0.8 / _SIZE_PT, max(1.0, _PAGE / sum(widths)))
    size = round(_SIZE_PT * large, 1)
    thin = Side(style="hair")
    border, fill = (
        Border(bottom=thin, left=thin, right=thin),
        PatternFill("solid", fgColor="D9E2F3"),
    )
    plain, bold = Font(name="Calibri", size=size), Font(name="Calibri", size=min(6.5, size), b=True)
    inside = Alignment(shrink_to_fit=True, vertical="center")
    upright = Alignment(wrap_text=True, vertical="bottom")
    turned = Alignment(wrap_text=True, vertical="bottom", text_rotation=90)
    for number, line in enumerate(sheet.iter_rows(), 1):
        for cell in line:
            as_text(cell)
            table = cell.column > len(_PRINTED)
            cell.font, cell.border = (bold if number == 1 else plain), border
            if number == 1:
                cell.fill, cell.alignment = fill, (turned if table else upright)
            else:
                cell.alignment = inside
                if cell.column >= _POINTS_COLUMN and cell.column != _STATE_COLUMN:
                    cell.number_format = "0.0#"
        sheet.row_dimensions[number].height = _HEAD_PT if number == 1 else height
    for cell, width in zip(sheet[1], widths, strict=True):
        sheet.column_dimensions[cell.column_letter].width = width * large
    sheet.freeze_panes = sheet.cell(2, 3)
    sheet.page_setup.orientation, sheet.page_setup.paperSize = "landscape", sheet.PAPERSIZE_A4
    sheet.page_setup.fitToWidth = 1
    fits = on_page * _MIN_PT <= _PAGE_PT - _HEAD_PT
    sheet.page_setup.fitToHeight = (1 if on_page == len(rows) else 2) if fits else 0
    sheet.sheet_properties.pageSetUpPr.fitToPage = True
    sheet.print_title_rows = "1:1"
    margins = sheet.page_margins
    margins.left = margins.right = margins.top = 0.3
    margins.bottom, margins.footer, margins.header = 0.45, 0.2, 0.1
    sheet.oddFooter.center.text, sheet.oddFooter.center.size = "Лист &P из &N", 8
