"""Each usual mistake is named by its own words, on numbers alone."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
import pytest

from reports.grading.issuing.assignment import Item
from reports.grading.judging.causes import Causes
from reports.grading.judging.spelling import squares_a_cosine, squares_a_minus
from reports.grading.judging.verdicts import WRONG, Judgement
from reports.grading.reading.student import StudentBook
from reports.recalculation.formulas import formula_of, pattern
from reports.recalculation.read import read_grid
from reports.workbook.layout import Layout
from tests.grading import classroom
from tests.grading.fill import filled_book, solved_formulas


@lru_cache(maxsize=1)
def student() -> StudentBook:
    book = filled_book(classroom.handout(), classroom.assignment())
    return classroom.marker().student(classroom.book(), read_grid(book))


def item_of(name: str) -> Item:
    return next(item for item in student().assignment.items if item.id == name)


def right(name: str, inputs: dict[str, float | str] | None = None) -> np.ndarray:
    run = student().expected.fork(inputs or {})
    node = name if name in run.model.fields else item_of(name).nodes[0]
    return np.ravel(np.asarray(run.value(node), dtype=float))


def cause(
    name: str, values: np.ndarray, rows: Sequence[int] = (), typed: Sequence[int] = ()
) -> str:
    marker, book = classroom.marker(), classroom.book()
    causes = Causes(student(), marker.others(book.number), marker.titles(student().assignment))
    seen = np.asarray(values, float)
    return causes.find(
        Judgement(item_of(name), WRONG, right(name), seen, tuple(rows), tuple(typed))
    )


V1, S1, S, V, J1, V2 = (
    f"P3_1.{key}" for key in ("v1_m_s", "s1_mm", "s_mm", "v_m_s", "j1_m_s2", "v2_m_s")
)


def LAM() -> float:
    return float(right("geometry.lam")[0])


@pytest.mark.parametrize(
    ("name", "change", "words"),
    [
        (V1, lambda v: -v, "обратный знак"),
        (S1, lambda v: v / 1000, "значения меньше правильных в 1000 раз"),
        (S1, lambda v: v * 1e6, "значения больше правильных в 1\u00a0000\u00a0000 раз"),
        ("geometry.omega", lambda v: 60 * v, "больше правильных в 60 раз"),  # turns a minute
        ("P3_2.beta_rad", np.degrees, "в градусах вместо радиан"),
        (J1, lambda v: np.roll(v, 1), "на одну строку вниз"),
        (J1, lambda v: np.roll(v, -1), "на одну строку вверх"),
        (V1, lambda v: 2 * v, "ход поршня S вместо радиуса"),
        (S, lambda v: right(V), "это значения соседнего столбца"),
        (V, lambda v: 2 * right(V1) - v, "знак слагаемого"),
        ("P4_1.beta_rad", lambda v: v * 2, "вдвое больше правильного"),
        ("geometry.V_h", lambda v: v * 10, "в 10 раз"),
        ("geometry.V_h", lambda v: v * 0, "получен нуль"),
        (V1, lambda v: v * 0, "все значения равны нулю"),
        ("geometry.V_h", lambda v: right("geometry.V_c"), "это значение величины"),
        ("geometry.lam", lambda v: 1 / v, "обратная величина"),
        ("geometry.V_c", lambda v: v * 17 / 18, "пропущено слагаемое 1"),
        ("geometry.F_piston", lambda v: v / np.pi, "пропущен множитель π"),
        ("geometry.F_piston", lambda v: v / 4, "вчетверо меньше"),
        ("P4_1.T_MPa", lambda v: v * np.cos(right("P4_1.beta_rad")), "множитель cos β"),
        ("P4_1.S_MPa", lambda v: v * np.cos(right("P4_1.beta_rad")) ** 2, "деление вместо"),
        (
            "P4_1.M_Nm",
            lambda v: (
                1e6 * right("P4_1.K_MPa") * right("geometry.F_piston") * right("geometry.r_crank")
            ),
            "Kуд вместо Tуд",
        ),
        ("geometry.F_piston", lambda v: v * 3 / np.pi, "π взято как 3"),
        ("geometry.F_piston", lambda v: v * 3.14 / np.pi, "π взято как 3,14"),
        (V2, lambda v: v * LAM(), "λ в квадрате, а надо в первой степени"),
        ("P3_2.beta_rad", lambda v: np.arcsin(np.sin(v) * LAM()), "λ в квадрате"),
        ("P4_3_1.R_MPa", lambda v: v**2, "корень не извлечён"),
        ("P3_2.eps_rod_exact_1_s2", lambda v: v / (1 - LAM() ** 2), "множитель (1 − λ²)"),
        (
            J1,
            lambda v: v * np.cos(np.radians(np.arange(0, 361, 30))),
            "cos φ в квадрате, а надо в первой степени",
        ),
        ("P3_2.beta_rad", np.sin, "взят аргумент вместо ASIN"),
        ("P4_1.beta_rad", lambda v: np.arccos(np.sin(v)), "ACOS вместо ASIN"),
        (
            "P4_1.N_MPa",
            lambda v: right("P4_1.Ps_MPa") * np.sin(right("P4_1.beta_rad")),
            "sin вместо tg",
        ),
        ("geometry.lam", lambda v: v / (1 + v), "r + L вместо длины шатуна"),
        (V2, lambda v: right(V1) * LAM() / 2, "угол φ вместо 2φ"),
        (
            "P4_1.j_m_s2",
            lambda v: v[0] / (1 + LAM()) * np.cos(np.radians(np.arange(0, 721, 30))),
            "пропущено слагаемое λ·cos(2·φ)",
        ),
        (
            "P4_3_1.R_MPa",
            lambda v: abs(right("P4_3_1.Rx_MPa")) + abs(right("P4_3_1.Ry_MPa")),
            "сложены модули",
        ),
        (
            "P3_2.eps_rod_exact_1_s2",
            lambda v: v * np.cos(right("P3_2.beta_rad")),
            "возведено в квадрат, а надо в куб",
        ),
        (
            "P4_1.M_Nm",
            lambda v: v * right("geometry_bore_mm") / 2000 / right("geometry.r_crank"),
            "радиус цилиндра D/2",
        ),
        ("geometry.v_max", lambda v: right(V).max(keepdims=True), "П3.1, vп: между ними есть"),
    ],
)
def test_a_change_of_the_numbers_is_named(name, change, words):
    assert words in cause(name, change(right(name).copy()))


@pytest.mark.parametrize(
    ("text", "minus", "cosine"),
    [
        ("-omega^2*SIN(A6)", True, False),
        ("lam*-(omega)^2", True, False),
        ("5-omega^2", False, False),
        ("A6%-B6^2", False, False),
        ("(A6)-B6^2", False, False),
        ("-(omega^2)*COS(B6)", False, False),
        ("lam/COS(RADIANS(A6))^2", False, True),
        ("COS(A6)*B6^2", False, False),
    ],
)
def test_what_is_written_tells_of_a_power(text: str, minus: bool, cosine: bool):
    formula = formula_of(pattern(text, 6, 3))
    assert (squares_a_minus(formula), squares_a_cosine(formula)) == (minus, cosine)


def test_an_angle_is_no_hundredth_of_another_but_for_whole_turns():
    name = "geometry.phi_vmax_deg"
    assert "раз" not in cause(name, right(name) * 100 % 360)


def test_a_cause_is_told_from_half_of_the_rows_on():
    wrong = -right(V1)
    half = len(wrong) // 2
    few, enough = (
        np.where(np.arange(len(wrong)) < rows, wrong, np.nan) for rows in (half - 1, half)
    )
    assert cause(V1, few) == ""
    assert "обратный знак" in cause(V1, enough)


@pytest.mark.parametrize(
    ("rows", "change", "typed", "words"),
    [
        ((4,), lambda v: -v, (), "неверна одна строка из 13, остальные верны: обратный знак"),
        ((4, 5), lambda v: -v, (), "неверно строк: 2 из 13, остальные верны: обратный знак"),
        ((4,), lambda v: np.roll(v, -1), (), "остальные верны: значения сдвинуты на одну"),
        ((4,), lambda v: v * 1.1, (), "остальные верны: сравните формулу с соседними"),
        ((0,), lambda v: v * 1.1, (), "остальные верны: сравните формулу с соседними"),
        ((4,), lambda v: v * 1.1, (4,), "остальные верны: вместо формулы вписано число"),
        # What has few digits left may come of anything.
        ((4,), lambda v: v * 1e-5, (), "остальные верны: сравните формулу с соседними"),
    ],
)
def test_a_slip_in_a_few_rows_is_told_from_a_wrong_column(rows, change, typed, words):
    values = right(J1).copy()
    values[list(rows)] = change(right(J1))[list(rows)]
    assert words in cause(J1, values, rows, typed)


def test_many_wrong_rows_or_an_empty_one_are_no_slip():
    values = right(V1) + 1.2345
    assert cause(V1, values, range(13)) == ""
    values[4] = np.nan
    assert cause(V1, values, (4,)) == ""


def test_a_mistake_upon_mistakes_is_named():
    """The forces of the next cylinders are wrong already; then comes a sign."""
    turned = {"P4_1.T_MPa": "=({})/1000", "P4_2.M2_Nm": "=-({})"}
    formulas = solved_formulas(classroom.assignment(), Layout.of(classroom.assignment().model))
    changes = {node: [text.format(str(t)[1:]) for t in formulas[node]]
               for node, text in turned.items()}  # fmt: skip
    data = filled_book(classroom.handout(), classroom.assignment(), changes)
    lines = classroom.marks(data)["items"]
    messages = {line["id"]: line["cause"] for line in lines if line["verdict"] == "wrong"}
    assert messages["P4_2.M2_Nm"] == "обратный знак"
    assert messages.keys() == turned.keys()


def test_degrees_in_a_sine_are_named():
    angles = np.array([float(label) for label in item_of(V1).labels])
    scale = right(V1)[3] / np.sin(np.radians(angles[3]))
    assert "градусы вместо радиан" in cause(V1, scale * np.sin(angles))


def test_another_students_parameter_and_another_method_are_named():
    other = classroom.register().books[1]
    speed = float(other.drawn["regime.speed_rpm"])
    assert speed != classroom.book().drawn["regime.speed_rpm"]
    theirs = right("geometry.omega", {"regime_speed_rpm": speed})
    actual = cause("geometry.omega", theirs, typed=(0,))
    assert "из варианта 2" in actual
    assert f"{speed:g}" in actual
    # A formula in which no number of theirs stands accuses nobody.
    assert cause("geometry.omega", theirs) == ""
    model = student().assignment.model
    labels = model.fields["calculation_method"].choices
    now = labels[str(model.fields["calculation_method"].value)]
    other_method = next(label for label in labels.values() if label != now)
    name = next(
        item.id for item in student().assignment.items
        if item.is_column and not np.allclose(
            right(item.id), right(item.id, {"calculation_method": other_method}), rtol=1e-3
        )
    )  # fmt: skip
    assert "формула вместо" in cause(name, right(name, {"calculation_method": other_method}))


def test_what_fits_nothing_has_no_cause():
    noise = np.random.default_rng(1).normal(size=right(V1).size) * 37
    assert cause(V1, noise) == ""
    assert cause(V1, np.full(right(V1).size, np.nan)) == ""
    assert cause(V1, right(V1)) == ""  # what is right is no mistake
    # A choice of the input, of which there is no square, is in this formula.
    assert cause("P4_1.j_m_s2", right("P4_1.j_m_s2") * 7 + 3) == ""
