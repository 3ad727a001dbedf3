"""Solver and expressions: two independent statements of the mechanics give the same numbers."""

from __future__ import annotations

import numpy as np
import pytest

from kshm import Solution, solve
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping, load_text
from reports.inputs.sections.input_file import InputFile
from reports.inputs.solve_input import solved
from reports.inputs.to_si.engine import engine_and_cycle
from reports.model.blocks import Model, TableSpec
from reports.model.evaluation import Evaluation, evaluate_model
from reports.new.generate import file_text, generate_engine
from reports.tables.registry import build_model
from tests.conftest import sample, sample_names
from tests.cover import ALL, sparse
from tests.layouts import MAKERS, layout_input


def results_of(model: Model) -> set[str]:
    """Tables that are results with another statement, not helpers of other tables."""
    return {
        key for key, table in model.tables.items()
        if not table.helper
        and not any(f"{key}.{column.key}" in model.own_nodes for column in table.columns)
    }  # fmt: skip


def variant(name: str, **changes: object) -> InputFile:
    raw = to_mapping(sample(name))
    raw["calculation"] |= changes
    return load_mapping(raw, source=name).model


def assert_agree(data: InputFile, solution: Solution | None = None) -> tuple[Model, Solution]:
    """Every result by its formula and by the solver; both are given back.

    Orbits and amplitudes stand in the tables as solved: a ``solution`` of its own compares them.
    Books that say ``alone`` have no other statement.
    """
    model = build_model(data)
    values, solution = evaluate_model(model), solution or solved(data)
    for table in model.tables.values():
        for column in table.columns[1:]:
            if column.helper or table.helper or f"{table.id}.{column.key}" in model.own_nodes:
                continue
            assert table.id in solution.columns, (
                f"{table.id}: no results in kshm, and its book does not say «place … alone»"
            )
            ours = values.columns[table.id][column.key]
            theirs = solution.columns[table.id][column.key]
            scale = max(1.0, float(np.abs(theirs).max()))
            if (np.abs(ours - theirs) <= 1e-10 * scale).all():
                continue
            np.testing.assert_allclose(
                ours, theirs, rtol=0, atol=1e-10 * scale, err_msg=f"{table.id}.{column.key}"
            )
    for key, theirs in solution.scalars.items():
        ours = values.scalars[key]
        assert isinstance(ours, float)
        assert abs(ours - theirs) <= 1e-10 * max(1.0, abs(theirs)), key
    return model, solution


# Both methods meet fine and coarse grids.
GRIDS = [(1, "exact"), (3, "textbook"), (5, "exact"), (30, "textbook")]
if ALL:
    GRIDS = [(step, method) for step in (1, 3, 5, 30) for method in ("textbook", "exact")]


CASES = [(name, *grid) for name in sample_names() for grid in GRIDS]


@pytest.mark.parametrize(("name", "step", "method"), sparse(CASES, 3))
def test_every_sample_on_every_grid(name: str, step: int, method: str) -> None:
    rays = 18 if step == 5 else 12
    assert_agree(variant(name, step_deg=step, method=method, wear_rays=rays))


@pytest.mark.parametrize("name", ["gots-diesel", "d-240-bearings", "mwm-6", "vaz-2106"])
def test_every_result_of_the_solver_stands_in_a_table(name: str) -> None:
    """Nothing the solver computes is left out of the workbook, nor the other way round."""
    data = sample(name)
    model, solution = build_model(data), solve(*engine_and_cycle(data))
    aliases = {"P4_3"}  # the most loaded journal once more, in the shape of the print
    assert set(solution.columns) - aliases == results_of(model)
    for table, columns in solution.columns.items():
        if table in aliases:
            continue
        spec: TableSpec = model.tables[table]
        assert [c.key for c in spec.columns if not c.helper] == list(columns)
    assert set(solution.scalars) <= set(model.scalars)


def test_table_of_points_instead_of_polytropes() -> None:
    """A diagram given by points: sampled from the polytropes it gives the same forces at them."""
    polytropic = solve(*engine_and_cycle(sample("gots-diesel")))
    gas = polytropic.columns["gas"]
    raw = to_mapping(sample("gots-diesel"))
    points = [[float(a), float(p)] for a, p in zip(gas["phi_deg"], gas["p_MPa"], strict=True)]
    raw["gas"] = {"source": "table", "ambient_pressure_mpa": 0.1, "points": points}
    data = load_mapping(raw, source="points").model
    _, solution = assert_agree(data)
    np.testing.assert_allclose(
        solution.columns["P4_1"]["Ps_MPa"],
        polytropic.columns["P4_1"]["Ps_MPa"],
        atol=1e-12,
    )


def test_an_exhaust_that_opens_on_the_isobar() -> None:
    raw = to_mapping(sample("gots-diesel"))
    raw["gas"] |= {"preexpansion_ratio": 5.0, "exhaust_start_before_bdc_deg": 150.0}
    formulas = Evaluation(build_model(load_mapping(raw, source="early").model))
    assert formulas.value("x_open") < 5
    assert formulas.value("p_open") == raw["gas"]["max_pressure_mpa"]


@pytest.mark.parametrize("cylinders", [1, 2, 4, 5, 6, 8, 12])
def test_any_number_of_cylinders(cylinders: int) -> None:
    raw = to_mapping(sample("gots-diesel"))
    offsets = [720.0 / cylinders * i for i in range(cylinders)]
    raw["engine"]["cylinders"] = cylinders
    shaft = raw["crankshaft"]
    shaft["firing_offsets_deg"] = offsets
    shaft["throw_angles_deg"] = [(-offset) % 360 for offset in offsets]
    shaft["main_lengths_mm"] = [32.0] * (cylinders + 1)
    shaft["webs"] = [dict(shaft["webs"][0]) for _ in range(2 * cylinders)]
    shaft["arms"] = [dict(shaft["arms"][0]) for _ in range(cylinders)]
    assert_agree(load_mapping(raw, source="cylinders").model)


@pytest.mark.parametrize(("cylinders", "layout"), [(2, "opposed"), (4, "opposed"), (10, "v")])
def test_journals_without_load(cylinders: int, layout: str) -> None:
    """Two strokes, pistons that fire together: between their throws there is rounding noise."""
    text = file_text(generate_engine(cylinders, layout=layout, strokes=2, kind="petrol"))
    data = load_text(text.replace("step_deg = 10", "step_deg = 30"), source="own.toml").model
    scalars = assert_agree(data)[1].scalars
    unlike = {abs(value) for key, value in scalars.items() if key.startswith("dRc")}
    assert unlike and max(unlike) < 100
    idle = [key for key in scalars if key.startswith("Rmain") and scalars[key] < 1e-3]
    assert bool(idle) == (layout == "opposed")


@pytest.mark.parametrize("method", ["textbook", "exact"])
@pytest.mark.parametrize("name", MAKERS)
def test_every_layout(name: str, method: str) -> None:
    """All tables of every layout, and none without its counterpart."""
    step, rays = (5, 12) if method == "exact" else (10, 18)
    data = layout_input(name, method=method, step_deg=step, wear_rays=rays)
    model, solution = assert_agree(data)
    assert set(solution.columns) - {"P4_3"} == results_of(model)
    for table in results_of(model):
        spec = model.tables[table]
        shown = [column.key for column in spec.columns if not column.helper]
        assert shown == list(solution.columns[table]), table
    assert set(solution.scalars) <= set(model.scalars)
