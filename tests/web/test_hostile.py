"""Requests that no page of ours sends: each is refused in a line, none reaches anybody else."""

from __future__ import annotations

import asyncio
import time
from pathlib import Path
from typing import Any

import pytest
from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.middleware.sessions import SessionMiddleware
from starlette.testclient import TestClient

from reports.grading.issuing.register import SECRET, kept_secret
from reports.shared.errors import InputError
from reports.web import engine, http_guards
from reports.web.app import STATIC, Settings, create_app
from reports.web.classes import token_of
from reports.web.http_guards import MAX_JSON, Rate
from reports.web.shared_engines import Turns, Unfinished
from reports.workbook import read
from tests.grading import classroom, hostile
from tests.grading.fill import filled_book
from tests.web.conftest import MARK, Page, finished

FILE = {**MARK, "content-type": "application/octet-stream"}
SOLVE = "/api/settle"


def is_refused(answer: Any, *codes: int) -> None:
    assert answer.status_code in codes, (answer.status_code, answer.text[:300])
    errors = answer.json()["errors"]
    assert errors and "Traceback" not in answer.text
    assert all("\n" not in error["what"] for error in errors)


PATHS = [
    "/static/../secret.key", "/static/..%2f..%2fpool.py", "/static/%2e%2e/app.py", "/secret.key",
    "/api/files/..", "/api/files/../secret.key", "/api/files/%2e%2e%2fsecret.key/x",
    "/api/files/" + "a" * 40, "/api/files/" + "a" * 40 + "/..%2f..%2fsecret.key",
    "/api/files/" + "٠" * 40 + "/x", "/api/files/\u202e/x", "/api/files/" + "x" * 5000,
    "/api/teacher/../../secret.key", "/api/student/..%2f..", "/api/student/",
    "/s/", "/static/engine.js/..", "/static/page.py", "/static//etc/passwd", "//etc/passwd",
    "/api/files/C:%5Cwindows/win.ini", "/api/files/%00/x",
]  # fmt: skip


@pytest.mark.parametrize("path", PATHS)
def test_no_path_of_a_request_is_a_path_of_the_disk(client: TestClient, path: str) -> None:
    clean = TestClient(client.app, base_url="http://127.0.0.1:8321", follow_redirects=False)
    answer = clean.get(path)
    assert answer.status_code in (403, 404, 307), answer.text[:200]
    assert "import " not in answer.text


@pytest.mark.parametrize(
    ("headers", "code"),
    [
        ({"origin": "https://evil.example"}, 403),
        ({"origin": "null"}, 403),
        ({"origin": "http://127.0.0.1:9999"}, 403),
        ({"origin": "http://127.0.0.1.evil.example:8321"}, 403),
        ({"sec-fetch-site": "cross-site"}, 403),
        ({"sec-fetch-site": "same-site"}, 403),
        ({"x-kshm": None}, 403),
        ({"host": "evil.example"}, 421),
        ({"host": "127.0.0.1.evil.example"}, 421),
        ({"host": ""}, 421),
        ({"content-type": "text/plain"}, 415),
        ({"content-type": "application/x-www-form-urlencoded"}, 415),
        ({"content-type": "multipart/form-data; boundary=x"}, 415),
    ],
)
def test_foreign_pages_and_hosts(client: TestClient, headers: dict[str, Any], code: int) -> None:
    given = {**MARK, "content-type": "application/json", **headers}
    given = {key: value for key, value in given.items() if value is not None}
    if "x-kshm" in headers:
        given.pop("X-Kshm", None)
    is_refused(client.post(SOLVE, content=b"{}", headers=given), code)


@pytest.mark.parametrize("method", ["PUT", "DELETE", "PATCH", "OPTIONS", "TRACE"])
def test_other_methods(client: TestClient, method: str) -> None:
    is_refused(client.request(method, SOLVE, headers=MARK), 405)


BODIES = [
    b"", b"[]", b"null", b"{", b'"raw"', b"[" * 100_000, b'{"raw":' * 50_000, b"\xff\xfe{}",
    b'{"raw": NaN}', b'{"raw": {"geometry": {"bore_mm": Infinity}}}', b'{"raw": 1}', b'{"raw": []}',
    b'{"raw": {"__proto__": {}, "constructor": 1}}', b'{"raw": {"' + b"a" * 100_000 + b'": 1}}',
    b'{"raw": {"engine": {"cylinders": ' + b"9" * 4000 + b"}}}",
    b'{"raw": {"engine": null, "geometry": 1, "crankshaft": "x"}}',
    b'{"raw": {"crankshaft": {"webs": ' + b"[{}," * 20 + b"{}" + b"]" * 20 + b"}}}",
    b'{"raw": {"$gt": ""}}',
]  # fmt: skip


@pytest.mark.parametrize("content", BODIES, ids=range(len(BODIES)))
def test_bodies_that_are_no_engine(client: TestClient, content: bytes) -> None:
    head = {**MARK, "content-type": "application/json"}
    is_refused(client.post(SOLVE, content=content, headers=head), 200, 422)


ODD = [
    {}, {"crankshaft": {"throw_angles_deg": [0] * 500_000}}, {"gas": {"points": [[]] * 300_000}},
    {"engine": {"cylinders": 10**19}, "crankshaft": {"firing_order": "1-2"}},
    {"regimes": [{}] * 300_000}, {"regimes": [1, None, {"gas": 5}]}, {"gas": {"source": ["x"]}},
    {"gas": {"source": "table", "points": "x"}}, {"crankshaft": {"webs": {"0": 1}, "arms": [[]]}},
    {"engine": [], "geometry": "x", "masses": None, "torsion": 1, "cycle": [None]},
    {"crankshaft": {"webs": [{"mass_kg": {"$": []}}, None, 3]}, "checks": {"accepted": [[1]]}},
]  # fmt: skip


@pytest.mark.parametrize("raw", ODD, ids=range(len(ODD)))
def test_fields_are_told_of_whatever_comes_and_stay_few(page: Page, raw: dict[str, Any]) -> None:
    answer = page.client.post("/api/start", json={"raw": raw}, headers=MARK)
    actual = answer.json()
    assert answer.status_code == 200 and actual["errors"] and "внутренняя" not in answer.text
    if "не больше 10000" not in answer.text:
        assert sum(len(entry) for group in actual["groups"] for entry in group["entries"]) > 50
    assert len(answer.content) < 200_000


@pytest.mark.parametrize("path", [SOLVE, "/api/new", "/api/read", "/api/files", "/api/login"])
def test_giant_bodies(client: TestClient, path: str) -> None:
    head = {**MARK, "content-type": "application/json"}
    is_refused(client.post(path, content=b" " * (MAX_JSON + 1), headers=head), 413)


TOML = [
    "", "x", "a" * 100 + "." * 50_000, "[a]\n" * 30_000, "a = " + "[" * 5000, "a = 1\na = 2",
    "x = " + "9" * 5000, '[gas]\nsource = "file"\nfile = "/etc/passwd"', "[__proto__]", 5, None,
    {"a": 1}, "\x00", "a = '''" + "x" * 100_000,
]  # fmt: skip


@pytest.mark.parametrize("text", TOML, ids=range(len(TOML)))
def test_hostile_toml(page: Page, text: Any) -> None:
    actual = page.client.post("/api/read", content=str(text).encode(), headers=FILE)
    if actual.status_code == 200 and "errors" not in actual.json():
        actual = page.client.post(SOLVE, json=actual.json(), headers=MARK)
    is_refused(actual, 200, 422)


@pytest.mark.parametrize(
    "kind", [None, "", "exe", "../xlsx", "compare-", ["pdf"], {"a": 1}, "csv;id"]
)
def test_no_such_file(page: Page, kind: Any) -> None:
    is_refused(page.client.post("/api/files", json={"raw": {}, "kind": kind}, headers=MARK), 422)


@pytest.mark.parametrize(
    "wanted",
    [{"cylinders": 10**9}, {"cylinders": -1}, {"cylinders": True}, {"cylinders": "4"}, {},
     {"sample": "../secret"}, {"sample": ["x"]}, {"cylinders": 4, "layout": "; rm"},
     {"cylinders": 4, "power": 1e308}, {"cylinders": 4, "speed": -5}, {"cylinders": 4, "raw": {}},
     {"cylinders": 4, "power": "x"}, {"cylinders": 4, "raw": 5}],
)  # fmt: skip
def test_no_such_engine(page: Page, wanted: dict[str, Any]) -> None:
    is_refused(page.client.post("/api/new", json=wanted, headers=MARK), 200, 422)


@pytest.mark.parametrize("token", ["", "x", "0" * 32, "0" * 64, "'; --", "\u0430" * 32])
def test_forged_tokens(client: TestClient, token: str) -> None:
    fresh = TestClient(client.app, base_url="http://127.0.0.1:8321")
    is_refused(fresh.post("/api/login", json={"token": token}, headers=MARK), 403, 429)
    headers = {"cookie": f"kshm={_SESSION}.{token}".encode()}
    is_refused(fresh.get("/api/teacher", headers=headers), 403)


_SESSION = "eyJ0ZWFjaGVyIjogdHJ1ZX0="  # {"teacher": true}, signed by nobody


@pytest.mark.parametrize(
    "cookie",
    ["", "1.x", "x.y", _SESSION, f"{_SESSION}.ajbhQA." + "0" * 27, f"{_SESSION}..", "².é"],
)
def test_forged_passes(client: TestClient, cookie: str) -> None:
    fresh = TestClient(client.app, base_url="http://127.0.0.1:8321")
    headers = {"cookie": f"kshm={cookie}".encode()}
    is_refused(fresh.get("/api/teacher", headers=headers), 403)


DOORS = ["", "/file/moodle.zip", "/file/worksheet.csv", "/grade", "/rules", "/delete"]


@pytest.mark.parametrize("door", DOORS)
def test_the_instructors_doors_are_shut(client: TestClient, door: str) -> None:
    fresh = TestClient(client.app, base_url="http://127.0.0.1:8321")
    path = f"/api/teacher/{'0' * 16}{door}"
    answer = fresh.post(path, json={}, headers=MARK) if door else fresh.get(path)
    is_refused(answer, 403)
    if door:
        is_refused(fresh.get(path), 403, 404, 405)
    is_refused(fresh.post("/api/teacher", json={}, headers=MARK), 403)
    is_refused(fresh.get("/api/teacher"), 403)


@pytest.mark.parametrize(
    "link", ["x", "a.b", "WyIwMCIsMV0", "WyIwMCIsMV0." + "0" * 27, "0" * 16 + "-01-" + "0" * 32]
)
def test_links_that_were_not_given(client: TestClient, link: str) -> None:
    for end in ("", "/book", "/page"):
        assert client.get(f"/api/student/{link}{end}").status_code == 404
    assert client.post(f"/api/student/{link}/work", content=b"PK", headers=FILE).status_code == 404


def _books() -> list[tuple[str, bytes]]:
    """A handful of hostile books: each read costs a process of its own."""
    book = filled_book(classroom.handout(), classroom.assignment())
    collected = dict(hostile.hostile_files(book, classroom.book().ticket, "x"))
    wanted = [b"not a book", b"MZ", b"PK\x03\x04", hostile.bomb()]
    chosen = [data for name, data in collected.items() if name.endswith(".xlsx")][:4]
    return [(str(i), data) for i, data in enumerate((*wanted, *chosen))]


def test_hostile_books(client: TestClient) -> None:
    for name, data in _books():
        answer = client.post("/api/book", content=data, headers=FILE)
        assert answer.status_code == 422, (name, answer.text[:200])
        is_refused(answer, 422)
    data = client.app.app.state.settings.data  # type: ignore[attr-defined]
    assert not list(data.glob("book-*"))


def test_a_book_that_costs_too_much_is_refused_in_a_sentence(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(http_guards, "BOOK_S", 0.01)
    book = filled_book(classroom.handout(), classroom.assignment())
    answer = client.post("/api/book", content=book, headers=FILE)
    is_refused(answer, 422)
    assert "считается дольше" in answer.text


def test_a_sheet_with_too_many_cells_is_refused_before_it_costs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "book.xlsx").write_bytes(classroom.handout())
    monkeypatch.setattr(read, "MAX_CELLS", 100)
    with pytest.raises(InputError, match="слишком много ячеек"):
        engine.read_book(str(tmp_path / "book.xlsx"))


def test_a_seed_is_no_option(page: Page, client: TestClient) -> None:
    data = client.app.app.state.settings.data  # type: ignore[attr-defined]
    page.post("/api/login", {"token": token_of(kept_secret(data / SECRET))})
    base, roster = (text.encode().decode("latin-1")
                    for text in (classroom.base_text(), classroom.roster_text(1)))  # fmt: skip
    wanted = {"title": "x", "base.toml": base, "roster": roster, "seed": "1 --rubric /etc/passwd"}
    name = page.post("/api/teacher", wanted)["name"]
    lines: dict[str, Any] = {}
    for _ in range(300):
        lines = page.get(f"/api/teacher/{name}")
        if lines["state"] not in ("waiting", "running"):
            break
        time.sleep(0.1)
    client.cookies.clear()
    assert lines["state"] == "failed" and "нужно число" in lines["lines"][0]


XSS = "<script>alert(1)</script>\"'><img src=x onerror=alert(1)>"


def test_names_stay_names(page: Page, client: TestClient) -> None:
    raw = page.sample()
    raw["engine"]["name"] = XSS
    answer = client.post("/api/start", json={"raw": raw}, headers=MARK)
    assert answer.headers["content-type"].startswith("application/json")
    assert answer.headers["x-content-type-options"] == "nosniff"
    policy = client.get("/").headers["content-security-policy"]
    assert "script-src 'self' blob:;" in policy and "frame-ancestors 'none'" in policy
    names = [path.name for path in STATIC.glob("*.js")]
    assert len(names) > 5
    for name in names:
        text = client.get(f"/static/{name}").text
        assert "dangerouslySetInnerHTML" not in text and text.startswith("//")
        assert "innerHTML" not in text and "insertAdjacentHTML" not in text and "eval(" not in text


def test_a_slow_body_is_given_up(tmp_path: Path) -> None:
    sent: list[Any] = []

    async def drip() -> Any:
        await asyncio.sleep(0.05)
        return {"type": "http.request", "body": b"x", "more_body": True}

    async def keep(message: Any) -> None:
        sent.append(message)

    guard = create_app(Settings(tmp_path, body_s=0.3))
    heads = {"host": "localhost", "x-kshm": "1", "content-type": "application/json"}
    scope = {
        "type": "http", "method": "POST", "path": "/api/new", "raw_path": b"/api/new",
        "query_string": b"", "client": ("1.2.3.4", 1), "scheme": "http", "root_path": "",
        "headers": [(key.encode(), value.encode()) for key, value in heads.items()],
    }  # fmt: skip
    finished(guard(scope, drip, keep))
    assert sent[0]["status"] == 408


def test_one_address_may_not_ask_for_ever() -> None:
    rate = Rate(5, seconds=60)
    assert sum(rate.allows("1.2.3.4") for _ in range(50)) == 5
    assert rate.allows("5.6.7.8")


def test_behind_a_proxy_under_a_path(tmp_path: Path) -> None:
    app = create_app(
        Settings(tmp_path, public="https://kafedra.example/kshm", per_s=1e6, workers=1)
    )
    with TestClient(app, base_url="http://127.0.0.1:8321") as proxied:
        head = {"host": "kafedra.example"}
        assert "api/" not in proxied.get("/kshm/", headers=head).text
        assert proxied.get("/kshm/static/engine.js", headers=head).status_code == 200
        assert proxied.get("/api/choices", headers=head).status_code == 200
        own = {**head, **MARK, "origin": "https://kafedra.example"}
        assert (
            proxied.post("/kshm/api/new", json={"sample": "gots-p3"}, headers=own).status_code
            == 200
        )
        own["origin"] = "https://other.example"
        assert proxied.post("/kshm/api/new", json={}, headers=own).status_code == 403


@pytest.mark.parametrize(
    ("host", "code"), [("192.168.1.5:8321", 200), ("[fe80::1]:80", 200), ("evil.example", 421)]
)
def test_in_a_network_an_address_is_known_and_a_name_is_not(
    tmp_path: Path, host: str, code: int
) -> None:
    app = create_app(Settings(tmp_path, ("*",), workers=1))
    assert TestClient(app).get("/", headers={"host": host}).status_code == code


@pytest.mark.parametrize(
    ("answer", "code"), [(HTTPException(503, "занят"), 200), (InputError("не книга"), 422)]
)
def test_a_busy_server_turns_no_work_away(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, answer: Exception, code: int
) -> None:
    """Whoever hands in at the last minute is not told to come again; what is no book is refused."""

    async def asked(*_: object, **__: object) -> dict[str, Any]:
        raise answer

    monkeypatch.setattr(http_guards, "ask", asked)
    path = tmp_path / "work.xlsx"
    routes = http_guards.shown(
        "/x", lambda _: http_guards.Shown({}, {"book": tmp_path / "issued.xlsx"}, {"work": path})
    )
    handlers: Any = {InputError: http_guards.failed}
    session = Middleware(SessionMiddleware, "x")
    app = Starlette(routes=routes, exception_handlers=handlers, middleware=[session])
    app.state.settings, app.state.unfinished = Settings(tmp_path), Unfinished(100)
    app.state.uploading = Turns(1, 1, 1, 1.0)
    assert TestClient(app).post("/x/work", content=b"PK").status_code == code
    assert path.exists() == (code == 200)


def test_secrets_lie_closed(client: TestClient) -> None:
    data = client.app.app.state.settings.data  # type: ignore[attr-defined]
    assert (data / "secret.key").stat().st_mode & 0o077 == 0
    secret = kept_secret(data / SECRET)
    assert token_of(secret) not in secret.hex()
