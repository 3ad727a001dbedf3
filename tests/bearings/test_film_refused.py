"""A film that does not carry its load: refused in one line that names the bearing."""

from __future__ import annotations

import numpy as np
import pytest

from kshm.mechanics.oil_orbit import FilmError, orbits
from reports.inputs.solved import solved
from reports.shared.errors import InputError
from tests.bearings.files import tractor

PHI = np.linspace(0, 4 * np.pi, 73)


def test_a_load_that_no_film_carries_is_refused_with_its_row() -> None:
    load = np.outer([1.0, 1e4], 1 + 0.8 * np.cos(PHI)) + 0j
    with pytest.raises(FilmError) as refused:
        orbits(PHI, load, np.full(load.shape, 0.5), np.full(2, 0.5))
    assert refused.value.bearing == 1


def test_the_input_is_told_which_bearing_gives_way() -> None:
    loose = tractor(pin_clearance_min_mm=1.9, pin_clearance_max_mm=2.0)
    with pytest.raises(InputError, match="bearings: масляная плёнка шатунного подшипника"):
        solved(loose)
