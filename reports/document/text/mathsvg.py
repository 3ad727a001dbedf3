r"""Formulas: TeX set by matplotlib's mathtext, written as SVG on the baseline of the text.

mathtext rounds its metrics to whole pixels, so it sets the formula at a hundred times the
size and the result is scaled down.  Glyphs are written as text in the STIX faces, so the
formulas can be searched and copied and the file stays small.

Conventions of the TeX: Cyrillic indices as ``P_{\mathrm{г}}``, decimal comma as ``{,}``
(:func:`numbers.to_tex` writes it), ``\cdot 10^{-6}``, ``\,`` for a thin space; ``\tg``,
``\ctg``, ``\arctg`` are known here besides what mathtext knows.
"""

from __future__ import annotations

import functools
import logging
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from html import escape as escape_html
from typing import Any

from markupsafe import Markup

from reports.document.text.symbols import SIGNS, spoken
from reports.document.text.tex import (
    FRACTIONS,
    GREEK,
    BreakPoint,
    TexNode,
    break_points,
    case_lines,
    case_parts,
    for_mathtext,
    is_cases,
    steps,
    tree,
)
from reports.document.text.texts import pictured
from reports.shared.errors import FormulaImageError, TexError
from reports.shared.russian import MINUS, NBSP

_UNITS = 1000.0  # size at which mathtext sets the formula; one em of the result
_PAD = 0.04  # em added left and right: slanted letters reach out of their boxes
# Of a brace, in units of a formula's size: its width, the room before conditions and between
# the branches, the height of a relation sign above the baseline.
_BRACE, _BETWEEN, _LEADING, _AXIS = 450.0, 900.0, 350.0, 250.0
_PRIME, _SPACE = 0x2032, 0x20
_PRIME_DROP = 0.5
_PRIME_GROWTH = 1.25
_NO_SIGN = {r"\left", r"\right", r"\,", r"\;", r"\:", r"\!"}
_SILENT = {"mathrm", "text", "left", "right", "operatorname", "mathit", "displaystyle"}
_WORDS = {r"\sin", r"\cos", r"\tg", r"\min", r"\max", r"\arcsin", r"\arccos", r"\arctg"}
_SIGN = 0.56  # em that a sign takes on the average
_INVISIBLE = re.compile(r"\\(?:left|right)\.")
_ONE = re.compile(r"−?[\w.]+")  # an index or exponent that needs no brackets
_DECIMAL_POINT = re.compile(r"\d\.\d")


class _Collector(logging.Handler):
    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        line = record.getMessage()
        if line not in self.lines:
            self.lines.append(line)


@contextmanager
def complaints(name: str) -> Iterator[list[str]]:
    """Warnings of a logger, each once, while nothing of them reaches the screen."""
    logger, collector = logging.getLogger(name), _Collector()
    handlers, propagate = logger.handlers[:], logger.propagate
    logger.handlers[:], logger.propagate = [collector], False
    try:
        yield collector.lines
    finally:
        logger.handlers[:], logger.propagate = handlers, propagate


@dataclass(frozen=True, slots=True)
class FormulaImage:
    """A formula as an SVG element with its size in em of the surrounding text.

    ``height_em`` counts from the bottom of the box; ``depth_em`` is how far the box hangs
    below the baseline.  ``svg`` carries its own size and ``vertical-align``.
    """

    svg: str
    width_em: float
    height_em: float
    depth_em: float
    tex: str

    def __html__(self) -> str:
        """Let Jinja put the SVG in without a filter."""
        return self.svg

    @property
    def image(self) -> Markup:
        """The formula as a picture with its words, for paper."""
        return pictured(self.svg, spoken(self.tex))


@functools.lru_cache(maxsize=4096)
def formula(tex: str) -> FormulaImage:
    """Set one line of TeX (without dollar signs).

    Raises:
        FormulaError: mathtext does not understand the TeX; the message shows the place.
    """
    width, height, depth, glyphs, rects = _parse(tex)
    baseline = height - depth
    parts = [*_texts(glyphs, baseline), *_rules(rects, baseline)]
    return FormulaImage(*_svg(tex, width, height, depth, parts), tex)


def _svg(
    tex: str, width: float, height: float, depth: float, body: Iterable[str]
) -> tuple[str, float, float, float]:
    """SVG around what is drawn, with its width, height and depth [em]."""
    pad = _PAD * _UNITS
    width_em = (width + 2 * pad) / _UNITS
    height_em, depth_em = height / _UNITS, depth / _UNITS
    style = (
        f"width:{width_em:.3f}em;height:{height_em:.3f}em;vertical-align:{-depth_em:.3f}em;"
        f"margin:0 {-_PAD:.2f}em"
    )
    svg = (
        f'<svg class="tex" role="img" style="{style}" '
        f'viewBox="{-pad:g} 0 {width + 2 * pad:g} {height:g}">'
        f"<title>{escape_html(spoken(tex), quote=False)}</title>{''.join(body)}</svg>"
    )
    return svg, width_em, height_em, depth_em


def _cases(tex: str) -> FormulaImage:
    """Branches of a value, each with its condition, behind one brace."""
    lead, branches = case_parts(tex)
    cells = [[_parse(cell) for cell in branch] for branch in branches]
    column = max(branch[0][0] for branch in cells) + _BETWEEN
    name_width, _, _, *name = _parse(lead)
    left = name_width + _BRACE + 0.1 * _UNITS
    body, top = [], 0.0
    for branch in cells:
        up = max(height - depth for _, height, depth, *_ in branch)
        for x, (_, _, _, glyphs, rects) in zip((left, left + column), branch, strict=False):
            body.append(_moved(x, top, _texts(glyphs, up), _rules(rects, up)))
        top += up + max(depth for _, _, depth, *_ in branch) + _LEADING
    height = top - _LEADING
    baseline = height / 2 + _AXIS
    body.append(_moved(0.0, 0.0, _texts(name[0], baseline), _rules(name[1], baseline)))
    body.append(_brace(name_width, height))
    width = left + max(column + branch[-1][0] for branch in cells)
    return FormulaImage(*_svg(tex, width, height, height - baseline, body), tex)


def _moved(x: float, y: float, *parts: Iterable[str]) -> str:
    inner = "".join(piece for part in parts for piece in part)
    return f'<g transform="translate({x:.0f} {y:.0f})">{inner}</g>'


def _brace(x: float, height: float) -> str:
    """Return a brace as high as what stands behind it."""
    tip, spine, end = (x + share * _BRACE for share in (0.15, 0.55, 0.95))
    middle, bend = height / 2, 0.35 * _UNITS
    path = (
        f"M{end:.0f} 0Q{spine:.0f} 0 {spine:.0f} {bend:.0f}V{middle - bend:.0f}"
        f"Q{spine:.0f} {middle:.0f} {tip:.0f} {middle:.0f}"
        f"Q{spine:.0f} {middle:.0f} {spine:.0f} {middle + bend:.0f}V{height - bend:.0f}"
        f"Q{spine:.0f} {height:.0f} {end:.0f} {height:.0f}"
    )
    return f'<path d="{path}" fill="none" stroke="#000" stroke-width="50"/>'


@functools.lru_cache(maxsize=4096)
def formula_lines(tex: str, max_em: float = 28.0) -> tuple[FormulaImage, ...]:
    r"""Set a formula in as many lines as it needs to stay within a width.

    The break falls at a relation sign first, then at plus or minus, then at a product, all
    outside of brackets where possible; the sign is repeated at the start of the next line
    as the Russian standard asks (a product as ``\times``).  A fraction or a root that is wider
    than a line gets its parts named, and these follow in lines of their own.

    Args:
        tex: The formula; ``\\\\`` forces a new line.
        max_em: Room for one line, in em.

    Raises:
        FormulaError: The TeX is wrong.
    """
    lines: list[FormulaImage] = []
    if is_cases(tex):
        lines = [_cases(tex)]
        if lines[0].width_em > max_em:
            lines, tex = [], case_lines(tex)
    for forced in tex.split(r"\\") if not lines else ():
        lines.extend(_fit(forced.strip(), max_em))
    return tuple(lines)


def _fit(tex: str, max_em: float) -> list[FormulaImage]:
    broken = _broken(tex, max_em)
    if all(line.width_em <= max_em for line in broken):
        return broken
    for share in (0.8, 0.5, 0.3):  # of a line: what a part may take at most
        short, *parts = steps(tex, partial(_is_wide, share * max_em))
        lines = _broken(short, max_em)
        for number, part in enumerate(parts):
            lines += _fit(part if number else rf"\mathrm{{где}}\;\; {part}", max_em)
        if all(line.width_em <= max_em for line in lines):
            return lines
    return lines


def _is_wide(limit: float, nodes: Sequence[TexNode]) -> bool:
    return sum(map(_wide, nodes)) * _SIGN > limit


def _broken(tex: str, max_em: float) -> list[FormulaImage]:
    """Lines of a formula; one that cannot be broken stays wider."""
    # Setting a formula costs a millisecond a sign: lines are guessed by counting signs, and
    # the first guess that fits serves.
    whole: FormulaImage | None = None
    scale = _SIGN
    if _signs(tex) * scale <= 1.2 * max_em:
        whole = formula(tex)
        if whole.width_em <= max_em:
            return [whole]
        scale = whole.width_em / max(1, _signs(tex))

    def head(point: BreakPoint) -> str:
        return tex[: point.end] + point.closing

    def score(point: BreakPoint) -> float:
        # A full line is good, a break at a relation better than one within a sum, the
        # left side alone on a line is bad.
        filled = _signs(head(point)) * scale / max_em
        return min(filled, 1.0) - point.rank * 0.35 - (0.5 if filled < 0.25 else 0.0)

    points = break_points(tex)
    guesses = [p for p in points if _signs(head(p)) * scale <= 1.15 * max_em]
    for point in sorted(guesses, key=score, reverse=True):
        line = formula(head(point))
        if line.width_em <= max_em:
            return [line, *_broken(point.carried + tex[point.end :], max_em)]
    if points:  # the first piece is too wide, what follows may not be
        shortest = min(points, key=lambda point: point.end)
        tail = _broken(shortest.carried + tex[shortest.end :], max_em)
        return [formula(head(shortest)), *tail]
    return [whole or formula(tex)]


@functools.lru_cache(maxsize=8192)
def _signs(tex: str) -> int:
    """About how many signs a formula is wide; a line cut out of one may be unbalanced."""
    try:
        return sum(map(_wide, tree(tex)))
    except TexError:
        return len(tex)


def _wide(node: TexNode) -> int:
    """Signs of a node; of a fraction the wider part counts."""
    parts = [sum(map(_wide, part)) for part in node.parts]
    if node.token in FRACTIONS:
        return max(parts)
    silent = node.parts or node.token.isspace() or node.token in _NO_SIGN
    return sum(parts) + (0 if silent else 3 if node.token in _WORDS else 1)


def _parse(tex: str) -> tuple[float, float, float, Iterable[Any], Iterable[Any]]:
    from reports.document.text.mathtext import read

    try:
        source = "" if "$" in tex or _DECIMAL_POINT.search(tex) else for_mathtext(tex).strip()
    except TexError:
        source = ""
    if not source:
        msg = f"Формула пуста, содержит $, десятичную точку или непарные скобки: {tex!r}"
        raise FormulaImageError(msg)
    with complaints("matplotlib.mathtext") as lines:  # a sign without a glyph is no formula
        try:
            parsed = read(f"${source}$", _UNITS)
        except (ValueError, RuntimeError) as error:
            reason = str(error).strip().splitlines()[-1]
            msg = f"Формула не набирается: {tex!r}: {reason}"
            raise FormulaImageError(msg) from error
    if lines:
        msg = f"Формула не набирается: {tex!r}: {lines[0]}"
        raise FormulaImageError(msg)
    return parsed.width, parsed.height, parsed.depth, parsed.glyphs, parsed.rects


def _texts(glyphs: Iterable[Any], baseline: float) -> list[str]:
    return texts_of(map(_primed, glyphs), (0.0, baseline), _number)


def _primed(glyph: tuple[Any, ...]) -> tuple[Any, ...]:
    """STIX draws the prime raised already; as an index mathtext raises it once more."""
    font, size, code, *more, x, y = glyph
    if code == _PRIME and size < _UNITS:
        return font, _PRIME_GROWTH * size, code, *more, x, y - _PRIME_DROP * size
    return glyph


def texts_of(
    glyphs: Iterable[Any],
    origin: tuple[float, float],
    number: Callable[[float], str],
    *,
    inherited: str = "",
) -> list[str]:
    """One ``<text>`` for all glyphs of one face and size, each glyph with its own place.

    Few elements with many glyphs: HTML parsing, styles and drawing cost by the element.

    Args:
        glyphs: What mathtext has set.
        origin: Where the baseline begins.
        number: How numbers are written.
        inherited: Family of the type around, which need not be named.
    """
    runs: dict[tuple[str, str], list[tuple[str, str, str]]] = {}
    for font, size, code, *_, x, y in glyphs:
        family = font.family_name
        style = "" if family == inherited else f' font-family="{family}"'
        style += ' font-style="italic"' if "Italic" in font.style_name else ""
        style += ' font-weight="bold"' if "Bold" in font.style_name else ""
        char = NBSP if code == _SPACE else escape_html(chr(code))
        glyph = (number(origin[0] + x), number(origin[1] - y), char)
        runs.setdefault((style, number(size)), []).append(glyph)
    return [
        f'<text{style} font-size="{size}" x="{_list(run, 0)}" '
        f'y="{_list(run, 1)}">{"".join(char for _, _, char in run)}</text>'
        for (style, size), run in runs.items()
    ]


def _list(run: list[tuple[str, str, str]], part: int) -> str:
    """Places along one axis; one number serves when all glyphs share it."""
    corners = [corner[part] for corner in run]
    return corners[0] if len(set(corners)) == 1 else " ".join(corners)


def _rules(rects: Iterable[Any], baseline: float) -> list[str]:
    return [
        f'<rect x="{_number(x)}" y="{_number(baseline - y - h)}" '
        f'width="{_number(w)}" height="{_number(h)}"/>'
        for x, y, w, h in rects
    ]


def _number(value: float) -> str:
    return str(round(float(value)))


def plain(tex: str) -> str:
    """Return a formula on one line of signs."""
    if is_cases(tex):
        tex = case_lines(tex)
    tex = _INVISIBLE.sub("", tex.replace("{,}", ",").replace(r" \\", ";"))
    return re.sub(r"\s+", " ", "".join(map(_said, tree(tex)))).strip()


def _said(node: TexNode) -> str:
    parts = ["".join(map(_said, part)) for part in node.parts]
    if node.token in FRACTIONS:
        return f"({parts[0]})/({parts[1]})"
    if node.token == r"\sqrt":
        return f"√({parts[0]})"
    if node.command in _SILENT or node.token == "{":
        return "".join(parts)
    if node.token in ("_", "^") and len(parts[0]) > 1 and not _ONE.fullmatch(parts[0]):
        return f"{node.token}({parts[0]})"
    if node.token == "^" and parts[0] in ("°", "′"):
        return parts[0]
    sign = {"-": MINUS, r"\!": " "}.get(node.token) or SIGNS.get(node.command)
    sign = sign or GREEK.get(node.command) or (f"{node.command} " if node.command else node.token)
    return (" " if sign == NBSP else sign) + "".join(parts)
