"""The equivalent train of a crankshaft: inertias, and stiffnesses by three formulas.

The three formulas of the equivalent length are written from memory of the handbooks named
after their authors and were not checked against a print; they differ by 10-30 %, so all are
shown.  What else is estimated here has no source but the sample it was taken from.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from kshm.arrays import Array
from kshm.defaults import PULLEY_SHARE
from kshm.engine.arrangement import hung, pin_counts
from kshm.engine.engine import Engine
from kshm.engine.torsion import StiffnessFormula, Torsion
from kshm.mechanics.masses import point_masses

FORMULAS: tuple[StiffnessFormula, ...] = ("wilson", "carter", "zimanenko")


@dataclass(frozen=True, slots=True)
class Train:
    """A chain of masses on shafts.

    ``inertias`` [kg·m²], shape (masses,); ``stiffnesses`` [N·m/rad] between neighbours, shape
    (masses − 1,); ``left`` and ``right`` from the end masses to the ground, 0 where free.
    ``moduli`` are W_p [m³] of the shafts between, shape (masses − 1,); ``throws`` the throw
    of each mass, −1 where no rod acts.
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
        """The same train with another inertia [kg·m²] at a mass."""
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
    shaft, bore, choice = engine.crankshaft, engine.geometry.bore, engine.balancing
    count = len(shaft.throws)
    main, length = np.array(shaft.main_diameters), np.array(shaft.main_lengths)
    webs = [(t.left_web_thickness + t.right_web_thickness) / 2 for t in shaft.throws]
    share = choice.web_thickness_share * bore
    thickness = [torsion.web_thickness or web or share for web in webs]
    return Sections(
        main_diameter=(main[:-1] + main[1:]) / 2,
        main_bore=np.full(count, torsion.main_bore),
        main_length=(length[:-1] + length[1:]) / 2,
        pin_diameter=np.array(shaft.pin_diameters),
        pin_bore=np.full(count, torsion.pin_bore),
        pin_length=np.array(shaft.pin_lengths) * pin_counts(engine.arrangement),
        thickness=np.array(thickness),
        width=np.full(count, torsion.web_width or choice.web_width_share * bore),
        radius=np.full(count, engine.geometry.crank_radius),
    )


def throw_inertias(engine: Engine) -> Array:
    """Mean reduced inertia of every throw with rods and pistons [kg·m²], shape (throws,).

    (m_ш.ш + Σm_щ + Σm_пр) r² + Σ m_2 r² + Σ m_j r² (1/2 + λ²/8).  An estimate: the masses of
    webs and counterweights are those reduced to r by their centrifugal force, as in Gots 2.3.
    """
    r, lam, shaft = engine.geometry.crank_radius, engine.geometry.lam, engine.crankshaft
    m_j, m_2 = point_masses(engine.masses, engine.geometry.rod_length)
    own = [
        throw.pin_mass
        + throw.left_web.mass
        + throw.right_web.mass
        + throw.left_web.counterweight_mass
        + throw.right_web.counterweight_mass
        for throw in shaft.throws
    ]
    masses = np.array(own)
    articulated = dict(zip(hung(engine.arrangement), engine.articulated, strict=True))
    for number, place in enumerate(engine.arrangement):
        rod = articulated.get(number)
        moving, turning = (m_j, m_2) if rod is None else (rod.reciprocating, rod.big_end)
        masses[place.throw] += turning + moving * (1 / 2 + lam**2 / 8)
    inertias: Array = masses * r**2
    return inertias


def train_of(
    engine: Engine, torsion: Torsion, flywheel: float, formula: StiffnessFormula | None = None
) -> Train:
    """The train given, or the equivalent one of the engine.

    Args:
        engine: the engine.
        torsion: what is given of the train.
        flywheel: inertia of the flywheel where none is given [kg·m²].
        formula: of the stiffness, in place of the chosen one.
    """
    shaft = engine.crankshaft
    if torsion.masses:
        mean = float(np.mean(shaft.main_diameters))
        sizes = [mass.diameter or mean for mass in torsion.masses[:-1]]
        moduli = modulus(np.array(sizes), torsion.main_bore)
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
    diameters = [*shaft.main_diameters]
    springs = _springs(engine, torsion, formula or torsion.formula)
    numbers = [-1, *range(len(throws)), -1]
    if torsion.driven:
        inertias.append(torsion.driven)
        springs.append(torsion.driven_stiffness or springs[-1])
        diameters.append(diameters[-1])
        numbers.append(-1)
    moduli = modulus(np.array(diameters), torsion.main_bore)
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


def modulus(diameter: Array, bore: float) -> Array:
    """Polar modulus W_p = π(D⁴ − d⁴)/(16 D) [m³], elementwise, statics."""
    return np.pi * (diameter**4 - bore**4) / (16 * diameter)
