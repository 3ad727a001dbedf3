"""The prototype that a new engine gets: the nearest sample, named, kept by an alternative."""

import tomllib

import pytest

from reports.inputs.load import load_mapping, load_text
from reports.new.generate import file_text, generate_engine
from reports.new.scale_engine import alternative
from reports.shared.resources import samples_dir
from tests.document.test_report_sentences import text_of


@pytest.mark.parametrize(
    ("task", "near"),
    [
        ({"cylinders": 4, "kind": "diesel", "bore_mm": 110.0, "stroke_mm": 125.0}, "d-240"),
        ({"cylinders": 4, "kind": "diesel", "bore_mm": 105.0, "stroke_mm": 120.0}, "d-240"),
        ({"cylinders": 6, "layout": "v", "kind": "diesel", "bore_mm": 130.0, "stroke_mm": 140.0},
         "yamz-236"),
        ({"cylinders": 4, "kind": "diesel", "bore_mm": 80.0, "stroke_mm": 125.0}, None),
        ({"cylinders": 4, "kind": "petrol", "bore_mm": 110.0, "stroke_mm": 125.0}, None),
        ({"cylinders": 12, "layout": "v", "kind": "diesel", "bore_mm": 300.0, "stroke_mm": 300.0},
         None),
    ],
)  # fmt: skip
def test_the_nearest_sample_is_the_prototype(task, near):
    text = file_text(generate_engine(**task))
    data = tomllib.loads(text)
    if near is None:
        assert "prototype" not in data
        return
    sample = tomllib.loads((samples_dir() / f"{near}.toml").read_text(encoding="utf-8"))
    assert data["prototype"]["name"] == sample["engine"]["name"]
    assert data["prototype"]["bore_mm"] == sample["geometry"]["bore_mm"]
    assert f"по образцу {near}" in text
    model = load_text(text, source="own.toml").model
    assert model.prototype.description.endswith(f"Данные — по образцу {near}.")


def test_an_alternative_keeps_the_prototype():
    engine = generate_engine(4, kind="diesel", bore_mm=110.0, stroke_mm=125.0)
    model = load_mapping(engine.data, source="own.toml").model
    other = load_text(file_text(alternative(model, 6)), source="six.toml").model
    assert other.prototype == model.prototype


@pytest.mark.usefixtures("nothing_is_drawn")
def test_the_note_describes_the_prototype():
    engine = generate_engine(4, kind="diesel", bore_mm=110.0, stroke_mm=125.0)
    raw = engine.data | {"report": {"detail": "course"}}
    text = text_of(load_mapping(raw, source="own.toml").model)
    assert "Прототип — рядный четырёхтактный четырёхцилиндровый дизель. Вал: колен 4" in text
    assert "коренных шеек 5" in text and "Данные — по образцу d-240." in text
