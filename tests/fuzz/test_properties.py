"""Random values in the right places, and random recipes: always a result or a Russian line."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import tomlkit
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from reports.inputs.fields import iter_fields, set_value, to_mapping
from reports.inputs.load import load_toml
from reports.shared.resources import samples_dir
from tests.fuzz.doors import DOORS

SAMPLES = ("gots-diesel", "cycle-turbo-diesel", "yamz-236", "gots-regimes", "gots-p43")


def quick(examples: int) -> settings:
    """The same examples in every run."""
    return settings(
        max_examples=examples, deadline=None, derandomize=True, database=None,
        suppress_health_check=[HealthCheck.too_slow],
    )  # fmt: skip


values = st.one_of(
    st.floats(),
    st.integers(-(10**30), 10**30),
    st.sampled_from([0, 1, -1, 0.0, -0.0, 1e-300, 1e300, 4, 720, "", "four", True]),
    st.text(max_size=20),
    st.booleans(),
    st.lists(st.one_of(st.floats(), st.text(max_size=3), st.lists(st.floats())), max_size=8),
    st.dictionaries(st.text(max_size=5), st.floats(), max_size=3),
)


@lru_cache(maxsize=8)
def paths(name: str) -> list[tuple[str | int, ...]]:
    return [field.path for field in iter_fields(load_toml(samples_dir() / f"{name}.toml").model)]


def mapping(name: str) -> dict[str, Any]:
    return to_mapping(load_toml(samples_dir() / f"{name}.toml").model)


@quick(120)
@given(st.data())
def test_any_value_of_any_key_is_answered(data):
    name = data.draw(st.sampled_from(SAMPLES))
    raw = mapping(name)
    for path in data.draw(st.lists(st.sampled_from(paths(name)), min_size=1, max_size=3)):
        try:
            set_value(raw, path, data.draw(values))
        except (TypeError, KeyError, IndexError):
            continue  # inside of something that was replaced
    try:
        text = tomlkit.dumps(raw)
    except (ValueError, TypeError):
        return
    DOORS["toml"](text.encode("utf-8", "surrogatepass"))


@quick(60)
@given(st.sampled_from(SAMPLES), st.integers(0, 6000), st.integers(0, 400), st.text(max_size=12))
def test_any_cut_in_a_file_is_answered(name, at, length, text):
    data = (samples_dir() / f"{name}.toml").read_bytes()
    DOORS["toml"](data[:at] + text.encode("utf-8", "replace") + data[at + length :])


@quick(12)
@given(st.binary(max_size=60))
def test_any_recipe_for_our_workbook_is_answered(recipe):
    DOORS["workbook"](recipe)


@quick(40)
@given(st.binary(max_size=60))
def test_any_recipe_for_a_students_workbook_is_answered(recipe):
    DOORS["grading"](recipe)
