"""Parameter studies: rows against single solutions, streaming, refusals, files."""

from __future__ import annotations

import csv
import io
import itertools
import random
import tracemalloc
from pathlib import Path

import numpy as np
import openpyxl
import pytest
from click.testing import CliRunner

from kshm import solve
from kshm.results.case import first_extreme
from kshm.results.chosen import ChosenQuantities
from reports.cli import main
from reports.inputs.fields import set_value, to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared import parallel_map
from reports.shared.errors import InputError, KshmError
from reports.shared.resources import samples_dir
from reports.studies import plan as plan_module
from reports.studies import sweep as run_module
from reports.studies.plan import make_plan
from reports.studies.sweep import Studied, SweepOptions, sweep
from tests.conftest import sample

BASE = samples_dir() / "gots-diesel.toml"
V_ENGINE = samples_dir() / "yamz-236.toml"
SLOW = ("M_mean", "P3_1.j_m_s2", "B_max", "P4_3_2.R_MPa")
VARY = ("regime.speed_rpm=1500:4400:4", "crankshaft.webs.2.counterweight_kg=0.5:1.1:3")


def studied(folder: Path, *vary: str, name: str = "a.csv", **more: object) -> list[dict[str, str]]:
    """Rows of a study as CSV."""
    target = folder / name
    base = more.pop("base", BASE)
    sweep(base, vary or VARY, target, **more)
    return list(csv.DictReader(io.StringIO(target.read_text(encoding="utf-8"))))


@pytest.mark.parametrize(
    ("base", "vary", "asked"),
    [
        (BASE, VARY, ()),
        (
            BASE,
            ("gas.max_pressure_mpa=8:12:5",),
            SLOW,
        ),
        (V_ENGINE, ("geometry.rod_length_mm=255:275:3", "masses.piston_group_kg=3:4:2"), ()),
    ],
)
def test_rows_are_what_single_solutions_give(
    tmp_path: Path, base: Path, vary: tuple[str, ...], asked: tuple[str, ...]
) -> None:
    model = sample(base.stem)
    plan = make_plan(model, base.name, vary, pairwise=False)
    rows = studied(tmp_path, *vary, base=base, quantities=asked)
    assert len(rows) == plan.count
    for number in random.Random(3).sample(range(plan.count), 3):
        raw = to_mapping(model)
        for axis, value in zip(plan.axes, plan.point(number), strict=True):
            set_value(raw, axis.paths[0], value)
            assert float(rows[number][axis.key]) == value
        solution = solve(*engine_and_cycle(load_mapping(raw, source="x").model))
        checked = 0
        for name, text in rows[number].items():
            if name in solution.scalars:
                assert float(text) == pytest.approx(solution.scalars[name], rel=1e-9, abs=1e-9)
                checked += 1
            elif name.count(".") == 2 and name.split(".")[0] in solution.columns:
                table, key, part = name.split(".")
                columns = solution.columns[table]
                values = columns[key]
                most = first_extreme(values, columns["phi_deg"])
                least = first_extreme(values, columns["phi_deg"], largest=False)
                wanted = {"max": most[0], "max_deg": most[1], "min": least[0], "min_deg": least[1],
                          "mean": values[:-1].mean()}[part]  # fmt: skip
                assert float(text) == pytest.approx(wanted, rel=1e-9, abs=1e-9), name
                checked += 1
        assert checked >= (150 if not asked else 12)
        assert rows[number]["error"] == ""


def test_streaming_in_tiny_chunks_is_one_chunk(tmp_path: Path) -> None:
    one = studied(tmp_path, name="one.csv")
    tiny = studied(tmp_path, name="tiny.csv", options=SweepOptions(chunk=5))
    for left, right in zip(one, tiny, strict=True):
        for name, text in left.items():
            if text:
                assert float(right[name]) == pytest.approx(float(text), rel=1e-12, abs=1e-12)


def test_processes_change_no_byte(tmp_path: Path) -> None:
    for jobs in (1, 2):
        sweep(BASE, VARY, tmp_path / f"{jobs}.csv", options=SweepOptions(jobs=jobs, chunk=3))
    assert (tmp_path / "1.csv").read_bytes() == (tmp_path / "2.csv").read_bytes()


def test_memory_does_not_grow_with_the_study(tmp_path: Path) -> None:
    peaks = []
    for count in (40, 240):
        tracemalloc.start()
        vary = (f"regime.speed_rpm=1500:4400:{count}",)
        sweep(BASE, vary, tmp_path / "a.csv", quantities=("M_mean",),
              options=SweepOptions(jobs=1, chunk=20))  # fmt: skip
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 1.2 * peaks[0]


def test_only_a_few_items_are_under_way(monkeypatch: pytest.MonkeyPatch) -> None:
    read = itertools.count()
    items = (next(read) for _ in range(200))

    class Future:
        def __init__(self, value: int) -> None:
            self.value = value

        def result(self) -> int:
            return self.value

        def cancel(self) -> None:
            pass

    results = parallel_map._windowed(lambda work, item: Future(work(item)), abs, items, 7)
    assert next(results) == 0
    assert next(read) == 7
    assert len(list(results)) > 150


def test_what_fails_the_check_stays_as_a_row_with_its_reason(tmp_path: Path) -> None:
    rows = studied(tmp_path, "geometry.bore_mm=5:88:2", "regime.speed_rpm=1500:4400:2",
                   quantities=("M_mean",))  # fmt: skip
    assert [bool(row["error"]) for row in rows] == [True, False, True, False]
    assert "geometry.bore_mm" in rows[0]["error"]
    assert rows[0]["M_mean"] == ""
    done = sweep(BASE, ("geometry.bore_mm=5:88:2",), tmp_path / "b.csv")
    assert (done.points, done.failed) == (2, 1)
    assert "bore_mm" in done.first_error


def test_a_record_of_a_list_is_called_by_its_number_from_one() -> None:
    vary = ("crankshaft.webs.2.mass_kg=1:2:2",)
    (axis,) = make_plan(sample(BASE.stem), BASE.name, vary, pairwise=False).axes
    assert axis.paths == (("crankshaft", "webs", 1, "mass_kg"),)


def test_pairwise_takes_values_in_order(tmp_path: Path) -> None:
    vary = ("regime.speed_rpm=2000:3000:3", "geometry.bore_mm=80:90:3")
    rows = studied(tmp_path, *vary, pairwise=True, quantities=("c_m",))
    assert [(row["regime.speed_rpm"], row["geometry.bore_mm"]) for row in rows] == [
        ("2000.0", "80.0"), ("2500.0", "85.0"), ("3000.0", "90.0"),
    ]  # fmt: skip
    with pytest.raises(InputError, match="разное число значений"):
        studied(tmp_path, vary[0], "geometry.bore_mm=80:90:2", pairwise=True)


@pytest.mark.parametrize(
    ("vary", "said"),
    [
        ("geometry.bore=80:90:3", "нет ключа geometry.bore; похожи: geometry.bore_mm"),
        ("geometry.bore_mm", "нужно КЛЮЧ=ОТ:ДО:ЧИСЛО"),
        ("geometry.bore_mm=80:90", "нужно ОТ:ДО:ЧИСЛО"),
        ("geometry.bore_mm=80:inf:3", "нужно ОТ:ДО:ЧИСЛО"),
        ("geometry.bore_mm=80:90:0", "нужно ОТ:ДО:ЧИСЛО"),
        ("geometry.bore_mm=80:90:99999999", "точек больше"),
        ("engine.name=1:2:2", "не число"),
        ("calculation.step_deg=5:10:2", "не число|меняет строение"),
    ],
)
def test_what_cannot_be_varied_is_refused(tmp_path: Path, vary: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        studied(tmp_path, vary)
    assert list(tmp_path.iterdir()) == []


def test_other_refusals(tmp_path: Path) -> None:
    for more, said in (
        ({"quantities": ("M_men",)}, "нет такой величины; похожи: M_mean"),
        ({"name": "a.ods"}, "нужно окончание .parquet, .csv, .xlsx"),
    ):
        with pytest.raises(KshmError, match=said):
            studied(tmp_path, **more)
    with pytest.raises(InputError, match="ключ задан дважды"):
        studied(tmp_path, VARY[0], VARY[0])
    with pytest.raises(InputError, match="в книге помещается"):
        studied(tmp_path, "geometry.bore_mm=80:90:400", "regime.speed_rpm=1000:4000:400",
                name="a.xlsx")  # fmt: skip
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["a.csv", "a.parquet", "a.xlsx"])
def test_a_study_that_breaks_off_leaves_the_old_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    def breaking(work: object, items: object, **_: object) -> object:
        yield work(next(iter(items)))  # type: ignore[operator]
        raise KeyboardInterrupt

    (tmp_path / name).write_text("old")
    monkeypatch.setattr(run_module, "in_order", breaking)
    with pytest.raises(KeyboardInterrupt):
        sweep(BASE, VARY, tmp_path / name, options=SweepOptions(chunk=5))
    assert (tmp_path / name).read_text() == "old"
    assert sorted(path.name for path in tmp_path.iterdir()) == [name, f"{name}.part"]


def test_parquet_holds_the_numbers_of_the_csv(tmp_path: Path) -> None:
    pd = pytest.importorskip("pandas")
    vary = ("geometry.bore_mm=5:88:2", *VARY[:1])
    rows = studied(tmp_path, *vary)
    sweep(BASE, vary, tmp_path / "a.parquet", options=SweepOptions(chunk=3))
    frame = pd.read_parquet(tmp_path / "a.parquet")
    assert list(frame.columns) == list(rows[0])
    for (_, item), row in zip(frame.iterrows(), rows, strict=True):
        assert ("" if pd.isna(item["error"]) else item["error"]) == row["error"]
        if not row["error"]:
            assert item["M_mean"] == pytest.approx(float(row["M_mean"]), rel=1e-12)


def test_the_workbook_shows_a_family_of_curves(tmp_path: Path) -> None:
    target = tmp_path / "a.xlsx"
    sweep(BASE, VARY, target, quantities=("M_max", "P4_1.N_MPa"))
    book = openpyxl.load_workbook(target)
    data, summary, charts = (book[name] for name in ("Результаты", "Сводка", "Диаграммы"))
    keys = [cell.value for cell in data[1]]
    assert keys[:3] == ["regime.speed_rpm", "crankshaft.webs.2.counterweight_kg", "M_max"]
    assert data.max_row == 2 + 12
    column = [data.cell(row, 3).value for row in range(3, 15)]
    line = next(row for row in summary.iter_rows(values_only=True) if row[0] == "M_max")
    assert line[3] == max(column)
    assert line[4] == data.cell(3 + column.index(max(column)), 1).value
    assert len(charts._charts) == 4  # the torque; extremes and mean of the force
    first = charts._charts[0]
    assert [series.tx.v for series in first.series] == ["0,5 кг", "0,8 кг", "1,1 кг"]
    cached = [float(point.v) for point in first.series[1].yVal.numRef.numCache.pt]
    assert cached == pytest.approx(column[4:8], rel=1e-5)  # a chart keeps six digits
    assert first.series[1].yVal.numRef.f == "'Результаты'!$C$7:$C$10"


def test_every_crankpin_has_its_chart_where_nothing_is_asked_for(tmp_path: Path) -> None:
    """Another pin than the first may carry the most."""
    target = tmp_path / "a.xlsx"
    sweep(V_ENGINE, ("regime.speed_rpm=1500:2100:2",), target)
    charts = openpyxl.load_workbook(target)["Диаграммы"]._charts
    titles = ["".join(run.t for part in c.title.tx.rich.p for run in part.r) for c in charts]
    assert len([title for title in titles if "Наибольшая удельная нагрузка" in title]) == 3


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "a.csv"
    with pytest.raises(SystemExit) as stop:
        main(["sweep", str(BASE), "--vary", "geometry.bore_mm=5:88:2", "-o", str(target)])
    assert stop.value.code == 1
    said = capsys.readouterr()
    assert "сочетаний 2" in said.out
    assert "Без результата: 1" in said.err
    assert "Studied" in repr(Studied(1, 0))


def test_the_workbook_reads_as_a_person_does(tmp_path: Path) -> None:
    """A curve without results has no key, a constant no place of its extremes, an axis a symbol."""
    target = tmp_path / "a.xlsx"
    vary = ("regime.speed_rpm=3000:4400:3", "geometry.rod_length_mm=40:160:3")
    sweep(BASE, vary, target, quantities=("S_stroke", "M_max", "P4_1.N_MPa"))
    book = openpyxl.load_workbook(target)
    lines = {row[0]: row for row in book["Сводка"].iter_rows(values_only=True)}
    assert lines["S_stroke"][4:6] == lines["S_stroke"][7:9] == ("не меняется",) * 2
    assert lines["M_max"][4] in (3000, 3700, 4400)
    assert "(П4.1)" in lines["P4_1.N_MPa.max"][1]
    charts = book["Диаграммы"]._charts
    for chart in charts:
        assert [series.tx.v for series in chart.series] == ["100 мм", "160 мм"]
    ordinate = charts[1].y_axis.title.tx.rich.p[0].r[0].t
    assert ordinate == "Mmax, Н·м"


def test_an_abbreviation_in_a_title_stays_in_capitals(tmp_path: Path) -> None:
    target = tmp_path / "a.xlsx"
    vary = ("regime.speed_rpm=3000:4400:2", "cycle.compressor_efficiency=0.6:0.7:2")
    base = samples_dir() / "cycle-turbo-diesel.toml"
    sweep(base, vary, target, quantities=("M_mean",))
    (chart,) = openpyxl.load_workbook(target)["Диаграммы"]._charts
    title = "".join(run.t for part in chart.title.tx.rich.p for run in part.r)
    assert title.endswith("; кривые: КПД компрессора")


def test_a_study_without_a_result_has_no_empty_chart(tmp_path: Path) -> None:
    target = tmp_path / "a.xlsx"
    sweep(BASE, ("geometry.rod_length_mm=30:40:2",), target, quantities=("M_max",))
    book = openpyxl.load_workbook(target)
    assert not book["Диаграммы"]._charts
    assert all(row[-1] for row in book["Результаты"].iter_rows(min_row=3, values_only=True))


def test_a_result_that_is_no_number_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Beside a reason of its own, which stays."""
    plan = make_plan(sample(BASE.stem), BASE.name, ("geometry.bore_mm=85:88:2",), pairwise=False)
    numbers = {"c_m": np.array([np.nan, np.nan])}
    monkeypatch.setattr(
        plan_module, "of_batch", lambda *_: (numbers, [None, KshmError("своя причина")])
    )
    wanted = ChosenQuantities(("c_m",), (), slow=False)
    (task,) = plan_module.tasks(plan, wanted, 2)
    assert plan_module.solved(task).errors == [plan_module.NOT_FINITE, "своя причина"]


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_columns_tell_their_units(tmp_path, suffix):
    target = tmp_path / f"study{suffix}"
    words = ["sweep", str(BASE), "-o", str(target), "--vary", "geometry.bore_mm=84:92:2"]
    form = ["--units", "--excel"] if suffix == ".csv" else []
    done = CliRunner().invoke(main, [*words, "--quantity", "M_mean", *form])
    assert done.exit_code == 0, done.output
    if suffix == ".csv":
        lines = target.read_text(encoding="utf-8-sig").splitlines()
        assert lines[:2] == ["geometry.bore_mm;M_mean;error", "мм;Н·м;"]
        assert "," in lines[2] and "." not in lines[2]
    else:
        from pyarrow import parquet

        field = parquet.read_schema(target).field("M_mean")
        assert field.metadata[b"unit"].decode() == "Н·м"


def test_a_number_of_cylinders_is_no_axis(tmp_path):
    words = ["sweep", str(BASE), "-o", str(tmp_path / "a.csv"), "--vary", "engine.cylinders=3:6:4"]
    done = CliRunner().invoke(main, words)
    assert done.exit_code == 2
    assert "ключ engine.cylinders меняет строение расчёта; сделайте отдельный файл" in done.stderr
