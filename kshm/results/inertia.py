"""Reduced inertia, speed fluctuation and flywheel of one engine, Ilchenko, Gots 2.8."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Results, Scalars
from kshm.engine.arrangement import rods_beside
from kshm.engine.engine import Engine
from kshm.mechanics import reduced_inertia as reduced
from kshm.mechanics import rod_model, speed_fluctuation
from kshm.mechanics.torque import gas_torque
from kshm.results.case import Case


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
    work = speed_fluctuation.excess_work(raw.torque_sum[case.index], phi)
    gas_work = speed_fluctuation.excess_work(gas, phi)
    mean, delta = float(whole[:-1].mean()), engine.balancing.irregularity
    flywheel = speed_fluctuation.flywheel_inertia(work, mean, engine.omega, delta)
    omega = speed_fluctuation.speed(gas_work, whole + flywheel, engine.omega)
    near = reduced.approximate(phi, parts)
    error = near / exact - 1
    approximation = {"I_approx_kgm2": near, "I_error": error} if central else {}
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
        "Wgas_range": float(np.ptp(gas_work)),
        "I_flywheel": flywheel,
        "delta_work": speed_fluctuation.irregularity(work, mean + flywheel, engine.omega),
        "omega_max": float(omega.max()),
        "omega_min": float(omega.min()),
        "delta_speed": float(np.ptp(omega) / omega[:-1].mean()),
    }
    return {"inertia": table}, scalars | _rod_model(engine)


def _range(which: str, inertia: Array) -> Scalars:
    return {
        f"I{which}_max": float(inertia.max()),
        f"I{which}_min": float(inertia.min()),
        f"I{which}_mean": float(inertia[:-1].mean()),
        f"delta_I{which}": reduced.variation(inertia),
    }


def _rod_model(engine: Engine) -> Scalars:
    """The rod estimated from the main dimensions with the first pin, Ilchenko (20)-(31)."""
    shaft, geometry = engine.crankshaft, engine.geometry
    sizes = rod_model.sizes(
        geometry.bore, shaft.pin_diameters[0],
        shaft.pin_lengths[0] / rods_beside(engine.arrangement, 0), geometry.rod_length,
    )  # fmt: skip
    model = rod_model.estimate(sizes)
    return {
        "rod_model_mass": model.mass,
        "rod_model_centre": model.centre,
        "rod_model_inertia": model.inertia,
        "rod_model_small": model.radius_small,
        "rod_model_big": model.radius_big,
    }
