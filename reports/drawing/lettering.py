"""How wide letters are: slanted STIX, which matplotlib carries and the PDF sets.

A word after a stroke below is an index: «l_1 = 32».
"""

from __future__ import annotations

import functools
import re
from typing import TYPE_CHECKING

from reports.shared.signs import fonts_dir

if TYPE_CHECKING:
    from matplotlib.ft2font import FT2Font

CAPITAL = 0.662  # height of a capital of the face [em]
WIDER = 1.04  # a drawing program may set another face
INDEX = 0.7  # size of an index
_SPACE, _ANYWHERE = re.compile("(?<= )"), re.compile(r"(?<= )|(?<=\w-)(?=\w)")  # ends of lines
_INDEX = re.compile(r"_([^\W_][\w.]*)")


@functools.cache
def _font(file: str) -> FT2Font:
    from matplotlib.ft2font import FT2Font

    return FT2Font(str(fonts_dir() / file))


@functools.cache
def _advance(char: str) -> float:
    """Width of a letter [em]; three quarters of one for a letter that no face has."""
    from matplotlib.ft2font import LoadFlags

    for font in map(_font, ("STIXGeneralItalic.ttf", "DejaVuSerif-Italic.ttf")):
        if ord(char) in font.get_charmap():
            glyph = font.load_char(ord(char), flags=LoadFlags.NO_SCALE)
            return float(glyph.horiAdvance) / float(font.units_per_EM)
    return 0.75


def width_of(text: str, height: float) -> float:
    """Length of a line by the height of its capitals [mm]."""
    parts = enumerate(_INDEX.split(text))
    ems = sum(sum(map(_advance, part)) * (INDEX if place % 2 else 1.0) for place, part in parts)
    return WIDER * ems * height / CAPITAL


def parts_of(text: str) -> list[tuple[str, bool]]:
    """The text in parts and whether each is an index."""
    parts = enumerate(_INDEX.split(text))
    return [(part, place % 2 == 1) for place, part in parts if part]


def plain(text: str) -> str:
    """The text in one line, where an index cannot stand lower."""
    return _INDEX.sub(r"\1", text)


def fitted(text: str, room: float, height: float, least: float = 1.8) -> float:
    """Height of the letters at which a line fits its room [mm]."""
    wide = width_of(text, height)
    return height if wide <= room else max(least, height * room / wide)


def wrapped(text: str, room: float, height: float, *, hyphens: bool = False) -> list[str]:
    """A text in lines that fit a room; a word that is too long stays whole.

    With ``hyphens`` a line may end after the hyphen of a double name.
    """
    lines: list[str] = []
    for piece in (_ANYWHERE if hyphens else _SPACE).split(text):
        longer = lines[-1] + piece if lines else piece
        if lines and width_of(longer.rstrip(), height) <= room:
            lines[-1] = longer
        else:
            lines.append(piece)
    return [line.rstrip() for line in lines]
