"""[[torsion.peaks]]: the gas torques are scaled by the diagram's largest pressure, not a row's."""

from __future__ import annotations

import copy
import math

import numpy as np
import pytest

from kshm.chain.solve import solve_batch
from kshm.results.case import Case
from kshm.results.torsion import TorsionStudy
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import engine_and_cycle
from reports.model.evaluation import Evaluation
from reports.tables.registry import build_model
from reports.workbook.layout import Layout
from reports.workbook.write import workbook_bytes
from tests.conftest import sample
from tests.cover import sparse
from tests.layouts import MAKERS
from tests.tables.test_diagram import PETROL
from tests.tables.test_two_statements import assert_agree
from tools.referees.by_formualizer import Formualizer

PEAKS = [
    {"speed_rpm": 1000.0, "pressure_mpa": 9.0},
    {"speed_rpm": 2000.0, "pressure_mpa": 12.0},
]


def mwm(interpolation: str = "linear") -> dict:
    raw = to_mapping(sample("mwm-6"))
    raw["gas"]["interpolation"] = interpolation
    return raw


def laid_out(maker: str) -> dict:
    return MAKERS[maker](copy.deepcopy(to_mapping(sample("gots-diesel"))))


def rounded() -> dict:
    raw = laid_out("basic")
    raw["geometry"]["compression_ratio"] = 9.5
    return raw | {"gas": PETROL | {"peak_share": 0.85}}


# A file and the largest pressure of its diagram [MPa].
DIAGRAMS = {
    "points": (mwm, 15.1992),
    "smooth points": (lambda: mwm("monotone"), 15.1992),
    "polytropes": (lambda: laid_out("basic"), 10.5),
    "offset": (lambda: laid_out("offset"), 10.5),
    "two-stroke": (lambda: laid_out("two_stroke"), 10.5),
    "articulated": (lambda: laid_out("articulated"), 10.5),
    "rounded": (rounded, 0.85 * 7.2),
    "cycle": (lambda: to_mapping(sample("cycle-turbo-diesel")), None),
}


def stepped(name: str, step: int) -> dict:
    raw = DIAGRAMS[name][0]()
    raw["calculation"]["step_deg"] = step
    raw["torsion"] = {"peaks": PEAKS}
    return raw


def scales(raw: dict) -> tuple[float, float, float]:
    """Gas factor of the solver at 1500 rpm, the diagram's largest pressure of the sheets, p_z."""
    model = load_mapping(raw, source="f").model
    engine, _ = engine_and_cycle(model)
    study = TorsionStudy(Case(engine, solve_batch([engine]), 0), engine.torsion)
    gas, _ = study.at_speed(np.array([1500 * math.pi / 30]))
    run = Evaluation(build_model(model))
    return float(gas[0]), float(run.value("tor_diagram_MPa")), getattr(engine.gas, "p_max", 0) / 1e6


@pytest.mark.parametrize("name", DIAGRAMS)
def test_the_scale_does_not_depend_on_the_step(name: str) -> None:
    for step in (1, 5, 10, 15):
        gas, largest, p_z = scales(stepped(name, step))
        wanted = DIAGRAMS[name][1] or p_z
        assert largest == pytest.approx(wanted, rel=1e-9), step
        assert gas == pytest.approx(10.5 / wanted, rel=1e-9), step


@pytest.mark.parametrize("name", DIAGRAMS)
def test_both_statements_scale_alike(name: str) -> None:
    assert_agree(load_mapping(stepped(name, 15), source="f").model)


@pytest.mark.parametrize("name", sparse(["points", "smooth points", "polytropes", "rounded"]))
def test_the_sheet_finds_the_largest_pressure(name: str) -> None:
    model = build_model(load_mapping(stepped(name, 15), source="f").model)
    (result,) = Formualizer().recalculate([workbook_bytes(model)])
    cell = Layout.of(model).cells["tor_diagram_MPa"]
    actual = result[cell.sheet][cell.coordinate]
    assert actual == pytest.approx(DIAGRAMS[name][1])
