"""The short workbook: sheets of a course project, whole formulas, the same numbers."""

from __future__ import annotations

import io
from functools import lru_cache
from pathlib import Path

import pytest
from openpyxl import Workbook, load_workbook

from reports.exports.build import build, load_input
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.blocks import Model
from reports.tables.registry import build_model
from reports.workbook.conditions import conditions
from reports.workbook.course import short_model
from reports.workbook.layout import CONTENTS_SHEET, INPUT_SHEET, WAVES_SHEET, Layout
from reports.workbook.write import workbook_bytes
from tests.conftest import sample, sample_names
from tests.workbook.made import coarse_book, coarse_model, coarse_values
from tools.referees.by_formualizer import Formualizer
from tools.referees.cells import Book

RECALCULATED = ("gots-diesel", "yamz-236", "d-240-bearings")
MAX_SHEETS = 32  # open ones of the textbook's diesel


@lru_cache(maxsize=1)
def short_book(name: str) -> bytes:
    return workbook_bytes(short_model(coarse_model(name)), coarse_values(name))


@lru_cache(maxsize=1)
def opened() -> Workbook:
    return load_workbook(io.BytesIO(short_book("gots-diesel")), data_only=True)


def recalculated(name: str) -> Book:
    (book,) = Formualizer().recalculate([short_book(name)])
    return book


@pytest.mark.parametrize("name", RECALCULATED)
def test_formulas_of_a_short_book_give_the_numbers_of_the_full_one(name: str) -> None:
    short, full = short_model(coarse_model(name)), coarse_model(name)
    values, layout, actual = coarse_values(name), Layout.of(short), recalculated(name)
    errors = [(sheet, at, value) for sheet, cells in actual.items() for at, value in cells.items()
              if value is None or (isinstance(value, str) and value.startswith("#"))]  # fmt: skip
    assert errors == []
    assert len(short.scalars) < len(full.scalars)
    for key in short.scalars:
        cell = layout.cells[key]
        number = actual[cell.sheet][cell.coordinate]
        if isinstance(values.scalars[key], str):
            assert number == values.scalars[key], key
        else:
            assert number == pytest.approx(values.scalars[key], rel=1e-6, abs=1e-6), key


@pytest.mark.parametrize("name", sample_names())
def test_nothing_refers_to_what_is_left_out(name: str) -> None:
    full = build_model(sample(name))
    short = short_model(full)
    layout = Layout.of(short)
    assert {*short.left_out, *short.folded} == {*full.sheets} - visible(short)
    for chart in short.charts:
        for line in chart.drawn_by("workbook"):
            assert layout.range_of(line.x)
            assert layout.range_of(line.y)
    scalars = coarse_values(name).scalars
    ours, theirs = (
        [each.title for each in conditions(model, Layout.of(model), scalars)]
        for model in (short, full)
    )
    assert ours == theirs


def visible(model: Model) -> set[str]:
    return {*model.sheets} - model.folded


def test_sections_that_the_input_has_keep_their_sheets() -> None:
    sheets = visible(short_model(coarse_model("d-240-bearings")))
    assert {"Подшипники", "Прочность шеек", "Материал вала", "Орбиты подшипников"} <= sheets
    assert {"Крутильная схема", "Резонансы"} <= visible(short_model(coarse_model("mwm-6")))


def test_the_first_sheet_says_once_what_is_left_out_and_how_to_have_it() -> None:
    titles = opened().sheetnames
    states = [opened()[title].sheet_state for title in titles]
    assert states.count("visible") <= MAX_SHEETS
    hidden = titles[states.index("hidden") :]
    assert WAVES_SHEET in hidden
    assert {opened()[title].sheet_state for title in hidden} == {"hidden"}
    texts = [str(cell.value) for cell in opened()[CONTENTS_SHEET]["B"]]
    assert sum("[workbook] sheets" in text for text in texts) == 1
    for title in short_model(coarse_model()).left_out:
        assert sum(title in text.split("; ") for text in texts) == 1, title
    targets = [cell.hyperlink.location for sheet in opened() for row in sheet.iter_rows()
               for cell in row if cell.hyperlink]  # fmt: skip
    linked = {target.rpartition("!")[0].strip("'") for target in targets}
    assert linked <= set(titles) - set(hidden)


def test_the_full_book_is_had_by_its_key() -> None:
    raw = to_mapping(sample("gots-diesel")) | {"workbook": {"sheets": "full"}}
    model = build_model(load_mapping(raw, source="test").model)
    assert short_model(model) is model


def test_a_short_book_is_built_again_and_its_cell_gives_the_full_one(tmp_path: Path) -> None:
    path = tmp_path / "short.xlsx"
    path.write_bytes(short_book("gots-diesel"))
    again = load_input(path)
    assert to_mapping(again.model) == to_mapping(coarse_model().input)
    book = load_workbook(path)
    cell = Layout.of(short_model(coarse_model())).cells["workbook_sheets"]
    assert cell.sheet == INPUT_SHEET
    assert book[cell.sheet][cell.coordinate].value == "листы курсового проекта"
    book[cell.sheet][cell.coordinate].value = "все листы"
    book.save(path)
    build(path, load_input(path), tmp_path / "out", ("xlsx",))
    full = load_workbook(tmp_path / "out" / "short.xlsx", read_only=True)
    assert full.sheetnames == load_workbook(io.BytesIO(coarse_book()), read_only=True).sheetnames
