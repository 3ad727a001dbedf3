"""No formula is longer than a person reads, whatever the engine."""

from __future__ import annotations

from functools import cache

import pytest

from reports.formula.excel import compile_formula
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from reports.model.blocks import TableSpec, nodes_in
from reports.new.generate import generate_engine
from reports.tables.registry import build_model
from reports.workbook.layout import Layout, RowReferences, at_row
from tests.conftest import sample, sample_names
from tests.cover import sparse
from tests.layouts import MAKERS, made
from tests.new.test_generate import TWELVE
from tests.workbook.lint import LONGEST


def generated(cylinders: int, layout: str, strokes: int, kind: str) -> InputFile:
    raw = generate_engine(cylinders, layout=layout, strokes=strokes, kind=kind).data
    return load_mapping(raw | {"torsion": {}}, source="").model


ENGINES = {
    **{name: (lambda name=name: sample(name)) for name in sample_names()},
    **{f"layout {name}": (lambda name=name: made(name, method="exact")) for name in MAKERS},
    **{" ".join(map(str, e)): (lambda e=e: generated(*e)) for e in TWELVE},
}


@cache
def lengths(name: str) -> dict[str, int]:
    """Characters of each formula, of a column in its last row."""
    model = build_model(ENGINES[name]())
    layout = Layout.of(model)
    found = {}
    for block in model.blocks:
        table = block if isinstance(block, TableSpec) else None
        refs = RowReferences(layout, table, block.sheet)
        last = layout.rows_of(table)[-1] if table else 0
        for key, node in nodes_in(block):
            if node.expr is not None:
                found[key] = len(at_row(compile_formula(node.expr, refs), last))
    return found


@pytest.mark.parametrize("name", sparse(ENGINES))
def test_no_formula_is_longer_than_a_person_reads(name: str) -> None:
    assert {key: size for key, size in lengths(name).items() if size > LONGEST} == {}
