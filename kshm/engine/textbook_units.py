"""An engine from numbers in the units of the textbook: millimetres, degrees, MPa, min⁻¹.

    from kshm import in_line, polytropic, solve, throw

Everything else of ``kshm`` is in SI units with angles in radians; these functions are where
a person's units come in without a file.  What no engine can be is refused by ``InputError``.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import TypedDict, Unpack

from kshm.engine import arrangement
from kshm.engine.arrangement import Arrangement, ArticulatedRod, Cylinder, in_row
from kshm.engine.checks import refuse, takes_kinds
from kshm.engine.crankshaft import Crankshaft, EndMass, Throw, Web
from kshm.engine.engine import Engine, Geometry, Method, implausible
from kshm.engine.gas import Gas, PolytropicGas, TabulatedGas
from kshm.engine.masses import DirectMasses
from kshm.errors import InputError, Problem
from kshm.nomenclature.quantity import UNITS

_MM, _MPA, _RPM = (UNITS[unit].si for unit in ("mm", "MPa", "rpm"))
_ARMS = 6

Sizes = float | Collection[float]  # one for all journals or one each


@takes_kinds
def polytropic(
    *,
    intake_mpa: float,
    residual_mpa: float,
    max_mpa: float,
    compression_exponent: float,
    expansion_exponent: float,
    preexpansion_ratio: float = 1.0,
    combustion_start_deg: float,
    injection_advance_deg: float,
    exhaust_open_deg: float,
    exhaust_close_deg: float,
    scavenge_open_deg: float = 0.0,
    ambient_mpa: float = 0.1,
) -> PolytropicGas:
    """Return indicator diagram by polytropes, rounded as Gots 2.1 and figure 22; p is absolute.

    Angles count from TDC before the intake, in a two-stroke engine from TDC of combustion,
    see ``kshm.mechanics.gas.polytropic_pressure``.

    Args:
        intake_mpa: p_a at the intake [MPa].
        residual_mpa: p_r of the exhaust [MPa].
        max_mpa: p_z, the greatest [MPa].
        compression_exponent: n_1 [-].
        expansion_exponent: n_2 [-].
        preexpansion_ratio: ρ of a diesel, 1 of a petrol engine [-].
        combustion_start_deg: c', where the pressure leaves the polytrope [°].
        injection_advance_deg: from the spark or injection to TDC [°].
        exhaust_open_deg: b', where the exhaust opens [°].
        exhaust_close_deg: where it closes [°].
        scavenge_open_deg: where the ports of a two-stroke engine open [°].
        ambient_mpa: outside of the cylinder [MPa].

    Raises:
        InputError: a number that no diagram has.

    >>> polytropic(
    ...     intake_mpa=0.09, residual_mpa=0.11, max_mpa=6, compression_exponent=1.36,
    ...     expansion_exponent=1.25, combustion_start_deg=350, injection_advance_deg=20,
    ...     exhaust_open_deg=500, exhaust_close_deg=560,
    ... ).p_max
    6000000.0
    """
    return PolytropicGas(
        p_ambient=ambient_mpa * _MPA,
        p_intake=intake_mpa * _MPA,
        p_residual=residual_mpa * _MPA,
        p_max=max_mpa * _MPA,
        n_compression=compression_exponent,
        n_expansion=expansion_exponent,
        rho=preexpansion_ratio,
        combustion_start=math.radians(combustion_start_deg),
        ignition_advance=math.radians(injection_advance_deg),
        exhaust_open=math.radians(exhaust_open_deg),
        exhaust_close=math.radians(exhaust_close_deg),
        scavenge_open=math.radians(scavenge_open_deg),
    )


@takes_kinds
def points(
    angles_deg: Collection[float],
    pressures_mpa: Collection[float],
    *,
    smooth: bool = False,
    ambient_mpa: float = 0.1,
) -> TabulatedGas:
    """Return indicator diagram by points, Gots 2.1.

    Args:
        angles_deg: from 0 to the cycle's end, which rise, shape (points,) [°].
        pressures_mpa: absolute pressures there, as many [MPa].
        smooth: by a curve in place of straight lines.
        ambient_mpa: pressure outside of the cylinder [MPa].

    Raises:
        InputError: the lists differ in length, do not rise, or their ends differ.

    >>> points([0, 360, 720], [0.1, 4.0, 0.1]).pressures
    (100000.0, 4000000.0, 100000.0)
    """
    return TabulatedGas(
        p_ambient=ambient_mpa * _MPA,
        angles=tuple(math.radians(angle) for angle in angles_deg),
        pressures=tuple(pressure * _MPA for pressure in pressures_mpa),
        smooth=smooth,
    )


@takes_kinds
def throw(
    *,
    arms_mm: Collection[float],
    web_kg: float,
    pin_kg: float,
    counterweight_kg: float = 0.0,
    web_thickness_mm: float = 0.0,
    web_angle_deg: float = 0.0,
    counterweight_angle_deg: float = 0.0,
) -> Throw:
    """Return one throw with two like webs; masses reduced to the crank radius [kg].

    Args:
        arms_mm: l1 … l6 of Gots figure 35 [mm]; the rods of one pin share l3 + l4 evenly.
        web_kg: mass of one web [kg].
        pin_kg: mass of the crankpin [kg].
        counterweight_kg: mass of the counterweight on one web [kg].
        web_thickness_mm: thickness of a web [mm], 0 where the arms reach its middle.
        web_angle_deg: angle of the web from the crank against rotation [°].
        counterweight_angle_deg: angle of the counterweight from the direction opposite
            the crank along rotation [°].

    Raises:
        InputError: there are not six arms, or a number that no throw has.

    >>> round(throw(arms_mm=[30] * 6, web_kg=0.3, pin_kg=0.2).length, 6)
    0.18
    """
    refuse((len(arms_mm) != _ARMS, f"six arms l1 … l6 are needed, not {len(arms_mm)}"))
    web = Web(
        web_kg, math.radians(web_angle_deg), counterweight_kg, math.radians(counterweight_angle_deg)
    )
    l1, l2, l3, l4, l5, l6 = (arm * _MM for arm in arms_mm)
    thickness = web_thickness_mm * _MM
    return Throw(0.0, (l1, l2, l3, l4, l5, l6), web, web, pin_kg, thickness, thickness)


@takes_kinds
def end_mass(mass_kg: float, angle_deg: float, arm_mm: float) -> EndMass:
    """Return an external counterweight beyond an end journal, Gots 2.7.

    Args:
        mass_kg: its mass reduced to the crank radius [kg].
        angle_deg: its angle from the first crank [°].
        arm_mm: how far beyond the middle of the end journal it stands [mm].

    Raises:
        InputError: a negative mass, a number that is none.

    >>> end_mass(0.4, angle_deg=180, arm_mm=50).arm
    0.05
    """
    return EndMass(mass_kg, math.radians(angle_deg), arm_mm * _MM)


@takes_kinds
def place(
    throw: int,
    axis_deg: float = 0.0,
    *,
    rod_place: float = 0.0,
    pin: int = 0,
    pin_deg: float = 0.0,
    master: int | None = None,
) -> Cylinder:
    """Return the place of one cylinder, for layouts that ``banks`` and ``opposed`` do not make.

    Args:
        throw: its throw, from 0 at the nose.
        axis_deg: its axis from that of cylinder 1, clockwise seen from the nose [°].
        rod_place: where on the pin its rod stands, 0 nearest to the nose, 1 farthest [-],
            Gots figure 36.
        pin: which part of a split pin, from 0.
        pin_deg: how far this part stands ahead of the throw [°].
        master: number from 0 of the cylinder on whose rod this one's hangs.

    Raises:
        InputError: a number that no place has.

    >>> places = [place(0), place(0, axis_deg=90, rod_place=1)]  # a V of two on one throw
    >>> round(places[1].axis, 4)
    1.5708
    """
    return Cylinder(throw, math.radians(axis_deg), rod_place, pin, math.radians(pin_deg), master)


@takes_kinds
def banks(
    throws: int,
    axes_deg: Collection[float],
    *,
    pins_deg: Collection[float] | None = None,
    articulated: bool = False,
) -> Arrangement:
    """Return places of V, W and radial engines: a rod of every bank on each throw, Gots 2.7.2.

    The first bank has cylinders 1 … n from the nose, the second n + 1 … 2n, and so on.

    Args:
        throws: number of throws, 1 for a radial engine of one row.
        axes_deg: axes of the banks, clockwise seen from the nose, shape (banks,) [°].
        pins_deg: how far each bank's part of a split pin stands ahead of its throw [°].
        articulated: the rods of all banks but the first hang on those of the first.

    Raises:
        InputError: no throw, no axis, not as many pins as banks.

    >>> [cylinder.throw for cylinder in banks(throws=3, axes_deg=[-45, 45])]
    [0, 1, 2, 0, 1, 2]
    """
    angles = [float(axis) for axis in axes_deg]
    axes = [math.radians(axis - angles[0]) for axis in angles]
    split = None if pins_deg is None else [math.radians(angle) for angle in pins_deg]
    return arrangement.fan(throws, axes, pin_angles=split, articulated=articulated)


@takes_kinds
def articulated_rod(
    *,
    rod_length_mm: float,
    radius_mm: float,
    angle_deg: float,
    reciprocating_kg: float,
    big_end_kg: float,
) -> ArticulatedRod:
    """Return a rod that hangs on a master rod, Gots figure 2 в.

    Args:
        rod_length_mm: its length [mm].
        radius_mm: distance of its pin from the crankpin [mm].
        angle_deg: angle of that radius from the master rod along the rotation [°].
        reciprocating_kg: m_j of its cylinder [kg].
        big_end_kg: its mass reduced to its pin on the master rod [kg].

    Raises:
        InputError: a number that no rod has.

    >>> articulated_rod(
    ...     rod_length_mm=120, radius_mm=50, angle_deg=60, reciprocating_kg=0.8, big_end_kg=0.3
    ... ).radius
    0.05
    """
    angle = math.radians(angle_deg)
    return ArticulatedRod(rod_length_mm * _MM, radius_mm * _MM, angle, reciprocating_kg, big_end_kg)


class EngineNumbers(TypedDict, total=False):
    """Arguments of ``assemble`` that engines of several layouts may share, typed.

    >>> sizes: EngineNumbers = {"bore_mm": 80, "compression_ratio": 9}
    >>> sizes["bore_mm"]
    80
    """

    bore_mm: float
    crank_radius_mm: float
    rod_length_mm: float
    compression_ratio: float
    speed_rpm: float
    gas: Gas
    reciprocating_kg: float
    rod_big_end_kg: float
    throws: Throw | Sequence[Throw]
    pin_diameter_mm: Sizes
    pin_length_mm: Sizes
    main_diameter_mm: Sizes
    main_lengths_mm: Sizes
    nose: EndMass | None
    rear: EndMass | None
    strokes: int
    method: Method
    step_deg: int
    wear_rays: int
    mechanical_efficiency: float
    indicated_power_kw: float | None
    fullness: float
    name: str


def in_line(*, firing_offsets_deg: Collection[float], **numbers: Unpack[EngineNumbers]) -> Engine:
    """Return an in-line engine with a central mechanism, of what ``assemble`` takes.

    Every cylinder has a throw of its own, cylinder 1 at the nose, γ_i = −θ_i, Gots 2.7.1.

    Args:
        firing_offsets_deg: θ_i, shape (cylinders,) [°].
        **numbers: as of ``assemble``.

    Raises:
        InputError: lists of the wrong length, a number that no engine has.

    >>> from kshm import in_line, points, throw
    >>> sizes = {
    ...     "bore_mm": 80, "crank_radius_mm": 40, "rod_length_mm": 140, "compression_ratio": 9,
    ...     "speed_rpm": 3000, "gas": points([0, 360, 720], [0.1, 4.0, 0.1]),
    ...     "reciprocating_kg": 0.7, "rod_big_end_kg": 0.5,
    ...     "throws": throw(arms_mm=[30] * 6, web_kg=0.3, pin_kg=0.2),
    ...     "pin_diameter_mm": 45, "pin_length_mm": 25, "main_diameter_mm": 50,
    ...     "main_lengths_mm": 28,
    ... }
    >>> engine = in_line(firing_offsets_deg=[0, 540, 180, 360], **sizes)
    >>> engine.cylinders
    4
    """
    return assemble(firing_offsets_deg=firing_offsets_deg, **numbers)


@takes_kinds
def assemble(
    places: Sequence[Cylinder] | None = None,
    *,
    bore_mm: float,
    crank_radius_mm: float,
    rod_length_mm: float,
    compression_ratio: float,
    speed_rpm: float,
    gas: Gas,
    reciprocating_kg: float,
    rod_big_end_kg: float,
    firing_offsets_deg: Collection[float],
    throws: Throw | Sequence[Throw],
    pin_diameter_mm: Sizes,
    pin_length_mm: Sizes,
    main_diameter_mm: Sizes,
    main_lengths_mm: Sizes,
    nose: EndMass | None = None,
    rear: EndMass | None = None,
    crank_offset_mm: float | None = None,
    pin_offset_mm: float | None = None,
    articulated: ArticulatedRod | Sequence[ArticulatedRod] = (),
    strokes: int = 4,
    method: Method = "textbook",
    step_deg: int = 10,
    wear_rays: int = 12,
    mechanical_efficiency: float = 1.0,
    indicated_power_kw: float | None = None,
    fullness: float = 1.0,
    name: str = "engine",
) -> Engine:
    """Return an engine of any layout; the throws stand where the firing offsets want them.

    What looks like a unit mistaken is a ``UserWarning``, one line each.

    Args:
        places: ``banks(...)``, ``opposed(...)`` or a list of ``place(...)``; in a row if None.
        bore_mm: cylinder bore D [mm].
        crank_radius_mm: crank radius r [mm].
        rod_length_mm: length of the rod L [mm].
        compression_ratio: ε [-].
        speed_rpm: rotational speed n [min⁻¹].
        gas: ``polytropic(...)`` or ``points(...)``.
        reciprocating_kg: reciprocating mass m_j of a cylinder [kg].
        rod_big_end_kg: rod mass m_2 that turns with the crankpin [kg].
        firing_offsets_deg: θ_i, shape (cylinders,) [°].
        throws: ``throw(...)``, one for all or one each.
        pin_diameter_mm: diameters of the crankpins [mm], one for all or one per throw.
        pin_length_mm: their working lengths under all rods side by side [mm], likewise; of a
            split pin that of each part.
        main_diameter_mm: diameters of the main journals [mm], one for all or one each.
        main_lengths_mm: their lengths [mm], likewise.
        nose: external counterweight at the nose.
        rear: external counterweight at the rear.
        crank_offset_mm: how far the cylinders' axes pass the shaft on the side to which the
            crank turns at TDC [mm], Gots 1.4.
        pin_offset_mm: how far the piston pins stand from the axes on the same side [mm].
        articulated: ``articulated_rod(...)``, one for all rods that hang or one each.
        strokes: 4 or 2.
        method: ``"textbook"``, two-term acceleration, or ``"exact"``.
        step_deg: step of the tables [°], which must divide the cycle.
        wear_rays: rays of the wear diagrams, 12 or 18.
        mechanical_efficiency: η_m [-].
        indicated_power_kw: indicated power of a cycle calculation [kW], to compare with.
        fullness: φ_п, how much that power was rounded down by [-].
        name: name of the engine.

    Raises:
        InputError: lists of the wrong length, rods of one throw that do not fire together
            with it, a number that no engine has.

    With ``sizes`` as in the example of ``in_line``:

    >>> boxer = assemble(opposed(4), firing_offsets_deg=[0, 360, 540, 180], **sizes)
    >>> boxer.is_in_line
    False
    """
    cylinders = len(firing_offsets_deg)
    refuse(
        (cylinders < 1, "an engine has a cylinder"),
        (mechanical_efficiency == 0, "the mechanical efficiency must be above 0"),
    )
    places = in_row(cylinders) if places is None else tuple(places)
    problem = f"{len(places)} places need as many firing offsets, not {cylinders}"
    refuse((len(places) != cylinders, problem))
    count = 1 + max(each.throw for each in places)
    each_throw = (throws,) * count if isinstance(throws, Throw) else tuple(throws)
    problem = f"{cylinders} cylinders need throws for {count}, not {len(each_throw)}"
    refuse((len(each_throw) != count, problem))
    _check_offsets([float(offset) for offset in firing_offsets_deg], 180.0 * strokes)
    offsets = tuple(math.radians(offset) for offset in firing_offsets_deg)
    angles = _throw_angles(places, offsets, count)
    if isinstance(articulated, ArticulatedRod):
        articulated = (articulated,) * len(arrangement.hung(places))
    engine = Engine(
        geometry=Geometry(
            bore_mm * _MM,
            crank_radius_mm * _MM,
            rod_length_mm * _MM,
            compression_ratio,
            *(None if e is None else e * _MM for e in (crank_offset_mm, pin_offset_mm)),
        ),
        omega=speed_rpm * _RPM,
        gas=gas,
        masses=DirectMasses(reciprocating_kg, rod_big_end_kg),
        crankshaft=Crankshaft(
            throws=tuple(
                replace(one, angle=angle) for one, angle in zip(each_throw, angles, strict=True)
            ),
            nose=nose or EndMass(),
            rear=rear or EndMass(),
            pin_diameters=_sizes(pin_diameter_mm, count),
            pin_lengths=_sizes(pin_length_mm, count),
            main_diameters=_sizes(main_diameter_mm, count + 1),
            main_lengths=_sizes(main_lengths_mm, count + 1),
        ),
        firing_offsets=offsets,
        strokes=strokes,
        method=method,
        step_deg=step_deg,
        rays=wear_rays,
        mechanical_efficiency=mechanical_efficiency,
        indicated_power=None if indicated_power_kw is None else indicated_power_kw * 1e3,
        fullness=fullness,
        name=name,
        arrangement=places,
        articulated=tuple(articulated),
    )
    for odd in implausible(engine):
        warnings.warn(odd, stacklevel=3)  # past the check of the kinds
    return engine


def _check_offsets(offsets: Sequence[float], period: float) -> None:
    """Refuse offsets that do not begin with cylinder 1 or lie outside of the cycle [°]."""
    if offsets[0] != 0:
        problem = f"must begin with 0, not {offsets[0]:g}"
        hint = "angles count from cylinder 1"
        raise InputError(Problem("firing_offsets_deg", problem, hint, value=offsets[0]))
    for offset in offsets:
        if not 0 <= offset < period:
            problem, limits = f"{offset:g}° is outside of the cycle", (0.0, period)
            hint = f"from 0° to below {period:g}°"
            raise InputError(Problem("firing_offsets_deg", problem, hint, limits, offset))


def _sizes(sizes: Sizes, count: int) -> tuple[float, ...]:
    """Sizes of ``count`` journals [m]."""
    each = tuple(sizes) if isinstance(sizes, Collection) else (sizes,) * count
    return tuple(float(size) * _MM for size in each)


def _throw_angles(places: Arrangement, offsets: Sequence[float], count: int) -> list[float]:
    """Angle of every throw [rad] by its first rod; the others must stand on it as they fire."""
    angles: dict[int, float] = {}
    for number, (cylinder, offset) in enumerate(zip(places, offsets, strict=True), 1):
        angle = arrangement.throw_angle(cylinder, offset)
        stands = angles.setdefault(cylinder.throw, angle)
        gap = math.degrees(math.remainder(angle - stands, 2 * math.pi))
        refuse(
            (
                not abs(gap) <= 1e-6,
                f"cylinder {number} fires where throw {cylinder.throw + 1} stands {gap:g}° apart",
            )
        )
    refuse((set(angles) != set(range(count)), f"a throw of {count} carries no rod"))
    return [angles[number] for number in range(count)]
