"""The engine's page: its numbers are the solver's, its errors stand at their fields."""

from __future__ import annotations

import tomllib
from typing import Any

import numpy as np
import pytest

from kshm import solve
from reports.inputs.load import load_mapping
from reports.inputs.template import list_samples
from reports.inputs.to_si.engine import engine_and_cycle
from reports.web import engine
from tests.web.conftest import Page


@pytest.mark.parametrize("name", ["gots-diesel", "yamz-236", "gots-regimes"])
def test_numbers_are_the_solvers(page: Page, name: str) -> None:
    raw = page.sample(name)
    solution = solve(*engine_and_cycle(load_mapping(raw, source="").model))
    answer = page.post("/api/solve", {"raw": raw, "sheet": "П4.1"})
    for block in answer["results"]:
        for row in block["rows"]:
            assert row["value"] == solution.scalars[row["key"]]
    curves = next(c for c in answer["charts"] if c["id"] == "fig46")["curves"]
    for curve, key in zip(curves, ("Pg_MPa", "Pj_MPa", "Ps_MPa"), strict=False):
        wanted = solution.columns["P4_1"][key]
        np.testing.assert_allclose(curve["y"], wanted, atol=1e-7 * np.abs(wanted).max())
        np.testing.assert_array_equal(curve["x"], solution.columns["P4_1"]["phi_deg"])


@pytest.mark.parametrize("name", ["gots-diesel", "two-stroke", "yamz-236", "vw-1600"])
def test_what_moves_has_a_value_at_every_angle(page: Page, name: str) -> None:
    moves = page.post("/api/solve", {"raw": page.sample(name), "sheet": ""})["moves"]
    phi, s, beta = (np.array(moves[key]) for key in ("turn", "s", "beta"))
    pin = moves["radius"] * np.cos(np.radians(phi))
    drawn = moves["radius"] + moves["rod"] - s - pin  # from crankpin to piston pin along the axis
    np.testing.assert_allclose(drawn, moves["rod"] * np.cos(beta), atol=0.01 * moves["rod"])
    assert len(moves["turn"]) == len(moves["s"]) == len(moves["beta"])
    assert moves["forces"] and moves["throws"][0] == 0
    for force in moves["forces"].values():
        assert len(force["values"]) == len(moves["phi"])


def test_a_change_changes_the_numbers(page: Page) -> None:
    raw = page.sample()
    before = page.post("/api/solve", {"raw": raw, "sheet": ""})["results"]
    raw["geometry"]["bore_mm"] = "90,5"  # as a person types it
    after = page.post("/api/solve", {"raw": raw, "sheet": ""})["results"]
    assert before != after


@pytest.mark.parametrize("name", list_samples())
def test_every_sample_has_fields_sheets_and_a_file(name: str) -> None:
    found = engine.start(engine.fresh({"sample": name})["raw"])
    text = engine.as_toml(found["raw"])["text"]
    assert tomllib.loads(text)
    assert engine.start(engine.read_toml(text)["raw"])["raw"] == found["raw"]
    assert {field["key"] for group in found["groups"] for field in group["fields"]} > {
        "engine.cylinders", "regime.speed_rpm",
    }  # fmt: skip


def _numbers() -> list[tuple[str, str]]:
    found = engine.start(engine.fresh({"sample": "gots-diesel"})["raw"])
    fields = [field for group in found["groups"] for field in group["fields"]]
    return [
        (field["key"], bad)
        for field in fields
        if field["number"] and "[" not in field["key"]
        for bad in ("abc", str(field["max"] * 2 + 1))
    ]


def test_every_fields_error_stands_at_the_field() -> None:
    start = engine.start(engine.fresh({"sample": "gots-diesel"})["raw"])
    keys = {field["key"] for group in start["groups"] for field in group["fields"]}
    cases = _numbers()
    assert len(cases) > 60
    for key, bad in cases:
        section, name = key.split(".")
        raw: dict[str, Any] = {**start["raw"]}
        raw[section] = {**raw[section], name: bad}
        errors = engine.answered(engine.answer, raw, "")["errors"]
        assert key in {error["where"] for error in errors}, (key, bad, errors)
        assert all(error["where"] in keys and error["what"] for error in errors)


@pytest.mark.parametrize(("name", "arms"), [("gots-diesel", "arms"), ("yamz-236", "arms-v")])
def test_drawings_stand_beside_what_they_explain(page: Page, name: str, arms: str) -> None:
    groups = page.post("/api/start", {"raw": page.sample(name)})["groups"]
    drawings = {group["drawing"] for group in groups} - {""}
    assert drawings == {arms, "phases", "signs"}
    for drawing in drawings:
        answer = page.client.get(f"/static/{drawing}.svg")
        assert answer.headers["content-type"] == "image/svg+xml" and "<svg" in answer.text


def test_checks_name_what_the_input_explains(page: Page) -> None:
    checks = {
        each["key"]: each for each in page.post("/api/checks", {"raw": page.sample()})["checks"]
    }
    assert checks["work"]["ok"] and not checks["power"]["ok"] and checks["power"]["reason"]


@pytest.mark.parametrize("cylinders", [1, 4, 8, 12])
def test_an_own_engine(page: Page, cylinders: int) -> None:
    layout = "v" if cylinders == 8 else "inline"
    wanted = {"cylinders": cylinders, "layout": layout, "strokes": "4", "kind": "petrol"}
    raw = page.post("/api/new", wanted)["raw"]
    assert page.post("/api/start", {"raw": raw})["groups"]
    again = page.post("/api/new", {"raw": page.sample(), "cylinders": cylinders})["raw"]
    assert again["engine"]["cylinders"] == cylinders
    assert not page.post("/api/solve", {"raw": again, "sheet": "П4.1"})["errors"]


def test_files_of_the_machine_are_out_of_reach(page: Page) -> None:
    raw = page.sample()
    for key in ("style", "templates", "compare"):
        report = {**raw["report"], key: "/etc/passwd"}
        errors = page.post("/api/solve", {"raw": {**raw, "report": report}, "sheet": ""})["errors"]
        assert [error["where"] for error in errors] == [f"report.{key}"]
    gas = {**raw["gas"], "source": "file", "file": "/etc/passwd"}
    errors = page.post("/api/solve", {"raw": {**raw, "gas": gas}, "sheet": ""})["errors"]
    assert errors[0]["where"] == "gas.source"
