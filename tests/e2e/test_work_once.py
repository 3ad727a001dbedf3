"""One build solves each grid once and writes each page once, whatever is asked for."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

from reports.document import report
from reports.exports.build import build, load_input
from reports.inputs import solve_input
from reports.inputs.sections.report import Format
from reports.model import evaluation
from reports.shared.resources import samples_dir


@pytest.fixture
def counted(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    count: Counter[str] = Counter()

    def count_calls(module: object, name: str) -> None:
        usual = getattr(module, name)

        def counting(*args: object, **kwargs: object) -> object:
            count[name] += 1
            return usual(*args, **kwargs)

        monkeypatch.setattr(module, name, counting)

    count_calls(report, "_write")
    count_calls(solve_input, "solve")
    count_calls(evaluation, "evaluate_model")
    solve_input._solution.cache_clear()
    return count


@pytest.mark.parametrize(
    ("kinds", "written"),
    [
        (("xlsx",), 0),
        # The draft, what the chapters left out would hold, the one page of PDF and Word.
        pytest.param(("xlsx", "pdf", "docx"), 3, marks=pytest.mark.slow),
    ],
)
def test_build(kinds: tuple[Format, ...], written: int, counted: Counter[str], tmp_path: Path):
    source = samples_dir() / "two-stroke.toml"
    build(source, load_input(source), tmp_path, kinds)
    assert counted["_write"] == written
    assert counted["solve"] == 2  # on the grid of the tables and at one degree
    assert counted["evaluate_model"] == 1
