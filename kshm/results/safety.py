"""Safety of main journals and crankpins against fatigue by the textbook's loads."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Scalars
from kshm.engine.bearings import Bearings
from kshm.mechanics import pin_bearing
from kshm.mechanics.fatigue import (
    Swing,
    class_strength,
    concentration,
    polar_modulus,
    safety,
    together,
)
from kshm.results.case import Case
from kshm.results.extremes import first_number
from kshm.results.pin_bearing import bending_forces, oil_hole

_FILLET = 0.06  # of the crankpin's diameter, where the file gives no radius


def safety_scalars(case: Case, asked: Bearings) -> Scalars:
    """Scalars ``safe_…`` of journals and crankpins, SI."""
    s = asked.strength
    factors = {
        key: concentration(shape, s.sensitivity) / (s.size * s.surface)
        for key, shape in (
            ("safe_kf_bend", s.fillet_bending), ("safe_kf_turn", s.fillet_torsion),
            ("safe_kh_bend", s.hole_bending), ("safe_kh_turn", s.hole_torsion),
        )
    }  # fmt: skip
    shaft, raw, index = case.engine.crankshaft, case.raw, case.index
    main, pin = raw.running_main[index, 1:], raw.running_pin[index]
    found = dict(factors)
    least: dict[str, float] = {}
    parts = (
        ("safe_", main, shaft.main_diameters[1:], asked.main_bore, 2),
        ("safe_pin_", pin, shaft.pin_diameters, asked.pin_bore, 1),
    )
    for name, torques, diameters, bore, first in parts:
        modulus = polar_modulus(np.array(diameters), np.array(bore))
        swing = Swing.of(torques.max(axis=1), torques.min(axis=1), modulus)
        fillet, hole = (
            safety(swing, s.torsion, factors[key], s.mean_torsion)
            for key in ("safe_kf_turn", "safe_kh_turn")
        )
        lists = {"W{}_cm3": modulus, "fillet{}": fillet, "hole{}": hole}
        if name == "safe_":
            lists |= {
                "tau_max{}_MPa": swing.mean + swing.amplitude,
                "tau_min{}_MPa": swing.mean - swing.amplitude,
                "tau_a{}_MPa": swing.amplitude,
                "tau_m{}_MPa": swing.mean,
            }
        else:
            lists |= {"a{}_MPa": swing.amplitude, "m{}_MPa": swing.mean}
        for key, values in lists.items():
            found |= {name + key.format(k): float(value) for k, value in enumerate(values, first)}
        least[name + "fillet"], least[name + "hole"] = float(fillet.min()), float(hole.min())
    worst = int(first_number(np.ptp(raw.running_main[index], axis=-1)))
    found["safe_n_main"] = min(found[f"safe_fillet{worst}"], found[f"safe_hole{worst}"])
    found |= {
        "safe_n_turn_fillet": least["safe_pin_fillet"],
        "safe_n_turn_hole": least["safe_pin_hole"],
    }
    if any(place.pin_angle for place in case.engine.arrangement):
        found["safe_n_pin"] = min(least["safe_pin_fillet"], least["safe_pin_hole"])
        return found
    return found | _bending(case, asked, factors, found)


def _bending(case: Case, asked: Bearings, factors: Scalars, turned: Scalars) -> Scalars:
    """The first crankpin bent in the planes of its oil hole and of the crank."""
    s, engine = asked.strength, case.engine
    inward, ahead, lever = bending_forces(case)
    diameter = np.array(engine.crankshaft.pin_diameters[0])
    modulus = polar_modulus(diameter, np.array(asked.pin_bore)) / 2

    def swing(angle: float) -> Swing:
        moment = pin_bearing.on_plane(inward, ahead, angle) * lever
        return Swing.of(moment.max(), moment.min(), modulus)

    hole, crank = swing(oil_hole(case)), swing(0.0)
    n_hole = safety(hole, s.bending, factors["safe_kh_bend"], s.mean_bending)
    n_fillet = safety(crank, s.bending, factors["safe_kf_bend"], s.mean_bending)
    both = [
        float(together(n, np.array(turned[f"safe_n_turn_{where}"])))
        for n, where in ((n_hole, "hole"), (n_fillet, "fillet"))
    ]
    radius = np.array(asked.strength.fillet or _FILLET * float(diameter))
    count = len(engine.crankshaft.throws)
    torsion = max(turned[f"safe_pin_a{k}_MPa"] for k in range(1, count + 1))
    k = {key: factor * s.size * s.surface for key, factor in factors.items()}
    strength, at_hole = (
        float(class_strength(np.array(s.tensile), diameter, r, s.making))
        for r in (radius, np.array(asked.hole / 2))
    )
    equal, equal_hole = (
        float(np.hypot(k[f"safe_k{part}_bend"] * each.amplitude,
                       np.sqrt(3) * k[f"safe_k{part}_turn"] * torsion))
        for part, each in (("f", crank), ("h", hole))
    )  # fmt: skip
    return {
        "safe_sigma_a_MPa": float(hole.amplitude),
        "safe_sigma_m_MPa": float(hole.mean),
        "safe_crank_a_MPa": float(crank.amplitude),
        "safe_crank_m_MPa": float(crank.mean),
        "safe_n_bend_hole": float(n_hole),
        "safe_n_bend_fillet": float(n_fillet),
        "safe_n_hole": both[0],
        "safe_n_fillet": both[1],
        "safe_n_pin": min(both),
        "safe_fillet_mm": float(radius),
        "safe_class_MPa": strength,
        "safe_class_hole_MPa": at_hole,
        "safe_equal_MPa": equal,
        "safe_equal_hole_MPa": equal_hole,
        "safe_class_Q": strength / equal,
        "safe_class_Q_hole": at_hole / equal_hole,
    }
