"""Formulas that tell cases apart: lists of numbers, or honest ones with a mistake among them."""

from __future__ import annotations

import pytest

from tests.grading.test_verdicts import formulas, graded, line

V1 = "P3_1.v1_m_s"


def written(case: str) -> list[str]:
    """The column by quarters of a turn: ``@`` is the textbook's formula, ``{r}`` the row."""
    return [
        "=" + case.replace("{r}", str(row)).replace("@", text[1:])
        for row, text in enumerate(formulas()[V1], 6)
    ]


@pytest.mark.parametrize(
    ("case", "share"),
    [
        ("IF(A{r}=0,0,IF(A{r}=90,r_crank*omega,IF(A{r}=180,0,IF(A{r}=270,-r_crank*omega,"
         "IF(A{r}=360,0,@)))))", 1),
        ("IF(A{r}=0,0,IF(A{r}=90,r_crank*omega,IF(A{r}=180,0,IF(A{r}=270,-r_crank*omega,"
         "IF(A{r}=360,0,-@)))))", 0),
        ("IF(INT(A{r}/90)=0,@,IF(INT(A{r}/90)=1,-@,IF(INT(A{r}/90)=2,@,IF(INT(A{r}/90)=3,@,"
         "IF(INT(A{r}/90)=4,@,0)))))", 10 / 13 / 2),
    ],
)  # fmt: skip
def test_cases_with_formulas_in_them_are_no_list_of_numbers(case: str, share: float) -> None:
    """Of five cases one is wrong: the column was called ready numbers, and earned nothing."""
    found = line(graded({V1: written(case)}), V1)
    assert found["verdict"] == ("right" if share == 1 else "wrong")
    assert found["points"] == pytest.approx(found["of"] * share, abs=1e-5)
    assert found["reason"] == ""
