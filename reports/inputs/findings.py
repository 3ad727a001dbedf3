"""What the cross-checks read (`Values`) and what they say (`Finding`)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

Path = tuple[str | int, ...]


@dataclass(frozen=True, slots=True)
class Finding:
    """What is wrong (or odd, if a warning) at a path; the file's name is added later."""

    path: Path
    what: str
    hint: str = ""
    warning: bool = False


@dataclass(slots=True)
class Values:
    """The valid fields of a file by section and TOML key, defaults filled in.

    `broken` holds the (section, key) that are wrong in themselves, `unsure`
    the sections with unknown keys; `counts` the list lengths as
    written, known even where an entry is wrong.
    """

    sections: dict[str, dict[str, Any]] = field(default_factory=dict)
    counts: dict[tuple[str, str], int] = field(default_factory=dict)
    broken: set[tuple[str, str]] = field(default_factory=set)
    unsure: set[str] = field(default_factory=set)

    def get(self, section: str, key: str) -> Any:  # noqa: ANN401 - as various as the fields
        """Return a valid value, or None."""
        return self.sections.get(section, {}).get(key)

    def sure(self, section: str, *keys: str) -> bool:
        """Tell whether the absence of these keys may be judged."""
        if section not in self.sections or section in self.unsure:
            return False
        return not any((section, key) in self.broken for key in keys)


def radius_and_rod(values: Values) -> tuple[float, float] | None:
    """Return (r, L) [mm] if the geometry fixes them."""
    radius = values.get("geometry", "crank_radius_mm")
    stroke = values.get("geometry", "stroke_mm")
    rod = values.get("geometry", "rod_length_mm")
    lam = values.get("geometry", "lambda")
    if radius is None and stroke is not None:
        radius = stroke / 2
    if radius is None and rod is not None and lam is not None:
        radius = lam * rod
    if rod is None and radius is not None and lam is not None:
        rod = radius / lam
    return None if radius is None or rod is None else (radius, rod)
