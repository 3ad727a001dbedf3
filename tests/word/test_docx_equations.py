"""TeX as equations of Word."""

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.document.text.tex import TexError
from reports.word.omml import displayed, omath
from tests.word.docx_samples import M


def words(tex: str) -> str:
    return "".join(omath(tex).itertext())


def tags(tex: str) -> list[str]:
    return [element.tag.removeprefix(M) for element in omath(tex).iter()]


@pytest.mark.parametrize(
    ("tex", "text", "holds"),
    [
        (r"\dfrac{a}{2{,}5}", "a2,5", {"f", "num", "den"}),
        (r"\sqrt{x + 1}", "x+1", {"rad", "radPr", "deg"}),
        (r"R_{\mathrm{ш.ш}}", "Rш.ш", {"sSub"}),
        (r"K'_x", "Kx′", {"sSubSup"}),
        (r"\left(S'_k\right)^{2}", "Sk′2", {"d", "sSup"}),
        (r"\sum_{j=1}^{m} M", "j=1mM", {"nary"}),
        (r"\bar{p}", "p", {"bar"}),
        (r"7{,}809^{\circ}", "7,809°", {"r"}),
        (r"-0{,}5 \cdot 10^{-6}\;\mathrm{МПа}", "−0,5·10−6\u2005МПа", {"sSup"}),
    ],
)
def test_what_stands_in_formulas(tex, text, holds):
    assert words(tex) == text
    assert holds <= set(tags(tex))


def test_a_power_is_set_to_the_whole_number():
    power = omath(r"1{,}25^{2}").find(f"{M}sSup")
    assert "".join(power.find(f"{M}e").itertext()) == "1,25"


def test_letters_are_slanted_and_words_upright():
    faces = {
        "".join(run.itertext()): [e.tag.removeprefix(M) for e in run.iter()]
        for run in omath(r"x \, \mathrm{кВт} \tg \beta").iter(f"{M}r")
    }
    assert "nor" in faces["кВт"] and "nor" not in faces["x"] and "rPr" not in faces["β"]


def test_a_sign_at_a_broken_end_is_text():
    line = displayed(r"{}= a + b +", ".")
    runs = list(line.iter(f"{M}r"))
    assert "".join(line.itertext()).strip(".") == "=\u2005a+b\u2005+"
    as_text = [run.find(f".//{M}nor") is not None for run in runs]
    assert as_text == [True, False, False, False, True, True]


@pytest.mark.parametrize("tex", [r"\left( a", r"\unheardof", r"{a"])
def test_what_cannot_be_set_is_refused(tex):
    with pytest.raises((TexError, ValueError)):
        omath(tex)


NUMBERS = st.decimals(0, 10**6, places=3).map(lambda d: str(d).replace(".", "{,}"))
EXPRESSIONS = st.recursive(
    NUMBERS | st.sampled_from([r"\varphi", "x", r"R_{\mathrm{ш}}", "K'"]),
    lambda inner: st.one_of(
        st.tuples(inner, inner).map(lambda p: rf"\dfrac{{{p[0]}}}{{{p[1]}}}"),
        st.tuples(inner, inner).map(lambda p: rf"\left({p[0]} + {p[1]}\right)^{{2}}"),
        inner.map(lambda i: rf"\sqrt{{{i}}} \cdot \sin {i}"),
    ),
    max_leaves=8,
)


@given(EXPRESSIONS)
def test_no_digit_is_lost(tex):
    assert re.findall(r"\d", words(tex)) == re.findall(r"\d", tex)
    for element in omath(tex).iter(f"{M}e", f"{M}num", f"{M}den"):
        assert len(element)
