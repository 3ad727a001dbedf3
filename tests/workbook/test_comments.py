"""Comments of headers: every column tells its formula in the symbols of the book."""

from __future__ import annotations

import pytest

from reports.formula.plain import plain
from reports.model.blocks import TableSpec
from reports.workbook.layout import HEADER_ROW, Layout
from tests.cover import charts, quantities, samples_with, sparse
from tests.workbook.made import coarse_model, coarse_opened

SYMBOLS = {"a": "a", "b": "b", "t.x": "x", "m": "m − n", "q": "V/Vc"}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a*(b + 2)", "a·(b + 2)"), ("-(a*b)/2.5", "−a·b/2,5"), ("a - (b - a)", "a − (b − a)"),
        ("sqrt(a**2 + m**2)", "√(a² + (m − n)²)"), ("b/q", "b/(V/Vc)"),
        ("to_MPa(a)*sin(rad(b))", "a·sin(b)"), ("(a + b)**1.5", "(a + b)^1,5"),
        ("a if t.x <= 180 and b > 0 else 0", "a при x ≤ 180 и b > 0, иначе 0"),
        ("col_mean(t.x)", "среднее(x)"), ("abs(a)*pi", "|a|·π"), ("a - -b", "a − (−b)"),
    ],
)  # fmt: skip
def test_an_expression_as_a_line(text: str, said: str) -> None:
    assert plain(text, SYMBOLS.__getitem__) == said


@pytest.mark.parametrize("name", sparse(samples_with(charts, quantities)))
def test_every_column_explains_itself(name: str) -> None:
    """Formula and place in the book, unless the formula only repeats another column."""
    book, model = coarse_opened(name), coarse_model(name)
    layout = Layout.of(model)
    message = bare = 0
    for table in (block for block in model.blocks if isinstance(block, TableSpec)):
        for column in table.columns[1:]:
            at = layout.column_of(f"{table.id}.{column.key}")
            text = book[table.sheet].cell(HEADER_ROW, at).comment.text
            assert column.source in text, (table.id, column.key)
            assert "_" not in text.partition("\n")[2], text
            message += " = " in text
            bare += " = " not in text
    assert message > 5 * bare
