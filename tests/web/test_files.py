"""Files are made by the commands: one after another, fairly, once for one content."""

from __future__ import annotations

import io
import re
import time
import tomllib
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from reports.commands.engine import build
from reports.web.app import Settings, create_app
from reports.web.jobs import OFFERED
from tests.web.conftest import MARK, Page


def made(page: Page, **data: Any) -> tuple[str, dict[str, Any]]:
    job = page.post("/api/files", data)["id"]
    for _ in range(600):
        found = page.get(f"/api/files/{job}")
        if found["state"] in ("done", "failed"):
            return job, found
        time.sleep(0.1)
    raise AssertionError(found)


def test_kinds_are_those_of_the_command() -> None:
    only = next(option for option in build.params if option.name == "only")
    assert set(only.type.choices) < set(OFFERED)  # type: ignore[attr-defined]


def test_workbook_down_and_up_again(page: Page, client: TestClient) -> None:
    raw = page.sample()
    raw["regime"]["speed_rpm"] = 3210.0
    job, found = made(page, raw=raw, kind="xlsx")
    assert [each["name"] for each in found["files"]] == ["engine.xlsx"]
    answer = client.get(f"/api/files/{job}/engine.xlsx")
    assert answer.headers["content-disposition"].startswith("attachment")
    heads = {**MARK, "content-type": "application/octet-stream"}
    back = client.post("/api/book", content=answer.content, headers=heads).json()
    assert back["raw"]["regime"]["speed_rpm"] == 3210.0
    assert page.post("/api/solve", {"raw": back["raw"], "sheet": "П4.1"})["charts"]
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
    text = page.post("/api/toml", {"raw": raw})["text"]
    assert tomllib.loads(text)["geometry"]["bore_mm"] == 88


def test_a_comparison_needs_two(page: Page) -> None:
    raw = page.sample()
    page.post("/api/files", {"raw": raw, "kind": "compare-xlsx"}, 422)
    _, found = made(page, raw=raw, other=page.sample("yamz-236"), kind="compare-xlsx")
    assert [each["name"] for each in found["files"]] == ["compare.xlsx"]


def test_bad_values_make_no_job(page: Page) -> None:
    raw = page.sample()
    raw["geometry"]["bore_mm"] = -1
    errors = page.post("/api/files", {"raw": raw, "kind": "pdf"}, 422)["errors"]
    assert errors[0]["where"] == "geometry.bore_mm"


@pytest.mark.parametrize("name", ["../secret.key", "order.json", "..%2forder.json", "engine.toml"])
def test_only_what_was_made_is_given(page: Page, client: TestClient, name: str) -> None:
    job, _ = made(page, raw=page.sample(), kind="json")
    assert client.get(f"/api/files/{job}/{name}").status_code == 404


def told(book: bytes) -> tuple[str, list[float]]:
    """A workbook's parts without the values of its cells, and those values."""
    archive = zipfile.ZipFile(io.BytesIO(book))
    text = "".join(archive.read(name).decode() for name in archive.namelist() if "xml" in name)
    value = re.compile(r"<(v|c:v)>(-?[0-9.]+(?:[eE][-+]?[0-9]+)?)</\1>")
    return value.sub("", text), [float(found) for _, found in value.findall(text)]


def test_files_are_built_on_a_cluster(cluster: Any, tmp_path: Path) -> None:
    def calculated() -> set[str]:
        return {event[0] for event in cluster.scheduler.transition_log if event[2] == "memory"}

    before, books = calculated(), []
    for far in (cluster.scheduler_address, None):
        settings = Settings(tmp_path / str(bool(far)), per_s=1e6, workers=1, dask=far)
        with TestClient(create_app(settings), base_url="http://localhost") as client:
            page = Page(client)
            job, _ = made(page, raw=page.sample(), kind="xlsx")
            books.append(client.get(f"/api/files/{job}/engine.xlsx").content)
    assert len(calculated() - before) == 1  # the cluster made the one, this machine the other
    (far_text, far_values), (near_text, near_values) = map(told, books)
    assert far_text == near_text
    np.testing.assert_allclose(far_values, near_values, rtol=1e-9, atol=1e-9)  # last digits differ
