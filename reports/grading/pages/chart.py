"""A small chart of a column as inline SVG: the student's line, the right one if it may be seen."""

from __future__ import annotations

from collections.abc import Sequence

WIDTH, HEIGHT = 640, 200
_LEFT, _RIGHT, _TOP, _BOTTOM = 56, 12, 10, 26

Points = Sequence[float | None]


def line_chart(x: Sequence[float], own: Points, right: Points | None, fmt: str = ".4g") -> str:
    """The chart's SVG; gaps where there is no number, one line where ``right`` is None."""
    known = [v for line in (own, right or ()) for v in line if v is not None]
    if not known or len(x) < 2:
        return ""
    low, high = min(known), max(known)
    if high - low < 1e-12 * max(1.0, abs(high)):
        low, high = low - 1, high + 1
    pad = (high - low) * 0.05
    low, high = low - pad, high + pad

    def at_x(value: float) -> float:
        share = (value - x[0]) / ((x[-1] - x[0]) or 1)
        return _LEFT + share * (WIDTH - _LEFT - _RIGHT)

    def at_y(value: float) -> float:
        return _TOP + (high - value) / (high - low) * (HEIGHT - _TOP - _BOTTOM)

    shown = "ваши значения" if right is None else "ваши значения и правильные"
    parts = [
        f'<svg class="chart" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
        f'aria-label="График столбца: {shown}">'
    ]
    for share in (0.0, 0.5, 1.0):
        value = low + pad + (high - low - 2 * pad) * share
        y = at_y(value)
        parts.append(
            f'<line class="grid" x1="{_LEFT}" x2="{WIDTH - _RIGHT}" y1="{y:.1f}" y2="{y:.1f}"/>'
        )
        label = format(value, fmt).replace(".", ",").replace("-", "−")
        parts.append(f'<text x="{_LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{label}</text>')
    for share in (0.0, 0.25, 0.5, 0.75, 1.0):
        value = x[0] + (x[-1] - x[0]) * share
        anchor = "start" if share == 0 else "end" if share == 1 else "middle"
        parts.append(
            f'<text x="{at_x(value):.1f}" y="{HEIGHT - 8}" text-anchor="{anchor}">{value:g}</text>'
        )
    if right is not None:
        parts.append(_line(x, right, at_x, at_y, "right"))
    parts.append(_line(x, own, at_x, at_y, "own"))
    parts.append("</svg>")
    return "".join(parts)


def _line(x: Sequence[float], y: Points, at_x: object, at_y: object, name: str) -> str:
    assert callable(at_x) and callable(at_y)
    path, pen = [], "M"
    for position, value in zip(x, y, strict=True):
        if value is None:
            pen = "M"
            continue
        path.append(f"{pen}{at_x(position):.1f} {at_y(value):.1f}")
        pen = "L"
    return f'<path class="{name}" d="{"".join(path)}"/>'
