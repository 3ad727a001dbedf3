"""The input files `kshm new` writes: a sample of the house, or every key explained."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from datetime import UTC, datetime
from typing import Any

import tomlkit
from tomlkit.items import Table

from reports.inputs.fields import SECTIONS
from reports.inputs.load import SECTION_MODELS
from reports.inputs.messages import likely_word, shown
from reports.inputs.meta import Meta, Strictly, find_meta, hints, submodel
from reports.inputs.sections.articulated import ArticulatedSection
from reports.inputs.sections.cycle import CycleSection
from reports.inputs.sections.input_file import PolytropicGasSection
from reports.inputs.sections.reference import ReferenceSection
from reports.shared.errors import InputError, Problem
from reports.shared.resources import samples_dir

_KEPT = ("title", "year", "frame", "detail")  # how the report is set, not who wrote it
BLANK_SAMPLE = "gots-diesel"
_HEAD = (
    "Исходные данные двигателя для kshm. Впишите свои значения вместо примера.",
    "Число пишется с точкой; окончание ключа называет единицу:",
    "_mm — мм, _kg — кг, _mpa — МПа, _deg — градусы, _rpm — мин⁻¹, _kw — кВт.",
)


_CYCLE_HINT = (
    'Давления газов можно взять из расчета цикла: gas.source = "cycle" и раздел [cycle];',
    "готовый пример дает команда kshm new --sample cycle-turbo-diesel.",
)
_ARTICULATED_HINT = ("Если шатуны правого ряда V-образного двигателя висят на главных:",)
_REFERENCE_HINT = ("Таблицы 1–3, 5–8 и рисунки 3–10 учебника для любых λ; lambdas — список:",)
_COMMENTED: dict[str, tuple[type[Strictly], tuple[str, ...]]] = {
    "cycle": (CycleSection, _CYCLE_HINT),  # an alternative to the pressures of [gas]
    "articulated": (ArticulatedSection, _ARTICULATED_HINT),
    "reference": (ReferenceSection, _REFERENCE_HINT),
}

# Other ways to give a section's data, told above it.
_MORE: dict[str, tuple[str, ...]] = {
    "gas": (
        'source = "rounded" — скругленная диаграмма рисунка 22 (kind = "petrol" или "diesel");',
        'source = "table" — точки points, interpolation = "linear" или "monotone";',
        'source = "file" — текстовая таблица рядом с этим файлом (CSV или результаты',
        'DIESEL-RK, сохраненные как текст): file = "diagram.csv", pressure_unit = "bar",',
        "angle_column и pressure_column — номер или заголовок столбца, firing_tdc_deg — угол",
        "ВМТ сгорания в таблице.",
        "Другие режимы того же двигателя — разделы [[regimes]] с [regimes.gas]: см. образец",
        "gots-regimes.",
    ),
    "masses": (
        "Шатун: rod_centre_mm, или rod_small_end_share, или взвешивание",
        "rod_weighed_small_end_kg, или качания; чего нет — оценит estimate_fuel по таблице 4.",
    ),
}


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
        what = f"нет образца {shown(sample)}"
        raise InputError(Problem("--sample", what, f"{hint}есть: {', '.join(names)}"))
    return (samples_dir() / f"{sample}.toml").read_text(encoding="utf-8")


def _explained() -> str:
    values = tomllib.loads(_sample_text(BLANK_SAMPLE))
    values["report"] = {"year": datetime.now(tz=UTC).year}
    values["engine"]["name"] = "Двигатель"
    document = tomlkit.document()
    for line in _HEAD:
        document.add(tomlkit.comment(line))
    models: dict[str, type[Strictly]] = {**SECTION_MODELS, "gas": PolytropicGasSection}
    for name, title in SECTIONS.items():
        if name in _COMMENTED:
            document.add(tomlkit.nl())
            for line in _commented(name):
                document.add(tomlkit.comment(line))
            continue
        document.add(tomlkit.nl())
        document.add(tomlkit.comment(title))
        for line in _MORE.get(name, ()):
            document.add(tomlkit.comment(line))
        document.add(name, _table(models[name], values.get(name, {})))
    return tomlkit.dumps(document)


def _commented(name: str) -> Iterator[str]:
    """An optional section as comments: its hint, its head, its keys."""
    model, hint = _COMMENTED[name]
    yield from hint
    yield f"[{name}]"
    for key, annotation in hints(model).items():
        yield f"{key} = … {_note(find_meta(annotation))}"


def _table(model: type[Strictly], values: dict[str, Any]) -> Table:
    table = tomlkit.table()
    defaults = model.model_construct()
    names = {info.alias or field: field for field, info in model.model_fields.items()}
    for key, annotation in hints(model).items():
        inner = submodel(annotation)
        if inner is not None and issubclass(inner, Strictly):
            entries = tomlkit.aot()
            for entry in values[key]:
                entries.append(_table(inner, entry))
            table.add(key, entries)
            continue
        note = _note(find_meta(annotation))
        value = values.get(key, getattr(defaults, names[key], None))
        if value is None:  # an alternative or optional key: shown, not given
            table.add(tomlkit.comment(f"{key} = … {note}"))
        else:
            table.add(key, tomlkit.item(value))
            table[key].comment(note)
    return table


def _note(metas: list[Meta]) -> str:
    meta = metas[0]
    title = meta.title.replace("{n}", "N")
    symbol = f" {meta.symbol.replace('_{n}', '').replace('{n}', '')}" if meta.symbol else ""
    if meta.choices is not None and any(key != label for key, label in meta.choices.items()):
        options = ", ".join(f"{key} — {label}" for key, label in meta.choices.items())
        return f"{title}{symbol}: {options}"
    limits = meta.range_text()
    return f"{title}{symbol}; {limits}" if limits else title + symbol
