"""One state of a work on the server and in every file, tries at once, a request answered."""

from __future__ import annotations

import csv
import io
import json
import time
from pathlib import Path
from typing import Any

import pytest
from openpyxl import load_workbook
from starlette.testclient import TestClient

from reports.grading.issuing.issue import assignment_for
from reports.grading.issuing.register import SECRET, kept_secret, load_register
from reports.grading.pages.states import State
from reports.web.app import Settings, create_app
from reports.web.classes import token_of
from reports.workbook.layout import Layout
from tests.grading import classroom
from tests.grading.fill import filled_book, solved_formulas
from tests.grading.test_states import IDLE
from tests.web.conftest import MARK, Page

FILE = {**MARK, "content-type": "application/octet-stream"}
RUBRIC = '[work]\nfill = ["geometry", "masses", "P3_1", "P4_1"]\n[attempts]\ntries = 2\n'


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("states")


@pytest.fixture(scope="module")
def page(data: Path) -> Any:
    with TestClient(create_app(Settings(data, per_s=1e6, workers=1)),
                    base_url="http://127.0.0.1:8322") as client:  # fmt: skip
        yield Page(client)


def done(page: Page, name: str) -> dict[str, Any]:
    for _ in range(600):
        lines: dict[str, Any] = page.get(f"/api/teacher/{name}")
        if lines["state"] not in ("waiting", "running"):
            return lines
        time.sleep(0.2)
    raise AssertionError(lines)


def test_a_held_work_is_held_on_the_server_as_in_every_file(page: Page, data: Path) -> None:
    page.post("/api/login", {"token": token_of(kept_secret(data / SECRET))})
    group = {"base.toml": classroom.base_text(), "roster": classroom.roster_text(3),
             "rubric.toml": RUBRIC}  # fmt: skip
    sent = {key: text.encode().decode("latin-1") for key, text in group.items()}
    name = page.post("/api/teacher", {**sent, "title": "Г", "seed": "3"})["name"]
    message = done(page, name)
    folder = data / "classes" / name
    register = load_register(folder / "issued")
    links = [f"/api/student/{each['link']}" for each in message["students"]]
    for number, link in enumerate(links, 1):
        assignment = assignment_for(register.books[number - 1], register.rubric)
        own = solved_formulas(assignment, Layout.of(assignment.model))
        idle = {node: [f"{text}+0" for text in own[node]] for node in IDLE}
        changes = idle if number < 3 else {"omega": ["=regime_speed_rpm"]}
        book = filled_book(page.client.get(f"{link}/book").content, assignment, changes)
        answer = page.client.post(f"{link}/work", content=book, headers=FILE).json()
        assert answer["try"].startswith("верно "), answer
        assert answer["try"].endswith("на листе Массы") == (number == 3)
        assert page.get(link)["tries"] == [1, 2]
    page.post(f"/api/teacher/{name}/grade", {})
    message = done(page, name)
    page.post(f"/api/teacher/{name}/rules", {"open": True})
    results = folder / "results"
    rows = json.loads((results / "summary.json").read_text(encoding="utf-8"))["rows"]
    states = [row["status"] for row in rows]
    assert states == [State.HELD, State.HELD, State.CHECKED]
    files = {path: json.loads(path.read_text(encoding="utf-8"))
             for path in sorted((results / "results").glob("0*.json"))}  # fmt: skip
    table = (results / "gradebook.csv").read_text("utf-8-sig")
    cells = [*csv.DictReader(io.StringIO(table), delimiter=";")]
    head, *lines = load_workbook(results / "gradebook.xlsx")["Оценки"].iter_rows(values_only=True)
    moodle = [*csv.DictReader(io.StringIO((results / "moodle.csv").read_text("utf-8")))]
    assert [row["status"] for row in message["rows"]] == states  # the teacher's page
    assert [each["state"] for each in files.values()] == states
    assert [each["Состояние"] for each in cells] == states
    assert [line[head.index("Состояние")] for line in lines[:3]] == states
    assert [each["State"] for each in moodle] == states
    for link, row, one, cell in zip(links, rows, files.values(), cells, strict=True):
        student = page.get(link)
        assert (student["status"], student["points"]) == (row["status"], row["points"])
        assert one["points"] == row["points"]
        assert cell["Баллы"] == (
            "" if row["points"] is None else f"{row['points']:g}".replace(".", ",")
        )
        assert f"Состояние: {row['status']}." in page.client.get(f"{link}/page").text
    whole = page.client.get(f"/api/teacher/{name}/file/summary.html").text
    assert whole.count(f">{State.HELD}<") == 2
    side = next((results / "рядом").glob("*.html"))
    assert page.client.get(f"/api/teacher/{name}/file/рядом/{side.name}").status_code == 200
    # Another look is asked for, and its answer stands on the page.
    page.post(f"{links[2]}/ask", {"column": "Массы ω", "text": "так в задании"})
    assert done(page, name)["rows"][2]["status"] == State.BY_HAND
    requested = {"who": "3", "what": "geometry.omega", "points": "1", "remark": "половина"}
    page.post(f"/api/teacher/{name}/grade", requested)
    assert done(page, name)["rows"][2]["status"] == State.CHECKED
    text = page.client.get(f"{links[2]}/page").text
    assert "так в задании" in text and "половина" in text and "Ответа пока нет" not in text
