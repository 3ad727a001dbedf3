"""Results of the cycle calculation as frozen dataclasses, SI units."""

from __future__ import annotations

from dataclasses import dataclass

from kshm.cycle.errors import Remark
from kshm.cycle.fuel import Mixture
from kshm.cycle.inputs import CycleInputs
from kshm.cycle.processes import Charge, Combustion, Compression, Expansion


@dataclass(frozen=True, slots=True)
class Indicated:
    """Indicated figures that do not depend on bore and stroke.

    ``p_theory`` is p_i' of the unrounded diagram [Pa], ``p_i`` = φ p_i';
    ``g_i`` [kg/J] (1 g/(kW·h) = 1/3.6e9 kg/J).
    """

    p_theory: float
    p_i: float
    g_i: float
    eta_i: float


@dataclass(frozen=True, slots=True)
class Effective:
    """Effective figures; powers [W], torque [N·m], flows [kg/s], volumes [m³]."""

    piston_area: float
    displacement: float  # V_h of one cylinder
    mean_piston_speed: float
    p_m: float
    p_e: float
    eta_m: float
    eta_e: float
    g_e: float
    power_i: float
    power_e: float
    torque: float
    fuel_flow: float
    air_flow: float


@dataclass(frozen=True, slots=True)
class Turbo:
    """Compressor and turbine; powers [W], flows [kg/s].

    ``p_t_balance`` is the pressure before the turbine [Pa] at which its power would
    just drive the compressor, ``c2_balance`` = p_t_balance/p_k the C2 to try;
    ``k_gas`` the exponent of the exhaust gas.
    """

    compressor_flow: float
    compressor_power: float
    turbine_flow: float
    p_t: float
    t_t: float
    k_gas: float
    turbine_power: float
    p_t_balance: float
    c2_balance: float


@dataclass(frozen=True, slots=True)
class Cycle:
    """A calculated cycle: inputs, stages in their order, and what needs a look.

    ``warnings`` are remarks; the numbers stand all the same.
    ``listing`` tells whether the peculiarities of the program were switched on.
    """

    inputs: CycleInputs
    mixture: Mixture
    charge: Charge
    compression: Compression
    combustion: Combustion
    expansion: Expansion
    indicated: Indicated
    effective: Effective
    turbo: Turbo | None
    t_residual_check: float
    warnings: tuple[Remark, ...] = ()
    listing: bool = False
