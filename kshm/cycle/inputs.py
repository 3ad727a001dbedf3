"""Inputs of the cycle calculation as frozen dataclasses, and their check.

SI units: Pa, K, rad/s, m, J/kg.  The codes in the field comments are the names in
the program listing, Gots appendix 2.

None of the usual ranges of the results is printed in Gots.  ``source`` tells whether a range was
seen on a public page ("web") or is common knowledge that nobody checked against a book
("memory"); the latter must not be shown as a book value.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from kshm.cycle.fuel import CycleError, Fuel, check_fuel

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
Source = Literal["memory", "web"]
Group = Literal["petrol", "diesel_na", "diesel_turbo"]
# Boosted petrol has no column of its own: what boost changes is left out for it
_BOOST_CHANGES = {
    "charge.gamma",
    "charge.t_a",
    "charge.eta_v",
    "compression.p_c",
    "compression.t_c",
    "combustion.p_z",
    "expansion.p_b",
    "indicated.p_i",
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


@dataclass(frozen=True, slots=True)
class UsualRange:
    """Usual range of a result in the unit of its `ListedNumber`; ends included."""

    low: float
    high: float
    source: Source = "memory"
    reference: str = ""


def _table(
    petrol: tuple[float, float] | UsualRange | None,
    natural: tuple[float, float] | UsualRange | None,
    turbo: tuple[float, float] | UsualRange | None,
) -> dict[Group, UsualRange]:
    groups: tuple[Group, ...] = ("petrol", "diesel_na", "diesel_turbo")
    table: dict[Group, UsualRange] = {}
    for group, usual in zip(groups, (petrol, natural, turbo), strict=True):
        if usual is not None:
            table[group] = usual if isinstance(usual, UsualRange) else UsualRange(*usual)
    return table


def _web(low: float, high: float, page: str) -> UsualRange:
    return UsualRange(low, high, "web", page)


# Keys are paths in `Cycle`; units are those of the listing (MPa, K).
RANGES: dict[str, dict[Group, UsualRange]] = {
    "inputs.excess_air": _table((0.85, 1.05), (1.4, 1.8), (1.35, 2.0)),
    "inputs.charge_heating": _table((0, 25), (10, 40), (-5, 10)),
    "inputs.t_residual": _table((900, 1100), (600, 900), (600, 900)),
    "charge.gamma": _table((0.04, 0.10), (0.02, 0.05), (0.0, 0.03)),
    "charge.t_a": _table((320, 370), (310, 350), (320, 400)),
    "charge.eta_v": _table((0.70, 0.95), (0.80, 0.94), (0.80, 0.97)),
    "inputs.recharge": _table((1.0, 1.12), (1.0, 1.10), (1.02, 1.10)),
    "inputs.scavenging": _table((1, 1), (1, 1), (0.6, 1.0)),
    "compression.n_1": _table((1.34, 1.38), (1.38, 1.42), (1.32, 1.38)),
    "compression.p_c": _table((0.9, 2.1), (3.5, 5.5), (6.0, 8.0)),
    "compression.t_c": _table((550, 750), (700, 900), (900, 1000)),
    "inputs.xi_z": _table((0.80, 0.95), (0.70, 0.88), (0.70, 0.88)),
    "inputs.xi_b": _table((0.85, 0.95), (0.80, 0.92), (0.82, 0.92)),
    "combustion.lambda_p": _table((3.0, 4.2), (1.2, 2.5), (1.2, 1.8)),
    "combustion.t_z": _table((2400, 3100), (1800, 2300), (1800, 2300)),
    "combustion.p_z": _table((3.5, 7.5), (5, 12), _web(6, 15, "ukrbukva.net 68604")),
    "expansion.n_2": _table((1.23, 1.30), (1.18, 1.28), (1.18, 1.28)),
    "expansion.p_b": _table((0.35, 0.6), (0.2, 0.5), (0.3, 0.8)),
    "expansion.t_b": _table((1200, 1700), (1000, 1200), (1000, 1300)),
    "inputs.fullness": _table((0.94, 0.97), (0.92, 0.95), (0.91, 0.96)),
    "effective.eta_m": _table((0.75, 0.92), (0.70, 0.82), (0.75, 0.90)),
    "indicated.p_i": _table((0.6, 1.4), (0.7, 1.1), (0.0, 2.2)),
}


def usual_ranges(kind: Kind, *, boosted: bool) -> dict[str, UsualRange]:
    """Usual ranges of the results of this kind of engine, by path in `Cycle`."""
    group: Group = "petrol"
    if kind == "diesel":
        group = "diesel_turbo" if boosted else "diesel_na"
    return {
        key: table[group]
        for key, table in RANGES.items()
        if group in table and not (group == "petrol" and boosted and key in _BOOST_CHANGES)
    }
