"""Reduced inertia, speed fluctuation and flywheel of one engine as columns and scalars."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm.engine.engine import Engine
from kshm.mechanics import reduced_inertia as reduced
from kshm.mechanics import rod_model, speed_fluctuation

if TYPE_CHECKING:
    from kshm.chain.solve import BatchSolution

Array = NDArray[np.float64]
Columns = dict[str, Array]


def gas_torque(engine: Engine, raw: BatchSolution, index: int) -> Array:
    """Torque of the gas forces of all cylinders [N·m], shape (cylinders, angles)."""
    geometry, local = engine.geometry, raw.local_phi[index]
    lam, r = geometry.lam, geometry.crank_radius
    along = np.sqrt(1 / lam**2 - np.sin(local) ** 2)
    # Virtual work: the gas force times ds/dφ.
    arm = r * np.sin(local) * (1 + np.cos(local) / along)
    torque: Array = raw.p_gas[index] * geometry.piston_area * arm
    return torque


def columns(engine: Engine, raw: BatchSolution, index: int) -> dict[str, Columns]:
    """Table ``inertia`` over the cycle in SI units."""
    phi, parts = raw.phi, reduced.parts_of(engine)
    rod, piston = reduced.exact(phi, parts)
    exact = parts.crank_inertia + rod + piston
    near = reduced.approximate(phi, parts)
    whole = reduced.of_engine(phi, engine)
    gas = gas_torque(engine, raw, index).sum(axis=0)
    work = speed_fluctuation.excess_work(raw.torque_sum[index], phi)
    gas_work = speed_fluctuation.excess_work(gas, phi)
    flywheel = speed_fluctuation.flywheel_inertia(
        work, float(whole[:-1].mean()), engine.omega, engine.balancing.irregularity
    )
    omega = speed_fluctuation.speed(gas_work, whole + flywheel, engine.omega)
    table = {
        "phi_deg": phi, "I_rod_kgm2": rod, "I_piston_kgm2": piston, "I_exact_kgm2": exact,
        "I_approx_kgm2": near, "I_error": near / exact - 1, "I_engine_kgm2": whole,
        "Mgas_Nm": gas, "W_J": work, "Wgas_J": gas_work, "omega_1_s": omega,
    }  # fmt: skip
    return {"inertia": table}


def scalars(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    """Scalars of the reduced inertia in SI units."""
    table = columns(engine, raw, index)["inertia"]
    parts = reduced.parts_of(engine)
    exact, whole, omega = table["I_exact_kgm2"], table["I_engine_kgm2"], table["omega_1_s"]
    mean = float(whole[:-1].mean())
    delta = engine.balancing.irregularity
    flywheel = speed_fluctuation.flywheel_inertia(table["W_J"], mean, engine.omega, delta)
    shaft = engine.crankshaft
    sizes = rod_model.sizes(
        engine.geometry.bore, shaft.pin_diameter, shaft.pin_length, engine.geometry.rod_length
    )
    model = rod_model.estimate(sizes)
    return {
        "I_crank": parts.crank_inertia,
        "rod_mass": parts.rod_mass,
        "rod_x": parts.rod_centre,
        "I_rod": parts.rod_inertia,
        "piston_mass": parts.piston_mass,
        "I_counterweights": reduced.counterweight_inertia(engine),
        "I_max": float(exact.max()),
        "I_min": float(exact.min()),
        "I_mean": float(exact[:-1].mean()),
        "delta_I": reduced.variation(exact),
        "I_error_max": float(np.abs(table["I_error"]).max()),
        "I_engine_max": float(whole.max()),
        "I_engine_min": float(whole.min()),
        "I_engine_mean": mean,
        "delta_I_engine": reduced.variation(whole),
        "W_range": float(np.ptp(table["W_J"])),
        "Wgas_range": float(np.ptp(table["Wgas_J"])),
        "I_flywheel": flywheel,
        "delta_work": speed_fluctuation.irregularity(
            table["W_J"], mean + flywheel, engine.omega
        ),
        "omega_max": float(omega.max()),
        "omega_min": float(omega.min()),
        "delta_speed": float(np.ptp(omega) / omega[:-1].mean()),
        "rod_model_mass": model.mass,
        "rod_model_centre": model.centre,
        "rod_model_inertia": model.inertia,
        "rod_model_small": model.radius_small,
        "rod_model_big": model.radius_big,
    }  # fmt: skip
