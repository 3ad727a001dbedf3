"""Recorded diagrams: files as recorders and spreadsheets write them, and what they suggest."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from kshm.mechanics.gas import mean_pressure, polytropic_exponent
from reports.inputs.checks.gas import indicated_of, volume_ratios
from reports.inputs.load import Loaded, load_toml
from reports.inputs.to_si.masses import sizes_of
from reports.shared.errors import InputError

DATA = Path(__file__).parent / "diagrams"
BAR = [
    1.2, 1.15, 1.12, 1.12, 1.13, 1.14, 1.2, 1.31, 1.63, 2.6, 5.6, 17.5, 52, 44, 17, 8.6, 5.6, 4.3,
    2.9, 1.9, 1.6, 1.45, 1.35, 1.28,
]  # fmt: skip
RIGHT = [[30.0 * i, p / 10] for i, p in enumerate([*BAR, BAR[0]])]
NAMES = 'angle_column = "CA"\npressure_column = "PCYL1"'


def loaded(folder: Path, table: str | bytes, more: str = "", unit: str = "bar") -> Loaded:
    text = (DATA / "engine.toml").read_text(encoding="utf-8")
    text = text.replace('pressure_unit = "bar"', f'pressure_unit = "{unit}"\n{more}')
    (folder / "engine.toml").write_text(text, encoding="utf-8")
    data = table if isinstance(table, bytes) else table.encode()
    (folder / "diagram.csv").write_bytes(data)
    return load_toml(folder / "engine.toml")


def kept(name: str) -> bytes:
    return (DATA / f"{name}.csv").read_bytes()


def refusal(folder: Path, table: str | bytes, more: str = "", unit: str = "bar") -> str:
    with pytest.raises(InputError) as caught:
        loaded(folder, table, more, unit)
    (line,) = caught.value.lines()  # one line for one cause
    return line


def written(separator: str = ";", comma: bool = False, head: str = "") -> str:
    rows = [f"{a:g}{separator}{p * 10:g}" for a, p in RIGHT[:-1]]
    text = "\n".join(([head] if head else []) + rows) + "\n"
    return text.replace(".", ",") if comma else text


READ = {
    "quoted decimal commas": (kept("quoted-commas"), ""),
    "a row of units under the names": (kept("names-then-units"), NAMES),
    "dashes under the names": (kept("names-then-dashes"), 'pressure_column = "p"'),
    "empty cells beside": (kept("empty-cells"), ""),
    "words beside": (kept("words-beside"), ""),
    "semicolons at the end": (kept("trailing-semicolons"), ""),
    "Windows-1251": (kept("windows-1251"), ""),
    "right": (kept("right"), ""),
    # Siblings.
    "Windows-1251 by name": (kept("windows-1251"), 'pressure_column = "Давление"'),
    "UTF-16 between tabs": (written("\t", True, "Угол\tДавление").encode("utf-16"), ""),
    "UTF-8 with its mark": (written(";", True, "Угол;Давление").encode("utf-8-sig"), ""),
    "a degree sign in Windows-1251": (written(";", True, "CA [°];p [bar]").encode("cp1251"), ""),
    "quoted between blanks": ("\n".join(f'{a:g}, "{10 * p:.2f}"' for a, p in RIGHT[:-1]), ""),
    "a dot in one column, a comma in the other": (
        "\n".join(f"{a:.1f};{10 * p:.2f}".replace(f";{10 * p:.2f}", f";{10 * p:.2f}".replace(
            ".", ",")) for a, p in RIGHT[:-1]), ""),
    "names of another case": (written(";", False, "ca;pcyl1"), NAMES),
    "Excel's word on the separator": ("sep=;\n" + written(), ""),
    "a date, a title and units": ("Проба 3;\n12.05.2024;\n" + written(head="a;p\n°;бар"), ""),
    "minus signs of print": (
        "\n".join(f"{a - 360:g};{10 * p:g}" for a, p in RIGHT[:-1]).replace("-", "−"),
        "firing_tdc_deg = 0"),
    "Windows ends of lines": (written(",").replace("\n", "\r\n"), ""),
    "ends of lines of a Macintosh": (written().replace("\n", "\r"), ""),
    "numbers of columns under the head": (written(head="Угол;Давление\n1;2"), ""),
    "numbers of columns under the units": (written(head="CA;PCYL1\n°;бар\n1;2"), NAMES),
    "numbers of three columns": (
        "a;p;T\n1;2;3\n" + "\n".join(f"{a:g};{10 * p:g};300" for a, p in RIGHT[:-1]), ""),
    "numbers of columns alone": (written(head="1;2"), ""),
    "numbers of columns from nought": (written(head="0;1"), ""),
    "LabVIEW's name below its preamble": (
        "LabVIEW Measurement\t\nX_Columns\tOne\nSamples\t24\t24\nX0\t0,0\t0,0\n***End***\t\t\n"
        + written("\t", True, "X_Value\tPcyl"),
        'angle_column = "X_Value"\npressure_column = "Pcyl"'),
    "Fortran's numbers": ("\n".join(f"{a:.0f}.  {10 * p:.4E}" for a, p in RIGHT[:-1]), ""),
}  # fmt: skip


@pytest.mark.parametrize("case", READ)
def test_a_file_as_it_is_written_is_read(case: str, tmp_path: Path) -> None:
    table, more = READ[case]
    actual = loaded(tmp_path, table, more)
    np.testing.assert_allclose(actual.model.gas.points, RIGHT, rtol=1e-12)
    assert actual.warnings == ()
    assert actual.notes == ()


TORN = "запятая стоит и между столбцами, и в дробях"
REFUSED = {
    "commas for both": (kept("commas-twice"), "", TORN),
    "comma and blank": (kept("comma-blank"), "", TORN),
    "blank, comma, blank": (kept("blank-comma-blank"), "", TORN),
    "no number under blank lines": (kept("blank-lines"), "", "строка 8: не числа («NaN»)"),
    "below nothing": (
        kept("negative"), "", "строка 1: давление 0 bar, таких строк ещё 6; нужно абсолютное"),
    # Siblings.
    "a comma in the unit hides the third column": (
        "Угол, °,Давление\n" + kept("comma-blank").decode().strip(), "", TORN),
    "commas in both columns": (
        "\n".join(f"{a:.1f},{10 * p:.2f}".replace(".", ",") for a, p in RIGHT), "", TORN),
    "named columns": (
        kept("commas-twice"), 'angle_column = "Угол"\npressure_column = "Давление"', TORN),
    "first row is no number": ("Угол;Давление\n0;—\n" + written(), "", "строка 2: не числа («—»)"),
    "an empty cell": (
        written().replace("90;1.12", "90;"), "", "строка 4: не числа"),
    "both signs in a column": (
        written(comma=True).replace("5,6\n", "5.6\n"), "", "строка 11: в столбце стоят и точка"),
    "two columns of a name": (
        written(head="CA;PCYL1;PCYL1"),
        NAMES, "столбцов «PCYL1» несколько"),
    "too high": (
        written().replace("52", "5200"), "", "строка 13: давление 5200 bar; допустимо до 60 МПа"),
    "two cycles": (
        "\n".join(f"{a:g};{10 * p:g}" for n in range(2) for a, p in
                  ([x + 720 * n, y] for x, y in RIGHT[:-1])),
        "", "углы занимают 1410°, больше цикла 720°; оставьте один цикл или задайте average"),
    "a cycle and a half": (
        "\n".join(f"{30 * i};{BAR[i % 24]}" for i in range(36)), "average_cycles = true",
        "углы занимают 1,46 цикла; оставьте целое число циклов"),
    "a degree sign": (
        "\n".join(f"{a - 360:.1f}°;{10 * p:g}" for a, p in RIGHT[:-1]), "",
        "строка 1: не числа («-360.0°»); уберите из ячеек «°»"),
    "units in the cells": (
        "\n".join(f"{a:g};{10 * p:g} бар" for a, p in RIGHT[:-1]), "",
        "строка 1: не числа («1.2 бар»); уберите из ячеек «бар»"),
    "blanks between thousands": (
        written().replace("17.5", "1 017,5"), "", "(«1 017,5»); уберите разделители тысяч"),
    "commas between thousands": (
        written().replace("17.5", "1,017.5"), "", "(«1,017.5»); уберите разделители тысяч"),
    "thousands that may be decimals": (
        "\n".join(f"{30 * i};{100 * p:,.0f}" for i, p in enumerate(BAR)), "",
        "«1,750» читается двояко; уберите разделители тысяч"),
    "several columns without averaging": (
        written(), "pressure_column = [1, 2]", "задайте average_cycles = true или один столбец"),
    "a book": (b"PK\x03\x04rest", "", "это книга Excel или архив"),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_what_can_be_read_in_two_ways_or_in_none_is_refused(case: str, tmp_path: Path) -> None:
    table, more, message = REFUSED[case]
    assert message in refusal(tmp_path, table, more)


@pytest.mark.parametrize(
    ("unit", "mpa"),
    [("бар", 0.1), ("Bar", 0.1), ("BAR", 0.1), ("MPa", 1.0), ("МПа", 1.0), ("кПа", 0.001),
     ("кгс/см²", 0.0980665), ("кгс/см2", 0.0980665), ("ат", 0.0980665), ("атм", 0.101325),
     ("psi", 0.006894757), ("Pa", 1e-6)],
)  # fmt: skip
def test_units_in_any_case_and_in_russian(unit: str, mpa: float, tmp_path: Path) -> None:
    table = "\n".join(f"{a:g};{p / mpa:.9g}" for a, p in RIGHT[:-1])
    np.testing.assert_allclose(loaded(tmp_path, table, unit=unit).model.gas.points, RIGHT, 1e-7)


def test_an_unknown_unit_is_named(tmp_path: Path) -> None:
    assert "неизвестная единица давления «сажень»" in refusal(tmp_path, written(), unit="сажень")


def trace(step: float, cycles: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Angles and pressures [bar] of a smooth diagram, cycle after cycle a little different."""
    angles = np.arange(0, 720 * cycles, step)
    ratio = volume_ratios(angles, 44 / 141, 16.4)
    pumped = np.where((angles % 720 < 180) | (angles % 720 > 560), 1.1, 0)
    closed = 1.1 * (16.4 / ratio) ** 1.35
    burnt = 1 + 1.6 / (1 + np.exp(-(angles % 720 - 368) / 5))
    return angles, np.where(pumped > 0, pumped, closed * burnt) + 0.1 * (angles // 720)


def work(angles: np.ndarray, p: np.ndarray) -> float:
    return mean_pressure(p, volume_ratios(angles, 44 / 141, 16.4), 16.4)


@pytest.mark.parametrize("step", [0.1, 0.2, 0.25, 0.3])
def test_a_fine_trace_is_thinned_by_means_and_does_the_same_work(
    step: float, tmp_path: Path
) -> None:
    angles, p = trace(step)
    item = loaded(tmp_path, "\n".join(f"{a:.2f};{x:.4f}" for a, x in zip(angles, p, strict=True)))
    whole = work(np.append(angles, 720), np.append(p, p[0]))
    assert work(*np.array(item.model.gas.points).T) == pytest.approx(whole / 10, rel=1e-3)
    assert len(item.model.gas.points) <= 1442  # the seam too
    (note,) = item.notes
    assert note == f"diagram.csv: {len(p)} строк усреднены до точек через 0,5°"


@pytest.mark.parametrize("restarts", [False, True])
@pytest.mark.parametrize("step", [0.5, 1.0, 2.0])
def test_several_cycles_are_averaged_when_asked(
    step: float, restarts: bool, tmp_path: Path
) -> None:
    angles, p = trace(step, 3)
    shown = angles % 720 if restarts else angles
    table = "\n".join(f"{a:g};{x:.6f}" for a, x in zip(shown, p, strict=True))
    assert "больше цикла 720°" in refusal(tmp_path, table)
    actual = loaded(tmp_path, table, "average_cycles = true")
    expected = p.reshape(3, -1).mean(axis=0) / 10
    np.testing.assert_allclose(np.array(actual.model.gas.points)[:-1, 1], expected, atol=2e-7)
    assert actual.notes == ("diagram.csv: давления 3 циклов усреднены по углу",)


A, P = trace(0.5)
CYCLE_S = 0.12  # of the engine of these tests, 1000 rpm
UNLIKE = {
    "two turns": (A % 360, P, "", "углы дважды проходят 0…360°; цикл занимает 720°: прибавьте"),
    "two turns around TDC": ((A + 180) % 360 - 180, P, "", "углы дважды проходят −180…180°"),
    "two turns to be averaged": (A % 360, P, "average_cycles = true", "углы дважды проходят"),
    "radians": (np.radians(A), P, "", "похоже на радианы; нужны градусы: умножьте на 57,29578"),
    "radians around TDC": (np.radians(A - 360), P, "firing_tdc_deg = 0", "похоже на радианы"),
    "radians of three cycles": (
        np.radians(trace(0.5, 3)[0]), trace(0.5, 3)[1], "average_cycles = true", "радианы"),
    "seconds": (A / 720 * CYCLE_S, P, "", "похоже на секунды; нужны градусы: угол = 6 · n · t"),
    "seconds of a part": (A[:900] / 720 * CYCLE_S, P[:900], "", "похоже на секунды"),
    "milliseconds": (A / 720 * CYCLE_S * 1e3, P, "", "похоже на миллисекунды"),
    "microseconds": (A / 720 * CYCLE_S * 1e6, P, "average_cycles = true", "на микросекунды"),
    "turns": (A / 360, P, "", "похоже на обороты; нужны градусы: умножьте на 360"),
    "samples": (np.arange(1440), P, "", "от 0 до 1439 через 1: похоже на номера отсчётов"),
    "samples to be averaged": (
        np.arange(1, 1441), P, "average_cycles = true", "похоже на номера отсчётов"),
    "samples of a recorder that begins anew": (
        np.tile(np.arange(1440), 3), np.tile(P, 3), "average_cycles = true", "номера отсчётов"),
    "samples of two degrees": (np.arange(360), P[::4], "", "номера отсчётов или один оборот"),
}  # fmt: skip


def rows_of(angles: np.ndarray, *columns: np.ndarray) -> str:
    cells = zip(angles, *columns, strict=True)
    return "\n".join(f"{a:.9g};" + ";".join(f"{x:.4f}" for x in p) for a, *p in cells)


@pytest.mark.parametrize("case", UNLIKE)
def test_angles_that_are_none_are_named(case: str, tmp_path: Path) -> None:
    angles, p, more, message = UNLIKE[case]
    line = refusal(tmp_path, rows_of(angles, p), more)
    assert message in line
    assert "average_cycles" not in line


def test_a_unit_over_the_angles_is_believed(tmp_path: Path) -> None:
    for head, unit in (("Time [ms]", "время"), ("t, с", "время"), ("CA, рад", "радианы")):
        line = refusal(tmp_path, f"{head};p\n" + rows_of(A, P))
        assert f"в столбце угла {unit} («{head}»)" in line


def noise(deviation: float) -> np.ndarray:
    return np.random.default_rng(1).normal(0, deviation, P.size)


LOW = {
    "noise": (P + noise(0.4), "похоже на шум датчика: запишите несколько циклов"),
    "noise beyond a gauge": (P + noise(1.0), "похоже на шум датчика"),
    "gauge": (P - 1.15, "похоже, в файле избыточное"),
    "gauge with noise": (P - 1.1 + noise(0.1), "похоже, в файле избыточное"),
    "zero of the sensor": (P - 5, "ниже −1,013 бар не бывает ни абсолютного, ни избыточного"),
}


@pytest.mark.parametrize("case", LOW)
def test_pressures_below_nothing_are_told_with_their_cause(case: str, tmp_path: Path) -> None:
    p, message = LOW[case]
    assert message in refusal(tmp_path, rows_of(A, p))


@pytest.mark.parametrize(
    ("columns", "more"),
    [(0, ""), (1, "pressure_column = [2, 3, 4, 5]"), (1, 'pressure_column = ["a", "b", "c", "d"]')],
)
def test_a_column_per_cycle_is_averaged(columns: int, more: str, tmp_path: Path) -> None:
    cycles = [P + shift for shift in (-0.2, -0.1, 0.1, 0.2)]
    others = [np.full(P.size, 300.0)] * columns
    table = "CA;a;b;c;d;T\n"[: 11 + 2 * columns].rstrip(";\n") + "\n"
    table += rows_of(A, *cycles, *others)
    actual = loaded(tmp_path, table, "average_cycles = true\n" + more)
    np.testing.assert_allclose(np.array(actual.model.gas.points)[:-1, 1], P / 10, atol=1e-5)
    assert actual.notes == ("diagram.csv: давления столбцов усреднены: 4",)
    if columns:
        line = refusal(tmp_path, table, "average_cycles = true")
        assert "столбцов циклов подряд 4, а за ними другие числа; назовите столбцы" in line


def test_a_misfire_is_a_cycle(tmp_path: Path) -> None:
    angles, p = trace(1.0, 2)
    p[720:] = np.minimum(
        p[720:], 1.1 * (16.4 / volume_ratios(angles[720:], 44 / 141, 16.4)) ** 1.35
    )
    actual = loaded(tmp_path, rows_of(angles, p), "average_cycles = true")
    assert "давления 2 циклов усреднены" in actual.notes[0]


def test_a_lone_gap_is_told_and_steps_that_grow_are_not(tmp_path: Path) -> None:
    angles, p = trace(1.0)
    rows = [f"{a:g};{x:.4f}" for a, x in zip(angles, p, strict=True)]
    actual = loaded(tmp_path, "\n".join(rows[:300] + rows[330:]))
    assert actual.notes == ("diagram.csv: между 299 и 330° точек нет",)
    uneven = rows[:300:10] + rows[300:420] + rows[420::10]
    assert loaded(tmp_path, "\n".join(uneven)).notes == ()


SUGGESTED = {
    "TDC of gas exchange": (
        kept("zero-at-firing"), "",
        "наибольшее давление стоит при 0°, работа цикла p_i = 0,912 МПа; "
        "похоже, за ВМТ сгорания принята ВМТ газообмена"),
    "zero at BDC": (
        written(), "firing_tdc_deg = 180",
        "наибольшее давление стоит при 540°, работа цикла p_i = −0,722 МПа; "
        "похоже, ВМТ сдвинута примерно на 180°"),
    "a quarter early": (
        kept("right"), "firing_tdc_deg = 450",
        "наибольшее давление стоит при 270°, работа цикла p_i = −2,71 МПа; "
        "похоже, ВМТ сдвинута примерно на 90°"),
    "a quarter late": (kept("right"), "firing_tdc_deg = 270", "похоже, ВМТ сдвинута примерно"),
    "gauge": (
        kept("gauge"), "", "похоже, что давление избыточное: показатель сжатия 1,58, на впуске"),
    "TDC a point late": (
        "\n".join(f"{a:g};{10 * p:g}" for a, p in RIGHT[:-1]), "firing_tdc_deg = 390",
        "наибольшее давление стоит при 330°, работа цикла p_i = −0,738 МПа"),
}  # fmt: skip


@pytest.mark.parametrize("case", SUGGESTED)
def test_a_wrong_diagram_is_told_with_what_it_suggests(case: str, tmp_path: Path) -> None:
    table, more, message = SUGGESTED[case]
    (line,) = (problem.line() for problem in loaded(tmp_path, table, more).warnings)
    assert line.startswith("engine.toml: gas.points: ")
    assert message in line


@pytest.mark.parametrize(
    ("turn", "words"), [(10, "ВМТ принята раньше"), (-10, "ВМТ принята позже"), (3, ""), (-3, "")]
)
def test_ten_degrees_are_told_and_three_are_not(turn: int, words: str, tmp_path: Path) -> None:
    angles, p = trace(1.0)
    table = "\n".join(f"{a:g};{x:.4f}" for a, x in zip(angles, p, strict=True))
    collected = loaded(tmp_path, table, f"firing_tdc_deg = {360 - turn}")
    lines = [problem.line() for problem in collected.warnings]
    assert [words in line for line in lines] == ([True] if words else [])


def test_points_of_the_input_are_judged_as_those_of_a_file(tmp_path: Path) -> None:
    text = (DATA / "engine.toml").read_text(encoding="utf-8")
    points = [[a, round(p - 0.04, 6)] for a, p in RIGHT]
    gas = f'source = "table"\npoints = {points}\n'
    old = 'source = "file"\nfile = "diagram.csv"\npressure_unit = "bar"\n'
    assert old in text
    file = tmp_path / "engine.toml"
    file.write_text(text.replace(old, gas), encoding="utf-8")
    (warning,) = load_toml(file).warnings
    assert "похоже, что давление избыточное: показатель сжатия 1,58" in warning.line()


def test_exponents_of_known_polytropes_are_found() -> None:
    ratio = np.linspace(2, 9, 40)
    assert polytropic_exponent(3.0 * ratio**-1.31, ratio) == pytest.approx(1.31, rel=1e-12)
    with pytest.raises(ValueError, match="two points"):
        polytropic_exponent(np.ones(1), np.ones(1))


def test_figures_of_the_right_diagram(tmp_path: Path) -> None:
    model = loaded(tmp_path, kept("right")).model
    actual = indicated_of(model, model.gas, sizes_of(model))
    assert actual.peak_at == 360
    assert actual.compression == pytest.approx(1.41, abs=5e-3)
    assert actual.intake == pytest.approx(0.1132, abs=1e-6)
