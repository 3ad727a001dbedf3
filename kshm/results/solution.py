"""Results of one engine as named tables and scalars in the units of the textbook."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from kshm.arrays import Array, Columns, Results, Scalars, Tables
from kshm.chain.solve import ChainArrays, solve_batch
from kshm.chain.stack import structure
from kshm.cycle.cycle import CycleRun
from kshm.engine.arrangement import hung
from kshm.engine.checks import refuse, takes_kinds
from kshm.engine.engine import Engine
from kshm.engine.revised import unknown
from kshm.engine.source import Further
from kshm.mechanics.balance import is_balanced_by_orders
from kshm.nomenclature.quantity import quantity
from kshm.results import forces, gas, motion, regimes
from kshm.results.balance import balance_results, torque_order_results
from kshm.results.bearings import bearing_results
from kshm.results.case import Case
from kshm.results.counterweight import counterweight_results
from kshm.results.cycle import cycle_scalars, cycle_tables
from kshm.results.flywheel import flywheel_results
from kshm.results.forces import continuous_results, pin_bending, rod_bearing
from kshm.results.inertia import inertia_results, rod_mass_scalars
from kshm.results.loads import Engines, geometry_scalars, load_scalars, mass_scalars
from kshm.results.motion import neiman_results, segal_results, two_term_errors
from kshm.results.named import (
    GROUPS,
    BalanceResults,
    FlywheelResults,
    GeometryResults,
    Group,
    KinematicsResults,
    LoadsResults,
    MassesResults,
    TorqueResults,
    html_table,
)
from kshm.results.plots import Plots, plots_of
from kshm.results.reference import reference_results, reference_tables
from kshm.results.sketch import sketch
from kshm.results.strength import strength_results
from kshm.results.torsion import torsion_results

if TYPE_CHECKING:
    import pandas as pd

Subject = Callable[[Case], Results]

# Subjects for engines of every layout, those that follow the series of a central mechanism,
# and those whose cylinders move alike: no articulated rods.
ALWAYS: tuple[Subject, ...] = (
    reference_results, rod_bearing, pin_bending, continuous_results, two_term_errors,
    torsion_results, bearing_results, strength_results, counterweight_results,
)  # fmt: skip
BY_ORDERS: tuple[Subject, ...] = (segal_results, neiman_results, balance_results)
SAME_RODS: tuple[Subject, ...] = (inertia_results, torque_order_results, flywheel_results)
_GRIDS = ("phi_deg", "alpha_deg", "ray_deg")


@takes_kinds
def solve(engine: Engine, cycle: CycleRun | None = None) -> Solution:
    """Solve one engine: kinematics, forces, torques, journal loads and wear, Gots (1)-(60).

    Args:
        engine: the engine.
        cycle: the calculation that its gas comes from, to stand among the results; an engine
            of a file brings its own.

    Returns:
        Tables of shape (angles,) a column and scalars, in the units of the textbook.

    Raises:
        InputError: what is no engine, an oil film that does not carry its load.

    With ``engine`` as in the example of ``kshm.in_line``:

    >>> solution = solve(engine)
    >>> round(solution.scalars["c_m"], 2)  # mean piston speed [m/s]
    8.0
    >>> f"{solution.columns['P4_1']['N_MPa'].max():.2f}"  # greatest side force
    '0.92'
    """
    source = engine.source
    if cycle is None and source is not None and source.has_made(engine):
        cycle = source.cycle
    return Solution(engine, solve_batch([engine]), cycle=cycle)


def solve_regimes(engine: Engine) -> tuple[Solution, ...]:
    """Solutions of the further regimes; those of one structure in one batch."""
    engines = [regimes.at_point(engine, point) for point in engine.regimes]
    groups: dict[tuple[object, ...], list[int]] = {}
    for index, other in enumerate(engines):
        groups.setdefault(structure(other), []).append(index)
    solutions: dict[int, Solution] = {}
    for members in groups.values():
        raw = solve_batch([engines[index] for index in members])
        for row, index in enumerate(members):
            solutions[index] = Solution(engines[index], raw, row)
    return tuple(solutions[index] for index in range(len(engines)))


def in_units(columns: Columns) -> Columns:
    """SI columns in the units of the tables."""
    return {
        # Grids are whole degrees: what the conversion to radians and back leaves goes.
        key: np.round(values / quantity(key).si, 9) if key in _GRIDS else values / quantity(key).si
        for key, values in columns.items()
    }


class Solution:
    """Everything computed for one engine.

    ``columns[table][key]`` are arrays in the unit named by the key's quantity;
    ``scalars[key]`` likewise; ``tables[id]`` are pandas DataFrames with the
    units in ``attrs["units"]``.  ``raw`` holds the SI arrays of the batch.

    With ``engine`` as in the example of ``kshm.in_line``:

    >>> table = solve(engine).tables["P4_1"]
    >>> table.columns[0], len(table)
    ('phi_deg', 73)

    Main results have English names too, in groups, and know their symbols, units and titles:

    >>> solve(engine).kinematics.mean_piston_speed.unit
    'м/с'
    """

    geometry = Group(GeometryResults)
    kinematics = Group(KinematicsResults)
    masses = Group(MassesResults)
    torque = Group(TorqueResults)
    loads = Group(LoadsResults)
    balance = Group(BalanceResults)
    flywheel = Group(FlywheelResults)

    def __init__(
        self, engine: Engine, raw: ChainArrays, index: int = 0, cycle: CycleRun | None = None
    ) -> None:
        self.engine = engine
        self.raw = raw
        self.cycle = cycle
        self._case = Case(engine, raw, index)

    @cached_property
    def columns(self) -> Tables:
        """Table id → column key → values in the units of the tables."""
        further = regimes.regime_tables(each.chain_tables for each in self.regimes)
        tables = self.chain_tables | self._subjects[0] | further
        return {table: in_units(columns) for table, columns in tables.items()}

    @cached_property
    def wear_sums(self) -> Tables:
        """Sums by rays of every journal, ``table_14_sums`` and the like, in units of tables."""
        return {table: in_units(columns) for table, columns in forces.wear_sums(self._case).items()}

    @cached_property
    def scalars(self) -> Scalars:
        """Scalar key → value in the unit of its quantity."""
        further = regimes.regime_scalars(each.chain_scalars for each in self.regimes)
        scalars = self.chain_scalars | self._subjects[1] | further
        further_numbers = {key: value for key, (_, value) in self._further.scalars.items()}
        return {key: value / quantity(key).si for key, value in scalars.items()} | further_numbers

    @cached_property
    def _further(self) -> Further:
        """Numbers of own books of an unchanged engine of a file."""
        source = self.engine.source
        has = source is not None and source.has_made(self.engine)
        return source.further() if source is not None and has else Further()

    @cached_property
    def regimes(self) -> tuple[Solution, ...]:
        """Solutions of the engine's further regimes."""
        return solve_regimes(self.engine)

    @cached_property
    def chain_tables(self) -> Tables:
        """Tables of chapters 1 and 2 alone in SI units, those that a regime changes among them."""
        case = self._case
        tables = {
            **motion.motion_tables(case),
            "gas": gas.gas_table(case),
            **forces.force_tables(self.raw, case.index),
            **motion.layout_motion_tables(case),
            **forces.rod_tables(case),
            **forces.wear_tables(case),
            **({} if self.cycle is None else cycle_tables(self.cycle)),
            **gas.point_tables(case),
        }
        worst = tables[f"P4_3_{int(self.chain_scalars['worst_main_load'])}"]
        return tables | {"P4_3": {key: worst[key] for key in ("phi_deg", "Rx_MPa", "Ry_MPa")}}

    @cached_property
    def chain_scalars(self) -> Scalars:
        """Scalars of chapters 1 and 2 alone in SI units."""
        case = self._case
        of = Engines(self.raw, slice(case.index, case.index + 1))

        def single(scalars: Mapping[str, Array]) -> Scalars:
            return {key: float(each[0]) for key, each in scalars.items()}

        return {
            **single(geometry_scalars(of)),
            **motion.layout_motion_scalars(case),
            **single(mass_scalars(of)),
            **gas.corner_scalars(case),
            **single(load_scalars(of)),
            **({} if self.cycle is None else cycle_scalars(self.cycle)),
            **gas.gas_scalars(case),
        }

    def _repr_html_(self) -> str:
        """Return the torque and the main results as a notebook shows them."""
        phi, torque = (self.column("P4_2", key) for key in ("phi_deg", "Msum_Nm"))
        picture = sketch(phi, torque, "φ, °", "M, Н·м")
        return picture + html_table({name: getattr(self, name) for name in GROUPS})

    def __repr__(self) -> str:
        """Return what was solved and the results asked for first."""
        first = (self.torque.mean, self.torque.max, self.loads.crankpin_max)
        return f"Solution of {self.engine!r}: {', '.join(map(repr, first))}"

    def __eq__(self, other: object) -> bool:
        """Tell whether the same engine was solved: then all results are the same."""
        if not isinstance(other, Solution):
            return NotImplemented
        return (self.engine, self.cycle) == (other.engine, other.cycle)

    def __hash__(self) -> int:
        return hash(self.engine)

    @property
    def plot(self) -> Plots:
        """Figures as SVG: ``torque()``, ``polar()``, ``wear()``, ``diagram()``."""
        return plots_of(self)

    def column(self, table: str, key: str) -> Array:
        """Return one column; one of the chain asks for nothing more.

        Args:
            table: id of the table, as in the book: ``P4_1`` for П4.1 of Gots.
            key: of the column.

        Returns:
            In the unit of its quantity, shape (angles,).

        Raises:
            UnknownNameError: there is no such column; the hint tells similar ones.

        With ``engine`` as in the example of ``kshm.in_line``:

        >>> solve(engine).column("P4_1", "N_MPa").shape  # angles
        (73,)
        """
        values = self.chain_tables.get(table, {}).get(key)
        if values is not None:
            return in_units({key: values})[key]
        if table not in self.columns:
            raise unknown(table, list(self.columns))
        if key not in self.columns[table]:
            raise unknown(key, list(self.columns[table]))
        return self.columns[table][key]

    def scalar(self, key: str) -> float:
        """Return one scalar in the unit of its quantity; one of the chain asks for nothing more.

        Args:
            key: of the scalar, one of those of ``kshm.quantity``.

        Raises:
            UnknownNameError: there is no such scalar; the hint tells similar ones.

        With ``engine`` as in the example of ``kshm.in_line``:

        >>> round(solve(engine).scalar("S_stroke"), 3)  # piston stroke [m]
        0.08
        """
        value = self.chain_scalars.get(key)
        if value is not None:
            return value / quantity(key).si
        if key not in self.scalars:
            raise unknown(key, list(self.scalars))
        return self.scalars[key]

    def joints(self, cylinder: int) -> tuple[tuple[Array, Array], ...]:
        """Return the joints of a cylinder's mechanism over one turn of its crank, Gots chapter 1.

        Args:
            cylinder: its number from 0.

        Returns:
            Pairs of coordinates x, y [m], each of shape (angles,), from the crankpin on.

        Raises:
            InputError: there is no such cylinder.

        With ``engine`` as in the example of ``kshm.in_line``:

        >>> [len(joint) for joint in solve(engine).joints(0)]  # crankpin, piston pin
        [2, 2]
        """
        count = self.engine.cylinders
        refuse((not 0 <= cylinder < count, f"cylinder: from 0 to {count - 1}, not {cylinder}"))
        return motion.joints(
            self._case, is_hung=self.engine.arrangement[cylinder].master is not None
        )

    @cached_property
    def _subjects(self) -> Results:
        """Tables and scalars beside the chain itself in SI units."""
        by_orders = BY_ORDERS if is_balanced_by_orders(self.engine) else ()
        same_rods = () if hung(self.engine.arrangement) else SAME_RODS
        tables, scalars = Tables(), rod_mass_scalars(self.engine)
        for subject in (*by_orders, *same_rods, *ALWAYS):
            more_tables, more_scalars = subject(self._case)
            tables |= more_tables
            scalars |= more_scalars
        return tables, scalars

    @cached_property
    def tables(self) -> dict[str, pd.DataFrame]:
        """Table id → DataFrame with ``phi_deg`` first.

        ``attrs["units"]``, ``attrs["symbols"]`` and ``attrs["titles"]`` tell of each column.
        """
        import pandas as pd

        frames = {}
        tables: dict[str, Mapping[str, Any]] = {
            **self.columns, **self.wear_sums, **reference_tables(),
        }  # fmt: skip
        further = self._further.tables
        tables |= {name: {k: v for k, (_, v) in each.items()} for name, each in further.items()}
        for name, columns in tables.items():
            frame = pd.DataFrame(columns)
            keys = [key for key in columns if not key.startswith(("lambda", "sign", "phi_m"))]
            declared = {key: quantities for key, (quantities, _) in further.get(name, {}).items()}
            quantities = {key: declared.get(key) or quantity(key) for key in keys}
            frame.attrs["units"] = {key: each.unit_label for key, each in quantities.items()}
            frame.attrs["symbols"] = {key: each.symbol for key, each in quantities.items()}
            frame.attrs["titles"] = {key: each.title for key, each in quantities.items()}
            frames[name] = frame
        return frames
