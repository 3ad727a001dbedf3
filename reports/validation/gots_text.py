"""Numbers in the running text of the textbook, each by its key."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np

from kshm import solve
from kshm.engine.engine import Geometry
from kshm.mechanics import kinematics
from kshm.nomenclature.dizdn_listing import value_of
from kshm.nomenclature.quantity import UNITS
from kshm.results.solution import Solution
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping, load_toml
from reports.inputs.to_si.engine import to_engine
from reports.model.evaluation import evaluate_model
from reports.shared.resources import samples_dir
from reports.tables.registry import build_model
from reports.validation.checks import Lookup, Ours
from reports.validation.runs import DINN_STEP, listing, solution

Number = Callable[[], Ours]

_R, _LAM, _OMEGA = np.array(0.05), np.array(0.25), np.array(400.0)  # r and ω cancel
_THIRD, _FIFTH = np.array(1 / 3), np.array(0.2)
_PRINTED_STEP = 30  # degrees of the grid of tables П4.1 and П4.2


def by_key(numbers: dict[str, Number]) -> Lookup:
    """Look-up of numbers named by the key of their row."""
    return lambda row, _column: numbers[row]()


def minutes(radians: float) -> float:
    """An angle in minutes, as numbers with minutes are compared."""
    return 60 * float(np.degrees(radians))


@lru_cache(maxsize=1)
def with_masses() -> dict[str, float]:
    """Scalars of the kinematic sample with m′п, m′ш, m′к of section 2.9, by the tables."""
    raw: dict[str, Any] = to_mapping(load_toml(samples_dir() / "gots-p3.toml").model)
    raw["masses"] = {
        "estimate_fuel": "diesel", "estimate_piston_kg_per_m2": 250.0,
        "estimate_rod_kg_per_m2": 288.0, "estimate_throw_kg_per_m2": 150.0,
    }  # fmt: skip
    # The printed masses of the shaft give way to the estimate.
    raw["crankshaft"].pop("pin_mass_kg")
    for web in raw["crankshaft"]["webs"]:
        web.pop("mass_kg")
    scalars = evaluate_model(build_model(load_mapping(raw, source="2.9").model)).scalars
    return {key: float(value) for key, value in scalars.items() if not isinstance(value, str)}


def _displacement(degrees: float) -> float:
    first, second = kinematics.displacement_orders(np.radians(degrees), _R, _LAM)
    return float(first + second)


def _square_crank() -> float:
    phi = np.linspace(0, np.pi / 2, 90001)
    return minutes(float(np.interp(np.pi / 2, phi + kinematics.rod_angle(phi, _LAM), phi)))


def _first_order_ratio() -> float:
    first = kinematics.velocity_orders(np.array(np.pi / 2), _R, _LAM, _OMEGA)[0]
    return float(first / kinematics.mean_velocity(_R, _OMEGA))


SECTION_1_2: dict[str, Number] = {
    "s_90": lambda: _displacement(90) / float(_R),
    "s_90_S": lambda: _displacement(90) / (2 * float(_R)),
    "phi_vmax": lambda: float(np.degrees(kinematics.max_velocity_angle(_LAM))),
    "phi_square": _square_crank,
    "v1_ratio": _first_order_ratio,
}


def _dead_centre(which: int) -> float:
    """φ_1 or φ_2 [rad] of section 1.4 without its sign."""
    angle = float(kinematics.dead_centres(_THIRD, _FIFTH)[which])
    return abs(angle if which == 0 else angle - np.pi)


def _stroke_over_r() -> float:
    geometry = Geometry(0.08, 0.05, 0.15, 10.0, crank_offset=0.01)
    return geometry.stroke / geometry.crank_radius


SECTION_1_4: dict[str, Number] = {
    "sin_phi_1": lambda: float(np.sin(_dead_centre(0))),
    "sin_phi_2": lambda: float(np.sin(_dead_centre(1))),
    "phi_1": lambda: minutes(_dead_centre(0)),
    "phi_2": lambda: minutes(_dead_centre(1)),
    "stroke_r": _stroke_over_r,
    "stroke_gap": lambda: 100 * (_stroke_over_r() / 2 - 1),
}


@lru_cache(maxsize=1)
def figure_6() -> dict[str, Any]:
    """The curves of figure 6 as the software draws them."""
    raw = to_mapping(load_toml(samples_dir() / "gots-p3.toml").model)
    raw["reference"] = {}
    return dict(solve(to_engine(load_mapping(raw, source="6").model)).columns["ref_fig6"])


def _on_figure(key: str) -> float:
    curves = figure_6()
    return float(np.interp(float(_LAM), curves["lambda_value"], curves[key]))


FIGURE_6: dict[str, Number] = {
    "phi_vmax": lambda: _on_figure("phi_vmax_deg"),
    "v1_ratio": lambda: _on_figure("v1_ratio"),
}


def _kinematic(key: str) -> float:
    return solution("gots-p3").scalars[key]


def _mass(key: str) -> float:
    return with_masses()[key]


def _diesel(key: str, step: int | None = DINN_STEP) -> float:
    return solution("gots-diesel", step).scalars[key]


def _at_ninety() -> float:
    columns = solution("gots-p3").columns["P3_1"]
    return float(np.interp(90.0, columns["phi_deg"], columns["s_mm"])) / 1000


def _extreme(found: Solution, table: str, column: str, pick: str) -> tuple[float, float]:
    """Extreme of a column and its angle [°]."""
    columns = found.columns[table]
    at = int(getattr(columns[column], pick)())
    return float(columns[column][at]), float(columns["phi_deg"][at])


def _main(pick: str, part: int) -> float:
    return _extreme(solution("gots-p43", DINN_STEP), "P4_3_3", "R_MPa", pick)[part]


def _running(table: str, column: str, pick: str) -> float:
    return _extreme(solution("gots-diesel", _PRINTED_STEP), table, column, pick)[0]


def _kilonewton(specific: float) -> float:
    return specific * 1000 * _diesel("F_piston")


SECTION_2_9: dict[str, Number] = {
    "L": lambda: _kinematic("L_rod"),
    "s_90": _at_ninety,
    "s_90_S": lambda: _at_ninety() / _kinematic("S_stroke"),
    "omega": lambda: _kinematic("omega"),
    "phi_vmax": lambda: 60 * _kinematic("phi_vmax_deg"),
    "v_max": lambda: _kinematic("v_max"),
    "phi_vmin": lambda: 60 * (360 - _kinematic("phi_vmax_deg")),
    "j_tdc": lambda: _kinematic("j_tdc"),
    "j_bdc": lambda: _kinematic("j_bdc"),
    "F": lambda: _kinematic("F_piston"),
    "m_piston": lambda: _mass("m_piston"),
    "m_rod": lambda: _mass("m_rod"),
    "m_k": lambda: _mass("m_k"),
    "m_1": lambda: _mass("m_1"),
    "m_2": lambda: _mass("m_2"),
    "m_j": lambda: _mass("m_j"),
    "m_r": lambda: _mass("m_r"),
    "p_j_factor": lambda: -_mass("m_j") / _mass("F_piston") / UNITS["MPa"].si,
    "K_r": lambda: -_mass("K_r"),
    "K_r_spec": lambda: -_mass("K_r_spec"),
    "M_factor": lambda: _diesel("r_crank") * _diesel("F_piston"),
    "theta": lambda: float(np.degrees(sorted(solution("gots-diesel").engine.firing_offsets)[1])),
    "M_cycle": lambda: value_of(listing(), "effective.torque"),
    "M_dynamic": lambda: _diesel("M_e"),
    "M_error": lambda: 100 * (1 - _diesel("M_e") / value_of(listing(), "effective.torque")),
    "M_max": lambda: _diesel("M_max", _PRINTED_STEP),
    "M_min": lambda: _diesel("M_min", _PRINTED_STEP),
    "K_r_rod": lambda: _kinematic("K_r_rod"),
    "R_pin_max": lambda: _diesel("Rpin_max"),
    "R_pin_max_kN": lambda: _diesel("Rpin_max_kN"),
    "R_pin_min": lambda: _diesel("Rpin_min"),
    "R_pin_min_kN": lambda: _diesel("Rpin_min_kN"),
    "R_main_max": lambda: _main("argmax", 0),
    "phi_main_max": lambda: _main("argmax", 1),
    "R_main_max_kN": lambda: _kilonewton(_main("argmax", 0)),
    "R_main_min": lambda: _main("argmin", 0),
    "phi_main_min": lambda: _main("argmin", 1),
    "R_main_min_kN": lambda: _kilonewton(_main("argmin", 0)),
    "M_main3_max": lambda: _running("P4_4", "Mmain3_Nm", "argmax"),
    "M_main3_min": lambda: _running("P4_4", "Mmain3_Nm", "argmin"),
    "M_pin3_max": lambda: _running("P4_5", "Mpin3_Nm", "argmax"),
    "M_pin3_min": lambda: _running("P4_5", "Mpin3_Nm", "argmin"),
}


def _input(*path: str | int) -> float:
    """An input of the run that gives table П4.1."""
    found: Any = to_mapping(load_toml(samples_dir() / "gots-diesel.toml").model)
    for name in path:
        found = found[name]
    return float(found)


APPENDIX_1: dict[str, Number] = {
    "SR": lambda: _input("gas", "preexpansion_ratio"),
    "VIPN_start": lambda: _input("gas", "exhaust_start_before_bdc_deg"),
    "VIPN_end": lambda: _input("gas", "exhaust_end_after_bdc_deg"),
    "web_3": lambda: 3.0,  # the third line of the list
    "arm_2_l2": lambda: _input("crankshaft", "arms", 1, "l2_mm"),
}
