"""The report on a measured diagram: what of its points is printed, and what is attached."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from reports.document.page.style import USUAL
from reports.document.report import Report, _files
from reports.exports.build import remarks_of
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from tests.tables.test_diagram import DIESEL, diagram_input, points_of

_PRESSURES = [p for _, p in points_of(diagram_input(DIESEL, step=1), 1)[:-1] for _ in "12"]
FINE = [[n / 2, p] for n, p in enumerate(_PRESSURES)]
POINTS = [*FINE, [720.0, FINE[0][1]]]


def book(detail: str, points: list[list[float]]) -> str:
    raw = to_mapping(
        diagram_input({"source": "table", "interpolation": "monotone", "points": points})
    )
    raw["report"]["detail"] = detail
    model = build_model(load_mapping(raw, source="d").model)
    return Report.of(model, evaluate_model(model), Path("d.toml")).page("screen")


@pytest.mark.parametrize(("detail", "step", "rows"), [("course", 30, 26), ("full", 5, 145)])
def test_the_report_prints_the_points_that_its_step_takes(
    detail: str, step: int, rows: int
) -> None:
    text = book(detail, POINTS)
    assert f"напечатаны точки через {step}°" in text.replace("\xa0", " ")
    table = re.search(r"Точки индикаторной диаграммы.*?</table>", text, re.S)
    assert table is not None
    cells = re.findall(r"<td[^>]*>(.*?)</td>", table.group(), re.S)
    pairs = [cell for cell in cells[::2] if cell and "—" not in cell]
    assert len(pairs) == rows  # the highest stands at 370°: on the grid of 5°, off that of 30°


def test_few_points_are_all_printed() -> None:
    assert "напечатаны точки" not in book("course", points_of(diagram_input(DIESEL), 8))


def test_figures_of_the_curve_stand_in_the_text() -> None:
    text = re.sub(r"<[^>]+>", "", book("course", points_of(diagram_input(DIESEL), 1)))
    said = " ".join(text.split())
    assert "Наибольшее давление диаграммы 10,500 МПа достигается при 370,0°" in said
    assert "n1 = 1,37, расширения между 50 и 90° после ВМТ n2 = 1,24" in said


def test_all_points_are_attached(tmp_path: Path) -> None:
    source = tmp_path / "d.toml"
    source.write_text("x = 1", encoding="utf-8")
    model = build_model(diagram_input({"source": "table", "points": POINTS}))
    files = {file.name: file.data for file in _files(model, source, b"", USUAL)}
    lines = files["диаграмма.csv"].decode().splitlines()
    assert lines[0] == "phi_deg,p_MPa"
    assert [[float(x) for x in line.split(",")] for line in lines[1:]] == POINTS


def test_what_a_diagram_suggests_stands_beside_the_checks_of_the_workbook() -> None:
    gauge = [[a, p - 0.1] for a, p in points_of(diagram_input(DIESEL), 1)]
    loaded = load_mapping(
        to_mapping(diagram_input({"source": "table", "points": gauge})), source="d.toml"
    )
    assert any("похоже, что давление избыточное" in line for line in remarks_of(loaded))
