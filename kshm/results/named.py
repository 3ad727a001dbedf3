"""Main results under English names, each a number that knows its symbol, unit and title."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from html import escape
from typing import Any

from kshm.nomenclature.quantity import Quantity, quantity

# Group, name, key of the scalar; "#" stands for the numbers of journals or pins.
NAMES: dict[str, dict[str, str]] = {
    "geometry": {
        "crank_radius": "r_crank", "rod_length": "L_rod", "rod_ratio": "lam",
        "stroke": "S_stroke", "piston_area": "F_piston", "cylinder_volume": "V_h",
        "clearance_volume": "V_c", "displacement": "V_engine",
    },
    "kinematics": {
        "angular_speed": "omega", "mean_piston_speed": "c_m", "max_piston_speed": "v_max",
        "max_piston_speed_angle": "phi_vmax_deg", "acceleration_at_tdc": "j_tdc",
        "acceleration_at_bdc": "j_bdc", "max_rod_angle": "beta_max_deg",
    },
    "masses": {
        "reciprocating": "m_j", "rod_at_crankpin": "m_2", "throw": "m_k", "rotating": "m_r",
        "centrifugal_force": "K_r",
    },
    "torque": {
        "mean": "M_mean", "max": "M_max", "max_angle": "phi_M_max_deg", "min": "M_min",
        "min_angle": "phi_M_min_deg", "effective": "M_e", "indicated_power": "N_i_calc",
        "indicated_pressure": "p_i_calc", "journal_swing": "dM_main#", "pin_swing": "dM_pin#",
    },
    "loads": {
        "crankpin_max": "Rpin_max_kN", "crankpin_min": "Rpin_min_kN",
        "crankpin_max_angle": "phi_Rpin_max_deg", "crankpin_max_specific": "Rpin_max",
        "crankpin_mean_specific": "Rpin_mean", "crankpin_pressure_max": "q_pin_max",
        "crankpin_pressure_mean": "q_pin_mean", "journal_max": "Rmain#_max_kN",
        "journal_max_specific": "Rmain#_max", "journal_mean_specific": "Rmain#_mean",
        "journal_pressure_max": "q_main#_max", "worst_journal": "worst_main_load",
    },
    "balance": {
        "rotating_force": "Frot", "rotating_moment": "Lrot",
        "first_order_force": "F1_after_max", "first_order_moment": "L1_after_max",
    },
    "flywheel": {
        "inertia": "I_flywheel", "excess_work": "W_fine", "engine_inertia": "I_engine_mean",
        "irregularity": "delta_speed",
    },
}  # fmt: skip


class NamedResult(float):
    """A number in the unit of its quantity.

    >>> speed = NamedResult(8.0, "c_m")
    >>> speed.key, speed.unit, speed > 7
    ('c_m', 'м/с', True)
    """

    key: str

    def __new__(cls, value: float, key: str) -> NamedResult:
        """Value and the key of its quantity."""
        result = super().__new__(cls, value)
        result.key = key
        return result

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


class ResultGroup:
    """Results of one group as attributes; those of all journals or pins are tuples."""

    def __init__(self, group: str, scalars: Mapping[str, float]) -> None:
        self._group, self._scalars = group, scalars

    def __getattr__(self, name: str) -> NamedResult | tuple[NamedResult, ...]:
        """Result of a name.

        Raises:
            AttributeError: there is no such name, or this engine has no such result.
        """
        names = NAMES[self._group]
        if name not in names:
            listed = ", ".join(names)
            raise AttributeError(f"no result {self._group}.{name}; there are: {listed}")
        key = names[name]
        if "#" in key:
            return tuple(self._numbered(key))
        if key not in self._scalars:
            raise AttributeError(f"{self._group}.{name} is not calculated for this engine")
        return NamedResult(self._scalars[key], key)

    def _numbered(self, key: str) -> Iterator[NamedResult]:
        for number in range(1, 1 + len(self._scalars)):
            one = key.replace("#", str(number))
            if one in self._scalars:
                yield NamedResult(self._scalars[one], one)

    def __dir__(self) -> list[str]:
        """Names of the results of this engine."""
        return [name for name, key in NAMES[self._group].items() if self._has(key)]

    def _has(self, key: str) -> bool:
        return next(self._numbered(key), None) is not None if "#" in key else key in self._scalars

    def __iter__(self) -> Iterator[NamedResult]:
        """All results of the group."""
        for name in self.__dir__():
            result = getattr(self, name)
            yield from result if isinstance(result, tuple) else (result,)

    def __repr__(self) -> str:
        """One result a line."""
        return "\n".join(f"{result.title}: {result!r}" for result in self)


class Group:
    """A group of results as an attribute of what has ``scalars``."""

    def __set_name__(self, owner: type, name: str) -> None:
        """Take the name of the attribute for that of the group."""
        self._name = name

    def __get__(self, solution: Any, owner: type | None = None) -> ResultGroup:  # noqa: ANN401
        """Results of the solution."""
        return ResultGroup(self._name, solution.scalars)


def html_table(groups: Mapping[str, ResultGroup]) -> str:
    """Results of all groups as a table for a notebook."""
    rows = [
        f"<tr><td>{escape(result.title)}</td><td>{escape(result.symbol)}</td>"
        f"<td style='text-align:right'>{float(result):.5g}</td><td>{escape(result.unit)}</td></tr>"
        for group in groups.values()
        for result in group
    ]
    return f"<table><tbody>{''.join(rows)}</tbody></table>"
