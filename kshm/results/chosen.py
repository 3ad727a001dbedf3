"""Quantities of a study: scalars, extremes and means of columns, by key or English name."""

from __future__ import annotations

import difflib
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from kshm.arrays import Array
from kshm.chain.solve import ChainArrays
from kshm.cycle.cycle import CycleRun
from kshm.errors import KshmError, Problem, UnknownNameError, one_line
from kshm.nomenclature.quantity import Quantity, quantity
from kshm.results.case import first_extremes
from kshm.results.forces import force_tables
from kshm.results.loads import chain_scalars
from kshm.results.named import NAMES
from kshm.results.solution import Solution, in_units

# What a column gives; an angle belongs to the extreme before it.
PARTS = ("max", "max_deg", "min", "min_deg", "mean")
_HIDDEN = ("throw", "hole", "r_crank", "L_rod", "lam", "omega")
_DEFAULT_TABLES = ("P4_1", "P4_2", "P4_4", "P4_5")
# English name of a result and the key that it stands for.
_ENGLISH = {f"{group}.{name}": key for group, names in NAMES.items() for name, key in names.items()}


@dataclass(frozen=True, slots=True)
class ChosenQuantities:
    """Scalars and ``table.column`` pairs; ``slow`` ones need every table of every engine."""

    scalars: tuple[str, ...]
    columns: tuple[tuple[str, str], ...]
    slow: bool
    own: Mapping[str, Quantity] = field(default_factory=dict)  # scalars of own books

    @property
    def names(self) -> list[str]:
        """Names of the numbers of one combination, in order."""
        pairs = [f"{table}.{key}.{part}" for table, key in self.columns for part in PARTS]
        return [*self.scalars, *pairs, *self.own]

    def quantity(self, name: str) -> Quantity:
        """Return the quantity of a number."""
        return self.own.get(name) or quantity(name.split(".")[1] if "." in name else name)


def choose(
    base: ChainArrays,
    names: Collection[str],
    cycle: CycleRun | None = None,
    department: Mapping[str, Quantity] | None = None,
) -> ChosenQuantities:
    """Choose quantities by name, by default the scalars of the chain.

    Args:
        base: the solved base, which tells what there is.
        names: keys of scalars, ``M_mean``, their English names, ``torque.mean``, and keys of
            columns, ``P4_1.N_MPa``, which give extremes, their angles and the mean.
        cycle: the calculation that the base's gas comes from.
        department: quantities of the scalars of own books; without names all of them are taken.

    Raises:
        UnknownNameError: there is no such quantity; the hint tells similar ones.
    """
    quick_scalars, quick_tables = list(chain_scalars(base)), force_tables(base)
    if not names:
        scalars = tuple(key for key in quick_scalars if not key.startswith(_HIDDEN))
        columns = tuple(
            (table, key)
            for table in _DEFAULT_TABLES
            for key in quick_tables.get(table, ())
            if _summed_up(key)
        )
        return ChosenQuantities(scalars, columns, slow=False, own=department or {})
    solution = Solution(base.batch.engines[0], base, cycle=cycle)
    pairs = {
        f"{table}.{key}": (table, key)
        for table, columns in solution.columns.items()
        for key, values in columns.items()
        if _summed_up(key) and "phi_deg" in columns and values.dtype.kind == "f"
    }
    keys: list[str] = []
    chosen: list[tuple[str, str]] = []
    slow, theirs, department = False, dict[str, Quantity](), department or {}
    for name in dict.fromkeys(_keys(names, solution.scalars)):
        if name in department:
            theirs[name] = department[name]
        elif name in pairs:
            table, key = pairs[name]
            chosen.append((table, key))
            slow |= table not in quick_tables
        elif name in solution.scalars:
            keys.append(name)
            slow |= name not in quick_scalars
        else:
            raise _unknown(name, [*solution.scalars, *pairs, *department, *_ENGLISH])
    return ChosenQuantities(tuple(keys), tuple(chosen), slow, theirs)


def _summed_up(key: str) -> bool:
    return key not in ("phi_deg", "phase_deg")


def _keys(names: Collection[str], scalars: Mapping[str, float]) -> Iterator[str]:
    """Yield the keys that names mean, one for each journal or pin where there are several."""
    for name in names:
        key = _ENGLISH.get(name, name) if isinstance(name, str) else name
        if isinstance(key, str) and "#" in key:
            numbered = (key.replace("#", str(at)) for at in range(1, 1 + len(scalars)))
            yield from (each for each in numbered if each in scalars)
        else:
            yield key


def _unknown(name: object, names: list[str]) -> UnknownNameError:
    text = one_line(str(name), 80)
    close = difflib.get_close_matches(text, names, n=3, cutoff=0.5)
    hint = f"similar: {', '.join(close)}" if close else "keys as in Solution.scalars"
    return UnknownNameError(text, Problem(text, "no such quantity", hint, value=close))


def of_batch(
    raw: ChainArrays, quantities: ChosenQuantities, cycles: Sequence[CycleRun | None]
) -> tuple[dict[str, Array], list[KshmError | None]]:
    """Values of all engines of a batch in the units of the tables, by name, and why one has none.

    Args:
        raw: the solved engines.
        quantities: what they give.
        cycles: the calculation that the gas of each comes from.
    """
    reasons: list[KshmError | None] = [None] * len(raw.batch.engines)
    if quantities.slow:
        solvers = [name for name in quantities.names if name not in quantities.own]
        values = {name: np.full(len(reasons), np.nan) for name in solvers}
        for i, (engine, cycle) in enumerate(zip(raw.batch.engines, cycles, strict=True)):
            try:
                one = _of_one(Solution(engine, raw, i, cycle), quantities)
            except KshmError as error:
                reasons[i] = error
            else:
                for name, number in one.items():
                    values[name][i] = number
        return values, reasons
    scalars = chain_scalars(raw)
    values = {key: scalars[key] / quantity(key).si for key in quantities.scalars}
    tables = force_tables(raw) if quantities.columns else {}
    for table, key in quantities.columns:
        columns = in_units({name: tables[table][name] for name in ("phi_deg", key)})
        values |= _summary(table, key, columns[key], columns["phi_deg"])
    return values, reasons


def _of_one(solution: Solution, quantities: ChosenQuantities) -> dict[str, float]:
    values = {key: solution.scalars[key] for key in quantities.scalars}
    for table, key in quantities.columns:
        columns = solution.columns[table]
        summary = _summary(table, key, columns[key][None], columns["phi_deg"])
        values |= {name: float(numbers[0]) for name, numbers in summary.items()}
    return values


def _summary(table: str, key: str, values: Array, degrees: Array) -> dict[str, Array]:
    """Extremes with the first angles at which they stand, and the mean over the cycle."""
    largest, at_largest = first_extremes(values, degrees)
    smallest, at_smallest = first_extremes(values, degrees, largest=False)
    # The last row of a table repeats the first angle.
    mean = values[..., :-1].mean(axis=-1)
    numbers = (largest, at_largest, smallest, at_smallest, mean)
    return {f"{table}.{key}.{part}": each for part, each in zip(PARTS, numbers, strict=True)}


def described(name: str, quantities: ChosenQuantities) -> tuple[str, str]:
    """Russian title and unit of a name."""
    table, dot, column = name.partition(".")
    if not dot:
        about = quantities.quantity(name)
        return about.title, about.unit_label
    key, _, part = column.rpartition(".")
    about = quantity(key)
    kinds = {
        "max": "наибольшее", "max_deg": "угол наибольшего", "min": "наименьшее",
        "min_deg": "угол наименьшего", "mean": "среднее",
    }  # fmt: skip
    unit = "°" if part.endswith("deg") else about.unit_label
    return f"{about.title} ({_numbered(table)}), {kinds[part]}", unit


def _numbered(table: str) -> str:
    """Return the number of a table of the textbook as it is printed: ``P4_3_1`` is П4.3.1."""
    return f"П{table[1:].replace('_', '.')}" if re.fullmatch(r"P\d(_\d+)+", table) else table
