"""Verdicts on single defects: each is found, and nothing else is."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from openpyxl import Workbook

from kshm.nomenclature.quantity import quantity
from reports.grading.issuing.rubric import ToleranceRules
from reports.grading.judging import marking
from reports.grading.judging.trial_evaluation import trials_of
from reports.grading.judging.verdicts import tolerance
from reports.grading.reading.submissions import Submission
from reports.model.evaluation import Evaluation, evaluate_model
from reports.workbook.layout import Layout
from tests.grading import classroom
from tests.grading.fill import filled_book, solved_formulas
from tests.grading.forms import insert
from tools.referees.by_libreoffice import LibreOffice


def formulas() -> dict[str, list[str]]:
    assignment = classroom.assignment()
    return solved_formulas(assignment, Layout.of(assignment.model))  # type: ignore[return-value]


def graded(changes=None, edit=None):
    data = filled_book(classroom.handout(), classroom.assignment(), changes, edit)
    result = classroom.marks(data)
    assert result["status"] == "graded", result
    return result


def line(result, item):
    return next(line for line in result["items"] if line["id"] == item)


def test_a_right_book_is_right_throughout():
    result = graded()
    assert classroom.verdicts(result) == {}
    assert result["points"] == 100
    assert result["manual"] == result["notes"] == result["changed"] == result["altered"] == []


def test_few_digits_of_pi_cost_nothing_and_are_no_mistake_of_what_follows():
    """Where large forces cancel each other they cost more than a rounding may."""
    texts = {n: [f.replace("RADIANS", "1/57.3*") for f in own] for n, own in formulas().items()}
    turned = re.compile(r"RADIANS\(A(\d+)\)")
    for node in ("P3_1.s1_mm", "P3_1.j1_m_s2", "P3_2.omega_rod_approx_1_s"):  # angles typed as well
        texts[node] = [turned.sub(lambda m: f"({30 * (int(m[1]) - 6)}/57.3)", f)
                       for f in formulas()[node]]  # fmt: skip
    result = graded(texts)
    assert classroom.verdicts(result) == {}
    assert result["points"] == 100


def test_an_empty_book_is_empty_throughout():
    result = classroom.marks(classroom.handout())
    assert set(classroom.verdicts(result).values()) == {"empty"}
    assert result["points"] == 0


def test_one_wrong_omega_costs_one_item_and_all_after_it_is_carried():
    result = graded({"omega": ["=regime_speed_rpm*PI()/60"]})
    actual = classroom.verdicts(result)
    assert actual.pop("geometry.omega") == "wrong"
    assert set(actual.values()) == {"carried"}
    # Speeds, accelerations, inertia forces and everything made of them.
    for item in ("P3_1.v1_m_s", "P3_1.j_m_s2", "P4_1.M_Nm", "P4_3_2.R_MPa"):
        assert actual[item] == "carried"
    assert "P3_1.s_mm" not in actual
    cost = line(result, "geometry.omega")["of"]
    assert result["points"] == pytest.approx(100 - cost, abs=0.01)


def test_what_rests_on_an_empty_column_names_it():
    empty = [""] * len(formulas()["P3_1.v1_m_s"])
    result = graded({"P3_1.v1_m_s": empty})
    assert classroom.verdicts(result) == {"P3_1.v1_m_s": "empty", "P3_1.v_m_s": "groundless"}
    actual = line(result, "P3_1.v_m_s")
    assert actual["origins"] == ["P3_1.v1_m_s"] and actual["points"] == 0
    result = graded({"P3_1.v1_m_s": empty, "P3_1.v2_m_s": empty})
    assert line(result, "P3_1.v_m_s")["origins"] == ["P3_1.v1_m_s", "P3_1.v2_m_s"]
    result = graded({"P3_1.v1_m_s": empty, "omega": [""]})
    assert line(result, "P3_1.v_m_s")["origins"] == ["P3_1.v1_m_s", "geometry.omega"]
    assert line(result, "P4_4.Mmain4_Nm")["origins"] == ["geometry.omega"]  # no speed is in it
    wrong = [f.replace("+", "-") for f in formulas()["P3_1.v_m_s"]]
    result = graded({"P3_1.v1_m_s": empty, "P3_1.v_m_s": wrong})
    assert line(result, "P3_1.v_m_s")["verdict"] == "wrong"  # whatever it rests on


def test_right_numbers_are_no_origin_of_a_mistake_and_every_remark_names_its_cells():
    """Typed speeds are right though ω is not: the sum is off because of the other summand."""
    right = evaluate_model(classroom.assignment().model).columns
    beta, k = right["P3_2"]["beta_rad"], formulas()["P4_1.K_MPa"]
    result = graded({
        "omega": ["=regime_speed_rpm*PI()/60"],
        "P3_1.v1_m_s": [round(float(v), 3) for v in right["P3_1"]["v1_m_s"]],
        "P3_1.s_mm": [f"=D{row}" for row in range(6, 19)],
        "V_c": ['=INDIRECT("C10")/17'],
        "P4_1.K_MPa": [*k[:3], f"={float(beta[3])!r}+0.0004", *k[4:]],  # near β by chance
    })  # fmt: skip
    assert line(result, "P3_1.v_m_s")["origins"] == ["P3_1.v2_m_s"]
    assert line(result, "P3_1.s_mm")["where"] == ["П3.1!D6:D18"]
    assert line(result, "geometry.V_c")["where"] == ["Массы!C11"]
    assert line(result, "P4_1.K_MPa")["cause"].endswith("сравните формулу с соседними")


def test_a_wrong_way_back_is_wrong():
    moments = evaluate_model(classroom.assignment().model).columns["P4_1"]["M_Nm"]
    back = [f"=I{row}/F_piston/10^6" for row in range(6, 6 + len(moments))]  # without r
    result = graded({"P4_1.M_Nm": [float(v) for v in moments], "P4_1.T_MPa": back})
    assert line(result, "P4_1.T_MPa")["verdict"] == "wrong"


@pytest.mark.parametrize(
    ("item", "change", "cause"),
    [
        ("P3_1.v1_m_s", lambda f: f.replace("RADIANS", ""), "градусы вместо радиан"),
        ("P3_1.s1_mm", lambda f: f"=-({f[1:]})", "обратный знак"),
        ("P3_1.s1_mm", lambda f: f"=({f[1:]})/1000", "меньше правильных в 1000 раз"),
        ("P3_1.j1_m_s2", lambda f: f"=10*({f[1:]})", "больше правильных в 10 раз"),
        ("P3_1.v1_m_s", lambda f: f.replace("r_crank", "S_stroke"), "ход поршня S вместо"),
        ("P3_1.v_m_s", lambda f: f.replace("+", "-"), "знак слагаемого"),
        ("P3_2.beta_rad", lambda f: f"=DEGREES({f[1:]})", "в градусах вместо радиан"),
    ],
)
def test_a_usual_mistake_is_named(item, change, cause):
    result = graded({item: [change(f) for f in formulas()[item]]})
    actual = line(result, item)
    assert actual["verdict"] == "wrong"
    assert cause in actual["cause"]
    sheet = actual["where"][0].partition("!")[0]
    assert all(cell["cell"].startswith(f"{sheet}!") for cell in actual["cells"])
    others = {key: word for key, word in classroom.verdicts(result).items() if key != item}
    assert set(others.values()) <= {"carried"}


WRITTEN = {
    "geometry.j_tdc": ("=r_crank*(omega*(1+lam))^2", "(1 + λ) в квадрате, а надо в первой степени"),
    "geometry.F_piston": ("=PI()*geometry_bore_mm/1000/4",
                          "не возведено в квадрат: диаметр цилиндра"),
    "P3_1.s1_mm": ("=r_crank*(1-COS(RADIANS(A{r}/2)))*1000",
                   "угол φ/2 вместо φ под знаком sin, cos"),
    "P3_1.s2_mm": ("=r_crank*lam/4*(1-COS(RADIANS(A{r})))*1000",
                   "угол φ вместо 2φ под знаком sin, cos"),
    "P3_1.s_mm": ("=B{r}-C{r}", "знак слагаемого sп2"),
    "P3_1.j_m_s2": ("=H{r}*I{r}", "умножение вместо сложения или наоборот"),
    "P3_2.beta_rad": ("=ATAN(lam*SIN(RADIANS(A{r})))", "ATAN вместо ASIN"),
    "P4_1.Pj_MPa": ("=-m_r*K{r}/F_piston/10^6", "масса mr вместо mj"),
    "P4_1.T_MPa": ("=D{r}*SIN(RADIANS(A{r})-J{r})/COS(J{r})", "знак слагаемого β"),
}  # fmt: skip


def test_what_students_write_is_named_as_a_teacher_would():
    """All in one book: each is looked at by the student's own values."""
    own = formulas()
    changes = {
        node.removeprefix("geometry."): [
            text.replace("{r}", str(row))
            for row, _ in enumerate(own[node.removeprefix("geometry.")], 6)
        ]
        for node, (text, _) in WRITTEN.items()
    }
    result = graded(changes)
    causes = {node: line(result, node)["cause"] for node in WRITTEN}
    assert causes == {node: words for node, (_, words) in WRITTEN.items()}


def test_typed_numbers_are_told_from_formulas():
    values = classroom.marker().assignment(classroom.book())[0]
    right = evaluate_model(values.model).columns["P3_1"]["v1_m_s"]
    result = graded({"P3_1.v1_m_s": [round(float(v), 2) for v in right]})
    assert classroom.verdicts(result) == {"P3_1.v1_m_s": "typed"}
    actual = line(result, "P3_1.v1_m_s")
    assert actual["points"] == pytest.approx(actual["of"] / 2)
    # A formula of numbers is a number.
    result = graded({"P3_1.v1_m_s": [f"={float(v)!r}+0" for v in right]})
    assert classroom.verdicts(result) == {"P3_1.v1_m_s": "typed"}


@pytest.mark.parametrize(("row", "lost"), [("=8", 1), ("<=7", 2), ("<=8", 0)])
def test_a_formula_that_fails_in_one_or_two_rows_loses_their_share(row, lost):
    """Though it is one formula, filled down: in the other rows it is right for every engine."""
    texts = [f"=IF(ROW(){row},1/0,{f[1:]})" for f in formulas()["P4_1.S_MPa"]]
    actual = line(graded({"P4_1.S_MPa": texts}), "P4_1.S_MPa")
    share = 1 - lost / 25 if lost else 22 / 25 / 2  # of three a formula is wrong
    assert actual["verdict"] == "error" and len(actual["rows"]) == (lost or 25)
    assert actual["points"] == pytest.approx(actual["of"] * share, abs=1e-5)


def test_a_formula_of_numbers_is_a_number_whatever_the_engines(monkeypatch):
    """Also where one of those on which it is tried has some values as its own."""

    def tried(*given):
        first, second, third = trials_of(*given)
        return first, second, replace(third, expected=first.expected)

    monkeypatch.setattr(marking, "trials_of", tried)
    right = evaluate_model(classroom.assignment().model).columns["P4_1"]["Pg_MPa"]
    texts = [f"={float(v)!r}" for v in right]
    book = filled_book(classroom.handout(), classroom.assignment(), {"P4_1.Pg_MPa": texts})
    actual = marking.Marker(classroom.register()).mark(
        Submission("работа", Path("х"), None, None), book
    )
    assert line(actual, "P4_1.Pg_MPa")["verdict"] == "typed"


@pytest.mark.parametrize(
    ("formula", "verdict"),
    [
        ("=47*(1-COS(RADIANS({phi})))", "right"),  # the radius is alike for the class
        ("=47*(1-COS(RADIANS({phi})))*89.5/geometry_bore_mm", "typed"),
        ("={v}+0*{phi}", "still"),
    ],
)
@pytest.mark.parametrize("own", [False, True])
def test_a_formula_of_the_angle_is_no_list_for_being_alike_for_the_class(formula, verdict, own):
    """Nor is it one where the angles stand once more in a column of one's own."""
    right = evaluate_model(classroom.assignment().model).columns["P3_1"]["s1_mm"]
    texts = [
        formula.format(phi=f"{'T' if own else 'A'}{row}", v=repr(float(value)))
        for row, value in enumerate(right, 6)
    ]

    def angles(book: Workbook, layout: Layout) -> None:
        for index in range(len(right) if own else 0):
            book["П3.1"].cell(6 + index, 20).value = 30 * index

    assert line(graded({"P3_1.s1_mm": texts}, angles), "P3_1.s1_mm")["verdict"] == verdict


@pytest.mark.parametrize(
    ("key", "largest", "allowed"),
    [("s_mm", 94.0, 0.0005), ("j_m_s2", 13000.0, 0.5), ("Pg_MPa", 0.01, 0.0001),
     ("F_re", 0.0, 1e-11)],
)  # fmt: skip
def test_the_tolerance_is_half_a_unit_of_the_last_printed_digit(key, largest, allowed):
    """Of quantities smaller than their printed digits it is a share of the column.

    A nought may be what is left of a force of many newtons at 90°.
    """
    rubric = SimpleNamespace(tolerance=ToleranceRules())
    student = SimpleNamespace(assignment=SimpleNamespace(rubric=rubric))
    item = SimpleNamespace(id=f"t.{key}", quantity=quantity(key))
    actual = tolerance(item, np.array([0.0, largest]), student)
    assert actual == pytest.approx(allowed, rel=1e-6)


@pytest.mark.parametrize("original", ["empty", "filled"])
def test_a_copy_of_a_sheet_that_is_filled_instead_is_for_a_person(original):
    def copied(book: Workbook, layout: Layout) -> None:
        copy = book.copy_worksheet(book["П3.1"])
        copy.title = "П3.1 (2)"
        sheet = copy if original == "filled" else book["П3.1"]
        for line in sheet.iter_rows(min_row=6, min_col=2):
            for cell in line:
                cell.value = None

    result = graded(edit=copied)
    collected = {
        item for item, verdict in classroom.verdicts(result).items() if verdict == "unknown"
    }
    lines = {item["id"] for item in result["items"] if item["id"].startswith("P3_1.")}
    assert collected == (lines if original == "empty" else set())
    assert bool(result["manual"]) == (original == "empty")


@pytest.mark.parametrize(("saved", "more"), [(True, "+0"), (False, "+0"), (False, "")])
def test_a_look_up_over_a_column_that_follows_from_it_is_for_a_person(saved, more):
    """LibreOffice takes one cell of the column; without its number it is a circle.

    A place that is written out is no look-up.
    """

    def on_one_sheet(book: Workbook, layout: Layout) -> None:
        sheet, row = book.create_sheet("Расчёт"), 0
        for node in ("P3_1.s1_mm", "P3_1.s2_mm", "P3_1.s_mm"):
            table, column = layout.columns[node]
            for at in layout.rows_of(table):
                row += 1
                cell = book[table.sheet].cell(at, column)
                text = re.sub(r"(?<![\w!'$])(\$?[A-Z]\$?\d+)", rf"'{table.sheet}'!\1", cell.value)
                sheet.cell(row, 2).value = text
                cell.value = f"=INDEX(Расчёт!$B:$B,{row}{more})"

    book = filled_book(classroom.handout(), classroom.assignment(), edit=on_one_sheet)
    if saved:
        (book,) = LibreOffice().converted([book])
    result = classroom.marks(book)
    collected = set(classroom.verdicts(result).values())
    if not more:
        assert collected == set() and result["points"] == 100
        return
    assert collected == ({"unknown"} if saved else {"error", "groundless"})
    assert bool(result["manual"]) == saved


def test_the_variant_copied_in_other_units_costs_nothing():
    drawn = classroom.book().drawn
    radius = classroom.assignment().model.fields["geometry_crank_radius_mm"].value

    def copied(book: Workbook, layout: Layout) -> None:
        sheet = book.create_sheet("Мой вариант")
        sheet["B1"] = drawn["geometry.bore_mm"] / 10  # cm
        sheet["B2"] = drawn["regime.speed_rpm"] / 60  # turns a second
        sheet["B3"] = drawn["masses.reciprocating_kg"] * 1000  # g
        sheet["B4"] = radius  # alike for the whole class
        for name, text in (
            ("r_crank", "='Мой вариант'!B4/1000"),
            ("F_piston", "=PI()*('Мой вариант'!B1/100)^2/4"),
            ("omega", "=2*PI()*'Мой вариант'!B2"),
            ("m_j", "='Мой вариант'!B3/1000"),
        ):
            cell = layout.cells[name]
            book[cell.sheet].cell(cell.row, cell.column).value = text

    result = graded(edit=copied)
    assert classroom.verdicts(result) == {} and result["points"] == 100


def test_numbers_cut_up_into_short_ones_are_for_a_person():
    values = evaluate_model(classroom.assignment().model)
    speeds, omega = values.columns["P3_1"]["v1_m_s"], values.scalars["omega"]

    def cut_up(book: Workbook, layout: Layout) -> None:
        sheet = book.create_sheet("Числа")
        for row, speed in enumerate(speeds, 6):
            whole = round(float(speed) * 1000)
            sheet.cell(row, 1).value, sheet.cell(row, 2).value = divmod(whole, 100)
            text = f"=(Числа!A{row}/10+Числа!B{row}/1000)*omega/{omega!r}"
            book["П3.1"].cell(row, 5).value = text

    assert classroom.verdicts(graded(edit=cut_up)) == {"P3_1.v1_m_s": "unknown"}


def test_numbers_made_of_digits_by_formulas_that_are_not_alike_are_for_a_person():
    """They do not look like a list, but are right at the angles of the rows alone."""
    values = evaluate_model(classroom.assignment().model)
    speeds, omega = values.columns["P3_1"]["v1_m_s"], values.scalars["omega"]

    def of_digits(book: Workbook, layout: Layout) -> None:
        sheet = book.create_sheet("Числа")
        for digit in range(10):
            sheet.cell(digit + 1, 3).value = digit
        for row, speed in enumerate(speeds, 6):
            whole = f"{round(abs(speed) * 1e6):08}"
            digits = "+".join(f"Числа!C{int(d) + 1}*10^{1 - i}" for i, d in enumerate(whole))
            text = f"={'-' if speed < 0 else ''}({digits + '+Числа!C1' * row})*omega/{omega!r}"
            book["П3.1"].cell(row, 5).value = text

    assert classroom.verdicts(graded(edit=of_digits)) == {"P3_1.v1_m_s": "unknown"}


def test_what_rests_on_a_circle_is_not_said_to_rest_on_blanks():
    count = len(formulas()["P4_2.M1_Nm"])
    back = [f"=E{row}-C{row}-D{row}" for row in range(6, 6 + count)]
    result = graded({"P4_2.M1_Nm": back})
    resting = [item for item in result["items"] if item["verdict"] == "groundless"]
    assert "P4_4.Mmain4_Nm" in {item["id"] for item in resting}  # by way of other columns
    assert {item["reason"] for item in resting} == {"опирается на круговую ссылку"}


@pytest.mark.parametrize("own", [False, True])
def test_a_circle_for_other_engines_is_found_whatever_the_engines(monkeypatch, own):
    """Also where one of them has the very bore for which the student's formula takes numbers."""
    values = evaluate_model(classroom.assignment().model).columns["P4_1"]
    bore = classroom.book().drawn["geometry.bore_mm"]

    def tried(*given):
        trials = trials_of(*given)
        other = next(b.drawn["geometry.bore_mm"] for b in classroom.register().books[1:])
        inputs = dict(trials[0].inputs) | {"geometry_bore_mm": float(bore if own else other)}
        expected = Evaluation(given[0].model).fork(inputs)
        return (replace(trials[0], inputs=inputs, expected=expected), *trials[1:])

    monkeypatch.setattr(marking, "trials_of", tried)
    forces = [
        f"=IF(geometry_bore_mm={bore},{float(v)!r},F{row}*COS(J{row}))"
        for row, v in enumerate(values["Ps_MPa"], 6)
    ]
    back = [f"=D{row}/COS(J{row})" for row in range(6, 6 + len(forces))]
    book = filled_book(
        classroom.handout(), classroom.assignment(), {"P4_1.Ps_MPa": forces, "P4_1.S_MPa": back}
    )
    result = marking.Marker(classroom.register()).mark(
        Submission("работа", Path("х"), None, None), book
    )
    assert line(result, "P4_1.Ps_MPa")["points"] == line(result, "P4_1.S_MPa")["points"] == 0


def test_numbers_that_are_scaled_are_not_said_to_stand_still():
    values = evaluate_model(classroom.assignment().model)
    omega = values.scalars["omega"]
    scaled = [f"={float(v)!r}*omega/{omega!r}" for v in values.columns["P3_1"]["v1_m_s"]]
    actual = line(graded({"P3_1.v1_m_s": scaled}), "P3_1.v1_m_s")
    assert actual["verdict"] == "still" and "готовые числа" in actual["reason"]


def test_a_row_within_a_table_is_not_called_a_change_of_given_formulas_alone():
    def inserted(book: Workbook, layout: Layout) -> None:
        insert(book, "П4.1", row=18)

    result = graded(edit=inserted)
    assert result["points"] == 100  # though a person looks: look-ups by number have shifted
    assert any("сбиты вставкой строк" in text for text in result["manual"])
