"""``round`` in the three engines: as a spreadsheet rounds, halves away from zero."""

from __future__ import annotations

import numpy as np

from reports.formula.excel import compile_formula
from reports.formula.numeric import evaluate
from reports.formula.tex import to_tex


class _Names:
    def name(self, key: str) -> str:
        return key


def test_halves_go_away_from_zero() -> None:
    values = np.array([0.5, 1.5, 2.5, -0.5, -2.5, 87.58, -1.2])
    rounded = evaluate("round(x)", lambda _: values)
    assert rounded.tolist() == [1, 2, 3, -1, -3, 88, -1]


def test_excel_and_tex() -> None:
    assert compile_formula("2*round(x/2)", _Names()) == "=2*ROUND(x/2,0)"
    assert to_tex("round(x)", lambda name: name) == r"\mathrm{окр}\left(x\right)"
