"""The command ``serve``: whom it refuses, what it prints, what it leaves and finds."""

from __future__ import annotations

import shutil
import ssl
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import httpx2
import psutil
import pytest
from click.testing import CliRunner
from starlette.testclient import TestClient

from reports.cli import main
from reports.grading.issuing.register import SECRET, kept_secret
from reports.shared import files
from reports.web import command
from reports.web.app import Settings, create_app
from reports.web.classes import token_of
from tests.web.conftest import MARK, Page, Served, serving


def test_a_second_server_on_one_folder_is_refused(served: Served) -> None:
    done = CliRunner().invoke(main, ["serve", "--data", str(served.data), "--port", "1"])
    assert done.exit_code == 2 and "папку уже держит другой сервер" in done.stderr


@pytest.mark.skipif(sys.platform != "linux", reason="processes of Linux")
def test_nothing_outlives_a_killed_server_and_what_is_half_made_goes(tmp_path: Path) -> None:
    with (
        serving(tmp_path) as server,
        httpx2.Client(headers=MARK, trust_env=False, timeout=60) as web,
    ):
        raw = web.post(f"{server.page}api/new", json={"sample": "gots-diesel"}).json()["raw"]
        web.post(f"{server.page}api/files", json={"raw": raw, "kind": "pdf"})
        time.sleep(2.5)
        family = psutil.Process(server.process.pid).children(recursive=True)
        assert len(family) > 4
        server.process.kill()
        server.process.wait()
        _, alive = psutil.wait_procs(family, timeout=5)
        assert not [p for p in alive if p.is_running() and p.status() != psutil.STATUS_ZOMBIE]
    half = [tmp_path / "book-x", tmp_path / "jobs" / ("0" * 40), tmp_path / "classes" / "1"]
    for folder in half:
        folder.mkdir(parents=True)
        (folder / ".kshm-1").write_text("half")
    with serving(tmp_path) as server:
        assert httpx2.get(server.page, trust_env=False).status_code == 200
    assert not any(folder.exists() for folder in half)


def test_the_network_is_told_its_addresses_and_that_nothing_is_encrypted(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("uvicorn.Server.run", lambda *_: None)
    monkeypatch.setattr(command, "_own_addresses", lambda: ["192.168.1.5", "127.0.0.1"])
    wide = ["serve", "--host", "0.0.0.0", "--port", "8329", "--data", str(tmp_path / "d")]
    done = CliRunner().invoke(main, wide)
    assert done.exit_code == 0, done.output
    assert "http://192.168.1.5:8329/teacher#" in done.stdout
    assert "http://127.0.0.1:8329/" in done.stdout
    assert "не шифруются" in done.stderr
    narrow = CliRunner().invoke(main, ["serve", "--port", "8329", "--data", str(tmp_path / "d")])
    assert "не шифруются" not in narrow.stderr and "0.0.0.0" not in narrow.stdout


def test_the_own_addresses_are_no_loops() -> None:
    own = command._own_addresses()
    assert own[-1] == "127.0.0.1" and not any(name.startswith("127.") for name in own[:-1])


def test_a_certificate_encrypts(tmp_path: Path) -> None:
    openssl = shutil.which("openssl")
    if openssl is None:
        pytest.skip("нет openssl")
    cert, key = tmp_path / "c.pem", tmp_path / "k.pem"
    subprocess.run(
        [openssl, "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1",
         "-nodes", "-keyout", key, "-out", cert, "-days", "2", "-subj", "/CN=localhost",
         "-addext", "subjectAltName=IP:127.0.0.1"],
        check=True, capture_output=True,
    )  # fmt: skip
    with serving(tmp_path, "data", "--certificate", str(cert), "--key", str(key)) as server:
        assert server.page.startswith("https://")
        known = ssl.create_default_context(cafile=str(cert))
        assert httpx2.get(server.page, verify=known, trust_env=False).status_code == 200


@pytest.mark.parametrize(("keys", "said"), [
    (["--key", "k.pem"], "ключ без сертификата"),
    (["--certificate", "bad.pem"], "не читается; нужны файлы PEM"),
    (["--certificate", "none.pem"], "нет такого файла"),
])  # fmt: skip
def test_a_wrong_certificate_is_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, keys: list[str], said: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("bad.pem").write_text("no certificate", encoding="utf-8")
    done = CliRunner().invoke(main, ["serve", *keys])
    assert done.exit_code == 2 and said in done.stderr and len(done.stderr.splitlines()) == 1


def test_wrong_keys_do_not_keep_the_right_one_out(tmp_path: Path) -> None:
    app = create_app(Settings(tmp_path, per_s=1e6, workers=1))
    with TestClient(app, base_url="http://localhost") as client:
        page = Page(client)
        codes = [client.post("/api/login", json={"token": "x"}, headers=MARK).status_code
                 for _ in range(11)]  # fmt: skip
        assert codes == [403] * 10 + [429]
        page.post("/api/login", {"token": token_of(kept_secret(tmp_path / SECRET))})
        assert page.get("/api/teacher")["classes"] == []
        copy = dict(client.cookies)
        page.post("/api/logout", {})
        page.get("/api/teacher", 403)
        client.cookies.update(copy)  # the session has ended here, not in the browser alone
        page.get("/api/teacher", 403)


def test_a_session_outlives_the_server_and_ends_alone(tmp_path: Path) -> None:
    def entered(client: TestClient) -> Page:
        page = Page(client)
        page.post("/api/login", {"token": token_of(kept_secret(tmp_path / SECRET))})
        return page

    def address() -> TestClient:
        return TestClient(create_app(Settings(tmp_path, workers=1)), base_url="http://localhost")

    with address() as first, address() as second:
        entered(first)
        entered(second).post("/api/logout", {})
        cookies = dict(first.cookies)
        assert first.get("/api/teacher").status_code == 200
    with address() as later:
        later.cookies.update(cookies)
        assert later.get("/api/teacher").status_code == 200


@pytest.mark.parametrize(
    ("public", "path"), [("https://kafedra.example/kshm", "/kshm/"), ("", "/")]
)
def test_the_cookie_stays_under_the_public_path(tmp_path: Path, public: str, path: str) -> None:
    app = create_app(Settings(tmp_path, public=public, workers=1))
    head = {"host": "kafedra.example" if public else "localhost"}
    said = TestClient(app).get(path, headers=head).headers["set-cookie"]
    assert f"path={path};" in said


def test_a_full_disk_and_a_bug_are_one_sentence_without_folders(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    app = create_app(Settings(tmp_path, per_s=1e6, workers=1))
    with TestClient(app, base_url="http://localhost", raise_server_exceptions=False) as client:
        page = Page(client)
        raw = page.sample()

        def full(*_: Any, **__: Any) -> None:
            raise OSError(28, "No space left on device", str(tmp_path / "x"))

        monkeypatch.setattr(files, "_create", full)
        said = page.client.post("/api/files", json={"raw": raw, "kind": "json"}, headers=MARK)
        assert said.status_code == 507 and "не удаётся записать" in said.text
        assert str(tmp_path) not in said.text and "Errno" not in said.text

        def broken(*_: Any) -> None:
            raise ZeroDivisionError(str(tmp_path))

        monkeypatch.setattr(app.app.state.jobs, "add", broken)
        said = page.client.post("/api/files", json={"raw": raw, "kind": "json"}, headers=MARK)
        assert said.status_code == 500 and len(said.json()["errors"]) == 1
        assert "внутренняя ошибка" in said.text
        assert not any(word in said.text for word in (str(tmp_path), "Zero", "Traceback"))
