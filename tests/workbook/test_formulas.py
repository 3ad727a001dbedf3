"""Lint of the formulas: a subset on which Excel, LibreOffice and formualizer agree."""

from __future__ import annotations

import io
import re
from functools import lru_cache

import pytest
from openpyxl import load_workbook

from reports.formula.excel import compile_formula
from reports.formula.numeric import evaluate
from reports.formula.parse import FormulaError, names, parse
from reports.layout import INPUT_SHEET, Layout
from tests.workbook.made import book, model

ALLOWED = {
    "ABS", "ACOS", "AND", "ASIN", "ATAN2", "AVERAGE", "COS", "COUNT", "DEGREES", "EXP", "IF",
    "INDEX", "INT", "LN", "MATCH", "MAX", "MIN", "MOD", "NOT", "OR", "PI", "RADIANS", "SIN",
    "SQRT", "SUM", "SUMPRODUCT", "TAN",
}  # fmt: skip


@lru_cache(maxsize=1)
def formulas() -> list[tuple[str, str, str]]:
    opened = load_workbook(io.BytesIO(book()))
    return [
        (sheet.title, cell.coordinate, cell.value)
        for sheet in opened.worksheets
        for row in sheet.iter_rows()
        for cell in row
        if cell.data_type == "f"
    ]


def test_only_functions_that_all_engines_share() -> None:
    used = {name for _, _, text in formulas() for name in re.findall(r"([A-Z][A-Z0-9.]*)\(", text)}
    assert used <= ALLOWED


def test_no_number_of_the_input_is_typed_into_a_formula() -> None:
    """Input values that are unlike any constant of a formula must not occur in one."""
    special = {
        repr(float(field.value))
        for field in model().inputs
        if isinstance(field.value, float) and not float(field.value).is_integer()
    }
    special -= {"0.5"}
    for sheet, cell, text in formulas():
        bare = re.sub(r"'[^']*'!|[A-Za-z_][A-Za-z_0-9.]*|\$?[A-Z]{1,3}\$?\d+", " ", text)
        found = {repr(float(number)) for number in re.findall(r"\d+\.\d+", bare)}
        assert not found & special, (sheet, cell, text)


def test_results_are_formulas_and_never_typed_numbers() -> None:
    """Outside the input sheet a number is only the first angle, a column number or a label."""
    opened = load_workbook(io.BytesIO(book()))
    layout = Layout.of(model())
    first_angles = {
        (table.sheet, 6, layout.column_of(f"{table.id}.{table.columns[0].key}"))
        for table in model().tables.values()
    }
    for sheet in opened.worksheets:
        if sheet.title == INPUT_SHEET:
            continue
        for row in sheet.iter_rows(min_row=6):
            for cell in row:
                if cell.data_type == "n" and cell.value is not None:
                    assert (sheet.title, cell.row, cell.column) in first_angles, cell


def test_names_are_legal_and_point_at_single_cells() -> None:
    opened = load_workbook(io.BytesIO(book()))
    seen = set()
    for name, defined in opened.defined_names.items():
        assert re.fullmatch(r"[A-Za-z_][A-Za-z0-9_.]*", name)
        assert not re.fullmatch(r"(?i)[a-z]{1,3}[0-9]+|r|c|r[0-9]*c[0-9]*", name)
        assert re.fullmatch(r"'[^']+'!\$[A-Z]+\$[0-9]+", defined.attr_text)
        assert name.casefold() not in seen
        seen.add(name.casefold())


class Plain:
    """References that show the name itself."""

    def name(self, key: str) -> str:
        return key

    def column(self, key: str, *, repeat_last: bool) -> str:
        return f"[{key}{'+' if repeat_last else ''}]"

    def last(self, key: str) -> str:
        return f"[{key}:last]"

    def following(self, key: str) -> str:
        return f"[{key}:next]"


@pytest.mark.parametrize(
    ("text", "formula"),
    [
        ("-a**2", "=-(a^2)"),
        ("(-a)**2", "=(-a)^2"),
        ("a**b**c", "=a^(b^c)"),
        ("a - (b - c)", "=a-(b-c)"),
        ("a / (b * c)", "=a/(b*c)"),
        ("a * -b", "=a*(-b)"),
        ("atan2(y, x)", "=ATAN2(x,y)"),
        ("to_MPa(a + b)", "=(a+b)/1000000"),
        ("of_mm(a)", "=a/1000"),
        ("1 if a <= b and c != 0 else 2", "=IF(AND(a<=b,c<>0),1,2)"),
        ('1 if mode == "да" else 0', '=IF(mode="да",1,0)'),
        ("col_mean(t.x) + col_max(t.x)", "=AVERAGE([t.x])+MAX([t.x+])"),
    ],
)
def test_compiled_formula(text: str, formula: str) -> None:
    assert compile_formula(text, Plain()) == formula


def test_numpy_agrees_with_python_arithmetic() -> None:
    resolve = {"a": 3.0, "b": -2.0}.__getitem__
    assert evaluate("-a**2 + b*(a - b)/4", resolve) == -9.0 - 2.5
    assert evaluate("mod(b, a)", resolve) == 1.0
    assert evaluate("min(a, b, 1) if a > b else 0", resolve) == -2.0


@pytest.mark.parametrize(
    "text",
    ["__import__('os')", "a.b.c", "[1]", "lambda: 1", "a if b", "open('x')", "sin()", "a @ b",
     "sin(x, y=1)", "f'{a}'", "a[0]", "True"],
)  # fmt: skip
def test_anything_else_is_refused(text: str) -> None:
    with pytest.raises(FormulaError):
        parse(text)


def test_names_of_an_expression() -> None:
    assert names("a*sin(t.b) + pi*col_max(c)") == {"a", "t.b", "c"}
