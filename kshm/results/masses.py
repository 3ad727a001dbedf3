"""Scalars of the sheet of masses in SI units, Gots 2.2."""

from __future__ import annotations

from kshm.arrays import Scalars
from kshm.engine.engine import Engine
from kshm.engine.masses import Estimate, RodMasses, Swinging
from kshm.mechanics import masses, rod_masses


def rod_mass_scalars(engine: Engine) -> Scalars:
    """Masses over the piston area, the rod by two and three masses, how they were found."""
    given, geometry = engine.masses, engine.geometry
    area = geometry.piston_area
    scalars = {"area_throw": masses.throw_mass(engine.crankshaft.throws[0]) / area}
    if not isinstance(given, RodMasses):
        return scalars
    length = geometry.rod_length
    two = rod_masses.two_mass_inertia(given.rod, given.centre, length)
    scalars |= {
        "area_piston": given.piston_group / area,
        "area_rod": given.rod / area,
        "rod_l1": given.centre,
        "rod_share": 1 - given.centre / length,
        "I_two": two,
    }
    if given.inertia is not None:
        three = rod_masses.three_masses(given.rod, given.centre, length, given.inertia)
        scalars |= {
            "I_sh": given.inertia,
            **{f"m{number}_three": mass for number, mass in enumerate(three, 1)},
            "m3_share": three[2] / given.rod,
            "dI_two": two / given.inertia - 1,
        }
    if isinstance(given.basis, Swinging):
        scalars |= _swinging_scalars(given.basis)
    elif isinstance(given.basis, Estimate):
        near = rod_masses.area_masses(given.basis, geometry.bore, 2 * geometry.crank_radius)
        scalars |= {"est_piston": near.piston, "est_rod": near.rod, "est_throw": near.throw}
    return scalars


def _swinging_scalars(data: Swinging) -> Scalars:
    arm = rod_masses.swung_centre(data) + data.bore_radius
    rest = data.distance - arm
    return {
        "T_small": 1 / data.swings_small,
        "T_big": 1 / data.swings_big,
        "I_A": rod_masses.pendulum_inertia(data.mass, arm, data.swings_small),
        "I_C": rod_masses.pendulum_inertia(data.mass, rest, data.swings_big),
        "rod_l2": rest,
    }
