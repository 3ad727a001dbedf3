"""Table 14, forces on the crankpin by rays; book: see ``book``.

The forces belong to another engine; the table checks the windows and the sums.
"""

import numpy as np

from kshm.wear import ray_angles, ray_loads, ray_sums
from tests.textbook.book import rows_of

ROWS = [row for row in rows_of("table_14") if row["phi_deg"].isdigit()]
SUMS = next((row for row in rows_of("table_14") if not row["phi_deg"].isdigit()), None)
KEYS = [key for key in rows_of("table_14")[0] if key.startswith("ray")]
PRINTED_SUMS = [26.9, 25.7, 16.4, 1.40, 5.90, 5.90, 7.50, 7.50, 8.33, 3.62, 16.7, 27.2]


def _window(row: dict[str, str]) -> tuple[float, list[int]]:
    rays = [i for i, key in enumerate(KEYS) if row[key]]
    (value,) = {float(row[KEYS[i]]) for i in rays}
    return value, rays


def test_our_windows_and_sums_are_the_printed_ones() -> None:
    """A force towards the middle of each printed window falls into just those rays."""
    ups, againsts = [], []
    angles = ray_angles(12)
    for row in ROWS:
        value, rays = _window(row)
        middle = np.angle(np.exp(1j * angles[rays]).sum())
        ups.append(value * np.cos(middle))
        againsts.append(value * np.sin(middle))
    # The last row of a table repeats the first and is not counted.
    up, against = np.array([*ups, ups[0]]), np.array([*againsts, againsts[0]])
    loads = ray_loads(up, against, 12)
    for index, row in enumerate(ROWS):
        value, rays = _window(row)
        assert np.flatnonzero(loads[index]).tolist() == rays
    sums = ray_sums(loads)
    for ours, printed in zip(sums, PRINTED_SUMS, strict=True):
        unit = 0.1 if printed > 10 else 0.01
        assert abs(ours - printed) <= unit / 2 + 1e-9


def test_the_window_includes_its_edges() -> None:
    """A force along a ray of twelve counts at five rays, two of them on the edges."""
    loads = ray_loads(np.array([1.0]), np.array([0.0]), 12)[0]
    assert np.flatnonzero(loads).tolist() == [0, 1, 2, 10, 11]
