"""What a supervisor marks in the chapters: numbers against sentences, symbols, limits."""


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
