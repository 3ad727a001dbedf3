"""Tiles and bars of four engines against numbers worked out here: no formula of the product.

Only sizes, masses and the gas pressure come from the solver; mechanics is written anew.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

import reports
from kshm import solve
from kshm.results.solution import Solution
from reports.inputs.load import load_toml
from reports.model.evaluation import evaluate_model
from reports.shared.resources import samples_dir
from reports.tables.registry import build_model
from reports.workbook.layout import CONTENTS_SHEET
from reports.workbook.write import workbook_bytes
from tests.conftest import missing
from tools.referees.by_libreoffice import LibreOffice, find_soffice
from tools.referees.cells import Book

pytestmark = pytest.mark.xdist_group("first sheet")  # four engines are recalculated once

ENGINES = ("gots-diesel", "yamz-236", "two-stroke", "vaz-2106")
TILES = {"power": "A5", "mean": "B5", "most": "F5", "least": "F6", "pin": "I5", "delta": "L5",
         "flywheel": "L6", "last": "O5"}  # fmt: skip
STRONG = "vaz-2106"
SAFETIES = ("st_eye_top_n", "st_eye_n", "st_shank_nx", "st_shank_ny", "st_bolt_n", "st_web_n")
BARS_SHEET = "Прочность"
BARS = ("st_crown_MPa", "st_press_MPa", "st_pull_MPa", "st_land_MPa", "st_q1_MPa", "st_q2_MPa",
        "st_pin_eye_MPa", "st_pin_boss_MPa", "st_pin_bend_MPa", "st_pin_shear_MPa", "st_cap_MPa",
        *SAFETIES[:2], *SAFETIES[4:])  # fmt: skip
_STEP = 0.05


@dataclass(frozen=True)
class Engine:
    """An engine solved, and its book recalculated by LibreOffice."""

    name: str
    solution: Solution
    book: Book

    def tile(self, name: str) -> float:
        """Value of a tile of the first sheet."""
        value = self.book[CONTENTS_SHEET][TILES[name]]
        assert isinstance(value, float)
        return value


@pytest.fixture(scope="module")
def engines() -> dict[str, Engine]:
    if find_soffice() is None:
        missing("LibreOffice", "libreoffice-calc")
    paths = [samples_dir() / f"{name}.toml" for name in ENGINES]
    models = [build_model(load_toml(path).model) for path in paths]
    books = [workbook_bytes(model, evaluate_model(model)) for model in models]
    return {
        name: Engine(name, solve(reports.load(path)), book)
        for name, path, book in zip(ENGINES, paths, LibreOffice().recalculate(books), strict=True)
    }


def rod_forces(solution: Solution) -> tuple[np.ndarray, np.ndarray]:
    """Force along and across the crank over its area [MPa], a row of the cycle each: statics."""
    engine = solution.engine
    angle = np.radians(np.arange(0, 360 * engine.strokes // 2, engine.step_deg))
    radius, rod = engine.geometry.crank_radius, engine.geometry.rod_length
    area = np.pi / 4 * engine.geometry.bore**2
    pressure = solution.columns["gas"]["p_MPa"][:-1] - engine.gas.p_ambient / 1e6
    acceleration = radius * engine.omega**2 * (np.cos(angle) + radius / rod * np.cos(2 * angle))
    along = pressure - solution.masses.reciprocating * acceleration / area / 1e6
    sine = radius / rod * np.sin(angle)  # of the rod's angle
    cosine = np.sqrt(1 - sine**2)
    # The rod carries along/cosine in the direction of its axis; its parts on the crank.
    push = along / cosine
    radial = push * (np.cos(angle) * cosine - np.sin(angle) * sine)
    tangential = push * (np.sin(angle) * cosine + np.cos(angle) * sine)
    return radial, tangential


def turned(values: np.ndarray, solution: Solution, cylinder: int) -> np.ndarray:
    """Values of a cylinder that works later, at the angles of the first."""
    engine = solution.engine
    steps = np.degrees(engine.firing_offsets[cylinder]) / engine.step_deg
    assert steps == pytest.approx(round(steps))
    return np.roll(values, round(steps))


def torque(solution: Solution) -> np.ndarray:
    """Moment of all cylinders [N·m] over a cycle."""
    _, tangential = rod_forces(solution)
    geometry = solution.engine.geometry
    arm = np.pi / 4 * geometry.bore**2 * 1e6 * geometry.crank_radius
    count = solution.engine.cylinders
    return arm * sum(turned(tangential, solution, i) for i in range(count))


@pytest.mark.parametrize("name", ENGINES)
def test_power_and_moments(engines: dict[str, Engine], name: str) -> None:
    each = engines[name]
    moments, engine = torque(each.solution), each.solution.engine
    assert each.tile("most") == pytest.approx(moments.max(), rel=1e-9)
    assert each.tile("least") == pytest.approx(moments.min(), rel=1e-9)
    assert each.tile("mean") == pytest.approx(moments.mean(), rel=1e-9)
    power = moments.mean() * engine.omega * engine.mechanical_efficiency / 1e3
    assert each.tile("power") == pytest.approx(power, rel=1e-9)


@pytest.mark.parametrize("name", ENGINES)
def test_the_greatest_load_of_a_pin(engines: dict[str, Engine], name: str) -> None:
    solution = engines[name].solution
    engine, area = solution.engine, np.pi / 4 * solution.engine.geometry.bore**2
    radial, tangential = rod_forces(solution)
    pull = (
        solution.masses.rod_at_crankpin
        * engine.geometry.crank_radius
        * engine.omega**2
        / area
        / 1e6
    )
    loads = []
    for throw in range(len(engine.crankshaft.throws)):
        on_it = [i for i, each in enumerate(engine.arrangement) if each.throw == throw]
        along = sum(turned(radial, solution, i) - pull for i in on_it)
        across = sum(turned(tangential, solution, i) for i in on_it)
        loads.append(np.hypot(along, across).max())
    assert engines[name].tile("pin") == pytest.approx(max(loads), rel=1e-9)


@pytest.mark.parametrize("name", ENGINES)
def test_the_flywheel_keeps_the_unevenness(engines: dict[str, Engine], name: str) -> None:
    """Within what the step of the tables misses of the work between its extremes."""
    each = engines[name]
    moments, step = torque(each.solution), np.radians(each.solution.engine.step_deg)
    excess = np.append(moments, moments[0]) - moments.mean()
    work = np.concatenate(([0.0], np.cumsum((excess[:-1] + excess[1:]) / 2 * step)))
    asked = (work.max() - work.min()) / each.solution.engine.omega**2
    inertia = each.tile("flywheel") + float(each.solution.scalars["I_engine_mean"])
    assert inertia * each.tile("delta") == pytest.approx(asked, rel=_STEP)


def test_the_least_safety(engines: dict[str, Engine]) -> None:
    """Of the engine with strength: the least of the solver's safeties."""
    each = engines[STRONG]
    safeties = [float(each.solution.scalars[key]) for key in SAFETIES]
    assert each.tile("last") == pytest.approx(min(safeties), rel=1e-9)


@pytest.mark.parametrize("key", BARS)
def test_values_with_bars(engines: dict[str, Engine], key: str) -> None:
    """Stresses, pressures and safeties that have bars stand in the book as the solver has them."""
    each = engines[STRONG]
    numbers = [cell for cell in each.book[BARS_SHEET].values() if isinstance(cell, float)]
    assert any(number == pytest.approx(float(each.solution.scalars[key])) for number in numbers)
