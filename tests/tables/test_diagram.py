"""Rounded diagrams, smooth points and diagrams from files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kshm import solve
from kshm.mechanics.gas import periodic_nodes
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping, load_toml
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.engine import engine_and_cycle, to_engine
from reports.model.evaluation import evaluate_model
from reports.shared.errors import InputError
from reports.tables.registry import build_model
from reports.workbook.read import load_workbook_input
from reports.workbook.write import workbook_bytes
from tests.conftest import sample, samples_dir
from tests.referee.compare import (
    differences_from_caches,
    differences_from_solver,
    errors_in,
    recalculated_as_solved,
)
from tests.tables.test_two_statements import assert_agree
from tools.referees.by_libreoffice import LibreOffice

PETROL: dict[str, Any] = {
    "source": "rounded", "kind": "petrol", "intake_pressure_mpa": 0.085,
    "residual_pressure_mpa": 0.118, "max_pressure_mpa": 7.2, "compression_exponent": 1.37,
    "expansion_exponent": 1.24, "injection_advance_deg": 25.0, "ignition_delay_deg": 10.0,
    "exhaust_start_before_bdc_deg": 55.0, "exhaust_end_after_bdc_deg": 30.0,
}  # fmt: skip
DIESEL = PETROL | {
    "kind": "diesel", "max_pressure_mpa": 10.5, "intake_pressure_mpa": 0.165,
    "residual_pressure_mpa": 0.17, "preexpansion_ratio": 1.366, "injection_advance_deg": 15.0,
}  # fmt: skip
ENGINES = {"petrol": (PETROL, 9.5), "diesel": (DIESEL, 18.0)}


def diagram_input(gas: dict[str, Any], ratio: float = 18.0, step: int = 5) -> InputFile:
    raw = to_mapping(sample("gots-diesel"))
    raw["geometry"]["compression_ratio"] = ratio
    raw["calculation"]["step_deg"] = step
    raw["gas"] = gas
    return load_mapping(raw, source="gas.toml").model


def points_of(data: InputFile, every: int) -> list[list[float]]:
    gas = solve(*engine_and_cycle(data)).columns["gas"]
    pairs = zip(gas["phi_deg"].tolist(), gas["p_MPa"].tolist(), strict=True)
    return [[angle, round(pressure, 9)] for angle, pressure in pairs][::every]


@pytest.mark.parametrize("method", ["textbook", "exact"])
@pytest.mark.parametrize("kind", ENGINES)
def test_rounded_statements_agree(kind: str, method: str) -> None:
    gas, ratio = ENGINES[kind]
    raw = to_mapping(diagram_input(gas, ratio))
    raw["calculation"]["method"] = method
    assert_agree(load_mapping(raw, source="gas").model)


@pytest.mark.parametrize("interpolation", ["linear", "monotone"])
def test_points_statements_agree(interpolation: str) -> None:
    points = points_of(diagram_input(PETROL, 9.5), 3)
    assert_agree(
        diagram_input({"source": "table", "interpolation": interpolation, "points": points})
    )


@pytest.mark.parametrize("kind", ENGINES)
def test_the_diagram_has_the_points_of_figure_22_and_no_overshoot(kind: str) -> None:
    gas, ratio = ENGINES[kind]
    data = diagram_input(gas, ratio, step=1)
    solution = solve(*engine_and_cycle(data))
    phi, p = solution.columns["gas"]["phi_deg"], solution.columns["gas"]["p_MPa"]
    s = solution.scalars
    share = 0.85 if kind == "petrol" else 1.0
    after = 12 if kind == "petrol" else 10
    assert p.max() == pytest.approx(share * gas["max_pressure_mpa"], rel=1e-12)
    assert phi[int(p.argmax())] == 360 + after  # z_д
    assert p[360] == pytest.approx(1.2 * s["p_c_end"], rel=1e-12)  # c''
    assert p[540] == pytest.approx((s["p_b"] + gas["residual_pressure_mpa"]) / 2, rel=1e-12)
    rising = p[(phi >= 180) & (phi <= 360 + after)]
    falling = p[(phi >= 360 + after) & (phi <= s["phi_close_deg"])]
    assert (np.diff(rising) > 0).all()
    assert (np.diff(falling) < 0).all()
    assert p[0] == p[-1] == gas["residual_pressure_mpa"]


def test_no_corner_but_at_top_dead_centre() -> None:
    """The slope changes little from one tenth of a degree to the next at every join."""
    from dataclasses import replace

    from kshm.mechanics.gas import engine_pressure

    engine = to_engine(diagram_input(PETROL, 9.5))
    gas = engine.gas
    fine = np.radians(np.arange(0, 720.05, 0.1))
    slope = np.diff(engine_pressure(replace(engine, name="fine"), fine)) / np.diff(fine)
    jumps = np.abs(np.diff(slope))
    assert jumps.max() < 0.06 * np.abs(slope).max()
    assert gas.p_max > 0


def test_smooth_points_meet_every_point_and_never_leave_their_neighbours() -> None:
    x = np.array([0.0, 1.0, 1.5, 4.0, 6.0, 7.0])
    y = np.array([1.0, 1.0, 5.0, 4.0, 0.5, 1.0])
    nodes = periodic_nodes(x, y)
    np.testing.assert_allclose(nodes.at(x), y, atol=1e-14)
    fine = np.linspace(0, 7, 3001)
    row = np.clip(np.searchsorted(x, fine, side="right") - 1, 0, len(x) - 2)
    low, high = np.minimum(y[row], y[row + 1]), np.maximum(y[row], y[row + 1])
    values = nodes.at(fine)
    assert (values >= low - 1e-12).all()
    assert (values <= high + 1e-12).all()
    assert nodes.slope[0] == nodes.slope[-1]  # the diagram closes without a corner


def test_mean_indicated_pressure_is_the_area_over_the_swept_volume() -> None:
    solution = solve(*engine_and_cycle(diagram_input(DIESEL, step=1)))
    gas, s = solution.columns["gas"], solution.scalars
    area = np.trapezoid(gas["p_MPa"], gas["volume_dm3"])
    assert s["p_i_area"] == pytest.approx(area / s["V_h"], rel=1e-12)
    # The torque does the same work but for the two-term acceleration and the grid.
    assert s["p_i_area"] == pytest.approx(s["p_i_calc"], rel=2e-3)


@pytest.mark.parametrize("case", ["rounded", "points"])
def test_recalculated_workbook_agrees_and_reads_back(case: str, tmp_path: Path) -> None:
    gas = DIESEL
    if case == "points":
        points = points_of(diagram_input(PETROL, 9.5), 3)
        gas = {"source": "table", "interpolation": "monotone", "points": points}
    data = diagram_input(gas, step=30)
    book = recalculated_as_solved(build_model(data))
    file = tmp_path / "book.xlsx"
    file.write_bytes(book)
    assert load_workbook_input(file).model == data


REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "start after TDC": (
        {"ignition_delay_deg": 25.0},
        "gas.ignition_delay_deg: сгорание начинается при 360°; "
        "точка c' должна лежать до ВМТ: уменьшите задержку воспламенения",
    ),
    "join before the peak": (
        {"expansion_after_tdc_deg": 11.0},
        "gas.expansion_after_tdc_deg: выход на линию расширения при 11° не позже точки z_д; "
        "задайте больше 12°",
    ),
    "low peak": (
        {"max_pressure_mpa": 2.0},
        "gas.max_pressure_mpa: p_zд не выше давления в c''",
    ),
    "residual too high": (
        {"residual_pressure_mpa": 0.6},
        "gas.residual_pressure_mpa: ",
    ),
    "early exhaust": (
        {"exhaust_start_before_bdc_deg": 120.0, "expansion_after_tdc_deg": 80.0},
        "gas.exhaust_start_before_bdc_deg: выпуск начинается раньше линии расширения; "
        "уменьшите угол",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_joined_is_refused(case: str) -> None:
    changes, message = REFUSED[case]
    with pytest.raises(InputError) as caught:
        diagram_input(PETROL | changes, 9.5)
    (line,) = caught.value.lines()
    assert line.removeprefix("gas.toml: ").startswith(message)


HEAD = '[gas]\nsource = "file"\nfile = "{file}"\npressure_unit = "{unit}"\n{more}\n'


def written(tmp_path: Path, table: str, unit: str = "bar", more: str = "") -> Path:
    """The textbook's diesel with a diagram from a file beside it."""
    text = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
    before, rest = text.split("[gas]", 1)
    after = rest[rest.index("[masses]") :]
    head = HEAD.format(file="diagram.csv", unit=unit, more=more)
    (tmp_path / "diagram.csv").write_text(table, encoding="utf-8")
    file = tmp_path / "engine.toml"
    file.write_text(before + head + after, encoding="utf-8")
    return file


def table(points: list[list[float]], delimiter: str, *, turn: float = 0.0, comma: bool = False,
          scale: float = 10.0, head: str = "") -> str:  # fmt: skip
    lines = [head] if head else []
    for angle, pressure in points:
        line = delimiter.join((f"{angle + turn:g}", f"{pressure * scale:.6g}"))
        lines.append(line.replace(".", ",") if comma else line)
    return "\n".join(lines) + "\n"


def test_files_of_every_shape_give_the_same_points(tmp_path: Path) -> None:
    points = points_of(diagram_input(DIESEL), 1)[:-1]
    expected = [[round(a, 6), p] for a, p in points]
    shapes = {
        "csv": (table(points, ",", head="phi,p"), ""),
        "named": (table(points, ";", comma=True, head="угол;давление"),
                  'angle_column = "угол"\npressure_column = "давление"'),
        "tabs": (table(points, "\t", head="CA, deg\tp, bar"), ""),
        "blanks with another zero": (
            table(points, "   ", turn=-360, comma=True, head="Результаты расчета\n\n deg  bar"),
            "firing_tdc_deg = 0",
        ),
    }  # fmt: skip
    for name, (text, more) in shapes.items():
        gas = load_toml(written(tmp_path, text, more=more)).model.gas
        assert gas.interpolation == "monotone"
        got = np.array(gas.points)
        np.testing.assert_allclose(got[:-1], expected, rtol=1e-5, err_msg=name)
        assert got[-1].tolist() == [720, got[0][1]]


def test_a_file_that_begins_within_the_cycle_is_closed(tmp_path: Path) -> None:
    points = [[a + 2.5, p] for a, p in points_of(diagram_input(DIESEL), 1)[:-1]]
    gas = load_toml(written(tmp_path, table(points, ","))).model.gas
    assert gas.points[0][0] == 0
    assert gas.points[-1] == (720, gas.points[0][1])


BAD_FILES = {
    "words": ("угол;давление\nноль;один\n", "bar", "", "не найдена таблица чисел"),
    "a gap": ("0,1\n10,2\n20,1\n", "bar", "", "между точками 700°, диаграмма не покрывает цикл"),
    "no unit": ("0,1\n1,2\n2,3\n", "", "", "не указана единица давления"),
    "no such column": ("0,1\n1,2\n2,3\n", "bar", "pressure_column = 5", "нет столбца 5"),
    "ragged": ("0,1\n1,2,3\n", "bar", "", "строка 2: чисел 3, а выше 2"),
    "two tables": ("0,1\n1,2\n2,3\nконец\n", "bar", "", "строка 4: не числа"),
    "two cycles": (
        "\n".join(f"{a},1" for a in range(0, 1441, 20)), "bar", "",
        "углы занимают 1440°, больше цикла 720°",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD_FILES)
def test_a_file_that_is_not_understood_is_one_line(case: str, tmp_path: Path) -> None:
    text, unit, more, message = BAD_FILES[case]
    with pytest.raises(InputError) as caught:
        load_toml(written(tmp_path, text, unit, more))
    (line,) = caught.value.lines()
    assert message in line
    assert "\n" not in line


def test_a_file_elsewhere_is_refused(tmp_path: Path) -> None:
    file = written(tmp_path, "0,1\n")
    text = file.read_text(encoding="utf-8").replace('"diagram.csv"', '"../secret.csv"')
    file.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match="файл должен лежать рядом"):
        load_toml(file)


def test_values_of_the_points_stand_in_the_sheet() -> None:
    values = evaluate_model(build_model(diagram_input(PETROL, 9.5))).scalars
    assert [values[f"node_deg{n}"] for n in (1, 4, 5, 6, 9, 11)] == [0, 345, 360, 372, 540, 720]


@pytest.mark.libreoffice
def test_libreoffice_agrees(libreoffice: LibreOffice) -> None:
    """MATCH and INDEX in a row and in a column mean the same to the other referee."""
    points = points_of(diagram_input(PETROL, 9.5), 3)
    smooth = {"source": "table", "interpolation": "monotone", "points": points}
    models = [build_model(diagram_input(gas, step=30)) for gas in (DIESEL, smooth)]
    books = [workbook_bytes(model) for model in models]
    results = libreoffice.recalculate(books)
    for model, book, result in zip(models, books, results, strict=True):
        assert errors_in(result) == []
        assert differences_from_caches(book, result) == []
        assert differences_from_solver(model, result)[1] == []
