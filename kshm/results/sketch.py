"""A curve as a small SVG of its own, for where nothing draws: a notebook's view of a result."""

from __future__ import annotations

from html import escape

from kshm.arrays import Array

_WIDTH, _HEIGHT, _LEFT, _EDGE = 520, 180, 60, 22
_STYLE = "font-family:sans-serif;font-size:11px;fill:currentColor"


def sketch(x: Array, y: Array, x_name: str, y_name: str) -> str:
    """Return an SVG of a curve with its extremes and its zero line.

    Args:
        x: abscissae, rising, shape (points,).
        y: ordinates, shape (points,).
        x_name: what the abscissa is, with its unit.
        y_name: what the ordinate is, with its unit.
    """
    low, high = min(0.0, float(y.min())), max(0.0, float(y.max()))
    across = (_WIDTH - _LEFT - _EDGE) / float(x[-1] - x[0])
    up = (_HEIGHT - 2 * _EDGE) / ((high - low) or 1.0)
    right, base = _LEFT + (x - x[0]) * across, _HEIGHT - _EDGE - (y - low) * up
    zero = _HEIGHT - _EDGE + low * up
    path = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(right, base, strict=True))
    labels = [
        (_LEFT - 4, base.min() + 4, "end", f"{y.max():.4g}"),
        (_LEFT - 4, base.max() + 4, "end", f"{y.min():.4g}"),
        (_LEFT, _HEIGHT - 6, "start", f"{x[0]:g}"),
        (_WIDTH - _EDGE, _HEIGHT - 6, "end", f"{x_name} {x[-1]:g}"),
        (_LEFT, _EDGE - 8, "start", y_name),
    ]
    texts = "".join(
        f'<text x="{a:.1f}" y="{b:.1f}" text-anchor="{anchor}" style="{_STYLE}">'
        f"{escape(text)}</text>"
        for a, b, anchor, text in labels
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_WIDTH}" height="{_HEIGHT}">'
        f'<line x1="{_LEFT}" x2="{_WIDTH - _EDGE}" y1="{zero:.1f}" y2="{zero:.1f}" '
        f'stroke="currentColor" stroke-width="0.6"/>'
        f'<polyline points="{path}" fill="none" stroke="#1f5fa8" stroke-width="1.4"/>{texts}</svg>'
    )
