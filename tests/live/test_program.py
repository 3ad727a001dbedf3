"""The numbers of JavaScript are those of numpy, as built and after every input has changed."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from reports.live.program import program_of
from reports.model.evaluation import Evaluation
from reports.tables.registry import build_model
from tests.cover import engines_with, model_of, operations, quantities
from tests.live.node import calculated, distance
from tests.referee.changes import changed_everywhere

NEAR = 1e-9


@pytest.mark.parametrize("name", engines_with(operations, quantities))
def test_javascript_finds_what_numpy_finds(name: str, tmp_path: Path) -> None:
    model = model_of(name)
    program = program_of(model, model.nodes)
    changes, changed = changed_everywhere(model.input, random.Random(name), 0.02)
    edit = {
        change.field.name: (change.field.choices or {}).get(str(change.value), change.value)
        for change in changes
    }
    actual, after = calculated(program, tmp_path, [edit])["found"]
    first, second = Evaluation(model), Evaluation(build_model(changed))
    worst = {key: distance(first.value(key), actual[key]) for key in model.nodes}
    assert {key: far for key, far in worst.items() if far > NEAR} == {}
    worst = {
        key: distance(second.value(key), after[key]) for key in model.nodes
        if key not in program.fixed
    }  # fmt: skip
    assert {key: far for key, far in worst.items() if far > NEAR} == {}
    moved = [key for key in worst if distance(first.value(key), after[key]) > NEAR]
    assert len(moved) > len(worst) / 2


def test_only_what_the_program_alone_can_find_is_fixed() -> None:
    fixed = program_of(model_of("gots-diesel"), ()).fixed
    assert {key.partition(".")[0] for key in fixed if "." in key} == {"inertia", "inertia_steps"}
    assert len(fixed) < 12
