"""Tables 1-3 and 5-8 for any λ, figures 3-10 and 20."""

from __future__ import annotations

import io
import zipfile

import numpy as np
import pytest

from kshm import solve
from kshm.results.reference import REFERENCE_LAMBDAS, reference_tables
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.engine import engine_and_cycle
from reports.model.evaluation import evaluate_model
from reports.shared.errors import InputError
from reports.tables.registry import build_model
from reports.workbook.read import load_workbook_input
from tests.conftest import sample
from tests.referee.compare import recalculated_as_solved
from tests.tables.test_two_statements import assert_agree


def asked(**reference: object) -> InputFile:
    raw = to_mapping(sample("gots-p3"))
    raw["calculation"]["step_deg"] = 30
    raw["reference"] = reference
    return load_mapping(raw, source="reference.toml").model


def test_the_books_list_gives_the_books_tables() -> None:
    data = asked()
    columns = evaluate_model(build_model(data)).columns
    for name, printed in reference_tables().items():
        ours = columns[name.replace("table_", "ref_")]
        for i, (key, _) in enumerate(REFERENCE_LAMBDAS, 1):
            np.testing.assert_allclose(np.abs(ours[f"ref_lambda{i}"]), printed[key], atol=2e-6)


@pytest.mark.parametrize("lambdas", [[0.25], [0.2, 0.3, 0.4], [0.05 * i for i in range(1, 13)]])
def test_both_statements_agree_for_any_list(lambdas: list[float]) -> None:
    assert_agree(asked(lambdas=lambdas, angle_deg=35.0))


def test_workbook_is_live_and_reads_back(tmp_path) -> None:
    data = asked(lambdas=[0.2, 0.28])
    book = recalculated_as_solved(build_model(data))
    file = tmp_path / "book.xlsx"
    file.write_bytes(book)
    assert load_workbook_input(file).model == data
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        text = b"".join(
            archive.read(name) for name in archive.namelist() if name.startswith("xl/charts/")
        ).decode()
    for figure in ("3", "4", "5, 9", "6", "7", "8", "10"):
        assert f"[рис.\xa0{figure}]" in text
    assert "рис.\xa020" in text


def test_without_the_section_only_figure_20_stands() -> None:
    model = build_model(sample("gots-diesel"))
    assert [t for t in model.tables if t.startswith("ref_")] == []
    assert "vectors" in model.tables


def test_vectors_project_to_the_forces() -> None:
    columns = solve(*engine_and_cycle(sample("gots-p3"))).columns["vectors"]
    np.testing.assert_allclose(columns["C1_y_kN"], columns["Pj1_kN"], atol=1e-9)
    size = np.hypot(columns["C2_x_kN"], columns["C2_y_kN"])
    np.testing.assert_allclose(size, size[0], rtol=1e-12)
    away = np.hypot(columns["rose2_x_kN"], columns["rose2_y_kN"])
    np.testing.assert_allclose(away, np.abs(columns["Pj2_kN"]), atol=1e-9)


@pytest.mark.parametrize("count", [0, 13])
def test_a_list_of_wrong_length_is_one_line(count: int) -> None:
    with pytest.raises(InputError) as caught:
        asked(lambdas=[0.25] * count)
    (line,) = caught.value.lines()
    assert line == (
        f"reference.toml: reference.lambdas: значений {count}, а нужно от 1 до 12; исправьте список"
    )
