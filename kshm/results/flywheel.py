"""The flywheel as a part: width of its rim for the needed moment of inertia, speed of the rim."""

from __future__ import annotations

from kshm.arrays import Results
from kshm.defaults import FLYWHEEL_DISC_SHARE, FLYWHEEL_STROKES
from kshm.mechanics.flywheel import FlywheelRing, rim_stress
from kshm.results.case import Case
from kshm.results.inertia import inertia_results


def flywheel_results(case: Case) -> Results:
    """Scalars ``fw_…`` of the flywheel, SI; empty without [flywheel]."""
    given, engine = case.engine.flywheel, case.engine
    if given is None:
        return {}, {}
    needed = inertia_results(case)[1]["I_flywheel"]
    outer = given.outer or FLYWHEEL_STROKES * 2 * engine.geometry.crank_radius
    thick = given.disc or FLYWHEEL_DISC_SHARE * outer
    bore = outer * (1 - 2 * given.rim_share)
    disc = FlywheelRing(bore, 0.0, thick, given.density)
    unit = FlywheelRing(outer, bore, 1.0, given.density)
    # A rim is as wide as the disc at least.
    rim = unit._replace(width=max(thick, (needed - disc.inertia) / unit.inertia))
    speed = engine.omega * given.overspeed * outer / 2
    return {}, {
        "fw_outer_mm": outer, "fw_bore_mm": bore, "fw_disc_mm": thick, "fw_rim_mm": rim.width,
        "fw_I_disc": disc.inertia, "fw_I": disc.inertia + rim.inertia,
        "fw_mass_disc": disc.mass, "fw_mass_rim": rim.mass, "fw_mass": disc.mass + rim.mass,
        "fw_speed": speed, "fw_limit": given.rim_speed,
        "fw_stress_MPa": rim_stress(given.density, speed),
        "fw_outer_most_mm": 2 * given.rim_speed / (engine.omega * given.overspeed),
    }  # fmt: skip
