"""People's formulas by formualizer: what it gets wrong is met, what it cannot do is unknown."""

from __future__ import annotations

import io
import math
import re
import zipfile
from pathlib import Path

import numpy as np
import pytest

from reports.recalculation.evaluate import Evaluator
from reports.recalculation.formulas import formula_of, pattern, quoted, render
from reports.recalculation.functions import ALLOWED, BY_ENGINE, BY_PERSON, BY_PROGRAM
from reports.recalculation.read import read_grid
from reports.recalculation.trial_sheet import Bench, Cells, PinnedGrid, pinned, unrounded
from reports.shared.errors import UnknownFormula
from reports.workbook.caches import sheet_parts
from tests.referee.books import engine_of
from tests.workbook.made import coarse_book
from tools.referees.by_formualizer import Formualizer
from tools.referees.cells import row_and_column

COLUMN = 26


@pytest.mark.parametrize("name", ["gots-diesel", "cycle-turbo-diesel"])
def test_a_grid_gives_what_the_whole_workbook_gives(name):
    """Only this test holds the grid of runs against formualizer's own reading of a file."""
    book = coarse_book(name)
    engine = Evaluator(read_grid(book))
    (wanted,) = Formualizer().recalculate([book])
    compared = 0
    for sheet, cells in wanted.items():
        for cell, value in cells.items():
            row, column = row_and_column(cell)
            own = engine.shown(sheet, column, row)
            if isinstance(value, str):
                assert str(own).lower() == value.lower(), (sheet, cell)
            else:
                assert own == pytest.approx(value, rel=1e-9, abs=1e-12), (sheet, cell)
            compared += 1
    assert compared > 3000


def test_what_is_compared_stays_rounded_where_roundings_are_taken_away():
    text = "ROUND(IF(ROUND(A1-B1,9)>=C1,ROUND(A1,2),IF(B1<ROUND(A1,1),ROUND(B1,3),D1)),2)"
    actual = render(unrounded(formula_of(pattern(text, 1, 3))).pattern, 1, 3)
    assert actual == "=(IF(ROUND(A1-B1,9.0)>=C1,(A1),IF(B1<ROUND(A1,1.0),(B1),D1)))"


# As LibreOffice 7.4 calculates them.
SELDOM = {
    "ACOT(A3)": 2.8563352406082534, "COT(A1)": 0.332273417254529, "SEC(A3)": -1.0371351588584488,
    "CSC(A3)": 3.7707938654716204, "SQRTPI(A1)": 1.98166364880301, "CEILING.MATH(A3,0.5)": -3.0,
    "FLOOR.MATH(A3,0.5)": -3.5, "DEVSQ(A1:A7)": 33.64432, "MAXA(A1:A7)": 4.5, "MINA(A1:A7)": -3.41,
    "FORECAST(A2,A1:A5,B1:B5)": 1.02229, "FORECAST.LINEAR(2.5,A1:A5,B1:B5)": 1.0375,
    "SERIESSUM(A3,1,2,B1:B3)": -1465.9396613103, "RANK.EQ(A3,A1:A5,1)": 1.0,
    "SUBTOTAL(9,A1:A7)": 5.48, "SUBTOTAL(1,A1:A2,A4:A5)": 2.2225, "SUBTOTAL(11,A1:A5)": 6.728864,
    'CONVERT(B3*60,"deg","rad")': math.pi, 'CONVERT(A1,"rad","deg")': 71.6197243913529,
    "AGGREGATE(4,6,A1:A5)": 4.5, "AGGREGATE(9,4,A1:A7)": 5.48, "AGGREGATE(12,6,A1:A5)": 1.25,
    "IMABS(COMPLEX(B3,B4))": 5.0, 'LEN(SUBSTITUTE("a1a","a",""))': 1.0,
    "SUBTOTAL(9,C1:C5)": 17.78, 'CONVERT(A1,"mm","m")': 0.00125, 'CONVERT(A3,"kg","g")': -3410.0,
}  # fmt: skip


def test_functions_that_people_seldom_need_are_calculated():
    numbers = [1.25, 2.37, -3.41, 4.5, 0.77]
    cells = {f"A{row}": value for row, value in enumerate(numbers, 1)} | {"A7": "слово"}
    cells |= {f"B{row}": row for row in range(1, 6)}
    cells |= {f"C{row}": f"=A{row}*2" for row in range(1, 6)} | {"C3": "=SUBTOTAL(9,A1:A2)"}
    cells |= {f"E{row}": f"={text}" for row, text in enumerate(SELDOM, 1)}
    engine = engine_of(cells)
    collected = {text: engine.shown("Sheet", 5, row) for row, text in enumerate(SELDOM, 1)}
    assert collected == pytest.approx(SELDOM, rel=1e-12)


# As LibreOffice 7.4 calculates them; what it lacks by hand.
OF_RECTANGLES = {
    "SUM(MMULT(A1:B2,A1:B2))": 54.0, "INDEX(MMULT(A1:B2,A1:B2),2,1)": 15.0, "MDETERM(A1:B2)": -2.0,
    "INDEX(MINVERSE(A1:B2),1,2)": 1.0, "SUM(MMULT(TRANSPOSE(A1:A3),B1:B3))": 44.0,
    "SUM(TRANSPOSE(A1:A3))": 9.0, "CORREL(A1:A3,B1:B3)": 1.0,
    'VALUE("12")+1': 13.0, 'FIND("b","abc")': 2.0, 'SEARCH("B","abc")': 2.0,
    "ERF(1)": 0.842700792949715, 'IMARGUMENT("3+4i")': 0.927295218001612,
    'IMREAL(IMPRODUCT("1+2i","3-1i"))': 5.0, 'IMABS(IMDIV("3+4i","1+0i"))': 5.0,
    "SUM(FILTER(B1:B3,A1:A3>2))": 10.0, "INDEX(SORT(A1:A3),1)": 1.0, "SUM(SEQUENCE(3))": 6.0,
    "SUM(TAKE(A1:A3,2))": 4.0, "SUM(DROP(A1:A3,2))": 5.0, "SUM(VSTACK(A1:A2,B1:B2))": 10.0,
}  # fmt: skip


def test_functions_of_rectangles_are_calculated():
    cells = {"A1": 1, "A2": 3, "A3": 5, "B1": 2, "B2": 4, "B3": 6}
    cells |= {f"E{row}": f"={text}" for row, text in enumerate(OF_RECTANGLES, 1)}
    engine = engine_of(cells)
    collected = {text: engine.shown("Sheet", 5, row) for row, text in enumerate(OF_RECTANGLES, 1)}
    assert collected == pytest.approx(OF_RECTANGLES, rel=1e-12)
    odd = {"A1": 1, "A2": 2, "B1": 2, "B2": 4, "C1": "слово"}
    texts = {"E1": "=MMULT(A1:B2,A1:A1)", "E2": "=SUM(MINVERSE(A1:B2))", "E3": "=MDETERM(C1:C1)"}
    engine = engine_of(odd | texts)
    assert [engine.shown("Sheet", 5, row) for row in (1, 2, 3)] == ["#VALUE!", "#NUM!", "#VALUE!"]
    spilt = engine_of(cells, {"G1:H2": "=MMULT(A1:B2,A1:B2)"})
    assert [spilt.shown("Sheet", column, 2) for column in (7, 8)] == [15.0, 22.0]


@pytest.mark.parametrize(
    "text",
    [
        'CONVERT(A1,"kPa","Pa")',
        'CONVERT(A1,B1,"m")',
        'CONVERT(A1,"MM","m")',
        "SUBTOTAL(109,A1:A3)",
        "SUBTOTAL(A1,A1:A3)",
        "AGGREGATE(14,6,A1:A3,1)",
        "AGGREGATE(9,5,A1:A3)",
        "SUM(OFFSET(A1,1,0))",
    ],
)
def test_what_the_engine_would_get_wrong_in_them_is_unknown(text):
    with pytest.raises(UnknownFormula):
        engine_of({"A1": 9, "C1": f"={text}"}).shown("Sheet", 3, 1)


def test_cached_values_are_not_read():
    book = coarse_book("gots-diesel")
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(book)) as source,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as target,
    ):
        parts = set(sheet_parts(source).values())
        for name in source.namelist():
            data = source.read(name)
            if name in parts:
                data = re.sub(rb"(</f>|<f/>)<v>[^<]*</v>", rb"\1<v>7</v>", data)
            target.writestr(name, data)
    values = []
    for data in (book, stream.getvalue()):
        engine = Evaluator(read_grid(data))
        runs = [run for column in engine.grid.sheets["П4.1"].values() for run in column.runs]
        values.append(np.concatenate([engine.all_of(run) for run in runs]))
    assert np.array_equal(values[0], values[1], equal_nan=True)  # a line over a table is a text


def value(formula: str, **cells: object) -> float | str | None:
    return engine_of({**cells, "Z1": formula}).shown("Sheet", COLUMN, 1)


def array_value(formula: str, **cells: object) -> float | str | None:
    return engine_of(cells, {"Z1": formula}).shown("Sheet", COLUMN, 1)


NUMBERS = {"A1": 1.0, "A2": -2.0, "A3": 3.0, "B1": "=1/0", "B2": "=SQRT(-1)"}


@pytest.mark.parametrize(
    ("formula", "wanted"),
    [
        ("=SUM(ABS(A1:A3))", 6.0), ("=SUM(SIGN(A1:A3))", 1.0), ("=SUM(INT(A1:A3/2))", 0.0),
        ("=SUM(TRUNC(A1:A3/2))", 0.0), ("=SUM(ROUND(A1:A3*1.45,1))", 3.0),
        ("=SUM(POWER(A1:A3,2))", 14.0), ("=SUM(MOD(A1:A3,2))", 2.0),
        ("=SUM(RADIANS(A1:A3*90))", np.pi), ("=SUM(DEGREES(A1:A3))", np.degrees(2)),
        ("=SUM(SQRT(A1:A3^2))", 6.0), ("=SUM(EXP(LN(ABS(A1:A3))))", 6.0),
        ("=SUM(LOG(ABS(A1:A3),2)-LN(ABS(A1:A3))/LN(2))", 0.0), ("=SUM(ATAN(A1:A3*0+1))*4/3", np.pi),
        ("=SUM(ASIN(A1:A3/3)+ACOS(A1:A3/3))/1.5", np.pi), ("=SUM(NOT(A1:A3>0)*1)", 1.0),
        ("=SUM(SQRT(A1:A3))", "#NUM!"), ("=SUM(ABS(B1:B2))", "#DIV/0!"),
        ("=SUM(LN(A1:A3*0))", "#NUM!"),
        ("=SUM(MOD(A1:A3,0))", "#DIV/0!"), ('=SUM(ABS(A1:A3&"x"))', "#VALUE!"),
    ],
)  # fmt: skip
def test_functions_are_lifted_over_arrays_and_keep_kinds_of_errors(formula, wanted):
    """Of all tests this one alone has every function that formualizer does not lift itself."""
    actual = array_value(formula, **NUMBERS)
    assert actual == (wanted if isinstance(wanted, str) else pytest.approx(wanted, abs=1e-12))


def test_capitals_of_any_alphabet_are_not_told_apart():
    for formula in (
        '="да"="Да"',
        '=A1="ДА"',
        "=A1=A2",
        '=MATCH("ДА",A1:A2,0)',
        '=COUNTIF(A1:A2,"дА")=2',
    ):
        assert value(formula, A1="да", A2="Да") == 1.0, formula


@pytest.mark.parametrize(
    "formula",
    ['=INDIRECT("A1")', '=WEBSERVICE("http://x")', "=A1+nothing", "=[1]Sheet1!A1",
     "=RAND()", "=NOW()",
     "=" + "(" * 80 + "1" + ")" * 80, "=SUM(A3:A1)", "=A2:A3",
     "=A2:A3*2",
     "=INDEX(A1:B3,0,1)", "={1,2}", "=MATCH(A1:A3,A1:A3,0)", '="1,5"+1', "=C1*2",
     "=SUMPRODUCT(C2:C2,A1:A1)",
     "=A1 A2", "=1+", "=Sheet!", "=SUM(A1:)", "=" + "A1+" * 3000 + "1"],
)  # fmt: skip
def test_what_cannot_be_calculated_for_certain_is_unknown(formula):
    engine = engine_of({"A1": 1.0, "C1": "1,5", "C2": "15", "Z1": formula, "Z2": "=Z1+1",
                        "Z3": "=IFERROR(Z2,5)", "Z4": "=A1+1"})  # fmt: skip
    for row in (1, 2, 3):  # and so is what depends on it, whatever hides errors
        with pytest.raises(UnknownFormula):
            engine.values("Sheet", COLUMN, row, row)
    assert engine.values("Sheet", COLUMN, 4, 4)[0].tolist() == [2.0]


def test_errors_of_formualizers_own_are_never_the_students():
    from reports.recalculation.evaluate import _numbers

    for kind in ("Error", "NImpl", "Name", "Cancelled", "Spill", "#REF!"):
        with pytest.raises(UnknownFormula):
            _numbers([1.0, {"type": "Error", "kind": kind}])
    assert _numbers([1.0, {"type": "Error", "kind": "Div"}, "a", True])[1] == "netn"


def test_one_formula_that_formualizer_stops_at_leaves_the_others():
    import formualizer

    engine = engine_of({"A1": 2.0, "Z1": "=A1*3", "Z2": "=A1*0"})

    class Stopping:
        def __init__(self, book):
            self.book = book

        def evaluate_all(self):
            raise formualizer.ExcelEvaluationError("#REF!")

        def __getattr__(self, name):
            return getattr(self.book, name)

        def evaluate_cell(self, sheet, row, column):
            if row == 2:
                raise formualizer.ExcelEvaluationError("#REF!")
            return self.book.evaluate_cell(sheet, row, column)

    engine.__dict__["_book"] = Stopping(engine._book)
    assert engine.shown("Sheet", COLUMN, 1) == 6.0
    with pytest.raises(UnknownFormula):
        engine.shown("Sheet", COLUMN, 2)


@pytest.mark.parametrize(
    ("formula", "wanted"),
    [("=1/0", "#DIV/0!"), ("=SQRT(-1)", "#NUM!"), ("=MATCH(9,A1:A2,0)", "#N/A"),
     ('=A1+"a"', "#VALUE!"),
     ("=Лист!A1", "#REF!"), ("=1E308*10", "#NUM!"), ("=Z1+1", "#CIRC!")],
)  # fmt: skip
def test_errors_are_no_numbers(formula, wanted):
    engine = engine_of({"A1": 3.0, "A2": 4.0, "Z1": formula})
    assert engine.shown("Sheet", COLUMN, 1) == wanted
    numbers, kinds = engine.values("Sheet", COLUMN, 1, 1)
    assert kinds == "e"
    assert np.isnan(numbers[0])


def test_a_recurrence_a_circle_and_a_choice_that_avoids_it():
    cells = {"A1": 1.0, "A2": "=A1+1", "A3": "=A2+1", "A4": "=A3+1", "B1": "=C1+1", "C1": "=B1+1",
             "D1": "=IF(TRUE,1,D2)", "D2": "=D1+1"}  # fmt: skip
    engine = engine_of(cells)
    assert engine.values("Sheet", 1, 1, 4)[0].tolist() == [1, 2, 3, 4]
    assert engine.values("Sheet", 2, 1, 1)[1] == "e"
    assert engine.values("Sheet", 4, 1, 2)[0].tolist() == [1, 2]  # no circle that is live


def test_array_formulas_fill_their_extent_and_nothing_else():
    engine = engine_of({"A1": 1.0, "A2": 2.0, "A3": 3.0, "D1": "=B2+B3", "E1": "=B4+C3"},
                       {"B1:B3": "=A1:A3*2", "C1:C2": "=A1:A3*3"})  # fmt: skip
    assert engine.values("Sheet", 2, 1, 3)[0].tolist() == [2, 4, 6]
    assert engine.values("Sheet", 2, 1, 3)[1] == "nnn"
    assert engine.values("Sheet", 3, 1, 3) == (pytest.approx([3, 6, np.nan], nan_ok=True), "nnb")
    assert engine.shown("Sheet", 4, 1) == 10.0
    assert engine.shown("Sheet", 5, 1) == 0.0
    with pytest.raises(UnknownFormula):  # of two cells it fills one
        engine_of({"A1": 1.0}, {"B1:B2": "=A1:A1*2"}).values("Sheet", 2, 1, 2)


@pytest.mark.parametrize("title", ["P41", "Q1 план", "E1-2", "Силы д'Аламбера", "R1C1"])
def test_a_title_that_looks_like_a_cell_stays_when_formulas_are_filled_down(title):
    own = quoted(title)
    cells = {"A1": 2.0, "A2": 3.0, "B1": f"={own}A1*10", "B2": f"={own}A2*10",
             "C1": f"=SUM({own}A$1:A1)", "C2": f"=SUM({own}A$1:A2)"}  # fmt: skip
    engine = engine_of(cells, title=title)
    assert engine.values(title, 2, 1, 2)[0].tolist() == [20.0, 30.0]
    assert engine.values(title, 3, 1, 2)[0].tolist() == [2.0, 5.0]


def test_formulas_on_other_cells():
    engine = engine_of({"A1": 2.0, "A2": 3.0, "B1": "=A1*10", "B2": "=A2*10+B1", "C1": "=B1+B2"})
    (run,) = engine.grid.sheets["Sheet"][3].runs
    second = engine.grid.sheets["Sheet"][2].runs[1]
    cells = [Cells("Sheet", 2, (1, 2), (1.0, 5.0))]
    bench = Bench(PinnedGrid(pinned(engine.grid, cells)), {"sum": [run], "product": [second]})
    assert bench.values("sum", [1]).tolist() == [6.0]  # of the constants, not of the formulas
    assert bench.values("product", [2]).tolist() == [31.0]
    bench.put([Cells("Sheet", 2, (1, 2), (2.0, 7.0)), Cells("Sheet", 1, (2,), (1.0,))])
    assert bench.values("sum", [1]).tolist() == [9.0]
    assert bench.values("product", [2]).tolist() == [12.0]
    assert engine.values("Sheet", 3, 1, 1)[0].tolist() == [70.0]  # the book itself is as it was


def test_array_formulas_on_other_cells():
    engine = engine_of({"A1": 1.0, "A2": 2.0}, {"B1:C2": "=A1:A2*{1,10}"})
    first, second = (engine.grid.sheets["Sheet"][n].runs[0] for n in (2, 3))
    bench = Bench(PinnedGrid(engine.grid), {"b": [first], "c": [second]})
    assert bench.values("c", [1, 2]).tolist() == [10.0, 20.0]
    bench.put([Cells("Sheet", 1, (1, 2), (3.0, 4.0))])
    assert bench.values("b", [1, 2]).tolist() == [3.0, 4.0]


def test_a_formula_without_its_roundings():
    engine = engine_of({"A1": 2.345, "B1": "=ROUND(A1*2,0)+INT(A1)+ROUNDUP(MAX(A1,ROUND(A1,1)),1)"})
    (run,) = engine.grid.sheets["Sheet"][2].runs
    assert Bench(PinnedGrid(engine.grid), {"b": [run]}).values("b", [1]).tolist() == [5 + 2 + 2.4]
    plain = Bench(PinnedGrid(engine.grid), {"b": [run]}, rounded=False)
    assert plain.values("b", [1])[0] == pytest.approx(4.69 + 2 + 2.345)


def test_sums_and_products_of_any_length_are_calculated():
    many = "+".join(["A1"] * 500)
    mixed = "-".join(["A1"] * 300) + "+2*" + "*".join(["A2"] * 300)
    engine = engine_of({"A1": 2.0, "A2": 1.0, "B1": f"={many}", "B2": f"=SUM({mixed},1)",
                        "B3": f"=({many})/2-({many})"})  # fmt: skip
    assert engine.values("Sheet", 2, 1, 3)[0].tolist() == [1000, 2 - 299 * 2 + 2 + 1, -500]


@pytest.mark.parametrize("text", ["OFFSET(A1,1,0)", "NOSUCH(A1)", "A1+Таблица1[Столбец]"])
def test_why_a_formula_is_not_calculated_is_said_in_russian(text):
    with pytest.raises(UnknownFormula, match=r"^(функция|ссылка на умную таблицу)"):
        engine_of({"A1": 9, "C1": f"={text}"}).shown("Sheet", 3, 1)


def test_the_manual_lists_what_is_done_for_each_function():
    text = (Path(__file__).parents[2] / "docs" / "grading.md").read_text(encoding="utf-8")
    section = text.partition("### Какие функции считаются")[2].partition("**Баллы.**")[0]
    engine, _, others = section.partition("Считает сама программа")
    program, _, person = others.partition("Смотрит человек")
    named = re.compile(r"\b[A-Z][A-Z0-9.]*[A-Z0-9]\b|\b[NT]\b")
    assert set(named.findall(engine)) == BY_ENGINE
    assert set(named.findall(program)) == BY_PROGRAM
    for name, why in BY_PERSON.items():
        assert re.search(rf"\| {why} \|[^|]*\b{name}\b", person), name
    assert not BY_ENGINE & BY_PROGRAM and not ALLOWED & BY_PERSON.keys()
    with pytest.raises(UnknownFormula, match="функция OFFSET: строит адрес ячейки"):
        engine_of({"A1": 9, "C1": "=OFFSET(A1,1,0)"}).shown("Sheet", 3, 1)
