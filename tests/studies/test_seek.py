"""The command that looks for inputs."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest
from click.testing import CliRunner

from reports.cli import main
from tests.conftest import ROOT

BASE = str(ROOT / "samples" / "vaz-2106.toml")
BOLT = ("--vary", "strength.bolt_mm=7:12")


def said(*words: str) -> tuple[int, str]:
    done = CliRunner().invoke(main, ["optimise", BASE, *words])
    return done.exit_code, done.output


def test_the_input_that_makes_a_result_as_a_file(tmp_path: Path) -> None:
    target = tmp_path / "bolt.toml"
    code, text = said(*BOLT, "--reach", "st_bolt_n=2", "-o", str(target))
    assert code == 0 and "мм (Диаметр болта)\nst_bolt_n = 2; решено: " in text
    value = float(text.partition(" = ")[2].partition(" ")[0].replace(",", "."))
    strength = tomllib.loads(target.read_text(encoding="utf-8"))["strength"]
    assert strength["bolt_mm"] == pytest.approx(value, rel=1e-7)
    assert CliRunner().invoke(main, ["check", str(target)]).exit_code == 0


def test_the_inputs_of_the_greatest_result() -> None:
    limits = ("--vary", "geometry.bore_mm=70:80", "--vary", "regime.speed_rpm=3000:4000")
    code, text = said(*limits, "--most", "kinematics.mean_piston_speed")
    assert code == 0 and "regime.speed_rpm = 4000 мин⁻¹" in text


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (BOLT, "нужен один из ключей --least, --most и --reach"),
        ((*BOLT, "--reach", "st_bolt_n=9"), "st_bolt_n: в этих пределах не достигает 9; величина"),
        ((*BOLT, "--reach", "st_bolt_n"), "--reach st_bolt_n: нужно ИМЯ=ЧИСЛО"),
        ((*BOLT, "--least", "st_bolt_nn"), "нет такой величины; похожи: st_bolt_n"),
        ((*BOLT, "--least", "P4_1.N_MPa"), "P4_1.N_MPa: это несколько чисел; назовите одно"),
        (("--vary", "engine.cylinders=1:2", "--least", "M_mean"), "меняет строение расчёта"),
        (("--vary", "geometry.bore_mm=1:2", "--least", "M_mean"), "нет годного двигателя: geom"),
        (("--vary", "geometry.bore_mm=2:1", "--least", "M_mean"), "пределы не возрастают"),
        ((*BOLT, "--vary", "geometry.bore_mm=70:80", "--reach", "st_bolt_n=2"),
         "ключей 2, а можно до 1"),
    ],
)  # fmt: skip
def test_what_cannot_be_sought_is_told(words: tuple[str, ...], text: str) -> None:
    code, output = said(*words)
    assert code == 2 and text in output and len(output.splitlines()) == 1
