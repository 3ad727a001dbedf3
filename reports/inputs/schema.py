"""JSON Schema of the input file, from the models of its sections: editors complete and check keys.

A rule that needs two keys, and what the program forgives (a number in quotes, a choice by its
Russian word), are not in it.
"""

from __future__ import annotations

import json
import types
import typing
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from pydantic.fields import FieldInfo

from reports.inputs.department_chapters import Texts, sections_of
from reports.inputs.diagram_file import KEYS as FILE_KEYS
from reports.inputs.firing import FOLLOWING
from reports.inputs.meta import MAX_TEXT, Meta, StrictModel
from reports.inputs.normalise import MAX_ENTRIES
from reports.inputs.ranges import SECTION as VARIANTS
from reports.inputs.registry import GAS_MODELS, SECTIONS, InputSection
from reports.inputs.sections.input_file import (
    DesignGeometrySection,
    GeometrySection,
    RegimeValues,
)
from reports.shared.files import write_text

FILE = "kshm.schema.json"  # beside the input files that name it
LINE = f":schema ./{FILE}"  # the first line of an input file, behind its "#"
Schema = dict[str, Any]
_TYPES = {bool: "boolean", int: "integer", float: "number", str: "string"}
_OF_FILE = "file"  # the gas whose points stand in a file of their own


def schema_text(books: Texts = ()) -> str:
    """Return the schema as a file; `books` are own books, whose sections it has too."""
    return json.dumps(input_schema(books), ensure_ascii=False, indent=1) + "\n"


def write_beside(path: Path) -> None:
    """Write the schema beside an input file that names it, if it is not there.

    Raises:
        OutputError: it cannot be written.
    """
    schema = path.parent / FILE
    if not schema.exists():
        write_text(schema, schema_text())


def input_schema(books: Texts = ()) -> Schema:
    """Return the schema of an input file (draft 7)."""
    sections = {section.name: _section(section) for section in SECTIONS.values()}
    required = [section.name for section in SECTIONS.values() if not section.optional]
    regime = _object(RegimeValues)
    regime["properties"] = {**regime["properties"], "gas": sections["gas"]}
    regime["required"] = [*regime["required"], "gas"]
    own = {name: {"title": spec.title, **_object(spec.model)}
           for name, spec in sections_of(books).items() if spec.model is not None}  # fmt: skip
    properties = {
        **sections,
        "regimes": {"title": "Другие режимы", "type": "array", "items": regime},
        VARIANTS: {"title": "Пределы вариантов", "type": "object", "minProperties": 1,
                   "additionalProperties": {"type": "object"}},
    }  # fmt: skip
    if own:
        properties["own"] = {"title": "Разделы своих книг", **_closed(own, own)}
    return {"title": "Исходные данные двигателя для kshm", **_closed(properties, required)}


def _closed(properties: Mapping[str, Schema], required: Iterable[str]) -> Schema:
    return {
        "type": "object", "properties": dict(properties), "required": list(required),
        "additionalProperties": False,
    }  # fmt: skip


def _section(section: InputSection) -> Schema:
    spec = {"title": section.title}
    if section.words:
        spec["description"] = "\n".join(section.words)
    if section.model is GeometrySection:  # sizes, or none where they follow from the power
        models = (GeometrySection, DesignGeometrySection)
        return {**spec, "anyOf": [_object(model) for model in models]}
    if section.name == "gas":
        kinds = [_object(model) for model in GAS_MODELS.values()]
        return {**spec, "oneOf": [*kinds, _diagram_file()]}
    return {**spec, **_object(section.model)}


def _diagram_file() -> Schema:
    """Return schema of a gas whose points stand in a file beside the input."""
    properties: dict[str, Schema] = {key: {} for key in sorted(FILE_KEYS)}
    properties["source"] = {"const": _OF_FILE}
    properties["file"] = {"title": "Файл с диаграммой", "type": "string"}
    return _closed(properties, ["source", "file"])


def _object(model: type[StrictModel]) -> Schema:
    properties, required = {}, []
    for name, info in model.model_fields.items():
        key = info.alias or name
        properties[key] = _field(info)
        if info.is_required() and key not in FOLLOWING:
            required.append(key)
    return _closed(properties, required)


def _field(info: FieldInfo) -> Schema:
    meta = next((part for part in info.metadata if isinstance(part, Meta)), None)
    schema = _typed(info.annotation, meta)
    if meta is not None:
        schema = {**_words(meta), **schema}
    if not info.is_required() and isinstance(info.default, bool | int | float | str):
        schema["default"] = info.default
    return schema


def _words(meta: Meta) -> Schema:
    title = meta.title.replace("{n}", "N")
    symbol = meta.symbol.replace("_{n}", "").replace("{n}", "")
    unit = f", {meta.unit.label}" if meta.unit.label else ""
    words: Schema = {"title": f"{title} {symbol}".rstrip() + unit}
    labels = [f"{key} — {label}" for key, label in (meta.choices or {}).items() if key != label]
    details = "; ".join(labels) if labels else meta.range_text()
    if details:
        words["description"] = details
    return words


def _typed(annotation: Any, meta: Meta | None) -> Schema:  # noqa: ANN401
    """Return the schema of a type; the metadata is that of its single values."""
    origin, parts = typing.get_origin(annotation), typing.get_args(annotation)
    if origin in (typing.Union, types.UnionType):
        (only,) = (part for part in parts if part is not type(None))
        return _typed(only, meta)
    if origin is typing.Annotated:
        metas = [part for part in parts[1:] if isinstance(part, Meta)]
        inner = _typed(parts[0], metas[0] if metas else meta)
        return {**_words(metas[0]), **inner} if metas else inner
    if origin is typing.Literal:
        return {"enum": list(parts)}
    if origin is tuple and parts[-1] is Ellipsis:
        return {"type": "array", "items": _typed(parts[0], meta), "maxItems": MAX_ENTRIES}
    if origin is tuple:
        items = [_typed(part, meta) for part in parts]
        return {"type": "array", "items": items, "minItems": len(parts), "maxItems": len(parts)}
    if isinstance(annotation, type) and issubclass(annotation, StrictModel):
        return _object(annotation)
    return {"type": _TYPES[annotation], **dict(_limits(annotation, meta))}


def _limits(kind: type, meta: Meta | None) -> Iterator[tuple[str, Any]]:
    if kind is str:
        yield "maxLength", MAX_TEXT
    if meta is None:
        return
    if meta.choices is not None:
        yield "enum", [kind(choice) for choice in meta.choices]
    if meta.minimum is not None:
        yield "minimum", meta.minimum
    if meta.maximum is not None:
        yield "maximum", meta.maximum
