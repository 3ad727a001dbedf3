"""A drawing as DXF (R2010, millimetres): layers by name, real text, closed polylines."""

from __future__ import annotations

import io
from collections import OrderedDict
from collections.abc import Iterable

from reports.drawing.lettering import plain
from reports.drawing.primitives import LAYERS, Circle, Dash, Item, Line, Words, bounds

STYLE = "ЕСКД"
_FONT = "isocpeur.ttf"  # of AutoCAD and its kin, with Cyrillic
_SLANT = 15.0
_BLACK, _GREY = 7, 8


def dxf_bytes(items: Iterable[Item], dashes: float = 1.0) -> bytes:
    """The drawing as a DXF file; the same items give the same bytes.

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
        document.styles.add(STYLE, font=_FONT).dxf.oblique = _SLANT
        for layer in LAYERS:
            made = document.layers.add(layer.name, color=_GREY if layer.grey else _BLACK)
            made.dxf.lineweight = round(100 * layer.width)
            made.dxf.linetype = _linetype(document, layer.dash)
        space = document.modelspace()
        aligns = {0.0: TextEntityAlignment.LEFT, 0.5: TextEntityAlignment.CENTER,
                  1.0: TextEntityAlignment.RIGHT}  # fmt: skip
        shown = list(items)
        for item in shown:
            looks: dict[str, object] = {"layer": item.layer.name}
            if isinstance(item, Line):
                if item.dash:
                    looks["linetype"] = _linetype(document, item.dash)
                space.add_lwpolyline(item.points, close=item.closed, dxfattribs=looks)
                if item.filled:
                    hatch = space.add_hatch(color=_BLACK, dxfattribs={"layer": item.layer.name})
                    hatch.paths.add_polyline_path(item.points, is_closed=True)
            elif isinstance(item, Circle):
                space.add_circle(item.centre, item.radius, dxfattribs=looks)
                if item.filled:
                    hatch = space.add_hatch(color=_BLACK, dxfattribs={"layer": item.layer.name})
                    edges = hatch.paths.add_edge_path()
                    edges.add_arc(item.centre, item.radius, 0, 360)
            else:
                _text(space, item, aligns[item.align], looks)
        left, low, right, high = bounds(shown)
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


def _text(space: object, item: Words, align: object, looks: dict[str, object]) -> None:
    text = space.add_text(  # type: ignore[attr-defined]
        plain(item.text), height=item.height, rotation=item.angle,
        dxfattribs={**looks, "style": STYLE, "oblique": _SLANT},
    )  # fmt: skip
    text.set_placement(item.place, align=align)


def _linetype(document: object, dash: Dash) -> str:
    """Name of a pattern of dashes, made where it is not there yet."""
    if not dash:
        return "Continuous"
    name = "-".join(f"{part:g}" for part in dash).replace(".", "_")
    types = document.linetypes  # type: ignore[attr-defined]
    if name not in types:
        pattern = [sum(dash), *(p if n % 2 == 0 else -p for n, p in enumerate(dash))]
        types.add(name, pattern, description=f"штрихи {name} мм")
    return name
