"""Sheets as programs write them, and those of a class that share a form."""

from __future__ import annotations

import math
import re

import pytest

from reports.recalculation import sheets
from reports.recalculation.grid import CellGrid
from reports.recalculation.read import read_grid
from reports.recalculation.sheets import Forms, read_sheet
from reports.shared.errors import BadBook
from tests.grading.forms import as_excel
from tests.referee.books import SHEET, book_of, grid_of
from tests.workbook.made import coarse_book

HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'
STRINGS = ["zero", "one", ""]


def plainly(grid: CellGrid) -> object:
    """All that a grid holds, to be compared."""
    return [
        (title, number, list(c.constants.items()), c.errors, c.saved_rows, [*map(repr, c.saved)],
         [(r.sheet, r.first, r.count, r.text, r.formula and r.formula.pattern, r.problem)
          for r in c.runs])
        for title, columns in grid.sheets.items()
        for number, c in columns.items()
    ] + [grid.cells]  # fmt: skip


def outcome(data: bytes, forms: Forms | None, title: str = "A") -> object:
    grid = CellGrid(sheets={title: {}})
    try:
        read_sheet(grid, title, data, STRINGS, forms)
    except BadBook as error:
        return str(error)
    return plainly(grid)


def sheet(cells: str, head: str = HEAD) -> bytes:
    return (head + SHEET.format(cells)).encode()


def test_a_sheet_of_a_known_form_is_filled_in_without_being_parsed(monkeypatch):
    forms = Forms()
    other = re.sub("<v>([0-9.]+)</v>", lambda m: f"<v>{int(m[1] == '0' or '1' in m[1])}</v>", CELLS)
    other = other.replace("#N/A", "#REF!").replace("<v>x</v>", "<v>y</v>")
    wanted = outcome(sheet(other), None)
    assert wanted != outcome(sheet(CELLS), forms) == outcome(sheet(CELLS), forms)
    monkeypatch.setattr(sheets, "_parsed", None)
    assert outcome(sheet(other), forms) == wanted


def test_sheets_that_differ_in_looks_alone_are_of_one_form(monkeypatch):
    """Style numbers and heights of rows are each program's own."""
    forms = Forms()
    cells = '<c r="A1" s="{0}"><v>1</v></c><c r="B1" s="{0}" t="s"><v>1</v></c>'
    wide = sheet(cells.format(12)).replace(b'<row r="1"', b'<row r="1" ht="15.75" spans="1:2"')
    assert wide != sheet(cells.format(12))
    outcome(sheet(cells.format(7)), forms)
    wanted = outcome(wide, forms)
    monkeypatch.setattr(sheets, "_parsed", None)
    assert outcome(sheet(cells.format(345)), forms) == wanted


def test_forms_used_last_are_kept(monkeypatch):
    forms, often = Forms(), sheet('<c r="A1"><v>1</v></c>')
    monkeypatch.setattr(sheets, "_MAX_FORMS", 3)
    outcome(often, forms), outcome(often, forms)
    for column in "BCDEFG":
        outcome(sheet(f'<c r="{column}1"><v>1</v></c>'), forms)
        assert outcome(often, forms)
    monkeypatch.setattr(sheets, "_parsed", None)
    assert outcome(often, forms)


def test_whole_books_read_by_their_forms_are_the_same(monkeypatch):
    forms = Forms()
    books = [coarse_book("gots-diesel"), coarse_book("cycle-petrol")]
    for book in (*books, *books):
        assert plainly(read_grid(book, forms)) == plainly(read_grid(book))
    parse, parsed = sheets._parsed, []

    def told(grid, title, *rest):
        parsed.append((grid, title))
        return parse(grid, title, *rest)

    monkeypatch.setattr(sheets, "_parsed", told)
    assert all(read_grid(book, forms).cells > 1000 for book in books)
    assert parsed == []  # no sheet of ours has an array formula, which is parsed each time


def test_what_a_reader_does_to_a_grid_does_not_change_the_form():
    forms, cells = Forms(), '<c r="A1"><f>1+1</f><v>2</v></c><c r="B1"><v>3</v></c>'
    wanted = outcome(sheet(cells), forms)
    assert outcome(sheet(cells), forms) == wanted
    for _ in range(2):
        grid = CellGrid(sheets={"A": {}})
        read_sheet(grid, "A", sheet(cells), STRINGS, forms)
        assert plainly(grid) == wanted
        grid.sheets["A"][1].runs[0].count = 7
        grid.sheets["A"][1].saved.append(1.0)
        grid.sheets["A"][1].saved_rows.append(9)
        grid.sheets["A"][2].constants.clear()
        del grid.sheets["A"][1].runs[:]


def test_sheets_of_one_text_under_two_titles_are_kept_apart():
    forms, data = Forms(), sheet('<c r="A1"><f>B1</f><v>1</v></c><c r="B1"><v>1</v></c>')
    for title in ("A", "B") * 3:
        assert outcome(data, forms, title) == outcome(data, None, title)


ODD = [
    "nan", "1e999", "-inf", "1_0", " 1", "1 ", "one", "0x10", "&#49;", "1&amp;2", "99", "-1", "2",
    "-1e308", "\u0661",
]  # fmt: skip


@pytest.mark.parametrize("value", ODD)
@pytest.mark.parametrize("at", ['<c r="A1"><v>{}</v></c>', '<c r="A1" t="s"><v>{}</v></c>',
                                '<c r="A1" t="str"><v>{}</v></c>', '<c r="A1" t="e"><v>{}</v></c>',
                                '<c r="A1"><f>B1</f><v>{}</v></c>'])  # fmt: skip
def test_odd_values_are_judged_as_the_parser_judges_them(value, at):
    forms = Forms()
    for _ in range(2):
        outcome(sheet(at.format(1)), forms)
    assert outcome(sheet(at.format(value)), forms) == outcome(sheet(at.format(value)), None)


# Values in other places than a plain <v>: the form must not be known, or be known rightly.
HIDDEN = [
    '<!-- <v>{}</v> --><c r="A1"><v>{}</v></c>',
    '<!-- <v>{}</v> --><c r="A1"><v xml:space="preserve">{}</v></c>',
    '<c r="A1"><v>{}</v><v>{}</v></c>',
    '<c r="A1"><v>{}</v></c><c r="A1"><v>{}</v></c>',
    '<c r="A1"><f>1</f><v>{}</v></c><c r="A1"><v>{}</v></c>',
    '<c r="A1"><v><![CDATA[{}]]></v></c><c r="B1"><f><![CDATA[<v>{}</v>]]></f></c>',
    '<c r="A1"><f t="array" ref="A1:B1">{{1,2}}</f><v>{}</v></c><c r="B1"><v>{}</v></c>',
    '<c r="A1"><v>{}</v><f>C1</f></c><c r="B1"><v>{}</v></c>',
    '<c r="A1" t="inlineStr"><v>{}</v><is><t>a</t></is></c><c r="B1"><v>{}</v></c>',
    '<c r="A1" t="s"><v>{}</v></c><c r="B1" t="s"><v>{}</v></c>',
]


@pytest.mark.parametrize("cells", HIDDEN)
@pytest.mark.parametrize("head", [HEAD, "", HEAD.replace("UTF-8", "cp1251")])
def test_values_in_odd_places_are_never_taken_for_others(cells, head):
    forms = Forms()
    for values in (("0", "0"), ("1", "1"), ("1", "2"), ("2", "1"), ("1", "0")):
        data = sheet(cells.format(*values), head)
        assert outcome(data, forms) == outcome(data, None)


def test_a_book_as_excel_writes_it_is_the_same_book():
    own = coarse_book("gots-diesel")
    grids = read_grid(own), read_grid(as_excel(own))
    runs = 0
    for title, columns in grids[0].sheets.items():
        for number, column in columns.items():
            other = grids[1].sheets[title][number]
            assert column.constants == other.constants
            pairs = zip(column.runs, other.runs, strict=True)
            for run, like in pairs:
                assert (run.first, run.count, run.formula) == (like.first, like.count, like.formula)
                runs += 1
    assert runs > 200


CELLS = (
    '<c r="A1"><v>1.5</v></c><c r="B1" t="s"><v>1</v></c><c r="C1" t="b"><v>1</v></c>'
    '<c r="D1" t="e"><v>#N/A</v></c>'
    '<c r="E1" t="inlineStr"><is><r><t>in</t></r><r><t>line</t></r></is></c>'
    '<c r="F1" t="str"><f>"x"</f><v>x</v></c>'
    '<c r="G1"><f>1+1</f><v>2</v></c><c r="H1" s="3"/><c><v>9</v></c>'
)


def test_kinds_of_cells():
    grid = grid_of(CELLS, ["zero", "one"])
    constants = {number: column.constants.get(1) for number, column in grid.sheets["A"].items()}
    assert constants == {1: 1.5, 2: "one", 3: True, 4: None, 5: "inline", 6: None, 7: None,
                         9: 9.0}  # fmt: skip
    assert grid.sheets["A"][4].errors == {1: "#N/A"}
    (text,), (number,) = grid.sheets["A"][6].runs, grid.sheets["A"][7].runs
    assert math.isnan(grid.sheets["A"][6].saved_of(text)[0])
    assert grid.sheets["A"][7].saved_of(number).tolist() == [2.0]


def test_values_saved_in_an_array_formula_are_not_typed_in():
    cells = (
        '<c r="B1"><f t="array" ref="B1:C1">A1:A1*{1,2}</f><v>7</v></c><c r="C1"><v>14</v></c>'
        '<c r="D1"><v>5</v></c>'
    )
    grid = grid_of(cells)
    assert grid.sheets["A"][3].constants == {}
    (run,) = grid.sheets["A"][3].runs
    assert grid.sheets["A"][3].saved_of(run).tolist() == [14.0]
    assert grid.sheets["A"][4].constants == {1: 5.0}
    with pytest.raises(BadBook, match="неверными границами"):
        grid_of('<c r="B1"><f t="array" ref="A1:XFD1048576">1</f></c>')
    over = grid_of('<c r="B1"><f t="array" ref="B1:C1">1</f></c><c r="C1"><f>2</f></c>')
    assert over.sheets["A"][2].runs[0].problem


@pytest.mark.parametrize(
    "value", ["nan", "1e999", "-inf", "one", "1,5", " ", "1 2", "0x10", "1_0", "\xa0"]
)
def test_a_value_that_is_no_number_is_refused(value):
    with pytest.raises(BadBook, match="неверным значением"):
        grid_of(f'<c r="A1"><v>2</v></c><c r="B1"><v>{value}</v></c>')


@pytest.mark.parametrize(
    "cell", ['<c r="A20001"><v>1</v></c>', '<c r="ALM1"><v>1</v></c>', '<c r="A0"><v>1</v></c>']
)
def test_cells_far_out_are_refused(cell):
    with pytest.raises(BadBook, match="далеко за таблицами"):
        grid_of(cell)


def test_names_of_cells_and_of_rectangles():
    import io

    from openpyxl import load_workbook
    from openpyxl.workbook.defined_name import DefinedName

    book = load_workbook(io.BytesIO(book_of({"A1": 1.0})))
    for name, text in (("Один", "Sheet!$A$1"), ("Много", "'Sheet'!$A$1:$B$3"), ("Сила", "1+1")):
        book.defined_names[name] = DefinedName(name, attr_text=text)
    stream = io.BytesIO()
    book.save(stream)
    grid = read_grid(stream.getvalue())
    assert grid.names == {"один": ("Sheet", 1, 1)}
    assert grid.named("много").last_row == 3
    assert grid.named("сила") is None
