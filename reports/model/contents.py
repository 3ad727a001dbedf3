"""Order of the books, chapters and sheets of the workbook, as the books themselves say."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache

from reports.model.book_text import Shelf, house_shelf

_PLACE = re.compile(r"^place (before|chain|after) (\d+)$", re.MULTILINE)
_CHAPTER = re.compile(r"^chapter (.+) ([0-9A-F]{6})( smooth)?$", re.MULTILINE)
_SHEET = re.compile(r"^sheet (.+?) in (.+) (\d+): (.+)$", re.MULTILINE)
_NUMBER = re.compile(r"\s*\(?\{\{.*\}\}\)?$")  # of a journal, filled in for each


@dataclass(frozen=True, slots=True)
class SheetChapter:
    """Title, colour of the tabs, sheets with their headings in order.

    ``smooth`` says that its curves over the angle have no corners.
    """

    title: str
    colour: str
    sheets: tuple[tuple[str, str], ...]
    smooth: bool = False


@dataclass(frozen=True, slots=True)
class Contents:
    """Books of each part of the model and chapters of the workbook, in order."""

    parts: dict[str, tuple[str, ...]]
    chapters: tuple[SheetChapter, ...]


@lru_cache(maxsize=8)
def contents_of(shelf: Shelf | None = None) -> Contents:
    """Contents of all books of a shelf, those of the house if none is given."""
    texts = dict((shelf or house_shelf()).texts())
    places = [
        (part, int(order), name)
        for name, text in texts.items()
        for part, order in _PLACE.findall(text)
    ]
    parts: dict[str, list[str]] = {"before": [], "chain": [], "after": []}
    for part, _, name in sorted(places):
        parts[part].append(name)
    whole = "\n".join(texts.values())
    sheets: dict[str, list[tuple[int, str, str]]] = {}
    for title, chapter, order, heading in _SHEET.findall(whole):
        sheets.setdefault(chapter, []).append((int(order), _NUMBER.sub("", title), heading))
    return Contents(
        {part: tuple(names) for part, names in parts.items()},
        tuple(
            SheetChapter(title, colour, _ordered(sheets.get(title, [])), bool(smooth))
            for title, colour, smooth in _CHAPTER.findall(whole)
        ),
    )


def _ordered(sheets: list[tuple[int, str, str]]) -> tuple[tuple[str, str], ...]:
    return tuple((title, heading) for _, title, heading in sorted(sheets))
