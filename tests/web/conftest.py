from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from reports.web.app import Settings, create_app

MARK = {"X-Kshm": "1"}


class Page:
    """A person's browser without its window."""

    def __init__(self, client: TestClient) -> None:
        self.client = client

    def post(self, path: str, data: Any, code: int = 200) -> Any:
        answer = self.client.post(path, json=data, headers=MARK)
        assert answer.status_code == code, answer.text
        return answer.json()

    def get(self, path: str, code: int = 200) -> Any:
        answer = self.client.get(path)
        assert answer.status_code == code, answer.text
        return answer.json()

    def sample(self, name: str = "gots-diesel") -> dict[str, Any]:
        raw: dict[str, Any] = self.post("/api/new", {"sample": name})["raw"]
        return raw


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    data: Path = tmp_path_factory.mktemp("data")
    app = create_app(Settings(data, per_s=1e6, workers=1))
    with TestClient(app, base_url="http://127.0.0.1:8321") as client:
        yield client


@pytest.fixture(scope="module")
def page(client: TestClient) -> Page:
    return Page(client)
