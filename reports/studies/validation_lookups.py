"""Look-ups of our numbers by the rows and columns of printed tables."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from kshm import solve
from kshm.cycle.cycle import cycle
from kshm.cycle.diagram import indicator_diagram
from kshm.cycle.dizdn_listing import Listing
from kshm.cycle.fuel import FUELS
from kshm.cycle.inputs import Boost, CycleInputs
from kshm.cycle.performance import Cycle
from kshm.mechanics import dimensionless, harmonics
from kshm.mechanics.kinematics import rod_angle
from kshm.mechanics.wear import components, ray_loads, ray_sums
from kshm.nomenclature.dizdn_listing import INPUTS, value_of
from kshm.nomenclature.quantity import UNITS
from kshm.results.reference import reference_tables
from kshm.results.solution import Solution
from reports.inputs.load import load_toml
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.resources import samples_dir
from reports.studies.validation_checks import Lookup, Ours, rows_of

DINN_STEP = 3  # degrees of the program's grid
# The print has the two columns of ε the other way round than its own headers (1), (2).
SWAPPED = {
    "eps_rod_exact_1_s2": "eps_rod_approx_1_s2",
    "eps_rod_approx_1_s2": "eps_rod_exact_1_s2",
}
_RAYS = 12
_MULTIPLE = re.compile(r"(\d*)p(\d)")


@lru_cache(maxsize=8)
def solution(sample: str, step_deg: int | None = None) -> Solution:
    """Return a sample solved, on its own or another grid of angles."""
    engine, run = engine_and_cycle(load_toml(samples_dir() / f"{sample}.toml").model)
    if step_deg is not None:
        engine = replace(engine, step_deg=step_deg)
    return solve(engine, run)


def on_grid(label: str, step: float = DINN_STEP) -> float:
    """Return the point of the program's grid that a rounded row label stands for."""
    return float(np.floor(float(label) / step + 0.5) * step)


def by_angle(
    columns: Mapping[str, Sequence[Any] | np.ndarray[Any, Any]],
    *,
    rename: Mapping[str, str] | None = None,
    step: float | None = None,
) -> Lookup:
    """Look-up in a table over φ.

    Args:
        columns: our table with ``phi_deg``.
        rename: printed column → ours, where they differ.
        step: grid that the printed labels are rounded from.
    """
    rows_by_angle = {
        round(float(angle), 6): index for index, angle in enumerate(columns["phi_deg"])
    }

    def look(row: str, column: str) -> Ours:
        angle = float(row) if step is None else on_grid(row, step)
        value = columns[(rename or {}).get(column, column)][rows_by_angle[angle]]
        return value if isinstance(value, str) else float(value) + 0.0

    return look


def printed_inputs() -> CycleInputs:
    """Return the inputs of the listing as printed, each by its code, in SI."""
    codes = {row["code"]: float(row["value"]) for row in rows_of("app2_inputs")}
    si: dict[str, Any] = {q.key: codes[q.code] * q.scale for q in INPUTS}
    boost = {key.removeprefix("boost."): si.pop(key) for key in list(si) if "boost." in key}
    si["cylinders"] = int(si["cylinders"])
    return CycleInputs(kind="diesel", fuel=FUELS["diesel"], boost=Boost(**boost), **si)


@lru_cache(maxsize=1)
def listing() -> Cycle:
    """Return the cycle of the listing with the program's peculiarities."""
    return cycle(printed_inputs(), Listing())


def minutes(radians: float) -> float:
    """Return an angle in minutes, as numbers with minutes are compared."""
    return 60 * float(np.degrees(radians))


def reference(table: str) -> Lookup:
    """Tables 1-3 and 5-8; where the values vanish the sign is nobody's."""
    columns = reference_tables()[table]
    look = by_angle(columns)
    values = [key for key in columns if key.startswith("lambda")]
    signs = {(row["phi_deg"], key): row.get(key, "") for row in rows_of(table) for key in row}

    def with_signs(row: str, column: str) -> Ours:
        if column.startswith("sign") and all(float(look(row, key)) < 5e-4 for key in values):
            return signs[row, column].replace("–", "-").replace("—", "-").strip()
        return look(row, column)

    return with_signs


def kinematics(table: str) -> Lookup:
    """Tables П3.1 and П3.2."""
    rename = SWAPPED if table == "P3_2" else None
    return by_angle(solution("gots-p3").columns[table], rename=rename)


def dynamics(table: str) -> Lookup:
    """Tables П4.1, П4.2, П4.4, П4.5."""
    return by_angle(solution("gots-diesel").columns[table])


def third_journal() -> Lookup:
    """Table П4.3 by the data of the run that it belongs to."""
    return by_angle(solution("gots-p43", DINN_STEP).columns["P4_3_3"], step=DINN_STEP)


def pin_forces() -> Lookup:
    """Return forces of table 14 of the engine of appendix 1."""
    return by_angle(solution("gots-diesel").columns["crankpin"], rename={"R_MPa": "Rpin_MPa"})


def wear_windows() -> Lookup:
    """Rays and sums of table 14 for forces towards the middle of each printed window."""
    rows = [row for row in rows_of("table_14") if row["phi_deg"].isdigit()]
    keys = [key for key in rows[0] if key.startswith("ray")]
    marked = [[index for index, key in enumerate(keys) if row[key]] for row in rows]
    sizes = [float(row[keys[rays[0]]]) for row, rays in zip(rows, marked, strict=True)]
    # The last row of a cycle repeats the first and is not counted.
    size = np.array([*sizes, sizes[0]])
    up, against = components(
        size, np.array([_middle(rays) for rays in [*marked, marked[0]]]), _RAYS
    )
    loads = ray_loads(up, against, _RAYS)
    sums = ray_sums(up, against, size, _RAYS)
    indices = {row["phi_deg"]: index for index, row in enumerate(rows)}

    def look(row: str, column: str) -> Ours:
        ray = keys.index(column)
        value = sums[ray] if row == "sum" else loads[indices[row], ray]
        return float(value) if value else ""

    return look


def _middle(rays: list[int]) -> float:
    """Middle of neighbouring rays, of which the last is the neighbour of the first."""
    first = next(ray for ray in rays if (ray - 1) % _RAYS not in rays)
    return first + (len(rays) - 1) / 2


def cycle_outputs() -> Lookup:
    """Return outputs of the listing of appendix 2."""
    printout = listing()
    return lambda row, _column: value_of(printout, row)


def cycle_diagram() -> Lookup:
    """Return indicator diagram of appendix 2."""
    diagram = indicator_diagram(listing())
    return by_angle(
        {
            "phi_deg": np.round(np.degrees(diagram.phi), 6),
            "piston_mm": diagram.displacement * 1e3,
            "volume_dm3": diagram.volume * 1e3,
            "pressure_MPa": diagram.pressure / UNITS["MPa"].si,
            "temperature_K": diagram.temperature,
        }
    )


def segal_angles() -> Lookup:
    """Segal, table 2: β for α and λ, in minutes."""

    def look(row: str, column: str) -> float:
        alpha, lam = np.radians(float(row)), np.array(float(column))
        return minutes(float(rod_angle(alpha, lam)))

    return look


def segal_displacements() -> Lookup:
    """Segal, table 3: exact s for α and λ."""

    def look(row: str, column: str) -> float:
        alpha, lam = np.radians(float(row)), np.array(float(column))
        return float(dimensionless.exact(alpha, lam).s)

    return look


def neiman_multiples() -> Lookup:
    """Neiman, tables 1, 2 and 4: n·p_m by the series cut after sin⁸."""

    def look(row: str, column: str) -> float:
        lam = 1 / float(row)
        if column == "k":
            return harmonics.printed_coefficient(lam, 0)
        match = _MULTIPLE.fullmatch(column)
        if match is None:
            raise KeyError(f"unknown column {column}")
        return int(match[1] or 1) * harmonics.printed_coefficient(lam, int(match[2]))

    return look


def neiman_speeds() -> Lookup:
    """Neiman, table 3: angle of the greatest speed and its ratio to the mean one."""

    def look(row: str, column: str) -> float:
        angle, ratio = harmonics.max_velocity(np.array(1 / float(row)))
        return minutes(float(angle)) if column == "alpha1" else float(ratio)

    return look
