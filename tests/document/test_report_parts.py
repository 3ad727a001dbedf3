"""Notes with every chapter on parts: what is put in gives the result, one symbol one quantity."""

from __future__ import annotations

import math
import re
from collections import defaultdict
from functools import cache
from unittest import mock

import pytest

from reports.document.chapters import opening
from reports.document.text.symbols import inline_html
from reports.document.text.terms import Terms
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from reports.new.generate import generate_engine
from reports.shared.errors import SymbolError
from reports.tables.left_out import unused
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.document.bare_pages import bare_page, formulas_of, plain
from tests.document.test_report_symbols import assert_substitutions_hold, page_of_defined_symbols

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]

SAMPLES = ("gots-diesel", "vaz-2106", "yamz-236", "vw-1600", "two-stroke",
           "cycle-tractor-diesel", "cycle-turbo-petrol")  # fmt: skip
NEW = {
    "V12": {"cylinders": 12, "layout": "v", "kind": "diesel", "bore_mm": 300.0},
    "one": {"cylinders": 1, "kind": "petrol", "bore_mm": 90.0},
    # Its greatest force of inertia lies between two printed numbers.
    "border": {
        "cylinders": 6,
        "layout": "v",
        "kind": "diesel",
        "bore_mm": 135.4,
        "speed_rpm": 5410.0,
    },
    "opposed": {"cylinders": 4, "layout": "opposed", "kind": "petrol"},
}
_ON_A_PAGE = 60  # symbols in two columns
SAME = {"m1/mш"}  # one share, which the masses and the estimate of a rod ask for


def with_every_part(name: str) -> InputFile:
    raw = generate_engine(**NEW[name]).data if name in NEW else to_mapping(sample(name))  # type: ignore[arg-type]
    kind = "petrol" if name in ("vaz-2106", "vw-1600", "one", "opposed") else "diesel"
    parts = {"torsion": {}, "bearings": {}, "flywheel": {}, "strength": {"kind": kind},
             "counterweight": {"goal": "residue"}}  # fmt: skip
    return load_mapping(parts | raw, source="").model


@cache
def page_of(name: str) -> str:
    return bare_page(with_every_part(name))


@pytest.mark.parametrize("name", [*SAMPLES, *NEW])
def test_what_is_put_in_gives_what_is_printed(name: str):
    assert_substitutions_hold(page_of(name))


@pytest.mark.parametrize("name", ["gots-diesel", "vw-1600", "two-stroke", "V12", "one"])
def test_a_symbol_of_a_formula_is_defined(name: str):
    """α_t stood in the tightness of a heated bush and nowhere else."""
    page_of_defined_symbols(with_every_part(name))


@pytest.mark.parametrize("name", ["gots-diesel", "V12", "cycle-petrol"])
def test_a_list_of_symbols_is_parted_where_a_page_holds_it(name: str):
    """The second column of a list of four pages began on the third, in the middle of the first."""
    page = page_of(name) if name in NEW else bare_page(sample(name))
    text = re.split(r'<div class="notation">', page, maxsplit=1)[1].partition("</div>")[0]
    first, _, second = text.partition('<p class="flush half">')
    assert bool(second) == (text.count("<p") < _ON_A_PAGE)
    if second:
        letters = len(plain(first)), len(plain(second))
        assert max(letters) < 1.2 * min(letters)


def test_of_one_cylinder_nothing_is_told_as_of_several():
    text = plain(page_of("one"))
    assert not re.search(
        r"Моменты даны в таблице |суммарный —|момент цилиндров|диаграммы остальных", text
    )


@pytest.mark.parametrize("name", [*SAMPLES, *NEW])
def test_the_speed_of_the_shaft_has_six_digits_at_most(name: str):
    """586,43063 stood in a note; what asks for more is written by the frequency of rotation."""
    formulas = " ".join(formulas_of(page_of(name)))
    assert (r"\left(\dfrac{\pi \cdot 5410}{30}\right)" in formulas) == (name == "border")
    whole, written = math.pi / 30 * with_every_part(name).regime.speed_rpm, set[str]()
    for number in re.findall(r"\d+\{,\}\d+", formulas):
        if abs(float(number.replace("{,}", ".")) - whole) < 1e-4 * whole:
            written.add(number)
    assert len(written) == 1 and all(len(each) <= len("123{,}456") for each in written)


@pytest.mark.parametrize("name", ["yamz-236", "two-stroke", "one"])
def test_a_symbol_stands_for_one_quantity(name: str):
    """Of all that a note prints: scalars, columns, input data."""
    requested: dict[str, Terms] = {}
    tex = Terms.tex

    def noted(self: Terms, key: str) -> str:
        requested[key] = self
        return tex(self, key)

    with (
        mock.patch.object(Terms, "tex", noted),
        mock.patch.object(opening, "_of_subjects", lambda _: []),
    ):
        bare_page(with_every_part(name))
    (terms,) = {id(each): each for each in requested.values()}.values()
    meanings: dict[str, dict[str, str]] = defaultdict(dict)
    for key in {*requested, *terms.model.fields}:
        try:
            symbol = str(inline_html(tex(terms, key)))
        except SymbolError:
            continue
        if symbol:
            title = re.sub(r"\d+", "#", plain(terms.title(key)))
            meanings[symbol][title] = re.sub(r"\d+", "#", key.rpartition(".")[2])
    several = {plain(symbol): sorted(titles) for symbol, titles in meanings.items()
               if len(set(titles.values())) > 1 and plain(symbol) not in SAME}  # fmt: skip
    assert several == {}


def test_one_input_has_one_symbol_in_all_sections():
    """The bore of the main journals stood twice in table 1, once as that of the film."""
    symbols = defaultdict(set)
    for name in (*SAMPLES, *NEW, "mwm-6", "d-240-bearings"):
        given = with_every_part(name)
        for field in build_model(given).inputs:
            if field.name not in unused(given):
                symbols[field.title].add(field.symbol)
    assert {title: each for title, each in symbols.items() if len(each) > 1} == {}


@pytest.mark.parametrize("name", [*SAMPLES, *NEW])
def test_the_share_of_a_web_is_not_told_beside_its_size(name: str):
    given = with_every_part(name)
    sizes = [side for arm in given.crankshaft.arms for side in (arm.left_web_mm, arm.right_web_mm)]
    told = "Отношение толщины щеки к диаметру цилиндра" in plain(page_of(name))
    assert told == (not all(sizes) and given.strength.web_thickness_mm is None)
