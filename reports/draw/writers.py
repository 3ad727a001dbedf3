"""A drawing as SVG in millimetres and as DXF (R2010): layers by name, real text."""

from __future__ import annotations

import io
import math
from collections import OrderedDict
from collections.abc import Iterable, Sequence
from dataclasses import replace
from html import escape

from reports.draw.canvas import (
    LAYERS,
    SIZE,
    Box,
    Circle,
    Dash,
    Dimension,
    Item,
    Line,
    Words,
    bounds,
)
from reports.draw.fonts import (
    CAPITAL,
    OF_DRAWINGS,
    SLANT,
    STROKE,
    WIDER,
    index_height,
    is_drawn,
    parts_of,
    plain,
    strokes_of,
    width_of,
)

_SVG_GREY = "#9a9a9a"
PT_PER_MM = 72 / 25.4
# LibreCAD takes the face that is called as the style, other programs the file of the style.
STYLE = "lc_opengost-br"
DIMSTYLE = "GOST_2_307"
_FONT = "isocpeur.ttf"  # of AutoCAD and its kin, with Cyrillic
_BLACK, _DXF_GREY = 7, 8
_PLINEGEN = 128  # a pattern runs on over the corners: the pieces of a curve are shorter than it
# Names that drawing programs know, by the kind of the pattern.
_KNOWN = {2: "DASHED2", 4: "CENTER2"}
_SHORT = 3.0  # mm: shorter dashes are dots
_DIVIDE = 8.0  # mm: the first dash of the fifth pattern


def svg_of(items: Sequence[Item], box: Box, *, shown_mm: float | None = None) -> str:
    """Return the items within a box of the sheet.

    Args:
        items: what is drawn.
        box: what of the sheet is shown [mm].
        shown_mm: width on paper, by default true to size [mm].
    """
    left, low, right, high = box
    wide, tall = right - left, high - low
    body = "".join(_runs(items, left, high))
    size = (PT_PER_MM * wide, PT_PER_MM * tall)
    return svg_element(body, f"{wide:.2f} {tall:.2f}", size, shown_mm or wide)


def svg_element(body: str, extent: str, size: tuple[float, float], width_mm: float) -> str:
    """Return a figure of a page as one element.

    Args:
        body: its elements.
        extent: width and height in their units.
        size: width and height true to size [pt].
        width_mm: width on paper [mm].
    """
    return (
        f'<svg class="fig" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {extent}" '
        f'style="width:{width_mm:.1f}mm" data-size="{size[0]:.4g}/{size[1]:.4g}" '
        f'font-family="{OF_DRAWINGS}" stroke-linejoin="round">{body}</svg>'
    )


def _runs(items: Iterable[Item], left: float, high: float) -> Iterable[str]:
    """Items as elements; lines of equal looks follow one another in one path."""
    paths: dict[str, list[str]] = {}
    remaining: list[str] = []
    for item in items:
        if isinstance(item, Words):
            remaining.append(_words(item, left, high))
            continue
        if isinstance(item, Dimension):
            continue
        layer = item.layer
        colour = _SVG_GREY if layer.grey else "#000000"
        dash = (item.dash if isinstance(item, Line) else ()) or layer.dash
        dashes = f' stroke-dasharray="{" ".join(f"{d:g}" for d in dash)}"' if dash else ""
        looks = (
            f' fill="{colour if item.filled else "none"}" stroke="{colour}" '
            f'stroke-width="{layer.width:g}"{dashes}'
        )
        paths.setdefault(looks, []).append(_path(item, left, high))
    yield from (f'<path d="{"".join(parts)}"{looks}/>' for looks, parts in paths.items())
    yield from remaining


def _path(item: Line | Circle, left: float, high: float) -> str:
    if isinstance(item, Circle):
        (x, y), r = item.centre, item.radius
        x, y = x - left, high - y
        return (
            f"M{x - r:.3f} {y:.3f}A{r:.3f} {r:.3f} 0 1 0 {x + r:.3f} {y:.3f}"
            f"A{r:.3f} {r:.3f} 0 1 0 {x - r:.3f} {y:.3f}Z"
        )
    points = "L".join(f"{x - left:.3f} {high - y:.3f}" for x, y in item.points)
    return f"M{points}{'Z' if item.closed else ''}"


def _words(item: Words, left: float, high: float) -> str:
    return "".join(_svg_text(part, left, high) for part in parts_placed(item))


def parts_placed(item: Words) -> Iterable[Words]:
    """Yield a line of text in parts that stand one after another, indices lower and smaller."""
    parts = parts_of(item.text)
    if len(parts) == 1:
        yield replace(item, text=parts[0][0])
        return
    run = -item.align * item.width / WIDER
    for text, index in parts:
        height = index_height(item.height) if index else item.height
        along, down = run, -0.3 * item.height if index else 0.0
        turn = math.radians(item.angle)
        x = item.place[0] + along * math.cos(turn) - down * math.sin(turn)
        y = item.place[1] + along * math.sin(turn) + down * math.cos(turn)
        yield replace(item, place=(x, y), text=text, height=height, align=0.0)
        run += width_of(text, height) / WIDER


def _svg_text(item: Words, left: float, high: float) -> str:
    if is_drawn(item.text):
        # What is drawn in strokes is searched and copied by the unseen letters over it.
        return _svg_strokes(item, left, high) + _svg_letters(item, left, high, ' fill-opacity="0"')
    return _svg_letters(item, left, high)


def _svg_letters(item: Words, left: float, high: float, look: str = "") -> str:
    x, y = item.place[0] - left, high - item.place[1]
    anchor = {0.0: "start", 0.5: "middle", 1.0: "end"}[item.align]
    turn = f' transform="rotate({-item.angle:g} {x:.2f} {y:.2f})"' if item.angle else ""
    return (
        f'<text x="{x:.2f}" y="{y:.2f}" font-style="italic" font-size="{item.height / CAPITAL:.2f}"'
        f' text-anchor="{anchor}"{look}{turn} xml:space="preserve">{escape(item.text)}</text>'
    )


def _svg_strokes(item: Words, left: float, high: float) -> str:
    """Return a line of text in strokes of one width, turned about its place."""
    turn, start = math.radians(item.angle), -item.align * item.width / WIDER
    cos, sin = math.cos(turn), math.sin(turn)
    parts = []
    for stroke in strokes_of(item.text, item.height):
        points = (
            (
                item.place[0] + (start + x) * cos - y * sin - left,
                high - item.place[1] - (start + x) * sin - y * cos,
            )
            for x, y in stroke
        )
        parts.append("M" + "L".join(f"{x:.2f} {y:.2f}" for x, y in points))
    return (
        f'<path d="{"".join(parts)}" fill="none" stroke="#000000" stroke-linecap="round" '
        f'stroke-width="{STROKE * item.height:.2f}"/>'
    )


def dxf_bytes(items: Iterable[Item], dashes: float = 1.0) -> bytes:
    """Return the drawing as a DXF file; the same items give the same bytes.

    Args:
        items: The drawing, in millimetres of the thing where it is drawn true to size.
        dashes: How much longer the dashes of lines are than on paper.
    """
    import ezdxf
    from ezdxf import units
    from ezdxf.enums import TextEntityAlignment

    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True  # no clock, no new identifiers
    try:
        document = ezdxf.new("R2010", setup=False, units=units.MM)
        document.header["$MEASUREMENT"] = 1
        document.header["$LWDISPLAY"] = 1
        document.header["$LTSCALE"] = dashes
        document.styles.add(STYLE, font=_FONT).dxf.oblique = SLANT
        document.dimstyles.add(DIMSTYLE)
        for layer in LAYERS:
            entry = document.layers.add(layer.name, color=_DXF_GREY if layer.grey else _BLACK)
            entry.dxf.lineweight = round(100 * layer.width)
            entry.dxf.linetype = _linetype(document, layer.dash)
        space = document.modelspace()
        aligns = {0.0: TextEntityAlignment.LEFT, 0.5: TextEntityAlignment.CENTER,
                  1.0: TextEntityAlignment.RIGHT}  # fmt: skip
        drawn = list(items)
        for item in drawn:
            looks: dict[str, object] = {"layer": item.layer.name}
            if isinstance(item, Line | Words) and item.name == SIZE:
                continue  # of a dimension, which is an entity of its own
            if isinstance(item, Dimension):
                _dxf_dimension(space, item, looks)
            elif isinstance(item, Line):
                looks |= _dashes(document, item)
                space.add_lwpolyline(item.points, close=item.closed, dxfattribs=looks)
            elif isinstance(item, Circle):
                space.add_circle(item.centre, item.radius, dxfattribs=looks)
            else:
                parts = list(parts_placed(item))
                for part in parts:
                    align = aligns[part.align if len(parts) == 1 else 0.0]
                    _dxf_text(space, part, align, looks)
            if isinstance(item, Line | Circle) and item.filled:
                _dxf_fill(space, item)
        left, low, right, high = bounds(drawn)
        corners = (left, low, 0), (right, high, 0)
        space.reset_extents(*corners)
        # What begins at the origin is not carried over to the header by writing.
        document.header["$EXTMIN"], document.header["$EXTMAX"] = corners
        space.reset_limits((left, low), (right, high))
        centre = ((left + right) / 2, (low + high) / 2)
        document.set_modelspace_vport(1.05 * (high - low), centre)  # the whole of it is seen
        document.classes.add_required_classes(document.dxfversion)  # in the order of a set
        document.classes.classes = OrderedDict(sorted(document.classes.classes.items()))
        stream = io.StringIO()
        document.write(stream)
        return stream.getvalue().encode(document.output_encoding, "dxfreplace")
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


def _dashes(document: object, item: Line) -> dict[str, object]:
    """Attributes of a dashed polyline."""
    if not (item.dash or item.layer.dash):
        return {}
    attributes = {"linetype": _linetype(document, item.dash)} if item.dash else {}
    return {"flags": _PLINEGEN, **attributes}


def _dxf_fill(space: object, item: Line | Circle) -> None:
    """Draw the black inside of a closed line or of a circle."""
    looks = {"layer": item.layer.name}
    hatch = space.add_hatch(color=_BLACK, dxfattribs=looks)  # type: ignore[attr-defined]
    if isinstance(item, Circle):
        hatch.paths.add_edge_path().add_arc(item.centre, item.radius, 0, 360)
    else:
        hatch.paths.add_polyline_path(item.points, is_closed=True)


def _dxf_dimension(space: object, item: Dimension, looks: dict[str, object]) -> None:
    """Draw a dimension by ГОСТ 2.307 with its words where the drawing has them."""
    turn = math.degrees(math.atan2(item.end[1] - item.start[1], item.end[0] - item.start[0]))
    head = min(item.height, math.dist(item.start, item.end) / 3)
    manner = {
        "dimtxsty": STYLE, "dimtxt": item.height, "dimasz": head, "dimblk": "",
        "dimexo": 0.0, "dimexe": 0.0, "dimse1": 1, "dimse2": 1, "dimtmove": 2,
    }  # fmt: skip
    dimension = space.add_linear_dim(  # type: ignore[attr-defined]
        base=item.start, p1=item.start, p2=item.end, angle=turn, text=plain(item.text),
        location=item.middle, dimstyle=DIMSTYLE, override=manner, dxfattribs=looks,
    )  # fmt: skip
    dimension.render()


def _dxf_text(space: object, item: Words, align: object, looks: dict[str, object]) -> None:
    text = space.add_text(  # type: ignore[attr-defined]
        item.text, height=item.height, rotation=item.angle,
        dxfattribs={**looks, "style": STYLE, "oblique": SLANT},
    )  # fmt: skip
    text.set_placement(item.place, align=align)


def _type_name(dash: Dash) -> str:
    name = "DOT2" if len(dash) == 2 and dash[0] < _SHORT else _KNOWN[len(dash)]
    return name if max(dash[::2]) != _DIVIDE else "DIVIDE2"


def _linetype(document: object, dash: Dash) -> str:
    """Name of a pattern of dashes, made where it is not there yet."""
    if not dash:
        return "Continuous"
    name = _type_name(dash)
    types = document.linetypes  # type: ignore[attr-defined]
    if name not in types:
        pattern = [sum(dash), *(p if n % 2 == 0 else -p for n, p in enumerate(dash))]
        types.add(name, pattern, description=f"штрихи {name} мм")
    return name
