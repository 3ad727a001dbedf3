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
    packed = state["engine"]
    (sheet,) = (each for each in packed["sheets"] if each["title"] == "Вентилятор")
    assert (sheet["heading"], sheet["chapter"]) == ("Вентилятор системы охлаждения",
                                                    "Расчёты кафедры")  # fmt: skip
    fan = next(block for block in sheet["blocks"] if block["id"] == "fan")
    assert fan["title"] == "Вентилятор"
    assert {"power_fan", "tip_fan"} <= set(packed["program"]["keys"])
    (chart,) = (each for each in packed["charts"] if each["sheet"] == "Вентилятор")
    assert chart["title"] != ""
    assert any(check["key"].endswith("fan_tip") for check in packed["checks"])


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
