import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.document.text import numbers
from reports.shared.russian import MINUS, NBSP, fixed


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
    ],
)
def test_fixed(value, digits, text):
    assert fixed(value, digits) == text


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_not_finite_is_refused(value):
    for write in (fixed, numbers.significant, numbers.power_html, numbers.auto_tex):
        with pytest.raises(ValueError, match="не конечно"):
            write(value)


def test_negative_digits_are_refused():
    with pytest.raises(ValueError, match="отрицательно"):
        fixed(1.0, -1)


def test_significant():
    assert numbers.significant(0.31757, 3) == "0,318"
    assert numbers.significant(460.767, 5) == "460,77"
    assert numbers.significant(9.9996, 4) == "10,00"
    assert numbers.significant(0, 3) == "0,00"


@pytest.mark.parametrize(
    ("value", "step", "html", "tex"),
    [
        (1.25e-6, 1, "1,25×10<sup>−6</sup>", r"1{,}25\times 10^{-6}"),
        (-2.1e11, 1, "−2,10×10<sup>11</sup>", r"-2{,}10\times 10^{11}"),
        (21_000, 3, "21,0×10<sup>3</sup>", r"21{,}0\times 10^{3}"),
        (9.999e-5, 1, "1,00×10<sup>−4</sup>", r"1{,}00\times 10^{-4}"),
        (3.14159, 1, "3,14", "3{,}14"),
        (0, 1, "0,00", "0{,}00"),
    ],
)
def test_powers(value, step, html, tex):
    assert numbers.power_html(value, 3, step=step) == html
    assert numbers.power_tex(value, 3, step=step) == tex


def test_auto_takes_powers_only_for_unhandy_sizes():
    assert numbers.auto_html(0.00123) == "0,001230"
    assert "×10" in numbers.auto_html(0.000123)
    assert "×10" in numbers.auto_tex(1.5e7).replace(r"\times ", "×")


def test_tex_of_groups_and_minus():
    assert numbers.fixed_tex(-12345.6, 1) == r"-12\,345{,}6"
    assert numbers.in_parentheses("-1{,}5") == r"\left(-1{,}5\right)"
    assert numbers.in_parentheses("1{,}5") == "1{,}5"


def test_aligned_fills_with_digit_halves():
    shown = numbers.aligned(["1,5", "12,5", f"{MINUS}2,5"])
    assert shown == [NBSP * 3 + "1,5", NBSP + "12,5", f"{MINUS}2,5"]
    assert numbers.aligned([]) == []


def _value(text: str) -> float:
    return float(text.replace(NBSP, "").replace(MINUS, "-").replace(",", "."))


@given(st.floats(-1e12, 1e12), st.integers(0, 6))
def test_fixed_says_the_number(value, digits):
    text = fixed(value, digits)
    assert "." not in text and "-" not in text
    assert _value(text) == pytest.approx(value, abs=0.5000001 * 10**-digits, rel=1e-12)


@given(st.floats(1e-30, 1e30), st.integers(1, 8), st.sampled_from([1, 3]))
def test_power_says_the_number(value, digits, step):
    mantissa, exponent = numbers.split_power(value, digits, step=step)
    assert exponent % step == 0
    least = 1.0
    assert least <= _value(mantissa) < 10**step
    assert _value(mantissa) * 10.0**exponent == pytest.approx(value, rel=0.51 * 10 ** (1 - digits))
    assert len(mantissa.replace(",", "")) >= digits
