"""A cell of the sheet: its room, the title at its top, the room that is left."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

from reports.drawing.lettering import fitted, wrapped
from reports.drawing.primitives import THIN, Canvas, Dash, Point

TITLE, TEXT = 5.0, 3.5  # height of letters
_SMALLER = 3.9  # to which a title shrinks before it takes two lines
_SAMPLE = 12.0  # of a dash beside the name of a curve


class Room(NamedTuple):
    """A rectangle of the sheet [mm]."""

    left: float
    low: float
    width: float
    height: float

    @property
    def high(self) -> float:
        """Its upper edge."""
        return self.low + self.height

    @property
    def right(self) -> float:
        """Its right edge."""
        return self.left + self.width

    @property
    def middle(self) -> Point:
        """Its centre."""
        return self.left + self.width / 2, self.low + self.height / 2


@dataclass(frozen=True, slots=True)
class Name:
    """A curve in the legend."""

    text: str
    dash: Dash = ()


def headed(canvas: Canvas, room: Room, title: str, lines: tuple[str, ...] = ()) -> Room:
    """Write a title and lines under it; what is left of the room."""
    y = room.high - TITLE - 1.5
    one = fitted(title, room.width, TITLE)
    for text in [title] if one >= _SMALLER else wrapped(title, room.width, TITLE):
        height = fitted(text, room.width, TITLE)
        canvas.words((room.middle[0], y), text, height, align=0.5)
        y -= 1.6 * TITLE
    y += 0.3 * TITLE
    for text in lines:
        for part in wrapped(text, room.width, TEXT):
            canvas.words((room.middle[0], y), part, fitted(part, room.width, TEXT), align=0.5)
            y -= 1.7 * TEXT
    return Room(room.left, room.low, room.width, y + 0.6 * TEXT - room.low)


def _shown(dash: Dash) -> Dash:
    """Dashes so short that a sample shows them all, with the first one at both its ends."""
    if not dash:
        return dash
    share = min(1.0, _SAMPLE / (sum(dash) + dash[0]))
    return tuple(round(share * part, 2) for part in dash)


def legend(canvas: Canvas, room: Room, names: list[Name]) -> Room:
    """Dashes with the names of curves in lines; what is left of the room."""
    x, y = room.left + 2, room.high - TEXT - 1
    for name in names:
        words = replace(canvas.words((0, 0), "", TEXT), text=name.text)
        if x > room.left + 2 and x + _SAMPLE + 2 + words.width > room.right:
            x, y = room.left + 2, y - 1.8 * TEXT
        middle = y + TEXT / 2
        canvas.line((x, middle), (x + _SAMPLE, middle), layer=THIN, dash=_shown(name.dash))
        canvas.words((x + _SAMPLE + 2, y), name.text, TEXT)
        x += _SAMPLE + 8 + words.width
    return Room(room.left, room.low, room.width, y - 2 - room.low)
