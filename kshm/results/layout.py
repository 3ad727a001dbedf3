"""Which tables and columns an engine's layout has, and what they are called."""

from __future__ import annotations

from kshm.engine.arrangement import pins, throws
from kshm.engine.engine import Engine


def has_single_rods(engine: Engine) -> bool:
    """Whether every throw carries one rod, as in line and in opposed engines."""
    return all(len(group) == 1 for group in throws(engine.arrangement))


def shown_pins(engine: Engine) -> tuple[tuple[int, ...], ...]:
    """Crankpins with results of their own; equal pins with one rod each differ in phase only."""
    groups, shaft = pins(engine.arrangement), engine.crankshaft
    sizes = set(zip(shaft.pin_diameters, shaft.pin_lengths, strict=True))
    single = all(len(group) == 1 for group in groups)
    return groups[:1] if single and len(sizes) == 1 else groups


def pin_table(number: int) -> str:
    """Id of the table with the loads on a crankpin, counted from 0."""
    return "crankpin" if number == 0 else f"crankpin_{number + 1}"


def wear_table(number: int) -> str:
    """Id of the table with the wear of a crankpin, counted from 0."""
    return "table_14" if number == 0 else f"table_14_pin_{number + 1}"


def throw_torque_key(engine: Engine, throw: int) -> str:
    """Column of the torque of a throw, from 0: its cylinder's where it has only one."""
    group = throws(engine.arrangement)[throw]
    return f"M{group[0] + 1}_Nm" if len(group) == 1 else f"Mthrow{throw + 1}_Nm"


def rod_names(count: int) -> tuple[str, ...]:
    """What the columns call the rods of a throw from the nose: left and right where there are two.

    Names of one rod's K and T are those of the nomenclature, ``Kleft_MPa``, ``Krod3_MPa``.
    """
    if count == 2:
        return ("left", "right")
    return tuple(f"rod{number}" for number in range(1, count + 1))
