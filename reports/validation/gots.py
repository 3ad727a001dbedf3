"""Look-ups of the textbook's tables."""

from __future__ import annotations

import numpy as np

from kshm.cycle.diagram import indicator_diagram
from kshm.mechanics.wear import components, ray_loads, ray_sums
from kshm.nomenclature.dizdn_listing import value_of
from kshm.nomenclature.quantity import UNITS
from kshm.results.reference import reference_tables
from reports.validation.checks import Lookup, Ours
from reports.validation.printed import rows_of
from reports.validation.runs import DINN_STEP, by_angle, listing, solution

# The print has the two columns of ε the other way round than its own headers (1), (2).
SWAPPED = {
    "eps_rod_exact_1_s2": "eps_rod_approx_1_s2",
    "eps_rod_approx_1_s2": "eps_rod_exact_1_s2",
}
_RAYS = 12


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
    """Forces of table 14 of the engine of appendix 1."""
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
    places = {row["phi_deg"]: index for index, row in enumerate(rows)}

    def look(row: str, column: str) -> Ours:
        ray = keys.index(column)
        value = sums[ray] if row == "sum" else loads[places[row], ray]
        return float(value) if value else ""

    return look


def _middle(rays: list[int]) -> float:
    """Middle of neighbouring rays, of which the last is the neighbour of the first."""
    first = next(ray for ray in rays if (ray - 1) % _RAYS not in rays)
    return first + (len(rays) - 1) / 2


def cycle_outputs() -> Lookup:
    """Outputs of the listing of appendix 2."""
    made = listing()
    return lambda row, _column: value_of(made, row)


def cycle_diagram() -> Lookup:
    """Indicator diagram of appendix 2."""
    made = indicator_diagram(listing())
    return by_angle(
        {
            "phi_deg": np.round(np.degrees(made.phi), 6),
            "piston_mm": made.displacement * 1e3,
            "volume_dm3": made.volume * 1e3,
            "pressure_MPa": made.pressure / UNITS["MPa"].si,
            "temperature_K": made.temperature,
        }
    )
