"""Masses of rod, piston group and throws from what the input gives, Gots 2.2."""

from __future__ import annotations

from kshm.engine.engine import Geometry
from kshm.engine.masses import DirectMasses, Estimate, Masses, RodMasses, Swinging, Weighing
from kshm.mechanics.rod_masses import (
    area_masses,
    reduced_web,
    swung_centre,
    swung_inertia,
    weighed_centre,
)
from reports.inputs.sections.crankshaft import CrankshaftSection
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.masses import MassesSection
from reports.inputs.units import KG, KG_M2, KG_PER_M2, MM, PER_MIN

PIN_SHARE = 0.465  # as in appendix 1 of Gots: 0.425 of 0.915 kg
ROD_SHARE = 0.275  # as in section 2.9


def to_masses(model: InputFile, geometry: Geometry) -> Masses:
    """Masses of one cylinder in SI units."""
    given = model.masses
    if given.reciprocating_kg is not None and given.rod_big_end_kg is not None:
        return DirectMasses(KG.to_si(given.reciprocating_kg), KG.to_si(given.rod_big_end_kg))
    estimate = to_estimate(given)
    piston, rod = given.piston_group_kg, given.rod_kg
    if estimate is not None:
        near = area_masses(estimate, geometry.bore, 2 * geometry.crank_radius)
        area = geometry.piston_area
        piston = near.piston * area if piston is None else piston
        rod = near.rod * area if rod is None else rod
    if piston is None or rod is None:
        raise ValueError("masses are incomplete")
    mass, length = KG.to_si(rod), geometry.rod_length
    known = KG_M2.given(given.rod_inertia_kg_m2)
    basis: Weighing | Swinging | Estimate | None = estimate
    if given.rod_weighed_small_end_kg is not None:
        basis = Weighing(mass, KG.to_si(given.rod_weighed_small_end_kg))
        centre = weighed_centre(basis, length)
    elif given.swing_edges_mm is not None:
        basis = to_swinging(given, mass)
        centre, known = swung_centre(basis), swung_inertia(basis)
    elif given.rod_centre_mm is not None:
        centre = MM.to_si(given.rod_centre_mm)
    elif given.rod_small_end_share is not None:
        centre = (1 - given.rod_small_end_share) * length  # m_1/m = (l − l_1)/l, Gots (20)
    elif estimate is not None:
        centre = (1 - ROD_SHARE) * length
    else:
        raise ValueError("masses do not fix the rod's centre of mass")
    return RodMasses(KG.to_si(piston), mass, centre, known, basis)


def to_swinging(given: MassesSection, mass: float) -> Swinging:
    """The swings of the rod in SI units."""
    return Swinging(
        mass=mass,
        swings_small=PER_MIN.to_si(given.swings_small_end_per_min or 0.0),
        swings_big=PER_MIN.to_si(given.swings_big_end_per_min or 0.0),
        bore_radius=MM.to_si(given.small_end_radius_mm or 0.0),
        distance=MM.to_si(given.swing_edges_mm or 0.0),
    )


def to_estimate(given: MassesSection) -> Estimate | None:
    """Entries of table 4, None where nothing is estimated."""
    if given.estimate_fuel is None:
        return None

    return Estimate(
        fuel=given.estimate_fuel,
        piston_material=given.estimate_piston or "aluminium",
        shaft=given.estimate_shaft or "steel",
        piston_area_mass=KG_PER_M2.given(given.estimate_piston_kg_per_m2),
        rod_area_mass=KG_PER_M2.given(given.estimate_rod_kg_per_m2),
        throw_area_mass=KG_PER_M2.given(given.estimate_throw_kg_per_m2),
        pin_share=PIN_SHARE if given.estimate_pin_share is None else given.estimate_pin_share,
    )


def with_masses(model: InputFile, geometry: Geometry) -> CrankshaftSection:
    """The crankshaft with every reduced mass of pin and webs in its place [kg]."""
    shaft, estimate = model.crankshaft, to_estimate(model.masses)
    throw = share = 0.0
    if estimate is not None:
        near = area_masses(estimate, geometry.bore, 2 * geometry.crank_radius)
        throw, share = near.throw * geometry.piston_area, estimate.pin_share
    radius_mm = MM.from_si(geometry.crank_radius)
    webs = []
    for web in shaft.webs:
        mass = web.mass_kg
        if web.actual_mass_kg is not None and web.centre_mm is not None:
            mass = reduced_web(web.actual_mass_kg, web.centre_mm, radius_mm)
        elif mass is None:
            mass = throw * (1 - share) / 2
        webs.append(web.model_copy(update={"mass_kg": mass}))
    pin = throw * share if shaft.pin_mass_kg is None else shaft.pin_mass_kg
    return shaft.model_copy(update={"webs": tuple(webs), "pin_mass_kg": pin})
