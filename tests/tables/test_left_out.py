"""What an engine does without is named; an offset of zero is none; no shafts without an order."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kshm import solve
from kshm.nomenclature.quantity import quantity
from reports.commands.common import notes_of, tell
from reports.exports.numbers import export_tables, json_text
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import engine_and_cycle
from reports.tables.registry import build_model
from tests.inputs.test_plausibility import sample


def with_offset(name: str = "d-240", **geometry: float) -> dict[str, Any]:
    raw = sample(name)
    stroke = raw["geometry"].pop("stroke_mm", None)
    if stroke is not None:
        raw["geometry"]["crank_radius_mm"] = stroke / 2
    raw["geometry"] |= geometry
    return raw


def tables_of(raw: dict[str, Any]) -> dict[str, Any]:
    return dict(solve(*engine_and_cycle(load_mapping(raw, source="f").model)).columns)


@pytest.mark.parametrize(
    "zero", [{"crank_offset_mm": 0.0}, {"pin_offset_mm": 0.0, "crank_offset_mm": 0}]
)
def test_an_offset_of_zero_leaves_every_table(zero: dict[str, float]) -> None:
    central, given = tables_of(with_offset()), tables_of(with_offset(**zero))
    assert list(given) == list(central)
    for name, columns in central.items():
        for key, values in columns.items():
            np.testing.assert_array_equal(given[name][key], values)
    loaded = load_mapping(with_offset(**zero), source="f")
    assert loaded.warnings == () and notes_of(loaded) == ()
    assert "balance" in build_model(loaded.model).tables


def test_an_offset_of_zero_may_be_changed_in_the_book() -> None:
    loaded = load_mapping(with_offset(crank_offset_mm=0.0), source="f")
    fields = build_model(loaded.model).fields
    assert fields["geometry_crank_offset_mm"].structural


def test_an_offset_names_every_sheet_that_it_costs(capsys: pytest.CaptureFixture[str]) -> None:
    raw = with_offset(crank_offset_mm=6.0)
    loaded = load_mapping(raw, source="f")
    (note,) = notes_of(loaded)
    assert note.startswith("Не рассчитано из-за смещения оси цилиндра (ряды")
    tell(loaded, Path("data") / "v.toml")  # of several files a person knows which
    assert f"v.toml: {note}" in capsys.readouterr().err.splitlines()
    central = build_model(load_mapping(with_offset(), source="f").model)
    model = build_model(loaded.model)
    lost = set(central.tables) - set(model.tables)
    assert {"balance", "balance_orders", "neiman_motion"} <= lost
    # What needs no series of a central mechanism is there.
    assert {"inertia", "tangential", "torque_orders"} <= set(model.tables)
    assert {"I_flywheel", "delta_speed", "rod_model_mass"} <= set(model.scalars)
    # Sheets are what a reader meets; one that has lost a part of its tables would not be named.
    sheets = {table.sheet for table in central.tables.values() if table.id in lost}
    assert sheets.isdisjoint(block.sheet for block in model.blocks)
    assert all(f"«{sheet}»" in note for sheet in sheets) and not re.search("[a-z]", note)
    assert note in model.remarks and len(note) < 250
    solution = solve(*engine_and_cycle(loaded.model))
    assert json.loads(json_text(loaded.model, solution, notes_of(loaded)))["notes"] == [note]
    assert "notes" not in json.loads(json_text(loaded.model, solution))


@pytest.mark.parametrize("offset", [8.0, -8.0])
def test_reduced_inertia_and_gas_torque_with_an_offset_follow_from_the_motion(
    offset: float,
) -> None:
    """From coordinates of pin and crank alone, differentiated numerically."""
    loaded = load_mapping(with_offset("ecoboost-10", crank_offset_mm=offset), source="f")
    engine, _ = engine_and_cycle(loaded.model)
    solution = solve(engine)
    actual, given = solution.columns["inertia"], solution.scalars
    g, h = engine.geometry, 1e-5
    phi = np.radians(actual["phi_deg"])

    def places(angle: Any) -> tuple[Any, ...]:
        """Piston pin and centre of the rod along and across the axis, the rod's angle."""
        beta = np.arcsin((g.crank_radius * np.sin(angle) - g.offset) / g.rod_length)
        pin = g.crank_radius * np.cos(angle) + g.rod_length * np.cos(beta)
        along = pin - given["rod_x"] * np.cos(beta)
        return pin, along, given["rod_x"] * np.sin(beta), beta

    ends = zip(places(phi + h), places(phi - h), strict=True)
    pin, along, across, turning = ((after - before) / (2 * h) for after, before in ends)
    rod = given["rod_mass"] * (along**2 + across**2) + given["I_rod"] * turning**2
    np.testing.assert_allclose(actual["I_rod_kgm2"], rod, rtol=1e-6)
    np.testing.assert_allclose(actual["I_piston_kgm2"], given["piston_mass"] * pin**2, atol=1e-9)
    assert "I_error" not in actual and "t_motored_MPa" not in solution.columns["tangential"]
    mean = np.mean(actual["Mgas_Nm"][:-1])
    assert mean == pytest.approx(given["M_mean"], rel=0.02)  # inertia gives no work


def test_a_small_offset_changes_little() -> None:
    central, near = (
        solve(*engine_and_cycle(load_mapping(raw, source="f").model)).scalars
        for raw in (with_offset("ecoboost-10", crank_offset_mm=0.0),
                    with_offset("ecoboost-10", crank_offset_mm=1.1))
    )  # fmt: skip
    for key in ("I_flywheel", "I_engine_mean", "W_range", "I_mean", "rod_model_mass"):
        assert near[key] == pytest.approx(central[key], rel=0.03), key
        assert near[key] != central[key] or key == "rod_model_mass"


def test_the_contents_of_the_book_name_them_too(tmp_path: Any) -> None:
    import io

    import openpyxl

    from reports.workbook.write import workbook_bytes

    model = build_model(load_mapping(with_offset(crank_offset_mm=6.0), source="f").model)
    book = openpyxl.load_workbook(io.BytesIO(workbook_bytes(model)))
    for sheet in ("Содержание", "Проверки"):
        texts = [str(cell.value) for row in book[sheet].iter_rows() for cell in row]
        assert any(text.startswith("Не рассчитано из-за смещения") for text in texts), sheet


def test_a_stroke_with_an_offset_is_told_to_be_twice_the_radius() -> None:
    raw = sample("d-240")
    assert load_mapping(raw, source="f").warnings == ()
    raw["geometry"]["crank_offset_mm"] = 6.0
    (warning,) = load_mapping(raw, source="f").warnings
    assert warning.line() == (
        "f: geometry.stroke_mm: при смещении stroke_mm понимается как 2r, действительный ход "
        "поршня 125,046 мм; задайте радиус кривошипа crank_radius_mm"
    )


SHAFTS = ("P_shafts", "h_shafts", "h_shafts_best", "psi_best_nominal", "zone")


@pytest.mark.parametrize(
    ("name", "has"), [("d-240", True), ("gots-diesel", False), ("d-260", False)]
)
def test_shafts_are_for_engines_with_a_second_order(name: str, has: bool) -> None:
    loaded = load_mapping(sample(name), source="f")
    solution, model = solve(*engine_and_cycle(loaded.model)), build_model(loaded.model)
    for key in SHAFTS:
        assert (key in solution.scalars, key in model.scalars) == (has, has), key
    assert ("suppression" in solution.columns, "suppression" in model.tables) == (has, has)
    assert any(chart.id == "suppression" for chart in model.charts) == has
    assert "t_gas2" in solution.scalars


def test_sums_at_the_rays_are_among_the_numbers() -> None:
    solution = solve(*engine_and_cycle(load_mapping(sample("d-240"), source="f").model))
    tables = export_tables(solution)
    assert {"table_14_sums", "table_14_main_1_sums", "table_14_main_5_sums"} <= set(tables)
    for name in ("table_14", "table_14_main_2"):
        rays = [key for key in tables[name] if key.startswith("ray_")]
        collected = [sum(value or 0.0 for value in tables[name][key][:-1]) for key in rays]  # type: ignore[misc]
        assert tables[f"{name}_sums"]["ray_sum"] == pytest.approx(collected, rel=1e-12)
        assert tables[f"{name}_sums"]["ray_deg"] == [360 * i / len(rays) for i in range(len(rays))]


def test_columns_of_some_orders_say_which() -> None:
    for key in ("Fup_kN", "Lup_Nm", "Fup_after_kN", "Fright_kN", "Lright_after_Nm"):
        title = quantity(key).title
        assert "порядки 1, 2, 4 и вращающиеся массы" in title and "сумма" not in title
    model = build_model(load_mapping(sample("d-240"), source="f").model)
    assert all(column.source != "сумма" for column in model.tables["balance"].columns)


def test_the_flywheel_of_the_v8_is_one() -> None:
    loaded = load_mapping(sample("yamz-238"), source="f")
    scalars = solve(*engine_and_cycle(loaded.model)).scalars
    assert 0.5 < scalars["I_flywheel"] < 5
    assert scalars["delta_work"] == pytest.approx(0.005, rel=0.02)
