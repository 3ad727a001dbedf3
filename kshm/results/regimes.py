"""Further regimes of an engine: other speeds and gas, Gots 2.4, under keys of their own."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from kshm.arrays import Scalars, Tables
from kshm.engine.engine import Engine, OperatingPoint

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


def at_point(engine: Engine, point: OperatingPoint) -> Engine:
    """Return the same engine at another speed with other gas."""
    return replace(
        engine,
        omega=point.omega,
        gas=point.gas,
        mechanical_efficiency=point.mechanical_efficiency,
        indicated_power=point.indicated_power,
        fullness=point.fullness,
        regimes=(),
    )


def regime_tables(each: Iterable[Tables]) -> Tables:
    """Tables of the further regimes under their own ids."""
    return {
        regime_key(table, number): columns
        for number, tables in enumerate(each, 2)
        for table, columns in tables.items()
        if not main_only(table)
    }


def regime_scalars(each: Iterable[Scalars]) -> Scalars:
    """Scalars of the further regimes under their own keys."""
    return {
        regime_key(key, number): value
        for number, scalars in enumerate(each, 2)
        for key, value in scalars.items()
        if key not in STATIC
    }
