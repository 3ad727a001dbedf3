"""Copying told in rings of any size by what is rare; nobody honest is named."""

from __future__ import annotations

import io
import json
import random
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import pytest
from openpyxl import load_workbook

from reports.grading.batch.memory import remember, remembered
from reports.grading.judging import collusion, similarity, traits, work_digest
from reports.grading.judging.canonical import Reader
from reports.grading.judging.collusion import PastWork, rings_of
from reports.grading.judging.traits import ERROR, FORM, HELPER, IDLE, NAME, SLIP, TEXT
from reports.grading.judging.work_digest import Trait, Work, work_of
from reports.recalculation.formulas import pattern
from reports.shared.errors import InputError
from reports.workbook.layout import Layout
from tests.grading import classroom
from tests.grading.drawn import cosmetics
from tests.grading.drawn.classroom import Drawn, DrawnClass
from tests.grading.fill import filled_book, solved_formulas
from tests.grading.test_similarity import result

# --- formulas that differ in nothing but the way they are written --------------------------------

NODES = {("Л", 6, 1): ("phi", 0, 25), ("Л", 6, 2): ("b", 0, 25), ("Л", 1, 1): ("r", 0, 1),
         ("Л", 1, 2): ("omega", 0, 1), ("Л", 7, 1): ("phi", 1, 25)}  # fmt: skip
HELPERS = {("Л", 6, 20): "RADIANS(A6)", ("Л", 6, 21): "SIN(T6)"}


def tree(text: str) -> tuple:
    reader = Reader(
        lambda *at: NODES.get(at),
        lambda sheet, row, column: (
            pattern(HELPERS[sheet, row, column], row, column)
            if (sheet, row, column) in HELPERS else None
        ),
        lambda *at: 3.14159265 if at == ("Л", 2, 9) else None,
        {"r_crank": ("Л", 1, 1), "w": ("Л", 1, 2)}.get,
    )  # fmt: skip
    return reader.tree(pattern(text, 6, 5), ("Л", 6, 5), 0)


@pytest.mark.parametrize(
    "text",
    [
        "r_crank*w*SIN(RADIANS(A6))", "$A$1*$B$1*SIN(A6*PI()/180)", "+w * r_crank*SIN(A6/57.2958)",
        "ROUND(SIN(PI()/180*A6)*B$1*A$1,6)", "IFERROR(r_crank*w*SIN($A6*3.1416/180),0)",
        "A1*B1*U6", "PRODUCT(A1,B1,SIN(T6))", "LET(a,RADIANS(A6),r_crank*w*SIN(a))",
        "(r_crank)*(w*SIN(A6*(I2/180)))", "1000*r_crank*w*SIN(RADIANS(A6))/10^3",
    ],
)  # fmt: skip
def test_a_manner_of_writing_makes_no_other_formula(text):
    assert tree(text) == tree("r_crank*w*SIN(RADIANS(A6))")


@pytest.mark.parametrize(
    "text",
    ["r_crank*w*COS(RADIANS(A6))", "r_crank*w^2*SIN(RADIANS(A6))", "r_crank*w*SIN(RADIANS(A7))",
     "r_crank*w*SIN(A6)", "r_crank*w*SIN(RADIANS(B6))", "2*r_crank*w*SIN(RADIANS(A6))"],
)  # fmt: skip
def test_another_formula_is_another_one(text):
    assert tree(text) != tree("r_crank*w*SIN(RADIANS(A6))")


# --- how rare ------------------------------------------------------------------------------------


def works(traits: list[list[Trait]]) -> list[Work]:
    return [work_of(result(i, traits=own), {}) for i, own in enumerate(traits, 1)]


def of(kind: str, item: str, mark: str = "") -> Trait:
    return kind, item, mark or f"{kind}-{item}", "", item


RARE = [of(ERROR, "a"), of(ERROR, "b"), of(HELPER, "c"), of(HELPER, "d"), of(SLIP, "e"),
        *(of(FORM, f"f{i}") for i in range(8))]  # fmt: skip


def honest(chance: random.Random) -> list[Trait]:
    """Forms of one's own, a usual mistake or two."""
    forms = [of(FORM, f"f{i}", f"{chance.randrange(3)}") for i in range(8) if chance.random() < 0.6]
    return forms + [of(SLIP, f"s{i}") for i in chance.sample(range(30), 2)]


@pytest.mark.parametrize("size", [2, 3, 5, 8, 12])
def test_a_ring_of_any_size_is_held_and_nobody_else(size):
    chance = random.Random(size)
    class_ = works([RARE] * size + [honest(chance) for _ in range(60 - size)])
    (ring,) = rings_of(class_)
    assert ring.held
    assert {work.number for work in ring.works} == set(range(1, size + 1))


STEPS = [of(IDLE, "a"), of(IDLE, "b"), of(IDLE, "c"), of(TEXT, "", "t"), of(TEXT, "", "u")]
ONE_MANNER = [(FORM, f"f{i}", f"m{i}", f"s{i}", "manner") for i in range(47)]


@pytest.mark.parametrize("traits", [STEPS, ONE_MANNER], ids=["steps", "forms of one manner"])
@pytest.mark.parametrize("size", [2, 4, 8, 12])
def test_what_a_ring_shares_is_no_less_rare_for_its_size(traits, size):
    """Nor for being one manner throughout: nobody else writes 47 such formulas to a sign."""
    chance = random.Random(size)
    class_ = works([traits] * size + [honest(chance) for _ in range(60 - size)])
    (ring,) = rings_of(class_)
    assert ring.held and len(ring.works) == size


def test_a_manner_that_is_spelt_otherwise_or_differs_in_places_is_no_copy():
    chance = random.Random(1)
    rest = [honest(chance) for _ in range(58)]
    spelt = [(kind, item, mark, f"{text}'", group) for kind, item, mark, text, group in ONE_MANNER]
    other = [*ONE_MANNER[:33], *(of(FORM, f"f{i}", "other") for i in range(33, 47))]
    for own in (spelt, other):
        assert not any(ring.held for ring in rings_of(works([ONE_MANNER, own, *rest])))


@pytest.mark.parametrize("size", [16, 20, 30])
def test_what_a_subgroup_has_of_its_lecturer_holds_nobody(size):
    taught = [*(of(SLIP, f"t{i}") for i in range(4)), *(of(FORM, f"f{i}", "t") for i in range(5))]
    chance = random.Random(size)
    class_ = works([taught + honest(chance)[-2:] for _ in range(size)]
                   + [honest(chance) for _ in range(60 - size)])  # fmt: skip
    assert not any(ring.held for ring in rings_of(class_))


@pytest.mark.parametrize(("holds", "held"), [(True, True), (False, False)])
def test_the_rubric_says_whether_a_work_of_an_earlier_year_holds_points(holds, held):
    past = [PastWork("2025-12", 1, tuple(RARE))]
    class_ = works([RARE] + [[of(SLIP, f"x{i}")] for i in range(20)])
    (ring,) = rings_of(class_, past, past_holds=holds)
    assert ring.held == held and ring.past == tuple(past)


def test_what_most_of_a_class_write_is_no_ring():
    """A slip of the lecture, a common source: whatever it is, it is not rare."""
    chance = random.Random(1)
    class_ = works([RARE] * 40 + [honest(chance) for _ in range(20)])
    assert rings_of(class_) == []


def test_forms_alone_never_hold_in_a_small_class():
    forms = [of(FORM, f"f{i}") for i in range(40)]
    assert not any(ring.held for ring in rings_of(works([forms] * 2 + [[of(SLIP, "x")]] * 8)))
    large = works([forms] * 2 + [[of(SLIP, f"x{i}")] for i in range(40)])
    assert [ring.held for ring in rings_of(large)] == [True]


def test_forms_that_differ_speak_against_a_ring():
    mine = [of(FORM, f"f{i}") for i in range(20)]
    other = mine[:10] + [of(FORM, f"f{i}", "other") for i in range(10, 20)]
    rest = [[of(SLIP, f"x{i}")] for i in range(40)]
    assert rings_of(works([mine, other, *rest])) == []


def test_a_ring_is_told_in_words():
    class_ = works([RARE, RARE] + [[of(SLIP, f"x{i}")] for i in range(20)])
    text = rings_of(class_)[0].text(class_[0])
    assert text.startswith("общее с: Студент 2 (2.xlsx) — ")
    assert "одинаковых редких ошибок 2" in text and "редких вспомогательных столбцов 2" in text


def test_the_manual_tells_what_is_held_and_what_is_told():
    text = " ".join(Path("docs/grading.md").read_text(encoding="utf-8").split())
    assert f"от {collusion.HELD:g} бит." in text
    assert f"от {collusion.TOLD:g} до {collusion.HELD:g} бит" in text
    assert f"не больше {collusion._FORMS_BESIDE:g} бит" in text
    assert f"от {collusion._FORMS_ALONE:g} бит" in text
    assert f"меньше {collusion._CLASS} человек" in text
    words = {FORM: "своя формула — до", SLIP: "ошибка с известной причиной — до",
             ERROR: "редкая ошибка — до", IDLE: "действие без смысла (`+0`, `*1`) — до",
             HELPER: "вспомогательный столбец — до", TEXT: "раскладка — до",
             NAME: "своё имя ячейки — до"}  # fmt: skip
    assert f"от {collusion._WHOLE_FORMS} редких" in text
    share = f"не меньше {work_digest.VERBATIM} формул и не меньше {work_digest.NEARLY_ALL:.0%}"
    held, message = text.split("**Только сообщает:**")
    assert share.replace("%", " %") in held
    assert f"те же {work_digest.VERBATIM} формул" in message
    assert f"от {traits._PASTED} зелёных столбцов" in held
    assert f"от {similarity._SHARED} столбцов" in held
    for kind, said in words.items():
        assert f"{said} {collusion._KINDS[kind][1]:g}".replace(".", ",") in text, said


# --- a small class of real books; the whole is ``./run bench copying`` ---------------------------


@lru_cache(maxsize=1)
def drawn_class() -> DrawnClass:
    return DrawnClass("V8", 20)


@lru_cache(maxsize=1)
def drawn() -> Drawn:
    return drawn_class().drawn(5, (2, 5))


def test_the_rings_of_a_drawn_class_are_named_and_nobody_honest():
    actual = drawn().rings()
    assert drawn().named(actual, held=True) == {1, 2, 3, 4, 5, 6, 7}
    assert drawn().named(actual, held=False) == {1, 2, 3, 4, 5, 6, 7}


@pytest.mark.parametrize(
    "looks",
    [
        {"titles": ["Расчёт"]}, {"titles": ["Расчёт", "Черновик", "Мой", "А"]},
        {"titles": ["Расчёт"], "fixed": True},
        {"titles": ["Расчёт", "Черновик", "Мой", "А"], "fixed": True, "headed": False},
        {"titles": ["Расчёт", "Черновик"], "headed": False, "names": cosmetics.NAMES},
    ],
)  # fmt: skip
def test_looks_let_no_ring_pass(looks):
    ring = cosmetics.ring(drawn_class(), **looks)
    (actual,) = rings_of([*ring, *drawn().works[7:]])
    assert actual.held and [work.number for work in actual.works] == [1, 2, 3, 4]


@pytest.mark.parametrize(
    ("one", "other", "alike"),
    [("=N6+0", "=$N6+0", True), ("=N6+0", "=N6 - 0", True), ("=N6*1", "=($N6)*1", True),
     ("=N6*1", "=N6/1", True), ("=N6+0", "=N6*1", False), ("=N6-N6+B6", "=B6+N6 - N6", True)],
)  # fmt: skip
def test_idle_steps_are_told_by_what_they_are(one, other, alike):
    first, second = (work_digest.idle_steps(pattern(text[1:], 6, 5)) for text in (one, other))
    assert first and second and (first == second) == alike


def test_a_ring_of_last_year_is_found_through_the_memory(tmp_path):
    """And the folder tells neither names nor marks."""
    remember(tmp_path, "ab12cd34ef56", drawn().works)
    (path,) = tmp_path.glob("*.json")
    kept = path.read_text(encoding="utf-8")
    assert set(json.loads(kept)) == {"format", "version", "batch", "date", "works"}
    assert not any(work.student in kept or work.file in kept for work in drawn().works)
    assert "points" not in kept
    assert remembered(tmp_path, "ab12cd34ef56") == []  # the class itself
    past = remembered(tmp_path, "another")
    assert len(past) == 20 and all(isinstance(work, PastWork) for work in past)
    own = replace(drawn().works[0], number=50, key="50.xlsx")
    this_year = [own, *(replace(w, number=w.number + 60) for w in drawn().works[7:])]
    held = [ring for ring in rings_of(this_year, past) if own in ring.works]
    assert held and held[0].held and "работы прошлых лет" in held[0].text(own)
    path.write_text(kept[:100], encoding="utf-8")
    with pytest.raises(InputError, match="это не память прошлых лет"):
        remembered(tmp_path, "another")


# --- books of the program ------------------------------------------------------------------------


def test_a_pasted_sheet_of_the_solved_book_is_held():
    """Green cells only refer to it, and it is hidden."""
    assignment = classroom.assignment()
    book = load_workbook(io.BytesIO(filled_book(classroom.handout(), assignment)))
    formulas = solved_formulas(assignment, Layout.of(assignment.model), typed=False)
    pasted = book.create_sheet("Черновик")
    pasted.sheet_state = "hidden"
    source = book["П3.1"]
    for line in source.iter_rows():
        for cell in line:
            pasted[cell.coordinate].value = cell.value
    for node, column in zip((n for n in formulas if n.startswith("P3_1.")), "BCDEFGHIJ",
                            strict=True):  # fmt: skip
        for row, text in enumerate(formulas[node], 6):
            pasted[f"{column}{row}"].value = text
            source[f"{column}{row}"].value = f"=Черновик!{column}{row}"
    stream = io.BytesIO()
    book.save(stream)
    message = classroom.marks(stream.getvalue())["doubts"]
    assert message == [
        "зелёные ячейки только ссылаются на лист «Черновик» с формулами решённой книги"
    ]


def test_a_solved_book_with_ones_own_identifier_is_held():
    book = load_workbook(io.BytesIO(filled_book(classroom.handout(), classroom.assignment())))
    for name in [name for name in book.defined_names if name.startswith("col_")]:
        del book.defined_names[name]  # the solved book has no such names
    stream = io.BytesIO()
    book.save(stream)
    (message,) = classroom.marks(stream.getvalue())["doubts"]
    assert message.startswith("это книга, решённая программой: слово в слово")
    assert classroom.marks(filled_book(classroom.handout(), classroom.assignment()))["doubts"] == []
