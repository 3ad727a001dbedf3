"""Numbers in the running text of the companion sources, each by its key."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kshm.mechanics import dimensionless, harmonics, reduced_inertia, rod_model, torque_harmonics
from reports.validation.checks import UNKNOWN
from reports.validation.gots_text import Number
from reports.validation.runs import solution

Array = NDArray[np.float64]

_DEGREES = np.arange(0.0, 360.0)
_PHI = np.radians(_DEGREES)
_SYMBOLS = {"displacement": "s", "velocity": "v", "acceleration": "j"}


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
    exact = reduced_inertia.centre_speed(_PHI, 0.30, 0.30)
    return float(100 * np.abs(reduced_inertia.centre_speed_approx(_PHI, 0.30) / exact - 1).max())


def _velocity_error() -> float:
    inside = _PHI[np.abs(np.sin(_PHI)) > 1e-6]
    ratio = _two_term("velocity", inside, 0.30) / _exact("velocity", inside, 0.30)
    return float(100 * np.abs(ratio - 1).max())


# Table 1 of the paper, its smallest and its largest section: outer diameter of the small end,
# height and width of the section over it, and the wall [mm]; the height grows downwards.
_SECTIONS = {"low": (1.25 * 0.22, 0.50, 1.2, 0.5 * 0.33, 2.5),
             "high": (1.65 * 0.28, 0.55, 1.4, 0.6 * 0.45, 4.0)}  # fmt: skip
_BORES = (80.0, 120.0)


def _section(which: str, *, big: bool) -> tuple[float, float]:
    """Slope and rest of r′² or R′² = slope·D − rest [mm, mm²], Ilchenko (21)."""
    outer, height, raised, width, wall = _SECTIONS[which]
    squares = [
        rod_model.equal_circle(outer * height * bore * (raised if big else 1), width * bore, wall)
        ** 2
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

_D50 = 19.2  # specific imbalance of the Д-50 [kg/m]: 192 gf·cm/cm²
_RPM = np.pi / 30


def _gas_second() -> float:
    """t_г2 that ψ = 0.4 at 1630 min⁻¹ implies [Pa]; the paper's curve is not printed."""
    return float((1 - 0.4) * torque_harmonics.inertia_second(_D50, np.array(1630 * _RPM)))


def _full_helps_from() -> float:
    """Speed from which ψ = 1 leaves less than ψ = 0 [min⁻¹]."""
    rpm = np.arange(1200.0, 3001.0)
    t_j = torque_harmonics.inertia_second(_D50, rpm * _RPM)
    gas = np.array(_gas_second())
    helps = torque_harmonics.residual(gas, t_j, 1.0) < torque_harmonics.residual(gas, t_j, 0.0)
    return float(rpm[helps][0])


def _shaft_share() -> float:
    """Force of one shaft over 0.5·λ m_j r ω² of one cylinder."""
    solved = solution("d-240")
    scalars = solved.scalars
    unit = scalars["lam"] * scalars["m_j"] * scalars["r_crank"] * scalars["omega"] ** 2 / 2
    return 1000 * scalars["P_shafts"] / unit / solved.engine.cylinders


CHUDAKOV: dict[str, Number] = {
    # Second-order coefficient of the torque of one mass over m r²ω².
    "inertia_second": lambda: torque_harmonics.inertia_coefficients(0.25)[1],
    "gamma_inertia": lambda: solution("d-240").scalars["gamma_inertia2_deg"],
    "gamma_gas": lambda: solution("d-240").scalars["gamma_gas2_deg"],
    "shaft_force": _shaft_share,
    # h/(ψL) of the two shafts.
    "shaft_offset": lambda: torque_harmonics.shaft_offset(0.5, 0.2) / (0.5 * 0.2),
    "psi_1630": lambda: UNKNOWN,
    "speed_helps": _full_helps_from,
}
