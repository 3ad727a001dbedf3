"""Random changes of a workbook's input cells, as a person at the keyboard makes them."""

from __future__ import annotations

import io
import random
import re
import zipfile
from collections.abc import Sequence
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
# Abscissae that must rise, so near each other that most changes are refused.
_RISING = re.compile(r"(gas_point_\d+_deg|torsion_peak_\d+_speed_rpm)")
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
        and not _RISING.fullmatch(field.name)
    ]


def with_values(data: InputFile, changes: Sequence[Change]) -> InputFile | None:
    """The input with some values changed; None where ``kshm check`` refuses it."""
    raw = to_mapping(data)
    for change in changes:
        set_value(raw, change.field.path, change.value)
    try:
        return load_mapping(raw, source="changed").model
    except InputError:
        return None


def changed_everywhere(
    data: InputFile, rng: random.Random, spread: float
) -> tuple[list[Change], InputFile]:
    """Every free input cell changed at once, and the input that this makes.

    A formula that does not follow one of its inputs shows itself whichever input it is.
    Cells whose change ``kshm check`` refuses together with the others keep their values.
    ``spread`` is the largest share by which a number changes.
    """
    wanted = [Change(field, _other(field, rng, spread)) for field in free_fields(data)]
    taken: list[Change] = []
    parts = [wanted]
    while parts:  # halves of what is refused, so that few cells are tried alone
        part = parts.pop()
        built = with_values(data, [*taken, *part])
        if built is not None:
            taken, result = [*taken, *part], built
        elif len(part) > 1:
            parts += [part[len(part) // 2 :], part[: len(part) // 2]]
    return taken, result


def _other(field: Field, rng: random.Random, spread: float) -> float | str:
    if field.choices is not None:
        return rng.choice([choice for choice in field.choices if choice != field.value])
    value = float(field.value)
    return round(value * (1 + rng.uniform(spread / 5, spread)) + 0.01 * (value == 0), 6)


def type_into(book: bytes, data: InputFile, changes: Sequence[Change]) -> bytes:
    """The workbook with changes typed into their cells; all formulas as they were.

    The cells are changed in the sheets' parts: opening and saving seventeen thousand
    formulas would take minutes.
    """
    layout = Layout.of(build_model(data))
    of_sheet: dict[str, list[tuple[str, float | str]]] = {}
    for change in changes:
        cell = layout.cells[change.field.name]
        choices = change.field.choices
        words = choices and isinstance(change.value, str)
        shown = choices[change.value] if words else change.value
        of_sheet.setdefault(cell.sheet, []).append((cell.coordinate, shown))
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(book)) as source,
        zipfile.ZipFile(stream, "w") as target,  # read at once: not worth compressing
    ):
        parts = {part: of_sheet[title] for title, part in sheet_parts(source).items()
                 if title in of_sheet}  # fmt: skip
        for name in source.namelist():
            content = source.read(name)
            target.writestr(name, _typed(content, parts[name]) if name in parts else content)
    return stream.getvalue()


def without_charts(book: bytes) -> bytes:
    """The same cells without drawings: LibreOffice spends a third of its time on charts."""
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(book)) as source,
        zipfile.ZipFile(stream, "w") as target,  # read at once: not worth compressing
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


def _typed(content: bytes, values: Sequence[tuple[str, float | str]]) -> bytes:
    root = etree.fromstring(content)
    cells = {cell.get("r"): cell for cell in root.iter(f"{MAIN}c")}
    for coordinate, shown in values:
        cell = cells[coordinate]
        for child in list(cell):
            cell.remove(child)
        if isinstance(shown, str):
            cell.set("t", "inlineStr")
            etree.SubElement(etree.SubElement(cell, f"{MAIN}is"), f"{MAIN}t").text = shown
        else:
            cell.set("t", "n")
            etree.SubElement(cell, f"{MAIN}v").text = repr(shown)
    return bytes(etree.tostring(root))
