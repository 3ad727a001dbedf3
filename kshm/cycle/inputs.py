"""Inputs of the cycle calculation as frozen dataclasses, and their check.

SI units: Pa, K, rad/s, m, J/kg.  The codes in the field comments are the names in
the program listing, Gots appendix 2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from kshm.cycle.errors import CycleError, ru
from kshm.cycle.fuel import Fuel, check_fuel

Kind = Literal["diesel", "petrol"]


@dataclass(frozen=True, slots=True)
class FrictionLaw:
    """Mechanical losses p_m = A + B c_m: ``a`` [Pa], ``b`` [Pa·s/m]; ``source`` of both."""

    a: float
    b: float
    source: str = ""


# Losses by piston speed; "web" pages: transportzones.ru/zimads-640-1.html
FRICTION: dict[str, FrictionLaw] = {
    "petrol": FrictionLaw(0.049e6, 0.0152e6, "web"),  # S/D > 1, up to 6 cylinders
    "petrol_injection": FrictionLaw(0.024e6, 0.0053e6, "web"),
    "diesel": FrictionLaw(0.089e6, 0.0118e6, "memory"),  # undivided chamber
}


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


# field: (lowest, highest, symbol, unit, SI per unit)
_Limit = tuple[float, float, str, str, float]
_LIMITS: dict[str, _Limit] = {
    "omega": (50, 20000, "n", "мин⁻¹", math.pi / 30),
    "cylinders": (1, 24, "i", "", 1),
    "charge_heating": (-60, 120, "ΔT", "К", 1),
    "t_residual": (450, 1500, "T_r", "К", 1),
    "intake_factor": (0.5, 1.1, "C1", "", 1),
    "exhaust_factor": (0.5, 2.0, "C2", "", 1),
    "xi_z": (0.0, 1.0, "ξ_z", "", 1),
    "xi_b": (0.3, 1.0, "ξ_b", "", 1),
    "fullness": (0.8, 1.0, "φ_д", "", 1),
    "p_ambient": (0.03, 0.2, "p_0", "МПа", 1e6),
    "t_ambient": (220, 340, "T_0", "К", 1),
    "recharge": (0.8, 1.3, "φ_доз", "", 1),
    "scavenging": (0.0, 1.0, "φ_оч", "", 1),
    "h2_co": (0.3, 0.6, "H2/CO", "", 1),
    "lam": (0.1, 0.6, "λ", "", 1),
    "bore": (20, 1200, "D", "мм", 1e-3),
    "stroke": (20, 3500, "S", "мм", 1e-3),
    "p_max": (1, 40, "p_z", "МПа", 1e6),
}
_KIND_LIMITS: dict[Kind, dict[str, _Limit]] = {
    "diesel": {
        "compression_ratio": (10, 26, "ε", "", 1),
        "excess_air": (1.0, 8.0, "α", "", 1),
    },
    "petrol": {
        "compression_ratio": (4, 16, "ε", "", 1),
        "excess_air": (0.6, 1.6, "α", "", 1),
    },
}
_BOOST_LIMITS: dict[str, _Limit] = {
    "pressure_ratio": (1.0, 6.0, "π_k", "", 1),
    "compressor_efficiency": (0.3, 0.95, "η_k", "", 1),
    "turbine_efficiency": (0.3, 0.95, "η_т", "", 1),
    "cooler_pressure_loss": (0.0, 0.1, "Δp_охл", "МПа", 1e6),
    "cooler_temperature_drop": (0.0, 250, "ΔT_охл", "К", 1),
    "outlet_pressure_ratio": (1.0, 1.5, "p_вых/p_0", "", 1),
    "exhaust_cp": (1.0, 1.4, "c_pг", "кДж/(кг·К)", 1e3),
}
_FRICTION_LIMITS: dict[str, _Limit] = {
    "a": (0.0, 0.4, "A", "МПа", 1e6),
    "b": (0.0, 0.04, "B", "МПа·с/м", 1e6),
}
# What to do when an input leaves its range, where it is more than "change it"
_ADVICE = {
    ("excess_air", "diesel", True): "дизель при α < 1 дымит и этим методом не считается",
    ("compression_ratio", "petrol", False): "бензиновый двигатель с такой ε детонирует",
}


def check_range(field: str, value: float, limit: _Limit, advice: str = "") -> None:
    """Refuse a number outside its range.

    Raises:
        CycleError: names the input, the range and the direction.
    """
    low, high, symbol, unit, scale = limit
    shown = value / scale
    slack = 1e-9 * max(abs(low), abs(high))
    if math.isfinite(shown) and low - slack <= shown <= high + slack:
        return
    verb = "увеличьте" if shown < low else "уменьшите"
    if not math.isfinite(shown):
        verb = "задайте число:"
    tail = f" ({advice})" if advice else ""
    label = f" {unit}" if unit else ""
    msg = (
        f"{symbol} = {ru(shown)}{label}: допускается от {ru(low)} до {ru(high)}; "
        f"{verb} {symbol}{tail}"
    )
    raise CycleError(msg, field)


def check_inputs(inputs: CycleInputs) -> None:
    """Refuse inputs from which no cycle follows.

    Raises:
        CycleError: the first input that is missing, superfluous or out of range.
    """
    if inputs.kind not in ("diesel", "petrol"):
        msg = f"kind = «{inputs.kind}»: выберите diesel или petrol"
        raise CycleError(msg, "kind")
    if inputs.strokes != 4:
        msg = f"τ = {inputs.strokes}: рассчитывается только четырёхтактный цикл; задайте τ = 4"
        raise CycleError(msg, "strokes")
    if inputs.offset != 0:
        msg = "дезаксаж: цикл рассчитывается для центрального механизма; задайте 0"
        raise CycleError(msg, "offset")
    if int(inputs.cylinders) != inputs.cylinders:
        msg = f"i = {ru(inputs.cylinders)}: число цилиндров целое; исправьте i"
        raise CycleError(msg, "cylinders")
    check_fuel(inputs.fuel)
    for field, limit in {**_LIMITS, **_KIND_LIMITS[inputs.kind]}.items():
        value = getattr(inputs, field)
        if value is not None:
            advice = _ADVICE.get((field, inputs.kind, value / limit[4] < limit[0]), "")
            check_range(field, value, limit, advice)
    _check_p_max(inputs)
    _check_mechanical(inputs.mechanical)
    if inputs.boost is not None:
        for field, limit in _BOOST_LIMITS.items():
            check_range(f"boost.{field}", getattr(inputs.boost, field), limit)


def _check_p_max(inputs: CycleInputs) -> None:
    if inputs.kind == "diesel" and inputs.p_max is None:
        msg = "p_z: для дизеля задайте максимальное давление цикла"
        raise CycleError(msg, "p_max")
    if inputs.kind == "petrol" and inputs.p_max is not None:
        msg = "p_z: у бензинового двигателя давление p_z получается из расчёта; уберите его"
        raise CycleError(msg, "p_max")


def _check_mechanical(mechanical: float | FrictionLaw) -> None:
    if isinstance(mechanical, FrictionLaw):
        for field, limit in _FRICTION_LIMITS.items():
            check_range(f"mechanical.{field}", getattr(mechanical, field), limit)
    else:
        check_range("mechanical", mechanical, (0.3, 1.0, "η_м", "", 1))
