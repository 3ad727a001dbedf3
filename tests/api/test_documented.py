"""The documented lines: typed, run, and the same numbers as the command."""

from __future__ import annotations

import copy
import io
import json
import pickle
import re
import runpy
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import kshm
import reports
from reports.exports.department_chapters import own_numbers
from reports.exports.numbers import json_text
from reports.inputs.solve_input import solved
from reports.python import figures
from reports.python.api import loaded_of
from tests.api.test_api import small
from tests.conftest import ROOT, sample_names
from tests.manual.pages import DOCS, blocks

SCRIPT = Path(__file__).parent / "documented.py"


def test_a_notebooks_way_through_the_names(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    names = runpy.run_path(str(SCRIPT))
    assert names["same"] == names["also"] == names["engine"]
    assert names["peak"] == names["again"][0] and names["again"][1:] == [names["solution"]] * 2
    assert names["study"].shape == (6, 9) and not names["study"]["error"].any()
    assert names["torque"].shape == (2,) and names["wide"].geometry.bore == 0.09
    assert names["svg"].startswith("<svg") and "Rш.ш" in names["said"]
    assert [path.suffix for path in names["files"]] == [".xlsx", ".html"]
    assert abs(names["root"].result - 0.02) < 1e-9
    assert 0.2 < names["lighter"]["crankshaft.webs.*.counterweight_kg"] < 3
    text = SCRIPT.read_text(encoding="utf-8")
    for package in (kshm, reports):
        for name in package.__all__:
            assert re.search(rf"\b{package.__name__}\.{name}\b", text), name


def test_the_lines_are_clean_under_strict_types(tmp_path: Path) -> None:
    page = tmp_path / "page.py"
    page.write_text("\n".join(blocks(DOCS / "api.md", "python")), encoding="utf-8")
    words = ["mypy", "--strict", "--config-file", "pyproject.toml", SCRIPT, page]
    done = subprocess.run(
        [sys.executable, "-m", *words],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout


def test_the_script_is_clean_under_pyright(tmp_path: Path) -> None:
    checked = tmp_path / SCRIPT.name
    checked.write_text(SCRIPT.read_text(encoding="utf-8"), encoding="utf-8")
    settings = {
        "include": [checked.name], "extraPaths": [str(ROOT)], "typeCheckingMode": "strict",
        "reportMissingTypeStubs": False, "pythonVersion": "3.11",
    }  # fmt: skip
    (tmp_path / "pyrightconfig.json").write_text(json.dumps(settings), encoding="utf-8")
    words = [sys.executable, "-m", "basedpyright", "-p", tmp_path, "--pythonpath", sys.executable]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize("name", sample_names())
def test_an_engine_of_a_file_has_every_number_of_the_command(name: str) -> None:
    _, loaded = loaded_of(name)
    model = loaded.model
    said = json.loads(json_text(model, solved(model), extra=own_numbers(model)))
    solution = kshm.solve(reports.load(name, warn=False))
    assert solution.scalars == {key: each["value"] for key, each in said["summary"].items()}
    assert sorted(solution.tables) == sorted(said["tables"])
    for table, each in said["tables"].items():
        assert [column["key"] for column in each["columns"]] == list(solution.tables[table])
        assert len(each["rows"]) == len(solution.tables[table])


def test_a_changed_engine_has_the_cycle_of_its_own_numbers_or_none() -> None:
    from dataclasses import replace

    engine = reports.load("cycle-petrol", warn=False)
    low = engine.with_(compression_ratio=8.5)
    for key in ("cyc_N_e", "N_i_calc"):
        assert kshm.solve(low).scalars[key] < kshm.solve(engine).scalars[key]
    by_hand = kshm.solve(replace(engine, omega=200.0)).scalars
    assert "cyc_N_e" not in by_hand and "M_mean" in by_hand


@pytest.mark.parametrize("name", sample_names())
def test_what_is_dumped_loads_as_the_same_engine(name: str) -> None:
    engine = reports.load(name, warn=False)
    text = reports.dump(engine)
    assert reports.load(text.encode(), warn=False) == engine
    assert reports.dump(reports.load(io.StringIO(text), warn=False)) == text
    assert "# Диаметр цилиндра" in text or "power_kw" in text


def test_doors_and_what_they_refuse(tmp_path: Path) -> None:
    engine = reports.load("d-240", warn=False)
    path = tmp_path / "мой.toml"
    reports.dump(engine, path)
    with path.open("rb") as stream:
        assert reports.load(stream, warn=False) == engine
    assert [each.name for each in reports.build(path, tmp_path / "out", only=["html"])] == [
        "мой.html"
    ]
    for wrong, said in (
        (5, "нужен путь, словарь, байты или поток, а задано: int"),
        ("d-241", "файл не читается|нет файла|не найден"),
        (b"\xff\xfe\x00", "UTF-16"),
    ):
        with pytest.raises(kshm.InputError, match=said):
            reports.load(wrong)
    with pytest.raises(kshm.InputError, match="нет вида документа «pdff»"):
        reports.build(engine, tmp_path, only=["pdff"])
    with pytest.raises(kshm.InputError, match=r"engine\.with_"):
        reports.dump(small())


def test_other_values_by_every_kind_of_name() -> None:
    engine = reports.load("gots-diesel")
    for name in ("bore_mm", "geometry.bore_mm"):
        assert engine.with_({name: 90}).geometry.bore == 0.09
    assert engine.with_({"geometry.bore": 0.09}).geometry.bore == 0.09
    webs = engine.with_({"crankshaft.webs.*.counterweight_kg": 0.5}).crankshaft.throws
    assert {web.counterweight_mass for t in webs for web in (t.left_web, t.right_web)} == {0.5}
    plain = small().with_(counterweight_kg=0.5, method="exact", step_deg=10)
    assert plain.crankshaft.throws[0].left_web.counterweight_mass == 0.5
    assert (plain.method, plain.step_deg) == ("exact", 10)
    with pytest.raises(kshm.UnknownNameError, match=r"bor_mm: no such name; similar: .*bore_mm"):
        engine.with_(bor_mm=90)
    with pytest.raises(kshm.InputError, match=r"geometry\.bore_mm: значение −1"):
        engine.with_(bore_mm=-1)
    with pytest.raises(kshm.InputError, match="name something"):
        engine.with_()


def test_an_engine_and_a_solution_say_what_they_are() -> None:
    engine = reports.load("gots-diesel")
    solution = kshm.solve(engine)
    assert repr(engine).startswith("<Engine 'Дизель 3Ч 8,8/9,4") and len(repr(engine)) < 150
    assert "Mср = 113.484 Н·м" in repr(solution)
    assert "<svg" in solution._repr_html_() and "88 × 94 mm" in engine._repr_html_()
    assert pickle.loads(pickle.dumps(engine)).source.find("bore_mm") == "geometry.bore_mm"
    assert copy.deepcopy(solution) == solution and hash(solution) == hash(copy.copy(solution))
    assert solution != kshm.solve(engine.with_(bore_mm=90))
    for name in ("torque", "polar", "wear", "diagram"):
        assert getattr(solution.plot, name)()._repr_svg_().startswith("<svg")
    with pytest.raises(kshm.InputError, match="коренные шейки: от 1 до 4"):
        solution.plot.polar(9)
    assert np.isfinite(float(solution.torque.mean))


def test_of_several_crankpins_the_most_loaded_one_is_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: list[np.ndarray] = []
    monkeypatch.setattr(figures, "polar_path", lambda x, *_, **__: drawn.append(x) or "")
    monkeypatch.setattr(figures, "wear_diagram", lambda sums, *_: drawn.append(sums) or "")
    for speed, pin, rays in ((2100, "crankpin", ""), (3000, "crankpin_4", "pin_4_")):
        solution = kshm.solve(reports.load("yamz-238").with_(speed_rpm=speed))
        solution.plot.polar()
        solution.plot.wear()
        expected = (solution.columns[pin]["T_MPa"], solution.wear_sums[f"table_14_{rays}sums"])
        assert np.array_equal(drawn[-2], expected[0])
        assert np.array_equal(drawn[-1], expected[1]["ray_sum"])
