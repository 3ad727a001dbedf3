"""Revisions of an input are the engines, and the refusals, of files with the same values."""

from __future__ import annotations

import copy
import random

import pytest

from reports.inputs.fields import iter_fields, set_value, to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.revisions import Revisions
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.errors import InputError
from tests.conftest import sample, sample_names

FACTORS = (1.0, 1.03, 0.9, 1.4, 0.3, -1.0, 0.0, 1e4)


def of_a_file(raw, paths, row):
    changed = copy.deepcopy(raw)
    for path, value in zip(paths, row, strict=True):
        set_value(changed, path, value)
    return engine_and_cycle(load_mapping(changed, source="f.toml").model)


def outcome(function, *arguments):
    """Engine and cycle, or the lines of the refusal."""
    try:
        return function(*arguments)
    except InputError as error:
        return [line for line in error.lines() if not line.startswith("Внимание")]


@pytest.mark.parametrize("name", sample_names())
def test_every_revision_is_the_engine_of_its_file(name):
    draw = random.Random(name)
    model = sample(name)
    raw = to_mapping(model)
    fields = [
        field
        for field in iter_fields(model)
        if isinstance(field.value, float) and field.choices is None and not field.structural
    ]
    refused = 0
    for _ in range(3):
        chosen = draw.sample(fields, 3)
        paths = [field.path for field in chosen]
        revisions = Revisions(raw, "f.toml", paths)
        for _ in range(8):
            row = [field.value * draw.choice(FACTORS) for field in chosen]
            wanted = outcome(of_a_file, raw, paths, row)
            assert outcome(revisions.engine, row) == wanted, (paths, row)
            refused += isinstance(wanted, list)
    assert 0 < refused < 24
