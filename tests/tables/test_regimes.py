"""Several regimes in one input: live copies of all tables, comparison, bad input."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from openpyxl import load_workbook

from kshm import solve
from reports.inputs.fields import iter_fields, to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.engine import engine_and_cycle, to_engine
from reports.model.evaluation import evaluate_model
from reports.shared.errors import InputError
from reports.tables.registry import build_model
from reports.workbook.read import load_workbook_input
from reports.workbook.write import workbook_bytes
from tests.conftest import sample
from tests.referee.changes import Change, type_into
from tests.referee.compare import differences_from_solver, errors_in
from tests.tables.test_two_statements import assert_agree
from tools.referees.by_formualizer import Formualizer


def coarse(**changes: Any) -> dict[str, Any]:
    raw = to_mapping(sample("gots-regimes"))
    raw["calculation"]["step_deg"] = 30
    return raw | changes


def read(raw: dict[str, Any]) -> InputFile:
    return load_mapping(raw, source="r.toml").model


def test_a_regime_is_the_engine_with_its_speed_and_gas() -> None:
    """Every table of the second regime is the one of a file that has it as its main regime."""
    raw = coarse()
    both = solve(*engine_and_cycle(read(raw)))
    other = raw.pop("regimes")[0]
    raw["gas"] = other.pop("gas")
    raw["regime"] = {k: v for k, v in other.items() if k != "name"}
    alone = solve(*engine_and_cycle(read(raw)))
    for table in ("gas", "P4_1", "P4_2", "P4_3_3", "crankpin", "table_14", "P4_5s"):
        for key, column in alone.columns[table].items():
            np.testing.assert_array_equal(both.columns[f"{table}_R2"][key], column)
    for key in ("M_mean", "Rpin_max", "Rmain3_mean", "q_pin_max", "c_m", "K_r", "throw2_RKCP"):
        assert both.scalars[f"{key}_R2"] == alone.scalars[key]


def test_one_regime_is_the_model_it_was() -> None:
    raw = coarse()
    del raw["regimes"]
    raw["regime"].pop("name")
    plain = build_model(read(raw))
    assert not any(name.endswith(("_R2", "_R3")) for name in (*plain.tables, *plain.scalars))
    several = build_model(read(coarse()))
    for key, table in plain.tables.items():
        assert replace(several.tables[key], computed=None) == replace(table, computed=None)
    for key, scalar in plain.scalars.items():
        assert several.scalars[key] == scalar


def test_different_kinds_of_gas_in_one_file() -> None:
    raw = coarse()
    gas = solve(*engine_and_cycle(sample("gots-diesel"))).columns["gas"]
    points = [[float(a), round(float(p), 9)] for a, p in zip(gas["phi_deg"], gas["p_MPa"],
                                                            strict=True)]  # fmt: skip
    raw["regimes"][0]["gas"] = {
        "source": "table", "interpolation": "monotone", "points": points[::2],
    }  # fmt: skip
    raw["regimes"][1]["gas"] = {
        "source": "rounded", "kind": "diesel", "intake_pressure_mpa": 0.11,
        "residual_pressure_mpa": 0.12, "max_pressure_mpa": 8.0, "compression_exponent": 1.368,
        "expansion_exponent": 1.288, "injection_advance_deg": 15.0, "ignition_delay_deg": 10.0,
        "exhaust_start_before_bdc_deg": 42.0, "exhaust_end_after_bdc_deg": 25.0, "tdc_rise": 1.15,
    }  # fmt: skip
    rounded = raw["regimes"][1]["gas"]
    assert_agree(read(raw | {"gas": rounded | {"tdc_rise": 1.2}}))  # main and third alike
    data = read(raw)
    assert_agree(data)
    model = build_model(data)
    (result,) = Formualizer().recalculate([workbook_bytes(model)])
    assert errors_in(result) == []
    assert differences_from_solver(model, result)[1] == []


def test_the_governing_regime_is_named_for_each_load() -> None:
    data = read(coarse())
    values, solution = evaluate_model(build_model(data)).scalars, solve(*engine_and_cycle(data))
    names = ["максимальная мощность", "максимальный момент", "холостой ход"]
    for key in ("Rpin_max", "Rmain1_max", "Rmain4_mean", "M_max", "dM_pin3", "q_pin_mean"):
        collected = [solution.scalars[key + end] for end in ("", "_R2", "_R3")]
        assert values[f"governs_{key}"] == names[int(np.argmax(collected))], key
    lowest = [solution.columns[f"P4_1{end}"]["Ps_MPa"].min() for end in ("", "_R2", "_R3")]
    assert values["governs_Ps_min"] == names[int(np.argmin(lowest))]


def test_a_regime_in_the_open_workbook_is_live(tmp_path: Path) -> None:
    """A changed speed of the third regime changes its loads and may change who governs.

    A hostile name of a regime stays a text.
    """
    hostile = coarse()
    hostile["regimes"][0]["name"] = "=1+1"
    data = read(hostile)
    book = workbook_bytes(build_model(data))
    named = [c for row in load_workbook(io.BytesIO(book))["Режимы"].iter_rows() for c in row
             if c.value == "=1+1"]  # fmt: skip
    assert named and all(cell.data_type == "s" for cell in named)
    field = next(f for f in iter_fields(data) if f.name == "regime_speed_rpm_R3")
    changed = type_into(book, data, [Change(field, 6000.0)])
    (result,) = Formualizer().recalculate([changed])
    hostile["regimes"][1]["speed_rpm"] = 6000
    assert errors_in(result) == []
    assert differences_from_solver(build_model(read(hostile)), result)[1] == []
    file = tmp_path / "changed.xlsx"
    file.write_bytes(changed)
    assert load_workbook_input(file).model.regimes[1].speed_rpm == 6000
    file.write_bytes(book)
    assert load_workbook_input(file).model == data


def test_solving_together_is_solving_apart() -> None:
    engine = to_engine(read(coarse()))
    first, second = solve(engine).regimes
    separate = solve(replace(engine, regimes=engine.regimes[1:])).regimes[0]
    np.testing.assert_array_equal(
        second.columns["P4_1"]["Ps_MPa"], separate.columns["P4_1"]["Ps_MPa"]
    )
    assert first.engine.omega < second.engine.omega


GAS = {"source": "polytropic"}
REFUSED: dict[str, tuple[list[Any], str]] = {
    "no gas": (
        [{"name": "момент", "speed_rpm": 2400}],
        "regimes[1].gas: у режима нет данных о газах; добавьте раздел [regimes.gas]",
    ),
    "gas of the cycle": (
        [{"name": "момент", "speed_rpm": 2400, "gas": {"source": "cycle"}}],
        "regimes[1].gas.source: расчёт цикла есть только у основного режима; задайте давления",
    ),
    "unknown gas": (
        [{"name": "момент", "speed_rpm": 2400, "gas": {"source": "x"}}],
        "regimes[1].gas.source: недопустимое значение «x»; "
        "допустимо: polytropic, table, cycle, rounded, file",
    ),
    "no section": (
        [5],
        "regimes[1]: нужен раздел, а задано: число; запишите [[regimes]]",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_bad_regimes_are_one_line(case: str) -> None:
    regimes, message = REFUSED[case]
    with pytest.raises(InputError) as caught:
        read(coarse(regimes=regimes))
    assert caught.value.lines() == [f"r.toml: {message}"]


def test_a_wrong_value_names_its_regime() -> None:
    raw = coarse()
    raw["regimes"][1]["gas"]["max_pressure_mpa"] = 1.0
    raw["regimes"][0]["speed_rpm"] = 0
    with pytest.raises(InputError) as caught:
        read(raw)
    first, second = caught.value.lines()
    assert first.startswith("r.toml: regimes[1].speed_rpm: значение 0 вне допустимых пределов")
    assert second.startswith("r.toml: regimes[2].gas.max_pressure_mpa: p_z = 1 МПа ниже")
