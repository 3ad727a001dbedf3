"""Sheets of a known form hold what a parser would find, whatever the values are."""

from __future__ import annotations

import re

import pytest

from reports.recalculation import sheets
from reports.recalculation.forms import Forms
from reports.recalculation.grid import BadBook, Grid
from reports.recalculation.read import read_grid
from reports.recalculation.sheets import read_sheet
from tests.referee.books import SHEET
from tests.referee.test_sheets import CELLS
from tests.workbook.made import coarse_book

HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'
STRINGS = ["zero", "one", ""]


def plainly(grid: Grid) -> object:
    """All that a grid holds, to be compared."""
    return [
        (title, number, list(c.constants.items()), c.errors, c.saved_rows, [*map(repr, c.saved)],
         [(r.sheet, r.first, r.count, r.text, r.formula and r.formula.pattern, r.problem)
          for r in c.runs])
        for title, columns in grid.sheets.items()
        for number, c in columns.items()
    ] + [grid.cells]  # fmt: skip


def outcome(data: bytes, forms: Forms | None, title: str = "A") -> object:
    grid = Grid(sheets={title: {}})
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
        grid = Grid(sheets={"A": {}})
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
