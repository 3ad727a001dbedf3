"""Fields of an input by the names of their cells, and cells read back."""

from __future__ import annotations

import re
from collections import Counter

import pytest

from reports.inputs import fields
from reports.inputs.fields import key_text
from reports.inputs.form_fields import groups
from reports.inputs.load import load_mapping, load_toml
from reports.inputs.sections.report import CHAPTERS
from reports.inputs.template import list_samples
from reports.shared.errors import InputError
from reports.shared.resources import samples_dir
from tests.conftest import sample

TABLE = {"source": "table", "points": [[0, 0.1], [180, 0.2], [720, 0.1]]}


def named(model):
    return {field.name: field for field in fields.iter_fields(model)}


def names_of(raw):
    return named(load_mapping(raw, source="f").model)


@pytest.mark.parametrize("sample", list_samples())
def test_names_are_legal_and_unique(sample):
    collected = [
        f.name for f in fields.iter_fields(load_toml(samples_dir() / f"{sample}.toml").model)
    ]
    assert Counter(name.lower() for name in collected).most_common(1)[0][1] == 1
    for name in collected:
        assert re.fullmatch(r"[A-Za-z][A-Za-z0-9_]{1,254}", name)
        assert "_" in name
        assert not re.fullmatch(r"[A-Za-z]{1,3}\d+|[rRcC]\d*([cC]\d*)?", name)


def test_the_names_formulas_use(raw):
    raw["geometry"] |= {"lambda": 47 / 148}
    raw["crankshaft"]["force_offsets_deg"] = [0, 480, 240]
    actual = names_of(raw)
    for name, value in {
        "geometry_bore_mm": 88.0,
        "geometry_lambda": 47 / 148,
        "regime_speed_rpm": 4400,
        "firing_offset_1_deg": 0,
        "throw_angle_2_deg": 120,
        "force_offset_3_deg": 240,
        "web_3_mass_kg": 0.245,
        "web_6_counterweight_angle_deg": 0,
        "throw_1_l1_mm": 32.0,
        "throw_1_left_web_mm": 0.0,
        "main_length_2_mm": 32.0,
        "crankshaft_nose_arm_mm": 130,
        "calculation_step_deg": 10,
    }.items():
        assert actual[name].value == value


def test_names_of_points(raw):
    raw["gas"] = TABLE
    actual = names_of(raw)
    assert (actual["gas_point_2_deg"].value, actual["gas_point_2_mpa"].value) == (180, 0.2)
    assert (actual["gas_point_2_deg"].unit, actual["gas_point_2_mpa"].unit) == ("°", "МПа")
    assert actual["gas_point_2_mpa"].title == "Точка 2: давление"
    assert actual["gas_point_2_mpa"].path == ("gas", "points", 1, 1)


def test_a_field_tells_all(raw):
    field = names_of(raw)["web_3_mass_kg"]
    assert field == fields.Field(
        path=("crankshaft", "webs", 2, "mass_kg"),
        name="web_3_mass_kg",
        section="Щёки и противовесы",
        title="Щека 3: приведённая масса",
        symbol="m_щ3",
        unit="кг",
        value=0.245,
        minimum=0,
        maximum=50000,
        choices=None,
        structural=False,
        optional=True,
    )


def test_choices_and_structure(raw):
    actual = names_of(raw)
    assert actual["calculation_method"].choices == {
        "textbook": "по учебнику: двучленное ускорение",
        "exact": "точное ускорение",
    }
    assert {name for name, field in actual.items() if field.structural} == {
        "engine_cylinders",
        "engine_layout",
        "engine_strokes",
        "calculation_step_deg",
        "calculation_wear_rays",
        "gas_source",
        "workbook_sheets",
    }
    for field in actual.values():
        if field.choices is not None:
            assert str(field.value) in field.choices


def test_only_given_or_defaulted(raw):
    actual = names_of(raw)
    assert "geometry_lambda" not in actual
    assert "masses_rod_kg" not in actual
    assert actual["crankshaft_nose_mass_kg"].optional
    assert not actual["geometry_bore_mm"].optional


def test_order_is_the_files(raw):
    sections = [f.path[0] for f in names_of(raw).values()]
    assert list(dict.fromkeys(sections)) == [
        name for name, section in fields.SECTIONS.items() if not section.absent or name in raw
    ]


def test_structure_sees_shape_not_values(raw):
    def structure(data):
        return fields.structure(load_mapping(data, source="f").model)

    base = structure(raw)
    raw["geometry"]["bore_mm"] = 90.0
    raw["calculation"]["method"] = "exact"
    assert structure(raw) == base
    raw["calculation"]["step_deg"] = 30
    stepped = structure(raw)
    assert stepped != base
    del raw["geometry"]["rod_length_mm"]
    raw["geometry"]["lambda"] = 0.3
    assert structure(raw) != stepped


@pytest.mark.parametrize("sample", list_samples())
def test_mapping_there_and_back(sample):
    model = load_toml(samples_dir() / f"{sample}.toml").model
    mapping = fields.to_mapping(model)
    for field in fields.iter_fields(model):
        fields.set_value(mapping, field.path, field.value)
    assert load_mapping(mapping, source="f").model == model


def test_set_value_reaches_every_depth(raw):
    raw["gas"] = TABLE
    mapping = fields.to_mapping(load_mapping(raw, source="f").model)
    fields.set_value(mapping, ("gas", "points", 1, 1), 0.3)
    fields.set_value(mapping, ("crankshaft", "webs", 2, "mass_kg"), 0.5)
    model = load_mapping(mapping, source="f").model
    assert model.gas.points[1] == (180, 0.3)
    assert model.crankshaft.webs[2].mass_kg == 0.5


def test_one_more_entry_is_the_last_again_or_a_choice_that_is_not_taken() -> None:
    """An empty choice looks like the first one in a list, and is refused."""
    raw = fields.to_mapping(sample("gots-diesel"))
    raw["report"]["chapters"] = ["cycle", "dynamics"]
    more = {group["key"]: group.get("more") for group in groups(raw)}
    assert more["report.chapters"] == "rationale"
    assert more["report.formats"] == "xlsx"
    assert more["crankshaft.webs"] == raw["crankshaft"]["webs"][-1]
    raw["report"]["chapters"] = list(CHAPTERS)
    assert {g["key"]: g.get("more") for g in groups(raw)}["report.chapters"] == ""


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
