"""One look for all figures: line patterns, sizes of type, grey of the grid."""

from __future__ import annotations

from dataclasses import dataclass

PAGE_WIDTH = 165.0  # mm of text width
FONT_SIZE = 11.0  # pt
SMALL = 9.5
MM = 72 / 25.4  # points in a millimetre


@dataclass(frozen=True, slots=True)
class Look:
    """How a line is drawn: width [pt], dashes and gaps [pt], colour, ends, joints."""

    width: float = 0.9
    dash: tuple[float, ...] = ()
    colour: str = "#000000"
    cap: str = ""  # by default square, butt where dashed
    miter: bool = False

    @property
    def svg(self) -> str:
        """Attributes of an element."""
        cap = self.cap or ("" if self.dash else "square")
        dashes = ",".join(f"{part:g}" for part in self.dash)
        return (
            (f' stroke-dasharray="{dashes}"' if dashes else "")
            + f' stroke="{self.colour}" stroke-width="{self.width:g}"'
            + (' stroke-linejoin="miter"' if self.miter else "")
            + (f' stroke-linecap="{cap}"' if cap else "")
        )


# Patterns are told apart without colour; widths help where dashes are short.
PATTERNS = (
    Look(1.5),
    Look(1.3, (7, 2.2)),
    Look(1.3, (7, 2, 1.3, 2)),
    Look(1.6, (1.3, 1.7)),
    Look(1.2, (11, 2, 3, 2)),
    Look(1.2, (3, 1.6)),
    Look(2.4, colour="#8a8a8a"),
    Look(1.2, (7, 1.6, 1.3, 1.6, 1.3, 1.6)),
)
GRID = Look(0.45, colour="#c4c4c4")
AXIS = Look(0.8)
EDGE = Look(0.8, miter=True)
HALO = 0.55  # pt of white around a text
