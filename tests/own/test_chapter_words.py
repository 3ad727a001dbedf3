"""Words of a chapter's text that depend on values: cases, members, what is beyond its limits."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from reports.cli import main
from reports.document.report import Report
from reports.inputs.load import load_toml
from reports.model.blocks import Model
from reports.model.evaluation import Values, evaluate_model
from reports.shared.errors import BookError
from reports.shared.resources import samples_dir
from reports.tables.registry import build_model
from reports.tables.verdicts import outcomes
from tests.document.bare_pages import plain

_BOOK = """section fan: Вентилятор
input fan.limit: Предел | u | м/с | 1…500 | LIMIT
quantity tip_fan: окружная скорость | u_{\\mathrm{в}} | м/с | 1

place after 700
sheet Вентилятор in Расчёты кафедры 1: Вентилятор
list fan: Вентилятор
tip_1 of tip_fan = VALUE | -
tip_2 of tip_fan = 20 | -
list fan_usual verdicts "в пределах" "вне пределов": Обычные скорости
check tip_first = tip_1 | SPAN м/с | Скорость первого вентилятора
check tip_second = tip_2 | 10…40 м/с | Скорость второго вентилятора

text Вентилятор
TEXT
"""
_TEXT = """Начало.{{ when("fan_limit > 100") }} Предел высок.{{ otherwise }} Предел низок.{{ end }}
{{ within("fan_usual") }}Все скорости обычны.{{ end }}
{{ outside("fan_usual") }}Необычны: {{ beyond("fan_usual") }}.{{ end }}
pick MEMBER tip_@
Вентилятор @, его скорость {{ val("tip_@") }} {{ src("kolchin") }}:
formula tip_@,
продолжение предложения.
mend tip_first уменьшить диаметр
show fan_usual: Скорости и пределы"""
_USUAL = {"LIMIT": "50", "VALUE": "30", "SPAN": "10…40", "MEMBER": "least"}


@pytest.fixture
def written(tmp_path: Path):
    """Return a writer of an engine's report with the book, words of it changed."""

    def write(text: str = _TEXT, **changes: str) -> tuple[str, Model, Values]:
        book = _BOOK.replace("TEXT", text)
        for word, value in (_USUAL | changes).items():
            book = book.replace(word, value)
        (tmp_path / "fan.book").write_text(book, encoding="utf-8")
        engine = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
        alone = 'books = ["fan.book"]\nchapters = ["own"]'  # the program's take most of the time
        named = engine.replace("[report]", f"[report]\n{alone}")
        (tmp_path / "engine.toml").write_text(named, encoding="utf-8")
        model = build_model(load_toml(tmp_path / "engine.toml").model)
        values = evaluate_model(model)
        page = Report(model, values).page("screen")
        start = page.index("Вентилятор</h1>")
        return page[start : page.index("<h1", start)], model, values

    return write


def words(page: str) -> str:
    return re.sub(r"\s+", " ", plain(page))


def test_the_book_is_without_a_fault_by_itself(written, tmp_path):
    written()
    done = CliRunner().invoke(main, ["check", str(tmp_path / "fan.book")])
    assert "ошибок нет" in done.output, done.output


def test_a_case_is_told_where_it_holds(written):
    assert "Начало. Предел низок. Все скорости" in words(written()[0])
    assert "Начало. Предел высок. Все скорости" in words(written(LIMIT="200")[0])


@pytest.mark.parametrize(
    ("value", "span", "told"),
    [
        ("30", "10…40", "Все скорости обычны."),
        ("30", "10…20", "Необычны: скорость первого вентилятора (уменьшить диаметр)."),
        ("30", "35…40", "Необычны: скорость первого вентилятора (взято с запасом)."),
        ("0 - 30", "-20…10", "Необычны: скорость первого вентилятора (уменьшить диаметр)."),
    ],
)
def test_a_list_tells_what_is_beyond_its_limits(written, value, span, told):
    page, model, values = written(VALUE=value, SPAN=span)
    others = {"Все скорости", "Необычны"} - {told.partition(":")[0].removesuffix(" обычны.")}
    text = words(page)
    assert told in text and not any(word in text for word in others)
    names = {each.name for each in outcomes(model, values.scalars) if each.block == "fan_usual"}
    assert names == {"tip_first", "tip_second"}


@pytest.mark.parametrize(("member", "number"), [("least", 2), ("largest", 1)])
def test_a_member_is_picked_by_its_value(written, member, number):
    page = written(MEMBER=member)[0]
    assert f"Вентилятор {number}, его скорость" in words(page)
    assert '<p class="flush">продолжение предложения.</p>' in page


_SAID = """pick least P3_1.s2_mm
member 1 первого
Угол @ и {{ calc("tip_1/tip_2 + col_max(P3_1.s_mm)", 1) }}, $\\Delta_{\\mathrm{в}}$
    {{ book("п. 1.2") }}:
equation a_0 = \\dfrac{b}{c},
где b — {{ title("tip_1") }} {{ src("kolchin", "den_hartog") }}.
formula tip_1
where fan_limit
pick largest tip_@
conclude наибольшая скорость {{ member("@") }} вентилятора {{ val("tip_@") }}
show fan_usual: Скорости и пределы"""


def test_a_text_calculates_writes_symbols_and_concludes(written):
    page, model, values = written(_SAID)
    columns, rows = values.columns["P3_1"], model.tables["P3_1"].rows
    number = f"{30 / 20 + columns['s_mm'].max():.1f}".replace(".", ",")
    assert f"Угол {rows[int(columns['s2_mm'].argmin())]:g} и {number}," in words(page)
    assert "Δ<sub>в</sub>" in page and re.search(r"\[<a[^>]*>\d+</a>,\s*п\.\s*1\.2\]", page)
    assert re.search(r"где b — окружная скорость \[\d+, \d+\]\.", words(page))
    assert "u — предел, м/с" in words(page)
    conclusion = Report(model, values).page("screen")
    said = words(conclusion[conclusion.index("Заключение</h1>") :])
    assert "наибольшая скорость первого вентилятора 30,0 м/с" in said


@pytest.mark.parametrize(
    ("text", "cause"),
    [
        ('{{ member("3") }}', "нет такого имени"),
        ('{{ calc("nobody", 1) }}', "нет такого имени"),
        ('conclude {{ val("nobody") }}', "нет такого имени"),
        ('{{ calc("tip_1", 999999999) }}', "а можно от 0 до 9"),
        pytest.param("equation x" + "\n    + x" * 300, "формула длиннее 1000 знаков", id="long"),
        ("pick least nobody.s_mm", "нет такого имени"),
        ('{{ when("fan_limit > 1") }}Без конца.', "у условия нет"),
        ("Лишний.{{ end }}", "у end нет условия"),
        ("Лишний.{{ otherwise }}", "у otherwise нет условия"),
        ("pick most tip_@", "пишите pick least"),
        ("insert nothing", "нет такого имени"),
        ('{{ when("nobody > 1") }}Нет.{{ end }}', "нет такого имени"),
    ],
)
def test_a_mistake_is_told_by_its_line(written, text, cause):
    with pytest.raises(BookError, match=f"fan.book: строка 15.*{cause}"):
        written(text)
