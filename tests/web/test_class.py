"""A class of five from its issue to Moodle's file, through the page alone."""

from __future__ import annotations

import csv
import io
import time
import zipfile
from typing import Any

import pytest
from starlette.testclient import TestClient

from reports.web.app import server_secret
from reports.web.teacher import token_of
from tests.grading import classroom
from tests.grading.fill import filled_book
from tests.grading.test_moodle import ENGLISH, worksheet
from tests.web.conftest import MARK, Page

FILE = {**MARK, "content-type": "application/octet-stream"}


@pytest.fixture(scope="module")
def teacher(client: TestClient, page: Page) -> Page:
    settings = client.app.app.state.settings  # type: ignore[attr-defined]
    page.post("/api/login", {"token": token_of(server_secret(settings.data))})
    return page


def settled(page: Page, name: str) -> dict[str, Any]:
    for _ in range(1200):
        found: dict[str, Any] = page.get(f"/api/teacher/{name}")
        if not found["state"].get("doing"):
            return found
        time.sleep(0.1)
    raise AssertionError(found)


def test_a_class_of_five(client: TestClient, teacher: Page) -> None:
    given = {"title": "ДВС-1 <b>", "base": classroom.base_text(), "seed": 7,
             "roster": classroom.roster_text(5)}  # fmt: skip
    name = teacher.post("/api/teacher", given)["name"]
    own = settled(teacher, name)
    assert own["state"]["code"] == 0, own
    assert len(own["students"]) == 5
    every = client.get(f"/api/teacher/{name}/file/issued.zip").content
    assert len(zipfile.ZipFile(io.BytesIO(every)).namelist()) == 5

    # Students: their own books by their own links, and nothing else.
    links = [student["link"] for student in own["students"]]
    fresh = TestClient(client.app, base_url="http://127.0.0.1:8321")
    books = [fresh.get(f"/api/student/{link}/book").content for link in links]
    assert len(set(books)) == 5
    assert fresh.get(f"/api/teacher/{name}").status_code == 403
    assert fresh.get(f"/api/student/{links[0]}/page").status_code == 404
    forged = links[0].replace("-1-", "-2-")
    assert fresh.get(f"/api/student/{forged}").status_code == 404

    found = client.app.app.state.classes.find(name)  # type: ignore[attr-defined]
    register = found.register
    from reports.grading.issuing.issue import assignment_for

    def solved(number: int, **changes: Any) -> bytes:
        assignment = assignment_for(register.books[number - 1], register.rubric)
        return filled_book(books[number - 1], assignment, changes or None)

    handed = fresh.post(f"/api/student/{links[2]}/work", content=solved(3), headers=FILE)
    assert handed.status_code == 200
    assert (
        fresh.post(f"/api/student/{links[2]}/work", content=b"MZ", headers=FILE).status_code == 422
    )
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        archive.writestr("Имя Иванов_101_assignsubmission_file_/р.xlsx", solved(1))
        archive.writestr(
            "Имя Петров_102_assignsubmission_file_/р.xlsx", solved(2, omega=["=regime_speed_rpm"])
        )
    upload = f"/api/teacher/{name}"
    assert (
        client.post(f"{upload}/works", content=stream.getvalue(), headers=FILE).status_code == 200
    )
    sheet = "\ufeff" + worksheet(ENGLISH)
    client.post(f"{upload}/worksheet", content=sheet.encode(), headers=FILE)
    teacher.post(f"{upload}/grade", {})
    teacher.post(f"{upload}/grade", {}, 422)  # one at a time
    own = settled(teacher, name)
    assert own["state"]["code"] in (0, 1), own["state"]
    points = {row["number"]: row["points"] for row in own["rows"]}
    assert points[1] == points[3] == 100
    assert points[2] is not None and points[2] < 100
    assert points[4] is None

    # A decision, and Moodle's file.
    teacher.post(f"{upload}/decide", {"who": "2", "what": "всё", "points": "77", "remark": "="})
    own = settled(teacher, name)
    assert {row["number"]: row["points"] for row in own["rows"]}[2] == 77
    assert {"gradebook.xlsx", "moodle.csv", "moodle-worksheet.csv", "moodle-feedback.zip"} <= set(
        own["files"]
    )
    text = client.get(f"{upload}/file/moodle-worksheet.csv").content.decode("utf-8-sig")
    grades = {line["Identifier"]: line["Grade"] for line in csv.DictReader(io.StringIO(text))}
    assert float(grades["Participant 101"]) == 100
    assert float(grades["Participant 102"]) == 77
    # Pages: the instructor's at once, the student's own when opened, never another's.
    assert "Иванов" in client.get(f"{upload}/page/1").text
    assert fresh.get(f"/api/student/{links[0]}/page").status_code == 404
    teacher.post(f"{upload}/open", {"open": True})
    answer = fresh.get(f"/api/student/{links[0]}/page")
    assert "Иванов" in answer.text and "Петров" not in answer.text
    assert answer.headers["content-security-policy"].startswith("sandbox")
    assert fresh.get(f"/api/student/{links[1]}").json()["points"] == 77
