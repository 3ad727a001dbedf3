"""No formula is longer than a person reads, every symbol is the report's, whatever the engine."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cache
from html import unescape
from unicodedata import normalize

import pytest

from kshm.nomenclature.symbols import BASE, LOWER, UPPER, symbol_runs
from reports.document.text.symbols import inline_html
from reports.formula.excel import compile_formula
from reports.formula.tex import input_symbol_tex
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from reports.model.blocks import Model, TableSpec, nodes_in
from reports.new.generate import generate_engine
from reports.shared.errors import SymbolError
from reports.tables.curves import with_curves
from reports.tables.registry import build_model
from reports.workbook.layout import Layout, RowReferences, at_row
from tests.conftest import sample, sample_names
from tests.cover import sparse
from tests.layouts import MAKERS, layout_input
from tests.new.test_generate import TWELVE
from tests.workbook.lint import LONGEST


def generated(cylinders: int, layout: str, strokes: int, kind: str) -> InputFile:
    raw = generate_engine(cylinders, layout=layout, strokes=strokes, kind=kind).data
    return load_mapping(raw | {"torsion": {}}, source="").model


ENGINES = {
    **{name: (lambda name=name: sample(name)) for name in sample_names()},
    **{f"layout {name}": (lambda name=name: layout_input(name, method="exact")) for name in MAKERS},
    **{" ".join(map(str, e)): (lambda e=e: generated(*e)) for e in TWELVE},
}


@cache
def model_of(name: str) -> Model:
    return with_curves(build_model(ENGINES[name]()))


@cache
def lengths(name: str) -> dict[str, int]:
    """Characters of each formula, of a column in its last row."""
    model = model_of(name)
    layout = Layout.of(model)
    collected = {}
    for block in model.blocks:
        table = block if isinstance(block, TableSpec) else None
        refs = RowReferences(layout, table, block.sheet)
        last = layout.rows_of(table)[-1] if table else 0
        for key, node in nodes_in(block):
            if node.expr is not None:
                collected[key] = len(at_row(compile_formula(node.expr, refs), last))
    return collected


@pytest.mark.parametrize("name", sparse(ENGINES))
def test_no_formula_is_longer_than_a_person_reads(name: str) -> None:
    assert {key: size for key, size in lengths(name).items() if size > LONGEST} == {}


_TAG = re.compile("<(/?)(sub|sup)>|<[^>]+>")
_UPPER = re.compile("[⁰¹²³⁴-⁹⁻]+")
_SPACING = re.compile("[\\s·\u0300-\u036f\u20d7]")  # and bars, which a page draws otherwise


def levels(pieces: Iterable[tuple[str, str]]) -> dict[str, str]:
    """Letters on the line and of lower and upper indices, each in their order."""
    collected = {BASE: "", LOWER: "", UPPER: ""}
    for text, level in pieces:
        above = "".join(_UPPER.findall(text))
        collected[level or (UPPER if above else BASE)] += above
        collected[level] += _UPPER.sub("", text)
    return {k: _SPACING.sub("", normalize("NFKC", text)) for k, text in collected.items()}


def of_page(html: str) -> Iterator[tuple[str, str]]:
    """Pieces of the report's symbol; within an index all is one."""
    at, open_ = 0, []
    for tag in _TAG.finditer(html):
        yield unescape(html[at : tag.start()]), open_[0] if open_ else BASE
        at = tag.end()
        if tag[2]:
            open_ = open_[:-1] if tag[1] else [*open_, LOWER if tag[2] == "sub" else UPPER]
    yield unescape(html[at:]), BASE


@pytest.mark.parametrize("name", ENGINES)
def test_every_symbol_of_a_heading_is_the_reports(name: str) -> None:
    model = model_of(name)
    abouts = [node.quantity for block in model.blocks for _, node in nodes_in(block)]
    symbols = {about.tex for about in abouts if about.tex and not about.word}
    symbols |= {input_symbol_tex(item.symbol) for item in model.inputs if item.symbol}
    other, drawn = {}, set()
    for tex in symbols:
        try:
            page = levels(of_page(inline_html(tex)))
        except SymbolError:  # set as a formula, from the same TeX
            drawn.add(tex)
            continue
        if page != levels(symbol_runs(tex)):
            other[tex] = page, symbol_runs(tex)
    assert other == {}
    assert len(drawn) < len(symbols) / 10
