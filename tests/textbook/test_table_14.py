"""Table 14, forces on the crankpin by rays; book: see ``book``.

The forces belong to another engine; the table checks the windows and the sums.
"""

import numpy as np

from kshm.mechanics.wear import ray_loads
from reports.validation.checks import Verdict
from tests.textbook.book import beyond, checks, recorded


def test_our_windows_and_sums_are_the_printed_ones() -> None:
    """A force towards the middle of each printed window falls into just those rays."""
    found = checks("table_14")
    assert len(found) == 25 * 12
    assert beyond("table_14") == recorded("table_14") == set()
    empty = [check for check in found.values() if not check.cell.text]
    assert len(empty) == 187
    assert all(check.ours == "" for check in empty)
    assert all(0 < check.tolerance <= 0.05 for check in found.values() if check.cell.text)


def test_the_forces_belong_to_another_engine() -> None:
    forces = checks("table_14_forces")
    assert len(forces) == 24
    assert beyond("table_14_forces") == recorded("table_14_forces", Verdict.OTHER_RUN)
    assert beyond("table_14_forces") == set(forces)


def test_the_window_includes_its_edges() -> None:
    """A force along a ray of twelve counts at five rays, two of them on the edges."""
    loads = ray_loads(np.array([1.0]), np.array([0.0]), 12)[0]
    assert np.flatnonzero(loads).tolist() == [0, 1, 2, 10, 11]
