"""Our reading of TeX gives what matplotlib's own parser gives, to the last digit."""

from unittest import mock

import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.font_manager import FontProperties
from matplotlib.mathtext import MathTextParser

from reports.document.text import mathtext

TEXTS = (
    "x",
    r"P_{\mathrm{г}} - P_j",
    r"{}= -2 - {-3}",
    r"a\cdot 10^{-6}\,\mathrm{м}^{2}",
    r"\dfrac{\pi D^{2}}{4}\, p_{1} + \frac{a}{b}",
    r"\sqrt{1 - \lambda^{2}\sin^{2}\varphi}",
    r"\left(\cos\varphi + \dfrac{\lambda}{4}\cos 2\varphi\right)^{n_{1}}",
    r"\left.\left[\dfrac{x}{y}\right)\right.",
    r"\operatorname{tg}\beta = \operatorname{arctg}\left(x\right)",
    r"\sum_{i=1}^{n} m_{i} + \int_{0}^{4\pi} M\, d\varphi + \max(a) \leq \min_{x} b",
    r"\overline{p}^{\prime}_{i} + p_{z}^{{\prime}{\prime}} + \ddot{x} + \vec{F}",
    r"\mathrm{ш.\hspace{-0.2}ш} \times 3{,}14, b; c. d!",
    r"90° \approx \{5\}\% \Rightarrow \mathbf{K} \quad \mathit{ab}\!c \pm \mathrm{sin}x",
    r"\ln\dfrac{V}{V_{c}} \to [0; 1] / 2 * |x| @ y?",
)
_LEAVES = st.sampled_from(
    ["x", "2", "г", r"\varphi ", "-", "+", r"\cdot ", "=", ",", ".", "(", ")"]
)
_FORMULAS = st.recursive(
    _LEAVES,
    lambda inner: st.one_of(
        st.lists(inner, min_size=1, max_size=4).map("".join),
        st.tuples(inner, inner).map(lambda p: rf"\dfrac{{{p[0]}}}{{{p[1]}}}"),
        st.tuples(inner, inner).map(lambda p: rf"{{{p[0]}}}_{{{p[1]}}}"),
        st.tuples(inner, inner).map(lambda p: rf"{p[0]} a^{{{p[1]}}}"),
        inner.map(lambda p: rf"\sqrt{{{p}}}"),
        inner.map(lambda p: rf"\left({p}\right)"),
        inner.map(lambda p: rf"\cos {p}"),
        inner.map(lambda p: rf"\mathrm{{{p}}}"),
    ),
    max_leaves=6,
)


def drawn(parsed):
    glyphs = [(font.fname, *rest) for font, *rest in parsed.glyphs]
    return parsed.width, parsed.height, parsed.depth, glyphs, parsed.rects


def theirs(text, size):
    font = FontProperties(family="STIXGeneral", size=size, math_fontfamily="stix")
    return MathTextParser("path").parse(text, dpi=72, prop=font)


def ours(text, size):
    with mock.patch.object(mathtext, "MathTextParser", side_effect=AssertionError(text)):
        return mathtext.read(text, size)


@pytest.mark.parametrize("text", TEXTS)
def test_formulas(text):
    assert drawn(ours(f"${text}$", 1000.0)) == drawn(theirs(f"${text}$", 1000.0))


def test_a_label_of_a_figure():
    label = r"$p_{\mathrm{г}}$, МПа; $\varphi$, °"
    assert drawn(ours(label, 9.5)) == drawn(theirs(label, 9.5))


@given(_FORMULAS)
def test_made_formulas(text):
    assert drawn(ours(f"${text}$", 11.0)) == drawn(theirs(f"${text}$", 11.0))


@pytest.mark.parametrize("text", ["a'", r"\sqrt[3]{x}", r"\binom{a}{b}", "x_ 2"])
def test_what_it_does_not_know_is_left_to_the_library(text):
    assert drawn(mathtext.read(f"${text}$", 11.0)) == drawn(theirs(f"${text}$", 11.0))


@pytest.mark.parametrize("text", [r"\unknown", "{x", "x}", r"\left(x", r"\dfrac{}{x}", "a_b_c"])
def test_the_library_says_what_is_wrong(text):
    with pytest.raises((ValueError, TypeError)):
        theirs(f"${text}$", 11.0)
    with pytest.raises((ValueError, TypeError)):
        mathtext.read(f"${text}$", 11.0)
