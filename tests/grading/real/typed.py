"""Books of the class without a program that holds them: typed into the parts of the first one.

Of two books of the class only the input data and their owner differ.  What is made here is, but
for the looks of input data, what openpyxl writes (tests/grading/test_real_class.py).
"""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Mapping
from functools import lru_cache

from reports.grading.issuing.handout import input_mark
from reports.workbook.caches import sheet_parts
from reports.workbook.cockpit import PEOPLE_ROW, people
from reports.workbook.inputs import shown
from reports.workbook.layout import CONTENTS_SHEET, Cell
from tests.grading.classroom import opened
from tests.grading.fill import Value, with_values
from tests.grading.real.desk import Desk, desk

# What the first sheet repeats of the input data.
_CONTENTS = {
    Cell(CONTENTS_SHEET, 8, 3): "regime_speed_rpm",
    Cell(CONTENTS_SHEET, 9, 3): "gas_max_pressure_mpa",
    Cell(CONTENTS_SHEET, 10, 3): "masses_reciprocating_kg",
    Cell(CONTENTS_SHEET, 11, 3): "geometry_rod_length_mm",
    Cell(CONTENTS_SHEET, 12, 3): "geometry_bore_mm",
    Cell(CONTENTS_SHEET, 13, 3): "geometry_crank_radius_mm",
}
_PROPERTIES = "docProps/custom.xml"


@lru_cache(maxsize=2)
def _parts(here: Desk) -> tuple[dict[str, bytes], dict[str, str]]:
    """Parts of a student's empty book, and where its sheets are."""
    stream = io.BytesIO()
    opened(here.assignment, here.issued.ticket).save(stream)
    with zipfile.ZipFile(stream) as source:
        places = sheet_parts(source)
        return {name: source.read(name) for name in source.namelist()}, places


def typed(here: Desk, values: Mapping[Cell, Value], first: Desk | None = None) -> bytes:
    """The book of a desk with values in its cells; ``first`` is the first of the class."""
    first = first or desk(1)
    parts, places = _parts(first)
    fields = here.assignment.model.fields
    drawn = {
        name: shown(item)
        for name, item in fields.items()
        if shown(item) != shown(first.assignment.model.fields[name])
    }
    of_inputs = {here.layout.cells[name]: value for name, value in drawn.items()}
    of_contents = {at: drawn[name] for at, name in _CONTENTS.items() if name in drawn}
    of_contents[Cell(CONTENTS_SHEET, PEOPLE_ROW, 1)] = people(here.assignment.model)
    of_part: dict[str, dict[str, Value]] = {places[CONTENTS_SHEET]: {}}
    for cell, value in {**of_inputs, **of_contents, **values}.items():
        of_part.setdefault(places[cell.sheet], {})[cell.coordinate] = value
    changed = {part: with_values(parts[part], cells) for part, cells in of_part.items()}
    changed[_PROPERTIES] = _marked(parts[_PROPERTIES], drawn)
    for part in (_PROPERTIES, places[CONTENTS_SHEET]):
        changed[part] = changed[part].replace(first.issued.ticket.encode(),
                                              here.issued.ticket.encode())  # fmt: skip
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as target:  # read at once: not worth compressing
        for name, data in parts.items():
            target.writestr(name, changed.get(name, data))
    return stream.getvalue()


def _marked(data: bytes, drawn: Mapping[str, object]) -> bytes:
    """The marks of input data as the product sets them."""
    for name, value in drawn.items():
        data = re.sub(rf"\b{name}=\w\w".encode(), f"{name}={input_mark(value)}".encode(), data)
    return data
