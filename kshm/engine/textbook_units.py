"""An engine from numbers in the units of the textbook: millimetres, degrees, MPa, min⁻¹.

    from kshm import in_line, polytropic, solve, throw

Everything else of ``kshm`` is in SI units with angles in radians; these functions are where
a person's units come in without a file.  An engine of another layout is made from the
dataclasses of ``kshm.engine.engine`` and ``kshm.engine.arrangement``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from kshm.engine.engine import (
    Crankshaft,
    DirectMasses,
    EndMass,
    Engine,
    Gas,
    Geometry,
    Method,
    PolytropicGas,
    TabulatedGas,
    Throw,
    Web,
)

_MM, _MPA = 1e-3, 1e6
_ARMS = 6


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
    """Indicator diagram by polytropes; absolute pressures [MPa], angles in the cycle [°].

    Angles count from TDC before the intake, in a two-stroke engine from TDC of combustion,
    see ``kshm.mechanics.polytropes.polytropic_pressure``.
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


def points(
    angles_deg: Sequence[float],
    pressures_mpa: Sequence[float],
    *,
    smooth: bool = False,
    ambient_mpa: float = 0.1,
) -> TabulatedGas:
    """Indicator diagram by points from 0 to the cycle's end; absolute pressures [MPa].

    Raises:
        ValueError: the lists differ in length, do not rise, or their ends differ.
    """
    if len(angles_deg) != len(pressures_mpa) or len(angles_deg) < 3:
        msg = "as many pressures as angles are needed, three or more"
        raise ValueError(msg)
    if any(b <= a for a, b in pairwise(angles_deg)):
        msg = "angles must rise"
        raise ValueError(msg)
    if angles_deg[0] != 0 or pressures_mpa[0] != pressures_mpa[-1]:
        msg = "the points must begin at 0° and end with the pressure of the beginning"
        raise ValueError(msg)
    return TabulatedGas(
        p_ambient=ambient_mpa * _MPA,
        angles=tuple(math.radians(angle) for angle in angles_deg),
        pressures=tuple(pressure * _MPA for pressure in pressures_mpa),
        smooth=smooth,
    )


def throw(
    *,
    arms_mm: Sequence[float],
    web_kg: float,
    pin_kg: float,
    counterweight_kg: float = 0.0,
    web_thickness_mm: float = 0.0,
    web_angle_deg: float = 0.0,
    counterweight_angle_deg: float = 0.0,
) -> Throw:
    """One throw with two like webs; masses reduced to the crank radius [kg].

    Args:
        arms_mm: l1 … l6 of Gots figure 35 [mm].
        web_kg: mass of one web.
        pin_kg: mass of the crankpin.
        counterweight_kg: mass of the counterweight on one web.
        web_thickness_mm: thickness of a web, 0 where the arms reach its middle.
        web_angle_deg: angle of the web from the crank against rotation [°].
        counterweight_angle_deg: angle of the counterweight from the direction opposite
            the crank along rotation [°].

    Raises:
        ValueError: there are not six arms.
    """
    if len(arms_mm) != _ARMS:
        msg = f"six arms l1 … l6 are needed, not {len(arms_mm)}"
        raise ValueError(msg)
    web = Web(
        web_kg, math.radians(web_angle_deg), counterweight_kg, math.radians(counterweight_angle_deg)
    )
    l1, l2, l3, l4, l5, l6 = (arm * _MM for arm in arms_mm)
    thickness = web_thickness_mm * _MM
    return Throw(0.0, (l1, l2, l3, l4, l5, l6), web, web, pin_kg, thickness, thickness)


def end_mass(mass_kg: float, angle_deg: float, arm_mm: float) -> EndMass:
    """External counterweight beyond an end journal; mass reduced to the crank radius."""
    return EndMass(mass_kg, math.radians(angle_deg), arm_mm * _MM)


def in_line(
    *,
    bore_mm: float,
    crank_radius_mm: float,
    rod_length_mm: float,
    compression_ratio: float,
    speed_rpm: float,
    gas: Gas,
    reciprocating_kg: float,
    rod_big_end_kg: float,
    firing_offsets_deg: Sequence[float],
    throws: Throw | Sequence[Throw],
    pin_diameter_mm: float,
    pin_length_mm: float,
    main_diameter_mm: float,
    main_lengths_mm: float | Sequence[float],
    nose: EndMass | None = None,
    rear: EndMass | None = None,
    strokes: int = 4,
    method: Method = "textbook",
    step_deg: int = 10,
    wear_rays: int = 12,
    mechanical_efficiency: float = 1.0,
    indicated_power_kw: float | None = None,
    fullness: float = 1.0,
    name: str = "engine",
) -> Engine:
    """An in-line engine with a central mechanism; cylinder 1 stands at the nose.

    The throws stand where the firing offsets want them, γ_i = −θ_i, Gots 2.7.1.

    Args:
        bore_mm: cylinder bore D [mm].
        crank_radius_mm: crank radius r [mm].
        rod_length_mm: length of the rod L [mm].
        compression_ratio: ε [-].
        speed_rpm: rotational speed n [min⁻¹].
        gas: ``polytropic(...)`` or ``points(...)``.
        reciprocating_kg: reciprocating mass m_j of a cylinder [kg].
        rod_big_end_kg: rod mass m_2 that turns with the crankpin [kg].
        firing_offsets_deg: θ_i [°], one per cylinder.
        throws: ``throw(...)``, one for all cylinders or one each.
        pin_diameter_mm: diameter of the crankpins [mm].
        pin_length_mm: length of the crankpins [mm].
        main_diameter_mm: diameter of the main journals [mm].
        main_lengths_mm: their lengths [mm], one for all or one each.
        nose: external counterweight at the nose.
        rear: external counterweight at the rear.
        strokes: 4 or 2.
        method: ``"textbook"``, two-term acceleration, or ``"exact"``.
        step_deg: step of the tables [°], which must divide the cycle.
        wear_rays: rays of the wear diagrams, 12 or 18.
        mechanical_efficiency: η_m [-].
        indicated_power_kw: indicated power of a cycle calculation [kW], to compare with.
        fullness: φ_п, how much that power was rounded down by [-].
        name: name of the engine.

    Raises:
        ValueError: lists of the wrong length, a number that no engine has.
    """
    count = len(firing_offsets_deg)
    each = (throws,) * count if isinstance(throws, Throw) else tuple(throws)
    if isinstance(main_lengths_mm, int | float):
        main_lengths_mm = (main_lengths_mm,) * (count + 1)
    _check(count, len(each), len(main_lengths_mm), strokes, step_deg, wear_rays)
    positive = (bore_mm, crank_radius_mm, speed_rpm, compression_ratio - 1)
    if min(positive) <= 0 or rod_length_mm <= crank_radius_mm:
        msg = "bore, crank radius, speed, ε − 1 must be positive, the rod longer than the crank"
        raise ValueError(msg)
    placed = tuple(
        replace(one, angle=math.radians(-offset % 360))
        for one, offset in zip(each, firing_offsets_deg, strict=True)
    )
    return Engine(
        geometry=Geometry(
            bore_mm * _MM, crank_radius_mm * _MM, rod_length_mm * _MM, compression_ratio
        ),
        omega=speed_rpm * math.pi / 30,
        gas=gas,
        masses=DirectMasses(reciprocating_kg, rod_big_end_kg),
        crankshaft=Crankshaft(
            throws=placed,
            nose=nose or EndMass(),
            rear=rear or EndMass(),
            pin_diameter=pin_diameter_mm * _MM,
            pin_length=pin_length_mm * _MM,
            main_diameter=main_diameter_mm * _MM,
            main_lengths=tuple(length * _MM for length in main_lengths_mm),
        ),
        firing_offsets=tuple(math.radians(offset) for offset in firing_offsets_deg),
        strokes=strokes,
        method=method,
        step_deg=step_deg,
        rays=wear_rays,
        mechanical_efficiency=mechanical_efficiency,
        indicated_power=None if indicated_power_kw is None else indicated_power_kw * 1e3,
        fullness=fullness,
        name=name,
    )


def _check(cylinders: int, throws: int, journals: int, strokes: int, step: int, rays: int) -> None:
    problems = [
        (cylinders < 1, "an engine has a cylinder"),
        (throws != cylinders, f"{cylinders} cylinders need as many throws, not {throws}"),
        (journals != cylinders + 1, f"{cylinders} throws need a main journal more, not {journals}"),
        (strokes not in (2, 4), "strokes are 2 or 4"),
        (step < 1 or (strokes * 180) % step != 0, "the step must divide the cycle"),
        (rays not in (12, 18), "wear diagrams have 12 or 18 rays"),
    ]
    for wrong, msg in problems:
        if wrong:
            raise ValueError(msg)
