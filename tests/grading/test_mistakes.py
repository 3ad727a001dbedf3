"""Formulas rewritten with one usual mistake: the mistake and nothing else."""

from __future__ import annotations

import ast

import pytest

from reports.grading.judging.rewriting import (
    Divided,
    DoubleAngle,
    Flipped,
    OtherExponent,
    OtherRatio,
    Swapped,
    WithoutPowers,
    WithoutSummand,
    otherwise,
)


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
    actual = Flipped(number, ast.Add, ast.Sub).visit(ast.parse("-a - b - (c + d) * e", mode="eval"))
    assert ast.unparse(actual) == wanted


def test_the_arguments_are_swapped_with_the_conditions_or_without() -> None:
    text = "0 if a == 0 else 90 if b == 0 else deg(atan2(a, b))"
    tree = ast.parse(text, mode="eval").body
    assert ast.unparse(Swapped().visit(otherwise(tree))) == "deg(atan2(b, a))"


def test_exponents_are_one_more_or_less_and_brackets_lose_theirs() -> None:
    def rewritten(change: ast.NodeTransformer) -> str:
        return ast.unparse(change.visit(ast.parse("a**n + b**(n - 1) + (c - d)**2", mode="eval")))

    assert rewritten(OtherExponent(more=True)) == "a ** n + b ** n + (c - d) ** 2"
    assert rewritten(OtherExponent(more=False)) == "a ** (n - 1) + b ** (n - 1) + (c - d) ** 2"
    assert rewritten(WithoutPowers()) == "a ** n + b ** (n - 1) + (c - d)"


def test_a_summand_is_left_out_where_there_is_one() -> None:
    """Formulas of one item may have more of them or fewer."""
    collected = [ast.unparse(WithoutSummand(1).changed(ast.parse(text, mode="eval").body))
             for text in ("a - b + c", "a", "a / (b - 1) ** (n - 1)")]  # fmt: skip
    assert collected == ["a - 0 + c", "a", "a / (b - 0) ** (n - 1)"]


@pytest.mark.parametrize(
    ("number", "wanted"),
    [(None, "sin(a) / cos(sin(b))"), (0, "sin(a) / sin(cos(b))"), (2, "cos(a) / cos(cos(b))")],
)
def test_sine_and_cosine_are_taken_for_each_other(number: int | None, wanted: str) -> None:
    actual = OtherRatio(number).visit(ast.parse("cos(a) / sin(cos(b))", mode="eval"))
    assert ast.unparse(actual) == wanted


def test_an_angle_is_doubled_again_and_a_name_is_divided() -> None:
    def rewritten(change: ast.NodeTransformer) -> str:
        return ast.unparse(change.visit(ast.parse("cos(a) + lam * cos(2 * a)", mode="eval")))

    assert rewritten(DoubleAngle()) == "cos(a) + lam * cos(2.0 * (2 * a))"
    assert rewritten(Divided("lam", 4)) == "cos(a) + lam / 4 * cos(2 * a)"
