"""The sheets of the torsional vibration against the solver: two independent statements."""

from __future__ import annotations

import random
from functools import cache

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings

from kshm import Solution, solve
from kshm.mechanics import torsion
from kshm.mechanics.torsion import Train
from reports.inputs.fields import iter_fields
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.engine import engine_and_cycle
from reports.model.blocks import Model
from reports.model.evaluation import Evaluation, evaluate_model
from reports.model.rename import substituted
from reports.model.shape import Scope
from reports.tables.contexts import books
from reports.tables.registry import build_model, stand_ins
from reports.tables.torsion_members import main_orders
from reports.workbook.layout import FIRST_ROW, Layout
from reports.workbook.write import workbook_bytes
from tests.cover import examples, sparse
from tests.layouts import MAKERS
from tests.referee.changes import Change, free_fields, type_into, with_values
from tests.referee.compare import differences_from_caches, errors_in
from tests.tables.test_two_statements import assert_agree
from tests.torsion.files import TWO_DISCS, chain, laid_out, mwm
from tests.torsion.trains import MWM_FORM, MWM_HZ, trains
from tools.referees.by_formualizer import Formualizer
from tools.referees.by_libreoffice import LibreOffice

GIVEN = {
    "pulley_kg_m2": 0.02, "flywheel_kg_m2": 1.5, "driven_kg_m2": 3.0, "driven_nm_rad": 4e4,
    "nose_nm_rad": 9e5, "rear_nm_rad": 2e6, "ground_nm_rad": 1e4, "formula": "zimanenko",
    "web_width_mm": 95.0, "web_thickness_mm": 24.0, "main_bore_mm": 20.0, "pin_bore_mm": 15.0,
    "damping_nms_rad": 1.5, "damper": "tuned", "damper_kg_m2": 0.05, "damper_nm_rad": 5e4,
    "damper_nms_rad": 12.0, "speed_min_rpm": 700.0, "speed_max_rpm": 2600.0,
    "other_flywheel_kg_m2": 0.7, "peaks": [{"speed_rpm": 1500.0, "pressure_mpa": 9.0}],
}  # fmt: skip


@pytest.mark.parametrize("maker", sparse(MAKERS))
def test_estimates_of_every_layout(maker: str) -> None:
    data = laid_out(maker, {}, step_deg=15)
    assert_agree(data, solve(*engine_and_cycle(data)))


@pytest.mark.parametrize("maker", ["four", "v_six", "articulated", "two_stroke"])
@pytest.mark.parametrize("formula", ["wilson", "carter", "zimanenko"])
def test_everything_given(maker: str, formula: str) -> None:
    assert_agree(laid_out(maker, GIVEN | {"formula": formula}, step_deg=15))


def test_no_section_no_sheet() -> None:
    data = laid_out("basic", {}).model_copy(update={"torsion": None})
    assert not [key for key in build_model(data).tables if key.startswith("torsion")]
    assert not [key for key in solve(*engine_and_cycle(data)).columns if key.startswith("torsion")]


def test_the_printed_frequencies_stand_in_the_sheet() -> None:
    values = evaluate_model(build_model(mwm()))
    collected = [values.scalars[f"tor_f{m}_hz"] for m in (1, 2, 3)]
    assert collected == pytest.approx(MWM_HZ[:3], abs=5e-5)
    assert values.columns["torsion_forms"]["tor_theta1"] == pytest.approx(MWM_FORM, abs=5e-6)
    assert list(np.flatnonzero(values.columns["torsion_forms"]["tor_node1"])) == [8]


def test_two_discs_in_the_sheet() -> None:
    values = evaluate_model(build_model(laid_out("basic", TWO_DISCS, step_deg=30)))
    assert values.scalars["tor_f1_hz"] == pytest.approx(176.0767, abs=5e-5)
    assert values.columns["torsion_forms"]["tor_theta1"] == pytest.approx([1, -25.46988], abs=5e-6)
    assert "tor_f2_hz" not in values.scalars


def frequencies(data: InputFile) -> list[float]:
    """What the rows of the bisection end with [Hz]."""
    model = build_model(data)
    run = Evaluation(model)
    return [float(run.value(key)) for m in (1, 2, 3) if (key := f"tor_f{m}_hz") in model.scalars]


def as_file(train: Train) -> InputFile:
    section = chain([*train.inertias], [*train.stiffnesses], train.left, train.right)
    return laid_out("basic", section, step_deg=30)


@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck))
@given(trains())
def test_the_bisection_finds_the_frequencies_of_any_train(train: Train) -> None:
    wanted = torsion.modes_of(train).hertz[:3]
    np.testing.assert_allclose(frequencies(as_file(train)), wanted, rtol=1e-9)


@pytest.mark.parametrize("link", [1e6, 1e2, 1.0])
def test_frequencies_that_all_but_meet(link: float) -> None:
    """Two equal halves on a soft link: pairs of frequencies as near as the link is soft."""
    train = Train(np.array([0.05, 0.1, 0.1, 0.05]), np.array([1e6, link, 1e6]), 1e6, 1e6)
    modes = torsion.modes_of(train)
    if link == 1.0:
        assert modes.hertz[1] / modes.hertz[0] - 1 < 3e-6
    np.testing.assert_allclose(frequencies(as_file(train)), modes.hertz[:3], rtol=1e-9)


def free_sheets(data: InputFile) -> Model:
    """The sheets of the free vibration alone: a small book."""
    part = books(Scope(data), ("mechanism", "torsion"))
    last = [block.id for block in part.blocks].index("torsion_results")
    blocks = substituted(part.blocks[: last + 1], stand_ins(data))
    return Model(data, tuple(iter_fields(data)), blocks, ())


CHANGES = examples(6, 20)


@cache
def changed_books() -> list[tuple[InputFile, bytes]]:
    """The book of the sample and the same after random changes of its train."""
    data = mwm()
    book = workbook_bytes(free_sheets(data))
    own = [field for field in free_fields(data) if field.name.startswith("torsion_mass_")]
    values = [(data, book)]
    rng = random.Random(19)
    while len(values) <= CHANGES:
        changes = [Change(field, field.value * rng.uniform(0.1, 10)) for field in own]
        changed = with_values(data, changes)
        if changed is not None:
            values.append((changed, type_into(book, data, changes)))
    return values


@cache
def solutions() -> list[Solution]:
    """The solver's part of the same."""
    return [solve(*engine_and_cycle(data)) for data, _ in changed_books()]


@pytest.mark.parametrize(
    "program", [Formualizer, pytest.param(LibreOffice, marks=pytest.mark.libreoffice)]
)
def test_the_sheets_follow_random_changes(program: type) -> None:
    books = changed_books()
    layout = Layout.of(free_sheets(books[0][0]))
    results = program().recalculate([book for _, book in books])
    assert differences_from_caches(books[0][1], results[0]) == []
    for solution, result in zip(solutions(), results, strict=True):
        assert errors_in(result) == []
        for m in (1, 2, 3):
            cell = layout.cells[f"tor_f{m}_hz"]
            actual = result[cell.sheet][cell.coordinate]
            assert actual == pytest.approx(solution.scalars[f"tor_f{m}_hz"], rel=1e-9)
            column = layout.range_of(f"torsion_forms.tor_theta{m}").split("$")[1]
            form = [result["Крутильные формы"][f"{column}{FIRST_ROW + k}"] for k in range(9)]
            wanted = solution.columns["torsion_forms"][f"tor_theta{m}"]
            np.testing.assert_allclose(form, wanted, atol=1e-6 * np.abs(wanted).max())


def test_a_free_end_that_is_grounded_in_the_open_workbook() -> None:
    """The number of frequencies at zero is counted live: an end may be grounded in the sheet."""
    data = mwm()
    grounded = mwm(ground_nm_rad=2e5)
    run = Evaluation(build_model(data)).fork({"torsion_ground_nm_rad": 2e5})
    wanted = solve(*engine_and_cycle(grounded)).scalars["tor_f1_hz"]
    assert run.value("tor_f1_hz") == pytest.approx(wanted, rel=1e-9)


def test_values_of_a_changed_workbook_are_told_to_be_old() -> None:
    data = mwm()
    model = build_model(data)
    run = Evaluation(model)
    assert run.value("tor_fresh") == "отвечают исходным данным"
    mark = {"torsion_response.tor_mark": run.value("torsion_response.tor_mark")}
    for change in (
        "torsion_mass_9_inertia_kg_m2",
        "masses_reciprocating_kg",
        "torsion_loss_factor",
    ):
        known = mark | {change: 1.01 * run.value(change)}
        assert "ИЗМЕНЕНЫ" in run.fork(known).value("tor_fresh")


@pytest.mark.parametrize(
    ("cylinders", "strokes", "drawn"),
    [
        (3, 4, [1.5, 3, 4.5, 6, 7.5, 9, 10.5, 12]), (4, 4, [2, 4, 6, 8, 10, 12]),
        (5, 4, [2.5, 5, 7.5, 10]), (7, 2, [7]), (6, 4, [3, 6, 9, 12]), (7, 4, [3.5, 7, 10.5]),
        (8, 4, [4, 8, 12]), (12, 4, [3, 6, 9, 12]),
    ],
)  # fmt: skip
def test_the_orders_of_the_campbell_diagram_are_those_that_add_up(cylinders, strokes, drawn):
    assert main_orders(cylinders, strokes) == drawn
    turns = np.arange(cylinders) * strokes * np.pi / cylinders  # evenly firing
    together = np.abs(np.exp(1j * np.outer(drawn[-1:], turns)).sum(axis=1))
    assert together == pytest.approx(cylinders)
