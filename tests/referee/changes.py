"""Random changes of a workbook's input cells, as a person at the keyboard makes them."""

from __future__ import annotations

import io
import random
import re
import zipfile
from dataclasses import dataclass

from lxml import etree

from reports.inputs.fields import Field, iter_fields, set_value, to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from reports.shared.errors import InputError
from reports.tables.registry import build_model
from reports.workbook.caches import sheet_parts
from reports.workbook.layout import Layout

# Angles that fix each other: changing one alone is refused.
_PHASES = (
    "firing_offset", "throw_angle", "force_offset", "crankshaft_bank_angle",
    "crankshaft_split_pin",
)  # fmt: skip
MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"


@dataclass(frozen=True)
class Change:
    field: Field
    value: float | str


def free_fields(data: InputFile) -> list[Field]:
    """Input cells that a person may change without changing what the workbook consists of."""
    return [
        field
        for field in iter_fields(data)
        if not field.structural
        and field.path[0] != "report"
        and (field.choices is not None or isinstance(field.value, float))
        and not field.name.startswith(_PHASES)
    ]


def with_value(data: InputFile, field: Field, value: float | str) -> InputFile | None:
    """The input with one value changed; None where ``kshm check`` refuses it."""
    raw = to_mapping(data)
    set_value(raw, field.path, value)
    try:
        return load_mapping(raw, source="changed").model
    except InputError:
        return None


def random_change(data: InputFile, rng: random.Random) -> tuple[Change, InputFile]:
    """A change of one free input cell that ``kshm check`` accepts, and the input it makes."""
    free = free_fields(data)
    while True:
        field = rng.choice(free)
        if field.choices is not None:
            value: float | str = rng.choice(list(field.choices))
        else:
            value = round(float(field.value) * rng.uniform(0.8, 1.25) + rng.choice([0, 0, 0.01]), 6)
        if value == field.value:
            continue
        changed = with_value(data, field, value)
        if changed is not None:
            return Change(field, value), changed


def type_into(book: bytes, data: InputFile, change: Change) -> bytes:
    """The workbook with the change typed into its cell; all formulas as they were.

    The cell is changed in the sheet's part: opening and saving seventeen
    thousand formulas for each of many changes would take minutes.
    """
    cell = Layout.of(build_model(data)).cells[change.field.name]
    shown = change.field.choices[change.value] if change.field.choices else change.value
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(book)) as source,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as target,
    ):
        part = sheet_parts(source)[cell.sheet]
        for name in source.namelist():
            content = source.read(name)
            if name == part:
                content = _typed(content, cell.coordinate, shown)
            target.writestr(name, content)
    return stream.getvalue()


def without_charts(book: bytes) -> bytes:
    """The same cells without drawings: LibreOffice spends a third of its time on charts."""
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(book)) as source,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as target,
    ):
        for name in source.namelist():
            content = source.read(name)
            if name.startswith(("xl/charts/", "xl/drawings/")):
                continue
            if name.startswith("xl/worksheets/"):
                content = re.sub(rb"<drawing [^>]*/>", b"", content)
                content = re.sub(rb"<Relationship [^>]*/drawing\"[^>]*/>", b"", content)
            if name == "[Content_Types].xml":
                content = re.sub(rb"<Override [^>]*/xl/(charts|drawings)/[^>]*/>", b"", content)
            target.writestr(name, content)
    return stream.getvalue()


def _typed(content: bytes, coordinate: str, shown: float | str) -> bytes:
    root = etree.fromstring(content)
    (cell,) = root.iterfind(f".//{MAIN}c[@r='{coordinate}']")
    for child in list(cell):
        cell.remove(child)
    if isinstance(shown, str):
        cell.set("t", "inlineStr")
        etree.SubElement(etree.SubElement(cell, f"{MAIN}is"), f"{MAIN}t").text = shown
    else:
        cell.set("t", "n")
        etree.SubElement(cell, f"{MAIN}v").text = repr(shown)
    return bytes(etree.tostring(root))
