"""Usual ranges of the results, as data with their source.

None of these ranges is printed in Gots.  ``source`` tells whether a range was seen
on a public page ("web") or is common knowledge that nobody checked against a book
("memory"); the latter must not be shown as a book value.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from kshm.cycle.inputs import Kind

Source = Literal["memory", "web"]
Group = Literal["petrol", "diesel_na", "diesel_turbo"]


@dataclass(frozen=True, slots=True)
class Range:
    """Usual range of a result in the unit of its `ListedNumber`; ends included."""

    low: float
    high: float
    source: Source = "memory"
    reference: str = ""


def _table(
    petrol: tuple[float, float] | Range | None,
    natural: tuple[float, float] | Range | None,
    turbo: tuple[float, float] | Range | None,
) -> dict[Group, Range]:
    groups: tuple[Group, ...] = ("petrol", "diesel_na", "diesel_turbo")
    table: dict[Group, Range] = {}
    for group, usual in zip(groups, (petrol, natural, turbo), strict=True):
        if usual is not None:
            table[group] = usual if isinstance(usual, Range) else Range(*usual)
    return table


def _web(low: float, high: float, page: str) -> Range:
    return Range(low, high, "web", page)


# Keys are paths in `Cycle`; units are those of the listing (MPa, K).
RANGES: dict[str, dict[Group, Range]] = {
    "inputs.excess_air": _table((0.85, 1.05), (1.4, 1.8), (1.35, 2.0)),
    "inputs.charge_heating": _table((0, 25), (10, 40), (-5, 10)),
    "inputs.t_residual": _table((900, 1100), (600, 900), (600, 900)),
    "charge.gamma": _table((0.04, 0.10), (0.02, 0.05), (0.0, 0.03)),
    "charge.t_a": _table((320, 370), (310, 350), (320, 400)),
    "charge.eta_v": _table((0.70, 0.95), (0.80, 0.94), (0.80, 0.97)),
    "inputs.recharge": _table((1.0, 1.12), (1.0, 1.10), (1.02, 1.10)),
    "inputs.scavenging": _table((1, 1), (1, 1), (0.6, 1.0)),
    "compression.n_1": _table((1.34, 1.38), (1.38, 1.42), (1.32, 1.38)),
    "compression.p_c": _table((0.9, 2.1), (3.5, 5.5), (6.0, 8.0)),
    "compression.t_c": _table((550, 750), (700, 900), (900, 1000)),
    "inputs.xi_z": _table((0.80, 0.95), (0.70, 0.88), (0.70, 0.88)),
    "inputs.xi_b": _table((0.85, 0.95), (0.80, 0.92), (0.82, 0.92)),
    "combustion.lambda_p": _table((3.0, 4.2), (1.2, 2.5), (1.2, 1.8)),
    "combustion.t_z": _table((2400, 3100), (1800, 2300), (1800, 2300)),
    "combustion.p_z": _table((3.5, 7.5), (5, 12), _web(6, 15, "ukrbukva.net 68604")),
    "expansion.n_2": _table((1.23, 1.30), (1.18, 1.28), (1.18, 1.28)),
    "expansion.p_b": _table((0.35, 0.6), (0.2, 0.5), (0.3, 0.8)),
    "expansion.t_b": _table((1200, 1700), (1000, 1200), (1000, 1300)),
    "inputs.fullness": _table((0.94, 0.97), (0.92, 0.95), (0.91, 0.96)),
    "effective.eta_m": _table((0.75, 0.92), (0.70, 0.82), (0.75, 0.90)),
    "indicated.p_i": _table((0.6, 1.4), (0.7, 1.1), (0.0, 2.2)),
}


# Boosted petrol has no column of its own: what boost changes is left out for it
_BOOST_CHANGES = {
    "charge.gamma",
    "charge.t_a",
    "charge.eta_v",
    "compression.p_c",
    "compression.t_c",
    "combustion.p_z",
    "expansion.p_b",
    "indicated.p_i",
}


def usual_ranges(kind: Kind, *, boosted: bool) -> dict[str, Range]:
    """Usual ranges of the results of this kind of engine, by path in `Cycle`."""
    group: Group = "petrol"
    if kind == "diesel":
        group = "diesel_turbo" if boosted else "diesel_na"
    return {
        key: table[group]
        for key, table in RANGES.items()
        if group in table and not (group == "petrol" and boosted and key in _BOOST_CHANGES)
    }
