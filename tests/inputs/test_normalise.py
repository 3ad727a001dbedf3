"""Files of any bytes are read or refused; what can mean one thing only is understood."""

from __future__ import annotations

import errno
import pathlib
import re

import pytest

from reports.inputs.load import load_mapping, load_text, load_toml
from reports.inputs.normalise import MAX_BYTES
from reports.shared.errors import InputError
from reports.shared.resources import samples_dir
from tests.inputs.slips import at, changed, path_of

UNDERSTOOD = [
    ("calculation.step_deg", 10.0, 10),
    ("calculation.step_deg", "10", 10),
    ("calculation.step_deg", "10°", 10),
    ("calculation.wear_rays", 12.0, 12),
    ("engine.cylinders", 3.0, 3),
    ("engine.cylinders", "3", 3),
    ("engine.strokes", 4.0, 4),
    ("engine.strokes", "четырёхтактный", 4),
    ("engine.strokes", " Четырехтактный ", 4),
    ("engine.layout", "рядный", "inline"),
    ("engine.layout", " Рядный", "inline"),
    ("report.year", 2026.0, 2026),
    ("calculation.method", "точное ускорение", "exact"),
    ("gas.source", "по политропам", "polytropic"),
    ("gas.source", "По  Политропам", "polytropic"),
    ("report.frame", "без рамки", "none"),
    ("geometry.bore_mm", "88,0", 88.0),
    ("geometry.bore_mm", " 88.5 ", 88.5),
    ("geometry.bore_mm", "88", 88.0),
    ("regime.speed_rpm", "4 400", 4400.0),
    ("regime.speed_rpm", "4\u00a0400,5", 4400.5),
    ("geometry.crank_radius_mm", "4,7e1", 47.0),
    ("crankshaft.nose_angle_deg", "−30", -30.0),
    ("crankshaft.arms.1.l1_mm", "32,5", 32.5),
    ("crankshaft.main_lengths_mm.2", "33,5", 33.5),
]
REFUSED = [
    ("geometry.bore_mm", "88,0 мм", "напишите одно число: 88.0"),
    ("geometry.bore_mm", "5О", "в числе буква вместо цифры; возможно, 50"),
    ("geometry.bore_mm", "1l0,5", "в числе буква вместо цифры; возможно, 110.5"),
    ("geometry.bore_mm", "88,000", "неясно, 88.000 или 88000"),
    ("geometry.bore_mm", "1,234.5", "нужно число"),
    ("geometry.bore_mm", "8 8", "нужно число"),
    ("geometry.bore_mm", "около 88", "нужно число"),
    ("geometry.bore_mm", True, "нужно число"),
    ("calculation.step_deg", 10.5, "недопустимое значение"),
    ("engine.cylinders", 3.5, "нужно целое число"),
    ("engine.cylinders", True, "нужно целое число"),
    ("engine.layout", "звездой", "допустимо: inline, v, opposed"),
    ("gas.source", "наугад", "допустимо: polytropic, table, cycle, rounded, file"),
]


@pytest.mark.parametrize(("key", "given", "meant"), UNDERSTOOD)
@pytest.mark.parametrize("locate", [None, lambda path: "Лист!A1"], ids=["file", "book"])
def test_one_meaning_is_understood(raw, key, given, meant, locate):
    path = path_of(key)
    wanted = load_mapping(changed(raw, (path, meant)), source="f", locate=locate)
    actual = load_mapping(changed(raw, (path, given)), source="f", locate=locate)
    assert actual.model == wanted.model
    assert type(actual.model) is type(wanted.model)


@pytest.mark.parametrize(("key", "given", "words"), REFUSED)
def test_two_meanings_are_refused(raw, refused, key, given, words):
    lines = refused(changed(raw, (path_of(key), given)))
    assert any(key in line and words in line for line in lines), lines


WORDS = [
    ("engine.layout", "V-образный", "v"),
    ("engine.layout", "v – Образный", "v"),
    ("engine.layout", "Оппозитный", "opposed"),
    ("engine.strokes", "двухтактный", 2),
    ("cycle.kind", "Дизель", "diesel"),
    ("cycle.kind", "бензиновый", "petrol"),
    ("cycle.kind", "С искровым зажиганием", "petrol"),
    ("cycle.pumping", "да", "yes"),
    ("cycle.pumping", "Нет", "no"),
    ("cycle.rounding", "вверх", "up"),
    ("cycle.fuel", "дизельное топливо", "diesel"),
    ("masses.estimate_fuel", "дизель", "diesel"),
    ("masses.estimate_piston", "чугун", "iron"),
    ("gas.interpolation", "прямыми", "linear"),
]


@pytest.mark.parametrize(("key", "word", "meant"), WORDS)
def test_russian_words_of_choices(key, word, meant):
    from reports.inputs.normalise import normalise

    section, name = key.split(".")
    given = {section: {name: word}}
    if name == "interpolation":
        given["gas"]["source"] = "table"
    assert at(normalise(given), (section, name)) == meant


def test_a_file_of_points_may_be_called_so(tmp_path):
    text = (samples_dir() / "d-240.toml").read_text(encoding="utf-8")
    head, _, rest = text.partition("[gas]")
    gas = '[gas]\nsource = "из файла"\nfile = "no.csv"\n' + rest[rest.index("[masses]") :]
    with pytest.raises(InputError, match="не указана единица давления"):
        load_text(head + gas, source="f", folder=tmp_path)


IN_CELLS = [
    ({"geometry.bore_mm": "88 мм"}, "задано: строка «88 мм»; сделайте ячейку числом"),
    ({"geometry.bore_mm": "88,000"}, "неясно, 88.000 или 88000; сделайте ячейку числом"),
    ({"engine.layout": "звездой"}, "допустимо: рядный, V-образный, оппозитный"),
    ({"calculation.method": "так"}, "допустимо: по учебнику: двучленное ускорение"),
    ({"gas.source": "так"}, "допустимо: по политропам, по точкам диаграммы"),
    ({"engine.cylinders": 5, "engine.layout": "V-образный"},
     "задайте чётное число или «Расположение цилиндров»: рядный"),
    ({"crankshaft.bank_angle_deg": 90.0},
     "очистите ячейку или задайте «Расположение цилиндров»: V-образный"),
    ({"geometry.stroke_mm": 100.0}, "оставьте одну из двух ячеек"),
    ({"gas.scavenge_start_before_bdc_deg": 50.0}, "очистите ячейку или задайте «Тактность»: 2"),
    ({"crankshaft.throw_angles_deg.1": 90.0}, "(«Начало рабочих ходов» 2)"),
]  # fmt: skip


@pytest.mark.parametrize(("changes", "words"), IN_CELLS)
def test_a_cell_is_spoken_of_as_a_cell(raw, changes, words):
    data = changed(raw, *((path_of(key), value) for key, value in changes.items()))
    with pytest.raises(InputError) as caught:
        load_mapping(data, source="f.xlsx", locate=lambda path: "Исходные данные!C5")
    lines = caught.value.lines()
    assert any(words in line for line in lines), lines
    for line in lines:
        assert "f.xlsx: Исходные данные!C5" in line
        said = re.sub(r"\(\w+(\.\w+)?[^)]*\): ", "", line.partition("C5 ")[2], count=1)
        assert "ключ" not in said
        assert not re.search(r"[a-z]+_[a-z_]+", said), said


def test_a_list_in_place_of_the_kind_of_gas_is_answered():
    text = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
    text = text.replace('source = "polytropic"', "source = []")
    assert "source = []" in text
    with pytest.raises(InputError, match="gas"):
        load_text(text, source="t.toml")


TEXT = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
CUT = "файл обрывается на середине записи; восстановите его конец"
START = "заготовку даст команда «kshm new»"
OTHER = "а нужен текст TOML; выберите другой файл"


def swap(old, new):
    assert TEXT.count(old) == 1
    return TEXT.replace(old, new).encode()


ROW = TEXT[: TEXT.index("bore_mm = 88.0")].count("\n") + 1
LAST = TEXT.count("\n") + 1
CASES = {
    "empty": (b"", f"файл пуст; {START}"),
    "blank": (b" \n\n", f"файл пуст; {START}"),
    "comment only": ("# ничего\n".encode(), f"файл пуст; {START}"),
    "binary": (b"\x00\x01\x02", f"двоичный файл, {OTHER}"),
    "workbook": (b"PK\x03\x04....", f"это книга Excel или архив, {OTHER}"),
    "office": (b"\xd0\xcf\x11\xe0....", f"это старый или зашифрованный документ Office, {OTHER}"),
    "pdf": (b"%PDF-1.7", f"это документ PDF, {OTHER}"),
    "utf-16": ("[report]".encode("utf-16"), "кодировка UTF-16; сохраните файл в UTF-8"),
    "cp1251": (
        '[report]\nstudent = "Иванов"\n'.encode("cp1251"),
        "строка 2: не UTF-8 (возможно, Windows-1251); сохраните файл в UTF-8",
    ),
    "too large": (b"#" * (MAX_BYTES + 1), "файл больше 2 МБ; это не файл исходных данных"),
    "too many lines": (
        b"\n" * 30_000 + b"a=1",
        "в файле больше 20000 строк; это не файл исходных данных",
    ),
    "cut within a letter": (
        "# я".encode()[:-1],
        "файл обрывается посреди знака; восстановите его конец",
    ),
    "cut within a value": (TEXT[: TEXT.index("88.0")].encode(), CUT),
    "cut within a list": (TEXT[: TEXT.index("240, 480]")].encode(), CUT),
    "cut within a key": (TEXT[: TEXT.index("_mm = 88.0")].encode(), CUT),
    "decimal comma": (
        swap("bore_mm = 88.0", "bore_mm = 88,0"),
        f"строка {ROW}: дробь с запятой: 88,0; десятичный разделитель — точка: 88.0",
    ),
    "no equals sign": (
        swap("bore_mm = 88.0", "bore_mm 88.0"),
        f"строка {ROW}: после ключа нет знака «=»; напишите bore_mm = 88.0",
    ),
    "key twice": (
        swap("bore_mm = 88.0", "bore_mm = 88.0\nbore_mm = 1"),
        f"строка {ROW + 1}, столбец 12: ключ задан дважды; строка: «bore_mm = 1»",
    ),
    "section twice": (
        (TEXT + "[regime]\n").encode(),
        f"строка {LAST}, столбец 8: раздел задан дважды; строка: «[regime]»",
    ),
    "open quote": (
        b'[report]\nstudent = "abc\n',
        'строка 2: строка не закрыта кавычкой; напишите "abc"',
    ),
    "brackets without end": (
        b"a = " + b"[" * 100_000,
        "слишком глубокая вложенность; уберите лишние скобки",
    ),
    "dotted key without end": (
        b".".join([b"a"] * 100_000) + b" = 1",
        "строка 1: слишком длинный составной ключ; ключ состоит из одного слова",
    ),
    "digits without end": (
        b"a = " + b"9" * 5000,
        "ошибка записи TOML; проверьте запись по примеру из «kshm new»",
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_refused_with_one_line(case, tmp_path):
    data, message = CASES[case]
    file = tmp_path / "x.toml"
    file.write_bytes(data)
    with pytest.raises(InputError) as caught:
        load_toml(file)
    assert caught.value.lines() == [f"x.toml: {message}"]


@pytest.mark.parametrize(
    "change", [lambda text: "\ufeff" + text, lambda text: text.replace("\n", "\r\n")]
)
def test_notepad_files_are_read(change, tmp_path):
    file = tmp_path / "x.toml"
    file.write_bytes(change(TEXT).encode())
    assert load_toml(file).model == load_text(TEXT, source="x").model


def test_every_truncation_is_refused_or_valid(tmp_path):
    data = TEXT.encode()
    complete = data.rindex(b"l5_mm")
    file = tmp_path / "x.toml"
    for end in range(0, complete, 37):
        file.write_bytes(data[:end])
        with pytest.raises(InputError) as caught:
            load_toml(file)
        assert all(line.startswith("x.toml: ") for line in caught.value.lines())


def test_long_line_of_points_is_no_bomb():
    points = [[0.0, 0.1]] + [[i / 2, 0.1 + 1e-5 * i] for i in range(1, 1440)] + [[720.0, 0.1]]
    head, rest = TEXT.split("[gas]")
    tail = rest[rest.index("[masses]") :]
    text = f'{head}[gas]\nsource = "table"\npoints = {points}\n{tail}'
    assert len(load_text(text, source="x").model.gas.points) == 1441


def test_no_file(tmp_path):
    with pytest.raises(InputError) as caught:
        load_toml(tmp_path / "none.toml")
    assert caught.value.lines() == [
        f"{tmp_path / 'none.toml'}: файл не найден; проверьте имя и путь"
    ]


def test_folder(tmp_path):
    with pytest.raises(InputError, match="это папка, а нужен файл"):
        load_toml(tmp_path)


def test_file_name_stays_on_one_line(tmp_path):
    file = tmp_path / "a\nb.toml"
    file.write_text("x")
    with pytest.raises(InputError) as caught:
        load_toml(file)
    assert len(str(caught.value).splitlines()) == 1
    assert caught.value.lines()[0].startswith("a b.toml: ")


def test_unreadable(tmp_path, monkeypatch):
    file = tmp_path / "x.toml"
    file.write_text(TEXT, encoding="utf-8")

    def refuse(*args, **kwargs):
        raise PermissionError(errno.EACCES, "denied")

    monkeypatch.setattr(pathlib.Path, "open", refuse)
    with pytest.raises(InputError, match="файл не читается: нет прав"):
        load_toml(file)
