"""What a strict reader of whole reports found: references, symbols, sentences of profiles."""

import re

import pytest

from tests.document import report_samples
from tests.document.bare_pages import plain
from tests.document.test_report_sentences import engine, page_of, printed_rows, text_of, words_of

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]


def test_neighbouring_numbers_are_a_range():
    text = words_of()
    assert "в таблицах Б.5–Б.8;" in text and "на рисунках 19–22;" in text
    assert "[1, формулы (28), (29)]" in text and "], [1, " not in text


def test_a_short_report_names_the_workbook_once():
    text = words_of(detail="short")
    assert "в таблицах П4.3.1–П4.3.4 книги Excel;" in text
    assert "книги Excel, П" not in text and "приложения А" not in text
    assert "Полярная диаграмма и условная диаграмма износа даны для шейки" in text


def test_conclusions_are_of_the_chapters_that_stand():
    for detail, message in (("short", False), ("course", True)):
        text = words_of(detail=detail)
        assert ("набегающего момента" in text[text.rindex("Основные результаты") :]) == message
    text = text_of(engine(report__chapters=["kinematics"]))
    end = text[text.rindex("Основные результаты") :]
    assert re.search(r"наибольшая скорость поршня [^;]*; ускорение [^;]*с2\. +Проверок", end)
    assert "Получено" not in text


def test_equal_loads_have_each_its_angle():
    text = words_of("yamz-236")
    assert re.search(r"шейки 2 и 3: [^;]* на каждую, шейка 2 при φ = 460°", text)


def test_what_is_not_computed_is_not_promised():
    offset = words_of("ecoboost-10")
    assert "уравновешенность" not in offset.lower()
    assert "уравновешенность" in words_of().lower()
    assert "выполнены расчёт рабочего цикла, кинематический" in words_of("cycle-petrol", "short")


def test_a_balanced_first_order_has_no_table_of_zeros():
    caption = "Вращающиеся массы и векторы первого порядка"
    page = page_of("cycle-petrol")
    assert printed_rows(page, caption) is None
    assert "первого порядка взаимно уравновешены" in plain(page)
    page = page_of("yamz-236")
    assert "описывает окружность" in plain(page)
    assert not [row for row in printed_rows(page, caption) if row[0].startswith("Направление")]
    assert "описывает эллипс" in words_of()


def test_firing_orders_differ_by_their_intervals():
    rows = printed_rows(page_of(), "Порядки работы, лучшие первыми")
    assert rows[0][1] == "240, 240, 240"
    assert len({tuple(row[:2]) for row in rows}) == len(rows)


def test_sums_of_two_rods_have_symbols_of_their_own():
    terms = report_samples.terms("yamz-236")
    assert r"= M_{1\mathrm{ц}} + M_{4\mathrm{ц}}" in terms.formula("rods_1.Mthrow_Nm", 390.0)
    assert terms.formula("rods_1.T_MPa", 390.0) == (
        r"T_{\mathrm{кол}} = T_{\mathrm{л}} + T_{\mathrm{п}}"
    )
    assert terms.formula("crankpin.Krod_MPa", 390.0).startswith(
        r"K'_{\mathrm{ш.ш}} = K_{\mathrm{кол}}"
    )
    assert terms.formula("P4_1.M_Nm", 390.0).startswith(r"M_{\mathrm{ц}} = T_{\mathrm{уд}}")
    assert "силами своего цилиндра" in words_of("yamz-236")
    assert "силами своего цилиндра" not in words_of()


def test_what_lies_outside_the_usual_limits_is_named():
    page = page_of("cycle-petrol")
    rows = printed_rows(page, "Результаты и обычные пределы")
    outside = [row[0] for row in rows if row[3] != "в пределах"]
    assert "Вне пределов: температура конца сжатия Tc." in plain(page)
    assert [name[:24].lower() for name in outside] == ["температура конца сжатия"]
    assert not [row for row in rows if re.fullmatch(r"([\d,]+)…\1", row[2])]


def test_the_diagram_of_the_cycle_stands_at_the_step_of_the_profile():
    caption = "Индикаторная диаграмма цикла по точкам"
    for detail, rows in (("short", 13), ("full", 73)):
        page = page_of("cycle-petrol", detail)
        assert len(printed_rows(page, caption)) == rows


def test_a_moment_that_the_rows_miss_is_told():
    text = words_of("cycle-petrol")
    assert re.search(r"Наибольший момент −86,7 Н·м \(при шаге 1° — [\d,]+ Н·м\)", text)


def test_whole_orders_are_whole_numbers():
    free, torque = "Свободные силы и моменты", "Гармоники удельной тангенциальной силы"
    for source, half in (("gots-diesel", True), ("two-stroke", False)):
        page = page_of(source)
        captions = [re.search(f"{of}[^<]*", page)[0] for of in (free, torque)]
        first, harmonic = (printed_rows(page, caption)[0][0] for caption in captions)
        assert first == "1" and harmonic == ("0,5" if half else "1")


def test_only_numbers_of_the_textbook_stand_in_titles():
    assert "(П4.5)" in words_of() and "П4.5с" not in words_of()


def test_a_reader_of_an_offset_is_told_in_a_line_what_is_not_there():
    text = words_of("ecoboost-10")
    remark = re.search(r"не рассчитаны: из-за смещения[^.]*\.", text)[0]
    assert "центральный механизм" in remark and "лист" not in remark
    terms = report_samples.terms("ecoboost-10")
    burning = [piece.formula for piece in terms.branches("gas.p_burning_MPa")]
    assert any(r"\varphi - \varphi_{c}" in formula for formula in burning)
