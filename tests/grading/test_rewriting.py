"""Formulas rewritten with one usual mistake: the mistake and nothing else."""

from __future__ import annotations

import ast

import pytest

from reports.grading.judging.rewriting import Flipped


@pytest.mark.parametrize(
    ("number", "wanted"),
    [
        (0, "-a + b - (c + d) * e"),
        (1, "-a - b - (c - d) * e"),
        (2, "-a - b + (c + d) * e"),
        (3, "-a - b - (c + d) * e"),
    ],
)
def test_the_sign_of_one_sum_is_turned(number: int, wanted: str) -> None:
    found = Flipped(number).visit(ast.parse("-a - b - (c + d) * e", mode="eval"))
    assert ast.unparse(found) == wanted
