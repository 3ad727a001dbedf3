"""What an instructor has of a graded class: groups, copies, questions, the form, no names."""

from __future__ import annotations

import io
import json
import re
import shutil
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from openpyxl import Workbook, load_workbook
from openpyxl.cell.rich_text import CellRichText

from reports.formula.numeric import evaluate_tree
from reports.formula.parse import names, parse
from reports.grading.batch import grade as grading
from reports.grading.batch.grade import GradeSetup, decide, grade
from reports.grading.issuing.issue import assignment_for
from reports.grading.issuing.register import Register
from reports.grading.judging.marking import Marker
from reports.grading.pages.form import filled_form
from reports.grading.pages.gradebook import GROUPS
from reports.grading.pages.marked_copy import marked_copy
from reports.grading.pages.questions import questions_for
from reports.grading.reading.submissions import Submission
from reports.model.evaluation import Evaluation
from reports.shared.errors import InputError
from reports.shared.russian import written as printed
from reports.workbook.layout import Layout
from tests.grading import classroom
from tests.grading.classroom import graded_here, issue_class
from tests.grading.fill import filled_book, solved_formulas

RUBRIC = """
[scale]
marks = { "5" = 85, "4" = 70, "3" = 50 }
[form]
first_row = 5
mark = "D"
points = "C"
cells = { "B2" = "группа" }
"""


@dataclass(frozen=True)
class Handed:
    """A class of four: one right, one with a wrong sign, two with the same strange formula."""

    folder: Path
    register: Register

    def graded(self, out: Path, **more: object) -> dict:
        """The summary of a run."""
        setup = GradeSetup(**more)  # type: ignore[arg-type]
        secret = self.folder / "secret.key"
        done = grade(self.folder / "issued", self.folder / "works", out, secret_file=secret,
                     options=setup)  # fmt: skip
        return done.summary


@pytest.fixture(scope="module")
def handed(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Handed]:
    folder = tmp_path_factory.mktemp("outcomes")
    register = issue_class(folder, 4, RUBRIC).register
    (folder / "works").mkdir()
    for book in register.books:
        assignment = assignment_for(book, register.rubric)
        own = solved_formulas(assignment, Layout.of(assignment.model))
        changes = {}
        if book.number == 2:
            changes = {"P3_1.v1_m_s": [f"=-({text[1:]})" for text in own["P3_1.v1_m_s"]]}
        if book.number > 2:
            before = "=0*INDIRECT(" + ('"A"&ROW())+' if book.number == 3 else '"A" & ROW()) + ')
            changes = {"P3_1.s1_mm": [before + text[1:] for text in own["P3_1.s1_mm"]]}
        empty = (folder / "issued" / book.folder / book.file).read_bytes()
        (folder / "works" / book.file).write_bytes(filled_book(empty, assignment, changes))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(grading, "grade_all", graded_here)
        yield Handed(folder, register)


@pytest.fixture
def out(handed: Handed, tmp_path: Path) -> Path:
    """The folder of a run that is over."""
    if not (handed.folder / "out").exists():
        handed.graded(handed.folder / "out")
    return shutil.copytree(handed.folder / "out", tmp_path / "out")


def groups(out: Path) -> list[dict]:
    return json.loads((out / "summary.json").read_text(encoding="utf-8"))["groups"]


def points(out: Path) -> dict[int, float | None]:
    rows = json.loads((out / "summary.json").read_text(encoding="utf-8"))["rows"]
    return {row["number"]: row["points"] for row in rows}


def test_works_with_the_same_formula_wait_as_one_group(out):
    (group,) = groups(out)
    assert (group["item"], group["numbers"], group["what"]) == ("P3_1.s1_mm", [3, 4], "П3.1 sп1")
    assert "функция INDIRECT" in group["why"] and "INDIRECT" in group["formula"]
    assert group["name"] in (out / "summary.html").read_text(encoding="utf-8")


def test_one_decision_by_command_serves_the_group(out):
    (group,) = groups(out)
    before = points(out)
    decide(out, GradeSetup(decisions=[(group["name"], "всё", "50%", "ДВССЫЛ: половина")],
                           author="Орлов"))  # fmt: skip
    after = points(out)
    for number in (3, 4):
        assert after[number] == pytest.approx(before[number] + group["of"] / 2, abs=0.011)
    assert after[1] == before[1] and after[2] == before[2]
    assert groups(out) == []
    pages = [page.read_text(encoding="utf-8") for page in (out / "pages").glob("0[34]*.html")]
    assert len(pages) == 2
    assert all("Орлов" in page and "ДВССЫЛ: половина" in page for page in pages)
    with pytest.raises(InputError, match="такая группа работ не ждёт решения"):
        decide(out, GradeSetup(decisions=[(group["name"], "всё", "1", "")]))


def test_one_decision_in_the_gradebook_serves_the_group(handed, out):
    book = load_workbook(out / "gradebook.xlsx")
    sheet = book[GROUPS]
    head = [cell.value for cell in sheet[1]]
    sheet.cell(2, head.index("Решение: баллы") + 1).value = 1.25
    sheet.cell(2, head.index("Решение: примечание") + 1).value = "засчитано"
    book.save(out / "gradebook.xlsx")
    before = points(out)
    handed.graded(out)
    assert points(out)[3] == pytest.approx(before[3] + 1.25, abs=0.011)
    assert groups(out) == []
    handed.graded(out)  # what was taken in stands
    assert points(out)[3] == pytest.approx(before[3] + 1.25, abs=0.011)


def test_a_marked_copy_has_colours_and_comments_and_the_book_stays(handed):
    path = handed.folder / "works" / handed.register.books[1].file
    data = path.read_bytes()
    marker = Marker(handed.register)
    result = marker.mark(Submission(path.name, path, None, None), data)
    (handed.folder / "copy.xlsx").write_bytes(marked_copy(data, result, handed.register.rubric))
    sheet = load_workbook(handed.folder / "copy.xlsx")["П3.1"]
    assert sheet["E6"].fill.fgColor.rgb == "00F6CBCE"
    assert sheet["B6"].fill.fgColor.rgb == "00D5EBDD"
    assert "неверно" in sheet["E6"].comment.text and "обратный знак" in sheet["E6"].comment.text
    assert path.read_bytes() == data
    assert sheet["E7"].value == load_workbook(path)["П3.1"]["E7"].value


def test_symbols_of_a_marked_copy_keep_their_indices(handed):
    copy = marked_copy(classroom.handout(1), {"items": []}, handed.register.rubric)
    heads = load_workbook(io.BytesIO(copy), rich_text=True)["П3.1"]
    assert any(isinstance(cell.value, CellRichText) for row in heads["A1:Z5"] for cell in row)


def test_questions_are_about_the_students_own_numbers():
    assignment = classroom.assignment()
    requested = questions_for(assignment, "seed", ["P3_1.v1_m_s"])
    assert len(requested) == 5 and len({question.item for question in requested}) == 5
    assert requested == questions_for(assignment, "seed", ["P3_1.v1_m_s"])
    assert requested != questions_for(assignment, "other")
    assert (
        "П3.1" not in requested[0].text and "скорость поршня первого порядка" in requested[0].text
    )
    kinds = {question.kind for question in requested}
    assert {"largest", "change", "sign"} <= kinds
    run = Evaluation(assignment.model)
    largest = next(question for question in requested if question.kind == "largest")
    column = run.value(largest.item)
    shown = f"{abs(column).max():.2f}".replace(".", ",")
    assert shown in largest.answer


def test_questions_have_reasons_and_numbers_that_give_the_answer():
    assignment = classroom.assignment(1)
    model, graph = assignment.model, assignment.graph
    requested = [one for seed in range(40) for one in questions_for(assignment, str(seed))]
    assert {one.kind for one in requested} == {"largest", "change", "sign", "substitution"}
    assert not any(
        "° ), а остальное" in one.text or "°), а остальное" in one.text for one in requested
    )
    for one in requested:
        item = next(item for item in assignment.items if item.id == one.item)
        if one.kind == "largest":
            assert re.search(r"Решает .+: .+ против .+\.", one.answer), one.answer
        if one.kind != "substitution":
            continue
        expression = graph.expression(item.nodes[0])
        texts = re.findall(r" = ([−0-9,.·e]+)(?=[;.])", one.answer.partition("Числа:")[2])
        numbers = [float(text.replace(",", ".").replace("−", "-")) for text in texts]
        known = dict(zip(sorted(names(expression)), numbers, strict=True))
        value = float(evaluate_tree(parse(expression), known.__getitem__))
        assert one.answer.startswith(printed(value + 0.0, item.quantity.digits)), one.answer
    twins = Counter(item.symbol for item in assignment.items)
    for one in requested:
        item = next(item for item in assignment.items if item.id == one.item)
        if twins[item.symbol] > 1 and one.item.partition(".")[0] in model.tables:
            blocks = {other.block for other in assignment.items if other.symbol == item.symbol}
            assert ("лист «" in one.text) == (len(blocks) > 1)


def test_copies_and_questions_lie_beside_the_pages_without_answers(handed, tmp_path):
    out = tmp_path / "out"
    handed.graded(out, copies=True, questions=True, workers=1)
    assert len(list((out / "pages").glob("*.xlsx"))) == 4
    sheets = sorted((out / "questions").glob("*.html"))
    assert len(sheets) == 4
    assert 'class="answer"' not in sheets[0].read_text(encoding="utf-8")
    whole = (out / "questions.html").read_text(encoding="utf-8")
    assert whole.count('class="answer"') == 20
    assert all(book.student.full in whole for book in handed.register.books)


def test_pages_without_names_tell_none(handed, tmp_path):
    out = tmp_path / "out"
    handed.graded(out, anonymous=True, questions=True)
    path = form(tmp_path / "form.xlsx", [])
    word = handed.register.books[2].student.full, "всё", "+", ""
    decide(out, GradeSetup(decisions=(word,), author="Гоц", form=path))  # and keeps it so
    assert load_workbook(out / "ведомость.xlsx").active["D7"].value == 5
    lines = [*out.glob("*.html"), *out.glob("pages/*"), *out.glob("questions/*")]
    assert len(lines) == 10
    for page in lines:
        text = page.read_text(encoding="utf-8") + page.name
        for book in handed.register.books:
            for name in (book.student.surname, book.folder, book.file):
                assert name not in text, (page.name, name)
    assert "Студент 3" in (out / "summary.html").read_text(encoding="utf-8")
    book = load_workbook(out / "gradebook.xlsx")
    assert book["Оценки"]["B2"].value == handed.register.books[0].student.full


def form(path: Path, names: list[str]) -> Path:
    book = Workbook()
    sheet = book.active
    sheet.append(["Ведомость"])
    for row, name in enumerate(names, 5):
        sheet.cell(row, 2).value = name
    book.save(path)
    return path


ROWS = [
    {"number": 1, "student": "Яковлев Юрий", "group": "Д-1", "points": 91.0, "manual": False,
     "status": "проверено"},
    {"number": 2, "student": "Иванова Анна", "group": "Д-1", "points": 71.0, "manual": False,
     "status": "проверено"},
    {"number": 3, "student": "Иванова Мария", "group": "Д-1", "points": None, "manual": True,
     "status": "ждёт решения"},
]  # fmt: skip


def written(data: bytes, tmp_path: Path) -> list[tuple]:
    (tmp_path / "filled.xlsx").write_bytes(data)
    sheet = load_workbook(tmp_path / "filled.xlsx").active
    return [tuple(cell.value for cell in line) for line in sheet["B5:D7"]]


def test_the_form_of_an_institute_is_filled_in_by_names(handed, tmp_path):
    path = form(tmp_path / "form.xlsx", ["Иванова М.", "Ю. Яковлев", "Иванова А. П."])
    filled = filled_form(path, ROWS, handed.register.rubric)
    assert written(filled.data, tmp_path) == [
        ("Иванова М.", None, None), ("Ю. Яковлев", 91, 5), ("Иванова А. П.", 71, 4),
    ]  # fmt: skip
    assert filled.left == ("Иванова Мария: ждёт решения",)
    assert load_workbook(tmp_path / "filled.xlsx").active["B2"].value == "Д-1"


def test_an_empty_form_gets_the_list_and_an_unclear_name_no_mark(handed, tmp_path):
    filled = filled_form(form(tmp_path / "a.xlsx", []), ROWS, handed.register.rubric)
    assert written(filled.data, tmp_path)[0] == ("Яковлев Юрий", 91, 5)
    path = form(tmp_path / "b.xlsx", ["Иванова", "Яковлев Юрий"])
    filled = filled_form(path, ROWS, handed.register.rubric)
    assert written(filled.data, tmp_path)[:2] == [("Иванова", None, None), ("Яковлев Юрий", 91, 5)]
    assert len(filled.left) == 2
