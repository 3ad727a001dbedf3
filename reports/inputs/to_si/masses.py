"""Sizes of crank and rod, and masses of rod, piston group and throws, Gots 2.2."""

from __future__ import annotations

import math
from dataclasses import dataclass

from kshm.defaults import SMALL_END_SHARE
from kshm.engine.engine import Geometry
from kshm.engine.masses import DirectMasses, Estimate, Masses, RodMasses, Swinging, Weighing
from kshm.mechanics.masses import (
    area_masses,
    reduced_web,
    swung_centre,
    swung_inertia,
    weighed_centre,
)
from reports.inputs.meta import solver_values
from reports.inputs.sections.input_file import GeometrySection, InputFile
from reports.inputs.sections.mechanism import CrankshaftSection, MassesSection
from reports.inputs.units import KG, KG_M2, MM

_SIMILAR_MM = 150.0  # masses over the piston area grow with the bore of larger engines
PIN_SHARE = Estimate(fuel="diesel").pin_share
ROD_SHARE = SMALL_END_SHARE  # as in section 2.9


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
        """Factor of the usual masses over F_п for so large an engine."""
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


def to_masses(section: MassesSection, geometry: Geometry) -> Masses:
    """Masses of one cylinder in SI units."""
    if section.reciprocating_kg is not None and section.rod_big_end_kg is not None:
        return DirectMasses(**solver_values(section, DirectMasses))
    estimate = to_estimate(section)
    piston, rod = section.piston_group_kg, section.rod_kg
    if estimate is not None:
        area_estimate = area_masses(estimate, geometry.bore, 2 * geometry.crank_radius)
        area = geometry.piston_area
        piston = area_estimate.piston * area if piston is None else piston
        rod = area_estimate.rod * area if rod is None else rod
    if piston is None or rod is None:
        raise ValueError("masses are incomplete")
    mass, length = KG.to_si(rod), geometry.rod_length
    inertia = KG_M2.given(section.rod_inertia_kg_m2)
    basis: Weighing | Swinging | Estimate | None = estimate
    if section.rod_weighed_small_end_kg is not None:
        basis = Weighing(mass, KG.to_si(section.rod_weighed_small_end_kg))
        centre = weighed_centre(basis, length)
    elif section.swing_edges_mm is not None:
        basis = to_swinging(section, mass)
        centre, inertia = swung_centre(basis), swung_inertia(basis)
    elif section.rod_centre_mm is not None:
        centre = MM.to_si(section.rod_centre_mm)
    elif section.rod_small_end_share is not None:
        centre = (1 - section.rod_small_end_share) * length  # m_1/m = (l − l_1)/l, Gots (20)
    elif estimate is not None:
        centre = (1 - ROD_SHARE) * length
    else:
        raise ValueError("masses do not fix the rod's centre of mass")
    return RodMasses(KG.to_si(piston), mass, centre, inertia, basis)


def to_swinging(section: MassesSection, mass: float) -> Swinging:
    """Return the swings of the rod in SI units."""
    return Swinging(mass=mass, **solver_values(section, Swinging))


def to_estimate(section: MassesSection) -> Estimate | None:
    """Entries of table 4, None where nothing is estimated."""
    if section.estimate_fuel is None:
        return None
    return Estimate(**solver_values(section, Estimate))


def with_masses(
    shaft: CrankshaftSection, masses: MassesSection, bore: float, radius: float
) -> CrankshaftSection:
    """Return crankshaft with every reduced mass of pin and webs in its place [kg]; sizes in m."""
    whole = shaft.pin_mass_kg is not None and all(
        web.mass_kg is not None and (web.actual_mass_kg is None or web.centre_mm is None)
        for web in shaft.webs
    )
    if whole:
        return shaft
    estimate = to_estimate(masses)
    throw = share = 0.0
    if estimate is not None:
        area_estimate = area_masses(estimate, bore, 2 * radius)
        throw, share = area_estimate.throw * math.pi * bore**2 / 4, estimate.pin_share
    webs = []
    for web in shaft.webs:
        mass = web.mass_kg
        if web.actual_mass_kg is not None and web.centre_mm is not None:
            mass = reduced_web(web.actual_mass_kg, web.centre_mm, MM.from_si(radius))
        elif mass is None:
            mass = throw * (1 - share) / 2
        webs.append(web.model_copy(update={"mass_kg": mass}))
    pin = throw * share if shaft.pin_mass_kg is None else shaft.pin_mass_kg
    return shaft.model_copy(update={"webs": tuple(webs), "pin_mass_kg": pin})
