"""Safety of main journals and crankpins against fatigue by the textbook's loads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array, Columns, Results, Scalars, Tables
from kshm.defaults import FILLET_SHARE
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

# Scalars of the weakest crankpin and the least of all pins, by the rows that they come from.
_WEAKEST = {
    "safe_n_turn_fillet": "safe_pin_turn_fillet{}", "safe_n_turn_hole": "safe_pin_turn_hole{}",
    "safe_sigma_a_MPa": "safe_pin_bend_a{}_MPa", "safe_sigma_m_MPa": "safe_pin_bend_m{}_MPa",
    "safe_crank_a_MPa": "safe_pin_crank_a{}_MPa", "safe_crank_m_MPa": "safe_pin_crank_m{}_MPa",
    "safe_n_bend_hole": "safe_pin_bend_hole{}", "safe_n_bend_fillet": "safe_pin_bend_fillet{}",
    "safe_n_hole": "safe_pin_hole{}", "safe_n_fillet": "safe_pin_fillet{}",
    "safe_n_pin": "safe_pin_n{}",
}  # fmt: skip
_LEAST = {"safe_class_Q": "safe_Q_fillet{}", "safe_class_Q_hole": "safe_Q_hole{}"}


def safety_results(case: Case, asked: Bearings) -> Results:
    """Scalars ``safe_…`` of journals and crankpins and the moments that bend the pins, SI."""
    s = asked.strength
    factors = {
        key: concentration(shape, s.sensitivity) / (s.size * s.surface)
        for key, shape in (
            ("safe_kf_bend", s.fillet_bending), ("safe_kf_turn", s.fillet_torsion),
            ("safe_kh_bend", s.hole_bending), ("safe_kh_turn", s.hole_torsion),
        )
    }  # fmt: skip
    tables: Tables = {}
    if any(place.pin_angle for place in case.engine.arrangement):
        turned = _turned_pins(case, asked, factors)
        pins = turned.rows | _least(turned.fillet, turned.hole)
    else:
        pins, tables = _bent_pins(case, asked, factors)
    weakest = first_number(-pins["safe_pin_n{}"])
    own = {key: float(pins[row][int(weakest) - 1]) for key, row in _WEAKEST.items() if row in pins}
    least = {key: float(pins[row].min()) for key, row in _LEAST.items() if row in pins}
    found = _mains(case, asked, factors) | _numbered(pins, 1)
    return tables, factors | found | own | least | {"safe_pin_weakest": float(weakest)}


def _numbered(rows: Mapping[str, Array], first: int) -> Scalars:
    return {
        key.format(k): float(value)
        for key, values in rows.items()
        for k, value in enumerate(values, first)
    }


def _least(one: Array, other: Array) -> dict[str, Array]:
    return {"safe_pin_n{}": np.minimum(one, other)}


def _mains(case: Case, asked: Bearings, factors: Scalars) -> Scalars:
    """Main journals turned by the running-on torques; the first has none."""
    diameters = np.array(case.engine.crankshaft.main_diameters[1:])
    modulus = polar_modulus(diameters, np.array(asked.main_bore))
    swing, fillet, hole = _turned(case.raw.running_main[case.index, 1:], modulus, asked, factors)
    least = np.minimum(fillet, hole)
    rows = {
        "safe_W{}_cm3": modulus,
        "safe_tau_max{}_MPa": swing.mean + swing.amplitude,
        "safe_tau_min{}_MPa": swing.mean - swing.amplitude,
        "safe_tau_a{}_MPa": swing.amplitude,
        "safe_tau_m{}_MPa": swing.mean,
        "safe_fillet{}": fillet,
        "safe_hole{}": hole,
        "safe_n{}": least,
    }
    weakest = {"safe_main_weakest": float(first_number(-least)) + 1}
    return _numbered(rows, 2) | weakest | {"safe_n_main": float(least.min())}


def _turned(
    torques: Array, modulus: Array, asked: Bearings, factors: Scalars
) -> tuple[Swing, Array, Array]:
    """Swings of stress of all journals, their safety at fillet and oil hole."""
    s, swing = asked.strength, Swing.of(torques.max(axis=1), torques.min(axis=1), modulus)
    fillet, hole = (
        safety(swing, s.torsion, factors[key], s.mean_torsion)
        for key in ("safe_kf_turn", "safe_kh_turn")
    )
    return swing, fillet, hole


@dataclass(frozen=True, slots=True)
class _Turned:
    """Torsion of every crankpin: its rows, stress and safety at fillet and oil hole."""

    rows: dict[str, Array]
    swing: Swing
    modulus: Array
    fillet: Array
    hole: Array


def _turned_pins(case: Case, asked: Bearings, factors: Scalars) -> _Turned:
    diameters = np.array(case.engine.crankshaft.pin_diameters)
    modulus = polar_modulus(diameters, np.array(asked.pin_bore))
    swing, fillet, hole = _turned(case.raw.running_pin[case.index], modulus, asked, factors)
    rows = {
        "safe_pin_W{}_cm3": modulus,
        "safe_pin_a{}_MPa": swing.amplitude,
        "safe_pin_m{}_MPa": swing.mean,
        "safe_pin_turn_fillet{}": fillet,
        "safe_pin_turn_hole{}": hole,
    }
    return _Turned(rows, swing, modulus, fillet, hole)


def _bent_pins(case: Case, asked: Bearings, factors: Scalars) -> tuple[dict[str, Array], Tables]:
    """Every crankpin bent in the planes of its oil hole and of its crank, and turned."""
    s, turned, phi = asked.strength, _turned_pins(case, asked, factors), case.raw.phi
    each = [bending_forces(case, k) for k in range(len(turned.modulus))]
    angles = [oil_hole(case, k) for k in range(len(each))]
    moments = {
        "bend": [pin_bearing.on_plane(inward, ahead, angle) * lever
                 for (inward, ahead, lever), angle in zip(each, angles, strict=True)],
        "crank": [inward * lever for inward, _, lever in each],
    }  # fmt: skip
    table: Columns = {"phi_deg": phi}
    for k, (bend, crank) in enumerate(zip(*moments.values(), strict=True), 1):
        table |= {f"Mbend{k}_Nm": bend, f"Mcrank{k}_Nm": crank}
    rows = turned.rows
    found = {}
    for name, where, part, torsion in (
        ("bend", "hole", "h", turned.hole), ("crank", "fillet", "f", turned.fillet),
    ):  # fmt: skip
        moment = np.array(moments[name])
        swing = Swing.of(moment.max(axis=1), moment.min(axis=1), turned.modulus / 2)
        bending = safety(swing, s.bending, factors[f"safe_k{part}_bend"], s.mean_bending)
        found[where] = together(bending, torsion)
        rows = rows | {
            f"safe_pin_{name}_a{{}}_MPa": swing.amplitude,
            f"safe_pin_{name}_m{{}}_MPa": swing.mean,
            f"safe_pin_bend_{where}{{}}": bending,
            f"safe_pin_{where}{{}}": found[where],
        }
        rows |= _class_rule(case, asked, where, swing, turned)
    return rows | _least(found["fillet"], found["hole"]), {"throw_bending": table}


def _class_rule(
    case: Case, asked: Bearings, where: str, bent: Swing, turned: _Turned
) -> dict[str, Array]:
    """Rule of the classification societies at the fillets or at the oil holes of all pins."""
    s, diameters = asked.strength, np.array(case.engine.crankshaft.pin_diameters)
    radius = np.full_like(diameters, asked.hole / 2)
    shapes = s.hole_bending, s.hole_torsion
    given: dict[str, Array] = {}
    if where == "fillet":
        radius = np.full_like(diameters, s.fillet) if s.fillet else FILLET_SHARE * diameters
        shapes = s.fillet_bending, s.fillet_torsion
        given = {"safe_fillet{}_mm": radius}
    bend, turn = (concentration(shape, s.sensitivity) for shape in shapes)
    strength = class_strength(np.array(s.tensile), diameters, radius, s.making)
    equal = np.hypot(bend * bent.amplitude, np.sqrt(3) * turn * turned.swing.amplitude)
    return given | {
        f"safe_class_{where}{{}}_MPa": strength,
        f"safe_equal_{where}{{}}_MPa": equal,
        f"safe_Q_{where}{{}}": strength / equal,
    }
