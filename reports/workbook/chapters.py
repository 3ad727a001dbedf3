"""Sheets by chapters: their order, the colours of their tabs, their headings.

A sheet is known by the beginning of its title: numbers of journals and regimes follow.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache

from reports.model.blocks import Model
from reports.model.chapter_source import shelf_of
from reports.model.contents import Contents, SheetChapter, contents_of

_REGIME = re.compile(r" р(\d+)$")
_NUMBER = re.compile(r" \((?P<a>\d+)\)$|(?<=[а-я]) (?P<b>\d+)$")


DIAGRAMS = "Диаграммы"


@lru_cache(maxsize=512)
def place_of(sheet: str, contents: Contents | None = None) -> tuple[int, int, int, int]:
    """Where a sheet stands: chapter, place in it, regime, number of the journal.

    ``contents`` are those of the house if none are given; so of the other functions.
    """
    regime = _REGIME.search(sheet)
    base = _REGIME.sub("", sheet)
    number = _NUMBER.search(base)
    name = base if number is None else _NUMBER.sub("", base)
    order = (int(regime[1]) if regime else 0, int(number["a"] or number["b"]) if number else 0)
    for chapter, entry in enumerate((contents or contents_of()).chapters):
        if base == diagrams_of(entry):
            return chapter, -1, *order
        for position, (title, _) in enumerate(entry.sheets):
            if name == title:
                return chapter, position, *order
    raise LookupError(f"no book says where the sheet {sheet!r} stands")


def contents_for(model: Model) -> Contents:
    """Chapters of a model's workbook, with those of its own books."""
    return contents_of(shelf_of(model.input.books))


def chapter_of(sheet: str, contents: Contents | None = None) -> SheetChapter:
    """Return the chapter of a sheet."""
    return (contents or contents_of()).chapters[place_of(sheet, contents)[0]]


def in_course(sheet: str, contents: Contents) -> bool:
    """Whether the workbook of a course project has a sheet."""
    chapter, position, *_ = place_of(sheet, contents)
    return contents.chapters[chapter].sheets[position][0] not in contents.beyond_course


def is_smooth_sheet(sheet: str, contents: Contents | None = None) -> bool:
    """Whether the curves of a sheet have no corners; those of other kinds of books may."""
    try:
        return chapter_of(sheet, contents).smooth
    except LookupError:
        return False


def ordered(sheets: Iterable[str], contents: Contents | None = None) -> list[str]:
    """Sheets by chapters; those of further regimes behind all of the first."""
    return sorted(sheets, key=lambda s: (place_of(s, contents)[2], *place_of(s, contents)))


def diagrams_of(chapter: SheetChapter) -> str:
    """Return the sheet of the chapter's charts that have no room beside their tables."""
    return f"{DIAGRAMS}, {chapter.title[0].lower()}{chapter.title[1:]}"[:31]


def heading(sheet: str, contents: Contents | None = None) -> str:
    """Return what stands above a sheet and in the contents."""
    chapter, position, regime, number = place_of(sheet, contents)
    entry = (contents or contents_of()).chapters[chapter]
    if position < 0:
        return f"{DIAGRAMS}: {entry.title[0].lower()}{entry.title[1:]}"
    text = entry.sheets[position][1]
    text += f" {number}" if number else ""
    return text + (f", режим {regime}" if regime else "")
