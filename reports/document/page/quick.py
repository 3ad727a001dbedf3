"""What WeasyPrint and pydyf do again and again, done once.

* A letter in a picture is laid out by pango three times wherever it stands; here once for each
  face and size.
* A path is taken apart number by number; one of straight lines alone is rewritten whole.
* Every element gets six styles for footnotes and list markers; here list items get one.
* The list of all pages is made anew for each tag.

These reach into the libraries, so they are done for the versions named here and for no
others; ``tests/document/test_page_quick.py`` compares the files byte for byte and asks for a new
look when another version is installed.  ``./run bench document`` says what it gains.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from copy import copy
from dataclasses import dataclass
from math import inf
from typing import Any

VERSIONS = ("70.0", "0.13.0")  # of WeasyPrint and pydyf

_UNUSUAL = {"dx", "dy", "rotate", "direction", "letter-spacing", "textLength", "lengthAdjust"}
_UNUSUAL |= {"dominant-baseline", "alignment-baseline", "display-anchor"}
_WEIGHTS = {"normal": 400, "bold": 700}
_LINES = re.compile(r"(?:[ML]-?\d+(?:\.\d\d?)? -?\d+(?:\.\d\d?)?)+z?")
_STEP = re.compile(r"([ML])([^MLz]+)(z?)")
_NOTES = re.compile(r"footnote|note-call|note\(|list-item|<summary")
_RARE = {"marker", "footnote-call", "footnote-marker", "note-call", "note-marker", "note-callback"}
_PSEUDO = 3  # place of the pseudo-element in an entry of a matcher
_OPERATOR = {"M": " m", "L": " l"}


@contextmanager
def setting(html: str) -> Iterator[None]:
    """Set a page quickly as long as this lasts."""
    import pydyf
    import weasyprint
    from weasyprint import svg
    from weasyprint.layout import absolute, block, column, grid, inline, page, percent, table
    from weasyprint.layout import float as floats

    rooms = (absolute, block, column, floats, grid, inline, page, table)
    if (weasyprint.__version__, pydyf.VERSION) != VERSIONS:
        yield
        return
    text, path = _text(svg.text), _path(svg.path)
    tags = {tag: text if known is svg.text else known for tag, known in svg.TAGS.items()}
    ours = (
        *((room, "resolve_percentages", _sizes(percent)) for room in rooms),
        (svg, "text", text),
        (svg, "TAGS", tags | {"path": path}),
        (pydyf.PDF, "page_references", property(_pages)),
        (weasyprint, "UA_STYLESHEET", _lean(weasyprint.UA_STYLESHEET, html)),
    )
    theirs = [(owner, name, getattr(owner, name)) for owner, name, _ in ours]
    try:
        for owner, name, value in ours:
            setattr(owner, name, value)
        yield
    finally:
        for owner, name, value in theirs:
            setattr(owner, name, value)


def _lean(sheet: Any, html: str) -> Any:  # noqa: ANN401
    """The browser's style sheet without six styles that each element gets for notes and lists."""
    if _NOTES.search(html):
        return sheet
    lean, matcher = copy(sheet), copy(sheet.matcher)
    universal = matcher.other_selectors
    of_lists = [entry for entry in universal if entry[_PSEUDO] == "marker"]
    matcher.other_selectors = [entry for entry in universal if entry[_PSEUDO] not in _RARE]
    by_name = matcher.lower_local_name_selectors
    matcher.lower_local_name_selectors = by_name | {"li": [*by_name.get("li", ()), *of_lists]}
    lean.matcher = matcher
    return lean


_SIDES = ("top", "right", "bottom", "left")
_BORDERS = tuple(f"border_{side}_width" for side in _SIDES)
_SIZES = (
    *(f"{kind}_{side}" for kind in ("margin", "padding") for side in _SIDES),
    *(f"{limit}{axis}" for limit in ("", "min_", "max_") for axis in ("width", "height")),
)


def _sizes(percent: Any) -> Callable[..., None]:  # noqa: ANN401
    """Lengths of a box, found once for a style within so wide and high a block."""
    known: dict[tuple[Any, ...], tuple[Any, dict[str, Any]]] = {}

    def resolve(box: Any, containing_block: Any) -> None:  # noqa: ANN401
        style, around = box.style, containing_block
        size = around if type(around) is tuple else (around.width, around.height)
        # Borders of cells that were settled with their neighbours' stay.
        settled = style["border_collapse"] == "collapse" and hasattr(box, _BORDERS[0])
        key = (id(style), *size, isinstance(box, percent.boxes.PageBox), settled)
        if key in known:
            box.__dict__.update(known[key][1])
            return
        percent.resolve_percentages(box, around)
        if style["box_sizing"] == "content-box":
            names = _SIZES if settled else _SIZES + _BORDERS
            # The style is kept, so that no other gets its number.
            known[key] = style, {name: box.__dict__[name] for name in names}

    return resolve


def _pages(pdf: Any) -> tuple[bytes, ...]:  # noqa: ANN401
    """References of the pages, made once for so many pages."""
    count = len(pdf.pages["Kids"])
    if getattr(pdf, "_kshm_pages", (0, ()))[0] != count:
        pdf._kshm_pages = count, tuple(b"%d 0 R" % n for n in pdf.pages["Kids"][::3])
    found: tuple[bytes, ...] = pdf._kshm_pages[1]
    return found


def _path(usual: Callable[..., None]) -> Callable[..., None]:
    """Draws a path of straight lines."""

    def path(svg: Any, node: Any, font_size: float) -> None:  # noqa: ANN401
        data = node.get("d", "")
        if not _LINES.fullmatch(data) or any(name.startswith("marker") for name in node.attrib):
            usual(svg, node, font_size)
            return
        svg.stream.move_to(0, 0)
        steps = (
            f"{place}{_OPERATOR[letter]}" + ("\nh" if end else "")
            for letter, place, end in _STEP.findall(data)
        )
        svg.stream.stream.append("\n".join(steps).encode())

    return path


@dataclass(slots=True)
class _Letter:
    """A letter of a face and size: its box, and how it is shown once it has been drawn."""

    layout: Any
    style: Any
    width: float
    height: float
    baseline: float
    font: tuple[str, float] = ("", 0.0)
    shown: bytes | None = None

    def draw(self, stream: Any, x: float, y: float) -> None:  # noqa: ANN401
        """Draw it on a stream: the first time by WeasyPrint."""
        from weasyprint.draw.text import draw_first_line
        from weasyprint.svg.text import Matrix, TextBox

        place = Matrix(d=-1, e=x, f=y)
        if self.shown:
            stream.set_text_matrix(*place.values)
            stream.set_font_size(*self.font)
            stream.stream.append(self.shown)
        elif self.shown is None:
            before = len(stream.stream)
            self.layout.reactivate(self.style)
            box = TextBox(self.layout, self.style)
            box.baseline = self.baseline
            draw_first_line(stream, box, "none", "none", place)
            made = stream.stream[before:]
            if not made or (len(made) <= 3 and made[-1].endswith(b"] TJ")):
                self.font, self.shown = stream._current_font, made[-1] if made else b""


def _text(usual: Callable[..., None]) -> Callable[..., None]:
    """Draws letters at their places."""
    from weasyprint.css.properties import INITIAL_VALUES
    from weasyprint.svg.bounding_box import extend_bounding_box
    from weasyprint.svg.text import Style
    from weasyprint.text.line_break import split_first_line

    known: dict[tuple[Any, ...], _Letter] = {}

    def letter_of(svg: Any, looks: tuple[str, str, int, float], sign: str) -> _Letter:  # noqa: ANN401
        if (*looks, sign) not in known:
            style = Style(INITIAL_VALUES)
            style.font_config = svg.font_config
            family, *rest = looks
            families = [name.strip("\"'") for name in family.split(",")]
            names = ("font_family", "font_style", "font_weight", "font_size")
            style.update(zip(names, (families, *rest), strict=True))
            layout, _, _, *box = split_first_line(sign, style, svg.context, inf, 0)
            known[(*looks, sign)] = _Letter(layout, style, *box)
        return known[(*looks, sign)]

    def text(svg: Any, node: Any, font_size: float) -> None:  # noqa: ANN401
        weight = node.get("font-weight", "400")
        try:
            weight = _WEIGHTS.get(weight) or int(weight)
            across, down = ([float(n) for n in node.get(axis, "").split()] for axis in "xy")
        except ValueError:
            weight = 0
        shifted = any(svg.cursor_d_position) or _UNUSUAL & node.attrib.keys()
        if not weight or not node.text or shifted:
            usual(svg, node, font_size)
            return
        family = node.get("font-family", "sans-serif")
        looks = (family, node.get("font-style", "normal"), weight, font_size)
        placed = []
        for number, sign in enumerate(node.text):
            letter = letter_of(svg, looks, sign)
            x = across[number] if number < len(across) else svg.cursor_position[0]
            y = down[number] if number < len(down) else svg.cursor_position[1]
            svg.cursor_position = x + letter.width, y
            top = y - letter.baseline
            corners = ((x, top), (x + letter.width, top + letter.height))
            node.text_bounding_box = extend_bounding_box(node.text_bounding_box, corners)
            placed.append((letter, x, y))
        svg.stream.push_state()
        fill, stroke = svg.set_graphical_state(node, font_size)
        svg.stream.begin_text()
        for letter, x, y in placed:
            svg.fill_stroke(fill, stroke, text=True)
            letter.draw(svg.stream, x, y)
        svg.stream.end_text()
        svg.stream.pop_state()

    return text
