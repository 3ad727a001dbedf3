"""How many lines a paragraph has: its words set line by line, divided where WeasyPrint does."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator
from html import unescape
from typing import TYPE_CHECKING, NamedTuple

from reports.document.text.fonts import text_em

if TYPE_CHECKING:
    from pyphen import Pyphen

DIVIDED = (4, 2, 2)  # letters of a word that is divided and of its parts, at least
_SMALL = 0.7  # of indices
_TOKEN = re.compile(r"<(/?)(\w+)([^>]*)>|([^<]+)")
_UNBROKEN = re.compile(r'class="(?:nb|ref)"')
# After a hyphen, a dash or a stroke before a letter a line may end.
_PARTS = re.compile(r"(?<=[^\W\d]-)(?=[^\W\d])|(?<=–)(?=[^\s])|(?<=[^\W\d]/)(?=[^\W\d]|\()")
_LETTERS = re.compile(r"[^\W\d_]+")


class _Piece(NamedTuple):
    """What a line is not divided within, but by hyphenation where it is plain text."""

    width: float
    space: float  # after it
    text: str = ""


def line_count(html: str, room: float, *, indent: float = 0.0, divided: bool = True) -> int:
    """Lines of a paragraph.

    Args:
        html: Its text; the only elements are inline ones.
        room: Width of a line [em].
        indent: Of the first line [em].
        divided: Words are hyphenated.
    """
    lines, used = 1, indent
    for width, space, text in _pieces(html):
        if used + width <= room or not used:
            used += width + space
            continue
        rest = _divided(text, room - used) if text and divided else 0.0
        lines, used = lines + 1, (rest or width) + space
    return lines


def _pieces(html: str) -> Iterator[_Piece]:
    """Pieces of the text with their widths."""
    width, plain, text = 0.0, True, ""
    for run, small, unbroken, slanted in _runs(html):
        scale = _SMALL if small else 1.0
        words = [run] if unbroken else re.split(r"( +)", run)
        for word in words:
            if word and not word.strip(" "):
                if width:
                    yield _Piece(width, text_em(" "), text if plain else "")
                width, plain, text = 0.0, True, ""
                continue
            parts = [word] if unbroken or small else _PARTS.split(word)
            for part in parts[:-1]:
                width += scale * text_em(part, slanted=slanted)
                yield _Piece(width, 0.0, text + part if plain else "")
                width, plain, text = 0.0, True, ""
            width += scale * text_em(parts[-1], slanted=slanted)
            plain = plain and not (small or unbroken or slanted)
            text += parts[-1]
    if width:
        yield _Piece(width, 0.0, text if plain else "")


def _runs(html: str) -> Iterator[tuple[str, bool, bool, bool]]:
    """Stretches of text: whether they are small, must not be divided, are slanted."""
    small = unbroken = slanted = 0
    open_tags: list[tuple[bool, bool, bool]] = []
    for closing, tag, attributes, text in _TOKEN.findall(html):
        if text:
            run = re.sub(r"[ \n\t]+", " ", unescape(text))
            yield run, small > 0, unbroken > 0, slanted > 0
        elif closing:
            if open_tags:
                less, whole, turned = open_tags.pop()
                small, unbroken, slanted = small - less, unbroken - whole, slanted - turned
        elif tag not in ("br", "img") and not attributes.endswith("/"):
            less, whole = tag in ("sub", "sup"), bool(_UNBROKEN.search(attributes))
            open_tags.append((less, whole, tag == "i"))
            small, unbroken, slanted = small + less, unbroken + whole, slanted + (tag == "i")


def _divided(text: str, room: float) -> float:
    """Width of the part of a word that goes on to the next line; 0 if none fits before."""
    found = next((m for m in _LETTERS.finditer(text) if len(m.group()) >= DIVIDED[0]), None)
    if found is None:
        return 0.0
    for place in reversed(_places(found.group())):
        at = found.start() + place
        if text_em(text[:at]) + text_em("-") <= room:
            return text_em(text[at:])
    return 0.0


@functools.lru_cache(maxsize=4096)
def _places(word: str) -> tuple[int, ...]:
    return tuple(_dictionary().positions(word))


@functools.cache
def _dictionary() -> Pyphen:
    from pyphen import Pyphen

    return Pyphen(lang="ru_RU", left=DIVIDED[1], right=DIVIDED[2])
