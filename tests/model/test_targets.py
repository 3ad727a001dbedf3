"""A function of the language has a meaning in each of its targets."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reports.formula.excel import compile_formula
from reports.formula.javascript import KNOWN, LIBRARY, columns_script, value_script
from reports.formula.numeric import evaluate
from reports.formula.parse import AGGREGATES, FUNCTIONS, SCALE_FUNCTIONS, SHIFTS
from reports.formula.plain import plain

ALL = sorted({*FUNCTIONS, *AGGREGATES, *SCALE_FUNCTIONS, *SHIFTS})
COLUMN = np.array([1.0, 2.0, 3.0])


class Cells:
    """A layout in which everything has a cell."""

    def __getattr__(self, name: str) -> Any:
        return lambda *_, **__: ["$A$1"] if name == "each" else "$A$1"


@pytest.mark.parametrize("name", ALL)
def test_each_target_has_the_function(name: str) -> None:
    least, most = FUNCTIONS.get(name, (1, 1))
    for count in {least, min(most, 3)}:
        first = {"place": 1, "rank": 1}.get(name, 0)
        last = count - 1 if name.startswith(("wave", "fourier")) else first + 1
        names = ["run" if first <= at < last else "0.5" for at in range(count)]
        text = f"{name}({', '.join(names)})"
        assert np.isfinite(np.asarray(evaluate(text, lambda _: COLUMN), dtype=float)).any()
        assert compile_formula(text, Cells()).startswith("=")  # type: ignore[arg-type]
        assert plain(text, str)
        assert columns_script([text], ["T.out"], str, lambda _: True).text
        if name not in SHIFTS:
            assert value_script(text, str).text


def test_javascript_has_no_function_of_its_own() -> None:
    assert sorted(KNOWN) == ALL
    called = LIBRARY.read_text("utf-8")
    for name in KNOWN & (AGGREGATES | SHIFTS | {"place", "rank", "element", "fourier_cos"}):
        assert f"{name}:" in called
