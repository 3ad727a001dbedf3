"""What a supervisor marks in the chapters: numbers against sentences, symbols, limits."""

import html
import itertools
import re

import pytest

from reports.document.text.texts import limits
from tests.document.bare_pages import plain
from tests.document.test_report_sentences import engine, page_of, printed_rows, text_of, words_of

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]


def end_of(text):
    """The conclusion."""
    return text[text.index("Рассчитаны кинематика") :]


# --- usual limits ---


@pytest.mark.parametrize(
    ("usual", "shown"),
    [("0…2,2", "до 2,2"), ("0…40 МПа", "до 40 МПа"), ("-5…10", "−5…10"), ("1…1", "1"),
     ("0,1…0,4", "0,1…0,4")],
)  # fmt: skip
def test_limits_from_zero_have_an_upper_end_alone(usual, shown):
    assert limits(usual) == shown


def test_the_conclusion_tells_what_of_the_cycle_lies_outside():
    """ΔT and ξ_b of the turbocharged diesel: «в обычных пределах» would not be true."""
    page = page_of("cycle-turbo-diesel", "course")
    rows = printed_rows(page, "Результаты и обычные пределы")
    outside = [row[0] for row in rows if row[3] != "в пределах"]
    end = end_of(plain(page))
    assert outside and "подогрев свежего заряда ΔT 11,00 К (обычно −5…10)" in end
    assert "лежат в обычных пределах" not in end
    inside = words_of("cycle-tractor-diesel", "course")
    assert ("принятые данные и результаты расчёта цикла лежат в обычных пределах" in inside) == (
        "вне обычных пределов: " not in end_of(inside)
    )


@pytest.mark.parametrize("name", ["cycle-turbo-diesel", "cycle-petrol"])
def test_a_quantity_has_one_usual_span(name):
    """p_z and η_м stood beside two spans: of the data and of the cycle."""
    page = page_of(name, "course")
    data = {row[1]: row[3] for row in printed_rows(page, "Принятые данные и обычные пределы")}
    cycle = {row[0]: row[2] for row in printed_rows(page, "Результаты и обычные пределы")}
    for symbol, words in (("pz", "Максимальное давление"), ("ηм", "Механический КПД")):
        assert data[symbol] == next(span for title, span in cycle.items() if words in title)


@pytest.mark.parametrize(
    ("name", "known"), [("Дизель 4Ч", True), ("Двигатель с искровым зажиганием", True),
                        ("Двигатель", False)],
)  # fmt: skip
def test_spans_of_two_kinds_of_engine_are_not_called_those_of_this_kind(name, known):
    text = text_of(engine(engine__name=name, report__detail="course"))
    assert ("с обычными для двигателей этого вида" in text) == known
    assert ("двигателей с искровым зажиганием и дизелей" in text) == (not known)


def test_limits_of_a_throw_with_one_rod_are_called_so():
    said = "Пределы относятся к колену с одним шатуном"
    assert said in words_of("yamz-236")
    assert said not in text_of(engine(crankshaft__pin_mass_kg=0.1, report__detail="short"))


# --- the working cycle ---


def formulas_of(page):
    """TeX of the formulas of a page, in their order."""
    return [html.unescape(tex) for tex in re.findall(r'data-tex="([^"]*)"', page)]


@pytest.mark.parametrize("name", ["cycle-turbo-diesel", "cycle-petrol"])
def test_symbols_of_the_cycle_are_those_of_its_tables(name):
    """The coefficients a, b, c of the characteristic were called a_N, b_N, c_N below it."""
    page = page_of(name, "course")
    text, formulas = plain(page), " ".join(formulas_of(page))
    assert "a_N + b_N x - c_N x^2" in formulas and "a_g + b_g x + c_g x^2" in formulas
    assert "= H_z" in formulas and "левая часть уравнения" not in text
    columns = {"w": "вес верхней формулы", "h": "отношение (Q + Uz", "Δc": "добавка к истинной",
               "cb": "истинная теплоёмкость при tb"}  # fmt: skip
    for symbol, meaning in columns.items():
        assert f"{symbol} — {meaning}" in text, symbol


def test_passes_that_changed_nothing_are_not_printed():
    for which in ("сжатия", "расширения"):
        rows = printed_rows(page_of("cycle-turbo-diesel", "course"),
                            f"Последовательные приближения показателя политропы {which}")  # fmt: skip
        alike = [one[1:] == other[1:] for one, other in itertools.pairwise(rows)]
        assert not any(alike[:-1]) and alike[-1]


@pytest.mark.parametrize("name", ["cycle-turbo-diesel", "cycle-petrol", "cycle-tractor-diesel"])
def test_the_temperature_of_residual_gases_is_above_or_below(name):
    text = words_of(name, "course")
    rows = printed_rows(page_of(name, "course"), "Проверки расчёта")
    gap = next(row[1] for row in rows if row[0].startswith("Температура Tr"))
    assert f"она {'ниже' if gap.startswith('−') else 'выше'} принятой на" in text
    assert not re.search(r"отличается от принятой|принятой на −", text)


@pytest.mark.parametrize(
    "words",
    ["по правилу Ньютона", "начало видимого расширения", "Остаток включает", "Проход"],
)
def test_words_that_no_engineer_writes_of_a_cycle(words):
    for name in ("cycle-turbo-diesel", "cycle-petrol"):
        assert words not in words_of(name, "course")


def test_constants_of_the_turbocharger_are_told():
    said = "1,005 кДж/(кг·К) для воздуха и 1,15 кДж/(кг·К) для газов"
    assert said in words_of("cycle-turbo-diesel", "course")
    assert said not in words_of("cycle-petrol", "course")
