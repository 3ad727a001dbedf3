"""External speed characteristic by the empirical relations of Leiderman.

With x = n/n_N: N_e = N_N x (a + b x − c x²), so M_e = M_N (a + b x − c x²) with
a + b − c = 1, and g_e = g_N (a' + b' x + c' x²) with a' + b' + c' = 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.errors import CycleError

_DIESEL_FUEL = (1.55, -1.55, 1.0)
_PETROL_FUEL = (1.2, -1.2, 1.0)
# Idle speed as a share of the rated one, used only when it is not given
IDLE_SHARE = {"petrol": 0.16, "diesel": 0.20}


@dataclass(frozen=True, slots=True)
class Leiderman:
    """Coefficients of power (a, b, c) and of consumption (a', b', c').

    ``source`` is "memory" (not checked against a book), "web" or "derived".
    """

    a: float
    b: float
    c: float
    fuel: tuple[float, float, float]
    source: str

    @property
    def x_torque(self) -> float:
        """Speed coefficient K_c = n_M/n_N = b/(2c), Gots 2.9 [-]; at most 1."""
        return min(1.0, self.b / (2 * self.c))

    @property
    def adaptability(self) -> float:
        """Coefficient of adaptability K = M_max/M_N = a + b K_c − c K_c², Gots 2.9 [-]."""
        x = self.x_torque
        return self.a + self.b * x - self.c * x * x


LEIDERMAN: dict[str, Leiderman] = {
    "petrol": Leiderman(1.0, 1.0, 1.0, _PETROL_FUEL, "memory"),
    "diesel": Leiderman(0.87, 1.13, 1.0, _DIESEL_FUEL, "memory"),
    "diesel_prechamber": Leiderman(0.60, 1.40, 1.0, _DIESEL_FUEL, "memory"),
    "diesel_swirl": Leiderman(0.70, 1.30, 1.0, _DIESEL_FUEL, "memory"),
}


def from_adaptability(k: float, k_c: float, base: Leiderman) -> Leiderman:
    """Coefficients that give the wanted K and K_c of Gots 2.9.

    c = (K − 1)/(1 − K_c)², b = 2 c K_c, a = K − c K_c²; the consumption is ``base``'s.

    Raises:
        CycleError: K not above 1, K_c outside 0.3…0.95, or torque would turn negative.
    """
    if not 1.0 < k <= 2.0:
        raise CycleError("adaptability_off", "adaptability", k=k)
    if not 0.3 <= k_c <= 0.95:
        raise CycleError("speed_ratio_off", "speed_ratio", k_c=k_c)
    c = (k - 1) / (1 - k_c) ** 2
    a = k - c * k_c**2
    if a < 0.2:
        raise CycleError("torque_vanishes", "adaptability", k=k, k_c=k_c)
    return Leiderman(a, 2 * c * k_c, c, base.fuel, "derived")


@dataclass(frozen=True, slots=True)
class SpeedCharacteristic:
    """Curves over the speed, shape (points,), read-only.

    ``omega`` [rad/s], ``power`` N_e [W], ``torque`` M_e [N·m], ``consumption`` g_e
    [kg/J], ``fuel_flow`` G_T [kg/s].
    """

    omega: Array
    power: Array
    torque: Array
    consumption: Array
    fuel_flow: Array
    adaptability: float
    speed_ratio: float


@dataclass(frozen=True, slots=True)
class SpeedPoint:
    """A point of the characteristic: speed [rad/s], torque [N·m], power [W].

    ``derived`` if its speed was not given.
    """

    key: str
    omega: float
    torque: float
    power: float
    derived: bool


def curve(
    power: float, omega: float, consumption: float, law: Leiderman, speeds: Array
) -> SpeedCharacteristic:
    """The characteristic at the given speeds, curves of shape (points,), SI [rad/s, N·m, W, kg/J].

    Leiderman's relations, Gots 2.9.

    Args:
        power: N_e at the rated speed [W].
        omega: rated speed [rad/s].
        consumption: g_e at the rated speed [kg/J].
        law: coefficients.
        speeds: speeds [rad/s], any one-dimensional shape.
    """
    omegas = np.array(speeds, dtype=np.float64)
    x = omegas / omega
    torque = power / omega * (law.a + law.b * x - law.c * x * x)
    f = law.fuel
    g_e = consumption * (f[0] + f[1] * x + f[2] * x * x)
    powers = torque * omegas
    flow = g_e * powers
    for array in (omegas, powers, torque, g_e, flow):
        array.setflags(write=False)
    return SpeedCharacteristic(omegas, powers, torque, g_e, flow, law.adaptability, law.x_torque)


def speed_points(
    power: float,
    omega: float,
    law: Leiderman,
    *,
    kind: str,
    omega_torque: float | None = None,
    omega_idle: float | None = None,
) -> tuple[SpeedPoint, SpeedPoint, SpeedPoint]:
    """Rated power, maximum torque and idle; what is not given is derived and marked.

    Args:
        power: N_e at the rated speed [W].
        omega: rated speed [rad/s].
        law: coefficients of the characteristic.
        kind: "diesel" or "petrol", for the idle speed.
        omega_torque: speed of maximum torque [rad/s], when given.
        omega_idle: idle speed [rad/s], when given.

    Raises:
        CycleError: speeds that are not idle < torque ≤ rated.
    """
    middle = law.x_torque * omega if omega_torque is None else omega_torque
    idle = IDLE_SHARE[kind] * omega if omega_idle is None else omega_idle
    if not 0 < idle < middle <= omega * (1 + 1e-12):
        field = "omega_torque" if omega_torque is not None else "omega_idle"
        raise CycleError("speeds_do_not_rise", field, idle=idle, torque=middle, rated=omega)
    x = middle / omega
    torque = power / omega * (law.a + law.b * x - law.c * x * x)
    return (
        SpeedPoint("power", omega, power / omega, power, derived=False),
        SpeedPoint("torque", middle, torque, torque * middle, derived=omega_torque is None),
        SpeedPoint("idle", idle, 0.0, 0.0, derived=omega_idle is None),
    )
