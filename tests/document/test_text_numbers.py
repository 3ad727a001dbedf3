import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kshm.nomenclature.digits import Digits, scientific
from kshm.nomenclature.quantity import quantity
from reports.document.text import texts
from reports.formula.tex import input_symbol_tex, number_tex
from reports.shared.russian import (
    MINUS,
    NBSP,
    fixed,
    last_bound,
    runs,
    short,
    surname,
    written,
)


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (0.047, 3, "0,047"),
        (-4.2419, 3, f"{MINUS}4,242"),
        (-0.0004, 3, "0,000"),
        (0.0, 0, "0"),
        (9968, 0, "9968"),
        (13128.4, 0, f"13{NBSP}128"),
        (-1234567.891, 2, f"{MINUS}1{NBSP}234{NBSP}567,89"),
        (99999.5, 0, f"100{NBSP}000"),
        (np.float64(2.5), 1, "2,5"),
        (4.335, 2, "4,34"),  # as the cell of the workbook shows it
        (2 * 0.4335 * 5 * np.pi / np.pi, 2, "4,34"),
        (-0.125, 2, MINUS + "0,13"),
        (1e25, 2, f"10{NBSP}000{NBSP}000{NBSP}000{NBSP}000{NBSP}000{NBSP}000{NBSP}000{NBSP}000,00"),
    ],
)
def test_fixed(value, digits, text):
    assert fixed(value, digits) == text


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_not_finite_is_refused(value):
    for digits in (Digits(2), scientific(2)):
        with pytest.raises(ValueError, match="не конечно"):
            texts.of_digits(value, digits)
    with pytest.raises(ValueError, match="не конечно"):
        texts.significant(value, 4)


def test_negative_digits_are_refused():
    with pytest.raises(ValueError, match="отрицательно"):
        fixed(1.0, -1)


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (389.3234, Digits(4), "389,32"),
        (26.0218, Digits(4), "26,022"),
        (0.0123456, Digits(6), "0,012346"),
        (99999.6, Digits(1), "100\u00a0000"),
        (450101.4, Digits(0), "450\u00a0101"),  # a whole number stays whole: a firing order is one
        (278684.2, Digits(1), "278\u00a0684"),
        (49023.4, quantity("st_Pz_N", -5).digits, "49\u00a0023"),  # a large engine has no tens
    ],
)
def test_print_has_no_more_than_five_digits(value, digits, text):
    assert texts.of_digits(value, digits) == text
    assert texts.of_digits_tex(value, digits) == text.replace(",", "{,}").replace("\u00a0", r"\,")


def test_cells_and_feedback_keep_all_decimals():
    assert written(1234.5678, Digits(3), more=0) == "1234,568"
    assert written(450151.4, Digits(0), more=1) == "450151,4"


def test_significant():
    assert texts.significant(0.31757, 3) == "0,318"
    assert texts.significant(460.767, 5) == "460,77"
    assert texts.significant(9.9996, 4) == "10,00"
    assert texts.significant(0, 3) == "0,00"


@pytest.mark.parametrize(
    ("value", "html", "tex"),
    [
        (1.25e-6, "1,25·10<sup>−6</sup>", r"1{,}25\cdot 10^{-6}"),
        (-2.1e11, "−2,10·10<sup>11</sup>", r"-2{,}10\cdot 10^{11}"),
        (9.999e-5, "1,00·10<sup>−4</sup>", r"1{,}00\cdot 10^{-4}"),
        (3.14159, "3,14", "3{,}14"),
        (0, "0", "0"),
    ],
)
def test_powers_of_ten(value, html, tex):
    assert texts.of_digits(value, scientific(2)) == html
    assert texts.of_digits_tex(value, scientific(2)) == tex


def test_tex_of_groups_and_minus():
    assert texts.of_digits_tex(-12345.6, Digits(1)) == r"-12\,346"


def test_zeros_that_are_left_blank():
    assert texts.of_digits(0.0, Digits(2, hides="zeros")) == ""


def test_aligned_fills_with_digit_halves():
    shown = texts.aligned(["1,5", "12,5", f"{MINUS}2,5"])
    assert shown == [NBSP * 3 + "1,5", NBSP + "12,5", f"{MINUS}2,5"]
    assert texts.aligned([]) == []


def _value(text: str) -> float:
    return float(text.replace(NBSP, "").replace(MINUS, "-").replace(",", "."))


@given(st.floats(-1e12, 1e12), st.integers(0, 6))
def test_fixed_says_the_number(value, digits):
    text = fixed(value, digits)
    assert "." not in text and "-" not in text
    assert _value(text) == pytest.approx(value, abs=0.5000001 * 10**-digits, rel=1e-12)


@given(st.floats(1e-30, 1e30), st.integers(1, 8))
def test_power_says_the_number(value, decimals):
    tex = texts.of_digits_tex(value, scientific(decimals)).replace("{,}", ",")
    mantissa, _, exponent = tex.partition(r"\cdot 10^{")
    assert 1 <= _value(mantissa) < 10 and len(mantissa) == decimals + 2
    shown = _value(mantissa) * 10.0 ** int(exponent.rstrip("}") or 0)
    assert shown == pytest.approx(value, rel=0.51 * 10**-decimals)


def test_what_is_no_number_stays_in_the_middle():
    assert texts.aligned(["мм", "—", "мин⁻¹", "МПа"]) == ["мм", "—", "мин⁻¹", "МПа"]
    assert texts.aligned(["5", "—", "10"]) == [NBSP * 2 + "5", "—", "10"]


def test_numbers_within_formulas_are_grouped_like_results():
    assert number_tex(14018.2, 5) == r"14\,018" and number_tex(-6000.0) == "-6000"
    assert input_symbol_tex("m_1/m_ш") == r"m_{1}/m_{\mathrm{ш}}"
    assert input_symbol_tex("K_H2") == r"K_{\mathrm{H_2}}"


def test_numbers_that_follow_each_other_are_a_stretch():
    assert runs(["4", "5", "6", "9"]) == [(0, 2), (3, 3)]
    assert runs(["Б.9", "Б.10", "А.11"]) == [(0, 1), (2, 2)] and runs(["", ""]) == [(0, 0), (1, 1)]


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("Александра Владимировна Константинопольская-Чехова", "Константинопольская-Чехова"),
        ("Абрамович Пётр Ильич", "Абрамович"),
        ("Иван Петрович Абрамович", "Абрамович"),
        ("К.К. Ржевский", "Ржевский"),
        ("Ржевский К. К.", "Ржевский"),
        ("Ли Мария", "Ли Мария"),  # nothing tells which is which
        ("Иванов И. И., Петров П. П.", "Иванов И. И., Петров П. П."),
        ("", ""),
    ],
)
def test_a_surname_is_told_by_initials_or_a_patronymic(name, told):
    assert surname(name) == told


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Расчёт двигателя ЯМЗ 238", "Расчёт двигателя ЯМЗ\xa0238"),
        ("Расчёт двигателя", "Расчёт двигателя"),
        ("Д240", "Д240"),
        ("", ""),
    ],
)
def test_a_short_last_word_does_not_stand_alone(text, said):
    assert last_bound(text) == said


def test_short_numbers_have_the_comma_and_the_minus_of_print():
    assert [short(value, 4) for value in (-0.5, 20000.0, -1234.56)] == [
        f"{MINUS}0,5", "20000", f"{MINUS}1235",
    ]  # fmt: skip
