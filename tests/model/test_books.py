"""Books: examples of their page, mistakes told with line and column, every book of the house."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from reports.inputs.load import load_toml
from reports.model.blocks import Grid, ScalarTable, TableSpec
from reports.model.chapter_reader import read_book
from reports.model.chapter_source import BookLine, Shelf, book_faults, house_shelf
from reports.model.contents import contents_of
from reports.model.context import names_of
from reports.model.shape import Part, Scope
from reports.shared.errors import BookError
from reports.shared.resources import samples_dir
from reports.tables.contexts import book_part
from reports.tables.registry import build_model
from reports.workbook.chapters import place_of
from tests.conftest import sample, sample_names
from tests.layouts import MAKERS, layout_input

PAGE = Path(__file__).parents[2] / "docs" / "books.md"
EXAMPLES = re.findall(r"```book\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)


def scope_of(sample: str = "gots-diesel") -> Scope:
    return Scope(load_toml(samples_dir() / f"{sample}.toml").model)


def read(text: str, folder: Path, scope: Scope | None = None, **lines: dict[str, BookLine]) -> Part:
    (folder / "own.book").write_text(text, encoding="utf-8")
    return read_book(
        "own.book", names_of(scope or scope_of()), Shelf((folder, *house_shelf().folders)), **lines
    )


@pytest.mark.parametrize("number", range(len(EXAMPLES)))
def test_an_example_of_the_page_is_read(number: int, tmp_path: Path):
    part = read(EXAMPLES[number], tmp_path)
    assert part.blocks or part.charts


def test_the_page_has_every_kind_of_block():
    parts = "\n".join(EXAMPLES)
    for word in ("list", "table", "grid", "allowed", "chart", "extremes", "check", "member"):
        assert re.search(rf"^{word} ", parts, re.MULTILINE), word


def test_blocks(tmp_path: Path):
    part = read(
        "sheet Свой\nlist a: Список\nr_crank = 1 | задано\nnote Первое\n    и дальше.\n"
        "table b Т over 0…20 by 10: Таблица\nphi_deg\nhelper beta_rad = 2*r_crank | -\n"
        "grid c: Сетка\nmember 1\nx1 of cyl_x = 1 | -\nmember 2\nx2 of cyl_x = 2 | -\n"
        "y2 of cyl_y = 3 | -\nlast cyl_x\n",
        tmp_path,
    )
    table = next(block for block in part.blocks if isinstance(block, TableSpec))
    grid = next(block for block in part.blocks if isinstance(block, Grid))
    scalars = next(block for block in part.blocks if isinstance(block, ScalarTable))
    assert scalars.note == "Первое и дальше."
    assert table.rows == (0, 10, 20) and table.step == 10
    assert table.columns[1].helper and table.columns[1].source == ""
    assert [row.of for row in grid.rows] == ["cyl_y", "cyl_x"]
    assert grid.rows[0].cells[0] is None


HEAD = "sheet Свой\nlist a: Список\n"
MISTAKES = {
    "unknown quantity": (HEAD + "r_crankk = 1 | -\n", 3, 1, "r_crankk"),
    "unknown quantity of a key": (HEAD + "lam = 1 | -\nk of nobody = 1 | -\n", 4, 6, "nobody"),
    "unknown function": (HEAD + "r_crank = sinus(1) | -\n", 3, 11, "sinus"),
    "broken formula": (HEAD + "r_crank = 1 + | -\n", 3, 11, "1 +"),
    "call of Python": (HEAD + "r_crank = __import__('os') | -\n", 3, 11, "__import__"),
    "attribute of attribute": (HEAD + "r_crank = a.b.c | -\n", 3, 11, "a.b.c"),
    "no source": (HEAD + "r_crank = 1\n", 3, 1, "источника"),
    "no formula": (HEAD + "r_crank\n", 3, 1, "не разобрана"),
    "a sentence": (HEAD + "Радиус кривошипа\n", 3, 1, "не разобрана"),
    "outside a block": ("sheet Свой\nr_crank = 1 | -\n", 2, 1, "вне блока"),
    "list without title": ("sheet Свой\nlist a\n", 2, 1, "list ИМЯ"),
    "table without rows": ("sheet Свой\ntable a Т: Таблица\n", 2, 1, "table ИМЯ"),
    "grid before member": ("sheet Свой\ngrid a: С\nx of cyl_x = 1 | -\n", 3, 1, "member"),
    "unit of another": (HEAD + "s_kN of s_mm = 1 | -\n", 3, 1, "единица"),
    "unknown word of a chart": ("sheet С\nchart a over phi_deg: Д\nz 1\n", 3, 1, "«z»"),
    "curve of three": ("sheet С\nchart a: Д\ncurve a.b c.d e.f\n", 3, 1, "curve"),
    "check without a test": (HEAD + "check a = lam\n", 3, 1, "check ИМЯ"),
    "extremes without a name": (HEAD + "extremes a.b\n", 3, 1, "extremes"),
    "if without end": (HEAD + "% if engine.offset\nr_crank = 1 | -\n", 3, 1, "% endif"),
    "unknown name of a condition": (HEAD + "% if motor.offset\n% endif\n", 3, 1, "motor"),
    "unknown key of the input": (HEAD + "\n% if given.gas.bohrung\n% endif\n", 4, 1, "bohrung"),
    "number divided by nothing": (HEAD + "lam = {{ 1/0 }} | -\n", 3, 1, "Jinja2"),
    "in what goes on": (HEAD + "r_crank = 1 +\n    foo(2) +\n    3 | -\n", 4, 5, "foo"),
}  # fmt: skip


@pytest.mark.parametrize("case", MISTAKES)
def test_a_mistake_is_told_where_it_stands(case: str, tmp_path: Path):
    text, line, column, words = MISTAKES[case]
    with pytest.raises(BookError) as raised:
        read(text, tmp_path)
    assert words in str(raised.value)
    assert "\n" not in str(raised.value)
    assert str(raised.value).startswith(f"own.book: строка {line}, столбец {column}: ")


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        (HEAD + "lam = 1 | -\nr_crank = of_mm(geometry_strok) | -\n", 4, 17, "geometry_strok"),
        (HEAD + "lam = 2*r_crank | -\nr_crank = lam/2 | -\n", 3, 1, "через себя"),
        ("sheet С\ntable t Т over turn: Т\nphi_deg\ns_mm = 2*s1_m | -\n", 4, 10, "s1_m"),
    ],
)  # fmt: skip
def test_what_only_the_model_shows(text: str, line: int, column: int, words: str, tmp_path: Path):
    places: dict[str, BookLine] = {}
    scope = scope_of()
    part = read(text, tmp_path, scope, lines=places)
    model = build_model(scope.input)
    kept = [b for b in model.blocks if b.id not in ("geometry", "t", "a")]
    whole = type(model)(model.input, model.inputs, (*kept, *part.blocks), ())
    message = str(next(iter(book_faults(whole, places, Shelf((tmp_path,))))))
    assert words in message and message.startswith(f"own.book: строка {line}, столбец {column}: ")


def test_numbers_are_short_and_macros_stand_on_one_line(tmp_path: Path):
    text = (
        HEAD + "% macro half(x)\n{{ x }}\n/2\n% endmacro\nlam = {{ half(3.0) }} + {{ 0.25 }} | -\n"
    )
    (block,) = read(text, tmp_path).blocks
    assert isinstance(block, ScalarTable) and block.scalars[0].expr == "3 /2 + 0.25"


@pytest.mark.parametrize("name", sample_names())
def test_books_of_the_house_name_what_there_is(name: str):
    """No formula of a sample names what the model has not, none needs itself."""
    scope, places = Scope(sample(name)), {}
    model = build_model(scope.input)
    for part in contents_of().parts.values():
        for book in part:
            book_part(book, scope, places)
    assert len(places) > 100
    assert [str(fault) for fault in book_faults(model, places, house_shelf())] == []


def test_every_sheet_of_every_layout_has_its_place():
    for name in (*sample_names(), *MAKERS):
        model = build_model(sample(name) if name in sample_names() else layout_input(name))
        assert all(place_of(sheet) for sheet in model.sheets)
    with pytest.raises(LookupError):
        place_of("Ничей лист")
