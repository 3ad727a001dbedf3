"""Tables of notes with every chapter: their headings, units and digits, by ГОСТ 7.32."""

from __future__ import annotations

import html
import re

import pytest

from tests.document.test_report_parts import NEW, SAMPLES, page_of
from tests.document.test_report_sentences import printed_rows

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]


def bare(cell: str) -> str:
    return html.unescape(re.sub("<[^>]+>|\u00ad", "", cell)).strip()


@pytest.mark.parametrize("name", [*SAMPLES, *NEW])
def test_headings_of_columns_and_rows_begin_with_a_capital(name: str):
    """«шкив», «колено 1», «коренная 2» and «другой маховик» stood beside «Величина»."""
    headings = []
    for table in re.findall(r"<table.*?</table>", page_of(name), re.DOTALL):
        headings += map(bare, re.findall(r"<th\b.*?</th>", table, re.DOTALL))
        for row in re.findall(r"<tr.*?</tr>", table, re.DOTALL):
            headings += map(bare, re.findall(r"<td.*?</td>", row, re.DOTALL)[:1])
    assert len(headings) > 300
    assert [text for text in headings if re.match("[а-яё]{4}", text)] == []


@pytest.mark.parametrize("name", ["gots-diesel", "V12"])
def test_a_value_beside_its_limits_has_the_unit_in_its_name_and_its_own_digits(name: str):
    """«Овализация пальца 0,03, до 0,05 мм»: no unit, and one digit of three."""
    rows = printed_rows(page_of(name), "Напряжения и обычные пределы")
    again = printed_rows(page_of(name), "Напряжения и запасы с изменёнными размерами")
    values = {row[0]: row[1] for row in rows}
    assert all(re.search(", (МПа|мм)$", title) for title in values)
    assert not [row for row in rows + again if re.search("МПа|мм", row[2] + row[-1])]
    told = printed_rows(page_of(name), "Результаты расчёта поршневого пальца")
    (oval,) = (row[2] for row in told if row[0] == "Наибольшая овализация пальца")
    assert values["Овализация пальца, мм"] == oval and len(oval.lstrip("0,")) > 2
