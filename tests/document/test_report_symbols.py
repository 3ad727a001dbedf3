"""One symbol has one meaning in a report: formulas, «где» lists, tables and lists of symbols."""

from __future__ import annotations

import importlib
import pkgutil
import re
from collections import defaultdict

import pytest

from reports.document import chapters
from reports.document.report import Report
from reports.document.text.terms import Terms
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import evaluate_model
from reports.model.shape import TIMING
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.cover import quantities, samples_with

Meanings = dict[str, set[str]]

SYMBOL = r"(?:<i>[^<]+</i>|[α-ω])(?:<sub>(?:[^<]|<i>[^<]*</i>)*</sub>)*"
# Indices, axes and points of the indicator diagram: each list says which it means.
LETTERS = {"i", "k", "x", "y", "r"}


@pytest.fixture
def meanings(monkeypatch: pytest.MonkeyPatch, nothing_is_drawn: None) -> Meanings:
    """Titles of the quantities whose symbols are written while a report is made.

    Those of formulas are asked for too, though no formula is set.
    """
    seen: Meanings = defaultdict(set)
    plain = Terms.tex

    def tex(terms: Terms, name: str) -> str:
        written = plain(terms, name)
        if written and name.rpartition(".")[2] != TIMING:  # φ of one cylinder, told so
            seen[written].add(terms.title(name))
        return written

    monkeypatch.setattr(Terms, "tex", tex)
    for found in pkgutil.iter_modules(chapters.__path__):
        module = importlib.import_module(f"{chapters.__name__}.{found.name}")
        if hasattr(module, "angle_table"):
            monkeypatch.setattr(module, "angle_table", _noted_columns(seen, module.angle_table))
        if hasattr(module, "grid_table"):
            monkeypatch.setattr(module, "grid_table", _noted_rows(seen, module.grid_table))
    return seen


def _noted_columns(seen, make):
    def noted(terms, table, keys=None, *, own_symbols=False, **manner):
        for column in terms.model.tables[table].columns:
            if not own_symbols and (column.key in keys if keys else not column.helper):
                seen[column.quantity.tex].add(column.quantity.title)
        return make(terms, table, keys, own_symbols=own_symbols, **manner)

    return noted


def _noted_rows(seen, make):
    def noted(terms, grid, rows=(), labels=()):
        rows, labels = list(rows), list(labels)
        for row in grid.rows:
            if row.of in rows or not rows:
                seen[row.quantity.tex].add(row.quantity.title)
        return make(terms, grid, rows, labels)

    return noted


def page_of(name: str) -> str:
    raw = to_mapping(sample(name))
    raw["report"]["detail"] = "full"
    raw["calculation"]["step_deg"] = 30  # the same words in shorter tables
    model = build_model(load_mapping(raw, source=name).model)
    return Report(model, evaluate_model(model)).page("screen")


def bare(symbol: str) -> str:
    return re.sub("</?i>", "", symbol).strip()


def told(page: str) -> Meanings:
    """What the sentences say that symbols mean: «α — угол …»."""
    found: Meanings = defaultdict(set)
    for text in re.findall(r"<p[^>]*>(.*?)</p>", page, re.DOTALL):
        for symbol, meaning in re.findall(rf"({SYMBOL})\s—\s([^,;.(<]+)", text):
            found[bare(symbol)].add(meaning.strip())
    return found


@pytest.mark.parametrize("name", samples_with(quantities))
def test_a_symbol_means_one_thing(name: str, meanings: Meanings) -> None:
    page = page_of(name)
    assert {tex: titles for tex, titles in meanings.items() if len(titles) > 1} == {}
    said = {s: words for s, words in told(page).items() if s not in LETTERS}
    assert {symbol: words for symbol, words in said.items() if len(words) > 1} == {}
