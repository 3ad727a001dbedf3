"""What a supervisor sends back: sentences that are not true, numbers told twice, words of no one."""

import re

import pytest

from reports.document.chapters.chapter import after_noun
from reports.inputs.solve_input import refined, solved
from reports.shared.russian import instrumental
from tests.conftest import sample
from tests.document.test_report_sentences import engine, page_of, plain, printed_rows, text_of

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]


def test_a_warning_about_the_input_is_no_sentence_of_the_note():
    """A piston of 3 g passes with a warning, which the console and the workbook tell."""
    model = engine(masses__piston_group_kg=0.003, masses__reciprocating_kg=None,
                   masses__rod_kg=1.8, masses__rod_big_end_kg=None,
                   masses__rod_small_end_share=0.28)  # fmt: skip
    text = text_of(model)
    assert "Внимание" not in text and "проверьте" not in text


def test_results_of_a_coarse_step_stand_in_a_table_of_every_profile():
    for detail in ("short", "course", "full"):
        page = page_of("yamz-236", detail)
        if "checks" in detail or detail != "short":
            assert printed_rows(page, "Результаты, для которых шаг таблиц велик")
        assert "в тексте сопровождаются" not in plain(page)


def test_the_line_of_an_offset_pin_does_not_cross_the_axis():
    text = text_of(engine("offset"))
    assert "Прямая, по которой движется ось поршневого пальца, не пересекает ось вала" in text


def test_statics_leads_where_the_rule_of_half_a_torque_is_off():
    """The table, the sentence and the conclusion hold the range of the same torque."""
    model = engine("split", report__detail="course")
    text = text_of(model)
    tables = solved(model).columns["P4_5s"]
    swings = [
        float(column.max() - column.min()) for key, column in tables.items() if "Mpins" in key
    ]
    said = re.search(r"среди шатунных — у ше(?:йки|ек) [^:]*: ([\d\xa0 ]+) Н·м", text)
    assert said, "no range of crankpins"
    assert float(re.sub(r"\D", "", said[1])) == pytest.approx(max(swings), abs=0.6)
    assert f"— {said[1].strip()} Н·м" in text[text.index("Рассчитаны кинематика") :]


def test_the_flywheel_is_that_of_the_fine_step_wherever_it_is_told():
    model = engine(report__detail="course", calculation__step_deg=30.0)
    inertia = float(solved(refined(model)).scalars["I_flywheel"])
    text = text_of(model)
    said = {float(n.replace(",", ".")) for n in re.findall(r"J?I?м(?:ах)? = ([\d,]+) кг·м2", text)}
    end = text[text.index("Рассчитаны кинематика") :]
    number = re.search(r"маховик для неравномерности хода [\d,]+: ([\d,]+) кг", end)
    assert number, "the conclusion tells no flywheel"
    assert float(number[1].replace(",", ".")) == pytest.approx(inertia, rel=1e-3)
    assert said <= {float(number[1].replace(",", "."))}


def test_a_film_below_the_allowed_reserve_is_not_called_enough():
    for allowed, word in ((1.01, "плёнки достаточно."), (9.0, "плёнки недостаточно")):
        model = engine(source="d-240-bearings", report__detail="course",
                       bearings__reserve_allowed=allowed)  # fmt: skip
        text = text_of(model)
        reserve = float(re.search(r"Запас плёнки за цикл ([\d,]+)", text)[1].replace(",", "."))
        assert ("не меньше допускаемого" in text) or reserve < allowed
        assert (word in text[text.index("Запас плёнки за цикл") :][:400]) == (
            (reserve >= allowed) == (word == "плёнки достаточно.")
        )


def test_clearances_and_widths_of_the_film_are_printed():
    rows = printed_rows(page_of("d-240-bearings", "course"), "Размеры подшипников и зазоры")
    assert rows and all(len(row) == 5 and all(row) for row in rows)
    assert "0,007√d, мм" in plain(page_of("d-240-bearings", "course"))


def test_the_oil_hole_has_one_verdict():
    text = plain(page_of("d-240-bearings", "course"))
    end = text[text.index("Рассчитаны кинематика") :]
    assert re.search(r"сверлить под углом [\d…]+° от колена", end)
    if sample("d-240-bearings").crankshaft.oil_hole_deg is None:
        assert "там, где плёнка толще всего" in end


def test_a_cycle_has_one_effective_torque():
    text = plain(page_of("cycle-tractor-diesel", "course"))
    end = text[text.index("Рассчитаны кинематика") :]
    assert text.count("Me д") == 0 and "эффективный момент с учётом полноты" in end


def test_the_jump_at_the_dead_centre_is_told():
    """p_z is reached at once in TDC where the rise by the angle does not end there."""
    assert re.search(r"возрастает скачком от [\d,]+ МПа до [\d,]+ МПа", plain(page_of("gots-p43")))


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("Судовой дизель 6Ч 30/38", " 6Ч 30/38"),
        ("Бензиновый двигатель VR6", " VR6"),
        ("Дизель: рядный, цилиндров 4", " (рядный, цилиндров 4)"),
        ("Д-240", " «Д-240»"),
    ],
)
def test_an_engine_is_not_called_an_engine_twice(name, words):
    assert after_noun(name) == words


def test_counts_of_throws_are_words():
    assert instrumental(1, "коленом", "коленами") == "одним\xa0коленом"
    assert instrumental(4, "коленом", "коленами") == "четырьмя\xa0коленами"
    assert "Схема вала с тремя коленами показана" in plain(page_of("gots-diesel", "short"))


def test_a_department_stands_in_quotes():
    raw = {"report__department": "Поршневые двигатели"}
    assert "Кафедра «Поршневые двигатели»" in text_of(engine(**raw))
