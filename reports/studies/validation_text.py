"""Numbers in the running text of the sources, each by its key."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, partial
from typing import Any

import numpy as np

from kshm import solve
from kshm.arrays import Array
from kshm.engine.engine import Geometry
from kshm.mechanics import (
    bearings,
    dimensionless,
    harmonics,
    inertia,
    kinematics,
    masses,
)
from kshm.mechanics.bearings import BearingArrays
from kshm.mechanics.oil_orbit import squeeze_force
from kshm.mechanics.torsion import Modes, Train, modes_of, train_of
from kshm.nomenclature.dizdn_listing import value_of
from kshm.nomenclature.quantity import UNITS
from kshm.results.solution import Solution
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping, load_toml
from reports.inputs.to_si.engine import to_engine
from reports.model.evaluation import evaluate_model
from reports.shared.resources import samples_dir
from reports.studies.validation_checks import UNKNOWN, Lookup, Ours
from reports.studies.validation_lookups import DINN_STEP, listing, minutes, solution
from reports.tables.registry import build_model

Number = Callable[[], Ours]

_R, _LAM, _OMEGA = np.array(0.05), np.array(0.25), np.array(400.0)  # r and ω cancel
_THIRD, _FIFTH = np.array(1 / 3), np.array(0.2)
_PRINTED_STEP = 30  # degrees of the grid of tables П4.1 and П4.2
_DEGREES = np.arange(0.0, 360.0)
_PHI = np.radians(_DEGREES)
_SYMBOLS = {"displacement": "s", "velocity": "v", "acceleration": "j"}
# Table 1 of the paper, its smallest and its largest section: outer diameter of the small end,
# height and width of the section over it, and the wall [mm]; the height grows downwards.
_SECTIONS = {"low": (1.25 * 0.22, 0.50, 1.2, 0.5 * 0.33, 2.5),
             "high": (1.65 * 0.28, 0.55, 1.4, 0.6 * 0.45, 4.0)}  # fmt: skip
_BORES = (80.0, 120.0)
_D50 = 19.2  # specific imbalance of the Д-50 [kg/m]: 192 gf·cm/cm²
_RPM = np.pi / 30
DISCS: dict[str, Number] = {
    "first": lambda: float(modes_of(Train(np.array([211.4, 8.3]), np.array([9.775e6]))).hertz[0]),
}
_WIDTH = 0.5  # B/D


def by_key(numbers: dict[str, Number]) -> Lookup:
    """Look-up of numbers named by the key of their row."""
    return lambda row, _column: numbers[row]()


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
    """Return the curves of figure 6 as the software draws them."""
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


def _extreme(solved: Solution, table: str, column: str, pick: str) -> tuple[float, float]:
    """Extreme of a column and its angle [°]."""
    columns = solved.columns[table]
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
    """Return an input of the run that gives table П4.1."""
    raw: Any = to_mapping(load_toml(samples_dir() / "gots-diesel.toml").model)
    for name in path:
        raw = raw[name]
    return float(raw)


APPENDIX_1: dict[str, Number] = {
    "SR": lambda: _input("gas", "preexpansion_ratio"),
    "VIPN_start": lambda: _input("gas", "exhaust_start_before_bdc_deg"),
    "VIPN_end": lambda: _input("gas", "exhaust_end_after_bdc_deg"),
    "web_3": lambda: 3.0,  # the third line of the list
    "arm_2_l2": lambda: _input("crankshaft", "arms", 1, "l2_mm"),
}


def _two_term(name: str, phi: Array, lam: float) -> Array:
    values: Array = getattr(dimensionless.two_term(phi, np.array(lam)), _SYMBOLS[name])
    return values


def _exact(name: str, phi: Array, lam: float) -> Array:
    values: Array = getattr(dimensionless.exact(phi, np.array(lam)), _SYMBOLS[name])
    return values


def _error(name: str, lam: float, degrees: float) -> float:
    """Error of the two-term formula relative to the local value [%]."""
    phi = np.array(np.radians(degrees))
    return 100 * abs(float(_two_term(name, phi, lam) / _exact(name, phi, lam)) - 1)


def _worst_angle(name: str) -> float:
    """Angle of the greatest error of the two-term formula at λ = 0.32 [°]."""
    degrees = np.linspace(0.0, 180.0, 1801)
    phi = np.radians(degrees)
    return float(degrees[np.abs(_two_term(name, phi, 0.32) - _exact(name, phi, 0.32)).argmax()])


def _change(name: str) -> float:
    """Greatest change between λ = 0.16 and 0.303 over half a turn [%]."""
    phi = np.radians(np.arange(0.0, 181.0))
    return 100 * float(np.abs(_exact(name, phi, 0.303) - _exact(name, phi, 0.16)).max())


def _example_angle() -> float:
    return float(dimensionless.angle_small(np.array(0.1), np.array(0.25)))


def _example_check() -> float:
    return float(_two_term("displacement", np.array(_example_angle()), 0.25))


SEGAL: dict[str, Number] = {
    "alpha_rad": _example_angle,
    "alpha_deg": lambda: float(np.degrees(_example_angle())),
    "cos_alpha": lambda: float(np.cos(_example_angle())),
    "check": _example_check,
    "check_error": lambda: 100 * (0.1 - _example_check()) / 0.1,
    "s_error": lambda: _error("displacement", 0.32, 90),
    "v_error": lambda: _error("velocity", 0.32, 60),
    "j_error": lambda: _error("acceleration", 0.32, 90),
    "j_error_025": lambda: _error("acceleration", 0.25, 90),
    "s_error_angle": lambda: _worst_angle("displacement"),
    "v_error_angle": lambda: _worst_angle("velocity"),
    "j_error_angle": lambda: _worst_angle("acceleration"),
    "j_bdc": lambda: float(_two_term("acceleration", np.array(np.pi), 0.25)) / (1 - 0.25),
    "s_change": lambda: _change("displacement"),
    "v_change": lambda: _change("velocity"),
    "j_change": lambda: _change("acceleration"),
}


def _share(order: int) -> float:
    """Amplitude of an order of s to that of the first, λ = 1/3.4 [%]."""
    return 100 * harmonics.printed_coefficient(1 / 3.4, order)


NEIMAN: dict[str, Number] = {
    "s_order4": lambda: _share(4),
    "j_order4": lambda: 4**2 * _share(4),
    "j_order6": lambda: 6**2 * _share(6),
}


def _centre_error() -> float:
    exact = inertia.centre_speed(_PHI, 0.30, 0.30)
    return float(100 * np.abs(inertia.centre_speed_approx(_PHI, 0.30) / exact - 1).max())


def _velocity_error() -> float:
    inside = _PHI[np.abs(np.sin(_PHI)) > 1e-6]
    ratio = _two_term("velocity", inside, 0.30) / _exact("velocity", inside, 0.30)
    return float(100 * np.abs(ratio - 1).max())


def _section(which: str, *, big: bool) -> tuple[float, float]:
    """Slope and rest of r′² or R′² = slope·D − rest [mm, mm²], Ilchenko (21)."""
    outer, height, raised, width, wall = _SECTIONS[which]
    squares = [
        masses.equal_circle(outer * height * bore * (raised if big else 1), width * bore, wall) ** 2
        for bore in _BORES
    ]
    slope = (squares[1] - squares[0]) / (_BORES[1] - _BORES[0])
    return slope, slope * _BORES[0] - squares[0]


ILCHENKO: dict[str, Number] = {
    "centre_error": _centre_error,
    "velocity_error": _velocity_error,
    "r_small_low": lambda: _section("low", big=False)[0],
    "r_small_high": lambda: _section("high", big=False)[0],
    "r_big_low": lambda: _section("low", big=True)[0],
    "r_big_high": lambda: _section("high", big=True)[0],
    "rest_low": lambda: _section("low", big=False)[1],
    "rest_high": lambda: _section("high", big=False)[1],
    "delta_I_min": lambda: UNKNOWN,
    "delta_I_max": lambda: UNKNOWN,
}


def _gas_second() -> float:
    """t_г2 that ψ = 0.4 at 1630 min⁻¹ implies [Pa]; the paper's curve is not printed."""
    return float((1 - 0.4) * harmonics.inertia_second(_D50, np.array(1630 * _RPM)))


def _full_helps_from() -> float:
    """Speed from which ψ = 1 leaves less than ψ = 0 [min⁻¹]."""
    rpm = np.arange(1200.0, 3001.0)
    t_j = harmonics.inertia_second(_D50, rpm * _RPM)
    gas = np.array(_gas_second())
    helps = harmonics.residual(gas, t_j, 1.0) < harmonics.residual(gas, t_j, 0.0)
    return float(rpm[helps][0])


def _shaft_share() -> float:
    """Force of one shaft over 0.5·λ m_j r ω² of one cylinder."""
    solved = solution("d-240")
    scalars = solved.scalars
    unit = scalars["lam"] * scalars["m_j"] * scalars["r_crank"] * scalars["omega"] ** 2 / 2
    return 1000 * scalars["P_shafts"] / unit / solved.engine.cylinders


CHUDAKOV: dict[str, Number] = {
    # Second-order coefficient of the torque of one mass over m r²ω².
    "inertia_second": lambda: harmonics.inertia_coefficients(0.25)[1],
    "gamma_inertia": lambda: solution("d-240").scalars["gamma_inertia2_deg"],
    "gamma_gas": lambda: solution("d-240").scalars["gamma_gas2_deg"],
    "shaft_force": _shaft_share,
    # h/(ψL) of the two shafts.
    "shaft_offset": lambda: harmonics.shaft_offset(0.5, 0.2) / (0.5 * 0.2),
    "psi_1630": lambda: UNKNOWN,
    "speed_helps": _full_helps_from,
}


@lru_cache(maxsize=1)
def _mwm() -> Modes:
    engine = solution("mwm-6").engine
    if engine.torsion is None:
        raise ValueError("the sample has no train")
    return modes_of(train_of(engine, engine.torsion, 0.0))


def _frequency(number: int) -> float:
    return float(_mwm().hertz[number - 1])


MWM: dict[str, Number] = {f"f{number}": partial(_frequency, number) for number in range(1, 9)}


def _at(form: Callable[[Array, Array], Array], eccentricity: float) -> float:
    return float(form(np.array(eccentricity), np.array(_WIDTH)))


def _degrees(eccentricity: Array, width: Array) -> Array:
    return np.degrees(bearings.attitude(eccentricity, width))


def _squeeze(eccentricity: Array, width: Array) -> Array:
    """So_V at ε signed as ε̇ is: a journal that comes near its shell or leaves it."""
    direction = np.where(eccentricity < 0, np.pi, 0.0)
    force = squeeze_force(np.abs(eccentricity)[None], direction[None], float(width))
    size: Array = np.abs(force[0])
    return size


def _pressure() -> float:
    """Mean pressure of the tractor diesel's crankpin 68 × 38 mm under 11,745 N [MPa]."""
    sizes = (0.068, 0.038, 1.0, 0.057e-3, 230.0, 0.005)
    bearing = BearingArrays(*(np.array([size]) for size in sizes))
    return float(11745 / bearing.area[0]) / UNITS["MPa"].si


FILM: dict[str, Number] = {
    **{f"so_d_{e}": partial(_at, bearings.rotation_number, e / 100)
       for e in (10, 30, 50, 70, 80, 90, 95, 99)},
    **{f"beta_{e}": partial(_at, _degrees, e / 100) for e in (10, 50, 90, 95, 99)},
    **{f"so_v_{e}": partial(_at, _squeeze, e / 100) for e in (-90, -50, 0, 50, 90)},
}  # fmt: skip
PRESSURE: dict[str, Number] = {"k": _pressure}
