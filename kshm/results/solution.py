"""Results of one engine as named tables and scalars in the units of the textbook."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm.engine.engine import Engine
from kshm.mechanics import kinematics
from kshm.mechanics.cubic_diagrams import diagram_columns, diagram_scalars, gas_work
from kshm.nomenclature.quantity import quantity, ray_key
from kshm.results import regimes
from kshm.results.companions import companion_columns, companion_scalars
from kshm.results.cycle import cycle_columns
from kshm.results.forces import force_tables
from kshm.results.layout_columns import layout_columns, shown_pins, wear_table
from kshm.results.summary import summarise

if TYPE_CHECKING:
    import pandas as pd

    from kshm.chain.solve import BatchSolution

Array = NDArray[np.float64]
Columns = dict[str, Array]

# λ for which the textbook prints its reference tables 1-3 and 5-8.
REFERENCE_LAMBDAS: tuple[tuple[str, float], ...] = tuple(
    (f"lambda_1/{value}", 1 / float(value)) for value in ("3.2", "3.4", "3.6", "3.8", "4.0", "4.2")
)


class Solution:
    """Everything computed for one engine.

    ``columns[table][key]`` are arrays in the unit named by the key's quantity;
    ``scalars[key]`` likewise; ``tables[id]`` are pandas DataFrames with the
    units in ``attrs["units"]``.  ``raw`` holds the SI arrays of the batch.
    """

    def __init__(self, engine: Engine, raw: BatchSolution, index: int = 0) -> None:
        self.engine = engine
        self.raw = raw
        self._index = index

    @cached_property
    def columns(self) -> dict[str, Columns]:
        """Table id → column key → values in the units of the tables."""
        companions = companion_columns(self.engine, self.raw, self._index)
        return self.chain_columns | companions | regimes.regime_columns(self.regimes)

    @cached_property
    def regimes(self) -> tuple[Solution, ...]:
        """Solutions of the engine's further regimes."""
        return regimes.solve_regimes(self.engine)

    @cached_property
    def chain_columns(self) -> dict[str, Columns]:
        """Tables of chapters 1 and 2 alone, those that a regime changes among them."""
        tables = {
            "P3_1": self._piston(),
            "P3_2": self._rod(),
            "gas": self._gas(),
            **force_tables(self.raw, self._index),
            **layout_columns(self.engine, self.raw, self._index),
            **{
                wear_table(n): self._wear(self.raw.pin_rays(self._index, n))
                for n in range(len(shown_pins(self.engine)))
            },
            **{
                f"table_14_main_{k + 1}": self._wear(self.raw.journal_rays(self._index, k))
                for k in range(self._journals)
            },
        }
        if self.engine.cycle is not None:
            made = cycle_columns(self.engine.cycle)
            tables |= {name: self._units(columns) for name, columns in made.items()}
        smooth = diagram_columns(self.engine)
        tables |= {name: self._units(columns) for name, columns in smooth.items()}
        worst = int(self.chain_scalars["worst_main_load"])
        chosen = tables[f"P4_3_{worst}"]
        tables["P4_3"] = {key: chosen[key] for key in ("phi_deg", "Rx_MPa", "Ry_MPa")}
        return tables

    @cached_property
    def scalars(self) -> dict[str, float]:
        """Scalar key → value in the unit of its quantity."""
        found = self.chain_scalars | companion_scalars(self.engine, self.raw, self._index)
        found |= regimes.regime_scalars(self.regimes)
        return {key: value / quantity(key).si for key, value in found.items()}

    @cached_property
    def chain_scalars(self) -> dict[str, float]:
        """Scalars of chapters 1 and 2 alone in SI units."""
        found = summarise(self.engine, self.raw, self._index)
        work = gas_work(self.engine, self.raw, self._index)
        return found | diagram_scalars(self.engine, work)

    @cached_property
    def tables(self) -> dict[str, pd.DataFrame]:
        """Table id → DataFrame with ``phi_deg`` first.

        ``attrs["units"]``, ``attrs["symbols"]`` and ``attrs["titles"]`` tell of each column.
        """
        import pandas as pd

        frames = {}
        tables: dict[str, Mapping[str, Array | list[str]]] = {**self.columns, **reference_tables()}
        for name, columns in tables.items():
            frame = pd.DataFrame(columns)
            known = [key for key in columns if not key.startswith(("lambda", "sign", "phi_m"))]
            found = {key: quantity(key) for key in known}
            frame.attrs["units"] = {key: about.unit_label for key, about in found.items()}
            frame.attrs["symbols"] = {key: about.symbol for key, about in found.items()}
            frame.attrs["titles"] = {key: about.title for key, about in found.items()}
            frames[name] = frame
        return frames

    @property
    def _journals(self) -> int:
        return len(self.engine.crankshaft.throws) + 1

    @cached_property
    def _degrees(self) -> Array:
        engine = self.engine
        return np.arange(0.0, engine.strokes * 180 + engine.step_deg, engine.step_deg)

    def _turn(self) -> tuple[Array, Array, Array, Array, Array, Array]:
        """φ over one turn with r, λ, ω, k as arrays for the kinematic tables."""
        degrees = self._degrees[self._degrees <= 360]
        geometry = self.engine.geometry
        r, lam = np.array(geometry.crank_radius), np.array(geometry.lam)
        k = np.array(geometry.relative_offset)
        return degrees, np.radians(degrees), r, lam, np.array(self.engine.omega), k

    def _units(self, values: Columns) -> Columns:
        return {key: value / quantity(key).si for key, value in values.items()}

    def _with_phi(self, values: Columns, degrees: Array | None = None) -> Columns:
        return {"phi_deg": self._degrees if degrees is None else degrees, **self._units(values)}

    def _piston(self) -> Columns:
        degrees, phi, r, lam, omega, k = self._turn()
        s1, s2 = kinematics.displacement_orders(phi, r, lam)
        v1, v2 = kinematics.velocity_orders(phi, r, lam, omega)
        j1, j2 = kinematics.acceleration_orders(phi, r, lam, omega)
        values = {
            "s1_mm": s1, "s2_mm": s2, "s_mm": s1 + s2,
            "v1_m_s": v1, "v2_m_s": v2, "v_m_s": v1 + v2,
            "j1_m_s2": j1, "j2_m_s2": j2, "j_m_s2": j1 + j2,
        }  # fmt: skip
        if not self.engine.geometry.is_central:
            sk = kinematics.displacement_offset(phi, r, lam, k)
            vk = kinematics.velocity_offset(phi, r, lam, omega, k)
            jk = kinematics.acceleration_offset(phi, r, lam, omega, k)
            values = {
                "s1_mm": s1, "s2_mm": s2, "sk_mm": sk, "s_mm": s1 + s2 + sk,
                "v1_m_s": v1, "v2_m_s": v2, "vk_m_s": vk, "v_m_s": v1 + v2 + vk,
                "j1_m_s2": j1, "j2_m_s2": j2, "jk_m_s2": jk, "j_m_s2": j1 + j2 + jk,
            }  # fmt: skip
        return self._with_phi(values, degrees)

    def _rod(self) -> Columns:
        degrees, phi, _, lam, omega, k = self._turn()
        exact, approx = kinematics.rod_angular_velocity(phi, lam, omega, k)
        eps_exact, eps_approx = kinematics.rod_angular_acceleration(phi, lam, omega, k)
        values = {
            "beta_rad": kinematics.rod_angle(phi, lam, k),
            "omega_rod_exact_1_s": exact,
            "omega_rod_approx_1_s": approx,
            "eps_rod_exact_1_s2": eps_exact,
            "eps_rod_approx_1_s2": eps_approx,
        }
        return self._with_phi(values, degrees)

    def _gas(self) -> Columns:
        raw, e = self.raw, self._index
        geometry = self.engine.geometry
        swept = geometry.piston_area * geometry.stroke
        displacement = raw.displacement[e, 0]
        volume = swept / (geometry.compression_ratio - 1) + geometry.piston_area * displacement
        ratio = volume * (geometry.compression_ratio - 1) / swept
        values = {
            "x_exact_mm": displacement,
            "volume_ratio": ratio,
            "volume_dm3": volume,
            "p_MPa": raw.p[e, 0],
        }
        return self._with_phi(values)

    def _wear(self, loads: Array) -> Columns:
        return self._with_phi({ray_key(i + 1): loads[:, i] for i in range(loads.shape[1])})


def reference_tables(step_deg: int = 10) -> dict[str, dict[str, Array | list[str]]]:
    """Tables 1, 2, 3, 5-8 of the textbook in the shape in which it prints them.

    Values are printed without their sign; the sign stands in columns of its own,
    for φ and for its mirror 360° − φ.
    """
    degrees = np.arange(0.0, 180.0 + step_deg, step_deg)
    lambdas = np.array([value for _, value in REFERENCE_LAMBDAS])
    values = kinematics.reference_functions(np.radians(degrees)[:, None], lambdas)
    mirrored = {"table_2", "table_5", "table_7"}  # odd in φ
    tables: dict[str, dict[str, Array | list[str]]] = {}
    for name, grid in values.items():
        columns = {key: np.abs(grid[:, i]) for i, (key, _) in enumerate(REFERENCE_LAMBDAS)}
        mirror = {"phi_mirror_deg": 360 - degrees}
        if name == "table_1":
            tables[name] = {"phi_deg": degrees, **columns, **mirror}
            continue
        negative = grid[:, 0] < -1e-9
        flipped = ~negative if name in mirrored else negative
        tables[name] = {
            "phi_deg": degrees,
            "sign": ["-" if flag else "+" for flag in negative],
            **columns,
            "sign_mirror": ["-" if flag else "+" for flag in flipped],
            **mirror,
        }
    return tables
