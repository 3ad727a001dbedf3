"""Which signs the fonts of the report can show, and what stands for the others."""

from __future__ import annotations

import functools
import re
import unicodedata
from pathlib import Path

REPLACEMENT = "\u25a1"
SECOND_FILE = "DejaVuSerif.ttf"  # has the letters of Russia's and its neighbours' languages
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


@functools.cache
def second_coverage() -> frozenset[int]:
    """Letters of names that STIX lacks and DejaVu Serif, the second face on paper, has."""
    from matplotlib.ft2font import FT2Font

    codes = FT2Font(str(fonts_dir() / SECOND_FILE)).get_charmap()
    return frozenset(code for code in codes if _is_letter(chr(code))) - coverage()


@functools.lru_cache(maxsize=4096)
def printable(text: str) -> str:
    """Make foreign text safe to print: no control characters, nothing both faces lack.

    Control, formatting and private characters go, thin spaces become no-break spaces, and
    what no face can show (emoji, rare scripts) becomes □, so that neither the look nor the
    set of fonts depends on the machine.
    """
    return boxed(cleaned(text))


@functools.lru_cache(maxsize=4096)
def cleaned(text: str) -> str:
    """Return same with all letters kept: on a screen and in Word the system's fonts have them."""
    if USUAL.fullmatch(text):
        return text
    return "".join(_printed(char) for char in unicodedata.normalize("NFC", text))


def boxed(text: str) -> str:
    """Return a text or a whole page with □ for the letters that no face on paper has."""
    return _foreign().sub(lambda met: REPLACEMENT if _is_letter(met[0]) else met[0], text)


@functools.cache
def _foreign() -> re.Pattern[str]:
    """Any sign that neither face has."""
    covered = sorted(coverage() | second_coverage())
    ranges: list[list[int]] = []
    for code in covered:
        if ranges and ranges[-1][1] == code - 1:
            ranges[-1][1] = code
        else:
            ranges.append([code, code])
    inside = "".join(f"\\U{low:08x}-\\U{high:08x}" for low, high in ranges)
    return re.compile(f"[^\\x00-\\x7f{inside}]")


def _is_letter(char: str) -> bool:
    return unicodedata.category(char)[0] in "LM"


def unprintable(text: str) -> tuple[str, ...]:
    """Return the signs of a text that are printed as □, each once."""
    if USUAL.fullmatch(text):
        return ()
    signs = dict.fromkeys(unicodedata.normalize("NFC", text))
    return tuple(char for char in signs if char != REPLACEMENT and REPLACEMENT in printable(char))


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
    return char if ord(char) in coverage() or _is_letter(char) else REPLACEMENT
