"""What can mean one thing only is understood, in a file as in a cell; the rest is refused."""

import re

import pytest

from reports.inputs.load import load_mapping, load_text
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
    found = load_mapping(changed(raw, (path, given)), source="f", locate=locate)
    assert found.model == wanted.model
    assert type(found.model) is type(wanted.model)


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
    from reports.inputs.understood import understood

    section, name = key.split(".")
    given = {section: {name: word}}
    if name == "interpolation":
        given["gas"]["source"] = "table"
    assert at(understood(given), (section, name)) == meant


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
