"""The fonts that matplotlib carries, STIX and a second face: where they lie, CSS for them."""

from __future__ import annotations

import base64
import functools
from typing import TYPE_CHECKING

from reports.shared.signs import SECOND_FILE, fonts_dir

if TYPE_CHECKING:
    from matplotlib.ft2font import FT2Font

SCHEME = "kshm-font"
FAMILY = "STIXGeneral"
UPRIGHT = "STIXGeneralUpright"
SECOND = "DejaVuSecond"
STACK = f"{FAMILY}, {UPRIGHT}, {SECOND}"
OF_DRAWINGS = f"{FAMILY}, {SECOND}"

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
# Letters of names that STIX lacks; a browser and Word take them from the system's fonts.
_SECOND_FACES = (
    (SECOND, "normal", "normal", SECOND_FILE),
    (SECOND, "italic", "normal", "DejaVuSerif-Italic.ttf"),
    (SECOND, "normal", "bold", "DejaVuSerif-Bold.ttf"),
    (SECOND, "italic", "bold", "DejaVuSerif-BoldItalic.ttf"),
)
_FACES = _TEXT_FACES + _MATHS_FACES + _SECOND_FACES
_FILES = frozenset(face[3] for face in _FACES)


@functools.cache
def font_bytes(name: str) -> bytes:
    """Read one of the shipped files.

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
    rules = []
    for family, style, weight, name in _FACES:
        if embedded:
            if family in (UPRIGHT, SECOND):
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
def face(family: str, style: str = "normal", weight: str = "normal") -> FT2Font:
    """The font of a family, style and weight; the regular one where the family lacks it."""
    from matplotlib.ft2font import FT2Font

    files = {(name, *looks): file for name, *looks, file in _FACES}
    file = files.get((family, style, weight)) or files.get((family, "normal", "normal"))
    return FT2Font(str(fonts_dir() / (file or "STIXGeneral.ttf")))


@functools.cache
def advance(char: str, style: str = "normal", weight: str = "normal") -> float:
    """Width of a character of a face or of the second one [em]; half an em where both lack it."""
    from matplotlib.ft2font import LoadFlags

    font = face(FAMILY, style, weight)
    if ord(char) not in font.get_charmap():
        font = face(SECOND, style, weight)
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
