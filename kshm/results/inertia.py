"""Masses of the rod, Gots 2.2; reduced inertia, irregularity and flywheel of one engine."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Results, Scalars
from kshm.defaults import FINE_STEP
from kshm.engine.arrangement import rods_beside
from kshm.engine.engine import Engine
from kshm.engine.masses import Estimate, RodMasses, Swinging
from kshm.mechanics import inertia, masses
from kshm.mechanics import inertia as reduced
from kshm.mechanics.forces import gas_torque
from kshm.results.case import Case


def rod_mass_scalars(engine: Engine) -> Scalars:
    """Masses over the piston area, the rod by two and three masses, how they were found."""
    rod, geometry = engine.masses, engine.geometry
    area = geometry.piston_area
    scalars = {"area_throw": masses.throw_mass(engine.crankshaft.throws[0]) / area}
    if not isinstance(rod, RodMasses):
        return scalars
    length = geometry.rod_length
    two = masses.two_mass_inertia(rod.rod, rod.centre, length)
    scalars |= {
        "area_piston": rod.piston_group / area,
        "area_rod": rod.rod / area,
        "rod_l1": rod.centre,
        "rod_share": 1 - rod.centre / length,
        "I_two": two,
    }
    if rod.inertia is not None:
        three = masses.three_masses(rod.rod, rod.centre, length, rod.inertia)
        scalars |= {
            "I_sh": rod.inertia,
            **{f"m{number}_three": mass for number, mass in enumerate(three, 1)},
            "m3_share": three[2] / rod.rod,
            "dI_two": two / rod.inertia - 1,
        }
    if isinstance(rod.basis, Swinging):
        scalars |= _swinging_scalars(rod.basis)
    elif isinstance(rod.basis, Estimate):
        estimate = masses.area_masses(rod.basis, geometry.bore, 2 * geometry.crank_radius)
        scalars |= {
            "est_piston": estimate.piston,
            "est_rod": estimate.rod,
            "est_throw": estimate.throw,
        }
    return scalars


def _swinging_scalars(data: Swinging) -> Scalars:
    arm = masses.swung_centre(data) + data.bore_radius
    far_arm = data.distance - arm
    return {
        "T_small": 1 / data.swings_small,
        "T_big": 1 / data.swings_big,
        "I_A": masses.pendulum_inertia(data.mass, arm, data.swings_small),
        "I_C": masses.pendulum_inertia(data.mass, far_arm, data.swings_big),
        "rod_l2": far_arm,
    }


def inertia_results(case: Case) -> Results:
    """Table ``inertia`` over the cycle with its extremes, flywheel and rod model, SI units.

    The approximation (19) is that of a central mechanism.
    """
    engine, raw = case.engine, case.raw
    phi, parts, (r, lam, _) = raw.phi, reduced.parts_of(engine), case.sizes
    central = parts.offset == 0
    rod, piston = reduced.exact(phi, parts)
    exact = parts.crank_inertia + rod + piston
    whole = reduced.of_engine(phi, engine)
    local, p_gas = raw.local_phi[case.index], raw.p_gas[case.index]
    gas = gas_torque(p_gas, local, r, lam, np.array(engine.geometry.piston_area),
                     parts.offset).sum(axis=0)  # fmt: skip
    work = inertia.excess_work(raw.torque_sum[case.index], phi)
    gas_work = inertia.excess_work(gas, phi)
    mean, delta = float(whole[:-1].mean()), engine.balancing.irregularity
    fine = inertia.excess_work(*case.fine_torque)
    flywheel = inertia.flywheel_inertia(fine, mean, engine.omega, delta)
    omega = inertia.speed(gas_work, whole + flywheel, engine.omega)
    approximate = reduced.approximate(phi, parts)
    error = approximate / exact - 1
    approximation = {"I_approx_kgm2": approximate, "I_error": error} if central else {}
    table = {
        "phi_deg": phi, "I_rod_kgm2": rod, "I_piston_kgm2": piston, "I_exact_kgm2": exact,
        **approximation, "I_engine_kgm2": whole,
        "Mgas_Nm": gas, "W_J": work, "Wgas_J": gas_work, "omega_1_s": omega,
    }  # fmt: skip
    scalars = {
        "I_crank": parts.crank_inertia,
        "rod_mass": parts.rod_mass,
        "rod_x": parts.rod_centre,
        "I_rod": parts.rod_inertia,
        "piston_mass": parts.piston_mass,
        "I_counterweights": reduced.counterweight_inertia(engine),
        **_range("", exact),
        **({"I_error_max": float(np.abs(error).max())} if central else {}),
        **_range("_engine", whole),
        "W_range": float(np.ptp(work)),
        "W_fine": float(np.ptp(fine)),
        "Wgas_range": float(np.ptp(gas_work)),
        "I_flywheel": flywheel,
        "delta_work": inertia.irregularity(fine, mean + flywheel, engine.omega),
        "omega_max": float(omega.max()),
        "omega_min": float(omega.min()),
        "delta_speed": float(np.ptp(omega) / omega[:-1].mean()),
    }
    steps, torque = {}, float(raw.torque_sum[case.index][:-1].mean())
    if engine.step_deg > FINE_STEP:
        ranges = np.array([scalars["W_fine"], scalars["W_range"]])
        with np.errstate(divide="ignore"):  # a diagram may give no work
            shares = ranges / torque
        steps["inertia_steps"] = {
            "W_step_deg": np.radians([FINE_STEP, engine.step_deg]), "W_step_share": shares,
        }  # fmt: skip
    return {"inertia": table} | steps, scalars | _rod_model(engine)


def _range(which: str, inertia: Array) -> Scalars:
    return {
        f"I{which}_max": float(inertia.max()),
        f"I{which}_min": float(inertia.min()),
        f"I{which}_mean": float(inertia[:-1].mean()),
        f"delta_I{which}": reduced.variation(inertia),
    }


def _rod_model(engine: Engine) -> Scalars:
    """Return the rod estimated from the main dimensions with the first pin, Ilchenko (20)-(31)."""
    shaft, geometry = engine.crankshaft, engine.geometry
    sizes = masses.rod_sizes(
        geometry.bore, shaft.pin_diameters[0],
        shaft.pin_lengths[0] / rods_beside(engine.arrangement, 0), geometry.rod_length,
    )  # fmt: skip
    model = masses.rod_estimate(sizes)
    return {
        "rod_model_mass": model.mass,
        "rod_model_centre": model.centre,
        "rod_model_inertia": model.inertia,
        "rod_model_small": model.radius_small,
        "rod_model_big": model.radius_big,
    }
