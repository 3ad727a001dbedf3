"""Numbers that a spreadsheet has taken for texts or dates: paid as numbers, or a person looks."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

import numpy as np
import pytest

from reports.grading.issuing.rubric import Formulas
from reports.grading.judging.marking import Marker
from reports.grading.reading.selfcheck import findings
from reports.grading.reading.submissions import Submission
from reports.grading.reading.typed import carried, number_of
from reports.model.evaluation import evaluate_model
from tests.grading import classroom
from tests.grading.fill import filled_book
from tests.grading.test_verdicts import formulas, graded, line

SPEED = "P3_1.v1_m_s"


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("12,5", 12.5), ("12.5", 12.5), ("\u00a012,5\u202f", 12.5), ("−12,5 Н", -12.5),
        ("1 234,5 Н·м", 1234.5), ("1\u00a0234", 1234.0), ("460,8 рад/с", 460.8), ("1,5e-3", 1.5e-3),
        ("30°", 30.0), ("5 м/с²", 5.0), (",5", 0.5), ("12", 12.0), ("2,5кН", 2.5),
        ("", None), ("-", None), ("Н", None), ("12,5 %", None), ("1.234,5", None),
        ("1,234.5", None),
        ("12 34", None), ("1.5.2026", None), ("10:30", None), ("12,5=", None), ("≈12", None),
        ("не знаю", None), ("1/2", None), ("12 и ещё немного о том о сём", None),
    ],
)  # fmt: skip
def test_a_number_is_read_as_people_write_it(text: str, number: float | None) -> None:
    assert number_of(text) == number


def right(key: str) -> list[float]:
    values = evaluate_model(classroom.assignment().model).columns["P3_1"][key]
    return [round(float(value), 2) for value in np.asarray(values)]


@pytest.mark.parametrize("written", ["{}", "{}\u00a0", "{} м/с", "\u2009{} m/s"])
@pytest.mark.parametrize("point", ",.")
def test_a_number_as_a_text_is_worth_a_number(written: str, point: str) -> None:
    numbers = graded({SPEED: right("v1_m_s")})
    texts = [written.format(f"{value:.2f}".replace(".", point)) for value in right("v1_m_s")]
    result = graded({SPEED: texts})
    actual = line(result, SPEED)
    assert (actual["verdict"], actual["points"]) == ("typed", line(numbers, SPEED)["points"])
    assert actual["reason"] == "число записано текстом: таблица с ним не считает"
    assert set(classroom.verdicts(result).values()) <= {"typed", "carried"}
    wrong = [text.replace("1", "7") for text in texts]
    assert line(graded({SPEED: wrong}), SPEED)["points"] == 0


def test_one_text_among_formulas_costs_what_a_number_does() -> None:
    built = formulas()[SPEED]
    value = right("v1_m_s")[3]
    one = graded({SPEED: [*built[:3], value, *built[4:]]})
    text = graded({SPEED: [*built[:3], str(value).replace(".", ","), *built[4:]]})
    assert line(text, SPEED)["points"] == line(one, SPEED)["points"]
    assert "текстом" in line(text, SPEED)["reason"] and not line(one, SPEED)["reason"]


@pytest.mark.parametrize("text", ["460,77 рад/с", "=regime_speed_rpm*ПИ()/30"])
def test_a_text_costs_nothing_after_it(text: str) -> None:
    """What follows shows #ЗНАЧ! in Excel, and its formulas are right."""
    result = graded({"omega": [text]})
    worth = line(result, "geometry.omega")["of"]
    assert result["points"] >= 100 - worth - 0.01
    assert set(classroom.verdicts(result).values()) <= {"typed", "wrong", "unknown", "carried"}


@pytest.mark.parametrize(
    ("cells", "why"),
    [
        ([datetime(2026, 5, 1)], "дата"), ([datetime(1983, 10, 1)], "дата"),
        ([" =r_crank*omega"], "формула записана текстом"),
    ],
)  # fmt: skip
def test_what_is_no_number_any_more_is_for_a_person(cells: list[object], why: str) -> None:
    built = formulas()[SPEED]
    result = graded({SPEED: [*built[:3], *cells, *built[4:]]})
    actual = line(result, SPEED)
    assert (actual["verdict"], actual["points"]) == ("unknown", 0)
    assert why in actual["reason"] and actual["rows"] == ["90"]
    assert result["manual"]


def test_a_right_number_that_looks_like_a_date_is_a_number() -> None:
    """The look of a cell is no value: 12,345 m/s² in a cell of dates are m/s²."""
    force = "P3_1.j_m_s2"
    values = [float(round(v)) for v in right("j_m_s2")]
    assert max(values) > 10_000

    def dated(book, layout) -> None:
        table, column = layout.columns[force]
        for row in layout.rows_of(table):
            book[table.sheet].cell(row, column).number_format = "dd.mm.yy"

    plain, shown = graded({force: values}), graded({force: values}, dated)
    assert line(shown, force)["verdict"] == line(plain, force)["verdict"] == "typed"


def test_where_no_formula_is_demanded_a_text_is_paid_as_a_number() -> None:
    register = classroom.register()
    free = register.rubric.model_copy(update={"formulas": Formulas(required=False)})
    marker = Marker(type(register)(**{**vars_of(register), "rubric": free}))
    for cells, verdict in (
        ([f"{value:.2f}" for value in right("v1_m_s")], "right"),
        ([datetime(2026, 5, 1) for _ in right("v1_m_s")], "unknown"),
    ):
        book = filled_book(classroom.handout(), classroom.assignment(), {SPEED: cells})
        result = marker.mark(Submission("1.xlsx", Path("1.xlsx"), None, None), book)
        assert line(result, SPEED)["verdict"] == verdict


def vars_of(register) -> dict:
    return {name: getattr(register, name) for name in register.__dataclass_fields__}


def test_a_student_is_told_before_handing_in(tmp_path: Path) -> None:
    built = formulas()[SPEED]
    odd = ["1,5", datetime(2026, 5, 1), " =1+1", "нет"]
    path = tmp_path / "моя.xlsx"
    changes = {SPEED: [*odd, *built[4:]]}
    path.write_bytes(filled_book(classroom.handout(), classroom.assignment(), changes))
    assert [collected.what for collected in findings(path)][:4] == [
        "текст вместо числа: П3.1!E9",
        "число записано текстом: таблица с ним не считает: П3.1!E6",
        "вместо числа стоит дата: 1.5 таблица приняла за первое мая: П3.1!E7",
        "формула записана текстом: таблица её не считает: П3.1!E8",
    ]


@pytest.mark.parametrize(
    ("text", "number"),
    [("123", None), ("1234", 1234.0), ("x12 y34", 1234.0),
     ("x" * 99, None), ("x" * 120, 120.5)],  # of a long one its length, which is no angle
)  # fmt: skip
def test_a_text_of_four_digits_carries_a_number(text, number):
    assert carried(text) == number
