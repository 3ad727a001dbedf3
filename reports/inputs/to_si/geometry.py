"""Crank radius and rod length from any two of r (or S), L and λ."""

from __future__ import annotations

from reports.inputs.sections.input_file import GeometrySection


def crank_radius_mm(geometry: GeometrySection) -> float:
    """Return r [mm] from r, S = 2r, or λ and L."""
    if geometry.crank_radius_mm is not None:
        return float(geometry.crank_radius_mm)
    if geometry.stroke_mm is not None:
        return geometry.stroke_mm / 2
    if geometry.lambda_ is None or geometry.rod_length_mm is None:
        msg = "geometry does not fix the crank radius"
        raise ValueError(msg)
    return geometry.lambda_ * geometry.rod_length_mm


def rod_length_mm(geometry: GeometrySection) -> float:
    """Return L [mm] as given, or from r and λ."""
    if geometry.rod_length_mm is not None:
        return float(geometry.rod_length_mm)
    if geometry.lambda_ is None:
        msg = "geometry does not fix the rod length"
        raise ValueError(msg)
    return crank_radius_mm(geometry) / geometry.lambda_
