"""Whatever stands in a column costs that column, never another, nor the file."""

from __future__ import annotations

import random
from collections.abc import Iterator

import pytest
import tomlkit

from reports.grading.issuing.assignment import Item
from reports.grading.judging import marking, verdicts
from reports.grading.judging.causes import Causes
from reports.grading.judging.dependencies import GROUND_RULES, GroundRule
from reports.grading.judging.judgement import CARRIED, GROUNDLESS, RIGHT, UNKNOWN
from reports.grading.judging.response import FormulaResponse
from reports.inputs.fields import to_mapping
from reports.shared.resources import samples_dir
from tests.conftest import sample
from tests.cover import ALL, QUICK
from tests.grading.drawn.engine import Engine, base_of
from tests.grading.fill import Formula
from tests.manual.pages import DOCS, blocks

ENTRIES = 4 * 500 if ALL else 60 if QUICK else 500  # on all engines together
AT_ONCE = 1 if ALL else 5  # in one book


def _class() -> Engine:
    text = (samples_dir() / "class" / "base.toml").read_text(encoding="utf-8")
    fill = ("geometry", "masses", "P3_*", "P4_*")
    return Engine(text.replace("step_deg = 10", "step_deg = 30"), fill)


def _v6() -> Engine:
    variants = {"geometry.bore_mm": {"min": 126.0, "max": 134.0, "step": 1.0},
                "regime.speed_rpm": {"min": 1900, "max": 2200, "step": 20}}  # fmt: skip
    fill = ("scheme", "geometry", "masses", "P3_1", "P4_1", "P4_2", "P4_4", "rods_1",
            "balance_orders")  # fmt: skip
    return Engine(base_of("yamz-236", variants), fill)


def _two_stroke() -> Engine:
    variants = {"regime.speed_rpm": {"min": 5000, "max": 5600, "step": 50}}
    fill = ("geometry", "masses", "P4_1", "strength*")
    return Engine(base_of("two-stroke", variants, strength={"kind": "petrol"}), fill)


def _fan() -> Engine:
    (book,) = blocks(DOCS / "own-chapter.md", "book")
    variants = {"regime.speed_rpm": {"min": 4200, "max": 4400, "step": 50}}
    raw = to_mapping(sample("gots-diesel"))
    raw["report"]["books"] = ["вентилятор.book"]
    raw["calculation"]["step_deg"] = 30
    raw["own"] = {"fan": {"blade_mm": 420}}
    return Engine(tomlkit.dumps(raw | {"variants": variants}), ("fan", "geometry", "P3_1"), book)


ENGINES = {"class": _class, "V6": _v6, "two-stroke": _two_stroke, "fan": _fan}
_MADE: dict[str, Engine] = {}


@pytest.fixture(
    params=[pytest.param(n, marks=pytest.mark.xdist_group(f"entries {n}")) for n in ENGINES]
)
def engine(request: pytest.FixtureRequest) -> Engine:
    return _MADE.setdefault(request.param, _MADE.get(request.param) or ENGINES[request.param]())


def drawn(engine: Engine, count: int) -> Iterator[dict[Item, dict[str, list[Formula]]]]:
    """Books with some columns spoilt: every column in turn, in every manner."""
    chance = random.Random(20)
    items: list[Item] = []
    for first in range(0, count, AT_ONCE):
        book: dict[Item, dict[str, list[Formula]]] = {}
        for number in range(first, min(first + AT_ONCE, count)):
            items = items or chance.sample(engine.assignment.items, len(engine.assignment.items))
            item = items.pop()
            book[item] = {n: engine.hand(n, chance).entries(number) for n in item.nodes}
        yield book


def test_what_a_column_holds_costs_no_other(engine: Engine):
    assert {x["verdict"] for x in engine.marked({})["items"]} == {RIGHT}
    nodes_of = {item.id: set(item.nodes) for item in engine.assignment.items}
    ancestors = {item.id: engine.assignment.ancestors(item) for item in engine.assignment.items}
    for book in drawn(engine, ENTRIES // len(ENGINES)):
        changes = {node: cells for nodes in book.values() for node, cells in nodes.items()}
        result = engine.marked(changes)
        said = {node: cells[:2] for node, cells in changes.items()}
        assert result["status"] == "graded", (result.get("reason"), said)
        assert "внутренняя ошибка" not in str(result["items"]), said
        for line in result["items"]:
            if not nodes_of[line["id"]].isdisjoint(changes):
                continue
            follows = not ancestors[line["id"]].isdisjoint(changes)
            allowed = {RIGHT, CARRIED, GROUNDLESS} if follows else {RIGHT}
            assert line["verdict"] in allowed, (line["id"], line["verdict"], line["reason"], said)


def _fails(*_: object) -> None:
    msg = "поломка"
    raise TypeError(msg)


def _right_class() -> Engine:
    return _MADE.setdefault("class", _MADE.get("class") or _class())


@pytest.mark.xdist_group("entries class")
@pytest.mark.parametrize("at", [(Causes, "_common"), (FormulaResponse, "_judged")])
def test_an_error_of_the_program_costs_its_item_a_look(at, monkeypatch: pytest.MonkeyPatch):
    """The formula of P3_1.j is nobody else's: its response is tried, its cause looked for."""
    own, node = getattr(*at), "P3_1.j_m_s2"

    def failing(self: object, first: object, *others: object) -> object:
        item = first if isinstance(first, Item) else first.item  # type: ignore[attr-defined]
        return _fails() if item.id == node else own(self, first, *others)

    monkeypatch.setattr(*at, failing)
    engine = _right_class()
    result = engine.marked({node: [f"={str(f)[1:]}*7+3" for f in engine.right[node]]})
    lines = {line["id"]: line for line in result["items"]}
    assert result["status"] == "graded"
    assert lines[node]["verdict"] == UNKNOWN and "TypeError: поломка" in lines[node]["reason"]
    assert {x["verdict"] for i, x in lines.items() if i != node} <= {RIGHT, CARRIED}
    assert any(lines[node]["label"] in text for text in result["manual"])


@pytest.mark.xdist_group("entries class")
@pytest.mark.parametrize("name", ["altered", "formula_marks", "GROUND_RULES"])
def test_an_error_about_the_whole_work_costs_the_work_a_look(
    name: str, monkeypatch: pytest.MonkeyPatch
):
    if name == "GROUND_RULES":
        monkeypatch.setattr(verdicts, name, (GroundRule("поломка", _fails), *GROUND_RULES))
    else:
        monkeypatch.setattr(marking, name, _fails)
    engine = _right_class()
    node = "P3_1.v1_m_s"
    result = engine.marked({node: [1000] * len(engine.right[node])})
    said = {line["id"]: line["verdict"] for line in result["items"] if line["verdict"] != RIGHT}
    assert said[node] == "wrong" and set(said.values()) <= {"wrong", CARRIED}
    assert any("TypeError: поломка" in text for text in result["doubts"])
