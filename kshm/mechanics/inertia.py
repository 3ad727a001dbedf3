"""Reduced moment of inertia over the crank angle, speed over the cycle, flywheel.

@article{ilchenko2011,
  author = {Ільченко, А. В. and Кубрак, Ю. О. and Ломакін, В. О.},
  title  = {Приведений момент інерції кривошипно-шатунного механізма одноциліндрового
            поршневого двигуна внутрішнього згоряння},
  year   = {2011},
}

x_L is the distance of the rod's centre of mass from the piston pin: only with this
reading does the paper's (11) stay near its (10).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.defaults import STEEL
from kshm.engine.arrangement import pin_counts
from kshm.engine.engine import Engine
from kshm.engine.masses import RodMasses
from kshm.mechanics import dimensionless
from kshm.mechanics.webs import web_thickness, web_width

_WEB_ALLOWANCE = 0.01  # m, in the height of the web under (34)
_TURN = np.linspace(0.0, 2 * np.pi, 720, endpoint=False)


@dataclass(frozen=True, slots=True)
class Parts:
    """Moving parts of one cylinder, SI units."""

    radius: float
    rod_length: float
    crank_inertia: float  # I_к of the first throw about the shaft
    rod_mass: float
    rod_centre: float  # x_L, from the piston pin
    rod_inertia: float  # about the rod's own centre of mass
    piston_mass: float
    offset: float = 0.0  # k = e/r of Gots 1.4

    @property
    def lam(self) -> float:
        """λ = R/L [-]."""
        return self.radius / self.rod_length


def parts_of(engine: Engine) -> Parts:
    """Parts of an engine; a rod that is not given follows from m_2 and the chosen share."""
    geometry, choice, masses = engine.geometry, engine.balancing, engine.masses
    length = geometry.rod_length
    if isinstance(masses, RodMasses):
        rod, centre, piston = masses.rod, masses.centre, masses.piston_group
        known = masses.inertia
    else:
        share = choice.rod_small_end_share
        rod = masses.rod_big_end / (1 - share)
        centre, piston = (1 - share) * length, masses.reciprocating - share * rod
        known = None
    inertia = choice.rod_mass_factor * rod * centre * (length - centre)
    return Parts(
        radius=geometry.crank_radius,
        rod_length=length,
        crank_inertia=float(throw_inertias(engine)[0]),
        rod_mass=rod,
        rod_centre=centre,
        rod_inertia=inertia if known is None else known,
        piston_mass=piston,
        offset=geometry.relative_offset,
    )


def throw_inertias(engine: Engine) -> Array:
    """Moment of inertia of every throw without counterweights [kg·m²], Ilchenko (32)-(35).

    Shape (throws,).  With d⁴ in (32), (33) and the web's thickness in (34), as dimensions
    demand; the main journal is the mean one, half of it on either side.  A split pin has its
    parts one beside another.
    """
    shaft, r = engine.crankshaft, engine.geometry.crank_radius
    pin = np.array(shaft.pin_diameters)
    pin_length = np.array(shaft.pin_lengths) * pin_counts(engine.arrangement)
    main, main_length = np.array(shaft.main_diameters), np.array(shaft.main_lengths)
    pins = cylinder_inertia(pin, pin_length) + STEEL * np.pi * pin**2 / 4 * pin_length * r**2
    height = r + (pin + main.mean()) / 2 + _WEB_ALLOWANCE
    width, both = web_width(engine), web_thickness(engine).sum(axis=1)
    webs = STEEL * height * width * both * ((height**2 + width**2) / 12 + r**2 / 4)
    inertias: Array = cylinder_inertia(main, main_length).mean() + pins + webs
    return inertias


def cylinder_inertia(diameter: Array, length: Array) -> Array:
    """Moment of inertia of a steel cylinder [kg·m²], elementwise, Ilchenko (32)."""
    return STEEL * np.pi * diameter**4 / 32 * length


def piston_speed(phi: Array, lam: float, k: float = 0.0) -> Array:
    """Speed of the piston over ωR [-], elementwise, Gots 1.4: by the rod's direction, k is e/r."""
    if k == 0:
        return dimensionless.exact(phi, np.array(lam)).v
    side = np.sin(phi) - k
    speed: Array = np.sin(phi) + np.cos(phi) * side / np.sqrt(1 / lam**2 - side**2)
    return speed


def centre_speed(phi: Array, lam: float, share: float, k: float = 0.0) -> Array:
    """Speed of the rod's centre of mass over ωR [-], elementwise, Ilchenko (10).

    Args:
        phi: crank angle [rad].
        lam: λ [-].
        share: distance of the centre from the crankpin over the rod length, (L − x_L)/L.
        k: relative offset e/r [-].
    """
    # Straight from the coordinates: the point divides pin and crankpin by ``share``.
    across = (1 - share) * np.cos(phi)
    along = (1 - share) * np.sin(phi) + share * piston_speed(phi, lam, k)
    return np.hypot(along, across)


def centre_speed_approx(phi: Array, share: float) -> Array:
    """Return the paper's approximation of ``centre_speed`` [-], elementwise, Ilchenko (11)."""
    return np.abs(share * np.cos(phi) ** 2 - 1)


def exact(phi: Array, parts: Parts) -> tuple[Array, Array]:
    """Reduced inertia of rod and piston 2T/ω² [kg·m²], elementwise, exact, Ilchenko (10)."""
    lam, k = parts.lam, parts.offset
    share = 1 - parts.rod_centre / parts.rod_length
    turning = np.cos(phi) / np.sqrt(1 / lam**2 - (np.sin(phi) - k) ** 2)  # ω_ш/ω
    centre = parts.radius * centre_speed(phi, lam, share, k)
    rod = parts.rod_mass * centre**2 + parts.rod_inertia * turning**2
    piston = parts.piston_mass * (parts.radius * piston_speed(phi, lam, k)) ** 2
    return rod, piston


def moving_mean(engine: Engine) -> float:
    """Mean over a turn of the reduced inertia of a rod with its piston [kg·m²], Ilchenko (10)."""
    rod, piston = exact(_TURN, parts_of(engine))
    return float((rod + piston).mean())


def approximate(phi: Array, parts: Parts) -> Array:
    """Reduced inertia of a cylinder with its throw [kg·m²], elementwise, Ilchenko (19), m_п."""
    lam, cosine = parts.lam, np.cos(phi)
    share = 1 - parts.rod_centre / parts.rod_length
    rod = parts.rod_mass * (parts.radius * (share * cosine**2 - 1)) ** 2
    turning = parts.rod_inertia * (lam * cosine) ** 2
    piston = parts.piston_mass * (parts.radius * np.sin(phi) * (1 + lam * cosine)) ** 2
    return parts.crank_inertia + rod + turning + piston


def counterweight_inertia(engine: Engine) -> float:
    """Least moment of inertia of all counterweights: masses reduced to R, at R [kg·m²]."""
    shaft = engine.crankshaft
    webs = [web for throw in shaft.throws for web in (throw.left_web, throw.right_web)]
    mass = sum(web.counterweight_mass for web in webs) + shaft.nose.mass + shaft.rear.mass
    return mass * engine.geometry.crank_radius**2


def of_engine(phi: Array, engine: Engine) -> Array:
    """Reduced inertia of the engine without flywheel [kg·m²], shape (angles,), Ilchenko (10)."""
    parts = parts_of(engine)
    phases = phi[None, :] - np.array(engine.firing_offsets)[:, None]
    rod, piston = exact(phases, parts)
    shaft = float(throw_inertias(engine).sum()) + counterweight_inertia(engine)
    total: Array = (rod + piston).sum(axis=0) + shaft
    return total


def variation(values: Array) -> float:
    """δ_I = (I_max − I_min)/(I_max + I_min) [-], shape (angles,); Ilchenko defines none."""
    return float((values.max() - values.min()) / (values.max() + values.min()))


def excess_work(torque: Array, phi: Array) -> Array:
    """Work of the torque above its mean since the first angle [J], shape (angles,), Gots 2.8.

    It closes over the cycle.

    Args:
        torque: engine torque over the cycle [N·m], the last value repeats the first.
        phi: shaft angle [rad], shape (angles,).
    """
    steps = ((torque[1:] + torque[:-1]) / 2 - torque[:-1].mean()) * np.diff(phi)
    return np.concatenate([[0.0], np.cumsum(steps)])


def flywheel_inertia(work: Array, engine_inertia: float, omega: float, delta: float) -> float:
    """Flywheel [kg·m²] that keeps the irregularity at ``delta``, Gots 2.8; 0 if none is needed.

    ``work`` is the excess work [J], shape (angles,).
    """
    return max(0.0, float(np.ptp(work)) / (delta * omega**2) - engine_inertia)


def irregularity(work: Array, inertia: float, omega: float) -> float:
    """Coefficient of cyclic irregularity ΔA/(I·ω²) [-] of ``work`` of shape (angles,), Gots 2.8."""
    return float(np.ptp(work)) / (inertia * omega**2)


def speed(work: Array, inertia: Array, omega: float) -> Array:
    """Angular velocity over the cycle [rad/s], shape (angles,), by energy, Ilchenko (1).

    Args:
        work: excess work of the gas forces alone [J]: the inertia forces are in I(φ).
        inertia: reduced moment of inertia with the flywheel I(φ) [kg·m²].
        omega: mean angular velocity [rad/s], met to the order of the irregularity squared.
    """
    energy = inertia[:-1].mean() * omega**2 / 2 + work - work[:-1].mean()
    omegas: Array = np.sqrt(2 * energy / inertia)
    return omegas
