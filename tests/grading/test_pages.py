"""Feedback pages: what a student may see."""

from __future__ import annotations

import io
from dataclasses import replace
from types import SimpleNamespace

import pytest
from openpyxl import load_workbook

from reports.grading.judging.work_digest import Entry, work_of
from reports.grading.pages.gradebook import TITLE, gradebook_xlsx
from reports.grading.pages.pages import line_chart, number, student_page
from reports.grading.pages.summary import summarise
from tests.grading import classroom
from tests.grading.test_verdicts import formulas, graded, line

ITEM = "P3_1.v1_m_s"


def page(mode: str) -> tuple[str, dict]:
    """A page of a book with one wrong column."""
    wrong = [f.replace("RADIANS", "") for f in formulas()[ITEM]]
    result = graded({ITEM: wrong})
    rubric = classroom.register().rubric
    feedback = rubric.feedback.model_copy(update={"mode": mode})
    return student_page(result, rubric.model_copy(update={"feedback": feedback})), line(
        result, ITEM
    )


def test_hints_do_not_draw_the_right_curve():
    html, item = page("hints")
    chart = item["chart"]
    axes = ("φ, °", "м/с")
    assert line_chart(chart["x"], chart["own"], None, axes) in html
    assert "<b>П3.1 v<sub>п1</sub>, м/с</b>" in html
    assert 'class="right"' not in html
    assert "правильные значения" not in html
    assert "значения и правильные" not in html
    # No point of the right curve, as a number or as a place on the page.
    shown = {number(cell["own"], item["digits"]) for cell in item["cells"]}
    for cell in item["cells"]:
        right = number(cell["right"], item["digits"])
        assert right in shown or f">{right}<" not in html


def test_what_a_person_must_look_at_is_not_counted_as_wrong():
    texts = {ITEM: ['=INDIRECT("A6")'] * 13, "V_c": ['=INDIRECT("C10")/17'], "omega": ["=1"]}
    work = work_of(graded(texts), {})
    (omega,) = summarise(classroom.register(), [work])["hardest"]
    assert (omega["wrong"], omega["unknown"]) == (1, 0)
    typed = work_of(graded({ITEM: [1.0] * 13}), {})
    counts = summarise(classroom.register(), [replace(typed, number=2), work])["hardest"]
    (collected,) = [entry for entry in counts if "vп1" in entry["title"]]
    assert (collected["wrong"], collected["unknown"]) == (1, 1)


def test_what_is_begun_is_to_be_mended_and_what_is_not_stands_apart():
    filled = formulas()[ITEM]
    parts = {}
    for kept in (0, 6):
        cells = filled[:kept] + [""] * (len(filled) - kept)
        html = student_page(graded({ITEM: cells}), classroom.register().rubric)
        parts[kept] = html.partition("Не заполнено или опереться не на что")
    assert "Что исправить" not in parts[0][0] and f'id="{ITEM}"' in parts[0][2]
    assert f'id="{ITEM}"' in parts[6][0].partition("Что исправить")[2]
    assert "Строки: 180; 210; 240" in parts[6][0] and 'id="P3_1.v_m_s"' in parts[6][2]


@pytest.mark.parametrize(("share", "words"), [(1.0, "не снимаются"), (0.5, "доля баллов 0,5")])
def test_what_an_earlier_mistake_costs_is_told_as_the_rubric_has_it(share, words):
    rubric = classroom.register().rubric
    rubric = rubric.model_copy(
        update={"credit": rubric.credit.model_copy(update={"carried": share})}
    )
    assert words in student_page(graded({"omega": ["=regime_speed_rpm"]}), rubric)


def test_a_question_ends_with_its_own_mark():
    result, rubric = graded({"omega": ["=regime_speed_rpm"]}), classroom.register().rubric
    line(result, "geometry.omega")["reason"] = "вычислено ли это?"
    assert "Вычислено ли это?</p>" in student_page(result, rubric)


def test_full_feedback_draws_both_curves():
    html, item = page("full")
    chart = item["chart"]
    assert line_chart(chart["x"], chart["own"], chart["right"], ("φ, °", "м/с")) in html
    assert html.count('class="right"') == 2  # the curve and its sample in the legend
    assert all(f">{number(cell['right'], item['digits'])}<" in html for cell in item["cells"])


@pytest.mark.parametrize(("students", "tables", "pages"), [(30, 17, 1), (140, 17, 2), (140, 24, 2)])
def test_a_class_is_printed_on_two_landscape_pages(students, tables, pages):
    entries = [
        Entry(f"t{i}.x", f"Таблица П4.{i}", "", "", "right", 1.5, 1.5, "", "", None)
        for i in range(tables)
    ]
    rows = [
        {"number": n, "student": f"Константинопольский Александр {n}", "group": "ДВС-1",
         "points": 98.76, "status": "нужна ручная проверка", "remark": "", "file": "", "manual": 0,
         "decision": None, "result": SimpleNamespace(sha256="", items=entries)}
        for n in range(1, students + 1)
    ]  # fmt: skip
    sheet = load_workbook(io.BytesIO(gradebook_xlsx(rows, 100)))[TITLE]
    assert sheet.max_row == students + 1
    assert sheet.cell(students + 1, 6).value == 1.5
    assert (sheet.page_setup.fitToWidth, sheet.page_setup.fitToHeight) == (1, pages)
    # A landscape A4 without margins, in points; a column is wider than its digits by 5 pixels.
    heights = [sheet.row_dimensions[n].height for n in range(1, students + 2)]
    on_page = -(-students // pages)
    assert sum(heights[: on_page + 1]) < 595 - 72 * (0.3 + 0.45)
    widths = [sheet.column_dimensions[cell.column_letter].width for cell in sheet[1]]
    assert sum(7 * width + 5 for width in widths) * 0.75 < (842 - 72 * 0.6) * 1.1  # shrunk little
    assert sheet.cell(2, 2).font.size >= 5.4
