"""Sheets of samples and of random engines, made once for all tests."""

from __future__ import annotations

from functools import lru_cache

from reports.document.text.terms import Terms
from reports.inputs.load import load_text
from reports.inputs.solve_input import fine_columns
from reports.model.evaluation import evaluate_model
from reports.shared.resources import samples_dir
from reports.sheet.write import sheet_items
from reports.tables.registry import build_model

_last: list[tuple] = []


def drawn(t: Terms):
    """A sheet, made once for all that looks at it one after the other."""
    if not _last or _last[0][0] is not t:
        _last[:] = [(t, sheet_items(t))]
    return _last[0][1]


def terms_of(model) -> Terms:
    built = build_model(model)
    return Terms(built, evaluate_model(built), fine_columns(model))


@lru_cache(maxsize=4)
def terms(name: str, section: str = "") -> Terms:
    text = (samples_dir() / f"{name}.toml").read_text(encoding="utf-8")
    return terms_of(load_text(text + section, source=f"{name}.toml").model)
