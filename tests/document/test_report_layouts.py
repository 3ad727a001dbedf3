"""The report of every layout and section: all chapters are written, all references resolve.

Formulas and figures are left out here: what they look like is tested elsewhere.
"""

import pytest

from reports.document.report import Report
from reports.document.text.terms import Terms
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from tests import layouts
from tests.conftest import sample
from tests.document.report_samples import terms, terms_of, text_of

pytestmark = pytest.mark.usefixtures("nothing_is_drawn")


def of_layout(change) -> Terms:
    raw = to_mapping(sample("gots-diesel"))
    raw["report"]["detail"] = "full"
    model = build_model(load_mapping(change(raw), source="t.toml").model)
    return Terms(model, evaluate_model(model))


def page(page: Terms) -> str:
    return Report(page.model, page.values).page("screen")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (layouts.offset, "дезаксиального"),
        (layouts.articulated, "Прицепной шатун"),
        (layouts.split, "Силы двух шатунов на колене"),
        (layouts.two_stroke, "двухтактный"),
    ],
)
def test_a_layout_has_its_words(change, words):
    assert words in page(of_layout(change))


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("gots-p3", "Движение поршня и шатуна в относительных величинах"),
        ("gots-regimes", "Сравнение режимов работы"),
        ("cycle-turbo-diesel", "Турбокомпрессор"),
    ],
)
def test_a_section_has_its_chapter(name, words):
    assert words in page(terms(name))


def test_powers_of_ten_are_printed_as_such():
    text = page(terms("gots-diesel"))
    assert "·10<sup>−7</sup>" in text and "0,00000012" not in text


def test_a_broken_reference_is_told(monkeypatch):
    from reports.document import report
    from reports.shared.errors import NumberingError

    few = report.CHAPTERS[:4]
    monkeypatch.setattr(report, "CHAPTERS", few)
    with pytest.raises(NumberingError, match="необъявленное"):
        page(terms_of(text_of("one")))
