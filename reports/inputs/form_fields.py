"""Groups of fields for the form of the page, whatever the values are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from pydantic import BaseModel

from reports.inputs.department_chapters import sections_of, texts_of
from reports.inputs.fields import Path, key_text
from reports.inputs.findings import MAX_REGIMES
from reports.inputs.meta import Key, Meta, hints
from reports.inputs.registry import GAS_MODELS, SECTIONS
from reports.inputs.sections.input_file import RegimeValues

Data = dict[str, Any]
_MAX_ENTRIES = 1500  # of a list are shown: an answer stays bounded, whatever was asked
_DRAWINGS = {"throw_angles_deg": "phases", "webs": "signs", "arms": "arms"}  # of these lists


def groups(raw: Mapping[str, Any]) -> Iterator[Data]:
    """Yield groups of fields in the order of the file, its lists among them, with keys not given.

    A list has its ``path`` and what one more entry begins with: the last one again, of a list of
    choices one that is not taken; ``whole`` is the path of what may be taken away.
    """
    for name, section in SECTIONS.items():
        if name in raw or not section.absent:
            whole = (name,) if section.absent else None
            yield from _section(name, (name,), section.title, raw.get(name), whole)
    for name, spec in sections_of(texts_of(raw)).items():
        assert spec.model is not None
        part = _mapping(_mapping(raw.get("own")).get(name))
        yield {"title": spec.title, "key": f"own.{name}", "whole": None,
               "entries": [list(_record(part, spec.model, ("own", name)))]}  # fmt: skip
    regimes = raw.get("regimes")
    for index, regime in enumerate(regimes[:MAX_REGIMES] if isinstance(regimes, list) else ()):
        path, gas = ("regimes", index), _mapping(regime).get("gas")
        yield from _section("regime", path, f"Режим {index + 2}", regime, path, RegimeValues)
        yield from _section("gas", (*path, "gas"), f"Газы режима {index + 2}", gas, path)


def absent(raw: Mapping[str, Any]) -> dict[str, str]:
    """Titles of sections that can be added, a further regime among them."""
    sections = {name: section.title for name, section in SECTIONS.items()
                if section.absent and name not in raw}  # fmt: skip
    return {**sections, "regimes": "Ещё один режим"}


def without_foreign(raw: Mapping[str, Any]) -> Data:
    """Return the input without keys of gas sources other than the chosen one."""
    gas = _mapping(raw.get("gas"))
    foreign = {key for model in GAS_MODELS.values() for key in hints(model)}
    foreign -= set(hints(_gas_model(gas)))
    return {**raw, "gas": {k: v for k, v in gas.items() if k not in foreign}} if gas else {**raw}


def _mapping(value: object) -> Mapping[str, Any]:
    return value if isinstance(value, dict) else {}


def _gas_model(gas: Mapping[str, Any]) -> type[BaseModel]:
    return GAS_MODELS.get(str(gas.get("source")), SECTIONS["gas"].model)


def _section(
    name: str, path: Path, title: str, values: object, whole: Path | None,
    model: type[BaseModel] | None = None,
) -> Iterator[Data]:  # fmt: skip
    part, lists = _mapping(values), SECTIONS[name].lists
    model = model or (_gas_model(part) if name == "gas" else SECTIONS[name].model)
    plain = list(_record(part, model, path, left_out=lists))
    if plain:
        yield {"title": title, "key": key_text(path), "entries": [plain], "whole": whole}
    for key, spec in hints(model).items():
        if key not in lists:
            continue
        heading = lists[key].title if name == path[0] else f"{title}: {lists[key].title.lower()}"
        two_banks = key == "arms" and "bank_angle_deg" in part
        values = part.get(key)
        entries = values[:_MAX_ENTRIES] if isinstance(values, list | tuple) else ()
        yield {
            "title": heading, "key": key_text((*path, key)), "path": (*path, key), "whole": whole,
            "drawing": "arms-v" if two_banks else _DRAWINGS.get(key, ""),
            "entries": [list(_entry(item, spec, (*path, key, index)))
                        for index, item in enumerate(entries)],
            "more": _one_more(entries, spec),
        }  # fmt: skip


def _one_more(entries: Sequence[object], spec: Key) -> object:
    if spec.metas and spec.metas[0].choices:
        free = (choice for choice in spec.metas[0].choices if choice not in entries)
        return next(free, "")
    if entries:
        return entries[-1]
    return {} if spec.inner else [""] * len(spec.metas) if len(spec.metas) > 1 else ""


def _record(
    part: Mapping[str, Any], model: type[BaseModel], path: Path, number: int = 0,
    left_out: Mapping[str, object] | None = None,
) -> Iterator[Data]:  # fmt: skip
    for key, spec in hints(model).items():
        if spec.metas and key not in (left_out or ()):
            meta = spec.metas[0].numbered(number) if number else spec.metas[0]
            yield _field((*path, key), meta, part.get(key), spec, spec.optional)


def _entry(item: object, spec: Key, path: Path) -> Iterator[Data]:
    """Fields of an entry of a list: a record, a pair, or one value."""
    metas, number = spec.metas, int(path[-1]) + 1
    if spec.inner is not None:
        yield from _record(_mapping(item), spec.inner, path, number)
        return
    pair = len(metas) > 1
    values = (item if isinstance(item, list | tuple) else ()) if pair else (item,)
    for column, meta in enumerate(metas):
        value = values[column] if column < len(values) else None
        yield _field((*path, column) if pair else path, meta.numbered(number), value, spec)


def _field(path: Path, meta: Meta, value: object, spec: Key, optional: bool = False) -> Data:
    return {
        "path": path, "key": key_text(path), "title": meta.title, "symbol": meta.symbol,
        "unit": meta.unit.label, "value": value, "min": meta.minimum, "max": meta.maximum,
        "choices": meta.choices and dict(meta.choices), "optional": optional,
        "number": meta.choices is None and bool(spec.types & {int, float}),
    }  # fmt: skip
