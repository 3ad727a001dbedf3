"""What conditional sentences ask: each a function of the values that the report prints."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from markupsafe import Markup

from reports.document.text.terms import Terms, with_unit
from reports.model.shape import Shape, pin_name
from reports.shared.russian import fixed

_PRESSURE = 2  # decimals of the greatest pressure in a sentence
_NOTHING = 2e-3  # of what it is measured by: no table and no curve shows it


def leaders(terms: Terms, names: Sequence[str]) -> list[int]:
    """Numbers, from 1, of the scalars that are printed as large as the largest."""
    values = [terms.value(name) for name in names]
    most = terms.num(names[int(np.argmax(values))])
    return [number for number, name in enumerate(names, 1) if terms.num(name) == most]


def pin_stems(shape: Shape) -> list[str]:
    """Stems of the keys of the crankpins, from the nose: ``pin``, ``pin2``."""
    return [f"pin{pin_name(number)}" for number in range(1, len(shape.pins) + 1)]


def worst_pin(terms: Terms) -> int:
    """Number of the crankpin with the greatest load, as the workbook tells it."""
    return round(terms.value("worst_pin_load")) if terms.has("worst_pin_load") else 1


def greatest_pressure(terms: Terms) -> tuple[Markup, str, Markup | str]:
    """Of the diagram: in the rows of the table, its angle, and between them where it is greater."""
    column, unit = terms.column("gas.p_MPa"), terms.unit("gas.p_MPa")
    row = int(column.argmax())
    names = [name for name in ("cyc_p_z", "gas_max_pressure_mpa") if terms.has(name)]
    most = terms.value(names[0]) if names else 0.0
    told, peak = (fixed(float(value), _PRESSURE) for value in (column[row], most))
    missed = most > column[row] + 0.5 * 10.0**-_PRESSURE
    angle = fixed(terms.model.tables["gas"].rows[row], 0)
    return with_unit(told, unit), angle, with_unit(peak, unit) if missed else ""


def worst_running(terms: Terms, throws: int) -> tuple[list[int], list[int]]:
    """Main journals and crankpins with the greatest range of the running-on torque."""
    mains = leaders(terms, [f"dM_main{k}" for k in range(2, throws + 2)])  # journal 1 has none
    return [k + 1 for k in mains], leaders(terms, [f"dM_pin{i}" for i in range(1, throws + 1)])


def are_alike(terms: Terms, columns: Sequence[str]) -> bool:
    """Whether columns over a cycle hold the same values, at whatever angles."""
    # The last row repeats the first.
    first, *others = (np.sort(terms.column(name)[:-1]) for name in columns)
    scale = float(np.abs(first).max())
    return all(np.allclose(first, other, rtol=0, atol=1e-6 * scale) for other in others)


def are_nothing(terms: Terms, columns: Sequence[str], scale: float) -> bool:
    """Whether columns hold only what is nothing beside a scale in their unit."""
    return all(np.abs(terms.column(name)).max() <= _NOTHING * scale for name in columns)
