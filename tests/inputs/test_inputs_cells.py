"""The same checks for the cells of an edited workbook."""

import pytest

from reports.inputs.fields import key_text
from reports.inputs.load import load_mapping
from reports.shared.errors import InputError


def locate(path):
    return f"Исходные данные!{'B' if len(path) == 2 else 'C'}{len(str(path))}"


def load(raw):
    return load_mapping(raw, source="f.xlsx", locate=locate)


def lines(raw):
    with pytest.raises(InputError) as caught:
        load(raw)
    return caught.value.lines()


def test_sheet_and_cell_are_named(raw):
    raw["geometry"]["bore_mm"] = -1
    path = ("geometry", "bore_mm")
    assert lines(raw) == [
        f"f.xlsx: {locate(path)} (geometry.bore_mm): значение −1 вне допустимых пределов; "
        "допустимо от 10 до 1500 мм"
    ]


def test_cross_checks_name_the_cell(raw):
    raw["crankshaft"]["throw_angles_deg"][1] = 10
    (line,) = lines(raw)
    path = ("crankshaft", "throw_angles_deg", 1)
    assert line.startswith(f"f.xlsx: {locate(path)} ({key_text(path)}): угол колена 10°")


def test_what_a_spreadsheet_does_to_types_is_undone(raw):
    expected = load_mapping(raw | {"report": raw["report"] | {"variant": "7"}}, source="f").model
    raw["report"]["variant"] = 7.0
    raw["report"]["city"] = None
    raw["engine"]["cylinders"] = 3.0
    raw["engine"]["layout"] = "рядный"
    raw["engine"]["strokes"] = "4"
    raw["calculation"]["step_deg"] = "10°"
    raw["calculation"]["method"] = "по учебнику: двучленное ускорение"
    raw["gas"]["source"] = "по политропам"
    assert load(raw).model == expected


@pytest.mark.parametrize(
    "path",
    [
        ("geometry", "bore_mm"),
        ("geometry", "rod_length_mm"),
        ("crankshaft", "nose_mass_kg"),
        ("crankshaft", "main_lengths_mm", 2),
        ("crankshaft", "webs", 2, "mass_kg"),
        ("gas", "source"),
    ],
)
def test_an_emptied_cell_is_one_error(raw, path):
    target = raw
    for part in path[:-1]:
        target = target[part]
    target[path[-1]] = None
    assert lines(raw) == [
        f"f.xlsx: {locate(path)} ({key_text(path)}): ячейка пуста; впишите значение"
    ]


@pytest.mark.parametrize(
    ("value", "shown"), [("abc", "строка «abc»"), (True, "логическое значение true")]
)
def test_text_in_a_number_cell_is_refused(raw, value, shown):
    raw["regime"]["speed_rpm"] = value
    (line,) = lines(raw)
    assert f"нужно число, а задано: {shown}" in line


def test_half_a_cylinder_is_refused(raw):
    raw["engine"]["cylinders"] = 3.5
    assert "нужно целое число" in lines(raw)[0]
