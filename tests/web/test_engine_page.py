"""The engine's page: its numbers are the solver's, its errors stand at their fields."""

from __future__ import annotations

import re
import struct
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kshm import solve
from reports.inputs.form_fields import Data
from reports.inputs.load import load_mapping, load_remote
from reports.inputs.sections.input_file import InputFile
from reports.inputs.template import list_samples
from reports.inputs.to_si.engine import engine_and_cycle
from reports.live import describe
from reports.model.evaluation import Evaluation
from reports.shared.errors import InputError
from reports.tables.registry import kept_model
from reports.web import engine
from tests.web.conftest import Page


def fields(start: dict[str, Any]) -> list[dict[str, Any]]:
    """All fields that the page shows, those of lists among them."""
    return [field for group in start["groups"] for entry in group["entries"] for field in entry]


def curves(raw: dict[str, Any]) -> tuple[InputFile, Data, Evaluation]:
    """An engine with what its mechanism is drawn from: the book's step, the book's formulas."""
    model = describe.with_joints(kept_model(load_remote(raw).model))
    return model.input, describe.scene(model), Evaluation(model)


def articulated() -> dict[str, Any]:
    """A V engine whose right rods hang on the left ones."""
    raw = engine.fresh({"sample": "yamz-236"})["raw"]
    rod = {"rod_length_mm": 170, "radius_mm": 60, "angle_deg": 90, "reciprocating_kg": 3.4,
           "big_end_kg": 1.1}  # fmt: skip
    return {**raw, "articulated": rod}


NAMES = ("gots-diesel", "two-stroke", "yamz-236", "vw-1600", "ecoboost-10")
ENGINES = {name: engine.fresh({"sample": name})["raw"] for name in NAMES}


@pytest.mark.parametrize("name", [*ENGINES, "articulated"])
def test_the_drawn_rods_keep_their_lengths(name: str) -> None:
    model, scene, evaluation = curves(ENGINES.get(name) or articulated())
    built, solution = engine_and_cycle(model)[0], solve(*engine_and_cycle(model))
    for number in (0, built.cylinders - 1):
        one = scene["each"][number]
        crank, *middle, piston = (np.array([evaluation.value(key) for key in joint])
                                  for joint in scene["joints"][one["rod"]])  # fmt: skip
        hung = built.arrangement[number].master is not None
        assert bool(middle) == hung
        radius, rod = 1000 * built.geometry.crank_radius, 1000 * built.geometry.rod_length
        np.testing.assert_allclose(np.hypot(*crank), radius, rtol=1e-6)
        np.testing.assert_allclose(piston[0], 1000 * built.geometry.offset, atol=1e-6)
        if hung:
            np.testing.assert_allclose(np.hypot(*(middle[0] - crank)), 60, rtol=1e-6)
            np.testing.assert_allclose(np.hypot(*(piston - middle[0])), 170, rtol=1e-6)
        else:
            np.testing.assert_allclose(np.hypot(*(piston - crank)), rod, rtol=1e-6)
        table = scene["tables"][number]
        for key in scene["forces"]:
            wanted = solution.columns[table][key]
            actual = evaluation.value(f"{table}.{key}")
            np.testing.assert_allclose(actual, wanted, atol=1e-7 * np.abs(wanted).max())


def test_the_cursor_on_a_wear_diagram_is_where_the_force_acts() -> None:
    raw = ENGINES["gots-diesel"]
    solution = solve(*engine_and_cycle(load_mapping(raw, source="").model))
    model = kept_model(load_remote(raw).model)
    for sheet, table in (("Износ ш.ш", "table_14"), ("Износ к.ш (2)", "table_14_main_2")):
        (chart,) = (each for each in describe.charts(model) if each["sheet"] == sheet)
        x, y = (sign * Evaluation(model).value(key) for key, sign in chart["contact"])
        x, y = np.array([x, y]) / np.maximum(np.hypot(x, y), 1e-12)
        counted = solution.columns[table]
        for i, ray in enumerate(key for key in counted if key != "phi_deg"):
            turn = np.radians(i * 360 / 12)
            towards = -(x * np.sin(turn) + y * np.cos(turn))  # the worn side is opposite the ray
            certain = np.abs(towards - 0.5) > 1e-6
            np.testing.assert_array_equal((counted[ray] > 0)[certain], (towards > 0.5)[certain])


def test_what_only_a_build_finds_comes_when_a_person_pauses(page: Page) -> None:
    raw = page.sample()
    before = page.post("/api/settle", {"raw": raw})
    raw["geometry"]["bore_mm"] = "90,5"  # as a person types it
    after = page.post("/api/settle", {"raw": raw})
    assert before["built"].keys() == after["built"].keys() and before["built"] != after["built"]
    assert before["remarks"]


@pytest.mark.parametrize("name", list_samples())
def test_every_sample_has_fields_sheets_in_words_and_a_file(name: str, tmp_path: Path) -> None:
    actual = engine.start(engine.fresh({"sample": name})["raw"])
    text = engine.as_toml(actual["raw"])["text"]
    assert tomllib.loads(text)
    file = tmp_path / "engine.toml"
    file.write_text(text, encoding="utf-8")
    assert engine.start(engine.read_toml(str(file))["raw"])["raw"] == actual["raw"]
    assert all(
        each["heading"] != each["title"] or not re.match(r"П\d", each["title"])
        for each in actual["engine"]["sheets"]
    )
    assert {field["key"] for field in fields(actual)} > {
        "engine.cylinders", "regime.speed_rpm",
    }  # fmt: skip


def _numbers() -> list[tuple[str, str]]:
    actual = engine.start(engine.fresh({"sample": "gots-diesel"})["raw"])
    return [
        (field["key"], bad)
        for field in fields(actual)
        if field["number"] and "[" not in field["key"]
        for bad in ("abc", str(field["max"] * 2 + 1))
    ]


def test_every_fields_error_stands_at_the_field() -> None:
    start = engine.start(engine.fresh({"sample": "gots-diesel"})["raw"])
    keys = {field["key"] for field in fields(start)}
    cases = _numbers()
    assert len(cases) > 60
    for key, bad in cases:
        section, name = key.split(".")
        raw: dict[str, Any] = {**start["raw"]}
        raw[section] = {**raw[section], name: bad}
        with pytest.raises(InputError) as actual:
            engine.settle(raw)
        errors = actual.value.problems
        assert key in {error.where for error in errors}, (key, bad, errors)
        assert all(error.where in keys and error.what for error in errors)


@pytest.mark.parametrize(("name", "arms"), [("gots-diesel", "arms"), ("yamz-236", "arms-v")])
def test_drawings_stand_beside_what_they_explain(page: Page, name: str, arms: str) -> None:
    groups = page.post("/api/start", {"raw": page.sample(name)})["groups"]
    drawings = {group.get("drawing") for group in groups} - {"", None}
    assert drawings == {arms, "phases", "signs"}
    for drawing in drawings:
        answer = page.client.get(f"/images/{drawing}.svg")
        assert answer.headers["content-type"] == "image/svg+xml" and "<svg" in answer.text


@pytest.mark.parametrize("cylinders", [1, 4, 8, 12])
def test_an_own_engine(page: Page, cylinders: int) -> None:
    layout = "v" if cylinders == 8 else "inline"
    wanted = {"cylinders": cylinders, "layout": layout, "strokes": "4", "kind": "petrol",
              "power": f"{20 * cylinders},5", "speed": ""}  # fmt: skip
    raw = page.post("/api/new", wanted)["raw"]
    assert page.post("/api/start", {"raw": raw})["groups"]
    again = page.post("/api/new", {"raw": page.sample(), "cylinders": cylinders})["raw"]
    assert again["engine"]["cylinders"] == cylinders
    assert page.post("/api/start", {"raw": again})["engine"]["charts"]


@pytest.mark.parametrize(
    ("wanted", "said"),
    [
        ({"cylinders": 5, "layout": "opposed"}, "«Цилиндров»"),
        ({"cylinders": 99}, "«Цилиндров»"),
        ({"cylinders": 4, "power": "-5"}, "«Мощность»"),
        ({"cylinders": 4, "power": "abc"}, "«Мощность»"),
        ({"cylinders": 4, "speed": "x"}, "«Частота»"),
        ({"cylinders": 5, "layout": "v", "raw": {}}, "engine"),
    ],
)
def test_an_engine_that_cannot_be_is_refused_in_the_words_of_the_form(
    page: Page, wanted: dict[str, Any], said: str
) -> None:
    errors = page.post("/api/new", wanted)["errors"]
    words = " ".join(part for error in errors for part in error.values())
    assert said in words
    assert "--" not in words and "ключ для" not in words and "команда" not in words


def test_files_of_the_machine_are_out_of_reach(page: Page) -> None:
    raw = page.sample()
    for key in ("style", "templates", "compare"):
        report = {**raw["report"], key: "/etc/passwd"}
        errors = page.post("/api/settle", {"raw": {**raw, "report": report}})["errors"]
        assert [error["where"] for error in errors] == [f"report.{key}"]
    gas = {**raw["gas"], "source": "file", "file": "/etc/passwd"}
    errors = page.post("/api/settle", {"raw": {**raw, "gas": gas}})["errors"]
    assert errors[0]["where"] == "gas.source"


def test_a_link_to_the_page_has_a_preview(page: Page) -> None:
    text = page.client.get("/").text
    assert 'property="og:title" content="Кривошипно-шатунный механизм' in text
    (address,) = re.findall(r'property="og:image" content="([^"]+)"', text)
    assert address.startswith("http://127.0.0.1:8321/")  # whole: who previews knows no other
    answer = page.client.get(address)
    assert answer.headers["content-type"] == "image/png"
    assert struct.unpack(">II", answer.content[16:24]) == (1200, 630)
