"""Main results under English names, each a number that knows its symbol, unit and title."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from html import escape
from typing import TYPE_CHECKING, Any, Generic, NoReturn, TypeVar

from kshm.errors import Problem, UnknownNameError
from kshm.nomenclature.quantity import Quantity, quantity


class NamedResult(float):
    """A number in the unit of its quantity.

    >>> speed = NamedResult(8.0, "c_m")
    >>> speed.key, speed.unit, speed > 7
    ('c_m', 'м/с', True)
    """

    key: str

    def __new__(cls, value: float, key: str) -> NamedResult:
        """Return the value with the key of its quantity."""
        result = super().__new__(cls, value)
        result.key = key
        return result

    def __getnewargs__(self) -> tuple[float, str]:  # type: ignore[override]
        """Return what a copy is made of."""
        return float(self), self.key

    @property
    def quantity(self) -> Quantity:
        """What the number is of."""
        return quantity(self.key)

    @property
    def symbol(self) -> str:
        """Symbol as the tables have it."""
        return self.quantity.symbol

    @property
    def unit(self) -> str:
        """Label of the unit, empty for a ratio."""
        return self.quantity.unit_label

    @property
    def title(self) -> str:
        """Title of the quantity."""
        return self.quantity.title

    def __repr__(self) -> str:
        """Symbol, number and unit."""
        return f"{self.symbol} = {float(self):.6g} {self.unit}".rstrip()


class One:
    """Attribute of a group: one result."""

    def __init__(self, key: str) -> None:
        self.key = key

    def __get__(self, group: ResultGroup | None, owner: type) -> NamedResult:
        """Return the result of the engine; what it has not is told by the group."""
        if group is None:
            return self  # type: ignore[return-value]
        if self.key not in group.scalars:
            raise AttributeError(self.key)
        return NamedResult(group.scalars[self.key], self.key)

    def results(self, group: ResultGroup) -> tuple[NamedResult, ...]:
        """Return the result, if the engine has it."""
        has = self.key in group.scalars
        return (NamedResult(group.scalars[self.key], self.key),) if has else ()


class Each:
    """Attribute of a group: a result for every journal or pin, `#` in the key is its number."""

    def __init__(self, key: str) -> None:
        self.key = key

    def __get__(self, group: ResultGroup | None, owner: type) -> tuple[NamedResult, ...]:
        """Return the results by number, none where the engine has none."""
        return self if group is None else self.results(group)  # type: ignore[return-value]

    def results(self, group: ResultGroup) -> tuple[NamedResult, ...]:
        """Return the results by number."""
        numbers = range(1, 1 + len(group.scalars))
        keys = (self.key.replace("#", str(number)) for number in numbers)
        return tuple(NamedResult(group.scalars[key], key) for key in keys if key in group.scalars)


class ResultGroup:
    """Results of one group as attributes; those of all journals or pins are tuples."""

    def __init__(self, scalars: Mapping[str, float]) -> None:
        self.scalars = scalars

    if not TYPE_CHECKING:  # else a checker would take any name for an attribute

        def __getattr__(self, name: str) -> NoReturn:
            """Tell of a name that there is not, or not for this engine.

            Raises:
                UnknownNameError: always.
            """
            if name.startswith("_"):
                raise AttributeError(name)
            names = names_of(type(self))
            if name in names:
                problem, hint = "is not calculated for this engine", ""
            else:
                problem, hint = "no such result", f"names: {', '.join(names)}"
            where = f"{group_name(type(self))}.{name}"
            raise UnknownNameError(name, Problem(where, problem, hint))

    def __dir__(self) -> list[str]:
        """Return the names of the results of this engine."""
        return [name for name, each in names_of(type(self)).items() if each.results(self)]

    def __iter__(self) -> Iterator[NamedResult]:
        """Yield all results of the group."""
        for each in names_of(type(self)).values():
            yield from each.results(self)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ResultGroup) or type(other) is not type(self):
            return NotImplemented
        return list(self) == list(other)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        """Return one result a line."""
        return "\n".join(f"{result.title}: {result!r}" for result in self)


def group_name(group: type) -> str:
    """Return the name of a group in a solution."""
    return group.__name__.removesuffix("Results").lower()


def names_of(group: type[ResultGroup]) -> dict[str, One | Each]:
    """Return the attributes of a group by name."""
    return {name: each for name, each in vars(group).items() if isinstance(each, One | Each)}


class GeometryResults(ResultGroup):
    """Sizes of the mechanism."""

    crank_radius = One("r_crank")
    rod_length = One("L_rod")
    rod_ratio = One("lam")
    stroke = One("S_stroke")
    piston_area = One("F_piston")
    cylinder_volume = One("V_h")
    clearance_volume = One("V_c")
    displacement = One("V_engine")


class KinematicsResults(ResultGroup):
    """Speeds and accelerations."""

    angular_speed = One("omega")
    mean_piston_speed = One("c_m")
    max_piston_speed = One("v_max")
    max_piston_speed_angle = One("phi_vmax_deg")
    acceleration_at_tdc = One("j_tdc")
    acceleration_at_bdc = One("j_bdc")
    max_rod_angle = One("beta_max_deg")


class MassesResults(ResultGroup):
    """Masses and the centrifugal force."""

    reciprocating = One("m_j")
    rod_at_crankpin = One("m_2")
    throw = One("m_k")
    rotating = One("m_r")
    centrifugal_force = One("K_r")


class TorqueResults(ResultGroup):
    """Torque, power and swings."""

    mean = One("M_mean")
    max = One("M_max")
    max_angle = One("phi_M_max_deg")
    min = One("M_min")
    min_angle = One("phi_M_min_deg")
    effective = One("M_e")
    indicated_power = One("N_i_calc")
    indicated_pressure = One("p_i_calc")
    journal_swing = Each("dM_main#")
    pin_swing = Each("dM_pin#")


class LoadsResults(ResultGroup):
    """Loads on crankpins and main journals."""

    crankpin_max = One("Rpin_max_kN")
    crankpin_min = One("Rpin_min_kN")
    crankpin_max_angle = One("phi_Rpin_max_deg")
    crankpin_max_specific = One("Rpin_max")
    crankpin_mean_specific = One("Rpin_mean")
    crankpin_pressure_max = One("q_pin_max")
    crankpin_pressure_mean = One("q_pin_mean")
    journal_max = Each("Rmain#_max_kN")
    journal_max_specific = Each("Rmain#_max")
    journal_mean_specific = Each("Rmain#_mean")
    journal_pressure_max = Each("q_main#_max")
    worst_journal = One("worst_main_load")


class BalanceResults(ResultGroup):
    """Unbalanced forces and moments."""

    rotating_force = One("Frot")
    rotating_moment = One("Lrot")
    first_order_force = One("F1_after_max")
    first_order_moment = One("L1_after_max")


class FlywheelResults(ResultGroup):
    """Flywheel and irregularity."""

    inertia = One("I_flywheel")
    excess_work = One("W_fine")
    engine_inertia = One("I_engine_mean")
    irregularity = One("delta_speed")


GROUPS: dict[str, type[ResultGroup]] = {
    group_name(each): each for each in ResultGroup.__subclasses__()
}
# Group, name, key of the scalar.
NAMES: dict[str, dict[str, str]] = {
    group: {name: each.key for name, each in names_of(kind).items()}
    for group, kind in GROUPS.items()
}
Kind = TypeVar("Kind", bound=ResultGroup)


class Group(Generic[Kind]):
    """A group of results as an attribute of what has ``scalars``."""

    def __init__(self, kind: type[Kind]) -> None:
        self._kind = kind

    def __get__(self, solution: Any, owner: type) -> Kind:  # noqa: ANN401
        """Return the results of the solution."""
        return self if solution is None else self._kind(solution.scalars)  # type: ignore[return-value]


def html_table(groups: Mapping[str, ResultGroup]) -> str:
    """Results of all groups as a table for a notebook."""
    rows = [
        f"<tr><td>{escape(result.title)}</td><td>{escape(result.symbol)}</td>"
        f"<td style='text-align:right'>{float(result):.5g}</td><td>{escape(result.unit)}</td></tr>"
        for group in groups.values()
        for result in group
    ]
    return f"<table><tbody>{''.join(rows)}</tbody></table>"
