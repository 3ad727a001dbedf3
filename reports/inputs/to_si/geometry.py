"""Crank radius and rod length from any two of r (or S), L and λ."""

from __future__ import annotations

import math
from dataclasses import dataclass

from reports.inputs.sections.input_file import GeometrySection, InputFile

_SIMILAR_MM = 150.0  # masses over the piston area grow with the bore of larger engines


@dataclass(frozen=True, slots=True)
class Sizes:
    """Bore, crank radius and rod [mm], given or found by the cycle."""

    bore: float
    radius: float
    rod: float

    @property
    def piston_area(self) -> float:
        """F_п [m²]."""
        return math.pi * (self.bore / 1000) ** 2 / 4

    @property
    def heavier(self) -> float:
        """How many times the usual masses over F_п those of so large an engine are."""
        return max(1.0, self.bore / _SIMILAR_MM)


def sizes_of(model: InputFile, bore_and_stroke: tuple[float, float] | None = None) -> Sizes:
    """Sizes of an engine whose bore and stroke [m] are given or found."""
    geometry = model.geometry
    if isinstance(geometry, GeometrySection):
        return Sizes(geometry.bore_mm, crank_radius_mm(geometry), rod_length_mm(geometry))
    if bore_and_stroke is None:
        raise ValueError("geometry without bore needs a wanted power")
    bore, stroke = (1000 * size for size in bore_and_stroke)
    return Sizes(bore, stroke / 2, stroke / 2 / geometry.lambda_)


def crank_radius_mm(geometry: GeometrySection) -> float:
    """Return r [mm] from r, S = 2r, or λ and L."""
    if geometry.crank_radius_mm is not None:
        return float(geometry.crank_radius_mm)
    if geometry.stroke_mm is not None:
        return geometry.stroke_mm / 2
    if geometry.lambda_ is None or geometry.rod_length_mm is None:
        raise ValueError("geometry does not fix the crank radius")
    return geometry.lambda_ * geometry.rod_length_mm


def rod_length_mm(geometry: GeometrySection) -> float:
    """Return L [mm] as given, or from r and λ."""
    if geometry.rod_length_mm is not None:
        return float(geometry.rod_length_mm)
    if geometry.lambda_ is None:
        raise ValueError("geometry does not fix the rod length")
    return crank_radius_mm(geometry) / geometry.lambda_
