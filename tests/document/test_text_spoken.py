"""Alternative texts of formulas: as a person reads them aloud, in no markup and no English."""

from __future__ import annotations

import re
from html import unescape

import pytest

from reports.document import report
from reports.document.text import mathsvg
from reports.document.text.spoken import spoken
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.cover import ALL

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
    made = mathsvg.formula(r"\sin^2 \varphi")
    assert "<title>синус в квадрате фи</title>" in made.svg
    assert "синус в квадрате фи" in made.image


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
