"""Finished reports for one worker; a local listener that writes down what is asked of it."""

import http.server
import json
import threading

import pytest

from reports.document import report, store
from reports.document.chapters import closing, opening
from reports.document.page import writer
from reports.document.text.mathsvg import formula, formula_lines


def pytest_collection_modifyitems(items):
    """Tests that share finished reports run in one worker: two would set each report twice."""
    for item in items:
        if item.path.name in ("test_report_pdf.py", "test_report_sheets.py"):
            item.add_marker(pytest.mark.xdist_group("reports"))


EMPTY = {
    "figure": "<svg></svg>",
    "formula": json.dumps(["<svg></svg>", 1.0, 1.0, 0.0]),
    "lines": json.dumps([["<svg></svg>", 1.0, 1.0, 0.0, "x"]]),
}


@pytest.fixture
def nothing_is_drawn(monkeypatch):
    """Reports without figures and formulas: a second instead of ten."""
    for cached in (formula, formula_lines):
        cached.cache_clear()
    monkeypatch.setattr(writer, "draw_all", lambda jobs: None)
    monkeypatch.setattr(store, "kept", lambda kind, content, make: EMPTY[kind])
    yield
    for cached in (formula, formula_lines):
        cached.cache_clear()


@pytest.fixture
def few_chapters(monkeypatch):
    """Reports with all their sheets, but with hardly any chapter."""
    few = {"introduction": opening.introduction, "sources": closing.sources}
    monkeypatch.setattr(report, "CHAPTERS", few)


@pytest.fixture
def listener():
    hits = []

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            hits.append(self.path)
            self.send_response(200)
            self.end_headers()

        def log_message(self, *_):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}", hits
    server.shutdown()
    server.server_close()
