"""Finished workbooks of samples, each made once for all tests of a process."""

from __future__ import annotations

import io
import zipfile
from functools import lru_cache

import openpyxl
from openpyxl.workbook import Workbook

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from reports.model.blocks import Model
from reports.model.charts import ChartSpec
from reports.model.evaluation import Values, evaluate_model
from reports.tables.registry import build_model
from reports.workbook.charts import is_blank
from reports.workbook.cockpit import BESIDE, CHARTS
from reports.workbook.layout import Layout
from reports.workbook.write import workbook_bytes
from tests.conftest import sample
from tests.kept import kept


@lru_cache(maxsize=4)
def model(name: str = "gots-diesel") -> Model:
    return build_model(sample(name))


@kept
def book(name: str) -> bytes:
    return workbook_bytes(model(name))


@lru_cache(maxsize=4)
def coarse_model(name: str = "gots-diesel") -> Model:
    """The same sheets, names and formulas in fewer rows."""
    return build_model(coarse(name))


def coarse(name: str) -> InputFile:
    """A sample on the coarse grid."""
    raw = to_mapping(sample(name))
    raw["calculation"]["step_deg"] = 30
    return load_mapping(raw, source=name).model


@lru_cache(maxsize=4)
def coarse_values(name: str = "gots-diesel") -> Values:
    return evaluate_model(coarse_model(name))


@kept
def coarse_book(name: str) -> bytes:
    return workbook_bytes(coarse_model(name), coarse_values(name))


@lru_cache(maxsize=2)
def coarse_opened(name: str = "gots-diesel") -> Workbook:
    """The same as openpyxl reads it, with values; not to be changed."""
    return openpyxl.load_workbook(io.BytesIO(coarse_book(name)), data_only=True)


def drawn(model: Model) -> list[ChartSpec]:
    """All charts of a workbook: the first two sheets', then those of tables that are not zero."""
    first = [model.charts_by_id[n] for n in (*CHARTS, *BESIDE) if n in model.charts_by_id]
    layout, values = Layout.of(model), evaluate_model(model)
    return first + [s for s in model.charts if s.sheet and not is_blank(s, layout, values)]


MOVING = 6  # charts of the mechanism's sheet, half of them with one scale on both axes


def parts(prefix: str, name: str = "gots-diesel", *, coarse: bool = False) -> dict[str, bytes]:
    data = coarse_book(name) if coarse else book(name)
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {part: archive.read(part) for part in archive.namelist() if part.startswith(prefix)}
