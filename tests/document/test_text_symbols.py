"""Alternative texts of formulas: as a person reads them aloud, in no markup and no English."""

from __future__ import annotations

import re
from html import unescape

import pytest

from reports.document import report
from reports.document.text import mathsvg
from reports.document.text.symbols import indexed, inline_html, remark_html, spoken, titled_html
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import evaluate_model
from reports.shared.errors import SymbolError
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.cover import ALL
from tests.workbook.made import coarse_model

NB = "\u00a0"


@pytest.mark.parametrize(
    ("tex", "html"),
    [
        ("r", "<i>r</i>"),
        (r"R_{\mathrm{ш.ш}}", "<i>R</i><sub>ш.ш</sub>"),
        (r"P_{\mathrm{г}}", "<i>P</i><sub>г</sub>"),
        (r"p'_{\mathrm{г}}", "<i>p</i>′<sub>г</sub>"),
        (r"R'_{\Sigma i}", "<i>R</i>′<sub>Σ<i>i</i></sub>"),
        (r"K_{r\mathrm{ш}}", "<i>K</i><sub><i>r</i>ш</sub>"),
        (r"\varphi", "<i>φ</i>"),
        (r"m_j r\omega^2", "<i>m</i><sub><i>j</i></sub><i>rω</i><sup>2</sup>"),
        ("10^{-6}", "10<sup>−6</sup>"),
        ("0{,}5", "0,5"),
        (r"\varphi=30^\circ", f"<i>φ</i>{NB}={NB}30°"),
        (r"\bar{R}", '<span class="bar"><i>R</i></span>'),
        (r"M_{\mathrm{к.ш2}}", "<i>M</i><sub>к.ш2</sub>"),
        ("x<y", f"<i>x</i>{NB}&lt;{NB}<i>y</i>"),
        (r"n\leq 4", f"<i>n</i>{NB}≤{NB}4"),
        (r"a-b", f"<i>a</i>{NB}−{NB}<i>b</i>"),
    ],
)
def test_symbols(tex, html):
    assert inline_html(tex) == html


@pytest.mark.parametrize("tex", ["{", "a}", "x_", r"\dfrac{a}{b}", "a$b", r"\href{x}{y}", "a&b"])
def test_anything_else_is_refused(tex):
    with pytest.raises(SymbolError):
        inline_html(tex)


def test_markup_cannot_pass():
    assert "<script" not in inline_html(r"\mathrm{<script>}")


@pytest.mark.parametrize(
    ("title", "html"),
    [
        ("впуска pa/pк", "впуска <i>p</i><sub><i>a</i></sub>/<i>p</i><sub>к</sub>"),
        ("Потери A + B·cm: A", "Потери <i>A</i> + <i>B</i>·<i>c</i><sub><i>m</i></sub>: <i>A</i>"),
        ("H2/CO при α < 1", "H<sub>2</sub>/CO при <i>α</i> &lt; 1"),
        ("Температура T_r", "Температура <i>T</i><sub><i>r</i></sub>"),
        ("показатель n1", "показатель <i>n</i><sub>1</sub>"),
        ("дозарядки φдоз", "дозарядки <i>φ</i><sub>доз</sub>"),
        ("шатунный, Δmin", "шатунный, Δ<sub>min</sub>"),
        ("до 1500 °C: c·t²", "до 1500 °C: <i>c</i>·<i>t</i><sup>2</sup>"),
        ("скорости, доля ωr", "скорости, доля <i>ωr</i>"),
        ("Ford EcoBoost, М-10Г2к", "Ford EcoBoost, М-10Г2к"),
        ("<b>x</b>", "&lt;<i>b</i>&gt;<i>x</i>&lt;/<i>b</i>&gt;"),
    ],
)
def test_symbols_in_titles(title, html):
    assert titled_html(title) == html


@pytest.mark.parametrize("name", ["gots-diesel", "yamz-236", "mwm-6"])
def test_symbols_as_text_keep_every_letter(name):
    seen = 0
    for node in coarse_model(name).nodes.values():
        tex, plain = node.quantity.tex, node.quantity.symbol
        text = indexed(tex, plain)
        if text != plain:
            html = inline_html(tex)
            assert text.replace("_", "") == unescape(re.sub("<[^>]+>", "", html))
            assert text.count("_") == html.count("<sub>")
            seen += 1
    assert seen > 50


@pytest.mark.parametrize(
    ("tex", "plain", "text"),
    [
        (r"R'_{\mathrm{ш.ш}}", "", "R′_ш.ш"),
        ("s_{(2)}", "", "s_(2)"),
        (r"\frac{a}{b}", "a/b", "a/b"),
        (r"\omega^2", "ω²", "ω²"),
        (r"\bar{R}", "R̄", "R̄"),
    ],
)
def test_what_text_cannot_show_stays_as_it_is(tex, plain, text):
    assert indexed(tex, plain) == text


@pytest.mark.parametrize(
    ("remark", "html"),
    [
        (
            "a.toml: masses.rod_kg: m_ш.ш/F_п = 563 кг/м² необычно",
            'a.toml: masses.rod_kg: <span class="nb"><i>m</i><sub>ш.ш</sub>/<i>F</i><sub>п</sub>'
            '</span> = 563 <span class="nb">кг/м<sup>2</sup></span> необычно',
        ),
        (
            "обычно n_2 меньше n_1",
            'обычно <span class="nb"><i>n</i><sub>2</sub></span> меньше '
            '<span class="nb"><i>n</i><sub>1</sub></span>',
        ),
        ("Δφ_з = 30°", '<span class="nb">Δ<i>φ</i><sub>з</sub></span> = 30°'),
        ("τ_−1 МПа", '<span class="nb"><i>τ</i><sub>−1</sub></span> МПа'),
        ("cycle.xi_z, xi_z, x_5_mm, h2_co_ratio", "cycle.xi_z, xi_z, x_5_mm, h2_co_ratio"),
        ("stroke_mm = 2r, x__ = <b>", "stroke_mm = 2r, x__ = &lt;b&gt;"),
    ],
)
def test_a_remark_has_its_symbols_and_whole_units(remark, html):
    assert str(remark_html(remark)) == html


# Between them every chapter, section and kind of formula; each sample with KSHM_ALL=1.
ENGINES = ("cycle-petrol", "mwm-6", "d-240-bearings", "gots-regimes") if not ALL else None
ODD = re.compile(
    r"[\^_{}\\~]|\s\s|^\s|\s$|\s[),;:°′]|[(\[]\s|[a-z]{3,}|\b(?:tg|ln|lg|sh|ch)\b|[=(·/] − "
)


@pytest.mark.parametrize(
    ("tex", "said"),
    [
        (r"\sin^2 \varphi", "синус в квадрате фи"),
        (r"\beta_{\max}", "бета макс"),
        (r"\beta_{\mathrm{max}}", "бета макс"),
        (r"P_{\mathrm{г}}=\dfrac{a}{b}\cdot 10^{-6}", "Pг = a/b · 10 в степени −6"),
        (r"\dfrac{1-\dfrac{a}{b}}{c}+\sqrt{\varphi}", "(1 − a/b)/c + корень из фи"),
        (r"R'_{\mathrm{ш.ш}\,\max} \, F_{\mathrm{п}}", "R′ ш.ш макс Fп"),
        (r"j = -10\,213{,}5\,\mathrm{м/с^2}", "j = −10 213,5 м/с²"),
        (r"\left|a_k\right| \, r", "модуль (ak) r"),
        (r"\arctg x + \tg 2\alpha", "арктангенс x + тангенс 2 альфа"),
        (r"\ln y - 1", "натуральный логарифм y − 1"),
        (r"p = \begin{cases} a, & x \leq 1 \\ -b, & x > 1 \end{cases}",
         "p = a, x ≤ 1; p = −b, x > 1"),
        (r"M_{\alpha} \Delta\omega \, \ddot{x} \, \bar{T}",
         "M альфа дельта омега x с двумя точками T с чертой"),
    ],
)  # fmt: skip
def test_a_formula_is_read_as_a_person_reads_it(tex: str, said: str) -> None:
    assert spoken(tex) == said


def test_a_formula_on_the_page_is_called_so() -> None:
    built = mathsvg.formula(r"\sin^2 \varphi")
    assert "<title>синус в квадрате фи</title>" in built.svg
    assert "синус в квадрате фи" in built.image


def names() -> tuple[str, ...]:
    from reports.shared.resources import samples_dir

    return ENGINES or tuple(sorted(path.stem for path in samples_dir().glob("*.toml")))


@pytest.mark.parametrize("name", names())
def test_no_formula_of_a_report_is_said_in_markup_or_english(name: str) -> None:
    raw = to_mapping(sample(name))
    raw["report"]["detail"] = "full"
    model = build_model(load_mapping(raw, source=name).model)
    page = report.Report(model, evaluate_model(model)).page("screen")
    formulas = re.findall(r'<svg class="tex"[^>]*><title>([^<]*)</title>', page)
    assert len(formulas) > 100 and all(formulas)
    assert [said for said in map(unescape, formulas) if ODD.search(said)] == []
    pictures = re.findall(r"<title>([^<]*)</title>", page)
    assert [said for said in map(unescape, pictures) if re.search(r"[\^_{}\\]", said)] == []
