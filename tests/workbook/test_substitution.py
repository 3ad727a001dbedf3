"""The lines over the tables: what they say is calculated anew from their own numbers."""

from __future__ import annotations

import io
import math
import re

import pytest
from openpyxl import Workbook, load_workbook

from reports.workbook.layout import TITLE_ROW
from reports.workbook.substitution import SHEET, shown
from tests.conftest import sample
from tests.grading import classroom
from tests.workbook.made import coarse_book
from tools.referees.by_libreoffice import LibreOffice

SAMPLES = ("gots-diesel", "yamz-236", "two-stroke", "d-240-bearings")
_SIGNS = {
    "·": "*", "−": "-", "10⁶": "1e6", "²": "**2", "³": "**3", "⁴": "**4", "√": "sqrt",
    "arcsin": "asin", "arccos": "acos", "π": "pi", "\u00a0": " ",
}  # fmt: skip


def calculated(text: str) -> float:
    """Value of what a line puts in."""
    for sign, other in _SIGNS.items():
        text = text.replace(sign, other)
    text = re.sub(r"(\d),(\d)", r"\1.\2", text)
    text = re.sub(r"([\d.]+)°", r"radians(\1)", text)
    text = re.sub(r"\|([^|]*)\|", r"abs(\1)", text)
    return float(eval(text, {"__builtins__": {}}, {**vars(math), "abs": abs}))


def lines_of(book: Workbook) -> dict[str, str]:
    """Sheet → the line over its table."""
    lines = {}
    for sheet in book.worksheets:
        texts = [cell.value for cell in sheet[TITLE_ROW] if isinstance(cell.value, str)]
        if sheet.title != SHEET and len(texts) > 2:
            lines[sheet.title] = texts[-1]
    return lines


@pytest.mark.parametrize("name", SAMPLES)
def test_every_line_gives_its_result(name: str) -> None:
    book = load_workbook(io.BytesIO(coarse_book(name)), data_only=True)
    rows = book[SHEET].iter_rows(min_row=6, min_col=5, max_col=6, values_only=True)
    hidden = [f"{head}{line}" for head, line in rows if line]
    assert set(lines_of(book).values()) <= set(hidden) and len(hidden) > 60
    for line in hidden:
        *_, put_in, result = line.split(" = ")
        number = result.split()[0]
        unit = 10.0 ** -len(number.partition(".")[2])
        assert calculated(put_in) == pytest.approx(float(number), rel=2e-3, abs=2 * unit), line


def test_a_line_follows_the_chosen_angle_and_column(libreoffice: LibreOffice) -> None:
    book = load_workbook(io.BytesIO(coarse_book("gots-diesel")))
    sheet = book["П3.1"]
    angle, column, line = [cell for cell in sheet[TITLE_ROW] if cell.value is not None][-3:]
    choices = {str(rule.sqref): rule.formula1 for rule in sheet.data_validations.dataValidation}
    assert {angle.coordinate, column.coordinate} <= choices.keys()
    angle.value, column.value = 90, "vп1"
    stream = io.BytesIO()
    book.save(stream)
    (data,) = libreoffice.converted([stream.getvalue()])
    geometry, speed = sample("gots-diesel").geometry, sample("gots-diesel").regime.speed_rpm
    r, omega = geometry.crank_radius_mm / 1000, math.pi * speed / 30
    text = load_workbook(io.BytesIO(data), data_only=True)["П3.1"][line.coordinate].value
    said = f"vп1 = r·ω·sin(φ) = {shown(r)}·{shown(omega)}·sin(90°) = {r * omega:.2f} м/с"
    assert text == said


def test_a_student_is_told_no_formula() -> None:
    book = load_workbook(io.BytesIO(classroom.handout()))
    assert SHEET not in book.sheetnames and not lines_of(book)


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0"), (-0.5, "(-0.5)"), (0.006082123, "0.00608212"), (26850.34, "26850.3"),
     (460.76692, "460.767"), (-1.2e-7, "(-0.00000012)"), (12.0, "12"),
     (0.128905, "0.12891"), (4.266775, "4.26678")],  # a spreadsheet rounds decimal halves up
)  # fmt: skip
def test_numbers_are_put_in_with_as_many_digits_as_tell(value: float, text: str) -> None:
    assert shown(value) == text
