"""What the conditions of a book ask of the input, and what books take from each other."""

from __future__ import annotations

import pytest

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.blocks import ScalarTable
from reports.model.chapter_reader import read_book
from reports.model.chapter_source import Shelf
from reports.model.context import names_of
from reports.model.shape import Scope
from reports.shared.errors import BookError
from tests.conftest import sample


def keys(folder, text: str, model, **further: str) -> list[str]:
    """Keys of the first list of a book."""
    for name, lines in {"own": text, **further}.items():
        (folder / f"{name}.book").write_text(lines, encoding="utf-8")
    block = read_book("own.book", names_of(Scope(model)), Shelf((folder,))).blocks[0]
    assert isinstance(block, ScalarTable)
    return [scalar.key for scalar in block.scalars]


def test_a_list_of_sections_is_asked_section_by_section(tmp_path):
    raw = to_mapping(sample("gots-diesel"))
    web = raw["crankshaft"]["webs"]
    for each in web:
        each["actual_mass_kg"], each["centre_mm"] = each.pop("mass_kg"), 40.0
    text = """sheet Массы
list web_masses: Приведение щёк
% for web in given.crankshaft.webs
% if web.actual_mass_kg and not web.mass_kg
web_red{{ loop.index }} = 1 | -
% endif
% endfor
"""
    model = load_mapping(raw, source="f").model
    assert keys(tmp_path, text, model) == [f"web_red{i + 1}" for i in range(len(web))]


def test_a_key_of_another_kind_of_section_is_not_given(tmp_path):
    text = """sheet Массы
list geometry: Размеры
% if given.geometry.bore_mm
r_crank = 1 | -
% else
L_rod = 1 | -
% endif
"""
    assert keys(tmp_path, text, sample("gots-diesel")) == ["r_crank"]
    assert keys(tmp_path, text, sample("cycle-petrol")) == ["L_rod"]
    other = tmp_path / "other"  # books are read once
    other.mkdir()
    with pytest.raises(BookError, match="bore_cm"):
        keys(other, text.replace("bore_mm", "bore_cm"), sample("cycle-petrol"))


def test_lines_of_another_book_end_where_it_ends(tmp_path):
    text = """sheet Массы
list geometry: Размеры
% include "further.book"
S_stroke = 2*r_crank | -
"""
    further = "r_crank = 1 | -\nlam = 1/4 | -\n"
    built = keys(tmp_path, text, sample("gots-diesel"), further=further)
    assert built == ["r_crank", "lam", "S_stroke"]
