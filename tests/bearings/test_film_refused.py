"""A film that does not carry its load: refused in one line that names the bearing."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np
import pytest
import tomlkit

from kshm.errors import FilmError
from kshm.mechanics.oil_orbit import orbits
from reports.exports.build import load_input
from reports.inputs.fields import to_mapping
from reports.inputs.solve_input import solved
from reports.shared.errors import InputError
from reports.studies.sweep import sweep
from tests.bearings.files import tractor

PHI = np.linspace(0, 4 * np.pi, 73)


def test_a_load_that_no_film_carries_is_refused_with_its_row() -> None:
    load = np.outer([1.0, 1e4], 1 + 0.8 * np.cos(PHI)) + 0j
    with pytest.raises(FilmError) as refused:
        orbits(PHI, load, np.full(load.shape, 0.5), np.full(2, 0.5))
    assert refused.value.bearing == 1


def test_the_input_is_told_which_bearing_gives_way() -> None:
    loose = tractor(30, pin_clearance_min_mm=1.9, pin_clearance_max_mm=2.0)
    with pytest.raises(InputError, match="bearings: масляная плёнка шатунного подшипника"):
        solved(loose)


def test_the_file_is_named_and_check_refuses_what_build_refuses(tmp_path: Path) -> None:
    loose = tractor(30, pin_clearance_min_mm=1.9, pin_clearance_max_mm=2.0)
    file = tmp_path / "loose.toml"
    file.write_text(tomlkit.dumps(to_mapping(loose)), encoding="utf-8")
    with pytest.raises(InputError, match=r"^loose.toml: bearings: масляная плёнка"):
        load_input(file)


def test_a_study_keeps_the_reason_in_the_row(tmp_path: Path) -> None:
    file, target = tmp_path / "base.toml", tmp_path / "a.csv"
    file.write_text(tomlkit.dumps(to_mapping(tractor(30))), encoding="utf-8")
    vary = (
        "bearings.pin_clearance_max_mm=0.131:2.0:2",
        "bearings.pin_clearance_min_mm=0.057:1.9:2",
    )
    sweep(file, vary, target, quantities=["oil_orbit_0.oil_h1_um"], pairwise=True)
    first, last = csv.DictReader(io.StringIO(target.read_text(encoding="utf-8")))
    assert "масляная плёнка шатунного подшипника" not in str(first)
    assert "масляная плёнка шатунного подшипника" in str(last)
