"""The input as groups of fields by the one registry, whatever its values are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from pydantic import BaseModel

from reports.inputs.fields import key_text
from reports.inputs.load_regimes import MOST_REGIMES
from reports.inputs.meta import Meta, find_meta, hints, leaf_types, submodel
from reports.inputs.registry import GAS_MODELS, SECTIONS
from reports.inputs.sections.input_file import RegimeValues

Data = dict[str, Any]
Path = tuple[str | int, ...]
_MOST_ENTRIES = 1500  # of a list are shown: an answer stays bounded, whatever was asked
_DRAWINGS = {"throw_angles_deg": "phases", "webs": "signs", "arms": "arms"}  # of these lists


def groups(raw: Mapping[str, Any]) -> Iterator[Data]:
    """Groups of fields in the order of the file, its lists among them, with keys not given."""
    for name, section in SECTIONS.items():
        if name in raw or not section.absent:
            yield from _section(name, (name,), section.title, raw.get(name))
    regimes = raw.get("regimes")
    for index, regime in enumerate(regimes[:MOST_REGIMES] if isinstance(regimes, list) else ()):
        place, gas = ("regimes", index), _mapping(regime).get("gas")
        yield from _section("regime", place, f"Режим {index + 2}", regime, RegimeValues)
        yield from _section("gas", (*place, "gas"), f"Газы режима {index + 2}", gas)


def absent(raw: Mapping[str, Any]) -> list[Data]:
    """Sections that may be added; of regimes another one."""
    sections = [
        {"id": name, "title": section.title}
        for name, section in SECTIONS.items()
        if section.absent and name not in raw
    ]
    return [*sections, {"id": "regimes", "title": "Ещё один режим"}]


def without_foreign(raw: Mapping[str, Any]) -> Data:
    """The input without keys of other sources of the gas than the one chosen."""
    gas = _mapping(raw.get("gas"))
    own = set(hints(_gas_model(gas)))
    foreign = {key for model in GAS_MODELS.values() for key in hints(model)} - own
    return {**raw, "gas": {k: v for k, v in gas.items() if k not in foreign}} if gas else {**raw}


def _mapping(value: object) -> Mapping[str, Any]:
    return value if isinstance(value, dict) else {}


def _gas_model(gas: Mapping[str, Any]) -> type[BaseModel]:
    return GAS_MODELS.get(str(gas.get("source")), SECTIONS["gas"].model)


def _section(
    name: str, path: Path, title: str, given: object, model: type[BaseModel] | None = None
) -> Iterator[Data]:
    part, home = _mapping(given), SECTIONS[name]
    model = model or (_gas_model(part) if name == "gas" else home.model)
    lists = {key: about for key, about in home.lists.items() if key in hints(model)}
    fields = list(_record(part, model, path, left_out=lists))
    may_go = path[0] == "regimes" if name in ("regime", "gas") else home.absent
    whole = list(path[:2]) if may_go else None  # told once, with the first group
    if fields:
        yield {"title": title, "key": key_text(path), "fields": fields, "whole": whole}
    for key, about in lists.items():
        drawing = _DRAWINGS.get(key, "")
        if key == "arms" and "bank_angle_deg" in part:
            drawing = "arms-v"
        own = about.title if name == path[0] else f"{title}: {about.title.lower()}"
        whole = None if fields else whole
        yield {"title": own, "drawing": drawing, "whole": whole, **_list(part, model, (*path, key))}


def _record(
    part: Mapping[str, Any], model: type[BaseModel], path: Path, number: int = 0,
    left_out: Mapping[str, object] | None = None,
) -> Iterator[Data]:  # fmt: skip
    for key, annotation in hints(model).items():
        metas = find_meta(annotation)
        if metas and key not in (left_out or ()):
            meta = metas[0].numbered(number) if number else metas[0]
            needed = key in _required(model)
            yield _field((*path, key), meta, part.get(key), annotation, needed)


def _required(model: type[BaseModel]) -> set[str]:
    fields = model.model_fields.items()
    return {info.alias or name for name, info in fields if info.is_required()}


def _list(part: Mapping[str, Any], model: type[BaseModel], path: Path) -> Data:
    """A list that grows and shrinks: fields of each entry and what a new one begins with."""
    key = str(path[-1])
    annotation, given = hints(model)[key], part.get(key)
    inner, metas = submodel(annotation), find_meta(annotation)
    entries: list[list[Data]] = []
    shown = given[:_MOST_ENTRIES] if isinstance(given, list | tuple) else ()
    for index, item in enumerate(shown):
        here, number = (*path, index), index + 1
        if inner is not None:
            entries.append(list(_record(_mapping(item), inner, here, number)))
            continue
        pair = len(metas) > 1
        values = (item if isinstance(item, list | tuple) else ()) if pair else (item,)
        entries.append([
            _field((*here, column) if pair else here, meta.numbered(number),
                   values[column] if column < len(values) else None, annotation, True)
            for column, meta in enumerate(metas)
        ])  # fmt: skip
    blank: Any = [_least(meta) for meta in metas]
    if inner is not None:
        blank = {key: _least(find_meta(hints(inner)[key])[0]) for key in _required(inner)}
    elif len(metas) == 1:
        blank = blank[0]
    return {"key": key_text(path), "path": list(path), "entries": entries, "blank": blank,
            "fields": [field for entry in entries for field in entry]}  # fmt: skip


def _least(meta: Meta) -> Any:  # noqa: ANN401
    """What a new entry has until a person writes over it."""
    if meta.choices:
        return next(iter(meta.choices))
    return "" if meta.minimum is None else max(meta.minimum, 0)


def _field(path: Path, meta: Meta, value: object, annotation: object, needed: bool) -> Data:
    return {
        "path": list(path), "key": key_text(path), "title": meta.title, "symbol": meta.symbol,
        "unit": meta.unit.label, "value": value, "min": meta.minimum, "max": meta.maximum,
        "choices": None if meta.choices is None else dict(meta.choices),
        "number": meta.choices is None and bool(leaf_types(annotation) & {int, float}),
        "optional": not needed,
    }  # fmt: skip
