"""Bearings and their clearances that the book of the oil film goes through."""

from __future__ import annotations

from dataclasses import dataclass

from kshm.defaults import CLASS_RATIO, CLEARANCE_SHARES, FILLET_SHARE
from reports.inputs.sections.bearings import MATERIALS, MEMORY, OILS
from reports.model.shape import Scope


@dataclass(frozen=True, slots=True)
class FilmCase:
    """A bearing with one of its clearances; ``number`` as the solver counts them."""

    bearing: int
    which: int

    @property
    def number(self) -> int:
        """Number from 1; 1 and 2 are the big end."""
        return 2 * self.bearing + self.which

    @property
    def label(self) -> str:
        """What the column is called."""
        name = f"коренной {self.bearing}" if self.bearing else "шатунный"
        return f"{name}, Δ{self.end}"

    @property
    def end(self) -> str:
        """Which end of the tolerance the clearance is."""
        return "max" if self.which == 2 else "min"

    @property
    def part(self) -> str:
        """Whose keys of the section it takes."""
        return "main" if self.bearing else "pin"


def film_bearings(scope: Scope) -> range:
    """Numbers of the bearings; articulated rods leave the big end, 0, out."""
    return range(1 if scope.shape.articulated else 0, scope.shape.throws + 2)


def film_cases(scope: Scope) -> list[FilmCase]:
    """All bearings with both clearances."""
    return [FilmCase(k, which) for k in film_bearings(scope) for which in (1, 2)]


def oil_names(scope: Scope) -> dict[str, object]:
    """Bearings, oils and the rules for what the file leaves out."""
    section = scope.input.bearings
    return {
        "cases": film_cases(scope),
        "bearings": film_bearings(scope),
        "oils": list(OILS.values()),
        "clearances": CLEARANCE_SHARES,
        "memory": MEMORY,
        "class_ratio": CLASS_RATIO,
        "estimated": section is not None and any(
            getattr(section, f"{part}_clearance_{end}_mm") is None
            for part in ("pin", "main") for end in ("min", "max")
        ),
    }  # fmt: skip


def safety_names(scope: Scope) -> dict[str, object]:
    """Materials; the fillet where the file gives none."""
    del scope
    return {"materials": list(MATERIALS.values()), "fillet_share": FILLET_SHARE,
            "class_ratio": CLASS_RATIO}  # fmt: skip
