"""Values as a spreadsheet stores them, brought to the types of the input file."""

from __future__ import annotations

import typing
from typing import Any

from reports.inputs.fields import Path
from reports.inputs.meta import Meta, Strictly, find_meta, hints, submodel


def from_cells(
    data: dict[str, Any], models: dict[str, type[Strictly]]
) -> tuple[dict[str, Any], list[Path]]:
    """Return the data in the file's types, and the paths of cells that are empty.

    A spreadsheet has one number type, shows choices by label and turns a
    variant "7" into 7; nothing else is forgiven.
    """
    empty: list[Path] = []
    result = {
        name: _table(part, models[name], (name,), empty)
        if isinstance(part, dict) and name in models
        else part
        for name, part in data.items()
    }
    return result, empty


def _table(part: dict[str, Any], model: type[Strictly], path: Path, empty: list[Path]) -> Any:  # noqa: ANN401
    known = hints(model)
    result = {}
    for key, value in part.items():
        if key not in known:
            result[key] = value
            continue
        converted = _value(value, known[key], (*path, key), empty)
        if converted is not None:
            result[key] = converted
    return result


def _value(value: object, annotation: object, path: Path, empty: list[Path]) -> Any:  # noqa: ANN401
    inner = submodel(annotation)
    if isinstance(value, list | tuple):
        return [
            _table(item, inner, (*path, index), empty)
            if inner is not None and issubclass(inner, Strictly) and isinstance(item, dict)
            else _value(item, annotation, (*path, index), empty)
            for index, item in enumerate(value)
        ]
    metas = find_meta(annotation)
    types = _leaf_types(annotation)
    if value is None:
        if types == {str} and metas and metas[0].choices is None:
            return ""
        empty.append(path)
        return None
    if metas and metas[0].choices is not None:
        return _choice(value, metas[0], types)
    if types == {str} and isinstance(value, int | float) and not isinstance(value, bool):
        return str(int(value)) if float(value).is_integer() else str(value)
    return _whole(value) if types == {int} else value


def _choice(value: object, meta: Meta, types: set[type]) -> object:
    labels = {label: key for key, label in (meta.choices or {}).items()}
    key = labels.get(value, value) if isinstance(value, str) else value
    if types == {int}:
        return int(key) if isinstance(key, str) and key.isdecimal() else _whole(key)
    return key


def _whole(value: object) -> object:
    return int(value) if isinstance(value, float) and value.is_integer() else value


def _leaf_types(annotation: object) -> set[type]:
    if isinstance(annotation, type):
        return set() if annotation is type(None) else {annotation}
    if typing.get_origin(annotation) is typing.Literal:
        return {type(item) for item in typing.get_args(annotation)}
    if hasattr(annotation, "__metadata__"):
        return _leaf_types(typing.get_args(annotation)[0])
    found: set[type] = set()
    for part in typing.get_args(annotation):
        found |= _leaf_types(part)
    return found
