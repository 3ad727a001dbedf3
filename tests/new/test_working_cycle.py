"""Engines with a working cycle in place of pressures: the power asked for, plausible results."""

from __future__ import annotations

import random

import pytest

from reports.inputs.load import Loaded, load_text
from reports.inputs.solve_input import solved
from reports.model.evaluation import evaluate_model
from reports.new.generate import file_text, generate_engine
from reports.new.sizing import USUAL
from reports.shared.errors import InputError, KshmError
from reports.tables.registry import build_model
from reports.tables.verdicts import failed_checks
from tests import cover
from tests.new.test_sizing import told


def made(cylinders: int, kind: str, layout: str = "inline", **task: float | None) -> Loaded:
    engine = generate_engine(cylinders, layout=layout, kind=kind, cycle=True, **task)
    return load_text(file_text(engine), source="own.toml")


def drawn(number: int) -> tuple[int, str, str, dict[str, float]]:
    """Cylinders, kind, layout and task of a teacher's sheet."""
    draw = random.Random(number)
    kind, layout = ("petrol", "diesel")[number % 2], ("inline", "v", "opposed")[number % 3]
    cylinders = draw.choice([2, 4, 6, 8] if layout != "inline" else [1, 2, 3, 4, 5, 6])
    usual = USUAL[kind, 4]
    bore = round(draw.uniform(70, 100 if kind == "petrol" else 140), 1)
    stroke = round(bore * draw.uniform(0.85, 1.2), 1)
    speed = round(draw.uniform(0.8, 1.1) * usual.piston_speed * 30000 / stroke)
    swept = bore**2 * 0.785e-6 * stroke * cylinders  # l
    power = round(draw.uniform(0.75, 1.6) * swept * speed / 120, 1)
    return cylinders, kind, layout, {"power_kw": power, "speed_rpm": speed, "bore_mm": bore,
                                     "stroke_mm": stroke}  # fmt: skip


@pytest.mark.parametrize("number", range(24 if cover.ALL else 6))
def test_a_drawn_task_has_its_power(number: int):
    cylinders, kind, layout, task = drawn(number)
    engine = made(cylinders, kind, layout, **task)
    scalars = solved(engine.model).scalars
    assert scalars["cyc_N_e"] == pytest.approx(task["power_kw"], rel=1e-3), task
    assert engine.model.geometry.bore_mm == task["bore_mm"]
    assert told(engine) == [], task


@pytest.mark.parametrize("kind", ["petrol", "diesel"])
def test_usual_data_pass_their_checks(kind: str):
    model = build_model(made(4, kind).model)
    assert failed_checks(model, evaluate_model(model)) == []


def test_what_cannot_be_is_refused():
    with pytest.raises(KshmError, match="только четырёхтактный"):
        generate_engine(2, strokes=2, cycle=True)
    with pytest.raises(InputError, match="обычный цикл даёт от"):
        generate_engine(4, cycle=True, power_kw=900.0, speed_rpm=5000.0, bore_mm=80.0,
                        stroke_mm=80.0)  # fmt: skip
