"""Inputs of the cycle calculation as frozen dataclasses, and their check.

SI units: Pa, K, rad/s, m, J/kg.  The codes in the field comments are the names in
the program listing, Gots appendix 2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from kshm.cycle.fuel import Fuel, check_fuel
from kshm.errors import CycleError

Kind = Literal["diesel", "petrol"]
_RPM = math.pi / 30
# Lowest and highest value of an input in SI units; the file's door takes its limits from here.
LIMITS: dict[str, tuple[float, float]] = {
    "omega": (50 * _RPM, 20000 * _RPM),
    "cylinders": (1, 24),
    "charge_heating": (-60, 120),
    "t_residual": (450, 1500),
    "intake_factor": (0.5, 1.1),
    "exhaust_factor": (0.5, 2.0),
    "xi_z": (0.0, 1.0),
    "xi_b": (0.3, 1.0),
    "fullness": (0.8, 1.0),
    "p_ambient": (0.03e6, 0.2e6),
    "t_ambient": (220, 340),
    "recharge": (0.8, 1.3),
    "scavenging": (0.0, 1.0),
    "h2_co": (0.3, 0.6),
    "lam": (0.1, 0.6),
    "bore": (0.02, 1.2),
    "stroke": (0.02, 3.5),
    "p_max": (1e6, 40e6),
    "boost.pressure_ratio": (1.0, 6.0),
    "boost.compressor_efficiency": (0.3, 0.95),
    "boost.turbine_efficiency": (0.3, 0.95),
    "boost.cooler_pressure_loss": (0.0, 0.1e6),
    "boost.cooler_temperature_drop": (0.0, 250),
    "boost.outlet_pressure_ratio": (1.0, 1.5),
    "boost.exhaust_cp": (1.0e3, 1.4e3),
    "mechanical": (0.3, 1.0),
    "mechanical.a": (0.0, 0.4e6),
    "mechanical.b": (0.0, 0.04e6),
    "power": (0.5e3, 50e6),
    "stroke_bore": (0.5, 2.5),
    "step": (1e-4, 0.02),
}
_KIND_LIMITS: dict[Kind, dict[str, tuple[float, float]]] = {
    "diesel": {"compression_ratio": (10, 26), "excess_air": (1.0, 8.0)},
    "petrol": {"compression_ratio": (4, 16), "excess_air": (0.6, 1.6)},
}
_GAS = 45.0  # molar mass of propane and lighter [kg/kmol]: gases burn where vapours do not
_LEAN_GAS = {"excess_air": (0.6, 2.5)}
# Why an input may not leave its range, where it is more than a number out of hand
_REASONS = {
    ("excess_air", "diesel", True): "diesel_smokes",
    ("compression_ratio", "petrol", False): "petrol_knocks",
}


@dataclass(frozen=True, slots=True)
class FrictionLaw:
    """Mechanical losses p_m = A + B c_m: ``a`` [Pa], ``b`` [Pa·s/m]."""

    a: float
    b: float


@dataclass(frozen=True, slots=True)
class Boost:
    """Turbocharger and intercooler; without a cooler leave its two numbers at 0."""

    pressure_ratio: float  # PIK, π_k
    compressor_efficiency: float  # SK, η_k
    turbine_efficiency: float  # ST, η_t
    cooler_pressure_loss: float = 0.0  # DPX [Pa]
    cooler_temperature_drop: float = 0.0  # DTX [K]
    outlet_pressure_ratio: float = 1.03  # p_out/p_0 behind the turbine
    exhaust_cp: float = 1150.0  # heat capacity of the exhaust gas [J/(kg·K)]


@dataclass(frozen=True, slots=True)
class CycleInputs:
    """Everything the cycle calculation starts from; one engine, one regime.

    A naturally aspirated engine has no ``boost``.  A diesel needs ``p_max``; a
    petrol engine burns at constant volume and has none.  ``bore`` and ``stroke``
    are None until the design mode has found them.
    """

    kind: Kind
    fuel: Fuel
    omega: float  # OV [rad/s]
    cylinders: int  # KC
    compression_ratio: float  # SG, ε
    excess_air: float  # AL, α
    charge_heating: float  # DT, ΔT [K]
    t_residual: float  # TR, T_r [K]
    intake_factor: float  # C1: p_a/p_k
    exhaust_factor: float  # C2: p_r/p_k, naturally aspirated p_r/p_0
    xi_z: float  # CIZ
    xi_b: float  # CIB
    fullness: float  # FID, φ_d of the indicator diagram
    mechanical: float | FrictionLaw  # ETM, η_m, or p_m = A + B c_m
    p_max: float | None = None  # PZ [Pa]
    boost: Boost | None = None
    bore: float | None = None  # DI [m]
    stroke: float | None = None  # SI [m]
    lam: float = 0.28  # ORL, λ = r/l
    offset: float = 0.0  # DEZ [m]; only 0 is supported
    p_ambient: float = 1e5  # PO [Pa]
    t_ambient: float = 298.0  # TO [K], although the listing says °C
    recharge: float = 1.0  # DOZ, φ_доз
    scavenging: float = 1.0  # FIO, φ_оч
    h2_co: float = 0.5  # H2/CO in the products of a rich mixture
    subtract_pumping: bool = False  # take p_r − p_a off p_i (the program does not)
    strokes: int = 4  # τ

    @property
    def external(self) -> bool:
        """Whether the charge carries the fuel as vapour."""
        return self.kind == "petrol"

    @property
    def speed_rpm(self) -> float:
        """Rotational speed n [min⁻¹]."""
        return self.omega * 30 / math.pi


def check_range(
    field: str, value: float, limits: tuple[float, float] | None = None, kind: str = ""
) -> None:
    """Refuse a number outside its range, by default that of ``LIMITS``.

    Raises:
        CycleError: names the input and the range.
    """
    low, high = limits or LIMITS[field]
    slack = 1e-9 * max(abs(low), abs(high))
    if not (math.isfinite(value) and low - slack <= value <= high + slack):
        key = _REASONS.get((field, kind, value < low), "out_of_range")
        raise CycleError(key, field, value=value, low=low, high=high)


def check_inputs(inputs: CycleInputs) -> None:
    """Refuse inputs from which no cycle follows.

    Raises:
        CycleError: the first input that is missing, superfluous or out of range.
    """
    if inputs.kind not in ("diesel", "petrol"):
        raise CycleError("kind_unknown", "kind")
    if inputs.strokes != 4:
        raise CycleError("four_strokes_only", "strokes", strokes=inputs.strokes)
    if inputs.offset != 0:
        raise CycleError("central_only", "offset")
    if int(inputs.cylinders) != inputs.cylinders:
        raise CycleError("cylinders_not_whole", "cylinders", cylinders=inputs.cylinders)
    check_fuel(inputs.fuel)
    kind_limits = _KIND_LIMITS[inputs.kind]
    if inputs.kind == "petrol" and inputs.fuel.vapour_molar_mass <= _GAS:
        kind_limits = kind_limits | _LEAN_GAS
    for field in (*(name for name in LIMITS if hasattr(inputs, name)), *kind_limits):
        value = getattr(inputs, field)
        if value is not None and field != "mechanical":
            check_range(field, value, kind_limits.get(field), inputs.kind)
    if inputs.kind == "diesel" and inputs.p_max is None:
        raise CycleError("diesel_needs_p_max", "p_max")
    if inputs.kind == "petrol" and inputs.p_max is not None:
        raise CycleError("petrol_has_no_p_max", "p_max")
    if isinstance(inputs.mechanical, FrictionLaw):
        _check_parts("mechanical", inputs.mechanical)
    else:
        check_range("mechanical", inputs.mechanical)
    if inputs.boost is not None:
        _check_parts("boost", inputs.boost)


def _check_parts(owner: str, part: FrictionLaw | Boost) -> None:
    for field in (name for name in LIMITS if name.startswith(owner + ".")):
        check_range(field, getattr(part, field.partition(".")[2]))
