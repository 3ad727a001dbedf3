"""Reports without pictures; a local listener that writes down what is asked of it."""

import http.server
import threading
from functools import cache

import pytest

from reports.document import report
from reports.document.page import numbering, render
from reports.document.text.mathsvg import FormulaImage
from tests.document.report_samples import BOX


@cache
def _without_formulas(media, style):
    """The environment of the templates, which are compiled once for all tests of a process."""
    page = render._environment(None, media, style)
    page.globals["formula_lines"] = lambda tex, room: (
        FormulaImage("<svg></svg>", 1.0, 1.0, 0.0, str(tex)),
    )
    return page


@pytest.fixture
def nothing_is_drawn(monkeypatch):
    """Reports without figures and formulas, which takes half the time."""
    monkeypatch.setattr(render, "_own_environment", _without_formulas)
    monkeypatch.setattr(numbering, "drawn", lambda plan: BOX)


@pytest.fixture
def few_chapters(monkeypatch):
    """Reports with all their sheets, but with hardly any chapter."""
    few = [each for each in report.CHAPTERS if each.name in ("introduction", "sources")]
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
