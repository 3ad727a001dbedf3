"""Fonts of report and drawings, STIX and a second face: files, CSS, measure of a text.

A word after a stroke below is an index of a drawing: «l_1 = 32».
"""

from __future__ import annotations

import base64
import cmath
import functools
import math
import re
from typing import TYPE_CHECKING

from reports.shared.font_coverage import SECOND_FILE, fonts_dir
from reports.shared.resources import templates_dir

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
ASCENT, DESCENT = 0.75, 0.25  # of the type: the least that a line takes in STIX
_SCALE = 100.0  # pt at which texts are measured
CAPITAL = 0.662  # height of a capital of the face [em]
WIDER = 1.04  # a drawing program may set another face
INDEX = 0.7  # size of an index: the next smaller height of ГОСТ 2.304
HEIGHTS = (1.8, 2.5, 3.5, 5.0, 7.0, 10.0, 14.0, 20.0, 28.0, 40.0)  # of letters, ГОСТ 2.304 [mm]
SLANT = 15.0  # of the letters from the vertical [deg]
STROKE = 0.1  # width of a line of type Б over the height of the letters
_UNITS = 9.0  # of the stroke face in the height of a capital
_GAP, _BLANK = 2.7, 5.4  # between letters and between words [units of the face]
_FLAT = 12.0  # deg of an arc that one straight stroke stands for
_SPACE, _ANYWHERE = re.compile("(?<= )"), re.compile(r"(?<= )|(?<=\w\w-)(?=\w\w)")  # ends of lines
_INDEX = re.compile(r"_([^\W_][\w.]*)")
_LACKING = 0.75  # em: a letter of a drawing that no face has
_STROKE_FILES = ("gost-b.lff", "kazakh.lff")
Strokes = tuple[tuple[tuple[float, float], ...], ...]


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
    """Return the font of a family, style and weight; the regular one where the family lacks it."""
    from matplotlib.ft2font import FT2Font

    files = {(name, *looks): file for name, *looks, file in _FACES}
    file = files.get((family, style, weight)) or files.get((family, "normal", "normal"))
    return FT2Font(str(fonts_dir() / (file or "STIXGeneral.ttf")))


def face_with(
    char: str, style: str = "normal", weight: str = "normal", family: str = FAMILY
) -> FT2Font | None:
    """Return the font of a family, or the second one, that has a character."""
    fonts = (face(name, style, weight) for name in (family, SECOND))
    return next((font for font in fonts if ord(char) in font.get_charmap()), None)


@functools.cache
def advance(
    char: str, style: str = "normal", weight: str = "normal", lacking: float = 0.5
) -> float:
    """Width of a character of a face or of the second one [em], ``lacking`` where both lack it."""
    from matplotlib.ft2font import LoadFlags

    font = face_with(char, style, weight)
    if font is None:
        return lacking
    glyph = font.load_char(ord(char), flags=LoadFlags.NO_SCALE)
    return float(glyph.horiAdvance) / float(font.units_per_EM)


def text_em(text: str, *, slanted: bool = False, bold: bool = False) -> float:
    """Width of a line of plain text in a face [em], without kerning."""
    if not (slanted or bold):
        return sum(map(advance, text))
    look = ("italic" if slanted else "normal", "bold" if bold else "normal")
    return sum(advance(char, *look) for char in text)


@functools.lru_cache(maxsize=2048)
def text_box(text: str) -> tuple[float, float, float]:
    """Width, height and depth of a line of upright text [em], with kerning."""
    from matplotlib.ft2font import LoadFlags

    font = face(FAMILY)
    if not font.get_charmap().keys() >= set(map(ord, text)):
        return text_em(text), ASCENT + DESCENT, DESCENT
    font.set_size(_SCALE, 72)
    font.set_text(text, 0.0, flags=LoadFlags.NO_HINTING)
    width, height = font.get_width_height()
    unit = 64 * _SCALE
    return width / unit, height / unit, font.get_descent() / unit


@functools.cache
def glyphs() -> dict[str, Strokes]:
    """Strokes of every letter of the face of ГОСТ 2.304, type Б, in its units, upright."""
    letters: dict[str, Strokes] = {}
    folder = templates_dir() / "fonts"
    text = "\n".join((folder / name).read_text(encoding="utf-8") for name in _STROKE_FILES)
    for block in text.split("\n[")[1:]:
        head, _, body = block.partition("\n")
        strokes: list[tuple[tuple[float, float], ...]] = []
        for line in body.splitlines():
            if line.startswith("C"):  # the strokes of another letter
                strokes += letters.get(chr(int(line[1:5], 16)), ())
            elif ";" in line:
                strokes.append(_stroke(line))
        letters[chr(int(head[:4], 16))] = tuple(strokes)
    return letters


def _stroke(line: str) -> tuple[tuple[float, float], ...]:
    """Points of a stroke; a third number of a point is the bulge of the arc that ends there."""
    points: list[tuple[float, float]] = []
    for item in line.split(";"):
        x, y, *bulge = item.split(",")
        end = float(x), float(y)
        if bulge and points:
            points += _arc(points[-1], end, float(bulge[0].removeprefix("A")))
        points.append(end)
    return tuple(points)


def _arc(
    start: tuple[float, float], end: tuple[float, float], bulge: float
) -> list[tuple[float, float]]:
    """Points between the ends of an arc whose bulge is the tangent of a quarter of its angle."""
    turn = 4 * math.atan(bulge)
    chord = complex(*end) - complex(*start)
    centre = complex(*start) + chord / 2 * (1 + 1j / math.tan(turn / 2))
    count = max(int(abs(math.degrees(turn)) / _FLAT), 1)
    away = complex(*start) - centre
    points = (centre + away * cmath.exp(1j * turn * n / count) for n in range(1, count))
    return [(point.real, point.imag) for point in points]


def stroke_advance(char: str) -> float:
    """Width of a letter of the stroke face with the gap after it [units]."""
    if char.isspace():
        return _BLANK
    strokes = glyphs().get(char)
    if strokes is None:  # of a name: it is drawn in a face of the report
        return advance(char, "italic", "normal", _LACKING) * _UNITS / CAPITAL
    return max((x for stroke in strokes for x, _ in stroke), default=0.0) + _GAP


def strokes_of(text: str, height: float) -> list[tuple[tuple[float, float], ...]]:
    """Slanted strokes of a line of text from its left end on the base line [mm]."""
    scale, lean, left = height / _UNITS, math.tan(math.radians(SLANT)), 0.0
    strokes = []
    for char in text:
        for stroke in glyphs().get(char, ()):
            strokes.append(tuple((scale * (left + x + lean * y), scale * y) for x, y in stroke))
        left += stroke_advance(char)
    return strokes


def is_drawn(text: str) -> bool:
    """Whether the stroke face has all letters of a text."""
    return all(char.isspace() or char in glyphs() for char in text)


def width_of(text: str, height: float) -> float:
    """Length of a line by the height of its capitals [mm]."""
    parts = enumerate(_INDEX.split(text))
    units = sum(
        sum(map(stroke_advance, part)) * (index_height(height) if number % 2 else height)
        for number, part in parts
    )
    return WIDER * units / _UNITS


def index_height(height: float) -> float:
    """Height of an index: the next smaller one of ГОСТ 2.304, else in proportion [mm]."""
    if height not in HEIGHTS:
        return INDEX * height
    return HEIGHTS[max(HEIGHTS.index(height) - 1, 0)]


def larger(height: float) -> float:
    """Height of a title over letters: the next larger one of ГОСТ 2.304, else in proportion."""
    if height not in HEIGHTS:
        return height / INDEX
    return HEIGHTS[min(HEIGHTS.index(height) + 1, len(HEIGHTS) - 1)]


def standard(height: float) -> float:
    """Return the largest height of ГОСТ 2.304 that is no larger; the least one at last [mm]."""
    return max((one for one in HEIGHTS if one <= height + 1e-9), default=HEIGHTS[0])


def parts_of(text: str) -> list[tuple[str, bool]]:
    """Return the text in parts and whether each is an index."""
    parts = enumerate(_INDEX.split(text))
    return [(part, number % 2 == 1) for number, part in parts if part]


def plain(text: str) -> str:
    """Return the text in one line, where an index cannot stand lower."""
    return _INDEX.sub(r"\1", text)


def fitted(text: str, room: float, height: float, least: float = 1.8) -> float:
    """Height of the letters at which a line fits its room [mm]."""
    wide = width_of(text, height)
    return standard(height if wide <= room else max(least, height * room / wide))


def wrapped(text: str, room: float, height: float, *, hyphens: bool = False) -> list[str]:
    """Return a text in lines that fit a room; a word that is too long stays whole.

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
