"""Mistakes that departments make in their books: each is one sentence with its line at check."""

from __future__ import annotations

import re
from itertools import zip_longest
from pathlib import Path

import pytest
from click.testing import CliRunner

from reports.cli import main
from reports.exports.book_trial import TRIED, check_alone, refuse_unbuilt
from reports.exports.department_chapters import failed_engine_checks, refuse_faults
from reports.formula.mends import MEANT
from reports.formula.parse import AGGREGATES, FUNCTIONS, SCALE_FUNCTIONS, SHIFTS, is_known_function
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from reports.shared.errors import InputError
from tests.conftest import sample
from tests.manual.pages import DOCS, blocks

(BOOK,) = blocks(DOCS / "own-chapter.md", "book")
TABLE = """table fan_turn В.1 over turn: Скорость лопасти
phi_deg
speed_fan of tip_fan = tip_fan*sin(rad(phi_deg)) | -
"""
CHART = """chart fan_chart over phi_deg: Скорость лопасти
y u, м/с
curve fan_turn.speed_fan
"""
CHOICE = '"ремень" else 1'
LIST_ = "power_fan = "
CHECK = "value <= 125"


def engine(text: str, base: str = "gots-diesel", **sections: object) -> InputFile:
    """An engine with a book."""
    raw = to_mapping(sample(base)) | sections
    raw["calculation"] = {**raw["calculation"], "step_deg": 30}
    raw["report"]["books"], raw["books"] = ["к.book"], {"к.book": text}
    return load_mapping(raw, source="").model


def told(text: str, *, built: bool = False, **sections: object) -> str:
    """What check says of a book; nothing where it is taken."""
    try:
        model = engine(text, **sections)  # type: ignore[arg-type]
        refuse_faults(model)
        if built:
            refuse_unbuilt(model, whole=False)
    except InputError as error:
        return str(error)
    return ""


def with_table(more: str = "") -> str:
    return BOOK.replace("\ntext ", f"\n{TABLE}{CHART}\ntext ") + more


# What is put in place of what in the page's book, and the sentence.
FORMULAS = {
    "function of Excel": ("MAX(1, 2)", "«MAX(» | пишите max для чисел или col_max"),
    "pi of Excel": ("PI()*2", "«PI(» | пишите pi без скобок"),
    "caret": ("omega^2", "«^» | степень пишут **"),
    "if of Excel": ("IF(omega>1;2;3)", "«IF(» | пишите ЗНАЧЕНИЕ if УСЛОВИЕ else ДРУГОЕ"),
    "decimal comma": ("0,6*omega", "«0,6» | в дроби — точка: 0.6"),
    "comma within a call": ("max(omega, 0,6)", "«0,6» | в дроби — точка"),
    "sum of Excel": ("СУММ(1;2)", "«СУММ(» | пишите total для чисел или col_sum"),
    "one equals sign": ("1 if omega = 2 else 3", "«=» | «равно» пишут =="),
    "not equal of Excel": ("1 if omega <> 2 else 3", "«<>» | «не равно» пишут !="),
    "typographic minus": ("omega − 1", "«−» | минус — обычный знак -"),
    "percent": ("omega*5%", "«5%» | процент пишут дробью"),
    "no sign of product": ("2omega", "«2o» | знак умножения пишут"),
    "square": ("omega²", "«²» | степень пишут **"),
    "no else": ("1 if omega > 2", "«1 if omega > 2» | пишите ЗНАЧЕНИЕ if"),
    "brackets": ("(omega + 1", "«(omega + 1» | скобки не парные"),
    "arguments": ("sqrt(1, 2)", "«sqrt(1, 2)» | у sqrt чисел в скобках 2, а нужно 1"),
    "no function": ("blow(omega)", "«blow(» | функции перечислены в docs/books.md"),
    "misspelt function": ("sqr(omega)", "«sqr(» | возможно, sqrt"),
    "cell": ("$B$12*2", "«$B$12» | ячейки не называют"),
    "Cyrillic name": ("оmega*2", "имя «оmega» неизвестно | в имени русские буквы"),
    "column without its table": ("Pg_MPa*2", "имя «Pg_MPa» неизвестно | возможно, P4_1.Pg_MPa"),
    "input that others have": ("cycle_power_kw", "неизвестно | cycle.power_kw у этого двигателя н"),
    "column in a list": ("P4_1.Pg_MPa", "«P4_1.Pg_MPa» — столбец, а «power_fan» — одно число | во"),
    "greatest of a column": ("max(P4_1.Pg_MPa)", "— одно число | пишите col_max(P4_1.Pg_MPa)"),
    "mean of a number": ("col_mean(omega)", "col_mean берёт столбец, а «omega» — одно число | наз"),
    "value of no check": ("value*2", "имя «value» неизвестно | value стоит только в условии"),
}  # fmt: skip
REPLACED = {
    "label in capitals": (CHOICE, '"Ремень" else 1', "среди подписей «fan_drive» нет «Ремень» | е"),
    "key for a label": (CHOICE, '"belt" else 1', "слово выбора, а в формуле — подпись | пишите «р"),
    "number as a text": ('fan_drive == "ремень"', 'omega == "ремень"', "— число, а сравнено с тек"),
    "order of texts": ("fan_drive ==", "fan_drive >", "тексты не больше и не меньше | сравнивайте"),
    "label in a statement": ("list fan:",
                             '% if value.own.fan.drive == "ремень"\n% endif\nlist fan:',
                             "value.own.fan.drive не бывает «ремень» | в условии — слово выбора:"),
    "word of the program's": ("list fan:", '% if value.engine.layout == "V"\n% endif\nlist fan:',
                              "value.engine.layout не бывает «V»"),
    "check of a text": ("check fan_tip = tip_fan", "check fan_tip = fan_drive", "— текст, а прове"),
    "check of the program's": ("check fan_tip", "check lam", "имя проверки «lam» занято | назовит"),
    "quantity of the program's": ("quantity tip_fan",
                                  "quantity omega: х | x | | 1\nquantity tip_fan",
                                  "величину «omega» объявляет сама программа"),
    "one symbol": (r"u_{\mathrm{в}}", r"N_{\mathrm{в}}", "обозначение «Nв» уже у «power_fan»"),
    "symbol of the program's": (r"u_{\mathrm{в}}", r"\lambda", "обозначение «λ» уже у «lam»"),
    "open brace": (r"u_{\mathrm{в}}", r"u_{\mathrm{в}", "не годится"),
    "two sections": ("input fan.blade_mm", "input fans.blade_mm", "два раздела исходных: fan и fa"),
    "sheet of the program's": ("sheet Вентилятор", "sheet Массы", "лист «Массы» есть у программы"),
    "sheet of the workbook": ("sheet Вентилятор", "sheet содержание", "«содержание» есть у програ"),
    "no sheet": ("sheet Вентилятор in Расчёты кафедры 1: Вентилятор системы охлаждения\n", "",
                 "лист не назван"),
    "no condition": (CHECK, "125", "«125» — не условие о проверяемом значении"),
    "condition of another": (CHECK, "omega <= 125", "не условие о проверяемом значении"),
    "function in a condition": (CHECK, "ABS(value) <= 125", "«ABS(» | пишите abs"),
    "unknown limit": (CHECK, "value <= limit_fan", "имя «limit_fan» неизвестно"),
    "unknown value": ("check fan_tip = tip_fan", "check fan_tip = tip_fen", "имя «tip_fen» неизве"),
    "nothing in a list": ("list fan_checks", "list fan_empty: Пусто\nlist fan_checks", "нет ни од"),
    "shown twice": ("show fan", "show fan\nshow fan", "«fan» показано дважды | оставьте одно show"),
    "formula twice": ("formula power_fan", "formula power_fan\nformula power_fan", "показано дваж"),
    "table not shown": ("show fan", 'Таблица {{ tab("fan") }}.', "«fan» в записке не показано | д"),
    "figure of a table": ("show fan", 'Рисунок {{ fig("fan") }}.\nshow fan', "«fan» — таблица | п"),
    "unknown source": ("скорость {{", '{{ src("kolchyn") }} {{', "«kolchyn» нет | есть, например"),
    "unnamed member": ("скорость {{", '{{ member("3") }} {{', "«3» не назван | допишите строку"),
    "number of nothing": ("скорость {{", '{{ calc("no", 1) }} {{', "нет «no» | назовите"),
    "list of no checks": ("скорость {{", '{{ within("fan") }}а{{ end }} {{', "«fan» нет"),
    "more than a formula": ("formula power_fan", "formula power_fan кВт", "за «power_fan» стоит"),
    "nothing to show": ("show fan", "show fans", "показывать нечего: нет «fans»"),
    "a word for a text": ("Окружная скорость {{", "Скорость {{ val('tip fan') }} {{", "не разобра"),
    "if without end": ("list fan:", "% if engine.strokes == 2\nlist fan:", "% if не закрыт | допи"),
    "end without if": ("list fan:", "% endif\nlist fan:", "% endif без % if"),
    "end of another": ("list fan:", "% for i in engine.numbers\n% endif\nlist fan:", "% endif без"),
    "else without if": ("list fan:", "% else\nlist fan:", "% else стоит вне % if"),
    "expression of Jinja": ("list fan:", "% if engine.strokes ==\nlist fan:", "% if не закрыт"),
    "print of Jinja": ("tip_fan =", "tip_fan = {{ 1 2 }} +", "нужно }}, а стоит целое число"),
    "tag in a text": ("Вентилятор берёт", "Вентилятор <b> берёт", "похож на формулу или код"),
}  # fmt: skip


def lines_told(text: str, sentence: str, line: int, **more: bool) -> None:
    """Hold what is told to one sentence of a line."""
    (only, *others) = told(text, **more).splitlines() or [""]
    what, _, mend = sentence.partition(" | ")
    assert only.startswith(f"к.book: строка {line}, столбец "), only
    assert what in only and mend in only, only
    assert re.search(r"(?:[a-z]{4,} ){2}[a-z]{3,}|[a-z]Error", only) is None, only
    assert not others, others


def test_the_book_of_the_page_is_fine():
    assert told(BOOK, built=True) == told(with_table("show fan_chart\n"), built=True) == ""


@pytest.mark.parametrize("case", FORMULAS)
def test_a_formula_is_mended(case: str):
    text, sentence = FORMULAS[case]
    book = BOOK.replace("power_fan = fan_flow_share*M_e*omega/1000", f"power_fan = {text}")
    lines_told(book, sentence, line_of(book, "power_fan = "))


def line_of(book: str, fragment: str) -> int:
    return book[: book.index(fragment)].count("\n") + 1


@pytest.mark.parametrize("case", REPLACED)
def test_a_line_is_told(case: str):
    old, new, sentence = REPLACED[case]
    assert old in BOOK
    book = BOOK.replace(old, new, 1)
    changed = [at for at, (one, other) in enumerate(
        zip_longest(BOOK.splitlines(), book.splitlines()), 1) if one != other]  # fmt: skip
    at = changed[0]
    only = told(book)
    number = int(only.removeprefix("к.book: строка ").partition(",")[0])
    assert at <= number <= at + new.count("\n") + 1, only
    lines_told(book, sentence, number)


# Tables and charts: what stands in place of what, the line that is told, the sentence.
TABLES = {
    "turn over cycle": ("over turn", "over cycle", "speed_fan of", None),
    "rows of another angle": ("tip_fan*sin", "P4_1.Pg_MPa*sin", "speed_fan of", "— не строки табл"),
    "many rows": ("over turn", "over 0…4000 by 1", "table fan_turn", "или больше 3000 | возьмите"),
    "rows that are none": ("over turn", "over 0…x by 1", "table fan_turn", "0…x by 1» не разобран"),
    "no angle": ("phi_deg\n", "", "table fan_turn", "первый столбец «speed_fan» с формулой"),
    "no curve": ("curve fan_turn.speed_fan\n", "", "chart fan_chart", "«fan_chart» нет кривых | д"),
    "no abscissa": (" over phi_deg", "", "chart fan_chart", "нет абсциссы"),
    "unknown curve": ("curve fan_turn.speed_fan", "curve fan_turn.speed", "curve fan", "нет «fan_"),
    "step of no axis": ("y u,", "x_step много\ny u,", "x_step много", "шаг оси «много» не разобра"),
    "word of no chart": ("y u,", "colour red\ny u,", "colour red", "слово «colour» диаграмме неиз"),
    "curve of another angle": ("curve fan_turn.speed_fan", "curve P4_1.phi_deg fan_turn.speed_fan",
                               "curve P4_1", "разное число значений | возьмите столбцы одной"),
}  # fmt: skip


@pytest.mark.parametrize("case", TABLES)
def test_a_table_is_told(case: str):
    old, new, at, sentence = TABLES[case]
    book = with_table()
    assert old in TABLE + CHART
    head, block, rest = book.partition(TABLE + CHART)
    book = head + block.replace(old, new, 1) + rest
    if sentence is None:
        assert told(book) == ""
    else:
        lines_told(book, sentence, line_of(book, at))


def test_the_whole_report_is_asked():
    """What the program's chapters have is not shown again; symbols that no page sets are told."""
    shown = BOOK + "show P3_1\n"
    lines_told(
        shown, "«P3_1» уже стоит в записке | {{ tab", line_of(shown, "show P3_1"), built=True
    )
    symbol = BOOK.replace(r"u_{\mathrm{в}}", "u_1_2")
    lines_told(
        symbol, "«u_1_2» не набирается | проверьте", line_of(symbol, "quantity tip"), built=True
    )


def test_a_condition_asks_an_own_input():
    text = BOOK.replace(CHECK, "value <= fan_blade_mm/10")
    assert told(text, built=True) == ""
    (failed,) = failed_engine_checks(engine(text), every=False)
    assert failed.key == "fan_tip"
    assert failed_engine_checks(engine(text, own={"fan": {"blade_mm": 2000}}), every=False) != []


def test_what_is_not_allowed_is_told(tmp_path: Path):
    """On the command line, with code 1; a reason silences it, a misspelt one is refused."""
    text = BOOK + "\nsheet Вентилятор\nallowed fan_limit <= fan_blade_mm: Пределы\n"
    text += "too_fast = 1000*tip_fan | Окружная скорость\n"
    (tmp_path / "к.book").write_text(text, encoding="utf-8")
    toml = Path("samples/gots-diesel.toml").read_text(encoding="utf-8")
    path = tmp_path / "д.toml"
    named = toml.replace("[report]", '[report]\nbooks = ["к.book"]')
    for what, code, words in (
        ("", 1, "не выполнена проверка «Окружная скорость»"),
        ("too_fast", 0, "ошибок нет"), ("too_fost", 2, "«too_fost»; возможно, too_fast"),
        ("powr", 2, "нет проверки или ключа «powr»; возможно, power"),
    ):  # fmt: skip
        more = f'\n[[checks.accepted]]\nwhat = "{what}"\nreason = "так задано"\n' if what else ""
        path.write_text(named + more, encoding="utf-8")
        done = CliRunner().invoke(main, ["check", str(path)])
        assert (done.exit_code, words in done.output) == (code, True), done.output


def test_a_book_alone_is_tried_on_engines_of_every_kind(tmp_path: Path):
    path = tmp_path / "к.book"
    kinds = [sample(name) for name in TRIED]
    assert {"DesignGeometrySection", "GeometrySection"} == {
        type(k.geometry).__name__ for k in kinds
    }
    assert any(getattr(kind.geometry, "stroke_mm", None) for kind in kinds)
    assert {kind.engine.strokes for kind in kinds} == {2, 4}
    for name, sampled in (("geometry_bore_mm", "cycle-petrol"), ("geometry_stroke_mm", TRIED[0])):
        path.write_text(BOOK.replace("fan_flow_share*M_e", name), encoding="utf-8")
        with pytest.raises(InputError) as raised:
            list(check_alone(path))
        assert f"имя «{name}» неизвестно" in str(raised.value)
        assert (f"на образце {sampled}:" in str(raised.value)) == (sampled != TRIED[0])


@pytest.mark.parametrize(("data", "words"), [
    (BOOK.encode("utf-16"), "строка 1, столбец 1: кодировка UTF-16; сохраните книгу в UTF-8"),
    (BOOK.encode("cp1251", "replace"), "строка 1, столбец 1: кодировка не UTF-8"),
    (b"PK\x03\x04", "это книга Excel или архив"),
])  # fmt: skip
def test_an_encoding_is_told(data: bytes, words: str, tmp_path: Path):
    path = tmp_path / "к.book"
    path.write_bytes(data)
    done = CliRunner().invoke(main, ["check", str(path)])
    assert done.exit_code == 2 and words in done.output and str(tmp_path) not in done.output


def test_the_manual_lists_the_functions():
    page = (DOCS / "books.md").read_text(encoding="utf-8")
    part = page.partition("## Функции")[2].partition("\n## ")[0]
    listed = set(re.findall(r"^\| `(\w+)\(", part, re.MULTILINE))
    assert listed == {*FUNCTIONS, *AGGREGATES, *SHIFTS}
    assert set(re.findall(r"`(\w+)\(x\)`", page)) >= SCALE_FUNCTIONS
    assert all(is_known_function(name) for name in MEANT.values())
