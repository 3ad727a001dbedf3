"""Symbols and numbers of a note: each defined, one quantity and one value; what is put in."""

import ast
import html
import re
from collections import defaultdict
from contextlib import ExitStack
from unittest import mock

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reports.document.chapters import opening
from reports.document.chapters.chapter import Chapter
from reports.document.page.numbering import Draft
from reports.document.text.symbols import inline_html
from reports.document.text.terms import Terms, field_title
from reports.formula.parse import parse
from reports.formula.tex import input_symbol_tex
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import graph_of
from reports.tables.left_out import unused
from reports.tables.registry import build_model
from tests import layouts
from tests.conftest import sample
from tests.document.bare_pages import bare_page, formulas_of, plain
from tests.document.substitutions import substitutions
from tests.document.test_report_sentences import (
    assert_symbols_mean_one_number,
    engine,
    page_of,
)

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]


@settings(max_examples=6)
@given(
    layout=st.sampled_from(sorted(layouts.MAKERS)), speed=st.floats(0.4, 1.2),
    step=st.sampled_from([10.0, 30.0]),
)  # fmt: skip
def test_a_number_told_twice_is_one_number(layout, speed, step):
    """Values of a symbol in the text, the conclusion's torque, flywheel and running-on torque."""
    model = engine(layout, calculation__step_deg=step, regime__times_speed_rpm=speed,
                   report__detail="course")  # fmt: skip
    page = page_of_defined_symbols(model)
    assert_symbols_mean_one_number(page)
    text = plain(page)
    end = text[text.index("Рассчитаны кинематика") :]
    for said in (r"маховик для [^:]*: ([\d,]+\d)",
                 r"у шатунн[а-я]+ ше[а-я]+ [^—]*— ([\d ]+) Н·м"):  # fmt: skip
        for number in re.findall(said, end):
            assert text.count(number.strip()) > 1, (said, number)


@pytest.mark.parametrize("name", ["gots-diesel", "yamz-236", "vaz-2106"])
def test_an_angular_speed_is_written_in_one_way(name):
    """ω = 219,91 rad/s stood as 219,9115 in the formula of the greatest speed."""
    formulas = formulas_of(bare_page(engine(source=name, report__detail="course")))
    numbers = re.findall(r"\d+\{,\}\d+", " ".join(formulas))
    stated = next(re.findall(r"\d+\{,\}\d+", tex)[-1] for tex in formulas
                  if tex.startswith(r"\omega = "))  # fmt: skip
    speed = float(stated.replace("{,}", "."))
    near = {text for text in numbers if abs(float(text.replace("{,}", ".")) / speed - 1) < 1e-4}
    assert near == {stated}


def _bare(text):
    return re.sub(r"<[^>]+>|[\s\u200b]", "", html.unescape(text)).replace("−", "-")


# Names of one quantity: what is given and what the calculation calls so.
_SAME = (
    {"masses_rod_small_end_share", "rod_share"},
    {"m_j", "masses_reciprocating_kg"}, {"m_2", "masses_rod_big_end_kg"},
    {"geometry_lambda", "lam"}, {"gas_combustion_start_deg", "phi_c_deg"},
    {"phi_deg", "timing_deg", "alpha_deg", "reference_angle_deg"},
    *({f"ref_lambda{n}", f"reference_lambda_{n}_value"} for n in range(1, 13)),
)  # fmt: skip


@pytest.mark.parametrize(
    ("name", "more"),
    [
        ("cycle-turbo-diesel", {"strength": {}, "bearings": {}, "torsion": {}}),
        ("mwm-6", {}), ("d-240", {"reference": {}}),
    ],
)  # fmt: skip
def test_a_symbol_is_one_quantity(name, more, monkeypatch):
    """l_1 was an arm of a throw and a length of the rod, q a heat and a sensitivity."""
    raw = to_mapping(sample(name)) | more
    raw["report"]["detail"] = "full"
    model = load_mapping(raw, source="t.toml").model
    seen, tex_of = defaultdict(dict), Terms.tex

    def noted(terms, name):
        seen[_canonical(tex_of(terms, name))][name.rpartition(".")[2]] = terms.title(name).lower()
        return tex_of(terms, name)

    monkeypatch.setattr(Terms, "tex", noted)
    bare_page(model)
    for field in build_model(model).inputs:
        if field.symbol and field.name not in unused(model) and "gas_point" not in field.name:
            seen[_canonical(input_symbol_tex(field.symbol))][field.name] = field.title.lower()
    for tex, titles in seen.items():
        kinds = {re.sub(r"\d+", "", title) for title in titles.values()}
        assert len(kinds) == 1 or not tex or any(titles.keys() <= same for same in _SAME), (
            tex, titles)  # fmt: skip


def _canonical(tex):
    return re.sub(r"_(\w)(?!\w)", r"_{\1}", tex.replace(" ", ""))


@pytest.mark.parametrize("name", ["gots-diesel", "two-stroke", "cycle-turbo-diesel", "yamz-236"])
def test_a_symbol_of_a_formula_is_defined(name):
    """On the left of a formula, in a table, in a «где» list or in the text beside it.

    T_Σ of a split pin stood under a root and nowhere else.
    """
    page_of_defined_symbols(engine(source=name, report__detail="course"))


def test_a_symbol_of_a_split_pin_is_defined():
    page_of_defined_symbols(engine("split", report__detail="course"))


def page_of_defined_symbols(model):
    """A note whose formulas have no unknown symbol and whose first table has no idle row."""
    placed, lines, listed = [], set(), []

    def noting(known):
        def noted(self, key, *more, **named):
            at = more[0] if more and not isinstance(more[0], str) else None
            placed.append((self, key, at, more[2] if len(more) > 2 else ()))
            return known(self, key, *more, **named)

        return noted

    def telling(known):
        def noted(self, name, *more, **named):
            lines.add(name)
            return known(self, name, *more, **named)

        return noted

    def beginning(self, **named):  # what other chapters would tell is known by now
        lines.clear()
        return numbering(self, **named)

    def listing(field, of):
        listed.append(field)
        return field_title(field, of)

    numbering = Draft.numbering
    with ExitStack() as patched:
        for of, way, new in (
            *((Chapter, way, noting(getattr(Chapter, way))) for way in ("eq", "full")),
            *((Terms, way, telling(getattr(Terms, way))) for way in ("value", "column")),
            (Draft, "numbering", beginning), (opening, "field_title", listing),
        ):  # fmt: skip
            patched.enter_context(mock.patch.object(of, way, new))
        page = bare_page(model)
    graph = graph_of(built := build_model(model))
    used = lines.union(*map(graph.ancestors, lines & built.nodes.keys()))
    idle = {f.name for f in listed if f.name not in used and not f.structural}
    assert not idle, idle
    text = _bare(re.sub(r'<div class="eq.*?</div>', "", page, flags=re.DOTALL))
    formulas = [(c.terms.tex(n), c, n, *of) for c, n, *of in placed if not c.writer.draft]
    left = {tex for tex, *_ in formulas}
    assert (r"\Delta p/\Delta\varphi" in left) == any(n == "p_start" for _, _, n, *_ in formulas)
    for _, chapter, name, at, zeros in formulas:
        terms, symbol = chapter.terms, chapter.terms._symbols(name)
        for node in ast.walk(parse(terms._expr(name, at))):
            inner = ast.unparse(node) if isinstance(node, ast.Name | ast.Attribute) else "pi"
            known = terms.has(inner) or terms.has(f"{name.rpartition('.')[0]}.{inner}")
            tex = symbol(inner) if known else ""
            if not tex or tex in left or inner in zeros or re.search(r"dfrac|\\(sin|cos)|\+", tex):
                continue
            assert _bare(str(inline_html(tex))) in text, (name, tex)
    return page


@pytest.mark.parametrize("name", ["cycle-turbo-diesel", "cycle-petrol"])
def test_symbols_of_the_cycle_are_those_of_its_tables(name):
    """The coefficients a, b, c of the characteristic were called a_N, b_N, c_N below it."""
    page = page_of(name, "course")
    text, formulas = plain(page), " ".join(formulas_of(page))
    assert "a_N + b_N x - c_N x^2" in formulas and "a_g + b_g x + c_g x^2" in formulas
    assert "= H_z" in formulas and "левая часть уравнения" not in text
    assert r"{Q_{\mathrm{дог}} + U_z - U_b}" in formulas and "Здесь Qдог = " in text
    columns = {"w": "вес верхней формулы", "h": "отношение (Qдог + Uz", "Δc": "добавка к истинной",
               "cb": "истинная теплоёмкость при tb"}  # fmt: skip
    for symbol, meaning in columns.items():
        assert f"{symbol} — {meaning}" in text, symbol


def assert_substitutions_hold(page):
    """Numbers that are put in have as many digits as give the printed result."""
    collected = list(substitutions(formulas_of(page)))
    assert len(collected) > 40
    for tex, value, shown, half in collected:
        turned = {value, value + 180, value - 180} if r"\arctg" in tex else {value}
        near = 1.001 * half
        assert any(abs(each - shown) <= near for each in turned), (tex, value)


@pytest.mark.parametrize("name", ["cycle-turbo-diesel", "cycle-petrol", "mwm-6", "two-stroke"])
def test_a_substitution_gives_the_printed_result(name):
    assert_substitutions_hold(page_of(name, "course"))


@pytest.mark.parametrize("layout", ["split", "offset", "v_six"])
def test_a_substitution_of_a_layout_gives_the_printed_result(layout):
    assert_substitutions_hold(bare_page(engine(layout, report__detail="course")))
