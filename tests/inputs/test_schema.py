"""The schema of the input file: a validator takes every sample and refuses what kshm refuses."""

from __future__ import annotations

import copy
import json
import tomllib
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from jsonschema import Draft7Validator

from reports.cli import main
from reports.inputs.load import load_text
from reports.inputs.schema import FILE, LINE, input_schema, schema_text
from reports.shared.errors import InputError
from tests.conftest import ROOT, sample_names

SCHEMA = Draft7Validator(input_schema())
BASE = (ROOT / "samples" / "gots-diesel.toml").read_text(encoding="utf-8")


def test_the_schema_is_one() -> None:
    Draft7Validator.check_schema(input_schema())
    assert json.loads(schema_text()) == input_schema()


@pytest.mark.parametrize("name", sample_names())
def test_samples_are_valid(name: str) -> None:
    raw = tomllib.loads((ROOT / "samples" / f"{name}.toml").read_text(encoding="utf-8"))
    assert [error.message for error in SCHEMA.iter_errors(raw)] == []


def with_value(path: str, value: Any) -> dict[str, Any]:
    """The base with a value at a path; None removes it."""
    raw = tomllib.loads(BASE)
    target: Any = raw
    *parts, last = path.split(".")
    for part in parts:
        target = target[int(part)] if part.isdigit() else target.setdefault(part, {})
    if value is None:
        del target[last]
    else:
        target[last] = value
    return raw


WRONG: list[tuple[str, Any]] = [
    ("engine", None), ("geometry", None), ("gas", None), ("masses", None), ("crankshaft", None),
    ("regime", None), ("engine.cylinders", None), ("geometry.bore_mm", None),
    ("regime.speed_rpm", None), ("gas.source", None), ("motor", {}), ("engine.cilinders", 3),
    ("geometry.bore", 88), ("gas.pressure", 1), ("crankshaft.webs.0.mas_kg", 1),
    ("engine.cylinders", 0), ("engine.cylinders", 25), ("engine.cylinders", 2.5),
    ("engine.strokes", 3), ("engine.layout", "w"), ("engine.name", 5), ("geometry.bore_mm", -88),
    ("geometry.bore_mm", 1e6), ("geometry.bore_mm", "широкий"), ("geometry.bore_mm", [88]),
    ("geometry.bore_mm", True), ("gas.source", "steam"), ("calculation.step_deg", 7),
    ("crankshaft.main_lengths_mm", 28), ("crankshaft.webs", {}), ("regime", 4400),
    ("report.year", "нынешний"), ("balance.irregularity", 5), ("checks", {"accepted": [{}]}),
    ("variants", {}), ("regimes", [{"name": "ход", "speed_rpm": 900}]),
]  # fmt: skip


@pytest.mark.parametrize(("path", "value"), WRONG, ids=lambda each: str(each)[:30])
def test_wrong_files_are_invalid(path: str, value: Any) -> None:
    raw = with_value(path, value)
    assert list(SCHEMA.iter_errors(raw))
    with pytest.raises(InputError):
        load_text(toml(raw), source="f")
    assert len(WRONG) >= 30


def toml(raw: dict[str, Any]) -> str:
    import tomlkit

    return tomlkit.dumps(copy.deepcopy(raw))


def test_what_an_editor_shows() -> None:
    bore = input_schema()["properties"]["geometry"]["anyOf"][0]["properties"]["bore_mm"]
    assert bore == {
        "title": "Диаметр цилиндра D, мм", "description": "допустимо от 10 до 1500 мм",
        "type": "number", "minimum": 10, "maximum": 1500,
    }  # fmt: skip
    layout = input_schema()["properties"]["engine"]["properties"]["layout"]
    assert layout["enum"] == ["inline", "v", "opposed"] and "рядный" in layout["description"]


def test_a_new_file_names_the_schema_beside_it(tmp_path: Path) -> None:
    target = tmp_path / "engine.toml"
    for words in (["-o", str(target)], ["--sample", "d-240", "-o", str(tmp_path / "b.toml")],
                  ["--cylinders", "6", "-o", str(tmp_path / "c.toml")]):  # fmt: skip
        assert CliRunner().invoke(main, ["new", *words]).exit_code == 0
        text = Path(words[-1]).read_text(encoding="utf-8")
        assert text.splitlines()[0] == f"#{LINE}"
        assert list(SCHEMA.iter_errors(tomllib.loads(text))) == []
    assert json.loads((tmp_path / FILE).read_text(encoding="utf-8")) == input_schema()
    (tmp_path / FILE).write_text("{}")
    assert CliRunner().invoke(main, ["new", "-o", str(tmp_path / "d.toml")]).exit_code == 0
    assert (tmp_path / FILE).read_text() == "{}"


def test_own_books_have_their_keys(tmp_path: Path) -> None:
    book = tmp_path / "pump.book"
    assert CliRunner().invoke(main, ["new", "--book", str(book)]).exit_code == 0
    from reports.inputs.department_chapters import sections_of

    text = book.read_text(encoding="utf-8")
    own = input_schema((("pump", text),))["properties"]["own"]
    assert list(own["properties"]) == list(sections_of((("pump", text),)))
    said = CliRunner().invoke(main, ["schema"])
    assert json.loads(said.output) == input_schema()
