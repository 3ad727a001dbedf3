"""Torsional vibration of a crankshaft: equivalent train, free and forced vibration, damper.

The three formulas of the equivalent length are written from memory of the handbooks named
after their authors and were not checked against a print; they differ by 10-30 %, so all are
shown.  What else is estimated here has no source but the sample it was taken from.

Free: the symmetric problem J^(−1/2) K J^(−1/2) is solved by the singular values of its factor
√c (θ_{k+1} − θ_k)/√J: the frequencies themselves, not their squares, so low ones keep their
digits beside high ones.

Forced: (−ω²J + iωB + K(1 + iη)) θ = T for each speed and order.  The matrices are tridiagonal,
so the elimination runs over the masses and every step takes all speeds and orders together.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from kshm.arrays import Array
from kshm.defaults import PULLEY_SHARE
from kshm.engine.arrangement import hung, pin_counts
from kshm.engine.engine import Engine
from kshm.engine.torsion import StiffnessFormula, Torsion
from kshm.errors import InputError
from kshm.mechanics import inertia as reduced
from kshm.mechanics.masses import point_masses
from kshm.mechanics.webs import web_thickness, web_width

FORMULAS: tuple[StiffnessFormula, ...] = ("wilson", "carter", "zimanenko")
Complex = NDArray[np.complex128]
_STILL = 1e-9  # of the greatest angle
_SAMPLES = 16  # of the highest order over its period, for the sum in time


@dataclass(frozen=True, slots=True)
class Train:
    """A chain of masses on shafts.

    ``inertias`` [kg·m²], shape (masses,); ``stiffnesses`` [N·m/rad] between neighbours, shape
    (masses − 1,); ``left`` and ``right`` from the end masses to the ground, 0 where free.
    ``moduli`` are the least W_p [m³] of the shafts between, shape (masses − 1,); ``throws`` the
    throw of each mass, −1 where no rod acts.
    """

    inertias: Array
    stiffnesses: Array
    left: float = 0.0
    right: float = 0.0
    moduli: Array | None = None
    throws: tuple[int, ...] = ()

    @property
    def is_free(self) -> bool:
        """Whether the train can turn as a whole."""
        return self.left == 0 and self.right == 0

    @property
    def heaviest(self) -> int:
        """Number of the greatest inertia: the flywheel."""
        return int(np.argmax(self.inertias))

    def with_inertia(self, mass: int, inertia: float) -> Train:
        """Return the same train with another inertia [kg·m²] at a mass."""
        inertias = np.array(self.inertias)
        inertias[mass] = inertia
        return replace(self, inertias=inertias)


@dataclass(frozen=True, slots=True)
class Sections:
    """Sizes of throws [m], shapes (throws,): journal j, pin p, web h × b, crank radius.

    ``pin_length`` is that of all pins of a throw, which a torque passes one after another.
    """

    main_diameter: Array
    main_bore: Array
    main_length: Array
    pin_diameter: Array
    pin_bore: Array
    pin_length: Array
    thickness: Array
    width: Array
    radius: Array

    @property
    def main(self) -> Array:
        """D_j⁴ − d_j⁴ [m⁴], elementwise, by definition."""
        return self.main_diameter**4 - self.main_bore**4

    @property
    def pin(self) -> Array:
        """D_p⁴ − d_p⁴ [m⁴], elementwise, by definition."""
        return self.pin_diameter**4 - self.pin_bore**4

    @property
    def web(self) -> Array:
        """Web thickness times width cubed [m⁴], elementwise, by definition."""
        return self.thickness * self.width**3


def wilson(s: Sections) -> Array:
    """L_e/D_0⁴ of throws [1/m³], elementwise, Ker Wilson (from memory)."""
    return (
        (s.main_length + 0.4 * s.main_diameter) / s.main
        + (s.pin_length + 0.4 * s.pin_diameter) / s.pin
        + (s.radius - 0.2 * (s.main_diameter + s.pin_diameter)) / s.web
    )


def carter(s: Sections) -> Array:
    """L_e/D_0⁴ of throws [1/m³], elementwise, Carter (from memory)."""
    return (
        (s.main_length + 0.8 * s.thickness) / s.main
        + 0.75 * s.pin_length / s.pin
        + 1.5 * s.radius / s.web
    )


def zimanenko(s: Sections) -> Array:
    """L_e/D_0⁴ of throws [1/m³], elementwise, Zimanenko (from memory)."""
    length = (
        s.main_length
        + 0.6 * s.thickness * s.main_diameter / s.main_length
        + (0.8 * s.pin_length + 0.2 * s.width * s.main_diameter / s.radius) * s.main / s.pin
        + s.radius * np.sqrt(s.radius / s.pin_diameter) * s.main / s.web
    )
    return length / s.main


_LENGTHS: dict[StiffnessFormula, Callable[[Sections], Array]] = {
    "wilson": wilson,
    "carter": carter,
    "zimanenko": zimanenko,
}


def compliances(engine: Engine, torsion: Torsion, formula: StiffnessFormula) -> Array:
    """Twist of every throw over its torque [rad/(N·m)], shape (throws,), statics."""
    shear = torsion.shear_modulus * np.pi / 32
    return _LENGTHS[formula](sections(engine, torsion)) / shear


def sections(engine: Engine, torsion: Torsion) -> Sections:
    """Sizes of the throws [m]; the main journal of a throw is the mean of its two."""
    shaft = engine.crankshaft
    count = len(shaft.throws)
    main, length = np.array(shaft.main_diameters), np.array(shaft.main_lengths)
    return Sections(
        main_diameter=(main[:-1] + main[1:]) / 2,
        main_bore=np.full(count, torsion.main_bore),
        main_length=(length[:-1] + length[1:]) / 2,
        pin_diameter=np.array(shaft.pin_diameters),
        pin_bore=np.full(count, torsion.pin_bore),
        pin_length=np.array(shaft.pin_lengths) * pin_counts(engine.arrangement),
        thickness=web_thickness(engine, torsion).mean(axis=1),
        width=np.full(count, web_width(engine, torsion)),
        radius=np.full(count, engine.geometry.crank_radius),
    )


def throw_inertias(engine: Engine) -> Array:
    """Mean reduced inertia of every throw with rods and pistons [kg·m²], shape (throws,).

    Its part of the engine's mean reduced inertia: the throw, Ilchenko (35), counterweights at r,
    those beyond the ends on the end throws, the means of its rods and pistons.  Articulated rods
    have no sums there: Σ m_2 r² + Σ m_j r² (1/2 + λ²/8) of the point masses of all rods.
    """
    r, lam, shaft = engine.geometry.crank_radius, engine.geometry.lam, engine.crankshaft
    weights = np.array([
        throw.left_web.counterweight_mass + throw.right_web.counterweight_mass
        for throw in shaft.throws
    ])  # fmt: skip
    weights[0] += shaft.nose.mass
    weights[-1] += shaft.rear.mass
    inertias: Array = reduced.throw_inertias(engine) + weights * r**2
    articulated = dict(zip(hung(engine.arrangement), engine.articulated, strict=True))
    whole = None if articulated else reduced.moving_mean(engine)
    m_j, m_2 = point_masses(engine.masses, engine.geometry.rod_length)
    for number, cylinder in enumerate(engine.arrangement):
        rod = articulated.get(number)
        moving, turning = (m_j, m_2) if rod is None else (rod.reciprocating, rod.big_end)
        points = (turning + moving * (1 / 2 + lam**2 / 8)) * r**2
        inertias[cylinder.throw] += points if whole is None else whole
    return inertias


def train_of(
    engine: Engine, torsion: Torsion, flywheel: float, formula: StiffnessFormula | None = None
) -> Train:
    """Return the train given, or the equivalent one of the engine.

    Args:
        engine: the engine.
        torsion: what is given of the train.
        flywheel: inertia of the flywheel where none is given [kg·m²].
        formula: of the stiffness, in place of the chosen one.
    """
    if torsion.masses:
        moduli = _given_moduli(engine, torsion)
        return Train(
            np.array([mass.inertia for mass in torsion.masses]),
            np.array([mass.stiffness for mass in torsion.masses[:-1]]),
            torsion.ground,
            torsion.masses[-1].stiffness,
            moduli,
            tuple(-1 if mass.throw is None else mass.throw for mass in torsion.masses),
        )
    throws = throw_inertias(engine) if torsion.throws is None else np.array(torsion.throws)
    inertias = [torsion.pulley or PULLEY_SHARE * throws.mean(), *throws]
    inertias.append(torsion.flywheel or flywheel)
    springs = _springs(engine, torsion, formula or torsion.formula)
    numbers = [-1, *range(len(throws)), -1]
    if torsion.driven:
        inertias.append(torsion.driven)
        springs.append(torsion.driven_stiffness or springs[-1])
        numbers.append(-1)
    moduli = _moduli(engine, torsion)[: len(springs)]
    return Train(np.array(inertias), np.array(springs), torsion.ground, 0.0, moduli, tuple(numbers))


def _springs(engine: Engine, torsion: Torsion, formula: StiffnessFormula) -> list[float]:
    """Stiffnesses from the pulley to the flywheel [N·m/rad]."""
    soft, shear = compliances(engine, torsion, formula), torsion.shear_modulus * np.pi / 32
    last = engine.crankshaft.main_diameters[-1] ** 4 - torsion.main_bore**4
    flange = engine.crankshaft.main_lengths[-1] / 2 / (shear * last)
    between = 2 / (soft[:-1] + soft[1:]) if torsion.throw_stiffness is None else (
        np.array(torsion.throw_stiffness))  # fmt: skip
    return [
        torsion.nose_stiffness or float(1 / soft[0]),
        *(float(value) for value in between),
        torsion.rear_stiffness or float(1 / (soft[-1] / 2 + flange)),
    ]


def _moduli(engine: Engine, torsion: Torsion) -> Array:
    """W_p of the weakest journal of every shaft from the nose [m³], shape (throws + 2,).

    A shaft between two masses runs from crankpin to crankpin over the main journal between; the
    last one is behind the flywheel, as thick as the last main journal.
    """
    shaft = engine.crankshaft
    main = modulus(np.array(shaft.main_diameters), torsion.main_bore)
    pin = modulus(np.array(shaft.pin_diameters), torsion.pin_bore)
    before = np.concatenate([[np.inf], pin])
    behind = np.concatenate([pin, [np.inf]])
    return np.append(np.minimum(main, np.minimum(before, behind)), main[-1])


def _given_moduli(engine: Engine, torsion: Torsion) -> Array:
    """W_p of the shafts of a train given by masses [m³], shape (masses − 1,).

    Where no diameter is given it is the mean main journal or, weaker, a crankpin at its ends.
    """
    shaft = engine.crankshaft
    mean = float(modulus(np.mean(shaft.main_diameters, keepdims=True), torsion.main_bore)[0])
    pin = modulus(np.array(shaft.pin_diameters), torsion.pin_bore)
    moduli = []
    for mass, following in pairwise(torsion.masses):
        pins = [float(pin[each.throw]) for each in (mass, following) if each.throw is not None]
        moduli.append(min([mean, *pins]) if mass.diameter is None else float(
            modulus(np.array([mass.diameter]), torsion.main_bore)[0]))  # fmt: skip
    return np.array(moduli)


def modulus(diameter: Array, bore: float) -> Array:
    """Polar modulus W_p = π(D⁴ − d⁴)/(16 D) [m³], elementwise, statics."""
    return np.pi * (diameter**4 - bore**4) / (16 * diameter)


@dataclass(frozen=True, slots=True)
class Modes:
    """Angular frequencies [rad/s], shape (modes,), and forms with θ_1 = 1, (modes, masses).

    A free train's turning as a whole is left out.  A form that leaves the first mass all but
    still has its greatest angle as 1.
    """

    omega: Array
    forms: Array

    @property
    def hertz(self) -> Array:
        """Frequencies ω/2π [Hz], shape (modes,), by definition."""
        return self.omega / (2 * np.pi)


def modes_of(train: Train) -> Modes:
    """All elastic vibrations of a train, shapes (modes,) [rad/s], (modes, masses), as Holzer's."""
    root = np.sqrt(train.inertias)
    count = len(root)
    springs = np.concatenate([[train.left], train.stiffnesses, [train.right]])
    ends = np.arange(count)
    factor = np.zeros((count + 1, count))
    factor[ends, ends] = np.sqrt(springs[:-1]) / root
    factor[ends + 1, ends] = -np.sqrt(springs[1:]) / root
    _, values, vectors = np.linalg.svd(factor[springs > 0])
    omega = values[::-1]
    forms = vectors[len(values) - 1 :: -1] / root
    number = np.arange(len(forms))
    greatest = forms[number, np.abs(forms).argmax(axis=1)]
    moves = np.abs(forms[:, 0]) > _STILL * np.abs(greatest)
    return Modes(omega, forms / np.where(moves, forms[:, 0], greatest)[:, None])


def nodes(forms: Array) -> Array:
    """Place of the node within each shaft [masses from 1], NaN without one, by definition.

    Args:
        forms: shape (modes, masses).

    Returns:
        shape (modes, masses − 1).
    """
    left, right = forms[:, :-1], forms[:, 1:]
    crosses = (left < 0) != (right < 0)
    first = np.arange(1, forms.shape[1])
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(crosses, first + left / (left - right), np.nan)


def phase_sums(at_cylinders: Array, offsets: Array, orders: Array) -> Array:
    """Length of the vector sum |Σ a_k e^{−iνθ_k}| [-], shape (modes, orders), by definition.

    Args:
        at_cylinders: amplitudes of the forms at the cylinders' throws, (modes, cylinders).
        offsets: firing offsets θ_k [rad], (cylinders,).
        orders: ν per turn, (orders,).
    """
    turns = np.exp(-1j * np.outer(orders, offsets))
    sums: Array = np.abs(at_cylinders @ turns.T)
    return sums


def energy_resistance(train: Train, modes: Modes, damping: Array, loss_factor: float) -> Array:
    """Torque that damping takes from a form of 1 rad [N·m/rad], shape (modes,), conservation.

    ω Σ b_k a_k² + η Σ c_k (a_{k+1} − a_k)²; ``damping`` is b_k [N·m·s/rad], (masses,).
    """
    forms = modes.forms
    twist = (train.stiffnesses * np.diff(forms) ** 2).sum(axis=1)
    twist = twist + train.left * forms[:, 0] ** 2 + train.right * forms[:, -1] ** 2
    lost: Array = modes.omega * (damping * forms**2).sum(axis=1) + loss_factor * twist
    return lost


def form_stress(train: Train, modes: Modes) -> Array:
    """Greatest stress of a form of 1 rad M/W_p [Pa/rad], shape (modes,), statics."""
    if train.moduli is None:
        raise InputError("the shafts have no sections")
    stress: Array = np.abs(train.stiffnesses * np.diff(modes.forms) / train.moduli).max(axis=1)
    return stress


def brought_inertia(train: Train, modes: Modes) -> Array:
    """Inertia of a form brought to the first mass Σ J a² [kg·m²], shape (modes,), definition."""
    brought: Array = (train.inertias * modes.forms**2).sum(axis=1)
    return brought


def best_tuning(share: float) -> tuple[float, float]:
    """Optimum of a tuned damper: κ = 1/(1 + μ) and ζ, ζ² = 3μ/(8(1+μ)³), Den Hartog.

    From memory.  κ is over the frequency without damper, ζ over 2 J_d ω_1.
    """
    return 1 / (1 + share), float(np.sqrt(3 * share / (8 * (1 + share) ** 3)))


def best_viscous(share: float) -> float:
    """Optimum ζ = 1/√(2(1 + μ)(2 + μ)) of a viscous damper over 2 J_d ω_1 [-], from memory."""
    return float(1 / np.sqrt(2 * (1 + share) * (2 + share)))


@dataclass(frozen=True, slots=True)
class Damper:
    """A ring at the first mass: inertia [kg·m²], spring [N·m/rad], damping [N·m·s/rad]."""

    inertia: float
    stiffness: float
    damping: float


@dataclass(frozen=True, slots=True)
class Response:
    """Complex amplitudes at ω = νΩ, shapes (masses or shafts, speeds, orders).

    ``angles`` [rad]; ``torques`` of the shafts between the masses [N·m]; ``work`` of the
    excitation and ``lost`` to damping in a period of each order [J], shape (speeds, orders).
    """

    angles: Complex
    torques: Complex
    work: Array
    lost: Array


def respond(
    train: Train,
    omega: Array,
    excitation: Complex,
    damping: Array,
    loss_factor: float,
    damper: Damper | None = None,
) -> Response:
    """Steady vibration under harmonic torques [rad], [N·m], conservation of momentum.

    Args:
        train: the train.
        omega: ω = νΩ [rad/s], shape (speeds, orders).
        excitation: torques at the masses [N·m], shape (masses, speeds, orders).
        damping: b of each mass [N·m·s/rad], shape (masses,).
        loss_factor: η of the shafts and of the ground.
        damper: at the first mass.
    """
    ring = 0 if damper is None else 1
    inertias, absolute = train.inertias, damping
    soft = 1 + 1j * loss_factor
    springs = [soft * value for value in train.stiffnesses]
    ground = np.zeros(len(inertias) + ring, dtype=complex)
    ground[ring] += soft * train.left
    ground[-1] += soft * train.right
    load = excitation
    if damper is not None:
        inertias = np.concatenate([[damper.inertia], inertias])
        absolute = np.concatenate([[0.0], absolute])
        springs.insert(0, damper.stiffness + 1j * omega * damper.damping)
        load = np.concatenate([np.zeros_like(excitation[:1]), excitation])
    angles = _solved(omega, inertias, absolute, springs, ground, load)
    twist = np.diff(angles, axis=0)
    size = np.abs(twist) ** 2
    lost = sum(np.imag(c) * each for c, each in zip(springs, size, strict=True))
    lost = lost + np.tensordot(np.imag(ground), np.abs(angles) ** 2, 1)
    lost = lost + omega * np.tensordot(absolute, np.abs(angles) ** 2, 1)
    return Response(
        angles[ring:],
        train.stiffnesses[:, None, None] * twist[ring:],
        np.pi * np.imag(load * np.conj(angles)).sum(axis=0),
        np.pi * lost,
    )


def _solved(
    omega: Array,
    inertias: Array,
    damping: Array,
    springs: list[complex] | list[Complex],
    ground: Complex,
    load: Complex,
) -> Complex:
    """Elimination down the train and back up, shape (masses, speeds, orders)."""
    square, count = omega**2, len(inertias)
    roots: list[Complex] = []
    angles = np.array(load, dtype=complex)
    for k in range(count):
        diagonal = ground[k] - square * inertias[k] + 1j * omega * damping[k]
        diagonal = diagonal + (springs[k] if k < count - 1 else 0)
        if k:
            share = springs[k - 1] / roots[k - 1]
            diagonal = diagonal + springs[k - 1] - springs[k - 1] * share
            angles[k] += share * angles[k - 1]
        roots.append(diagonal)
    angles[-1] /= roots[-1]
    for k in range(count - 2, -1, -1):
        angles[k] = (angles[k] + springs[k] * angles[k + 1]) / roots[k]
    return angles


def sum_in_time(amplitudes: Complex, orders: Array, step: float) -> Array:
    """Greatest |Σ_ν A_ν e^{iνφ}| over the cycle [as A], shape (…,) of (…, orders), definition.

    Args:
        amplitudes: complex amplitudes by order.
        orders: ν per turn, multiples of ``step``.
        step: least order of the cycle: ½ of four strokes, 1 of two.
    """
    indices = np.rint(orders / step).astype(int)
    samples = _SAMPLES * int(indices.max())
    spectrum = np.zeros((*amplitudes.shape[:-1], samples // 2 + 1), dtype=complex)
    spectrum[..., indices] = amplitudes * (samples / 2)
    greatest: Array = np.abs(np.fft.irfft(spectrum, samples)).max(axis=-1)
    return greatest


def stresses(train: Train, response: Response) -> Complex:
    """Torsional stress of the shafts M/W_p [Pa], shape (shafts, speeds, orders), statics."""
    if train.moduli is None:
        raise InputError("the shafts have no sections")
    stress: Complex = response.torques / train.moduli[:, None, None]
    return stress
