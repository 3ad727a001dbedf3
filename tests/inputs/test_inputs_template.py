"""The input files that `kshm new` writes."""

import tomllib
from datetime import UTC, datetime

import pytest

from reports.inputs.load import load_text
from reports.inputs.meta import hints
from reports.inputs.registry import SECTIONS
from reports.inputs.template import list_samples, new_file
from reports.shared.errors import InputError
from reports.shared.resources import samples_dir


def test_samples():
    assert list_samples() == (
        "cycle-petrol",
        "cycle-tractor-diesel",
        "cycle-turbo-diesel",
        "cycle-turbo-petrol",
        "d-240",
        "d-240-bearings",
        "d-260",
        "ecoboost-10",
        "gots-appendix1",
        "gots-diesel",
        "gots-p3",
        "gots-p43",
        "gots-regimes",
        "mwm-6",
        "two-stroke",
        "vw-1600",
        "yamz-236",
        "yamz-238",
    )


def test_the_blank_file_explains_every_key():
    text = new_file()
    models = {name: section.model for name, section in SECTIONS.items()}
    for section in SECTIONS:
        for key in hints(models[section]):
            assert key in text
    assert "bore_mm = 88.0 # Диаметр цилиндра D; допустимо от 10 до 1500 мм" in text
    assert "# lambda = …" in text
    assert load_text(text, source="new").warnings == ()


@pytest.mark.parametrize("sample", list_samples())
def test_a_sample_keeps_its_comments_and_data(sample):
    text = new_file(sample)
    original = (samples_dir() / f"{sample}.toml").read_text(encoding="utf-8")
    comments = [line for line in original.splitlines() if "#" in line]
    assert [line for line in text.splitlines() if "#" in line] == comments
    new, old = tomllib.loads(text), tomllib.loads(original)
    assert new.pop("report")["year"] == datetime.now(tz=UTC).year
    del old["report"]
    assert new == old


def test_an_unknown_sample_is_refused():
    with pytest.raises(InputError) as caught:
        new_file("gots-disel")
    (line,) = caught.value.lines()
    assert "нет образца «gots-disel»; возможно, gots-diesel" in line


@pytest.mark.parametrize("name", ["../samples/gots-diesel", "/etc/passwd", "", "gots-diesel.toml"])
def test_a_path_is_no_sample(name):
    with pytest.raises(InputError, match="нет образца"):
        new_file(name)
