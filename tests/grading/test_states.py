"""One state of a work wherever it is told: page, JSON, gradebook, workbook, Moodle, class."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

from openpyxl import load_workbook

from reports.grading.batch import grade as room
from reports.grading.batch.grade import GradeSetup, decide, grade
from reports.grading.judging import collusion
from reports.grading.pages.gradebook import TITLE
from reports.grading.pages.side_by_side import COMPARED
from reports.grading.pages.states import State
from reports.workbook.layout import Layout
from tests.grading import classroom
from tests.grading.fill import filled_book, solved_formulas
from tests.grading.test_moodle import ENGLISH, worksheet

IDLE = ("P3_1.v1_m_s", "P3_1.j1_m_s2", "P4_1.M_Nm", "P3_1.s1_mm")
UNKNOWN = {"V_c": ['=INDIRECT("V_h")/17']}


def works(folder: Path) -> Path:
    """Two of one rare manner, one that a person has to look at, one that cannot be read."""
    folder.mkdir()
    for number in (1, 2, 3):
        assignment = classroom.assignment(number)
        own = solved_formulas(assignment, Layout.of(assignment.model))
        idle = {node: [f"{text}+0" for text in own[node]] for node in IDLE}
        data = filled_book(classroom.handout(number), assignment, idle if number < 3 else UNKNOWN)
        (folder / classroom.book(number).file).write_bytes(data)
    (folder / f"{classroom.book(4).folder}.ods").write_bytes(b"x")
    return folder


def graded(where: Path, out: Path, *words: tuple[str, str, str, str]) -> None:
    folder, sheet = classroom.folder(), out.with_name("worksheet.csv")
    sheet.write_text(worksheet(ENGLISH).replace("999,Никто", "103,Имя Сидорова"), encoding="utf-8")
    options = GradeSetup(workers=1, decisions=words, worksheet=sheet)
    grade(folder / "issued", where, out, secret_file=folder / "secret.key", options=options)


def told(out: Path) -> dict[str, list[tuple[str, float | None]]]:
    """State and points of each student as each output has them."""

    def rows(name: str, delimiter: str) -> list[dict[str, str]]:
        text = (out / name).read_text(encoding="utf-8-sig")
        return list(csv.DictReader(io.StringIO(text), delimiter=delimiter))

    def number(text: object) -> float | None:
        return float(str(text).replace(",", ".")) if text not in ("", None) else None

    book = load_workbook(out / "gradebook.xlsx")
    sheets = {}
    for title in ("Оценки", TITLE):
        head, *lines = book[title].iter_rows(values_only=True)
        at = [head.index(word) for word in ("Состояние", "Баллы")]
        sheets[title] = [(line[at[0]], line[at[1]]) for line in lines if line[0]]
    results = [json.loads(path.read_text(encoding="utf-8"))
               for path in sorted((out / "results").glob("0*.json"))]  # fmt: skip
    table = rows("gradebook.csv", ";")
    whole = json.loads((out / "summary.json").read_text(encoding="utf-8"))["rows"]
    return {
        "json": [(each["state"], each.get("points")) for each in results],
        "csv": [(each["Состояние"], number(each["Баллы"])) for each in table],
        "summary": [(each["status"], each["points"]) for each in whole],
        **sheets,
    }


def pages(out: Path) -> list[str]:
    return [path.read_text(encoding="utf-8") for path in sorted((out / "pages").glob("0*.html"))]


def test_every_output_says_one_state(tmp_path, monkeypatch):
    monkeypatch.setattr(room, "grade_all", classroom.graded_here)
    where, out = works(tmp_path / "in"), tmp_path / "out"
    for _ in range(2):  # and the second run takes over what the first has written
        graded(where, out)
        tables = told(out)
        first = tables["summary"]
        assert [state for state, _ in first] == [
            State.HELD, State.HELD, State.BY_HAND, State.REFUSED,
        ]  # fmt: skip
        assert [points for _, points in first[:2]] == [None, None]
        assert all(table == first for table in tables.values()), tables
        for page, (state, _) in zip(pages(out), first, strict=True):
            assert f"Состояние: {state}." in page
        assert all("пока 100 из 100 баллов" in page for page in pages(out)[:2])
        assert all(classroom.book(2).student.surname not in page for page in pages(out)[:1])
        held = json.loads(next((out / "results").glob("01*.json")).read_text(encoding="utf-8"))
        assert held["provisional"] == 100 and "бит" in held["doubts"][0]
        moodle = list(csv.DictReader(io.StringIO((out / "moodle.csv").read_text("utf-8"))))
        assert [line["State"] for line in moodle] == [state for state, _ in first]
        assert not any(line["Grade"] for line in moodle)
        assert not any(line["Feedback"] for line in moodle[:2])
        assert all("бит" in line["For the teacher"] for line in moodle[:2])
        filled = csv.DictReader(io.StringIO((out / "moodle-worksheet.csv").read_text("utf-8-sig")))
        assert not any(line["Grade"] for line in filled)
        text = (out / "summary.html").read_text(encoding="utf-8")
        assert text.count(f">{State.HELD}<") == 2
        # Before he decides the teacher sees the two beside each other, no student does.
        (side,) = (out / COMPARED).glob("*.html")
        beside = side.read_text(encoding="utf-8")
        assert f"{COMPARED}/{side.name}" in text and "лишнее действие, слово в слово" in beside
        own = json.loads(next((out / "results").glob("02*.json")).read_text("utf-8"))["texts"]
        assert beside.count(f"<code>{own['P3_1.s1_mm']}</code>") == 2
        assert not any(COMPARED in page for page in pages(out))
    words = (("1", "всё", "+", "сам"), ("2", "всё", "40", ""), ("3", "всё", "×0,5", ""),
             ("4", "всё", "70", ""))  # fmt: skip
    decide(out, GradeSetup(decisions=words))
    for _ in range(2):
        tables = told(out)
        assert all(table == tables["summary"] for table in tables.values()), tables
        assert [state for state, _ in tables["summary"]][:3] == [State.CHECKED] * 3
        assert [points for _, points in tables["summary"]][:2] == [100, 40]
        assert "пока" not in "".join(pages(out)[:3])
        graded(where, out)
    decide(out, GradeSetup(decisions=[(each[0], "всё", "-", "") for each in words]))
    assert told(out)["json"] == told(out)["summary"] == first


def test_what_two_works_share_stands_in_the_gradebook_and_for_moodle_with_its_bits(
    tmp_path, monkeypatch
):
    """Where it is too little to hold them, students do not read it."""
    monkeypatch.setattr(room, "grade_all", classroom.graded_here)
    monkeypatch.setattr(collusion, "HELD", 100.0)
    where, out = works(tmp_path / "in"), tmp_path / "out"
    graded(where, out)
    assert told(out)["summary"][0] == (State.CHECKED, 100)
    moodle = list(csv.DictReader(io.StringIO((out / "moodle.csv").read_text("utf-8"))))
    assert moodle[0]["Grade"] == "100" and "сходство" not in moodle[0]["Feedback"]
    filled = (out / "moodle-worksheet.csv").read_text("utf-8-sig")
    assert "сходство" not in filled and "сходство" not in "".join(pages(out))
    sheet = str(list(load_workbook(out / "gradebook.xlsx")["Оценки"].values))
    for text in (moodle[0]["For the teacher"], sheet, (out / "gradebook.csv").read_text("utf-8"),
                 (out / "summary.html").read_text("utf-8")):  # fmt: skip
        assert "сходство: общее с: Петров Имя" in text and " бит" in text
