"""Results for which the step of the tables is too coarse are told, and only those."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from kshm import solve
from reports.cli import main
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.solve_input import GridError, grid_errors, grid_remark, written_alike
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.resources import samples_dir
from tests.conftest import sample
from tests.layouts import layout_input


def stepped(name, step):
    raw = to_mapping(sample(name))
    raw["calculation"]["step_deg"] = step
    return load_mapping(raw, source="t.toml").model


def scalars(model):
    return solve(*engine_and_cycle(model)).scalars


@pytest.mark.parametrize("step", [10.0, 30.0])
@pytest.mark.parametrize("name", ["yamz-236", "yamz-238", "two-stroke"])
def test_what_is_told_is_what_the_solver_finds_with_a_step_of_a_degree(name, step):
    model = stepped(name, step)
    coarse, fine = scalars(model), scalars(stepped(name, 1.0))
    lines = {error.key: error for error in grid_errors(model)}
    for key in ("M_max", "M_mean", "I_flywheel", "Rpin_max", "Rmain1_max", "dM_main2"):
        off = abs(coarse[key] - fine[key]) > 0.02 * abs(fine[key])
        assert (key in lines) == off, key
        if off:
            assert (lines[key].coarse, lines[key].fine) == (coarse[key], fine[key])
            angle = f"phi_{key}_deg"
            moved = fine[angle] if fine.get(angle) != coarse.get(angle) else None
            assert lines[key].moved_deg == moved


def test_the_v6_of_the_issue():
    (item,) = (e for e in grid_errors(stepped("yamz-236", 10.0)) if e.key == "M_max")
    assert round(item.coarse) == 2374 and round(item.fine) == 2557
    assert item.percent == pytest.approx(-7.18, abs=0.01)
    assert item.moved_deg is not None and item.moved_deg % 10


def test_a_fine_grid_has_nothing_to_tell():
    assert grid_errors(stepped("yamz-236", 1.0)) == () and grid_remark(stepped("d-240", 1.0)) == ""


def test_rounding_noise_of_zero_is_no_difference():
    assert all(
        abs(e.coarse) + abs(e.fine) > 1e-9 for e in grid_errors(layout_input("opposed_four"))
    )


_GRID = (
    r"Шаг таблиц 10°: наибольший суммарный момент: 2374.Н·м, с шагом 1° 2557.Н·м; "
    r"других таких результатов: 25; шаг меняют в исходных данных: «Шаг таблиц по углу поворота»$"
)


def test_only_results_that_people_use_are_told_of():
    """A flywheel that the note takes from the fine step and a least load are not."""
    for name in ("two-stroke", "vw-1600"):
        assert grid_errors(sample(name)) and grid_remark(sample(name)) == ""


@pytest.mark.parametrize("command", ["check", "solve"])
def test_the_commands_name_the_grid(command):
    path = samples_dir() / "yamz-236.toml"
    done = CliRunner().invoke(main, [command, str(path)])
    assert done.exit_code == 0
    assert re.search(_GRID, done.stdout, re.MULTILINE)


def test_numbers_in_files_are_told_and_the_grid_aside(tmp_path):
    book, target = samples_dir() / "yamz-236.toml", tmp_path / "numbers.json"
    done = CliRunner().invoke(
        main, ["solve", str(book), "--csv", str(tmp_path), "--json", str(target)]
    )
    assert done.stdout.splitlines() == [str(tmp_path), str(target)]
    assert re.search(_GRID, done.stderr, re.MULTILINE)


def test_an_oil_hole_that_the_fine_step_puts_elsewhere_is_told():
    model = stepped("gots-diesel", 30.0)
    coarse, fine = scalars(model), scalars(stepped("gots-diesel", 1.0))
    assert round(coarse["hole_pin_deg"]) == 270 and round(fine["hole_pin_deg"]) == 300
    (item,) = (e for e in grid_errors(model) if e.key == "hole_pin_deg")
    assert (round(item.coarse), round(item.fine)) == (270, 300)
    assert np.isinf(item.percent)  # no share of an angle
    assert replace(item, first=True).title.endswith("шейки 1, от колена против вращения")
    assert not [e for e in grid_errors(stepped("yamz-236", 10.0)) if "hole" in e.key]
    # The pin's bending is held against the fine step's in the same plane of the hole.
    hole = {"oil_hole_deg": coarse["alpha_oil_deg"]}
    crankshaft = model.crankshaft.model_copy(update=hole)
    same = scalars(stepped("gots-diesel", 1.0).model_copy(update={"crankshaft": crankshaft}))
    bent = {e.key: e.fine for e in grid_errors(model) if e.key.startswith("Malpha")}
    assert bent and bent == {key: same[key] for key in bent}
    assert bent["Malpha_max"] != fine["Malpha_max"]


def test_of_alike_pins_the_first_is_named_and_goes_first():
    raw = to_mapping(sample("yamz-238"))
    raw["calculation"]["step_deg"] = 30
    lines = [e for e in grid_errors(load_mapping(raw, source="t.toml").model) if "Rpin" in e.key]
    names = [e.title for e in lines if e.key.endswith("max_kN")]
    assert names[0].endswith("шатунную шейку 1")
    for key in ("max_kN", "_max"):
        numbers = [int(e.title[-1]) for e in lines if e.key.endswith(key)]
        equal = {e.percent for e in lines if e.key.endswith(key)}
        assert len(equal) > 1 or numbers == sorted(numbers)
    one = [e for e in grid_errors(stepped("two-stroke", 30.0)) if "Rpin" in e.key]
    assert all(e.title.endswith("шейку") for e in one)


def test_no_number_is_told_in_place_of_the_same():
    """«−8 вместо −8»: by the digits of the quantity the two are alike."""
    for coarse, fine, printed in ((-8.2, -7.9, ("−8,2", "−7,9")), (-8.4, -7.4, ("−8", "−7"))):
        assert written_alike(GridError("M_min", coarse, fine))[:2] == printed
