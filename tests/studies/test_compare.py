"""Engines side by side: numbers against single solutions, live formulas, refusals, sentences."""

from __future__ import annotations

import io
import re
import zipfile
from dataclasses import replace

import openpyxl
import pytest
from click.testing import CliRunner
from lxml import etree

from kshm import solve
from kshm.nomenclature.quantity import quantity
from reports.cli import main
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping, load_text, load_toml
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.resources import samples_dir
from reports.shared.russian import capital
from reports.studies.comparison import (
    Row,
    charts,
    conclusions,
    differences,
    labels,
    read_engines,
    results,
    split_rows,
    spread,
)
from reports.studies.comparison_page import comparison_page, results_block
from reports.studies.workbooks import CURVES, FIGURES, INPUTS, RESULTS, book_bytes
from tests.conftest import sample
from tests.document.bare_pages import plain
from tests.referee.compare import differences_from_caches, errors_in
from tests.workbook.lint import chart_problems
from tools.referees.by_formualizer import Formualizer

THREE = ("d-240", "yamz-236", "vw-1600")
SIX = (*THREE, "two-stroke", "ecoboost-10", "cycle-petrol")


def sources(names):
    return [samples_dir() / f"{name}.toml" for name in names]


def engines(names=THREE):
    files = sources(names)
    return read_engines(files, [load_toml(file).model for file in files])


def run(*args):
    done = CliRunner().invoke(main, ["compare", *[str(arg) for arg in args]])
    return done.exit_code, done.output


def test_an_efficiency_that_the_cycle_finds_is_no_datum():
    """Friction A + B·c_m: the default of 1 is taken nowhere, and the report leaves it out too."""
    actual = engines(("d-240", "cycle-petrol"))
    (shown,) = (d for d in differences(actual) if d.title == "Механический КПД")
    assert shown.values[1] is None


def test_values_are_those_of_each_engine_alone():
    rows = {row.key: row for row in results(engines())}
    for number, file in enumerate(sources(THREE)):
        scalars = solve(*engine_and_cycle(load_toml(file).model)).scalars
        for key in ("M_mean", "Rpin_max_kN", "m_j", "V_engine", "I_flywheel"):
            assert rows[key].values[number] == scalars[key]
        mains = [value for key, value in scalars.items()
                 if key.startswith("Rmain") and key.endswith("_max_kN")]  # fmt: skip
        assert rows[r"Rmain\d+_max_kN"].values[number] == max(mains)


def test_of_unequal_crankpins_the_most_loaded_is_compared():
    raw = to_mapping(load_toml(samples_dir() / "yamz-238.toml").model)
    raw["crankshaft"] |= {
        "firing_order": "1-2-6-3-7-5-4-8", "throw_angles_deg": [0, 270, 90, 180],
        "firing_offsets_deg": [0, 90, 270, 540, 450, 180, 360, 630],
    }  # fmt: skip
    light = load_mapping(raw, source="light.toml").model
    both = read_engines(sources(("yamz-238", "yamz-236")), [light, sample("yamz-236")])
    scalars, columns = both[0].solution.scalars, both[0].solution.columns
    assert scalars["Rpin_max"] < scalars["Rpin2_max"]
    rows = {row.key: row for row in results(both)}
    assert rows["Rpin_max_kN"].values[0] == max(scalars[f"Rpin{n}_max_kN"] for n in ("", 2, 3, 4))
    curve = next(chart for chart in charts(both) if chart.key == "crankpin.Rpin_MPa").curves[0]
    assert curve[2] == [float(v) for v in columns["crankpin_2"]["Rpin_MPa"]]


def test_the_workbook_recalculated_by_formualizer():
    book = book_bytes(engines())
    (result,) = Formualizer().recalculate([book])
    assert errors_in(result) == []
    assert differences_from_caches(book, result) == []


@pytest.mark.libreoffice
def test_the_workbook_recalculated_by_libreoffice(libreoffice):
    book = book_bytes(engines())
    (result,) = libreoffice.recalculate([book])
    assert errors_in(result) == []
    assert differences_from_caches(book, result) == []


def test_differences_are_live_and_charts_hold_every_engine(tmp_path):
    book = book_bytes(engines())
    sheets = openpyxl.load_workbook(io.BytesIO(book))
    assert sheets.sheetnames == [INPUTS, RESULTS, FIGURES, CURVES]
    rows = {row[0].value: row for row in sheets[RESULTS].iter_rows(min_row=4)}
    torque = rows[capital(quantity("M_mean").title)]
    assert torque[6].value == f"=(E{torque[0].row}/D{torque[0].row}-1)*100"
    wanted = len(charts(engines()))
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        drawn = [name for name in archive.namelist() if name.startswith("xl/charts/chart")]
        for name in drawn:
            root = etree.fromstring(archive.read(name))
            assert len(root.findall(".//{*}ser")) == 3
            assert chart_problems(root) == []
    assert len(drawn) == wanted == 5


def test_what_differs_comes_first_and_what_is_alike_does_not():
    text = (samples_dir() / "d-240.toml").read_text(encoding="utf-8")
    files = [samples_dir() / "d-240.toml", samples_dir() / "d-260.toml"]
    other = load_text(text.replace("bore_mm = 110.0", "bore_mm = 105.0"), source="b.toml").model
    actual = differences(read_engines(files, [load_toml(files[0]).model, other]))
    assert [(row.symbol, row.unit, row.values) for row in actual] == [("D", "мм", (110.0, 105.0))]


def test_names_of_files_are_told_apart(tmp_path):
    files = [tmp_path / "a" / "x.toml", tmp_path / "b" / "x.toml", tmp_path / "y.toml"]
    assert labels(files) == ["x (1)", "x (2)", "y"]


@pytest.mark.parametrize("suffix", ["xlsx", "html", "pdf"])
def test_a_file_of_each_kind(tmp_path, suffix):
    target = tmp_path / f"c.{suffix}"
    code, output = run(*sources(THREE), "-o", target)
    assert code == 0, output
    assert output == f"{target}: двигателей 3\n"
    assert target.stat().st_size > 20_000
    assert [path.name for path in tmp_path.iterdir()] == [target.name]


def test_six_engines_of_every_kind_with_different_cycles_and_tables(tmp_path):
    target = tmp_path / "six.html"
    assert run(*sources(SIX), "-o", target)[0] == 0
    page = target.read_text(encoding="utf-8")
    assert page.count("<figure ") == 5
    for name in SIX:
        assert name in page
    assert book_bytes(engines(SIX))


def test_an_edited_workbook_is_compared_with_its_file(tmp_path):
    sample = samples_dir() / "two-stroke.toml"
    assert CliRunner().invoke(main, ["build", str(sample), "--only", "xlsx", "-o", str(tmp_path)])
    book = tmp_path / "two-stroke.xlsx"
    code, output = run(sample, book, "-o", tmp_path / "c.html")
    assert code == 0, output
    assert "Различий нет" in (tmp_path / "c.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("names", "target", "message"),
    [
        (("d-240",), "c.xlsx", "compare: файлов 1; сравниваются от 2 до 6 двигателей"),
        ((*SIX, "d-260"), "c.xlsx", "compare: файлов 7; сравниваются от 2 до 6 двигателей"),
        (("d-240", "d-260", "d-240"), "c.xlsx",
         "{d-240}: файл назван дважды; уберите повтор или сделайте копию с правками"),
        (("d-240", "d-260"), "c.docx",
         "c.docx: нужно окончание .xlsx, .pdf, .html, .csv, .json; укажите имя ключом -o"),
        (("d-240", "d-260"), "c",
         "c: нужно окончание .xlsx, .pdf, .html, .csv, .json; укажите имя ключом -o"),
    ],
)  # fmt: skip
def test_what_cannot_be_compared_is_refused_in_a_line(tmp_path, names, target, message):
    code, output = run(*sources(names), "-o", tmp_path / target)
    assert code == 2
    known = dict(zip(names, map(str, sources(names)), strict=True))
    for name, path in known.items():
        message = message.replace(f"{{{name}}}", path)
    assert output.splitlines() == [message]
    assert list(tmp_path.iterdir()) == []


def test_a_result_over_an_input_is_refused(tmp_path):
    book = tmp_path / "a.xlsx"
    book.write_bytes(b"data")
    code, output = run(samples_dir() / "d-240.toml", book, "-o", book)
    assert code == 2
    what = "результат записался бы поверх исходного файла; укажите другое имя ключом -o"
    assert output.splitlines() == [f"{book}: {what}"]
    assert book.read_bytes() == b"data"


def test_forces_that_cancel_are_nought_and_no_base_for_a_difference():
    rows = {row.key: row for row in results(engines())}
    cancelled, torque = rows["F1_before_max"], rows["M_mean"]
    assert cancelled.values[0] == 0
    assert cancelled.change(1) is None
    assert torque.change(1) == (torque.values[1] / torque.values[0] - 1) * 100


def row(key, *values):
    return Row("", key, "", "", quantity("M_e" if "\\" in key else key), values)


@pytest.mark.parametrize(
    ("rows", "sentence"),
    [
        ([row("V_engine", 4.0, 4.02)], "Рабочий объём у всех одинаков: 4,00 л."),
        ([row("V_engine", 4.0, 4.2)],
         "Рабочие объёмы разные: от 4,00 л (А) до 4,20 л (Б); силы и моменты сравниваются с этой "
         "оговоркой."),
        ([row("c_m", 10.0, 12.5)],
         "Наибольшая средняя скорость поршня — Б: 12,50 м/с, на 25,0 % больше, чем у А."),
        ([row("c_m", 12.5, 10.0)],
         "Наибольшая средняя скорость поршня — А: 12,50 м/с, на 25,0 % больше, чем у Б."),
        ([row("c_m", 10.0, 25.0)],
         "Наибольшая средняя скорость поршня — Б: 25,00 м/с, в 2,5 раза больше, чем у А."),
        ([row("c_m", 12.5, 12.45)],
         "Одинаковы с точностью 1 %: средняя скорость поршня, 12,50 м/с."),
        ([row("M_max", 300.0, 200.0), row("M_min", -100.0, 0.0), row("M_mean", 100.0, 100.0)],
         "Равномернее всех крутящий момент Б: размах к среднему 2,00 против 4,00 у А."),
        ([row("F1_before_max", 0.0, 3.0)],
         "Уравновешены силы инерции 1-го порядка: А; у остальных — нет."),
        ([row("F1_before_max", 1e-12, 0.0)],
         "У всех силы инерции 1-го порядка уравновешены самим расположением колен."),
        ([row("c_m", 0.002, 25.0)],
         "Наибольшая средняя скорость поршня — Б: 25,00 м/с, в 12 500 раз больше, чем у А."),
        ([row("V_engine", 0.0363, 40.0)],
         "Рабочие объёмы разные: от 0,0363 л (А) до 40,00 л (Б); силы и моменты сравниваются с "
         "этой оговоркой."),
        ([row("V_engine", 4998.73, 0.030869)],
         "Рабочие объёмы разные: от 0,03087 л (Б) до 4999 л (А); силы и моменты сравниваются с "
         "этой оговоркой."),
        ([row("F1_before_max", 0.04, 0.04), row("Rpin_max_kN", 1e2, 2.0)],
         "Уравновешены силы инерции 1-го порядка: А; у остальных — нет."),
        ([row("F1_before_max", 2.0, 3.0)],
         "Ни у одного двигателя силы инерции 1-го порядка не уравновешены."),
        ([row("L1_before_max", 2.0, 3.0)],
         "Ни у одного двигателя моменты сил инерции 1-го порядка не уравновешены."),
    ],
)  # fmt: skip
def test_a_conclusion_follows_from_the_values(rows, sentence):
    *_, actual = conclusions(("А", "Б"), rows)
    assert actual.replace("\u00a0", " ") == sentence
    # No number stands at the end of a line with its unit, percent or "times" on the next.
    assert not re.search(r"\d (%|раза|м/с)", actual)


def test_each_engine_has_its_own_decimals_and_no_change_is_told_in_millions_of_per_cent():
    moment = Row("", "M_max", "М", "", quantity("M_max"), (17.26, 881857.0, 16.0), (2, -3, 2))
    (line,) = results_block(("А", "Б", "В"), [moment]).rows
    texts = [str(cell).replace("\u00a0", " ") for cell in line[1:]]
    assert texts == ["17,26", "881 857<br>(× 51 100)", "16,00<br>(−7,3 %)"]


def test_nothing_is_concluded_where_an_engine_has_no_value():
    assert conclusions(("А", "Б"), [row("M_e", 100.0, None), row("c_m", None, 3.0)]) == ()
    assert spread([0.0, 0.0]) == 0
    assert spread([-2.0, 2.0]) == 2


def test_the_page_says_where_its_numbers_come_from():
    page = comparison_page(engines(), media="screen")
    for words in ("Чем отличаются исходные данные", "Выводы", "файл d-240.toml", "(+"):
        assert words in page
    ends = re.findall(r"файл [^<]*\.toml(.)</li>", page.replace("\u00a0", " "))
    assert set(ends[:-1]) <= {";"} and ends[-1] == "."


@pytest.mark.parametrize(
    ("base", "value", "shown"),
    [
        (0.4, 0.0001, "(× 0,00025)"),  # not −100,0 %: something is left
        (0.4, 0.0, "(−100,0 %)"),
        (0.4, 0.0000007, "(−100,0 %)"),  # and here nothing that anyone would see
        (0.4, 0.0004, "(−99,9 %)"),
        (-131.0, 2.0, ""),  # of the other sign
        (131.0, -2.0, ""),
        (-131.0, -26.2, "(−80,0 %)"),
        (131.0, 131.0, ""),  # not +0,0 %
        (131.0, 130.99, ""),
    ],
)
def test_a_difference_says_what_is_left(base, value, shown):
    block = results_block(("А", "Б"), [row("M_e", base, value)])
    _, _, rest = str(block.rows[0][2]).partition("<br>")
    assert rest.replace("\xa0", " ") == shown


@pytest.mark.parametrize(("percent", "look"), [(-99.97, "0.0###"), (-99.9, "0.0"), (-26.0, "0.0")])
def test_the_book_says_what_is_left_by_a_plain_format(monkeypatch, percent, look):
    """Under a condition some programs leave the minus out."""
    monkeypatch.setattr(Row, "change", lambda self, number: percent)
    sheet = openpyxl.load_workbook(io.BytesIO(book_bytes(engines(THREE[:2]))))[RESULTS]
    texts = (cell for cells in sheet.iter_rows() for cell in cells if isinstance(cell.value, str))
    assert {cell.number_format for cell in texts if cell.value.endswith("-1)*100")} == {look}


def test_data_of_a_regime_are_said_to_be_of_it():
    """A person reads which regime a speed belongs to, and a choice in words."""
    actual = differences(engines(("d-240", "gots-regimes")))
    titles = [difference.title for difference in actual]
    assert len(titles) == len(set(titles))
    assert "Режим 2: частота вращения" in titles
    assert "Газы режима 3: давление впуска" in titles
    words = {value for each in actual for value in each.values if isinstance(value, str)}
    assert "polytropic" not in words
    (speed,) = (d for d in actual if d.title == "Режим 2: частота вращения")
    assert speed.values == (None, 2400)


def test_what_one_engine_alone_has_is_named_in_a_sentence_and_no_row_of_dashes():
    actual = engines(("d-240", "d-240-bearings", "gots-regimes"))
    names = [engine.label for engine in actual]
    shown, said = split_rows(differences(actual), names)
    assert "подшипники и прочность шеек" in said and "газы режима 3" in said
    for row in (*shown, *split_rows(results(actual), names)[0]):
        known = [value for value in row.values if value is not None]
        assert len(known) == len(names) or len(set(known)) > 1, row.title
    page = plain(comparison_page(actual, media="screen"))
    assert said.replace("\u00a0", " ") in page.replace("\u00a0", " ")
    sheet = openpyxl.load_workbook(io.BytesIO(book_bytes(actual)))[INPUTS]
    assert said in [cell.value for cell in sheet["A"]]
    assert split_rows(differences(actual[:1] * 2), names[:2]) == ([], "")


def test_results_that_one_engine_alone_has_are_named_by_their_group():
    pair = [
        Row("Уравновешенность", key, key, "", quantity("F1_after_max"), (1.0, None)) for key in "ab"
    ]
    assert split_rows(pair, ("А", "Б")) == ([], "Есть не у всех: А — уравновешенность.")
    shown, said = split_rows([*pair, replace(pair[0], key="c", values=(1.0, 2.0))], ("А", "Б"))
    assert [row.key for row in shown] == ["c"] and said == "Есть не у всех: А — a, b."
