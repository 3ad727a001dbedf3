"""Big-end bearing of cylinder 1 and bending of the first crankpin, Gots 2.6."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Results, Scalars
from kshm.engine.arrangement import hung, throws
from kshm.mechanics import pin_bearing
from kshm.mechanics.kinematics import Position
from kshm.nomenclature.quantity import UNITS
from kshm.results.case import Case
from kshm.results.extremes import first_extreme, least_loaded
from kshm.results.layout import shown_pins

_MPA = UNITS["MPa"].si  # extremes are told apart as the tables show them


def rod_bearing(case: Case) -> Results:
    """Load on the big-end bearing of cylinder 1 in the rod's axes, SI; no articulated rods."""
    raw, engine, first = case.raw, case.engine, (case.index, 0)
    if hung(engine.arrangement):
        return {}, {}
    area = engine.geometry.piston_area
    spin = raw.batch.pin_mass[first][0] * engine.geometry.crank_radius * engine.omega**2
    at = Position.at(raw.local_phi[first], *case.sizes[1:])
    x, y = pin_bearing.rod_bearing(raw.K[first] - spin / area, raw.T[first], at)
    load = np.hypot(x, y)
    most, where = first_extreme(load, raw.phi, floor=_MPA)
    scalars = {
        "B_mean": float(load[:-1].mean()),
        "B_max": most,
        "phi_B_max_deg": where,
        "B_min": float(load.min()),
    }
    table = {"phi_deg": raw.phi, "Bx_MPa": x, "By_MPa": y, "B_MPa": load}
    return {"rod_bearing": table}, scalars


def pin_bending(case: Case) -> Results:
    """Projections of R_к on planes of the pin and its bending in the oil hole's, SI; (42).

    Split pins have no common plane.
    """
    raw = case.raw
    if any(place.pin_angle for place in case.engine.arrangement):
        return {}, {}
    inward, ahead, lever = bending_forces(case, 0)
    angle, angles = oil_hole(case, 0), pin_bearing.plane_angles()
    force = pin_bearing.on_plane(inward, ahead, angle)
    planes = [pin_bearing.on_plane(inward, ahead, plane) for plane in angles]
    moment = force * lever
    swings = np.array([np.ptp(plane) * lever / 2 for plane in planes])
    least, best = first_extreme(swings, angles, largest=False)
    scalars: Scalars = {
        "alpha_oil_deg": angle,
        "Ralpha_max": float(force.max()),
        "Ralpha_min": float(force.min()),
        "Malpha_max": float(moment.max()),
        "Malpha_min": float(moment.min()),
        "Malpha_swing": float(np.ptp(moment)) / 2,
        "Malpha_mean": float(moment.max() + moment.min()) / 2,
        "alpha_best_deg": best,
        "Mbest_swing": least,
    }
    table = {"phi_deg": raw.phi, "Ralpha_MPa": force, "Malpha_Nm": moment}
    table |= {f"plane{number}_MPa": plane for number, plane in enumerate(planes, 1)}
    return {"pin_bending": table}, scalars


def bending_forces(case: Case, number: int) -> tuple[Array, Array, float]:
    """R_к of a throw, from 0, inwards and ahead [Pa], shape (angles,); its bending lever [m³]."""
    raw, engine, index = case.raw, case.engine, case.index
    throw = engine.crankshaft.throws[number]
    unit = engine.geometry.crank_radius * engine.omega**2 / engine.geometry.piston_area
    carried = raw.batch.pin_mass[index, list(throws(engine.arrangement)[number]), 0].sum()
    own = throw.pin_mass + throw.left_web.mass + throw.right_web.mass
    inward: Array = raw.throw_K[index, number] - (carried + own) * unit
    lever = engine.geometry.piston_area * throw.length / 4
    return inward, raw.throw_T[index, number], lever


def oil_hole(case: Case, pin: int) -> float:
    """Angle of a pin's oil hole from the crank against rotation [rad]: given, or by the wear."""
    if case.engine.oil_hole is not None:
        return case.engine.oil_hole
    shown = min(pin, len(shown_pins(case.engine)) - 1)  # pins of one wear have one hole
    return float(least_loaded(case.raw.pin_wear[case.index, shown])[1])
