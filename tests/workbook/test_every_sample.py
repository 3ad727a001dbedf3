"""Every sample's workbook on the coarse grid: charts, formulas, and its input read back."""

from __future__ import annotations

import io
import re
import zipfile
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

import pytest
from lxml import etree

from kshm.nomenclature.symbols import LOWER, UPPER, symbol_runs
from reports.inputs.fields import to_mapping
from reports.inputs.sections.input_file import InputFile
from reports.model.blocks import Model, ScalarTable
from reports.tables.curves import with_curves
from reports.tables.registry import build_model
from reports.workbook import cockpit, motion
from reports.workbook.caches import sheet_parts
from reports.workbook.layout import HEADER_ROW, INPUT_SHEET
from reports.workbook.read import load_workbook_input
from reports.workbook.sheets import Runs
from tests.conftest import sample_names
from tests.cover import charts, formulas, samples_with, sparse
from tests.referee.changes import Change, free_fields, with_values
from tests.workbook.lint import (
    COMPILED,
    MAIN,
    chart_problems,
    constants,
    expressions,
    formula_problems,
    has_value,
    limits,
    literals,
)
from tests.workbook.made import MOVING, coarse_book, coarse_model, drawn

LEVELS = {"subscript": LOWER, "superscript": UPPER}
ADDRESS = re.compile(r"(?<=[A-Z])\d+(?![\d(A-Za-z_.])")


@pytest.mark.parametrize("name", samples_with(charts, formulas))
def test_the_workbook_keeps_the_rules(name: str, tmp_path: Path) -> None:
    """One test for each sample: the workbook is made once."""
    model = coarse_model(name)
    book = coarse_book(name)
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        charts = [part for part in archive.namelist() if part.startswith("xl/charts/chart")]
        assert len(charts) == len(drawn(model)) + MOVING
        collected = {part: chart_problems(etree.fromstring(archive.read(part))) for part in charts}
        assert {part: problems for part, problems in collected.items() if problems} == {}
        whole = with_curves(model)
        known, indexed, shown = constants(whole) | COMPILED, symbols(whole), set()
        for title, part in sheet_parts(archive).items():
            root = etree.fromstring(archive.read(part))
            for text, runs in pieces(root):
                assert indexed.get(text, runs) == runs, (title, text)
                shown |= {text} & indexed.keys()
            cells = [f.getparent() for f in root.iter(f"{MAIN}f")]
            assert [cell.get("r") for cell in cells if not has_value(cell)] == [], title
            for cell in kinds(cells):
                formula = cell.findtext(f"{MAIN}f")
                where = (title, cell.get("r"), formula)
                assert formula_problems(cell) == [], where
                drawn_or_beside = title in (motion.SHEET, cockpit.SHEET)  # shapes, percents
                allowed = limits(model) if title == INPUT_SHEET else known
                assert drawn_or_beside or literals(formula) <= allowed, where
    assert indexed.keys() - shown == set()
    path = tmp_path / "book.xlsx"
    path.write_bytes(book)
    assert to_mapping(load_workbook_input(path).model) == to_mapping(model.input)


def symbols(model: Model) -> dict[str, Runs]:
    """Headings of tables with an index, with the levels of their letters."""
    columns = [column.quantity for table in model.tables.values() for column in table.columns]
    runs = {about.header: symbol_runs(about.tex) for about in columns if not about.word}
    unit = {about.header: f", {about.unit_label}" for about in columns if about.unit_label}
    return {
        text: (*pieces, (unit[text], "")) if text in unit else pieces
        for text, pieces in runs.items()
        if any(level for _, level in pieces)
    }


def pieces(root: etree._Element) -> Iterable[tuple[str, Runs]]:
    """Headings of a sheet's tables with the levels of their letters."""
    for item in root.iterfind(f"{MAIN}sheetData/{MAIN}row[@r='{HEADER_ROW}']/{MAIN}c/{MAIN}is"):
        runs = tuple(
            (run.findtext(f"{MAIN}t"), LEVELS.get(look.get("val"), "") if look is not None else "")
            for run in item.iter(f"{MAIN}r")
            for look in [run.find(f"{MAIN}rPr/{MAIN}vertAlign")]
        )
        text = "".join(item.itertext())
        yield text, runs or ((text, ""),)


def kinds(cells: list[etree._Element]) -> Iterable[etree._Element]:
    """One cell for each formula that differs by more than the numbers of its rows."""
    return {
        (ADDRESS.sub("", cell.findtext(f"{MAIN}f")), str(cell.find(f"{MAIN}f").attrib)): cell
        for cell in cells
    }.values()


def with_every_value_changed(data: InputFile) -> tuple[InputFile, float]:
    """The input with every free number and choice changed that may be, and their share."""
    free = free_fields(data)
    done = 0
    for field in free:
        others: list[float | str]
        if field.choices is not None:
            others = [value for value in field.choices if value != field.value]
        else:
            # A value that is bound to another one may move in one direction only.
            others = [field.value * 1.003, field.value * 0.997, field.value + 0.01]
        tried = (
            with_values(data, [Change(field, value)]) for value in others if value != field.value
        )
        measured = next((changed for changed in tried if changed is not None), None)
        if measured is not None:
            data, done = measured, done + 1
    return data, done / len(free)


@pytest.mark.parametrize("name", sparse(sample_names()))
def test_no_expression_depends_on_the_values_of_the_input(name: str) -> None:
    """A number of the input typed into a formula would change with it."""
    model = coarse_model(name)
    data, share = with_every_value_changed(model.input)
    assert share > 0.9
    assert expressions(build_model(data)) == expressions(model)


@pytest.mark.parametrize("name", samples_with(formulas))
def test_rows_of_a_list_are_told_apart_and_whole(name: str) -> None:
    for block in coarse_model(name).blocks:
        listed = isinstance(block, ScalarTable) and not block.id.endswith("_sizes")
        scalars = block.scalars if listed else ()
        looks = [(s.note or s.quantity.title, s.quantity.symbol, s.source)
                 for s in scalars if s.of not in ("check", "verdict")]  # fmt: skip
        assert [look for look, count in Counter(looks).items() if count > 1] == []
        # A long text runs over the next cells: they are free.
        worded = [s for s in scalars if s.quantity.digits.kind == "text" and s.of != "check"]
        said = {s.key: max(map(len, re.findall('"([^"]*)"', s.expr)), default=0) for s in worded}
        assert [s.key for s in worded if said[s.key] > 12 and (s.source or s.quantity.unit)] == []
