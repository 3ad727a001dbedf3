"""Formulas of the workbook: what they refer to, ROUND, functions of Fourier sums."""

from __future__ import annotations

import io
import re
import zipfile

import numpy as np
import pytest
from lxml import etree
from openpyxl import load_workbook

from reports.formula.excel import compile_formula
from reports.formula.numeric import evaluate
from reports.formula.parse import names, parse
from reports.formula.tex import to_tex
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.shape import FIRING
from reports.shared.errors import FormulaError
from reports.tables.curves import with_curves
from reports.tables.registry import build_model
from reports.workbook import cockpit
from reports.workbook.caches import sheet_parts
from reports.workbook.layout import INPUT_SHEET, WAVES_SHEET, Layout, RowReferences, at_row
from reports.workbook.styles import NUMBER
from reports.workbook.write import workbook_bytes
from tests.conftest import sample
from tests.workbook.lint import LONGEST, MAIN, formula_problems, literals
from tests.workbook.made import coarse_book, coarse_model, coarse_opened, model


def cell(formula: str, value: str = "1") -> etree._Element:
    root = etree.Element(f"{MAIN}c", r="A9")
    built = etree.SubElement(root, f"{MAIN}f")
    built.text = formula
    etree.SubElement(root, f"{MAIN}v").text = value
    return root


@pytest.mark.parametrize(
    ("formula", "said"),
    [
        ("A1*RAND()", "RAND is volatile"), ("OFFSET(A1,1,0)", "OFFSET is volatile"),
        ("IFERROR(A1,0)", "IFERROR is not shared"), ("N(A1)", "N is not shared"),
        ("_xlfn.IFNA(A1,0)", "newer"), ("[1]Лист!A1+1", "external"), ("#REF!+1", "error value"),
        ("SUM(A1:A9*B1:B9)", "SUM on A1:A9"), ("MAX(ABS(A1:A9))", "ABS on A1:A9"),
        ("SUMPRODUCT(A1:A9,ABS(B1:B9))", "ABS on B1:B9"), ("A1:A9+1", "arithmetic on A1:A9"),
        ("SUM(SIN('П4.1'!A1:A9))", "SIN on A1:A9"), ("A1" + "+A1" * 90, "too long"),
        ("IF(A1>=m-1,A6,9999)", "sentinel"),
        ("A1<=180+0.0000001", "guard"), ("A1<b*MAX(1,ABS(b))", "guard"),
        ("A1*1E-07", "exponent"), ("2*(-(A1*B1))", "sign before"), ("-(A1+B1)", "sign before"),
    ],
)  # fmt: skip
def test_the_lint_sees_each_defect(formula: str, said: str) -> None:
    assert any(said in problem for problem in formula_problems(cell(formula)))


@pytest.mark.parametrize(
    "formula",
    ["2*SUMPRODUCT('П4.2'!$B$6:$B$77,'Синусы и косинусы'!$C$6:$C$77)/COUNT(B6:B77)",
     'IF(A6<=0.000001,"RAND()",MAX($B$6:$B$78,1))', "INDEX('Лист (2)'!A1:A9,MATCH(x,B1:B8,1)+1)",
     "SUMPRODUCT(A1:A9*B1:B9)"],
)  # fmt: skip
def test_the_lint_passes_what_all_engines_share(formula: str) -> None:
    assert formula_problems(cell(formula)) == []


def test_a_formula_without_its_value_or_of_an_array_is_a_defect() -> None:
    assert formula_problems(cell("A1+1", "")) == ["no cached value"]
    array = cell("A1+1")
    array.find(f"{MAIN}f").set("t", "array")
    assert "array" in formula_problems(array)[0]
    assert "over a range" in formula_problems(cell("SUMPRODUCT(A1:A3,COS(B1:B3*2))"))[0]


def test_literals_of_a_formula() -> None:
    text = "IF('П4.1'!$A$6<=180+1E-07,r_2*0.047,\"88\")+B3/1000+LN(2)+R1C7"
    assert literals(text) == {180.0, 1e-7, 0.047, 1000.0, 2.0}


def test_no_number_of_the_input_is_typed_into_a_formula() -> None:
    """Input values that are unlike any constant of a formula must not occur in one.

    That no formula changes with the input, and that the sheet of inputs has no numbers but their
    limits, for every sample: ``test_every_sample``.
    """
    special = {
        float(field.value)
        for field in coarse_model().inputs
        if isinstance(field.value, float) and not float(field.value).is_integer()
    } - {0.5}
    assert len(special) > 10
    with zipfile.ZipFile(io.BytesIO(coarse_book())) as archive:
        for title, part in sheet_parts(archive).items():
            for formula in etree.fromstring(archive.read(part)).iter(f"{MAIN}f"):
                own = title != INPUT_SHEET
                text = formula.text or ""  # of a shared one the first alone has it
                assert not (own and literals(text) & special), text


def test_results_are_formulas_and_never_typed_numbers() -> None:
    """Outside the input sheet a number is only the first angle, a column number or a label."""
    opened = load_workbook(io.BytesIO(coarse_book()))
    drawn = with_curves(coarse_model())
    layout, tables = Layout.of(drawn), drawn.tables.values()
    numbers = {
        (table.sheet, 6, layout.column_of(f"{table.id}.{table.columns[0].key}")) for table in tables
    } | {
        (table.sheet, 6 + row, layout.column_of(f"{table.id}.{column.key}"))
        for table in tables
        for column in table.columns
        if table.is_computed(column)  # as the sheet says
        for row in range(len(table.rows))
    }
    for sheet in opened.worksheets:
        if sheet.title in (INPUT_SHEET, cockpit.SHEET):  # there the numbers as issued
            continue
        for row in sheet.iter_rows(min_row=6):
            for cell in row:
                order = (sheet.title, cell.column, cell.style) == (WAVES_SHEET, 1, NUMBER)
                if cell.data_type == "n" and cell.value is not None and not order:
                    assert (sheet.title, cell.row, cell.column) in numbers, cell


def test_names_are_legal_and_point_at_single_cells() -> None:
    seen = set()
    for name, defined in coarse_opened().defined_names.items():
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
        ("-a**2", "=0-a^2"),
        ("a - -(b + c)", "=a-(0-(b+c))"),
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


def test_a_stiffness_estimated_from_sizes_is_calculated_in_steps() -> None:
    """An empty section: every size of the cranked shaft is read or estimated."""
    raw = to_mapping(sample("gots-diesel")) | {"torsion": {}}
    model = build_model(load_mapping(raw, source="x").model)
    cells = [
        cell.value
        for sheet in load_workbook(io.BytesIO(workbook_bytes(model))).worksheets
        if sheet.title.startswith("Крутильн")
        for line in sheet.iter_rows()
        for cell in line
        if isinstance(cell.value, str) and cell.value.startswith("=")
    ]
    assert len(cells) > 100
    assert max(map(len, cells)) <= LONGEST


class _Names:
    def name(self, key: str) -> str:
        return key


def test_halves_go_away_from_zero() -> None:
    values = np.array([0.5, 1.5, 2.5, -0.5, -2.5, 87.58, -1.2])
    rounded = evaluate("round(x)", lambda _: values)
    assert rounded.tolist() == [1, 2, 3, -1, -3, 88, -1]


def test_excel_and_tex() -> None:
    assert compile_formula("2*round(x/2)", _Names()) == "=2*ROUND(x/2,0)"
    assert to_tex("round(x)", lambda name: name) == r"\mathrm{окр}\left(x\right)"


DEGREES = np.arange(0.0, 721.0, 10.0)
NAMES = {"wave": 3 + 2 * np.cos(np.radians(DEGREES)) - 0.5 * np.sin(np.radians(2.5 * DEGREES)),
         "phi_deg": DEGREES, "order": np.array([0.5, 1.0, 2.5])}  # fmt: skip


def value(text: str) -> object:
    return evaluate(text, NAMES.__getitem__)


def test_coefficients_of_a_known_wave() -> None:
    assert value("fourier_cos(wave, phi_deg, order)") == pytest.approx([0, 2, 0], abs=1e-14)
    assert value("fourier_sin(wave, phi_deg, order)") == pytest.approx([0, 0, -0.5], abs=1e-14)
    assert value("fourier_sin(wave, phi_deg, 2.5)") == pytest.approx(-0.5)


def test_a_running_sum_takes_the_rows_down_to_its_own() -> None:
    assert np.asarray(value("running_sum(phi_deg)"))[:4] == pytest.approx([0, 10, 30, 60])


def test_formulas_leave_the_repeated_last_row_out() -> None:
    built = model()
    references = RowReferences(Layout.of(built), built.tables["torque_orders"])
    text = compile_formula("fourier_cos(tangential.t_gas_MPa, tangential.phi_deg, 1.5)", references)
    waves = "'Синусы и косинусы'!$D$6:$D$77"
    assert text == f"=2*SUMPRODUCT($B$6:$B$77,{waves})/COUNT($B$6:$B$77)"
    running = compile_formula("running_sum(tangential.t_gas_MPa)", references)
    assert at_row(running, 9) == "=SUM($B$6:B9)"


def test_each_row_sums_over_the_waves_of_its_order() -> None:
    built = model()
    references = RowReferences(Layout.of(built), built.tables["torque_orders"])
    sines = "fourier_sin(tangential.t_gas_MPa, tangential.phi_deg, order)"
    text = compile_formula(sines, references)
    assert "'Синусы и косинусы'!$R$6:$R$77)" in at_row(text, 6)
    assert "'Синусы и косинусы'!$AG$6:$AG$77)" in at_row(text, 21)


def test_sums_over_cylinders_take_the_waves_of_each_order() -> None:
    built = model()
    references = RowReferences(Layout.of(built), built.tables["torque_orders"])
    text = compile_formula(f"wave_sin({FIRING}, order)", references)
    first, second = at_row(text, 6), at_row(text, 7)
    assert first.startswith("=SUM('Синусы и косинусы'!$B$") and first != second
