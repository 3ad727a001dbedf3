"""Engines of a task sheet: what is given stands in the file, the power is the one asked for."""

from __future__ import annotations

import itertools
import math
import random
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from reports.cli import main
from reports.inputs.load import Loaded, load_mapping, load_text, load_toml
from reports.inputs.reasons import usual_span
from reports.inputs.solve_input import flywheel_remark, power_problems, refined, solved
from reports.inputs.to_si.engine import engine_and_cycle
from reports.new.generate import file_text, generate_engine
from reports.new.scale_engine import kind_of
from reports.new.sizing import USUAL
from reports.shared.errors import InputError
from reports.shared.resources import samples_dir
from tests import cover

ALL = [
    (cylinders, layout, strokes, kind)
    for layout, strokes, kind in itertools.product(
        ("inline", "v", "opposed"), (4, 2), ("petrol", "diesel")
    )
    for cylinders in range(1, 13)
    if layout == "inline" or cylinders % 2 == 0
]
Case = tuple[tuple[int, str, int, str], dict[str, float | None]]


def made(case: tuple[int, str, int, str], task: dict[str, float | None]) -> Loaded:
    cylinders, layout, strokes, kind = case
    engine = generate_engine(cylinders, layout=layout, strokes=strokes, kind=kind, **task)
    return load_text(file_text(engine), source="own.toml")


def effective_kw(loaded: Loaded) -> float:
    moment = float(solved(loaded.model).scalars["M_e"])
    return moment * float(loaded.model.regime.speed_rpm) * math.pi / 30 / 1000


def told(loaded: Loaded) -> list[str]:
    """What the command `check` warns of."""
    return [
        *(problem.line() for problem in (*loaded.warnings, *power_problems(loaded.model))),
        *filter(None, [flywheel_remark(loaded.model)]),
    ]


def drawn(number: int) -> Case:
    """A task as a teacher's sheet has it; layouts, strokes and fuels come in turn."""
    draw = random.Random(number)
    kinds = [case[1:] for case in ALL]
    kind = sorted(set(kinds))[number % len(set(kinds))]
    case = draw.choice([case for case in ALL if case[1:] == kind])
    cylinders, _, strokes, fuel = case
    usual, diesel = USUAL[fuel, strokes], fuel == "diesel"
    bore = round(draw.uniform(55, 160 if diesel else 110), 1)
    stroke = round(bore * draw.uniform(0.8, 1.3), 1)
    speed = round(draw.uniform(0.7, 1.3) * usual.piston_speed * 30000 / stroke)
    pressure = draw.uniform(0.4, 1.6 if strokes == 4 else 1.0)
    swept = math.pi * bore**2 / 4 * stroke * cylinders
    ratio = round(stroke / 2 / draw.uniform(0.23, 0.31), 1)
    return case, {
        "power_kw": round(pressure * swept * speed / (30e6 * strokes), 1),
        "speed_rpm": speed,
        "bore_mm": bore,
        "stroke_mm": stroke,
        **draw.choice([{"rod_mm": ratio}, {"lambda_": round(stroke / 2 / ratio, 3)}]),
        "compression": round(draw.uniform(*((14, 21) if diesel else (7.5, 11))), 1),
        "efficiency": draw.choice([None, 0.75, 0.8, 0.88]),
    }


# One of each kind, or twenty parts with some of each.
# All two hundred with --all; sixty hold every layout, strokes and fuel five times.
TASKS = 200 if cover.ALL else 60
PARTS = [range(12)] if cover.QUICK else [range(n, n + 10) for n in range(0, TASKS, 10)]


@pytest.mark.parametrize(
    "numbers", cover.sparse(PARTS), ids=lambda numbers: f"from {numbers.start}"
)
def test_a_drawn_task_has_its_power_and_passes(numbers: range) -> None:
    for number in numbers:
        case, task = drawn(number)
        actual = made(case, task)
        assert told(actual) == [], (case, task)
        assert effective_kw(actual) == pytest.approx(task["power_kw"], rel=1e-3), (case, task)
        section = actual.model.geometry
        for key in ("bore_mm", "stroke_mm", "lambda_"):
            if task.get(key) is not None:
                assert getattr(section, key) == task[key]
        assert section.compression_ratio == task["compression"]
        assert actual.model.regime.speed_rpm == task["speed_rpm"]


def test_the_tasks_are_of_every_kind() -> None:
    cases = [drawn(number)[0] for number in range(200)]
    assert {case[1:] for case in cases} == {case[1:] for case in ALL}
    assert {case[0] for case in cases} == set(range(1, 13))


def of_sample(name: str) -> tuple[tuple[int, str, int, str], dict[str, Any], list[float]]:
    """A sample's data as a task without a power, and the powers it has: computed and stated."""
    model = load_toml(samples_dir() / f"{name}.toml").model
    engine, _ = engine_and_cycle(model)
    geometry, efficiency = engine.geometry, round(engine.mechanical_efficiency, 4)
    speed = float(model.regime.speed_rpm)
    task = {
        "speed_rpm": speed,
        "bore_mm": round(geometry.bore * 1000, 3),
        "stroke_mm": round(geometry.crank_radius * 2000, 3),
        "rod_mm": round(geometry.rod_length * 1000, 3),
        "compression": geometry.compression_ratio,
        "efficiency": efficiency,
    }
    powers = [float(solved(model).scalars["M_e"]) * speed * math.pi / 30 / 1000]
    if model.regime.indicated_power_kw is not None:
        powers.append(float(model.regime.indicated_power_kw) * efficiency)
    old = model.engine
    return (old.cylinders, old.layout, old.strokes, kind_of(model)), task, powers


@pytest.mark.parametrize(
    "path", cover.sparse(sorted(samples_dir().glob("*.toml"))), ids=lambda path: path.stem
)
def test_every_sample_given_as_a_task(path: Path) -> None:
    case, task, powers = of_sample(path.stem)
    for power in powers:
        actual = made(case, {**task, "power_kw": round(power, 2)})
        assert told(actual) == []
        assert effective_kw(actual) == pytest.approx(power, rel=1e-3)


@pytest.mark.parametrize("key", ["bore_mm", "stroke_mm", "compression", "lambda_", "rod_mm", None])
@pytest.mark.parametrize("power", [None, 55.0])
@pytest.mark.parametrize("speed", [None, 2200.0])
def test_any_part_of_a_task_will_do(key: str | None, power: float | None, speed: float) -> None:
    given = {"bore_mm": 110.0, "stroke_mm": 125.0, "compression": 16.0, "lambda_": 0.27,
             "rod_mm": 240.0}  # fmt: skip
    task = {"power_kw": power, "speed_rpm": speed} | ({key: given[key]} if key else {})
    actual = made((4, "inline", 4, "diesel"), task)
    assert told(actual) == []
    if power is not None:
        assert effective_kw(actual) == pytest.approx(power, rel=1e-3)
        assert actual.model.regime.indicated_power_kw == pytest.approx(power / 0.78, abs=1e-3)
    else:
        assert actual.model.regime.indicated_power_kw is None


@pytest.mark.parametrize(
    ("power", "words"), [(300.0, "не больше 209 кВт"), (4.0, "не меньше 6,81 кВт")]
)
def test_a_power_out_of_reach_is_told_with_the_one_in_reach(power: float, words: str) -> None:
    task = {"power_kw": power, "speed_rpm": 2200.0, "bore_mm": 110.0, "stroke_mm": 125.0}
    with pytest.raises(InputError) as refused:
        made((4, "inline", 4, "diesel"), task)
    (line,) = refused.value.lines()
    assert line.startswith(f"--power: задано {power:g} кВт, а при этих размерах и частоте")
    assert words in line


@pytest.mark.parametrize("power", [300.0, 4.0])
def test_the_power_told_to_be_in_reach_is(power: float) -> None:
    task = {"power_kw": power, "speed_rpm": 2200.0, "bore_mm": 110.0, "stroke_mm": 125.0}
    with pytest.raises(InputError) as refused:
        made((4, "inline", 4, "diesel"), task)
    words = refused.value.lines()[0].split(" кВт;")[0].split()[-1]
    inside = float(words.replace(",", ".")) * (0.99 if power == 300 else 1.01)
    assert effective_kw(made((4, "inline", 4, "diesel"), task | {"power_kw": inside})) > 0


# --- the command ---
def run(*arguments: object) -> tuple[int, str]:
    done = CliRunner().invoke(main, [str(argument) for argument in arguments])
    return done.exit_code, done.output


SHEET = ("--cylinders", 4, "--fuel", "diesel", "--power", "55,0", "--speed", 2200, "--bore", 110,
         "--stroke", 125, "--lambda", "0,27", "--compression", 16)  # fmt: skip


def test_a_task_sheet_of_the_command(tmp_path: Path) -> None:
    file = tmp_path / "own.toml"
    assert run("new", *SHEET, "-o", file)[0] == 0
    text = file.read_text(encoding="utf-8")
    assert "по заданию: 55 кВт при 2200 мин⁻¹" in text
    assert "indicated_power_kw = 70.513" in text
    for line in ("bore_mm = 110 #", "stroke_mm = 125 #", "lambda = 0.27 #"):
        assert f"\n{line}" in text
    code, output = run("check", file)
    assert code == 0
    assert "Внимание" not in output


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("bore_mm = 110", "bore_mm = 120"),
        ("stroke_mm = 125", "stroke_mm = 110"),
        ("compression_ratio = 16", "compression_ratio = 18"),
        ("speed_rpm = 2200", "speed_rpm = 1800"),
        ("mechanical_efficiency = 0.78", "mechanical_efficiency = 0.78\nindicated_power_kw = 90"),
    ],
)
def test_a_power_lost_by_writing_over_is_told(tmp_path: Path, old: str, new: str) -> None:
    file = tmp_path / "own.toml"
    run("new", *SHEET, "-o", file)
    text = file.read_text(encoding="utf-8")
    assert old in text
    if "\n" in new:  # the key that the file has already gives way
        key = new.split("\n")[1].split(" =")[0]
        text = "\n".join(line for line in text.split("\n") if not line.startswith(f"{key} ="))
    file.write_text(text.replace(old, new, 1), encoding="utf-8")
    code, output = run("check", file)
    assert code == 1, output
    (line,) = (line for line in output.splitlines() if "indicated_power_kw" in line)
    assert line.startswith("Внимание: regime.indicated_power_kw: задано N_i = ")
    code, output = run("check", "--json", file)
    assert code == 1
    assert '"where": "regime.indicated_power_kw"' in output


def test_asked_55_got_65(tmp_path: Path) -> None:
    file = tmp_path / "own.toml"
    run("new", *SHEET, "-o", file)
    text = file.read_text(encoding="utf-8").replace("bore_mm = 110", "bore_mm = 120")
    file.write_text(text, encoding="utf-8")
    actual = effective_kw(load_toml(file))
    assert actual == pytest.approx(55 * (120 / 110) ** 2, rel=1e-3)
    assert "(эффективная 55 кВт), а диаграмма с этими размерами даёт 83,92 кВт (65,45 кВт)" in (
        run("check", file)[1].replace("\xa0", " ")
    )


def test_a_power_that_is_accepted_is_not_told() -> None:
    assert power_problems(load_toml(samples_dir() / "gots-diesel.toml").model) == ()


@pytest.mark.parametrize("word", ["60,5", "60.5"])
def test_a_comma_is_a_decimal_sign(word: str) -> None:
    assert (
        "60,5 кВт при 5000" in run("new", "--cylinders", 4, "--power", word, "--speed", "5000")[1]
    )


@pytest.mark.parametrize("word", ["1,234.5", "60,5,5", "60 кВт", "", ","])
def test_what_is_no_number_is_refused_as_it_was_written(word: str) -> None:
    code, output = run("new", "--cylinders", 4, "--bore", word)
    assert code == 2
    assert f"неверное значение --bore: нужно число, а задано «{word}»" in output


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--bore", 5), "--bore: получается диаметр цилиндра 5 мм; возможно от 10 до 1000 мм"),
        (("--stroke", 1), "--stroke: получается диаметр цилиндра 1,1 мм"),
        (("--rod", 10), "geometry"),
        (("--rod", 200, "--lambda", 0.3), "--rod и --lambda вместе не нужны"),
        (("--efficiency", 2), "regime.mechanical_efficiency"),
        (("--compression", 0), "--compression: значение должно быть больше нуля"),
        (("--lambda", "nan"), "--lambda: значение должно быть больше нуля"),
    ],
)
def test_a_task_that_cannot_be_is_refused(options: tuple[object, ...], words: str) -> None:
    code, output = run("new", "--cylinders", 4, *options)
    assert code == 2, output
    assert words in output
    assert "внутренняя ошибка" not in output


def test_sizes_go_with_an_own_engine_only() -> None:
    assert "--bore: ключ для своего двигателя" in run("new", "--bore", 80)[1]
    sample = samples_dir() / "d-240.toml"
    code, output = run("new", "--from", sample, "--cylinders", 6, "--bore", 80)
    assert code == 2
    assert "--bore: у варианта следует из" in output


@pytest.mark.parametrize("sample", ["gots-diesel", "d-240", "two-stroke", "yamz-238", "mwm-6"])
def test_an_alternative_has_the_power_that_was_asked_for(tmp_path: Path, sample: str) -> None:
    file = tmp_path / "alt.toml"
    source = samples_dir() / f"{sample}.toml"
    assert run("new", "--from", source, "--cylinders", 4, "--power", "60,5", "-o", file)[0] == 0
    actual = load_toml(file)
    assert effective_kw(actual) == pytest.approx(60.5, rel=2e-3)
    assert power_problems(actual.model) == ()
    assert actual.model.regime.indicated_power_kw is not None


_BOOSTED = [
    (6, "petrol", {"power_kw": 250, "speed_rpm": 5800, "bore_mm": 86, "stroke_mm": 86}),
    (12, "diesel", {"power_kw": 3600, "speed_rpm": 750, "bore_mm": 300, "stroke_mm": 380}),
    (8, "petrol", {"power_kw": 230, "speed_rpm": 5500, "bore_mm": 84, "stroke_mm": 80}),
]


@pytest.mark.parametrize(("cylinders", "kind", "task"), _BOOSTED)
def test_the_bearings_of_a_boosted_engine_are_within_the_usual_pressure(cylinders, kind, task):
    data = generate_engine(cylinders, layout="v", kind=kind, **task).data
    model = load_mapping(data, source="own.toml").model
    scalars, shaft = solved(refined(model)).scalars, model.crankshaft
    for key, reason in (("q_pin_max", "pin_peak"), ("q_pin_mean", "pin_pressure")):
        low, high = usual_span(reason, kind)
        assert low <= scalars[key] <= high
    rod = shaft.pin_length_mm / 2
    low, high = usual_span("pin_length", kind)
    assert low <= rod / shaft.pin_diameter_mm <= high
    low, high = usual_span("pin", kind)
    assert low <= shaft.pin_diameter_mm / model.geometry.bore_mm <= high
    assert all(arms.l2_mm == pytest.approx(rod / 2, abs=1e-5) for arms in shaft.arms)
