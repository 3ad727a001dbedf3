"""``docs/input.md``: the input file key by key, from the models that check it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from pydantic_core import PydanticUndefined

from reports.inputs.meta import Meta, Strictly, hints
from reports.inputs.registry import GAS_MODELS, SECTIONS, records
from reports.inputs.units import number_text
from tools.manual.markdown import escaped, table
from tools.manual.words import FILE_KEYS, INPUT_HEAD, SECTION_NOTES

_HEADER = ("Ключ", "Что это", "Обозначение", "Единица", "Допустимо", "Если не задано")


def input_page() -> str:
    """The whole page."""
    parts = [INPUT_HEAD]
    for name, section in SECTIONS.items():
        parts.append(f"## [{name}] — {section.title.lower()}")
        parts += SECTION_NOTES.get(name, ())
        if name == "gas":
            parts += _gases()
        else:
            parts += _section(name, section.model)
    for name, title in (("regimes", "дальнейшие режимы"), ("variants", "варианты для группы")):
        parts.append(f"## {'[[regimes]]' if name == 'regimes' else '[variants]'} — {title}")
        parts += SECTION_NOTES[name]
    return "\n\n".join(parts) + "\n"


def _gases() -> Iterator[str]:
    for source, model in GAS_MODELS.items():
        yield f'### gas.source = "{source}"'
        yield from SECTION_NOTES.get(f"gas.{source}", ())
        yield from _section("gas", model)
    yield '### gas.source = "file"'
    yield from SECTION_NOTES["gas.file"]
    yield table(("Ключ", "Что это"), ((f"`{key}`", text) for key, text in FILE_KEYS))


def _section(path: str, model: type[Strictly]) -> Iterator[str]:
    """The keys of a section as one table, those of its lists of records as further ones."""
    inner = dict(records(model))
    yield table(_HEADER, _rows(model, skipped=inner))
    for key, found in inner.items():
        yield f"### [[{path}.{key}]]"
        yield from SECTION_NOTES.get(f"{path}.{key}", ())
        yield table(_HEADER, _rows(found))


def _rows(model: type[Strictly], skipped: Iterable[str] = ()) -> Iterator[tuple[str, ...]]:
    for key, about in hints(model).items():
        if key in skipped:
            continue
        default = _default(model.model_fields[about.name])
        for meta in about.metas:
            listed = "{n}" in meta.title or "{n}" in meta.symbol
            mark = f"`{key}`" + (" (список)" if listed and not _of_record(model) else "")
            yield (
                mark,
                escaped(meta.title.replace("{n}", "N")),
                escaped(meta.symbol.replace("_{n}", "_N").replace("{n}", "N")) or "—",
                meta.unit.label or "—",
                escaped(_allowed(meta)),
                default,
            )


def _of_record(model: type[Strictly]) -> bool:
    return all("{n}" in meta.title for hint in hints(model).values() for meta in hint.metas)


def _allowed(meta: Meta) -> str:
    if meta.choices is not None:
        pairs = meta.choices.items()
        return ", ".join(f"`{key}`" + (f" — {text}" if key != text else "") for key, text in pairs)
    if meta.minimum is None or meta.maximum is None:
        return "текст"
    return f"{number_text(meta.minimum)} … {number_text(meta.maximum)}"


def _default(info: Any) -> str:  # noqa: ANN401
    if info.is_required():
        return "**обязателен**"
    value = info.default
    if value is PydanticUndefined:  # a factory: only the year has one
        return "текущий год"
    if value is None or value in ("", ()):
        return "не задан"
    if isinstance(value, str):
        return f"`{value}`"
    values = value if isinstance(value, tuple) else (value,)
    return "; ".join(number_text(item) for item in values)
