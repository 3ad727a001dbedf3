"""A line that is no TOML is told by what stands in it, with the mend."""

from __future__ import annotations

import pytest

from reports.inputs.load import load_text
from reports.shared.errors import InputError
from reports.shared.resources import samples_dir

TEXT = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
BORE = "bore_mm = 88.0"


def lines_of(text):
    with pytest.raises(InputError) as caught:
        load_text(text, source="x.toml")
    return caught.value.lines()


def row_of(part, text):
    return text[: text.index(part)].count("\n") + 1


BROKEN = {
    "bore_mm = 88,5": "дробь с запятой: 88,5; десятичный разделитель — точка: 88.5",
    "bore_mm 88.0": "после ключа нет знака «=»; напишите bore_mm = 88.0",
    "bore_mm: 88.0": "после ключа нет знака «=»; напишите bore_mm = 88.0",
    "bore_mm := 88.0": "после ключа нет знака «=»; напишите bore_mm = 88.0",
    "bore_mm = 1 088": "пробелы в числе 1 088; напишите 1088",
    "bore_mm = 88,0 мм": "лишнее после числа: «мм»; единица стоит в имени ключа, напишите 88.0",
    "bore_mm = 88 %": "лишнее после числа: «%»; единица стоит в имени ключа, напишите 88",
    "bore_mm = =80+8": "формула вместо числа; в файле пишут готовое число, формулы — в книге Excel",
    "bore_mm = 9б,5": "в числе 9б,5 буква «б»; пишите число цифрами",
    "bore_mm =": "после знака «=» ничего нет; впишите значение или удалите строку",
    "bore_mm = .5": "число записано как .5; напишите 0.5",
    "bore_mm = 088": "число записано как 088; напишите 88",
    "bore_mm = −88.0;": "число записано как −88.0;; напишите -88",
    "bore_mm\u00a0= 88.0":
        "неразрывный пробел в столбце 8; замените его обычным пробелом или удалите",
    "bore_mm = 88.0\u200b":
        "невидимый знак U+200B в столбце 15; замените его обычным пробелом или удалите",
    "bоre_mm = 88.0": "в ключе «bоre_mm» русская буква «о»; напишите латиницей: bore_mm",
    "диаметр = 88.0":
        "в ключе «диаметр» русская буква «д»; "
        "ключи пишутся латиницей, названия — в комментарии после #",
    "// bore": "комментарий начинается не с «#»; поставьте в начале строки #",
    "bore_mm = 88.0; rod = 3": "две записи на одной строке; пишите каждый ключ на своей строке",
    "x = Мой двигатель": 'строка без кавычек; напишите "Мой двигатель"',
    "x = «Двигатель»": 'типографская кавычка «; нужны прямые: "Двигатель"',
    "x = “Двигатель”": 'типографская кавычка “; нужны прямые: "Двигатель"',
    'x = "Двигатель': 'строка не закрыта кавычкой; напишите "Двигатель"',
    "x = да": "слово «да» без кавычек; напишите true",
    'x = "C:\\Users\\a.csv"': 'обратная черта «\\» в кавычках; пишите прямую: "C:/Users/a.csv"',
    "x = [28,0; 28,5]":
        "в списке точка с запятой; между числами запятая, дробь с точкой: [28.0, 28.5]",
    "x = [28 29]": "в списке нет запятой между числами; напишите [28, 29]",
    "x = (28, 29)": "список без квадратных скобок; напишите [28, 29]",
    "x = 28; 29": "список без квадратных скобок; напишите [28, 29]",
    "x = [28.0, 29.0": "список не закрыт скобкой «]»; строка: «x = [28.0, 29.0»",
}  # fmt: skip


@pytest.mark.parametrize("line", BROKEN)
def test_the_line_is_told_with_its_mend(line):
    comment = "" if line == "bore_mm = −88.0;" else " # p = 0,81 «МПа» [х]"
    text = TEXT.replace(BORE, line + comment)
    assert lines_of(text) == [f"x.toml: строка {row_of(line, text)}: {BROKEN[line]}"]


def test_a_quoted_key_with_a_russian_letter():
    (line,) = lines_of(TEXT.replace(BORE, '"bоre_mm" = 88.0'))
    assert line == (
        "x.toml: geometry.bоre_mm: в ключе русская буква «о»; напишите латиницей: bore_mm"
    )


def test_a_list_of_decimal_commas_that_toml_reads():
    text = TEXT.replace("[gas]", "main_lengths_mm = [28,0, 28,0]\n\n[gas]", 1)
    first, *others = lines_of(text)
    row = row_of("main_lengths_mm = [28,0", text)
    assert first == (
        f"x.toml: строка {row}: в списке дроби с запятой; если это дроби, напишите [28.0, 28.0]"
    )
    assert others


def test_a_backslash_that_toml_takes_for_a_tab():
    text = TEXT.replace("[report]", '[report]\ntemplates = "my\\templates"', 1)
    (line,) = lines_of(text)
    assert line == (
        "x.toml: report.templates: в строке обратная черта «\\» со знаком, как в «\\t»; "
        "пишите в путях прямую черту: «папка/файл.csv»"
    )
