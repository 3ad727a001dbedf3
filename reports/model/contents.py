"""Order of the books, chapters and sheets of the workbook, as the books themselves say."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache

from reports.model.chapter_source import Shelf, house_shelf
from reports.shared.errors import BookError

_PLACE = re.compile(r"^place (before|chain|after|drawn) (\d+)( alone)?$", re.MULTILINE)
_CHAPTER = re.compile(r"^chapter (.+) ([0-9A-F]{6})( smooth)?$", re.MULTILINE)
_SHEET = re.compile(r"^sheet (.+?) in (.+) (\d+)( full)?: (.+)$", re.MULTILINE)
MAX_TITLE = 28  # of a sheet: the number of a regime may follow
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


@dataclass(frozen=True, eq=False)
class Contents:
    """Books of each part of the model and chapters of the workbook, in order.

    ``beyond_course`` are the sheets that only the full workbook has, ``alone`` the books whose
    numbers no solver gives: those of their formulas are the results.
    """

    parts: dict[str, tuple[str, ...]]
    chapters: tuple[SheetChapter, ...]
    beyond_course: frozenset[str] = frozenset()
    alone: frozenset[str] = frozenset()


@lru_cache(maxsize=8)
def contents_of(shelf: Shelf | None = None) -> Contents:
    """Contents of all books of a shelf, those of the house if none is given."""
    texts = dict((shelf or house_shelf()).texts())
    positions = [
        (part, int(order), name, bool(alone))
        for name, text in texts.items()
        for part, order, alone in _PLACE.findall(text)
    ]
    parts: dict[str, list[str]] = {"before": [], "chain": [], "after": [], "drawn": []}
    for part, _, name, _ in sorted(positions):
        parts[part].append(name)
    whole = "\n".join(texts.values())
    sheets: dict[str, list[tuple[int, str, str]]] = {}
    beyond_course: set[str] = set()
    for title, chapter, order, full, heading in _SHEET.findall(whole):
        name = _NUMBER.sub("", title)
        sheets.setdefault(chapter, []).append((int(order), name, heading))
        beyond_course |= {name} if full else set()
    if shelf is not None and shelf.own:
        _check_chapters(shelf, {title for title, _, _ in _CHAPTER.findall(whole)})
    return Contents(
        {part: tuple(names) for part, names in parts.items()},
        tuple(
            SheetChapter(title, colour, _ordered(sheets.get(title, [])), bool(smooth))
            for title, colour, smooth in _CHAPTER.findall(whole)
        ),
        frozenset(beyond_course),
        frozenset(name for _, _, name, alone in positions if alone),
    )


def _check_chapters(shelf: Shelf, chapters: set[str]) -> None:
    """Refuse sheets of own books that name no chapter of the workbook."""
    for name, text in shelf.own:
        for number, line in enumerate(text.splitlines(), 1):
            sheet = _SHEET.fullmatch(line)
            title = sheet[1] if sheet else ""
            if sheet is None:
                continue
            if sheet[2] not in chapters:
                raise BookError(name, number, line.index(sheet[2]) + 1,
                                f"главы «{sheet[2]}» в книге Excel нет",
                                "главы: " + ", ".join(sorted(chapters)))  # fmt: skip
            if "{{" not in title and (len(title) > MAX_TITLE or re.search(r"[\\/*?:\[\]']", title)):
                raise BookError(name, number, 7, f"листа «{title}» в Excel быть не может",
                                f"до {MAX_TITLE} знаков без \\ / * ? : [ ] '")  # fmt: skip


def _ordered(sheets: list[tuple[int, str, str]]) -> tuple[tuple[str, str], ...]:
    return tuple((title, heading) for _, title, heading in sorted(sheets))
