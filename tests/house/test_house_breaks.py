"""The list of deliberate breaks is of this code; ``./run breaks`` asks the tests for each."""

from __future__ import annotations

import shlex

import pytest

from tests.breaks.listed import ROOT, Break, breaks


@pytest.mark.parametrize("one", breaks(), ids=lambda one: one.about)
def test_a_break_stands_where_it_is_said_to(one: Break) -> None:
    text = (ROOT / one.file).read_text(encoding="utf-8")
    assert text.count(one.stands) == 1
    assert one.put != one.stands
    paths = [word for word in shlex.split(one.tests) if word.startswith("tests/")]
    assert paths
    assert all((ROOT / path.partition("::")[0]).exists() for path in paths)


def test_there_are_more_than_thirty() -> None:
    assert len(breaks()) >= 32
    assert len({one.stands for one in breaks()}) == len(breaks())
