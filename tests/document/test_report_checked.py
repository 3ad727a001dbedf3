"""Values that a note holds to a limit: their digits, their units, which side they are on."""

from __future__ import annotations

import re
from functools import cache

import pytest

from reports.document.text.checked import allows, shown
from reports.document.text.terms import Terms
from reports.model.blocks import Held
from reports.model.evaluation import evaluate_model
from reports.shared.standing import Standing
from reports.tables.registry import build_model
from tests.document.bare_pages import plain
from tests.document.test_report_parts import page_of, with_every_part
from tests.document.test_report_sentences import printed_rows

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]


@cache
def terms_of(name: str) -> Terms:
    model = build_model(with_every_part(name))
    return Terms(model, evaluate_model(model))


def judged(name: str, key: str):
    return next(each for each in terms_of(name).judged if each.name == key)


@pytest.mark.parametrize("name", ["gots-diesel", "V12"])
def test_a_count_of_the_checks_is_whole_and_an_error_of_arithmetic_is_nought(name: str):
    """A count of one stood as 1,000 and a sum of forces that vanishes as 0,000."""
    values = {row[0]: row[1] for row in printed_rows(page_of(name), "Проверки расчёта")}
    (count,) = (value for title, value in values.items() if title.startswith("Число напряжений"))
    assert count == "1"
    assert not [value for value in values.values() if re.fullmatch(r"−?0,0+|.*,\d{4,}", value)]


@pytest.mark.parametrize(
    ("key", "value", "printed"),
    [
        ("fw_rim", 0.95294, "0,953"),
        ("fw_rim", 1.00002, "1,00002"),
        ("st_least", 0.99999, "0,99999"),
        ("st_least", 1.0, "1,00"),
        ("power", -46.714, "−46,71"),
        ("phases", 1e-9, "0"),
    ],
)
def test_a_printed_value_is_on_the_side_of_its_verdict(key: str, value: float, printed: str):
    """1,000 beside «не более 1» and «нет» contradicts itself."""
    terms, each = terms_of("gots-diesel"), judged("gots-diesel", key)
    limit = {"fw_rim": value <= 1, "st_least": value >= 1, "power": False, "phases": True}[key]
    standing = Standing.INSIDE if limit else Standing.FAILED
    assert shown(terms, type(each)(each.block, each.held, each.key, each.scalar, value, standing)) \
        == printed  # fmt: skip


def test_what_is_beyond_its_limit_names_the_limit_and_its_unit():
    """Stresses above what is allowed were told to be less than allowed, «МПа — 46,83»."""
    text, terms = plain(page_of("gots-diesel")), terms_of("gots-diesel")
    beyond = [each for each in terms.judged
              if each.held is Held.ALLOWED and each.standing is not Standing.INSIDE]  # fmt: skip
    assert {allows(terms, each).rpartition(" ")[0] for each in beyond} == {"не более", "не менее"}
    chapter = text[text.rindex("Правильность расчёта проверена") :]
    for each in beyond:
        _, comma, unit = each.title.rpartition(", ")
        shape = re.escape(f"— {shown(terms, each)}{' ' + unit if comma else ''} (")
        assert re.search(shape + allows(terms, each), chapter), each.title
    assert "меньше допускаемого: наибольшая" not in text
    # The abstract and the conclusion count them: the chapters before told each.
    assert text.count(f"результатов не в допускаемых пределах: {len(beyond)}") == 2
