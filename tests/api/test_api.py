"""The public interface: its names, its units, engines without files, the page about it."""

from __future__ import annotations

import contextlib
import io
import pydoc
import re
import subprocess
import sys
from operator import attrgetter
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import kshm
import reports
from kshm import end_mass, in_line, points, polytropic, quantity, solve, throw
from reports.inputs.to_si.engine import engine_and_cycle
from tests.api.conftest import run_text
from tests.api.public_names import lines
from tests.conftest import sample
from tests.manual.pages import DOCS, ROOT, blocks

PAGE = DOCS / "api.md"


@pytest.fixture(scope="module")
def ran(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict, str]:
    """Names and output of the page's examples, run one after another in a folder of their own."""
    names: dict = {}
    said, folder = io.StringIO(), tmp_path_factory.mktemp("page")
    (folder / "samples").symlink_to(ROOT / "samples")
    with contextlib.redirect_stdout(said), contextlib.chdir(folder):
        for block in blocks(PAGE, "python"):
            exec(compile(block, str(PAGE), "exec"), names)
    return names, said.getvalue()


def test_the_examples_of_the_page_give_the_book(ran: tuple[dict, str]) -> None:
    """The engine made without a file is the sample's, number for number."""
    names, said = ran
    assert len(blocks(PAGE, "python")) >= 6
    book = solve(*engine_and_cycle(sample("gots-diesel"))).scalars
    built = names["solution"].scalars
    for key in ("M_mean", "Rpin_max", "Rmain2_max", "c_m", "throw1_RTCL"):
        assert built[key] == pytest.approx(book[key], rel=1e-12)
    assert "N наибольшая" in said and "geometry.bore_mm значение −5 вне" in said
    assert "МПа" in said


def test_tables_are_frames_that_know_their_units(ran: tuple[dict, str]) -> None:
    tables = ran[0]["solution"].tables
    frame = tables["P4_1"]
    assert next(iter(frame.columns)) == "phi_deg"
    for kind in ("units", "symbols", "titles"):
        assert list(frame.attrs[kind]) == list(frame.columns)
    assert frame.attrs["units"]["N_MPa"] == "МПа"
    np.testing.assert_array_equal(
        frame["N_MPa"].to_numpy(), ran[0]["solution"].columns["P4_1"]["N_MPa"]
    )


def test_names_are_those_of_the_stored_list() -> None:
    """A renamed or lost table, column or scalar shows here; new ones are added to the list.

    ``python -m tests.api.public_names > tests/api/names.txt`` writes it anew.
    """
    stored = (Path(__file__).parent / "names.txt").read_text(encoding="utf-8").splitlines()
    assert list(lines()) == stored
    for name in kshm.__all__:
        assert getattr(kshm, name).__name__ == name
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = kshm.nothing


def test_what_is_imported_when() -> None:
    """The package and the solver start without pandas; both packages are typed."""
    code = (
        "import sys, kshm; assert 'numpy' not in sys.modules; kshm.solve;"
        "assert 'pandas' not in sys.modules and 'reports' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True)
    assert (ROOT / "kshm" / "py.typed").exists()
    assert (ROOT / "reports" / "py.typed").exists()


def run_example(name: str, names: dict, package: ModuleType = kshm) -> None:
    run_text(name, attrgetter(name)(package).__doc__, names)


@pytest.mark.parametrize("name", kshm.__all__)
def test_every_public_name_has_an_example_that_runs(name: str, example_names: dict) -> None:
    run_example(name, dict(example_names))


@pytest.mark.parametrize("name", reports.__all__)
def test_every_name_of_the_report_engine_has_one(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    run_example(name, {each: getattr(reports, each) for each in reports.__all__}, reports)


@pytest.mark.parametrize("package", [kshm, reports])
def test_tab_and_help_list_the_public_names_alone(package: ModuleType) -> None:
    """Beside them `help` lists the modules of a package: no package can hide those."""
    code = f"import {package.__name__} as p; print(*dir(p)); print(*dir(p))"
    said = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert said.stdout.splitlines() == [" ".join(sorted(package.__all__))] * 2
    text = pydoc.plain(pydoc.render_doc(package))
    sections = dict(re.findall(r"^([A-Z ]+)\n((?:(?: .*)?\n)+)", text, re.MULTILINE))
    told = {"NAME", "DESCRIPTION", "PACKAGE CONTENTS", "CLASSES", "FUNCTIONS", "VERSION", "FILE"}
    assert sections.keys() <= told
    listed = "".join(sections.get(name, "") for name in ("CLASSES", "FUNCTIONS"))
    assert set(re.findall(r"^    (?:class )?(\w+)\(", listed, re.MULTILINE)) == set(dir(package))


def test_a_wrong_example_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    for text in (">>> 1 + 1\n3\n", "No example."):
        monkeypatch.setattr(kshm.Engine, "__doc__", text)
        with pytest.raises(AssertionError):
            run_example("Engine", {})


def small(**changes: object) -> kshm.Engine:
    gas = points([0, 360, 720], [0.1, 4.0, 0.1])
    given: dict = {
        "bore_mm": 80, "crank_radius_mm": 40, "rod_length_mm": 140, "compression_ratio": 9,
        "speed_rpm": 3000, "gas": gas, "reciprocating_kg": 0.7, "rod_big_end_kg": 0.5,
        "firing_offsets_deg": [0.0], "pin_diameter_mm": 45, "pin_length_mm": 25,
        "main_diameter_mm": 50, "main_lengths_mm": 28, "step_deg": 30,
        "throws": throw(arms_mm=[30] * 6, web_kg=0.3, pin_kg=0.2),
    }  # fmt: skip
    return in_line(**(given | changes))


def test_engines_that_cannot_be_are_refused() -> None:
    assert solve(small(nose=end_mass(0.1, 0, 50))).scalars["S_stroke"] == pytest.approx(0.08)
    for changes, said in (
        ({"firing_offsets_deg": []}, "an engine has a cylinder"),
        ({"firing_offsets_deg": [0, 360], "throws": [small().crankshaft.throws[0]]}, "2 cylinders"),
        ({"main_lengths_mm": [28]}, "main journal more"),
        ({"strokes": 3}, "strokes are 2 or 4"),
        ({"step_deg": 7}, "must divide"),
        ({"wear_rays": 10}, "12 or 18"),
        ({"rod_length_mm": 40}, "longer than the crank"),
    ):
        with pytest.raises(ValueError, match=said):
            small(**changes)
    with pytest.raises(ValueError, match="six arms"):
        throw(arms_mm=[1, 2], web_kg=1, pin_kg=1)
    with pytest.raises(ValueError, match="angles must rise"):
        points([0, 0, 720], [1, 1, 1])
    with pytest.raises(ValueError, match="as many pressures"):
        points([0, 720], [1])
    with pytest.raises(ValueError, match="begin at 0"):
        points([0, 360, 720], [0.1, 4.0, 0.2])
    assert polytropic.__doc__ is not None
    assert quantity("N_MPa").unit_label == "МПа"
