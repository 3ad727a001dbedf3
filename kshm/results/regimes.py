"""Further regimes of an engine: other speeds and gas, solved together, Gots 2.4."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from kshm.engine.engine import Engine, Regime

if TYPE_CHECKING:
    from kshm.results.solution import Columns, Solution

# Scalars that no speed and no gas changes: they stand once, without a regime's number.
STATIC = frozenset(
    {
        "r_crank", "L_rod", "lam", "S_stroke", "F_piston", "V_h", "V_c", "V_engine",
        "phi_vmax_deg", "v_ratio", "beta_max_deg", "m_1", "m_2", "m_j", "m_k", "m_r",
        "e_offset", "k_offset", "phi_tdc_deg", "phi_bdc_deg", "phi_down_deg", "phi_up_deg",
        "S_ratio", "beta_90_deg", "beta_270_deg",
        "S_art", "V_h_art", "V_c_art", "phi_tdc_art_deg", "phi_bdc_art_deg",
    }
)  # fmt: skip


def regime_key(key: str, number: int) -> str:
    """Key of a table or scalar of a further regime, counted from 2."""
    return f"{key}_R{number}"


def main_only(table: str) -> bool:
    """Whether a table stands for the main regime only: the motions of appendix 3."""
    return table in ("P4_3", "offset", "articulated") or table.startswith("P3")


def of_regime(engine: Engine, regime: Regime) -> Engine:
    """The same engine at another speed with other gas."""
    return replace(
        engine,
        omega=regime.omega,
        gas=regime.gas,
        mechanical_efficiency=regime.mechanical_efficiency,
        indicated_power=regime.indicated_power,
        fullness=regime.fullness,
        cycle=None,
        regimes=(),
    )


def solve_regimes(engine: Engine) -> tuple[Solution, ...]:
    """Solutions of the further regimes; those of one structure in one batch."""
    from kshm.chain.solve import solve_batch
    from kshm.chain.stack import structure
    from kshm.results.solution import Solution

    engines = [of_regime(engine, regime) for regime in engine.regimes]
    groups: dict[tuple[object, ...], list[int]] = {}
    for index, other in enumerate(engines):
        groups.setdefault(structure(other), []).append(index)
    found: dict[int, Solution] = {}
    for members in groups.values():
        raw = solve_batch([engines[index] for index in members])
        for place, index in enumerate(members):
            found[index] = Solution(engines[index], raw, place)
    return tuple(found[index] for index in range(len(engines)))


def regime_columns(solutions: tuple[Solution, ...]) -> dict[str, Columns]:
    """Tables of the further regimes under their own ids, units of the tables."""
    return {
        regime_key(table, number): columns
        for number, solution in enumerate(solutions, 2)
        for table, columns in solution.chain_columns.items()
        if not main_only(table)
    }


def regime_scalars(solutions: tuple[Solution, ...]) -> dict[str, float]:
    """Scalars of the further regimes in SI units."""
    return {
        regime_key(key, number): value
        for number, solution in enumerate(solutions, 2)
        for key, value in solution.chain_scalars.items()
        if key not in STATIC
    }
