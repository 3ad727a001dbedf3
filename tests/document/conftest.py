"""Reports without pictures; a local listener that writes down what is asked of it."""

import http.server
import threading

import pytest

from reports.document import report
from reports.document.chapters import closing, opening
from reports.document.page import render, writer
from reports.document.text.mathsvg import Formula


@pytest.fixture
def nothing_is_drawn(monkeypatch):
    """Reports without figures and formulas, which takes half the time."""
    empty = (Formula("<svg></svg>", 1.0, 1.0, 0.0, "x"),)
    monkeypatch.setattr(render, "formula_lines", lambda tex, room: empty)
    monkeypatch.setattr(writer, "drawn", lambda plan: "<svg></svg>")
    render._own_environment.cache_clear()
    yield
    render._own_environment.cache_clear()


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
