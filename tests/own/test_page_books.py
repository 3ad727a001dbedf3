"""Own books on the engine page: numbers, sheets, and what a visitor learns of a wrong name."""

from __future__ import annotations

from pathlib import Path

import pytest

from reports.inputs.fields import to_mapping
from reports.web import engine
from tests.conftest import sample
from tests.own.test_book_mistakes import with_table


@pytest.fixture
def shelf(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("KSHM_BOOKS", str(tmp_path))
    (tmp_path / "к.book").write_text(with_table(), encoding="utf-8")
    return tmp_path


def raw_of(name: str) -> dict[str, object]:
    raw = to_mapping(sample("gots-diesel"))
    raw["report"]["books"] = [name]
    return raw


def test_own_numbers_stand_among_the_results(shelf: Path):
    state = engine.start(raw_of("к.book"))
    assert state["errors"] == []
    assert ("Вентилятор", "Вентилятор системы охлаждения", "Расчёты кафедры") in state["sheets"]
    answer = engine.answer(state["raw"], "Вентилятор")
    (fan,) = (block for block in answer["results"] if block["id"] == "fan")
    assert [row["key"] for row in fan["rows"]] == ["power_fan", "tip_fan"]
    assert fan["title"] == "Вентилятор" and all(row["value"] > 0 for row in fan["rows"])
    (chart,) = answer["charts"]
    assert chart["curves"][0]["name"] != ""
    checks = engine.answer(state["raw"], None)["checks"]
    assert "fan_tip" in [check["key"] for check in checks]


@pytest.mark.parametrize("name", ["нет.book", "folder.book", "tar.book"])
def test_a_wrong_book_is_told_by_its_name_alone(name: str, shelf: Path):
    (shelf / "folder.book").mkdir()
    (shelf / "tar.book").write_bytes(b"\0" * 2_000_000)
    (problem,) = engine.start(raw_of(name))["errors"]
    assert name in problem["where"]
    assert str(shelf) not in str(problem) and shelf.name not in str(problem)


def test_a_fault_of_a_book_is_told_on_the_page(shelf: Path):
    (shelf / "к.book").write_text(with_table("show nobody\n"), encoding="utf-8")
    (problem,) = engine.start(raw_of("к.book"))["errors"]
    assert problem["where"].startswith("к.book: строка ")
