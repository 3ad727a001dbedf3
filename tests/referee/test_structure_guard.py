"""A structural cell that is changed is said at once, and its results are grey until it is set back.

The formulas were built for one structure: those of another number of cylinders or step are a lie.
"""

from __future__ import annotations

import json
import subprocess
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import pytest

from reports.commands.new_engine import new_text
from reports.inputs.fields import Field, iter_fields
from reports.inputs.load import load_text
from reports.inputs.sections.input_file import InputFile
from reports.model.blocks import Model
from reports.tables.registry import build_model
from reports.workbook.cockpit import VERDICT_ROW
from reports.workbook.inputs import shown
from reports.workbook.layout import (
    CONTENTS_SHEET,
    INPUT_SHEET,
    NOTE_ROW,
    VALUE_COLUMN,
    Cell,
    Layout,
)
from reports.workbook.read import load_workbook_input
from reports.workbook.verdict import RESHAPED
from reports.workbook.write import workbook_bytes
from tests.conftest import sample
from tests.cover import ALL
from tests.referee.changes import Change, type_into, without_charts
from tests.referee.test_other_programs import gnumeric  # noqa: F401 - the fixture
from tools.referees.by_gnumeric import Gnumeric
from tools.referees.cells import cached_values

NEW = "new V6"
BOOKS = ("two-stroke", NEW, *(("yamz-238", "gots-diesel", "d-240-bearings") if ALL else ()))
CELLS = (
    "calculation_step_deg", "engine_cylinders", "engine_strokes", "engine_layout", "gas_source",
    "calculation_wear_rays",
)  # fmt: skip
_MARK = Cell(INPUT_SHEET, NOTE_ROW, VALUE_COLUMN).coordinate
_VERDICT = f"A{VERDICT_ROW}"
_GREY = 'BGCOLOR="#EDEDED"'


@lru_cache(maxsize=1)
def data_of(name: str) -> InputFile:
    if name != NEW:
        return sample(name)
    text = new_text(None, sample=None, cylinders=6, layout="v")
    return load_text(text, source=name).model


@lru_cache(maxsize=1)
def made(name: str) -> tuple[Model, bytes]:
    model = build_model(data_of(name))
    return model, without_charts(workbook_bytes(model))


def other(item: Field) -> int | str:
    """Another value that the cell allows, by its key."""
    key = next(key for key in item.choices or {} if key != str(item.value))
    return int(key) if isinstance(item.value, int) else key


def changed(item: Field) -> Field:
    return replace(item, value=other(item))


def edits(name: str) -> list[Field]:
    fields = {item.name: item for item in iter_fields(data_of(name))}
    assert all(fields[key].structural for key in CELLS)
    return [fields[key] for key in CELLS]


def in_libreoffice(folder: Path, name: str) -> tuple[list[list[str]], str]:
    """The verdict and the mark of the inputs, before and after each edit, and a page of all."""
    model, data = made(name)
    source, page, layout = folder / "book.xlsx", folder / "page.html", Layout.of(model)
    source.write_bytes(data)
    typed = [(INPUT_SHEET, layout.cells[item.name].coordinate, shown(changed(item)), shown(item))
             for item in edits(name)]  # fmt: skip
    cells = [(CONTENTS_SHEET, _VERDICT), (INPUT_SHEET, _MARK)]
    script = Path(__file__).with_name("structure.py")
    done = subprocess.run(
        ["/usr/bin/python3", str(script), str(folder / "profile")],
        input=json.dumps([(str(source), typed, cells, str(page))]),
        capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout)[0], page.read_text(errors="replace")


@pytest.mark.usefixtures("libreoffice")
@pytest.mark.libreoffice
@pytest.mark.parametrize("name", BOOKS)
def test_a_changed_structure_is_said_and_taken_back_in_libreoffice(
    name: str, tmp_path: Path
) -> None:
    (before, *actual), page = in_libreoffice(tmp_path, name)
    assert before[1] == before[0] != RESHAPED
    for item, after, restored in zip(edits(name), actual[::2], actual[1::2], strict=True):
        assert after == [RESHAPED, RESHAPED], item.name
        assert restored == before, item.name
    results = len(cached_values(made(name)[1]))
    assert page.upper().count(_GREY) > 100 * results


@pytest.mark.parametrize("name", BOOKS)
def test_a_changed_structure_is_said_in_gnumeric(name: str, gnumeric: Gnumeric) -> None:  # noqa: F811
    _, data = made(name)
    at, step = _VERDICT, edits(name)[0]
    for item in edits(name) if ALL else edits(name)[:2]:
        typed = type_into(data, data_of(name), [Change(item, other(item))])
        (actual,) = gnumeric.recalculate([typed])
        assert (actual[CONTENTS_SHEET][at], actual[INPUT_SHEET][_MARK]) == (RESHAPED, RESHAPED)
    back = type_into(data, data_of(name), [Change(step, step.value)])
    (restored,) = gnumeric.recalculate([back])
    assert restored[CONTENTS_SHEET][at] == cached_values(data)[CONTENTS_SHEET][at]


def test_a_changed_structure_is_built(tmp_path: Path) -> None:
    """Reading the edited book back takes the structure; the book built of it holds."""
    name = "gots-diesel"
    fields = {item.name: item for item in iter_fields(data_of(name))}
    path = tmp_path / "edited.xlsx"
    typed = [Change(fields["calculation_step_deg"], 15)]
    path.write_bytes(type_into(made(name)[1], data_of(name), typed))
    model = load_workbook_input(path).model
    assert model.calculation.step_deg == 15
    text = cached_values(workbook_bytes(build_model(model)))[CONTENTS_SHEET][_VERDICT]
    assert text != RESHAPED
