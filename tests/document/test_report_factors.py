"""A factor that turns one unit into another has its words in the chapter of its formula."""

import html
import re
from itertools import pairwise

import pytest

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from tests.conftest import sample
from tests.document.bare_pages import bare_page, formulas_of
from tests.document.test_report_sentences import engine

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]
# 100, 1000 and so on, but not within a longer number, and powers of ten.
_FACTOR = re.compile(r"(?<![\d,}.])(?<!\\,)10{2,6}(?![\d{])(?!\\,)|10\^\{-?\d+\}")
# Coefficients of an empirical formula, whose angle is in degrees: the text says so.
# So are those of expansion; a small number in brackets of its own is a power of ten itself.
_COEFFICIENTS = re.compile(
    r"(?:8|3\{,\}3) \\cdot 10\^\{-4\}|[12]\{,\}\d \\cdot 10\^\{-5\}"
    r"|\\left\(-?\d+(?:\{,\}\d+)? \\cdot 10\^\{-\d\}\\right\)"
)
_MODULUS = re.compile(r"\}\{\d\{,\}\d+ \\cdot 10\^\{\d\}\}")  # a stiffness is a power of ten itself
_TOLD = re.compile(r"Здесь (?:множител[ьи]|числ[оа]) (.*?) перевод[ия]т ", re.DOTALL)


def unexplained(page):
    """Formulas with such a number that their chapter does not explain."""
    for chapter in re.split(r"(?=<h1)", page):
        title = re.sub("<[^>]+>", "", chapter[: chapter.find("</h1>")])
        listed = (chapter[m.start() - 200 : m.start()] for m in re.finditer("перевод ", chapter))
        said = "".join([*_TOLD.findall(chapter), *listed])
        numbers = re.sub(r"<sup>([^<]*)</sup>", r"^{\1}", said).replace("−", "-")
        for tex in map(html.unescape, re.findall(r'data-tex="([^"]*)"', chapter)):
            _, *sides = tex.split(" = ")
            body = _MODULUS.sub("", _COEFFICIENTS.sub("", " ".join(sides[:-1] or sides)))
            for factor in set(_FACTOR.findall(body)):
                if factor not in numbers:
                    yield title, factor, tex


def full(name, **sections):
    raw = to_mapping(sample(name)) | sections
    raw["report"] |= {"detail": "course"}
    return load_mapping(raw, source="t.toml").model


@pytest.mark.parametrize(
    ("name", "sections"),
    [
        ("yamz-236", {"strength": {"kind": "diesel"}, "bearings": {}, "torsion": {},
                      "counterweight": {}, "flywheel": {}}),
        ("cycle-turbo-diesel", {}), ("vaz-2106", {}), ("cycle-petrol", {}),
    ],
)  # fmt: skip
def test_a_factor_of_units_is_explained(name, sections):
    assert list(unexplained(bare_page(full(name, **sections)))) == []


def test_no_side_of_a_formula_is_said_twice():
    """σ_max = max σ = max σ = 71.9: the extreme of a column has no numbers to put in."""
    page = bare_page(full("yamz-236", strength={"kind": "diesel"}))
    sides = (html.unescape(tex).split(" = ") for tex in re.findall(r'data-tex="([^"]*)"', page))
    assert [each for each in sides if any(a == b for a, b in pairwise(each))] == []


def late(page):
    """Words on a number that is not in the formulas of the sentence before them."""
    for chapter in re.split(r"(?=<h1)", page):
        for said in re.finditer(r'<p class="flush">Здесь (?:множител|числ).*?</p>', chapter):
            before = chapter[: said.start()]
            begins = [m.start() for m in re.finditer("<p>|<h[12]", before)]
            sentence = " ".join(formulas_of(before[begins[-1] :]))
            numbers = re.sub(r"<sup>([^<]*)</sup>", r"^{\1}", said[0]).replace("−", "-")
            for number in _FACTOR.findall(numbers.replace("\xa0", " ")):
                if number not in sentence:
                    yield said[0], sentence


@pytest.mark.parametrize(
    "name", ["cycle-turbo-diesel", "cycle-petrol", "cycle-tractor-diesel", "yamz-236", "two-stroke"]
)
def test_a_factor_is_explained_at_its_own_formula(name):
    """1000 turns MJ into kJ, stood under the formula after that of the heat."""
    assert list(late(bare_page(full(name, strength={"kind": "diesel"}, bearings={})))) == []


@pytest.mark.parametrize("name", ["gots-diesel", "ecoboost-10", "two-stroke", "mwm-6"])
def test_a_factor_is_explained_in_notes_of_other_engines(name):
    assert list(unexplained(bare_page(engine(source=name, report__detail="full")))) == []
