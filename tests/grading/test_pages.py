"""Feedback pages: what a student may see."""

from __future__ import annotations

from reports.grading.pages.chart import line_chart
from reports.grading.pages.pages import number, student_page
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
    assert line_chart(chart["x"], chart["own"], None) in html
    assert 'class="right"' not in html
    assert "правильные значения" not in html
    assert "значения и правильные" not in html
    # No point of the right curve, as a number or as a place on the page.
    shown = {number(cell["own"], item["digits"]) for cell in item["cells"]}
    for cell in item["cells"]:
        right = number(cell["right"], item["digits"])
        assert right in shown or f">{right}<" not in html


def test_full_feedback_draws_both_curves():
    html, item = page("full")
    chart = item["chart"]
    assert line_chart(chart["x"], chart["own"], chart["right"]) in html
    assert html.count('class="right"') == 2  # the curve and its sample in the legend
    assert all(f">{number(cell['right'], item['digits'])}<" in html for cell in item["cells"])
