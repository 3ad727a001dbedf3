"""Strength of piston, ring, pin, rod, bolts and webs: stresses, forces in the eye, safety.

Where statics is exact, as for thick rings, columns and torsion, it is used; the rest are the fits
of A. I. Kolchin and V. P. Demidov (2008), chapters 11-13, from memory.  SI units.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from kshm.arrays import Array

POISSON = 0.3
_POINTS = 20001  # of a quadrature

Points = tuple[tuple[float, float], ...]
# Of the ring's pressure to the mean one, pear form, from the middle to the gap [deg].
RING: Points = ((0.0, 1.05), (30.0, 1.05), (60.0, 1.14), (90.0, 0.90), (120.0, 0.45), (150.0, 0.67),
                (180.0, 2.85))  # fmt: skip
# Of the pressed eye over the embedding [deg]: N0/P and the size of M0/(P r); the sign is that of
# statics.
EYE_N0: Points = ((95.0, 0.0), (100.0, 0.0001), (105.0, 0.0005), (110.0, 0.0009), (115.0, 0.0018),
                  (120.0, 0.0030), (125.0, 0.0060), (130.0, 0.0085))  # fmt: skip
EYE_M0: Points = ((95.0, 0.0), (100.0, 0.0), (105.0, 0.0001), (110.0, 0.00025), (115.0, 0.0006),
                  (120.0, 0.0011), (125.0, 0.0018), (130.0, 0.0030))  # fmt: skip
# Factor of the torsion of a rectangle by its sides' ratio, as course books print it.
TORSION: Points = ((1.0, 0.208), (1.5, 0.231), (1.75, 0.239), (2.0, 0.246), (2.5, 0.258),
                   (3.0, 0.267), (4.0, 0.282))  # fmt: skip


def between(x: float | Array, points: Points) -> Array:
    """Value of a table at ``x`` [unit of its points], shape of ``x``; lines by definition.

    Beyond the ends it is that of the end.
    """
    abscissas, values = np.array(points).T
    return np.asarray(np.interp(x, abscissas, values))


def land_stresses(pressure: float, bore: float, land: float) -> tuple[float, float, float]:
    """Shear, bending and their sum √(σ² + 4τ²) [Pa] of the first land."""
    slenderness = bore / land
    shear, bending = 0.0314 * pressure * slenderness, 0.0045 * pressure * slenderness**2
    return shear, bending, float(np.hypot(bending, 2 * shear))


def ring_pressure(modulus: float, gap: float, slenderness: float) -> float:
    """Mean pressure [Pa] of a ring on the cylinder; ``gap`` A_0/t, ``slenderness`` D/t."""
    return 0.152 * modulus * gap / ((slenderness - 1) ** 3 * slenderness)


def ring_stresses(
    pressure: float, modulus: float, gap: float, slenderness: float
) -> tuple[float, float]:
    """Greatest stress [Pa] of a ring at work and when it is put on the piston, m = 1.57."""
    work = 2.61 * pressure * (slenderness - 1) ** 2
    put = 4 * modulus * (1 - 0.114 * gap) / (1.57 * (slenderness - 1.4) * slenderness)
    return work, put


@dataclass(frozen=True, slots=True)
class Pin:
    """A hollow piston pin under a force [N]; sizes [m], modulus [Pa]."""

    force: float
    outer: float
    inner: float
    length: float
    modulus: float

    @property
    def alpha(self) -> float:
        """Bore over diameter α [-]."""
        return self.inner / self.outer

    def bending(self, bosses: float, eye: float) -> float:
        """Greatest bending stress [Pa]: even load in the eye, triangles in the bosses."""
        lever = self.length + 2 * bosses - 1.5 * eye
        return self.force * lever / (1.2 * (1 - self.alpha**4) * self.outer**3)

    @property
    def shear(self) -> float:
        """Greatest shear stress [Pa] of the section between eye and boss."""
        a = self.alpha
        return 0.85 * self.force * (1 + a + a**2) / ((1 - a**4) * self.outer**2)

    @property
    def _share(self) -> float:
        return 0.1 - (self.alpha - 0.4) ** 3

    @property
    def ovality(self) -> float:
        """Growth of the diameter across the force [m]."""
        thickness = ((1 + self.alpha) / (1 - self.alpha)) ** 3
        return 1.35 * self.force / (self.modulus * self.length) * thickness * self._share

    @property
    def oval_unit(self) -> float:
        """Factor A of the stresses of the ovality [Pa]."""
        return 15 * self.force / (self.length * self.outer) * self._share

    def oval_stresses(self, *, curved: bool) -> tuple[float, float, float, float]:
        """Stress [Pa] of the ovality outside and inside at 0°, outside and inside at 90°.

        Inside a curved bar has (1 + 2α)/α, its bending being that of the inner fibre; the other
        form (2 + α)/α takes the outer one's part.
        """
        a = self.alpha
        wall = (1 + a) / (1 - a) ** 2
        outer, inner = (2 + a) * wall, ((1 + 2 * a) if curved else (2 + a)) * wall / a
        at_0, at_90 = 1 / (1 - a), 0.636 / (1 - a)
        unit = self.oval_unit
        return (
            unit * (0.19 * outer - at_0),
            -unit * (0.19 * inner + at_0),
            -unit * (0.174 * outer + at_90),
            unit * (0.174 * inner - at_90),
        )


class SectionLoad(NamedTuple):
    """Normal force [N], drawing, and moment [N·m], lowering the curvature, of a section."""

    force: float
    moment: float


def eye_top(force: float, radius: float, embedding: float, *, drawn: bool) -> SectionLoad:
    """Load of the section at the top of the eye by the books' fits; ``embedding`` [deg]."""
    if drawn:
        shares = 0.572 - 0.0008 * embedding, 0.00033 * embedding - 0.0297
    else:
        shares = float(between(embedding, EYE_N0)), -float(between(embedding, EYE_M0))
    return SectionLoad(force * shares[0], force * radius * shares[1])


def eye_section(
    top: SectionLoad, force: float, radius: float, angle: float, *, drawn: bool
) -> SectionLoad:
    """Load of the section ``angle`` [rad] from the top, by equilibrium of the ring between."""
    of_load = float(_of_load(np.array(angle), drawn=drawn))
    lowered = top.moment + top.force * radius * (1 - np.cos(angle)) + force * radius * of_load
    return SectionLoad(float(top.force * np.cos(angle) - force * of_load), float(lowered))


def eye_forces(embedding: float, *, drawn: bool) -> tuple[float, float]:
    """Force and moment in the top of the eye, over P and P·r; ``embedding`` [rad] from the top.

    A thin ring's half from its plane of symmetry to where it is embedded: neither a turn nor a
    shift aside at either end.  Drawn: an even load P/(2r) outwards over the upper half; pressed:
    2P/(πr)·cos over the lower half.

    Returns:
        N_0/P and M_0/(P r).
    """
    angle = np.linspace(0.0, embedding, _POINTS)
    load, lever = _of_load(angle, drawn=drawn), 1 - np.cos(angle)
    # Moment M_0 + N_0(1 − cos φ) + load; no turn: its integral is 0, no shift aside: with cos.
    ones = np.ones_like(angle)
    rows = [[_whole(ones * w, angle), _whole(lever * w, angle)] for w in (ones, np.cos(angle))]
    right = [-_whole(load * w, angle) for w in (ones, np.cos(angle))]
    moment, force = np.linalg.solve(np.array(rows), np.array(right))
    return float(force), float(moment)


def _of_load(angle: Array, *, drawn: bool) -> Array:
    """Moment of the load alone at each angle from the top, over P·r."""
    if drawn:
        upper = -0.5 * (1 - np.cos(np.minimum(angle, np.pi / 2)))
        return np.where(angle <= np.pi / 2, upper, -0.5 * (np.sin(angle) - np.cos(angle)))
    beyond = np.maximum(angle - np.pi / 2, 0.0)
    # A thread of 2P/(πr)·cos ψ over the lower half, ψ from the bottom.
    bracket = np.cos(beyond) / 2 - (beyond + np.pi / 2) / np.pi * np.cos(beyond)
    bracket += np.sin(beyond) / np.pi
    return -np.where(angle <= np.pi / 2, 0.0, bracket)


def _whole(values: Array, angle: Array) -> float:
    """Integral by trapezes."""
    return float(np.sum((values[1:] + values[:-1]) / 2 * np.diff(angle)))


def outer_fibre(
    load: SectionLoad, radius: float, wall: float, length: float, steel: float
) -> float:
    """Stress [Pa] of the eye's outer fibre, a fit of a curved bar; ``steel`` the eye's share K."""
    bent = 2 * load.moment * (6 * radius + wall) / (wall * (2 * radius + wall))
    return (bent + steel * load.force) / (length * wall)


def fit_pressure(
    gap: float, radii: tuple[float, float, float], moduli: tuple[float, float]
) -> float:
    """Pressure [Pa] between two thick rings put together, by Lamé.

    Args:
        gap: interference of the diameters [m].
        radii: inner of the bush, common, outer of the eye [m].
        moduli: of the bush and of the eye [Pa].
    """
    inner, common, outer = radii
    bush, eye = moduli
    # Radial shift of each ring's surface under a unit pressure: A r(1 − ν)/E + B(1 + ν)/(E r).
    widened, narrowed = (_shift(common, at, e) for at, e in ((outer, eye), (inner, bush)))
    return gap / 2 / (widened - narrowed)


def _lame(at: float, other: float) -> tuple[float, float]:
    """Return a and B of Lamé for a unit pressure at a surface, the other free."""
    rows = np.array([[1.0, -1 / at**2], [1.0, -1 / other**2]])
    a, b = np.linalg.solve(rows, np.array([-1.0, 0.0]))
    return float(a), float(b)


def compliance(at: float, other: float) -> float:
    """Shift of a ring's surface under a unit pressure over r/E [-], inwards negative, by Lamé."""
    a, b = _lame(at, other)
    return (1 - POISSON) * a + (1 + POISSON) * b / at**2


def _shift(at: float, other: float, modulus: float) -> float:
    return compliance(at, other) * at / modulus


def hoop_stresses(pressure: float, inner: float, outer: float) -> tuple[float, float]:
    """Hoop stress [Pa] at the inner and outer surface of a thick ring pressed from inside."""
    a, b = _lame(inner, outer)
    return pressure * (a + b / inner**2), pressure * (a + b / outer**2)


def i_section(height: float, width: float, web: float, flange: float) -> tuple[float, float, float]:
    """Area [m²], J across the height and J across the width [m⁴] of an I-section."""
    inside = height - 2 * flange
    area = 2 * width * flange + web * inside
    arm = (height - flange) / 2  # of a flange from the middle, Steiner
    tall = web * inside**3 / 12 + 2 * (width * flange**3 / 12 + width * flange * arm**2)
    wide = inside * web**3 / 12 + 2 * flange * width**3 / 12
    return area, tall, wide


def column_factor(limit: float, area: float, second: float, length: float, modulus: float) -> float:
    """Factor of the shank's stress for buckling: 1 + σ_в F/P_Euler, both ends on hinges."""
    return 1 + limit * area / (np.pi**2 * modulus * second / length**2)


def torsion_factor(ratio: float) -> float:
    """W/(b h²) of a rectangle under torsion by its sides' ratio: as printed, beyond by the series.

    Course books print `TORSION` up to the ratio 4; beyond it `torsion_series` goes on to 1/3.
    """
    if ratio < TORSION[-1][0]:
        return float(between(ratio, TORSION))
    return torsion_series(ratio)


def torsion_series(ratio: float) -> float:
    """W/(b h²) of a rectangle under torsion by its sides' ratio, Saint-Venant's series."""
    odd = np.arange(1, 2001, 2)  # what is left out is below 1e-13
    decay = np.exp(-odd * np.pi * ratio / 2)
    tanh, sech = (1 - decay**2) / (1 + decay**2), 2 * decay / (1 + decay**2)
    alpha = 1 / 3 - 64 / np.pi**5 / ratio * np.sum(tanh / odd**5)
    slope = 1 - 8 / np.pi**2 * np.sum(sech / odd**2)
    return float(alpha / slope)


class StressCycle(NamedTuple):
    """Amplitude and mean of a stress that swings between two values."""

    amplitude: float
    mean: float

    @classmethod
    def of(cls, most: float, least: float) -> StressCycle:
        """Swing between the greatest and the least stress."""
        return cls((most - least) / 2, (most + least) / 2)

    def safety(self, limits: Sequence[float], k: float, mean: float) -> float:
        """Safety of a cycle by fatigue or by yielding, Serensen and Kinasoshvili.

        A pressing mean stress counts as none.

        Args:
            limits: of endurance and of yielding.
            k: concentration over size and surface.
            mean: factor of the mean stress.
        """
        worn, middle = self.amplitude * k, max(self.mean, 0.0)
        endurance, yielding = limits
        share = endurance / yielding  # β: fatigue is met first above (β − α)/(1 − β)
        if worn * (1 - share) > (share - mean) * middle:
            return endurance / (worn + mean * middle)
        return yielding / (worn + middle)
