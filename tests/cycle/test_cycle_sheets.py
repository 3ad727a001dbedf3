"""The sheets of the cycle against the solver: expressions, passes, live cells."""

from __future__ import annotations

import numpy as np
import pytest

from kshm import solve
from kshm.cycle.processes import N1_PASSES, N2_PASSES
from reports.inputs.fields import iter_fields
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.engine import engine_and_cycle
from reports.model.evaluation import Values, evaluate_model
from reports.tables.registry import build_model
from reports.workbook.layout import Layout
from reports.workbook.write import workbook_bytes
from tests.cycle.cycle_files import SAMPLES, VARIANTS, loaded
from tests.referee.changes import Change, type_into
from tests.referee.compare import differences_from_solver, errors_in
from tools.referees.by_formualizer import Formualizer
from tools.referees.cells import Book

TOLERANCE = 1e-9


def differences(data: InputFile) -> list[str]:
    """Scalars and columns whose expression does not give the solver's value."""
    model = build_model(data)
    values, solution = evaluate_model(model), solve(*engine_and_cycle(data))
    wrong = []
    for key, ours in solution.scalars.items():
        theirs = values.scalars[key]
        if not abs(ours - float(theirs)) <= TOLERANCE * max(1.0, abs(ours)):
            wrong.append(f"{key}: {theirs}, solver {ours}")
    for table in ("speed", "cycle_diagram", "gas"):
        for key, column in solution.columns[table].items():
            scale = max(1.0, float(np.abs(column).max()))
            gap = np.abs(column - values.columns[table][key]).max()
            if not gap <= TOLERANCE * scale:
                wrong.append(f"{table}.{key}: {gap}")
    return wrong


@pytest.mark.parametrize("variant", VARIANTS)
def test_expressions_give_what_the_solver_gives(variant: str) -> None:
    data = loaded(*VARIANTS[variant])
    assert "cyc_N_e" in solve(*engine_and_cycle(data)).scalars
    assert differences(data) == []


def evaluated(variant: str) -> Values:
    return evaluate_model(build_model(loaded(*VARIANTS[variant])))


@pytest.mark.parametrize("variant", VARIANTS)
def test_the_last_passes_stand_still(variant: str) -> None:
    values = evaluated(variant).scalars
    for name, count in (("n1", N1_PASSES), ("n2", N2_PASSES)):
        last, before = (float(values[f"pass_x_{name}_{i}"]) for i in (count, count - 1))
        assert abs(last - before) <= 1e-12 * last


def test_variants_reach_the_branches_of_the_temperature() -> None:
    """A closed form above 1500 °C, passes below, and passes within the blend."""
    roots = {name: evaluated(name).scalars for name in ("as it is", "very lean", "lean")}
    assert float(roots["as it is"]["cyc_t_root"]) > 1500
    assert float(roots["very lean"]["cyc_T_z"]) - 273 < 1400
    assert 1400 < float(roots["lean"]["cyc_T_z"]) - 273 < 1500


@pytest.mark.parametrize("variant", ["large losses", "losses by speed"])
def test_the_stroke_stands_still_after_its_passes(variant: str) -> None:
    values = evaluated(variant).scalars
    last, before = float(values["pass_S_stroke_6"]), float(values["pass_S_stroke_5"])
    assert abs(last - before) <= 1e-12 * last


def test_dynamics_take_their_pressures_from_the_cycle() -> None:
    fine = loaded("cycle-turbo-diesel", {"calculation.step_deg": 10})
    values = evaluate_model(build_model(fine))
    pressure = values.columns["gas"]["p_MPa"]
    assert pressure.max() == pytest.approx(float(values.scalars["cyc_p_z"]), rel=1e-12)
    assert pressure[18] == pytest.approx(float(values.scalars["cyc_p_a"]), rel=1e-12)  # 180°
    assert pressure[0] == pytest.approx(float(values.scalars["cyc_p_r"]), rel=1e-12)
    assert float(values.scalars["p_c_end"]) == pytest.approx(
        float(values.scalars["cyc_p_c"]), rel=1e-12
    )


@pytest.mark.parametrize("name", SAMPLES)
def test_power_of_the_dynamics_agrees_with_the_cycle(name: str) -> None:
    """The check of the mean tangential force compares two computed numbers: within 2 %."""
    from tests.conftest import sample

    values = evaluate_model(build_model(sample(name))).scalars
    assert abs(float(values["T_error"])) <= 2
    assert values["check_power"] == "да"


@pytest.mark.parametrize("name", SAMPLES)
def test_found_sizes_give_the_wanted_power(name: str) -> None:
    """Unrounded sizes give the power exactly, rounded ones within a step's worth."""
    from tests.conftest import sample

    data = sample(name)
    values = evaluate_model(build_model(data)).scalars
    bore, stroke = float(values["cyc_D_0"]), float(values["cyc_S_0"])
    swept = np.pi * bore**2 / 4 * stroke / 1e6  # dm³
    p_e = float(values["cyc_p_e_0"])
    power = p_e * swept * data.engine.cylinders * data.regime.speed_rpm / 120
    assert power == pytest.approx(data.cycle.power_kw, rel=1e-9)
    assert abs(float(values["cyc_N_error"])) < 4
    assert float(values["cyc_D"]) == round(float(values["cyc_D"]))


@pytest.fixture(scope="module")
def book() -> bytes:
    return workbook_bytes(build_model(loaded("cycle-turbo-diesel")))


def typed(book: bytes, name: str, value: float) -> tuple[Book, InputFile]:
    """The recalculated workbook with a value typed into an input cell, and that input."""
    data = loaded("cycle-turbo-diesel")
    (field,) = (f for f in iter_fields(data) if f.name == name)
    section, key = (str(part) for part in field.path)
    changed = loaded("cycle-turbo-diesel", {f"{section}.{key}": value})
    (result,) = Formualizer().recalculate([type_into(book, data, [Change(field, value)])])
    return result, changed


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("cycle_excess_air", 1.7),
        ("cycle_excess_air", 2.4),
        ("geometry_compression_ratio", 16.5),
        ("cycle_ambient_temperature_k", 283.0),
        ("cycle_power_kw", 90.0),
        ("cycle_boost_ratio", 2.0),
        ("regime_speed_rpm", 3600.0),
    ],
)
def test_a_changed_cell_recalculates_cycle_and_dynamics(
    book: bytes, name: str, value: float
) -> None:
    result, changed = typed(book, name, value)
    assert errors_in(result) == []
    compared, wrong = differences_from_solver(build_model(changed), result, edited=True)
    assert wrong == []
    assert compared > 900


def test_the_gas_sheet_refers_to_the_cycle(book: bytes) -> None:
    """Formulas of the gas name the cycle's cells, not pressures of their own."""
    import io

    from openpyxl import load_workbook

    model = build_model(loaded("cycle-turbo-diesel"))
    layout = Layout.of(model)
    sheet = load_workbook(io.BytesIO(book))["Газы"]
    keys = [column.key for column in model.tables["gas"].columns if column.key.startswith("p_")]
    letters = [layout.range_of(f"gas.{key}").split("$")[1] for key in keys]
    text = " ".join(sheet[f"{letter}10"].value for letter in letters)
    for name in ("cyc_p_a", "cyc_p_r", "cyc_p_z", "cyc_n1", "cyc_n2", "cyc_rho"):
        assert name in text
    assert "gas_intake" not in text
