"""Tolerances in, bands out: a linear result's band is known, and which input moves it."""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner
from openpyxl import load_workbook

import kshm
from reports.cli import main
from tests.api.test_api import small
from tests.conftest import ROOT

BASE = str(ROOT / "samples" / "gots-diesel.toml")
SPANS = ("--tolerance", "regime.speed_rpm=40", "--tolerance", "bore_mm=0.02")


def test_the_band_of_a_linear_result_and_of_one_by_itself() -> None:
    """c = n·S/30 of evenly spread n: quantiles at ±0.95 of the tolerance, the rank is 1."""
    bands = kshm.tolerance(small(), {"speed_rpm": 60, "bore_mm": 0.02}, quantities=["c_m", "V_h"])
    speed, volume = bands.bands
    half = 60 * 0.08 / 30
    assert (speed.base, speed.middle) == pytest.approx((8.0, 8.0), rel=1e-4)
    assert (speed.low - 8, speed.high - 8) == pytest.approx((-0.95 * half, 0.95 * half), rel=5e-3)
    assert speed.ranks["speed_rpm"] == pytest.approx(1) and abs(speed.ranks["bore_mm"]) < 0.1
    assert (speed.first, volume.first) == ("speed_rpm", "bore_mm")
    assert 8 - half <= speed.least < speed.low and speed.high < speed.greatest <= 8 + half
    assert bands.table.shape == (2, 8) and not bands.failed and "<table" in bands._repr_html_()
    again = kshm.tolerance(small(), {"speed_rpm": 60, "bore_mm": 0.02}, quantities=["c_m", "V_h"])
    assert again.samples.equals(bands.samples)


def test_ranks_are_those_of_scipy() -> None:
    from scipy.stats import spearmanr

    spans = {"max_mpa": 1, "reciprocating_kg": 0.05, "rod_big_end_kg": 0.05}
    from kshm.engine.revised import find

    engine = small(gas=kshm.polytropic(
        intake_mpa=0.09, residual_mpa=0.11, max_mpa=6, compression_exponent=1.36,
        expansion_exponent=1.25, combustion_start_deg=350, injection_advance_deg=20,
        exhaust_open_deg=500, exhaust_close_deg=560,
    ))  # fmt: skip
    bands = kshm.tolerance(engine, spans, quantities=["Rpin_mean"], samples=200)
    (band,), frame = bands.bands, bands.samples
    for name in spans:
        expected = spearmanr(frame[name], frame["Rpin_mean"]).statistic
        assert band.ranks[name] == pytest.approx(expected, abs=1e-12)
        assert abs(frame[name] - find(engine, name).value_in(engine)).max() <= spans[name]


def test_an_engine_outside_of_its_limits_is_left_out() -> None:
    bands = kshm.tolerance(small(), {"bore_mm": 100}, quantities=["V_h"], samples=100)
    assert 5 < bands.failed < 20 and bands.samples["error"].str.len().gt(0).sum() == bands.failed


@pytest.mark.parametrize("suffix", [".csv", ".xlsx", ".html"])
def test_a_file_of_each_kind(tmp_path: Path, suffix: str) -> None:
    target = tmp_path / f"bands{suffix}"
    words = ["sweep", BASE, *SPANS, "--samples", "100", "--quantity", "c_m", "-o", str(target)]
    done = CliRunner().invoke(main, words)
    assert done.exit_code == 0 and "двигателей 100" in done.output
    if suffix == ".csv":
        (row,) = csv.DictReader(target.open(encoding="utf-8"))
        assert float(row["base"]) == pytest.approx(4400 * 0.094 / 30)
        assert row["first"] == "regime.speed_rpm" and float(row["regime.speed_rpm"]) > 0.999
    elif suffix == ".xlsx":
        book = load_workbook(target)
        assert book.sheetnames == ["Разброс", "Влияние", "Выборка"]
        assert book["Разброс"]["I4"].value == "Частота вращения, мин⁻¹"
        assert book["Выборка"].max_row == 103
    else:
        text = target.read_text(encoding="utf-8")
        assert "<svg" in text and "влияет величина «частота вра" in text


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--tolerance", "bore_mm"), "--tolerance bore_mm: нужно КЛЮЧ=ДОПУСК"),
        (("--tolerance", "bore_mm=-1"), "число больше нуля"),
        (("--tolerance", "bor_mm=1"), "в файле нет ключа bor_mm; похожи: geometry.bore_mm"),
        ((*SPANS, "--vary", "geometry.bore_mm=80:90:3"), "--tolerance исключает --vary"),
        ((*SPANS, "--samples", "1"), "--samples: нужно от 20 до 1000000"),
        ((*SPANS, "--quantity", "c_mm"), "--quantity c_mm: нет такой величины; похожи: c_m"),
        ((), "нужен ключ --vary"),
    ],
)  # fmt: skip
def test_what_is_no_tolerance_is_told(tmp_path: Path, words: tuple[str, ...], said: str) -> None:
    done = CliRunner().invoke(main, ["sweep", BASE, *words, "-o", str(tmp_path / "a.csv")])
    assert done.exit_code == 2 and said in done.output and len(done.output.splitlines()) == 1


def test_without_scipy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "scipy.stats", None)
    done = CliRunner().invoke(main, ["sweep", BASE, *SPANS, "-o", str(tmp_path / "a.csv")])
    assert done.exit_code == 3 and 'пакет scipy; установите его: pip install "kshm' in done.output
