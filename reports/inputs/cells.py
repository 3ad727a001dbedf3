"""Values as a spreadsheet stores them, brought to the types of the input file."""

from __future__ import annotations

from typing import Any

from reports.inputs.fields import Path
from reports.inputs.meta import Key, Strictly, hints


def from_cells(
    data: dict[str, Any], models: dict[str, type[Strictly]]
) -> tuple[dict[str, Any], list[Path]]:
    """Return the data in the file's types, and the paths of cells that are empty.

    A spreadsheet turns a variant "7" into 7; what else it does to numbers and choices
    `reports.inputs.understood` mends, as in a file.
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


def _value(value: object, about: Key, path: Path, empty: list[Path]) -> Any:  # noqa: ANN401
    if isinstance(value, list | tuple):
        return [_value(item, about, (*path, index), empty) for index, item in enumerate(value)]
    if isinstance(value, dict) and about.inner is not None:
        return _table(value, about.inner, path, empty)
    text = about.types == {str} and about.metas[0].choices is None
    if value is None:
        if text:
            return ""
        empty.append(path)
        return None
    if text and isinstance(value, int | float) and not isinstance(value, bool):
        return str(int(value)) if float(value).is_integer() else str(value)
    return value
