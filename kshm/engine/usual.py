"""Usual sizes of real engines, wide: what lies outside betrays a unit mistaken."""

from __future__ import annotations

import math
from collections.abc import Iterator

from kshm.engine.engine import Engine
from kshm.engine.gas import TabulatedGas
from kshm.engine.masses import DirectMasses
from kshm.nomenclature.quantity import UNITS

STROKE_TO_BORE = (0.6, 4.5)  # up to crosshead engines
MEAN_SPEED = (2.8, 26.0)  # of the piston [m/s]
PEAK_PRESSURE = (1.2, 25.0)  # [MPa]
SMALL_END_SHARE = (0.2, 0.3)  # of the rod's mass on the piston pin, Gots 2.2
_RECIPROCATING = (30.0, 2000.0)  # over the piston's area [kg/m²], from models to ships


def implausible(engine: Engine) -> Iterator[str]:
    """What hardly belongs to an engine, a line each with the unit that may be mistaken."""
    size, gas = engine.geometry, engine.gas
    peak = max(gas.pressures) if isinstance(gas, TabulatedGas) else gas.p_max
    speed = size.stroke * engine.speed_rpm / 30
    tests = [
        ("stroke over bore", "", size.stroke / size.bore, STROKE_TO_BORE, "millimetres"),
        ("mean piston speed", " m/s", speed, MEAN_SPEED, "millimetres and min⁻¹"),
        ("highest pressure", " MPa", peak / UNITS["MPa"].si, PEAK_PRESSURE, "MPa, absolute"),
    ]
    if isinstance(engine.masses, DirectMasses):
        mass = engine.masses.reciprocating / size.piston_area
        label = "reciprocating mass over the piston's area"
        tests.append((label, " kg/m²", mass, _RECIPROCATING, "kilograms and millimetres"))
    for what, unit, value, (low, high), given in tests:
        if not low <= value <= high:
            yield f"{what} is {value:.3g}{unit}, usually {low:g} … {high:g}: are they {given}?"
    last = max(engine.firing_offsets)
    # A cycle is 4π: taken for degrees it is still less than any real offset.
    if 0 < math.degrees(last) <= 4 * math.pi:
        yield f"all cylinders fire within {math.degrees(last):.3g}°: are the offsets degrees?"
