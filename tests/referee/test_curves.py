"""The hidden sheet of the charts' curves: formulas that give the solver's values by degrees."""

from __future__ import annotations

import random

import numpy as np
import pytest

from reports.inputs.sections.input_file import InputFile
from reports.inputs.solve_input import fine_columns
from reports.model.blocks import Model
from reports.model.evaluation import evaluate_model
from reports.recalculation.grid import MAX_CELLS
from reports.tables.curves import with_curves, with_values
from reports.tables.registry import build_model
from reports.workbook.layout import FIRST_ROW, Layout
from reports.workbook.write import workbook_bytes
from tests.conftest import sample, sample_names
from tests.layouts import MAKERS, layout_input
from tests.referee.changes import changed_everywhere, type_into, without_charts
from tests.referee.compare import CURVES, TOLERANCE
from tests.workbook.made import book, model
from tools.referees.by_formualizer import Formualizer
from tools.referees.cells import Book, cached_values, formula_cells

ENGINES = {
    **{name: (lambda name=name: sample(name)) for name in sample_names()},
    **{f"layout {name}": (lambda name=name: layout_input(name, method="exact")) for name in MAKERS},
}


def differing(drawn: Model, data: InputFile, numbers) -> tuple[int, list[str]]:
    """Curves compared with the solver at one degree and those that are others."""
    fine, compared, wrong = fine_columns(data), 0, []
    for of, key in drawn.draws.items():
        table, _, column = of.partition(".")
        if key in drawn.grid_runs:
            continue
        expected = fine[table][column]
        found = numbers(key)
        compared += 1
        if not np.abs(found - expected).max() <= TOLERANCE * max(1.0, np.abs(expected).max()):
            wrong.append(f"{of}: {np.abs(found - expected).max()}")
    return compared, wrong


@pytest.mark.parametrize("name", ENGINES)
def test_curves_are_those_of_the_solver(name: str) -> None:
    data = ENGINES[name]()
    built = build_model(data)
    drawn = with_curves(built)
    values = with_values(drawn, evaluate_model(built))

    def numbers(key: str) -> np.ndarray:
        table, _, column = key.partition(".")
        return values.columns[table][column]

    compared, wrong = differing(drawn, data, numbers)
    assert wrong == []
    assert compared >= 10


def of_cells(drawn: Model, recalculated: Book):
    """Numbers of a curve from the cells of a recalculated book."""
    layout = Layout.of(drawn)

    def numbers(key: str) -> np.ndarray:
        letters = layout.range_of(key).split("$")[1]
        rows = layout.rows_of(layout.columns[key][0])
        cells = recalculated[CURVES]
        return np.array([cells.get(f"{letters}{row}", 0.0) for row in rows])

    return numbers


def test_formulas_of_the_book_give_them_after_an_edit_too() -> None:
    data = model().input
    changes, changed = changed_everywhere(data, random.Random(3), 0.1)
    edited = type_into(without_charts(book("gots-diesel")), data, changes)
    plain, other = Formualizer().recalculate([book("gots-diesel"), edited])
    for each, recalculated in ((data, plain), (changed, other)):
        drawn = with_curves(build_model(each))
        compared, wrong = differing(drawn, each, of_cells(drawn, recalculated))
        assert wrong == []
        assert compared >= 30


def test_saved_values_are_as_exact_as_a_picture() -> None:
    drawn = with_curves(model())
    layout, saved = Layout.of(drawn), cached_values(book("gots-diesel"))[CURVES]
    values = with_values(drawn, evaluate_model(model())).columns
    shown = {key for key in drawn.draws.values() if key in layout.columns}
    for key in shown:
        table, _, column = key.partition(".")
        letters = layout.range_of(key).split("$")[1]
        exact = values[table][column]
        rows = layout.rows_of(layout.columns[key][0])
        kept = [saved.get(f"{letters}{row}", exact[row - FIRST_ROW]) for row in rows]
        error = np.abs(np.array(kept) - exact).max()
        assert error <= np.abs(exact).max() / 700, key


def test_a_book_by_degrees_has_no_such_sheet() -> None:
    data = sample("gots-diesel")
    calculation = data.calculation.model_copy(update={"step_deg": 1})
    fine = build_model(data.model_copy(update={"calculation": calculation}))
    assert CURVES not in formula_cells(workbook_bytes(fine))
    assert sum(map(len, formula_cells(book("yamz-238")).values())) < MAX_CELLS


def polar_tables(drawn: Model) -> list[str]:
    return [key.removesuffix("_frame.frame_x") for key in drawn.grid_runs if "frame_x" in key]


@pytest.mark.parametrize("spread", [0.0, 0.3])
@pytest.mark.parametrize("name", ["gots-diesel", "yamz-238", "two-stroke"])
def test_names_of_a_polar_diagram_keep_apart_after_an_edit(name: str, spread: float) -> None:
    """Axes hold the curve in whole equal divisions, the arrow shows the greatest load."""
    data = sample(name)
    if spread:
        _, data = changed_everywhere(data, random.Random(name), spread)
    built = build_model(data)
    drawn = with_curves(built)
    values = with_values(drawn, evaluate_model(built))
    scalars, names, blank = values.scalars, 0, 0

    def run(key: str) -> list:
        return [scalars[each] for each in drawn.grid_runs[key]]

    assert len(polar_tables(drawn)) >= 2
    for table in polar_tables(drawn):
        step, parts = run(f"{table}_frame.frame_step")[0], run(f"{table}_frame.frame_count")[0]
        frames = [run(f"{table}_frame.frame_{axis}") for axis in "xy"]
        ends = [(low - 0.06 * parts * step, high + 0.06 * parts * step) for low, high in frames]
        for axis, (low, high) in zip("xy", ends, strict=True):
            chart = next(
                each
                for each in drawn.charts
                if each.kind == "polar"
                and each.series[0].y in drawn.draws
                and each.series[0].y.startswith(f"{table}.")
            )
            key = drawn.draws[getattr(chart.series[0], axis)].split(".")
            curve = values.columns[key[0]][key[1]]
            assert low <= curve.min() and curve.max() <= high
            assert high - low == pytest.approx(parts * step)
            assert low / step == pytest.approx(round(low / step), abs=1e-6)
        assert parts <= 14
        size = np.hypot(*(run(f"{table}_arrow.arrow_{axis}")[1] for axis in "xy"))
        angle = run(f"{table}_arrow.arrow_deg")[0]
        columns = [drawn.draws[getattr(chart.series[0], axis)].split(".") for axis in "xy"]
        loads = np.hypot(*(values.columns[t][c] for t, c in columns))
        assert size == pytest.approx(loads.max())
        assert loads[round(angle)] == pytest.approx(size)
        labels = run(f"{table}_marks.mark_label")
        spots = list(zip(*(run(f"{table}_marks.mark_{axis}") for axis in "uv"), strict=True))
        shown = [at for at, label in zip(spots, labels, strict=True) if label != " "]
        shown.append(tuple(run(f"{table}_arrow.mark_{axis}")[0] for axis in "uv"))
        for i, one in enumerate(shown):
            for other in shown[:i]:
                assert max(abs(a - b) for a, b in zip(one, other, strict=True)) >= 1
        names, blank = names + len(shown), blank + labels.count(" ")
    assert names > len(polar_tables(drawn)) and blank > 0
