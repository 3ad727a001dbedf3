"""The STIX fonts that matplotlib carries: where they lie, what they cover, CSS for them."""

from __future__ import annotations

import base64
import functools
import unicodedata
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.ft2font import FT2Font

SCHEME = "kshm-font"
FAMILY = "STIXGeneral"
UPRIGHT = "STIXGeneralUpright"
STACK = f"{FAMILY}, {UPRIGHT}"
REPLACEMENT = "\u25a1"

# family, style, weight, file.  UPRIGHT serves the signs that the slanted and bold
# faces lack (≈ ≤ √ ∑ …) from the regular face, so that no system font is ever asked.
_TEXT_FACES = (
    (FAMILY, "normal", "normal", "STIXGeneral.ttf"),
    (FAMILY, "italic", "normal", "STIXGeneralItalic.ttf"),
    (FAMILY, "normal", "bold", "STIXGeneralBol.ttf"),
    (FAMILY, "italic", "bold", "STIXGeneralBolIta.ttf"),
    (UPRIGHT, "normal", "normal", "STIXGeneral.ttf"),
    (UPRIGHT, "italic", "normal", "STIXGeneral.ttf"),
    (UPRIGHT, "normal", "bold", "STIXGeneral.ttf"),
    (UPRIGHT, "italic", "bold", "STIXGeneral.ttf"),
)
_MATHS_FACES = (
    ("STIXNonUnicode", "normal", "normal", "STIXNonUni.ttf"),
    ("STIXNonUnicode", "italic", "normal", "STIXNonUniIta.ttf"),
    ("STIXSizeOneSym", "normal", "normal", "STIXSizOneSymReg.ttf"),
    ("STIXSizeTwoSym", "normal", "normal", "STIXSizTwoSymReg.ttf"),
    ("STIXSizeThreeSym", "normal", "normal", "STIXSizThreeSymReg.ttf"),
    ("STIXSizeFourSym", "normal", "normal", "STIXSizFourSymReg.ttf"),
    ("STIXSizeFiveSym", "normal", "normal", "STIXSizFiveSymReg.ttf"),
)
_FILES = frozenset(face[3] for face in _TEXT_FACES + _MATHS_FACES)

# Signs that STIX lacks and a report needs; the raised ones only where no markup can stand.
_SUBSTITUTES = {"\u207b": "\u2212", "\u207a": "+", "\u2011": "-", "\u2015": "\u2014"}


def fonts_dir() -> Path:
    """Folder of matplotlib's TrueType fonts."""
    import matplotlib

    return Path(matplotlib.get_data_path()) / "fonts" / "ttf"


@functools.cache
def font_bytes(name: str) -> bytes:
    """Read one of the shipped STIX files.

    Raises:
        ValueError: The name is not one of the files used here.
    """
    if name not in _FILES:
        msg = f"Шрифт не входит в набор отчёта: {name}"
        raise ValueError(msg)
    return (fonts_dir() / name).read_bytes()


@functools.cache
def fonts_css(*, embedded: bool = False) -> str:
    """CSS with the ``@font-face`` rules of the report.

    Args:
        embedded: False writes ``kshm-font:`` addresses that only our renderer serves, so
            that the HTML is the same on every machine.  True embeds the text faces as
            ``data:`` for a page that a browser opens.
    """
    faces = _TEXT_FACES + _MATHS_FACES
    rules = []
    for family, style, weight, name in faces:
        if embedded:
            if family == UPRIGHT:
                continue
            data = base64.b64encode(font_bytes(name)).decode("ascii")
            source = f"data:font/ttf;base64,{data}"
        else:
            source = f"{SCHEME}:{name}"
        rules.append(
            f"@font-face{{font-family:{family};font-style:{style};font-weight:{weight};"
            f'src:url("{source}") format("truetype")}}'
        )
    return "\n".join(rules)


@functools.cache
def coverage() -> frozenset[int]:
    """Code points that STIXGeneral in its regular face can show."""
    return frozenset(_regular().get_charmap())


@functools.cache
def face(family: str, style: str = "normal", weight: str = "normal") -> FT2Font:
    """The font of a family, style and weight; the regular one where the family lacks it."""
    from matplotlib.ft2font import FT2Font

    files = {(name, *looks): file for name, *looks, file in _TEXT_FACES + _MATHS_FACES}
    file = files.get((family, style, weight)) or files.get((family, "normal", "normal"))
    return FT2Font(str(fonts_dir() / (file or "STIXGeneral.ttf")))


def _regular() -> FT2Font:
    return face(FAMILY)


@functools.cache
def advance(char: str, style: str = "normal", weight: str = "normal") -> float:
    """Width of a character of a face [em]; half an em where it lacks it."""
    from matplotlib.ft2font import LoadFlags

    font = face(FAMILY, style, weight)
    if ord(char) not in font.get_charmap():
        return 0.5
    glyph = font.load_char(ord(char), flags=LoadFlags.NO_SCALE)
    return float(glyph.horiAdvance) / float(font.units_per_EM)


def text_em(text: str, *, slanted: bool = False, bold: bool = False) -> float:
    """Width of a line of plain text in a face [em], without kerning."""
    if not (slanted or bold):
        return sum(map(advance, text))
    look = ("italic" if slanted else "normal", "bold" if bold else "normal")
    return sum(advance(char, *look) for char in text)


@functools.lru_cache(maxsize=4096)
def printable(text: str) -> str:
    """Make foreign text safe to print: no control characters, nothing the font lacks.

    Control, formatting and private characters go, thin spaces become no-break spaces, and
    what STIX cannot show (emoji, rare scripts) becomes □, so that neither the look nor the
    set of fonts depends on the machine.
    """
    if text.isascii() and text.isprintable():
        return text
    shown = coverage()
    result = []
    for char in unicodedata.normalize("NFC", text):
        if char in "\u2009\u202f\u2007\u200a":
            result.append("\u00a0")
        elif char in _SUBSTITUTES:
            result.append(_SUBSTITUTES[char])
        elif char in "\n\t" or char == "\u00ad":
            result.append(char)
        elif char == "\r" or unicodedata.category(char) in {"Cc", "Cf", "Cs", "Co", "Cn"}:
            continue
        else:
            result.append(char if ord(char) in shown else REPLACEMENT)
    return "".join(result)
