"""The drawings of ``docs/input.md``: arms of a throw, angles and signs, phases of a shaft."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from reports.shared.files import write_text

_STYLE = (
    "<style>path,line,rect,circle{fill:none;stroke:#222;stroke-width:1.4}"
    ".t{stroke-width:.8;stroke:#555}.a{stroke-dasharray:9 3 2 3;stroke-width:.8}"
    ".c{fill:#e8edf5}.p{fill:#f6e3d3}"
    "text{font:15px serif;fill:#111;text-anchor:middle}.l{text-anchor:start}</style>"
    '<defs><marker id="h" markerWidth="9" markerHeight="7" refX="8" refY="3.5" '
    'orient="auto-start-reverse"><path d="M0 .8 8 3.5 0 6.2Z" '
    'style="fill:#222;stroke:none"/></marker></defs>'
)
_ARROW = 'marker-end="url(#h)"'
_BOTH = f'{_ARROW} marker-start="url(#h)"'


def arms(*, v_engine: bool = False) -> str:
    """Figure 35: one throw from the middle of a main journal to the next, with l1…l6 and h."""
    half_main, web, pin = 60, 46, 58 if not v_engine else 48
    left = [("l₁", half_main), ("h_Л", web), ("l₂", pin)]
    middle = [("l₃", 44), ("l₄", 44)] if v_engine else []
    right = [("l₅", pin), ("h_П", web), ("l₆", half_main)]
    parts = [*left, *middle, *right]
    x0, axis, top = 60, 250, 90
    places = [x0]
    for _, width in parts:
        places.append(places[-1] + width)
    end = places[-1]
    body = [_line(x0 - 30, axis, end + 30, axis, "a")]
    for x in (x0 - 30, end - half_main):
        body.append(_box(x, axis - 34, half_main + 30, 68, "c"))
    for x in (places[1], places[-3]):
        body.append(_box(x, top - 12, web, axis - top + 58, "c"))
    body.append(_box(places[2], top - 4, places[-3] - places[2], 56, "p"))
    rods = (places[3], places[5]) if v_engine else (places[3],)
    for x in rods:
        body.append(_line(x, 20, x, top + 66, "a"))
        body.append(_text(x, 14, "ось" if v_engine else "ось шатуна"))
    level = axis + 84
    for x in places:
        body.append(_line(x, axis - 30 if x in (x0, end) else top + 20, x, level + 8, "t"))
    for (name, width), x in zip(parts, places, strict=False):
        body.append(_line(x, level, x + width, level, "t", _BOTH))
        body.append(_text(x + width / 2, level - 7, name))
    body.append(_line(x0, axis - 60, x0, axis + 30, "a"))
    body.append(_line(end, axis - 60, end, axis + 30, "a"))
    body.append(_text(places[1] + web / 2, top - 20, "щека 1"))
    body.append(_text(places[-3] + web / 2, top - 20, "щека 2"))
    body.append(_text(end + 36, axis + 5, "коренная шейка", "l"))
    return _svg(end + 180, level + 24, body)


def signs() -> str:
    """Angles seen from the nose: φ and β by rotation, γ of throws, angles of web masses."""
    x, y, r = 190, 300, 110
    angle = math.radians(40)
    pin = (x + r * math.sin(angle), y - r * math.cos(angle))
    piston = (x, 60)
    body = [
        _line(x, 30, x, y + 150, "a"), _line(x - 150, y, x + 150, y, "a"),
        _circle(x, y, r, "t"), _line(x, y, *pin), _line(*pin, *piston),
        _circle(x, y, 12, "c"), _circle(*pin, 9, "p"), _box(x - 34, 38, 68, 44, "c"),
        _arc(x, y, 60, 0, 40), _text(x + 30, y - 66, "φ"),
        _arc(x, y, 138, 75, 105), _text(x + 170, y - 20, "вращение", "l"),
        _text(x + 20, 130, "β", "l"), _text(pin[0] + 14, pin[1] + 4, "колено 1", "l"),
    ]  # fmt: skip
    back = (x - 78 * math.sin(angle), y + 78 * math.cos(angle))
    body += [
        _line(x, y, *back), _circle(*back, 15, "p"),
        _text(back[0] - 24, back[1] + 34, "противовес"),
        _arc(x, y, 96, 220, 250), _text(x - 118, y + 66, "α_пр"),
    ]  # fmt: skip
    notes = (
        "Вид с носка вала, вращение по часовой стрелке.",
        "φ — от ВМТ по вращению; β > 0 при sin φ > 0.",
        "γ — угол колена от колена 1 по часовой стрелке,",
        "в ряду γ = −θ; во втором ряду γ = γ_р − θ − δ_ш.",
        "α_пр — от направления, противоположного",
        "кривошипу, по вращению; α_щ — против вращения.",
        "e > 0 — ось цилиндра смещена в сторону вращения.",
    )
    body += [_text(370, 70 + 26 * i, note, "l") for i, note in enumerate(notes)]
    return _svg(830, 470, body)


def phases() -> str:
    """Power strokes of a four-cylinder engine 1-3-4-2 and the angles of its throws."""
    body = []
    starts = (0, 540, 180, 360)
    x0, scale = 90, 0.6
    for number, start in enumerate(starts):
        y = 40 + 44 * number
        body.append(_text(46, y + 18, f"цил. {number + 1}"))
        body.append(_box(x0, y, 720 * scale, 26, "t"))
        body.append(_box(x0 + start * scale, y, 180 * scale, 26, "p"))
        body.append(_text(x0 + (start + 90) * scale, y + 18, f"θ = {start}°"))
    for angle in range(0, 721, 180):
        body.append(_text(x0 + angle * scale, 234, f"{angle}°"))
        body.append(_line(x0 + angle * scale, 34, x0 + angle * scale, 216, "t"))
    x, y, r = 640, 120, 62
    body += [_circle(x, y, 10, "c"), _line(x, y, x, y - r), _line(x, y, x, y + r)]
    body += [_circle(x, y - r, 9, "p"), _circle(x, y + r, 9, "p"), _arc(x, y, 84, 60, 110)]
    body += [_text(x, y - r - 18, "колена 1, 4: γ = 0°"), _text(x, y + r + 30, "2, 3: γ = 180°")]
    return _svg(760, 256, body)


DRAWINGS: Mapping[str, Callable[[], str]] = {
    "arms.svg": arms,
    "arms-v.svg": lambda: arms(v_engine=True),
    "signs.svg": signs,
    "phases.svg": phases,
}


def write_drawings(folder: Path) -> list[Path]:
    """Write the drawings anew; return those that changed."""
    changed = []
    for name, make in DRAWINGS.items():
        path, text = folder / name, make()
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            write_text(path, text)
            changed.append(path)
    return changed


def _svg(width: float, height: float, body: Sequence[str]) -> str:
    inner = "\n".join(body)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" '
        f'width="{width:g}" height="{height:g}">\n{_STYLE}\n'
        f'<rect width="100%" height="100%" style="fill:#fff;stroke:none"/>\n{inner}\n</svg>\n'
    )


def _line(x1: float, y1: float, x2: float, y2: float, kind: str = "", more: str = "") -> str:
    return f'<line x1="{x1:g}" y1="{y1:g}" x2="{x2:g}" y2="{y2:g}" class="{kind}" {more}/>'


def _box(x: float, y: float, width: float, height: float, kind: str) -> str:
    return f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" class="{kind}"/>'


def _circle(x: float, y: float, radius: float, kind: str) -> str:
    return f'<circle cx="{x:g}" cy="{y:g}" r="{radius:g}" class="{kind}"/>'


def _arc(x: float, y: float, radius: float, first: float, last: float) -> str:
    """Return an arrow by rotation, clockwise from the vertical [deg]."""
    ends = []
    for angle in (math.radians(first), math.radians(last)):
        ends.append(f"{x + radius * math.sin(angle):.1f} {y - radius * math.cos(angle):.1f}")
    return f'<path d="M{ends[0]} A{radius:g} {radius:g} 0 0 1 {ends[1]}" {_ARROW}/>'


def _text(x: float, y: float, text: str, kind: str = "") -> str:
    """Return a text; ``h_Л`` has a subscript."""
    return f'<text x="{x:g}" y="{y:g}" class="{kind}">{_lowered(text)}</text>'


def _lowered(text: str) -> str:
    """Every index of a note as a subscript."""
    first, *rest = text.split("_")
    parts = [first]
    for part in rest:
        size = len(part) - len(part.lstrip("абвгдежзиклмнопрстуфхцчшщЛП"))
        parts.append(f'<tspan baseline-shift="sub" font-size="11">{part[:size]}</tspan>')
        parts.append(part[size:])
    return "".join(parts)
