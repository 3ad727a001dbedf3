"""A parameter study: many engines that differ in a few numbers, solved together."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from kshm.chain.solve import solve_chunks
from kshm.engine.checks import refuse
from kshm.engine.engine import Engine
from kshm.nomenclature.quantity import UNITS, quantity
from kshm.results.loads import chain_scalars

if TYPE_CHECKING:
    import pandas as pd

# Names of ``kshm.assemble`` and where their numbers stand in the engine.
VARIED: dict[str, tuple[str, str]] = {
    "bore_mm": ("geometry.bore", "mm"),
    "crank_radius_mm": ("geometry.crank_radius", "mm"),
    "rod_length_mm": ("geometry.rod_length", "mm"),
    "compression_ratio": ("geometry.compression_ratio", ""),
    "speed_rpm": ("omega", "rpm"),
    "mechanical_efficiency": ("mechanical_efficiency", ""),
    "reciprocating_kg": ("masses.reciprocating", ""),
    "rod_big_end_kg": ("masses.rod_big_end", ""),
    "max_mpa": ("gas.p_max", "MPa"),
    "intake_mpa": ("gas.p_intake", "MPa"),
    "residual_mpa": ("gas.p_residual", "MPa"),
    "compression_exponent": ("gas.n_compression", ""),
    "expansion_exponent": ("gas.n_expansion", ""),
    "preexpansion_ratio": ("gas.rho", ""),
    "injection_advance_deg": ("gas.ignition_advance", "deg"),
}
MAIN = ("M_mean", "M_max", "M_min", "N_i_calc", "Rpin_max_kN", "Rpin_mean", "q_pin_max")


def sweep(
    engine: Engine,
    vary: Mapping[str, Sequence[float]],
    *,
    quantities: Sequence[str] = MAIN,
    pairwise: bool = False,
) -> pd.DataFrame:
    """Solve an engine with other numbers; a row for each combination, the first name fastest.

    Args:
        engine: the base.
        vary: values by name: those of ``kshm.assemble`` in its units (``bore_mm``), or a path
            within the engine in SI (``geometry.bore``).
        quantities: keys of scalars, as in ``Solution.scalars``, of the chain of forces.
        pairwise: the first of all, then the second of all, in place of all combinations.

    Returns:
        Columns of the names and of the quantities, in the units of their quantities;
        ``attrs["units"]`` and ``attrs["titles"]`` tell of each.

    Raises:
        InputError: a name or key that is none, lists of different lengths with ``pairwise``,
            a number that no engine has.

    With ``engine`` as in the example of ``kshm.in_line``:

    >>> study = sweep(engine, {"speed_rpm": [1000, 2000], "bore_mm": [95, 100]})
    >>> study.shape, study.attrs["units"]["M_mean"]
    ((4, 9), 'Н·м')
    """
    import pandas as pd

    refuse((not vary, "name something to vary"))
    lists = [tuple(map(float, values)) for values in vary.values()]
    lengths = {len(values) for values in lists}
    refuse((pairwise and len(lengths) > 1, "pairwise lists must have one length"))
    # The first name changes fastest.
    rows = (
        list(zip(*lists, strict=True))
        if pairwise
        else [row[::-1] for row in itertools.product(*lists[::-1])]
    )
    columns: dict[str, list[np.ndarray]] = {key: [] for key in quantities}
    for chunk in solve_chunks(_engines(engine, tuple(vary), rows)):
        scalars = chain_scalars(chunk)
        for key, values in columns.items():
            refuse((key not in scalars, f"{key} is no scalar of the chain of forces"))
            values.append(scalars[key] / quantity(key).si)
    frame = pd.DataFrame(rows, columns=[*vary]).assign(
        **{key: np.concatenate(values) for key, values in columns.items()}
    )
    frame.attrs["units"] = {key: quantity(key).unit_label for key in quantities}
    frame.attrs["titles"] = {key: quantity(key).title for key in quantities}
    return frame


def _engines(
    engine: Engine, names: Sequence[str], rows: Sequence[Sequence[float]]
) -> Iterator[Engine]:
    places = [_place(engine, name) for name in names]
    for row in rows:
        revised = engine
        for (path, factor), value in zip(places, row, strict=True):
            revised = _with(revised, path, value * factor)
        yield revised


def _place(engine: Engine, name: str) -> tuple[tuple[str, ...], float]:
    """Path within the engine and the factor to SI."""
    path, unit = VARIED.get(name, (name, ""))
    part: Any = engine
    for step in path.split("."):
        known = {field.name for field in fields(part)} if is_dataclass(part) else set()
        refuse((step not in known, f"nothing to vary under {name!r}; names: {', '.join(VARIED)}"))
        part = getattr(part, step)
    number = isinstance(part, int | float) and not isinstance(part, bool) and math.isfinite(part)
    refuse((not number, f"{name} is no number of this engine"))
    return tuple(path.split(".")), UNITS[unit].si


def _with(part: Any, path: Sequence[str], value: float) -> Any:  # noqa: ANN401
    """A copy of a dataclass with another number at a path."""
    first, *rest = path
    return replace(part, **{first: _with(getattr(part, first), rest, value) if rest else value})
