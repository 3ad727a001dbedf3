"""Fields of a validated input, the names of their cells, and cells read back.

Naming (the workbook's formulas use these names).  `path` holds TOML keys and
0-based list indices, `name` 1-based numbers:

====================================  ==========================================
path                                  name
====================================  ==========================================
(section, key)                        ``<section>_<key>``: ``geometry_bore_mm``,
                                      ``geometry_lambda``, ``regime_speed_rpm``,
                                      ``crankshaft_pin_mass_kg``
crankshaft.firing_offsets_deg, i      ``firing_offset_<i+1>_deg``
crankshaft.throw_angles_deg, i        ``throw_angle_<i+1>_deg``
crankshaft.force_offsets_deg, i       ``force_offset_<i+1>_deg``
crankshaft.main_lengths_mm, i         ``main_length_<i+1>_mm``, and so the other sizes
crankshaft.webs, i, key               ``web_<i+1>_<key>``: ``web_3_mass_kg``
crankshaft.arms, i, key               ``throw_<i+1>_<key>``: ``throw_1_l1_mm``,
                                      ``throw_1_left_web_mm``
gas.points, i, 0 and 1                ``gas_point_<i+1>_deg``, ``gas_point_<i+1>_mpa``
own, section, key                     ``<section>_<key>``, of a book of a department
====================================  ==========================================

Every name is Latin, holds an underscore (so it is neither a cell address nor
an R1C1 token) and is unique without regard to case.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from pydantic import BaseModel

from kshm.nomenclature.quantity import smallness
from reports.inputs.department_chapters import sections_of
from reports.inputs.meta import Key, Meta, StrictModel, hints
from reports.inputs.registry import SECTIONS, records
from reports.inputs.sections.input_file import InputFile, RegimeSection, RegimeValues

Path = tuple[str | int, ...]
Value = str | int | float

# A zero of these is none: another value changes what the workbook consists of.
_NONE_AT_ZERO = ("crank_offset_mm", "pin_offset_mm", "ground_nm_rad", "stiffness_nm_rad")
POINT_KEYS = ("deg", "mpa")
_PHRASES = (
    ("обязательный ключ не задан", "ячейка не заполнена"),
    ("удалите ключ: он для", "очистите ячейку: она для"),
    ("удалите ключ", "очистите ячейку"),
    ("уберите лишний ключ", "очистите лишнюю ячейку"),
    ("уберите ключ", "очистите ячейку"),
    ("оставьте один из двух ключей", "оставьте одну из двух ячеек"),
    ("оставьте один ключ", "оставьте одну ячейку"),
    ("добавьте недостающий ключ", "заполните недостающую ячейку"),
    ("такой ключ есть", "такая ячейка есть"),
    ("неизвестный ключ", "неизвестная ячейка"),
    ("лишний ключ", "лишнее значение"),
    ("ключ нужен", "ячейка нужна"),
    ("удалите раздел", "уберите эти данные в файле .toml"),
    ("напишите одно число", "сделайте ячейку числом"),
)
_CHOICE = re.compile(r'\b(?:\w+\.)?(?P<key>\w+) = "?(?P<value>\w+)"?(?: или "(?P<other>\w+)")?')
_SECTION = re.compile(r"(?:(?P<add>добавьте )|нужен )?раздел \[(?P<name>\w+)\]|\[(?P<bare>\w+)\]")
_KEY = re.compile(r"\b(?:[a-z]+\.)?(?P<key>lambda|strokes|layout|source|[a-z0-9]+(?:_[a-z0-9]+)+)"
                  r"(?:\[(?P<n>\d+)\])?")  # fmt: skip


@dataclass(frozen=True, slots=True)
class Field:
    """One input value.

    Attributes:
        path: Keys and 0-based indices, as `load_mapping` finds the value.
        name: The defined name of its cell.
        section: Russian title of its group.
        title: Russian title.
        symbol: Symbol; a subscript follows the underscore.
        unit: Russian unit label, empty for a pure number.
        value: The value in user units.
        minimum: Smallest allowed value, if it is a number.
        maximum: Largest allowed value, if it is a number.
        choices: Allowed values (as text) and their Russian labels, or None.
        structural: A change of the value changes the shape of the workbook.
        optional: The key may be left out of the file.
    """

    path: Path
    name: str
    section: str
    title: str
    symbol: str
    unit: str
    value: Value
    minimum: float | None
    maximum: float | None
    choices: dict[str, str] | None
    structural: bool
    optional: bool

    @property
    def listed(self) -> bool:
        """Whether the value is one of a list of records, shown as a table."""
        return len(self.path) >= 4 and isinstance(self.path[-2], int)


def cell_name(path: Path) -> str:
    """Return the defined name that belongs to a path (see the module's table)."""
    if len(path) == 2:
        return f"{path[0]}_{path[1]}"
    if path[0] == "own":
        return f"{path[1]}_{path[2]}"
    key = path[3] if len(path) > 3 else ""
    if path[1] == "points":
        key = POINT_KEYS[int(path[3])]
    return SECTIONS[str(path[0])].lists[str(path[1])].cells.format(n=int(path[2]) + 1, key=key)


def key_text(path: Path) -> str:
    """Return the path as messages show it: ``crankshaft.webs[3].mass_kg``, lists from 1."""
    text = ""
    for part in path:
        text += f"[{part + 1}]" if isinstance(part, int) else f".{part}" if text else part
    return text


def iter_fields(model: InputFile) -> Iterator[Field]:
    """Yield the fields that are given or defaulted, in the order of the file."""
    for section in SECTIONS.values():
        part: BaseModel | None = getattr(model, section.name)
        if part is None:
            continue
        yield from _fields_of(part, (section.name,), section.title, number=None)
    for name, spec in sections_of(model.books).items():
        yield from _fields_of(getattr(model.own, name), ("own", name), spec.title, number=None)
    for index, regime in enumerate(model.regimes):
        yield from _regime_fields(regime, index)


def structure(model: InputFile) -> tuple[tuple[str, Value | None], ...]:
    """Return what determines the shape of the workbook.

    Two inputs of equal structure have the same cells: the same names in the
    same order, and the same values of the structural fields.
    """
    return tuple(
        (field.name, field.value if field.structural else None) for field in iter_fields(model)
    )


def tables_shape(fields: Iterable[Field]) -> tuple[tuple[str, Value | None], ...]:
    """Return what determines the tables of an input: everything but plain numbers."""
    return tuple((field.name, _shape(field)) for field in fields)


def _shape(field: Field) -> Value | None:
    if field.path == ("geometry", "bore_mm") and isinstance(field.value, float):
        return smallness(field.value / 1000)  # decides the decimals
    return field.value if _shapes(field) else None


def _shapes(field: Field) -> bool:
    text = isinstance(field.value, str) and field.path[0] not in ("report", "prototype")
    phase = field.path[0] == "crankshaft" and field.name.endswith("_deg")  # tables shift by them
    return field.structural or text or phase


def to_mapping(model: InputFile) -> dict[str, Any]:
    """Return the nested mapping `load_mapping` reads back to an equal model."""
    return model.model_dump(by_alias=True, exclude_none=True, mode="json")


def set_value(raw: dict[str, Any], path: Path, value: object) -> None:
    """Put a value into a nested mapping of `to_mapping` at `path`."""
    target: Any = raw
    for part in path[:-1]:
        target = target[part]
    target[path[-1]] = value


def _fields_of(part: BaseModel, path: Path, section: str, number: int | None) -> Iterator[Field]:
    for key, spec in hints(type(part)).items():
        value = getattr(part, spec.name)
        if value is None:
            continue
        here = (*path, key)
        if isinstance(value, tuple):
            list_section = SECTIONS[str(path[0])].lists[key].title
            yield from _entries(value, spec, here, list_section)
            continue
        meta = spec.metas[0]
        if number is not None:
            meta = meta.numbered(number)
        yield _field(here, section, meta, value, spec.optional)


def _regime_fields(regime: RegimeSection, index: int) -> Iterator[Field]:
    """Fields of a further regime: those of the main one under names of their own."""
    values = RegimeValues(**{key: value for key, value in regime if key != "gas"})
    parts = (
        (values, "regime", ("regimes", index), 1, "Режим"),
        (regime.gas, "gas", ("regimes", index), 0, "Газы режима"),
    )
    for part, section, home, dropped, title in parts:
        for field in _fields_of(part, (section,), f"{title} {index + 2}", number=None):
            listed = f": {field.section.lower()}" if field.listed else ""
            yield replace(
                field,
                path=(*home, *field.path[dropped:]),
                name=field.name + regime_suffix(index + 2),
                section=f"{title} {index + 2}{listed}",
            )


def regime_suffix(number: int) -> str:
    """Return the ending of the names of a further regime, counted from 2; the main one has none."""
    return f"_R{number}"


def _entries(values: tuple[Any, ...], spec: Key, path: Path, section: str) -> Iterator[Field]:
    metas, optional = spec.metas, spec.optional
    for index, value in enumerate(values):
        here = (*path, index)
        if spec.inner is not None:
            yield from _fields_of(value, here, section, index + 1)
        elif isinstance(value, tuple):
            for column, (meta, item) in enumerate(zip(metas, value, strict=True)):
                yield _field((*here, column), section, meta.numbered(index + 1), item, optional)
        else:
            yield _field(here, section, metas[0].numbered(index + 1), value, optional)


def _field(path: Path, section: str, meta: Meta, value: Value, optional: bool) -> Field:
    return Field(
        path=path,
        name=cell_name(path),
        section=section,
        title=meta.title,
        symbol=meta.symbol,
        unit=meta.unit.label,
        value=value,
        minimum=meta.minimum,
        maximum=meta.maximum,
        choices=dict(meta.choices) if meta.choices is not None else None,
        structural=meta.structural or (path[-1] in _NONE_AT_ZERO and value == 0),
        optional=optional,
    )


def from_cells(
    data: dict[str, Any], models: dict[str, type[StrictModel]]
) -> tuple[dict[str, Any], list[Path]]:
    """Return the data in the file's types, and the paths of cells that are empty.

    A spreadsheet turns a variant "7" into 7; what else it does to numbers and choices
    `reports.inputs.normalise` mends, as in a file.
    """
    empty: list[Path] = []
    result = {
        name: _table(part, models[name], (name,), empty)
        if isinstance(part, dict) and name in models
        else part
        for name, part in data.items()
    }
    return result, empty


def _table(part: dict[str, Any], model: type[StrictModel], path: Path, empty: list[Path]) -> Any:  # noqa: ANN401
    specs = hints(model)
    result = {}
    for key, value in part.items():
        if key not in specs:
            result[key] = value
            continue
        converted = _value(value, specs[key], (*path, key), empty)
        if converted is not None:
            result[key] = converted
    return result


def _value(value: object, spec: Key, path: Path, empty: list[Path]) -> Any:  # noqa: ANN401
    if isinstance(value, list | tuple):
        return [_value(item, spec, (*path, index), empty) for index, item in enumerate(value)]
    if isinstance(value, dict) and spec.inner is not None:
        return _table(value, spec.inner, path, empty)
    text = spec.types == {str} and spec.metas[0].choices is None
    if value is None:
        if text:
            return ""
        empty.append(path)
        return None
    if text and isinstance(value, int | float) and not isinstance(value, bool):
        return str(int(value)) if float(value).is_integer() else str(value)
    return value


def in_cells(text: str) -> str:
    """Return a message about keys, reworded for the cells of a workbook."""
    for of_file, of_book in _PHRASES:
        text = text.replace(of_file, of_book)
    text = _CHOICE.sub(_chosen, text)
    text = _SECTION.sub(_group, text)
    return _KEY.sub(_titled, text)


def _group(match: re.Match[str]) -> str:
    name = match["name"] or match["bare"]
    if name not in SECTIONS:
        return match[0]
    title = f"данные «{SECTIONS[name].title}»"
    return f"{title} задаются в файле .toml: добавьте их там" if match["add"] else title


def _chosen(match: re.Match[str]) -> str:
    labels = _labels().get(match["key"])
    if labels is None:
        return match[0]
    named = [labels.get(value, value) for value in (match["value"], match["other"]) if value]
    return f"«{_titles()[match['key']]}»: " + " или ".join(named)


def _titled(match: re.Match[str]) -> str:
    title = _titles().get(match["key"])
    if title is None:
        return match[0]
    return f"«{title}»" + (f" {match['n']}" if match["n"] else "")


@functools.cache
def _titles() -> dict[str, str]:
    """Title by key."""
    titles: dict[str, str] = {}
    for section in SECTIONS.values():
        titles |= {key: spec.title for key, spec in section.lists.items()}
        for model in section.models:
            for key, spec in hints(model).items():
                for meta in spec.metas[:1]:
                    titles.setdefault(key, meta.title.replace(" {n}", ""))
            for _, inner in records(model):
                for key, spec in hints(inner).items():
                    titles.setdefault(key, spec.metas[0].title.partition(": ")[2])
    return titles


@functools.cache
def _labels() -> dict[str, dict[str, str]]:
    """Labels of the choices by key."""
    labels: dict[str, dict[str, str]] = {}
    for section in SECTIONS.values():
        for model in section.models:
            for key, spec in hints(model).items():
                for meta in spec.metas[:1]:
                    if meta.choices is not None:
                        labels[key] = {**meta.choices, **labels.get(key, {})}
    return labels
