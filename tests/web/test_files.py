"""Files are made by the commands: one after another, fairly, once for one content."""

from __future__ import annotations

import io
import time
import zipfile
from typing import Any

import openpyxl
import pytest
from starlette.testclient import TestClient

from reports.commands.engine import build
from reports.web.jobs import OFFERED
from tests.web.conftest import MARK, Page


def made(page: Page, **data: Any) -> tuple[str, dict[str, Any]]:
    job = page.post("/api/files", data)["id"]
    for _ in range(600):
        actual = page.get(f"/api/files/{job}")
        if actual["state"] in ("done", "failed"):
            return job, actual
        time.sleep(0.1)
    raise AssertionError(actual)


def test_kinds_are_those_of_the_command() -> None:
    only = next(option for option in build.params if option.name == "only")
    assert set(only.type.choices) < set(OFFERED)  # type: ignore[attr-defined]


def typed_over(book: bytes) -> bytes:
    """The book with a number over a formula."""
    opened = openpyxl.load_workbook(io.BytesIO(book))
    assert str(opened["Итоги"]["C6"].value).startswith("=")
    opened["Итоги"]["C6"] = 5.0
    written = io.BytesIO()
    opened.save(written)
    return written.getvalue()


def test_workbook_down_and_up_again(page: Page, client: TestClient) -> None:
    raw = page.sample()
    raw["regime"]["speed_rpm"] = 3210.0
    job, actual = made(page, raw=raw, kind="xlsx")
    assert [each["file"] for each in actual["files"]] == ["engine.xlsx"]
    answer = client.get(f"/api/files/{job}/engine.xlsx")
    assert answer.headers["content-disposition"].startswith("attachment")
    heads = {**MARK, "content-type": "application/octet-stream"}
    back = client.post("/api/book", content=answer.content, headers=heads).json()
    assert back["raw"]["regime"]["speed_rpm"] == 3210.0
    assert back["lost"] == []
    typed = client.post("/api/book", content=typed_over(answer.content), headers=heads).json()
    assert [line.partition(":")[0] for line in typed["lost"]] == ["книга.xlsx, Итоги!C6"]
    assert page.post("/api/settle", {"raw": back["raw"]})["remarks"]
    # The same once more is there at once.
    assert page.post("/api/files", {"raw": raw, "kind": "xlsx"})["id"] == job
    assert page.get(f"/api/files/{job}")["state"] == "done"


def test_tables_and_numbers(page: Page, client: TestClient) -> None:
    raw = page.sample()
    job, _ = made(page, raw=raw, kind="csv")
    data = client.get(f"/api/files/{job}/tables.zip").content
    assert "P3_1.csv" in zipfile.ZipFile(io.BytesIO(data)).namelist()
    job, _ = made(page, raw=raw, kind="json")
    assert client.get(f"/api/files/{job}/engine.json").json()["tables"]["P3_1"]


def test_a_comparison_needs_two(page: Page) -> None:
    raw = page.sample()
    page.post("/api/files", {"raw": raw, "kind": "compare-xlsx"}, 422)
    _, actual = made(page, raw=raw, other=page.sample("yamz-236"), kind="compare-xlsx")
    assert [each["file"] for each in actual["files"]] == ["compare.xlsx"]


def test_bad_values_make_no_job(page: Page) -> None:
    raw = page.sample()
    raw["geometry"]["bore_mm"] = -1
    errors = page.post("/api/files", {"raw": raw, "kind": "pdf"}, 422)["errors"]
    assert errors[0]["where"] == "geometry.bore_mm"


@pytest.mark.parametrize("name", ["../secret.key", "order.json", "..%2forder.json", "engine.toml"])
def test_only_what_was_made_is_given(page: Page, client: TestClient, name: str) -> None:
    job, _ = made(page, raw=page.sample(), kind="json")
    assert client.get(f"/api/files/{job}/{name}").status_code == 404
