"""Our reading of TeX gives what matplotlib's own parser gives, to the last digit."""

import logging
import re
from unittest import mock

import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.font_manager import FontProperties
from matplotlib.mathtext import MathTextParser

from reports.document.text import mathtext
from reports.document.text.mathsvg import FormulaImage, formula, formula_lines, plain
from reports.shared.errors import FormulaImageError

LONG = (
    r"j_{\mathrm{п}}=r\omega^2\left(\cos\varphi+\lambda\cos2\varphi\right)"
    r"=0{,}047\cdot460{,}77^2\left(\cos30^{\circ}+0{,}3176\cdot\cos60^{\circ}\right)"
    r"=10\,213\,\mathrm{м/с^2}"
)


def text_of(result: FormulaImage) -> str:
    return "".join(re.findall(r"<text[^>]*>([^<]*)</text>", result.svg))


def test_glyphs_are_text_in_stix():
    result = formula(r"P_{\mathrm{г}}=-1{,}5")
    families = set(re.findall(r'font-family="([^"]*)"', result.svg))
    assert families == {"STIXGeneral"}
    assert set(text_of(result)) == set("Pг=−1,5")
    assert "<path" not in result.svg


def test_box_sits_on_the_baseline():
    flat, deep = formula("a"), formula("y_{y}")
    assert flat.depth_em < 0.05 < deep.depth_em
    assert f"vertical-align:{-deep.depth_em:.3f}em" in deep.svg
    assert flat.height_em == pytest.approx(0.47, abs=0.05)
    fraction = formula(r"\dfrac{a}{b}")
    assert fraction.height_em > 1.5 and fraction.svg.count("<rect") == 1


def test_indices_stand_above_and_below_the_baseline():
    result = formula("x_a^b")
    places = {
        chars: [float(y) for y in ys.split()]
        for ys, chars in re.findall(r'y="([^"]*)">([^<]*)</text>', result.svg)
    }
    (base,), ends = places["x"], dict(zip("ba", places["ba"], strict=True))
    assert base == pytest.approx(1000 * (result.height_em - result.depth_em), abs=2)
    assert ends["b"] < base - 200 and ends["a"] > base + 100


def test_width_scales_with_the_text_not_with_pixels():
    assert formula("11").width_em == pytest.approx(1.0 + 0.08, abs=0.06)


def test_decimal_comma_takes_no_space_and_dot_neither():
    assert formula("1{,}5").width_em < formula("1,5").width_em - 0.05
    tight = formula(r"R_{\mathrm{ш.ш}}").width_em - formula(r"R_{\mathrm{шш}}").width_em
    assert tight == pytest.approx(0.25 * 0.7, abs=0.02)


@pytest.mark.parametrize(
    "tex",
    ["", "  ", "a$b", "{a", "a}", r"\nonsense{x}", r"x^2^3", "1.5", "漢", r"\frac{a}"],
)
def test_wrong_tex_is_refused_quietly(tex, caplog):
    with caplog.at_level(logging.WARNING), pytest.raises(FormulaImageError, match="Формула"):
        formula(tex)
    assert not caplog.records


def test_equal_formulas_are_set_once():
    assert formula(r"a+b") is formula(r"a+b")


def test_same_bytes_in_a_fresh_cache():
    first = formula(LONG).svg
    formula.cache_clear()
    assert formula(LONG).svg == first


def test_long_formula_breaks_at_relations_and_repeats_the_sign():
    lines = formula_lines(LONG, 24)
    assert len(lines) >= 2
    assert all(line.width_em <= 24 for line in lines)
    assert text_of(lines[0]).endswith("=") or "=" in text_of(lines[0])
    assert lines[0].tex.rstrip().endswith("=")
    assert lines[1].tex.startswith("{}=")
    assert formula_lines(LONG, 100) == (formula(LONG),)


def test_forced_lines():
    assert len(formula_lines(r"a=b\\c=d")) == 2


def test_label_for_readers():
    assert plain(r"P_{\mathrm{г}}=\dfrac{a}{b}\cdot 10^{-6}") == "P_г=(a)/(b)· 10^−6"
    assert "<title>a &lt; b</title>" in formula("a < b").svg


def test_nested_fractions_are_said_whole():
    assert plain(r"\dfrac{1-\dfrac{a}{b}}{c}+\sqrt{\varphi}") == "(1−(a)/(b))/(c)+√(φ)"


DEEP = r"\sqrt{\left(\dfrac{1}{0{,}3} + 1\right)^{2} - 0{,}19512^{2}}"
SUMS = [" + ".join([DEEP] * count) for count in range(7)]


@pytest.mark.parametrize(
    "tex",
    [
        rf"x = 1 + \dfrac{{9 \cdot 4}}{{82}} \left({DEEP} - \left({SUMS[2]}\right)\right)",
        rf"\varepsilon = \dfrac{{{SUMS[5]}}}{{{DEEP}}} = -56\,871",
        rf"y = \sqrt{{{SUMS[6]}}}",
        rf"z = \dfrac{{{SUMS[3]}}}{{{SUMS[4]}}} + \sqrt{{{SUMS[2]}}}",
    ],
)
def test_no_formula_is_wider_than_its_line(tex):
    lines = formula_lines(tex, 28.0)
    assert len(lines) > 1
    assert max(line.width_em for line in lines) <= 28.0


def test_parts_too_wide_are_named_and_follow():
    tex = rf"\varepsilon = \dfrac{{{SUMS[5]}}}{{3}} = 7"
    first, second, *_ = formula_lines(tex, 28.0)
    assert r"\mathrm{Ч}}{3} = 7" in first.tex and second.tex.startswith(r"\mathrm{где}")


CASES = r"p = \begin{cases} a, & x \leq 1 \\ \dfrac{b}{c}, & x > 1 \end{cases}"


def test_branches_stand_behind_one_brace():
    (line,) = formula_lines(CASES, 28.0)
    assert line.svg.count("<path") == 1
    assert plain(CASES) == "p = a, x ≤ 1; p = (b)/(c), x > 1"
    assert line.height_em > formula_lines(r"\dfrac{b}{c}", 28.0)[0].height_em


def test_branches_too_wide_for_a_brace_stand_in_lines():
    lines = formula_lines(CASES, 6.0)
    assert len(lines) == 2 and all("<path" not in line.svg for line in lines)


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
