"""Input files that `kshm new` writes: a sample, or every key explained."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from typing import Any

import tomlkit
from tomlkit.items import Table

from reports.inputs.messages import likely_word, shown
from reports.inputs.meta import Meta, StrictModel, hints
from reports.inputs.registry import SECTIONS, InputSection, records
from reports.inputs.sections.input_file import DesignGeometrySection, RegimeValues
from reports.shared.errors import InputError, Problem
from reports.shared.resources import samples_dir

# How the report is set, not who wrote it.
_KEPT = ("title", "year", "frame", "detail", "chapters", "formats")
BLANK_SAMPLE = "gots-diesel"
NUMBER_WORDS = (
    "Число пишется с точкой; окончание ключа называет единицу:",
    "_mm — мм, _kg — кг, _mpa — МПа, _deg — градусы, _rpm — мин⁻¹, _kw — кВт.",
)


def list_samples() -> tuple[str, ...]:
    """Return the names of the samples, sorted."""
    return tuple(sorted(path.stem for path in samples_dir().glob("*.toml")))


def new_file(sample: str | None = None) -> str:
    """Return the text of a commented input file.

    Args:
        sample: A name of `list_samples`: that file, its comments kept, the
            report's data emptied.  None: every key with title, unit and range.

    Raises:
        InputError: There is no such sample.
    """
    if sample is None:
        return _explained()
    document = tomlkit.parse(_sample_text(sample))
    report = document.get("report", {})
    for key in report:
        if key not in _KEPT:
            report[key] = ""
    if "year" in report:
        report["year"] = datetime.now(tz=UTC).year
    return tomlkit.dumps(document)


def _sample_text(sample: str) -> str:
    names = list_samples()
    if sample not in names:  # also keeps ../ out
        likely = likely_word(sample, names)
        hint = f"возможно, {likely}; " if likely else ""
        problem = f"нет образца {shown(sample)}"
        raise InputError(Problem("--sample", problem, f"{hint}есть: {', '.join(names)}"))
    return (samples_dir() / f"{sample}.toml").read_text(encoding="utf-8")


def _explained() -> str:
    values = tomllib.loads(_sample_text(BLANK_SAMPLE))
    values["report"] = {"year": datetime.now(tz=UTC).year}
    values["engine"]["name"] = "Двигатель"
    del values["regime"]["indicated_power_kw"]  # the book's own, of another diagram
    document = tomlkit.document()
    head = "Исходные данные двигателя для kshm. Впишите свои значения вместо примера."
    for line in (head, *NUMBER_WORDS):
        document.add(tomlkit.comment(line))
    for section in SECTIONS.values():
        document.add(tomlkit.nl())
        if section.absent:
            for line in _commented(section):
                document.add(tomlkit.comment(line))
            continue
        for line in (section.title, *section.words):
            document.add(tomlkit.comment(line))
        document.add(section.name, _table(section.model, values.get(section.name, {})))
    return tomlkit.dumps(document)


def set_file(values: Mapping[str, Any]) -> str:
    """Return the text of an input file with given values, every key explained.

    Args:
        values: sections by name, as `reports.inputs.fields.to_mapping` gives them; the texts of
            own books stay in their files.
    """
    document = tomlkit.document()
    for line in ("Исходные данные двигателя для kshm.", *NUMBER_WORDS):
        document.add(tomlkit.comment(line))
    for section in SECTIONS.values():
        if section.name not in values:
            continue
        document.add(tomlkit.nl())
        document.add(tomlkit.comment(section.title))
        document.add(section.name, _table(_model(section.name, values[section.name]),
                                          values[section.name], whole=False))  # fmt: skip
    if values.get("regimes"):
        entries = tomlkit.aot()
        for regime in values["regimes"]:
            table = _table(RegimeValues, regime, whole=False)
            table.add("gas", _table(_model("gas", regime["gas"]), regime["gas"], whole=False))
            entries.append(table)
        document.add("regimes", entries)
    if values.get("own"):
        document.add("own", tomlkit.item(values["own"]))
    return tomlkit.dumps(document)


def _model(name: str, section: Mapping[str, Any]) -> type[StrictModel]:
    spec = SECTIONS[name]
    if name == "geometry" and "bore_mm" not in section:
        return DesignGeometrySection
    return spec.sources.get(section.get("source", ""), spec.model)


def _commented(section: InputSection) -> Iterator[str]:
    """Yield an optional section as comments: its words, its head, its keys."""
    yield from section.words
    lists = dict(records(section.model))
    plain = {key: item for key, item in hints(section.model).items() if key not in lists}
    heads = {f"[{section.name}]": plain} if plain else {}
    heads |= {f"[[{section.name}.{key}]]": hints(inner) for key, inner in lists.items()}
    for head, keys in heads.items():
        yield head
        for key, spec in keys.items():
            yield f"{key} = … {_note(spec.metas)}"


def _table(model: type[StrictModel], values: Mapping[str, Any], *, whole: bool = True) -> Table:
    """Return the values of a section, each explained; `whole` with the keys that are not given."""
    table, lists = tomlkit.table(), {}
    defaults = model.model_construct()
    for key, spec in hints(model).items():
        if spec.inner is not None:
            entries = tomlkit.aot()
            for entry in values.get(key, ()):
                entries.append(_table(spec.inner, entry, whole=whole))
            if entries:
                lists[key] = entries
            continue
        note = _note(spec.metas)
        value = values.get(key, getattr(defaults, spec.name, None))
        if value is not None:
            table.add(key, tomlkit.item(value))
            table[key].comment(note)
        elif whole:  # an alternative or optional key: shown, not given
            table.add(tomlkit.comment(f"{key} = … {note}"))
    for key, entries in lists.items():
        table.add(key, entries)
    return table


def _note(metas: tuple[Meta, ...]) -> str:
    meta = metas[0]
    title = meta.title.replace("{n}", "N")
    symbol = f" {meta.symbol.replace('_{n}', '').replace('{n}', '')}" if meta.symbol else ""
    if meta.choices is not None and any(key != label for key, label in meta.choices.items()):
        options = ", ".join(f"{key} — {label}" for key, label in meta.choices.items())
        return f"{title}{symbol}: {options}"
    limits = meta.range_text()
    return f"{title}{symbol}; {limits}" if limits else title + symbol
