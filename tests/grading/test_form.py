"""The institute's form comes back with marks and with everything else that was in it."""

from __future__ import annotations

import io
import re
import zipfile
from pathlib import Path

import pytest
import xlsxwriter
from openpyxl import load_workbook

from reports.grading.issuing.rubric import Form, MarkScale, Rubric
from reports.grading.pages.form import filled_form
from reports.shared.errors import InputError
from tools.referees.by_libreoffice import LibreOffice

NAMES = ("Алексеева М.", "Борисов П.", "Васильев А.")
RUBRIC = Rubric(
    scale=MarkScale(marks={"5": 85, "4": 70, "3": 50}),
    form=Form(first_row=5, student="B", points="C", mark="D", number="A", cells={"B2": "группа"}),
)
PIXEL = bytes.fromhex(
    "89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c4890000000d49444154789c6360f8cf"
    "c0f01f0005050102cf9c6a770000000049454e44ae426082"
)


def rows(*points: float) -> list[dict]:
    full = ("Алексеева Мария", "Борисов Пётр", "Васильев Андрей")
    return [
        {"number": n, "student": name, "group": "Д & М <1>", "points": value, "manual": False,
         "status": "проверено"}
        for n, (name, value) in enumerate(zip(full, points, strict=True), 1)
    ]  # fmt: skip


def form(path: Path, *, listed: bool = True, shared: bool = False) -> Path:
    """A form as a registry makes it."""
    with xlsxwriter.Workbook(path) as book:
        sheet, other = book.add_worksheet("Ведомость"), book.add_worksheet("Итог")
        bold, red, frame = (book.add_format(look) for look in
                            ({"bold": True}, {"font_color": "red"}, {"border": 1}))  # fmt: skip
        sheet.set_column(2, 3, 12, frame)
        sheet.write_rich_string("A1", "Форма ", bold, "17-У", red, " вуза")
        sheet.insert_textbox("F2", "Форма 17-У, заполняется чернилами")
        sheet.set_header("&L&G&CВедомость", {"image_left": "a.png",
                                             "image_data_left": io.BytesIO(PIXEL)})  # fmt: skip
        sheet.insert_image("F12", "b.png", {"image_data": io.BytesIO(PIXEL)})
        sheet.add_sparkline("E5", {"range": "Ведомость!C5:D5"})
        chart = book.add_chart({"type": "column"})
        chart.add_series({"values": "=Ведомость!$C$5:$C$7"})
        sheet.insert_chart("F20", chart)
        sheet.conditional_format("C5:C7", {"type": "data_bar"})
        sheet.data_validation("D5:D7", {"validate": "list", "source": ["5", "4", "3", "2"]})
        for row, name in enumerate(NAMES, 4):
            sheet.write(row, 1, name if listed else None)
            sheet.write_blank(row, 3, None, red)
        sheet.write_formula("C9", "=AVERAGE(C5:C7)", frame, 11)
        other.write_formula("A1", "=COUNTIF(Ведомость!D5:D7,5)", None, 22)
        if shared:
            sheet.write_formula("D5", "=C5/20")
    return path


def parts(data: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


SHEET, OTHER, BOOK = "xl/worksheets/sheet1.xml", "xl/worksheets/sheet2.xml", "xl/workbook.xml"


def rest(sheet: bytes) -> str:
    """A sheet without the rows that are filled in and the values of its formulas."""
    text = re.sub(r'<row r="[2567]".*?</row>', "", sheet.decode(), flags=re.DOTALL)
    return re.sub(r"(</f>)<v>[^<]*</v>", r"\1", text)


@pytest.mark.parametrize("listed", [True, False])
def test_a_form_keeps_every_byte_but_the_cells_that_are_filled_in(tmp_path, listed):
    path = form(tmp_path / "a.xlsx", listed=listed)
    before, data = parts(path.read_bytes()), filled_form(path, rows(100, 72.5, 10), RUBRIC).data
    after = parts(data)
    assert before.keys() == after.keys()
    assert {name for name in before if before[name] != after[name]} <= {SHEET, OTHER, BOOK}
    assert rest(after[SHEET]) == rest(before[SHEET])
    assert "rich" not in rest(after[SHEET]) and "sparkline" in rest(after[SHEET])
    sheet = load_workbook(io.BytesIO(data))["Ведомость"]
    lines = [[cell.value for cell in row] for row in sheet["A5:D7"]]
    names = NAMES if listed else ("Алексеева Мария", "Борисов Пётр", "Васильев Андрей")
    assert lines == [[1, names[0], 100, 5], [2, names[1], 72.5, 4], [3, names[2], 10, 2]]
    assert sheet["B2"].value == "Д & М <1>"
    assert sheet["D5"].font.color.rgb == "FFFF0000" and sheet["C5"].border.left.style == "thin"


@pytest.mark.libreoffice
def test_what_a_form_calculates_follows_the_marks(tmp_path):
    """What was saved before belongs to other marks."""
    data = filled_form(form(tmp_path / "a.xlsx"), rows(100, 80, 90), RUBRIC).data
    assert b"fullCalcOnLoad" in parts(data)[BOOK]
    book = load_workbook(io.BytesIO(LibreOffice().converted([data])[0]), data_only=True)
    assert book["Ведомость"]["C9"].value == pytest.approx(90)
    assert book["Итог"]["A1"].value == 2


@pytest.mark.parametrize("prefixed", [False, True])
def test_a_form_of_another_program_is_filled_in(tmp_path, prefixed):
    """With prefixes, rows and cells without addresses, rows that are not there."""
    path = form(tmp_path / "a.xlsx")
    edited = parts(path.read_bytes())
    text = edited[SHEET].decode()
    if prefixed:
        text = re.sub(r"<(/?)(?=\w)(?![\w]+:)", r"<\1x:", text)
        text = text.replace('xmlns="', 'xmlns:x="', 1)
    else:
        text = re.sub(r' r="[A-Z]?\d+"(?= spans| s=| t=)', "", text, count=3)
        text = re.sub(r'<row r="6".*?</row>', "", text)
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as target:
        for name, data in edited.items():
            target.writestr(name, text.encode() if name == SHEET else data)
    path.write_bytes(stream.getvalue())
    filled = filled_form(path, rows(100, 72.5, 10), RUBRIC)
    sheet = load_workbook(io.BytesIO(filled.data))["Ведомость"]
    assert [sheet["C5"].value, sheet["D5"].value, sheet["D7"].value] == [100, 5, 2]
    assert filled.written == (3 if prefixed else 2)


def test_a_formula_that_stands_in_the_place_of_a_mark_goes_whole(tmp_path):
    """Or is refused where other cells have a part in it."""
    path = form(tmp_path / "a.xlsx", shared=True)
    data = filled_form(path, rows(100, 72.5, 10), RUBRIC).data
    assert load_workbook(io.BytesIO(data))["Ведомость"]["D5"].value == 5
    edited = parts(path.read_bytes())
    edited[SHEET] = edited[SHEET].replace(b"<f>C5/20", b'<f t="shared" ref="D5:D7" si="0">C5/20')
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as target:
        for name, part in edited.items():
            target.writestr(name, part)
    path.write_bytes(stream.getvalue())
    with pytest.raises(InputError, match="D5: в ячейке формула, общая для нескольких ячеек"):
        filled_form(path, rows(100, 72.5, 10), RUBRIC)
