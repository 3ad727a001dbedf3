"""Which signs the STIX fonts of the report can show, and what stands for the others."""

from __future__ import annotations

import functools
import re
import unicodedata
from pathlib import Path

REPLACEMENT = "\u25a1"
# Signs that STIX lacks and a report needs; the raised ones only where no markup can stand.
_SUBSTITUTES = {"\u207b": "\u2212", "\u207a": "+", "\u2011": "-", "\u2015": "\u2014"}
_THIN = "\u2009\u202f\u2007\u200a"
# What nearly all texts consist of: the font is not opened for them.
USUAL = re.compile(r"[ -~А-Яа-яЁёΑ-ΡΣ-Ωα-ω«»–—…№°±²³·×−≈≤≥]*")
_DROPPED = {"Cc", "Cf", "Cs", "Co", "Cn"}


def fonts_dir() -> Path:
    """Folder of matplotlib's TrueType fonts."""
    import matplotlib

    return Path(matplotlib.get_data_path()) / "fonts" / "ttf"


@functools.cache
def coverage() -> frozenset[int]:
    """Code points that STIXGeneral in its regular face can show."""
    from matplotlib.ft2font import FT2Font

    return frozenset(FT2Font(str(fonts_dir() / "STIXGeneral.ttf")).get_charmap())


@functools.lru_cache(maxsize=4096)
def printable(text: str) -> str:
    """Make foreign text safe to print: no control characters, nothing the font lacks.

    Control, formatting and private characters go, thin spaces become no-break spaces, and
    what STIX cannot show (emoji, rare scripts) becomes □, so that neither the look nor the
    set of fonts depends on the machine.
    """
    if USUAL.fullmatch(text):
        return text
    return "".join(_printed(char) for char in unicodedata.normalize("NFC", text))


def unprintable(text: str) -> tuple[str, ...]:
    """The signs of a text that are printed as □, each once."""
    if USUAL.fullmatch(text):
        return ()
    signs = dict.fromkeys(unicodedata.normalize("NFC", text))
    return tuple(char for char in signs if char != REPLACEMENT and _printed(char) == REPLACEMENT)


def _printed(char: str) -> str:
    if char in _THIN:
        return "\u00a0"
    if char in _SUBSTITUTES:
        return _SUBSTITUTES[char]
    if char in "\n\t\u00ad":
        return char
    # A selector asks for the coloured picture of the sign before it and is no sign itself.
    if unicodedata.category(char) in _DROPPED or "\ufe00" <= char <= "\ufe0f":
        return ""
    return char if ord(char) in coverage() else REPLACEMENT
