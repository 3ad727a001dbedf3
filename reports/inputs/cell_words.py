"""Messages about a workbook speak of its cells, not of the keys of a file."""

from __future__ import annotations

import functools
import re

from reports.inputs.meta import hints
from reports.inputs.registry import SECTIONS, records

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
_SECTION = re.compile(r"(?:добавьте |нужен )?раздел \[(?P<name>\w+)\]|\[(?P<bare>\w+)\]")
_KEY = re.compile(r"\b(?:[a-z]+\.)?(?P<key>lambda|strokes|layout|source|[a-z0-9]+(?:_[a-z0-9]+)+)"
                  r"(?:\[(?P<n>\d+)\])?")  # fmt: skip


def in_cells(text: str) -> str:
    """A message with the titles of cells in place of keys, what to do said of cells."""
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
    added = match[0].startswith("добавьте")
    return f"{title} задаются в файле .toml: добавьте их там" if added else title


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
    found: dict[str, str] = {}
    for section in SECTIONS.values():
        found |= {key: about.title for key, about in section.lists.items()}
        for model in section.models:
            for key, about in hints(model).items():
                for meta in about.metas[:1]:
                    found.setdefault(key, meta.title.replace(" {n}", ""))
            for _, inner in records(model):
                for key, about in hints(inner).items():
                    found.setdefault(key, about.metas[0].title.partition(": ")[2])
    return found


@functools.cache
def _labels() -> dict[str, dict[str, str]]:
    """Labels of the choices by key."""
    found: dict[str, dict[str, str]] = {}
    for section in SECTIONS.values():
        for model in section.models:
            for key, about in hints(model).items():
                for meta in about.metas[:1]:
                    if meta.choices is not None:
                        found[key] = {**meta.choices, **found.get(key, {})}
    return found
